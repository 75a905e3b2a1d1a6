"""Measures of any path: length, extent, bends, distance from a line, and where it crosses itself.

Frame: the caller's, points in rows, x and y in columns; arrays of all kernels here are float64 and contiguous. The modules of
`recognizer.geometric` say what each measure means and take its numbers from their rules; nobody else calls these.
"""

from __future__ import annotations

from math import atan2, hypot, sqrt

import numpy as np

from recognizer.jit import kernel
from sketch.ink import FloatArray


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
def extent_of(points: FloatArray) -> float:
    """Diagonal of the bounding box."""
    low_x = high_x = points[0, 0]
    low_y = high_y = points[0, 1]
    for i in range(1, len(points)):
        low_x, high_x = min(low_x, points[i, 0]), max(high_x, points[i, 0])
        low_y, high_y = min(low_y, points[i, 1]), max(high_y, points[i, 1])
    return hypot(high_x - low_x, high_y - low_y)


@kernel
def prepared(
    points: FloatArray, count: int, step: float, fewest: int, most: int
) -> tuple[FloatArray, FloatArray]:
    """A stroke moved and scaled to a bounding box from (0, 0) with a diagonal of 1, as `count` points at equal spacing, and as
    points about `step` apart, between `fewest` and `most` of them: `recognizer.preprocess`. Empty where the pen never moved."""
    n = len(points)
    low_x = high_x = points[0, 0]
    low_y = high_y = points[0, 1]
    farthest = 0.0
    for i in range(n):
        low_x, high_x = min(low_x, points[i, 0]), max(high_x, points[i, 0])
        low_y, high_y = min(low_y, points[i, 1]), max(high_y, points[i, 1])
        farthest = max(farthest, abs(points[i, 0]), abs(points[i, 1]))
    size = hypot(high_x - low_x, high_y - low_y)
    if size <= 1e-12 * farthest:
        return np.empty((0, 2)), np.empty((0, 2))
    unit = np.empty((n, 2))
    for i in range(n):
        unit[i, 0], unit[i, 1] = (points[i, 0] - low_x) / size, (points[i, 1] - low_y) / size
    length = length_of(unit)
    finely = min(max(round(length / step) + 1, fewest), most)
    return resampled(unit, count), resampled(unit, finely)


@kernel
def straightness(points: FloatArray, hook: int) -> tuple[float, float]:
    """Root mean square distance of points from their best line, the lesser of all of them and without `hook` at either end;
    and the path's length over its extent."""
    deviation = min(line_rms(points), line_rms(points[hook : len(points) - hook]))
    return deviation, length_of(points) / extent_of(points)


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
def winding(path: FloatArray, coarse: int, slight: float) -> tuple[float, int]:
    """Turning of a path on `coarse` points, without regard to its sense, radians, and how often the sense changes between
    bends of more than `slight`."""
    turned, changes, sense = 0.0, 0, 0.0
    for bend in turning_angles(resampled(path, coarse)):
        turned += abs(bend)
        if abs(bend) > slight:
            if sense * bend < 0:
                changes += 1
            sense = bend
    return turned, changes
