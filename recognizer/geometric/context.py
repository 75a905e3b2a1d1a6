"""What only the page can tell: taps, scribbles and lassos.

A dot is small beside the strokes around it; a scribble goes to and fro over ink that was there
before; a lasso closes round ink that was there before. Frame: page units, y down; lengths are
compared with other ink, so that the page's scale is no matter (but for a stroke alone on it).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log

import numpy as np
import shapely
from numpy.typing import NDArray

from recognizer.geometric.corners import corners
from recognizer.geometric.kernels.paths import extent_of
from recognizer.geometric.ring import Ring
from recognizer.geometric.rules import Seen
from recognizer.geometric.teeth import Teeth
from recognizer.group import boxes_of
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import STROKE_KINDS, GestureKind


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
    joint: float = 0.6
    """Gaps between a short side and the ends of the sides that it joins, over its length, at most: corners of planks are
    missed by half of the plank's thickness."""
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
    clear: float = log(0.5)
    """Evidence from which a stroke is clearly a polygon: more likely than not, taken by itself."""
    corners: int = 2
    """Corners of an outline, besides its ends, from which what looks like a polygon is one."""


GESTURES = GestureRule()
POLYGON = STROKE_KINDS.index("polygon")


def gestures(
    ink: Ink, looks: Sequence[Seen | None], rule: GestureRule = GESTURES
) -> list[GestureKind | None]:
    """For each stroke the gesture that its surroundings make it, or None. `looks`: what each looks like by itself. Those
    that are clearly polygons, with corners too, are no lassos, for a block may be drawn about another."""
    found: list[GestureKind | None] = [None] * len(ink)
    if len(ink) == 0:
        return found
    if len(ink) == 1:
        size = extent_of(np.ascontiguousarray(ink[0].points))
        return ["tap" if dots(ink, np.array([size]), rule)[0] else None]
    boxes = boxes_of(ink, range(len(ink)))
    sizes = np.hypot(boxes[:, 2] - boxes[:, 0], boxes[:, 3] - boxes[:, 1])
    tiny = dots(ink, sizes, rule)
    tiny[_sides(ink, tiny, sizes, rule)] = False
    covered = shapely.box(*boxes.T)
    drawn = np.flatnonzero(~tiny)
    if len(drawn) < len(ink):
        for index in np.flatnonzero(tiny).tolist():
            found[index] = "tap"
    over, under = shapely.STRtree(covered[drawn]).query(covered[drawn])
    before: dict[int, list[int]] = {}
    for index, other in zip(drawn[over].tolist(), drawn[under].tolist(), strict=True):
        if other < index:
            before.setdefault(index, []).append(other)
    for index, others in before.items():
        look = looks[index]
        if look is not None:
            found[index] = _gesture(ink, index, look, sorted(others)[-rule.looked_at :], sizes, rule)
    return found


def _sides(ink: Ink, tiny: NDArray[np.bool_], sizes: FloatArray, rule: GestureRule) -> list[int]:
    """Those of the tiny strokes that lead from one longer stroke's end to another's: the short side of a plank."""
    small = [index for index in np.flatnonzero(tiny).tolist() if sizes[index] > 0]
    ends = np.array([ink[index].points[end] for index in np.flatnonzero(~tiny).tolist() for end in (0, -1)])
    if not small or len(ends) < 2:
        return []
    found: list[int] = []
    for index in small:
        first, last = (np.hypot(*(ends - ink[index].points[end]).T) for end in (0, -1))
        here, there = int(first.argmin()), int(last.argmin())
        if here != there and max(first[here], last[there]) <= rule.joint * sizes[index]:
            found.append(index)
    return found


def _gesture(
    ink: Ink, index: int, look: Seen, earlier: Sequence[int], sizes: FloatArray, rule: GestureRule
) -> GestureKind | None:
    """The gesture that one stroke is over those of the earlier strokes in its box, or None."""
    stroke = ink[index]
    if is_scribble(stroke, look.swings, [ink[other] for other in earlier], rule):
        return "scribble"
    smaller = [other for other in earlier if sizes[other] < sizes[index]]
    small = [ink[other] for other in smaller if sizes[other] <= rule.worth * sizes[index]]
    worthy = [ink[other] for other in smaller if sizes[other] > rule.worth * sizes[index]]
    held = enclosed(stroke, look.outline, [*worthy, *small], rule)
    if sum(held) >= rule.several or (any(held[: len(worthy)]) and not _angular(stroke, look, rule)):
        return "lasso"
    return None


def dots(ink: Ink, sizes: FloatArray, rule: GestureRule = GESTURES) -> NDArray[np.bool_]:
    """Which strokes are dots, (n,); sizes (n,) page units are the strokes' diagonals."""
    if len(ink) == 1:
        lasted, size = _seconds(ink[0]), float(sizes[0])
        brief = len(ink[0]) <= rule.lone_points if lasted is None else lasted <= rule.lone_time
        return np.array([size == 0 or (size <= rule.lone_size and brief)])
    still = sizes == 0
    quick = np.array([(_seconds(stroke) or 0.0) <= rule.dot_time for stroke in ink])
    drawn = sizes[~still]
    if len(drawn) == 0:
        return still
    limit = min(rule.dot * float(np.median(drawn)), rule.dot_of_largest * float(drawn.max()))
    return still | (quick & (sizes <= limit))


def is_scribble(stroke: Stroke, swings: Teeth, earlier: list[Stroke], rule: GestureRule = GESTURES) -> bool:
    """Whether the stroke goes to and fro over one of the earlier strokes."""
    if swings.legs < rule.swings or swings.pitch > rule.dense * swings.height:
        return False
    line = shapely.LineString(stroke.points)
    lines = [shapely.LineString(other.points) for other in earlier if len(other) > 1]
    crossed = shapely.get_num_geometries(shapely.intersection(line, lines)) if lines else np.zeros(1)
    return bool((crossed >= rule.hits).any())


def _angular(stroke: Stroke, look: Seen, rule: GestureRule) -> bool:
    """Whether what is clearly a polygon has corners too."""
    polygon = float(look.beliefs[POLYGON]) > rule.clear
    return polygon and len(corners(stroke.points, stroke.times)) >= rule.corners


def enclosed(
    stroke: Stroke, outline: Ring | None, earlier: list[Stroke], rule: GestureRule = GESTURES
) -> list[bool]:
    """Which of the earlier strokes the stroke closes round."""
    nothing = [False] * len(earlier)
    if not earlier or outline is None or outline.gap > rule.gap or outline.loose > rule.loose:
        return nothing
    inside = shapely.Polygon(stroke.points)
    shapely.prepare(inside)
    return [float(shapely.contains_xy(inside, *other.points.T).mean()) >= rule.enclosed for other in earlier]


def _seconds(stroke: Stroke) -> float | None:
    return None if stroke.times is None else float(stroke.times[-1] - stroke.times[0])
