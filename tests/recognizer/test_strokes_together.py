"""Strokes that mean something together: arrows with separate heads, signs, and nothing where there is nothing."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen import ideals
from recognizer.geometric.heads import pieced_arrows
from recognizer.geometric.recognizer import Geometric
from recognizer.geometric.symbols import attached, signs
from sketch.geometry import resample
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import StrokeKind

BOX = ideals.polygon([[0, 0], [140, 0], [140, 90], [0, 90]])


def page(*paths: object) -> Ink:
    return Ink(tuple(Stroke(resample(np.array(path, dtype=float), 60)) for path in paths))


def kinds(ink: Ink) -> list[StrokeKind]:
    return [claim.kind for claim in Geometric().recognize(ink)]


def arrow(angle: float, opening: float, barb: float, order: list[int], pieces: int) -> list[FloatArray]:
    """An arrow of length 100 at an angle, its head in `pieces` strokes, drawn in an order."""
    tip = 100 * np.array([np.cos(angle), np.sin(angle)])
    head = ideals.arrow_head((0.0, 0.0), (float(tip[0]), float(tip[1])), barb, opening)
    strokes = [np.array([[0.0, 0.0], tip])]
    strokes += [head] if pieces == 1 else [head[:2], head[:0:-1]]
    return [strokes[k] for k in order if k < len(strokes)]


@given(
    st.floats(0, 6.3), st.floats(0.35, 0.9), st.floats(15, 50), st.permutations([0, 1, 2]), st.integers(1, 2)
)
@settings(max_examples=60, deadline=None)
def test_an_arrow_is_one_however_its_head_was_drawn(
    angle: float, opening: float, barb: float, order: list[int], pieces: int
) -> None:
    ink = page(*arrow(angle, opening, barb, order, pieces))
    (found,) = pieced_arrows(ink, range(len(ink)))
    assert sorted(found.strokes) == list(range(len(ink)))
    assert ink[found.shaft] == ink[order.index(0) if pieces == 2 else [k for k in order if k < 2].index(0)]
    assert set(kinds(ink)) == {"arrow"}


@given(st.floats(0.05, 20), st.floats(-1e3, 1e3), st.floats(-1e3, 1e3))
@settings(max_examples=30, deadline=None)
def test_neither_place_nor_scale_of_an_arrow_matters(scale: float, x: float, y: float) -> None:
    strokes = arrow(0.4, 0.5, 25, [0, 1, 2], 1)
    ink = page(*strokes)
    moved = page(*(scale * path + np.array([x, y]) for path in strokes))
    assert pieced_arrows(moved, range(2))[0].belief == pytest.approx(
        pieced_arrows(ink, range(2))[0].belief, abs=1e-3
    )


def test_a_shaft_may_go_on_as_the_first_barb() -> None:
    ink = page([[0, 0], [100, 0], [75, -14]], [[100, 0], [75, 14]])
    assert kinds(ink) == ["arrow", "arrow"]


def test_a_bent_shaft_is_judged_by_its_last_leg() -> None:
    ink = page([[0, 0], [100, 0], [100, 100]], [[88, 82], [100, 103], [112, 82]])
    assert kinds(ink) == ["arrow", "arrow"]


@pytest.mark.parametrize(
    "strokes",
    [
        [[[0, 0], [100, 0]], [[50, -50], [50, 50]]],
        [[[0, 0], [100, 0]], [[50, 0], [50, 90]]],
        [[[0, 0], [0, 100]], [[0, 50], [60, 50]], [[60, 0], [60, 100]]],
        [[[0, 100], [0, 0], [60, 100], [60, 0]]],
        [[[40, 0], [0, 60], [80, 60]], [[50, 30], [50, 100]]],
        [[[0, 0], [100, 100]], [[100, 0], [0, 100]], [[50, -20], [50, 120]]],
        [[[0, 100], [0, 0]], [[0, 0], [60, 100]], [[60, 100], [60, 0]]],
    ],
    ids=["plus", "T", "H", "N in one stroke", "4", "asterisk", "N"],
)
def test_signs_are_mathematics_and_no_arrows(strokes: list[list[list[float]]]) -> None:
    ink = page(*strokes)
    assert pieced_arrows(ink, range(len(ink))) == []
    assert set(kinds(ink)) == {"math"}


def test_lines_apart_are_wires() -> None:
    ink = page([[0, 0], [100, 0]], [[0, 60], [100, 62]], [[0, 120], [100, 118]])
    assert kinds(ink) == ["wire"] * 3


def test_wires_that_end_at_a_shape_make_no_sign() -> None:
    ink = page(BOX, [[70, 0], [40, -100]], [[70, 0], [100, -100]])
    assert attached(ink, [1, 2], [0]) == {1: 1, 2: 1}
    assert kinds(ink) == ["polygon", "wire", "wire"]
    assert signs(ink, [1, 2], []) == {1, 2}


def test_sides_that_close_an_outline_make_no_sign() -> None:
    sides = [[[0, 0], [100, 0]], [[100, 0], [100, 80]], [[100, 80], [0, 80]], [[0, 80], [0, 0]]]
    assert kinds(page(*sides)) == ["wire"] * 4
