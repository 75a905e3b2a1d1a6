"""The tables of the contest over pages."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from evaluation.page_contest import PageResult
from evaluation.page_scores import PageSummary, by_problem, summarize
from evaluation.table import Cell, Table, column, table


def page_tables(results: Sequence[PageResult]) -> list[Table]:
    """How pages are read; how well the corrected shapes fit; how they move; the same by diagram. The
    last row is the oracle's, which does not compete."""
    if not results or not results[0].pages:
        return []
    names = [result.name for result in results]
    totals = [summarize(result.pages) for result in results]

    def cells(of: Callable[[PageSummary], float | None], scale: float = 100, digits: int = 1) -> list[Cell]:
        return column([of(total) for total in totals], digits, scale, beside=1)

    def errors(of: Callable[[PageSummary], float | None], scale: float = 100, digits: int = 2) -> list[Cell]:
        return column([of(total) for total in totals], digits, scale, low=True, beside=1)

    read = table(
        f"{totals[0].n} pages as they are read. Shares of pages in %, strokes: share of strokes right, balanced: mean recall of their kinds.",
        names,
        {
            "exact": cells(lambda s: s.exact),
            "components": cells(lambda s: s.components),
            "grouping": cells(lambda s: s.grouping),
            "ends": cells(lambda s: s.ends),
            "fixed": cells(lambda s: s.fixed),
            "strokes": cells(lambda s: s.strokes),
            "balanced": cells(lambda s: s.strokes_balanced),
        },
    )
    moved = table(
        "The corrected shapes and their motion. Lengths in % of the diagram's size, angle in degrees.",
        names,
        {
            "same outcome": cells(lambda s: s.same_outcome),
            "same verdict": cells(lambda s: s.same_verdict),
            "motion error": errors(lambda s: s.motion),
            "median": errors(lambda s: s.motion_median),
            "centre": errors(lambda s: s.centre),
            "radius": errors(lambda s: s.radius),
            "vertex": errors(lambda s: s.vertex),
            "angle": errors(lambda s: s.angle, 1),
            "unread": errors(lambda s: s.unread, 100, 1),
        },
    )
    return [read, moved, *_by_problem(results)]


def page_notes() -> list[str]:
    """What the tables mean, in sentences."""
    return [
        (
            "Exact: the right components from the right strokes, hanging on the right things, the right ones fixed. "
            "Motion error: distance between where bodies should be and where they are at 2 s, mean over bodies; a "
            "body that was not found, or that should not be there, counts as the whole diagram's size (100 %). "
            "Same verdict: of the pages with an answer by the student, those on which it is judged as on the page that was meant."
        ),
    ]


def _by_problem(results: Sequence[PageResult]) -> list[Table]:
    """A row a diagram: each recognizer's share of pages with the right outcome; its motion error."""
    split = [by_problem(result.pages) for result in results]
    head = ("", "n", *(result.name for result in results))

    def rows(
        of: Callable[[PageSummary], float | None], digits: int, low: bool
    ) -> tuple[tuple[str, *tuple[Cell, ...]], ...]:
        return tuple(
            (
                name,
                Cell(str(split[0][name].n)),
                *column([of(each[name]) for each in split], digits, 100, low, beside=1),
            )
            for name in split[0]
        )

    return [
        Table(
            "Pages with the right outcome in %, by diagram.", head, rows(lambda s: s.same_outcome, 0, False)
        ),
        Table("Mean motion error in %, by diagram.", head, rows(lambda s: s.motion, 2, True)),
    ]
