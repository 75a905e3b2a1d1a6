"""Laws of plane geometry on polylines and solids."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sketch.geometry import (
    arc_lengths,
    centroid,
    closure,
    contains,
    diagonal,
    distinct,
    nearest_on_boundary,
    nearest_on_segment,
    path_length,
    polygon_of,
    resample,
    self_intersections,
    signed_area,
    signed_distance,
    solid_area,
    turning,
)
from sketch.ink import FloatArray
from sketch.shapes import Circle, Polygon, Solid

numbers = st.floats(-1000, 1000).map(lambda value: round(value, 3))
points = st.tuples(numbers, numbers)
paths = st.lists(points, min_size=1, max_size=20).map(np.array)
angles = st.floats(-math.pi, math.pi)


@st.composite
def convex(draw: st.DrawFn) -> FloatArray:
    """Vertices of a convex polygon in order: distinct angles on an ellipse."""
    count = draw(st.integers(3, 12))
    gaps = np.array(draw(st.lists(st.floats(0.2, 1), min_size=count, max_size=count)))
    around = np.cumsum(gaps) / gaps.sum() * 2 * np.pi
    return np.column_stack(
        [draw(st.floats(1, 100)) * np.cos(around), draw(st.floats(1, 100)) * np.sin(around)]
    )


solids: st.SearchStrategy[Solid] = convex().map(Polygon) | st.builds(Circle, points, st.floats(0.1, 500))


def loops(count: int) -> FloatArray:
    """A coil that loops `count` times: a prolate trochoid, whose loop k closes within ±1.9 of t = 2πk."""
    t = np.linspace(-2.5, (count - 1) * 2 * np.pi + 2.5, 100 * count + 20)
    return np.column_stack([t - 2.0 * np.sin(t), 3.0 * np.cos(t)])


@given(paths, st.integers(2, 60))
def test_resampling_keeps_the_ends_and_spaces_points_equally_along_the_path(
    path: FloatArray, count: int
) -> None:
    found = resample(path, count)
    assert found.shape == (count, 2)
    assert found[0] == pytest.approx(path[0])
    assert found[-1] == pytest.approx(path[-1] if path_length(path) > 0 else path[0])
    if len(path) == 2:
        steps = np.linalg.norm(np.diff(found, axis=0), axis=1)
        assert steps == pytest.approx(np.full(count - 1, path_length(path) / (count - 1)), abs=1e-9)


@given(paths, st.integers(2, 60))
def test_resampling_never_lengthens_a_path_and_no_step_exceeds_the_spacing(
    path: FloatArray, count: int
) -> None:
    found = resample(path, count)
    spacing = path_length(path) / (count - 1)
    assert np.linalg.norm(np.diff(found, axis=0), axis=1).max() <= spacing + 1e-9
    assert path_length(found) <= path_length(path) + 1e-9


def test_resampling_a_circle_gives_equal_chords() -> None:
    angle = np.linspace(0, 2 * np.pi, 2001)
    steps = np.linalg.norm(
        np.diff(resample(np.column_stack([np.cos(angle), np.sin(angle)]), 33), axis=0), axis=1
    )
    assert steps == pytest.approx(np.full(32, 2 * math.sin(math.pi / 32)), rel=1e-4)


@given(convex())
def test_a_closed_convex_polygon_turns_once_around(vertices: FloatArray) -> None:
    closed = np.concatenate([vertices, vertices[:2]])
    assert turning(closed).sum() == pytest.approx(2 * math.pi)
    assert turning(closed[::-1]).sum() == pytest.approx(-2 * math.pi)


@pytest.mark.parametrize("count", [1, 2, 5, 9])
def test_a_coil_of_k_loops_crosses_itself_k_times(count: int) -> None:
    assert len(self_intersections(loops(count))) == count


def test_what_does_not_cross_has_no_crossings() -> None:
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [0, 0]])
    for path in (square, square[:3], square[:1], np.array([[0.0, 0], [1, 0], [2, 0], [1, 0], [0, 0]])):
        assert self_intersections(path).shape == (0, 2)


def test_crossings_are_where_both_segments_say() -> None:
    path = loops(3)
    crossings = self_intersections(path)
    at = [
        [path[int(p)] + (p % 1) * (path[int(p) + 1] - path[int(p)]) for p in pair]
        for pair in crossings.tolist()
    ]
    for first, second in at:
        assert first == pytest.approx(second)


@given(paths, angles, points)
def test_rigid_motions_change_no_measure_of_a_path(
    path: FloatArray, angle: float, shift: tuple[float, float]
) -> None:
    cos, sin = math.cos(angle), math.sin(angle)
    moved = path @ np.array([[cos, sin], [-sin, cos]]) + shift
    assert path_length(moved) == pytest.approx(path_length(path), abs=1e-6)
    assert closure(moved) == pytest.approx(closure(path), abs=1e-6)
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    if len(path) > 2 and steps.min() > 0.01 and np.abs(turning(path)).max() < 3.1:
        assert turning(moved) == pytest.approx(turning(path), abs=1e-6)


@given(paths)
def test_closure_is_a_fraction_and_arc_lengths_never_fall(path: FloatArray) -> None:
    assert 0 <= closure(path) <= 1 + 1e-12
    assert (np.diff(arc_lengths(path)) >= 0).all()
    assert diagonal(path) <= path_length(path) + 1e-9


def test_closure_of_a_line_is_one_and_of_a_ring_nought() -> None:
    assert closure(np.array([[0.0, 0], [1, 1], [3, 3]])) == pytest.approx(1)
    assert closure(np.array([[0.0, 0], [1, 1], [0, 0]])) == 0
    assert closure(np.array([[2.0, 2]])) == 0


@given(paths)
def test_distinct_points_follow_one_another_and_lose_no_length(path: FloatArray) -> None:
    kept = distinct(path)
    assert (np.linalg.norm(np.diff(kept, axis=0), axis=1) > 0).all()
    assert path_length(kept) == pytest.approx(path_length(path))


@given(convex(), angles, points)
def test_area_and_centre_move_with_the_polygon(
    vertices: FloatArray, angle: float, shift: tuple[float, float]
) -> None:
    cos, sin = math.cos(angle), math.sin(angle)
    turn = np.array([[cos, sin], [-sin, cos]])
    assert signed_area(vertices @ turn + shift) == pytest.approx(signed_area(vertices), rel=1e-6)
    assert signed_area(vertices[::-1]) == pytest.approx(-signed_area(vertices))
    assert centroid(vertices @ turn + shift) == pytest.approx(centroid(vertices) @ turn + shift, abs=1e-6)


def test_areas_and_centres_of_known_shapes() -> None:
    assert centroid(np.array([[0.0, 0], [3, 0], [0, 6]])) == pytest.approx([1, 2])
    assert centroid(np.array([[0.0, 0], [1, 1], [2, 2]])) == pytest.approx([1, 1])
    assert solid_area(Polygon([[0, 0], [0, 6], [3, 0]])) == pytest.approx(9)
    assert solid_area(Circle((1, 2), 3)) == pytest.approx(9 * math.pi)


@given(solids, points)
def test_the_nearest_boundary_point_lies_on_the_boundary_and_none_is_nearer(
    solid: Solid, point: tuple[float, float]
) -> None:
    foot = nearest_on_boundary(solid, point)
    distance = math.dist(foot, point)
    ring = polygon_of(solid)
    assert abs(signed_distance(solid, foot)) <= 1e-9 * (1 + diagonal(ring) + math.hypot(*point))
    assert distance <= min(math.dist(vertex, point) for vertex in ring.tolist()) + 1e-9
    assert abs(signed_distance(solid, point)) == pytest.approx(distance)


@given(solids, points)
def test_inside_is_where_the_signed_distance_is_negative(solid: Solid, point: tuple[float, float]) -> None:
    distance = signed_distance(solid, point)
    assume(abs(distance) > 1e-6)
    assert contains(solid, point) == (distance < 0)
    middle = polygon_of(solid).mean(axis=0).tolist()
    assert contains(solid, (middle[0], middle[1]))


@given(convex(), points)
def test_a_convex_polygon_contains_what_lies_on_one_side_of_all_edges(
    vertices: FloatArray, point: tuple[float, float]
) -> None:
    ends = np.roll(vertices, -1, axis=0)
    edges, offsets = ends - vertices, np.array(point) - vertices
    side = edges[:, 0] * offsets[:, 1] - edges[:, 1] * offsets[:, 0]
    assume(np.abs(side).min() > 1e-6)
    assert contains(Polygon(vertices), point) == bool((side > 0).all())


@given(points, points, points)
def test_the_foot_on_a_segment_is_perpendicular_or_an_end(
    start: tuple[float, float], end: tuple[float, float], point: tuple[float, float]
) -> None:
    a, b, p = (np.array(corner) for corner in (start, end, point))
    foot = nearest_on_segment(a, b, p)
    at_end = min(np.linalg.norm(foot - a), np.linalg.norm(foot - b)) < 1e-6
    assert at_end or abs((p - foot) @ (b - a)) <= 1e-6 * (
        1 + np.linalg.norm(b - a) * np.linalg.norm(p - foot)
    )
