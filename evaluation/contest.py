"""The whole contest: strokes, and on generated ink whole pages and their motion too."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from evaluation.lessons import Lesson
from evaluation.page_contest import PageResult, page_contest
from evaluation.parallel import Progress, silent
from evaluation.stroke_contest import StrokeResult, stroke_contest
from evaluation.suites import (
    PageSuite,
    StrokeSuite,
    generated_pages,
    generated_strokes,
    strokes_from_files,
)


@dataclass(frozen=True, slots=True, eq=False)
class Contest:
    """Who took part, on what, with what result. seed: of generated ink, None for files; pages: None
    where there are labelled strokes only."""

    names: tuple[str, ...]
    seed: int | None
    strokes: StrokeSuite
    stroke_results: tuple[StrokeResult, ...]
    pages: PageSuite | None
    page_results: tuple[PageResult, ...]


def contest_on_files(
    paths: Sequence[Path],
    names: Sequence[str],
    jobs: int = 1,
    progress: Progress = silent,
    without: Lesson | None = None,
) -> Contest:
    """The contest on labelled JSON Lines, without the rows of a lesson's writers. Raises FileError for an unreadable
    file, ValueError for a recognizer that is not known."""
    suite = strokes_from_files(paths, without)
    return Contest(tuple(names), None, suite, stroke_contest(suite, names, jobs, progress), None, ())


def contest_on_generated(
    strokes: int, pages: int, seed: int, names: Sequence[str], jobs: int = 1, progress: Progress = silent
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
        stroke_contest(suite, names, jobs, progress),
        whole,
        page_contest(whole, names, jobs, progress),
    )
