"""The measurements of a stroke as loops that numba compiles, since most of a stroke's time goes there.

All in one file on purpose: numba takes a kernel on disk for fresh as long as its own file is, whatever the
files of others that are compiled into it. The modules beside this one say what each measure means and take its
numbers from their rules; nobody else calls these. Arrays are float64, contiguous, writable; x and y in columns.

Frame: the caller's, mostly points of a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from math import atan2, hypot, sqrt
from typing import Any, TypeVar, cast

import numba
import numpy as np
from numba.core.event import Listener, register

from sketch.ink import FloatArray

F = TypeVar("F", bound=Callable[..., Any])


def kernel(function: F) -> F:
    """Compiles the function when it is first called, and keeps it on disk."""
    return cast(F, numba.njit(cache=True, nogil=True, error_model="numpy")(function))


class _Announcer(Listener):
    """Says once in a process that kernels are being compiled: it looks like a hang."""

    told = False

    def on_start(self, event: Any) -> None:
        if not self.told and event.data["dispatcher"].py_func.__module__ == __name__:
            self.told = True
            logging.getLogger("inklined").warning(
                "Compiling the geometric recognizer for this machine: once, for half a minute at most."
            )

    def on_end(self, event: Any) -> None:
        pass


register("numba:compile", _Announcer())


@kernel
def resampled(points: FloatArray, count: int) -> FloatArray:
    """`count` >= 2 points at equal spacing along the path, ends kept: `sketch.geometry.resample`."""
    n = len(points)
    travelled = np.zeros(n)
    for i in range(1, n):
        travelled[i] = travelled[i - 1] + hypot(
            points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1]
        )
    even = np.empty((count, 2))
    total = travelled[-1]
    piece = 0
    for k in range(count):
        wanted = k * (total / (count - 1))
        while piece < n - 2 and travelled[piece + 1] < wanted:
            piece += 1
        if n == 1 or total == 0.0:
            even[k] = points[0]
            continue
        span = travelled[piece + 1] - travelled[piece]
        share = (wanted - travelled[piece]) / span if span > 0 else 0.0
        for axis in range(2):
            even[k, axis] = points[piece, axis] + share * (points[piece + 1, axis] - points[piece, axis])
    if total > 0:
        even[-1] = points[-1]
    return even


@kernel
def length_of(points: FloatArray) -> float:
    total = 0.0
    for i in range(1, len(points)):
        total += hypot(points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1])
    return total


@kernel
def bend_angles(points: FloatArray, reach: int) -> FloatArray:
    """Signed angle between the chords that lead `reach` points to and from each point, (n,)."""
    n = len(points)
    found = np.zeros(n)
    for i in range(reach, n - reach):
        ax, ay = points[i, 0] - points[i - reach, 0], points[i, 1] - points[i - reach, 1]
        bx, by = points[i + reach, 0] - points[i, 0], points[i + reach, 1] - points[i, 1]
        found[i] = atan2(ax * by - ay * bx, ax * bx + ay * by)
    return found


@kernel
def turning_angles(points: FloatArray) -> FloatArray:
    """Signed exterior angle at each inner point, (n − 2,)."""
    return bend_angles(points, 1)[1:-1]


@kernel
def line_rms(points: FloatArray) -> float:
    """Root mean square distance of points from their best line."""
    n = len(points)
    mx = my = 0.0
    for i in range(n):
        mx += points[i, 0]
        my += points[i, 1]
    mx /= n
    my /= n
    xx = xy = yy = 0.0
    for i in range(n):
        x, y = points[i, 0] - mx, points[i, 1] - my
        xx += x * x
        xy += x * y
        yy += y * y
    lesser = (0.5 * (xx + yy) - hypot(0.5 * (xx - yy), xy)) / n
    return sqrt(max(lesser, 0.0))


@kernel
def crossing_places(points: FloatArray) -> FloatArray:
    """Positions i + s and j + t of where segments i < j − 1 cross, (k, 2), ordered by i."""
    n = len(points) - 1
    found = np.empty((64, 2))
    count = 0
    for i in range(n - 2):
        px, py = points[i, 0], points[i, 1]
        ax, ay = points[i + 1, 0] - px, points[i + 1, 1] - py
        low_x, high_x = min(px, px + ax), max(px, px + ax)
        low_y, high_y = min(py, py + ay), max(py, py + ay)
        for j in range(i + 2, n):
            qx, qy = points[j, 0], points[j, 1]
            bx, by = points[j + 1, 0] - qx, points[j + 1, 1] - qy
            if max(qx, qx + bx) < low_x or min(qx, qx + bx) > high_x:
                continue
            if max(qy, qy + by) < low_y or min(qy, qy + by) > high_y:
                continue
            determinant = ax * by - ay * bx
            if determinant == 0.0:
                continue
            s = ((qx - px) * by - (qy - py) * bx) / determinant
            t = ((qx - px) * ay - (qy - py) * ax) / determinant
            if 0.0 <= s < 1.0 and 0.0 <= t < 1.0:
                if count == len(found):
                    found = np.concatenate((found, np.empty((count, 2))))
                found[count, 0] = i + s
                found[count, 1] = j + t
                count += 1
    return found[:count].copy()


@kernel
def line_errors(points: FloatArray) -> FloatArray:
    """Sum of squared distances of points i … j from their own best line, (n, n); infinite where j <= i."""
    n = len(points)
    errors = np.full((n, n), np.inf)
    mx, my = points[:, 0].mean(), points[:, 1].mean()
    for i in range(n):
        sx = sy = sxx = sxy = syy = 0.0
        for j in range(i, n):
            x, y = points[j, 0] - mx, points[j, 1] - my
            sx += x
            sy += y
            sxx += x * x
            sxy += x * y
            syy += y * y
            if j > i:
                m = j - i + 1
                xx, xy, yy = sxx - sx * sx / m, sxy - sx * sy / m, syy - sy * sy / m
                errors[i, j] = max(0.5 * (xx + yy) - hypot(0.5 * (xx - yy), xy), 0.0)
    return errors


@kernel
def legs_of(errors: FloatArray, most: int) -> tuple[FloatArray, FloatArray]:
    """Summed errors of the best polylines of 1 … `most` legs, (most,), and the break before each last point, (most, n)."""
    n = len(errors)
    totals = np.empty(most)
    before = np.zeros((most, n))
    total = errors[0].copy()
    totals[0] = total[-1]
    for leg in range(1, most):
        through = np.full(n, np.inf)
        for last in range(leg + 1, n):
            for first in range(leg, last):
                reached = total[first] + errors[first, last]
                if reached < through[last]:
                    through[last] = reached
                    before[leg, last] = first
        total = through
        totals[leg] = total[-1]
    return totals, before


@kernel
def closing_pair(path: FloatArray, reach: int, patience: float) -> tuple[int, int]:
    """Indices within `reach` of the two ends between which the outline closes best."""
    n = len(path)
    step = length_of(path) / (n - 1)
    least, first, last = np.inf, 0, n - 1
    for i in range(reach):
        for j in range(n - reach, n):
            away = hypot(path[i, 0] - path[j, 0], path[i, 1] - path[j, 1])
            cost = away + patience * step * (i + n - 1 - j)
            if cost < least:
                least, first, last = cost, i, j
    return first, last


@kernel
def moments_of(vertices: FloatArray) -> tuple[float, float, float, float, float, float]:
    """Signed area of a polygon, its centroid (x, y) and its second central moments over area (xx, xy, yy)."""
    n = len(vertices)
    ox, oy = vertices[:, 0].mean(), vertices[:, 1].mean()
    area = cx = cy = xx = xy = yy = 0.0
    for i in range(n):
        ax, ay = vertices[i, 0] - ox, vertices[i, 1] - oy
        bx, by = vertices[(i + 1) % n, 0] - ox, vertices[(i + 1) % n, 1] - oy
        cross = ax * by - ay * bx
        area += 0.5 * cross
        cx += cross * (ax + bx)
        cy += cross * (ay + by)
        xx += cross * (ax * ax + ax * bx + bx * bx)
        yy += cross * (ay * ay + ay * by + by * by)
        xy += cross * (ax * ay + bx * by + 0.5 * (ax * by + bx * ay))
    cx /= 6 * area
    cy /= 6 * area
    twelve = 12 * area
    return area, cx + ox, cy + oy, xx / twelve - cx * cx, xy / twelve - cx * cy, yy / twelve - cy * cy


@kernel
def stray_of(path: FloatArray, first: int, last: int) -> float:
    """Largest distance from the ends cut off a path to what is left of it."""
    farthest = 0.0
    for i in range(len(path)):
        if first <= i <= last:
            continue
        nearest = np.inf
        for j in range(first, last + 1):
            nearest = min(nearest, hypot(path[i, 0] - path[j, 0], path[i, 1] - path[j, 1]))
        farthest = max(farthest, nearest)
    return farthest


@kernel
def turning_points(values: FloatArray, least: float) -> list[int]:
    """Indices of the ends and the turning points of a signal that moves by `least` between them."""
    found = [0]
    low = high = rising = 0
    for index in range(len(values)):
        value = values[index]
        if value > values[high]:
            high = index
        if value < values[low]:
            low = index
        if rising >= 0 and value < values[high] - least:
            if rising > 0 or high > 0:
                found.append(high)
            rising, low, high = -1, index, index
        elif rising <= 0 and value > values[low] + least:
            if rising < 0 or low > 0:
                found.append(low)
            rising, low, high = 1, index, index
    found.append(high if rising > 0 else low if rising < 0 else len(values) - 1)
    return found


@kernel
def swings_about(
    path: FloatArray, ax: float, ay: float, visible: float, swing: float, whole: float
) -> tuple[int, float, float, float, float]:
    """Legs, unevenness, progress, pitch and height of the swings of a path about an axis: see `Teeth`."""
    across = ay * -path[:, 0] + ax * path[:, 1]
    width = across.max() - across.min()
    if width < visible:
        return 1, 0.0, 1.0, 1.0, width
    turns = turning_points(across, swing * width)
    count = len(turns)
    along = np.empty(count)
    heights = np.empty(count - 1)
    for k in range(count):
        along[k] = path[turns[k], 0] * ax + path[turns[k], 1] * ay
        if k > 0:
            heights[k - 1] = abs(across[turns[k]] - across[turns[k - 1]])
    heights.sort()
    half = (count - 1) // 2
    typical = heights[half] if (count - 1) % 2 else 0.5 * (heights[half - 1] + heights[half])
    kept = heights[heights > whole * typical]
    progress = 1.0
    for side in range(2):
        way = 0.0
        last = 1 + side
        for k in range(3 + side, count - 1, 2):
            way += abs(along[k] - along[last])
            last = k
        if way > 0:
            progress = min(progress, abs(along[last] - along[1 + side]) / way)
    pitch = abs(along[-1] - along[0]) * 2 / max(count - 1, 1)
    return len(kept), kept.std() / kept.mean(), progress, pitch, typical


@kernel
def ring_of(
    path: FloatArray, first: int, last: int, count: int, coarse: int, seam: float
) -> tuple[bool, FloatArray, float, float, float, float, float, int]:
    """The outline path[first : last + 1] closed on `count` + 1 points, begun where it lies farthest out: whether
    it encloses anything, the points, area, perimeter, roundness, aspect, share of wrong turning on every
    `count // coarse`-th point, crossings away from the seam: see `Ring`."""
    outline = np.concatenate((path[first : last + 1], path[first : first + 1]))
    closed = resampled(outline, count + 1)
    closed[-1] = closed[0]
    perimeter = length_of(closed)
    area, cx, cy, xx, xy, yy = moments_of(closed[:-1])
    nothing = (False, closed, 0.0, perimeter, 0.0, 0.0, 0.0, 0)
    if perimeter == 0 or not abs(area) >= 1e-6 * perimeter**2:
        return nothing
    half, rest = 0.5 * (xx + yy), hypot(0.5 * (xx - yy), xy)
    small, large = half - rest, half + rest
    if small <= 1e-9 * large:
        return nothing
    determinant = small * large
    total = squares = farthest = 0.0
    corner = 0
    for i in range(count):
        x, y = closed[i, 0] - cx, closed[i, 1] - cy
        radius = sqrt(max((x * x * yy - 2 * x * y * xy + y * y * xx) / determinant, 0.0))
        total += radius
        squares += radius * radius
        if radius > farthest:
            farthest, corner = radius, i
    mean = total / count
    roundness = sqrt(max(squares / count - mean * mean, 0.0)) / mean
    begun = np.concatenate((closed[corner:-1], closed[: corner + 1]))
    places = np.arange(0, count + 1, count // coarse)
    bends = turning_angles(closed[np.append(places, places[1])])
    sense = np.sign(bends.sum())
    wrong = 0.0
    for bend in bends:
        wrong += max(-sense * bend, 0.0)
    crosses = 0
    margin = seam * len(closed)
    places_of = crossing_places(closed)
    for k in range(len(places_of)):
        if not (places_of[k, 0] < margin and places_of[k, 1] > len(closed) - 1 - margin):
            crosses += 1
    return (
        True,
        begun,
        abs(area),
        perimeter,
        roundness,
        sqrt(small / large),
        wrong / (np.abs(bends).sum() + 1e-9),
        crosses,
    )


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


@kernel
def extent_of(points: FloatArray) -> float:
    """Diagonal of the bounding box."""
    low_x = high_x = points[0, 0]
    low_y = high_y = points[0, 1]
    for i in range(1, len(points)):
        low_x, high_x = min(low_x, points[i, 0]), max(high_x, points[i, 0])
        low_y, high_y = min(low_y, points[i, 1]), max(high_y, points[i, 1])
    return hypot(high_x - low_x, high_y - low_y)


@kernel
def teeth_of(
    path: FloatArray, chord: float, visible: float, swing: float, whole: float
) -> tuple[float, float, int, float, float, float, float]:
    """Axis (x, y) and measures of the swings about whichever axis shows them best: the chord, where the ends are
    that far apart, or one of the principal axes."""
    n = len(path)
    mx, my = path[:, 0].mean(), path[:, 1].mean()
    xx = xy = yy = 0.0
    for i in range(n):
        x, y = path[i, 0] - mx, path[i, 1] - my
        xx += x * x
        xy += x * y
        yy += y * y
    angle = 0.5 * atan2(2 * xy, xx - yy)
    axes = np.empty((3, 2))
    axes[1, 0], axes[1, 1] = -np.sin(angle), np.cos(angle)
    axes[2, 0], axes[2, 1] = np.cos(angle), np.sin(angle)
    x, y = path[-1, 0] - path[0, 0], path[-1, 1] - path[0, 1]
    length = hypot(x, y)
    first = 1
    if length > chord:
        first = 0
        axes[0, 0], axes[0, 1] = x / length, y / length
    best = (0.0, 0.0, 0, 0.0, 0.0, 0.0, 0.0)
    most = -1.0
    for k in range(first, 3):
        legs, uneven, progress, pitch, height = swings_about(
            path, axes[k, 0], axes[k, 1], visible, swing, whole
        )
        merit = legs * progress / (1.0 + uneven)
        if merit > most:
            most = merit
            best = (axes[k, 0], axes[k, 1], legs, uneven, progress, pitch, height)
    return best


@kernel
def turning_shares(points: FloatArray, corners: FloatArray, reach: int) -> tuple[float, float]:
    """Of a closed outline (its last point equal to its first) and of the polygon through the points that `corners`
    numbers, first repeated as last: the share of the polygon's turning that is in the wrong sense, and that of
    the outline's turning within `reach` points of the corners."""
    count = len(points) - 1
    sides = len(corners) - 1
    around = np.empty((sides + 2, 2))
    for k in range(sides + 2):
        around[k] = points[int(corners[k if k <= sides else 1])]
    turns = turning_angles(around)
    sense = np.sign(turns.sum())
    wrong = 0.0
    for turn in turns:
        wrong += max(-sense * turn, 0.0)
    bends = turning_angles(np.concatenate((points[-2:-1], points)))
    near = np.zeros(count, dtype=np.bool_)
    for corner in corners:
        for step in range(-reach, reach + 1):
            near[(int(corner) + step) % count] = True
    within = bends[near].sum()
    total = bends.sum()
    return wrong / (np.abs(turns).sum() + 1e-9), within / (total if total != 0 else 1.0)


@kernel
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
