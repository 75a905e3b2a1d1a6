"""Closed strokes: where the outline closes, what hangs over, how round and how convex it is.

Frame: a path whose bounding box has a diagonal of 1 (lengths are fractions of the stroke's size).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from recognizer.geometric.crossings import crossings
from sketch.geometry import path_length, resample, signed_area, turning
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class RingRule:
    """How a ring is looked for."""

    overlap: float = 0.3
    """Share of the path at either end that may hang over: a circle is often closed with a third of
    a turn to spare, while the loop of a 6 or a 9 leaves more than that outside."""
    patience: float = 0.1
    """Path cut away must bring the ends nearer by a tenth of its length, or it is left on."""
    open: float = 0.5
    """Ends this far apart close nothing: half a circle's do. It spares most strokes the rest."""
    points: int = 48
    """Points of the ring, closed: a circle's sagitta between them is 0.2 % of its radius."""
    coarse: int = 16
    """Points on which convexity is judged: sides of a tenth of the outline or more, no tremor."""


RING = RingRule()


@dataclass(frozen=True, slots=True, eq=False)
class Ring:
    """points: (RING.points + 1, 2), the last equal to the first, begun at the point farthest from
    the centre (a convex polygon's corner); first, last: where on the path it begins and ends;
    gap: between its ends; loose: how far what was cut off strays from it; area; roundness: spread
    of the radii after the affine map that makes an ellipse a circle (0 for any ellipse, 0.11 for
    any parallelogram, 0.19 for any triangle); radius: of the circle of the same area; aspect:
    smaller over larger axis; fullness: 4π area / perimeter² (1 for a circle, 0.6 for an equilateral
    triangle, 0 for a line); wrong_way: share of the turning that turns the other way; crosses: how
    often it crosses itself."""

    points: FloatArray
    first: int
    last: int
    gap: float
    loose: float
    area: float
    roundness: float
    radius: float
    aspect: float
    fullness: float
    wrong_way: float
    crosses: int


def ring(path: FloatArray, rule: RingRule = RING) -> Ring | None:
    """The closed outline within a path of equally spaced points (n, 2); None where nothing is
    enclosed, or the ends stay apart."""
    first, last = closing_points(path, rule)
    gap = float(np.hypot(*(path[first] - path[last])))
    if gap > rule.open:
        return None
    outline = path[first : last + 1]
    closed = resample(np.concatenate([outline, outline[:1]]), rule.points + 1)
    closed[-1] = closed[0]
    perimeter = path_length(closed)
    area = abs(signed_area(closed[:-1]))
    if area < 1e-6 * perimeter**2:
        return None
    centre, moments = area_moments(closed[:-1])
    spread = np.linalg.eigvalsh(moments)
    if spread[0] <= 1e-9 * spread[1]:
        return None
    rays = closed[:-1] - centre
    radii = np.sqrt(((rays @ np.linalg.inv(moments)) * rays).sum(axis=1))
    corner = int(np.argmax(radii))
    begun = np.concatenate([closed[corner:-1], closed[: corner + 1]])
    bends = turning(np.concatenate([(coarse := closed[:: rule.points // rule.coarse]), coarse[1:2]]))
    sense = np.sign(bends.sum())
    return Ring(
        points=begun,
        first=first,
        last=last,
        gap=gap,
        loose=_stray(path, first, last),
        area=area,
        roundness=float(radii.std() / radii.mean()),
        radius=float(np.sqrt(area / np.pi)),
        aspect=float(np.sqrt(spread[0] / spread[1])),
        fullness=float(4 * np.pi * area / perimeter**2),
        wrong_way=float(-(sense * bends).clip(max=0.0).sum() / (np.abs(bends).sum() + 1e-9)),
        crosses=_inner_crossings(closed),
    )


def closing_points(path: FloatArray, rule: RingRule = RING) -> tuple[int, int]:
    """Indices near the two ends between which the outline closes best."""
    reach = max(round(rule.overlap * (len(path) - 1)), 1)
    head, tail = path[:reach], path[-reach:]
    step = path_length(path) / (len(path) - 1)
    away = np.hypot(head[:, None, 0] - tail[None, :, 0], head[:, None, 1] - tail[None, :, 1])
    cut = np.arange(reach)[:, None] + np.arange(reach)[None, ::-1]
    best = int(np.argmin(away + rule.patience * step * cut))
    return best // reach, len(path) - reach + best % reach


def area_moments(vertices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Centroid (2,) and second central moments over area (2, 2) of a polygon's inside. They map with
    any affine map, whatever the spacing of the vertices."""
    origin = vertices.mean(axis=0)
    here = vertices - origin
    there = np.concatenate([here[1:], here[:1]])
    cross = here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]
    area = 0.5 * cross.sum()
    centre = cross @ (here + there) / (6 * area)
    mixed = (here * cross[:, None]).T @ there
    squares = (here * cross[:, None]).T @ here + (there * cross[:, None]).T @ there
    second = (squares + 0.5 * (mixed + mixed.T)) / (12 * area)
    return centre + origin, second - np.outer(centre, centre)


def _stray(path: FloatArray, first: int, last: int) -> float:
    """Largest distance from the cut-off ends to the outline."""
    cut = np.concatenate([path[:first], path[last + 1 :]])
    if len(cut) == 0:
        return 0.0
    outline = path[first : last + 1]
    away = np.hypot(cut[:, None, 0] - outline[None, :, 0], cut[:, None, 1] - outline[None, :, 1])
    return float(away.min(axis=1).max())


def _inner_crossings(closed: FloatArray) -> int:
    """Crossings of a closed outline away from its seam, where a pen that closes it may wander."""
    found = crossings(closed)
    margin = 0.06 * len(closed)
    seam = (found[:, 0] < margin) & (found[:, 1] > len(closed) - 1 - margin) if len(found) else np.empty(0)
    return int(len(found) - seam.sum())
