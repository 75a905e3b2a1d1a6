"""Arrows in one stroke: a shaft, then a head that falls back from the tip on both sides.

Frame: equally spaced points of a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

import numpy as np

from recognizer.geometric.cusps import bends
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class ArrowRule:
    """Where shaft and head are looked for."""

    shaft: float = 0.3
    """The first part of the path, as a share of its length, that gives the shaft's direction. The
    shaft itself is at least that: a head has two or four strokes of a third of the shaft."""
    tip: float = 0.3
    """The tip lies within this share of the farthest point's distance of it: when the pen comes back to
    the tip between the barbs, it often overshoots, by up to half a barb."""
    turn: float = radians(80)
    """At the tip the pen turns by more than this: barbs come back at more than a right angle."""


ARROW = ArrowRule()


@dataclass(frozen=True, slots=True, eq=False)
class Head:
    """What follows the tip, in lengths of the shaft. tip: index of the tip; bow: rms distance of the
    shaft from its chord; fallback: how far the head reaches back from the tip; narrower, wider: its
    reach to its lesser and its greater side; ink: length of the head's path; sharpest: bend at the
    tip, radians."""

    tip: int
    bow: float
    fallback: float
    narrower: float
    wider: float
    ink: float
    sharpest: float


def head(path: FloatArray, rule: ArrowRule = ARROW) -> Head | None:
    """The head of an arrow drawn tail first; None where the path has no room for one."""
    count = len(path)
    aim = path[round(rule.shaft * (count - 1))] - path[0]
    length = float(np.hypot(*aim))
    if length == 0:
        return None
    along = (path - path[0]) @ (aim / length)
    farthest = float(along.max())
    sharpness = np.abs(bends(path))
    turned = np.flatnonzero((along >= farthest * (1 - rule.tip)) & (sharpness > rule.turn))
    if len(turned) == 0:
        return None
    tip = int(turned[0])
    tip += int(np.argmax(sharpness[tip : tip + 4]))
    shaft = path[tip] - path[0]
    length = float(np.hypot(*shaft))
    if tip < rule.shaft * (count - 1) or tip > count - 4 or length == 0:
        return None
    forward = shaft / length
    left = np.array([-forward[1], forward[0]])
    rest = (path[tip:] - path[tip]) / length
    across = rest @ left
    low, high = float(-across.min()), float(across.max())
    return Head(
        tip=tip,
        bow=float(np.sqrt((((path[: tip + 1] - path[0]) @ left / length) ** 2).mean())),
        fallback=float(-(rest @ forward).min()),
        narrower=min(low, high),
        wider=max(low, high),
        ink=float(np.hypot(*np.diff(rest, axis=0).T).sum()),
        sharpest=float(sharpness[tip]),
    )
