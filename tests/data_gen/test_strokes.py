"""Laws of generated strokes: remade from (seed, index) alone, of the kind they claim, in the writer's hand."""

from __future__ import annotations

import hashlib
import inspect
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen import ideals
from data_gen.glyphs import alphabet
from data_gen.hand.names import NAMES
from data_gen.strokes import BATCH, EQUAL, Recipe, doodles, formula_strokes, generate, items, meant
from sketch.geometry import closure, diagonal, self_intersections, turning
from sketch.ink import LIMITS, FloatArray, Stroke
from sketch.page import STROKE_KINDS, StrokeKind


def test_a_stroke_made_alone_is_the_same_to_the_bit() -> None:
    together = generate(40, seed=11)
    for index in (0, 7, 39):
        alone = generate(1, seed=11, start=index)[0]
        assert alone == together[index]


def test_a_stroke_does_not_depend_on_where_its_batch_begins() -> None:
    assert generate(10, seed=3, start=BATCH - 5) == generate(BATCH + 5, seed=3)[-10:]


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
    assert np.isfinite(item.stroke.points).all()
    assert np.abs(item.stroke.points).max() < 1e5 < LIMITS.coordinate
    if item.stroke.times is not None:
        assert item.stroke.times[0] == 0
    if item.stroke.pressure is not None:
        assert 0 <= item.stroke.pressure.min() <= item.stroke.pressure.max() <= 1
    assert Stroke(item.stroke.points, item.stroke.times, item.stroke.pressure) == item.stroke


IDEAL = Recipe(without=NAMES)
ONE_STROKE = Recipe(without=("several_strokes", "broken"))


def _meant(kind: StrokeKind, count: int, recipe: Recipe) -> list[tuple[FloatArray, int]]:
    """Ideal paths of one stroke with their counts."""
    drawn = [meant(kind, seed=4, index=index, recipe=recipe) for index in range(count)]
    return [(paths[0], detail) for paths, detail in drawn]


def test_kinds_have_the_shape_that_their_names_say() -> None:
    assert max(closure(path) for path, _ in _meant("circle", 60, ONE_STROKE)) < 0.2
    assert max(closure(path) for path, _ in _meant("polygon", 60, ONE_STROKE)) < 0.35
    assert min(closure(path) for path, _ in _meant("wire", 60, ONE_STROKE)) > 0.3
    # Even the flattest wave of five legs turns four times by 60 degrees or so.
    assert min(np.abs(turning(path)).sum() for path, _ in _meant("spring", 60, ONE_STROKE)) > np.radians(200)
    assert max(diagonal(path) for path, _ in _meant("tap", 60, ONE_STROKE)) < 12


def test_a_polygon_has_as_many_corners_as_its_truth_says_and_is_convex() -> None:
    for path, corners in _meant("polygon", 200, IDEAL):
        assert np.allclose(path[0], path[-1])
        turns = turning(np.concatenate([path, path[1:2]]))
        assert int((np.abs(turns) > 1e-6).sum()) == corners
        assert 3 <= corners <= 8
        assert np.abs(turns.sum()) == pytest.approx(2 * np.pi)
        assert len(set(np.sign(turns[np.abs(turns) > 1e-6]))) == 1


def test_a_spring_has_as_many_legs_or_loops_as_its_truth_says() -> None:
    for path, count in _meant("spring", 200, IDEAL):
        if count > 0:
            assert count >= 5
            rises = np.sign(np.diff(path[:, 1]))
            rises = rises[rises != 0]
            assert 1 + int((np.diff(rises) != 0).sum()) == count
        else:
            # A loop is a run backwards along the axis.
            backward = np.diff(path[:, 0]) < 0
            assert int((np.diff(backward.astype(int)) == 1).sum() + backward[0]) in (-count, -count + 1)


def test_a_ring_without_variations_is_a_circle_begun_at_its_top() -> None:
    for path, _ in _meant("circle", 20, IDEAL):
        assert np.allclose(np.linalg.norm(path, axis=1), 0.5)
        assert np.allclose(path[[0, -1]], [0.0, -0.5])


def test_every_variation_changes_some_drawing_and_no_label() -> None:
    everything = items(700, seed=9)
    for name in NAMES:
        without = items(700, seed=9, recipe=Recipe(without=(name,)))
        assert [(a.kind, a.index) for a in everything] == [(b.kind, b.index) for b in without]
        assert any(a.strokes != b.strokes for a, b in zip(everything, without, strict=True)), name


def test_a_variation_left_out_changes_only_the_drawings_that_had_it() -> None:
    everything = items(700, seed=9)
    for name, most in (("retracing", 0.15), ("broken", 0.15), ("tail", 0.15), ("backtrack", 0.05)):
        without = items(700, seed=9, recipe=Recipe(without=(name,)))
        changed = np.mean([a.strokes != b.strokes for a, b in zip(everything, without, strict=True)])
        assert 0 < changed < most, name


def test_items_come_in_one_stroke_and_in_several_as_people_draw_them() -> None:
    for kind, low, high in (
        ("polygon", 0.1, 0.5),
        ("arrow", 0.3, 0.6),
        ("math", 0.2, 0.5),
        ("circle", 0.01, 0.2),
    ):
        several = [len(item.strokes) > 1 for item in items(600, seed=3, mix={kind: 1.0})]
        assert low < np.mean(several) < high, kind
    assert all(
        item.count == len(item.strokes)
        for item in items(200, seed=3, mix={"arrow": 1.0}, recipe=Recipe(("broken",)))
    )


def test_an_item_is_the_same_alone_in_a_batch_and_in_another_process() -> None:
    together = items(BATCH + 9, seed=21)
    for index in (0, 77, BATCH + 8):
        assert items(1, seed=21, start=index)[0] == together[index]
    code = (
        "import hashlib\nfrom data_gen.strokes import items\n"
        + inspect.getsource(_digest)
        + "print(_digest(items(40, 21)))"
    )
    elsewhere = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert elsewhere.stdout.strip() == _digest(together[:40])


def _digest(made):
    return hashlib.sha256(b"".join(s.points.tobytes() for item in made for s in item.strokes)).hexdigest()


def test_sampling_rates_are_those_of_tablets_and_web_pages() -> None:
    rates = [
        1 / float(np.median(np.diff(item.stroke.times)))
        for item in generate(600, seed=6, mix={"polygon": 1.0}, recipe=Recipe(("sparse",)))
        if item.stroke.times is not None and len(item.stroke) < 300
    ]
    assert 18 < min(rates) < 30 and 200 < max(rates) < 275


def test_some_devices_give_no_times_and_some_no_pressure() -> None:
    made = generate(600, seed=6)
    assert 0.08 < np.mean([item.stroke.times is None for item in made]) < 0.26
    assert 0.2 < np.mean([item.stroke.pressure is None for item in made]) < 0.47


def test_doodles_are_none_of_the_kinds_and_of_many_forms() -> None:
    made = doodles(400, seed=2)
    assert {item.kind for item in made} == {None}
    assert len({item.form for item in made}) > 12
    assert doodles(1, seed=2, start=399) == made[399:]


def test_recipes_that_cannot_be_are_refused() -> None:
    with pytest.raises(ValueError, match="no variation is called"):
        Recipe(without=("sparkle",))
    with pytest.raises(ValueError, match="no group of writers"):
        Recipe(profile="martian")


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
