"""Strokes of no kind: kinds drawn exactly are familiar, what is none is not, wherever and however large it is drawn."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen import ideals
from data_gen.strokes import doodles, generate
from recognizer.geometric.recognizer import Geometric
from rejection import kinds_of, measure, odd_of
from sketch.geometry import resample
from sketch.ink import FloatArray, Ink, Stroke

AROUND = np.linspace(0, 2 * pi, 200)
KINDS: dict[str, FloatArray] = {
    "circle": ideals.circle((0, 0), 50, 0.3, 2 * pi),
    "square": ideals.polygon([[0, 0], [100, 0], [100, 100], [0, 100]]),
    "wire": ideals.line((0, 0), (100, 30)),
    "zig-zag": ideals.zigzag((0, 0), (200, 0), 8, 40, 0.1),
    "coil": np.column_stack([60 * AROUND / pi + 25 * np.cos(6 * AROUND), 25 * np.sin(6 * AROUND)]),
    "v": np.array([[0.0, 0.0], [20.0, 50.0], [40.0, 0.0]]),
}
STRANGERS: dict[str, FloatArray] = {
    "heart": np.column_stack(
        [
            -16 * np.sin(AROUND) ** 3,
            -13 * np.cos(AROUND) + 5 * np.cos(2 * AROUND) + 2 * np.cos(3 * AROUND) + np.cos(4 * AROUND),
        ]
    ),
    "star's outline": np.array(
        [
            [(1.0 if k % 2 else 0.4) * np.cos(k * pi / 6), (1.0 if k % 2 else 0.4) * np.sin(k * pi / 6)]
            for k in range(13)
        ]
    ),
    "spiral": (AROUND * np.array([np.cos(3.5 * AROUND), np.sin(3.5 * AROUND)])).T,
    "knot": np.column_stack([np.sin(3 * AROUND + 0.7), np.sin(4 * AROUND)]),
    "cloud": ((0.6 + 0.3 * np.abs(np.sin(4 * AROUND))) * np.array([np.cos(AROUND), np.sin(AROUND)])).T,
}


def strangeness(path: FloatArray) -> float:
    return float(Geometric().strangeness([Ink((Stroke(resample(path, 200)),))])[0])


@pytest.mark.parametrize("known", KINDS)
@pytest.mark.parametrize("odd", STRANGERS)
def test_what_is_of_a_kind_is_less_strange_than_what_is_of_none(known: str, odd: str) -> None:
    assert strangeness(KINDS[known]) + 0.5 < strangeness(STRANGERS[odd])


@given(st.integers(0, 10**6), st.booleans(), st.floats(0.05, 20), st.floats(-1e3, 1e3))
@settings(max_examples=40, deadline=None)
def test_neither_place_nor_size_makes_a_stroke_strange(
    seed: int, odd: bool, scale: float, away: float
) -> None:
    drawn = doodles(1, seed)[0].strokes[0] if odd else generate(1, seed)[0].stroke
    there, here = Ink((Stroke(scale * drawn.points + away),)), Ink((drawn,))
    found = Geometric().strangeness([there, here])
    assert found[0] == pytest.approx(found[1], abs=1e-3)


@pytest.mark.parametrize("name", STRANGERS)
def test_a_stranger_among_letters_of_its_size_is_not_rejected_but_is_where_it_stands_alone(name: str) -> None:
    odd = STRANGERS[name] - STRANGERS[name].min(axis=0)
    odd *= 30 / odd.max()
    letters = [Stroke(resample(0.7 * KINDS["v"] + (x, 0.0), 40)) for x in (-70.0, -35.0, 35.0, 70.0)]
    lone, *_ = Geometric().recognize(Ink((Stroke(resample(4 * odd, 200)),)))
    among, *_ = Geometric().recognize(Ink((Stroke(resample(odd, 200)), *letters)))
    assert not among.rejected
    if strangeness(odd) > 9.0:
        assert lone.rejected


def test_a_drawing_is_as_strange_as_its_strangest_stroke_and_none_is_not_strange() -> None:
    both = Ink((Stroke(KINDS["circle"]), Stroke(resample(STRANGERS["knot"], 200))))
    found = Geometric().strangeness([both, Ink((both[1],)), Ink((Stroke([[3.0, 4.0]]),))])
    assert found[0] == found[1] > 0
    assert found[2] == 0


def test_hardly_a_stroke_of_a_kind_is_rejected_alone() -> None:
    items = [item for item in generate(700, 8101) if item.kind != "tap"]
    rejected = [Geometric().recognize(Ink((item.stroke,)))[0].rejected for item in items]
    assert np.mean(rejected) <= 0.10


def test_strokes_of_no_kind_are_told_as_often_as_was_measured() -> None:
    """2,000 strokes of another seed: see benchmarks/results/rejection.txt."""
    odd = odd_of(600, 8200)
    kept = measure(Geometric().strangeness, kinds_of(600, 8200), {"doodles": odd["doodles"]})
    assert kept["doodles"]["all"] <= 0.36
