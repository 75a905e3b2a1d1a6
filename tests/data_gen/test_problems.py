"""Laws of the six diagrams' truth: what must hold before any ink is drawn."""

import math
from itertools import pairwise

import numpy as np
import pytest

from data_gen.pages import meaning
from data_gen.problems import ANSWERS, PROBLEMS, problem
from sketch.geometry import bounding_box, contains, signed_distance
from sketch.shapes import Circle, Polygon, Spring, Wire, outline

EVERY = [(name, answer) for name in PROBLEMS for answer in ANSWERS[name]]
DRAWS = 12


def draws(name, answer):
    return [problem(name, answer, np.random.default_rng([5, k])) for k in range(DRAWS)]


@pytest.mark.parametrize(("name", "answer"), EVERY)
def test_the_same_generator_gives_the_same_diagram(name, answer):
    for made, again in zip(draws(name, answer), draws(name, answer), strict=True):
        assert made == again


@pytest.mark.parametrize(("name", "answer"), EVERY)
def test_every_draw_differs(name, answer):
    assert len({made.components for made in draws(name, answer)}) == DRAWS


@pytest.mark.parametrize(("name", "answer"), EVERY)
def test_links_end_exactly_on_the_boundary_of_what_they_are_attached_to(name, answer):
    for made in draws(name, answer):
        page = meaning(made)
        links = [part for part in page.components if isinstance(part.shape, Spring | Wire)]
        for link in links:
            for label, end in zip(link.ends, (link.shape.start, link.shape.end), strict=True):
                assert abs(signed_distance(page.component(label).shape, end)) < 1e-9


@pytest.mark.parametrize(("name", "answer"), EVERY)
def test_every_formula_can_be_read_and_every_anchor_lies_on_its_component(name, answer):
    for made in draws(name, answer):
        page = meaning(made)
        assert [one.problem for one in page.expressions] == [None] * len(page.expressions)
        for one in page.associations:
            shape = page.component(one.component).shape
            if isinstance(shape, Circle | Polygon):
                assert contains(shape, one.anchor)
            else:
                start, end = outline(shape)
                along = math.dist(start, one.anchor) + math.dist(one.anchor, end)
                assert along == pytest.approx(math.dist(start, end))


@pytest.mark.parametrize(("name", "answer"), EVERY)
def test_all_of_a_diagram_lies_on_the_page(name, answer):
    for made in draws(name, answer):
        low, high = bounding_box(np.concatenate([outline(part.shape) for part in made.components]))
        assert low.min() >= 0
        assert high[0] <= 600
        assert high[1] <= 450


@pytest.mark.parametrize(("name", "answer"), EVERY)
def test_labels_go_down_the_page_by_rows_and_every_movable_solid_has_an_expected_fate(name, answer):
    for made in draws(name, answer):
        assert [part.label for part in made.components] == list("ABCDEFGH"[: len(made.components)])
        middles = [np.mean(bounding_box(outline(part.shape)), axis=0)[1] for part in made.components]
        assert all(a <= b + 60 for a, b in pairwise(middles))
        movable = {p.label for p in made.components if isinstance(p.shape, Circle | Polygon) and not p.fixed}
        assert set(made.expected.fates) == movable


@pytest.mark.parametrize("answer", ANSWERS["incline-and-ball"])
def test_the_ball_touches_the_incline_and_the_incline_has_the_angle_it_is_said_to_have(answer):
    for made in draws("incline-and-ball", answer):
        ball = next(part.shape for part in made.components if isinstance(part.shape, Circle))
        incline = next(part.shape for part in made.components if isinstance(part.shape, Polygon))
        assert signed_distance(incline, ball.centre) == pytest.approx(ball.radius, abs=1e-9)
        foot, corner, top = incline.vertices
        drawn = math.atan2(abs(top[1] - corner[1]), abs(corner[0] - foot[0]))
        theta = next(one for one in meaning(made).expressions if one.text.startswith("theta"))
        assert drawn == pytest.approx(float(theta.tree.rhs), abs=1e-12)


def test_only_the_right_tensions_balance_the_box():
    """Sum of forces in closed form: both wires pull at 45°, the box weighs 10 N."""
    for answer in ANSWERS["box-on-two-wires"]:
        for made in draws("box-on-two-wires", answer):
            page = meaning(made)
            total = np.array([0.0, -10.0])
            moment = 0.0
            box = next(
                part.shape for part in page.components if isinstance(part.shape, Polygon) and not part.fixed
            )
            middle = box.vertices.mean(axis=0)
            for one in page.associations:
                text = page.expressions[one.expression]
                if text.text.startswith("T_"):
                    wire = page.component(one.component).shape
                    pull = np.subtract(wire.start, wire.end) * [1, -1]
                    pull = float(text.tree.rhs) * pull / np.linalg.norm(pull)
                    assert abs(pull[0]) == pytest.approx(pull[1])
                    arm = (np.asarray(wire.end) - middle) * [1, -1]
                    total += pull
                    moment += arm[0] * pull[1] - arm[1] * pull[0]
            balanced = np.linalg.norm(total) < 1e-9 and abs(moment) < 1e-6
            assert balanced == (answer == "right")


def test_each_box_of_a_stack_carries_the_centre_of_mass_of_all_above_it():
    for made in draws("stack-of-boxes", "right"):
        boxes = [part.shape.vertices for part in made.components if not part.fixed]
        weights = [float(np.prod(np.ptp(box, axis=0))) for box in boxes]
        for below in range(1, len(boxes)):
            middles = [box[:, 0].mean() for box in boxes[:below]]
            centre = np.average(middles, weights=weights[:below])
            carried = boxes[below - 1]
            left = max(carried[:, 0].min(), boxes[below][:, 0].min())
            right = min(carried[:, 0].max(), boxes[below][:, 0].max())
            assert left < centre < right


def test_names_and_answers_that_are_not_known_are_refused_with_those_that_are():
    with pytest.raises(ValueError, match=r"no problem is called 'seesaw'; there are incline-and-ball"):
        problem("seesaw", "right", np.random.default_rng(0))
    with pytest.raises(ValueError, match=r"pendulum has no answer 'low'; it has right"):
        problem("pendulum", "low", np.random.default_rng(0))
