"""Ideal curves: what a pen means to draw, before any hand touches it.

Each function gives a polyline (n, 2) in page units, y down; corners are single vertices and
curves are dense enough to pass for smooth (a point at least every 12 degrees). The curves themselves
are kernels (`data_gen.hand.curves`); here they are put between two points of a page.
"""

from __future__ import annotations

from math import hypot, pi

import numpy as np
from numpy.typing import ArrayLike

from data_gen.hand import entries
from sketch.ink import FloatArray
from sketch.shapes import Point


def superellipse(
    centre: Point,
    radii: tuple[float, float],
    start: float = 0.0,
    sweep: float = 2 * pi,
    squareness: float = 2.0,
    egg: float = 0.0,
) -> FloatArray:
    """|x/a|^k + |y/b|^k = 1 from angle `start` through `sweep` (radians, negative the other way).

    squareness k: 2 an ellipse, above 2 boxy; egg in (−1, 1): narrower towards +x.
    """
    (x, y), (a, b) = centre, radii
    return entries.superellipse(*map(float, (x, y, a, b, start, sweep, squareness, egg)))


def circle(centre: Point, radius: float, start: float = 0.0, sweep: float = 2 * pi) -> FloatArray:
    """A circle's outline from angle `start` through `sweep` radians; more than 2π overlaps."""
    return superellipse(centre, (radius, radius), start, sweep)


def polygon(vertices: ArrayLike, start: float = 0.0, overlap: float = 0.0) -> FloatArray:
    """Once around the polygon, from `start` (sides travelled, fractional: 0.5 is the middle of the first
    side), ending `overlap` (fraction of the perimeter) past the start, or before it where negative."""
    corners = np.array(vertices, dtype=float)
    return entries.polygon(corners, float(start % len(corners)), float(overlap))


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
    length = _length(start, end)
    return _placed(entries.coil(*map(float, (coils, length, width, lead, lean))), start, end)


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
    advances = np.ones(legs) if spacing is None else np.array(spacing, dtype=float)
    peaks = np.ones(legs - 1) if heights is None else np.array(heights, dtype=float)
    path = entries.zigzag(advances, peaks, _length(start, end), float(width), float(lead))
    return _placed(path, start, end)


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
    back, out = -head * np.cos(opening), head * np.sin(opening)
    return _placed(np.array([[back, out], [0.0, 0.0], [back, -out]]), start, end) + np.subtract(end, start)


def _length(start: Point, end: Point) -> float:
    return hypot(end[0] - start[0], end[1] - start[1])


def _placed(path: FloatArray, start: Point, end: Point) -> FloatArray:
    """A path along +x from the origin, turned and moved to begin at `start` on the way to `end`."""
    along = np.subtract(end, start) / _length(start, end)
    return start + path[:, :1] * along + path[:, 1:] * np.array([-along[1], along[0]])
