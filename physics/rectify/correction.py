"""What was corrected, and how parts of a page move together. Page units, y down."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field, replace
from math import cos, hypot, sin
from typing import Literal, assert_never

from physics.formula.meaning import Meanings
from sketch.page import Association, Sketch
from sketch.shapes import Arrow, Circle, Point, Polygon, Shape, Spring, Wire

Rule = Literal["C1", "C2", "C3", "C4", "C5"]
RULES: tuple[Rule, ...] = ("C1", "C2", "C3", "C4", "C5")
Key = tuple[Rule, str]
"""What a correction is known by, however often a page is corrected: its rule, and the label of the
component that the rule was applied to."""


@dataclass(frozen=True, slots=True)
class Correction:
    """rule: the row of the feature list; component: its label; why: a sentence for the student;
    before, after: its shape, page units; cause: the component that the rule was applied to, which is
    another one where this one only follows it."""

    rule: Rule
    component: str
    why: str
    before: Shape
    after: Shape
    cause: str

    @property
    def key(self) -> Key:
        """Corrections of one key belong together: they are made and undone as one."""
        return self.rule, self.cause


@dataclass(frozen=True, slots=True)
class Step:
    """A page after one rule, and what the rule changed, in order."""

    sketch: Sketch
    corrections: tuple[Correction, ...] = ()


@dataclass(frozen=True, slots=True)
class Rectified:
    """A corrected page, and everything that was changed, in order.

    drawn: the page as it was; without: the corrections that were not to be made; meanings: what the page says,
    which correction does not change.
    """

    sketch: Sketch
    corrections: tuple[Correction, ...]
    drawn: Sketch
    without: frozenset[Key]
    meanings: Meanings = field(compare=False)

    @property
    def displacement(self) -> float:
        """The way of all vertices, centres and ends from where they were drawn, summed, page units."""
        return sum(sum(moves) for moves in displacements(self.drawn, self.sketch).values())

    @property
    def farthest(self) -> float:
        """The longest such way, page units."""
        return max((max(moves) for moves in displacements(self.drawn, self.sketch).values()), default=0.0)


def displacements(before: Sketch, after: Sketch) -> dict[str, tuple[float, ...]]:
    """How far each vertex, centre or end of each component that changed has come, page units.

    Where a polygon has been given other vertices than it had, each counts from the nearest old one.
    """
    found: dict[str, tuple[float, ...]] = {}
    for old, new in zip(before.components, after.components, strict=True):
        if old.shape != new.shape:
            found[old.label] = _ways(old.shape, new.shape)
    return found


def _ways(old: Shape, new: Shape) -> tuple[float, ...]:
    here, there = points_of(old), points_of(new)
    if len(here) == len(there):
        straight = [hypot(x - u, y - v) for (x, y), (u, v) in zip(here, there, strict=True)]
        # Vertices may run the other way round now, from the same first one.
        back = [hypot(x - u, y - v) for (x, y), (u, v) in zip([here[0], *here[:0:-1]], there, strict=True)]
        return tuple(min(straight, back, key=sum) if isinstance(old, Polygon) else straight)
    return tuple(min(hypot(x - u, y - v) for x, y in here) for u, v in there)


def points_of(shape: Shape) -> list[Point]:
    """A shape's vertices, its centre or its ends, page units."""
    match shape:
        case Circle():
            return [shape.centre]
        case Polygon():
            return [(x, y) for x, y in shape.vertices.tolist()]
        case Spring() | Wire() | Arrow():
            return [shape.start, shape.end]
        case _:
            assert_never(shape)


Place = Callable[[Point], Point]
"""A motion of the plane, page units."""


def shift(dx: float, dy: float) -> Place:
    """Every point moved by (dx, dy)."""
    return lambda point: (point[0] + dx, point[1] + dy)


def turn(about: Point, angle: float) -> Place:
    """Every point turned about one, by an angle from +x towards +y (clockwise to the eye)."""
    cosine, sine = cos(angle), sin(angle)

    def moved(point: Point) -> Point:
        x, y = point[0] - about[0], point[1] - about[1]
        return about[0] + cosine * x - sine * y, about[1] + sine * x + cosine * y

    return moved


def carried(shape: Shape, place: Place) -> Shape:
    """The shape after the motion."""
    match shape:
        case Circle():
            return replace(shape, centre=place(shape.centre))
        case Polygon():
            return Polygon([place((x, y)) for x, y in shape.vertices.tolist()])
        case Spring() | Wire() | Arrow():
            return replace(shape, start=place(shape.start), end=place(shape.end))
        case _:
            assert_never(shape)


def reshaped(sketch: Sketch, shapes: Mapping[str, Shape]) -> Sketch:
    """The page with the shapes of some components replaced."""
    if not shapes:
        return sketch
    return replace(
        sketch,
        components=tuple(
            replace(part, shape=shapes[part.label]) if part.label in shapes else part
            for part in sketch.components
        ),
    )


def taken_along(sketch: Sketch, places: Mapping[str, Place], held: Container[str]) -> dict[str, Shape]:
    """New shapes where solids are moved, each by its own motion: of themselves, of the ends of links that are
    attached to them, and of what hangs from them, which keeps its place below.

    held: solids that do not follow a link, since they rest on something.
    """
    parts = {part.label: part for part in sketch.components}
    links = [part for part in sketch.components if isinstance(part.shape, Spring | Wire)]
    places = dict(places)
    waiting = list(places)
    while waiting:
        label = waiting.pop(0)
        for link in links:
            if label not in link.ends:
                continue
            assert isinstance(link.shape, Spring | Wire)
            near = 0 if link.ends[0] == label else 1
            hung = link.ends[1 - near]
            if hung is None or hung in places or not hangs(sketch, hung, link.label, held):
                continue
            end = link.shape.start if near == 0 else link.shape.end
            there = places[label](end)
            places[hung] = shift(there[0] - end[0], there[1] - end[1])
            waiting.append(hung)
    found: dict[str, Shape] = {label: carried(parts[label].shape, place) for label, place in places.items()}
    for link in links:
        if link.ends[0] in places or link.ends[1] in places:
            assert isinstance(link.shape, Spring | Wire)
            start, end = (
                place(point) if (place := places.get(label or "")) is not None else point
                for point, label in zip((link.shape.start, link.shape.end), link.ends, strict=True)
            )
            if start != end:
                found[link.label] = replace(link.shape, start=start, end=end)
    return {label: shape for label, shape in found.items() if shape != parts[label].shape}


def hangs(sketch: Sketch, label: str, by: str, held: Container[str]) -> bool:
    """Whether a solid hangs from a link (by), with all that other links join to it: nothing of that is fixed, rests
    on something (held), or is pinned to the page by a free end."""
    links = [part for part in sketch.components if isinstance(part.shape, Spring | Wire) and part.label != by]
    fixed = {part.label for part in sketch.components if part.fixed}
    reached = [label]
    for one in reached:  # grows as it goes
        if one in fixed or one in held:
            return False
        for link in links:
            if one in link.ends:
                other = link.ends[1] if link.ends[0] == one else link.ends[0]
                if other is None:
                    return False
                if other not in reached:
                    reached.append(other)
    return True


def correction(
    rule: Rule, cause: str, before: Mapping[str, Shape], after: Mapping[str, Shape], why: str, follows: str
) -> tuple[Correction, ...]:
    """What one use of a rule has changed, the cause itself first. why: of the cause; follows: of all others."""
    return tuple(
        Correction(
            rule,
            label,
            f"{label}: {why if label == cause else follows}.",
            before[label],
            after[label],
            cause,
        )
        for label in sorted(after, key=lambda label: (label != cause, label))
        if before[label] != after[label]
    )


def with_anchors(before: Sketch, after: Sketch) -> Sketch:
    """The corrected page with what was tapped on its links where it was on them: an angle tapped near an end is one
    near that end still."""
    anchors: list[Association] = []
    for one in after.associations:
        old, new = before.component(one.component).shape, after.component(one.component).shape
        if isinstance(old, Spring | Wire) and isinstance(new, Spring | Wire) and old != new:
            (x1, y1), (x2, y2) = old.start, old.end
            dx, dy = x2 - x1, y2 - y1
            length2 = dx * dx + dy * dy
            along = ((one.anchor[0] - x1) * dx + (one.anchor[1] - y1) * dy) / length2
            beside = ((one.anchor[1] - y1) * dx - (one.anchor[0] - x1) * dy) / length2
            (x1, y1), (x2, y2) = new.start, new.end
            dx, dy = x2 - x1, y2 - y1
            one = replace(one, anchor=(x1 + along * dx - beside * dy, y1 + along * dy + beside * dx))
        anchors.append(one)
    associations = tuple(anchors)
    return after if associations == after.associations else replace(after, associations=associations)


def shapes_of(sketch: Sketch) -> dict[str, Shape]:
    """Every component's shape, by label."""
    return {part.label: part.shape for part in sketch.components}
