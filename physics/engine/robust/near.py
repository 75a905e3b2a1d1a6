"""Contacts of all pairs that are near, kept from substep to substep while two bodies hardly move past each
other, and with their impulses when they are found anew."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.broad import left, sweep
from physics.engine.robust.manifold import FEATURE, LIFT, PAIR, PN, PT, REALS, WHOLES, meet
from physics.engine.robust.memory import (
    CONTACTS,
    NEEDS,
    PAIRS,
    SWEPT,
    boxes_of,
    home_of,
    near_of,
    old_real_of,
    old_whole_of,
    order_of,
    pos_of,
    real_of,
    room_of,
    seen_of,
    table_of,
    tally_of,
    turns_of,
    vel_of,
    whole_of,
)
from physics.engine.tables import pair_of, reaches, support_of
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

MOVED = 1e-3
"""Share of the smaller body's width by which two bodies move past each other before their contacts are found
anew: at rest they are found once."""


@part
def find(w: Any, m: Any, movable: int, h: float, room: float) -> bool:
    """Brings pairs and contacts up to date. False, with `NEEDS` set, if the tables are too small."""
    tally, pos, vel, home, room_left = tally_of(m), pos_of(m), vel_of(m), home_of(m), room_of(m)
    near, seen = near_of(m), seen_of(m)
    fresh = tally[SWEPT] == 0 or left(w, movable, pos, vel, home, room_left, h)
    if fresh:
        found = sweep(
            w,
            movable,
            pos,
            vel,
            turns_of(m),
            h,
            room,
            home,
            room_left,
            boxes_of(m),
            order_of(m),
            table_of(m),
            near,
        )
        if found > m.near:
            tally[SWEPT] = 0
            tally[NEEDS] = found
            return False
        tally[PAIRS], tally[SWEPT] = found, 1
        for q in range(found):
            seen[q, 4] = 0.0
    if _passed(w, near, seen, tally[PAIRS], pos, vel, h) or fresh:
        _rebuild(w, m, h)
    return True


@part
def _passed(
    w: Any, near: IntArray, seen: FloatArray, count: int, pos: FloatArray, vel: FloatArray, h: float
) -> bool:
    """Marks the near pairs whose bodies may have moved past each other within the next h seconds; whether
    there are any."""
    reach = reaches(w)
    stale = False
    for q in range(count):
        pair = pair_of(w, near[q, 0])
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
def _rebuild(w: Any, m: Any, h: float) -> None:
    real, whole, old_real, old_whole = real_of(m), whole_of(m), old_real_of(m), old_whole_of(m)
    near, seen, pos, turns = near_of(m), seen_of(m), pos_of(m), turns_of(m)
    tally, vel, reach = tally_of(m), vel_of(m), reaches(w)
    before = tally[CONTACTS]
    for k in range(before):
        for c in range(REALS):
            old_real[c, k] = real[c, k]
        for c in range(WHOLES):
            old_whole[c, k] = whole[c, k]
    # Numba would compile `meet` anew for a count that it knows to be zero.
    count, old = 0 * before, 0
    for q in range(tally[PAIRS]):
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
            pair = pair_of(w, number)
            i, j = pair.i, pair.j
            given = False
            if pair.support >= 0:
                support = support_of(w, pair.support)
                given = support.over == 1
            if not given:
                margin = 4.0 * MOVED * pair.size + 2.0 * h * _speed(reach, vel, i, j)
                found = meet(w, number, pos, turns, margin, real, whole, count)
                for k in range(count, count + found):
                    for o in range(old, end):
                        if old_whole[FEATURE, o] == whole[FEATURE, k]:
                            real[PN, k], real[PT, k] = old_real[PN, o], old_real[PT, o]
                            real[LIFT, k] = old_real[LIFT, o]
                count += found
            seen[q, 0], seen[q, 1] = pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]
            seen[q, 2], seen[q, 3], seen[q, 4] = pos[i, 2], pos[j, 2], 1.0
        old = end
    tally[CONTACTS] = count
