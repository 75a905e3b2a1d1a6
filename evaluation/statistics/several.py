"""Several recognizers on several suites: do they differ at all, and which of them from which.

Friedman's test (1937) with ties, Iman and Davenport's F (1980), Kendall's W; then either all pairs by Wilcoxon's test with
Holm's correction (1979), or Nemenyi's critical difference of mean ranks as in Demšar (JMLR 2006).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

from sketch.ink import FloatArray

ALPHA = 0.05


@dataclass(frozen=True, slots=True)
class Friedman:
    """ranks: mean rank of each, 1 the best; chi2, p: Friedman's; f, f_p: Iman and Davenport's; w: Kendall's, 0 no agreement
    of the suites to 1 the same order on all; n: suites; k: recognizers."""

    ranks: tuple[float, ...]
    chi2: float
    p: float
    f: float
    f_p: float
    w: float
    n: int
    k: int


@dataclass(frozen=True, slots=True)
class Ranking:
    """Recognizers by mean rank, the best first; critical: difference of ranks from which on two differ; groups: the longest
    runs of recognizers that do not, by place."""

    names: tuple[str, ...]
    ranks: tuple[float, ...]
    critical: float
    groups: tuple[tuple[int, ...], ...]


def friedman(scores: ArrayLike, high: bool = True) -> Friedman:
    """Of scores (n suites, k recognizers), the higher the better, or the lower. Raises ValueError below 2 suites or 3
    recognizers."""
    table = np.asarray(scores, dtype=float)
    n, k = table.shape
    if n < 2 or k < 3:
        raise ValueError(f"Friedman's test needs two suites and three recognizers; there are {n} and {k}")
    ranks = ranks_of(table, high)
    if np.ptp(ranks) == 0:
        return Friedman(tuple(ranks.mean(axis=0).tolist()), 0.0, 1.0, 0.0, 1.0, 0.0, n, k)
    tested = stats.friedmanchisquare(*ranks.T)
    chi2 = float(tested.statistic)
    room = n * (k - 1) - chi2
    f = (n - 1) * chi2 / room if room > 1e-12 else float("inf")
    return Friedman(
        ranks=tuple(ranks.mean(axis=0).tolist()),
        chi2=chi2,
        p=float(tested.pvalue),
        f=f,
        f_p=float(stats.f.sf(f, k - 1, (k - 1) * (n - 1))),
        w=chi2 / (n * (k - 1)),
        n=n,
        k=k,
    )


def ranks_of(scores: FloatArray, high: bool = True) -> FloatArray:
    """Ranks within each row, (n, k), 1 the best, ties shared."""
    return np.asarray(stats.rankdata(-scores if high else scores, axis=1), dtype=float)


def holm(p: Sequence[float]) -> list[float]:
    """Holm's adjusted p, in the order given."""
    order = np.argsort(np.asarray(p, dtype=float), kind="stable").tolist()
    adjusted = [0.0] * len(p)
    worst = 0.0
    for place, k in enumerate(order):
        worst = max(worst, min(1.0, (len(p) - place) * p[k]))
        adjusted[k] = worst
    return adjusted


def critical_difference(k: int, n: int, alpha: float = ALPHA) -> float:
    """Of the mean ranks of k recognizers on n suites, by Nemenyi's test."""
    q = float(stats.studentized_range.ppf(1 - alpha, k, np.inf)) / np.sqrt(2)
    return float(q * np.sqrt(k * (k + 1) / (6 * n)))


def ranking(names: Sequence[str], scores: ArrayLike, high: bool = True, alpha: float = ALPHA) -> Ranking:
    """The recognizers of these names by their scores (n suites, k recognizers)."""
    table = np.asarray(scores, dtype=float)
    mean = ranks_of(table, high).mean(axis=0)
    order = [int(k) for k in np.argsort(mean, kind="stable")]
    critical = critical_difference(len(names), len(table), alpha)
    ranks = [float(mean[k]) for k in order]
    return Ranking(tuple(names[k] for k in order), tuple(ranks), critical, _groups(ranks, critical))


def _groups(ranks: Sequence[float], critical: float) -> tuple[tuple[int, ...], ...]:
    """Runs of places within the critical difference that are part of no longer one."""
    found: list[tuple[int, ...]] = []
    reached = -1
    for first in range(len(ranks)):
        last = max(k for k in range(first, len(ranks)) if ranks[k] - ranks[first] < critical)
        if last > max(first, reached):
            found.append(tuple(range(first, last + 1)))
            reached = last
    return tuple(found)
