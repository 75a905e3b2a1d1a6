"""Closed-form motions, through the public `simulate`, at 60 frames a second."""

from __future__ import annotations

from itertools import pairwise
from math import cos, pi, sin, sqrt, tan

import numpy as np
import pytest
from physics_scenes import (
    G,
    box,
    disc,
    floor,
    hanging,
    incline,
    on_incline,
    pendulum,
    supported,
)
from scipy.special import ellipj, ellipk

from physics.engine import simulate
from physics.formula.program import STATE, Program, constant
from physics.scene import Anchor, Force, Material, Scene, SpringLink
from physics.trajectory import Trajectory


def mechanical(trajectory: Trajectory) -> np.ndarray:
    energy = trajectory.energy
    return energy.kinetic + energy.potential + energy.elastic


def test_a_projectile_follows_its_parabola() -> None:
    moved = simulate(Scene((disc("A", 0, 0, velocity=(3.0, 4.0, 0.0)),)), 3)
    t = moved.times
    wanted = np.column_stack([3 * t, 4 * t - G / 2 * t**2])
    assert np.abs(moved.path("A") - wanted).max() < 1e-11


@pytest.mark.parametrize("degrees", [10, 30, 45, 60])
def test_on_a_smooth_incline_the_way_is_half_g_sin_theta_t_squared(degrees: float) -> None:
    angle = np.radians(degrees)
    start, down, ball = on_incline(angle)
    moved = simulate(Scene((incline(angle), ball)), 1)
    way = (moved.path("ball") - start) @ down
    assert np.abs(way - 0.5 * G * sin(angle) * moved.times**2).max() < 1e-12
    assert np.abs((moved.path("ball") - start) @ (down[1], -down[0])).max() < 1e-12


def test_a_box_slides_down_a_rough_incline_with_g_sin_theta_minus_mu_cos_theta() -> None:
    angle, mu = pi / 6, 0.3
    slope = Material(friction=mu)
    down = (cos(angle), -sin(angle))
    up = (sin(angle), cos(angle))
    place = np.array([0.0, 6 * sin(angle)]) + np.array(down) + 0.2 * np.array(up)
    level = box("box", place[0], place[1], 0.6, 0.4)
    tilted = type(level)(level.label, level.shape, level.position, level.mass, level.inertia, -angle)
    moved = simulate(Scene((incline(angle, material=slope), tilted)), 1)
    way = (moved.path("box") - place) @ down
    assert np.abs(way - 0.5 * G * (sin(angle) - mu * cos(angle)) * moved.times**2).max() < 1e-8


def test_a_rough_incline_holds_a_box_without_creep_where_mu_exceeds_tan_theta() -> None:
    angle = pi / 6
    slope = Material(friction=1.01 * tan(angle))
    place = (
        np.array([0.0, 6 * sin(angle)]) + (cos(angle), -sin(angle)) + 0.2 * np.array([sin(angle), cos(angle)])
    )
    level = box("box", place[0], place[1], 0.6, 0.4)
    tilted = type(level)(level.label, level.shape, level.position, level.mass, level.inertia, -angle)
    moved = simulate(Scene((incline(angle, material=slope), tilted)), 5)
    assert np.abs(moved.poses - moved.poses[0]).max() < 1e-9


def test_a_disc_rolls_down_a_rough_incline_with_two_thirds_of_g_sin_theta() -> None:
    angle = pi / 6
    start, down, ball = on_incline(angle)
    moved = simulate(Scene((incline(angle, material=Material(friction=0.5)), ball)), 1)
    way = (moved.path("ball") - start) @ down
    assert np.abs(way - G * sin(angle) / 3 * moved.times**2).max() < 1e-11
    spin = moved.velocities[:, moved.column("ball"), 2]
    assert np.abs(spin * 0.25 + moved.speed("ball")).max() < 1e-11


@pytest.mark.parametrize(("angle", "tolerance"), [(0.05, 2e-5), (0.8, 2e-4), (1.5, 8e-4)])
def test_a_pendulum_swings_as_the_elliptic_functions_say(angle: float, tolerance: float) -> None:
    moved = simulate(pendulum(angle), 10)
    k = sin(angle / 2)
    wanted = 2 * np.arcsin(k * ellipj(ellipk(k * k) - sqrt(G) * moved.times, k * k)[0])
    path = moved.path("bob")
    assert np.abs(np.arctan2(path[:, 0], -path[:, 1]) - wanted).max() < tolerance
    assert np.abs(np.hypot(*path.T) - 1).max() < 1e-12
    depth = G * (1 - cos(angle))
    assert np.ptp(mechanical(moved)) < 1e-3 * depth


def test_the_tension_of_a_pendulum_is_m_g_times_3_cos_theta_minus_2_cos_theta_0() -> None:
    moved = simulate(pendulum(0.8), 3)
    angle = np.arctan2(moved.path("bob")[:, 0], -moved.path("bob")[:, 1])
    tension = next(force for force in moved.forces if force.name == "T of wire" and force.body == "bob")
    wanted = G * (3 * np.cos(angle) - 2 * cos(0.8))
    assert np.abs(np.hypot(*tension.values.T) - wanted).max() < 2e-3 * G


@pytest.mark.parametrize("stiffness", [5.0, 50.0, 5000.0])
def test_a_mass_on_a_spring_swings_harmonically_and_keeps_its_energy(stiffness: float) -> None:
    spring = SpringLink("S", Anchor("A", (0, 0)), Anchor(None, (0, 0)), 1.0, stiffness)
    moved = simulate(Scene((disc("A", 1.2, 0),), springs=(spring,), gravity=(0, 0)), 10)
    wanted = 1 + 0.2 * np.cos(sqrt(stiffness) * moved.times)
    phase = sqrt(stiffness) * 10 * 0.05**2 / 24
    assert np.abs(moved.path("A")[:, 0] - wanted).max() < 0.2 * 1.2 * phase + 1e-9
    assert np.ptp(mechanical(moved)) < 1e-3 * 0.5 * stiffness * 0.2**2


def test_a_hanging_mass_swings_about_m_g_over_k_below() -> None:
    spring = SpringLink("S", Anchor("A", (0, 0)), Anchor(None, (0, 0)), 1.0, 40.0)
    moved = simulate(Scene((disc("A", 0, -1.0),), springs=(spring,)), 2)
    wanted = -1 - G / 40 * (1 - np.cos(sqrt(40) * moved.times))
    assert np.abs(moved.path("A")[:, 1] - wanted).max() < 1e-3
    assert np.abs(moved.path("A")[:, 0]).max() == 0


@pytest.mark.parametrize("e", [0.0, 0.3, 1.0])
def test_a_central_impact_follows_newton_and_keeps_momentum(e: float) -> None:
    bodies = (
        disc("A", -1, 0, mass=1, velocity=(2.0, 0, 0), material=Material(e)),
        disc("B", 1, 0, mass=3, velocity=(-1.0, 0, 0), material=Material(e)),
    )
    moved = simulate(Scene(bodies, gravity=(0, 0)), 2)
    common = (1 * 2 - 3 * 1) / 4
    assert moved.velocities[-1, 0, 0] == pytest.approx(common - e * 3 * 3 / 4, abs=1e-12)
    assert moved.velocities[-1, 1, 0] == pytest.approx(common + e * 3 * 1 / 4, abs=1e-12)
    assert [event.kind for event in moved.events if event.kind == "impact"] == ["impact"]


def test_an_oblique_elastic_impact_exchanges_the_velocity_along_the_line_of_centres() -> None:
    bodies = (disc("A", -1, 0.1, velocity=(2.0, 0, 0), material=Material(1.0)), disc("B", 0, 0))
    moved = simulate(Scene(bodies, gravity=(0, 0)), 2)
    normal = np.array([sqrt(0.25 - 0.01), -0.1]) / 0.5
    along = 2 * normal[0] * normal
    assert np.abs(moved.velocities[-1, 1, :2] - along).max() < 1e-6
    assert np.abs(moved.velocities[-1, 0, :2] - ((2, 0) - along)).max() < 1e-6


def test_a_ball_bounces_to_e_squared_of_its_height_each_time() -> None:
    e = 0.8
    moved = simulate(Scene((disc("A", 0, 1.25), floor(Material(e)))), 3, 600)
    height = moved.path("A")[:, 1] - 0.25
    hits = [event.time for event in moved.events if event.kind == "impact"]
    fall = sqrt(2 / G)
    assert hits[0] == pytest.approx(fall, abs=1e-9)
    assert hits[1] == pytest.approx(fall * (1 + 2 * e), abs=1e-8)
    for n, (start, end) in enumerate(pairwise(hits[:4]), start=1):
        top = height[(moved.times > start) & (moved.times < end)].max()
        assert top == pytest.approx(e ** (2 * n), abs=2e-5)


def test_a_bouncing_ball_comes_to_rest() -> None:
    moved = simulate(Scene((disc("A", 0, 0.75), floor(Material(0.3)))), 3)
    assert abs(moved.poses[-1, 0, 1] - 0.25) < 1e-6
    assert np.abs(moved.velocities[-1]).max() < 1e-9
    assert [event.bodies for event in moved.events if event.kind == "rest"] == [("A",)]


def test_two_wires_at_45_degrees_carry_m_g_over_root_2_each_and_nothing_moves() -> None:
    moved = simulate(hanging(None, None), 10)
    assert np.abs(moved.poses - moved.poses[0]).max() < 1e-9
    for wire in ("T of left", "T of right"):
        force = next(force for force in moved.forces if force.name == wire)
        assert np.abs(np.hypot(*force.values.T) - 5 * sqrt(2)).max() < 1e-9


def test_a_stack_of_ten_boxes_stays_and_each_carries_what_is_above() -> None:
    boxes = [box(f"B{i}", 0.01 * (i % 2), 0.2 + 0.4 * i, 0.6, 0.4) for i in range(10)]
    moved = simulate(Scene((floor(), *boxes)), 3)
    assert np.abs(moved.poses - moved.poses[0]).max() < 1e-9
    for i in range(1, 10):
        force = next(f for f in moved.forces if f.body == f"B{i}" and f.name == f"contact with B{i - 1}")
        assert force.values[-1, 1] == pytest.approx((10 - i) * G, rel=1e-9)


def test_a_given_support_that_is_right_rolls_the_ball_with_a_straight_speed() -> None:
    angle = pi / 6
    moved = simulate(supported(angle, 1.0), 1.2)
    assert np.abs(moved.speed("ball") - G * sin(angle) * moved.times).max() < 1e-9
    assert not moved.events


def test_a_given_support_that_is_too_small_lets_the_ball_sink_and_bounce_and_one_too_great_lifts_it() -> None:
    angle = pi / 6
    start, down, _ = on_incline(angle)
    up = (-down[1], down[0])
    low = simulate(supported(angle, 0.9), 1.2)
    kinds = {event.kind for event in low.events}
    rise = (low.path("ball") - start) @ up
    assert kinds == {"bounce"}
    assert -0.032 < rise.min() < -0.028
    assert rise.max() < 2e-3
    high = simulate(supported(angle, 1.1), 1.2)
    rise = (high.path("ball") - start) @ up
    assert [event.kind for event in high.events] == ["lift-off"]
    assert np.abs(rise - 0.5 * 0.1 * G * cos(angle) * high.times**2).max() < 1e-9


def test_right_tensions_hold_the_box_and_wrong_ones_move_it_and_break_a_wire() -> None:
    right = 5 * sqrt(2)
    held = simulate(hanging(right, right), 10)
    assert np.abs(held.poses - held.poses[0]).max() < 1e-6
    assert not held.events
    for tensions in ((6, right), (right, 6), (6, 6), (8, 8), (right, 8)):
        moved = simulate(hanging(*tensions), 2)
        assert np.abs(moved.path("box") - moved.path("box")[0]).max() > 0.05
        broken = [event for event in moved.events if event.kind == "break"]
        assert broken
        gone = moved.times > broken[0].time + 1 / 60
        assert np.isnan(moved.anchors[broken[0].bodies[0]][gone]).all()


def test_a_force_linear_in_time_gives_a_cubic_way() -> None:
    # F = 6 t: read t, times 6.
    program = Program("6 t", (("read", float(STATE.index("t"))), ("push", 6.0), ("multiply", 0.0)))
    scene = Scene((disc("A", 0, 0),), forces=(Force("F", "A", program, constant(0)),), gravity=(0, 0))
    moved = simulate(scene, 2)
    assert np.abs(moved.velocities[:, 0, 0] - 3 * moved.times**2).max() < 1e-12
    assert np.abs(moved.path("A")[:, 0] - moved.times**3).max() < 1e-4
    assert np.abs(moved.energy.worked - moved.energy.kinetic).max() < 1e-9


def test_a_formula_without_a_value_stops_the_run_and_is_named() -> None:
    # F = 1 / (1 − t): no value at t = 1.
    code = (("push", 1.0), ("read", 0.0), ("push", -1.0), ("multiply", 0.0), ("add", 0.0), ("sqrt", 0.0))
    program = Program("sqrt(1 - t)", code)
    scene = Scene((disc("A", 0, 0),), forces=(Force("F_2", "A", program, constant(0)),), gravity=(0, 0))
    moved = simulate(scene, 2)
    stopped = [event for event in moved.events if event.kind == "stopped"]
    assert len(stopped) == 1
    assert "F_2" in stopped[0].message
    assert "sqrt(1 - t)" in stopped[0].message
    assert stopped[0].time == pytest.approx(1.0, abs=0.01)
    assert np.isfinite(moved.poses).all()
    assert len(moved.times) == 121
    assert np.all(moved.poses[62:] == moved.poses[61])


def test_a_slack_wire_lets_its_body_fall_freely_and_catches_it_without_a_rebound() -> None:
    scene = pendulum(0.0)
    bob = disc("bob", 0.0, -0.5, 0.05)
    moved = simulate(Scene((bob,), wires=scene.wires), 2)
    fall = sqrt(2 * 0.5 / G)
    before = moved.times < fall
    assert np.abs(moved.path("bob")[before, 1] + 0.5 + G / 2 * moved.times[before] ** 2).max() < 1e-12
    assert np.abs(moved.path("bob")[moved.times > fall + 0.05, 1] + 1).max() < 1e-9
    assert [event.kind for event in moved.events if event.kind in ("slack", "taut")] == ["slack", "taut"]
