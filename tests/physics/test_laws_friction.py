"""Closed forms of what rests, slides, rolls and tips: inclines, ladders, blocks on blocks, stacks.

Errors are shares of the size of the quantity: of the way gone, of the weight. The incline stands
at θ with its foot on the right; down it is `downhill(θ)`.
"""

from __future__ import annotations

from dataclasses import replace
from math import atan, cos, pi, sin, tan

import numpy as np
import pytest
from physics_scenes import (
    G,
    T,
    block,
    box,
    disc,
    downhill,
    floor,
    force,
    formula,
    incline,
    laid,
    ledger,
    off,
    size_of,
    stays,
    way,
)

from physics.engine import simulate
from physics.scene import Body, Force, Material, Scene
from physics.trajectory import Trajectory


def on_incline(body: Body, angle: float, above: float, friction: float | None = None) -> Scene:
    slope = incline(angle, material=Material(friction=friction))
    return Scene((slope, laid(body, angle, above)))


# Inclines ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("degrees", [1, 10, 30, 45, 60])
@pytest.mark.parametrize("body", [disc("A", 0, 0, 0.2), box("A", 0, 0, 0.6, 0.4, 3.0)], ids=["disc", "box"])
def test_on_a_smooth_incline_the_way_is_half_g_sin_theta_t_squared(degrees: float, body: Body) -> None:
    angle = np.radians(degrees)
    moved = simulate(on_incline(body, angle, 0.2), 1)
    gone = 0.5 * G * sin(angle) * moved.times**2
    down = downhill(angle)
    assert off(way(moved, "A", down), gone, gone[-1]) < 1e-12
    assert off(way(moved, "A", np.array([-down[1], down[0]])), 0.0, gone[-1]) < 1e-12
    assert off(moved.poses[:, 1, 2], moved.poses[0, 1, 2], 1.0) < 1e-12
    weight = body.mass * G
    assert off(size_of(moved, "contact with incline", "A"), weight * cos(angle), weight) < 1e-12


@pytest.mark.parametrize(("degrees", "friction"), [(30, 0.3), (45, 0.9), (10, 0.1), (60, 0.5)])
def test_on_a_rough_incline_a_box_slides_with_g_times_sin_theta_minus_mu_cos_theta(
    degrees: float, friction: float
) -> None:
    angle = np.radians(degrees)
    moved = simulate(on_incline(box("A", 0, 0, 0.8, 0.4), angle, 0.2, friction), 1)
    gone = 0.5 * G * (sin(angle) - friction * cos(angle)) * moved.times**2
    down = downhill(angle)
    assert off(way(moved, "A", down), gone, gone[-1]) < 1e-10
    assert off(moved.force("friction of incline", "A").values, -friction * G * cos(angle) * down, G) < 1e-10
    assert off(moved.energy.dissipated, friction * G * cos(angle) * gone, G) < 1e-10
    assert off(ledger(moved), ledger(moved)[0], G) < 1e-10


@pytest.mark.parametrize("degrees", [5, 30, 50])
@pytest.mark.parametrize("share", [1 + 1e-6, 1.01, 3.0])
def test_a_rough_incline_holds_a_box_without_any_creep_where_mu_exceeds_tan_theta(
    degrees: float, share: float
) -> None:
    angle = np.radians(degrees)
    moved = simulate(on_incline(box("A", 0, 0, 0.8, 0.4), angle, 0.2, share * tan(angle)), 10)
    assert stays(moved, "A")
    assert off(moved.force("friction of incline", "A").values, -G * sin(angle) * downhill(angle), G) < 1e-12


def test_friction_is_mu_times_the_weight_until_a_sliding_box_stops_and_none_from_then_on() -> None:
    speed, friction = 2.0, 0.4
    moved = simulate(
        Scene((box("A", 0, 0.2, 0.8, 0.4, velocity=(speed, 0, 0)), floor(Material(friction=friction)))), 1
    )
    stops = speed / (friction * G)
    assert 0.3 < stops < 0.9
    rub = moved.force("friction of floor", "A").values[:, 0]
    assert off(rub[moved.times < stops], -friction * G, G) < 1e-10
    assert off(rub[moved.times > stops], 0.0, G) < 1e-10


def test_a_box_thrown_up_a_rough_incline_stops_and_comes_back_slower() -> None:
    # Up with −g (sin θ + μ cos θ), down again with g (sin θ − μ cos θ).
    angle, friction, speed = pi / 6, 0.3, 3.0
    thrown = laid(box("A", 0, 0, 0.6, 0.4, velocity=(-speed, 0, 0)), angle, 0.2, along=3.0)
    moved = simulate(Scene((incline(angle, material=Material(friction=friction)), thrown)), 1)
    up, back = G * (sin(angle) + friction * cos(angle)), G * (sin(angle) - friction * cos(angle))
    top, t = speed / up, moved.times
    wanted = np.where(t < top, -speed * t + up * t**2 / 2, back * (t - top) ** 2 / 2 - speed**2 / (2 * up))
    assert off(way(moved, "A", downhill(angle)), wanted, speed**2 / (2 * up)) < 1e-10


@pytest.mark.parametrize("angle", [0.0, 0.3, -0.3])
def test_a_box_that_slides_on_a_rough_slope_stops_after_v_squared_over_twice_its_braking(
    angle: float,
) -> None:
    friction, speed = 0.5, 2.0
    slope = (
        incline(abs(angle), material=Material(friction=friction)) if angle else floor(Material(0, friction))
    )
    start = box("A", 0, 0.2, 0.6, 0.4, velocity=(speed if angle >= 0 else -speed, 0, 0))
    body = laid(start, abs(angle), 0.2, along=3.0) if angle else start
    moved = simulate(Scene((slope, body)), 2)
    brake = G * (friction * cos(angle) - sin(angle))
    t = np.minimum(moved.times, speed / brake)
    gone = speed * t - brake * t**2 / 2
    ahead = downhill(abs(angle)) * (1 if angle >= 0 else -1)
    assert off(way(moved, "A", ahead), gone, gone[-1]) < 1e-10
    assert not moved.velocities[moved.times > speed / brake, 1].any()


# Rolling ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("degrees", "share"), [(30, 1.0 + 1e-6), (30, 3.0), (60, 1.2), (5, 10.0)])
def test_a_disc_rolls_down_with_two_thirds_of_g_sin_theta_where_mu_reaches_a_third_of_tan_theta(
    degrees: float, share: float
) -> None:
    angle, radius = np.radians(degrees), 0.25
    moved = simulate(on_incline(disc("A", 0, 0, radius), angle, radius, share * tan(angle) / 3), 1)
    gone = G * sin(angle) / 3 * moved.times**2
    assert off(way(moved, "A", downhill(angle)), gone, gone[-1]) < 1e-9
    assert off(moved.poses[:, 1, 2], -gone / radius, gone[-1] / radius) < 1e-9
    friction = -G * sin(angle) / 3 * downhill(angle)
    assert off(moved.force("friction of incline", "A").values, friction, G) < 1e-9
    assert off(moved.energy.dissipated, 0.0, G) < 1e-9


@pytest.mark.parametrize("share", [1 - 1e-6, 0.5])
def test_a_disc_rolls_and_slides_where_mu_is_below_a_third_of_tan_theta(share: float) -> None:
    angle, radius = pi / 6, 0.25
    friction = share * tan(angle) / 3
    moved = simulate(on_incline(disc("A", 0, 0, radius), angle, radius, friction), 1)
    gone = 0.5 * G * (sin(angle) - friction * cos(angle)) * moved.times**2
    turned = -friction * G * cos(angle) / radius * moved.times**2
    assert off(way(moved, "A", downhill(angle)), gone, gone[-1]) < 1e-9
    assert off(moved.poses[:, 1, 2], turned, np.abs(turned[-1])) < 1e-9


@pytest.mark.parametrize("spin", [0.0, 4.0])
def test_a_disc_that_slides_on_a_level_floor_rolls_in_the_end_at_two_thirds_of_its_speed(
    spin: float,
) -> None:
    # Slip u = v + ωr fades at 3μg; then v = (2v₀ − ω₀r)/3 for good.
    speed, friction, radius = 3.0, 0.2, 0.25
    ball = disc("A", 0, radius, radius, velocity=(speed, 0, spin))
    moved = simulate(Scene((ball, floor(Material(friction=friction)))), 4)
    t = np.minimum(moved.times, (speed + spin * radius) / (3 * friction * G))
    final = (2 * speed - spin * radius) / 3
    gone = speed * t - friction * G * t**2 / 2 + final * (moved.times - t)
    assert off(way(moved, "A", np.array([1.0, 0.0])), gone, gone[-1]) < 1e-10
    assert off(moved.velocities[-1, 0], np.array([final, 0.0, -final / radius]), speed / radius) < 1e-10


# Tipping and ladders ----------------------------------------------------------------------------


def started(angle: float, friction: float, width: float) -> tuple[Trajectory, float, Body]:
    """(the motion of a box 1 m high on an incline, its angular acceleration at the start, the box)."""
    body = box("A", 0, 0, width, 1.0)
    moved = simulate(on_incline(body, angle, 0.5, friction), 1)
    return moved, float(moved.accelerations[0, 1, 2]), body


@pytest.mark.parametrize("degrees", [10, 25, 40])
def test_a_box_tips_exactly_where_tan_theta_exceeds_width_over_height(degrees: float) -> None:
    # About its lower corner: (I + m(w² + h²)/4) α = −m g cos θ (h tan θ − w)/2.
    angle = np.radians(degrees)
    for share in (1 - 1e-6, 1 + 1e-6):
        width = share * tan(angle)
        moved, turn, body = started(angle, 2 * tan(angle), width)
        if share > 1:
            assert stays(moved, "A")
        else:
            wanted = -G * cos(angle) * (tan(angle) - width) / 2 / (body.inertia + (width**2 + 1) / 4)
            assert turn == pytest.approx(wanted, rel=1e-6)
            assert moved.poses[-1, 1, 2] < moved.poses[0, 1, 2] - 1e-6


@pytest.mark.parametrize("degrees", [10, 25, 40])
def test_a_box_slides_exactly_where_tan_theta_exceeds_mu(degrees: float) -> None:
    angle = np.radians(degrees)
    for share in (1 - 1e-6, 1 + 1e-6):
        friction = share * tan(angle)
        moved, turn, _ = started(angle, friction, 2 * tan(angle))
        if share > 1:
            assert stays(moved, "A")
        else:
            gone = 0.5 * G * (sin(angle) - friction * cos(angle)) * moved.times**2
            assert off(way(moved, "A", downhill(angle)), gone, gone[-1]) < 1e-6
            assert abs(turn) < 1e-10


@pytest.mark.parametrize("degrees", [40, 60])
def test_a_sliding_box_tips_exactly_where_mu_exceeds_width_over_height(degrees: float) -> None:
    # On its lower corner alone: I α = N (w − μh)/2, N = m g cos θ − m α w/2.
    angle = np.radians(degrees)
    width = 0.5 * tan(angle)
    for share in (1 - 1e-6, 1 + 1e-6):
        friction = share * width
        moved, turn, body = started(angle, friction, width)
        if share < 1:
            gone = 0.5 * G * (sin(angle) - friction * cos(angle)) * moved.times**2
            assert off(way(moved, "A", downhill(angle)), gone, gone[-1]) < 1e-9
            assert off(moved.poses[:, 1, 2], -angle, 1.0) < 1e-10
        else:
            lever = (width - friction) / 2
            wanted = lever * G * cos(angle) / (body.inertia + width / 2 * lever)
            assert turn == pytest.approx(wanted, rel=1e-6)
            assert moved.poses[-1, 1, 2] < -angle - 1e-8


def ladder(angle: float, friction: float) -> Scene:
    """A bar of 2 m that narrows to a point at both ends, against a smooth wall x <= 0."""
    bar = block("ladder", cos(angle), sin(angle), ((-1, 0), (0, -0.02), (1, 0), (0, 0.02)), 5.0)
    wall = box("wall", -0.5, 2.0, 1.0, 6.0, fixed=True)
    ground = box("ground", 5.0, -0.5, 12.0, 1.0, fixed=True, material=Material(friction=friction))
    return Scene((replace(bar, angle=-angle), wall, ground))


@pytest.mark.parametrize("degrees", [45, 60, 75])
def test_a_ladder_on_a_smooth_wall_holds_where_mu_reaches_half_the_cotangent(degrees: float) -> None:
    # Moments about the foot: wall and friction m g cot φ / 2 each, floor m g.
    angle = np.radians(degrees)
    weight, push = 5 * G, 5 * G / tan(angle) / 2
    held = simulate(ladder(angle, (1 + 1e-6) / tan(angle) / 2), 5)
    assert stays(held, "ladder")
    for name, wanted in (
        ("contact with wall", (push, 0.0)),
        ("contact with ground", (0.0, weight)),
        ("friction of ground", (-push, 0.0)),
    ):
        assert off(held.force(name, "ladder").values, np.array(wanted), weight) < 1e-10
    slips = simulate(ladder(angle, (1 - 1e-6) / tan(angle) / 2), 1)
    assert slips.accelerations[0, 0, 0] > 0
    assert slips.path("ladder")[-1, 1] < slips.path("ladder")[0, 1] - 1e-7


# Blocks on blocks -------------------------------------------------------------------------------


def sled(pull: Force, friction: float = 0.4) -> Scene:
    """A box of 1 kg on a long one of 3 kg on a smooth floor, which is pulled."""
    upper = box("upper", 0.0, 0.4, 0.6, 0.4, 1.0, material=Material(friction=friction))
    return Scene(
        (floor(), box("lower", 0.0, 0.1, 4.0, 0.2, 3.0, material=Material(0.0)), upper), forces=(pull,)
    )


@pytest.mark.parametrize("share", [0.3, 1 - 1e-6, 1 + 1e-6, 2.0])
def test_a_block_on_a_pulled_block_slips_where_the_pull_exceeds_mu_g_times_both_masses(
    share: float,
) -> None:
    friction, light, heavy = 0.4, 1.0, 3.0
    pull = share * friction * G * (light + heavy)
    moved = simulate(sled(force("F", "lower", pull), friction), 0.7)
    upper = min(pull / (light + heavy), friction * G)
    lower = (pull - light * upper) / heavy
    right = np.array([1.0, 0.0])
    for label, rate in (("upper", upper), ("lower", lower)):
        gone = rate * moved.times**2 / 2
        assert off(way(moved, label, right), gone, gone[-1]) < 1e-10
    assert off(moved.force("friction of lower", "upper").values, light * upper * right, G) < 1e-10
    assert off(moved.force("friction of upper", "lower").values, -light * upper * right, G) < 1e-10
    assert off(ledger(moved), ledger(moved)[0], 4 * G) < 1e-10


def test_a_block_on_a_block_begins_to_slip_when_a_growing_pull_reaches_the_limit() -> None:
    # F = k t: together k t³/24, until k t = 4 μ g m; then the upper one keeps μ g.
    friction, growth = 0.4, 20.0
    moved = simulate(sled(Force("F", "lower", formula(growth * T), formula(0.0)), friction), 1.2)
    slip = 4 * friction * G / growth
    t = moved.times
    late = np.maximum(t - slip, 0.0)
    together = growth * np.minimum(t, slip) ** 3 / 24
    upper = together + friction * G * (slip / 2 * late + late**2 / 2)
    assert off(way(moved, "upper", np.array([1.0, 0.0])), upper, upper[-1]) < 1e-8
    both = (moved.poses[:, 2, 0] + 3 * moved.poses[:, 1, 0]) / 4
    assert off(both, growth * t**3 / 24, growth * 1.2**3 / 24) < 1e-10


@pytest.mark.parametrize("count", [1, 3, 10])
def test_a_stack_stays_and_each_box_carries_what_is_above(count: int) -> None:
    boxes = [box(f"B{i}", 0.01 * (i % 2), 0.2 + 0.4 * i, 0.6, 0.4) for i in range(count)]
    moved = simulate(Scene((floor(Material(friction=0.5)), *boxes)), 3, mode="exact")
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-12
    for i in range(count):
        below = f"B{i - 1}" if i else "floor"
        carried = moved.force(f"contact with {below}", f"B{i}").values
        assert off(carried, np.array([0.0, (count - i) * G]), count * G) < 1e-10


def test_a_pyramid_of_55_boxes_stays_within_a_millimetre_and_does_not_jitter() -> None:
    rough = Material(friction=0.5)
    boxes = [
        box(f"B{row}.{k}", 0.42 * (k - (9 - row) / 2), 0.2 + 0.4 * row, 0.4, 0.4, material=rough)
        for row in range(10)
        for k in range(10 - row)
    ]
    moved = simulate(Scene((floor(rough), *boxes)), 3)
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-3
    assert np.abs(moved.velocities[-1]).max() <= 1e-12


def test_a_ball_in_a_notch_rests_on_both_sides() -> None:
    # Two faces at α and β: N₁/sin β = N₂/sin α = W/sin(α + β), as Lami says.
    a, b, r = pi / 6, pi / 3, 0.25
    left = replace(box("left", 0, 0, 4.0, 1.0, fixed=True), angle=-a)
    right = replace(box("right", 0, 0, 4.0, 1.0, fixed=True), angle=b)
    # Faces through the origin: slabs of 1 m shifted half a metre down along their normals, and outward.
    left = replace(left, position=(-1.9 * cos(a) - 0.5 * sin(a), 1.9 * sin(a) - 0.5 * cos(a)))
    right = replace(right, position=(1.9 * cos(b) + 0.5 * sin(b), 1.9 * sin(b) - 0.5 * cos(b)))
    # Its centre is r from both faces: on the bisector of the notch, at r / sin(half the opening).
    half = (pi - a - b) / 2
    aim, reach = b + half, r / sin(half)
    ball = disc("A", reach * cos(aim), reach * sin(aim), r)
    moved = simulate(Scene((left, right, ball)), 3)
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-12
    assert off(size_of(moved, "contact with left", "A"), G * sin(b) / sin(a + b), G) < 1e-10
    assert off(size_of(moved, "contact with right", "A"), G * sin(a) / sin(a + b), G) < 1e-10


def test_a_disc_that_rolls_up_an_incline_turns_and_rolls_back_in_one_parabola() -> None:
    angle, r, speed = atan(0.5), 0.2, 2.0
    thrown = disc("A", 0, 0, r, velocity=(-speed, 0, speed / r))
    slope = incline(angle, material=Material(friction=0.5))
    moved = simulate(Scene((slope, laid(thrown, angle, r, along=3.0))), 1.2)
    rate = 2 / 3 * G * sin(angle)
    gone = rate * moved.times**2 / 2 - speed * moved.times
    assert off(way(moved, "A", downhill(angle)), gone, speed**2 / (2 * rate)) < 1e-9
    assert not moved.events
