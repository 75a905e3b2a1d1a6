"""The suites that are streamed: what a part of each holds, and what all parts come to.

Strokes: a row for each stroke and recognizer, `index`, `label`, `name`, the kind it `claimed`, how `sure` it was.
Pages: a row for each page and recognizer, its scores as `page_contest.PageScore` has them. Problems: the same for textbook
problems drawn by simulated pens, the problems in turn. Ink: strokes as rows of a suite (`sketch.files.parquet`), for whoever
wants them. Items of generated suites are by writers of their own, so that intervals need no clusters.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol

import numpy as np

from evaluation.metrics.strokes import IntArray
from evaluation.rivals import resident
from evaluation.statistics.closed import of_mean, of_recalls, of_share
from evaluation.statistics.intervals import Interval
from sketch.files import parquet as suites
from sketch.files.jsonl import Row
from sketch.ink import Ink
from sketch.page import STROKE_KINDS

SuiteName = Literal["strokes", "pages", "problems", "ink"]


@dataclass(frozen=True, slots=True)
class Shard:
    """Items start … start + count − 1 of a suite under a seed, for recognizers of these names."""

    suite: SuiteName
    start: int
    count: int
    seed: int
    names: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Tally:
    """A recognizer over all parts: how many rows, and each measure with its interval."""

    name: str
    rows: int
    measures: Mapping[str, Interval]


class Sums(Protocol):
    """What has been counted of the parts so far, of a size that does not grow."""

    def add(self, part: Any) -> None:
        """Counts a part, a pyarrow table of the suite's summed columns."""
        ...

    def tallies(self) -> list[Tally]:
        """What all of it comes to."""
        ...


@dataclass(frozen=True, slots=True)
class Streamed:
    """part: a shard's bytes, the same for the same shard; summed: the columns that are counted; sums: of nothing yet."""

    part: Callable[[Shard], bytes]
    summed: tuple[str, ...]
    sums: Callable[[Sequence[str]], Sums]


def part_of(shard: Shard) -> bytes:
    """The shard worked on: its part as Parquet. The same shard gives the same bytes."""
    return SUITES[shard.suite].part(shard)


class Confusions:
    """Strokes by recognizer, kind and claim."""

    def __init__(self, names: Sequence[str]) -> None:
        size = len(STROKE_KINDS)
        self.tables: dict[str, IntArray] = {name: np.zeros((size, size), dtype=np.int64) for name in names}

    def add(self, part: Any) -> None:
        counted = part.group_by(["name", "label", "claimed"]).aggregate([([], "count_all")])
        for row in counted.to_pylist():
            kinds = STROKE_KINDS.index(row["label"]), STROKE_KINDS.index(row["claimed"])
            self.tables[row["name"]][kinds] += row["count_all"]

    def tallies(self) -> list[Tally]:
        return [
            Tally(
                name,
                int(table.sum()),
                {
                    "accuracy": of_share(int(np.trace(table)), int(table.sum())),
                    "balanced accuracy": of_recalls(np.diag(table), table.sum(axis=1)),
                },
            )
            for name, table in self.tables.items()
        ]


class Means:
    """Shares and means of columns by recognizer; rows that are null in a column do not count in it."""

    def __init__(self, names: Sequence[str], measures: Mapping[str, str]) -> None:
        self.measures = measures
        self.rows = dict.fromkeys(names, 0)
        self.moments = {(name, column): np.zeros(3) for name in names for column in measures}
        """How many, their sum, and the sum of their squares."""

    def add(self, part: Any) -> None:
        by = np.array(part.column("name").to_pylist())
        for name in self.rows:
            own = by == name
            self.rows[name] += int(own.sum())
            for column in self.measures:
                told = np.array(part.column(column).to_pylist(), dtype=float)[own]
                told = told[~np.isnan(told)]
                self.moments[name, column] += (len(told), told.sum(), (told**2).sum())

    def tallies(self) -> list[Tally]:
        return [
            Tally(
                name,
                rows,
                {
                    measure: of_mean(*self.moments[name, column].tolist())
                    if column == "motion"
                    else of_share(*self.moments[name, column][[1, 0]].astype(int).tolist())
                    for column, measure in self.measures.items()
                    if self.moments[name, column][0]
                },
            )
            for name, rows in self.rows.items()
        ]


class Nothing:
    """Ink is for others to count."""

    def add(self, part: Any) -> None:
        """Nothing is counted."""

    def tallies(self) -> list[Tally]:
        return []


PAGES = {
    "exact": "read exactly",
    "same_outcome": "same outcome",
    "motion": "motion error",
    "same_verdict": "same verdict",
}
PROBLEMS = {"exact": "read exactly", "same": "same outcome"}


def ink_rows(count: int, seed: int, start: int = 0, **how: Any) -> Iterator[Row]:
    """Generated strokes as rows of a suite; how: what else `data_gen.strokes.stream` takes."""
    from data_gen.strokes import stream

    for item in stream(count, seed, start, **how):
        yield Row(item.kind, Ink((item.stroke,)), None, {"index": item.index, "seed": seed})


def _strokes(shard: Shard) -> bytes:
    columns: dict[str, list[Any]] = {key: [] for key in ("index", "label", "name", "claimed", "sure")}
    for row in ink_rows(shard.count, shard.seed, shard.start):
        for name in shard.names:
            (claim,) = resident(name).recognize(row.ink)
            values = (row.extra["index"], row.label, name, claim.kind, claim.confidence)
            for column, value in zip(columns.values(), values, strict=True):
                column.append(value)
    return _table(columns)


def _pages(shard: Shard) -> bytes:
    from data_gen.pages import pages
    from evaluation.page_contest import read_page, score_page, true_reading

    keys = ("index", "problem", "answer", "name", "exact", "components", "grouping", "ends", "fixed")
    columns: dict[str, list[Any]] = {
        key: [] for key in (*keys, "motion", "missed", "same_outcome", "same_verdict")
    }
    for page in pages(shard.count, shard.seed, shard.start):
        truth = true_reading(page)
        for name in shard.names:
            score = score_page(page, truth, read_page(page, name))
            match = score.match
            values = (
                *(page.index, page.name, page.answer, name),
                *(match.exact, match.components, match.grouping, match.ends, match.fixed),
                *(score.motion.error, score.motion.missed, score.same_outcome, score.same_verdict),
            )
            for column, value in zip(columns.values(), values, strict=True):
                column.append(value)
    return _table(columns, {"same_verdict": "bool"})


def _problems(shard: Shard) -> bytes:
    from data_gen.textbook.roster import names
    from evaluation.textbook_pens import read_problem

    every = list(names())
    columns: dict[str, list[Any]] = {key: [] for key in ("index", "problem", "name", "exact", "same")}
    for index in range(shard.start, shard.start + shard.count):
        for one in read_problem((every[index % len(every)], shard.seed, index, shard.names)):
            values = (index, ": ".join(one.name), one.recognizer, one.exact, one.same)
            for column, value in zip(columns.values(), values, strict=True):
                column.append(value)
    return _table(columns)


def _ink(shard: Shard) -> bytes:
    out = io.BytesIO()
    suites.pour(out, ink_rows(shard.count, shard.seed, shard.start))
    return out.getvalue()


def _table(columns: Mapping[str, list[Any]], types: Mapping[str, str] | None = None) -> bytes:
    """The columns as Parquet. types: of columns that may hold nothing but nulls, which say no type themselves."""
    import pyarrow as pa
    from pyarrow import parquet

    named = {key: pa.type_for_alias(alias) for key, alias in (types or {}).items()}
    table = pa.table({key: pa.array(values, named.get(key)) for key, values in columns.items()})
    out = io.BytesIO()
    parquet.write_table(table, out, compression="zstd")
    return out.getvalue()


SUITES: Mapping[SuiteName, Streamed] = {
    "strokes": Streamed(_strokes, ("label", "name", "claimed"), Confusions),
    "pages": Streamed(_pages, ("name", *PAGES), lambda names: Means(names, PAGES)),
    "problems": Streamed(_problems, ("name", *PROBLEMS), lambda names: Means(names, PROBLEMS)),
    "ink": Streamed(_ink, ("label",), lambda _names: Nothing()),
}
