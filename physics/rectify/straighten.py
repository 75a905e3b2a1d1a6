"""C1: edges that are nearly level or upright become so; vertices run anti-clockwise.

Anti-clockwise is meant as the eye sees it on the page: with y down, the shoelace area of
`sketch.geometry.signed_area` is then negative, and positive in the scene, where y is up.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, pi, radians

import numpy as np

from physics.rectify.correction import Rectified, changes, reshaped
from sketch.geometry import signed_area
from sketch.ink import FloatArray
from sketch.page import Sketch
from sketch.shapes import Polygon, Shape


@dataclass(frozen=True, slots=True)
class StraightRule:
    """When an edge is meant to be level or upright."""

    lean: float = radians(12)
    """Radians from the axis: short edges of hand-drawn boxes lean by up to 9 degrees; inclines are steeper."""
    least_area: float = 0.5
    """Share of its area that a polygon must keep: a flat triangle is not to be pressed flat."""


RULE = StraightRule()


def straighten(sketch: Sketch) -> Rectified:
    """C1 on every polygon of the page."""
    shapes: dict[str, Shape] = {}
    for part in sketch.components:
        if isinstance(part.shape, Polygon):
            vertices = _wound(_straight(part.shape.vertices))
            if not np.array_equal(vertices, part.shape.vertices):
                shapes[part.label] = Polygon(vertices)
    after = reshaped(sketch, shapes)
    why = "its nearly level and upright edges are made so, and its vertices run anti-clockwise"
    return Rectified(after, changes("C1", lambda part: f"{part.label}: {why}.", sketch, after))


def _straight(vertices: FloatArray) -> FloatArray:
    """Vertices joined by nearly level edges share a height, by nearly upright ones a column: the mean.
    Repeated, since straightening one edge turns its neighbours."""
    result = vertices
    level: set[int] = set()
    upright: set[int] = set()
    for _ in range(len(vertices) + 1):
        found = _leaning(result)
        if found[0] <= level and found[1] <= upright:
            return result
        level |= found[0]
        upright |= found[1]
        after = vertices.copy()
        after[:, 1] = _shared(vertices[:, 1], level)
        after[:, 0] = _shared(vertices[:, 0], upright)
        if abs(signed_area(after)) < RULE.least_area * abs(signed_area(vertices)):
            return result
        result = after
    return result


def _leaning(vertices: FloatArray) -> tuple[set[int], set[int]]:
    """(nearly level, nearly upright) edges, each by its first vertex."""
    level: set[int] = set()
    upright: set[int] = set()
    for k, (dx, dy) in enumerate((np.roll(vertices, -1, axis=0) - vertices).tolist()):
        lean = abs(atan2(dy, dx))
        if min(lean, pi - lean) <= RULE.lean:
            level.add(k)
        elif abs(lean - pi / 2) <= RULE.lean:
            upright.add(k)
    return level, upright


def _shared(values: FloatArray, edges: set[int]) -> FloatArray:
    """Values (n,) with one mean for all vertices that the edges join."""
    count = len(values)
    group = list(range(count))
    for edge in sorted(edges):
        old, new = group[(edge + 1) % count], group[edge]
        group = [new if one == old else one for one in group]
    result = values.copy()
    for name in set(group):
        members = [k for k in range(count) if group[k] == name]
        if len({float(values[k]) for k in members}) > 1:
            result[members] = values[members].mean()
    return result


def _wound(vertices: FloatArray) -> FloatArray:
    """The same vertices from the same first one, anti-clockwise to the eye."""
    return vertices if signed_area(vertices) <= 0 else np.concatenate([vertices[:1], vertices[:0:-1]])
