"""A set of people's gestures in tables: relative accuracy by label, and how far people agree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, fields
from typing import Any

import numpy as np

from evaluation.gestures.agreement import Consistency, consistency
from evaluation.gestures.relative import RelativeAccuracy, relative_accuracy, task_axis
from evaluation.lessons import writer_of
from evaluation.statistics.intervals import Interval, balanced
from evaluation.table import Cell, Table
from sketch.files.jsonl import Row

UNITS = {
    "shape_error": "units",
    "shape_variability": "units",
    "length_error": "units",
    "size_error": "units²",
    "bending_error": "rad",
    "bending_variability": "rad",
    "time_error": "s",
    "time_variability": "s",
    "speed_error": "units/s",
    "speed_variability": "units/s",
    "stroke_error": "strokes",
    "order_error": "units",
}
MEASURES = tuple(field.name for field in fields(RelativeAccuracy))
Measured = dict[str, dict[str, Interval | None]]
"""For each label each measure's mean with its interval; None where no drawing has it."""


def measure(rows: Sequence[Row], seed: int = 0, per_writer: bool = False) -> Measured:
    """The mean of every measure over the drawings of each label, clustered by writer. per_writer: against each writer's own
    axis, which tells how steady a person is, rather than against everybody's."""
    by_label: dict[str, list[Row]] = {}
    for row in rows:
        if row.label is not None and len(row.ink):
            by_label.setdefault(row.label, []).append(row)
    return {label: _label(by_label[label], seed, per_writer) for label in sorted(by_label)}


def _label(rows: Sequence[Row], seed: int, per_writer: bool) -> dict[str, Interval | None]:
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(writer_of(row) if per_writer else "", []).append(row)
    found: list[tuple[str, RelativeAccuracy]] = []
    for own in groups.values():
        axis = task_axis([row.ink for row in own])
        found += [(writer_of(row), relative_accuracy(row.ink, axis)) for row in own]
    told: dict[str, Interval | None] = {}
    for name in MEASURES:
        values = [(writer, value) for writer, one in found if (value := getattr(one, name)) is not None]
        told[name] = (
            balanced(
                [[v for _, v in values]],
                [0] * len(values),
                [w for w, _ in values],
                np.random.default_rng(seed),
            )[0]
            if values
            else None
        )
    return told


def tables(measured: Measured, agreed: Sequence[Consistency]) -> list[Table]:
    """A row a label, a column a measure; then ways of drawing."""
    relative = Table(
        "Relative accuracy (GREAT): means with 95 % intervals, clustered by writer.",
        ("", "n", *(f"{name.replace('_', ' ')}, {UNITS[name]}" for name in MEASURES)),
        tuple(
            (label, Cell(_count(own)), *(Cell(_shown(own[name])) for name in MEASURES))
            for label, own in measured.items()
        ),
    )
    ways = Table(
        "Ways of drawing: distinct ones, and how often two drawings are made the same way, within a writer and between writers.",
        ("", "drawings", "ways", "within", "between"),
        tuple(
            (
                one.label,
                Cell(str(one.drawings)),
                Cell(str(one.ways)),
                Cell(_rate(one.within)),
                Cell(_rate(one.between)),
            )
            for one in agreed
        ),
    )
    return [relative, ways]


def plain(measured: Measured, agreed: Sequence[Consistency]) -> dict[str, Any]:
    """As JSON has it."""
    return {
        "relative_accuracy": {
            label: {name: None if value is None else asdict(value) for name, value in own.items()}
            for label, own in measured.items()
        },
        "consistency": [asdict(one) for one in agreed],
    }


def study(rows: Sequence[Row], seed: int = 0, per_writer: bool = False) -> tuple[list[Table], dict[str, Any]]:
    """Everything about a set of gestures: tables, and the same as JSON has it. Raises ValueError when no row has a label."""
    measured, agreed = measure(rows, seed, per_writer), consistency(rows)
    if not measured:
        raise ValueError("no row bears a label and ink; gestures are compared with others of their label")
    return tables(measured, agreed), plain(measured, agreed)


def _count(own: dict[str, Interval | None]) -> str:
    shape = own["shape_error"]
    return "0" if shape is None else str(shape.n)


def _shown(value: Interval | None) -> str:
    if value is None:
        return "–"
    return f"{value.value:.3g}" + ("" if value.low is None else f" ({value.low:.3g}–{value.high:.3g})")


def _rate(value: float | None) -> str:
    return "–" if value is None else f"{value:.3f}"
