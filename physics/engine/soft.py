"""Impulses of a crowd: contacts and rows (wires, pins, rubbing) swept again and again.

Projected Gauss-Seidel (Moreau 1988; Jean and Moreau 1992): each takes the impulse that makes its own
rate right, clamped to what it may be: a contact only pushes, friction stays within Coulomb's bound.
Sweeps go forth and back and begin with the last substep's impulses, which are the answer wherever
nothing changes. Overlap is let out by a soft contact's law of position alone (Catto 2024, "Solver2D"):
what it moves gains no speed, so no energy of motion.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from physics.engine.crowd import (
    ACTIVE,
    CONTACTS,
    GOAL,
    HEFT,
    IMPULSE,
    LEAST,
    MOST,
    Crowd,
)
from physics.engine.manifold import (
    CA,
    CB,
    GAP,
    I,
    J,
    KN,
    KT,
    LIFT,
    LIVE,
    MU,
    NX,
    NY,
    PN,
    PT,
    TA,
    TARGET,
    TB,
    renew,
)
from physics.engine.rows import CORD, GIVEN, POINT, refresh
from physics.engine.world import World
from physics.jit import kernel
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

PUSH_RATE = 9.0
"""1/s: overlap goes at this share of itself per second: ω / (2ζ + ωh) of a soft contact of 30 Hz and damping
ratio 10 at 240 Hz."""
PUSH_SPEED = 1.0
"""m/s: however deep it is."""
SLOP = 1e-9
"""m: overlap that is left as it is."""
PUSHES = 4
"""Sweeps over the pushes, which start from those of the last substep."""


@kernel
def bring_up(world: World, crowd: Crowd) -> None:
    """Contacts and rows at the poses of now."""
    for k in range(crowd.tally[CONTACTS]):
        renew(k, crowd.pos, crowd.turns, world.inverse, crowd.real, crowd.whole)
    for k in range(len(crowd.rows)):
        row = crowd.rows[k]
        refresh(row, world, crowd.pos, crowd.now)
        light = 0.0
        rubs = row.kind == GIVEN or row.kind == POINT
        for q in range(6):
            crowd.jacobian[k, q] = row.T[q] if rubs else row.J[q]
            light += crowd.jacobian[k, q] ** 2 * world.inverse[row.i if q < 3 else row.j, q % 3]
        crowd.bars[k, HEFT] = 1.0 / light if light > 0.0 else 0.0
        if rubs:
            active = world.supports[row.source].over == 1 and row.mu > 0.0
        else:
            active = world.links[row.source].broken == 0
            crowd.bars[k, LEAST] = 0.0 if row.kind == CORD else -np.inf
            crowd.bars[k, MOST] = np.inf
        crowd.bars[k, ACTIVE] = 1.0 if active else 0.0


@kernel
def opening(crowd: Crowd, k: int, vel: FloatArray) -> float:
    """How fast contact k's gap opens, m/s."""
    real, i, j = crowd.real, crowd.whole[k, I], crowd.whole[k, J]
    return (
        real[k, NX] * (vel[j, 0] - vel[i, 0])
        + real[k, NY] * (vel[j, 1] - vel[i, 1])
        + real[k, CB] * vel[j, 2]
        - real[k, CA] * vel[i, 2]
    )


@kernel
def slipping(crowd: Crowd, k: int, vel: FloatArray) -> float:
    """How fast contact k slips, m/s."""
    real, i, j = crowd.real, crowd.whole[k, I], crowd.whole[k, J]
    return (
        real[k, NX] * (vel[j, 1] - vel[i, 1])
        - real[k, NY] * (vel[j, 0] - vel[i, 0])
        + real[k, TB] * vel[j, 2]
        - real[k, TA] * vel[i, 2]
    )


@kernel
def press(world: World, crowd: Crowd, k: int, normal: float, tangent: float, vel: FloatArray) -> None:
    """Applies impulses along normal and tangent of contact k."""
    real, inverse, i, j = crowd.real, world.inverse, crowd.whole[k, I], crowd.whole[k, J]
    x = real[k, NX] * normal - real[k, NY] * tangent
    y = real[k, NY] * normal + real[k, NX] * tangent
    vel[i, 0] -= inverse[i, 0] * x
    vel[i, 1] -= inverse[i, 1] * y
    vel[i, 2] -= inverse[i, 2] * (real[k, CA] * normal + real[k, TA] * tangent)
    vel[j, 0] += inverse[j, 0] * x
    vel[j, 1] += inverse[j, 1] * y
    vel[j, 2] += inverse[j, 2] * (real[k, CB] * normal + real[k, TB] * tangent)


@kernel
def rate_of(crowd: Crowd, k: int, vel: FloatArray) -> float:
    """The rate of row k: of its slack, of a pin's gap, of slip."""
    jacobian, i, j = crowd.jacobian, crowd.rows[k].i, crowd.rows[k].j
    rate = 0.0
    for q in range(3):
        rate += jacobian[k, q] * vel[i, q] + jacobian[k, 3 + q] * vel[j, q]
    return rate


@kernel
def haul(world: World, crowd: Crowd, k: int, impulse: float, vel: FloatArray) -> None:
    """Applies an impulse along row k."""
    jacobian, inverse, i, j = crowd.jacobian, world.inverse, crowd.rows[k].i, crowd.rows[k].j
    for q in range(3):
        vel[i, q] += inverse[i, q] * jacobian[k, q] * impulse
        vel[j, q] += inverse[j, q] * jacobian[k, 3 + q] * impulse


@kernel
def settle(world: World, crowd: Crowd, vel: FloatArray, sweeps: int, tolerance: float) -> int:
    """Sweeps until no rate changes by more than the tolerance, m/s, at most so often; how often."""
    real, whole, bars = crowd.real, crowd.whole, crowd.bars
    contacts, rows = crowd.tally[CONTACTS], len(crowd.rows)
    for turn in range(sweeps):
        change = 0.0
        for step in range(rows):
            k = step if turn % 2 == 0 else rows - 1 - step
            heft = bars[k, HEFT]
            if bars[k, ACTIVE] == 0.0 or heft == 0.0:
                continue
            wanted = bars[k, IMPULSE] - (rate_of(crowd, k, vel) - bars[k, GOAL]) * heft
            wanted = min(max(wanted, bars[k, LEAST]), bars[k, MOST])
            more = wanted - bars[k, IMPULSE]
            if more != 0.0:
                bars[k, IMPULSE] = wanted
                haul(world, crowd, k, more, vel)
                change = max(change, abs(more) / heft)
        for step in range(contacts):
            k = step if turn % 2 == 0 else contacts - 1 - step
            if whole[k, LIVE] == 0:
                continue
            aside = 0.0
            if real[k, MU] > 0.0 and real[k, KT] > 0.0:
                most = real[k, MU] * real[k, PN]
                wanted = min(max(real[k, PT] - slipping(crowd, k, vel) * real[k, KT], -most), most)
                aside = wanted - real[k, PT]
                if aside != 0.0:
                    real[k, PT] = wanted
                    press(world, crowd, k, 0.0, aside, vel)
                    change = max(change, abs(aside) / real[k, KT])
            more = -(opening(crowd, k, vel) - real[k, TARGET]) * real[k, KN]
            if more < -real[k, PN]:
                more = -real[k, PN]
            if more != 0.0:
                real[k, PN] += more
                press(world, crowd, k, more, 0.0, vel)
                change = max(change, abs(more) / real[k, KN])
        if change <= tolerance:
            return turn + 1
    return sweeps


@kernel
def push_apart(world: World, crowd: Crowd, h: float) -> bool:
    """Moves bodies so that overlap grows less; whether there was any. Rows and other contacts yield nothing."""
    real, contacts, inverse = crowd.real, crowd.tally[CONTACTS], world.inverse
    deepest = 0.0
    for k in range(contacts):
        deepest = max(deepest, -real[k, GAP])
    if deepest <= SLOP:
        return False
    shift, bars = crowd.shift, crowd.bars
    for i in range(len(shift)):
        shift[i, 0], shift[i, 1], shift[i, 2] = 0.0, 0.0, 0.0
    for k in range(contacts):
        if real[k, GAP] >= 0.0:
            real[k, LIFT] = 0.0
        elif real[k, LIFT] > 0.0:
            press(world, crowd, k, real[k, LIFT], 0.0, shift)
    for turn in range(PUSHES):
        for step in range(contacts):
            k = step if turn % 2 == 0 else contacts - 1 - step
            gap = real[k, GAP]
            wanted = -gap if gap > 0.0 else h * min(-gap * PUSH_RATE, PUSH_SPEED)
            more = (wanted - opening(crowd, k, shift)) * real[k, KN]
            more = max(more, -real[k, LIFT])
            if more != 0.0:
                real[k, LIFT] += more
                press(world, crowd, k, more, 0.0, shift)
        for k in range(len(crowd.rows)):
            if bars[k, ACTIVE] == 1.0 and bars[k, MOST] == np.inf:
                away = rate_of(crowd, k, shift)
                if bars[k, LEAST] < 0.0 or away < -max(crowd.rows[k].gap, 0.0):
                    haul(world, crowd, k, -away * bars[k, HEFT], shift)
    for i in range(len(shift)):
        for q in range(3):
            if inverse[i, q] > 0.0:
                crowd.pos[i, q] += shift[i, q]
            shift[i, q] = 0.0
    return True
