"""Which claimed component is which true one.

Truth and claim speak of the same ink, so components are paired by the strokes that they share,
whatever they are taken for and however they are labelled.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import linear_sum_assignment

from sketch.page import Component, Sketch

SAME_KIND = 1e-3
"""Bonus that decides between pairings of equal overlap in favour of equal kinds; far below the
smallest difference between overlaps of components of up to 30 strokes."""


def match_components(truth: Sketch, claim: Sketch) -> dict[str, str]:
    """Label of each true component → label of its claimed counterpart: one to one, the pairing of
    greatest total overlap (shared strokes / all strokes of the two). Components that share no
    stroke are never paired."""
    if not truth.components or not claim.components:
        return {}
    gain = np.array([[_gain(true, claimed) for claimed in claim.components] for true in truth.components])
    rows, columns = linear_sum_assignment(gain, maximize=True)
    return {
        truth.components[row].label: claim.components[column].label
        for row, column in zip(rows.tolist(), columns.tolist(), strict=True)
        if gain[row, column] > 0
    }


def _gain(true: Component, claimed: Component) -> float:
    shared = len(set(true.strokes) & set(claimed.strokes))
    if shared == 0:
        return 0.0
    overlap = shared / len(set(true.strokes) | set(claimed.strokes))
    return overlap + (SAME_KIND if true.kind == claimed.kind else 0.0)
