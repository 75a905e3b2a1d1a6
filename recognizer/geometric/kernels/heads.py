"""Heads of arrows: see `recognizer.geometric.arrows` for those of one stroke, `recognizer.geometric.heads` for the others."""

from __future__ import annotations

from math import hypot, sqrt

import numpy as np

from recognizer.geometric.kernels.paths import bend_angles, extent_of
from recognizer.jit import kernel, part
from sketch.ink import FloatArray


@kernel
def head_of(
    path: FloatArray, reach: int, shaft: float, tip_share: float, turn: float
) -> tuple[int, float, float, float, float, float, float]:
    """Tip, bow, fallback, narrower, wider, ink and sharpest of the head of an arrow drawn tail first: see
    `Head`; a tip of −1 where the path has no room for one."""
    n = len(path)
    nothing = (-1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    least = int(np.round(shaft * (n - 1)))
    ax, ay = path[least, 0] - path[0, 0], path[least, 1] - path[0, 1]
    length = hypot(ax, ay)
    if length == 0:
        return nothing
    along = ((path[:, 0] - path[0, 0]) * ax + (path[:, 1] - path[0, 1]) * ay) / length
    farthest = along.max()
    sharpness = np.abs(bend_angles(path, reach))
    tip = -1
    for i in range(n):
        if along[i] >= farthest * (1 - tip_share) and sharpness[i] > turn:
            tip = i
            break
    if tip < 0:
        return nothing
    tip += int(np.argmax(sharpness[tip : tip + 4]))
    ax, ay = path[tip, 0] - path[0, 0], path[tip, 1] - path[0, 1]
    length = hypot(ax, ay)
    if tip < shaft * (n - 1) or tip > n - 4 or length == 0:
        return nothing
    fx, fy = ax / length, ay / length
    squares = 0.0
    for i in range(tip + 1):
        side = (-(path[i, 0] - path[0, 0]) * fy + (path[i, 1] - path[0, 1]) * fx) / length
        squares += side * side
    left, right, fallback, ink = 0.0, 0.0, 0.0, 0.0
    for i in range(tip, n):
        x, y = (path[i, 0] - path[tip, 0]) / length, (path[i, 1] - path[tip, 1]) / length
        side = -x * fy + y * fx
        left, right, fallback = max(left, side), max(right, -side), max(fallback, -(x * fx + y * fy))
        if i > tip:
            ink += hypot(path[i, 0] - path[i - 1, 0], path[i, 1] - path[i - 1, 1]) / length
    bow = sqrt(squares / (tip + 1))
    return tip, bow, fallback, min(left, right), max(left, right), ink, sharpness[tip]


@part
def _from_segment(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> float:
    """Distance of a point from the segment a … b."""
    sx, sy = bx - ax, by - ay
    square = sx * sx + sy * sy
    share = ((x - ax) * sx + (y - ay) * sy) / square if square > 0 else 0.0
    share = min(max(share, 0.0), 1.0)
    return hypot(x - ax - share * sx, y - ay - share * sy)


@kernel
def head_shape(
    shaft: FloatArray, ink: FloatArray, aim: float
) -> tuple[bool, float, float, float, float, float, float, float, float, float, FloatArray]:
    """The ink of a head seen from the end of its shaft: whether there is one at all; lesser over greater reach
    aside; the lesser fall over reach of a barb; both barbs' mean of it; distance of the tip from the shaft's
    line over half the width; how far the tip lies ahead of the shaft's end in lengths of the head; rms
    distance of the ink from its three sides over its size; the greater distance of a barb's middle from the
    ink over the size; length of both barbs, and of the longer; and the tip. aim: share of the head's size before the shaft's
    end that gives its direction."""
    tip_at = np.zeros(2)
    nothing = (False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, tip_at)
    size = extent_of(ink)
    ex, ey = shaft[-1, 0], shaft[-1, 1]
    reach = 0.0
    for i in range(len(shaft)):
        reach = max(reach, hypot(shaft[i, 0] - ex, shaft[i, 1] - ey))
    far = min(aim * size, 0.5 * reach)
    fx = fy = 0.0
    for i in range(len(shaft) - 1, -1, -1):
        if hypot(shaft[i, 0] - ex, shaft[i, 1] - ey) >= far:
            fx, fy = ex - shaft[i, 0], ey - shaft[i, 1]
            break
    length = hypot(fx, fy)
    if length == 0 or size == 0:
        return nothing
    fx, fy = fx / length, fy / length
    n = len(ink)
    along, across = np.empty(n), np.empty(n)
    for i in range(n):
        x, y = ink[i, 0] - ex, ink[i, 1] - ey
        along[i], across[i] = x * fx + y * fy, -x * fy + y * fx
    t, most, least = np.argmax(along), np.argmax(across), np.argmin(across)
    tx, ty, lx, ly, rx, ry = along[t], across[t], along[most], across[most], along[least], across[least]
    left, right, back = ly - ty, ty - ry, tx - min(lx, rx)
    if min(left, right) <= 0 or back <= 0:
        return nothing
    falls_left, falls_right = (tx - lx) / left, (tx - rx) / right
    squares, open_left, open_right = 0.0, np.inf, np.inf
    for i in range(n):
        x, y = along[i], across[i]
        stray = min(_from_segment(x, y, tx, ty, lx, ly), _from_segment(x, y, tx, ty, rx, ry))
        stray = min(stray, _from_segment(x, y, lx, ly, rx, ry))
        squares += stray * stray
        open_left = min(open_left, hypot(x - 0.5 * (tx + lx), y - 0.5 * (ty + ly)))
        open_right = min(open_right, hypot(x - 0.5 * (tx + rx), y - 0.5 * (ty + ry)))
    tip_at[0], tip_at[1] = ex + fx * tx, ey + fy * tx
    return (
        True,
        min(left, right) / max(left, right),
        min(falls_left, falls_right),
        0.5 * (falls_left + falls_right),
        2 * abs(ty) / (left + right),
        tx / back,
        sqrt(squares / n) / size,
        max(open_left, open_right) / size,
        hypot(tx - lx, ty - ly) + hypot(tx - rx, ty - ry),
        max(hypot(tx - lx, ty - ly), hypot(tx - rx, ty - ry)),
        tip_at,
    )
