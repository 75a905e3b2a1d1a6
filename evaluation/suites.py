"""What the recognizers are compared on: labelled strokes and whole pages.

A suite of strokes is a row of pages, each with one label: a single stroke, or the few strokes of
one symbol. Page units whatever their scale: a recognizer must not care.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import cast

import numpy as np

from data_gen import pages as page_generator
from data_gen import strokes as stroke_generator
from data_gen.pages import Page
from evaluation.lessons import Lesson, ink_digest, writer_of
from recognizer.claims import Claim
from sketch.files import formats
from sketch.files.errors import FileError
from sketch.ink import Ink
from sketch.page import STROKE_KINDS, StrokeKind


@dataclass(frozen=True, slots=True)
class StrokeSuite:
    """rows: how many the source held; inks and labels: those that are scored, in step;
    unknown: labels that are no stroke kind, with how many rows bear them (not scored);
    unlabelled: rows without a label (not scored); notices: what the reader of files skipped; writers: who drew each ink,
    each its own where nobody is named."""

    name: str
    rows: int
    inks: tuple[Ink, ...]
    labels: tuple[StrokeKind, ...]
    unknown: Mapping[str, int] = field(default_factory=dict[str, int])
    unlabelled: int = 0
    notices: tuple[str, ...] = ()
    writers: tuple[str, ...] = ()

    @property
    def clusters(self) -> tuple[str, ...]:
        """Whose rows are alike: the writers, or every row for itself."""
        return self.writers or tuple(str(k) for k in range(len(self.labels)))

    @property
    def hash(self) -> str:
        """Of what is scored, sixteen hexadecimal digits."""
        told = (f"{label} {ink_digest(ink)}" for label, ink in zip(self.labels, self.inks, strict=True))
        return sha256("\n".join(told).encode()).hexdigest()[:16]

    @property
    def single(self) -> tuple[bool, ...]:
        """For each ink whether it is one stroke."""
        return tuple(len(ink) == 1 for ink in self.inks)


@dataclass(frozen=True, slots=True)
class PageSuite:
    """Whole diagrams with their truth."""

    name: str
    pages: tuple[Page, ...]

    @property
    def hash(self) -> str:
        """Of the pages' ink and formulas, sixteen hexadecimal digits."""
        told = (
            f"{page.name} {page.answer} {ink_digest(page.truth.ink)} {[line.text for line in page.truth.expressions]}"
            for page in self.pages
        )
        return sha256("\n".join(told).encode()).hexdigest()[:16]


def generated_strokes(count: int, seed: int) -> StrokeSuite:
    """`count` strokes of all kinds from the generator, each a page of its own."""
    items = stroke_generator.generate(count, seed)
    return StrokeSuite(
        name=f"{count} generated strokes, seed {seed}",
        rows=len(items),
        inks=tuple(Ink((item.stroke,)) for item in items),
        labels=tuple(item.kind for item in items),
    )


def generated_pages(count: int, seed: int) -> PageSuite:
    """`count` pages from the generator, the six problems in turn."""
    return PageSuite(f"{count} generated pages, seed {seed}", tuple(page_generator.pages(count, seed)))


def strokes_from_files(paths: Sequence[Path], without: Lesson | None = None) -> StrokeSuite:
    """All rows of some files of labelled ink as one suite, but for those by the writers of a lesson. Raises FileError when
    one is unreadable, or when no row of any bears a label, or none is left."""
    loaded = [formats.read(path) for path in paths]
    every = [row for file in loaded for row in file.rows]
    rows = [row for row in every if without is None or not without.taught_by(row)]
    if not rows:
        names = ", ".join(map(str, paths))
        raise FileError(
            names, "all rows are by writers that the rivals learn from; ask for fewer --templates"
        )
    if all(row.label is None for row in rows):
        names = ", ".join(map(str, paths))
        raise FileError(names, "no row bears a label; a contest needs rows with a label and strokes")
    known = [row for row in rows if row.label in STROKE_KINDS and len(row.ink)]
    return StrokeSuite(
        name=" + ".join(path.name for path in paths),
        rows=len(rows),
        inks=tuple(row.ink for row in known),
        labels=tuple(cast(StrokeKind, row.label) for row in known),
        writers=tuple(writer_of(row) for row in known),
        unknown=_count(str(row.label) for row in rows if row.label not in (None, *STROKE_KINDS)),
        unlabelled=sum(row.label is None for row in rows),
        notices=_left_out(len(every) - len(rows))
        + tuple(
            f"{path.name}, {notice}"
            for path, file in zip(paths, loaded, strict=True)
            for notice in file.notices
        ),
    )


def claim_of_row(claims: Sequence[Claim]) -> Claim:
    """What a row of several strokes is taken for: the kind with the highest score summed over its
    strokes, since the row bears one label for all of them; rejected when all of them are."""
    return Claim(np.mean([claim.scores for claim in claims], axis=0), all(claim.rejected for claim in claims))


def _left_out(rows: int) -> tuple[str, ...]:
    return (f"{rows} rows are left out: rivals learnt from their writers.",) if rows else ()


def _count(labels: Iterable[str]) -> dict[str, int]:
    """How often each occurs, the most frequent first."""
    return dict[str, int](Counter(labels).most_common())
