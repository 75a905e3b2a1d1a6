"""The contest's tables, once, for the terminal and for the report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations

from evaluation.examination import probability
from evaluation.metrics.strokes import StrokeScores
from evaluation.statistics.paired import mcnemar
from evaluation.stroke_contest import DIAGRAM_KINDS, StrokeResult
from evaluation.suites import StrokeSuite
from evaluation.table import UNKNOWN, Cell, Table, column, table
from sketch.page import STROKE_KINDS, StrokeKind

TOLD = 5
"""Notices of the reader of files that are shown; the JSON file holds all of them."""

MEMORY = (
    "Memory: by how much the greatest resident memory of a fresh process grows while it loads the recognizer and reads some "
    "generated ink, libraries that only it needs included; learnt: the size of the files that hold what it learnt."
)

LISTED = 12
"""Labels that a sentence lists; the JSON file holds all of them."""


def stroke_table(suite: StrokeSuite, results: Sequence[StrokeResult]) -> Table:
    """One row a recognizer: the scores of strokes, the time they take, and the memory."""

    def share(values: Sequence[float | None], low: bool = False) -> list[Cell]:
        return column(values, 1, 100, low)

    return table(
        f"{suite.name}: {len(suite.labels)} rows scored. Shares in %, times in ms a stroke on one thread; memory and learnt in MB.",
        [result.name for result in results],
        {
            "accuracy": share([result.scores.accuracy for result in results]),
            "balanced": share([result.scores.balanced_accuracy for result in results]),
            "macro-F1": share([result.scores.macro_f1 for result in results]),
            "five kinds": share([result.five.balanced_accuracy for result in results]),
            "ECE": share([result.scores.ece for result in results], low=True),
            "p50 ms": column([result.latency.p50 for result in results], 2, low=True),
            "p95 ms": column([result.latency.p95 for result in results], 2, low=True),
            "memory": column([result.memory.grown for result in results], 0, low=True),
            "learnt": column([result.memory.learnt for result in results], 2, low=True),
        },
    )


def recall_table(results: Sequence[StrokeResult]) -> Table:
    """One row a kind: how many there are, and each recognizer's recall."""
    kinds: list[StrokeKind] = [
        kind for kind in STROKE_KINDS if results and kind in results[0].scores.per_class
    ]

    def recall(scores: StrokeScores) -> list[float]:
        return [scores.per_class[kind].recall for kind in kinds]

    by_kind = [
        column(list(values), 1, 100)
        for values in zip(*(recall(result.scores) for result in results), strict=True)
    ]
    rows = tuple(
        (kind, Cell(str(results[0].scores.per_class[kind].n)), *cells)
        for kind, cells in zip(kinds, by_kind, strict=True)
    )
    head = ("", "n", *(result.name for result in results))
    return Table("Recall of each kind in %.", head, rows)


def stroke_notes(suite: StrokeSuite, results: Sequence[StrokeResult]) -> list[str]:
    """What the tables do not say, in sentences."""
    five = results[0].five.n if results else 0
    notes = [
        f"Five kinds: balanced accuracy over {five} single strokes, each one of {', '.join(DIAGRAM_KINDS)}.",
        MEMORY,
    ]
    several = sum(not single for single in suite.single)
    if several:
        notes.append(
            f"{several} rows are of several strokes; such a row's claim is the kind of the greatest score "
            "summed over its strokes."
        )
    for result in results:
        beyond = {label: n for label, n in result.unclaimable.items() if label in STROKE_KINDS}
        if beyond:
            notes.append(
                f"{result.name} cannot claim {_listed(beyond)}, which count as errors; without them its balanced "
                f"accuracy is {_percent(result.claimable.balanced_accuracy)} %."
            )
    if suite.unknown:
        notes.append(
            f"No recognizer can claim labels that are no stroke kind; they are not scored: {_listed(suite.unknown)}."
        )
    if suite.unlabelled:
        notes.append(f"{suite.unlabelled} rows bear no label and are not scored.")
    notes += [
        f"{first.name} alone is right on {test.only_first} rows, {second.name} alone on {test.only_second} "
        f"(exact McNemar test, p {sign}{probability(test.p)})."
        for first, second in combinations(results, 2)
        for test in [mcnemar(first.right, second.right)]
        if test.p is not None
        for sign in ["" if probability(test.p).startswith("<") else "= "]
    ]
    more = len(suite.notices) - TOLD
    return [*notes, *suite.notices[:TOLD], *([f"… and {more} more such notices."] if more > 0 else [])]


def _listed(labels: Mapping[str, int]) -> str:
    """The most frequent labels with their counts, and how many are left."""
    shown = [f"{label} ({n})" for label, n in list(labels.items())[:LISTED]]
    more = len(labels) - len(shown)
    return ", ".join(shown) + (f" and {more} more labels" if more > 0 else "")


def _percent(share: float | None) -> str:
    return UNKNOWN if share is None else f"{100 * share:.1f}"
