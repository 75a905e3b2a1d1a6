"""How far a gesture is from the way its writers usually make it: the relative-accuracy measures of GREAT.

Vatavu, Anthony and Wobbrock, "Relative accuracy measures for stroke gestures", ICMI 2013. A task axis is the mean of all
drawings of a gesture, point by point; each drawing is then compared with it. Geometry: shape error and variability (distances),
length, size, bending error and variability (turning angles). Time: time error and variability, speed error and variability.
Articulation: the count of strokes, and their order, as the distance by the drawn order less that by the best order ($P's).

Frame: each drawing resampled to `N` points over all its strokes, its centroid moved to the origin; page units, seconds,
radians. Time measures are None where any drawing has no times.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from sketch.geometry import path_length
from sketch.ink import FloatArray, Ink

N = 32
"""Points of a drawing: the paper's."""


@dataclass(frozen=True, slots=True)
class RelativeAccuracy:
    """One drawing against the task axis of its gesture. Errors of length, size, time and strokes are signed: above 0 when the
    drawing has more than the axis."""

    shape_error: float
    shape_variability: float
    length_error: float
    size_error: float
    bending_error: float
    bending_variability: float
    time_error: float | None
    time_variability: float | None
    speed_error: float | None
    speed_variability: float | None
    stroke_error: float
    order_error: float


@dataclass(frozen=True, slots=True, eq=False)
class TaskAxis:
    """The mean of all drawings of a gesture. points: (N, 2); times: (N,) seconds from the start, speeds: (N − 1,), None where a
    drawing has no times; turns: (N − 2,); strokes: mean count."""

    points: FloatArray
    times: FloatArray | None
    strokes: float

    @property
    def turns(self) -> FloatArray:
        return turning(self.points)


def task_axis(drawings: Sequence[Ink], points: int = N) -> TaskAxis:
    """The axis of drawings of one gesture, each with ink. Points correspond by the order of drawing for gestures that all are
    drawn in one stroke; otherwise each drawing's points are first matched to the first drawing's by the least total distance, as
    the paper does by $P. Raises ValueError for no drawing, or one without ink."""
    if not drawings or any(not len(ink) for ink in drawings):
        raise ValueError("a task axis needs drawings, each with one stroke at least")
    spread = [resampled(ink, points) for ink in drawings]
    single = all(len(ink) == 1 for ink in drawings)
    first = spread[0][0]
    aligned = [one if single else one[_matching(first, one)] for one, _ in spread]
    clocks = [clock for _, clock in spread]
    times = (
        None
        if any(clock is None for clock in clocks)
        else np.mean([c for c in clocks if c is not None], axis=0)
    )
    return TaskAxis(np.mean(aligned, axis=0), times, float(np.mean([len(ink) for ink in drawings])))


def relative_accuracy(drawing: Ink, axis: TaskAxis) -> RelativeAccuracy:
    """All measures of one drawing. Raises ValueError for one without ink."""
    count = len(axis.points)
    drawn, clock = resampled(drawing, count)
    order = _matching(axis.points, drawn)
    by_order = np.linalg.norm(drawn - axis.points, axis=1)
    matched = np.linalg.norm(drawn[order] - axis.points, axis=1)
    apart = by_order if len(drawing) == 1 and axis.strokes == 1 else matched
    bends = np.abs(_wrapped(turning(drawn) - axis.turns))
    timed = clock is not None and axis.times is not None
    late = clock - axis.times if clock is not None and axis.times is not None else np.zeros(1)
    hasty = speeds(drawn, clock) - speeds(axis.points, axis.times) if timed else np.zeros(1)
    return RelativeAccuracy(
        shape_error=float(apart.mean()),
        shape_variability=float(apart.std()),
        length_error=path_length(drawn) - path_length(axis.points),
        size_error=_area(drawn) - _area(axis.points),
        bending_error=float(bends.mean()),
        bending_variability=float(bends.std()),
        time_error=float(late[-1]) if timed else None,
        time_variability=float(np.abs(late).std()) if timed else None,
        speed_error=float(np.abs(hasty).mean()) if timed else None,
        speed_variability=float(np.abs(hasty).std()) if timed else None,
        stroke_error=len(drawing) - axis.strokes,
        order_error=float(by_order.sum() - matched.sum()),
    )


def resampled(ink: Ink, count: int = N) -> tuple[FloatArray, FloatArray | None]:
    """`count` points at equal steps of the drawn length (jumps between strokes are none), centroid at the origin, and each
    point's seconds from the first. Raises ValueError for no ink."""
    if not len(ink):
        raise ValueError("a drawing without strokes has no points")
    points = np.concatenate([stroke.points for stroke in ink])
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    steps[np.cumsum([len(stroke) for stroke in ink])[:-1] - 1] = 0.0
    along = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(0.0, along[-1], count)
    placed = _placed(points, along, at)
    clocks = [stroke.times for stroke in ink]
    clock = (
        None
        if any(times is None for times in clocks)
        else np.concatenate([t for t in clocks if t is not None])
    )
    times = None if clock is None else np.interp(at, along, clock - clock[0])
    return placed - placed.mean(axis=0), times


def turning(points: FloatArray) -> FloatArray:
    """The signed angle at each inner point, radians in (−π, π], (n − 2,)."""
    steps = np.diff(points, axis=0)
    heading = np.arctan2(steps[:, 1], steps[:, 0])
    return _wrapped(np.diff(heading))


def speeds(points: FloatArray, times: FloatArray | None) -> FloatArray:
    """Page units a second between points, (n − 1,); 0 where no time passed."""
    if times is None:
        raise ValueError("speeds need times")
    lengths, seconds = np.linalg.norm(np.diff(points, axis=0), axis=1), np.diff(times)
    return np.divide(lengths, seconds, out=np.zeros_like(lengths), where=seconds > 0)


def _placed(points: FloatArray, along: FloatArray, at: FloatArray) -> FloatArray:
    """Points at these lengths; at the length where a stroke ends, the end of that stroke."""
    place = (
        np.clip(np.searchsorted(along, at, side="left"), 1, len(points) - 1)
        if len(points) > 1
        else np.zeros(len(at), int)
    )
    if len(points) == 1:
        return np.repeat(points, len(at), axis=0)
    before, after = along[place - 1], along[place]
    share = np.divide(at - before, after - before, out=np.zeros_like(at), where=after > before)[:, None]
    return (1 - share) * points[place - 1] + share * points[place]


def _matching(first: FloatArray, other: FloatArray) -> NDArray[np.intp]:
    """Which point of the other goes with each of the first, by the least total distance."""
    apart = np.linalg.norm(first[:, None] - other[None], axis=2)
    return linear_sum_assignment(apart)[1]


def _area(points: FloatArray) -> float:
    """Of the bounding box."""
    width, height = np.ptp(points, axis=0).tolist()
    return float(width * height)


def _wrapped(angles: FloatArray) -> FloatArray:
    return np.pi - np.mod(np.pi - angles, 2 * np.pi)
