"""C2: a block that is meant to lie on a side of another is turned until it does, before it is moved there.

Two sides drawn along each other by hand differ by a few degrees; a block left so would stand on a corner and
fall over onto its side as soon as it is set in motion. The block turns about its centre of mass, by the angle
between the two sides; the lower of two movable ones is settled first, so that a stack on an incline is turned from
the incline upwards. One that touches as it was drawn, to rounding, stands on its corner on purpose.
Page units, y down.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass
from math import atan2, hypot, radians

from physics.rectify.contacts import Touching
from physics.rectify.correction import Correction, Step, correction, reshaped, shapes_of, taken_along, turn
from physics.rectify.separation import Outline, boxes_apart, outline_of, separation
from sketch.geometry import centroid
from sketch.page import Sketch
from sketch.shapes import Point, Polygon


@dataclass(frozen=True, slots=True)
class FlushRule:
    """When two sides are meant to lie along each other."""

    turn: float = radians(10)
    """Radians between them: each may lean by about 6 degrees from where it was meant."""
    exact: float = 1e-9
    """Page units, for the gap and at the end of the longer side: what is off by less is off by rounding."""


RULE = FlushRule()


def lay(sketch: Sketch, touching: Touching, skipped: Container[str] = ()) -> Step:
    """Every movable block that touches another one is turned to lie along it, but those skipped."""
    blocks = {
        part.label: outline_of(part.shape) for part in sketch.components if isinstance(part.shape, Polygon)
    }
    movable = [
        part.label
        for part in sketch.components
        if part.label in blocks and not part.fixed and part.label not in skipped
    ]
    settled = set(blocks) - set(movable)
    after = sketch
    corrections: list[Correction] = []
    # The lower ones first; of two alike the left one.
    for label in sorted(movable, key=lambda label: (-blocks[label].centre[1], blocks[label].centre[0])):
        if len(blocks) > 1 and label not in settled:
            angle = _angle(
                blocks[label], [blocks[one] for one in sorted(touching().get(label, frozenset()) & settled)]
            )
            settled.add(label)
            if angle is None:
                continue
            shape = after.component(label).shape
            assert isinstance(shape, Polygon)
            x, y = centroid(shape.vertices).tolist()
            held = frozenset(touching())
            shapes = taken_along(after, {label: turn((x, y), angle)}, held)
            why = "it is turned to lie along what it was drawn to touch"
            corrections += correction(
                "C2", label, shapes_of(after), shapes, why, f"it goes along with {label}"
            )
            after = reshaped(after, shapes)
            laid = after.component(label).shape
            assert isinstance(laid, Polygon)
            blocks[label] = outline_of(laid)
    return Step(after, tuple(corrections))


def lies_aslant(one: Outline, other: Outline) -> bool:
    """Whether two blocks touch along a side of each, to rounding, and these sides are neither level nor upright."""
    if boxes_apart(one, other) > RULE.exact:
        return False
    gap, (dx, dy) = separation(one, other)
    if abs(gap) > RULE.exact or min(abs(dx), abs(dy)) <= RULE.exact:
        return False
    angle, length = _between(one, other, (dx, dy))
    return abs(angle) * length <= RULE.exact


def _angle(block: Outline, under: list[Outline]) -> float | None:
    """By how much a block must be turned to lie along what bears it; None where it is not to be turned."""
    best: tuple[float, float] | None = None
    for other in under:
        gap, (x, y) = separation(other, block)
        angle, length = _between(other, block, (x, y))
        if abs(gap) <= RULE.exact or abs(angle) * length <= RULE.exact:
            return None
        if abs(angle) <= RULE.turn and (best is None or y < best[0]):
            best = y, angle
    return None if best is None else best[1]


def _between(one: Outline, other: Outline, towards: Point) -> tuple[float, float]:
    """(the angle by which `other` must be turned so that the sides that face each other are parallel; the
    longer one's length). towards: the direction from `one` to `other`."""
    dx, dy = towards
    own = max(range(len(one.normals)), key=lambda k: one.normals[k][0] * dx + one.normals[k][1] * dy)
    facing = min(range(len(other.normals)), key=lambda k: other.normals[k][0] * dx + other.normals[k][1] * dy)
    (ax, ay), (bx, by) = one.normals[own], other.normals[facing]
    angle = atan2(-bx * ay + by * ax, -(ax * bx + ay * by))
    return angle, max(_length(one, own), _length(other, facing))


def _length(outline: Outline, side: int) -> float:
    (x, y), (u, v) = outline.corners[side], outline.corners[(side + 1) % len(outline.corners)]
    return hypot(u - x, v - y)
