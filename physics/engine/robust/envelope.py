"""The system of a crowd's active rows, factorized: a sparse symmetric matrix over bodies, kept in its envelope.

(M + Σ D jᵀj) δ = Σ D r jᵀ, where j is a row over the velocities of two bodies, D its stiffness, r what its rate
lacks. Bodies are numbered by breadth from one at the rim (Cuthill and McKee 1969), the last first (George
1971), so that all that is not zero lies near the diagonal, and Cholesky's factor fills no more than that envelope
(Jennings 1966).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

DEAREST = 4e5
"""Multiplications that one factorization may cost; sweeps are cheaper than more (about 0.4 ms)."""


@part
def numbered(who: IntArray, count: int, inverse: FloatArray, place: IntArray) -> int:
    """Numbers the movable bodies that rows join in `place` (−1: none); how many there are. who: (rows, 2)."""
    bodies = len(inverse)
    begin, order = np.zeros(bodies + 1, np.int64), np.empty(bodies, np.int64)
    free = np.zeros(bodies, np.int64)
    for i in range(bodies):
        place[i] = -1
        if inverse[i, 0] > 0.0 or inverse[i, 1] > 0.0 or inverse[i, 2] > 0.0:
            free[i] = 1
    for k in range(count):
        i, j = who[k, 0], who[k, 1]
        begin[i + 1] += free[i]
        begin[j + 1] += free[j]
    for i in range(bodies):
        begin[i + 1] += begin[i]
    near, at = np.empty(max(begin[bodies], 1), np.int64), begin.copy()
    for k in range(count):
        i, j = who[k, 0], who[k, 1]
        if free[i] == 1:
            near[at[i]] = j
            at[i] += 1
        if free[j] == 1:
            near[at[j]] = i
            at[j] += 1
    found = 0
    for seed in range(bodies):
        if free[seed] == 0 or place[seed] >= 0 or begin[seed + 1] == begin[seed]:
            continue
        # From any body to the farthest, and from there on in earnest.
        last = _spread(seed, begin, near, free, place, order, found)
        rim = order[last - 1]
        for k in range(found, last):
            place[order[k]] = -1
        found = _spread(rim, begin, near, free, place, order, found)
    for k in range(found):
        place[order[k]] = found - 1 - k
    return found


@part
def _spread(
    seed: int,
    begin: IntArray,
    near: IntArray,
    free: IntArray,
    place: IntArray,
    order: IntArray,
    found: int,
) -> int:
    order[found] = seed
    place[seed] = 0
    head, last = found, found + 1
    while head < last:
        i = order[head]
        head += 1
        for k in range(begin[i], begin[i + 1]):
            j = near[k]
            if free[j] == 1 and place[j] < 0:
                place[j] = 0
                order[last] = j
                last += 1
    return last


@part
def laid_out(
    who: IntArray, count: int, place: IntArray, found: int, first: IntArray, base: IntArray
) -> float:
    """For each of 3 `found` lines its first column, and where its column 0 would be in the envelope (the last of
    `base`: how long that is); what a factorization costs, multiplications."""
    low = np.arange(found)
    for k in range(count):
        i, j = place[who[k, 0]], place[who[k, 1]]
        if i >= 0 and j >= 0:
            low[max(i, j)] = min(low[max(i, j)], min(i, j))
    size, cost = 0, 0.0
    for line in range(3 * found):
        first[line] = 3 * low[line // 3]
        base[line] = size - first[line]
        size += line + 1 - first[line]
        cost += 0.5 * float(line - first[line]) ** 2
    base[3 * found] = size
    return cost


@part
def filled(
    who: IntArray,
    way: FloatArray,
    stiff: FloatArray,
    count: int,
    place: IntArray,
    inverse: FloatArray,
    base: IntArray,
    matrix: FloatArray,
) -> None:
    """Writes the matrix into its envelope. way: (rows, 6), zero where a body cannot move."""
    for i in range(len(inverse)):
        if place[i] >= 0:
            for q in range(3):
                line = 3 * place[i] + q
                matrix[base[line] + line] = 1.0 / inverse[i, q] if inverse[i, q] > 0.0 else 1.0
    for k in range(count):
        for one in range(6):
            i = place[who[k, one // 3]]
            if i < 0 or way[k, one] == 0.0:
                continue
            line, pull = 3 * i + one % 3, stiff[k] * way[k, one]
            for other in range(6):
                j = place[who[k, other // 3]]
                column = 3 * j + other % 3
                if j >= 0 and column <= line:
                    matrix[base[line] + column] += pull * way[k, other]


@part
def factorized(first: IntArray, base: IntArray, lines: int, matrix: FloatArray) -> bool:
    """Cholesky's factor in the place of the matrix; False if rounding left it without one."""
    for line in range(lines):
        here = base[line]
        total = matrix[here + line]
        for column in range(first[line], line):
            there = base[column]
            rest = matrix[here + column]
            for q in range(max(first[line], first[column]), column):
                rest -= matrix[here + q] * matrix[there + q]
            rest /= matrix[there + column]
            matrix[here + column] = rest
            total -= rest * rest
        if not total > 0.0:
            return False
        matrix[here + line] = np.sqrt(total)
    return True


@part
def solved(first: IntArray, base: IntArray, lines: int, matrix: FloatArray, side: FloatArray) -> None:
    """Replaces the right side by the answer."""
    for line in range(lines):
        rest = side[line]
        for q in range(first[line], line):
            rest -= matrix[base[line] + q] * side[q]
        side[line] = rest / matrix[base[line] + line]
    for step in range(lines):
        line = lines - 1 - step
        side[line] /= matrix[base[line] + line]
        for q in range(first[line], line):
            side[q] -= matrix[base[line] + q] * side[line]
