"""Scores of what strokes were taken for: pure functions of (truth, claim).

A confusion matrix has a row for every stroke kind (the truth), a column for every stroke kind
(the claim) and one column more for strokes that nobody claimed, so that a refusal costs recall
and costs no precision. A score of nothing is None, never a number.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from recognizer.claims import Claim
from sketch.ink import FloatArray
from sketch.page import STROKE_KINDS, StrokeKind

IntArray = NDArray[np.int64]
_COLUMN = {kind: column for column, kind in enumerate(STROKE_KINDS)}
_NOBODY = len(STROKE_KINDS)

CALIBRATION_BINS = 15
"""Equal-width bins of the top confidence for the calibration error, the customary number."""


@dataclass(frozen=True, slots=True)
class ClassScore:
    """n: how many are truly of this kind (at least one); recall: share of them claimed as it;
    precision: share of its claims that are right, None when it was never claimed."""

    n: int
    recall: float
    precision: float | None


@dataclass(frozen=True, slots=True, eq=False)
class StrokeScores:
    """All scores of one recognizer on one set of labelled claims; None where there was nothing to
    score. confusion: (9, 10) counts as the module describes."""

    n: int
    accuracy: float | None
    balanced_accuracy: float | None
    macro_f1: float | None
    ece: float | None
    per_class: dict[StrokeKind, ClassScore]
    confusion: IntArray


def score(truth: Sequence[StrokeKind], claims: Sequence[Claim]) -> StrokeScores:
    """Every score of claims against truth, in step. A rejected claim counts by its best guess:
    stroke scores compare raw claims."""
    table = confusion(truth, [claim.kind for claim in claims])
    right = np.array([kind == claim.kind for kind, claim in zip(truth, claims, strict=True)], dtype=bool)
    sure = np.array([claim.confidence for claim in claims], dtype=np.float64)
    return StrokeScores(
        n=len(truth),
        accuracy=accuracy(table),
        balanced_accuracy=balanced_accuracy(table),
        macro_f1=macro_f1(table),
        ece=calibration_error(sure, right),
        per_class=per_class(table),
        confusion=table,
    )


def confusion(truth: Sequence[StrokeKind], claimed: Sequence[StrokeKind | None]) -> IntArray:
    """Counts (9, 10): row the truth, column the claim in the order of `STROKE_KINDS`, last column
    claimed by nobody (None)."""
    table = np.zeros((len(STROKE_KINDS), len(STROKE_KINDS) + 1), dtype=np.int64)
    for kind, claim in zip(truth, claimed, strict=True):
        table[_COLUMN[kind], _NOBODY if claim is None else _COLUMN[claim]] += 1
    return table


def accuracy(table: IntArray) -> float | None:
    """Share of all that are claimed as what they are."""
    total = int(table.sum())
    return float(np.trace(table)) / total if total else None


def balanced_accuracy(table: IntArray) -> float | None:
    """Mean recall over the kinds that are present: each kind counts the same, however frequent."""
    present = table.sum(axis=1) > 0
    return float(_recalls(table)[present].mean()) if present.any() else None


def macro_f1(table: IntArray) -> float | None:
    """Mean over the kinds that are present of 2·right / (truly so + claimed so)."""
    present = table.sum(axis=1) > 0
    if not present.any():
        return None
    truly, claimed = table.sum(axis=1), table.sum(axis=0)[:_NOBODY]
    return float((2 * np.diag(table)[present] / (truly + claimed)[present]).mean())


def per_class(table: IntArray) -> dict[StrokeKind, ClassScore]:
    """A `ClassScore` for every kind that is present, in the order of `STROKE_KINDS`."""
    truly, claimed, right = table.sum(axis=1), table.sum(axis=0), np.diag(table)
    return {
        kind: ClassScore(
            n=int(truly[k]),
            recall=float(right[k] / truly[k]),
            precision=float(right[k] / claimed[k]) if claimed[k] else None,
        )
        for k, kind in enumerate(STROKE_KINDS)
        if truly[k]
    }


def calibration_error(
    confidence: FloatArray, right: NDArray[np.bool_], bins: int = CALIBRATION_BINS
) -> float | None:
    """Expected calibration error: the items are put into `bins` equal bins of their confidence
    (n,), each closed above; the gap between a bin's mean confidence and its share of right ones
    (n,), averaged with the bin's share of all items as weight."""
    if len(confidence) == 0:
        return None
    place = np.clip(np.ceil(confidence * bins).astype(np.int64) - 1, 0, bins - 1)
    claimed = np.bincount(place, weights=confidence, minlength=bins)
    correct = np.bincount(place, weights=right, minlength=bins)
    return float(np.abs(claimed - correct).sum()) / len(confidence)


def _recalls(table: IntArray) -> FloatArray:
    """Recall of each kind, (9,); 0 where the kind is absent."""
    return np.diag(table) / np.maximum(table.sum(axis=1), 1)
