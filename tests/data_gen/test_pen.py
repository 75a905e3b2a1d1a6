"""Laws of the pen's motion: kinematics of the sigma-lognormal model, variations by name, groups of writers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import ks_2samp

from data_gen import ideals
from data_gen.hand.motion import LEAST_BEND
from data_gen.hand.names import NAMES, Mask, mask
from data_gen.hand.paths import PATH_POINTS
from data_gen.pen import EVERY, draw
from data_gen.writers import ADULT, PROFILES, Writer, sample_writer
from sketch.geometry import path_length, resample
from sketch.ink import FloatArray

STEADY = replace(
    sample_writer(np.random.default_rng(0)),
    wobble=0.0, tremor=0.0, jitter=0.0, hooks=0.0, retrace=0.0, grid=0.0, late=0.0, overlap=0.05, rate=250.0, speed=4.0,
)  # fmt: skip
RECTANGLE = ideals.polygon([(0, 0), (200, 0), (200, 120), (0, 120)])


def _drawn(
    path: FloatArray, writer: Writer, seed: int = 1, on: Mask = EVERY
) -> tuple[FloatArray, FloatArray]:
    (stroke,) = draw([path], writer, np.random.default_rng(seed), on)
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


def test_without_variations_and_kinematics_the_pen_stays_on_its_path() -> None:
    points, _ = _drawn(
        RECTANGLE, sample_writer(np.random.default_rng(5)), on=np.zeros(len(NAMES), dtype=bool)
    )
    away = np.min(np.linalg.norm(points[:, None] - resample(RECTANGLE, 8000)[None], axis=2), axis=1)
    # The path is carried by evenly spaced points, which may cut a corner by half their spacing.
    assert away.max() < path_length(RECTANGLE) / PATH_POINTS / 2


def test_a_variation_left_out_leaves_the_others_as_they_are() -> None:
    writer = replace(STEADY, tremor=0.01, grid=0.0)
    both, _ = _drawn(RECTANGLE, replace(writer, jitter=0.3))
    shaken, _ = _drawn(RECTANGLE, replace(writer, jitter=0.3), on=mask("jitter"))
    noisy, _ = _drawn(RECTANGLE, replace(writer, jitter=0.3), on=mask("tremor"))
    bare, _ = _drawn(RECTANGLE, replace(writer, jitter=0.3), on=mask("tremor", "jitter"))
    assert np.allclose(both - shaken, noisy - bare)


def test_what_is_no_variation_is_refused() -> None:
    with pytest.raises(ValueError, match="no variation is called 'sparkle'; there are direction, "):
        mask("sparkle")


def test_wobble_has_the_size_it_is_asked_for() -> None:
    line = ideals.line((0, 0), (100, 0))
    bare = mask(*(name for name in NAMES if name != "wobble"))
    writer = replace(STEADY, wobble=0.02)
    drawn = draw([line] * 800, writer, np.random.default_rng(3), bare)
    across = np.concatenate([stroke.points[:, 1] for stroke in drawn])
    assert np.sqrt((across**2).mean()) == pytest.approx(0.02 * 100, rel=0.05)


def test_speed_follows_curvature_by_the_two_thirds_power_law() -> None:
    """In its extended form (Viviani and Stucchi 1992): on ellipses log speed against log(curvature + α) has the
    slope −1/3, once the slow rise and fall of the strokelet's own bell is taken out by a polynomial in time."""
    quiet = mask(*(name for name in NAMES if name not in ("kinematics", "rounding")))
    slopes: list[float] = []
    for seed, aspect in enumerate((1.4, 1.6, 1.8, 2.0) * 5):
        ellipse = ideals.superellipse((0, 0), (60 * aspect, 60), start=0.31 * seed, sweep=4 * np.pi)
        (stroke,) = draw([ellipse], replace(STEADY, speed=2.0), np.random.default_rng(seed), quiet)
        assert stroke.times is not None
        step = np.diff(stroke.points, axis=0)
        speed = np.linalg.norm(step, axis=1) / np.diff(stroke.times)
        middle = (stroke.points[1:] + stroke.points[:-1]) / 2
        angle = np.arctan2(middle[:, 1] / 60, middle[:, 0] / (60 * aspect))
        curvature = aspect / (aspect**2 * np.sin(angle) ** 2 + np.cos(angle) ** 2) ** 1.5 / 60
        straight = LEAST_BEND / (120 * np.hypot(aspect, 1))
        inner = slice(len(speed) // 6, -len(speed) // 6)
        bell = np.vander(np.linspace(-1, 1, len(speed))[inner], 6)
        sides = np.column_stack([np.log(curvature[inner] + straight), bell])
        slopes.append(float(np.linalg.lstsq(sides, np.log(speed[inner]), rcond=None)[0][0]))
    # The pen takes curvature over ± 4 of its points, which blunts the ends of an ellipse by a tenth.
    assert -0.36 < np.mean(slopes) < -0.26


def test_a_hand_with_tremor_swings_at_4_to_12_hertz_more_than_others() -> None:
    def swinging(profile: str) -> float:
        """Share of the speed's variance within 4 to 12 Hz."""
        shares: list[float] = []
        rng = np.random.default_rng(8)
        for _ in range(60):
            writer = replace(sample_writer(rng, profile), rate=100.0, speed=1.5, grid=0.0, jitter=0.0)
            (stroke,) = draw([ideals.line((0, 0), (300, 20))], writer, rng)
            across = np.diff(stroke.points[:, 1])
            assert stroke.times is not None
            power = np.abs(np.fft.rfft(across - across.mean())) ** 2
            frequency = np.fft.rfftfreq(len(across), float(stroke.times[1]))
            shares.append(float(power[(frequency >= 4) & (frequency <= 12)].sum() / 300**2))
        return float(np.median(shares))

    assert swinging("tremor") > 10 * swinging("adult")


@pytest.mark.parametrize("profile", [name for name in PROFILES if name != "adult"])
def test_a_group_differs_from_adults_where_it_says_so_and_nowhere_else(profile: str) -> None:
    rng = np.random.default_rng(1)
    people = [sample_writer(rng, profile) for _ in range(1500)]
    adults = [sample_writer(rng, "adult") for _ in range(1500)]
    for habit in ADULT:
        there, here = ([getattr(one, habit) for one in some] for some in (people, adults))
        alike = ks_2samp(there, here).pvalue
        assert (alike > 1e-5) == (PROFILES[profile][habit] == ADULT[habit]), habit


def test_a_group_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="no group of writers is called 'martian'; there are adult"):
        sample_writer(np.random.default_rng(0), "martian")
