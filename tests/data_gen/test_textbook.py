"""Laws of the textbook problems: what must hold of every one before any is judged."""

import numpy as np
import pytest

from data_gen.pages import meaning
from data_gen.problems import in_reading_order
from data_gen.textbook.exercise import number
from data_gen.textbook.roster import FAMILIES, exercise, names
from physics.build import build
from physics.rectify import rectify
from physics.verify.misconceptions import MISCONCEPTIONS
from sketch.geometry import bounding_box
from sketch.shapes import outline

EVERY = list(names())
DRAWS = 3


def draws(family, name):
    return [exercise(family, name, np.random.default_rng([11, k])) for k in range(DRAWS)]


def test_there_are_at_least_forty_problems_in_ten_families():
    assert len(FAMILIES) == 10
    assert len(EVERY) >= 40
    assert min(len(problems) for problems in FAMILIES.values()) >= 4


@pytest.mark.parametrize(("family", "name"), EVERY)
def test_a_draw_is_remade_by_its_generator_and_another_has_other_numbers(family, name):
    made = draws(family, name)
    assert made == draws(family, name)
    assert len({one.components for one in made}) == DRAWS


@pytest.mark.parametrize(("family", "name"), EVERY)
def test_one_right_answer_and_three_wrong_ones_from_known_misconceptions(family, name):
    for made in draws(family, name):
        right, *wrong = made.answers
        assert right.misconception is None
        assert len(wrong) >= 3
        assert all(one.misconception in MISCONCEPTIONS for one in wrong)
        assert len({one.text for one in made.answers}) == len(made.answers)


@pytest.mark.parametrize(("family", "name"), EVERY)
def test_every_line_can_be_read_and_everything_lies_on_the_page(family, name):
    for made in draws(family, name):
        for answer in made.answers:
            page = meaning(in_reading_order(made.answered(answer)))
            assert [one.problem for one in page.expressions] == [None] * len(page.expressions)
        low, high = bounding_box(np.concatenate([outline(part.shape) for part in made.components]))
        assert low.min() >= 0
        assert high[0] <= 600
        assert high[1] <= 450


@pytest.mark.parametrize(("family", "name"), EVERY)
def test_the_diagram_is_exact_so_that_correcting_it_moves_nothing(family, name):
    for made in draws(family, name):
        page = meaning(in_reading_order(made.answered(made.answers[0])))
        before, after = (
            {body.label: body for body in build(one).scene.bodies} for one in (page, rectify(page).sketch)
        )
        for label, body in before.items():
            assert body.position == pytest.approx(after[label].position, abs=1e-9)


def test_a_number_has_four_digits_and_no_exponent():
    assert [number(value) for value in (8.495709, 0.000123456, 123456.0, -2.0)] == [
        "8.496",
        "0.0001235",
        "123500",
        "-2",
    ]


def test_names_that_are_not_known_are_refused_with_those_that_are():
    with pytest.raises(ValueError, match=r"no family is called 'optics'; there are projectile"):
        exercise("optics", "lens", np.random.default_rng(0))
    with pytest.raises(ValueError, match=r"atwood has no problem 'lens'; it has acceleration"):
        exercise("atwood", "lens", np.random.default_rng(0))
