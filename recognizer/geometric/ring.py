"""Closed strokes: where the outline closes, what hangs over, how round and how convex it is.

Frame: a path whose bounding box has a diagonal of 1 (lengths are fractions of the stroke's size).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from recognizer.geometric.kernels.rings import closing_pair, moments_of, ring_of
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class RingRule:
    """How a ring is looked for."""

    overlap: float = 0.3
    """Share of the path at either end that may hang over: a circle is often closed with a third of
    a turn to spare, while the loop of a 6 or a 9 leaves more than that outside."""
    patience: float = 0.1
    """Path cut away must bring the ends nearer by a tenth of its length, or it is left on."""
    open: float = 0.5
    """Ends this far apart close nothing: half a circle's do. It spares most strokes the rest."""
    points: int = 48
    """Points of the ring, closed: a circle's sagitta between them is 0.2 % of its radius."""
    seam: float = 0.06
    """Share of the outline to either side of where it closes: a pen that closes it may wander there."""
    coarse: int = 16
    """Points on which convexity is judged: sides of a tenth of the outline or more, no tremor."""


RING = RingRule()


@dataclass(frozen=True, slots=True, eq=False)
class Ring:
    """points: (RING.points + 1, 2), the last equal to the first, begun at the point farthest from
    the centre (a convex polygon's corner); first, last: where on the path it begins and ends;
    gap: between its ends; loose: how far what was cut off strays from it; area; roundness: spread
    of the radii after the affine map that makes an ellipse a circle (0 for any ellipse, 0.11 for
    any parallelogram, 0.19 for any triangle); radius: of the circle of the same area; aspect:
    smaller over larger axis; fullness: 4π area / perimeter² (1 for a circle, 0.6 for an equilateral
    triangle, 0 for a line); wrong_way: share of the turning that turns the other way; crosses: how
    often it crosses itself."""

    points: FloatArray
    first: int
    last: int
    gap: float
    loose: float
    area: float
    roundness: float
    radius: float
    aspect: float
    fullness: float
    wrong_way: float
    crosses: int


def ring(path: FloatArray, rule: RingRule = RING) -> Ring | None:
    """The closed outline within a path of equally spaced points (n, 2); None where nothing is
    enclosed, or the ends stay apart."""
    encloses, points, first, last, gap, loose, area, perimeter, roundness, aspect, wrong_way, crosses = (
        ring_of(
            np.ascontiguousarray(path),
            _reach(path, rule),
            rule.patience,
            rule.open,
            rule.points,
            rule.coarse,
            rule.seam,
        )
    )
    if not encloses:
        return None
    return Ring(
        points=points,
        first=first,
        last=last,
        gap=gap,
        loose=loose,
        area=area,
        roundness=roundness,
        radius=sqrt(area / pi),
        aspect=aspect,
        fullness=4 * pi * area / perimeter**2,
        wrong_way=wrong_way,
        crosses=crosses,
    )


def closing_points(path: FloatArray, rule: RingRule = RING) -> tuple[int, int]:
    """Indices near the two ends between which the outline closes best."""
    return closing_pair(np.ascontiguousarray(path), _reach(path, rule), rule.patience)


def _reach(path: FloatArray, rule: RingRule) -> int:
    return max(round(rule.overlap * (len(path) - 1)), 1)


def area_moments(vertices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Centroid (2,) and second central moments over area (2, 2) of a polygon's inside. They map with
    any affine map, whatever the spacing of the vertices."""
    _, x, y, xx, xy, yy = moments_of(np.ascontiguousarray(vertices, dtype=float))
    return np.array([x, y]), np.array([[xx, xy], [xy, yy]])
