"""How recognizers are examined on people's gestures, whatever these are called: who may be learnt from, and who is tested.

User-dependent (Wobbrock, Wilson and Li 2007): of each writer T templates of each label are learnt and one other drawing of each
is tested, so many trials. User-independent: writers are left out a fold at a time, T templates of each label are learnt from
the others. Zero-shot: nothing is learnt from people; recognizers that are ready, or taught by generated ink, claim what they can.

Splits are made before anybody is examined and are the same for all: every comparison is paired by sample.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil
from typing import Literal, cast

import numpy as np

from evaluation.lessons import writer_of
from evaluation.parallel import Progress, Workers, in_parallel, silent
from evaluation.rivals import resident
from evaluation.suites import claim_of_row
from recognizer.published import PUBLISHED
from recognizer.samples import Sample
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke
from sketch.page import STROKE_KINDS, StrokeKind

Kind = Literal["user-dependent", "user-independent", "zero-shot"]
BEST = 5
"""So many guesses of a recognizer are kept, the likeliest first."""


@dataclass(frozen=True, slots=True)
class Split:
    """Indices of rows to learn from and to be tested on; templates: of each label; trial: number of the draw or fold."""

    train: tuple[int, ...]
    test: tuple[int, ...]
    templates: int
    trial: int


@dataclass(frozen=True, slots=True)
class Guess:
    """A recognizer on one row: the labels it guessed, the likeliest first."""

    name: str
    templates: int
    trial: int
    row: int
    label: str
    best: tuple[str, ...]

    @property
    def right(self) -> bool:
        return self.best[:1] == (self.label,)


def usable(rows: Sequence[Row]) -> list[Row]:
    """The rows that have a label and ink."""
    return [row for row in rows if row.label is not None and len(row.ink)]


def user_dependent(
    rows: Sequence[Row], templates: Sequence[int], trials: int, rng: np.random.Generator
) -> list[Split]:
    """Of each writer, for each T and trial: T rows of each label to learn from, and one other of each to be tested on. Labels of
    which a writer has too few rows for the greatest T are left out for that writer. Raises ValueError when no writer has two
    labels left."""
    most = max(templates)
    splits: list[Split] = []
    for places in _by(rows, writer_of).values():
        by_label = {label: own for label, own in _by_label(rows, places).items() if len(own) > most}
        if len(by_label) < 2:
            continue
        for trial in range(trials):
            shuffled = {label: rng.permutation(own).tolist() for label, own in by_label.items()}
            test = tuple(own[most] for own in shuffled.values())
            for count in templates:
                train = tuple(place for own in shuffled.values() for place in own[:count])
                splits.append(Split(train, test, count, trial))
    if not splits:
        raise ValueError(f"no writer has {most + 1} rows of at least two labels; ask for fewer templates")
    return splits


def user_independent(
    rows: Sequence[Row], templates: Sequence[int], folds: int, rng: np.random.Generator
) -> list[Split]:
    """The writers in so many folds; each fold is tested once, after learning T rows of each label, drawn from all other
    writers. Raises ValueError for fewer writers than folds."""
    by_writer = _by(rows, writer_of)
    writers = list(by_writer)
    if len(writers) < folds or folds < 2:
        raise ValueError(
            f"{len(writers)} writers cannot be left out in {folds} folds; at least two folds are needed"
        )
    order = rng.permutation(len(writers)).tolist()
    size = ceil(len(writers) / folds)
    splits: list[Split] = []
    for fold, first in enumerate(range(0, len(order), size)):
        out = {writers[k] for k in order[first : first + size]}
        test = [place for writer in out for place in by_writer[writer]]
        others = [place for writer in writers if writer not in out for place in by_writer[writer]]
        shuffled = {label: rng.permutation(own).tolist() for label, own in _by_label(rows, others).items()}
        known = tuple(sorted(place for place in test if rows[place].label in shuffled))
        for count in templates:
            train = tuple(place for own in shuffled.values() for place in own[:count])
            splits.append(Split(train, known, count, fold))
    return splits


def zero_shot(rows: Sequence[Row]) -> list[Split]:
    """All rows whose label is a stroke kind, tested at once. Raises ValueError when there is none."""
    test = tuple(k for k, row in enumerate(rows) if row.label in STROKE_KINDS)
    if not test:
        raise ValueError(f"no row bears a label that is a stroke kind: {', '.join(STROKE_KINDS)}")
    return [Split((), test, 0, 0)]


def examine(
    rows: Sequence[Row],
    splits: Sequence[Split],
    names: Sequence[str],
    seed: int = 0,
    workers: Workers = 1,
    progress: Progress = silent,
    change: Callable[[Ink], Ink] | None = None,
) -> tuple[Guess, ...]:
    """What each recognizer guesses of each tested row. change: of the tested ink alone, as when only its beginning is shown.
    Raises ValueError for a recognizer that cannot learn in a protocol in which one must."""
    for name in names:
        if name not in PUBLISHED and any(split.train for split in splits):
            raise ValueError(
                f"{name} does not learn from people's ink; those that do are {', '.join(PUBLISHED)}"
            )
    tasks = [
        (
            name,
            split,
            [Sample(rows[k].ink, cast(StrokeKind, rows[k].label), rows[k].writer) for k in split.train],
            [(k, str(rows[k].label), change(rows[k].ink) if change else rows[k].ink) for k in split.test],
            seed,
        )
        for split in splits
        for name in names
    ]
    found = in_parallel(_guesses, tasks, workers, "Examining recognizers", progress)
    return tuple(guess for guesses in found for guess in guesses)


def beginning(ink: Ink, fraction: float) -> Ink:
    """What is to be seen of the ink when that fraction of its length has been drawn: at least its first point."""
    if fraction >= 1:
        return ink
    lengths = [np.linalg.norm(np.diff(stroke.points, axis=0), axis=1) for stroke in ink]
    left = fraction * float(sum(each.sum() for each in lengths))
    shown: list[Stroke] = []
    for stroke, steps in zip(ink, lengths, strict=True):
        along = np.concatenate([[0.0], np.cumsum(steps)])
        count = max(1, int((along <= left * (1 + 1e-12)).sum()))
        channels = (
            None if channel is None else channel[:count] for channel in (stroke.times, stroke.pressure)
        )
        shown.append(Stroke(stroke.points[:count], *channels))
        left -= float(along[-1])
        if left <= 0:
            break
    return Ink(tuple(shown))


def _guesses(task: tuple[str, Split, list[Sample], list[tuple[int, str, Ink]], int]) -> list[Guess]:
    name, split, samples, tested, seed = task
    inks = [ink for _, _, ink in tested]
    best = _learnt(name, samples, inks, seed) if samples else _ready(name, inks)
    return [
        Guess(name, split.templates, split.trial, row, label, ranked)
        for (row, label, _), ranked in zip(tested, best, strict=True)
    ]


def _learnt(name: str, samples: Sequence[Sample], inks: Sequence[Ink], seed: int) -> list[tuple[str, ...]]:
    scorer = PUBLISHED[name].trainer()(samples, np.random.default_rng(seed))
    weights, _ = scorer.weigh(inks)
    order = np.argsort(-weights, axis=1, kind="stable")[:, :BEST]
    return [tuple(scorer.kinds[k] for k in row) for row in order.tolist()]


def _ready(name: str, inks: Sequence[Ink]) -> list[tuple[str, ...]]:
    here = resident(name)
    ranked = (np.argsort(-claim_of_row(here.recognize(ink)).scores, kind="stable")[:BEST] for ink in inks)
    return [tuple(STROKE_KINDS[k] for k in order.tolist()) for order in ranked]


def _by(rows: Sequence[Row], key: Callable[[Row], str]) -> dict[str, list[int]]:
    found: defaultdict[str, list[int]] = defaultdict(list)
    for k, row in enumerate(rows):
        found[key(row)].append(k)
    return dict(found)


def _by_label(rows: Sequence[Row], places: Sequence[int]) -> dict[str, list[int]]:
    found: defaultdict[str, list[int]] = defaultdict(list)
    for place in places:
        found[str(rows[place].label)].append(place)
    return {label: found[label] for label in sorted(found)}
