"""ShortStraw and IStraw: published corner finders, to measure ours beside (`benchmarks/corners.py`).

A straw is the distance between two points of an equally spaced path a window apart: short where the path
turns. ShortStraw: A. Wolin, B. Eoff, T. Hammond, "ShortStraw: a simple and effective corner finder for
polylines", SBIM 2008. IStraw: Y. Xiong, J. LaViola, "A ShortStraw-based algorithm for corner finding in
sketch-based interfaces", Computers & Graphics 34 (2010): straws at the ends too, points that the pen dwells
at, line tests that grow stricter with length, corners moved to the sharpest point near, sharp noise taken
out, and a test of every corner by two windows that tells curves from corners. Written from the papers'
ideas and numbers as their readers report them, since neither text was at hand: figures stand for the
method, not for its authors' program.

Frame: the stroke's own; seconds.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import degrees

import numpy as np

from sketch.geometry import arc_lengths, diagonal, resample
from sketch.ink import FloatArray, Stroke


@dataclass(frozen=True, slots=True)
class StrawRule:
    """The papers' numbers."""

    spacing: float = 1 / 40
    """Distance between points over the bounding box's diagonal."""
    window: int = 3
    """Points from a straw's middle to either end."""
    short: float = 0.95
    """Straws below this share of the median (ShortStraw) or the mean (IStraw) are candidates."""
    line: float = 0.95
    """Chord over path of a line, ShortStraw."""
    line_test: float = 0.975
    """The same of IStraw, where missing corners are looked for,"""
    collinear: float = 0.9747
    """and where a corner between two others may be none;"""
    long: int = 10
    """points between them from which that is stricter by"""
    stricter: float = 0.0053
    dwell: float = 2.0
    """Time between two points over the mean, from which the pen dwelt there: IStraw."""
    wide: int = 12
    """Points to either side of a corner in IStraw's wide window; a third of it in the narrow one."""


RULE = StrawRule()


def short_straw(stroke: Stroke, rule: StrawRule = RULE) -> FloatArray:
    """The inner corners that ShortStraw finds, in drawing order: (k, 2)."""
    points, _ = _even(stroke, rule)
    if len(points) <= 2 * rule.window + 1:
        return np.empty((0, 2))
    straws = np.full(len(points), np.inf)
    straws[rule.window : -rule.window] = _straws(points, rule.window)
    limit = rule.short * float(np.median(straws[np.isfinite(straws)]))
    found = _with_missing(points, straws, [0, *_minima(straws, limit), len(points) - 1], rule.line)
    kept = [found[0]]
    for here, after in pairwise(found[1:]):
        if not _is_line(points, kept[-1], after, rule.line):
            kept.append(here)
    return points[kept[1:]]


def istraw(stroke: Stroke, rule: StrawRule = RULE) -> FloatArray:
    """The inner corners that IStraw finds in a stroke of lines and curves, in drawing order: (k, 2)."""
    points, times = _even(stroke, rule)
    count, window = len(points), rule.window
    if count <= 2 * window + 1:
        return np.empty((0, 2))
    straws = np.empty(count)
    straws[window:-window] = _straws(points, window)
    for index in range(window):  # near the ends as much of a straw as there is, stretched to a whole one
        share = 2 * window / (index + window)
        straws[index] = share * float(np.hypot(*(points[index + window] - points[0])))
        straws[-1 - index] = share * float(np.hypot(*(points[-1 - index - window] - points[-1])))
    inner = _minima(straws, rule.short * float(straws.mean()))
    if times is not None:
        inner = _with_dwelling(inner, times, rule)
    found = [0, *(i for i in inner if 0 < i < count - 1), count - 1]
    found = _with_missing(points, straws, found, rule.line_test)
    found = _sharpened(points, found, rule)
    found = _without_collinear(points, found, rule)
    found = _without_noise(found, straws, rule)
    return points[_without_curves(points, found, rule)[1:-1]]


def _even(stroke: Stroke, rule: StrawRule) -> tuple[FloatArray, FloatArray | None]:
    """Points at the papers' spacing, and the times at which the pen passed them."""
    size = diagonal(stroke.points)
    if size == 0:
        return stroke.points[:1], None
    travelled = arc_lengths(stroke.points)
    count = max(round(float(travelled[-1]) / (rule.spacing * size)), 1) + 1
    if stroke.times is None:
        return resample(stroke.points, count), None
    wanted = np.linspace(0.0, float(travelled[-1]), count)
    return resample(stroke.points, count), np.interp(wanted, travelled, stroke.times)


def _straws(points: FloatArray, window: int) -> FloatArray:
    return np.hypot(*(points[2 * window :] - points[: -2 * window]).T)


def _minima(straws: FloatArray, limit: float) -> list[int]:
    """The shortest straw of every run of straws below the limit."""
    below = np.flatnonzero(straws < limit)
    runs = np.split(below, np.flatnonzero(np.diff(below) > 1) + 1) if len(below) else []
    return [int(run[np.argmin(straws[run])]) for run in runs]


def _is_line(points: FloatArray, first: int, last: int, ratio: float) -> bool:
    path = float(arc_lengths(points[first : last + 1])[-1])
    return path == 0 or float(np.hypot(*(points[last] - points[first]))) / path > ratio


def _with_missing(points: FloatArray, straws: FloatArray, found: list[int], ratio: float) -> list[int]:
    """More corners where neighbouring ones have no line between them: the shortest straw of the middle half."""
    done = [found[0]]
    waiting = found[:0:-1]
    while waiting:
        first, last = done[-1], waiting[-1]
        quarter = (last - first) // 4
        if quarter >= 1 and not _is_line(points, first, last, ratio):
            middle = np.arange(first + quarter, last - quarter + 1)
            waiting.append(int(middle[np.argmin(straws[middle])]))
        else:
            done.append(waiting.pop())
    return done


def _with_dwelling(found: list[int], times: FloatArray, rule: StrawRule) -> list[int]:
    """More corners where the pen dwelt, away from those there are."""
    spent = np.diff(times)
    limit = rule.dwell * float(spent.mean())
    slow = [i for i in _minima(-spent, -limit) if all(abs(i - other) > rule.window for other in found)]
    return sorted([*found, *slow])


def _sharpened(points: FloatArray, found: list[int], rule: StrawRule) -> list[int]:
    """Each corner at the sharpest of the seven points about it."""
    moved = [found[0]]
    for corner in found[1:-1]:
        near = range(max(corner - rule.window, 1), min(corner + rule.window, len(points) - 2) + 1)
        best = min(near, key=lambda i: _angle(points, i, 2))
        if best > moved[-1]:
            moved.append(best)
    return [*moved, found[-1]]


def _without_collinear(points: FloatArray, found: list[int], rule: StrawRule) -> list[int]:
    kept = [found[0]]
    for here, after in pairwise(found[1:]):
        stricter = rule.stricter if after - kept[-1] > rule.long else 0.0
        if not _is_line(points, kept[-1], after, rule.collinear + stricter):
            kept.append(here)
    return [*kept, found[-1]]


def _without_noise(found: list[int], straws: FloatArray, rule: StrawRule) -> list[int]:
    """Of two corners within a straw of one another the one with the shorter straw; none so near an end."""
    kept = [found[0]]
    for corner in found[1:-1]:
        if corner - kept[-1] >= rule.window:
            kept.append(corner)
        elif len(kept) > 1 and straws[corner] < straws[kept[-1]]:
            kept[-1] = corner
    if len(kept) > 1 and found[-1] - kept[-1] < rule.window:
        kept.pop()
    return [*kept, found[-1]]


def _without_curves(points: FloatArray, found: list[int], rule: StrawRule) -> list[int]:
    """The corners at which the narrow window's angle is not much flatter than the wide one's: a curve's is,
    a corner's is the same in both."""
    kept = [found[0]]
    for here, after in pairwise(found[1:]):
        back, on = min(rule.wide, here - kept[-1]), min(rule.wide, after - here)
        wide = _opening(points, here, back, on)
        narrow = _opening(points, here, max(back // 3, 1), max(on // 3, 1))
        if narrow - wide <= 10 + 800 / (wide + 35):
            kept.append(here)
    return [*kept, found[-1]]


def _angle(points: FloatArray, index: int, reach: int) -> float:
    return _opening(points, index, min(reach, index), min(reach, len(points) - 1 - index))


def _opening(points: FloatArray, index: int, back: int, on: int) -> float:
    """Angle at a point between the points `back` before and `on` after it, degrees: 180 on a line."""
    before, after = points[index - back] - points[index], points[index + on] - points[index]
    cross = before[0] * after[1] - before[1] * after[0]
    return degrees(abs(float(np.arctan2(cross, before @ after))))
