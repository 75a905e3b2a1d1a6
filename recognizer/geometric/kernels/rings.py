"""Closed outlines: where they close, their moments, how round and how convex they are: see `recognizer.geometric.ring`."""

from __future__ import annotations

from math import hypot, sqrt

import numpy as np

from recognizer.geometric.kernels.paths import (
    bend_angles,
    crossing_places,
    length_of,
    resampled,
    turning_angles,
)
from recognizer.jit import kernel
from sketch.ink import FloatArray


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
def ring_of(
    path: FloatArray, reach: int, patience: float, widest: float, count: int, coarse: int, seam: float
) -> tuple[bool, FloatArray, int, int, float, float, float, float, float, float, float, int]:
    """The outline that a path closes, on `count` + 1 points, begun where it lies farthest out: whether its ends come within
    `widest` and it encloses anything, the points, first, last, gap, stray, area, perimeter, roundness, aspect, share of wrong
    turning on every `count // coarse`-th point, crossings away from the seam: see `Ring`."""
    first, last = closing_pair(path, reach, patience)
    gap = hypot(path[first, 0] - path[last, 0], path[first, 1] - path[last, 1])
    if gap > widest:
        return False, path, first, last, gap, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0
    outline = np.concatenate((path[first : last + 1], path[first : first + 1]))
    closed = resampled(outline, count + 1)
    closed[-1] = closed[0]
    perimeter = length_of(closed)
    area, cx, cy, xx, xy, yy = moments_of(closed[:-1])
    nothing = (False, closed, first, last, gap, 0.0, 0.0, perimeter, 0.0, 0.0, 0.0, 0)
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
        first,
        last,
        gap,
        stray_of(path, first, last),
        abs(area),
        perimeter,
        roundness,
        sqrt(small / large),
        wrong / (np.abs(bends).sum() + 1e-9),
        crosses,
    )


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
def dents(points: FloatArray, reach: int) -> tuple[float, float]:
    """Sharpest bends of a closed outline (its last point equal to its first) in the sense in which it goes round and in the
    other, between chords of `reach` points, radians."""
    n = len(points) - 1
    around = np.empty((n + 2 * reach, 2))
    for k in range(n + 2 * reach):
        around[k] = points[(k - reach) % n]
    bends = bend_angles(around, reach)[reach : n + reach]
    if bends.sum() < 0:
        bends = -bends
    return bends.max(), -bends.min()
