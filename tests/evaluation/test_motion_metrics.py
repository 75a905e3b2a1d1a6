"""Laws of the motion error and of the same outcome, on pages that fall freely."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from evaluation.frames import frame, frames, view
from evaluation.metrics.geometry import diagram_size
from evaluation.metrics.matching import match_components
from evaluation.metrics.motion import motion_error, same_outcome, until
from physics.outcome import outcome
from physics.pipeline import move
from sketch.ink import Ink, Stroke
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon

INK = Ink(tuple(Stroke([(k, 0.0), (k + 1, 1.0)]) for k in range(4)))
GROUND = Component(Polygon([(0, 400), (300, 400), (300, 430), (0, 430)]), (0,), "A", fixed=True)
BALL = Component(Circle((80, 50), 20), (1,), "B")
BOX = Component(Polygon([(180, 40), (230, 40), (230, 90), (180, 90)]), (2,), "C")
PAGE = Sketch(INK, (GROUND, BALL, BOX))
TRUTH = move(PAGE, 2.0)


def moved(*components: Component):
    return move(Sketch(INK, components), 2.0)


def test_a_page_moves_as_itself():
    error = motion_error(TRUTH, TRUTH)
    assert (error.error, error.bodies, error.missed) == (0.0, 2, 0)


def test_a_body_claimed_elsewhere_is_off_by_that_much_while_both_fall():
    aside = replace(BALL, shape=Circle((80 - 30, 50), 20))
    error = motion_error(TRUTH, moved(GROUND, aside, BOX), at=0.5)
    assert error.error == pytest.approx(30 / diagram_size(PAGE) / 2, rel=1e-6)


def test_labels_and_order_do_not_matter():
    names = {"A": "C", "B": "A", "C": "B"}
    other = moved(*(replace(part, label=names[part.label]) for part in reversed(PAGE.components)))
    assert motion_error(TRUTH, other).error == pytest.approx(0.0, abs=1e-9)
    pairs = match_components(TRUTH.rectified, other.rectified)
    assert same_outcome(pairs, outcome(TRUTH), outcome(other))


def test_a_body_that_was_not_found_and_one_that_should_not_be_there_count_as_the_whole_diagram():
    lost = motion_error(TRUTH, moved(GROUND, BALL))
    assert (lost.bodies, lost.missed) == (2, 1)
    assert lost.error == pytest.approx(0.5, abs=1e-9)
    ghost = replace(BALL, shape=Circle((150, 300), 9), strokes=(3,), label="D")
    extra = motion_error(TRUTH, moved(*PAGE.components, ghost))
    assert (extra.bodies, extra.missed) == (3, 1)
    assert extra.error >= 1 / 3


def test_a_body_taken_for_fixed_is_off_by_its_fall_at_most_by_the_diagram():
    stuck = moved(GROUND, replace(BALL, fixed=True), BOX)
    fallen = motion_error(TRUTH, stuck, at=0.4)
    assert fallen.error == pytest.approx(0.5 * 9.81 * 0.4**2 / (diagram_size(PAGE) / 100) / 2, rel=0.02)
    assert motion_error(TRUTH, stuck, at=2.0).error <= 0.5
    assert not same_outcome({"A": "A", "B": "B", "C": "C"}, outcome(TRUTH), outcome(stuck))


def test_where_nothing_can_move_nothing_is_off():
    still = moved(GROUND)
    assert motion_error(still, still).error == 0.0
    assert motion_error(still, still).bodies == 0


def test_a_shortened_motion_is_the_beginning_of_the_whole():
    short = until(TRUTH, 0.7)
    n = len(short.trajectory.times)
    assert 0.7 - 1 / 30 < short.trajectory.times[-1] <= 0.7 + 1e-9
    assert np.array_equal(short.trajectory.poses, TRUTH.trajectory.poses[:n])
    assert all(event.time <= 0.7 for event in short.trajectory.events)
    assert until(TRUTH, 5.0) is TRUTH


def test_frames_begin_with_the_page_as_drawn_and_follow_the_bodies():
    first, *_, last = frames(TRUTH, 1.0, 4)
    before = {part.label: part.shape for part in first.components}
    after = {part.label: part.shape for part in last.components}
    assert before["A"] == after["A"] == TRUTH.rectified.component("A").shape
    assert before["B"].centre == pytest.approx(BALL.shape.centre)
    x, y = TRUTH.trajectory.path("B")[-1 if last.seconds >= 2 else 60]
    assert after["B"].centre == pytest.approx((100 * x, -100 * y))
    assert np.allclose(before["C"].vertices.mean(axis=0), (205, 65))


def test_a_body_far_off_the_page_does_not_shrink_the_picture():
    falling = move(Sketch(INK, (BALL,)), 3.0)
    _, _, wide, high = view([frame(falling, 0.0), frame(falling, 3.0)])
    assert max(wide, high) < 3 * diagram_size(Sketch(INK, (BALL,)))
