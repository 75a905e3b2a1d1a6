"""HBF49: 49 features of a symbol in one stroke or several, a baseline for online symbol recognition.

Delaye and Anquetil, "HBF49 feature set: a first unified baseline for online symbol recognition", Pattern
Recognition 46 (2013) 117-130. Features 1 to 31 look at how the pen went, 32 to 49 at what it left. Frame:
the drawing's box about the origin, its longer side 1 (the paper's 128 units), y down, points one step apart.

Choices where a formula leaves one, or where it has no value: pen lifts are no part of the path (lengths, directions and
turns are those of ink alone); a line encloses what a pen of one unit would; a spot has neither direction nor
turn. Only feature 14, the number of strokes, and the order and sense of drawing set strokes apart from their union.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from recognizer.classical.paths import IntArray, Paths, evenly_spaced, paths_of, unit_sized
from sketch.ink import FloatArray, Ink


@dataclass(frozen=True, slots=True)
class HBF49Rule:
    """Numbers of the features; lengths in sides of the drawing's box, the longer of which is 1."""

    step: float = 8 / 128
    """Between points: sixteen steps along a side, so that jitter of a pixel is no direction of its own."""
    most: int = 400
    """Points of a drawing: scribbles of more than 25 times their size have a longer step."""
    wide: int = 2
    """k of the angles over k points on either side: they see a corner that the pen rounded."""
    initial: int = 2
    """The initial vector goes from the first point to the one so many steps on (the third, as Rubine's)."""
    thin: float = 1 / 128
    """Width of the pen: boxes and hulls are at least as wide."""
    nothing: float = 1e-7
    """Lengths below this are rounding: they have no direction, and a step that rises by less is level."""


RULE = HBF49Rule()

NAMES = (
    *("start x", "start y", "end x", "end y"),
    *("ends apart", "ends' direction, cosine", "ends' direction, sine", "ends apart over length"),
    *("initial direction, cosine", "initial direction, sine", "inflexion x", "inflexion y"),
    *("downward share", "strokes", "angle of the box's diagonal", "length", "box over length", "deviation"),
    *("mean direction", "curvature", "perpendicularity", "k-perpendicularity", "greatest k-angle"),
    *(f"direction near {angle}°" for angle in (0, 45, 90, 135)),
    *(f"turn near {angle}°" for angle in (0, 60, 120, 180)),
    *(f"ink in row {row}, column {column}" for row in (1, 2, 3) for column in (1, 2, 3)),
    *(f"Hu's invariant {rank}" for rank in range(1, 8)),
    *("hull over box", "compactness"),
)
"""The 49 features, in the paper's order."""


def hbf49(drawings: Sequence[Ink], rule: HBF49Rule = RULE) -> FloatArray:
    """Features of B drawings, (B, 49), in the order of `NAMES`; finite for any ink.

    A drawing is an `Ink` of one stroke or more (of one symbol). Raises ValueError for one without strokes.
    """
    if not len(drawings):
        return np.empty((0, len(NAMES)))
    paths = evenly_spaced(unit_sized(paths_of(drawings)), rule.step, rule.most)
    ink = _Ink.of(paths)
    columns = (
        *_ends(ink, rule),
        *_extent(ink),
        *_turns(ink, rule),
        *_directions(ink),
        *_turn_shares(ink, rule),
        *_zones(ink),
        *_hu_invariants(ink, rule),
        *_hull(ink, rule),
    )
    return np.column_stack(columns)


@dataclass(frozen=True, slots=True, eq=False)
class _Ink:
    """What several features start from: for each step its first point `at` (S,), its vector (S, 2) and
    length (S,); for each drawing its box's sides (B, 2) and the length of its path (B,)."""

    paths: Paths
    at: IntArray
    step: FloatArray
    apart: FloatArray
    box: FloatArray
    length: FloatArray

    @classmethod
    def of(cls, paths: Paths) -> _Ink:
        at = paths.spans()
        step = paths.points[at + 1] - paths.points[at]
        apart = np.hypot(*step.T)
        low, high = paths.box()
        return cls(paths, at, step, apart, high - low, paths.total(apart, at))


def _ends(ink: _Ink, rule: HBF49Rule) -> list[FloatArray]:
    """1 to 14: where the pen began, went first, stood halfway and stopped."""
    paths, points = ink.paths, ink.paths.points
    start, end = points[paths.starts], points[paths.last]
    across = end - start
    gap = np.hypot(*across.T)
    first = points[np.minimum(paths.starts + rule.initial, paths.last)] - start
    reach = np.hypot(*first.T)
    middle = points[(paths.starts + paths.last) // 2] - 0.5 * (start + end)
    down = paths.total(ink.apart * (ink.step[:, 1] > rule.nothing), ink.at)
    return [
        *(start + 0.5).T,
        *(end + 0.5).T,
        gap,
        *_ratio(across.T, gap),
        _ratio(gap, ink.length),
        *_ratio(first.T, reach),
        *(middle / np.maximum(ink.box, rule.thin)).T,
        _ratio(down, ink.length),
        paths.strokes.astype(np.float64),
    ]


def _extent(ink: _Ink) -> list[FloatArray]:
    """15 to 19: the box, the length, the spread about the centroid, and the mean slope."""
    paths, sizes = ink.paths, ink.paths.sizes
    centre = np.column_stack([paths.total(axis) for axis in paths.points.T]) / sizes[:, None]
    spread = np.hypot(*(paths.points - centre[paths.drawing]).T)
    width, height = ink.box.T
    slope = np.arctan(_ratio(ink.step[:, 1], ink.step[:, 0], np.inf))
    return [
        np.arctan2(height, width),
        ink.length,
        _ratio(width + height, ink.length),
        paths.total(spread) / sizes,
        _ratio(paths.total(slope, ink.at), _many(ink, ink.at)),
    ]


def _turns(ink: _Ink, rule: HBF49Rule) -> list[FloatArray]:
    """20 to 23: the sum of turns and of their squared sines, over neighbours and over k points; the sharpest."""
    at, near = _angles(ink.paths, 1)
    wide_at, wide = _angles(ink.paths, rule.wide)
    sharpest = np.zeros(ink.paths.count)
    np.maximum.at(sharpest, ink.paths.drawing[wide_at], wide)
    return [
        ink.paths.total(near, at),
        ink.paths.total(np.sin(near) ** 2, at),
        ink.paths.total(np.sin(wide) ** 2, wide_at),
        sharpest,
    ]


def _directions(ink: _Ink) -> list[FloatArray]:
    """24 to 27: shares of the steps near four directions, opposite ones alike; a step between two counts for both."""
    place = (np.arctan2(ink.step[:, 1], ink.step[:, 0]) % np.pi) / (np.pi / 4)
    many = _many(ink, ink.at)
    below = np.floor(place)
    upper = place - below
    shares: list[FloatArray] = []
    for centre in range(4):
        weight = (below % 4 == centre) * (1 - upper) + ((below + 1) % 4 == centre) * upper
        shares.append(_ratio(ink.paths.total(weight, ink.at), many))
    return shares


def _turn_shares(ink: _Ink, rule: HBF49Rule) -> list[FloatArray]:
    """28 to 31: shares of the k-angles near straight on, 60°, 120° and straight back."""
    at, turn = _angles(ink.paths, rule.wide)
    many = _many(ink, at)
    place = turn / (np.pi / 3)
    return [
        _ratio(ink.paths.total(np.maximum(1 - np.abs(place - centre), 0.0), at), many) for centre in range(4)
    ]


def _zones(ink: _Ink) -> list[FloatArray]:
    """32 to 40: the share of points in each ninth of the square about the box; a point between centres of
    ninths counts for all it is near."""
    paths = ink.paths
    rows, columns = (_thirds(paths.points[:, axis] + 0.5) for axis in (1, 0))
    return [paths.total(row * column) / paths.sizes for row in rows for column in columns]


def _hu_invariants(ink: _Ink, rule: HBF49Rule) -> list[FloatArray]:
    """41 to 47: Hu's seven invariants of the points, coordinates in steps."""
    paths, sizes = ink.paths, ink.paths.sizes.astype(np.float64)
    x, y = ((axis - (paths.total(axis) / sizes)[paths.drawing]) / rule.step for axis in paths.points.T)

    xx, yy = x * x, y * y
    n20, n02, n11 = (paths.total(moment) / sizes**2 for moment in (xx, yy, x * y))
    n30, n21, n12, n03 = (paths.total(moment) / sizes**2.5 for moment in (xx * x, xx * y, x * yy, yy * y))
    a, b = n30 + n12, n21 + n03
    c, d = n30 - 3 * n12, 3 * n21 - n03
    return [
        n20 + n02,
        (n20 - n02) ** 2 + 4 * n11**2,
        c**2 + d**2,
        a**2 + b**2,
        c * a * (a**2 - 3 * b**2) + d * b * (3 * a**2 - b**2),
        (n20 - n02) * (a**2 - b**2) + 4 * n11 * a * b,
        d * a * (a**2 - 3 * b**2) - c * b * (3 * a**2 - b**2),
    ]


def _hull(ink: _Ink, rule: HBF49Rule) -> list[FloatArray]:
    """48 and 49: the hull's area over the box's, and the squared length over the hull's area."""
    clouds = shapely.multipoints(ink.paths.points, indices=ink.paths.drawing)
    area = np.maximum(shapely.area(shapely.convex_hull(clouds)), rule.thin)
    box = np.maximum(ink.box, rule.thin).prod(axis=1)
    return [np.minimum(area / np.maximum(box, rule.thin), 1.0), ink.length**2 / area]


def _angles(paths: Paths, reach: int) -> tuple[IntArray, FloatArray]:
    """Turns in [0, π] at the points that have `reach` points of their stroke on either side: which, and how much."""
    at = paths.spans(2 * reach) + reach
    before = paths.points[at] - paths.points[at - reach]
    after = paths.points[at + reach] - paths.points[at]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return at, np.abs(np.arctan2(cross, (before * after).sum(axis=1)))


def _thirds(place: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """How near places from 0 to 1 are to 0, to ½ and to 1; the three sum to 1."""
    low, high = np.maximum(1 - 2 * place, 0.0), np.maximum(2 * place - 1, 0.0)
    return low, 1 - low - high, high


def _many(ink: _Ink, at: IntArray) -> FloatArray:
    return np.bincount(ink.paths.drawing[at], minlength=ink.paths.count).astype(np.float64)


def _ratio(value: FloatArray, by: FloatArray, nought: float = 0.0) -> FloatArray:
    """value / by; where `by` is nothing: 0, or what `nought` says of a value that is something."""
    none = np.abs(by) <= RULE.nothing
    found = value / np.where(none, 1.0, by)
    return np.where(none, np.where(np.abs(value) <= RULE.nothing, 0.0, nought), found)
