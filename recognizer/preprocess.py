"""Cleaning that the rivals share: a stroke becomes a path that knows nothing of its origin.

In: a stroke in page units, y down, as the pen left it. Out: points at equal spacing on a path
whose bounding box has its corner at the origin and a diagonal of 1, so that where, how large and
how often sampled a stroke was no longer matters. Row P1 of FEATURES.md; equal spacing relative
to the stroke's size follows Wolin, Eoff and Hammond, ShortStraw (2008), section 3.1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sketch.geometry import bounding_box, distinct, path_length, resample
from sketch.ink import FloatArray, Stroke


@dataclass(frozen=True, slots=True)
class Spacing:
    """How finely a path is resampled."""

    step: float = 1 / 40
    """Distance between points as a fraction of the bounding box's diagonal: ShortStraw's choice,
    ten points on the side of a square whose corners are still corners."""
    fewest: int = 24
    """Points of a short path: enough for the windows of the detectors at both ends."""
    most: int = 256
    """Points of a long path. Crossings cost the square of it; 256 follow twelve coils."""


SPACING = Spacing()


def unit_path(stroke: Stroke) -> FloatArray:
    """The stroke's points, cleaned of repeats, moved and scaled to a bounding box from (0, 0) with
    a diagonal of 1: (m, 2), m >= 1. A dot, or a stroke that never moved, is the one point (0, 0).
    """
    low, high = bounding_box(stroke.points)
    size = float(np.hypot(*(high - low)))
    if size <= 1e-12 * float(np.abs(stroke.points).max()):
        return np.zeros((1, 2))
    return distinct((stroke.points - low) / size)


def spaced(path: FloatArray) -> FloatArray:
    """A unit path at equal spacing, about `SPACING.step` apart: (n, 2)."""
    return resample(path, points_for(path_length(path)))


def points_for(length: float) -> int:
    """Points of a unit path of this length."""
    return min(max(round(length / SPACING.step) + 1, SPACING.fewest), SPACING.most)
