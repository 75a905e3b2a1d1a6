"""From the ink of one thing to its ideal shape.

Least squares throughout: circles by Kåsa's algebraic fit and one Gauss-Newton step on true
distances; polygons by the best set of sides together (`geometric.legs`), a line fitted to each side
and neighbouring lines intersected; links by their ends. Frame: page units, y down. A function
returns None where the ink has no such shape in it (a circle of points in a line, for one).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import radians
from typing import assert_never

import numpy as np

from recognizer.geometric.arrows import head
from recognizer.geometric.ring import RING, Ring, closing_points, ring
from recognizer.geometric.rules import RULES, best_polygon
from recognizer.geometric.teeth import teeth
from recognizer.preprocess import spaced, unit_path
from sketch.geometry import bounding_box, diagonal, path_length, resample
from sketch.ink import FloatArray, Stroke
from sketch.shapes import Arrow, Circle, ComponentKind, Point, Polygon, Shape, ShapeError, Spring, Wire


@dataclass(frozen=True, slots=True)
class FitRule:
    """How ink is idealised."""

    points: int = 240
    """Points of a path: sampling cuts corners, and this finely it cuts off a hundredth of a side."""
    outline: int = 120
    """Points of a polygon's outline, on which its sides are sought."""
    rounding: float = 0.08
    """Share of the perimeter below which a side may be a rounded corner: it is one where the outline turns
    by less than `rounded` in all at its two ends (the short side of a plank turns by 180°)."""
    rounded: float = radians(140)
    cut: float = 0.02
    """Share of the perimeter below which a side was cut off a sharp corner by sampling,"""
    sharp: float = radians(165)
    """unless the outline turns by more: the tip of a sliver of 15°."""
    tip: float = radians(8)
    """A corner sharper than this is the end of a plank whose short side was lost, not the tip of a wedge: it is given
    the width that its ink has"""
    end: float = 0.06
    """within this share of the outline's extent from it."""
    side: int = 48
    """Points of a side that was drawn as a stroke of its own."""
    corner: float = 0.12
    """Share of a side's points left out at either end: corners are rounded there."""
    straight_on: float = radians(18)
    """A corner that turns by less was none: a polygon of 18 sides turns by 20° at each."""
    hook: float = 0.06
    """Share of a wire's points at either end that may be a hook and do not steer its line."""


FIT = FitRule()


def fit(kind: ComponentKind, strokes: list[Stroke]) -> Shape | None:
    """The ideal shape of this kind that the strokes draw together, or None."""
    try:
        match kind:
            case "circle":
                return fit_circle(joined(strokes))
            case "polygon":
                return fit_polygon(joined(strokes))
            case "spring":
                return fit_spring(joined(strokes))
            case "wire":
                return fit_wire(joined(strokes))
            case "arrow":
                return fit_arrow(strokes)
            case _:
                assert_never(kind)
    except ShapeError:
        return None  # ink without extent


def fit_sides(strokes: list[Stroke]) -> Polygon | None:
    """The polygon whose sides are three or more strokes that close end to end, each nearly straight: a
    line through each, and a corner where neighbouring lines meet. None where they outline nothing."""
    if len(strokes) < 3:
        return None
    sides = in_order(strokes)
    low, size = np.concatenate(sides).min(axis=0), diagonal(np.concatenate(sides))
    if size == 0 or min(diagonal(side) for side in sides) == 0:
        return None
    unit = [resample((side - low) / size, FIT.side) for side in sides]
    lines = [_line(side) for side in unit]
    corners = np.array(
        [_meeting(lines[k - 1], lines[k], 0.5 * (unit[k - 1][-1] + unit[k][0])) for k in range(len(lines))]
    )
    corners = _straightened(corners)
    return Polygon(low + size * _convex(corners)) if len(corners) >= 3 else None


def joined(strokes: list[Stroke]) -> FloatArray:
    """The strokes' points as one path, (n, 2): each stroke is appended, or turned about, so that
    its nearer end follows on; the first begins at its end that lies farther from the others."""
    return np.concatenate(in_order(strokes))


def in_order(strokes: list[Stroke]) -> list[FloatArray]:
    """The strokes' points, each (n, 2), in the order and sense in which they follow on one another."""
    if len(strokes) == 1:
        return [strokes[0].points]
    waiting = [stroke.points for stroke in strokes]
    first = waiting.pop(0)
    others = np.concatenate([points[[0, -1]] for points in waiting])
    path = [first[::-1] if _nearest(first[0], others) < _nearest(first[-1], others) else first]
    while waiting:
        end_of = path[-1][-1]
        gaps = [[float(np.hypot(*(points[end] - end_of))) for end in (0, -1)] for points in waiting]
        which, end = np.unravel_index(int(np.argmin(gaps)), (len(gaps), 2))
        points = waiting.pop(int(which))
        path.append(points[::-1] if end else points)
    return path


def fit_circle(points: FloatArray) -> Circle | None:
    """The least-squares circle through an outline, without what hangs over where it closes."""
    if diagonal(points) == 0:
        return None
    path = resample(points, FIT.points)
    first, last = closing_points(path)
    outline = path[first : last + 1]
    middle, size = outline.mean(axis=0), diagonal(outline)
    x, y = ((outline - middle) / size).T
    # Kåsa: x² + y² = 2ax + 2by + c is linear in a, b, c.
    system = np.column_stack([2 * x, 2 * y, np.ones_like(x)])
    (a, b, c), _, rank, _ = np.linalg.lstsq(system, x * x + y * y, rcond=None)
    if rank < 3 or c + a * a + b * b <= 0:
        return None
    radius = float(np.sqrt(c + a * a + b * b))
    away = np.hypot(x - a, y - b)
    if away.min() <= 1e-9 or radius > 10:
        return None
    slopes = np.column_stack([(x - a) / away, (y - b) / away, np.ones_like(x)])
    da, db, dr = np.linalg.lstsq(slopes, away - radius, rcond=None)[0]
    centre = middle + size * np.array([a + da, b + db])
    return Circle(_point(centre), float(size * (radius + dr)))


def fit_polygon(points: FloatArray) -> Polygon | None:
    """The convex polygon of three to six sides that an outline draws."""
    low, _ = bounding_box(points)
    size = diagonal(points)
    if size == 0:
        return None
    outline = ring(resample((points - low) / size, FIT.points), replace(RING, points=FIT.outline))
    if outline is None:
        return None
    corners = _straightened(_side_corners(outline))
    if len(corners) < 3:
        return None
    return Polygon(low + size * _blunted(_convex(corners), (points - low) / size))


def fit_spring(points: FloatArray) -> Spring | None:
    """A spring between the ends of its ink: its leads belong to its rest length."""
    if diagonal(points) == 0:
        return None
    found = teeth(spaced(unit_path(Stroke(points))))
    return Spring(_point(points[0]), _point(points[-1]), found.legs / 2, found.height * diagonal(points))


def fit_wire(points: FloatArray) -> Wire | None:
    """A wire along the best line of its ink, as long as the ink reaches along it."""
    if diagonal(points) == 0:
        return None
    path = resample(points, FIT.points)
    hooked = round(FIT.hook * FIT.points)
    body = path[hooked:-hooked]
    middle = body.mean(axis=0)
    _, _, directions = np.linalg.svd(body - middle, full_matrices=False)
    along = (path - middle) @ directions[0]
    ends = np.array([along.min(), along.max()])
    if abs(along[0] - ends[0]) > abs(along[0] - ends[1]):
        ends = ends[::-1]
    start, end = middle + ends[:, None] * directions[0]
    return Wire(_point(start), _point(end))


def fit_arrow(strokes: list[Stroke]) -> Arrow | None:
    """An arrow from tail to tip: in one stroke by its head, in several by where the shorter lie."""
    shaft = max(strokes, key=lambda stroke: diagonal(stroke.points))
    points = shaft.points
    if diagonal(points) == 0:
        return None
    heads = [other.points for other in strokes if other is not shaft]
    if heads:
        near = np.concatenate(heads)
        if _nearest(points[0], near) < _nearest(points[-1], near):
            points = points[::-1]
        return Arrow(_point(points[0]), _point(points[-1]))
    found: list[tuple[float, Arrow]] = []
    for path in ((tail_first := resample(points, RULES.points)), tail_first[::-1]):
        seen = head(path)
        if seen is not None:
            found.append((seen.narrower, Arrow(_point(path[0]), _point(path[seen.tip]))))
    if found:
        return max(found, key=lambda pair: pair[0])[1]
    return Arrow(_point(points[0]), _point(points[-1]))


def _side_corners(outline: Ring) -> FloatArray:
    """Corners of the best polygon: lines fitted to its sides, intersected with their neighbours. Sides
    that are only rounded corners are left out, and their neighbours meet beyond them."""
    points = outline.points
    breaks, _ = best_polygon(outline)
    sides = _without_rounding(points, list(pairwise(breaks)))
    lines = [_line(points[a : b + 1]) for a, b in sides]
    seen = [0.5 * (points[b] + points[a]) for (_, b), (a, _) in zip([sides[-1], *sides], sides, strict=False)]
    return np.array(
        [
            _meeting(before, after, at)
            for before, after, at in zip([lines[-1], *lines], lines, seen, strict=False)
        ]
    )


def _without_rounding(points: FloatArray, sides: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """The sides (first and last point) without the rounded corners between them; three remain."""
    perimeter = path_length(points)
    while len(sides) > 3:
        along = np.array([points[b] - points[a] for a, b in sides])
        lengths = np.hypot(along[:, 0], along[:, 1])
        before, after = np.roll(along, 1, axis=0), np.roll(along, -1, axis=0)
        cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        dot = np.einsum("ij,ij->i", before, after)
        turned = np.abs(np.arctan2(cross, dot))
        corner = ((lengths < FIT.cut * perimeter) & (turned < FIT.sharp)) | (
            (lengths < FIT.rounding * perimeter) & (turned < FIT.rounded)
        )
        if not corner.any():
            break
        del sides[int(np.argmin(np.where(corner, lengths, np.inf)))]
    return sides


def _line(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(point, direction) of the best line through a side, its rounded ends left out."""
    cut = int(FIT.corner * len(points))
    inner = points[cut : len(points) - cut]
    if len(inner) < 2:
        inner = points
    middle = inner.mean(axis=0)
    return middle, np.linalg.svd(inner - middle, full_matrices=False)[2][0]


def _meeting(
    before: tuple[FloatArray, FloatArray], after: tuple[FloatArray, FloatArray], seen: FloatArray
) -> FloatArray:
    """Where two sides' lines meet; the corner as seen where they are nearly parallel, or where they
    meet far from it."""
    (p, d), (q, e) = before, after
    sine = float(d[0] * e[1] - d[1] * e[0])
    if abs(sine) < np.sin(FIT.straight_on):
        return seen
    offset = q - p
    corner = p + d * float(offset[0] * e[1] - offset[1] * e[0]) / sine
    return corner if float(np.hypot(*(corner - seen))) < 0.15 else seen


def _straightened(corners: FloatArray) -> FloatArray:
    """The corners without those at which the outline hardly turns."""
    while len(corners) > 3:
        steps = np.roll(corners, -1, axis=0) - corners
        before = np.roll(steps, 1, axis=0)
        cross = before[:, 0] * steps[:, 1] - before[:, 1] * steps[:, 0]
        turns = np.abs(np.arctan2(cross, np.einsum("ij,ij->i", before, steps)))
        least = int(np.argmin(turns))
        if turns[least] > FIT.straight_on:
            break
        corners = np.delete(corners, least, axis=0)
    return corners


def _convex(corners: FloatArray) -> FloatArray:
    """The corners without those that lie inside the hull of the others (row R1: convex polygons)."""
    kept = list(range(len(corners)))
    sense = np.sign(_doubled_area(corners))
    for index in range(len(corners)):
        if len(kept) == 3 or index not in kept:
            continue
        at = kept.index(index)
        a, b, c = corners[kept[at - 1]], corners[index], corners[kept[(at + 1) % len(kept)]]
        if sense * ((b - a)[0] * (c - b)[1] - (b - a)[1] * (c - b)[0]) <= 0:
            kept.remove(index)
    return corners[kept]


def _blunted(corners: FloatArray, ink: FloatArray) -> FloatArray:
    """The corners with two in the place of each needle's tip, as far apart as the ink is wide there."""
    steps = np.roll(corners, -1, axis=0) - corners
    before = -np.roll(steps, 1, axis=0)
    cross = before[:, 0] * steps[:, 1] - before[:, 1] * steps[:, 0]
    inside = np.abs(np.arctan2(cross, np.einsum("ij,ij->i", before, steps)))
    found: list[FloatArray] = []
    for k, corner in enumerate(corners):
        if inside[k] >= FIT.tip:
            found.append(corner)
            continue
        one, other = (way[k] / np.hypot(*way[k]) for way in (before, steps))
        along = (one + other) / np.hypot(*(one + other))  # from the tip into the needle
        near = ink[(ink - corner) @ along <= FIT.end]
        if not len(near):
            found.append(corner)
            continue
        across = np.array([-along[1], along[0]])
        if one @ across > other @ across:
            across = -across
        back = float(((near - corner) @ along).min())
        wide = (near - corner) @ across
        found += [corner + back * along + edge * across for edge in (float(wide.min()), float(wide.max()))]
    return _convex(np.array(found)) if len(found) > len(corners) else corners


def _doubled_area(corners: FloatArray) -> float:
    x, y = corners.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _nearest(point: FloatArray, others: FloatArray) -> float:
    return float(np.hypot(*(others - point).T).min())


def _point(values: FloatArray) -> Point:
    return (float(values[0]), float(values[1]))
