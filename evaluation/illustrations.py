"""Pictures and words of a page in every recognizer's hands, for the report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from data_gen.pages import Page, page
from data_gen.problems import ANSWERS, PROBLEMS
from evaluation.graph import line_graph
from evaluation.page_contest import Reading, read_page, score_page, true_reading
from evaluation.parallel import Progress, Workers, in_parallel, silent
from evaluation.pictures import strip
from evaluation.words import happened
from sketch import svg
from sketch.page import Sketch

ABOUT: dict[str, tuple[str, str]] = {
    "incline-and-ball": (
        "A ball on an incline",
        (
            "The student gives the normal force f₁ on the ball. The right one, |W| cos θ, lets it roll down, and its "
            "speed against time is a straight line; one too small lets it sink in and bounce; one too great lifts "
            "it off."
        ),
    ),
    "box-on-two-wires": (
        "A box on two wires",
        (
            "A box of 1 kg hangs on two wires at 45°, g = 10. With 5√2 N on each it stays where it is; with another "
            "tension it moves, and a wire breaks."
        ),
    ),
    "mass-on-spring": ("A mass on a spring", "It swings about the place where the spring bears its weight."),
    "pendulum": ("A pendulum", "A ball on a wire swings to and fro."),
    "two-balls": ("Two balls", "They run into each other and part by the laws of momentum and restitution."),
    "stack-of-boxes": ("A stack of boxes", "Nothing happens, which is hard: the stack must stand still."),
}
"""Title and explanation of each diagram."""
ANSWER_TITLES: dict[str, str] = {"right": "The right answer", "low": "Too small", "high": "Too great"}


@dataclass(frozen=True, slots=True)
class View:
    """A page in one recognizer's hands. page: SVG of what it read over the ink, of the ink alone for the truth;
    strip, graph: SVG of the motion and of speed against time; verdict: in two or three words."""

    name: str
    page: str
    strip: str
    graph: str
    verdict: str
    same: bool
    words: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Illustration:
    """One page: problem and answer, its formulas, and a view for the truth and for each recognizer."""

    problem: str
    answer: str
    formulas: tuple[str, ...]
    views: tuple[View, ...]


def illustrations(
    seed: int, names: Sequence[str], workers: Workers = 1, progress: Progress = silent
) -> list[Illustration]:
    """A page of every diagram, and of every answer where a student can be wrong: the first page of the
    seed for each, as every recognizer of these names reads it."""
    chosen = [
        (page(problem, seed, k, answer), tuple(names))
        for k, problem in enumerate(PROBLEMS)
        for answer in ANSWERS[problem]
        if answer in ANSWER_TITLES
    ]
    return list(in_parallel(illustrate, chosen, workers, "Drawing pictures", progress))


def illustrate(task: tuple[Page, tuple[str, ...]]) -> Illustration:
    """A page as each of the recognizers of these names reads it."""
    drawn, names = task
    truth = true_reading(drawn)
    readings = [read_page(drawn, name) for name in names]
    return Illustration(
        problem=drawn.name,
        answer=drawn.answer,
        formulas=tuple(line.text for line in drawn.truth.expressions if line.text),
        views=(
            _view(drawn, truth, "what was meant", True, svg.draw(Sketch(drawn.truth.ink))),
            *(_rival(drawn, truth, reading) for reading in readings),
        ),
    )


def _rival(drawn: Page, truth: Reading, reading: Reading) -> View:
    score = score_page(drawn, truth, reading)
    verdict = "moves as it should" if score.same_outcome else "moves otherwise"
    if score.same_outcome and not score.match.exact:
        verdict = "moves as it should, read otherwise"
    return _view(drawn, reading, verdict, score.same_outcome, svg.draw(reading.claim))


def _view(drawn: Page, reading: Reading, verdict: str, same: bool, picture: str) -> View:
    motion = reading.shown
    trajectory = motion.trajectory
    speeds = {label: (trajectory.times, trajectory.speed(label)) for label in reading.outcome.fates}
    return View(
        name=reading.name,
        page=picture,
        strip=strip(motion, drawn.seconds),
        graph=line_graph(speeds, "time, s", "speed, m/s") if speeds else "",
        verdict=verdict,
        same=same,
        words=tuple(happened(motion, reading.outcome)),
    )
