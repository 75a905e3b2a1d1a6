"""`geometric`: hand-made geometry at its best, stroke by stroke and then against the page.

Each stroke is weighed alone (`rules`), then what only the page can tell is added (`context`):
taps are tiny beside the other strokes, a scribble covers earlier ink, a lasso encloses it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log

import numpy as np

from recognizer.claims import Claim, claim_for
from recognizer.geometric.context import gestures
from recognizer.geometric.rules import evidence
from recognizer.preprocess import unit_path
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import STROKE_KINDS, StrokeKind


@dataclass(frozen=True, slots=True)
class Confidence:
    """From evidence to probabilities."""

    temperature: float = 0.55
    """Divides the evidence before the softmax. 1 would take the soft bounds at their word, which are
    modest; on 3,000 generated strokes 0.5 to 0.6 gave the least calibration error (0.037, 1 gave 0.127)."""
    reject: float = 0.45
    """Below this confidence the stroke is rejected: two kinds are then about equally likely."""
    clear: float = log(0.5)
    """Evidence from which a stroke is clearly of a kind: more likely than not, taken by itself."""
    gesture: float = 0.9
    """Of a gesture: its context is a conjunction of plain facts, wrong once in ten by their margins."""


CONFIDENCE = Confidence()


class Geometric:
    """The geometric rival. It uses the page for gestures only."""

    name = "geometric"
    claims: frozenset[StrokeKind] = frozenset(STROKE_KINDS)

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """One claim a stroke, with a softmax of its evidence as scores."""
        alone = [weigh(stroke) for stroke in ink]
        polygons = [float(row[STROKE_KINDS.index("polygon")]) > CONFIDENCE.clear for row in alone]
        return tuple(
            claim(row) if gesture is None else claim_for(gesture, CONFIDENCE.gesture)
            for row, gesture in zip(alone, gestures(ink, polygons), strict=True)
        )


def weigh(stroke: Stroke) -> FloatArray:
    """The evidence for each kind from one stroke seen alone, (9,); none from a pen that never moved."""
    path = unit_path(stroke)
    return evidence(path) if len(path) > 1 else np.zeros(len(STROKE_KINDS))


def claim(row: FloatArray, rule: Confidence = CONFIDENCE) -> Claim:
    """Softmax of the evidence."""
    scores = np.exp((row - row.max()) / rule.temperature)
    scores /= scores.sum()
    return Claim(scores, rejected=bool(scores.max() < rule.reject))
