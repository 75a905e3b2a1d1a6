"""Laws of the contest over pages; the two worked examples from ink to what happens."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from data_gen.pages import page
from data_gen.problems import ANSWERS, PROBLEMS
from evaluation.metrics.matching import match_components
from evaluation.page_contest import ORACLE, page_contest, read_page, score_page, true_reading
from evaluation.page_scores import by_problem, summarize
from evaluation.suites import PageSuite, generated_pages

SEED = 31
WORKED = [
    (problem, answer) for problem in ("incline-and-ball", "box-on-two-wires") for answer in ANSWERS[problem]
]


@pytest.mark.parametrize("problem", PROBLEMS)
def test_the_truth_read_as_itself_is_exact_and_moves_as_expected(problem):
    drawn = page(problem, SEED, 0)
    truth = true_reading(drawn)
    score = score_page(drawn, truth, truth)
    assert score.match.exact
    assert score.same_outcome
    assert score.motion.error == 0
    assert all(true == claimed for true, claimed in score.strokes)
    for label, fates in drawn.expected.fates.items():
        assert truth.outcome.fates[label] in fates


@pytest.mark.parametrize("name", ["geometric", "learned"])
@pytest.mark.parametrize(("problem", "answer"), WORKED)
def test_worked_examples_behave_as_described_from_ink(name, problem, answer):
    """Right answers as in E6 and E7, wrong ones fail as described there, whoever reads the page."""
    drawn = page(problem, SEED, 0, answer)
    reading = read_page(drawn, name)
    theirs = match_components(drawn.truth, reading.claim)
    for label, fates in drawn.expected.fates.items():
        assert reading.outcome.fates[theirs[label]] in fates
    broken = {theirs[label] for label in drawn.expected.breaks} & reading.outcome.broken
    assert bool(broken) == bool(drawn.expected.breaks)


@pytest.mark.parametrize("name", ["geometric", "learned"])
def test_on_the_right_incline_speed_against_time_is_a_straight_line_of_slope_g_sin_theta(name):
    drawn = page("incline-and-ball", SEED, 0)
    reading = read_page(drawn, name)
    trajectory = reading.shown.trajectory
    (label,) = reading.outcome.fates
    slope, _ = np.polyfit(trajectory.times, trajectory.speed(label), 1)
    line = slope * trajectory.times
    assert np.abs(trajectory.speed(label) - line).max() < 0.01 * trajectory.speed(label).max()
    texts = [written.text for written in drawn.truth.expressions]
    g = 10.0 if "g = 10" in texts else 9.81
    assert slope == pytest.approx(g * np.sin(_angle(drawn.truth)), rel=0.01)


def _angle(truth) -> float:
    """Of the incline: between the long side and the level one."""
    (incline,) = (part for part in truth.components if part.fixed)
    low, high = incline.shape.vertices.min(axis=0), incline.shape.vertices.max(axis=0)
    return float(np.arctan2(high[1] - low[1], high[0] - low[0]))


def test_the_contest_is_the_same_in_one_process_and_in_two():
    suite = generated_pages(3, SEED)
    assert page_contest(suite, ("geometric",), 1) == page_contest(suite, ("geometric",), 2)


def test_pages_count_alike_and_problems_add_up():
    suite = generated_pages(7, SEED)
    (result, _) = page_contest(suite, ("geometric",))
    whole, split = summarize(result.pages), by_problem(result.pages)
    assert whole.n == sum(part.n for part in split.values()) == 7
    assert whole.motion == pytest.approx(sum(part.n * part.motion for part in split.values()) / 7)


def test_no_pages_give_no_figures():
    (result, oracle) = page_contest(PageSuite("none", ()), ("geometric",))
    assert oracle.name == ORACLE
    empty = summarize(result.pages)
    assert empty.n == 0
    assert empty.exact is None
    assert empty.motion is None


def test_a_page_whose_ball_was_not_found_scores_the_worst_motion():
    drawn = page("pendulum", SEED, 0)
    truth = true_reading(drawn)
    claim = truth.motion.rectified
    fixed = replace(claim, components=tuple(part for part in claim.components if part.fixed), associations=())
    blind = replace(truth, motion=replace(truth.motion, rectified=fixed), claim=fixed)
    score = score_page(drawn, truth, blind)
    assert score.motion.error == 1.0
    assert not score.match.exact
