"""Penny Pincher: no more than directions, compared one by one.

Taranta and LaViola, "Penny Pincher: a blazing fast, highly accurate $-family recognizer", GI 2015. Points: 16; a drawing is the
unit vectors between neighbouring ones, and two are as alike as the sum of their dot products. Neither turn nor sense is
looked past, scale and place are nowhere. Distance: 1 less the mean dot product, 0 to 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from recognizer.templates.points import IntArray, as_one_stroke, by_label, directions
from sketch.ink import FloatArray, Ink

POINTS = 16


@dataclass(frozen=True, slots=True, eq=False)
class PennyPincher:
    """templates: (T, 15, 2) unit vectors; labels: (T,)."""

    templates: FloatArray
    labels: IntArray

    @classmethod
    def of(cls, templates: Sequence[Ink], labels: IntArray) -> PennyPincher:
        return cls(directions(as_one_stroke(templates, POINTS)), labels)

    def nearest(self, drawings: Sequence[Ink]) -> FloatArray:
        vectors = directions(as_one_stroke(drawings, POINTS))
        alike = np.tensordot(vectors, self.templates, axes=([1, 2], [1, 2])) / (POINTS - 1)
        return by_label(np.maximum(1.0 - alike, 0.0), self.labels)
