"""How far people agree: rates over the gestures that they propose or make, as AGATe and GECKo compute them.

Agreement and coagreement rates: Vatavu and Wobbrock, "Formalizing agreement analysis for elicitation studies", CHI 2015. An
agreement rate is the share of pairs of participants who proposed the same; a coagreement rate the share of pairs who agreed on
both of two referents; between groups (Vatavu and Wobbrock, CHI 2016) pairs have one member in each. Consistency, as in GECKo
(Anthony, Vatavu and Wobbrock, GI 2013): the same rate over the ways in which strokes are made, within and between writers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from scipy import stats

from evaluation.lessons import writer_of
from sketch.files.jsonl import Row
from sketch.ink import Ink

STROKE_PARTS = 4
"""Directions that a way of making a stroke tells: right, down, left, up."""


@dataclass(frozen=True, slots=True)
class Consistency:
    """Of one label: drawings, ways in which they are made; within: mean over the writers, between: over all pairs of different
    writers; None where there is no such pair."""

    label: str
    drawings: int
    ways: int
    within: float | None
    between: float | None


def agreement_rate(proposals: Sequence[Hashable]) -> float | None:
    """The share of pairs of participants whose proposals are the same; None for fewer than two."""
    n = len(proposals)
    if n < 2:
        return None
    return sum(k * (k - 1) for k in Counter(proposals).values()) / (n * (n - 1))


def disagreement_rate(proposals: Sequence[Hashable]) -> float | None:
    """The share of pairs who differ."""
    rate = agreement_rate(proposals)
    return None if rate is None else 1 - rate


def coagreement_rate(*referents: Sequence[Hashable]) -> float | None:
    """The share of pairs of participants who agree on every one of the referents; each holds the same participants' proposals
    in the same order. None for fewer than two. Raises ValueError for different numbers of participants."""
    if len({len(proposals) for proposals in referents}) != 1:
        raise ValueError("each referent must have one proposal of every participant")
    return agreement_rate(list(zip(*referents, strict=True)))


def between_rate(first: Sequence[Hashable], second: Sequence[Hashable]) -> float | None:
    """The share of pairs, one of each group, who agree; None when a group is empty."""
    if not first or not second:
        return None
    one, other = Counter(first), Counter(second)
    return sum(count * other[proposal] for proposal, count in one.items()) / (len(first) * len(second))


def agreement_differs(*referents: Sequence[Hashable]) -> tuple[float, float]:
    """Whether agreement on several referents differs: the statistic V_rd and its p, by Cochran's Q over pairs of participants,
    to which V_rd is equal. Raises ValueError as `coagreement_rate`, and for fewer than two referents or participants."""
    if len({len(proposals) for proposals in referents}) != 1 or len(referents) < 2 or len(referents[0]) < 2:
        raise ValueError(
            "two referents at least, each with the proposals of the same two participants at least, are needed"
        )
    agree = np.array(
        [[a == b for a, b in combinations(proposals, 2)] for proposals in referents], dtype=float
    ).T
    k = agree.shape[1]
    columns, rows = agree.sum(axis=0), agree.sum(axis=1)
    varied = float((rows * (k - rows)).sum())
    if varied == 0:
        return 0.0, 1.0
    q = (k - 1) * float(k * (columns**2).sum() - columns.sum() ** 2) / varied
    return q, float(stats.chi2.sf(q, k - 1))


def way_of(ink: Ink) -> tuple[tuple[str, ...], ...]:
    """How a drawing is made, roughly: for each stroke in order the directions (right, down, left, up) that it runs in, one after
    another, each for an eighth of its length at least."""
    return tuple(_directions(stroke.points) for stroke in ink)


def consistency(rows: Sequence[Row]) -> list[Consistency]:
    """Of every label, in alphabetical order."""
    by_label: dict[str, dict[str, list[Hashable]]] = {}
    for row in rows:
        if row.label is not None and len(row.ink):
            by_label.setdefault(row.label, {}).setdefault(writer_of(row), []).append(way_of(row.ink))
    return [_consistency(label, by_label[label]) for label in sorted(by_label)]


def _consistency(label: str, by_writer: Mapping[str, Sequence[Hashable]]) -> Consistency:
    ways = [way for own in by_writer.values() for way in own]
    rates = [rate for own in by_writer.values() if (rate := agreement_rate(own)) is not None]
    every = Counter(ways)
    own_pairs = sum(len(own) * (len(own) - 1) for own in by_writer.values())
    own_same = sum(k * (k - 1) for own in by_writer.values() for k in Counter(own).values())
    pairs = len(ways) * (len(ways) - 1) - own_pairs
    same = sum(k * (k - 1) for k in every.values()) - own_same
    return Consistency(
        label,
        len(ways),
        len(every),
        float(np.mean(rates)) if rates else None,
        same / pairs if pairs else None,
    )


def _directions(points: np.typing.NDArray[np.float64]) -> tuple[str, ...]:
    steps = np.diff(points, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    total = float(lengths.sum())
    if total == 0:
        return ("dot",)
    quarter = np.round(np.arctan2(steps[:, 1], steps[:, 0]) / (np.pi / 2)).astype(int) % STROKE_PARTS
    runs: list[list[float]] = []
    for turn, length in zip(quarter.tolist(), lengths.tolist(), strict=True):
        if runs and runs[-1][0] == turn:
            runs[-1][1] += length
        elif length:
            runs.append([turn, length])
    kept = [int(turn) for turn, length in runs if length >= total / 8]
    told = [turn for k, turn in enumerate(kept) if k == 0 or kept[k - 1] != turn]
    return tuple(("right", "down", "left", "up")[turn] for turn in told)
