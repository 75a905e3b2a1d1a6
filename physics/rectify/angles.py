"""C5: a spring or a wire gets the angle that the page says it has.

An angle tapped nearer to the link's top end is measured from the vertical, nearer to its bottom
end from the horizontal. The link turns about one of its ends; which end gives way is chosen so that the motion
is changed least:

- a body that hangs from this link alone, and rests on nothing, follows it about the other end, as a bob does,
  and what hangs from that body follows in turn;
- an end that is attached to nothing goes where the angle wants it;
- a body that several links hold, or that rests on something, stays where it is, or correcting one
  wire would slacken another: there the end at the fixed block slides along the block's boundary
  (the wire's length changes), and where the wire would miss the block, the block itself follows, as far as it
  must. A block is scenery: where exactly it stands changes nothing that anybody asked.

Where two links share such a block, correcting one turns the other; they are corrected in turns until
both are right, each time by the smallest shift, which leads to where their two lines meet.

Page units, y down.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass, replace
from math import atan2, cos, hypot, pi, sin

from physics.formula.names import number_said
from physics.parts.given import Spoken
from physics.rectify.contacts import Touching
from physics.rectify.correction import (
    Correction,
    Step,
    displacements,
    hangs,
    points_of,
    reshaped,
    shift,
    taken_along,
    turn,
)
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Point, Polygon, Shape, Solid, Spring, Wire


@dataclass(frozen=True, slots=True)
class AngleRule:
    """How far a correction may go."""

    exact: float = 1e-10
    """Radians: an angle this near is left alone."""
    slide: float = 0.35
    """Share of the link's length by which its end may slide along a block; beyond, the block follows."""
    rounds: int = 100
    """Over all links: two that share a block and meet at 20 degrees need 90 turns for 1e-10."""
    farthest: float = 1.0
    """Share of the longest such link by which anything may be moved: what must go farther was not drawn to be that."""


RULE = AngleRule()


@dataclass(frozen=True, slots=True)
class SaidAngle:
    """A link's angle, radians, as the page says it, and which end it was tapped nearer to: 0 the start, 1 the end."""

    angle: float
    near: int


@dataclass(frozen=True, slots=True)
class LinkAngle:
    """A link's angle, radians, as measured from the vertical (steep) or from the horizontal."""

    angle: float
    steep: bool

    def direction(self, dx: float, dy: float) -> Point:
        """The unit direction that has this angle, nearest in sense to (dx, dy)."""
        level, rise = (sin(self.angle), cos(self.angle)) if self.steep else (cos(self.angle), sin(self.angle))
        # One that is level or upright goes down to the right, whichever of its ends was drawn first.
        right, down = (dx or dy) >= 0, (dy or dx) >= 0
        return (level if right else -level), (rise if down else -rise)


def said_of(sketch: Sketch, spoken: Spoken, part: Component) -> SaidAngle | None:
    """What the page says of a link's angle, None where it says nothing that can be."""
    said = spoken.of(part, "angle")
    if said is None or said.anchor is None or not isinstance(part.shape, Spring | Wire):
        return None
    angle = number_said(sketch, spoken.meanings, said)
    if angle is None or not 0 <= angle <= pi / 2:
        return None
    away = [hypot(said.anchor[0] - x, said.anchor[1] - y) for x, y in points_of(part.shape)]
    return SaidAngle(angle, 0 if away[0] < away[1] else 1)


def _measured(said: SaidAngle, shape: Shape) -> LinkAngle:
    """The angle of a link as it lies. Where neither end is the top one, it is measured so that the link may lie
    as it does."""
    ends = points_of(shape)
    (x, y), (u, v) = ends[said.near], ends[1 - said.near]
    level = abs(v - y) <= RULE.exact * hypot(u - x, v - y)
    return LinkAngle(said.angle, steep=said.angle > pi / 4 if level else y < v)


def drawn_at(sketch: Sketch, spoken: Spoken, part: Component) -> float | None:
    """The angle at which a link lies, radians, measured as the one that is said of it; None where none is."""
    said = said_of(sketch, spoken, part)
    if said is None:
        return None
    (x1, y1), (x2, y2) = points_of(part.shape)
    level, rise = abs(x2 - x1), abs(y2 - y1)
    return atan2(level, rise) if _measured(said, part.shape).steep else atan2(rise, level)


def angles_of(sketch: Sketch, spoken: Spoken) -> dict[str, SaidAngle]:
    """What the page says of the angles of its links, by label. One within a single body cannot turn."""
    found: dict[str, SaidAngle] = {}
    for part in sketch.components:
        if isinstance(part.shape, Spring | Wire) and (part.ends[0] is None or part.ends[0] != part.ends[1]):
            said = said_of(sketch, spoken, part)
            if said is not None:
                found[part.label] = said
    return found


def aim(
    sketch: Sketch, said: Mapping[str, SaidAngle], touching: Touching, skipped: Container[str] = ()
) -> Step:
    """C5 on every spring and wire that an angle is said of, but those skipped.

    Where not all can have their angles, the one that is farthest from its own is given up, and then the next.
    """
    wanted = {
        label: _measured(one, sketch.component(label).shape)
        for label, one in said.items()
        if label not in skipped
    }
    while wanted:
        turned = _turned(sketch, wanted, touching)
        if turned is not None:
            return Step(turned[0], _corrections(sketch, *turned))
        del wanted[max(wanted, key=lambda label: (abs(_off(sketch, label, wanted[label])), label))]
    return Step(sketch)


def no_worse(
    before: Sketch, clipped: Sketch, label: str, said: SaidAngle, held: Container[str]
) -> dict[str, Shape]:
    """What else must change so that a link's angle is no farther from what is said of it after clipping than it was
    before: it then keeps the angle that it was drawn with."""
    start, end = points_of(before.component(label).shape)
    dx, dy = end[0] - start[0], end[1] - start[1]
    wanted = _measured(said, before.component(label).shape)
    if abs(_off(clipped, label, wanted)) <= abs(_between(wanted, dx, dy)) + RULE.exact:
        return {}
    return _aimed(clipped, label, LinkAngle(atan2(abs(dx), abs(dy)), steep=True), held)


def _turned(
    sketch: Sketch, wanted: Mapping[str, LinkAngle], touching: Touching
) -> tuple[Sketch, dict[str, str]] | None:
    """(the page with these angles, for each component that was changed the link on whose account); None where they
    cannot be had."""
    after = sketch
    causes: dict[str, str] = {}
    for _ in range(RULE.rounds):
        before = after
        for label, said in sorted(wanted.items()):
            if abs(_off(after, label, said)) <= RULE.exact:
                continue
            shapes = _aimed(after, label, said, frozenset(touching()))
            after = reshaped(after, shapes)
            causes |= dict.fromkeys(shapes, label) | {label: label}
        if after is before:
            break
    else:
        return None
    if causes:
        longest = max(_length(sketch, label) for label in wanted)
        moves = displacements(sketch, after).values()
        if max((max(ways) for ways in moves), default=0.0) > RULE.farthest * longest:
            return None
    return after, causes


def _length(sketch: Sketch, label: str) -> float:
    start, end = points_of(sketch.component(label).shape)
    return hypot(end[0] - start[0], end[1] - start[1])


def _corrections(before: Sketch, after: Sketch, causes: Mapping[str, str]) -> tuple[Correction, ...]:
    """One correction for each component that has changed, that of a link before those of what follows it."""
    found: list[Correction] = []
    for old, new in zip(before.components, after.components, strict=True):
        if old.shape != new.shape:
            cause = causes[old.label]
            own = f"{old.label}: it is given the angle that the page says it has."
            follows = f"{old.label}: it follows {cause}, which is given its angle."
            why = own if cause == old.label else follows
            found.append(Correction("C5", old.label, why, old.shape, new.shape, cause))
    return tuple(sorted(found, key=lambda one: (one.cause, one.component != one.cause, one.component)))


def _off(sketch: Sketch, label: str, said: LinkAngle) -> float:
    """By how much a link must be turned, radians."""
    shape = sketch.component(label).shape
    assert isinstance(shape, Spring | Wire)
    return _between(said, shape.end[0] - shape.start[0], shape.end[1] - shape.start[1])


def _between(said: LinkAngle, dx: float, dy: float) -> float:
    """By how much a direction must be turned to have this angle, radians."""
    ux, uy = said.direction(dx, dy)
    return atan2(dx * uy - dy * ux, dx * ux + dy * uy)


def _aimed(sketch: Sketch, label: str, said: LinkAngle, held: Container[str]) -> dict[str, Shape]:
    """New shapes of a link with its angle, and of what follows it."""
    part = sketch.component(label)
    shape = part.shape
    assert isinstance(shape, Spring | Wire)
    yielding = _yielding(sketch, part, held)
    still, end = (shape.end, shape.start) if yielding == 0 else (shape.start, shape.end)
    dx, dy = end[0] - still[0], end[1] - still[1]
    length = hypot(dx, dy)
    ux, uy = said.direction(dx, dy)
    goal = (still[0] + length * ux, still[1] + length * uy)
    holder = part.ends[yielding]
    if holder is None:
        return _with_end(part, yielding, goal)
    solid = sketch.component(holder)
    assert isinstance(solid.shape, Circle | Polygon)
    if hangs(sketch, holder, label, held):
        place = turn(still, atan2(dx * uy - dy * ux, dx * ux + dy * uy))
        if isinstance(solid.shape, Polygon):
            place = shift(goal[0] - end[0], goal[1] - end[1])
        return taken_along(sketch, {holder: place}, held)
    hit = _first_hit(solid.shape, still, (ux, uy))
    if hit is not None and hypot(hit[0] - end[0], hit[1] - end[1]) <= RULE.slide * length:
        return _with_end(part, yielding, hit)
    along = dx * ux + dy * uy
    nearest = shift(still[0] + along * ux - end[0], still[1] + along * uy - end[1])
    return taken_along(sketch, {holder: nearest}, held)


def _yielding(sketch: Sketch, part: Component, held: Container[str]) -> int:
    """Which end gives way: 0 the start, 1 the end. Of two alike the lower one, then the right one: which of
    them was drawn first says nothing."""
    assert isinstance(part.shape, Spring | Wire)

    def firmness(label: str | None) -> int:
        if label is None:
            return 1
        if sketch.component(label).fixed:
            return 2
        return 0 if hangs(sketch, label, part.label, held) else 3

    one, other = firmness(part.ends[0]), firmness(part.ends[1])
    (x1, y1), (x2, y2) = part.shape.start, part.shape.end
    return 0 if (one, -y1, -x1) < (other, -y2, -x2) else 1


def _with_end(part: Component, which: int, place: Point) -> dict[str, Shape]:
    assert isinstance(part.shape, Spring | Wire)
    start, end = (place, part.shape.end) if which == 0 else (part.shape.start, place)
    return {} if start == end else {part.label: replace(part.shape, start=start, end=end)}


def _first_hit(solid: Solid, origin: Point, direction: Point) -> Point | None:
    """Where a ray from outside first meets a solid's boundary."""
    ux, uy = direction
    if isinstance(solid, Circle):
        x, y = origin[0] - solid.centre[0], origin[1] - solid.centre[1]
        half = x * ux + y * uy
        root = half * half - (x * x + y * y - solid.radius**2)
        distances = [-half - root**0.5] if root >= 0 else []
    else:
        distances = []
        vertices = solid.vertices.tolist()
        for (x1, y1), (x2, y2) in zip(vertices, vertices[1:] + vertices[:1], strict=True):
            ex, ey = x2 - x1, y2 - y1
            cross = ux * ey - uy * ex
            if cross == 0:
                continue
            x, y = x1 - origin[0], y1 - origin[1]
            if 0 <= (x * uy - y * ux) / cross <= 1:
                distances.append((x * ey - y * ex) / cross)
    ahead = [distance for distance in distances if distance > 0]
    return (origin[0] + min(ahead) * ux, origin[1] + min(ahead) * uy) if ahead else None
