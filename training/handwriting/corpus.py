"""Generated expressions as what the nets of the reader learn from, in shards on disk: one seed each.

A shard holds lines of strokes at equal spacing, every group of strokes that may be a sign with its sign
(`JUNK` when it is none), and the row that was written.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from data_gen.writers import sample_writer
from data_gen.writing.form import RULE as FORM
from data_gen.writing.form import FormRule
from data_gen.writing.grammars import aslant, drill, mixed
from data_gen.writing.habits import RULE as TYPE
from data_gen.writing.habits import TypeRule, habits
from data_gen.writing.typeset import written
from recognizer.handwriting.line import Group, Line, groups, line_of, spaced
from sketch.writing.rows import Row, nodes_of
from sketch.writing.signs import NUMBER, SIGNS

JUNK = len(SIGNS)
"""The number of what is no sign."""
SLANTED = 0.45
"""Share of lines with many scripts among those that relations are learnt from."""
JUNKY = 1.3
"""Groups that are no sign for each that is one, at most."""
DRILLED = 0.2
"""Share of lines of any signs side by side: the rest are expressions."""

Grammar = Callable[[np.random.Generator], Row]


@dataclass(frozen=True, slots=True)
class Hand:
    """The ranges of people's hands that ink is made with; pen: by a simulated pen, not as the paths are meant."""

    type: TypeRule = TYPE
    form: FormRule = FORM
    pen: bool = True


HAND = Hand()


@dataclass(frozen=True, slots=True, eq=False)
class Example:
    """A line with its truth: groups and the number of the sign of each, and the row."""

    line: Line
    groups: tuple[Group, ...]
    signs: tuple[int, ...]
    row: Row


def example(rng: np.random.Generator, grammar: Grammar | None = None, hand: Hand = HAND) -> Example:
    """One line by a writer of its own."""
    chosen = grammar or (drill if rng.random() < DRILLED else mixed)
    found = written(chosen(rng), habits(sample_writer(rng), rng, hand.type, hand.form), hand.pen)
    line = line_of([spaced(stroke) for stroke in found.ink])
    truth = {tuple(sorted(node.strokes)): NUMBER[node.name] for node in nodes_of(found.row)}
    junk = [group for group in groups(line) if group not in truth]
    kept = rng.permutation(len(junk))[: 2 + round(JUNKY * len(truth))]
    candidates = [*truth, *(junk[k] for k in kept)]
    return Example(line, tuple(candidates), tuple(truth.get(group, JUNK) for group in candidates), found.row)


def laid_out(rng: np.random.Generator) -> Example:
    """One line without a pen and without groups, rich in scripts: enough to learn relations from."""
    grammar = aslant if rng.random() < SLANTED else drill if rng.random() < DRILLED else mixed
    found = written(grammar(rng), habits(sample_writer(rng), rng), pen=False)
    return Example(line_of([spaced(stroke) for stroke in found.ink]), (), (), found.row)


def shard(folder: Path, seed: int, number: int, count: int) -> list[Example]:
    """Shard `number`: read where it is on disk, made and kept where it is not."""
    path = folder / f"{seed}-{number:04d}-{count}.pickle"
    if path.exists():
        return pickle.loads(path.read_bytes())
    made = [example(np.random.default_rng([seed, number, index])) for index in range(count)]
    folder.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".partial")
    partial.write_bytes(pickle.dumps(made, protocol=pickle.HIGHEST_PROTOCOL))
    partial.replace(path)
    return made


def shards(folder: Path, seed: int, count: int, size: int) -> Iterator[list[Example]]:
    """`count` shards of `size` lines each."""
    for number in range(count):
        yield shard(folder, seed, number, size)
