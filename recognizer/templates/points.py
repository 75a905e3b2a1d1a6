"""What the template matchers share: a drawing as n points, and numbers about them.

Frame: page units, y down, as the pen left it; each matcher moves, turns and scales as its paper says.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from sketch.geometry import resample
from sketch.ink import FloatArray, Ink

IntArray = NDArray[np.int64]


class Matcher(Protocol):
    """A paper's way to compare a drawing with templates that it remembers."""

    @classmethod
    def of(cls, templates: Sequence[Ink], labels: IntArray) -> Self:
        """One that remembers T templates, each with a label (T,) of 0 to K − 1; each label occurs."""
        ...

    def nearest(self, drawings: Sequence[Ink]) -> FloatArray:
        """The distance of B drawings to the nearest template of each label, (B, K), 0 or more."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Compared(ABC):
    """A matcher that compares a drawing, described by points, with every template alike. templates: (T, n, 2) described;
    labels: (T,)."""

    templates: FloatArray
    labels: IntArray

    @staticmethod
    @abstractmethod
    def described(drawings: Sequence[Ink]) -> FloatArray:
        """Drawings as the paper compares them, (B, n, 2)."""

    @staticmethod
    @abstractmethod
    def apart(drawings: FloatArray, templates: FloatArray) -> FloatArray:
        """The distance of every described drawing to every template, (B, T)."""

    @classmethod
    def of(cls, templates: Sequence[Ink], labels: IntArray) -> Self:
        return cls(cls.described(templates), labels)

    def nearest(self, drawings: Sequence[Ink]) -> FloatArray:
        return by_label(self.distances(drawings), self.labels)

    def distances(self, drawings: Sequence[Ink]) -> FloatArray:
        """To every template, (B, T)."""
        return self.apart(self.described(drawings), self.templates)


def as_one_stroke(drawings: Sequence[Ink], count: int) -> FloatArray:
    """`count` points at equal spacing on each drawing, its strokes joined end to start: (B, count, 2)."""
    return np.array([resample(_joined(drawing), count) for drawing in drawings], dtype=np.float64).reshape(
        -1, count, 2
    )


def as_cloud(drawings: Sequence[Ink], count: int) -> FloatArray:
    """`count` points at equal spacing on the ink of each drawing, none where the pen was lifted: (B, count, 2)."""
    return np.array([_spread(drawing, count) for drawing in drawings], dtype=np.float64).reshape(-1, count, 2)


def centred(points: FloatArray) -> FloatArray:
    """Each set of points, (B, n, 2), about its centroid."""
    return points - points.mean(axis=1, keepdims=True)


def box_sides(points: FloatArray) -> FloatArray:
    """Width and height of each set of points, (B, 2); a side that is rounding beside the other is 0."""
    sides = points.max(axis=1) - points.min(axis=1)
    return np.where(sides > 1e-9 * sides.max(axis=1, keepdims=True), sides, 0.0)


def positive(values: FloatArray) -> FloatArray:
    """The values, 1 in place of 0, to divide by."""
    return np.where(values > 0, values, 1.0)


def indicative_angle(points: FloatArray) -> FloatArray:
    """The direction from each first point to the centroid, radians, (B,)."""
    towards = points.mean(axis=1) - points[:, 0]
    return np.arctan2(towards[:, 1], towards[:, 0])


def turned(points: FloatArray, angles: FloatArray) -> FloatArray:
    """Points about the origin, (B, n, 2), turned from +x towards +y by the angles (B,)."""
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x, y = points[..., 0], points[..., 1]
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=2)


def directions(points: FloatArray) -> FloatArray:
    """The unit vectors between neighbouring points, (B, n − 1, 2); 0 where two are one."""
    steps = points[:, 1:] - points[:, :-1]
    return steps / positive(np.hypot(steps[..., 0], steps[..., 1]))[..., None]


def by_label(distances: FloatArray, labels: IntArray) -> FloatArray:
    """From distances to each template (B, T) those to the nearest of each label (B, K)."""
    order = np.argsort(labels, kind="stable")
    starts = np.flatnonzero(np.diff(labels[order], prepend=-1))
    return np.minimum.reduceat(distances[:, order], starts, axis=1)


def _joined(drawing: Ink) -> FloatArray:
    points = drawing[0].points if len(drawing) == 1 else drawing.points_of(range(len(drawing)))
    return points - points[0]


def _spread(drawing: Ink, count: int) -> FloatArray:
    if len(drawing) == 1:
        return resample(_joined(drawing), count)
    points = _joined(drawing)
    apart = np.hypot(*np.diff(points, axis=0, prepend=points[:1]).T)
    apart[np.cumsum([len(stroke) for stroke in drawing])[:-1]] = 0.0  # the pen was up
    travelled = np.cumsum(apart)
    wanted = np.linspace(0.0, travelled[-1], count)
    return np.column_stack([np.interp(wanted, travelled, points[:, axis]) for axis in (0, 1)])
