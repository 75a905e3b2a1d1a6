"""A table of figures as a value, for the terminal and for the report alike."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

UNKNOWN = "–"
"""Nothing was measured."""


@dataclass(frozen=True, slots=True)
class Cell:
    """text: as shown; best: it is the best of its column (or row) and not the only one."""

    text: str
    best: bool = False


@dataclass(frozen=True, slots=True)
class Table:
    """head: names of the columns; rows: the row's name, then its cells."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, *tuple[Cell, ...]], ...]


def column(
    values: Sequence[float | None], digits: int, scale: float = 1.0, low: bool = False, beside: int = 0
) -> list[Cell]:
    """Cells of one column; the greatest value is the best one, or the smallest when `low`. What looks
    the same as the best is as good. The last `beside` values do not compete."""
    texts = [UNKNOWN if value is None else f"{scale * value:.{digits}f}" for value in values]
    rivals = len(texts) - beside
    known = [float(text) for text in texts[:rivals] if text != UNKNOWN]
    if len(known) < 2 or min(known) == max(known):
        return [Cell(text) for text in texts]
    best = min(known) if low else max(known)
    return [
        Cell(text, k < rivals and text != UNKNOWN and float(text) == best) for k, text in enumerate(texts)
    ]


def table(caption: str, names: Sequence[str], columns: Mapping[str, Sequence[Cell]]) -> Table:
    """A table with a row for each name, from its columns."""
    rows = [(name, *(cells[k] for cells in columns.values())) for k, name in enumerate(names)]
    return Table(caption, ("", *columns), tuple(rows))
