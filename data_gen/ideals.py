"""Ideal curves: what a pen means to draw, before any hand touches it.

Each function gives a polyline (n, 2) in page units, y down; corners are single vertices and
curves are dense enough to pass for smooth (a point at least every 6 degrees).
"""

from __future__ import annotations

from collections.abc import Sequence

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
    angle = start + np.linspace(0.0, sweep, max(8, int(abs(sweep) / ARC_STEP) + 2))
    cos, sin = np.cos(angle), np.sin(angle)
    reach = (np.abs(cos) ** squareness + np.abs(sin) ** squareness) ** (-1.0 / squareness)
    x, y = reach * cos, reach * sin * (1.0 - egg * cos)
    return np.column_stack([centre[0] + radii[0] * x, centre[1] + radii[1] * y])


def circle(centre: Point, radius: float, start: float = 0.0, sweep: float = 2 * np.pi) -> FloatArray:
    """A circle's outline from angle `start` through `sweep` radians; more than 2π overlaps."""
    return superellipse(centre, (radius, radius), start, sweep)


def polygon(vertices: ArrayLike, start: float = 0.0, overlap: float = 0.0) -> FloatArray:
    """Once around the polygon, from `start` (sides travelled, fractional: 0.5 is the middle of the first
    side), ending `overlap` (fraction of the perimeter) past the start, or before it where negative."""
    corners = np.asarray(vertices, dtype=float)
    loop = np.concatenate([corners, corners[:1]])
    travelled = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(loop, axis=0), axis=1))])
    perimeter = travelled[-1]
    begin = float(np.interp(start % len(corners), np.arange(len(loop)), travelled))
    end = begin + perimeter * (1.0 + overlap)
    knots = np.concatenate([travelled[:-1] + turn * perimeter for turn in range(3)])
    inside = knots[(knots > begin + 1e-9 * perimeter) & (knots < end - 1e-9 * perimeter)]
    at = np.concatenate([[begin], inside, [end]]) % perimeter
    return np.column_stack([np.interp(at, travelled, loop[:, axis]) for axis in (0, 1)])


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
    steps = max(16, int(coils * 2 * np.pi / (1.5 * ARC_STEP)))
    phase = np.linspace(0.0, 2 * np.pi * coils, steps)
    # The loop must run backwards faster than the axis advances, or it is a wave and not a coil.
    advance = body / (2 * np.pi * coils)
    backward = max(lean * width / 2, 1.6 * advance)
    along = lead * length + body * phase / phase[-1] - backward * np.sin(phase)
    beside = width / 2 * (1 - np.cos(phase)) - width / 2
    beside = beside - np.linspace(beside[0], beside[-1], steps)
    return _placed(start, axis, across, along, beside, length)


def zigzag(
    start: Point,
    end: Point,
    legs: int,
    width: float,
    lead: float = 0.1,
    spacing: Sequence[float] | None = None,
    heights: Sequence[float] | None = None,
) -> FloatArray:
    """A spring as a zig-zag: `legs` straight legs between two straight leads.

    spacing: relative advance of each leg, (legs,); heights: relative size of each of the legs − 1
    inner peaks; both 1 everywhere unless given.
    """
    axis, across, length = _frame(start, end)
    steps = np.ones(legs) if spacing is None else np.asarray(spacing, dtype=float)
    sizes = np.ones(legs - 1) if heights is None else np.asarray(heights, dtype=float)
    along = lead * length + (1 - 2 * lead) * length * np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
    side = np.where(np.arange(legs - 1) % 2 == 0, 1.0, -1.0)
    beside = np.concatenate([[0.0], side * sizes * width / 2, [0.0]])
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
    step = np.subtract(end, start).astype(float)
    length = float(np.linalg.norm(step))
    axis = step / length
    return axis, np.array([-axis[1], axis[0]]), length


def _placed(
    start: Point, axis: FloatArray, across: FloatArray, along: FloatArray, beside: FloatArray, length: float
) -> FloatArray:
    body = np.asarray(start) + along[:, None] * axis + beside[:, None] * across
    ends = np.asarray(start) + np.array([[0.0], [length]]) * axis
    keep_lead = along[0] > 1e-9 * length
    return np.concatenate([ends[:1], body, ends[1:]]) if keep_lead else body
