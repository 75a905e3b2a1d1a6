"""Closed forms of wires, pulleys and pins: what they carry, when they go slack, when they break.

Errors are shares of the size of the quantity unless they are times, which are in seconds.
"""

from __future__ import annotations

from math import acos, cos, hypot, pi, sin, sqrt

import numpy as np
import pytest
from physics_scenes import (
    G,
    T,
    angles,
    atwood,
    box,
    chain,
    disc,
    events,
    force,
    hanging,
    ledger,
    mechanical,
    off,
    pendulum,
    size_of,
    stays,
    way,
    wire,
)
from scipy.integrate import quad, solve_ivp
from scipy.special import ellipkinc

from physics.engine import simulate
from physics.scene import Anchor, Material, Pulley, Scene, WireLink

# Statics ----------------------------------------------------------------------------------------


def test_two_wires_at_45_degrees_carry_m_g_over_root_2_each_and_nothing_moves() -> None:
    moved = simulate(hanging(None, None), 10)
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-12
    for name, side in (("T of left", -1), ("T of right", 1)):
        assert off(moved.force(name, "box").values, np.array([5.0 * side, 5.0]), 10.0) < 1e-12


@pytest.mark.parametrize(("left", "right"), [(30, 60), (10, 75), (20, 20), (70, 5)])
def test_two_wires_carry_what_lami_says(left: float, right: float) -> None:
    # T₁ / sin β = T₂ / sin α = W / sin(α + β), angles from the vertical.
    a, b = np.radians([left, right])
    scene = Scene(
        (disc("bob", 0, 0, 0.1, mass=2.0),),
        wires=(
            wire("left", "bob", (-sin(a), cos(a)), 1.0),
            wire("right", "bob", (1.5 * sin(b), 1.5 * cos(b)), 1.5),
        ),
    )
    moved = simulate(scene, 5)
    weight = 2 * G
    assert off(size_of(moved, "T of left", "bob"), weight * sin(b) / sin(a + b), weight) < 1e-12
    assert off(size_of(moved, "T of right", "bob"), weight * sin(a) / sin(a + b), weight) < 1e-12
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-12


def test_a_hanging_chain_carries_at_each_wire_what_hangs_below() -> None:
    moved = simulate(chain((0.0,) * 8), 2)
    for n in range(8):
        assert off(size_of(moved, f"T of W{n}", f"B{n}"), (8 - n) * G, 8 * G) < 1e-12
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-12


# Pulleys ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("left", "right"), [(1.0, 2.0), (5.0, 1.0), (1.0, 1.001)])
def test_an_atwood_machine_falls_with_the_difference_over_the_sum_of_its_masses(
    left: float, right: float
) -> None:
    moved = simulate(atwood(left, right), 0.6)
    fall = G * (left - right) / (left + right)
    gone = -fall * moved.times**2 / 2
    assert off(way(moved, "A", np.array([0.0, 1.0])), gone, np.abs(gone).max()) < 1e-10
    assert off(way(moved, "B", np.array([0.0, 1.0])), -gone, np.abs(gone).max()) < 1e-10
    assert off(moved.path("A")[:, 0], -0.3, 1.0) < 1e-12
    tension = 2 * left * right * G / (left + right)
    for body in ("A", "B"):
        wanted = np.array([0.0, tension])
        assert off(moved.force("T of wire", body).values, wanted, tension) < 1e-10


def test_an_even_atwood_machine_stays() -> None:
    assert off(simulate(atwood(2.0, 2.0), 5).poses, simulate(atwood(2.0, 2.0), 0).poses[0], 1.0) < 1e-12


def test_an_even_atwood_machine_goes_on_at_the_speed_that_it_has() -> None:
    scene = atwood(2.0, 2.0)
    wheel, a, b = scene.bodies
    pushed = (
        wheel,
        disc("A", *a.position, 0.1, 2.0, (0, 0.5, 0)),
        disc("B", *b.position, 0.1, 2.0, (0, -0.5, 0)),
    )
    moved = simulate(Scene(pushed, wires=scene.wires), 2)
    assert off(way(moved, "A", np.array([0.0, 1.0])), 0.5 * moved.times, 1.0) < 1e-12


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_load_over_the_edge_of_a_table_pulls_a_block_against_friction(friction: float) -> None:
    # a = g (M − μ m) / (M + m), T = m M g (1 + μ) / (M + m).
    block, load = 2.0, 1.5
    bodies = (
        box("table", -5.0, -0.5, 10.0, 1.0, fixed=True, material=Material(friction=friction)),
        box("block", -4.0, 0.1, 0.6, 0.2, block),
        disc("wheel", 0.5, -0.2, 0.3, fixed=True),
        disc("load", 0.8, -1.0, 0.1, load),
    )
    rest = 4.2 + 0.3 * pi / 2 + 0.8
    over = Pulley("wheel", clockwise=True)
    rope = WireLink("rope", Anchor("block", (0.3, 0.0)), Anchor("load", (0.0, 0.0)), rest, over=over)
    moved = simulate(Scene(bodies, wires=(rope,)), 1)
    rate = G * (load - friction * block) / (block + load)
    gone = rate * moved.times**2 / 2
    assert off(way(moved, "block", np.array([1.0, 0.0])), gone, gone[-1]) < 1e-10
    assert off(way(moved, "load", np.array([0.0, -1.0])), gone, gone[-1]) < 1e-10
    tension = block * load * G * (1 + friction) / (block + load)
    for body in ("block", "load"):
        assert off(size_of(moved, "T of rope", body), tension, tension) < 1e-10


# Slack and taut ---------------------------------------------------------------------------------


@pytest.mark.parametrize("square", [2.2, 2.5, 3.5, 4.5, 4.99])
def test_a_loop_on_a_wire_below_v_squared_5gL_leaves_the_circle_where_tension_ends(square: float) -> None:
    # T/m = v₀²/L − 2g + 3g cos φ, none at cos φ = (2 − v₀²/gL)/3. There v² = −gL cos φ; the parabola meets
    # the circle again after 4 v sin φ / g, where the speed along the wire is lost.
    length = 0.8
    speed = sqrt(square * G * length)
    top = acos((2 - square) / 3)
    left = quad(lambda a: length / sqrt(speed**2 - 2 * G * length * (1 - cos(a))), 0, top, epsabs=1e-14)[0]
    v = sqrt(-G * length * cos(top))
    back = left + 4 * v * sin(top) / G
    moved = simulate(pendulum(0.0, length, speed=speed), back + 0.1)

    slack, taut = events(moved, "slack")[0], events(moved, "taut")[0]
    assert slack.time == pytest.approx(left, abs=1e-9)
    at = moved.at(np.array([slack.time])).path("bob")[0] / length
    assert np.arctan2(at[0], -at[1]) == pytest.approx(top, abs=1e-9)

    flight = (moved.times > left) & (moved.times < back)
    t = moved.times[flight] - left
    x = length * sin(top) + v * cos(top) * t
    y = -length * cos(top) + v * sin(top) * t - G * t**2 / 2
    assert off(moved.path("bob")[flight], np.column_stack([x, y]), length) < 1e-9
    tension = size_of(moved, "T of wire", "bob")
    assert not tension[flight].any()
    swings = moved.times < left
    height = moved.path("bob")[swings, 1] / length  # −cos φ
    pull = (square - 2 - 3 * height) * G
    assert off(tension[swings], pull, G) < 1e-8

    assert taut.time == pytest.approx(back, abs=1e-9)
    flown = back - left
    place = np.array(
        [
            length * sin(top) + v * cos(top) * flown,
            -length * cos(top) + v * sin(top) * flown - G * flown**2 / 2,
        ]
    )
    velocity = np.array([v * cos(top), v * sin(top) - G * flown])
    lost = 0.5 * (velocity @ place / length) ** 2
    total = mechanical(moved)
    scale = 0.5 * speed**2
    assert off(total[moved.times < back], total[0], scale) < 1e-9
    assert off(total[moved.times > back], total[0] - lost, scale) < 1e-9
    assert off(np.hypot(*moved.path("bob")[moved.times > back].T), length, length) < 1e-8


@pytest.mark.parametrize("square", [0.5, 1.999, 5.0001, 8.0])
def test_a_loop_on_a_wire_keeps_taut_below_v_squared_2gL_and_above_5gL(square: float) -> None:
    moved = simulate(pendulum(0.0, speed=sqrt(square * G)), 3)
    assert not moved.events
    assert off(np.hypot(*moved.path("bob").T), 1.0, 1.0) < 1e-8
    cosine = -moved.path("bob")[:, 1]
    assert off(size_of(moved, "T of wire", "bob"), G * (square - 2 + 3 * cosine), G * (square + 1)) < 1e-7


def test_a_slack_wire_lets_its_body_fall_freely_and_catches_it_without_a_rebound() -> None:
    bob = disc("bob", 0.0, -0.5, 0.05)
    moved = simulate(Scene((bob,), wires=pendulum(0.0).wires), 2)
    fall = sqrt(2 * 0.5 / G)
    before = moved.times < fall
    assert off(moved.path("bob")[before, 1], -0.5 - G / 2 * moved.times[before] ** 2, 0.5) < 1e-12
    assert off(moved.path("bob")[~before, 1], -1.0, 1.0) < 1e-12
    assert off(moved.velocities[~before], 0.0, sqrt(G)) < 1e-12
    assert [event.time for event in events(moved, "taut")] == [pytest.approx(fall, abs=1e-12)]
    assert moved.energy.dissipated[-1] == pytest.approx(G / 2, rel=1e-12)


def test_a_wire_that_tautens_between_two_free_bodies_leaves_them_their_common_velocity() -> None:
    bodies = (disc("A", 0, 0, 0.1, 2.0), disc("B", 0.5, 0, 0.1, 1.0, (3.0, 0.5, 0)))
    moved = simulate(Scene(bodies, wires=(wire("wire", "A", "B", 1.0),), gravity=(0, 0)), 0.5)
    # |(0.5 + 3 t, 0.5 t)| = 1; then the parts along the wire become one, those across it stay.
    time = (-1.5 + sqrt(1.5**2 + 9.25 * 0.75)) / 9.25
    along = np.array([0.5 + 3 * time, 0.5 * time])
    jerk = 2 * 1 / 3 * (along @ (3.0, 0.5)) * along
    after = moved.at(np.array([time + 1e-9]))
    assert [event.time for event in events(moved, "taut")] == [pytest.approx(time, abs=1e-12)]
    assert off(after.velocities[0, 0, :2], jerk / 2, 3.0) < 1e-7
    assert off(after.velocities[0, 1, :2], np.array([3.0, 0.5]) - jerk, 3.0) < 1e-7
    momentum = 2 * moved.velocities[:, 0, :2] + moved.velocities[:, 1, :2]
    assert off(momentum, np.array([3.0, 0.5]), 3.0) < 1e-12


# Breaking ---------------------------------------------------------------------------------------


def test_a_wire_breaks_when_a_growing_force_reaches_its_limit() -> None:
    # T = m g + k t reaches the limit at (limit − m g)/k; then y'' = −g − k t/m.
    growth, limit, mass = 7.0, 30.0, 2.0
    scene = pendulum(0.0, mass=mass, limit=limit)
    moved = simulate(Scene(scene.bodies, wires=scene.wires, forces=(force("F", "bob", 0, -growth * T),)), 2.2)
    time = (limit - mass * G) / growth
    assert [event.time for event in events(moved, "break")] == [pytest.approx(time, abs=1e-9)]
    assert events(moved, "break")[0].bodies[0] == "wire"
    t = moved.times[moved.times > time]
    fallen = G * (t - time) ** 2 / 2 + growth / mass * (t**3 / 6 - time**2 * t / 2 + time**3 / 3)
    assert off(moved.path("bob")[moved.times > time, 1], -1 - fallen, fallen.max()) < 1e-9
    assert off(moved.path("bob")[moved.times < time], np.array([0.0, -1.0]), 1.0) < 1e-12
    assert np.isnan(moved.anchors["wire"][moved.times > time]).all()


@pytest.mark.parametrize(("angle", "limit"), [(1.2, 20.0), (1.5, 28.0), (0.6, 11.0)])
def test_a_pendulum_breaks_its_wire_at_the_angle_of_its_limit_and_flies_a_parabola(
    angle: float, limit: float
) -> None:
    # m g (3 cos θ − 2 cos θ₀) = limit; the time is (K(k) − F(asin(sin(θ/2)/k), k)) √(L/g), k = sin(θ₀/2).
    at = acos((limit / G + 2 * cos(angle)) / 3)
    square = sin(angle / 2) ** 2
    fraction = np.arcsin(sin(at / 2) / sin(angle / 2))
    time = (ellipkinc(pi / 2, square) - ellipkinc(fraction, square)) / sqrt(G)
    moved = simulate(pendulum(angle, limit=limit), time + 1)
    assert [event.time for event in events(moved, "break")] == [pytest.approx(time, abs=1e-9)]
    speed = sqrt(2 * G * (cos(at) - cos(angle)))
    after = moved.times > time
    t = moved.times[after] - time
    wanted = np.column_stack([sin(at) - speed * cos(at) * t, -cos(at) - speed * sin(at) * t - G * t**2 / 2])
    assert off(moved.path("bob")[after], wanted, np.abs(wanted).max()) < 1e-9


def test_a_wire_breaks_at_once_where_it_cannot_hold_the_weight() -> None:
    for limit, holds in ((0.999 * G, False), (1.001 * G, True)):
        moved = simulate(pendulum(0.0, limit=limit), 1)
        assert stays(moved, "bob") == holds
        assert bool(events(moved, "break")) != holds


# Several links ----------------------------------------------------------------------------------


def test_small_swings_of_a_double_pendulum_are_its_two_normal_modes() -> None:
    # Equal bobs and wires: ω² = (2 ∓ √2) g/L with the angles as 1 : ±√2, up to the angle squared.
    small = 1e-4
    for sign in (1, -1):
        rate = sqrt(G * (2 - sign * sqrt(2)))
        moved = simulate(chain((small, sign * sqrt(2) * small)), 2)
        wanted = small * np.cos(rate * moved.times)
        assert off(moved.path("B0")[:, 0], wanted, small) < 5e-6


def double_pendulum(angle: tuple[float, float], times: np.ndarray) -> np.ndarray:
    """θ₁ and θ₂ of equal bobs on equal wires, (2, T), from Lagrange's equations by DOP853:
    2 θ₁'' + θ₂'' cos δ = −θ₂'² sin δ − 2g sin θ₁; θ₁'' cos δ + θ₂'' = θ₁'² sin δ − g sin θ₂; δ = θ₁ − θ₂."""

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        a, b, va, vb = state
        c, s = cos(a - b), sin(a - b)
        matrix = np.array([[2, c], [c, 1]])
        right = np.array([-(vb**2) * s - 2 * G * sin(a), va**2 * s - G * sin(b)])
        return np.concatenate([[va, vb], np.linalg.solve(matrix, right)])

    span = (0.0, float(times[-1]))
    return solve_ivp(rates, span, [*angle, 0, 0], "DOP853", times, rtol=1e-12, atol=1e-13).y[:2]


def test_a_double_pendulum_moves_as_lagrange_says() -> None:
    moved = simulate(chain((0.6, -0.3)), 5)
    first, second = double_pendulum((0.6, -0.3), moved.times)
    assert off(angles(moved, "B0"), first, 0.6) < 1e-7
    between = moved.path("B1") - moved.path("B0")
    assert off(np.arctan2(between[:, 0], -between[:, 1]), second, 0.6) < 1e-7


@pytest.mark.parametrize(("links", "angle", "share"), [(2, 0.6, 1e-8), (5, 0.3, 1e-7), (15, 0.2, 1e-6)])
def test_a_chain_keeps_its_energy_and_its_lengths(links: int, angle: float, share: float) -> None:
    moved = simulate(chain((angle,) * links), 5)
    depth = (1 - cos(angle)) * G * links * (links + 1) / 2
    assert not moved.events
    assert off(mechanical(moved), mechanical(moved)[0], depth) < share
    ends = moved.anchors
    for n in range(links):
        length = np.hypot(*(ends[f"W{n}"][:, 0] - ends[f"W{n}"][:, 1]).T)
        assert off(length, 1.0, 1.0) < 1e-8


def test_a_crate_on_two_parallel_wires_swings_like_a_pendulum_and_never_turns() -> None:
    start = 0.7
    corners = ((-0.3, 0.2), (0.3, 0.2))
    centre = (sin(start), -cos(start) - 0.2)
    wires = tuple(
        WireLink(f"W{n}", Anchor("crate", corner), Anchor(None, (corner[0], 0.0)), 1.0)
        for n, corner in enumerate(corners)
    )
    moved = simulate(Scene((box("crate", *centre, 0.6, 0.4),), wires=wires), 3)
    top = moved.path("crate") + np.array([0.0, 0.2])
    assert off(np.hypot(*top.T), 1.0, 1.0) < 1e-8
    assert off(moved.poses[:, 0, 2], 0.0, 1.0) < 1e-10
    speed = moved.speed("crate")
    assert off(speed**2, 2 * G * (-top[:, 1] - cos(start)), 2 * G) < 1e-8


# The worked example of the page -----------------------------------------------------------------


def test_right_tensions_hold_the_box_and_wrong_ones_move_it_and_break_a_wire() -> None:
    right = 5 * sqrt(2)
    held = simulate(hanging(right, right), 10)
    assert off(held.poses, held.poses[0], 1.0) < 1e-6
    assert not held.events
    for tensions in ((6, right), (right, 6), (6, 6), (8, 8), (right, 8)):
        moved = simulate(hanging(*tensions), 2)
        assert hypot(*np.ptp(moved.path("box"), axis=0)) > 0.05
        broken = events(moved, "break")
        assert broken
        gone = moved.times > broken[0].time
        assert np.isnan(moved.anchors[broken[0].bodies[0]][gone]).all()
        assert off(ledger(moved), ledger(moved)[0], 10.0) < 1e-8


def test_too_great_tensions_break_both_wires_when_they_are_too_short_by_their_tolerance() -> None:
    # Symmetric: the box rises by y with a wire of √(1 + (1 − y)²), less than √2 by 5 cm; then both break.
    moved = simulate(hanging(8.0, 8.0), 1)
    first = events(moved, "break")[0].time
    length = np.hypot(*np.diff(moved.at(np.array([first - 1e-9])).anchors["left"][0], axis=0)[0])
    assert length == pytest.approx(sqrt(2) - 0.05, abs=1e-7)


def test_a_floor_takes_over_when_its_wire_breaks() -> None:
    scene = pendulum(0.0, limit=5.0)
    moved = simulate(
        Scene(
            (*scene.bodies, box("ground", 0, -2.5, 4, 1, fixed=True, material=Material(0.0))),
            wires=scene.wires,
        ),
        2,
    )
    fall = sqrt(2 * 0.95 / G)
    assert events(moved, "break")[0].time == 0.0
    assert events(moved, "impact")[0].time == pytest.approx(fall, abs=1e-9)
    assert moved.poses[-1, 0, 1] == pytest.approx(-1.95, abs=1e-12)
