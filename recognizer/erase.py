"""What gestures have to do with other ink (row P3): a scribble takes away what it goes over.

Frame: page units, y down. The strokes stay in the ink; nobody claims them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from sketch.ink import Ink
from sketch.page import StrokeKind


@dataclass(frozen=True, slots=True)
class EraseRule:
    """What counts as gone over."""

    hits: int = 3
    """Crossings of one stroke: a scribble passes to and fro over what it erases."""
    covered: float = 0.4
    """Share of a stroke's points within the scribble's hull: a small letter may be crossed once, and a long line
    is rubbed out by its middle."""
    filled: float = 0.35
    """Share of the hull of a stroke that the scribble's hull fills: a ring may be rubbed out from within."""
    latest: int = 64
    """Latest earlier strokes within a scribble's box that are looked at: more than a formula."""


ERASE = EraseRule()


def erased(ink: Ink, kinds: Sequence[StrokeKind | None], rule: EraseRule = ERASE) -> set[int]:
    """Indices of the strokes that later scribbles erase. Gestures are not erased, but for taps: a tap goes with
    what it was on."""
    scribbles = [index for index, kind in enumerate(kinds) if kind == "scribble"]
    if not scribbles:
        return set()
    lines = _lines(ink)
    tree = shapely.STRtree(lines)
    gone: set[int] = set()
    for scribble in scribbles:
        gone.update(_gone_over(ink, kinds, lines, tree, scribble, rule))
        under = tree.query(lines[scribble].convex_hull, predicate="contains").tolist()
        gone.update(index for index in under if index < scribble and kinds[index] == "tap")
    return gone


def without_object(ink: Ink, kinds: Sequence[StrokeKind | None], rule: EraseRule = ERASE) -> set[int]:
    """Indices of the gestures that can mean nothing: scribbles that go over no earlier stroke (a spring
    meets what it hangs on, but at its ends), lassos whose hull contains none but dots."""
    gestures = [index for index, kind in enumerate(kinds) if kind in ("scribble", "lasso")]
    if not gestures:
        return set()
    lines = _lines(ink)
    tree = shapely.STRtree(lines)
    idle: set[int] = set()
    for index in gestures:
        if kinds[index] == "scribble":
            met = _gone_over(ink, kinds, lines, tree, index, rule)
        else:
            met = tree.query(lines[index].convex_hull, predicate="contains").tolist()
        if not any(other < index and kinds[other] != "tap" for other in met):
            idle.add(index)
    return idle


def _gone_over(
    ink: Ink,
    kinds: Sequence[StrokeKind | None],
    lines: Sequence[shapely.LineString],
    tree: shapely.STRtree,
    scribble: int,
    rule: EraseRule,
) -> list[int]:
    """The earlier strokes, no gestures, that a scribble covers or crosses to and fro."""
    near = tree.query(lines[scribble])
    hull = lines[scribble].convex_hull
    shapely.prepare(hull)
    return [
        index
        for index in np.sort(near[near < scribble])[-rule.latest :].tolist()
        if kinds[index] not in ("scribble", "lasso", "tap")
        and (
            float(shapely.contains_xy(hull, *ink[index].points.T).mean()) >= rule.covered
            or _filled(hull, lines[index].convex_hull) >= rule.filled
            or _crossings(lines[scribble], lines[index]) >= rule.hits
        )
    ]


def _lines(ink: Ink) -> list[shapely.LineString]:
    """Each stroke as a line; a dot as one of no length."""
    return [shapely.LineString(np.repeat(s.points, 2, axis=0) if len(s) == 1 else s.points) for s in ink]


def _filled(hull: BaseGeometry, other: BaseGeometry) -> float:
    """Share of the other hull's area that lies in the hull; 0 for one without area."""
    return hull.intersection(other).area / other.area if other.area > 0 else 0.0


def _crossings(one: shapely.LineString, other: shapely.LineString) -> int:
    return int(shapely.get_num_geometries(shapely.intersection(one, other)))
