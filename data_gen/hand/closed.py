"""What people draw when they mean a circle, a convex polygon or a lasso: ideal paths, one unit large.

A family gives a drawing: the points of its strokes one below the other, where each stroke ends, and a count
(the corners of a polygon, the strokes of a ring). y grows downward; anti-clockwise is meant as it is seen.
"""

from __future__ import annotations

from math import cos, exp, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.chance import Key, between, normal, split, uniform
from data_gen.hand.curves import (
    backwards,
    bent,
    joined,
    more,
    moved,
    one,
    piece,
    point,
    polygon,
    superellipse,
)
from data_gen.hand.jit import part
from data_gen.hand.names import (
    ASPECT,
    CLOSURE,
    CORNERS,
    DIRECTION,
    OVERSHOOT,
    PROPORTIONS,
    ROUNDNESS,
    SIDES,
    TAIL,
)
from data_gen.hand.person import CLOSING, CORNER, GAP
from sketch.ink import FloatArray

Drawing = tuple[FloatArray, NDArray[np.int64], int]

SHAPE, PARTS = 1001, 1002
"""Names under which a family's random numbers are split off: of the shape, and of its strokes."""

ASPECT_SPREAD = 0.2
"""Standard deviation of log(width / height) of circles; one in eight is more than twice as slim."""
TOP = 0.92
"""Share of rings and polygons begun at the top (van Sommers 1984: most adults)."""
ANTICLOCKWISE = 0.9
"""Share of rings and polygons drawn anti-clockwise: the right-hander's and the school's way."""
TAILED = 0.14
"""Share of closed shapes whose pen runs on past the closure."""
SAGITTA = 0.03
"""Standard deviation of a side's sagitta, fraction of the side."""
OVERSHOT = 0.025
"""Standard deviation of how far a piece of a shape ends from its corner, fraction of the piece."""


@part
def circle(key: Key, habits: FloatArray, on: NDArray[np.bool_], several: bool) -> Drawing:
    """Ovals, eggs, slightly boxy or spiralling ones; in two arcs, or with a hub as pulleys have."""
    r = split(key, SHAPE)
    slim = 2.4 if uniform(r) < 0.12 else 1.0
    aspect = exp(ASPECT_SPREAD * slim * normal(r) + 0.05) if on[ASPECT] else 1.0
    way = split(key, DIRECTION)
    at_top, near, anywhere, sense = uniform(way) < TOP, normal(way), 2 * pi * uniform(way), uniform(way)
    start = -pi / 2
    if on[DIRECTION]:
        start = start + 0.3 + 0.42 * near if at_top else anywhere
    clockwise = on[DIRECTION] and sense > ANTICLOCKWISE
    error = closing(key, habits, on, 0.01)
    squareness, egg, spiral = _roundness(key, on)
    sweep = 2 * pi * min(max(1.0 + error, 0.8), 1.3) * (1.0 if clockwise else -1.0)
    path = superellipse(0.0, 0.0, 0.5 * aspect**0.5, 0.5 / aspect**0.5, start, sweep, squareness, egg)
    for k in range(len(path)):
        growth = 1.0 + spiral * (k / (len(path) - 1) - 0.5)
        path[k, 0] *= growth
        path[k, 1] *= growth
    parts = split(key, PARTS)
    if not several:
        points, ends = one(with_tail(path, key, on))
        return points, ends, 1
    if uniform(parts) < 0.7:
        # Two arcs: the second begins where the first began, or where it ended.
        cut = between(parts, 0.35, 0.65)
        other = piece(path, cut, 1.0)
        points, ends = one(piece(path, 0.0, cut))
        points, ends = more(points, ends, backwards(other) if uniform(parts) < 0.55 else other)
        return points, ends, 2
    points, ends = one(path)
    hub = uniform(parts)
    radius = between(parts, 0.05, 0.2)
    if hub < 0.5:
        points, ends = more(points, ends, point(0.03 * normal(parts), 0.03 * normal(parts)))
    else:
        points, ends = more(
            points, ends, superellipse(0.02, 0.02, radius, radius, -pi / 2, -2.05 * pi, 2.0, 0.0)
        )
    return points, ends, 2


@part
def _roundness(key: Key, on: NDArray[np.bool_]) -> tuple[float, float, float]:
    """Squareness, egg and spiral of a ring."""
    r = split(key, ROUNDNESS)
    squareness, egg, spiral = (
        2.0 + 0.3 * max(-0.8, normal(r)),
        min(max(0.12 * normal(r), -0.4), 0.4),
        0.06 * normal(r),
    )
    return (squareness, egg, spiral) if on[ROUNDNESS] else (2.0, 0.0, 0.0)


@part
def closing(key: Key, habits: FloatArray, on: NDArray[np.bool_], mean: float) -> float:
    """How far past its beginning a loop ends, fraction of its perimeter; negative: it stays open."""
    r = split(key, CLOSURE)
    wide = 2.2 if uniform(r) < 0.15 else 1.0
    error = mean + habits[GAP] + habits[CLOSING] * wide * normal(r)
    return error if on[CLOSURE] else 0.0


@part
def with_tail(path: FloatArray, key: Key, on: NDArray[np.bool_]) -> FloatArray:
    """Now and then the pen runs on past the closure, nearly straight along where it was going."""
    r = split(key, TAIL)
    chosen, length, veer = uniform(r), 0.03 + 0.22 * uniform(r) ** 1.5, 0.9 * (uniform(r) - 0.5)
    dx, dy = path[-1, 0] - path[-3, 0], path[-1, 1] - path[-3, 1]
    norm = hypot(dx, dy)
    if not on[TAIL] or chosen >= TAILED or norm == 0.0:
        return path
    c, s = length / norm * cos(veer), length / norm * sin(veer)
    return joined(path, point(path[-1, 0] + c * dx - s * dy, path[-1, 1] + s * dx + c * dy))


@part
def convex(key: Key, habits: FloatArray, on: NDArray[np.bool_], several: bool) -> Drawing:
    """Convex polygons of 3 to 8 corners, in one stroke or in pieces; the count is that of the corners."""
    corners = _anticlockwise(_corners(key, habits, on))
    count = len(corners)
    way = split(key, DIRECTION)
    at_top, anywhere, sense = uniform(way) < TOP, int(count * uniform(way)), uniform(way)
    mid_side, share = uniform(way) < 0.08, between(way, 0.15, 0.85)
    # Too long a last side goes straight on, or round the corner once more.
    straight_on = uniform(way) < 0.75
    first = 0
    for k in range(count):
        if corners[k, 1] + 0.35 * corners[k, 0] < corners[first, 1] + 0.35 * corners[first, 0]:
            first = k
    if on[DIRECTION] and not at_top:
        first = anywhere
    loop = np.empty((count, 2))
    for k in range(count):
        source = (first - k if on[DIRECTION] and sense > ANTICLOCKWISE else first + k) % count
        loop[k, 0], loop[k, 1] = corners[source, 0], corners[source, 1]
    if several:
        points, ends = _in_pieces(loop, key, on)
        return points, ends, count
    start = share if on[DIRECTION] and mid_side else 0.0
    error = max(-0.13, closing(key, habits, on, 0.012))
    if error > 0 and straight_on:
        path = polygon(loop, start, 0.0)
        x, y = path[-1, 0] - path[-2, 0], path[-1, 1] - path[-2, 1]
        path[-1, 0] += 2 * error * x
        path[-1, 1] += 2 * error * y
    else:
        path = polygon(loop, start, error)
    points, ends = one(with_tail(_bent(path, key, on), key, on))
    return points, ends, count


@part
def _bent(path: FloatArray, key: Key, on: NDArray[np.bool_]) -> FloatArray:
    r = split(key, SIDES)
    inward = 0.015 * normal(r)
    sagittas = np.empty(len(path) - 1)
    for k in range(len(sagittas)):
        sagittas[k] = inward + SAGITTA * normal(r)
    return bent(path, sagittas) if on[SIDES] else path


@part
def _corners(key: Key, habits: FloatArray, on: NDArray[np.bool_]) -> FloatArray:
    """Corners of a triangle, rectangle, plank, rhombus, parallelogram, trapezium or general convex polygon."""
    r = split(key, SHAPE)
    which, u = uniform(r), uniform(r)
    stretch = exp(0.34 * normal(r)) if on[ASPECT] else 1.0
    if which < 0.42:
        corners = np.zeros((3, 2))
        corners[0, 0], corners[1, 0] = -0.5, 0.5
        lean = 0.16 * normal(r) if u > 0.25 else (-0.5 if u < 0.125 else 0.5)
        corners[2, 0], corners[2, 1] = lean, -0.85 / stretch
    elif which < 0.84:
        # One rectangle in twelve is a plank: a floor, a shelf, a beam of up to 25:1.
        if u < 0.08:
            stretch = exp(1.5 + 1.7 * uniform(r))
        elif on[ASPECT]:
            stretch *= 1.25
        a, b = 0.5 * stretch**0.5, 0.5 / stretch**0.5
        corners = np.empty((4, 2))
        if u > 0.9:
            a, b = 1.3 * a, 1.3 * b
            corners[0, 0], corners[0, 1] = 0.0, -b
            corners[1, 0], corners[1, 1] = -a, 0.0
            corners[2, 0], corners[2, 1] = 0.0, b
            corners[3, 0], corners[3, 1] = a, 0.0
        else:
            skew = a * (0.3 * normal(r)) if u > 0.82 else 0.0
            narrow = a * between(r, -0.6, 0.6) if u > 0.86 else 0.0
            corners[0, 0], corners[0, 1] = -a + skew + narrow, -b
            corners[1, 0], corners[1, 1] = -a, b
            corners[2, 0], corners[2, 1] = a, b
            corners[3, 0], corners[3, 1] = a + skew - narrow, -b
    else:
        count = 5 + int(4 * u**1.6) if u > 0.2 else 4
        even = between(r, 0.4, 3.0)
        gaps = np.empty(count)
        total = 0.0
        for k in range(count):
            gaps[k] = even + uniform(r)
            total += gaps[k]
        angle = 2 * pi * uniform(r)
        corners = np.empty((count, 2))
        for k in range(count):
            angle += 2 * pi * gaps[k] / total
            corners[k, 0], corners[k, 1] = 0.5 * cos(angle) * stretch**0.5, 0.5 * sin(angle) / stretch**0.5
    if on[CORNERS]:
        stray = split(key, CORNERS)
        for k in range(len(corners)):
            corners[k, 0] += habits[CORNER] * normal(stray)
            corners[k, 1] += habits[CORNER] * normal(stray)
    return corners


@part
def _anticlockwise(corners: FloatArray) -> FloatArray:
    area = 0.0
    for k in range(len(corners)):
        after = (k + 1) % len(corners)
        area += corners[k, 0] * corners[after, 1] - corners[after, 0] * corners[k, 1]
    return corners if area < 0 else backwards(corners)


@part
def _in_pieces(corners: FloatArray, key: Key, on: NDArray[np.bool_]) -> tuple[FloatArray, NDArray[np.int64]]:
    """The pen lifts at corners: a stroke for each side, two halves, all but one side and that one, or any."""
    r = split(key, PARTS)
    count = len(corners)
    lifted = np.zeros(count + 1, dtype=np.bool_)
    lifted[count] = True
    habit = uniform(r)
    if habit < 0.35:
        for k in range(1, count):
            lifted[k] = True
    elif habit < 0.6:
        lifted[(count + 1) // 2] = True
    elif habit < 0.85:
        lifted[count - 1] = True
    else:
        lifted[1 + int((count - 1) * uniform(r))] = True
        for k in range(1, count):
            lifted[k] = lifted[k] or uniform(r) < 0.4
    points, ends, begun = np.empty((0, 2)), np.empty(0, dtype=np.int64), 0
    for k in range(1, count + 1):
        if not lifted[k]:
            continue
        path = np.empty((k - begun + 1, 2))
        for j in range(begun, k + 1):
            path[j - begun, 0], path[j - begun, 1] = corners[j % count, 0], corners[j % count, 1]
        path = loosened(path, r, on)
        # Single sides are drawn downwards or to the right, as lines are, whatever the way round.
        upwards = path[-1, 0] + path[-1, 1] < path[0, 0] + path[0, 1]
        if uniform(r) < (0.65 if upwards and k - begun == 1 else 0.15) and on[DIRECTION]:
            path = backwards(path)
        points, ends = more(points, ends, _bent(path, key ^ np.uint64(k), on))
        begun = k
    return points, ends


@part
def loosened(path: FloatArray, r: NDArray[np.uint64], on: NDArray[np.bool_]) -> FloatArray:
    """The path with its ends short of where they belong, past it, or beside it."""
    found = moved(path, 0.0, 0.0)
    before, after = (
        OVERSHOT * normal(r) + 0.005,
        OVERSHOT * normal(r) + 0.01,
    )
    aside = 0.5 * OVERSHOT * normal(r), 0.5 * OVERSHOT * normal(r)
    if on[OVERSHOOT]:
        for axis in range(2):
            first, last = path[1, axis] - path[0, axis], path[-1, axis] - path[-2, axis]
            found[0, axis] -= before * first
            found[-1, axis] += after * last
        found[0, 0] -= aside[0] * (path[1, 1] - path[0, 1])
        found[0, 1] += aside[0] * (path[1, 0] - path[0, 0])
        found[-1, 0] -= aside[1] * (path[-1, 1] - path[-2, 1])
        found[-1, 1] += aside[1] * (path[-1, 0] - path[-2, 0])
    return found


@part
def lasso(key: Key, habits: FloatArray, on: NDArray[np.bool_], _several: bool) -> Drawing:
    """A loose loop thrown around things: closed or nearly, lobed, longer than high."""
    r = split(key, SHAPE)
    flat = exp(-0.9 * uniform(r)) if on[ASPECT] else 1.0
    lobes = np.empty((4, 2))
    for k in range(4):
        spread = 0.16 / (k + 2) ** 0.8 if on[PROPORTIONS] else 0.0
        lobes[k, 0], lobes[k, 1] = spread * normal(r), spread * normal(r)
    way = split(key, DIRECTION)
    start, sense = (2 * pi * uniform(way), uniform(way)) if on[DIRECTION] else (-pi / 2, 0.0)
    sweep = 2 * pi * (1.0 + min(max(closing(key, habits, on, 0.02), -0.08), 0.12))
    count = 90
    path = np.empty((count, 2))
    for k in range(count):
        angle = start + sweep * k / (count - 1) * (1.0 if sense < 0.5 else -1.0)
        radius = 0.5
        for order in range(4):
            radius += 0.5 * lobes[order, 0] * cos((order + 2) * angle) + 0.5 * lobes[order, 1] * sin(
                (order + 2) * angle
            )
        path[k, 0] = max(radius, 0.15) * cos(angle)
        path[k, 1] = max(radius, 0.15) * sin(angle) * flat
    points, ends = one(path)
    return points, ends, 1
