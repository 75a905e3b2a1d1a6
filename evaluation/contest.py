"""The whole contest: strokes, on generated ink whole pages and their motion too, and handwritten mathematics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from data_gen.textbook.roster import names as every_problem
from evaluation.formula_contest import FormulaResult, formula_contest
from evaluation.formula_suites import FormulaSuite, formulas_from_files, generated_formulas
from evaluation.lessons import Lesson
from evaluation.page_contest import ORACLE, PageResult, page_contest
from evaluation.parallel import Progress, Workers, silent
from evaluation.stress import AXES
from evaluation.stress_contest import Curve, Groups, under_stress
from evaluation.stroke_contest import StrokeResult, stroke_contest
from evaluation.suites import (
    PageSuite,
    StrokeSuite,
    generated_pages,
    generated_strokes,
    strokes_from_files,
)
from evaluation.textbook_pens import Penned, read_problems
from recognizer.handwriting.roster import READERS


@dataclass(frozen=True, slots=True, eq=False)
class Contest:
    """Who took part, on what, with what result. seed: of generated ink, None for files; pages: None
    where there are labelled strokes only; more: further suites of strokes with their results; penned: textbook problems drawn
    by simulated pens; curves, groups: what was borne under stress; formulas: suites of handwritten mathematics with every reader's
    results."""

    names: tuple[str, ...]
    seed: int | None
    strokes: StrokeSuite
    stroke_results: tuple[StrokeResult, ...]
    pages: PageSuite | None
    page_results: tuple[PageResult, ...]
    more: tuple[tuple[StrokeSuite, tuple[StrokeResult, ...]], ...] = ()
    penned: tuple[Penned, ...] = ()
    curves: tuple[Curve, ...] = ()
    groups: tuple[Groups, ...] = ()
    formulas: tuple[tuple[FormulaSuite, tuple[FormulaResult, ...]], ...] = ()

    def stroke_suites(self) -> tuple[tuple[StrokeSuite, tuple[StrokeResult, ...]], ...]:
        """All suites of strokes, each with every recognizer's result."""
        return ((self.strokes, self.stroke_results), *self.more)

    def hashes(self) -> dict[str, str]:
        """Of everything that was compared on, by suite."""
        named = {suite.name: suite.hash for suite, _ in self.stroke_suites() if suite.labels}
        if self.pages is not None and self.pages.pages:
            named[self.pages.name] = self.pages.hash
        return {**named, **{suite.name: suite.hash for suite, _ in self.formulas}}


@dataclass(frozen=True, slots=True)
class Extent:
    """How much is generated: strokes, pages; pens: draws of every textbook problem; stress: strokes at each level of stress,
    stress_pages: pages at each; formulas: handwritten expressions."""

    strokes: int = 0
    pages: int = 0
    pens: int = 0
    stress: int = 0
    stress_pages: int = 0
    formulas: int = 0


@dataclass(frozen=True, slots=True)
class Reading:
    """Which readers of mathematics take part, on which files of labelled expressions; most: of the files' rows, None for all."""

    readers: tuple[str, ...] = READERS
    files: tuple[Path, ...] = ()
    most: int | None = None


def contest_on_files(
    paths: Sequence[Path],
    names: Sequence[str],
    workers: Workers = 1,
    progress: Progress = silent,
    without: Lesson | None = None,
) -> Contest:
    """The contest on labelled JSON Lines, without the rows of a lesson's writers. Raises FileError for an unreadable
    file, ValueError for a recognizer that is not known."""
    suite = strokes_from_files(paths, without)
    return Contest(tuple(names), None, suite, stroke_contest(suite, names, workers, progress), None, ())


def contest_on_generated(
    strokes: int,
    pages: int,
    seed: int,
    names: Sequence[str],
    workers: Workers = 1,
    progress: Progress = silent,
) -> Contest:
    """The contest on so many generated strokes and pages of a seed."""
    progress("Drawing the suites", 0, 2)
    suite = generated_strokes(strokes, seed)
    progress("Drawing the suites", 1, 2)
    whole = generated_pages(pages, seed)
    progress("Drawing the suites", 2, 2)
    return Contest(
        tuple(names),
        seed,
        suite,
        stroke_contest(suite, names, workers, progress),
        whole,
        page_contest(whole, names, workers, progress),
    )


def whole_contest(
    paths: Sequence[Path],
    extent: Extent,
    seed: int,
    names: Sequence[str],
    workers: Workers = 1,
    progress: Progress = silent,
    without: Lesson | None = None,
    reading: Reading = Reading(),
) -> Contest:
    """The contest on files, where there are any, and on whatever is generated besides, as one. Raises FileError, ValueError as
    `contest_on_files` and `formulas_from_files`."""
    if paths:
        contest = contest_on_files(paths, names, workers, progress, without)
        if extent.strokes or extent.pages:
            made = contest_on_generated(extent.strokes, extent.pages, seed, names, workers, progress)
            more = ((made.strokes, made.stroke_results),) if extent.strokes else ()
            contest = replace(contest, more=more, pages=made.pages, page_results=made.page_results)
    else:
        contest = contest_on_generated(extent.strokes, extent.pages, seed, names, workers, progress)
    if extent.pens:
        readers = (*names, ORACLE)
        penned = read_problems(list(every_problem()), extent.pens, seed, readers, workers, progress)
        contest = replace(contest, penned=penned)
    if extent.stress or extent.stress_pages:
        levels = (extent.stress, extent.stress_pages)
        curves, told = under_stress(names, tuple(AXES), levels, seed, workers, progress)
        contest = replace(contest, curves=tuple(curves), groups=tuple(told))
    suites = [formulas_from_files(reading.files, reading.most)] if reading.files else []
    suites += [generated_formulas(extent.formulas, seed)] if extent.formulas else []
    formulas = [(suite, formula_contest(suite, reading.readers, workers, progress)) for suite in suites]
    return replace(contest, formulas=tuple(formulas), seed=None if extent == Extent() else seed)
