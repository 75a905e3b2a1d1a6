"""How many rows a comparison needs, before anybody is asked to draw them.

McNemar's test by its exact power, summed over how many rows the two may differ on; margins of a share by the normal
approximation; both grow by the design effect 1 + (m − 1) ρ when each writer gives m rows that are alike by ρ (Donner 1986).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np
from scipy import stats

ALPHA, POWER = 0.05, 0.8
MOST = 10_000_000


@dataclass(frozen=True, slots=True)
class Plan:
    """rows: needed in all, writers: at so many rows each; power: reached, None for a margin; effect: of the design."""

    rows: int
    writers: int
    power: float | None
    effect: float


def mcnemar_power(n: int, only_first: float, only_second: float, alpha: float = ALPHA) -> float:
    """The chance that McNemar's exact test finds that two recognizers differ on n rows, of which the first alone has the share
    `only_first` right and the second alone `only_second`."""
    differing = only_first + only_second
    if not 0 < differing <= 1 or min(only_first, only_second) < 0:
        raise ValueError(
            f"shares {only_first} and {only_second}: rows on which they differ are above 0 and at most all"
        )
    spread: Any = stats.binom(n, differing)
    counts = np.arange(int(spread.ppf(1e-10)), int(spread.ppf(1 - 1e-10)) + 1)
    counts = counts[counts > 0]
    # The test says yes when the lesser count is at most c: the greatest c of which twice the tail is within alpha.
    most = stats.binom.ppf(alpha / 2, counts, 0.5)
    most = np.where(2 * stats.binom.cdf(most, counts, 0.5) <= alpha, most, most - 1)
    first = only_first / differing
    found = stats.binom.cdf(most, counts, first) + stats.binom.sf(counts - most - 1, counts, first)
    return float(spread.pmf(counts) @ np.where(most >= 0, found, 0.0))


def rows_for_difference(
    only_first: float,
    only_second: float,
    per_writer: int = 1,
    alike: float = 0.0,
    alpha: float = ALPHA,
    power: float = POWER,
) -> Plan:
    """So many rows that McNemar's exact test finds the difference with that power. Raises ValueError when there is none, or
    more than ten million rows are needed."""
    if only_first == only_second:
        raise ValueError(
            "two recognizers that are right equally often cannot be told apart by any number of rows"
        )
    low, high = 1, 8
    while mcnemar_power(high, only_first, only_second, alpha) < power:
        low, high = high, 2 * high
        if high > MOST:
            raise ValueError(f"more than {MOST} rows are needed; the difference is too small")
    while low < high:
        middle = (low + high) // 2
        if mcnemar_power(middle, only_first, only_second, alpha) < power:
            low = middle + 1
        else:
            high = middle
    return _plan(low, per_writer, alike, mcnemar_power(low, only_first, only_second, alpha))


def rows_for_margin(
    share: float, margin: float, per_writer: int = 1, alike: float = 0.0, alpha: float = ALPHA
) -> Plan:
    """So many rows that the interval of a share reaches no farther than `margin` to either side. Raises ValueError for shares
    and margins that are not between 0 and 1."""
    if not 0 < share < 1 or not 0 < margin < 1:
        raise ValueError(f"share {share} and margin {margin}: both must be between 0 and 1")
    reach = float(stats.norm.isf(alpha / 2))
    return _plan(ceil(share * (1 - share) * (reach / margin) ** 2), per_writer, alike, None)


def _plan(rows: int, per_writer: int, alike: float, power: float | None) -> Plan:
    if per_writer < 1 or not 0 <= alike <= 1:
        raise ValueError(
            f"{per_writer} rows a writer, alike by {alike}: at least 1, and from 0 to 1, are needed"
        )
    effect = 1 + (per_writer - 1) * alike
    writers = ceil(rows * effect / per_writer)
    return Plan(writers * per_writer, writers, power, effect)
