"""Straight strokes that make a sign together: a +, a T, an H, an asterisk.

A wire runs between shapes (row R3): where a straight stroke meets another within its length, and neither
ends at a shape or is a side of one, they are strokes of one sign. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from sketch.geometry import diagonal
from sketch.ink import Ink


@dataclass(frozen=True, slots=True)
class SignRule:
    """What meets, and what is in the way."""

    near: float = 0.08
    """Gap between a stroke and one that ends at it, over the shorter's size: the bar of a T is missed by
    less."""
    inner: float = 0.15
    """Share of a stroke's length at either end that is its end: sides of a box overshoot by as much."""
    alike: float = 4.0
    """Size of one stroke over the other's, at most: what is written together is written alike."""
    shape: float = 0.15
    """Gap between a stroke and an outline, over the stroke's size, where it may be attached."""


SIGNS = SignRule()


def signs(ink: Ink, straight: Sequence[int], touching: Sequence[int], rule: SignRule = SIGNS) -> set[int]:
    """Those of the straight strokes that are strokes of signs. touching: strokes with an end at a shape."""
    free = [index for index in straight if index not in set(touching)]
    if len(free) < 2:
        return set()
    sizes = np.array([diagonal(ink[index].points) for index in free])
    lines = np.array([shapely.LineString(ink[index].points[[0, -1]]) for index in free])
    one, other = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=rule.near * sizes)
    larger, smaller = np.maximum(sizes[one], sizes[other]), np.minimum(sizes[one], sizes[other])
    alike = (one != other) & (larger <= rule.alike * smaller)
    one, other = one[alike], other[alike]
    meeting = shapely.get_point(shapely.shortest_line(lines[one], lines[other]), 1)
    place = shapely.line_locate_point(lines[other], meeting, normalized=True)
    within = (place > rule.inner) & (place < 1 - rule.inner)
    return {free[position] for position in np.union1d(one[within], other[within]).tolist()}


def attached(
    ink: Ink, strokes: Sequence[int], outlines: Sequence[int], rule: SignRule = SIGNS
) -> dict[int, int]:
    """How many ends of each of the strokes lie at or in one of the outlines; strokes with none are left out."""
    if not strokes or not outlines:
        return {}
    ends = shapely.points(np.array([ink[index].points[end] for index in strokes for end in (0, -1)]))
    reach = np.repeat([rule.shape * diagonal(ink[index].points) for index in strokes], 2)
    shapes = [shapely.LineString(ink[index].points) for index in outlines if len(ink[index]) > 1]
    pairs = shapely.STRtree(shapes).query(ends, predicate="dwithin", distance=reach)
    counts = np.bincount(np.unique(pairs[0]) // 2, minlength=len(strokes))
    return {index: int(count) for index, count in zip(strokes, counts, strict=True) if count}
