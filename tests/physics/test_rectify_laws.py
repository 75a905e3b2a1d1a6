"""Laws that rectification as a whole obeys, on pages with everything on them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from physics_workshop import angles_off, difference, redrawn, shaken, workshop

from data_gen.pages import page as generated
from data_gen.problems import ANSWERS, PROBLEMS
from physics.build import build
from physics.rectify import Rectified, rectify, redo, undo
from physics.rectify.separation import apart
from sketch.page import Sketch
from sketch.shapes import Circle, Polygon

EACH = settings(deadline=None, phases=(Phase.explicit, Phase.reuse, Phase.generate))
"""No seed is simpler than another, so that none is sought."""
SEEDS = st.integers(0, 100_000)
NOISE = st.floats(0.05, 2.5)
CONTACTS = (("F", "S0"), ("F", "C0"), ("F", "C1"), ("F", "C2"), ("I", "R"), ("R", "Q"))


def farthest(one: Sketch, other: Sketch) -> float:
    return max(difference(part.shape, other.component(part.label).shape) for part in one.components)


def gap(sketch: Sketch, one: str, other: str) -> float:
    first, second = sketch.component(one).shape, sketch.component(other).shape
    assert isinstance(first, Circle | Polygon)
    assert isinstance(second, Circle | Polygon)
    return abs(apart(first, second)[0])


@pytest.mark.parametrize(("name", "answer"), [(name, one) for name in PROBLEMS for one in ANSWERS[name]])
@pytest.mark.parametrize("index", range(4))
def test_a_page_as_it_was_meant_is_not_changed_to_the_bit(name: str, answer: str, index: int) -> None:
    truth = generated(name, 23, index, answer).truth
    corrected = rectify(truth)
    assert corrected.corrections == ()
    assert corrected.sketch == truth
    assert corrected.displacement == corrected.farthest == 0


@settings(EACH, max_examples=40)
@given(SEEDS)
def test_an_exact_page_is_not_changed_to_the_bit_however_it_was_drawn(seed: int) -> None:
    exact = workshop(seed)
    for drawn in (exact, redrawn(exact, seed)):
        assert rectify(drawn).sketch == drawn


@settings(EACH, max_examples=40)
@given(SEEDS, NOISE)
def test_correcting_twice_is_correcting_once(seed: int, noise: float) -> None:
    once = rectify(shaken(workshop(seed), noise, seed)).sketch
    assert farthest(once, rectify(once).sketch) < 1e-9


@settings(EACH, max_examples=40)
@given(SEEDS, NOISE)
def test_the_order_of_drawing_and_the_start_and_sense_of_outlines_change_nothing(
    seed: int, noise: float
) -> None:
    rough = shaken(workshop(seed), noise, seed)
    one, other = rectify(rough), rectify(redrawn(rough, seed))
    assert farthest(one.sketch, other.sketch) < 1e-9
    assert {correction.key for correction in one.corrections} == {
        correction.key for correction in other.corrections
    }
    assert one.displacement == pytest.approx(other.displacement, abs=1e-6)


@settings(EACH, max_examples=40)
@given(SEEDS, NOISE)
def test_every_associated_angle_holds_afterwards_and_so_does_every_contact(seed: int, noise: float) -> None:
    rough = shaken(workshop(seed), noise, seed)
    after = rectify(rough).sketch
    was = angles_off(rough)
    for label, off in angles_off(after).items():
        assert off < 1e-9
        assert off <= was[label] + 1e-12
    for one, other in CONTACTS:
        assert gap(after, one, other) < 1e-9


@settings(EACH, max_examples=25)
@given(SEEDS)
def test_displacement_is_of_the_size_of_the_hands_unsteadiness_and_not_of_the_page(seed: int) -> None:
    rough = shaken(workshop(seed), 1.0, seed)
    corrected = rectify(rough)
    points = sum(_points(part.shape) for part in rough.components)
    # The mean way of a point shaken by 1 unit each way is 1.25; the incline turns what rests on it, too.
    assert corrected.displacement / points < 2.5
    assert corrected.farthest <= corrected.displacement


def _points(shape: object) -> int:
    return 1 if isinstance(shape, Circle) else len(shape.vertices) if isinstance(shape, Polygon) else 2


def keys(corrected: Rectified) -> list[tuple[str, str]]:
    return list(dict.fromkeys(correction.key for correction in corrected.corrections))


@settings(EACH, max_examples=12)
@given(SEEDS, st.floats(0.5, 2.0))
def test_each_correction_can_be_undone_and_made_again_and_the_others_still_hold(
    seed: int, noise: float
) -> None:
    corrected = rectify(shaken(workshop(seed), noise, seed))
    for index, correction in enumerate(corrected.corrections):
        other = undo(corrected, index)
        assert correction.key not in keys(other)
        assert other.without == {correction.key}
        for label, off in angles_off(other.sketch).items():
            assert off < 1e-9 or correction.key in (("C3", label), ("C5", label))
        for one, two in CONTACTS:
            near = gap(other.sketch, one, two) < 1e-9
            assert near or correction.key in (("C2", one), ("C2", two))
        assert redo(other, correction.key) == corrected


@settings(EACH, max_examples=15)
@given(SEEDS)
def test_all_corrections_undone_leave_the_page_as_it_was_drawn(seed: int) -> None:
    rough = shaken(workshop(seed), 1.5, seed)
    corrected = rectify(rough)
    for _ in range(6):  # what was right only after a correction may need one of its own without it
        if not corrected.corrections:
            break
        corrected = rectify(rough, corrected.without | set(keys(corrected)))
    assert corrected.sketch == rough


def test_undoing_what_is_not_there_is_refused() -> None:
    corrected = rectify(shaken(workshop(1), 1.0, 1))
    with pytest.raises(IndexError, match="the page has"):
        undo(corrected, len(corrected.corrections))
    with pytest.raises(IndexError, match="counted from 0"):
        undo(corrected, -1)
    with pytest.raises(KeyError, match="was not undone"):
        redo(corrected, ("C1", "F"))
    with pytest.raises(ValueError, match="rules are C1"):
        rectify(corrected.drawn, {("C9", "F")})


@settings(EACH, max_examples=20)
@given(SEEDS)
def test_a_scenes_blocks_run_anti_clockwise_and_are_the_same_however_they_were_drawn(seed: int) -> None:
    exact = workshop(seed)
    bodies = {body.label: body for body in build(exact).scene.bodies}
    again = {body.label: body for body in build(redrawn(exact, seed)).scene.bodies}
    assert bodies.keys() == again.keys()
    for label, body in bodies.items():
        other = again[label]
        assert (other.shape, other.position) == (body.shape, body.position)
        assert other.mass == pytest.approx(body.mass, rel=1e-12)


@pytest.mark.parametrize("index", range(6))
def test_corrections_tell_the_whole_way_of_every_component(index: int) -> None:
    rough = shaken(workshop(index), 1.5, index)
    corrected = rectify(rough)
    shapes = {part.label: part.shape for part in rough.components}
    for correction in corrected.corrections:
        assert shapes[correction.component] == correction.before
        assert correction.after != correction.before
        assert correction.why.startswith(f"{correction.component}: ")
        assert correction.cause in shapes
        shapes[correction.component] = correction.after
    assert shapes == {part.label: part.shape for part in corrected.sketch.components}


def test_a_page_moved_as_a_whole_is_corrected_as_a_whole() -> None:
    rough = shaken(workshop(3), 1.5, 3)
    step = np.array([512.0, -256.0])

    def moved(sketch: Sketch) -> Sketch:
        parts = []
        for part in sketch.components:
            shape = part.shape
            if isinstance(shape, Circle):
                there = replace(shape, centre=tuple((np.array(shape.centre) + step).tolist()))
            elif isinstance(shape, Polygon):
                there = Polygon(shape.vertices + step)
            else:
                start, end = (tuple((np.array(p) + step).tolist()) for p in (shape.start, shape.end))
                there = replace(shape, start=start, end=end)
            parts.append(replace(part, shape=there))
        about = tuple(
            replace(one, anchor=tuple((np.array(one.anchor) + step).tolist())) for one in sketch.associations
        )
        return replace(sketch, components=tuple(parts), associations=about)

    assert farthest(rectify(moved(rough)).sketch, moved(rectify(rough).sketch)) < 1e-9
