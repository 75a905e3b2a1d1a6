"""The impulses of one blow: what each row that takes part must push so that it afterwards goes as it should.

With rows J, tangents T and inverse masses W, velocities become v + W (Jᵀp + Tᵀr); for every row either J·v is what
it aims at and p pushes, or J·v is more and p is zero; friction stops the slip if |r| < μp does, and else r = ±μp
against it. Sweeps over the rows, one after another, come near at once, and to the end where few bodies share the
blow. Where they crawl (bodies jammed between others, mass ratios), the guess that they have made of which rows push
and which stick is solved as one linear system, and put right row by row, the worst first.

Frame: SI units, y up. Sources: Moreau (1988), the sweeps (projected Gauss-Seidel); Murty (1974), Note on a Bard-type
scheme, for changing one row at a time.
"""

from __future__ import annotations

from math import sqrt
from typing import Any, NamedTuple

import numpy as np

from physics.engine.rows import CORD, POINT
from physics.engine.tables import inverses
from physics.engine.world import IntArray, Table
from physics.jit import part
from sketch.ink import FloatArray

HELD = 2.0
"""Mark of a row that may pull as well as push, to stay shut."""
JAMMED = 3.0
"""Mark of a row that may pull and push, and rub as hard as it takes."""
SWEEPS = 5120
SETTLED = 2e-16
"""Share of the greatest speed about by which the last sweep may still change one."""
CRAWLS = 40
"""Sweeps after which the system is solved at once instead, and again after twice, four times as many."""
EXACT = 1e-11
"""Share of the greatest speed about by which one may be wrong where the sweeps do not settle."""
SINGULAR = 1e-11
"""A pivot below this, of rows scaled to one: the row repeats others, and keeps what the sweeps gave it."""
SETS = 4096
"""Sets of rows that are all tried where the worst-first rule finds no end: six contacts with friction."""
IDLE, PUSHES = 0, 1
"""Of a row that takes part: it is left, or it holds its aim."""
SMOOTH, STICKS, SLIPS = 0, 1, 2


class Guess(NamedTuple):
    """Which rows push (`PUSHES`), how they rub (`STICKS`) and which way they slip (±1), each (rows,); the impulses that
    follow, N s; the velocities `bare` of all impulses and `after` them, (bodies + 1, 3)."""

    push: IntArray
    grip: IntArray
    sense: FloatArray
    force: FloatArray
    rub: FloatArray
    bare: FloatArray
    after: FloatArray


@part
def blow(w: Any, rows: Table, vel: FloatArray) -> bool:
    """Impulses of the rows that take part (`bound` is 1, `HELD` or `JAMMED`), into row.force and row.rub; changes
    `vel`. Tells whether they were found: else they are only near."""
    for k in range(len(rows)):
        rows[k].force = rows[k].rub = 0.0
    swift = _swiftest(rows, vel)
    look = CRAWLS
    moved = 0.0
    for turn in range(SWEEPS):
        moved = _sweep(w, rows, vel)
        if moved <= SETTLED * swift:
            return True
        if turn + 1 == look:
            look *= 2
            if _solved(w, rows, vel, EXACT * swift):
                return True
    return moved <= EXACT * swift or _searched(w, rows, vel, EXACT * swift)


@part
def _swiftest(rows: Table, vel: FloatArray) -> float:
    """The greatest speed that rates are the difference of, m/s: what their rounding errors are a share of."""
    most = 0.0
    for k in range(len(rows)):
        row = rows[k]
        if row.bound > 0.0:
            for a in range(3):
                most = max(most, abs(row.J[a] * vel[row.i, a]), abs(row.J[3 + a] * vel[row.j, a]))
                most = max(most, abs(row.T[a] * vel[row.i, a]), abs(row.T[3 + a] * vel[row.j, a]))
    return most


@part
def _sweep(w: Any, rows: Table, vel: FloatArray) -> float:
    """One sweep over all rows; the most that it changed a speed by, m/s."""
    inverse = inverses(w)
    moved = 0.0
    for k in range(len(rows)):
        row = rows[k]
        if row.bound == 0.0:
            continue
        give, rate = _give(row, row.J, inverse), _rate(row, row.J, vel)
        if give > 0.0:
            total = row.force + (row.along - rate) / give
            if not _pulls(row):
                total = max(total, 0.0)
            change = total - row.force
            row.force = total
            _push(row, row.J, change, inverse, vel)
            moved = max(moved, abs(change) * give)
        if _rubs(row, inverse):
            give, rate, bound = _give(row, row.T, inverse), _rate(row, row.T, vel), _bound(row)
            total = min(max(row.rub - rate / give, -bound), bound)
            change = total - row.rub
            row.rub = total
            _push(row, row.T, change, inverse, vel)
            moved = max(moved, abs(change) * give)
    return moved


@part
def _pulls(row: Any) -> bool:
    return row.kind > CORD or row.bound >= HELD


@part
def _takes_part(row: Any, inverse: FloatArray) -> bool:
    return row.bound > 0.0 and _give(row, row.J, inverse) > 0.0


@part
def _rubs(row: Any, inverse: FloatArray) -> bool:
    return row.kind <= POINT and row.mu > 0.0 and _give(row, row.T, inverse) > 0.0


@part
def _bound(row: Any) -> float:
    return row.mu * max(row.force, 0.0) if row.bound < JAMMED else 1e300


@part
def _give(row: Any, line: Any, inverse: FloatArray) -> float:
    """How much a unit of impulse along a line changes the speed along it, 1/kg."""
    total = 0.0
    for a in range(3):
        total += line[a] ** 2 * inverse[row.i, a] + line[3 + a] ** 2 * inverse[row.j, a]
    return total


@part
def _rate(row: Any, line: Any, vel: FloatArray) -> float:
    total = 0.0
    for a in range(3):
        total += line[a] * vel[row.i, a] + line[3 + a] * vel[row.j, a]
    return total


@part
def _push(row: Any, line: Any, impulse: float, inverse: FloatArray, vel: FloatArray) -> None:
    for a in range(3):
        vel[row.i, a] += inverse[row.i, a] * line[a] * impulse
        vel[row.j, a] += inverse[row.j, a] * line[3 + a] * impulse


@part
def _solved(w: Any, rows: Table, vel: FloatArray, most: float) -> bool:
    """The blow at once, from the guess that the sweeps have made: which rows push, which stick. Changes rows and
    `vel` only where it finds the answer. most: by which a speed may be wrong, m/s."""
    n = len(rows)
    inverse = inverses(w)
    guess = _nothing(rows, inverse, vel)
    push, grip, sense, rub = guess.push, guess.grip, guess.sense, guess.rub
    for k in range(n):
        row = rows[k]
        if _takes_part(row, inverse):
            push[k] = PUSHES if _pulls(row) or row.force > 0.0 else IDLE
            if _rubs(row, inverse):
                sticks = abs(row.rub) < _bound(row) or row.force <= 0.0
                grip[k] = STICKS if sticks else SLIPS
                sense[k] = np.sign(row.rub)
    for _ in range(4 * n + 8):
        _impulses(rows, inverse, guess)
        worst, what = _worst(rows, inverse, guess, most)
        if what == 0:
            _take(rows, vel, guess)
            return True
        if what < 0:
            return False
        if what == 1:
            push[worst] = PUSHES - push[worst]
            if push[worst] == PUSHES and grip[worst] != SMOOTH:
                grip[worst] = STICKS
        elif what == 2:
            grip[worst], sense[worst] = SLIPS, np.sign(rub[worst])
        else:
            grip[worst] = STICKS
    return False


@part
def _searched(w: Any, rows: Table, vel: FloatArray, most: float) -> bool:
    """The same by trying every set of rows that push, stick, slip to and fro, where there are few enough."""
    n = len(rows)
    inverse = inverses(w)
    ways = np.ones(n, np.int64)
    sets = 1
    for k in range(n):
        row = rows[k]
        if _takes_part(row, inverse):
            ways[k] = 3 if _rubs(row, inverse) else 1
            if not _pulls(row):
                ways[k] += 1
            sets *= ways[k]
            if sets > SETS:
                return False
    guess = _nothing(rows, inverse, vel)
    push, grip, sense = guess.push, guess.grip, guess.sense
    for chosen in range(sets):
        rest = chosen
        for k in range(n):
            way = rest % ways[k]
            rest //= ways[k]
            row = rows[k]
            push[k] = IDLE
            if not _takes_part(row, inverse) or (way == 0 and not _pulls(row)):
                continue
            push[k] = PUSHES
            grip[k] = SMOOTH
            if _rubs(row, inverse):
                turn = way if _pulls(row) else way - 1
                grip[k] = STICKS if turn == 0 else SLIPS
                sense[k] = 0.0 if turn == 0 else (1.0 if turn == 1 else -1.0)
        _impulses(rows, inverse, guess)
        if _worst(rows, inverse, guess, most)[1] == 0:
            _take(rows, vel, guess)
            return True
    return False


@part
def _nothing(rows: Table, inverse: FloatArray, vel: FloatArray) -> Guess:
    """That no row pushes: the velocities are those without the impulses that rows have."""
    n, bare = len(rows), vel.copy()
    for k in range(n):
        _push(rows[k], rows[k].J, -rows[k].force, inverse, bare)
        _push(rows[k], rows[k].T, -rows[k].rub, inverse, bare)
    push, grip = np.zeros(n, np.int64), np.zeros(n, np.int64)
    return Guess(push, grip, np.zeros(n), np.zeros(n), np.zeros(n), bare, bare.copy())


@part
def _impulses(rows: Table, inverse: FloatArray, guess: Guess) -> None:
    """Fills in force, rub and the velocities after them, for a set of rows that push and stick. What rows have
    already stays where many impulses would do."""
    push, grip, force, rub, after = guess.push, guess.grip, guess.force, guess.rub, guess.after
    after[:] = guess.bare
    for k in range(len(rows)):
        row = rows[k]
        force[k] = row.force if push[k] == PUSHES else 0.0
        rub[k] = 0.0
        if push[k] == PUSHES:
            if grip[k] == STICKS:
                rub[k] = row.rub
            elif grip[k] == SLIPS:
                rub[k] = guess.sense[k] * row.mu * force[k]
            _push(row, row.J, force[k], inverse, after)
            _push(row, row.T, rub[k], inverse, after)
    for _ in range(2):
        # Twice: the second time mends what rounding left.
        _step(rows, inverse, guess)


@part
def _take(rows: Table, vel: FloatArray, guess: Guess) -> None:
    for k in range(len(rows)):
        rows[k].force, rows[k].rub = guess.force[k], guess.rub[k]
    for i in range(len(vel)):
        for a in range(3):
            vel[i, a] = guess.after[i, a]


@part
def _step(rows: Table, inverse: FloatArray, guess: Guess) -> None:
    """Solves for what the impulses still lack, and adds it to force, rub and the velocities after them."""
    push, grip, sense = guess.push, guess.grip, guess.sense
    force, rub, after = guess.force, guess.rub, guess.after
    owner, tangent = np.zeros(2 * len(rows), np.int64), np.zeros(2 * len(rows), np.int64)
    m = 0
    for k in range(len(rows)):
        if push[k] == PUSHES:
            owner[m], tangent[m] = k, 0
            m += 1
            if grip[k] == STICKS:
                owner[m], tangent[m] = k, 1
                m += 1
    full, goal, scale = np.zeros((m, m)), np.zeros(m), np.zeros(m)
    nudge = np.zeros_like(after)
    for a in range(m):
        row: Any = rows[owner[a]]
        scale[a] = 1.0 / sqrt(_give(row, row.T if tangent[a] else row.J, inverse))
    for b in range(m):
        column: Any = rows[owner[b]]
        nudge[:] = 0.0
        if tangent[b]:
            _push(column, column.T, scale[b], inverse, nudge)
        else:
            _push(column, column.J, scale[b], inverse, nudge)
            if grip[owner[b]] == SLIPS:
                _push(column, column.T, scale[b] * sense[owner[b]] * column.mu, inverse, nudge)
        for a in range(m):
            row = rows[owner[a]]
            full[a, b] = scale[a] * _rate(row, row.T if tangent[a] else row.J, nudge)
    for a in range(m):
        row = rows[owner[a]]
        lacks = -_rate(row, row.T, after) if tangent[a] else row.along - _rate(row, row.J, after)
        goal[a] = scale[a] * lacks
    found = _eliminated(full, goal)
    for a in range(m):
        k = owner[a]
        row, change = rows[k], scale[a] * found[a]
        if tangent[a]:
            rub[k] += change
            _push(row, row.T, change, inverse, after)
        else:
            force[k] += change
            _push(row, row.J, change, inverse, after)
            if grip[k] == SLIPS:
                rubbing = sense[k] * row.mu * change
                rub[k] += rubbing
                _push(row, row.T, rubbing, inverse, after)


@part
def _eliminated(full: FloatArray, goal: FloatArray) -> FloatArray:
    """A solution of full x = goal, zero where unknowns repeat others; Gauss's elimination with full pivoting.
    Changes both arguments."""
    m = len(goal)
    x, order = np.zeros(m), np.arange(m)
    rank = m
    for c in range(m):
        p, q, most = c, c, 0.0
        for a in range(c, m):
            for b in range(c, m):
                if abs(full[a, b]) > most:
                    p, q, most = a, b, abs(full[a, b])
        if most <= SINGULAR:
            rank = c
            break
        for b in range(m):
            full[c, b], full[p, b] = full[p, b], full[c, b]
        goal[c], goal[p] = goal[p], goal[c]
        for a in range(m):
            full[a, c], full[a, q] = full[a, q], full[a, c]
        order[c], order[q] = order[q], order[c]
        for a in range(c + 1, m):
            share = full[a, c] / full[c, c]
            if share != 0.0:
                for b in range(c + 1, m):
                    full[a, b] -= share * full[c, b]
                goal[a] -= share * goal[c]
    for c in range(rank - 1, -1, -1):
        total = goal[c]
        for b in range(c + 1, rank):
            total -= full[c, b] * x[order[b]]
        x[order[c]] = total / full[c, c]
    return x


@part
def _worst(rows: Table, inverse: FloatArray, guess: Guess, most: float) -> tuple[int, int]:
    """(the row that is most wrong, what mends it: 0 none is, 1 to push or to be left, 2 to slip, 3 to stick, or -1: it
    cannot be mended)."""
    push, grip, sense = guess.push, guess.grip, guess.sense
    force, rub, after = guess.force, guess.rub, guess.after
    worst, which, what = most, 0, 0
    for k in range(len(rows)):
        row = rows[k]
        if not _takes_part(row, inverse):
            continue
        give = _give(row, row.J, inverse)
        lacks = row.along - _rate(row, row.J, after)
        if push[k] == IDLE:
            if lacks > worst:
                worst, which, what = lacks, k, 1
            continue
        if not _pulls(row) and -force[k] * give > worst:
            worst, which, what = -force[k] * give, k, 1
        elif abs(lacks) > worst:
            worst, which, what = abs(lacks), k, -1
        if grip[k] == STICKS:
            give = _give(row, row.T, inverse)
            over = (abs(rub[k]) - (row.mu * max(force[k], 0.0) if row.bound < JAMMED else 1e300)) * give
            if over > worst:
                worst, which, what = over, k, 2
        elif grip[k] == SLIPS and sense[k] * _rate(row, row.T, after) > worst:
            worst, which, what = sense[k] * _rate(row, row.T, after), k, 3
    return which, what
