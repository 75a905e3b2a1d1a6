"""Accelerations under forces and constraints: the KKT system, solved for the constraints' forces.

With rows J, inverse masses W and the forces F: J W Jᵀ λ = −(J W F + J̇ v), one unknown for every row that
holds and one more for every contact that sticks; a contact that slips rubs with μ times its normal
force, which enters the normal force's column. The matrix is profiled by the bodies that rows
share, so that a chain costs as much as it has links. Where rows say the same thing twice (a table on
four legs), many λ are right: the smallest is taken, by the proximal iteration
λ ← λ + (A + εI)⁻¹(b − Aλ) from zero, which never leaves the range of A.

Sources: Featherstone (2008), ch. 3; Rockafellar (1976) for the proximal point iteration.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from physics.engine import forces
from physics.engine.cells import integers
from physics.engine.exact.machine import (
    System,
    accelerations,
    change,
    factor,
    forces_of,
    found,
    given,
    matrix,
    poses,
    row_of,
    starts,
    status,
    tangents,
    unknown_rows,
    velocities,
)
from physics.engine.rows import GIVEN, ON, SLIDE, STICK, refresh
from physics.engine.tables import course_of, inverses, support_of, value
from physics.engine.world import Table
from physics.jit import part
from sketch.ink import FloatArray

SINGULAR = 1e-10
"""A pivot below this share of its diagonal entry: the row repeats others. Mass ratios of 1e6 give 1e-6."""
PROXIMAL = 1e-7
"""ε as a share of the largest diagonal entry: each iteration leaves ε / (σ + ε) of an error, σ the least
singular value that is not zero."""
ITERATIONS = 60
SETTLED = 1e-15
"""Share of λ by which the last iteration may still change it."""
NORMAL: Any = np.int64(0)
TANGENT: Any = np.int64(1)
"""Which force of a row is meant. Not plain integers, of which numba would compile a version each."""
SYSTEMS = 256
"""Systems that are remembered: scenes of one kind have the same few again and again."""
LARGEST = 1500
"""Unknowns: more would need hours and gigabytes; robust mode takes over long before."""


def system_of(rows: Table, inverse: FloatArray) -> System:
    """The unknowns of the rows that hold, ordered so that those that share bodies are near each other."""
    if not len(rows):
        return _system((), ())
    moves: list[bool] = np.any(inverse > 0, axis=1).tolist()
    columns = (rows[name].tolist() for name in ("kind", "status", "grip", "i", "j"))
    labels: list[tuple[int, int]] = []
    bodies: list[tuple[int, int]] = []
    for k, (kind, on, grip, i, j) in enumerate(zip(*columns, strict=True)):
        if on != ON:
            continue
        ends = (i if moves[i] else -1, j if moves[j] else -1)
        if kind != GIVEN:
            labels.append((k, 0))
            bodies.append(ends)
        if grip == STICK:
            labels.append((k, 1))
            bodies.append(ends)
    return _system(tuple(labels), tuple(bodies))


@lru_cache(SYSTEMS)
def _system(labels: tuple[tuple[int, int], ...], bodies: tuple[tuple[int, int], ...]) -> System:
    """labels: the row of each unknown, and 1 for the force along its tangent; bodies: the two that it acts on,
    −1 where one cannot move."""
    touching: dict[int, list[int]] = {}
    for a, ends in enumerate(bodies):
        for body in ends:
            if body >= 0:
                touching.setdefault(body, []).append(a)
    pairs = {(max(a, b), min(a, b)) for group in touching.values() for a in group for b in group}
    pairs |= {(a, a) for a in range(len(labels))}
    order = list(labels)
    if len(order) > 8:
        order, pairs = _banded(order, pairs)
    start = np.arange(len(order))
    for a, b in pairs:
        start[a] = min(start[a], b)
    return System(
        np.array([k for k, _ in order], np.int64),
        np.array([tangent for _, tangent in order], np.int64),
        start,
        np.array(sorted(pairs), np.int64).reshape(-1, 2),
    )


def _banded(
    labels: list[tuple[int, int]], pairs: set[tuple[int, int]]
) -> tuple[list[tuple[int, int]], set[tuple[int, int]]]:
    """The same in an order that keeps the profile narrow (reverse Cuthill-McKee)."""
    # Here, for it takes long to import and few scenes need it.
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    m = len(labels)
    a, b = np.array(sorted(pairs)).T
    graph = csr_matrix((np.ones(2 * len(a)), (np.r_[a, b], np.r_[b, a])), shape=(m, m))
    order = reverse_cuthill_mckee(graph, symmetric_mode=True)
    place = np.empty(m, np.int64)
    place[order] = np.arange(m)
    moved = {(int(max(place[x], place[y])), int(min(place[x], place[y]))) for x, y in pairs}
    return [labels[k] for k in order], moved


@part
def accelerate(w: Any, m: Any, t: float) -> float:
    """Accelerations of this moment's poses and velocities; rows get their forces. Returns the heat of
    friction, W. Poses and velocities are first put where courses say."""
    pos, vel, acc = poses(m), velocities(m), accelerations(m)
    force, inverse = forces_of(m), inverses(w)
    forces.follow(w, t, pos, vel)
    forces.add(w, t, pos, vel, force)
    for k in range(m.rows):
        row = row_of(m, k)
        refresh(row, pos, vel)
        row.force = 0.0
        row.rub = 0.0
        if row.kind == GIVEN:
            _rub_given(row, w, t, pos, vel, force)
    for i in range(len(acc)):
        for a in range(3):
            acc[i, a] = force[i, a] * inverse[i, a]
    for k in range(w.courses):
        course = course_of(w, k)
        if course.on:
            acc[course.body, course.axis] = value(w, course.acceleration, t, pos, vel)
    n = m.unknowns
    if n > 0:
        owners, tangent, goal, solution = unknown_rows(m), tangents(m), given(m), found(m)
        for a in range(n):
            goal[a] = -demand(row_of(m, owners[a]), tangent[a], acc)
        solve(w, m)
        for a in range(n):
            row = row_of(m, owners[a])
            if tangent[a]:
                row.rub = solution[a]
            else:
                row.force = solution[a]
    heat = 0.0
    for k in range(m.rows):
        row = row_of(m, k)
        if row.status != ON:
            continue
        if row.grip == SLIDE and row.kind != GIVEN:
            row.rub = -row.sigma * row.mu * row.force
        heat -= row.rub * row.slip
        if row.kind == GIVEN and row.grip == SLIDE:
            continue
        i, j = row.i, row.j
        for a in range(3):
            push_i = row.J[a] * row.force + row.T[a] * row.rub
            push_j = row.J[3 + a] * row.force + row.T[3 + a] * row.rub
            force[i, a] += push_i
            force[j, a] += push_j
            acc[i, a] += inverse[i, a] * push_i
            acc[j, a] += inverse[j, a] * push_j
    return heat


@part
def demand(row: Any, tangent: int, acc: FloatArray) -> float:
    """The second derivative of a row's gap, or of its slip, under these accelerations, m/s²."""
    i, j = row.i, row.j
    total = 0.0
    if tangent:
        for a in range(3):
            total += row.T[a] * acc[i, a] + row.T[3 + a] * acc[j, a]
        return total + row.ct
    for a in range(3):
        total += row.J[a] * acc[i, a] + row.J[3 + a] * acc[j, a]
    return total + row.c


@part
def _rub_given(row: Any, w: Any, t: float, pos: FloatArray, vel: FloatArray, force: FloatArray) -> None:
    """Friction's bound under a given normal force; where it slips, its friction is a force like any other."""
    size = value(w, support_of(w, row.source).force, t, pos, vel)
    row.bound = row.mu * max(size, 0.0)
    if row.status == ON and row.grip == SLIDE:
        row.rub = -row.sigma * row.bound
        for a in range(3):
            force[row.i, a] += row.T[a] * row.rub
            force[row.j, a] += row.T[3 + a] * row.rub


@part
def _along(row: Any, tangent: int, at: int) -> float:
    """Entry `at` of what a row's line of the matrix is made of."""
    return row.T[at] if tangent else row.J[at]


@part
def across(row: Any, tangent: int, at: int) -> float:
    """The same of its column: what a unit of the unknown pushes, friction of a slipping contact included."""
    if tangent:
        return row.T[at]
    if row.grip == SLIDE:
        return row.J[at] - row.sigma * row.mu * row.T[at]
    return row.J[at]


@part
def coupling(first: Any, tangent: int, second: Any, other: int, inverse: FloatArray) -> float:
    """How much a unit of the second unknown accelerates along the first."""
    total = 0.0
    for one in range(2):
        body = first.i if one == 0 else first.j
        for two in range(2):
            if body == (second.i if two == 0 else second.j):
                for a in range(3):
                    total += (
                        _along(first, tangent, 3 * one + a)
                        * inverse[body, a]
                        * across(second, other, 3 * two + a)
                    )
    return total


@part
def solve(w: Any, m: Any) -> None:
    """found ← the forces that give the rows what `given` asks, the smallest where many do."""
    inverse = inverses(w)
    if m.unknowns == 1:
        row, tangent = row_of(m, unknown_rows(m)[0]), tangents(m)[0]
        total = coupling(row, tangent, row, tangent, inverse)
        status(m)[0] = 0
        found(m)[0] = given(m)[0] / total if total != 0.0 else 0.0
        return
    even = _even(m)
    _fill(m, inverse, even)
    _solve(m, even)


@part
def _even(m: Any) -> bool:
    """Whether the matrix is symmetric: only what slips pushes otherwise than it gives."""
    even = True
    for a in range(m.unknowns):
        even = even and row_of(m, unknown_rows(m)[a]).grip != SLIDE
    return even


@part
def _fill(m: Any, inverse: FloatArray, even: bool) -> None:
    a_matrix, start, owners, tangent = matrix(m), starts(m), unknown_rows(m), tangents(m)
    for a in range(m.unknowns):
        for b in range(start[a], a + 1):
            a_matrix[a, b] = 0.0
            a_matrix[b, a] = 0.0
    couples = integers(m, m.couples_at, 2 * m.couples)
    for k in range(m.couples):
        a, b = couples[2 * k], couples[2 * k + 1]
        first, second = row_of(m, owners[a]), row_of(m, owners[b])
        a_matrix[a, b] = coupling(first, tangent[a], second, tangent[b], inverse)
        if a != b:
            a_matrix[b, a] = (
                a_matrix[a, b] if even else coupling(second, tangent[b], first, tangent[a], inverse)
            )


@part
def _factor(m: Any, shift: float, even: bool) -> bool:
    """LU of matrix + shift · 1 within its profile, U = D Lᵀ where the matrix is symmetric; tells whether a pivot
    vanished."""
    full, lu, start = matrix(m), factor(m), starts(m)
    for a in range(m.unknowns):
        low = start[a]
        for b in range(low, a):
            lower = full[a, b]
            for k in range(max(low, start[b]), b):
                lower -= lu[a, k] * lu[k, b]
            lu[a, b] = lower / lu[b, b]
            upper = lower
            if not even:
                upper = full[b, a]
                for k in range(max(low, start[b]), b):
                    upper -= lu[b, k] * lu[k, a]
            lu[b, a] = upper
        pivot = full[a, a] + shift
        for k in range(low, a):
            pivot -= lu[a, k] * lu[k, a]
        if abs(pivot) <= SINGULAR * (abs(full[a, a]) + shift) or pivot != pivot:
            return True
        lu[a, a] = pivot
    return False


@part
def _substitute(m: Any) -> None:
    """change ← (LU)⁻¹ change."""
    lu, start, x = factor(m), starts(m), change(m)
    for a in range(m.unknowns):
        for k in range(start[a], a):
            x[a] -= lu[a, k] * x[k]
    for a in range(m.unknowns - 1, -1, -1):
        x[a] /= lu[a, a]
        for k in range(start[a], a):
            x[k] -= lu[k, a] * x[a]


@part
def _residual(m: Any) -> None:
    """change ← given − matrix · found, within the profile."""
    full, start, rest, goal, solution = matrix(m), starts(m), change(m), given(m), found(m)
    for a in range(m.unknowns):
        rest[a] = goal[a]
    for a in range(m.unknowns):
        rest[a] -= full[a, a] * solution[a]
        for b in range(start[a], a):
            rest[a] -= full[a, b] * solution[b]
            rest[b] -= full[b, a] * solution[a]


@part
def _solve(m: Any, even: bool) -> None:
    full, solution, step, goal = matrix(m), found(m), change(m), given(m)
    n = m.unknowns
    for a in range(n):
        solution[a], step[a] = 0.0, goal[a]
    if not _factor(m, 0.0, even):
        status(m)[0] = 0
        for turn in range(2):
            # The second time mends what rounding left.
            if turn > 0:
                _residual(m)
            _substitute(m)
            for a in range(n):
                solution[a] += step[a]
        return
    status(m)[0] = 1
    largest = 0.0
    for a in range(n):
        largest = max(largest, abs(full[a, a]))
    shift = PROXIMAL * largest if largest > 0.0 else 1.0
    # Slipping contacts can make A + εI singular all the same; ever more weight on ε mends that.
    for _ in range(6):
        if not _factor(m, shift, even):
            break
        shift *= 100.0
    for _ in range(ITERATIONS):
        _residual(m)
        _substitute(m)
        size = 0.0
        moved = 0.0
        for a in range(n):
            solution[a] += step[a]
            size = max(size, abs(solution[a]))
            moved = max(moved, abs(step[a]))
        if moved <= SETTLED * size:
            break
