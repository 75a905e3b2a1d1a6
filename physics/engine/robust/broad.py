"""Which pairs are near enough to be looked at: sort and sweep (Baraff 1992) over boxes with room to move.

The list holds until some body has used up its room, so a pile at rest is swept once.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.tables import corners, counts, firsts, radii, reaches
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

ROOM = 0.2
"""Room about a body's box, as a share of the mean reach of what moves: too little sweeps often, too much
lists pairs that never meet."""


@part
def left(
    w: Any, movable: int, pos: FloatArray, vel: FloatArray, home: FloatArray, room: FloatArray, h: float
) -> bool:
    """Whether a body may leave its box within the next h seconds. home: poses at the last sweep."""
    reach = reaches(w)
    for i in range(movable):
        moved = abs(pos[i, 0] - home[i, 0]) + abs(pos[i, 1] - home[i, 1])
        moved += abs(pos[i, 2] - home[i, 2]) * reach[i]
        if moved + h * (abs(vel[i, 0]) + abs(vel[i, 1]) + abs(vel[i, 2]) * reach[i]) > room[i]:
            return True
    return False


@part
def sweep(
    w: Any,
    movable: int,
    pos: FloatArray,
    vel: FloatArray,
    turns: FloatArray,
    h: float,
    least: float,
    home: FloatArray,
    room: FloatArray,
    boxes: FloatArray,
    order: IntArray,
    table: IntArray,
    near: IntArray,
) -> int:
    """Fills near[:, 0] with the numbers of the pairs whose boxes overlap, ascending; returns how many there
    are, which may be more than fit (then nothing else is changed but the boxes and their order).

    least: room that every body gets, m; boxes: (bodies, 4) x from, x to, y from, y to; order: bodies by
    x, kept from sweep to sweep; table: (bodies, bodies) number of a pair, -1: none.
    """
    bodies, reach = len(order), reaches(w)
    for i in range(bodies):
        room[i] = 0.0
        if i < movable:
            room[i] = least + 2.0 * h * (abs(vel[i, 0]) + abs(vel[i, 1]) + abs(vel[i, 2]) * reach[i])
        for k in range(3):
            home[i, k] = pos[i, k]
        _box(w, i, pos, turns, room[i], boxes)
    for k in range(1, bodies):
        one = order[k]
        at = k
        while at > 0 and boxes[order[at - 1], 0] > boxes[one, 0]:
            order[at] = order[at - 1]
            at -= 1
        order[at] = one
    found = 0
    for k in range(bodies):
        i = order[k]
        for q in range(k + 1, bodies):
            j = order[q]
            if boxes[j, 0] > boxes[i, 1]:
                break
            if boxes[j, 2] > boxes[i, 3] or boxes[i, 2] > boxes[j, 3] or table[i, j] < 0:
                continue
            if found < len(near):
                near[found, 0] = table[i, j]
            found += 1
    if found <= len(near):
        _sort(near, found)
    return found


@part
def _box(w: Any, i: int, pos: FloatArray, turns: FloatArray, room: float, boxes: FloatArray) -> None:
    radius, first, points = radii(w)[i], firsts(w)[i], corners(w)
    x1, x2, y1, y2 = -radius, radius, -radius, radius
    c, s = turns[i, 0], turns[i, 1]
    for k in range(first, first + counts(w)[i]):
        x, y = points[k, 0], points[k, 1]
        u, v = c * x - s * y, s * x + c * y
        x1, x2, y1, y2 = min(x1, u), max(x2, u), min(y1, v), max(y2, v)
    boxes[i, 0], boxes[i, 1] = pos[i, 0] + x1 - room, pos[i, 0] + x2 + room
    boxes[i, 2], boxes[i, 3] = pos[i, 1] + y1 - room, pos[i, 1] + y2 + room


@part
def _sort(near: IntArray, count: int) -> None:
    """Shell's sort of the first column (Ciura's gaps, grown by 2.25)."""
    gap = 1
    while 9 * gap < 4 * count:
        gap = 9 * gap // 4 + 1
    while gap > 0:
        for k in range(gap, count):
            one = near[k, 0]
            at = k
            while at >= gap and near[at - gap, 0] > one:
                near[at, 0] = near[at - gap, 0]
                at -= gap
            near[at, 0] = one
        gap = 4 * gap // 9
