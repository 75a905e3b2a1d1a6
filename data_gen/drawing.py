"""How a person divides a shape into strokes, and where those begin and end.

Frame: page units, y down. A shape of the truth becomes one or several meant paths, (n, 2) each;
the waver of the hand comes after (`data_gen.pen`). What goes wrong here is what a person gets
wrong on purpose or by haste: the closing of a loop, the corners, the ends of a wire that stop short
of the block or run into it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import assert_never

import numpy as np

from data_gen import ideals
from data_gen.writers import Writer
from sketch.geometry import centroid, diagonal, path_length, resample, signed_distance
from sketch.ink import FloatArray, Stroke
from sketch.shapes import Arrow, Circle, Point, Polygon, Shape, Solid, Spring, Wire, outline


@dataclass(frozen=True, slots=True)
class DrawingRule:
    """How far drawings stray from what is meant."""

    oval: float = 0.05
    """Standard deviation of log(width / height) of a circle."""
    shifted: float = 0.02
    """Standard deviation of a circle's centre, fraction of its diameter."""
    corner: float = 0.012
    """Standard deviation of a polygon's corners, fraction of its diagonal."""
    corner_most: float = 5.0
    """The same at most, page units: an eye guides the pen on long sides too."""
    joint: float = 0.03
    """Standard deviation of a piece's end from its corner at most, fraction of the piece's length."""
    closing: float = 0.012
    """Standard deviation of the closing error about the writer's mean, fraction of the perimeter."""
    closing_most: float = 12.0
    """Closing errors are never larger than this, page units."""
    end: float = 3.0
    """Standard deviation of a link's end along its axis, page units: short of the boundary or past it."""
    aside: float = 1.5
    """The same across its axis."""
    end_most: float = 7.0
    """Ends are never further off than this, page units."""
    regard: float = 20.0
    """Page units between a boundary that was meant and its ink that the eye bridges."""
    corner_pull: float = 0.5
    """How much nearness counts against sticking out when the eye looks for a corner: hooks are not one."""
    zigzag_uneven: float = 0.12
    """Standard deviation of the logarithm of a tooth's size and advance."""
    arcs: float = 0.25
    """Share of rings in two arcs among writers who always lift the pen within boxes."""
    upright: float = 0.75
    """Share of loops begun near the top (circles) or at the top left (polygons)."""
    mid_side: float = 0.08
    """Share of polygons begun in the middle of a side."""
    tap: float = 1.2
    """How far the pen slides in a tap, page units."""


RULE = DrawingRule()


def paths(shape: Shape, writer: Writer, rng: np.random.Generator) -> list[FloatArray]:
    """The strokes that the writer means for the shape, in drawing order."""
    match shape:
        case Circle():
            return _in_arcs(_circle(shape, writer, rng), writer, rng)
        case Polygon():
            return _polygon(shape, writer, rng)
        case Spring():
            return [_spring(shape, writer, rng)]
        case Wire():
            start, end = _loose_ends(shape, rng)
            return [ideals.line(*_either_way(start, end, rng))]
        case Arrow(start, end):
            length = float(np.linalg.norm(np.subtract(end, start)))
            return [ideals.arrow(start, end, head=0.2 * length, opening=float(rng.uniform(0.4, 0.7)))]
        case _:
            assert_never(shape)


@dataclass(frozen=True, slots=True)
class Drawn:
    """A solid as it was meant and as it has come to be on paper."""

    shape: Solid
    strokes: Sequence[Stroke]


def led_to(
    link: Spring | Wire, ends: tuple[str | None, str | None], solids: Mapping[str, Drawn]
) -> Spring | Wire:
    """The link as meant once the solids it joins are on paper: it ends at their ink, where that is near.

    ends: labels of the solids at start and end; a corner that was meant is led to the corner drawn.
    """
    start, end = (
        spot if label is None else _seen(spot, solids[label])
        for spot, label in zip((link.start, link.end), ends, strict=True)
    )
    return link if start == end else replace(link, start=start, end=end)


def _seen(spot: Point, solid: Drawn) -> Point:
    """The ink that stands for a spot of the boundary: the nearest, or at a corner what sticks out most."""
    ink = np.concatenate([resample(stroke.points, 128) for stroke in solid.strokes])
    steps = ink - spot
    away = np.linalg.norm(steps, axis=1)
    cost = away
    if isinstance(solid.shape, Polygon) and np.isclose(solid.shape.vertices, spot).all(axis=1).any():
        outward = spot - centroid(solid.shape.vertices)
        cost = RULE.corner_pull * away - steps @ outward / np.linalg.norm(outward)
    best = int(np.argmin(np.where(away <= RULE.regard, cost, np.inf)))
    return (float(ink[best, 0]), float(ink[best, 1])) if away[best] <= RULE.regard else spot


def tap(shape: Solid, rng: np.random.Generator) -> FloatArray:
    """A dot inside a solid, near its middle: the pen comes down, hardly slides, and leaves."""
    middle = np.asarray(shape.centre) if isinstance(shape, Circle) else centroid(shape.vertices)
    room = max(0.0, -signed_distance(shape, (float(middle[0]), float(middle[1]))) - 4 * RULE.tap)
    spot = middle + 0.5 * room * rng.uniform(-1, 1, 2) / np.sqrt(2)
    return spot + RULE.tap * np.cumsum(rng.standard_normal((int(rng.integers(1, 4)), 2)), axis=0) / 2


def _closing(perimeter: float, writer: Writer, rng: np.random.Generator) -> float:
    """How far past its beginning a loop ends, fraction of its perimeter; negative: it stays open."""
    most = RULE.closing_most / perimeter
    return float(np.clip(writer.gap + RULE.closing * rng.standard_normal(), -most, most))


def _circle(shape: Circle, writer: Writer, rng: np.random.Generator) -> FloatArray:
    oval = float(np.exp(0.5 * RULE.oval * rng.standard_normal()))
    centre = np.asarray(shape.centre) + 2 * RULE.shifted * shape.radius * rng.standard_normal(2)
    start = -np.pi / 2 + 0.4 * rng.standard_normal()
    if rng.random() >= RULE.upright:
        start = rng.uniform(-np.pi, np.pi)
    # Anti-clockwise to the eye is the school's way round; every third circle goes the other.
    way = -1.0 if rng.random() < 2 / 3 else 1.0
    sweep = way * 2 * np.pi * (1 + _closing(2 * np.pi * shape.radius, writer, rng))
    radii = (shape.radius * oval, shape.radius / oval)
    return ideals.superellipse((float(centre[0]), float(centre[1])), radii, float(start), sweep)


def _in_arcs(path: FloatArray, writer: Writer, rng: np.random.Generator) -> list[FloatArray]:
    """Few who lift the pen within boxes do so within rings: two arcs, the second from either end."""
    lifted, cut, again = rng.random(3).tolist()
    if lifted >= RULE.arcs * writer.pieces:
        return [path]
    at = int(len(path) * (0.35 + 0.3 * cut))
    return [path[: at + 1], path[at:] if again < 0.5 else path[at:][::-1]]


def _polygon(shape: Polygon, writer: Writer, rng: np.random.Generator) -> list[FloatArray]:
    count = len(shape.vertices)
    stray = min(RULE.corner * diagonal(shape.vertices), RULE.corner_most)
    corners = shape.vertices + stray * rng.standard_normal((count, 2))
    if rng.random() < 0.5:
        corners = corners[::-1]
    first = int(np.argmin(corners.sum(axis=1))) if rng.random() < RULE.upright else int(rng.integers(count))
    corners = np.roll(corners, -first, axis=0)
    if rng.random() >= writer.pieces:
        perimeter = path_length(outline(shape))
        start = float(rng.uniform(0.2, 0.8)) if rng.random() < RULE.mid_side else 0.0
        return [ideals.polygon(corners, start, _closing(perimeter, writer, rng))]
    # Pen lifts at some corners: 2 strokes up to one for each side.
    lifts = int(rng.integers(2, count + 1))
    breaks = [0, *sorted(rng.choice(np.arange(1, count), lifts - 1, replace=False).tolist()), count]
    loop = np.concatenate([corners, corners[:1]])
    return [_with_loose_ends(loop[a : b + 1], stray, rng) for a, b in pairwise(breaks)]


def _with_loose_ends(path: FloatArray, stray: float, rng: np.random.Generator) -> FloatArray:
    """A stroke of a polygon drawn in pieces: its ends miss the corners a little; any direction."""
    moved = path.copy()
    moved[[0, -1]] += min(stray, RULE.joint * path_length(path)) * rng.standard_normal((2, 2))
    return moved if rng.random() < 0.7 else moved[::-1]


def _spring(shape: Spring, writer: Writer, rng: np.random.Generator) -> FloatArray:
    start, end = _either_way(*_loose_ends(shape, rng), rng)
    lead = float(rng.uniform(0.06, 0.18))
    if rng.random() >= writer.zigzag:
        return ideals.coil(start, end, shape.coils, shape.width, lead, float(rng.uniform(0.3, 0.55)))
    legs = 2 * max(2, round(shape.coils))
    spacing = np.exp(RULE.zigzag_uneven * rng.standard_normal(legs))
    heights = np.exp(RULE.zigzag_uneven * rng.standard_normal(legs - 1))
    return ideals.zigzag(start, end, legs, shape.width, lead, spacing.tolist(), heights.tolist())


def _loose_ends(link: Spring | Wire, rng: np.random.Generator) -> tuple[Point, Point]:
    """Where the pen really means to begin and end: near the boundaries, not on them."""
    start, end = np.asarray(link.start), np.asarray(link.end)
    along = (end - start) / np.linalg.norm(end - start)
    frame = np.array([along, [-along[1], along[0]]])
    stray = rng.standard_normal((2, 2)) * [RULE.end, RULE.aside]
    stray = np.clip(stray, -RULE.end_most, RULE.end_most) @ frame
    start, end = start + stray[0], end + stray[1]
    return (float(start[0]), float(start[1])), (float(end[0]), float(end[1]))


def _either_way(start: Point, end: Point, rng: np.random.Generator) -> tuple[Point, Point]:
    """Two of three are drawn from the start on, as the eye goes: downwards or to the right."""
    return (start, end) if rng.random() < 2 / 3 else (end, start)
