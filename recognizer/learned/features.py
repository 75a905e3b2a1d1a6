"""What the net looks at: 64 points of a stroke and a handful of numbers about the whole of it.

Everything is a ratio of lengths or an angle, so that position and scale of the page, and the rate
at which the pen was sampled, do not matter; only `page_features` compare a stroke with its page.
All functions work on batches: paths (B, 64, 2), page units, y down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketch.geometry import distinct, resample
from sketch.ink import FloatArray, Ink

POINTS = 64
"""Points of equal spacing that stand for a stroke: five for each leg of a twelve-legged zig-zag."""


@dataclass(frozen=True, slots=True)
class FeatureRule:
    """Numbers of the features."""

    corner: float = np.radians(45.0)
    """A turn within `corner_span` points sharper than this counts as a corner."""
    corner_span: int = 2
    """Points on either side of a corner: a corner rounded over 5 % of the stroke still counts."""
    directions: int = 36
    """Directions of the support function: 5 degrees apart over a half turn and back."""
    few_points: int = 12
    """A stroke with this many different points or more is not a dot; beyond it the count is not looked at."""
    smallest: float = 5e-4
    """Relative sizes on a page below this count as this."""
    letter: float = 0.006
    """A small letter's size over its page's: dots and taps lie below, hardly anything else does."""
    nothing: float = 1e-6
    """Lengths (of a stroke of size one) and angles below this are rounding, not drawing."""


RULE = FeatureRule()

SEQUENCE_CHANNELS = (
    "x",
    "y",
    "heading cosine",
    "heading sine",
    "turn",
    "turn, absolute",
    "wider turn",
    "distance from the centroid",
    "distance from the start",
    "distance from the end",
    "turned so far",
    "crossings here",
)
GLOBAL_FEATURES = (
    "gap of the ends over length",
    "gap of the ends over size",
    "log length over size",
    "width of the lesser axis over the greater",
    "turning, signed, turns",
    "turning, absolute, turns",
    "share of the turning in one sense",
    "changes of the turning's sense",
    "corners",
    "sharpest turn",
    "crossings",
    "compactness of the enclosed area",
    "length over the hull's perimeter",
    "spread of the radius about the centroid",
    "spread of the radius in the whitened frame",
    "farthest from the chord over the chord",
    "swings across the main axis",
    "returns along the main axis",
    "advance along the main axis over length",
    "gap that closing at the best crossing would leave",
    "different points (few)",
    "is a dot",
)
PAGE_FEATURES = (
    "has company",
    "log size over the page's",
    "log of how far below a letter's size",
    "share of the page's other strokes inside",
)


def features(paths: FloatArray, distinct_points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Evenly spaced paths (B, 64, 2) and the number of different raw points of each (B,) to
    (B, 12, 64), the channels of `SEQUENCE_CHANNELS`, and (B, 22), the `GLOBAL_FEATURES`."""
    low, high = paths.min(axis=1, keepdims=True), paths.max(axis=1, keepdims=True)
    moving = (high > low).any(axis=(1, 2))
    size = _positive(np.hypot(*np.moveaxis(high - low, 2, 0)))[..., None]
    unit = (paths - (low + high) / 2) / size
    shared = _Shared(unit, *_heading_and_turn(unit), _wide_turn(unit, RULE.corner_span), _crossings(unit))
    overall = _global(shared, np.minimum(distinct_points, RULE.few_points) / RULE.few_points, ~moving)
    overall[:, :-2] *= moving[:, None]
    return _sequence(shared) * moving[:, None, None], overall


@dataclass(frozen=True, slots=True, eq=False)
class _Shared:
    """What both kinds of features start from: paths in their own frame, headings, turns, crossings."""

    unit: FloatArray
    heading: FloatArray
    turn: FloatArray
    wide: FloatArray
    crossings: FloatArray


def _sequence(shared: _Shared) -> FloatArray:
    unit, turn = shared.unit, shared.turn
    found = np.empty((len(unit), len(SEQUENCE_CHANNELS), POINTS))
    found[:, 0] = 2 * unit[..., 0]
    found[:, 1] = 2 * unit[..., 1]
    found[:, 2] = np.cos(shared.heading)
    found[:, 3] = np.sin(shared.heading)
    found[:, 4] = turn / np.pi
    found[:, 5] = np.abs(found[:, 4])
    found[:, 6] = shared.wide / np.pi
    found[:, 7] = 2 * _distance(unit - unit.mean(axis=1, keepdims=True))
    found[:, 8] = _distance(unit - unit[:, :1])
    found[:, 9] = _distance(unit - unit[:, -1:])
    found[:, 10] = np.cumsum(turn, axis=1) / (4 * np.pi)
    found[:, 11] = np.minimum(shared.crossings, 3.0) / 3.0
    return found


def _global(shared: _Shared, few: FloatArray, still: NDArray[np.bool_]) -> FloatArray:
    unit = shared.unit - shared.unit.mean(axis=1, keepdims=True)
    length = _positive(_distance(unit[:, 1:] - unit[:, :-1]).sum(axis=1))
    gap = _distance(unit[:, -1] - unit[:, 0])
    inner = shared.turn[:, 1:-1]
    signed, absolute = inner.sum(axis=1), np.abs(inner).sum(axis=1)
    sharp = np.abs(shared.wide)
    along, across, whitened = _principal(unit)
    columns = (
        gap / length,
        gap,
        np.log(length),
        _range(across) / _positive(_range(along)),
        signed / (2 * np.pi),
        absolute / (2 * np.pi),
        np.abs(signed) / np.maximum(absolute, RULE.nothing),
        _sign_changes(inner, 0.05) / 10,
        _peaks(sharp, RULE.corner) / 8,
        sharp.max(axis=1) / np.pi,
        shared.crossings.sum(axis=1) / 2 / 10,
        4 * np.pi * np.abs(_enclosed(unit)) / length**2,
        length / _positive(_hull_perimeter(unit)),
        _spread(_distance(unit)),
        _spread(whitened),
        _chord_deviation(unit) / length,
        _sign_changes(across, 0.15) / 10,
        _sign_changes(along[:, 1:] - along[:, :-1], 0.25) / 10,
        np.abs(along[:, -1] - along[:, 0]) / length,
        _best_closing(unit) / length,
        few,
        still,
    )
    found = np.empty((len(unit), len(GLOBAL_FEATURES)))
    for index, column in enumerate(columns):
        found[:, index] = column
    return np.minimum(np.maximum(found, -6.0), 6.0)


def page_features(ink: Ink) -> FloatArray:
    """How each stroke stands among the others, (n, 4), in the order of `PAGE_FEATURES`; zeros when alone."""
    count = len(ink)
    if count < 2:
        return np.zeros((count, len(PAGE_FEATURES)))
    low = np.array([stroke.points.min(axis=0) for stroke in ink])
    high = np.array([stroke.points.max(axis=0) for stroke in ink])
    sizes = np.linalg.norm(high - low, axis=1)
    page = float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
    relative = sizes / page if page > 0 else np.ones(count)
    return standing(relative, _boxes_inside(low, high) / (count - 1))


def standing(relative: FloatArray, inside: FloatArray) -> FloatArray:
    """Page features (n, 4) of strokes in company, from their sizes over the page's and the share of the other
    strokes that lie inside each, both (n,)."""
    log_size = np.log(np.maximum(relative, RULE.smallest))
    below = np.maximum(np.log(RULE.letter) - log_size, 0.0)
    return np.column_stack([np.ones(len(log_size)), log_size / 3.0, below, inside])


def _boxes_inside(low: FloatArray, high: FloatArray) -> FloatArray:
    """For each box the number of other boxes whose centre it contains, (n,). Works in blocks: n may be 20,000."""
    centre = (low + high) / 2
    counts = np.empty(len(low))
    for first in range(0, len(low), 512):
        part = slice(first, first + 512)
        contained = (centre[None] > low[part, None]) & (centre[None] < high[part, None])
        smaller = (high - low).max(axis=1)[None] < (high - low)[part].max(axis=1)[:, None]
        counts[part] = (contained.all(axis=2) & smaller).sum(axis=1)
    return counts


def of_strokes(points: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Sequence (B, 12, 64) and global (B, 22) features of raw strokes, each (n, 2)."""
    return features(*_evenly_spaced(points))


def both_ways(points: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """The same for each stroke and then for each stroke drawn backwards: (2 B, 12, 64) and (2 B, 22)."""
    paths, counts = _evenly_spaced(points)
    return features(np.concatenate([paths, paths[:, ::-1]]), np.concatenate([counts, counts]))


def _evenly_spaced(points: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Strokes as `POINTS` points of equal spacing, (B, 64, 2), and how many different points each had, (B,)."""
    cleaned = [distinct(stroke) for stroke in points]
    paths = np.array([resample(stroke, POINTS) for stroke in cleaned]).reshape(-1, POINTS, 2)
    return paths, np.array([float(len(stroke)) for stroke in cleaned])


def _distance(vectors: FloatArray) -> FloatArray:
    return np.hypot(vectors[..., 0], vectors[..., 1])


def _positive(values: FloatArray) -> FloatArray:
    return np.where(values > 0, values, 1.0)


def _heading_and_turn(paths: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Heading at each point (of the step that leaves it; the last repeats) and signed turn, 0 at both ends."""
    step = paths[:, 1:] - paths[:, :-1]
    heading, turn = np.empty(paths.shape[:2]), np.zeros(paths.shape[:2])
    np.arctan2(step[..., 1], step[..., 0], out=heading[:, :-1])
    heading[:, -1] = heading[:, -2]
    turn[:, 1:-1] = (heading[:, 1:-1] - heading[:, :-2] + np.pi) % (2 * np.pi) - np.pi
    return heading, turn


def _wide_turn(paths: FloatArray, span: int) -> FloatArray:
    """Turn between the chords to `span` points before and after, (B, 64); 0 near the ends."""
    chord = paths[:, span:] - paths[:, :-span]
    before, after = chord[:, :-span], chord[:, span:]
    cross = before[..., 0] * after[..., 1] - before[..., 1] * after[..., 0]
    found = np.zeros(paths.shape[:2])
    dot = before[..., 0] * after[..., 0] + before[..., 1] * after[..., 1]
    np.arctan2(cross, dot, out=found[:, span:-span])
    return found


_APART = np.abs(np.subtract.outer(np.arange(POINTS - 1), np.arange(POINTS - 1))) >= 2
"""Which pairs of steps can cross: not a step with itself or with its neighbour."""


def _crossings(unit: FloatArray) -> FloatArray:
    """For each point the number of crossings on the step that leaves it, (B, 64); 0 at the last.

    Two steps cross when the ends of each lie on different sides of the other. A point nearer to the
    other's line than rounding counts as on its right, so that a path run back on itself crosses nothing.
    """
    step = unit[:, 1:] - unit[:, :-1]
    normal = np.empty_like(step)
    np.negative(step[..., 1], out=normal[..., 0])
    normal[..., 1] = step[..., 0]
    offset = (unit[:, :-1] * normal).sum(axis=2) + RULE.nothing**2
    left = normal @ np.swapaxes(unit, 1, 2) > offset[..., None]
    parted = left[..., 1:] != left[..., :-1]
    hits = parted & np.swapaxes(parted, 1, 2) & _APART
    found = np.zeros(unit.shape[:2])
    found[:, :-1] = hits.sum(axis=2)
    return found


def _principal(unit: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Coordinates along and across the main axis, (B, 64) each, and the radius once both spreads are made 1."""
    x, y = unit[..., 0], unit[..., 1]
    xx, yy, xy = ((p * q).mean(axis=1) for p, q in ((x, x), (y, y), (x, y)))
    angle = 0.5 * np.arctan2(2 * xy, xx - yy)
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    along, across = cos * x + sin * y, cos * y - sin * x
    middle, half = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    greater = np.sqrt(np.maximum(middle + half, RULE.nothing))[:, None]
    lesser = np.sqrt(np.maximum(middle - half, RULE.nothing))[:, None]
    return along, across, np.hypot(across / lesser, along / greater)


def _range(values: FloatArray) -> FloatArray:
    return values.max(axis=1) - values.min(axis=1)


def _sign_changes(values: FloatArray, threshold: float) -> FloatArray:
    """How often each row swings from above +h to below −h or back, h a share of its largest magnitude, (B,)."""
    height = np.maximum(threshold * np.abs(values).max(axis=1, keepdims=True), RULE.nothing)
    above = values > height
    decided = above | (values < -height)
    # Where undecided, the last decided side holds: look it up by position in the flattened rows.
    position = np.arange(values.size).reshape(values.shape)
    place = np.maximum.accumulate(np.where(decided, position, position[:, :1]), axis=1)
    known = decided.ravel()[place]
    held = above.ravel()[place]
    return ((held[:, 1:] != held[:, :-1]) & known[:, :-1]).sum(axis=1).astype(float)


def _peaks(values: FloatArray, threshold: float) -> FloatArray:
    """Number of local maxima above the threshold in each row, (B,)."""
    inner = values[:, 1:-1]
    peak = (inner > threshold) & (inner >= values[:, :-2]) & (inner > values[:, 2:])
    return peak.sum(axis=1).astype(float)


def _enclosed(unit: FloatArray) -> FloatArray:
    x, y = unit[..., 0], unit[..., 1]
    open_ = (x[:, :-1] * y[:, 1:] - y[:, :-1] * x[:, 1:]).sum(axis=1)
    return 0.5 * (open_ + x[:, -1] * y[:, 0] - y[:, -1] * x[:, 0])


_ANGLES = np.arange(RULE.directions) * (np.pi / RULE.directions)
_DIRECTIONS = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)])


def _hull_perimeter(unit: FloatArray) -> FloatArray:
    """Cauchy: the hull's perimeter is the mean width times π."""
    shadow = np.swapaxes(unit @ _DIRECTIONS, 1, 2)
    return np.pi * (shadow.max(axis=2) - shadow.min(axis=2)).mean(axis=1)


def _spread(radius: FloatArray) -> FloatArray:
    return radius.std(axis=1) / _positive(radius.mean(axis=1))


def _chord_deviation(unit: FloatArray) -> FloatArray:
    chord = unit[:, -1] - unit[:, 0]
    offset = unit - unit[:, :1]
    cross = np.abs(chord[:, None, 0] * offset[..., 1] - chord[:, None, 1] * offset[..., 0])
    # A chord of no length has no direction to stray from.
    return cross.max(axis=1) / np.maximum(_distance(chord), RULE.nothing)


def _best_closing(unit: FloatArray) -> FloatArray:
    """Smallest distance between a point of the first quarter and one of the last: 0 where a tail crosses."""
    quarter = unit.shape[1] // 4
    gaps = _distance(unit[:, :quarter, None] - unit[:, None, -quarter:])
    return gaps.min(axis=(1, 2))
