"""Intervals in closed form from counts and sums alone, for suites too large to resample: every row is by a writer of its own.

Shares have Wilson's interval (1927); means, and means of recalls, the normal one.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy import stats

from evaluation.statistics.intervals import LEVEL, Interval


def of_share(right: int, n: int, level: float = LEVEL) -> Interval:
    """Of `right` rows out of n. Raises ValueError of none."""
    if not n:
        raise ValueError("there is no row to take an interval of")
    ends: Any = stats.binomtest(right, n).proportion_ci(level, method="wilson")
    return Interval(right / n, float(ends.low), float(ends.high), n, n, level)


def of_mean(n: float, total: float, squares: float, level: float = LEVEL) -> Interval:
    """Of n values by their sum and the sum of their squares; no ends for a lone one. Raises ValueError of none."""
    if not n:
        raise ValueError("there is no row to take an interval of")
    mean = total / n
    if n < 2:
        return Interval(mean, None, None, int(n), int(n), level)
    error = np.sqrt(max(0.0, squares - n * mean**2) / (n - 1) / n)
    return _around(mean, float(error), int(n), level)


def of_recalls(right: ArrayLike, n: ArrayLike, level: float = LEVEL) -> Interval:
    """Of the mean of the recalls of the kinds that are present, (k,) counts each. A recall's variance is taken as if one more
    had been right and one more wrong, so that it is never nothing. Raises ValueError of none."""
    held, sizes = np.asarray(right, dtype=float), np.asarray(n, dtype=float)
    present = sizes > 0
    if not present.any():
        raise ValueError("there is no row to take an interval of")
    held, sizes = held[present], sizes[present]
    near = (held + 1) / (sizes + 2)
    error = np.sqrt((near * (1 - near) / sizes).sum()) / len(sizes)
    return _around(float((held / sizes).mean()), float(error), int(sizes.sum()), level, least=0.0, most=1.0)


def _around(
    value: float, error: float, n: int, level: float, least: float = -np.inf, most: float = np.inf
) -> Interval:
    reach = float(stats.norm.ppf((1 + level) / 2)) * error
    return Interval(value, max(least, value - reach), min(most, value + reach), n, n, level)
