"""Matching, exact match and geometry error: laws over a hand-made page and its distortions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evaluation.metrics.diagram import diagram_match
from evaluation.metrics.geometry import diagram_size, geometry_error, shape_error
from evaluation.metrics.matching import match_components
from sketch.ink import Ink, Stroke
from sketch.page import Component, Sketch
from sketch.shapes import Arrow, Circle, Polygon, Spring, Wire

BOX = Polygon([(0, 0), (40, 0), (40, 30), (0, 30)])
INK = Ink(tuple(Stroke([(k, 0.0), (k + 1, 1.0)]) for k in range(6)))
PAGE = Sketch(
    INK,
    (
        Component(BOX, (0, 1), "A", fixed=True),
        Component(Circle((20, 120), 10), (2,), "B"),
        Component(Wire((20, 30), (20, 110)), (3,), "C", ends=("A", "B")),
        Component(Spring((40, 10), (100, 10), 6, 8), (4,), "D", ends=("A", None)),
    ),
)
SIZE = diagram_size(PAGE)


def relabelled(page: Sketch) -> Sketch:
    """The same page with its components in reverse order under other names."""
    names = {"A": "Z", "B": "Y", "C": "X", "D": "W"}
    renamed = tuple(
        replace(
            part,
            label=names[part.label],
            ends=tuple(None if end is None else names[end] for end in part.ends),
        )
        for part in page.components
    )
    return replace(page, components=renamed[::-1])


def with_component(page: Sketch, label: str, **changes) -> Sketch:
    parts = tuple(replace(part, **changes) if part.label == label else part for part in page.components)
    return replace(page, components=parts)


def test_box_around_the_components_gives_the_size():
    assert pytest.approx(np.hypot(100, 130)) == SIZE


def test_labels_and_order_do_not_matter():
    other = relabelled(PAGE)
    assert match_components(PAGE, other) == {"A": "Z", "B": "Y", "C": "X", "D": "W"}
    assert diagram_match(PAGE, other).exact
    error = geometry_error(PAGE, other)
    assert (error.centre, error.radius, error.vertex, error.angle) == (0, 0, 0, 0)
    assert (error.compared, error.missing, error.surplus, error.miscounted) == (4, 0, 0, 0)


def test_each_part_of_the_match_sees_its_own_fault():
    wrong_kind = with_component(PAGE, "B", shape=BOX)
    assert not diagram_match(PAGE, wrong_kind).components
    wrong_group = with_component(with_component(PAGE, "A", strokes=(0,)), "B", strokes=(1, 2))
    match = diagram_match(PAGE, wrong_group)
    assert (match.components, match.grouping, match.ends, match.fixed) == (True, False, True, True)
    loose = diagram_match(PAGE, with_component(PAGE, "C", ends=("A", None)))
    assert (loose.components, loose.grouping, loose.ends, loose.fixed) == (True, True, False, True)
    turned = diagram_match(PAGE, with_component(PAGE, "C", ends=("B", "A")))
    assert turned.exact
    free = diagram_match(PAGE, with_component(PAGE, "A", fixed=False))
    assert (free.components, free.grouping, free.ends, free.fixed) == (True, True, True, False)


def test_a_missing_component_counts_against_every_part_and_is_counted():
    claim = replace(PAGE, components=PAGE.components[:3])
    assert not any(
        getattr(diagram_match(PAGE, claim), part) for part in ("components", "grouping", "ends", "fixed")
    )
    assert geometry_error(PAGE, claim).missing == 1
    assert geometry_error(claim, PAGE).surplus == 1


def test_an_empty_page_matches_an_empty_page_only():
    assert diagram_match(Sketch(INK), Sketch(INK)).exact
    assert not diagram_match(PAGE, Sketch(INK)).exact
    assert geometry_error(Sketch(INK), Sketch(INK)).centre is None


def test_overlap_decides_the_pairing_before_kind_does():
    claim = Sketch(INK, (Component(Circle((0, 0), 5), (0, 1), "A"), Component(BOX, (2, 5), "B")))
    assert match_components(PAGE, claim) == {"A": "A", "B": "B"}


@given(st.floats(-50, 50), st.floats(-50, 50), st.floats(0.5, 2))
def test_circle_error_is_the_shift_and_the_change_of_radius(dx, dy, grown):
    error = shape_error(Circle((3, 4), 10), Circle((3 + dx, 4 + dy), 10 * grown), 100)
    assert error.centre == pytest.approx(np.hypot(dx, dy) / 100, abs=1e-12)
    assert error.radius == pytest.approx(abs(grown - 1) / 10, abs=1e-12)


@given(st.integers(0, 3), st.booleans())
def test_a_polygon_started_elsewhere_or_drawn_backwards_has_no_error(turn, backwards):
    vertices = np.roll(BOX.vertices, turn, axis=0)
    error = shape_error(BOX, Polygon(vertices[::-1] if backwards else vertices), 50)
    assert (error.centre, error.vertex, error.angle) == (0, 0, 0)


def test_a_sheared_square_differs_by_the_shear_angle_at_every_corner():
    square = np.array([(0, 0), (10, 0), (10, 10), (0, 10)], dtype=float)
    sheared = square + square[:, 1:] * [np.tan(np.radians(20)), 0]
    error = shape_error(Polygon(square), Polygon(sheared), 1)
    assert error.angle == pytest.approx(20)


def test_another_number_of_vertices_is_counted_not_averaged():
    claim = with_component(PAGE, "A", shape=Polygon(BOX.vertices[:3]))
    error = geometry_error(PAGE, claim)
    assert error.miscounted == 1
    assert error.vertex == 0


@pytest.mark.parametrize("kind", [Wire, lambda a, b: Spring(a, b, 5, 4)])
def test_a_wire_or_spring_has_no_direction_and_turns_by_its_angle(kind):
    true = kind((0, 0), (100, 0))
    assert shape_error(true, kind((100, 0), (0, 0)), 100).vertex == 0
    error = shape_error(true, kind((0, 0), (0, 100)), 100)
    assert error.angle == pytest.approx(90)


def test_an_arrow_has_a_direction():
    assert shape_error(Arrow((0, 0), (9, 0)), Arrow((9, 0), (0, 0)), 9).angle == pytest.approx(180)


def test_shapes_of_two_kinds_are_not_compared():
    with pytest.raises(TypeError, match="Circle"):
        shape_error(Circle((0, 0), 1), BOX, 1)
