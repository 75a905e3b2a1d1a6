"""A reader of mathematics on labelled rows: how much it reads right, how sure it is, and how long it takes."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from evaluation.metrics.mathematics import Found, mistakes, same, signs, structure
from evaluation.metrics.strokes import calibration_error
from recognizer.handwriting.reader import Reader, Reading
from sketch.files.jsonl import Row as InkRow
from sketch.writing.rows import Row, RowError, row_of, sign_named

BINS = 10
"""Of the calibration error, equally wide."""


@dataclass(frozen=True, slots=True)
class Read:
    """One row's truth (None where it has no label that is mathematics), its reading and the time that it took."""

    truth: Row | None
    reading: Reading
    seconds: float
    signs: tuple[Found, ...] = ()

    @property
    def right(self) -> bool:
        return self.truth is not None and same(self.truth, self.reading.row)


@dataclass(frozen=True, slots=True)
class Scores:
    """Shares of one unless told otherwise; None where nothing was labelled. Latency in milliseconds."""

    rows: int
    labelled: int
    expression_rate: float | None
    one_mistake_rate: float | None
    structure_rate: float | None
    symbol_accuracy: float | None
    symbol_accuracy_merged: float | None
    calibration_error: float | None
    latency_ms: dict[str, float]


def read_all(
    rows: Sequence[InkRow], reader: Reader, tell: Callable[[int], None] = lambda _done: None
) -> list[Read]:
    """Every row read from nothing."""
    found: list[Read] = []
    for index, row in enumerate(rows):
        begun = time.perf_counter()
        reading = reader.read(row.ink.strokes)
        taken = time.perf_counter() - begun
        found.append(Read(truth_of(row), reading, taken, tuple(signs(segmented(row), reading.row))))
        tell(index + 1)
    return found


def truth_of(row: InkRow) -> Row | None:
    """What the row says was written: its `norm` where it has one, else its label; None where that is no mathematics."""
    text = row.extra.get("norm") or row.label
    if not isinstance(text, str) or not text.strip():
        return None
    try:
        return row_of(text)
    except RowError:
        return None


def segmented(row: InkRow) -> list[tuple[str, tuple[int, ...]]]:
    """The signs that the row says were written, each with its strokes; none where it does not say."""
    found: list[tuple[str, tuple[int, ...]]] = []
    written: Any = row.extra.get("symbols")
    for symbol in written if isinstance(written, list) else []:
        try:
            found.append(
                (sign_named(str(symbol["label"])), tuple(int(stroke) for stroke in symbol["strokes"]))
            )
        except (KeyError, TypeError, ValueError):
            continue
    return found


def scores(found: Sequence[Read]) -> Scores:
    """What the readings are worth."""
    told = [one for one in found if one.truth is not None]
    each = [sign for one in found for sign in one.signs]
    right = [one.right for one in told]
    times = np.array([one.seconds for one in found]) * 1e3

    def share(values: Sequence[bool]) -> float | None:
        return float(np.mean(values)) if len(values) else None

    return Scores(
        rows=len(found),
        labelled=len(told),
        expression_rate=share(right),
        one_mistake_rate=share([mistakes(one.truth or (), one.reading.row) <= 1 for one in told]),
        structure_rate=share([structure(one.truth or ()) == structure(one.reading.row) for one in told]),
        symbol_accuracy=share([sign.right for sign in each]),
        symbol_accuracy_merged=share([sign.merged for sign in each]),
        calibration_error=calibration_error(
            np.array([one.reading.confidence for one in told]), np.array(right, dtype=bool), BINS
        ),
        latency_ms={
            "mean": round(float(times.mean()), 2),
            "p50": round(float(np.quantile(times, 0.5)), 2),
            "p95": round(float(np.quantile(times, 0.95)), 2),
            "max": round(float(times.max()), 2),
        },
    )


def confusions(found: Sequence[Read]) -> Counter[tuple[str, str]]:
    """How often which sign was read as which other; "" where its strokes were shared out otherwise."""
    return Counter((sign.truth, sign.claim or "") for one in found for sign in one.signs if not sign.right)
