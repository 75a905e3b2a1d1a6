"""What a confidence is worth: reliability, and the risk that is left when the unsure are refused.

Pure functions of how sure each claim was, (n,) from 0 to 1, and whether it was right, (n,).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

BINS = 10


@dataclass(frozen=True, slots=True)
class Bin:
    """Claims of like confidence: n of them, their mean confidence, and the share of them that is right."""

    n: int
    sure: float
    right: float


@dataclass(frozen=True, slots=True)
class Risk:
    """coverage: share of claims that are kept when the least sure are refused; risk: share of the kept that is wrong; area:
    under the curve (AURC, Geifman and El-Yaniv 2017), the less the better."""

    coverage: tuple[float, ...]
    risk: tuple[float, ...]
    area: float | None

    def at(self, coverage: float) -> float | None:
        """The risk at the least coverage that is at least this; None of none."""
        return next(
            (risk for kept, risk in zip(self.coverage, self.risk, strict=True) if kept >= coverage - 1e-12),
            None,
        )


def reliability(sure: ArrayLike, right: ArrayLike, bins: int = BINS) -> tuple[Bin, ...]:
    """The claims in equal-width bins of confidence, each closed above; empty bins are left out."""
    confidence, correct = np.asarray(sure, dtype=float), np.asarray(right, dtype=float)
    place = np.clip(np.ceil(confidence * bins).astype(int) - 1, 0, bins - 1)
    chosen = [place == k for k in range(bins)]
    return tuple(
        Bin(int(here.sum()), float(confidence[here].mean()), float(correct[here].mean()))
        for here in chosen
        if here.any()
    )


def risk_coverage(sure: ArrayLike, right: ArrayLike) -> Risk:
    """The risk at every coverage at which the least sure claim that is kept differs in confidence from the surest that is not."""
    confidence, wrong = np.asarray(sure, dtype=float), 1 - np.asarray(right, dtype=float)
    n = len(confidence)
    if n == 0:
        return Risk((), (), None)
    order = np.argsort(-confidence, kind="stable")
    ranked, errors = confidence[order], np.cumsum(wrong[order])
    kept = np.flatnonzero(np.append(ranked[1:] < ranked[:-1], True)) + 1
    risk = errors[kept - 1] / kept
    shares = np.diff(np.concatenate([[0], kept])) / n
    return Risk(tuple((kept / n).tolist()), tuple(risk.tolist()), float(shares @ risk))
