"""What only the page can tell: taps, scribbles and lassos.

A dot is small beside the strokes around it; a scribble goes to and fro over ink that was there
before; a lasso closes round ink that was there before. Frame: page units, y down; lengths are
compared with other ink, so that the page's scale is no matter (but for a stroke alone on it).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from recognizer.geometric.corners import corners
from recognizer.geometric.ring import ring
from recognizer.geometric.teeth import teeth
from recognizer.preprocess import spaced, unit_path
from sketch.geometry import diagonal, resample
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import GestureKind


@dataclass(frozen=True, slots=True)
class GestureRule:
    """What makes a stroke a gesture."""

    dot: float = 0.3
    """A tap's size over the median stroke's, at most: the dot of an i is a sixth of its stem, a
    comma half a small letter."""
    dot_of_largest: float = 0.08
    """The same over the page's largest stroke, where letters do not set the median: shapes on a page
    are seldom below a tenth of the largest."""
    dot_time: float = 0.4
    """Seconds a tap lasts, at most, where times are known: a slow click."""
    lone_size: float = 6.0
    """Page units (6 cm at 100 units to the metre). A stroke alone has nothing to be small beside."""
    lone_time: float = 0.15
    """Seconds a lone tap lasts, at most: the quickest line takes as long."""
    lone_points: int = 5
    """Points of a lone tap, at most, where times are not known: small ink in other units has more."""
    swings: int = 5
    """Legs of a scribble: a pen that erases goes there and back at least twice."""
    dense: float = 0.5
    """A scribble's pitch over its height, at most: it covers, where a wave or a spring passes over."""
    hits: int = 3
    """Crossings with one earlier stroke before a scribble means that stroke: a spring crosses the
    shape it ends at once or twice."""
    looked_at: int = 32
    """Latest of the earlier strokes in a gesture's box that are looked at: what people erase or select
    they drew lately, and a page of 10,000 strokes stays a matter of seconds."""
    gap: float = 0.3
    """Between the ends of a lasso, as a fraction of its size: drawn in haste."""
    loose: float = 0.2
    """Stray of a lasso's overhanging ends, as a fraction of its size."""
    enclosed: float = 0.9
    """Share of another stroke's points within a lasso before that stroke is meant."""
    worth: float = 0.1
    """Size of an enclosed stroke over the lasso's: smaller ones are dots and blemishes,"""
    several: int = 3
    """unless so many strokes are enclosed: a line of writing, which nobody draws a block about afterwards."""
    corners: int = 2
    """Corners of an outline, besides its ends, from which what looks like a polygon is one."""


GESTURES = GestureRule()


def gestures(ink: Ink, polygons: Sequence[bool], rule: GestureRule = GESTURES) -> list[GestureKind | None]:
    """For each stroke the gesture that its surroundings make it, or None. `polygons`: which strokes are
    clearly polygons in themselves: with corners too they are no lassos, for a block may be drawn about another."""
    found: list[GestureKind | None] = [None] * len(ink)
    if len(ink) == 0:
        return found
    sizes = np.array([diagonal(stroke.points) for stroke in ink])
    tiny = dots(ink, sizes, rule)
    if len(ink) == 1:
        return ["tap" if tiny[0] else None]
    boxes = shapely.box(*np.array([_box(stroke) for stroke in ink]).T)
    tree = shapely.STRtree(boxes)
    for index, stroke in enumerate(ink):
        if tiny[index]:
            found[index] = "tap"
            continue
        near = tree.query(boxes[index])
        earlier = np.sort(near[(near < index) & ~tiny[near]])[-rule.looked_at :].tolist()
        if not earlier:
            continue
        if is_scribble(stroke, [ink[other] for other in earlier], rule):
            found[index] = "scribble"
        else:
            smaller = [other for other in earlier if sizes[other] < sizes[index]]
            small = [ink[other] for other in smaller if sizes[other] <= rule.worth * sizes[index]]
            worthy = [ink[other] for other in smaller if sizes[other] > rule.worth * sizes[index]]
            held = enclosed(stroke, [*worthy, *small], rule)
            if sum(held) >= rule.several or (
                any(held[: len(worthy)]) and not _angular(stroke, polygons[index])
            ):
                found[index] = "lasso"
    return found


def dots(ink: Ink, sizes: FloatArray, rule: GestureRule = GESTURES) -> NDArray[np.bool_]:
    """Which strokes are dots, (n,); sizes (n,) page units are the strokes' diagonals."""
    still = sizes == 0
    if len(ink) == 1:
        lasted = _seconds(ink[0])
        brief = len(ink[0]) <= rule.lone_points if lasted is None else lasted <= rule.lone_time
        return still | ((sizes <= rule.lone_size) & brief)
    quick = np.array([(_seconds(stroke) or 0.0) <= rule.dot_time for stroke in ink])
    drawn = sizes[~still]
    if len(drawn) == 0:
        return still
    limit = min(rule.dot * float(np.median(drawn)), rule.dot_of_largest * float(drawn.max()))
    return still | (quick & (sizes <= limit))


def is_scribble(stroke: Stroke, earlier: list[Stroke], rule: GestureRule = GESTURES) -> bool:
    """Whether the stroke goes to and fro over one of the earlier strokes."""
    path = unit_path(stroke)
    found = teeth(spaced(path))
    if found.legs < rule.swings or found.pitch > rule.dense * found.height:
        return False
    line = shapely.LineString(stroke.points)
    lines = [shapely.LineString(other.points) for other in earlier if len(other) > 1]
    crossed = shapely.get_num_geometries(shapely.intersection(line, lines)) if lines else np.zeros(1)
    return bool((crossed >= rule.hits).any())


def _angular(stroke: Stroke, polygon: bool, rule: GestureRule = GESTURES) -> bool:
    """Whether what looks like a polygon has corners too."""
    return polygon and len(corners(stroke.points, stroke.times)) >= rule.corners


def enclosed(stroke: Stroke, earlier: list[Stroke], rule: GestureRule = GESTURES) -> list[bool]:
    """Which of the earlier strokes the stroke closes round."""
    nothing = [False] * len(earlier)
    if not earlier or len(stroke) < 3:
        return nothing
    outline = ring(resample(unit_path(stroke), 48))
    if outline is None or outline.gap > rule.gap or outline.loose > rule.loose:
        return nothing
    inside = shapely.Polygon(stroke.points)
    shapely.prepare(inside)
    return [float(shapely.contains_xy(inside, *other.points.T).mean()) >= rule.enclosed for other in earlier]


def _seconds(stroke: Stroke) -> float | None:
    return None if stroke.times is None else float(stroke.times[-1] - stroke.times[0])


def _box(stroke: Stroke) -> FloatArray:
    return np.concatenate([stroke.points.min(axis=0), stroke.points.max(axis=0)])
