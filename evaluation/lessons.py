"""People's own samples as lessons: which rows rivals learn from, and who may then not be in the test.

No writer is on both sides. A lesson takes as few writers as it can, so that many are left to test on.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from math import ceil
from typing import cast

import numpy as np

from evaluation.rivals import KINDS
from recognizer.samples import Sample
from sketch.files.jsonl import Row
from sketch.ink import Ink
from sketch.page import StrokeKind


@dataclass(frozen=True, slots=True)
class Lesson:
    """samples: what is learnt from; writers: all who were looked at for it. A row without a writer is a writer of its own,
    named by its ink."""

    samples: tuple[Sample, ...]
    writers: frozenset[str]

    def taught_by(self, row: Row) -> bool:
        """Whether the row's writer is one of the lesson's."""
        return writer_of(row) in self.writers

    def counts(self) -> dict[StrokeKind, int]:
        """How many samples there are of each kind."""
        return dict[StrokeKind, int](Counter(sample.kind for sample in self.samples))


def lesson(rows: Sequence[Row], per_kind: int, rng: np.random.Generator) -> Lesson:
    """`per_kind` rows of each kind that can be taught, or half of those there are where that is less, by writers who are added at
    random until there are enough. Raises ValueError when no row can be taught from."""
    usable = [row for row in rows if row.label in KINDS and len(row.ink)]
    if not usable:
        labels = ", ".join(sorted({str(row.label) for row in rows})[:8])
        raise ValueError(f"no row to learn from: labels are {labels}; needed are some of {', '.join(KINDS)}")
    by_writer: dict[str, list[Row]] = {}
    for row in usable:
        by_writer.setdefault(writer_of(row), []).append(row)
    there = Counter(row.label for row in usable)
    wanted = {kind: min(per_kind, ceil(there[kind] / 2)) for kind in KINDS}
    writers = sorted(by_writer)
    chosen: list[str] = []
    found: Counter[str | None] = Counter()
    for index in rng.permutation(len(writers)).tolist():
        rows_of = by_writer[writers[index]]
        if any(found[row.label] < wanted[cast(StrokeKind, row.label)] for row in rows_of):
            chosen.append(writers[index])
            found.update(row.label for row in rows_of)
    samples: list[Sample] = []
    for kind in KINDS:
        offered = [row for writer in chosen for row in by_writer[writer] if row.label == kind]
        picked = rng.permutation(len(offered))[: wanted[kind]].tolist()
        samples += [Sample(offered[k].ink, kind, offered[k].writer) for k in picked]
    return Lesson(tuple(samples), frozenset(chosen))


def writer_of(row: Row) -> str:
    """Who wrote the row; where nobody is named, somebody who wrote just this."""
    return f"writer {row.writer}" if row.writer is not None else f"ink {ink_digest(row.ink)}"


def ink_digest(ink: Ink) -> str:
    """Of the points of the ink, sixteen hexadecimal digits."""
    hashed = sha256()
    for stroke in ink:
        hashed.update(len(stroke).to_bytes(8, "big") + stroke.points.tobytes())
    return hashed.hexdigest()[:16]
