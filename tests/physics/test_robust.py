"""Robust mode on its own: piles stand, momentum and energy are kept, and no run depends on how it is cut."""

from __future__ import annotations

import pickle
from math import pi, sin, sqrt, tan

import numpy as np
import pytest
from physics_scenes import (
    G,
    T,
    X,
    atwood,
    block,
    box,
    course,
    disc,
    floor,
    force,
    hanging,
    incline,
    laid,
    pendulum,
    place_course,
    rod_pendulum,
    spring,
    supported,
    wire,
)
from scipy.special import ellipj, ellipk

from physics.engine.acts import Act, energies, link_ends
from physics.engine.robust.run import RobustRun
from physics.engine.world import start_of, world_of
from physics.scene import Anchor, Body, Material, Pin, Scene, WireLink
from sketch.ink import FloatArray

ROUGH = Material(friction=0.5)
DEAD = Material(restitution=0.0, friction=0.5)


def began(scene: Scene, sleep: bool = True) -> RobustRun:
    world, names = world_of(scene, [body.label for body in scene.bodies if not body.fixed])
    pos, vel = start_of(scene, names)
    return RobustRun(world, names, pos, vel, 0.0, None, sleep)


def run(scene: Scene, seconds: float, sleep: bool = True) -> RobustRun:
    moved = began(scene, sleep)
    moved.advance(seconds)
    return moved


def grid(seconds: float, rate: float = 60.0) -> FloatArray:
    return np.arange(round(seconds * rate) + 1) / rate


def kinds(moved: RobustRun) -> list[str]:
    return [event.kind for event in moved.events]


def act(acts: list[Act], name: str, body: int) -> Act:
    return next(one for one in acts if (one.name, one.body) == (name, body))


def mechanical(moved: RobustRun, seconds: float) -> FloatArray:
    pos, vel = moved.states(grid(seconds, 240.0))
    return sum(energies(moved.given, moved.names, pos, vel), np.zeros(len(pos)))


def pyramid(rows: int, gap: float, material: Material = ROUGH) -> Scene:
    boxes = [
        box(
            f"{row}.{k}",
            (k - (rows - 1 - row) / 2) * (0.5 + gap),
            0.25 + row * 0.5 + (row + 1) * gap,
            0.5,
            0.5,
            material=material,
        )
        for row in range(rows)
        for k in range(rows - row)
    ]
    return Scene((floor(material), *boxes))


def stack(count: int) -> Scene:
    return Scene(
        (floor(ROUGH), *(box(f"{k}", 0.0, 0.25 + 0.5 * k, 0.5, 0.5, mass=k + 1.0) for k in range(count)))
    )


def discs_in_bin(count: int) -> Scene:
    rng = np.random.default_rng([3, count])
    walls = (
        floor(ROUGH),
        box("left", -2.0, 2.0, 0.5, 6.0, fixed=True),
        box("right", 2.0, 2.0, 0.5, 6.0, fixed=True),
    )
    across = 10
    falling = [
        disc(
            f"{k}",
            -1.5 + 0.33 * (k % across) + rng.uniform(0, 0.02),
            0.4 + 0.33 * (k // across),
            rng.uniform(0.1, 0.15),
        )
        for k in range(count)
    ]
    return Scene((*walls, *falling))


# Piles ------------------------------------------------------------------------------------------


def test_a_pyramid_that_touches_exactly_stays_and_is_still_without_sleep() -> None:
    moved = run(pyramid(10, 0.0), 5.0, sleep=False)
    pos, vel = moved.states(grid(5.0))
    assert np.abs(pos - pos[0]).max() < 1e-6
    assert np.abs(vel[240:]).max() < 1e-12


def test_a_pyramid_with_gaps_closes_them_and_is_still() -> None:
    moved = run(pyramid(10, 1e-3, DEAD), 5.0, sleep=False)
    pos, vel = moved.states(grid(5.0))
    movable = moved.names.movable
    rows = np.round((pos[0, :movable, 1] - 0.25) / 0.5).astype(int)
    dropped = pos[-1, :movable, 1] - (0.25 + 0.5 * rows)
    assert np.abs(dropped).max() < 1e-4
    assert np.abs(pos[-1, :movable, 0] - pos[0, :movable, 0]).max() < 1e-3
    assert np.abs(vel[-30:]).max() < 1e-12


def test_under_a_stack_forces_are_the_weights_above() -> None:
    moved = run(stack(10), 3.0, sleep=False)
    acts, accelerations = moved.observe(grid(3.0))
    for k in range(10):
        below = "floor" if k == 0 else f"{k - 1}"
        pressed = act(acts, f"contact with {below}", k)
        above = G * sum(n + 1.0 for n in range(k, 10))
        assert np.abs(pressed.values[-1] - (0.0, above)).max() < 1e-5 * above
        assert abs(pressed.points[-1, 0]) < 1e-3
    assert np.abs(accelerations[-1]).max() < 1e-3


def test_a_pile_of_discs_in_a_bin_settles_within_it() -> None:
    moved = run(discs_in_bin(60), 8.0)
    pos, vel = moved.states(np.array([0.0, 8.0]))
    movable = moved.names.movable
    assert np.abs(vel[-1, :movable, :2]).max() < 0.02
    assert np.abs(pos[-1, :movable, 0]).max() < 1.75
    assert pos[-1, :movable, 1].min() > 0.0999


def test_contacts_never_create_energy() -> None:
    moved = run(discs_in_bin(40), 3.0)
    energy = mechanical(moved, 3.0)
    assert np.diff(energy).max() < 2e-3 * (energy[0] - energy[-1])
    # Blows, friction and damping account for what is lost, but for some hundredths in the heap's collapse.
    assert np.abs(moved.corrected(grid(3.0))).max() < 3e-2 * (energy[0] - energy[-1])


def test_a_collision_in_free_space_keeps_momentum_and_at_restitution_one_energy() -> None:
    lively = Material(restitution=1.0)
    bodies = (
        disc("A", 0.0, 0.0, velocity=(2.0, 0.3, 0.0), material=lively),
        disc("B", 2.0, 0.2, mass=3.0, material=lively),
        box("C", 4.0, 0.4, 0.5, 0.5, mass=2.0, material=lively),
    )
    moved = run(Scene(bodies, gravity=(0.0, 0.0)), 3.0)
    _, vel = moved.states(grid(3.0))
    mass = moved.given.mass[:3, :1]
    momentum = (mass * vel[:, :3, :2]).sum(axis=1)
    assert "impact" in kinds(moved)
    assert np.abs(momentum - momentum[0]).max() < 1e-12
    energy = mechanical(moved, 3.0)
    assert np.abs(energy / energy[0] - 1.0).max() < 1e-9


@pytest.mark.parametrize("masses", [(1.0, 1e6), (1e6, 1.0), (1e-3, 1e3)])
def test_a_stack_of_any_masses_stands_still(masses: tuple[float, float]) -> None:
    low, high = masses
    scene = Scene((floor(DEAD), box("low", 0, 0.25, 0.5, 0.5, low), box("high", 0.05, 0.75, 0.5, 0.5, high)))
    pos, vel = run(scene, 2.0, sleep=False).states(grid(2.0))
    assert np.abs(pos - pos[0]).max() < 1e-9
    assert np.abs(vel).max() < 1e-9


def test_a_smooth_pyramid_does_not_creep() -> None:
    moved = run(pyramid(10, 0.0, Material()), 5.0, sleep=False)
    pos, vel = moved.states(grid(5.0))
    assert np.abs(pos - pos[0]).max() < 1e-9
    assert np.abs(vel[60:]).max() < 1e-11


def test_what_was_drawn_overlapping_is_let_out_gently() -> None:
    scene = Scene((floor(DEAD), box("A", 0, 0.25, 0.5, 0.5), box("B", 0.1, 0.70, 0.5, 0.5)))
    moved = run(scene, 3.0)
    pos, vel = moved.states(grid(3.0))
    assert np.abs(vel).max() < 0.1
    assert abs(pos[-1, 1, 1] - 0.75) < 1e-4


# The ledger -------------------------------------------------------------------------------------


def test_heat_is_what_friction_impacts_and_dampers_make() -> None:
    slides = Scene((floor(ROUGH), box("A", 0.0, 0.25, 0.5, 0.5, velocity=(2.0, 0.0, 0.0))))
    falls = Scene((disc("A", 0.0, 1.25, material=Material(restitution=0.5)), floor()))
    tie = spring("s", "A", (0.0, 0.0), 1.0, 40.0, 3.0)
    swings = Scene((disc("A", 1.5, 0.0),), springs=(tie,), gravity=(0.0, 0.0))
    for scene, seconds, heat, step in (
        (slides, 1.0, 2.0, 1e-4),
        (falls, 0.6, 0.75 * G, 1e-12),
        (swings, 8.0, 5.0, 3e-3),
    ):
        moved = run(scene, seconds, sleep=False)
        counted, taken = moved.ledger(grid(seconds))[:, 0], moved.corrected(grid(seconds))
        assert counted[-1] + taken[-1] == pytest.approx(heat, rel=1e-9)
        assert np.abs(taken).max() < step


@pytest.mark.parametrize("scene", [pendulum(1.0), rod_pendulum(1.0)])
def test_what_the_steps_take_or_give_is_small_and_does_not_grow(scene: Scene) -> None:
    moved = run(scene, 10.0, sleep=False)
    taken = moved.corrected(grid(10.0))
    assert np.abs(taken).max() < 2e-3
    assert np.abs(taken[480:]).max() < 1.5 * np.abs(taken[:120]).max()


# Impacts ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("e", [0.3, 0.8, 1.0])
def test_a_ball_meets_the_floor_when_it_must_and_rises_e_squared_of_its_height(e: float) -> None:
    moved = run(Scene((disc("A", 0.0, 1.25, material=Material(restitution=e)), floor())), 1.2)
    falls = sqrt(2 / G)
    impact = next(event for event in moved.events if event.kind == "impact")
    assert abs(impact.time - falls) < 1e-9
    pos, _ = moved.states(grid(1.2, 240.0))
    later = grid(1.2, 240.0) > falls
    assert abs(pos[later, 0, 1].max() - 0.25 - e * e) < 1e-4


def test_a_blow_runs_through_a_row_of_balls() -> None:
    lively = Material(restitution=1.0)
    row = [disc(f"{k}", 0.5 * k, 0.0, material=lively) for k in range(4)]
    scene = Scene(
        (*row, disc("hit", -1.0, 0.0, velocity=(1.0, 0.0, 0.0), material=lively)), gravity=(0.0, 0.0)
    )
    _, vel = run(scene, 1.0).states(np.array([1.0]))
    assert np.abs(vel[0, :5, 0] - (0.0, 0.0, 0.0, 1.0, 0.0)).max() < 1e-9


# Slopes -----------------------------------------------------------------------------------------


def test_a_disc_slides_down_a_smooth_incline_by_half_g_sine_t_squared() -> None:
    angle = pi / 6
    scene = Scene((incline(angle), laid(disc("ball", 0, 0), angle, 0.25)))
    pos, _ = run(scene, 1.0).states(grid(1.0))
    way = np.hypot(*(pos[:, 0, :2] - pos[0, 0, :2]).T)
    assert np.abs(way - 0.5 * G * sin(angle) * grid(1.0) ** 2).max() < 1e-9


def test_a_rough_incline_rolls_a_disc_and_holds_a_box() -> None:
    angle = pi / 6
    scene = Scene((incline(angle, material=ROUGH), laid(disc("ball", 0, 0), angle, 0.25)))
    pos, _ = run(scene, 1.0).states(grid(1.0))
    way = np.hypot(*(pos[:, 0, :2] - pos[0, 0, :2]).T)
    assert np.abs(way - G / 3 * sin(angle) * grid(1.0) ** 2).max() < 1e-3
    held = Material(friction=1.05 * tan(angle))
    scene = Scene((incline(angle, material=held), laid(box("box", 0, 0, 0.6, 0.4), angle, 0.2)))
    pos, _ = run(scene, 3.0).states(grid(3.0))
    assert np.abs(pos - pos[0]).max() < 1e-6


# Links ------------------------------------------------------------------------------------------


def test_a_pendulum_on_a_wire_swings_as_jacobi_says_and_keeps_its_length() -> None:
    angle = 1.0
    moved = run(pendulum(angle), 3.0)
    t = grid(3.0)
    pos, vel = moved.states(t)
    k = sin(angle / 2)
    sn = ellipj(ellipk(k * k) - sqrt(G) * t, k * k)[0]
    wanted = 2 * np.arcsin(k * sn)
    assert np.abs(np.hypot(*pos[:, 0, :2].T) - 1.0).max() < 1e-5
    assert np.abs(np.arctan2(pos[:, 0, 0], -pos[:, 0, 1]) - wanted).max() < 1e-3
    acts, _ = moved.observe(t)
    tension = np.hypot(*act(acts, "T of wire", 0).values.T)
    assert np.abs(tension - G * (3 * np.cos(wanted) - 2 * np.cos(angle))).max() < 5e-2
    assert np.abs(energies(moved.given, moved.names, pos, vel)[1]).max() > 1.0


def test_a_pinned_bar_keeps_its_pin_and_its_energy() -> None:
    moved = run(rod_pendulum(1.0), 3.0)
    pos, _ = moved.states(grid(3.0))
    ends = link_ends(moved.given, pos)
    assert np.abs(ends[:, 0, 0] - ends[:, 0, 1]).max() < 1e-5
    energy = mechanical(moved, 3.0)
    assert np.ptp(energy) < 1e-3 * 2.0 * G * 1.2


def test_an_atwood_machine_falls_by_the_difference_of_its_masses() -> None:
    moved = run(atwood(1.0, 2.0), 0.6)
    t = grid(0.6)
    pos, _ = moved.states(t)
    assert np.abs(pos[:, 0, 1] - pos[0, 0, 1] - G / 6 * t**2).max() < 1e-3
    acts, _ = moved.observe(t)
    assert np.abs(act(acts, "T of wire", 0).values[5:, 1] - 4 * G / 3).max() < 1e-2


def test_a_spring_swings_with_its_own_period() -> None:
    scene = Scene(
        (disc("A", 1.5, 0.0),), springs=(spring("s", "A", (0.0, 0.0), 1.0, 40.0),), gravity=(0.0, 0.0)
    )
    t = grid(3.0)
    pos, _ = run(scene, 3.0).states(t)
    assert np.abs(pos[:, 0, 0] - 1.0 - 0.5 * np.cos(sqrt(40.0) * t)).max() < 1e-3


def test_a_stiff_spring_stays_stable() -> None:
    scene = Scene((disc("A", 1.01, 0.0),), springs=(spring("s", "A", (0.0, 0.0), 1.0, 1e6, 10.0),))
    pos, _ = run(scene, 1.0).states(grid(1.0))
    assert np.abs(np.hypot(*pos[:, 0, :2].T) - 1.0).max() < 0.0101


def test_a_wire_tautens_with_a_jerk_and_never_stretches() -> None:
    bob = disc("bob", 0.0, 0.0, 0.05)
    scene = Scene((bob,), wires=(wire("w", "bob", (0.0, 0.2), 1.0),))
    moved = run(scene, 2.0)
    pos, _ = moved.states(grid(2.0))
    assert np.hypot(pos[:, 0, 0], pos[:, 0, 1] - 0.2).max() < 1.0 + 1e-6
    assert kinds(moved)[:2] == ["slack", "taut"]


def test_a_wire_breaks_at_its_limit_and_its_load_falls_freely() -> None:
    scene = Scene(
        (disc("bob", 0.0, -1.0, 0.05, 2.0),), wires=(wire("w", "bob", (0.0, 0.0), 1.0, limit=15.0),)
    )
    moved = run(scene, 0.5)
    assert "break" in kinds(moved)
    pos, _ = moved.states(grid(0.5))
    assert pos[-1, 0, 1] < -1.0 - 0.45 * G * 0.5**2


# What the student gives -------------------------------------------------------------------------


def test_given_tensions_hold_the_box_or_break_a_wire() -> None:
    right = run(hanging(5 * sqrt(2), 5 * sqrt(2)), 2.0)
    pos, _ = right.states(grid(2.0))
    assert np.abs(pos - pos[0]).max() < 1e-9
    wrong = run(hanging(5 * sqrt(2), 4.0), 2.0)
    assert "break" in kinds(wrong)


@pytest.mark.parametrize(("share", "kind"), [(0.9, "bounce"), (1.1, "lift-off")])
def test_a_wrong_normal_force_is_struck_back_or_lifts_off(share: float, kind: str) -> None:
    assert kind in kinds(run(supported(pi / 6, share), 1.5))


def test_the_right_normal_force_rolls_a_ball_straight_down() -> None:
    pos, _ = run(supported(pi / 6, 1.0), 1.0).states(grid(1.0))
    way = np.hypot(*(pos[:, 0, :2] - pos[0, 0, :2]).T)
    assert np.abs(way - 0.5 * G * 0.5 * grid(1.0) ** 2).max() < 1e-9


def test_a_course_is_followed_until_its_body_collides() -> None:
    wall = box("wall", 2.0, 0.0, 0.5, 4.0, fixed=True)
    scene = Scene(
        (disc("A", 0.0, 0.0), wall), courses=(place_course("c", "A", "x", T**2),), gravity=(0.0, 0.0)
    )
    moved = run(scene, 2.0)
    t = grid(2.0)
    pos, vel = moved.states(t)
    before = t < sqrt(1.5) - 0.02
    assert np.abs(pos[before, 0, 0] - t[before] ** 2).max() < 1e-6
    released = next(event for event in moved.events if event.kind == "released")
    assert abs(released.time - sqrt(1.5)) < 1e-2
    assert vel[-1, 0, 0] < 0.0


def test_a_velocity_equation_is_integrated() -> None:
    scene = Scene((disc("A", 1.0, 0.0),), courses=(course("v", "A", "x", X, X),), gravity=(0.0, 0.0))
    pos, _ = run(scene, 1.0).states(grid(1.0))
    assert np.abs(pos[:, 0, 0] - np.exp(grid(1.0))).max() < 1e-3


def test_a_formula_without_a_value_stops_the_run_and_is_named() -> None:
    import sympy

    scene = Scene((disc("A", 0.0, 0.0),), forces=(force("f", "A", sympy.sqrt(1 - T)),), gravity=(0.0, 0.0))
    moved = run(scene, 3.0)
    assert moved.stopped
    assert moved.events[-1].kind == "stopped"
    assert "f of A" in moved.events[-1].message
    assert abs(moved.events[-1].time - 1.0) < 0.02


# The run itself ---------------------------------------------------------------------------------


def crowded() -> Scene:
    bodies: list[Body] = [floor(ROUGH), *(disc(f"{k}", 0.3 * (k % 3), 0.3 + 0.6 * k, 0.2) for k in range(6))]
    bodies.append(block("wedge", 1.0, 1.0, ((-0.3, -0.2), (0.3, -0.2), (0.0, 0.4))))
    pin = Pin("p", Anchor("0", (0.0, 0.2)), Anchor("wedge", (-0.3, -0.2)))
    tie = WireLink("w", Anchor("5", (0.0, 0.0)), Anchor(None, (0.0, 4.0)), 2.0)
    return Scene(tuple(bodies), pins=(pin,), wires=(tie,))


def test_a_run_is_equal_to_the_bit_however_it_is_cut_and_stored() -> None:
    whole = run(crowded(), 4.0)
    cut = began(crowded())
    for until in (0.013, 0.9, 0.9, 1.7, 2.9, 4.0):
        cut.advance(until)
        cut = pickle.loads(pickle.dumps(cut))
    times = np.sort(np.random.default_rng(5).uniform(0, 4.0, 200))
    for first, second in zip(whole.states(times), cut.states(times), strict=True):
        assert first.tobytes() == second.tobytes()
    assert whole.ledger(times).tobytes() == cut.ledger(times).tobytes()
    assert whole.events == cut.events
    assert whole.time == cut.time


def test_a_scene_at_rest_sleeps_and_tells_so() -> None:
    moved = run(Scene((floor(DEAD), box("A", 0, 0.25, 0.5, 0.5))), 100.0)
    assert moved.asleep
    assert kinds(moved) == ["rest"]
    pos, vel = moved.states(np.array([0.0, 99.0]))
    assert np.abs(pos[1] - pos[0]).max() < 1e-9
    assert not vel[1].any()
    acts, _ = moved.observe(np.array([99.0]))
    assert abs(act(acts, "contact with floor", 0).values[0, 1] - G) < 1e-6


def test_what_is_cut_off_is_forgotten() -> None:
    moved = run(crowded(), 2.0)
    moved.cut(1.0)
    assert moved.time == 1.0
    assert all(event.time <= 1.0 for event in moved.events)
    shorter = run(crowded(), 1.0)
    assert moved.states(grid(1.0))[0].tobytes() == shorter.states(grid(1.0))[0].tobytes()
