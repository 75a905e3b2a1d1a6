"""How early a stroke is known: accuracy against the fraction of its length that has been drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import partial
from typing import Any

import numpy as np

from evaluation.examination import spread
from evaluation.lessons import writer_of
from evaluation.parallel import Progress, Workers, silent
from evaluation.protocols import beginning, examine, usable, zero_shot
from evaluation.statistics.intervals import Interval, balanced
from evaluation.table import Cell, Table
from sketch.files.jsonl import Row


@dataclass(frozen=True, slots=True)
class EarlyCurve:
    """A recognizer's balanced accuracy at each fraction of the drawing."""

    name: str
    fractions: tuple[float, ...]
    values: tuple[Interval, ...]


def early_curves(
    rows: Sequence[Row],
    names: Sequence[str],
    steps: int,
    workers: Workers = 1,
    progress: Progress = silent,
    seed: int = 0,
) -> list[EarlyCurve]:
    """Every recognizer at `steps` equal fractions, on all rows whose label is a stroke kind. Raises ValueError when there is
    none."""
    known = usable(rows)
    splits = zero_shot(known)
    fractions = tuple(k / steps for k in range(1, steps + 1))
    found: dict[str, list[Interval]] = {name: [] for name in names}
    for fraction in fractions:
        guesses = examine(
            known, splits, names, seed, workers, progress, partial(beginning, fraction=fraction)
        )
        own = {name: [guess for guess in guesses if guess.name == name] for name in names}
        tested = own[names[0]]
        at = balanced(
            [[guess.right for guess in own[name]] for name in names],
            [guess.label for guess in tested],
            [writer_of(known[guess.row]) for guess in tested],
            np.random.default_rng(seed),
        )
        for name, value in zip(names, at, strict=True):
            found[name].append(value)
    return [EarlyCurve(name, fractions, tuple(values)) for name, values in found.items()]


def early_table(curves: Sequence[EarlyCurve]) -> Table:
    """A row a recognizer, a column a fraction."""
    n, writers = curves[0].values[0].n, curves[0].values[0].clusters
    return Table(
        f"Balanced accuracy in % (95 % interval) when a part of the ink has been drawn; {n} rows, {writers} writers.",
        ("", *(f"{100 * fraction:.0f} %" for fraction in curves[0].fractions)),
        tuple((curve.name, *(Cell(spread(value)) for value in curve.values)) for curve in curves),
    )


def plain(curves: Sequence[EarlyCurve]) -> dict[str, Any]:
    """As JSON has it."""
    return {
        curve.name: [
            {"fraction": fraction, **asdict(value)}
            for fraction, value in zip(curve.fractions, curve.values, strict=True)
        ]
        for curve in curves
    }
