"""Laws of generated strokes: remade from (seed, index) alone, of the kind they claim, in the writer's hand."""

from __future__ import annotations

import hashlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen import ideals
from data_gen.families import FAMILIES
from data_gen.glyphs import alphabet
from data_gen.strokes import EQUAL, RULE, formula_strokes, generate
from sketch.geometry import closure, diagonal, self_intersections, turning
from sketch.ink import LIMITS
from sketch.page import STROKE_KINDS


def test_a_stroke_made_alone_is_the_same_to_the_bit() -> None:
    together = generate(40, seed=11)
    for index in (0, 7, 39):
        alone = generate(1, seed=11, start=index)[0]
        assert alone == together[index]


def test_a_stroke_does_not_depend_on_where_its_batch_begins() -> None:
    assert generate(10, seed=3, start=RULE.batch - 5) == generate(RULE.batch + 5, seed=3)[-10:]


def test_another_seed_is_other_ink() -> None:
    digests = {
        hashlib.sha256(b"".join(item.stroke.points.tobytes() for item in generate(5, seed))).hexdigest()
        for seed in range(6)
    }
    assert len(digests) == 6


def test_formula_strokes_are_remade_from_seed_and_index() -> None:
    assert formula_strokes(3, seed=5, start=4) == formula_strokes(8, seed=5)[4:7]


def test_every_kind_is_drawn_in_its_share() -> None:
    made = [item.kind for item in generate(1800, seed=2, mix=EQUAL)]
    for kind in STROKE_KINDS:
        # 200 expected with a standard deviation of 13: five of them either way
        assert 135 < made.count(kind) < 265, kind


@pytest.mark.parametrize("count, start", [(-1, 0), (1, -1)])
def test_negative_counts_are_refused(count: int, start: int) -> None:
    with pytest.raises(ValueError, match="zero or more"):
        generate(count, seed=1, start=start)


def test_shares_must_sum_to_one() -> None:
    with pytest.raises(ValueError, match="sum to 1"):
        generate(1, seed=1, mix={"circle": 0.4})


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**31), index=st.integers(0, 2**31))
def test_any_seed_and_index_gives_ink_that_the_border_accepts(seed: int, index: int) -> None:
    (item,) = generate(1, seed, index)
    assert item.kind in STROKE_KINDS
    assert item.stroke.times is not None and item.stroke.pressure is not None
    assert item.stroke.times[0] == 0
    assert np.abs(item.stroke.points).max() < 1e5 < LIMITS.coordinate
    assert 0 <= item.stroke.pressure.min() <= item.stroke.pressure.max() <= 1


def test_kinds_have_the_shape_that_their_names_say() -> None:
    rng = np.random.default_rng(4)
    for _ in range(60):
        assert closure(FAMILIES["circle"](rng)) < 0.2
        assert closure(FAMILIES["polygon"](rng)) < 0.35
        assert closure(FAMILIES["wire"](rng)) > 0.3
        # Even the flattest wave of five legs turns four times by 60 degrees or so.
        assert np.abs(turning(FAMILIES["spring"](rng))).sum() > np.radians(200)
        assert diagonal(FAMILIES["tap"](rng)) < 12


def test_a_coil_crosses_itself_between_neighbouring_loops() -> None:
    for loops in (3, 5, 8):
        crossings = self_intersections(ideals.coil((0, 0), (200, 30), loops, 40))
        assert loops - 1 <= len(crossings) <= 3 * loops


def test_a_zigzag_has_one_corner_between_every_two_legs() -> None:
    for legs in (5, 6, 11):
        path = ideals.zigzag((0, 0), (100, 40), legs, 30, lead=0.1)
        assert int((np.abs(turning(path)) > np.radians(20)).sum()) == legs + 1
        assert np.allclose(path[[0, -1]], [(0, 0), (100, 40)])


@given(start=st.floats(0, 3.999), overlap=st.floats(-0.2, 0.5))
def test_once_round_a_polygon_is_its_perimeter_and_the_overlap(start: float, overlap: float) -> None:
    path = ideals.polygon([(0, 0), (30, 0), (30, 20), (0, 20)], start, overlap)
    assert np.linalg.norm(np.diff(path, axis=0), axis=1).sum() == pytest.approx(100 * (1 + overlap))


def test_every_symbol_can_be_drawn_in_each_of_its_ways() -> None:
    for name in alphabet.symbols() + alphabet.marks():
        for variant in range(alphabet.variants(name)):
            for stroke in alphabet.strokes(name, variant):
                assert stroke.shape[1] == 2 and np.isfinite(stroke).all(), name
                assert np.abs(stroke).max() < 25, name


def test_an_unknown_symbol_is_named() -> None:
    with pytest.raises(KeyError, match="smiley"):
        alphabet.strokes("smiley")
