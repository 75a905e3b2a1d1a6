"""C3: the angle of an incline becomes the angle that the page says it has.

A triangle with a right angle keeps its base; the corner above the right angle is moved so that
the long side rises by θ: to the height (length of the base) · tan θ. What rests on the long
side is turned along with it about the foot, and so keeps its contact and its distance from the
foot. Page units, y down; the angle is that at the foot, whichever way the incline rises.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from math import atan2, hypot, pi, radians, tan

import numpy as np

from physics.formula.meaning import GRAVITY, Meanings
from physics.formula.names import constant_of, lookup
from physics.rectify.contacts import meant_to_touch
from physics.rectify.correction import Rectified, changes, moved, reshaped, turn
from physics.rectify.separation import apart
from sketch.geometry import signed_area
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Point, Polygon


@dataclass(frozen=True, slots=True)
class InclineRule:
    """When a triangle is an incline, and when an angle can be its own."""

    right: float = radians(15)
    """Radians by which the right angle may be off as drawn."""
    flattest: float = radians(2)
    """Radians: an incline flatter than this, or nearer to upright, cannot be drawn."""
    exact: float = 1e-10
    """Radians: an angle this near is left alone (rounding is a thousandth of it)."""
    whole: float = 0.9
    """Share of a polygon's area that a triangle in it must fill to be what was meant."""
    corners: int = 12
    """Of these a triangle is looked for: a polygon of more corners is none with one blunted."""
    facing: float = radians(20)
    """Radians between the long side's normal and the direction to what rests on it."""


RULE = InclineRule()


@dataclass(frozen=True, slots=True)
class Incline:
    """foot, corner (the right angle), top: indices of a triangle's vertices."""

    foot: int
    corner: int
    top: int


def incline_of(shape: Polygon) -> Incline | None:
    """Which vertex is which, where the triangle has a right angle on a base; None otherwise."""
    if len(shape.vertices) != 3:
        return None
    corners: list[tuple[float, int]] = []
    for k in range(3):
        one, other = (
            shape.vertices[k - 1] - shape.vertices[k],
            shape.vertices[(k + 1) % 3] - shape.vertices[k],
        )
        angle = abs(atan2(one[0] * other[1] - one[1] * other[0], one @ other))
        corners.append((abs(angle - pi / 2), k))
    off, corner = min(corners)
    if off > RULE.right:
        return None
    others = [(corner + 1) % 3, (corner + 2) % 3]
    foot, top = sorted(others, key=lambda k: _steepness(shape.vertices[k] - shape.vertices[corner]))
    return Incline(foot, corner, top)


def triangle_in(shape: Polygon) -> Polygon:
    """The triangle that a polygon is but for a blunted corner: its largest one, where that is nearly
    all of it; otherwise the polygon itself."""
    if len(shape.vertices) == 3:
        return shape
    triples = combinations(range(min(len(shape.vertices), RULE.corners)), 3)
    areas = [(abs(signed_area(shape.vertices[list(triple)])), triple) for triple in triples]
    area, best = max(areas)
    whole = abs(signed_area(shape.vertices))
    return Polygon(shape.vertices[list(best)]) if area >= RULE.whole * whole else shape


def tilt(sketch: Sketch, meanings: Meanings) -> Rectified:
    """C3 on every right-angled triangle that an angle is said of."""
    after = sketch
    for part in sketch.components:
        said = meanings.of(part.label, "angle", "polygon") if isinstance(part.shape, Polygon) else None
        if said is None:
            continue
        angle = constant_of(said, lookup(sketch, meanings, part.label, {}, GRAVITY))
        if angle is not None and RULE.flattest <= angle <= pi / 2 - RULE.flattest:
            after = _tilted(after, part.label, angle)
    return Rectified(after, changes("C3", _why, sketch, after))


def _why(part: Component) -> str:
    if isinstance(part.shape, Polygon) and incline_of(triangle_in(part.shape)) is not None:
        return f"{part.label}: its incline is given the angle that the page says it has."
    return f"{part.label}: it keeps its place on an incline that was given its angle."


def _tilted(sketch: Sketch, label: str, angle: float) -> Sketch:
    drawn = sketch.component(label).shape
    assert isinstance(drawn, Polygon)
    shape = triangle_in(drawn)
    found = incline_of(shape)
    if found is None:
        return sketch
    foot, corner, top = (shape.vertices[k] for k in (found.foot, found.corner, found.top))
    base = foot - corner
    length = hypot(base[0], base[1])
    across = np.array([-base[1], base[0]]) / length
    across = across if across @ (top - corner) > 0 else -across
    new = corner + length * tan(angle) * across
    by = _direction(new - foot) - _direction(top - foot)
    by = (by + pi) % (2 * pi) - pi
    if abs(by) <= RULE.exact:
        return sketch if shape is drawn else reshaped(sketch, {label: shape})
    vertices = shape.vertices.copy()
    vertices[found.top] = new
    about: Point = (float(foot[0]), float(foot[1]))
    after = reshaped(sketch, {label: Polygon(vertices)})
    for rider in _riders(sketch, label, shape, top - foot):
        after = moved(after, rider, turn(about, by))
    return after


def _riders(
    sketch: Sketch, label: str, shape: Polygon, side: np.ndarray[tuple[int], np.dtype[np.float64]]
) -> list[str]:
    """Movable solids that rest on the long side."""
    riders: list[str] = []
    for part in sketch.components:
        if part.label == label or part.fixed or not isinstance(part.shape, Circle | Polygon):
            continue
        _, (x, y) = apart(shape, part.shape)
        along = abs(x * side[0] + y * side[1]) / hypot(side[0], side[1])
        if along <= np.sin(RULE.facing) and meant_to_touch(shape, part.shape):
            riders.append(part.label)
    return riders


def _steepness(step: np.ndarray[tuple[int], np.dtype[np.float64]]) -> float:
    return abs(float(step[1])) / (hypot(step[0], step[1]) or 1.0)


def _direction(step: np.ndarray[tuple[int], np.dtype[np.float64]]) -> float:
    return atan2(step[1], step[0])
