"""Two recognizers on the same rows: who errs less, whether that may be chance, and how much it is.

McNemar's test in its exact form (McNemar 1947), Wilcoxon's signed-rank test (1945) by scipy, and effect sizes that do not
grow with the number of rows: Cohen's g and the odds ratio of the rows on which they differ, and the matched-pairs rank-biserial
correlation (Kerby 2014).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

LEVEL = 0.95


@dataclass(frozen=True, slots=True)
class McNemar:
    """only_first, only_second: rows that one alone has right; n: all rows; p: two-sided and exact, None without a row on which
    they differ; difference: of the shares that are right; odds: only_first / only_second and its exact interval, with infinity
    where nothing stands below; g: how far the larger share of the differing rows is above a half, 0 to 0.5."""

    only_first: int
    only_second: int
    n: int
    p: float | None
    difference: float
    odds: float | None
    odds_low: float | None
    odds_high: float | None
    g: float | None


@dataclass(frozen=True, slots=True)
class SignedRanks:
    """statistic: the lesser of the rank sums; p: two-sided, exact where scipy has it exact, None when nothing differs; n: pairs
    that differ; effect: rank-biserial correlation, −1 to 1, positive when the first is larger."""

    statistic: float | None
    p: float | None
    n: int
    effect: float | None


def mcnemar(first: ArrayLike, second: ArrayLike, level: float = LEVEL) -> McNemar:
    """Of what two recognizers have right on the same rows, (n,) truth values each. Raises ValueError for different lengths."""
    one, other = np.asarray(first, dtype=bool), np.asarray(second, dtype=bool)
    if one.shape != other.shape:
        raise ValueError(
            f"{one.shape} rows of the one and {other.shape} of the other: they must be the same rows"
        )
    return mcnemar_of(int((one & ~other).sum()), int((other & ~one).sum()), len(one), level)


def mcnemar_of(only_first: int, only_second: int, n: int, level: float = LEVEL) -> McNemar:
    """Of the counts."""
    differing = only_first + only_second
    apart = (only_first - only_second) / n if n else 0.0
    if not differing:
        return McNemar(only_first, only_second, n, None, apart, None, None, None, None)
    tail = (1 - level) / 2
    low = float(stats.beta.ppf(tail, only_first, only_second + 1)) if only_first else 0.0
    high = float(stats.beta.isf(tail, only_first + 1, only_second)) if only_second else 1.0
    return McNemar(
        only_first,
        only_second,
        n,
        p=float(stats.binomtest(only_first, differing).pvalue),
        difference=apart,
        odds=_odds(only_first / differing),
        odds_low=_odds(low),
        odds_high=_odds(high),
        g=max(only_first, only_second) / differing - 0.5,
    )


def wilcoxon(first: ArrayLike, second: ArrayLike) -> SignedRanks:
    """Of two measurements of the same things, (n,) each; pairs that do not differ are left out (Wilcoxon's own way)."""
    apart = np.asarray(first, dtype=float) - np.asarray(second, dtype=float)
    apart = apart[apart != 0]
    if not len(apart):
        return SignedRanks(None, None, 0, None)
    ranks = stats.rankdata(np.abs(apart))
    up, down = float(ranks[apart > 0].sum()), float(ranks[apart < 0].sum())
    tested: Any = stats.wilcoxon(apart)
    return SignedRanks(min(up, down), float(tested.pvalue), len(apart), (up - down) / (up + down))


def _odds(share: float) -> float:
    return share / (1 - share) if share < 1 else float("inf")
