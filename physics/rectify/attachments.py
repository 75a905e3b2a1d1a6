"""C4: ends of springs and wires are clipped to the boundary of what they are attached to.

An end near a vertex is snapped to it; one on a circle near the point that faces the link's other
end is snapped there, so that the link pulls through the centre. An end that lies on the
boundary already is where it is meant to be. Page units.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass, replace
from math import hypot, radians, sin

from physics.rectify.angles import SaidAngle, no_worse
from physics.rectify.contacts import Touching
from physics.rectify.correction import Correction, Step, correction, reshaped, shapes_of
from physics.rectify.separation import nearest, outline_of
from sketch.page import Sketch
from sketch.shapes import Circle, Point, Polygon, Shape, Solid, Spring, Wire


@dataclass(frozen=True, slots=True)
class AttachmentRule:
    """How near is near."""

    vertex: float = 16.0
    """Page units from a vertex, but at most:"""
    side: float = 0.25
    """Share of the shorter of the vertex's two edges."""
    facing: float = radians(25)
    """Radians, seen from the circle's centre, between the end and the link's other end."""
    exact: float = 1e-7
    """Page units: an end this near to the boundary lies on it."""


RULE = AttachmentRule()


def attach(
    sketch: Sketch, angles: Mapping[str, SaidAngle], touching: Touching, skipped: Container[str] = ()
) -> Step:
    """C4 on every spring and wire of the page but those skipped. angles: that are said of links, by label, which
    clipping makes no worse."""
    after = sketch
    corrections: list[Correction] = []
    why = "its ends are put on the boundary of what they are attached to"
    # What follows a link that keeps its angle takes the ends of others along, which are then clipped there.
    for part in sorted(sketch.components, key=lambda part: (part.label not in angles, part.label)):
        if part.label in skipped or not isinstance(part.shape, Spring | Wire):
            continue
        shape = after.component(part.label).shape
        assert isinstance(shape, Spring | Wire)
        holders = [_holder(after, label) for label in part.ends]
        start = shape.start if holders[0] is None else _clipped(holders[0], shape.start, shape.end)
        end = shape.end if holders[1] is None else _clipped(holders[1], shape.end, shape.start)
        if (start, end) == (shape.start, shape.end) or start == end:
            continue
        shapes: dict[str, Shape] = {part.label: replace(shape, start=start, end=end)}
        if part.label in angles:
            clipped = reshaped(after, shapes)
            shapes |= no_worse(after, clipped, part.label, angles[part.label], frozenset(touching()))
        follows = f"it follows {part.label}, which keeps its angle"
        corrections += correction("C4", part.label, shapes_of(after), shapes, why, follows)
        after = reshaped(after, shapes)
    return Step(after, tuple(corrections))


def _holder(sketch: Sketch, label: str | None) -> Solid | None:
    shape = None if label is None else sketch.component(label).shape
    return shape if isinstance(shape, Circle | Polygon) else None


def _clipped(solid: Solid, end: Point, other: Point) -> Point:
    foot = nearest(outline_of(solid), end)
    if hypot(foot[0] - end[0], foot[1] - end[1]) <= RULE.exact:
        return end
    if isinstance(solid, Circle):
        facing = nearest(outline_of(solid), other)
        near = 2 * solid.radius * sin(RULE.facing / 2)
        return facing if hypot(foot[0] - facing[0], foot[1] - facing[1]) <= near else foot
    return _vertex_near(solid, foot) or foot


def _vertex_near(polygon: Polygon, foot: Point) -> Point | None:
    vertices = polygon.vertices.tolist()
    nearest, found = RULE.vertex, None
    for k, (x, y) in enumerate(vertices):
        sides = [hypot(x - px, y - py) for px, py in (vertices[k - 1], vertices[(k + 1) % len(vertices)])]
        distance = hypot(x - foot[0], y - foot[1])
        if distance <= min(nearest, RULE.side * min(sides)):
            nearest, found = distance, (x, y)
    return found
