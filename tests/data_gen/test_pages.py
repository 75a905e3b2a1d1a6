"""Laws of whole pages: seeds, owners, times, and ink that stays with what was meant."""

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from data_gen.pages import page, pages
from data_gen.problems import ANSWERS, PROBLEMS
from sketch.geometry import contains, diagonal, resample, signed_distance
from sketch.page import Sketch
from sketch.shapes import Circle, Polygon, Spring, outline

MADE = list(pages(72, seed=21))


def test_a_page_made_alone_is_the_page_made_in_sequence():
    for index in (0, 7, 31, 71):
        there = MADE[index]
        assert page(there.name, 21, index, there.answer) == there
    assert list(pages(3, seed=21, start=40)) == MADE[40:43]


def test_other_seeds_give_other_pages():
    assert page("pendulum", 1, 3).truth != page("pendulum", 2, 3).truth


def test_pages_go_through_every_diagram_and_every_answer():
    seen = {(made.name, made.answer) for made in MADE}
    assert seen == {(name, answer) for name in PROBLEMS for answer in ANSWERS[name]}


def test_every_stroke_has_exactly_one_owner():
    for made in MADE:
        assert None not in made.truth.kinds()
        owners = [stroke for part in made.truth.components for stroke in part.strokes]
        owners += [stroke for line in made.truth.expressions for stroke in line.strokes]
        owners += [gesture.stroke for gesture in made.truth.gestures]
        assert sorted(owners) == list(range(len(made.truth.ink)))


def test_every_component_and_every_line_has_ink():
    for made in MADE:
        assert all(part.strokes for part in made.truth.components)
        assert all(line.strokes and line.at is not None for line in made.truth.expressions)


def test_strokes_follow_one_another_in_time():
    for made in MADE:
        ends = [0.0]
        for stroke in made.truth.ink:
            assert stroke.times is not None
            assert stroke.times[0] >= ends[-1]
            ends.append(float(stroke.times[-1]))


def test_each_fixed_solid_is_tapped_once_and_nothing_else_is():
    for made in MADE:
        fixed = [part.shape for part in made.truth.components if part.fixed]
        spots = [made.truth.ink[tap.stroke].points.mean(axis=0) for tap in made.truth.gestures]
        assert len(spots) == len(fixed)
        for shape in fixed:
            assert sum(contains(shape, (float(x), float(y))) for x, y in spots) == 1
        movable = [part.shape for part in made.truth.components if not part.fixed]
        for shape in movable:
            if isinstance(shape, Circle | Polygon):
                assert not any(contains(shape, (float(x), float(y))) for x, y in spots)


def strays(truth: Sketch):
    """For each component how far its ink strays from its shape and its shape from its ink: 90 % of the
    points, page units."""
    for part in truth.components:
        ideal = resample(outline(part.shape), 300)
        ink = np.concatenate([resample(truth.ink[stroke].points, 150) for stroke in part.strokes])
        apart = cdist(ink, ideal)
        half = part.shape.width / 2 if isinstance(part.shape, Spring) else 0.0
        yield part, np.quantile(apart.min(axis=1), 0.9) - half, np.quantile(apart.min(axis=0), 0.9) - half


def test_the_ink_of_a_component_stays_near_its_shape():
    share = [
        max(out, back) / diagonal(outline(part.shape))
        for made in MADE
        for part, out, back in strays(made.truth)
    ]
    assert max(share) < 0.25
    assert np.quantile(share, 0.9) < 0.06


def test_lines_of_mathematics_stand_where_the_truth_says():
    for made in MADE:
        for line in made.truth.expressions:
            points = made.truth.ink.points_of(line.strokes)
            middle = (points.min(axis=0) + points.max(axis=0)) / 2
            assert np.linalg.norm(middle - line.at) < 0.6 * made.writer.height


def test_mathematics_is_written_outside_every_solid():
    for made in MADE:
        solids = [part.shape for part in made.truth.components if isinstance(part.shape, Circle | Polygon)]
        for line in made.truth.expressions:
            for stroke in line.strokes:
                middle = made.truth.ink[stroke].points.mean(axis=0)
                assert (
                    min(signed_distance(shape, (float(middle[0]), float(middle[1]))) for shape in solids) > 0
                )


def test_some_writers_lift_the_pen_within_a_polygon_and_springs_come_as_coils_and_as_zigzags():
    pieces = [len(part.strokes) for made in MADE for part in made.truth.components if part.kind == "polygon"]
    assert 0.05 < np.mean(np.array(pieces) > 1) < 0.5
    assert max(pieces) <= 4


def test_seeds_and_names_that_cannot_be_are_refused():
    with pytest.raises(ValueError, match="seed -1 and index 0: both must be zero or more"):
        page("pendulum", -1, 0)
    with pytest.raises(ValueError, match="no problem is called"):
        page("lever", 1, 0)


def test_clutter_is_nobodys_but_the_scribble_over_a_crossed_out_sign():
    made = list(pages(12, seed=5, cluttered=True))
    scribbles = [gesture for one in made for gesture in one.truth.gestures if gesture.kind == "scribble"]
    assert scribbles
    for one in made:
        kinds = one.truth.kinds()
        assert None in kinds
        assert all(part.strokes for part in one.truth.components)
        assert page(one.name, 5, one.index, one.answer, cluttered=True) == one
