"""One step of the motion: Dormand and Prince's method of order 8, with its dense output of order 7.

An order above the usual 5(4) pays here: at the accuracy that textbooks ask for it needs a third of
the evaluations, and its dense output is as exact as its steps. After a step positions and velocities
are brought back onto the constraints, each body by its share of mass (projection).

The state is one line of numbers: 3 N positions, 3 N velocities of the bodies that can move, and the
ledger of heat and works. Source: Hairer, Nørsett, Wanner (1993), Solving ODEs I, II.5 and II.6
(DOP853).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine import forces
from physics.engine.cells import head, line
from physics.engine.exact.machine import (
    MACHINE,
    T,
    accelerations,
    clock,
    dense_of,
    forces_of,
    found,
    given,
    newest,
    poses,
    power,
    row_of,
    slope,
    slopes,
    state,
    tangents,
    unknown_rows,
    velocities,
)
from physics.engine.exact.solve import accelerate, solve
from physics.engine.exact.tableau import E3, E5, A, C, D
from physics.engine.rows import POINT, SLIDE, refresh
from physics.engine.tables import WORLD, inverses
from physics.jit import kernel, part
from sketch.ink import FloatArray

TURNS = 6
"""Times that a state is projected before the motion begins, at most."""
NEAR = 1e-10
"""m and m/s: a projection that moves nothing farther is the last."""


@part
def unpack(y: FloatArray, movable: int, pos: FloatArray, vel: FloatArray) -> None:
    """A state's poses and velocities."""
    for i in range(movable):
        for a in range(3):
            pos[i, a] = y[3 * i + a]
            vel[i, a] = y[3 * (movable + i) + a]


@part
def derive(w: Any, m: Any, t: float, y: FloatArray, rates: FloatArray) -> bool:
    """dy/dt, (size,). False where a formula or a force has no value."""
    pos, vel, acc, power_of = poses(m), velocities(m), accelerations(m), power(m)
    movable = m.movable
    unpack(y, movable, pos, vel)
    heat = accelerate(w, m, t)
    forces.powers(w, t, pos, vel, acc, forces_of(m), heat, power_of)
    fine = True
    for i in range(movable):
        for a in range(3):
            rates[3 * i + a] = vel[i, a]
            rates[3 * (movable + i) + a] = acc[i, a]
            fine = fine and abs(acc[i, a]) < 1e300 and abs(vel[i, a]) < 1e300
    for k in range(m.ledger):
        rates[6 * movable + k] = power_of[k]
    return fine


@part
def _advance(y: FloatArray, rates: FloatArray, stage: int, h: float, new: FloatArray) -> None:
    """new ← the state at a stage: y + h Σ a rates."""
    for k in range(len(y)):
        new[k] = 0.0
    for q in range(stage):
        share = A[stage, q]
        if share != 0.0:
            for k in range(len(y)):
                new[k] += share * rates[q, k]
    for k in range(len(y)):
        new[k] = y[k] + h * new[k]


@part
def step(w: Any, m: Any, t: float, h: float, accuracy: float) -> float:
    """Takes the state on by h into `newest`, projected; slope 0 must be the derivative at the start.

    Returns the estimated error as a share of what `accuracy` allows (m and m/s, absolute below 1 and
    relative above); infinite where a formula has no value on the way. Slope 12 is the new derivative.
    """
    y, new, rates = state(m), newest(m), slopes(m)
    for s in range(1, 13):
        _advance(y, rates, s, h, new)
        if s < 12 and not derive(w, m, t + C[s] * h, new, slope(m, s)):
            return np.inf
    project(w, m, t + h, new)
    if not derive(w, m, t + h, new, slope(m, 12)):
        return np.inf
    return _error(m, h, accuracy)


@part
def _error(m: Any, h: float, accuracy: float) -> float:
    y, new, rates = state(m), newest(m), slopes(m)
    n = 6 * m.movable
    fifth, third = 0.0, 0.0
    for k in range(n):
        scale = accuracy * max(1.0, abs(y[k]), abs(new[k]))
        five, three = 0.0, 0.0
        for s in range(13):
            five += E5[s] * rates[s, k]
            three += E3[s] * rates[s, k]
        fifth += (five / scale) ** 2
        third += (three / scale) ** 2
    if fifth == 0.0 and third == 0.0:
        return 0.0
    return abs(h) * fifth / np.sqrt((fifth + 0.01 * third) * n)


@part
def project(w: Any, m: Any, t: float, y: FloatArray) -> None:
    """Brings a state back onto the rows that hold, and onto courses: first positions, then velocities."""
    pos, vel, inverse = poses(m), velocities(m), inverses(w)
    movable = m.movable
    unpack(y, movable, pos, vel)
    forces.follow(w, t, pos, vel)
    _ease(m, True)
    owners, tangent, goal, solution = unknown_rows(m), tangents(m), given(m), found(m)
    for turn in range(2 if m.unknowns > 0 else 0):
        for k in range(m.rows):
            refresh(row_of(m, k), pos, vel)
        worst = 0.0
        for a in range(m.unknowns):
            row = row_of(m, owners[a])
            if turn == 0:
                goal[a] = 0.0 if tangent[a] else -row.gap
            else:
                goal[a] = -row.slip if tangent[a] else -row.rate
            worst = max(worst, abs(goal[a]))
        if worst == 0.0:
            continue
        solve(w, m)
        moved = pos if turn == 0 else vel
        for a in range(m.unknowns):
            row = row_of(m, owners[a])
            for k in range(3):
                one = row.T[k] if tangent[a] else row.J[k]
                two = row.T[3 + k] if tangent[a] else row.J[3 + k]
                moved[row.i, k] += one * solution[a] * inverse[row.i, k]
                moved[row.j, k] += two * solution[a] * inverse[row.j, k]
    _ease(m, False)
    for i in range(movable):
        for a in range(3):
            y[3 * i + a] = pos[i, a]
            y[3 * (movable + i) + a] = vel[i, a]


@part
def _ease(m: Any, frictionless: bool) -> None:
    """Takes the friction of what slips out of the system for a while, and puts it back: a correction is no motion,
    and what slips has no say in it."""
    for k in range(m.rows):
        row = row_of(m, k)
        if row.kind <= POINT and row.grip == SLIDE:
            if frictionless:
                row.bound, row.sigma = row.sigma, 0.0
            else:
                row.sigma, row.bound = row.bound, 0.0


@part
def densify(w: Any, m: Any, t: float, h: float) -> bool:
    """Works out the dense output of the step just taken, so that `between` gives any moment of it."""
    y, new, rates, dense = state(m), newest(m), slopes(m), dense_of(m)
    scratch = line(m, m.dense_at, m.size)
    for s in range(13, 16):
        _advance(y, rates, s, h, scratch)
        if not derive(w, m, t + C[s] * h, scratch, slope(m, s)):
            return False
    for k in range(m.size):
        moved = new[k] - y[k]
        dense[0, k] = y[k]
        dense[1, k] = moved
        dense[2, k] = h * rates[0, k] - moved
        dense[3, k] = 2.0 * moved - h * (rates[12, k] + rates[0, k])
        for q in range(4):
            total = 0.0
            for s in range(16):
                total += D[q, s] * rates[s, k]
            dense[4 + q, k] = h * total
    return True


@part
def between(dense: FloatArray, x: float, y: FloatArray) -> None:
    """The state at share x of a step, by its dense output, (8, size)."""
    for k in range(len(y)):
        total = 0.0
        for q in range(7, 0, -1):
            total += dense[q, k]
            total *= x if q % 2 == 1 else 1.0 - x
        y[k] = dense[0, k] + total


@kernel
def projected(cells: FloatArray, memory: FloatArray) -> bool:
    """Projects a machine's state onto its rows; whether that moved it. Rows are curved: what was drawn far off them
    is brought nearer again and again."""
    w, m = head(cells, WORLD), head(memory, MACHINE)
    y, new = state(m), newest(m)
    moved = False
    for _ in range(TURNS):
        for k in range(m.size):
            new[k] = y[k]
        project(w, m, clock(m)[T], new)
        far = 0.0
        for k in range(m.size):
            far = max(far, abs(new[k] - y[k]))
            y[k] = new[k]
        moved = moved or far > 0.0
        if far < NEAR:
            break
    return moved
