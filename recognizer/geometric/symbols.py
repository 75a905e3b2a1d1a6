"""Straight strokes that make a sign together with others: a +, a T, an N, the bar of a 7.

A wire runs between shapes (row R3): where a straight stroke meets another open stroke, and neither ends at
a shape, they are strokes of one sign. Frame: page units, y down.
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
    alike: float = 4.0
    """Size of one stroke over the other's, at most: what is written together is written alike."""
    shape: float = 0.15
    """Gap between a stroke and an outline, over the stroke's size, where it may be attached."""


SIGNS = SignRule()


def signs(ink: Ink, straight: Sequence[int], letters: Sequence[int], rule: SignRule = SIGNS) -> set[int]:
    """Those of the straight strokes that meet one another, or one of the letters' strokes. None of them is to
    end at a shape."""
    strokes = [*straight, *letters]
    if len(straight) == 0 or len(strokes) < 2:
        return set()
    sizes = np.array([diagonal(ink[index].points) for index in strokes])
    lines = np.array([shapely.LineString(np.repeat(ink[i].points, 2, axis=0)) for i in strokes])
    count = len(straight)
    one, other = shapely.STRtree(lines).query(
        lines[:count], predicate="dwithin", distance=rule.near * sizes[:count]
    )
    larger, smaller = np.maximum(sizes[one], sizes[other]), np.minimum(sizes[one], sizes[other])
    met = one[(one != other) & (larger <= rule.alike * smaller)]
    return {straight[position] for position in np.unique(met).tolist()}


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
