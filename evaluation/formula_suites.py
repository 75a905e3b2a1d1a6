"""Handwritten mathematics to compare readers on: people's labelled expressions, and generated ones by simulated writers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import numpy as np

from data_gen.writers import sample_writer
from data_gen.writing.grammars import mixed
from data_gen.writing.habits import habits
from data_gen.writing.typeset import written
from evaluation.handwriting import truth_of
from evaluation.lessons import ink_digest, writer_of
from sketch.files import formats
from sketch.files.errors import FileError
from sketch.files.jsonl import Row
from sketch.writing.rows import Row as Signs
from sketch.writing.rows import latex, nodes_of

LONGEST = 40
"""Signs of a generated expression; longer ones are drawn again."""


@dataclass(frozen=True, slots=True)
class FormulaSuite:
    """Labelled expressions. held: how many rows the source held; unread: rows whose label is no mathematics, or is missing; over:
    rows that were left out because fewer were asked for."""

    name: str
    rows: tuple[Row, ...]
    held: int
    unread: int = 0
    over: int = 0

    @property
    def clusters(self) -> tuple[str, ...]:
        """Whose rows are alike: the writers, or every row for itself."""
        return tuple(writer_of(row) for row in self.rows)

    @property
    def hash(self) -> str:
        """Of what is read, sixteen hexadecimal digits."""
        told = (f"{row.extra.get('norm') or row.label} {ink_digest(row.ink)}" for row in self.rows)
        return sha256("\n".join(told).encode()).hexdigest()[:16]


def formulas_from_files(paths: Sequence[Path], most: int | None = None) -> FormulaSuite:
    """All rows of some files whose label is mathematics, or `most` of them, evenly spread. Raises FileError when a file cannot be
    read, or when there is no such row."""
    every = [row for path in paths for row in formats.read(path).rows]
    usable = [row for row in every if len(row.ink) and truth_of(row) is not None]
    if not usable:
        raise FileError(
            ", ".join(map(str, paths)), "no row is labelled with mathematics; needed is LaTeX, as x^{2}+1"
        )
    count = min(len(usable), most or len(usable))
    chosen = np.linspace(0, len(usable) - 1, count).round().astype(int).tolist()
    return FormulaSuite(
        name=" + ".join(path.name for path in paths),
        rows=tuple(usable[k] for k in chosen),
        held=len(every),
        unread=len(every) - len(usable),
        over=len(usable) - count,
    )


def generated_formulas(
    count: int, seed: int, grammar: Callable[[np.random.Generator], Signs] = mixed
) -> FormulaSuite:
    """`count` expressions of a seed, each by a writer of its own; row i depends on (seed, i) alone."""
    rows = tuple(_formula(seed, index, grammar) for index in range(count))
    return FormulaSuite(f"{count} generated expressions, seed {seed}", rows, count)


def _formula(seed: int, index: int, grammar: Callable[[np.random.Generator], Signs]) -> Row:
    rng = np.random.default_rng([seed, index])
    signs = grammar(rng)
    while sum(1 for _ in nodes_of(signs)) > LONGEST:
        signs = grammar(rng)
    found = written(signs, habits(sample_writer(rng), rng))
    symbols = [{"label": node.name, "strokes": list(node.strokes)} for node in nodes_of(found.row)]
    return Row(latex(signs), found.ink, None, {"symbols": symbols})
