"""Laws of the pen's motion: kinematics of the sigma-lognormal model, and perturbations that compose."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from data_gen import ideals
from data_gen.pen import draw
from data_gen.perturb import Perturbation, bow, compose, field, shear, stretch, turn, wobble
from data_gen.writers import Writer, sample_writer
from sketch.geometry import path_length, resample
from sketch.ink import FloatArray

STEADY = replace(
    sample_writer(np.random.default_rng(0)),
    wobble=0.0, tremor=0.0, hooks=0.0, grid=0.0, late=0.0, overlap=0.05, rate=250.0, speed=4.0,
)  # fmt: skip
RECTANGLE = ideals.polygon([(0, 0), (200, 0), (200, 120), (0, 120)])


def _drawn(path: FloatArray, writer: Writer, seed: int = 1) -> tuple[FloatArray, FloatArray]:
    (stroke,) = draw([path], writer, np.random.default_rng(seed))
    assert stroke.times is not None
    return stroke.points, stroke.times


def test_a_steady_hand_ends_where_it_meant_to() -> None:
    points, _ = _drawn(ideals.line((10, 20), (210, -40)), STEADY)
    assert points[0] == pytest.approx([10, 20])
    assert points[-1] == pytest.approx([210, -40])


def test_a_steady_hand_stays_near_the_path() -> None:
    points, _ = _drawn(RECTANGLE, STEADY)
    away = np.min(np.linalg.norm(points[:, None] - resample(RECTANGLE, 4000)[None], axis=2), axis=1)
    assert away.max() < 0.02 * 233


def test_the_pen_slows_down_at_corners() -> None:
    points, times = _drawn(RECTANGLE, STEADY)
    speed = np.linalg.norm(np.diff(points, axis=0), axis=1) / np.diff(times)
    middle = (points[1:] + points[:-1]) / 2
    corners = np.min(np.linalg.norm(middle[:, None] - RECTANGLE[None, 1:-1], axis=2), axis=1)
    assert np.median(speed[corners < 8]) < 0.5 * np.median(speed[corners > 40])


def test_a_strokelet_starts_and_ends_at_rest_with_one_peak_of_speed() -> None:
    points, times = _drawn(ideals.line((0, 0), (300, 0)), STEADY)
    speed = np.diff(points[:, 0]) / np.diff(times)
    peak = int(np.argmax(speed))
    assert 0 < peak < len(speed) / 2, "a lognormal's bell leans to the left"
    assert (np.diff(speed[:peak]) > -1e-9).all() and (np.diff(speed[peak:]) < 1e-9).all()
    assert speed[-1] < 0.1 * speed[peak]


def test_longer_strokes_take_longer_but_less_than_in_proportion() -> None:
    _, short = _drawn(ideals.line((0, 0), (50, 0)), STEADY)
    _, long = _drawn(ideals.line((0, 0), (400, 0)), STEADY)
    assert short[-1] < long[-1] < 8 * short[-1]


def test_haste_rounds_corners() -> None:
    def shortest_distance_to_corner(overlap: float) -> float:
        points, _ = _drawn(RECTANGLE, replace(STEADY, overlap=overlap))
        return float(np.linalg.norm(points - RECTANGLE[1], axis=1).min())

    assert shortest_distance_to_corner(0.45) > shortest_distance_to_corner(0.05) + 1


def test_the_sampling_rate_is_the_writers() -> None:
    for rate in (20.0, 60.0, 120.0):
        _, times = _drawn(RECTANGLE, replace(STEADY, rate=rate))
        assert 1 / np.median(np.diff(times)) == pytest.approx(rate, rel=0.15)


def test_a_coarse_grid_rounds_every_point() -> None:
    points, _ = _drawn(RECTANGLE, replace(STEADY, grid=1.0, tremor=0.01))
    assert np.array_equal(points, np.round(points))


def test_tremor_grows_with_its_amount() -> None:
    def roughness(tremor: float) -> float:
        points, _ = _drawn(RECTANGLE, replace(STEADY, tremor=tremor))
        return path_length(points)

    assert roughness(0.0) < roughness(0.003) < roughness(0.01)


def test_nothing_to_draw_is_no_strokes() -> None:
    assert draw([], STEADY, np.random.default_rng(0)) == []


@pytest.mark.parametrize(
    "step",
    [shear(0.0), stretch(0.0), turn(0.0), wobble(0.0), bow(0.0), field(0.0)],
    ids=lambda s: str(s.draws),
)
def test_a_perturbation_of_amount_zero_changes_nothing(step: Perturbation) -> None:
    paths = resample(RECTANGLE, 50)[None].repeat(3, axis=0)
    normals = np.random.default_rng(1).standard_normal((3, step.draws))
    assert np.allclose(step.apply(paths, normals), paths)


def test_composing_is_applying_one_after_the_other() -> None:
    paths = resample(RECTANGLE, 50)[None].repeat(4, axis=0)
    first, second = wobble(0.02), field(0.03)
    normals = np.random.default_rng(2).standard_normal((4, first.draws + second.draws))
    stepwise = second.apply(first.apply(paths, normals[:, : first.draws]), normals[:, first.draws :])
    assert np.array_equal(compose(first, second).apply(paths, normals), stepwise)


def test_wobble_has_the_size_it_is_asked_for() -> None:
    paths = np.repeat(resample(ideals.line((0, 0), (100, 0)), 64)[None], 4000, axis=0)
    step = wobble(0.02)
    moved = step.apply(paths, np.random.default_rng(3).standard_normal((4000, step.draws))) - paths
    assert np.sqrt((moved**2).mean()) == pytest.approx(0.02 * 100, rel=0.05)
