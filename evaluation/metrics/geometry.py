"""How far the claimed shapes lie from the true ones.

Lengths are fractions of the diagram's size (the diagonal of the box around its true components,
page units), angles are degrees. Only pairs of one kind are compared; the others are counted.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from evaluation.metrics.matching import match_components
from sketch.geometry import centroid, diagonal
from sketch.ink import FloatArray
from sketch.page import Sketch
from sketch.shapes import Arrow, Circle, Polygon, Shape, Spring, Wire, outline


@dataclass(frozen=True, slots=True)
class ShapeError:
    """Errors of one claimed shape, None where the kind has no such measure.

    centre: between the centres (circles, polygons); radius: |difference| (circles); vertex: mean
    distance of corresponding vertices (polygons; ends of springs, wires and arrows), None when a
    polygon has another number of vertices; angle: mean |difference| of a polygon's interior angles,
    or of the direction of a spring, wire or arrow, degrees.
    """

    centre: float | None = None
    radius: float | None = None
    vertex: float | None = None
    angle: float | None = None


@dataclass(frozen=True, slots=True)
class GeometryError:
    """Means over the compared pairs, None where no pair has the measure. compared: pairs of one
    kind; missing: true components without a counterpart of their kind; surplus: claimed ones
    without; miscounted: polygons with another number of vertices."""

    centre: float | None
    radius: float | None
    vertex: float | None
    angle: float | None
    compared: int
    missing: int
    surplus: int
    miscounted: int


def geometry_error(truth: Sketch, claim: Sketch) -> GeometryError:
    """Mean errors of the claimed shapes that were taken for the right kind."""
    size = diagram_size(truth)
    errors: list[ShapeError] = []
    miscounted = 0
    for a, b in match_components(truth, claim).items():
        true, claimed = truth.component(a).shape, claim.component(b).shape
        if type(true) is type(claimed):
            error = shape_error(true, claimed, size)
            miscounted += error.vertex is None and isinstance(true, Polygon)
            errors.append(error)
    return GeometryError(
        centre=_mean(error.centre for error in errors),
        radius=_mean(error.radius for error in errors),
        vertex=_mean(error.vertex for error in errors),
        angle=_mean(error.angle for error in errors),
        compared=len(errors),
        missing=len(truth.components) - len(errors),
        surplus=len(claim.components) - len(errors),
        miscounted=miscounted,
    )


def diagram_size(sketch: Sketch) -> float:
    """Diagonal of the box around all components, page units; 1 when there is none."""
    if not sketch.components:
        return 1.0
    return diagonal(np.concatenate([outline(component.shape) for component in sketch.components]))


def shape_error(truth: Shape, claim: Shape, size: float) -> ShapeError:
    """Errors of one shape against another of its kind. Raises TypeError when the kinds differ."""
    match truth, claim:
        case Circle(), Circle():
            return ShapeError(
                centre=float(np.hypot(*np.subtract(claim.centre, truth.centre))) / size,
                radius=abs(claim.radius - truth.radius) / size,
            )
        case Polygon(), Polygon():
            apart = centroid(claim.vertices) - centroid(truth.vertices)
            return _aligned(truth.vertices, claim.vertices, float(np.linalg.norm(apart)) / size, size)
        case (Spring(), Spring()) | (Wire(), Wire()):
            return min(
                (_ends(truth, claim.start, claim.end, size), _ends(truth, claim.end, claim.start, size)),
                key=lambda error: error.vertex or 0.0,
            )
        case Arrow(), Arrow():
            return _ends(truth, claim.start, claim.end, size)
        case _:
            raise TypeError(f"a {type(truth).__name__} cannot be compared with a {type(claim).__name__}")


def _aligned(true: FloatArray, claimed: FloatArray, centre: float, size: float) -> ShapeError:
    """Polygons' vertices correspond in the order, direction and start that fit best."""
    if len(true) != len(claimed):
        return ShapeError(centre=centre)
    orders = [np.roll(way, turn, axis=0) for way in (claimed, claimed[::-1]) for turn in range(len(claimed))]
    best = min(orders, key=lambda order: float(np.linalg.norm(order - true, axis=1).mean()))
    return ShapeError(
        centre=centre,
        vertex=float(np.linalg.norm(best - true, axis=1).mean()) / size,
        angle=float(np.degrees(np.abs(_interior(best) - _interior(true)).mean())),
    )


def _interior(vertices: FloatArray) -> FloatArray:
    """Unsigned angle between the two sides at each vertex, radians, (n,)."""
    back = np.roll(vertices, 1, axis=0) - vertices
    ahead = np.roll(vertices, -1, axis=0) - vertices
    cross = back[:, 0] * ahead[:, 1] - back[:, 1] * ahead[:, 0]
    return np.abs(np.arctan2(cross, np.einsum("ij,ij->i", back, ahead)))


def _ends(
    true: Spring | Wire | Arrow, start: tuple[float, float], end: tuple[float, float], size: float
) -> ShapeError:
    gaps = np.linalg.norm([np.subtract(start, true.start), np.subtract(end, true.end)], axis=1)
    wanted, found = np.subtract(true.end, true.start), np.subtract(end, start)
    cross = float(wanted[0] * found[1] - wanted[1] * found[0])
    return ShapeError(
        vertex=float(gaps.mean()) / size,
        angle=float(np.degrees(abs(np.arctan2(cross, float(wanted @ found))))),
    )


def _mean(values: Iterable[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.mean(known)) if known else None
