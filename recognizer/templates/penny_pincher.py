"""Penny Pincher: no more than directions, compared one by one.

Taranta and LaViola, "Penny Pincher: a blazing fast, highly accurate $-family recognizer", GI 2015. Points: 16; a drawing is the
unit vectors between neighbouring ones, and two are as alike as the sum of their dot products. Neither turn nor sense is
looked past, scale and place are nowhere. Distance: 1 less the mean dot product, 0 to 2.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from recognizer.templates.points import Compared, as_one_stroke, directions
from sketch.ink import FloatArray, Ink

POINTS = 16


class PennyPincher(Compared):
    """Unit vectors, and 1 less their mean dot product."""

    @staticmethod
    def described(drawings: Sequence[Ink]) -> FloatArray:
        return directions(as_one_stroke(drawings, POINTS))

    @staticmethod
    def apart(drawings: FloatArray, templates: FloatArray) -> FloatArray:
        alike = np.tensordot(drawings, templates, axes=([1, 2], [1, 2])) / (POINTS - 1)
        return np.maximum(1.0 - alike, 0.0)
