"""Ideal curves: what a pen means to draw, before any hand touches it.

Each function gives a polyline (n, 2) in page units, y down; corners are single vertices and
curves are dense enough to pass for smooth (a point at least every 12 degrees).
"""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate, pairwise
from math import dist, hypot

import numpy as np
from numpy.typing import ArrayLike

from sketch.ink import FloatArray
from sketch.shapes import Point

ARC_STEP = np.radians(6.0)
"""Angle between neighbouring points of an arc: the sagitta is 0.14 % of the radius."""


def superellipse(
    centre: Point,
    radii: tuple[float, float],
    start: float = 0.0,
    sweep: float = 2 * np.pi,
    squareness: float = 2.0,
    egg: float = 0.0,
) -> FloatArray:
    """|x/a|^k + |y/b|^k = 1 from angle `start` through `sweep` (radians, negative the other way).

    squareness k: 2 an ellipse, above 2 boxy; egg in (−1, 1): narrower towards +x.
    """
    count = max(8, int(abs(sweep) / ARC_STEP) + 2)
    angle = start + np.arange(count) * (sweep / (count - 1))
    cos, sin = np.cos(angle), np.sin(angle)
    if squareness != 2.0:
        reach = (np.abs(cos) ** squareness + np.abs(sin) ** squareness) ** (-1.0 / squareness)
        cos, sin = reach * cos, reach * sin
    points = np.empty((count, 2))
    points[:, 0] = centre[0] + radii[0] * cos
    points[:, 1] = centre[1] + radii[1] * sin * (1.0 - egg * cos)
    return points


def circle(centre: Point, radius: float, start: float = 0.0, sweep: float = 2 * np.pi) -> FloatArray:
    """A circle's outline from angle `start` through `sweep` radians; more than 2π overlaps."""
    return superellipse(centre, (radius, radius), start, sweep)


def polygon(vertices: ArrayLike, start: float = 0.0, overlap: float = 0.0) -> FloatArray:
    """Once around the polygon, from `start` (sides travelled, fractional: 0.5 is the middle of the first
    side), ending `overlap` (fraction of the perimeter) past the start, or before it where negative."""
    corners: list[list[float]] = np.asarray(vertices, dtype=float).tolist()
    loop = [*corners, corners[0]]
    travelled = [0.0, *accumulate(dist(a, b) for a, b in pairwise(loop))]
    perimeter = travelled[-1]

    def at(distance: float) -> list[float]:
        place = distance % perimeter
        side = min(bisect_right(travelled, place), len(corners)) - 1
        share = (place - travelled[side]) / (travelled[side + 1] - travelled[side] or 1.0)
        (x, y), (there_x, there_y) = loop[side], loop[side + 1]
        return [x + share * (there_x - x), y + share * (there_y - y)]

    whole, part = divmod(start % len(corners), 1.0)
    begin = travelled[int(whole)] + part * (travelled[int(whole) + 1] - travelled[int(whole)])
    end, hair = begin + perimeter * (1.0 + overlap), 1e-9 * perimeter
    passed = [
        corner
        for turn in range(3)
        for corner, reached in zip(corners, travelled[:-1], strict=True)
        if begin + hair < reached + turn * perimeter < end - hair
    ]
    return np.array([at(begin), *passed, at(end)])


def line(start: Point, end: Point) -> FloatArray:
    """Two points."""
    return np.array([start, end], dtype=float)


def coil(
    start: Point, end: Point, coils: float, width: float, lead: float = 0.1, lean: float = 0.35
) -> FloatArray:
    """A spring as a looping coil: a trochoid between two straight leads.

    coils: number of loops; width: peak to peak across the axis, page units; lead: fraction of
    the length that is straight at each end; lean: radius of the loops along the axis as a share of
    half the width (large enough that the loops cross themselves).
    """
    axis, across, length = _frame(start, end)
    body = length * (1 - 2 * lead)
    steps = max(16, int(coils * 2 * np.pi / (2 * ARC_STEP)))
    phase = np.arange(steps) * (2 * np.pi * coils / (steps - 1))
    # The loop must run backwards faster than the axis advances, or it is a wave and not a coil.
    advance = body / (2 * np.pi * coils)
    backward = max(lean * width / 2, 1.6 * advance)
    along = lead * length + body * phase / phase[-1] - backward * np.sin(phase)
    beside = width / 2 * (1 - np.cos(phase))
    beside -= phase * (beside[-1] / phase[-1])
    return _placed(start, axis, across, along, beside, length)


def zigzag(
    start: Point,
    end: Point,
    legs: int,
    width: float,
    lead: float = 0.1,
    spacing: ArrayLike | None = None,
    heights: ArrayLike | None = None,
) -> FloatArray:
    """A spring as a zig-zag: `legs` straight legs between two straight leads.

    spacing: relative advance of each leg, (legs,); heights: relative size of each of the legs − 1
    inner peaks; both 1 everywhere unless given.
    """
    axis, across, length = _frame(start, end)
    along, beside = np.zeros(legs + 1), np.zeros(legs + 1)
    np.cumsum(np.ones(legs) if spacing is None else spacing, out=along[1:])
    along = lead * length + along * ((1 - 2 * lead) * length / along[-1])
    beside[1:-1] = width / 2 if heights is None else np.multiply(heights, width / 2)
    beside[2:-1:2] *= -1.0
    return _placed(start, axis, across, along, beside, length)


def arrow(start: Point, end: Point, head: float, opening: float, closed: bool = False) -> FloatArray:
    """An arrow in one stroke: shaft, one barb, back to the tip, the other barb (and, if closed, to the first).

    head: length of a barb, page units; opening: angle between barb and shaft, radians.
    """
    tip = np.asarray(end, dtype=float)
    barbs = arrow_head(start, end, head, opening)
    points = [np.asarray(start, dtype=float), tip, barbs[0]]
    points += [barbs[2], tip] if closed else [tip, barbs[2]]
    return np.array(points)


def arrow_head(start: Point, end: Point, head: float, opening: float) -> FloatArray:
    """The head alone: barb, tip, barb, (3, 2)."""
    tip = np.asarray(end, dtype=float)
    axis, across, _ = _frame(start, end)
    back, out = -head * np.cos(opening) * axis, head * np.sin(opening) * across
    return np.array([tip + back + out, tip, tip + back - out])


def _frame(start: Point, end: Point) -> tuple[FloatArray, FloatArray, float]:
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = hypot(dx, dy)
    return np.array([dx / length, dy / length]), np.array([-dy / length, dx / length]), length


def _placed(
    start: Point, axis: FloatArray, across: FloatArray, along: FloatArray, beside: FloatArray, length: float
) -> FloatArray:
    body = start + along[:, None] * axis + beside[:, None] * across
    if along[0] <= 1e-9 * length:
        return body
    return np.concatenate([[start], body, [start + length * axis]])
