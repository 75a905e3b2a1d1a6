"""What was corrected, and pages with parts moved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, assert_never

import numpy as np

from sketch.page import Component, Sketch
from sketch.shapes import Arrow, Circle, Point, Polygon, Shape, Spring, Wire

Rule = Literal["C1", "C2", "C3", "C4", "C5"]


@dataclass(frozen=True, slots=True)
class Correction:
    """rule: the row of the feature list; component: its label; why: a sentence for the student;
    before, after: its shape, page units."""

    rule: Rule
    component: str
    why: str
    before: Shape
    after: Shape


@dataclass(frozen=True, slots=True)
class Rectified:
    """A corrected page, and everything that was changed, in order."""

    sketch: Sketch
    corrections: tuple[Correction, ...]


Place = Callable[[Point], Point]
"""A motion of the plane, page units."""


def shift(dx: float, dy: float) -> Place:
    """Every point moved by (dx, dy)."""
    return lambda point: (point[0] + dx, point[1] + dy)


def turn(about: Point, angle: float) -> Place:
    """Every point turned about one, by an angle from +x towards +y (clockwise to the eye)."""
    cosine, sine = float(np.cos(angle)), float(np.sin(angle))

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


def reshaped(sketch: Sketch, shapes: dict[str, Shape]) -> Sketch:
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


def moved(sketch: Sketch, label: str, place: Place) -> Sketch:
    """The page with a solid moved; ends of springs and wires that are attached to it go along."""
    shapes: dict[str, Shape] = {}
    for part in sketch.components:
        if part.label == label:
            shapes[label] = carried(part.shape, place)
        elif isinstance(part.shape, Spring | Wire) and label in part.ends:
            start, end = part.shape.start, part.shape.end
            start = place(start) if part.ends[0] == label else start
            end = place(end) if part.ends[1] == label else end
            if start != end:
                shapes[part.label] = replace(part.shape, start=start, end=end)
    return reshaped(sketch, shapes)


def changes(
    rule: Rule, why: Callable[[Component], str], before: Sketch, after: Sketch
) -> tuple[Correction, ...]:
    """A correction for each component whose shape differs between two pages."""
    return tuple(
        Correction(rule, old.label, why(old), old.shape, new.shape)
        for old, new in zip(before.components, after.components, strict=True)
        if old.shape != new.shape
    )
