"""Many drawings at once: all their points in one array, so that features are sums over stretches of it.

A drawing is an `Ink` of one stroke or more. Frame of what comes in: page units, y down; `unit_sized`
gives every drawing's bounding box its centre at (0, 0) and its longer side the length 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sketch.ink import FloatArray, Ink

IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

STILL = 1e-12
"""A drawing no larger than this share of its coordinates is one spot: what it spans is their rounding."""


@dataclass(frozen=True, slots=True, eq=False)
class Paths:
    """Points of B drawings, end to end.

    points: (N, 2); stroke: (N,) the stroke of each point, numbered through all drawings; drawing: (N,) its
    drawing, 0 to B − 1; starts: (B,) the first point of each drawing; strokes: (B,) how many each has.
    """

    points: FloatArray
    stroke: IntArray
    drawing: IntArray
    starts: IntArray
    strokes: IntArray

    @property
    def count(self) -> int:
        return len(self.starts)

    @property
    def last(self) -> IntArray:
        """The last point of each drawing, (B,)."""
        return np.append(self.starts[1:], len(self.points)) - 1

    @property
    def sizes(self) -> IntArray:
        """How many points each drawing has, (B,)."""
        return np.diff(np.append(self.starts, len(self.points)))

    def box(self) -> tuple[FloatArray, FloatArray]:
        """(low, high) corners of each drawing's bounding box, (B, 2) each."""
        return (
            np.minimum.reduceat(self.points, self.starts, axis=0),
            np.maximum.reduceat(self.points, self.starts, axis=0),
        )

    def total(self, values: FloatArray, at: IntArray | None = None) -> FloatArray:
        """Sum of the values by drawing, (B,). `at`: the points they stand at; all points without."""
        of = self.drawing if at is None else self.drawing[at]
        return np.asarray(np.bincount(of, values, self.count), dtype=np.float64)

    def spans(self, gap: int = 1) -> IntArray:
        """The points i for which i + gap is a later point of the same stroke."""
        return np.flatnonzero(self.stroke[gap:] == self.stroke[:-gap])


def paths_of(drawings: Sequence[Ink]) -> Paths:
    """The drawings' points. Raises ValueError for a drawing without strokes."""
    bare = next((index for index, drawing in enumerate(drawings) if not len(drawing)), None)
    if bare is not None:
        raise ValueError(f"drawing {bare} has no stroke; each needs one at least")
    strokes = [stroke.points for drawing in drawings for stroke in drawing]
    many = np.array([len(drawing) for drawing in drawings], dtype=np.int64)
    return _assembled(
        np.concatenate([*strokes, np.empty((0, 2))]),
        np.array([len(points) for points in strokes], dtype=np.int64),
        many,
    )


def unit_sized(paths: Paths) -> Paths:
    """Each drawing about the origin, its longer side 1; one that never moved lies at the origin."""
    low, high = paths.box()
    size = (high - low).max(axis=1)
    still = size <= STILL * np.maximum(np.abs(low), np.abs(high)).max(axis=1)
    scale = np.where(still, 0.0, 1.0 / np.where(still, 1.0, size))
    at = paths.drawing
    return replace(paths, points=(paths.points - (0.5 * (low + high))[at]) * scale[at, None])


def evenly_spaced(paths: Paths, step: float, most: int) -> Paths:
    """Each stroke at equal spacing, ends kept, its points `step` apart or as near to that as divides it;
    drawings that would have more than about `most` points get a longer step. A stroke of no length is one point."""
    inside = paths.spans()
    apart = np.zeros(len(paths.points))
    apart[inside + 1] = np.hypot(*(paths.points[inside + 1] - paths.points[inside]).T)
    length = np.bincount(paths.stroke, apart)
    drawing = np.repeat(np.arange(paths.count), paths.strokes)
    whole = np.bincount(drawing, length, paths.count)
    steps = np.ceil(length / np.maximum(step, whole / most)[drawing] - 1e-9).astype(np.int64)
    # All strokes lie end to end on one line of arc length, with a gap of 1 between them.
    along = np.cumsum(apart) + paths.stroke
    begun = along[np.flatnonzero(np.diff(paths.stroke, prepend=-1))]
    number = steps + 1
    of = np.repeat(np.arange(len(number)), number)
    rank = np.arange(len(of)) - (np.cumsum(number) - number)[of]
    wanted = begun[of] + (length / np.maximum(steps, 1))[of] * rank
    points = np.column_stack([np.interp(wanted, along, paths.points[:, axis]) for axis in (0, 1)])
    return _assembled(points, number, paths.strokes)


def _assembled(points: FloatArray, lengths: IntArray, strokes: IntArray) -> Paths:
    """Points of strokes of these lengths, of which each drawing has so many."""
    stroke = np.repeat(np.arange(len(lengths)), lengths)
    drawing = np.repeat(np.arange(len(strokes)), strokes)[stroke]
    return Paths(points, stroke, drawing, np.flatnonzero(np.diff(drawing, prepend=-1)), strokes)
