"""The tables of the contest under stress."""

from __future__ import annotations

from collections.abc import Sequence

from evaluation.examination import spread
from evaluation.stress import AXES
from evaluation.stress_contest import Curve, Groups
from evaluation.table import UNKNOWN, Cell, Table

PERCENT = "%"


def stress_tables(curves: Sequence[Curve], by_group: Sequence[Groups]) -> list[Table]:
    """One for each axis and measure, a row a recognizer; one for the groups of writers."""
    told: list[Table] = []
    for axis, measure in dict.fromkeys((curve.axis, curve.measure) for curve in curves):
        own = [curve for curve in curves if (curve.axis, curve.measure) == (axis, measure)]
        what = (
            "Balanced accuracy of strokes" if measure == "accuracy" else "Mean motion error of pages at 2 s"
        )
        told.append(
            Table(
                f"{what} in % (95 % interval) against {AXES[axis].about}, {AXES[axis].unit}; n = {own[0].values[0].n}.",
                ("", *(shown(axis, level) for level in own[0].levels)),
                tuple((curve.name, *(Cell(spread(value)) for value in curve.values)) for curve in own),
            )
        )
    if by_group:
        n = next(iter(by_group[0].values.values())).n
        told.append(
            Table(
                f"Balanced accuracy in % (95 % interval) by group of simulated writers; {n} strokes each.",
                ("", *by_group[0].values, "worst"),
                tuple(
                    (
                        one.name,
                        *(Cell(spread(value)) for value in one.values.values()),
                        Cell(one.worst or UNKNOWN),
                    )
                    for one in by_group
                ),
            )
        )
    return told


def shown(axis: str, level: float) -> str:
    """A level as a person reads it."""
    if level == float("inf"):
        return "as drawn"
    return f"{100 * level:g}" if AXES[axis].unit.startswith(PERCENT) else f"{level:g}"
