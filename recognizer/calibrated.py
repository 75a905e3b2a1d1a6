"""A published rival behind the house's protocol: its evidence as probabilities, and strangers rejected.

Two things are added to what a paper says, the same for all and fitted on held-out ink, never on what it learnt from:
one temperature, so that a confidence of 0.8 is right in eight of ten, and a line between drawings that are of some kind and drawings that
are of none, by how familiar a drawing is and by how far its likeliest kind leads. Neither changes which kind is the likeliest.
A dot is told from its page as `paper` and `geometric` do, since to most of the papers it is no gesture.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.special import log_softmax
from sklearn.linear_model import LogisticRegression

from recognizer.claims import Claim, claim_for
from recognizer.geometric.context import dots
from recognizer.samples import Sample, Scorer
from sketch.geometry import diagonal
from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind


@dataclass(frozen=True, slots=True)
class CalibrationRule:
    """How calibration is done."""

    heat: tuple[float, float] = (1e-3, 1e3)
    """Range of the temperature."""
    keep: float = 0.97
    """Share of true drawings that are kept: what is lost here is lost for good on a page."""
    dot: float = 0.9
    """Confidence in a dot: its context is a conjunction of plain facts, wrong once in ten by their margins."""
    batch: int = 256
    """Strokes looked at together: bounds memory on pages of thousands of strokes."""


RULE = CalibrationRule()


@dataclass(frozen=True, slots=True)
class Calibration:
    """temperature: divides the evidence before the softmax; weights: of the two signs of a stranger, see
    `strangeness`; limit: strangeness above which a drawing is rejected."""

    temperature: float
    weights: tuple[float, float]
    limit: float


def calibrate(
    scorer: Scorer, held_out: Sequence[Sample], strangers: Sequence[Ink], rule: CalibrationRule = RULE
) -> Calibration:
    """Fits temperature and rejection to samples and strangers that the scorer has not learnt from. Samples of kinds it
    does not know are passed over. Raises ValueError when none is left."""
    known = [sample for sample in held_out if sample.kind in scorer.kinds]
    if not known:
        raise ValueError(f"no held-out sample of {', '.join(scorer.kinds)}; calibration needs some of each")
    evidence, familiar = scorer.weigh([sample.ink for sample in known])
    truth = np.array([scorer.kinds.index(sample.kind) for sample in known])
    heat = temperature(evidence, truth, rule)
    ours, theirs = _signs(evidence, familiar, heat), _signs(*scorer.weigh(strangers), heat)
    weights = (1.0, 1.0)
    if len(theirs):
        line = LogisticRegression(class_weight="balanced", max_iter=400)
        line.fit(np.concatenate([ours, theirs]), np.arange(len(ours) + len(theirs)) >= len(ours))
        # A stranger is never told by its being familiar or sure: such a weight is chance.
        first, second = np.maximum(line.coef_[0], 0.0).tolist()
        weights = (first, second) if first + second > 0 else weights
    return Calibration(heat, weights, float(np.quantile(ours @ np.array(weights), rule.keep)))


def temperature(evidence: FloatArray, truth: NDArray[np.int64], rule: CalibrationRule = RULE) -> float:
    """The T at which softmax(evidence / T), (B, K), makes the truth (B,) likeliest (Guo et al. 2017)."""

    def loss(log_t: float) -> float:
        scores = log_softmax(evidence / np.exp(log_t), axis=1)
        return float(-scores[np.arange(len(truth)), truth].mean())

    low, high = np.log(rule.heat)
    best: Any = minimize_scalar(loss, bounds=(low, high), method="bounded")
    return float(np.exp(best.x))


class Calibrated:
    """A recognizer made of a scorer. It sees each stroke alone, but for dots, which are small beside others."""

    def __init__(self, name: str, scorer: Scorer, calibration: Calibration) -> None:
        self.name = name
        self.claims: frozenset[StrokeKind] = frozenset({*scorer.kinds, "tap"})
        self._scorer = scorer
        self._calibration = calibration
        self._columns = [STROKE_KINDS.index(kind) for kind in scorer.kinds]

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """One claim a stroke."""
        if not len(ink):
            return ()
        with np.errstate(over="ignore"):  # a stroke may last longer than a float holds: no dot then
            tiny = dots(ink, np.array([diagonal(stroke.points) for stroke in ink]))
        found: list[Claim] = [claim_for("tap", RULE.dot)] * len(ink)
        drawn = np.flatnonzero(~tiny).tolist()
        claims = self.classify([Ink((ink[index],)) for index in drawn])
        for index, claim in zip(drawn, claims, strict=True):
            found[index] = claim
        return tuple(found)

    def classify(self, drawings: Sequence[Ink]) -> list[Claim]:
        """One claim for each drawing of one symbol, in one stroke or several, as the papers have it: no dot among them."""
        claims: list[Claim] = []
        for first in range(0, len(drawings), RULE.batch):
            evidence, familiar = self._scorer.weigh(drawings[first : first + RULE.batch])
            scores = np.zeros((len(evidence), len(STROKE_KINDS)))
            scores[:, self._columns] = np.exp(log_softmax(evidence / self._calibration.temperature, axis=1))
            odd = self._strangeness(evidence, familiar) > self._calibration.limit
            claims += [Claim(row, bool(strange)) for row, strange in zip(scores, odd.tolist(), strict=True)]
        return claims

    def strangeness(self, drawings: Sequence[Ink]) -> FloatArray:
        """How much each drawing looks like none of the kinds, (B,); the scale is each rival's own."""
        return self._strangeness(*self._scorer.weigh(drawings))

    def _strangeness(self, evidence: FloatArray, familiar: FloatArray) -> FloatArray:
        signs = _signs(evidence, familiar, self._calibration.temperature)
        return signs @ np.array(self._calibration.weights)


def _signs(evidence: FloatArray, familiar: FloatArray, heat: float) -> FloatArray:
    """What speaks for a stranger, (B, 2): how unfamiliar it is, and how little its likeliest kind leads."""
    return -np.column_stack([familiar, log_softmax(evidence / heat, axis=1).max(axis=1)])
