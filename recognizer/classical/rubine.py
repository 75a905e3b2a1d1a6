"""Rubine's thirteen features of a gesture.

Rubine, "Specifying gestures by example", SIGGRAPH 1991, section 4.1 and figure 6. In: drawings of one stroke or more,
page units, y down. Strokes after the first go on where the one before stopped, as if the pen had not been
lifted, since the paper knows one stroke alone. Lengths are in page units, angles in radians, times in seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from recognizer.classical.paths import Paths, paths_of, unit_sized
from sketch.ink import FloatArray, Ink, Stroke

FOREVER = 1e12
"""Seconds: no clock that tells more tells the time."""


@dataclass(frozen=True, slots=True)
class RubineRule:
    """Numbers of the features."""

    jiggle: float = 3.0
    """A point nearer than this to the last one kept is dropped: the paper's "3 pixels" of a mouse that jiggles."""
    clock: float = 1e-6
    """Seconds between two points at least: clocks tell no less."""
    size: float = 250.0
    """The longer side that `shape` gives every drawing, page units: an ordinary gesture on a screen of that time."""


RULE = RubineRule()

NAMES = (
    *("initial direction, cosine", "initial direction, sine", "box diagonal", "angle of the box's diagonal"),
    *("ends apart", "ends' direction, cosine", "ends' direction, sine", "length"),
    *("turned, signed", "turned, absolute", "sharpness", "greatest speed, squared", "duration"),
)
"""f1 to f13."""
TIMELESS = 11
"""How many of them, the first ones, know nothing of time."""


def rubine(drawings: Sequence[Ink], rule: RubineRule = RULE) -> FloatArray:
    """f1 to f13 of B drawings, (B, 13), in the order of `NAMES`; finite for any ink.

    f12 and f13 are 0 where a stroke has no times. Raises ValueError for a drawing without strokes.
    """
    paths = paths_of([_joined(drawing, rule.jiggle) for drawing in drawings])
    found = np.zeros((len(drawings), len(NAMES)))
    if len(drawings):
        found[:, :TIMELESS] = _shape(paths)
        found[:, TIMELESS:] = [_time(drawing, rule) for drawing in drawings]
    return found


def shape(drawings: Sequence[Ink], rule: RubineRule = RULE) -> FloatArray:
    """f1 to f11 of B drawings that are first brought to one size, (B, 11): for ink whose units mean nothing,
    where the paper's gestures were all drawn on one screen."""
    if not len(drawings):
        return np.empty((0, TIMELESS))
    paths = unit_sized(paths_of(drawings))
    cuts = np.flatnonzero(np.diff(paths.stroke)) + 1
    strokes = iter(np.split(rule.size * paths.points, cuts))
    sized = [Ink(tuple(Stroke(next(strokes)) for _ in drawing)) for drawing in drawings]
    return _shape(paths_of([_joined(drawing, rule.jiggle) for drawing in sized]))


def _shape(paths: Paths) -> FloatArray:
    """f1 to f11 of drawings of one stroke, without jiggle."""
    points, starts, last = paths.points, paths.starts, paths.last
    at = paths.spans()
    step = points[at + 1] - points[at]
    first = points[np.minimum(starts + 2, last)] - points[starts]
    across = points[last] - points[starts]
    low, high = paths.box()
    width, height = (high - low).T
    corner = paths.spans(2)
    before, after = points[corner + 1] - points[corner], points[corner + 2] - points[corner + 1]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn = np.arctan2(cross, (before * after).sum(axis=1))
    return np.column_stack(
        [
            *_direction(first, width + height),
            np.hypot(width, height),
            np.arctan2(height, width),
            np.hypot(*across.T),
            *_direction(across, width + height),
            paths.total(np.hypot(*step.T), at),
            paths.total(turn, corner),
            paths.total(np.abs(turn), corner),
            paths.total(turn**2, corner),
        ]
    )


def _time(drawing: Ink, rule: RubineRule) -> tuple[float, float]:
    """f12 and f13: the greatest squared speed between kept points, and how long it took."""
    if any(stroke.times is None for stroke in drawing):
        return 0.0, 0.0
    times = np.concatenate([stroke.times for stroke in drawing if stroke.times is not None])
    times = np.clip(times, -FOREVER, FOREVER)
    points = drawing.points_of(range(len(drawing)))
    kept = _kept(points, rule.jiggle)
    lasted = np.diff(times[kept])
    moved = np.diff(points[kept], axis=0)
    timed = lasted > 0
    speed = np.hypot(*moved[timed].T) / np.maximum(lasted[timed], rule.clock)
    return float(speed.max(initial=0.0)) ** 2, max(float(times[-1] - times[0]), 0.0)


def _joined(drawing: Ink, jiggle: float) -> Ink:
    """The drawing as one stroke without jiggle."""
    points = drawing.points_of(range(len(drawing)))
    return Ink((Stroke(points[_kept(points, jiggle)]),)) if len(points) else Ink()


def _kept(points: FloatArray, jiggle: float) -> list[int]:
    """The points that lie at least `jiggle` from the one kept before; the first always."""
    kept = [0]
    x, y = points[0].tolist()
    squared = jiggle * jiggle
    for index, (px, py) in enumerate(points.tolist()):
        if (px - x) ** 2 + (py - y) ** 2 >= squared and index:
            kept.append(index)
            x, y = px, py
    return kept


def _direction(vectors: FloatArray, sizes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cosine and sine of each vector's direction; 0 and 0 for one that is rounding beside the drawing's size."""
    length = np.hypot(*vectors.T)
    some = length > 1e-9 * sizes
    scale = np.where(some, 1 / np.where(some, length, 1.0), 0.0)
    return vectors[:, 0] * scale, vectors[:, 1] * scale
