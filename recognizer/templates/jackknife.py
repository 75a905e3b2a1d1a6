"""Dynamic time warping on directions, after Jackknife.

Taranta, Samiei, Maghoumi, Khaloo, Pittman and LaViola, "Jackknife: a reliable recognizer with few samples and many modalities",
CHI 2017, its measure of inner products. Points: 16; a drawing is the unit vectors between neighbouring ones. Distance: the
cheapest warping of one into the other within a Sakoe-Chiba band, a step costing 1 less the dot product, times the
paper's two correction factors: for how the path's extent, and its box, are shared between x and y. Jackknife's lower bounds
only save time and are left out: 15 vectors in a band of 5 cost less than they would. So is its learnt rejection.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from recognizer.jit import kernel
from recognizer.templates.points import IntArray, as_one_stroke, box_sides, by_label, directions, positive
from sketch.ink import FloatArray, Ink

POINTS = 16
BAND = 2
"""Steps by which one drawing may run ahead of the other: a tenth of the points, rounded up."""
WORST = 0.01
"""The least cosine of the correction factors: none is more than 100."""


@dataclass(frozen=True, slots=True, eq=False)
class Jackknife:
    """templates: (T, 15, 2) unit vectors; extents and boxes: (T, 2) of length 1; labels: (T,)."""

    templates: FloatArray
    extents: FloatArray
    boxes: FloatArray
    labels: IntArray

    @classmethod
    def of(cls, templates: Sequence[Ink], labels: IntArray) -> Jackknife:
        return cls(*_described(templates), labels)

    def nearest(self, drawings: Sequence[Ink]) -> FloatArray:
        vectors, extents, boxes = _described(drawings)
        cost = _warped(vectors, self.templates) / (POINTS - 1)
        for ours, theirs in ((extents, self.extents), (boxes, self.boxes)):
            cost /= np.clip(ours @ theirs.T, WORST, 1.0)
        return by_label(np.maximum(cost, 0.0), self.labels)


def _described(drawings: Sequence[Ink]) -> tuple[FloatArray, FloatArray, FloatArray]:
    points = as_one_stroke(drawings, POINTS)
    extents = np.abs(np.diff(points, axis=1)).sum(axis=1)
    return directions(points), _unit(extents), _unit(box_sides(points))


def _unit(vectors: FloatArray) -> FloatArray:
    return vectors / positive(np.hypot(vectors[:, 0], vectors[:, 1]))[:, None]


@kernel
def _warped(drawings: FloatArray, templates: FloatArray) -> FloatArray:
    """Cheapest warping of each drawing (B, m, 2) into each template (T, m, 2): (B, T)."""
    m = drawings.shape[1]
    found = np.empty((len(drawings), len(templates)))
    cost = np.empty((m + 1, m + 1))
    for i in range(len(drawings)):
        for j in range(len(templates)):
            cost[:] = np.inf
            cost[0, 0] = 0.0
            for a in range(1, m + 1):
                for b in range(max(1, a - BAND), min(m, a + BAND) + 1):
                    along = drawings[i, a - 1, 0] * templates[j, b - 1, 0]
                    along += drawings[i, a - 1, 1] * templates[j, b - 1, 1]
                    before = min(cost[a - 1, b - 1], cost[a - 1, b], cost[a, b - 1])
                    cost[a, b] = before + 1.0 - along
            found[i, j] = cost[m, m]
    return found
