"""The measurements that the geometric rivals share: laws of cleaning, cusps, crossings, legs, rings, teeth."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen import ideals
from recognizer.geometric.crossings import crossings
from recognizer.geometric.cusps import cusps
from recognizer.geometric.kernels.paths import line_rms
from recognizer.geometric.legs import best_legs, leg_errors
from recognizer.geometric.ring import area_moments, closing_points, ring
from recognizer.geometric.teeth import swings, teeth
from recognizer.preprocess import SPACING, spaced, unit_path
from sketch.geometry import diagonal, resample, self_intersections
from sketch.ink import Stroke

SQUARE = np.array([[0.0, 0.0], [1, 0], [1, 1], [0, 1]])
TRIANGLE = np.array([[0.0, 0.0], [1, 0], [0.3, 0.8]])
SEEDS = st.integers(0, 2**32 - 1)


def wander(seed: int, count: int = 40) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal((count, 2)).cumsum(axis=0)


@given(SEEDS, st.floats(1e-3, 1e3), st.floats(-1e4, 1e4), st.floats(-1e4, 1e4))
def test_a_unit_path_knows_neither_place_nor_scale(seed: int, scale: float, x: float, y: float) -> None:
    path = wander(seed)
    moved = unit_path(Stroke(scale * path + [x, y]))
    assert np.allclose(moved, unit_path(Stroke(path)), atol=1e-6)


@given(SEEDS)
def test_a_unit_path_has_a_diagonal_of_one_and_begins_at_the_origin(seed: int) -> None:
    path = unit_path(Stroke(50 * wander(seed) - 7))
    assert diagonal(path) == pytest.approx(1)
    assert path.min(axis=0) == pytest.approx([0, 0])


def test_a_pen_that_never_moved_leaves_one_point() -> None:
    assert unit_path(Stroke([[3.0, 4.0]] * 9)).tolist() == [[0.0, 0.0]]


@given(SEEDS)
def test_spaced_points_lie_on_the_path_at_equal_arc_lengths(seed: int) -> None:
    path = unit_path(Stroke(wander(seed, 5)))
    points = spaced(path)
    assert SPACING.fewest <= len(points) <= SPACING.most
    # Straight parts show the spacing itself; across a corner the chord is shorter.
    steps = np.hypot(*np.diff(points, axis=0).T)
    assert steps.max() <= np.median(steps) * 1.02


@pytest.mark.parametrize(("vertices", "corners"), [(SQUARE, 3), (TRIANGLE, 2)])
def test_cusps_are_the_corners_between_the_ends(vertices: np.ndarray, corners: int) -> None:
    assert len(cusps(spaced(unit_path(Stroke(ideals.polygon(vertices)))))) == corners + 2


def test_a_circle_has_no_cusps_but_its_ends() -> None:
    points = spaced(unit_path(Stroke(ideals.circle((0, 0), 5))))
    assert cusps(points) == [0, len(points) - 1]


@given(SEEDS)
@settings(max_examples=60, deadline=None)
def test_crossings_are_those_of_plane_geometry(seed: int) -> None:
    path = wander(seed)
    assert np.allclose(crossings(path), self_intersections(path))


@pytest.mark.parametrize("coils", [3, 5, 8])
def test_a_coil_crosses_itself_at_least_once_a_turn(coils: int) -> None:
    path = spaced(unit_path(Stroke(ideals.coil((0, 0), (200, 0), coils, 40))))
    assert len(crossings(path)) >= coils - 1


@given(st.integers(1, 6), SEEDS)
@settings(max_examples=40, deadline=None)
def test_a_polyline_of_k_legs_is_found_by_k_legs(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    turns = np.cumsum(rng.choice([-1.0, 1.0], count) * rng.uniform(0.7, 2.0, count))
    knots = np.concatenate([[[0.0, 0.0]], np.cumsum(np.column_stack([np.cos(turns), np.sin(turns)]), axis=0)])
    path = np.concatenate([np.linspace(a, b, 12, endpoint=False) for a, b in pairwise(knots)] + [knots[-1:]])
    legs = best_legs(path, 7)
    assert legs.rms[count - 1] < 1e-6
    assert legs.breaks(count) == [12 * k for k in range(count + 1)]
    assert np.all(np.diff(legs.rms) <= 1e-6)


@given(SEEDS)
@settings(max_examples=30, deadline=None)
def test_leg_errors_are_those_of_the_best_line_through_each_run(seed: int) -> None:
    path = wander(seed, 20)
    errors = leg_errors(path)
    for i, j in ((0, 19), (3, 9), (12, 14)):
        assert errors[i, j] == pytest.approx(line_rms(path[i : j + 1]) ** 2 * (j - i + 1), abs=1e-8)


@given(st.floats(0.3, 1.0), st.floats(0, 3.1), st.floats(0, 6.2))
@settings(max_examples=50, deadline=None)
def test_every_ellipse_is_round(aspect: float, turn: float, start: float) -> None:
    ellipse = ideals.superellipse((0, 0), (1.0, aspect), start)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    found = ring(resample(unit_path(Stroke(ellipse @ rotation)), 64))
    assert found is not None
    assert found.roundness < 0.012
    assert found.aspect == pytest.approx(aspect, rel=0.03)


@given(st.floats(-1, 1), st.floats(0.3, 3))
@settings(max_examples=30, deadline=None)
def test_roundness_does_not_change_under_affine_maps(shear: float, stretch: float) -> None:
    centre, second = area_moments(SQUARE)
    map_ = np.array([[1.0, shear], [0.0, stretch]])
    moved_centre, moved = area_moments(SQUARE @ map_)
    assert moved_centre == pytest.approx(centre @ map_)
    assert moved == pytest.approx(map_.T @ second @ map_)


@pytest.mark.parametrize("overlap", [0.05, 0.15, 0.25])
def test_a_ring_closes_where_an_overlapping_circle_comes_round(overlap: float) -> None:
    path = resample(ideals.circle((0, 0), 1, 0.3, 2 * np.pi * (1 + overlap)), 64)
    first, last = closing_points(path)
    assert np.hypot(*(path[first] - path[last])) < 0.12
    assert (last - first) / 63 == pytest.approx(1 / (1 + overlap), abs=0.04)


def test_nothing_is_enclosed_by_a_line_or_a_half_circle() -> None:
    assert ring(resample(ideals.line((0, 0), (1, 0.2)), 64)) is None
    assert ring(resample(ideals.circle((0, 0), 0.5, 0.0, np.pi), 64)) is None


@pytest.mark.parametrize("legs", [5, 6, 9, 14])
def test_teeth_are_counted_and_lead_onward(legs: int) -> None:
    found = teeth(spaced(unit_path(Stroke(ideals.zigzag((0, 0), (300, 40), legs, 50)))))
    assert abs(found.legs - legs) <= 1  # the first and the last start from the axis
    assert found.progress == pytest.approx(1)


@given(st.integers(1, 9), st.floats(0.01, 0.4))
def test_swings_ignore_what_is_smaller_than_asked(turns: int, tremor: float) -> None:
    signal = np.array([float(k % 2) for k in range(turns + 1) for _ in range(2)])
    signal[1::2] += tremor * (0.5 - signal[1::2])
    assert len(swings(signal, 0.5)) == turns + 1
