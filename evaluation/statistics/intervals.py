"""Intervals for shares and means of rows that come in clusters: one writer's rows are alike.

Whole clusters are drawn with replacement (Field and Welsh 2007), the same clusters for everybody who is compared, and the
percentiles are those of the expanded interval of Hesterberg (The American Statistician, 2015), which undoes the narrowness
that percentiles have with few clusters. Where nothing varies, as when all rows are right, resampling knows no doubt: then the
interval is Clopper and Pearson's (1934) for as many rows as there are clusters.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import stats

from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

LEVEL = 0.95
DRAWS = 2000
"""Resamples: the ends of a 95 % interval then lie within some 0.1 standard errors of where endless ones would put them."""
CHUNK = 200
"""Resamples at once: memory is CHUNK times clusters."""


@dataclass(frozen=True, slots=True)
class Interval:
    """value: of all rows; low, high: of the interval, None where there is but one cluster; n: rows; clusters: writers."""

    value: float
    low: float | None
    high: float | None
    n: int
    clusters: int
    level: float = LEVEL


def numbered(clusters: Sequence[Hashable]) -> tuple[IntArray, int]:
    """Clusters as numbers from 0 in the order in which they first come, (n,), and how many there are."""
    places: dict[Hashable, int] = {}
    numbers = np.array([places.setdefault(cluster, len(places)) for cluster in clusters], dtype=np.int64)
    return numbers, len(places)


def balanced(
    columns: Sequence[ArrayLike],
    kinds: Sequence[Hashable],
    clusters: Sequence[Hashable],
    rng: np.random.Generator,
    level: float = LEVEL,
    draws: int = DRAWS,
) -> list[Interval]:
    """The mean over the kinds of the mean within each kind, (n,) each: balanced accuracy where a column says what is right.
    Columns are resampled alike. A kind that a resample lacks does not count in it. Raises ValueError when there is no row."""
    values, drawn = _resampled(columns, kinds, clusters, rng, draws)
    count, groups = len(clusters), len(set(clusters))
    return [
        Interval(float(value), *_ends(float(value), drawn[:, k], groups, level), count, groups, level)
        for k, value in enumerate(values)
    ]


def difference(
    first: ArrayLike,
    second: ArrayLike,
    kinds: Sequence[Hashable],
    clusters: Sequence[Hashable],
    rng: np.random.Generator,
    level: float = LEVEL,
    draws: int = DRAWS,
) -> Interval:
    """First less second, row by row: of their balanced means. `kinds` all the same gives the difference of plain means."""
    values, drawn = _resampled([first, second], kinds, clusters, rng, draws)
    value, apart = float(values[0] - values[1]), drawn[:, 0] - drawn[:, 1]
    count, groups = len(clusters), len(set(clusters))
    if groups < 2:
        return Interval(value, None, None, count, groups, level)
    return Interval(value, *_percentiles(apart, groups, level), count, groups, level)


def clustering(values: ArrayLike, clusters: Sequence[Hashable]) -> tuple[float, float]:
    """How alike a cluster's rows are: the intraclass correlation of a one-way analysis of variance (Fisher; Donner 1986),
    never below 0, and the design effect that it makes, by which many more rows are needed than of strangers."""
    numbers, groups = numbered(clusters)
    array = np.asarray(values, dtype=float)
    sizes = np.bincount(numbers, minlength=groups)
    if groups < 2 or len(array) <= groups:
        return 0.0, 1.0
    means = np.bincount(numbers, weights=array, minlength=groups) / sizes
    between = float(sizes @ (means - array.mean()) ** 2) / (groups - 1)
    within = float(((array - means[numbers]) ** 2).sum()) / (len(array) - groups)
    typical = (len(array) - float(sizes @ sizes) / len(array)) / (groups - 1)
    total = between + (typical - 1) * within
    alike = max(0.0, (between - within) / total) if total > 0 else 0.0
    weighted = float(sizes @ sizes) / len(array)
    return alike, 1 + (weighted - 1) * alike


def _resampled(
    columns: Sequence[ArrayLike],
    kinds: Sequence[Hashable],
    clusters: Sequence[Hashable],
    rng: np.random.Generator,
    draws: int,
) -> tuple[FloatArray, FloatArray]:
    """The balanced means of the columns (c,), and of `draws` resamples of the clusters (draws, c)."""
    table = np.stack([np.asarray(column, dtype=float) for column in columns])
    if table.shape[1] == 0:
        raise ValueError("there is no row to take an interval of")
    rows, groups = numbered(clusters)
    classes, width = numbered(kinds)
    cell = rows * width + classes
    counts = np.bincount(cell, minlength=groups * width).reshape(groups, width).astype(float)
    sums = np.stack(
        [
            np.bincount(cell, weights=column, minlength=groups * width).reshape(groups, width).astype(float)
            for column in table
        ]
    )
    value = _means(np.ones((1, groups)), counts, sums)[0]
    if groups < 2:
        return value, np.repeat(value[None], draws, axis=0)
    parts = [
        _means(_weights(rng, min(CHUNK, draws - done), groups), counts, sums)
        for done in range(0, draws, CHUNK)
    ]
    return value, np.concatenate(parts)


def _weights(rng: np.random.Generator, draws: int, groups: int) -> FloatArray:
    """How often each cluster is drawn, (draws, groups)."""
    chosen = rng.integers(groups, size=(draws, groups)) + groups * np.arange(draws)[:, None]
    return np.bincount(chosen.ravel(), minlength=draws * groups).reshape(draws, groups).astype(float)


def _means(weights: FloatArray, counts: FloatArray, sums: FloatArray) -> FloatArray:
    """Balanced means of weighted clusters, (draws, columns)."""
    totals = weights @ counts
    present = totals > 0
    within = np.stack(
        [np.divide(weights @ each, totals, where=present, out=np.zeros_like(totals)) for each in sums]
    )
    return (within.sum(axis=2) / present.sum(axis=1)).T


def _ends(value: float, drawn: FloatArray, groups: int, level: float) -> tuple[float | None, float | None]:
    if groups < 2:
        return None, None
    if np.ptp(drawn) == 0 and value in (0.0, 1.0):
        tail = float(stats.beta.ppf((1 - level) / 2, groups, 1))
        return (tail, 1.0) if value == 1.0 else (0.0, 1 - tail)
    return _percentiles(drawn, groups, level)


def _percentiles(drawn: FloatArray, groups: int, level: float) -> tuple[float, float]:
    reach = np.sqrt(groups / (groups - 1)) * float(stats.t.ppf((1 + level) / 2, groups - 1))
    tail = float(stats.norm.sf(reach))
    low, high = np.quantile(drawn, [tail, 1 - tail]).tolist()
    return float(low), float(high)
