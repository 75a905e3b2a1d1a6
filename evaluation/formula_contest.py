"""The contest over handwritten mathematics: every reader reads the same expressions from their ink alone.

Readers (`recognizer.handwriting.roster`) differ in who tells the signs; the grammar and the search are the same for all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

from evaluation.formula_suites import FormulaSuite, generated_formulas
from evaluation.handwriting import Read, Scores, read_all, scores
from evaluation.memory import Memory, memory
from evaluation.metrics.mathematics import mistakes, structure
from evaluation.parallel import Progress, Workers, in_parallel, silent
from recognizer.handwriting.reader import Reader
from recognizer.handwriting.roster import reader_of
from sketch.files.jsonl import Row

BATCH = 8
"""Expressions of a task: a second of work or so."""
WARM_UP = 91_002
"""Seed of the expression that is read before the clock starts."""


@dataclass(frozen=True, slots=True, eq=False)
class FormulaResult:
    """One reader on one suite: what it read of every row, in the suite's order, what that is worth, and what memory it takes."""

    name: str
    reads: tuple[Read, ...]
    scores: Scores
    memory: Memory

    @property
    def right(self) -> tuple[bool, ...]:
        """Whether each expression was read as it was written."""
        return tuple(one.right for one in self.reads)

    @property
    def nearly(self) -> tuple[bool, ...]:
        """Whether each was read with one mistake at most."""
        return tuple(mistakes(one.truth or (), one.reading.row) <= 1 for one in self.reads)

    @property
    def structured(self) -> tuple[bool, ...]:
        """Whether each was read as laid out as it was, whatever its signs."""
        return tuple(structure(one.truth or ()) == structure(one.reading.row) for one in self.reads)

    @property
    def sure(self) -> tuple[float, ...]:
        """How sure the reader was of each."""
        return tuple(one.reading.confidence for one in self.reads)


def formula_contest(
    suite: FormulaSuite, names: Sequence[str], workers: Workers = 1, progress: Progress = silent
) -> tuple[FormulaResult, ...]:
    """Every reader of these names over the suite. Raises ValueError for a name that no reader bears."""
    tasks = [
        (name, suite.rows[first : first + BATCH])
        for name in names
        for first in range(0, len(suite.rows), BATCH)
    ]
    read: dict[str, list[Read]] = {name: [] for name in names}
    batches = in_parallel(_read, tasks, workers, "Reading expressions", progress)
    for (name, _), batch in zip(tasks, batches, strict=True):
        read[name] += batch
    return tuple(
        FormulaResult(name, tuple(own), scores(own), memory(name, "reader")) for name, own in read.items()
    )


def _read(task: tuple[str, Sequence[Row]]) -> list[Read]:
    name, rows = task
    return read_all(rows, _warm(name))


@cache
def _warm(name: str) -> Reader:
    """This process's own reader of that name, which has read something: what is compiled or loaded on the way is no
    expression's time."""
    reader = reader_of(name)
    reader.read(generated_formulas(1, WARM_UP).rows[0].ink.strokes)
    return reader
