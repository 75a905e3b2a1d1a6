"""Contacts of all pairs that are near, kept from substep to substep while two bodies hardly move past each
other, and with their impulses when they are found anew."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.broad import left, sweep
from physics.engine.robust.crowd import CONTACTS, NEEDS, PAIRS, SWEPT, Crowd
from physics.engine.robust.manifold import FEATURE, LIFT, PAIR, PN, PT, REALS, WHOLES, meet
from physics.engine.world import World
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

MOVED = 1e-3
"""Share of the smaller body's width by which two bodies move past each other before their contacts are found
anew: at rest they are found once."""


@part
def find(world: World, crowd: Crowd, movable: int, h: float, room: float) -> bool:
    """Brings pairs and contacts up to date. False, with `NEEDS` set, if the tables are too small."""
    tally = crowd.tally
    fresh = tally[SWEPT] == 0 or left(world, movable, crowd.pos, crowd.vel, crowd.home, crowd.room, h)
    if fresh:
        found = sweep(
            world,
            movable,
            crowd.pos,
            crowd.vel,
            crowd.turns,
            h,
            room,
            crowd.home,
            crowd.room,
            crowd.boxes,
            crowd.order,
            crowd.table,
            crowd.near,
        )
        if found > len(crowd.near):
            tally[SWEPT] = 0
            tally[NEEDS] = found
            return False
        tally[PAIRS], tally[SWEPT] = found, 1
        for q in range(found):
            crowd.seen[q, 4] = 0.0
    if (
        _passed(world.pairs, world.reach, crowd.near, crowd.seen, tally[PAIRS], crowd.pos, crowd.vel, h)
        or fresh
    ):
        _rebuild(world, crowd, h)
    return True


@part
def _passed(
    pairs: Any,
    reach: FloatArray,
    near: IntArray,
    seen: FloatArray,
    count: int,
    pos: FloatArray,
    vel: FloatArray,
    h: float,
) -> bool:
    """Marks the near pairs whose bodies may have moved past each other within the next h seconds; whether
    there are any."""
    stale = False
    for q in range(count):
        pair = pairs[near[q, 0]]
        i, j = pair.i, pair.j
        moved = abs(pos[j, 0] - pos[i, 0] - seen[q, 0]) + abs(pos[j, 1] - pos[i, 1] - seen[q, 1])
        moved += abs(pos[i, 2] - seen[q, 2]) * reach[i] + abs(pos[j, 2] - seen[q, 3]) * reach[j]
        if moved + h * _speed(reach, vel, i, j) > MOVED * pair.size:
            seen[q, 4] = 0.0
            stale = True
    return stale


@part
def _speed(reach: FloatArray, vel: FloatArray, i: int, j: int) -> float:
    speed = abs(vel[j, 0] - vel[i, 0]) + abs(vel[j, 1] - vel[i, 1])
    return speed + abs(vel[i, 2]) * reach[i] + abs(vel[j, 2]) * reach[j]


@part
def _rebuild(world: World, crowd: Crowd, h: float) -> None:
    real, whole, old_real, old_whole = crowd.real, crowd.whole, crowd.old_real, crowd.old_whole
    near, seen, pos, turns, pairs = crowd.near, crowd.seen, crowd.pos, crowd.turns, world.pairs
    before = crowd.tally[CONTACTS]
    for k in range(before):
        for c in range(REALS):
            old_real[c, k] = real[c, k]
        for c in range(WHOLES):
            old_whole[c, k] = whole[c, k]
    # Numba would compile `meet` anew for a count that it knows to be zero.
    count, old = 0 * before, 0
    for q in range(crowd.tally[PAIRS]):
        number = near[q, 0]
        while old < before and old_whole[PAIR, old] < number:
            old += 1
        end = old
        while end < before and old_whole[PAIR, end] == number:
            end += 1
        if seen[q, 4] == 1.0:
            for k in range(old, end):
                for c in range(REALS):
                    real[c, count] = old_real[c, k]
                for c in range(WHOLES):
                    whole[c, count] = old_whole[c, k]
                count += 1
        else:
            pair: Any = pairs[number]
            i, j = pair.i, pair.j
            given = False
            if pair.support >= 0:
                support: Any = world.supports[pair.support]
                given = support.over == 1
            if not given:
                margin = 4.0 * MOVED * pair.size + 2.0 * h * _speed(world.reach, crowd.vel, i, j)
                found = meet(world, number, pos, turns, margin, real, whole, count)
                for k in range(count, count + found):
                    for o in range(old, end):
                        if old_whole[FEATURE, o] == whole[FEATURE, k]:
                            real[PN, k], real[PT, k] = old_real[PN, o], old_real[PT, o]
                            real[LIFT, k] = old_real[LIFT, o]
                count += found
            seen[q, 0], seen[q, 1] = pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]
            seen[q, 2], seen[q, 3], seen[q, 4] = pos[i, 2], pos[j, 2], 1.0
        old = end
    crowd.tally[CONTACTS] = count
