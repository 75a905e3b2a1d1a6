"""The contest over pages: each recognizer's reading goes through the same correction and the same
engine, and is compared with the truth by diagram, by geometry and by the motion that results.

The oracle takes part in every contest of pages: told what each stroke is, it shows how much of the
error is not recognition's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from data_gen.pages import Page
from evaluation.metrics.diagram import DiagramMatch, diagram_match
from evaluation.metrics.geometry import GeometryError, geometry_error
from evaluation.metrics.matching import match_components
from evaluation.metrics.motion import AT, MotionError, divergence, motion_error, same_outcome, until
from evaluation.parallel import Progress, Workers, in_parallel, silent
from evaluation.rivals import resident
from evaluation.suites import PageSuite
from physics.outcome import Outcome, outcome
from physics.pipeline import Motion, move
from physics.verify import verify
from recognizer.claims import Recognizer
from recognizer.interpret import interpret, notes_of
from recognizer.oracle import Oracle
from sketch.page import Sketch, StrokeKind

ORACLE = "oracle"
Judgement = tuple[tuple[int, str, str | None], ...]
"""Line, status and misconception of each verdict on a page."""


@dataclass(frozen=True, slots=True)
class Reading:
    """A page in one recognizer's hands: what it claims, how that moves, how it moves in the page's own
    time, what happens in that time, and how the student's answers are judged."""

    name: str
    claim: Sketch
    motion: Motion
    shown: Motion
    outcome: Outcome
    verdicts: Judgement = ()


@dataclass(frozen=True, slots=True)
class PageScore:
    """One recognizer on one page. strokes: (truth, claim) kinds after disambiguation; match: of the
    diagram as read; geometry: of the corrected shapes; same_outcome: whether the same happens until the
    page's own time is over; divergence: the motion error at `metrics.motion.TIMES`; same_verdict: whether the student's
    answers are judged alike, None where the page has none; index: the page's number under its seed."""

    problem: str
    answer: str
    strokes: tuple[tuple[StrokeKind, StrokeKind | None], ...]
    match: DiagramMatch
    geometry: GeometryError
    motion: MotionError
    same_outcome: bool
    divergence: tuple[float, ...] = ()
    same_verdict: bool | None = None
    index: int = 0


@dataclass(frozen=True, slots=True)
class PageResult:
    """One recognizer on a suite of pages, a score for each."""

    name: str
    pages: tuple[PageScore, ...]


def page_contest(
    suite: PageSuite, names: Sequence[str], workers: Workers = 1, progress: Progress = silent
) -> tuple[PageResult, ...]:
    """Runs the recognizers of these names, and the oracle, over the pages."""
    rivals = (*names, ORACLE)
    tasks = [(page, rivals) for page in suite.pages]
    scored = list(in_parallel(_score_page, tasks, workers, "Reading and moving pages", progress))
    return tuple(PageResult(name, tuple(row[k] for row in scored)) for k, name in enumerate(rivals))


def true_reading(page: Page) -> Reading:
    """What truly happens on the page."""
    return _reading("truth", page.truth, page.seconds)


def read_page(page: Page, name: str) -> Reading:
    """What happens on the page as the recognizer of that name reads it."""
    return _reading(name, claimed(page, name), page.seconds)


def claimed(page: Page, name: str) -> Sketch:
    """The page as the recognizer of that name reads it; "oracle" is told what each stroke is."""
    reader: Recognizer = Oracle(page.truth) if name == ORACLE else resident(name)
    return interpret(page.truth.ink, reader, notes_of(page.truth))


def score_page(page: Page, truth: Reading, claim: Reading) -> PageScore:
    """All metrics of one reading."""
    pairs = match_components(truth.claim, claim.claim)
    kinds = zip(page.truth.kinds(), claim.claim.kinds(), strict=True)
    return PageScore(
        problem=page.name,
        answer=page.answer,
        strokes=tuple((true, claimed) for true, claimed in kinds if true is not None),
        match=diagram_match(truth.claim, claim.claim),
        geometry=geometry_error(truth.motion.rectified, claim.motion.rectified),
        motion=motion_error(truth.motion, claim.motion),
        same_outcome=same_outcome(pairs, truth.outcome, claim.outcome),
        divergence=divergence(truth.motion, claim.motion),
        same_verdict=same_verdict(truth.verdicts, claim.verdicts),
        index=page.index,
    )


def same_verdict(truth: Judgement, claim: Judgement) -> bool | None:
    """Whether every answer that truly is one is judged the same: right, wrong or not determined, with the same misconception.
    An answer that is not seen to be one is judged otherwise. None where there is no answer."""
    return claim == truth if truth else None


def judgement(motion: Motion) -> Judgement:
    """What a student is told of each answer on the page as it was corrected, by the number of its line."""
    return tuple((v.expression, v.status, v.misconception) for v in verify(motion.rectified))


def _score_page(task: tuple[Page, Sequence[str]]) -> list[PageScore]:
    page, names = task
    truth = true_reading(page)
    return [score_page(page, truth, read_page(page, name)) for name in names]


def _reading(name: str, claim: Sketch, seconds: float) -> Reading:
    """Moves a page long enough for the motion error; judges what happens in the page's own time."""
    motion = move(claim, max(seconds, AT))
    shown = until(motion, seconds)
    return Reading(name, claim, motion, shown, outcome(shown), judgement(motion))
