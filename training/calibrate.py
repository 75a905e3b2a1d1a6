"""What makes answers mean what they say: one temperature, and where a stroke is refused.

Both come from generated ink that was not trained on, by writers never seen.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.special import expit, log_softmax

from training.fit import Said


@dataclass(frozen=True, slots=True)
class RejectRule:
    """When a stroke is refused."""

    kept: float = 0.99
    """Share of strokes that are of some kind which are not refused: a good stroke refused spoils a page."""
    told: float = 0.95
    """The same for the figure of merit: at this share of true positives the false positives are told."""


RULE = RejectRule()


@dataclass(frozen=True, slots=True)
class Calibration:
    """temperature: divides the logits; reject_above: probability of being none of the kinds beyond which a
    stroke is refused."""

    temperature: float
    reject_above: float


def calibrate(said: Said, rule: RejectRule = RULE) -> Calibration:
    """From the net's answers to held-out ink."""
    known = said.kind >= 0
    return Calibration(
        temperature(said.logits[known], said.kind[known]),
        float(np.quantile(expit(said.strange[known].astype(np.float64)), rule.kept)),
    )


def false_positives(known: NDArray[np.float32], odd: NDArray[np.float32], rule: RejectRule = RULE) -> float:
    """Share of the odd strokes that pass where `rule.told` of the known ones do; both by their logit of being
    none of the kinds."""
    return float((odd <= np.quantile(known, rule.told)).mean())


def temperature(logits: NDArray[np.float32], kind: NDArray[np.int64]) -> float:
    """Temperature scaling (Guo et al. 2017): the T > 0 that minimises the negative log likelihood of
    softmax(logits / T)."""

    def loss(log_t: float) -> float:
        scores = log_softmax(logits.astype(np.float64) / np.exp(log_t), axis=1)
        return float(-scores[np.arange(len(kind)), kind].mean())

    best: Any = minimize_scalar(loss, bounds=(-2.0, 2.0), method="bounded")
    return float(np.exp(best.x))
