"""The ideal shapes that a page can hold, as plain values.

Frame: page units, y down. Nothing here knows of masses or ink; what a shape weighs is
physics' business, how it was drawn the recognizer's.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import Literal, assert_never

import numpy as np
from numpy.typing import ArrayLike

from sketch.ink import FloatArray, readonly

ComponentKind = Literal["circle", "polygon", "spring", "wire", "arrow"]
COMPONENT_KINDS: tuple[ComponentKind, ...] = ("circle", "polygon", "spring", "wire", "arrow")

Point = tuple[float, float]


class ShapeError(ValueError):
    """A shape that cannot be: a radius of zero, two corners, a spring of no length."""


@dataclass(frozen=True, slots=True)
class Circle:
    """centre: page units; radius > 0: page units."""

    centre: Point
    radius: float

    def __post_init__(self) -> None:
        _finite(self, *self.centre, self.radius)
        if self.radius <= 0:
            raise ShapeError(f"a circle of radius {self.radius:g}; it must be above zero")


@dataclass(frozen=True, slots=True, eq=False)
class Polygon:
    """vertices: (n, 2) page units, n >= 3, in drawing order, first not repeated at the end."""

    vertices: FloatArray

    def __init__(self, vertices: ArrayLike) -> None:
        array = readonly(vertices)
        if array.ndim != 2 or array.shape[1] != 2 or len(array) < 3:
            raise ShapeError(f"polygon vertices have shape {array.shape}; needed is (n, 2) with n at least 3")
        _finite(self, *array.ravel().tolist())
        object.__setattr__(self, "vertices", array)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Polygon) and self.vertices.tobytes() == other.vertices.tobytes()

    def __hash__(self) -> int:
        return hash(self.vertices.tobytes())

    def __reduce__(self) -> tuple[type[Polygon], tuple[FloatArray]]:
        return Polygon, (self.vertices,)


@dataclass(frozen=True, slots=True)
class Spring:
    """A spring from start to end (page units). Its length as drawn is its rest length.

    coils: turns or teeth as drawn; width: peak to peak across the axis, page units.
    """

    start: Point
    end: Point
    coils: float
    width: float

    def __post_init__(self) -> None:
        _finite(self, *self.start, *self.end, self.coils, self.width)
        _apart(self.start, self.end, "spring")


@dataclass(frozen=True, slots=True)
class Wire:
    """An inextensible wire from start to end (page units)."""

    start: Point
    end: Point

    def __post_init__(self) -> None:
        _finite(self, *self.start, *self.end)
        _apart(self.start, self.end, "wire")


@dataclass(frozen=True, slots=True)
class Arrow:
    """An annotation arrow from its tail (start) to its tip (end), page units."""

    start: Point
    end: Point

    def __post_init__(self) -> None:
        _finite(self, *self.start, *self.end)
        _apart(self.start, self.end, "arrow")


Solid = Circle | Polygon
Link = Spring | Wire
Shape = Circle | Polygon | Spring | Wire | Arrow


def kind_of(shape: Shape) -> ComponentKind:
    """The kind's name, as claims and files spell it."""
    match shape:
        case Circle():
            return "circle"
        case Polygon():
            return "polygon"
        case Spring():
            return "spring"
        case Wire():
            return "wire"
        case Arrow():
            return "arrow"
        case _:
            assert_never(shape)


def outline(shape: Shape, steps: int = 64) -> FloatArray:
    """A polyline along the shape, (n, 2) page units; closed shapes end where they began."""
    match shape:
        case Circle(centre, radius):
            angle = np.append(np.arange(steps) * (2 * np.pi / steps), 0.0)
            return np.asarray(centre) + radius * np.column_stack([np.cos(angle), np.sin(angle)])
        case Polygon():
            return np.concatenate([shape.vertices, shape.vertices[:1]])
        case Spring() | Wire() | Arrow():
            return np.array([shape.start, shape.end])
        case _:
            assert_never(shape)


def _finite(shape: object, *values: float) -> None:
    if not all(map(isfinite, values)):
        name = type(shape).__name__.lower()
        raise ShapeError(f"the {name} has a coordinate that is not a finite number")


def _apart(start: Point, end: Point, name: str) -> None:
    if start == end:
        article = "an" if name == "arrow" else "a"
        raise ShapeError(
            f"{article} {name} of no length at ({start[0]:g}, {start[1]:g}); its ends must differ"
        )
