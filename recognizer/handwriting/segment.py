"""Strokes shared out among signs: the likeliest ways to cover a line by groups, none of them twice.

Each stroke's probability is that of its group being a sign, so that two strokes taken as one sign and as
two are weighed alike. A beam takes the strokes in drawing order: the first one that is still free belongs
to a group whose first stroke it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from heapq import nlargest

import numpy as np

from recognizer.handwriting.line import Group
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class SegmentRule:
    width: int = 30
    """States of the beam."""
    kept: int = 4
    """Ways that are read."""
    unlikely: float = 7.0
    """Ways this far below the best are not read: natural logarithm."""


RULE = SegmentRule()


@dataclass(frozen=True, slots=True)
class Covering:
    """A way to share out the strokes: positions of its groups, and the logarithm of its chance beyond that of each
    group's sign, which is counted once where signs are chosen."""

    groups: tuple[int, ...]
    score: float


def coverings(
    strokes: int, groups: Sequence[Group], scores: FloatArray, rule: SegmentRule = RULE
) -> list[Covering]:
    """The likeliest coverings of strokes 0 … n − 1, the best first; scores (groups, signs + 1) as of `SignReader`."""
    real = np.log(np.maximum(-np.expm1(np.minimum(scores[:, -1], -1e-9)), 1e-12))
    sizes = np.array([len(group) for group in groups])
    # Each stroke vouches for its group being a sign and for which: a word is no cheaper than its letters.
    told = scores[:, :-1].max(axis=1) - real
    value = sizes * (real + told)
    best = np.full(strokes, -np.inf)
    for group, each in zip(groups, (value / sizes).tolist(), strict=True):
        for stroke in group:
            best[stroke] = max(best[stroke], each)
    starting: list[list[tuple[int, float, int]]] = [[] for _ in range(strokes)]
    for position, group in enumerate(groups):
        cost = float(value[position] - best[list(group)].sum())
        starting[group[0]].append((sum(1 << stroke for stroke in group), cost, position))
    states: list[tuple[float, int, tuple[int, ...]]] = [(0.0, 0, ())]
    for stroke in range(strokes):
        found: list[tuple[float, int, tuple[int, ...]]] = []
        for score, covered, chosen in states:
            if covered >> stroke & 1:
                found.append((score, covered, chosen))
                continue
            for mask, cost, position in starting[stroke]:
                if not covered & mask:
                    found.append((score + cost, covered | mask, (*chosen, position)))
        states = nlargest(rule.width, found, key=lambda state: state[0])
    top = states[0][0]
    return [
        Covering(positions, float((value[list(positions)] - told[list(positions)]).sum()))
        for score, _, positions in states[: rule.kept]
        if score > top - rule.unlikely
    ]
