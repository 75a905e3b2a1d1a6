"""C3: the angle of an incline becomes the angle that the page says it has.

Let a right-angled triangle have the base p0 p1, from left to right, and its third vertex p2 above
the right angle. (i) Uphill: the right angle is at p1; p0 is kept, u is the unit direction from p0 to p1, and
v is u turned by θ towards p2. (ii) Downhill: the right angle is at p0; p1 is kept, u is the unit direction from p1
to p0, and v is u turned by θ towards p2. In both, the new p2 lies on the ray of direction v from the vertex
that is kept, straight above the right angle, which is where its way along the base is the base's length:

    (s v) · u = |p0 − p1|,  so  s = |p0 − p1| / (v · u) = |p0 − p1| / cos θ.

(The published formula squares the numerator, which is an area over a number, and no distance.) The corner
is exactly a right angle afterwards, whichever way the base lies.

What rests on the long side is turned with it about the vertex that is kept: it keeps its contact and its place
along the side. So does what rests on that, and so on; what hangs from them by a link follows without turning.
Links that end on the triangle's boundary stay where they are on it, and a fixed ball at the top (a pulley, a
peg) goes with the top.

Page units, y down; the angle is that at the kept vertex, the foot, whichever way the incline rises.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from math import atan2, cos, hypot, pi, radians, sin

from physics.formula.names import number_said
from physics.parts.given import Spoken
from physics.rectify.contacts import Touching
from physics.rectify.correction import (
    Correction,
    Place,
    Step,
    correction,
    reshaped,
    shapes_of,
    shift,
    taken_along,
    turn,
)
from physics.rectify.separation import apart
from sketch.geometry import signed_area
from sketch.ink import FloatArray
from sketch.page import Sketch
from sketch.shapes import Circle, Point, Polygon, Shape


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
    digits: int = 9
    """To which angles (radians) and shares are alike: then places decide, which do not depend on the drawing's order."""
    top: float = 12.0
    """Page units from the top to the boundary of a fixed ball that goes with it."""


RULE = InclineRule()


@dataclass(frozen=True, slots=True)
class Incline:
    """foot, corner (the right angle), top: indices of a triangle's vertices."""

    foot: int
    corner: int
    top: int


def incline_of(shape: Polygon) -> Incline | None:
    """Which vertex is which, where the triangle has a right angle on a base no steeper than 45°; None otherwise."""
    if len(shape.vertices) != 3:
        return None
    corners: list[tuple[float, Point, int]] = []
    for k in range(3):
        one, other = (
            shape.vertices[k - 1] - shape.vertices[k],
            shape.vertices[(k + 1) % 3] - shape.vertices[k],
        )
        angle = abs(atan2(one[0] * other[1] - one[1] * other[0], one @ other))
        corners.append((round(abs(angle - pi / 2), RULE.digits), _point(shape.vertices[k]), k))
    off, _, corner = min(corners)
    if off > RULE.right:
        return None
    steep = {k: _steepness(shape.vertices[k] - shape.vertices[corner]) for k in range(3) if k != corner}
    foot, top = sorted(steep, key=lambda k: (round(steep[k], RULE.digits), _point(shape.vertices[k])))
    return Incline(foot, corner, top) if steep[foot] <= sin(pi / 4) + RULE.exact else None


def triangle_in(shape: Polygon) -> Polygon:
    """The triangle that a polygon is but for a blunted corner: its largest one, where that is nearly
    all of it; otherwise the polygon itself."""
    if len(shape.vertices) == 3:
        return shape
    whole = abs(signed_area(shape.vertices))
    found: list[tuple[float, list[list[float]], list[int]]] = []
    for triple in combinations(range(min(len(shape.vertices), RULE.corners)), 3):
        corners = shape.vertices[list(triple)]
        share = abs(signed_area(corners)) / whole if whole > 0 else 0.0
        found.append((round(share, RULE.digits), sorted(corners.tolist()), list(triple)))
    share, _, best = max(found)
    return Polygon(shape.vertices[best]) if share >= RULE.whole else shape


def raised(foot: Point, corner: Point, top: Point, angle: float) -> Point:
    """The new top p2: seen from the foot at `angle` (radians) over the base, straight above the corner, on
    the side where the top was; 0 < angle < π/2."""
    bx, by = corner[0] - foot[0], corner[1] - foot[1]
    base = hypot(bx, by)
    ux, uy = bx / base, by / base
    side = 1.0 if ux * (top[1] - corner[1]) - uy * (top[0] - corner[0]) > 0 else -1.0
    vx = cos(angle) * ux - side * sin(angle) * uy
    vy = cos(angle) * uy + side * sin(angle) * ux
    distance = base / (vx * ux + vy * uy)
    return foot[0] + distance * vx, foot[1] + distance * vy


def angles_of(sketch: Sketch, spoken: Spoken) -> dict[str, float]:
    """The angles that the page says its polygons have as inclines, radians, by label."""
    found: dict[str, float] = {}
    for part in sketch.components:
        if isinstance(part.shape, Polygon):
            said = spoken.of(part, "angle")
            angle = None if said is None else number_said(sketch, spoken.meanings, said)
            if angle is not None and RULE.flattest <= angle <= pi / 2 - RULE.flattest:
                found[part.label] = angle
    return found


def no_worse(drawn: Polygon, after: Polygon, angle: float) -> Polygon:
    """A triangle that was straightened, with the angle at its foot as near to what is said of it as it was drawn;
    what is no incline as it is."""
    was, now = incline_of(drawn), incline_of(after)
    if was is None or now is None:
        return after
    before = at_foot(drawn, was)
    if abs(at_foot(after, now) - angle) <= abs(before - angle):
        return after
    vertices = after.vertices.copy()
    foot, corner, top = (_point(vertices[k]) for k in (now.foot, now.corner, now.top))
    vertices[now.top] = raised(foot, corner, top, before)
    return Polygon(vertices)


@lru_cache(maxsize=256)  # an edited formula changes no shape
def inclined(shape: Polygon) -> float | None:
    """The angle at the foot of the triangle that a polygon is, radians; None for what is no incline."""
    triangle = triangle_in(shape)
    found = incline_of(triangle)
    return None if found is None else at_foot(triangle, found)


def at_foot(shape: Polygon, found: Incline) -> float:
    """The angle between base and long side, radians."""
    foot, corner, top = (shape.vertices[k] for k in (found.foot, found.corner, found.top))
    one, other = corner - foot, top - foot
    return abs(atan2(float(one[0] * other[1] - one[1] * other[0]), float(one @ other)))


def tilt(
    sketch: Sketch, angles: Mapping[str, float], touching: Touching, skipped: Container[str] = ()
) -> Step:
    """C3 on every right-angled triangle that an angle is said of (radians, by label), but those skipped."""
    after = sketch
    corrections: list[Correction] = []
    why = "its incline is given the angle that the page says it has"
    for label, angle in angles.items():
        if label not in skipped:
            follows = f"it keeps its place on {label}, whose incline is given its angle"
            shapes = _tilted(after, label, angle, touching)
            corrections += correction("C3", label, shapes_of(after), shapes, why, follows)
            after = reshaped(after, shapes)
    return Step(after, tuple(corrections))


def _tilted(sketch: Sketch, label: str, angle: float, touching: Touching) -> dict[str, Shape]:
    """New shapes of the incline and of all that goes with it; none where its angle is right already."""
    drawn = sketch.component(label).shape
    assert isinstance(drawn, Polygon)
    shape = triangle_in(drawn)
    found = incline_of(shape)
    if found is None:
        return {}
    foot, corner, top = (_point(shape.vertices[k]) for k in (found.foot, found.corner, found.top))
    new = raised(foot, corner, top, angle)
    by = _direction(foot, new) - _direction(foot, top)
    by = (by + pi) % (2 * pi) - pi
    slant = hypot(top[0] - foot[0], top[1] - foot[1])
    if abs(by) <= RULE.exact and hypot(new[0] - top[0], new[1] - top[1]) <= RULE.exact * slant:
        return {} if shape is drawn else {label: shape}
    vertices = shape.vertices.copy()
    vertices[found.top] = new
    places: dict[str, Place] = dict.fromkeys(
        _riders(sketch, label, shape, foot, top, touching()), turn(foot, by)
    )
    for part in sketch.components:
        if part.fixed and isinstance(part.shape, Circle):
            x, y = part.shape.centre
            if abs(hypot(x - top[0], y - top[1]) - part.shape.radius) <= RULE.top:
                places[part.label] = shift(new[0] - top[0], new[1] - top[1])
    held = frozenset(touching())
    # The two sides that meet in the corner span the plane; the top alone moves.
    shapes = taken_along(sketch, places | {label: _affine(foot, corner, top, new)}, held)
    return shapes | {label: Polygon(vertices)}


def _riders(
    sketch: Sketch,
    label: str,
    shape: Polygon,
    foot: Point,
    top: Point,
    touching: Mapping[str, frozenset[str]],
) -> list[str]:
    """Movable solids that rest on the long side, what rests on those, and so on."""
    slant = hypot(top[0] - foot[0], top[1] - foot[1])
    riders: list[str] = []
    for part in sketch.components:
        if part.fixed or part.label not in touching.get(label, ()):
            continue
        assert isinstance(part.shape, Circle | Polygon)
        _, (x, y) = apart(shape, part.shape)
        along = abs(x * (top[0] - foot[0]) + y * (top[1] - foot[1])) / slant
        if along <= sin(RULE.facing) and y < 0:
            riders.append(part.label)
    for rider in riders:  # grows as it goes
        for other in sorted(touching.get(rider, ())):
            if other not in riders and not sketch.component(other).fixed:
                riders.append(other)
    return riders


def _affine(foot: Point, corner: Point, top: Point, new: Point) -> Place:
    """The map of the plane that keeps foot and corner and brings the top to its new place. What lies below the base
    stays, and what lies higher than the top goes as far as the top: an end may have been drawn beside the triangle."""
    bx, by = corner[0] - foot[0], corner[1] - foot[1]
    tx, ty = top[0] - foot[0], top[1] - foot[1]
    twice = bx * ty - by * tx

    def placed(point: Point) -> Point:
        share = (bx * (point[1] - foot[1]) - by * (point[0] - foot[0])) / twice
        share = min(1.0, max(0.0, share))
        return point[0] + share * (new[0] - top[0]), point[1] + share * (new[1] - top[1])

    return placed


def _steepness(step: FloatArray) -> float:
    return abs(float(step[1])) / (hypot(step[0], step[1]) or 1.0)


def _direction(start: Point, end: Point) -> float:
    return atan2(end[1] - start[1], end[0] - start[0])


def _point(vertex: FloatArray) -> Point:
    return (float(vertex[0]), float(vertex[1]))
