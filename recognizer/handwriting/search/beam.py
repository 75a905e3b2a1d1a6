"""The beam that reads a region's items from left to right into rows, compiled by numba.

A state is a reading of the items so far. It knows which rows are open: a sign goes on one of them, or begins a script of the
last sign of one. A row that is gone on with closes the scripts that hang on it. Chances are natural logarithms.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from recognizer.handwriting.search.ranked import room
from recognizer.jit import kernel
from sketch.ink import FloatArray

Indices = NDArray[np.int64]

RIGHT, SUB, SUP, NONE, FIT = 0, 1, 2, 3, 4
SCRIPTED = 3
"""Added to SUB and SUP it is the table of what a script begins with; ROWED added, of how it goes on: see `language`."""
ROWED = 1
ROWS = 10
"""Rows open at once, at most."""
LAST, CHOSEN, SCRIPTS, PARENT, TABLE, ROUND, SQUARE, BARS, NORMS = range(9)
"""What a state knows of an open row: its last item and that one's choice, which scripts that has (1, 2), the row that it
hangs on (−1), the table of what follows in it, and how many round and square brackets, bars and double bars are open in it."""
FIELDS = 9
(RELATION, LANGUAGE, AGAIN, BARE, ENDS, OPEN, FLOOR, SUBBED, SUPPED, FITTING) = range(10)
"""Places of the weights, see `layout.LayoutRule`."""
(NEITHER, ROUND_OPENS, ROUND_CLOSES, SQUARE_OPENS, SQUARE_CLOSES, BAR, NORM) = range(7)
"""What a sign does to brackets."""


@kernel
def beam(
    signs: Indices,
    kinds: Indices,
    scores: FloatArray,
    counts: Indices,
    relation: FloatArray,
    follow: FloatArray,
    letters: FloatArray,
    start: FloatArray,
    table: int,
    letter: NDArray[np.bool_],
    brackets: Indices,
    weights: FloatArray,
    width: int,
) -> tuple[FloatArray, Indices, Indices, Indices]:
    """The likeliest readings of n items, the best first: scores (w,), and of each item its choice, the item that it hangs on
    (−1 where it begins the region) and how: (w, n) each.

    signs, scores (n, c): what each item may be and the logarithm of its chance, counts (n,) how many of them; kinds (n, c): which
    column of `relation` (n, back, k, k, 5), the scores of an item's relation to those just before it, a choice has;
    follow (6, s, s + 1), letters (6, s) and start (s,): what usually follows, see `language.Language`; table: of `follow` for the
    region; letter (s,): which signs are letters; brackets (s,): what a sign does to brackets.
    """
    n, back = len(signs), relation.shape[1]
    score = np.full(width, -np.inf)
    rows = np.zeros((width, ROWS, FIELDS), dtype=np.int64)
    open_rows = np.zeros(width, dtype=np.int64)
    used = np.zeros((width, len(start)), dtype=np.bool_)
    came = np.zeros((n, width, 4), dtype=np.int64)
    best = np.full(width, -np.inf)
    ways = np.zeros((width, 4), dtype=np.int64)
    held = 0
    for at in range(counts[0]):
        gain = scores[0, at] + weights[LANGUAGE] * np.log(start[signs[0, at]])
        held = _offered(gain, 0, 0, at, 0, best, ways, held)
    for w in range(held):
        at = ways[w, 2]
        score[w] = best[w]
        rows[w, 0] = 0
        rows[w, 0, CHOSEN], rows[w, 0, PARENT], rows[w, 0, TABLE] = at, -1, table
        off = _bracket(rows[w, 0], int(brackets[signs[0, at]]))
        score[w] -= weights[OPEN] * off
        open_rows[w] = 1
        used[w, signs[0, at]] = True
        came[0, w, 0], came[0, w, 1], came[0, w, 2] = -1, at, -1
    states = held
    for child in range(1, n):
        held = 0
        floor = weights[FLOOR]
        for _ in range(2):
            held = 0
            for state in range(states):
                held = _ways(
                    child, state, score[state], rows[state], open_rows[state], used[state], signs, kinds, scores, counts,
                    relation, back, follow, letters, letter, brackets, weights, floor, best, ways, held,
                )  # fmt: skip
            if held:
                break
            floor = -np.inf  # nothing is near enough to hang on: on the likeliest, then
        new_score = best[:held].copy()
        new_rows = np.zeros((width, ROWS, FIELDS), dtype=np.int64)
        new_open = np.zeros(width, dtype=np.int64)
        new_used = np.zeros((width, len(start)), dtype=np.bool_)
        for w in range(held):
            state, row, at, how = ways[w, 0], ways[w, 1], ways[w, 2], ways[w, 3]
            came[child, w, 0], came[child, w, 1] = state, at
            came[child, w, 2], came[child, w, 3] = rows[state, row, LAST], how
            sign = signs[child, at]
            new_used[w] = used[state]
            new_used[w, sign] = True
            new_open[w] = _next(
                rows[state], int(open_rows[state]), row, child, at, how, int(brackets[sign]), new_rows[w]
            )
        score[:held] = new_score
        rows, open_rows, used, states = new_rows, new_open, new_used, held
    for state in range(states):
        for row in range(open_rows[state]):
            score[state] += _closed(rows[state, row], signs, follow, weights)
    order = np.argsort(-score[:states])
    chosen = np.zeros((states, n), dtype=np.int64)
    parents = np.zeros((states, n), dtype=np.int64)
    hows = np.zeros((states, n), dtype=np.int64)
    for k in range(states):
        state = order[k]
        for item in range(n - 1, -1, -1):
            chosen[k, item], parents[k, item], hows[k, item] = (
                came[item, state, 1], came[item, state, 2], came[item, state, 3]
            )  # fmt: skip
            state = came[item, state, 0]
    return score[order], chosen, parents, hows


@kernel
def _offered(
    gain: float, state: int, row: int, at: int, how: int, best: FloatArray, ways: Indices, held: int
) -> int:
    """Puts a way in its place among the best so far; returns how many are held."""
    place = room(gain, best, ways, held)
    if place < 0:
        return held
    ways[place, 0], ways[place, 1], ways[place, 2], ways[place, 3] = state, row, at, how
    return min(held + 1, len(best))


@kernel
def _ways(
    child: int,
    state: int,
    before: float,
    rows: Indices,
    count: int,
    used: NDArray[np.bool_],
    signs: Indices,
    kinds: Indices,
    scores: FloatArray,
    counts: Indices,
    relation: FloatArray,
    back: int,
    follow: FloatArray,
    letters: FloatArray,
    letter: NDArray[np.bool_],
    brackets: Indices,
    weights: FloatArray,
    floor: float,
    best: FloatArray,
    ways: Indices,
    held: int,
) -> int:
    """Offers every way to go on from a state with the next item."""
    closing = np.zeros(count)
    for row in range(count):
        # What closes when this row is gone on with: the scripts that hang on it, at any depth.
        for other in range(row + 1, count):
            above = rows[other, PARENT]
            while above > row:
                above = rows[above, PARENT]
            if above == row:
                closing[row] += _closed(rows[other], signs, follow, weights)
    believed = np.empty((count, 5))
    known = np.sum(used & letter)
    for at in range(counts[child]):
        sign = signs[child, at]
        none = 0.0
        for row in range(count):
            last = rows[row, LAST]
            gap = child - last - 1
            if gap < back:
                believed[row] = relation[child, gap, kinds[last, rows[row, CHOSEN]], kinds[child, at]]
            else:
                believed[row] = -9.0
                believed[row, NONE] = believed[row, FIT] = -0.01
            none += believed[row, NONE]
        for row in range(count):
            parent = signs[rows[row, LAST], rows[row, CHOSEN]]
            scripts = rows[row, SCRIPTS]
            for how in range(NONE):
                if believed[row, how] < floor or (how and (scripts & how or count == ROWS)):
                    continue
                table = rows[row, TABLE] if how == RIGHT else how + SCRIPTED
                chance = follow[table, parent, sign]
                if known and letter[sign]:
                    chance *= 1 - weights[AGAIN]
                    if used[sign]:
                        chance += weights[AGAIN] * letters[table, parent] / known
                usual = np.log(chance)
                off = 0.0
                if how == SUB:
                    off = weights[SUBBED]
                elif how == SUP:
                    off = weights[SUPPED]
                if how == RIGHT:
                    usual += weights[BARE] * _bare(int(parent), scripts, follow)
                    off = closing[row]
                    if _unopened(rows[row], int(brackets[sign])):
                        off -= weights[OPEN]
                elif brackets[sign] == ROUND_CLOSES or brackets[sign] == SQUARE_CLOSES:
                    off -= weights[OPEN]
                gain = scores[child, at] + weights[RELATION] * (
                    none - believed[row, NONE] + believed[row, how]
                )
                gain += weights[FITTING] * believed[row, FIT]
                held = _offered(
                    before + gain + weights[LANGUAGE] * usual + off, state, row, at, how, best, ways, held
                )
    return held


@kernel
def _unopened(row: Indices, bracket: int) -> bool:
    return (bracket == ROUND_CLOSES and row[ROUND] == 0) or (bracket == SQUARE_CLOSES and row[SQUARE] == 0)


@kernel
def _bracket(row: Indices, bracket: int) -> int:
    """The sign goes on the row; returns 1 where it closes what is not open."""
    off = 1 if _unopened(row, bracket) else 0
    if bracket == ROUND_OPENS:
        row[ROUND] += 1
    elif bracket == ROUND_CLOSES:
        row[ROUND] = max(row[ROUND] - 1, 0)
    elif bracket == SQUARE_OPENS:
        row[SQUARE] += 1
    elif bracket == SQUARE_CLOSES:
        row[SQUARE] = max(row[SQUARE] - 1, 0)
    elif bracket == BAR:
        row[BARS] = 1 - row[BARS]
    elif bracket == NORM:
        row[NORMS] = 1 - row[NORMS]
    return off


@kernel
def _closed(row: Indices, signs: Indices, follow: FloatArray, weights: FloatArray) -> float:
    """What it costs that the row ends here: how seldom its last sign is a row's last, and the brackets left open."""
    unpaired = row[ROUND] + row[SQUARE] + row[BARS] + row[NORMS]
    last = signs[row[LAST], row[CHOSEN]]
    ends = np.log(follow[row[TABLE], last, len(follow[0])])
    bare = _bare(int(last), row[SCRIPTS], follow)
    return weights[LANGUAGE] * weights[ENDS] * (ends + weights[BARE] * bare) - weights[OPEN] * unpaired


@kernel
def _bare(sign: int, scripts: int, follow: FloatArray) -> float:
    """The logarithm of the chance that the sign has no other scripts than these."""
    end = len(follow[0])
    usual = 0.0
    if not scripts & SUB:
        usual += np.log(follow[SCRIPTED + SUB, sign, end])
    if not scripts & SUP:
        usual += np.log(follow[SCRIPTED + SUP, sign, end])
    return usual


@kernel
def _next(
    rows: Indices, count: int, row: int, child: int, at: int, how: int, bracket: int, made: Indices
) -> int:
    """The rows that are open once the item has its place, written to `made`; returns how many."""
    if how != RIGHT:
        made[:count] = rows[:count]
        made[row, SCRIPTS] |= how
        made[count] = 0
        made[count, LAST], made[count, CHOSEN], made[count, PARENT] = child, at, row
        made[count, TABLE] = ROWED + how
        _bracket(made[count], bracket)
        return count + 1
    place = np.full(ROWS, -1, dtype=np.int64)
    kept = 0
    for other in range(count):
        above = rows[other, PARENT]
        if other > row and (above == row or (above > row and place[above] < 0)):
            continue  # a script of the row, or one of such a script: closed
        made[kept] = rows[other]
        if above >= 0:
            made[kept, PARENT] = place[above]
        place[other] = kept
        kept += 1
    here = made[place[row]]
    here[LAST], here[CHOSEN], here[SCRIPTS] = child, at, 0
    _bracket(here, bracket)
    return kept
