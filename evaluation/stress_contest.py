"""The contest under stress: accuracy, and what becomes of the motion, against each axis; and groups of writers.

Strokes are generated; every recognizer meets the same ones at every level. Groups (`child`, `tremor`, `low_vision`) are the
generator's, whose ranges come from the literature: they are not people.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from data_gen.pages import Page, pages
from data_gen.strokes import Recipe, generate
from data_gen.writers import PROFILES
from evaluation.metrics.motion import motion_error
from evaluation.parallel import Progress, Workers, in_parallel, silent
from evaluation.rivals import resident
from evaluation.statistics.intervals import Interval, balanced
from evaluation.stress import AXES, stressed
from evaluation.suites import claim_of_row
from physics.pipeline import Motion, move
from recognizer.interpret import interpret, notes_of
from sketch.ink import Ink
from sketch.page import StrokeKind

SECONDS = 2.0
"""How long pages are watched: until motions are compared."""
DRAWS = 1000


@dataclass(frozen=True, slots=True)
class Curve:
    """A recognizer along an axis: its measure at each level. measure: "accuracy" (balanced over the kinds, of strokes) or "motion"
    (mean motion error of pages)."""

    name: str
    axis: str
    measure: str
    levels: tuple[float, ...]
    values: tuple[Interval, ...]


@dataclass(frozen=True, slots=True)
class Groups:
    """A recognizer on groups of writers: balanced accuracy of each; worst: the group that it serves worst, None where it
    serves all alike."""

    name: str
    values: dict[str, Interval]

    @property
    def worst(self) -> str | None:
        if len({value.value for value in self.values.values()}) == 1:
            return None
        return min(self.values, key=lambda group: self.values[group].value)


@dataclass(frozen=True, slots=True)
class Trial:
    """Recognizers of these names on `count` items of a seed along some axes."""

    names: tuple[str, ...]
    axes: tuple[str, ...]
    count: int
    seed: int


def under_stress(
    names: Sequence[str],
    axes: Sequence[str],
    extent: tuple[int, int],
    seed: int,
    workers: Workers = 1,
    progress: Progress = silent,
) -> tuple[list[Curve], list[Groups]]:
    """Every recognizer along each axis, and on each group of writers. extent: so many generated strokes, and so many pages, at
    each level; groups are told by strokes."""
    strokes, pages = (Trial(tuple(names), tuple(axes), count, seed) for count in extent)
    curves = stroke_curves(strokes, workers, progress) if strokes.count else []
    curves += motion_curves(pages, workers, progress) if pages.count else []
    return curves, groups(names, strokes.count, seed, workers, progress) if strokes.count else []


def stroke_curves(of: Trial, workers: Workers = 1, progress: Progress = silent) -> list[Curve]:
    """The accuracy of every recognizer on generated strokes along each axis. A stroke whose order alone changes is still
    one stroke: axes that need several are told by pages."""
    names, axes, count, seed = of.names, of.axes, of.count, of.seed
    made = generate(count, seed)
    inks, labels = [Ink((item.stroke,)) for item in made], [item.kind for item in made]
    settings = [(axis, level) for axis in axes for level in AXES[axis].levels]
    tasks = [
        (name, tuple(stressed(ink, axis, level, seed, k) for k, ink in enumerate(inks)))
        for axis, level in settings
        for name in names
    ]
    claimed = list(in_parallel(_kinds, tasks, workers, "Stressing strokes", progress))
    right = [[kind == label for kind, label in zip(kinds, labels, strict=True)] for kinds in claimed]
    found: dict[tuple[str, str], list[Interval]] = {}
    for place, (axis, _) in enumerate(settings):
        columns = right[place * len(names) : (place + 1) * len(names)]
        at = balanced(columns, labels, range(count), np.random.default_rng(seed), draws=DRAWS)
        for name, value in zip(names, at, strict=True):
            found.setdefault((name, axis), []).append(value)
    return [
        Curve(name, axis, "accuracy", AXES[axis].levels, tuple(found[name, axis]))
        for axis in axes
        for name in names
    ]


def motion_curves(of: Trial, workers: Workers = 1, progress: Progress = silent) -> list[Curve]:
    """The mean motion error of every recognizer on generated pages along each axis that leaves the motion what it was."""
    names, axes, count, seed = of.names, of.axes, of.count, of.seed
    chosen = [axis for axis in axes if AXES[axis].moves]
    settings = tuple((axis, level) for axis in chosen for level in AXES[axis].levels)
    tasks = [(page, k, tuple(names), settings, seed) for k, page in enumerate(pages(count, seed))]
    errors = np.array(
        list(in_parallel(_errors, tasks, workers, "Stressing pages", progress))
    )  # (pages, settings, names)
    curves: list[Curve] = []
    for axis in chosen:
        places = [k for k, (own, _) in enumerate(settings) if own == axis]
        at = [
            balanced(
                list(errors[:, k].T), [0] * count, range(count), np.random.default_rng(seed), draws=DRAWS
            )
            for k in places
        ]
        curves += [
            Curve(name, axis, "motion", AXES[axis].levels, tuple(level[n] for level in at))
            for n, name in enumerate(names)
        ]
    return curves


def groups(
    names: Sequence[str], count: int, seed: int, workers: Workers = 1, progress: Progress = silent
) -> list[Groups]:
    """Every recognizer on `count` strokes by each group of writers."""
    found: dict[str, dict[str, Interval]] = {name: {} for name in names}
    made = {group: generate(count, seed, recipe=Recipe(profile=group)) for group in PROFILES}
    tasks = [(name, tuple(Ink((item.stroke,)) for item in made[group])) for group in made for name in names]
    claimed = iter(in_parallel(_kinds, tasks, workers, "Drawing as others draw", progress))
    for group, items in made.items():
        labels = [item.kind for item in items]
        columns = [[k == label for k, label in zip(next(claimed), labels, strict=True)] for _ in names]
        at = balanced(columns, labels, range(count), np.random.default_rng(seed), draws=DRAWS)
        for name, value in zip(names, at, strict=True):
            found[name][group] = value
    return [Groups(name, values) for name, values in found.items()]


def plain(curves: Sequence[Curve], by_group: Sequence[Groups]) -> dict[str, Any]:
    """As JSON has it; the level without limit is null."""
    return {
        "curves": [
            {
                "name": curve.name,
                "axis": curve.axis,
                "unit": AXES[curve.axis].unit,
                "measure": curve.measure,
                "levels": [None if level == float("inf") else level for level in curve.levels],
                "values": [asdict(value) for value in curve.values],
            }
            for curve in curves
        ],
        "groups": {
            one.name: {group: asdict(value) for group, value in one.values.items()} for one in by_group
        },
        "worst_group": {one.name: one.worst for one in by_group},
    }


def _kinds(task: tuple[str, tuple[Ink, ...]]) -> list[StrokeKind]:
    name, inks = task
    here = resident(name)
    return [claim_of_row(here.recognize(ink)).kind for ink in inks]


def _errors(
    task: tuple[Page, int, tuple[str, ...], tuple[tuple[str, float], ...], int],
) -> list[list[float]]:
    """Motion errors of a page, (settings, names)."""
    page, index, names, settings, seed = task
    truth = move(page.truth, SECONDS)
    return [
        [_error(page, truth, stressed(page.truth.ink, axis, level, seed, index), name) for name in names]
        for axis, level in settings
    ]


def _error(page: Page, truth: Motion, ink: Ink, name: str) -> float:
    return motion_error(truth, move(interpret(ink, resident(name), notes_of(page.truth)), SECONDS)).error
