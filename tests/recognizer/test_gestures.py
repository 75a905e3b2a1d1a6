"""Gestures against drawing: by what they enclose, cover and lie on."""

from __future__ import annotations

import numpy as np
import pytest

from data_gen import ideals
from data_gen.gestured import gestured_pages
from gestures import confusion, share
from recognizer.erase import erased, without_object
from recognizer.geometric.recognizer import Geometric
from sketch.geometry import resample
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import StrokeKind

LETTERS = [ideals.superellipse((20.0 * k, 0), (6, 9), 0.3, 4.5) for k in range(4)]
LOOP = ideals.superellipse((30, 0), (75, 40), 0.0, 6.1, egg=0.2)
RUBBED = np.column_stack([np.linspace(0, 30, 12), np.tile([-40.0, 40.0], 6)])
BALL = ideals.circle((15, 0), 40)


def page(*paths: FloatArray) -> Ink:
    return Ink(tuple(Stroke(resample(path, 120)) for path in paths))


def last(*paths: FloatArray) -> StrokeKind:
    return Geometric().recognize(page(*paths))[-1].kind


def test_a_loop_about_writing_is_a_lasso_and_alone_a_circle() -> None:
    assert last(*LETTERS, LOOP) == "lasso"
    assert last(LOOP) == "circle"
    assert last(*(letter + np.array([300.0, 0]) for letter in LETTERS), LOOP) == "circle"


def test_a_block_about_a_wheel_is_a_block() -> None:
    block = ideals.polygon([[-60, -60], [90, -60], [90, 60], [-60, 60]])
    assert last(BALL, block) == "polygon"


def test_to_and_fro_over_a_shape_is_a_scribble_and_erases_it() -> None:
    ink = page(BALL, RUBBED)
    assert last(BALL, RUBBED) == "scribble"
    assert erased(ink, ["circle", "scribble"]) == {0}


def test_a_shape_may_be_rubbed_out_from_within_together_with_its_tap() -> None:
    tap = Stroke([[15.0, 0.0], [15.4, 0.2]])
    ink = Ink((*page(BALL), tap, *page(RUBBED * np.array([1.6, 0.7]) + np.array([-9.0, 0]))))
    assert erased(ink, ["circle", "tap", "scribble"]) == {0, 1}


def test_a_scribble_over_nothing_erases_nothing() -> None:
    ink = page(BALL, RUBBED + np.array([400.0, 0]))
    assert erased(ink, ["circle", "scribble"]) == set()
    assert without_object(ink, ["circle", "scribble"]) == {1}


@pytest.mark.parametrize("teeth", [6, 9])
def test_a_spring_that_hangs_on_a_ball_is_no_scribble(teeth: int) -> None:
    spring = ideals.zigzag((15, 38), (15, 200), teeth, 40, 0.05)
    assert last(BALL, spring) == "spring"


def test_gestures_on_pages_are_found_as_often_as_was_measured() -> None:
    """300 pages of another seed: benchmarks/results/gestures.txt."""
    table = confusion("geometric", 45, 7)
    assert share(table, True) >= 0.88
    assert share(table, False) <= 0.005


def test_a_page_with_a_gesture_is_the_page_with_one_stroke_more() -> None:
    for item in gestured_pages(6, 3):
        assert item.ink.strokes[:-1] == item.page.truth.ink.strokes
        assert max(item.target) < len(item.ink) - 1
