"""The beam that shares strokes out among groups, compiled by numba."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from recognizer.handwriting.search.ranked import room
from recognizer.jit import kernel
from sketch.ink import FloatArray

Indices = NDArray[np.int64]


@kernel
def cover(
    strokes: int, members: Indices, ends: Indices, costs: FloatArray, width: int
) -> tuple[FloatArray, Indices, Indices]:
    """The likeliest ways to cover strokes 0 … n − 1 by groups, none of them twice, the best first: scores (w,), positions of the
    groups (w, n) and how many of these count (w,).

    members: the strokes of the groups one after another, ascending in each, ends (g,) where each group ends, groups ascending
    by their first stroke; costs (g,): of each group, a logarithm.
    """
    count = len(ends)
    first = np.full(strokes + 1, count, dtype=np.int64)
    for group in range(count - 1, -1, -1):
        first[members[0 if group == 0 else ends[group - 1]]] = group
    for stroke in range(strokes - 1, -1, -1):
        first[stroke] = min(first[stroke], first[stroke + 1])
    scores = np.zeros(1)
    taken = np.zeros((1, strokes), dtype=np.bool_)
    chosen = np.zeros((1, strokes), dtype=np.int64)
    counts = np.zeros(1, dtype=np.int64)
    best = np.full(width, -np.inf)
    ways = np.zeros((width, 2), dtype=np.int64)
    for stroke in range(strokes):
        held = 0
        for state in range(len(scores)):
            if taken[state, stroke]:
                held = _offered(scores[state], state, -1, best, ways, held)
                continue
            for group in range(first[stroke], first[stroke + 1]):
                gain = scores[state] + costs[group]
                if held == width and gain <= best[width - 1]:
                    continue
                free = True
                for at in range(0 if group == 0 else ends[group - 1], ends[group]):
                    free = free and not taken[state, members[at]]
                if free:
                    held = _offered(gain, state, group, best, ways, held)
        scores = best[:held].copy()
        before, picked, had = taken, chosen, counts
        taken = np.zeros((held, strokes), dtype=np.bool_)
        chosen = np.zeros((held, strokes), dtype=np.int64)
        counts = np.zeros(held, dtype=np.int64)
        for w in range(held):
            state, group = ways[w, 0], ways[w, 1]
            taken[w], chosen[w], counts[w] = before[state], picked[state], had[state]
            if group >= 0:
                for at in range(0 if group == 0 else ends[group - 1], ends[group]):
                    taken[w, members[at]] = True
                chosen[w, counts[w]] = group
                counts[w] += 1
    return scores, chosen, counts


@kernel
def _offered(gain: float, state: int, group: int, best: FloatArray, ways: Indices, held: int) -> int:
    """Puts a way in its place among the best so far; returns how many are held."""
    place = room(gain, best, ways, held)
    if place < 0:
        return held
    ways[place, 0], ways[place, 1] = state, group
    return min(held + 1, len(best))
