"""Arrows in one stroke: a shaft, then a head that falls back from the tip on both sides.

Frame: equally spaced points of a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

import numpy as np

from recognizer.geometric.cusps import CUSPS
from recognizer.geometric.kernels.heads import head_of
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
    tip, *measures = head_of(np.ascontiguousarray(path), CUSPS.reach, rule.shaft, rule.tip, rule.turn)
    return None if tip < 0 else Head(tip, *measures)
