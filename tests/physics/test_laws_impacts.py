"""Closed forms of impacts: momentum, restitution, bounces, rest, cradles.

Errors are shares of the size of the quantity unless they are times, which are in seconds.
"""

from __future__ import annotations

from dataclasses import replace
from math import acos, cos, pi, sqrt

import numpy as np
import pytest
from physics_scenes import G, angles, box, disc, events, floor, ledger, mechanical, off, pendulum, wire
from scipy.special import ellipk

from physics.engine import simulate
from physics.scene import Material, Scene

WEIGHTLESS = (0.0, 0.0)

# Two bodies -------------------------------------------------------------------------------------


@pytest.mark.parametrize("e", [0.0, 0.3, 0.77, 1.0])
@pytest.mark.parametrize("mass", [0.01, 1.0, 3.0, 1000.0])
def test_a_central_impact_follows_newton_and_keeps_momentum(e: float, mass: float) -> None:
    bodies = (
        disc("A", -1, 0, mass=1, velocity=(2.0, 0, 0), material=Material(e)),
        disc("B", 1, 0, mass=mass, velocity=(-1.0, 0, 0), material=Material(e)),
    )
    moved = simulate(Scene(bodies, gravity=WEIGHTLESS), 1)
    common = (2 - mass) / (1 + mass)
    after = np.array([common - 3 * e * mass / (1 + mass), common + 3 * e / (1 + mass)])
    assert off(moved.velocities[-1, :, 0], after, 3.0) < 1e-13
    assert [event.time for event in events(moved, "impact")] == [pytest.approx(0.5, abs=1e-13)]
    assert off(moved.path("A")[-1], np.array([0.5 * after[0], 0.0]), 1.0) < 1e-12
    lost = 0.5 * mass / (1 + mass) * 9 * (1 - e**2)
    assert off(moved.energy.dissipated[-1], lost, 4.5) < 1e-12


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("mass", [0.5, 1.0, 4.0])
def test_an_oblique_impact_changes_the_velocity_along_the_line_of_centres_alone(
    e: float, mass: float
) -> None:
    # J = (1 + e) v·n m₁m₂/(m₁ + m₂).
    bodies = (
        disc("A", -1, 0.1, velocity=(2.0, 0, 0), material=Material(e)),
        disc("B", 0, 0, mass=mass),
    )
    moved = simulate(Scene(bodies, gravity=WEIGHTLESS), 1)
    normal = np.array([sqrt(0.5**2 - 0.1**2), -0.1]) / 0.5
    push = (1 + e) * 2 * normal[0] * mass / (1 + mass) * normal
    assert off(moved.velocities[-1, 1, :2], push / mass, 2.0) < 1e-12
    assert off(moved.velocities[-1, 0, :2], np.array([2.0, 0.0]) - push, 2.0) < 1e-12
    assert not moved.velocities[:, :, 2].any()


@pytest.mark.parametrize(("e", "friction"), [(1.0, 0.1), (0.5, 0.2), (0.0, 0.3), (0.5, 1.0), (1.0, 0.0)])
def test_a_disc_that_strikes_a_rough_wall_slides_or_rolls_off_it_as_coulomb_says(
    e: float, friction: float
) -> None:
    # Sliding, the impulse along the wall is μ(1 + e) m vₙ; it ends where the disc rolls: v_t − J/m = −ωr.
    # J (1/m + r²/I) = 3 J/m takes v_t, thus J ≤ m v_t/3.
    into, along, radius = 2.0, 3.0, 0.25
    wall = box("wall", 0.5, 0, 1.0, 20.0, fixed=True, material=Material(e, friction))
    ball = disc("A", -1.25, 0.0, radius, velocity=(into, along, 0.0))
    moved = simulate(Scene((ball, wall), gravity=WEIGHTLESS), 1)
    push = min(friction * (1 + e) * into, along / 3)
    assert off(moved.velocities[-1, 0, :2], np.array([-e * into, along - push]), along) < 1e-12
    # The wall drags back (down) the right side of a disc that goes up: clockwise.
    assert off(moved.velocities[-1, 0, 2], -push * radius / (0.5 * radius**2), along / radius) < 1e-12


def test_a_spinning_disc_jumps_off_a_rough_floor_along_it() -> None:
    radius, spin, fall = 0.25, 8.0, 2.0
    ball = disc("A", 0, 1.25, radius, velocity=(0, -fall, spin))
    moved = simulate(Scene((ball, floor(Material(1.0, 0.9))), gravity=WEIGHTLESS), 1)
    # Anti-clockwise, its lowest point moves to +x at ωr; friction stops it: v = −ωr/3, ω' = ω/3.
    assert off(moved.velocities[-1, 0], np.array([-spin * radius / 3, fall, spin / 3]), spin) < 1e-12


@pytest.mark.parametrize("e", [0.2, 0.4, 1.0])
def test_a_rod_struck_at_its_end_gets_the_spin_of_its_moment_of_inertia(e: float) -> None:
    # A disc strikes a smooth bar squarely at the distance d from its centre: J = (1+e) v / (1/m + 1/M + d²/I).
    bar = box("bar", 0.0, 0.0, 0.1, 2.0, mass=3.0, material=Material(e))
    d, speed = 0.8, 2.0
    moved = simulate(Scene((bar, disc("A", -1.3, d, velocity=(speed, 0, 0))), gravity=WEIGHTLESS), 0.8)
    push = (1 + e) * speed / (1 + 1 / 3 + d**2 / bar.inertia)
    after = moved.at(np.array([0.5 + 1e-6]))
    assert events(moved, "impact")[0].time == pytest.approx(0.5, abs=1e-12)
    assert off(after.velocities[0, 0], np.array([push / 3, 0, -push * d / bar.inertia]), speed) < 1e-12
    assert off(after.velocities[0, 1], np.array([speed - push, 0, 0]), speed) < 1e-12


def test_a_fast_bullet_does_not_pass_through_a_thin_wall() -> None:
    wall = box("wall", 0.0, 0, 1e-3, 1.0, fixed=True, material=Material(1.0))
    bullet = disc("bullet", -10.0, 0.0, 1e-3, velocity=(1000.0, 0, 0))
    moved = simulate(Scene((wall, bullet), gravity=WEIGHTLESS), 0.1)
    assert off(moved.velocities[-1, 1], np.array([-1000.0, 0.0, 0.0]), 1000.0) < 1e-13
    assert events(moved, "impact")[0].time == pytest.approx((10 - 1.5e-3) / 1000, abs=1e-12)


# Bounces ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("e", [0.3, 0.8, 0.9])
def test_a_ball_bounces_to_e_squared_of_its_height_each_time_and_rests_at_the_limit(e: float) -> None:
    # Falls for t₀ = √(2h/g), then flights of 2eⁿt₀: rest at t₀ (1 + e)/(1 − e), with m g h turned to heat.
    fall = sqrt(2 / G)
    end = fall * (1 + e) / (1 - e)
    moved = simulate(Scene((disc("A", 0, 1.25), floor(Material(e)))), end + 1)
    hits = [fall * (1 + 2 * sum(e**n for n in range(1, k + 1))) for k in range(6)]
    found = [event.time for event in events(moved, "impact")]
    assert found[:6] == pytest.approx(hits, rel=1e-10)
    tops = moved.at(np.array([hit + fall * e ** (k + 1) for k, hit in enumerate(hits)]))
    for k, height in enumerate(tops.path("A")[:, 1] - 0.25):
        assert height == pytest.approx(e ** (2 * k + 2), rel=1e-10, abs=1e-14)
    rest = events(moved, "rest")
    assert [event.bodies[0] for event in rest] == ["A"]
    assert rest[0].time == pytest.approx(end, rel=1e-10)
    still = moved.times > end
    assert off(moved.poses[still, 0, 1], 0.25, 1.0) < 1e-12
    assert not moved.velocities[still].any()
    assert moved.energy.dissipated[-1] == pytest.approx(G, rel=1e-10)


def test_an_elastic_ball_bounces_for_ever() -> None:
    fall = sqrt(2 / G)
    moved = simulate(Scene((disc("A", 0, 1.25), floor(Material(1.0)))), 20)
    phase = (moved.times + fall) % (2 * fall) - fall
    assert off(moved.path("A")[:, 1], 1.25 - G / 2 * phase**2, 1.0) < 1e-9
    assert len(events(moved, "impact")) == int((20 / fall + 1) / 2)
    assert not events(moved, "rest")


def test_without_any_word_of_it_restitution_is_one_half() -> None:
    moved = simulate(Scene((disc("A", 0, 1.25), floor())), 1)
    hits = [event.time for event in events(moved, "impact")]
    assert hits[1] - hits[0] == pytest.approx(hits[0], rel=1e-12)


def test_two_who_speak_of_restitution_meet_at_the_geometric_mean() -> None:
    bodies = (
        disc("A", -1, 0, velocity=(2.0, 0, 0), material=Material(0.25)),
        disc("B", 0, 0, material=Material(0.81)),
    )
    moved = simulate(Scene(bodies, gravity=WEIGHTLESS), 1)
    assert off(moved.velocities[-1, :, 0], np.array([1 - 0.45, 1 + 0.45]), 2.0) < 1e-13


def test_a_flat_box_that_falls_flat_bounces_flat_and_comes_to_rest_at_the_limit() -> None:
    e, fall = 0.5, sqrt(2 / G)
    moved = simulate(Scene((box("A", 0, 1.2, 0.6, 0.4), floor(Material(e, 0.5)))), 3)
    assert events(moved, "impact")[0].time == pytest.approx(fall, abs=1e-10)
    tops = moved.at(np.array([fall * (1 + e), fall * (1 + 2 * e + e**2)])).path("A")[:, 1] - 0.2
    assert tops == pytest.approx([e**2, e**4], rel=1e-9)
    assert off(moved.poses[:, 0, 2], 0.0, 1.0) < 1e-12
    assert [event.time for event in events(moved, "rest")] == [pytest.approx(3 * fall, rel=1e-9)]


# Ballistic pendulum -----------------------------------------------------------------------------


@pytest.mark.parametrize("mass", [0.2, 1.0, 5.0])
def test_a_ballistic_pendulum_rises_to_the_height_of_the_common_momentum(mass: float) -> None:
    # Two bobs side by side on equal wires swing as one: without rebound h' = (m/(m + M))² h, energy lost
    # m M/(m + M) g h; they take a quarter of the period of θ₁ = acos(1 − h'/L) from the impact to the top.
    start, heavy, r = 1.0, 2.0, 0.05
    height = 1 - cos(start)
    rise = (mass / (mass + heavy)) ** 2 * height
    top = acos(1 - rise)
    bodies = (
        replace(pendulum(-start, mass=mass).bodies[0], material=Material(0.0)),
        disc("hit", 2 * r, -1.0, r, heavy),
    )
    wires = (wire("left", "bob", (0, 0), 1.0), wire("right", "hit", (2 * r, 0), 1.0))
    impact = float(ellipk(np.sin(start / 2) ** 2)) / sqrt(G)
    peak = impact + float(ellipk(np.sin(top / 2) ** 2)) / sqrt(G)
    moved = simulate(Scene(bodies, wires=wires), peak + 0.1)
    assert events(moved, "impact")[0].time == pytest.approx(impact, abs=1e-9)
    at = moved.at(np.array([peak]))
    for label, pivot in (("bob", 0.0), ("hit", 2 * r)):
        x, y = at.path(label)[0] - (pivot, 0.0)
        assert np.arctan2(x, -y) == pytest.approx(top, rel=1e-9)
        assert off(at.speed(label), 0.0, sqrt(G)) < 1e-8
    lost = mass * heavy / (mass + heavy) * G * height
    assert at.energy.dissipated[0] == pytest.approx(lost, rel=1e-9)


@pytest.mark.parametrize("e", [0.6, 1.0])
def test_a_bullet_that_bounces_off_a_bob_lifts_it_by_what_it_gave(e: float) -> None:
    # V = (1 + e) m v/(m + M), h = V²/2g. The bullet is thrown so that it flies level when it strikes.
    m, heavy, v, flight = 0.1, 1.0, 20.0, 0.05
    x, y = -0.07 - v * flight, -1 - G * flight**2 / 2
    bullet = disc("bullet", x, y, 0.02, m, (v, G * flight, 0.0), Material(e))
    bob = disc("bob", 0.0, -1.0, 0.05, heavy)
    speed = (1 + e) * m * v / (m + heavy)
    top = acos(1 - speed**2 / (2 * G))
    peak = flight + float(ellipk(np.sin(top / 2) ** 2)) / sqrt(G)
    moved = simulate(Scene((bullet, bob), wires=pendulum(0.0).wires), peak + 0.1)
    assert angles(moved.at(np.array([peak])), "bob")[0] == pytest.approx(top, rel=1e-9)
    assert moved.velocities[-1, 0, 0] == pytest.approx((m - e * heavy) / (m + heavy) * v, rel=1e-9)


# Cradles ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("struck", [1, 2, 3, 4])
def test_as_many_discs_leave_a_row_as_strike_it(struck: int) -> None:
    speeds = [3.0] * struck + [0.0] * (5 - struck)
    row = [
        disc(f"B{k}", 0.5 * k - (0.6 if v else 0.0), 0, velocity=(v, 0, 0), material=Material(1.0))
        for k, v in enumerate(speeds)
    ]
    moved = simulate(Scene(tuple(row), gravity=WEIGHTLESS), 1)
    assert off(moved.velocities[-1, :, 0], np.array(speeds[::-1]), 3.0) < 1e-12
    assert not moved.velocities[-1, :, 1:].any()
    assert off(moved.path("B4")[-1, 0], 2.0 + 3.0 * 0.8, 3.0) < 1e-12


@pytest.mark.parametrize("raised", [1, 2])
def test_newtons_cradle_raises_on_the_other_side_as_many_bobs_to_the_same_angle(raised: int) -> None:
    start, r = 0.6, 0.05
    quarter = float(ellipk(np.sin(start / 2) ** 2)) / sqrt(G)
    bobs, wires = [], []
    for k in range(5):
        lean = -start if k < raised else 0.0
        x, y = 2 * r * k + np.sin(lean), -cos(lean)
        bobs.append(disc(f"B{k}", float(x), y, r, material=Material(1.0)))
        wires.append(wire(f"W{k}", f"B{k}", (2 * r * k, 0.0), 1.0))
    moved = simulate(Scene(tuple(bobs), wires=tuple(wires)), 4 * quarter)
    for quarters, leaning in ((2, range(5 - raised, 5)), (4, range(raised))):
        at = moved.at(np.array([quarters * quarter]))
        for k in range(5):
            x, y = at.path(f"B{k}")[0] - (2 * r * k, 0.0)
            lean = (start if quarters == 2 else -start) if k in leaning else 0.0
            assert np.arctan2(x, -y) == pytest.approx(lean, abs=1e-8 * start)


def test_a_disc_between_two_that_strike_it_at_one_moment_stays() -> None:
    bodies = tuple(
        disc(f"B{k}", x, 0, velocity=(v, 0, 0), material=Material(1.0))
        for k, (x, v) in enumerate([(-1.5, 2.0), (0.0, 0.0), (1.5, -2.0)])
    )
    moved = simulate(Scene(bodies, gravity=WEIGHTLESS), 1)
    assert off(moved.velocities[-1, :, 0], np.array([-2.0, 0.0, 2.0]), 2.0) < 1e-13
    assert off(moved.poses[:, 1], 0.0, 1.0) < 1e-13


def test_a_break_of_three_discs_is_shared_by_symmetry() -> None:
    # Head-on between two that touch each other: momentum and energy give v' = v/5 backward and
    # 2√3/5 v for each of the two, at 30° to the side.
    r, v = 0.25, 5.0
    bodies = (
        disc("A", -1.0 - 2 * r * cos(pi / 6), 0.0, r, velocity=(v, 0, 0), material=Material(1.0)),
        disc("B", 0.0, r, r, material=Material(1.0)),
        disc("C", 0.0, -r, r, material=Material(1.0)),
    )
    moved = simulate(Scene(bodies, gravity=WEIGHTLESS), 0.5)
    assert off(moved.velocities[-1, 0, :2], np.array([-v / 5, 0.0]), v) < 1e-12
    share = 2 * sqrt(3) / 5 * v
    for body, side in ((1, 1), (2, -1)):
        wanted = share * np.array([cos(pi / 6), side * 0.5])
        assert off(moved.velocities[-1, body, :2], wanted, v) < 1e-12


def test_an_elastic_crowd_in_a_box_keeps_its_energy() -> None:
    walls = (
        box("left", -2.5, 0, 1, 6, fixed=True),
        box("right", 2.5, 0, 1, 6, fixed=True),
        box("top", 0, 2.5, 6, 1, fixed=True),
        box("bottom", 0, -2.5, 6, 1, fixed=True),
    )
    discs = tuple(
        disc(
            f"B{k}",
            -1.2 + 0.8 * (k % 4),
            -0.8 + 0.8 * (k // 4),
            0.2,
            1 + 0.1 * k,
            (1.3 - 0.4 * k, 0.7 * k - 1.1, 0.0),
            Material(1.0),
        )
        for k in range(8)
    )
    moved = simulate(Scene((*walls, *discs), gravity=WEIGHTLESS), 5)
    assert off(mechanical(moved), mechanical(moved)[0], mechanical(moved)[0]) < 1e-11
    assert off(ledger(moved), ledger(moved)[0], ledger(moved)[0]) < 1e-11
    assert np.abs(moved.poses[:, 4:, :2]).max() < 1.8 + 1e-9
