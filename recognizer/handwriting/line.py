"""Strokes made ready to be read: equal spacing, boxes, the scale of their line, and what may be one sign.

Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from recognizer.handwriting.kernels import CHANNELS, IMAGES, NUMBERS, POINTS, SIDE, Floats, Indices, looks
from sketch.geometry import distinct, path_length, resample
from sketch.ink import FloatArray, Stroke

Group = tuple[int, ...]
"""Strokes that may be one sign, in drawing order: positions in their line."""


@dataclass(frozen=True, slots=True)
class GroupRule:
    """Which strokes may be one sign."""

    points: int = 40
    """Points of equal spacing that stand for a stroke."""
    near: float = 0.42
    """Gap between the boxes of two strokes of one sign at most, in the line's scale."""
    letters: float = 0.9
    """The same between the letters of a word."""
    dotted: float = 1.1
    """The same where one of them is a dot: those of i and j stand high."""
    dot: float = 0.22
    """A stroke smaller than this, in the line's scale, is a dot."""
    short: float = 0.35
    """A stroke smaller than this may be the dot of an i that stands"""
    aside: float = 0.15
    """at most this far beside it and"""
    high: float = 1.6
    """this high above it, in the line's scale."""
    delayed: int = 5
    """Nearest strokes that a stroke may be of one sign with although others were drawn between them."""
    strokes: int = 4
    """Strokes of one sign at most, but for a word."""
    word: int = 7
    """Strokes of the name of a function at most; they follow one another."""
    apart: int = 2
    """Strokes of a sign at most whose strokes do not follow one another."""
    step: float = 1.15
    """The scale of a line is a power of this: one stroke more seldom changes it."""
    upright: float = 0.5
    """Height over width above which a stroke tells the height of letters."""
    quantile: float = 0.6


RULE = GroupRule()


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """Strokes of one line: points (n, 2) one below the other, ends (s,), boxes (s, 4), scale in page units."""

    points: FloatArray
    ends: Indices
    boxes: FloatArray
    scale: float

    def __len__(self) -> int:
        return len(self.ends)


def spaced(stroke: Stroke, rule: GroupRule = RULE) -> FloatArray:
    """The stroke at equal spacing, (points, 2); a dot is one point."""
    path = distinct(stroke.points)
    if len(path) == 1 or path_length(path) == 0.0:
        return path[:1]
    return resample(path, rule.points)


def line_of(paths: Sequence[FloatArray], scale: float | None = None) -> Line:
    """A line of strokes at equal spacing, at least one; its scale is found where it is not given."""
    boxes = np.array([np.concatenate([path.min(axis=0), path.max(axis=0)]) for path in paths])
    ends = np.cumsum([len(path) for path in paths])
    return Line(np.concatenate(paths), ends, boxes, scale or scale_of(boxes))


def scale_of(boxes: FloatArray, rule: GroupRule = RULE) -> float:
    """The height of a letter, page units: a quantile of the heights of upright strokes, rounded in its logarithm."""
    width, height = boxes[:, 2] - boxes[:, 0], boxes[:, 3] - boxes[:, 1]
    size = np.maximum(width, height)
    largest = float(size.max())
    if largest <= 0:
        return 1.0
    told = (height > rule.upright * width) & (height > 0.15 * largest / max(1.0, len(boxes) ** 0.5))
    found = (
        float(np.quantile(height[told], rule.quantile))
        if told.any()
        else 0.8 * float(np.median(size[size > 0]))
    )
    return float(rule.step ** np.round(np.log(found) / np.log(rule.step)))


def groups(line: Line, rule: GroupRule = RULE) -> list[Group]:
    """Every set of strokes that may be one sign: near one another and drawn one after another, or two strokes
    that are near though others were drawn between them."""
    count = len(line)
    near = neighbours(line, rule)
    beside = neighbours(line, replace(rule, near=rule.letters))
    found: set[Group] = {(k,) for k in range(count)}
    for start in range(count):
        for end in range(start + 2, min(start + rule.word, count) + 1):
            group = tuple(range(start, end))
            if (len(group) <= rule.strokes + 1 and near[start:end, start:end].any(axis=1).all()) or (
                beside[start:end, start:end].any(axis=1).all() and _in_a_row(line, group)
            ):
                found.add(group)
    for i, j in _delayed(line, near, rule):
        found.add((i, j))
        for k in (i + 1, j + 1, j - 1):
            if k < count and k not in (i, j) and (near[k, i] or near[k, j]):
                found.add(tuple(sorted((i, j, k))))
    return sorted(found)


def _delayed(
    line: Line, near: np.ndarray[tuple[int, int], np.dtype[np.bool_]], rule: GroupRule
) -> list[tuple[int, int]]:
    """Near strokes between which others were drawn, each with the nearest few: scribbles would have thousands."""
    middle = 0.5 * (line.boxes[:, :2] + line.boxes[:, 2:])
    away = np.where(near, np.linalg.norm(middle[:, None] - middle[None], axis=2), np.inf)
    rank = np.argsort(np.argsort(away, axis=1), axis=1)
    chosen = np.triu(near & ((rank < rule.delayed) | (rule.delayed > rank.T)), 2)
    return [(int(i), int(j)) for i, j in np.argwhere(chosen)]


def neighbours(line: Line, rule: GroupRule = RULE) -> np.ndarray[tuple[int, int], np.dtype[np.bool_]]:
    """Which strokes are near enough to be of one sign, (s, s); none is its own neighbour."""
    low, high = line.boxes[:, :2], line.boxes[:, 2:]
    gap = np.maximum(np.maximum(low[:, None] - high[None], low[None] - high[:, None]), 0.0)
    away = np.hypot(gap[..., 0], gap[..., 1])
    size = (high - low).max(axis=1)
    small = size < rule.dot * line.scale
    reach = np.where(small[:, None] | small[None], rule.dotted, rule.near) * line.scale
    # Parallel bars (=) stand further apart than the strokes of a letter.
    flat = (high - low)[:, 1] < 0.35 * (high - low)[:, 0]
    over = (gap[..., 0] == 0) & flat[:, None] & flat[None]
    near = away <= np.where(over, 0.9 * line.scale, reach)
    # The dot of an i may be a short stroke, and fly high.
    short = size < rule.short * line.scale
    near |= (
        (short[:, None] | short[None])
        & (gap[..., 0] < rule.aside * line.scale)
        & (gap[..., 1] < rule.high * line.scale)
    )
    np.fill_diagonal(near, False)
    return near


def _in_a_row(line: Line, group: Group) -> bool:
    """Whether the strokes stand side by side like letters of a word, and none of them is larger than one."""
    boxes = line.boxes[list(group)]
    size = (boxes[:, 2:] - boxes[:, :2]).max()
    return bool(np.ptp(boxes[:, [0, 2]]) > np.ptp(boxes[:, [1, 3]]) and size < 3.5 * line.scale)


@dataclass(frozen=True, slots=True, eq=False)
class Looks:
    """What the net is shown of B groups: sequence (B, 5, 64), images (B, 3, 28, 28), numbers (B, 6)."""

    sequence: Floats
    images: Floats
    numbers: Floats


def looks_of(line: Line, found: Sequence[Group], alone: bool = False) -> Looks:
    """The groups as the net is shown them; alone: as if nothing else were on the page, and of no known size."""
    batch = len(found)
    sequence = np.zeros((batch, CHANNELS, POINTS), dtype=np.float32)
    images = np.zeros((batch, IMAGES, SIDE, SIDE), dtype=np.float32)
    numbers = np.zeros((batch, NUMBERS), dtype=np.float32)
    members = np.array([k for group in found for k in group], dtype=np.int64)
    ends = np.cumsum([len(group) for group in found])
    scales = np.full(batch, line.scale)
    looks(
        line.points,
        line.ends,
        line.boxes,
        members,
        ends,
        scales,
        np.full(batch, alone),
        sequence,
        images,
        numbers,
    )
    return Looks(sequence, images, numbers)


def box_of(line: Line, group: Group) -> FloatArray:
    """(left, top, right, bottom) of a group."""
    boxes = line.boxes[list(group)]
    return np.concatenate([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])


def follows(group: Group) -> bool:
    """Whether the strokes were drawn one after another."""
    return all(b == a + 1 for a, b in pairwise(group))
