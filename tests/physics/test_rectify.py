"""Laws of correction: exact pages stay, twice is once, each rule does what its row says."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, cos, hypot, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from physics_pages import ball_on_incline, box_on_wires, page, rectangle

from data_gen.pages import page as generated
from data_gen.problems import PROBLEMS
from physics.rectify import rectify
from physics.rectify.separation import apart
from sketch.geometry import nearest_on_boundary, signed_area
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon, Shape, Wire

FLOOR = Component(rectangle(0, 300, 600, 340), label="F", fixed=True)


def numbers(shape: Shape) -> list[float]:
    match shape:
        case Circle(centre, radius):
            return [*centre, radius]
        case Polygon():
            return shape.vertices.ravel().tolist()
        case _:
            return [*shape.start, *shape.end]


def farthest(one: Sketch, other: Sketch) -> float:
    return max(
        float(np.abs(np.subtract(numbers(a.shape), numbers(b.shape))).max())
        for a, b in zip(one.components, other.components, strict=True)
    )


def wound(sketch: Sketch) -> Sketch:
    """With every polygon anti-clockwise to the eye, from the same first vertex."""

    def turned(part: Component) -> Component:
        if not isinstance(part.shape, Polygon) or signed_area(part.shape.vertices) <= 0:
            return part
        vertices = part.shape.vertices
        return replace(part, shape=Polygon(np.concatenate([vertices[:1], vertices[:0:-1]])))

    return replace(sketch, components=tuple(turned(part) for part in sketch.components))


@pytest.mark.parametrize("name", PROBLEMS)
@pytest.mark.parametrize("index", range(6))
def test_an_exact_page_is_not_changed(name: str, index: int) -> None:
    truth = wound(generated(name, 11, index).truth)
    corrected = rectify(truth)
    assert corrected.corrections == ()
    assert corrected.sketch == truth


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(PROBLEMS), st.integers(0, 10_000), st.floats(0, 4))
def test_correcting_twice_is_correcting_once(name: str, seed: int, noise: float) -> None:
    rng = np.random.default_rng(seed)
    truth = generated(name, 11, seed % 7).truth

    def shaken(shape: Shape) -> Shape:
        match shape:
            case Circle(centre, radius):
                return Circle((centre[0] + noise * rng.normal(), centre[1] + noise * rng.normal()), radius)
            case Polygon():
                return Polygon(shape.vertices + noise * rng.normal(size=shape.vertices.shape))
            case _:
                start, end = np.array([shape.start, shape.end]) + noise * rng.normal(size=(2, 2))
                return replace(shape, start=tuple(start.tolist()), end=tuple(end.tolist()))

    rough = replace(
        truth, components=tuple(replace(part, shape=shaken(part.shape)) for part in truth.components)
    )
    once = rectify(rough)
    twice = rectify(once.sketch)
    assert farthest(once.sketch, twice.sketch) < 1e-6


@pytest.mark.parametrize("name", PROBLEMS)
def test_corrections_tell_the_whole_way_from_the_page_to_its_correction(name: str) -> None:
    truth = generated(name, 11, 3).truth
    rng = np.random.default_rng(1)
    parts = tuple(
        replace(part, shape=Polygon(part.shape.vertices + rng.normal(size=part.shape.vertices.shape)))
        if isinstance(part.shape, Polygon)
        else part
        for part in truth.components
    )
    rough = replace(truth, components=parts)
    corrected = rectify(rough)
    shapes = {part.label: part.shape for part in rough.components}
    for correction in corrected.corrections:
        assert shapes[correction.component] == correction.before
        assert correction.why
        shapes[correction.component] = correction.after
    assert shapes == {part.label: part.shape for part in corrected.sketch.components}


def test_c1_straightens_a_leaning_box_and_winds_it_anti_clockwise() -> None:
    drawn = Polygon([(100, 102), (201, 98), (203, 199), (98, 201)])
    after = rectify(page((Component(drawn, label="A"),))).sketch.component("A").shape
    assert isinstance(after, Polygon)
    assert signed_area(after.vertices) < 0
    steps = np.roll(after.vertices, -1, axis=0) - after.vertices
    assert np.all(np.abs(steps).min(axis=1) == 0)
    assert np.abs(after.vertices.mean(axis=0) - drawn.vertices.mean(axis=0)).max() < 1e-9


def test_c1_leaves_slanted_edges_and_does_not_press_a_flat_triangle_flat() -> None:
    for drawn in (
        Polygon([(0, 0), (0, 100), (200, 100)]),
        Polygon([(0, 0), (300, 20), (600, 0)]),
    ):
        after = rectify(page((Component(drawn, label="A"),))).sketch.component("A").shape
        assert isinstance(after, Polygon)
        assert abs(signed_area(after.vertices)) > 0.5 * abs(signed_area(drawn.vertices))


@settings(max_examples=50, deadline=None)
@given(st.floats(-8, 8), st.floats(20, 60), st.floats(100, 500))
def test_c2_moves_a_ball_onto_its_floor_straight_down_or_up(gap: float, radius: float, x: float) -> None:
    ball = Component(Circle((x, 300 - radius - gap), radius), label="A")
    after = rectify(page((FLOOR, ball))).sketch
    centre = after.component("A").shape
    assert isinstance(centre, Circle)
    assert centre.centre == pytest.approx((x, 300 - radius), abs=1e-9)
    assert after.component("F") == FLOOR


def test_c2_moves_the_lighter_of_two_circles_along_the_line_of_centres() -> None:
    heavy = Component(Circle((100.0, 100.0), 50.0), label="A")
    light = Component(Circle((160.0, 160.0), 30.0), label="B")
    after = rectify(page((heavy, light))).sketch
    assert after.component("A") == heavy
    moved = after.component("B").shape
    assert isinstance(moved, Circle)
    assert hypot(moved.centre[0] - 100, moved.centre[1] - 100) == pytest.approx(80, abs=1e-9)
    assert moved.centre[0] == pytest.approx(moved.centre[1])


def test_c2_settles_a_stack_from_the_floor_upwards_so_that_no_pair_undoes_another() -> None:
    gaps = (6.0, -5.0, 4.0, -3.0)
    parts, top = [FLOOR], 300.0
    for k, gap in enumerate(gaps):
        bottom = top - gap
        parts.append(Component(rectangle(100 + 5 * k, bottom - 50, 220 - 5 * k, bottom), label="ABCD"[k]))
        top = bottom - 50
    after = rectify(page(parts[::-1])).sketch
    for lower, upper in zip("FABC", "ABCD", strict=True):
        gap, _ = apart(after.component(lower).shape, after.component(upper).shape)
        assert abs(gap) < 1e-9


def test_c2_puts_a_ball_into_a_corner_against_both_sides() -> None:
    wall = Component(rectangle(0, 0, 40, 300), label="W", fixed=True)
    ball = Component(Circle((66.0, 277.0), 30.0), label="A")
    after = rectify(page((FLOOR, wall, ball))).sketch.component("A").shape
    assert isinstance(after, Circle)
    assert after.centre == pytest.approx((70.0, 270.0), abs=1e-8)


@pytest.mark.parametrize("drawn", [radians(24), radians(30), radians(36)])
@pytest.mark.parametrize("mirrored", [False, True])
def test_c3_gives_the_incline_its_angle_and_keeps_the_base_and_the_ball_in_its_place(
    drawn: float, mirrored: bool
) -> None:
    sketch = ball_on_incline(drawn=drawn)
    if mirrored:
        sketch = mirror(sketch)
    after = rectify(sketch).sketch
    before, triangle = sketch.component("A").shape, after.component("A").shape
    assert isinstance(before, Polygon)
    assert isinstance(triangle, Polygon)
    level = {tuple(v) for v in before.vertices.tolist() if v[1] == 400}
    assert level <= {tuple(v) for v in triangle.vertices.tolist()}
    foot = next(v for v in level if v[0] == (700 - 100 if mirrored else 100))
    ball, old = after.component("B").shape, sketch.component("B").shape
    assert isinstance(ball, Circle)
    assert isinstance(old, Circle)
    assert hypot(ball.centre[0] - foot[0], ball.centre[1] - foot[1]) == pytest.approx(
        hypot(old.centre[0] - foot[0], old.centre[1] - foot[1]), abs=1e-6
    )
    top = triangle.vertices[np.argmin(triangle.vertices[:, 1])]
    assert atan2(400 - top[1], abs(top[0] - foot[0])) == pytest.approx(pi / 6, abs=1e-12)
    gap, _ = apart(triangle, ball)
    assert abs(gap) < 1e-9


def mirror(sketch: Sketch) -> Sketch:
    """Left and right exchanged about x = 350."""

    def seen(part: Component) -> Component:
        shape = part.shape
        if isinstance(shape, Circle):
            return replace(part, shape=replace(shape, centre=(700 - shape.centre[0], shape.centre[1])))
        assert isinstance(shape, Polygon)
        return replace(part, shape=Polygon((shape.vertices * (-1, 1) + (700, 0))[::-1]))

    return replace(sketch, components=tuple(seen(part) for part in sketch.components))


def test_c4_clips_ends_to_the_boundary_and_snaps_them_to_vertices_and_facing_points() -> None:
    block = Component(rectangle(100, 0, 300, 40), label="A", fixed=True)
    ball = Component(Circle((200.0, 200.0), 30.0), label="B")
    straight = Component(Wire((205.0, 30.0), (206.0, 176.0)), label="C", ends=("A", "B"))
    wire = rectify(page((block, ball, straight))).sketch.component("C").shape
    assert isinstance(wire, Wire)
    assert wire.start == pytest.approx((205.0, 40.0))
    foot = nearest_on_boundary(Circle((200.0, 200.0), 30.0), (205.0, 30.0))
    assert hypot(wire.end[0] - foot[0], wire.end[1] - foot[1]) < 1.0
    corner = Component(Wire((293.0, 44.0), (220.0, 180.0)), label="C", ends=("A", "B"))
    wire = rectify(page((block, ball, corner))).sketch.component("C").shape
    assert isinstance(wire, Wire)
    assert wire.start == (300.0, 40.0)


@pytest.mark.parametrize("lean", [-0.1, 0.05, 0.12])
def test_c5_gives_a_wire_its_angle_and_leaves_the_box_that_two_wires_hold(lean: float) -> None:
    sketch = box_on_wires("5", "5", lean)
    after = rectify(sketch).sketch
    assert after.component("E") == sketch.component("E")
    assert after.component("D") == sketch.component("D")
    wire = after.component("C").shape
    assert isinstance(wire, Wire)
    assert wire.end == (250.0, 250.0)
    assert atan2(wire.end[1] - wire.start[1], wire.end[0] - wire.start[0]) == pytest.approx(pi / 4, abs=1e-10)
    block = after.component("A").shape
    assert isinstance(block, Polygon)
    foot = nearest_on_boundary(block, wire.start)
    assert hypot(foot[0] - wire.start[0], foot[1] - wire.start[1]) < 1e-9


def test_c5_turns_a_bob_about_its_fixed_end_and_measures_from_the_vertical_near_the_top() -> None:
    ceiling = Component(rectangle(100, 0, 300, 40), label="A", fixed=True)
    bob = Component(Circle((200 + 120 * sin(0.4), 40 + 120 * cos(0.4)), 20.0), label="B")
    end = (200 + 100 * sin(0.4), 40 + 100 * cos(0.4))
    wire = Component(Wire((200.0, 40.0), end), label="C", ends=("A", "B"))
    for anchor, wanted in (((200.0, 45.0), pi / 6), (end, pi / 3)):
        after = rectify(page((ceiling, bob, wire), (("theta = pi/6", "C", anchor),))).sketch
        ball, line = after.component("B").shape, after.component("C").shape
        assert isinstance(ball, Circle)
        assert isinstance(line, Wire)
        assert line.start == (200.0, 40.0)
        assert atan2(line.end[0] - 200, line.end[1] - 40) == pytest.approx(wanted, abs=1e-10)
        assert ball.centre == pytest.approx((200 + 120 * sin(wanted), 40 + 120 * cos(wanted)))


def test_correction_does_not_depend_on_the_order_in_which_shapes_were_drawn() -> None:
    parts = [
        FLOOR,
        Component(rectangle(100, 250, 200, 296), label="A"),
        Component(rectangle(110, 197, 190, 253), label="B"),
        Component(Circle((250.0, 272.0), 25.0), label="C"),
    ]
    one, other = rectify(page(parts)).sketch, rectify(page(parts[::-1])).sketch
    for label in "FABC":
        assert numbers(one.component(label).shape) == pytest.approx(
            numbers(other.component(label).shape), abs=1e-9
        )
