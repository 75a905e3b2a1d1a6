"""What a streamed run came to, as a table."""

from __future__ import annotations

from collections.abc import Sequence

from evaluation.examination import spread
from evaluation.stream_suites import Tally
from evaluation.table import UNKNOWN, Cell, Table

DIGITS = 2
"""After the point of a percentage: with a million rows they mean something."""


def tally_table(what: str, found: Sequence[Tally]) -> Table:
    """A row a recognizer, a column a measure."""
    measures = list(dict.fromkeys(measure for one in found for measure in one.measures))
    counts = {
        measure: next(one.measures[measure].n for one in found if measure in one.measures)
        for measure in measures
    }
    n = ", ".join(f"{measure} {count}" for measure, count in counts.items())
    return Table(
        f"{what}: in %, with 95 % intervals; n: {n}.",
        ("", *measures),
        tuple(
            (
                one.name,
                *(
                    Cell(spread(one.measures[measure], DIGITS) if measure in one.measures else UNKNOWN)
                    for measure in measures
                ),
            )
            for one in found
        ),
    )
