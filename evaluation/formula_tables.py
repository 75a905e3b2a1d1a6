"""The table of the contest over handwritten mathematics, and what it does not say."""

from __future__ import annotations

from collections.abc import Sequence

from evaluation.formula_contest import FormulaResult
from evaluation.formula_suites import FormulaSuite
from evaluation.table import Table, column, table
from evaluation.tables import MEMORY


def formula_table(suite: FormulaSuite, results: Sequence[FormulaResult]) -> Table:
    """One row a reader: what it reads right, how sure it is of it, the time it takes, and the memory."""
    scores = [result.scores for result in results]
    return table(
        f"{suite.name}: {len(suite.rows)} expressions. Shares in %, times in ms an expression; memory and learnt in MB.",
        [result.name for result in results],
        {
            "right": column([one.expression_rate for one in scores], 1, 100),
            "one mistake": column([one.one_mistake_rate for one in scores], 1, 100),
            "structure": column([one.structure_rate for one in scores], 1, 100),
            "signs": column([one.symbol_accuracy for one in scores], 1, 100),
            "twins merged": column([one.symbol_accuracy_merged for one in scores], 1, 100),
            "ECE": column([one.calibration_error for one in scores], 1, 100, low=True),
            "p50 ms": column([one.latency_ms["p50"] for one in scores], 0, low=True),
            "p95 ms": column([one.latency_ms["p95"] for one in scores], 0, low=True),
            "memory": column([result.memory.grown for result in results], 0, low=True),
            "learnt": column([result.memory.learnt for result in results], 2, low=True),
        },
    )


def formula_notes(suite: FormulaSuite) -> list[str]:
    """What the table means, in sentences, and what is not in it."""
    left = [
        f"{suite.unread} rows whose label is no mathematics are left out." * bool(suite.unread),
        f"{suite.over} rows more are there; those read are evenly spread over all." * bool(suite.over),
    ]
    return [
        (
            "Right: the canonical LaTeX is the one that was written. One mistake: at most one sign or relation is to be put right. "
            "Signs: of those written, how many were read from just their strokes as what they are, or as a twin of the same shape "
            "(merged). Times are of the clock, while as many processes worked as took part."
        ),
        MEMORY,
        *(line for line in left if line),
    ]
