"""Protractor: $1's comparison in closed form.

Li, "Protractor: a fast and accurate gesture recognizer", CHI 2010. Points: 16, about the centroid, turned as $1's
(whatever their orientation), made one vector of length 1. Distance: the angle between the two vectors once one
drawing is turned by the best angle, which has a closed form; radians.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from recognizer.templates.points import (
    Compared,
    as_one_stroke,
    centred,
    indicative_angle,
    positive,
    turned,
)
from sketch.ink import FloatArray, Ink

POINTS = 16


def normalised(drawings: Sequence[Ink]) -> FloatArray:
    """Drawings as vectors of length 1, (B, 16, 2)."""
    points = as_one_stroke(drawings, POINTS)
    return unit(turned(centred(points), -indicative_angle(points)))


def unit(points: FloatArray) -> FloatArray:
    """Sets of points, (B, n, 2), each scaled so that its squares sum to 1; those all at the origin stay."""
    return points / positive(np.sqrt((points**2).sum(axis=(1, 2))))[:, None, None]


def angles(drawings: FloatArray, templates: FloatArray) -> FloatArray:
    """The angle between each drawing (B, n, 2) and template (T, n, 2) after the best turn, (B, T) radians.

    With a the dot product and b the cross product, turning by θ = atan(b / a) makes the dot product a cos θ +
    b sin θ, which is the length of (a, b) with the sign of a.
    """
    a = np.tensordot(drawings, templates, axes=([1, 2], [1, 2]))
    b = drawings[..., 0] @ templates[..., 1].T - drawings[..., 1] @ templates[..., 0].T
    return np.arccos(np.clip(np.copysign(np.hypot(a, b), a), -1.0, 1.0))


class Protractor(Compared):
    """Vectors of length 1, and the angle between them."""

    @staticmethod
    def described(drawings: Sequence[Ink]) -> FloatArray:
        return normalised(drawings)

    @staticmethod
    def apart(drawings: FloatArray, templates: FloatArray) -> FloatArray:
        return angles(drawings, templates)
