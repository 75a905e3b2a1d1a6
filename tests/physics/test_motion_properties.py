"""What holds for any scene: momentum, energy, Newton's laws, order, the same bits again."""

from __future__ import annotations

import pickle
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from math import pi, sqrt
from typing import TypeVar, cast

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st
from physics_crowds import Ground, carried, crowd_at, number, renamed, scenes, together
from physics_scenes import (
    G,
    box,
    chain,
    disc,
    events,
    floor,
    ledger,
    mechanical,
    off,
    overlap,
    pendulum,
    rod_pendulum,
    spring,
    wire,
)

from physics.engine import Simulation, simulate, simulate_many
from physics.scene import Material, Scene, SceneError
from physics.trajectory import Mode, Trajectory

# A failing crowd says enough as it is; to shrink one takes minutes.
# Derandomized: what these find with other seeds is counted by benchmarks/engine_random.py.
SCENES = settings(
    max_examples=15, deadline=None, derandomize=True, phases=(Phase.explicit, Phase.reuse, Phase.generate)
)
modes = pytest.mark.parametrize("mode", ["exact", "robust"])
Test = TypeVar("Test", bound=Callable[..., None])


def and_crowds(ground: Ground, *seeds: int) -> Callable[[Test], Test]:
    """These always, whatever else is drawn: the engine was wrong about them once."""

    def added(test: Test) -> Test:
        for seed in seeds:
            test = cast(Test, example(crowd_at(seed, ground))(test))
        return test

    return added


# Conservation -----------------------------------------------------------------------------------


def keeps_momentum(mode: Mode, scene: Scene) -> None:
    moved = simulate(scene, 1, mode=mode)
    mass = np.array([body.mass for body in scene.bodies])
    inertia = np.array([body.inertia for body in scene.bodies])
    place, velocity = moved.poses, moved.velocities
    momentum = np.einsum("b,tbk->tk", mass, velocity[:, :, :2])
    cross = place[:, :, 0] * velocity[:, :, 1] - place[:, :, 1] * velocity[:, :, 0]
    moment = cross @ mass + velocity[:, :, 2] @ inertia
    assert off(momentum, momentum[0], 1 + mass.sum()) < 1e-9
    assert off(moment, moment[0], 1 + mass.sum()) < (1e-8 if mode == "exact" else 1e-3)


def creates_no_energy(mode: Mode, scene: Scene) -> None:
    moved = simulate(scene, 1, mode=mode)
    total = mechanical(moved)
    scale = 1 + np.abs(total).max()
    assert np.diff(total).max() < (1e-8 if mode == "exact" else 1e-3) * scale
    assert off(ledger(moved), ledger(moved)[0], scale) < (1e-7 if mode == "exact" else 1e-6)
    assert np.diff(moved.energy.dissipated).min() > (-1e-8 if mode == "exact" else -1e-3) * scale


def stays_apart_and_finite(mode: Mode, scene: Scene) -> None:
    moved = simulate(scene, 2, mode=mode)
    assert np.isfinite(moved.poses).all() and np.isfinite(moved.velocities).all()
    assert np.isfinite(moved.accelerations).all()
    assert all(np.isfinite(one.values).all() for one in moved.forces)
    assert overlap(moved, scene, every=2) < (1e-6 if mode == "exact" else 1e-3)


@SCENES
@given(scenes("none"))
def test_momentum_and_its_moment_are_kept_where_nothing_is_fixed(scene: Scene) -> None:
    keeps_momentum("exact", scene)


@SCENES
@and_crowds("none", 15, 85, 125, 151)
@given(scenes("none"))
def test_momentum_and_its_moment_are_kept_in_small_steps_too(scene: Scene) -> None:
    keeps_momentum("robust", scene)


@SCENES
@and_crowds("floor", 40)
@given(scenes())
def test_energy_is_never_created_by_contacts_and_links_and_the_ledger_balances(scene: Scene) -> None:
    creates_no_energy("exact", scene)


@SCENES
@and_crowds("floor", 31, 130, 176)
@given(scenes())
def test_energy_is_not_created_in_small_steps_either(scene: Scene) -> None:
    creates_no_energy("robust", scene)


@SCENES
@given(scenes())
def test_solids_never_enter_each_other_and_every_number_is_finite(scene: Scene) -> None:
    stays_apart_and_finite("exact", scene)


@SCENES
@and_crowds("floor", 31, 40, 99, 105, 129, 130)
@given(scenes())
def test_solids_stay_apart_in_small_steps_too(scene: Scene) -> None:
    stays_apart_and_finite("robust", scene)


@SCENES
@given(scenes())
def test_no_wire_is_ever_longer_than_it_is_and_no_pin_comes_apart(scene: Scene) -> None:
    moved = simulate(scene, 1, mode="exact")
    for label, ends in moved.anchors.items():
        apart = np.hypot(*(ends[:, 0] - ends[:, 1]).T)
        for one in scene.wires:
            assert one.label != label or apart.max() < one.rest + 1e-9
        assert label not in [pin.label for pin in scene.pins] or apart.max() < 1e-9


@SCENES
@given(scenes())
def test_the_forces_on_a_body_add_up_to_its_mass_times_its_acceleration(scene: Scene) -> None:
    moved = simulate(scene, 1, mode="exact")
    for body in scene.bodies[:-1]:
        column = moved.column(body.label)
        mine = [one for one in moved.forces if one.body == body.label]
        total = sum(one.values for one in mine)
        turning = np.zeros(len(moved.times))
        for one in mine:
            arm = one.points - moved.path(body.label)
            turning += np.where(
                one.values.any(axis=1), arm[:, 0] * one.values[:, 1] - arm[:, 1] * one.values[:, 0], 0.0
            )
        scale = body.mass * G + np.abs(total).max()
        assert off(total, body.mass * moved.accelerations[:, column, :2], scale) < 1e-9
        assert off(turning, body.inertia * moved.accelerations[:, column, 2], scale) < 1e-9


@SCENES
@given(scenes())
def test_what_one_body_does_to_another_is_done_back_to_it(scene: Scene) -> None:
    moved = simulate(scene, 1, mode="exact")
    labels = [body.label for body in scene.bodies[:-1]]
    for one in moved.forces:
        kind, _, other = one.name.rpartition(" ")
        if kind in ("contact with", "friction of") and other in labels:
            back = moved.force(f"{kind} {one.body}", other)
            assert off(one.values, -back.values, 1 + np.abs(one.values).max()) < 1e-12
            if kind == "contact with":
                friction = f"friction of {other}", one.body
                rubbed = [f for f in moved.forces if (f.name, f.body) == friction]
                for rub in rubbed:
                    assert off(np.einsum("tk,tk->t", rub.values, one.values), 0.0, 1 + G**2) < 1e-6


# Invariance -------------------------------------------------------------------------------------


@SCENES
@given(scenes(), st.floats(-pi, pi), number, number)
def test_turning_and_moving_the_world_turns_and_moves_the_motion(
    scene: Scene, angle: float, dx: float, dy: float
) -> None:
    plain, turned = simulate(scene, 0.3), simulate(carried(scene, angle, (dx, dy)), 0.3)
    c, s = np.cos(angle), np.sin(angle)
    for body in scene.bodies:
        wanted = plain.path(body.label) @ np.array([[c, s], [-s, c]]) + np.array([dx, dy])
        assert off(turned.path(body.label), wanted, 1.0) < 1e-6


@SCENES
@given(scenes("none"), number, number)
def test_to_an_observer_who_drifts_the_motion_is_the_same(scene: Scene, v_x: float, v_y: float) -> None:
    drifting = replace(
        scene,
        bodies=tuple(
            replace(body, velocity=(body.velocity[0] + v_x, body.velocity[1] + v_y, body.velocity[2]))
            for body in scene.bodies
        ),
    )
    plain, seen = simulate(scene, 0.5), simulate(drifting, 0.5)
    drift = np.outer(plain.times, [v_x, v_y])
    for body in scene.bodies:
        assert off(seen.path(body.label), plain.path(body.label) + drift, 1.0) < 1e-6


@pytest.mark.parametrize("scene", [pendulum(1.2), rod_pendulum(2.5), chain((0.4, -0.2))])
def test_without_losses_a_motion_turned_back_returns_to_its_start(scene: Scene) -> None:
    there = simulate(scene, 2)
    turned = tuple(
        replace(
            body,
            position=tuple(there.poses[-1, k, :2].tolist()),
            angle=float(there.poses[-1, k, 2]),
            velocity=tuple((-there.velocities[-1, k]).tolist()),
        )
        for k, body in enumerate(scene.bodies)
    )
    back = simulate(replace(scene, bodies=turned), 2)
    assert off(back.poses[-1], there.poses[0], 1.0) < 1e-7


@modes
@SCENES
@given(scenes(), scenes())
def test_bodies_that_have_nothing_to_do_with_each_other_move_to_the_bit_as_if_alone(
    mode: Mode, one: Scene, other: Scene
) -> None:
    far = renamed(other, "'", (100.0, 0.0))
    alone, both = simulate(one, 0.5, mode=mode), simulate(together(one, far), 0.5, mode=mode)
    there = simulate(far, 0.5, mode=mode)
    for scene, single in ((one, alone), (far, there)):
        for body in scene.bodies:
            column, same = single.column(body.label), both.column(body.label)
            assert np.array_equal(single.poses[:, column], both.poses[:, same])
            assert np.array_equal(single.velocities[:, column], both.velocities[:, same])


def test_bodies_on_one_floor_that_do_not_meet_move_to_the_bit_as_if_alone() -> None:
    ball, ground = disc("A", 0, 0.8, material=Material(0.7)), floor(Material(friction=0.3))
    others = (disc("far", 9, 3.0, velocity=(1, 0, 0)), box("still", -5, 0.2, 0.6, 0.4))
    alone = simulate(Scene((ball, ground)), 2)
    for crowd in ((ball, ground, *others), (*others, ground, ball)):
        moved = simulate(Scene(crowd), 2)
        assert np.array_equal(alone.path("A"), moved.path("A"))


# The same bits again ----------------------------------------------------------------------------


def digests(motions: list[Trajectory]) -> list[str]:
    return [moved.digest() for moved in motions]


@modes
@settings(SCENES, max_examples=8)
@given(st.lists(scenes(), min_size=2, max_size=5))
def test_a_scene_moves_to_the_bit_the_same_again_alone_or_among_others_on_any_number_of_threads(
    mode: Mode, many: list[Scene]
) -> None:
    alone = digests([simulate(scene, 0.5, mode=mode) for scene in many])
    for threads in (1, 2):
        assert digests(simulate_many(many, 0.5, threads=threads, mode=mode)) == alone


SCRIPT = """
import pickle, sys
from physics.engine import simulate
for scene in pickle.load(sys.stdin.buffer):
    print(simulate(scene, 1.5).digest())
"""


def test_another_process_finds_the_same_bits() -> None:
    boxes = (box(f"B{k}", 0.1 * k, 0.6 + 0.7 * k, 0.6, 0.4) for k in range(4))
    pile = Scene((floor(Material(0.3, 0.4)), *boxes))
    many = [pile, chain((0.5, 0.1, -0.3)), pendulum(1.0), rod_pendulum(2.0)]
    ran = subprocess.run(
        [sys.executable, "-c", SCRIPT], input=pickle.dumps(many), capture_output=True, check=True, timeout=300
    )
    assert ran.stdout.decode().split() == digests([simulate(scene, 1.5) for scene in many])


@modes
@SCENES
@given(scenes(), st.lists(st.floats(0, 1.5), max_size=3), st.booleans())
def test_a_run_stopped_at_any_time_and_resumed_equals_one_that_is_not(
    mode: Mode, scene: Scene, stops: list[float], frozen: bool
) -> None:
    whole = simulate(scene, 1.5, mode=mode)
    run = Simulation(scene, mode=mode)
    for stop in sorted(stops):
        run.run_to(stop)
        if frozen:
            run = pickle.loads(pickle.dumps(run))
    run.run_to(1.5)
    moved = run.trajectory(60)
    assert moved.digest() == whole.digest()
    assert moved.events == whole.events
    assert moved.bodies == whole.bodies and dict(moved.modes) == dict(whole.modes)
    assert np.array_equal(moved.energy.dissipated, whole.energy.dissipated)


def test_a_simulation_shows_what_it_has_run_so_far() -> None:
    run = Simulation(pendulum(1.0))
    assert run.trajectory(60).times.tolist() == [0.0]
    run.run_to(0.5)
    whole = simulate(pendulum(1.0), 2)
    so_far = run.trajectory(60)
    assert np.array_equal(so_far.times, np.arange(31) / 60)
    assert np.array_equal(so_far.poses, whole.poses[:31])
    assert np.array_equal(run.trajectory(20).poses, whole.poses[:31:3])


# Dense output -----------------------------------------------------------------------------------


@modes
@SCENES
@given(scenes())
def test_the_motion_at_the_times_of_its_frames_is_its_frames(mode: Mode, scene: Scene) -> None:
    moved = simulate(scene, 0.5, mode=mode)
    again = moved.at(moved.times)
    assert again.digest() == moved.digest()
    few = moved.at(moved.times[3:20:4])
    assert np.array_equal(few.poses, moved.poses[3:20:4])
    assert np.array_equal(few.accelerations, moved.accelerations[3:20:4])
    fine = simulate(scene, 0.5, 240, mode=mode)
    assert np.array_equal(fine.poses[::4], moved.poses)


@SCENES
@given(scenes(), st.lists(st.floats(0.001, 0.999), min_size=1, max_size=20, unique=True))
def test_velocity_and_acceleration_are_the_slopes_of_place_and_velocity(
    scene: Scene, times: list[float]
) -> None:
    moved, near = simulate(scene, 1, mode="exact"), 1e-5
    kinks = np.array([event.time for event in moved.events] or [-1.0])
    at = np.array([time for time in sorted(times) if np.abs(kinks - time).min() > 2 * near])
    if not len(at):
        return
    before, now, after = (moved.at(at + shift) for shift in (-near, 0.0, near))
    scale = 1 + np.abs(moved.velocities).max() + np.abs(moved.accelerations).max()
    assert off((after.poses - before.poses) / (2 * near), now.velocities, scale) < 1e-6
    assert off((after.velocities - before.velocities) / (2 * near), now.accelerations, scale**2) < 1e-5


def test_a_closer_accuracy_costs_steps_and_gains_digits() -> None:
    finest = simulate(chain((1.0, 0.5)), 3, accuracy=1e-13).poses[-1]
    errors = [
        np.abs(simulate(chain((1.0, 0.5)), 3, accuracy=accuracy).poses[-1] - finest).max()
        for accuracy in (1e-4, 1e-7, 1e-10)
    ]
    assert errors[0] > 10 * errors[1] > 100 * errors[2]


def test_until_keeps_the_frames_and_events_up_to_a_time() -> None:
    moved = simulate(Scene((disc("A", 0, 1.25), floor())), 2)
    part = moved.until(1.0)
    assert part.times[-1] == 1.0
    assert np.array_equal(part.poses, moved.poses[:61])
    assert part.events == tuple(event for event in moved.events if event.time <= 1.0)
    assert np.array_equal(part.energy.kinetic, moved.energy.kinetic[:61])


# The border -------------------------------------------------------------------------------------


def test_frames_are_on_the_grid_from_zero_to_the_end() -> None:
    moved = simulate(Scene((disc("A", 0, 0),)), 1.5, 40)
    assert np.array_equal(moved.times, np.arange(61) / 40)
    assert simulate(Scene(), 0).times.tolist() == [0.0]
    assert simulate_many([], 1) == []
    assert simulate(Scene((disc("A", 0, 0),)), 0.99, 1).times.tolist() == [0.0]


def test_events_come_in_the_order_of_their_times_within_the_run() -> None:
    bodies = (disc("A", 0, 1.25), disc("B", 2, 0.75, material=Material(0.9)), floor())
    times = [event.time for event in simulate(Scene(bodies), 2).events]
    assert times == sorted(times) and len(times) > 5
    assert times[0] >= 0 and times[-1] <= 2


@pytest.mark.parametrize("mode", ["auto", "exact", "robust"])
def test_every_movable_body_has_the_mode_that_it_was_moved_in(mode: str) -> None:
    bob, rope = disc("bob", 4, 3, 0.1), wire("W", "bob", (5.0, 4.0), sqrt(2))
    scene = Scene((disc("A", 0, 1.25), floor(), bob), wires=(rope,))
    moved = simulate(scene, 1, mode=mode)
    assert set(moved.modes) == {"A", "bob"}
    assert set(moved.modes.values()) == {"robust" if mode == "robust" else "exact"}


def test_auto_is_exact_for_few_contacts_and_says_so_where_it_is_robust() -> None:
    few = Scene((disc("A", 0, 1.25), floor()), (spring("S", "A", (3, 3), 1.0, 20.0),))
    assert simulate(few, 1).digest() == simulate(few, 1, mode="exact").digest()
    # Each row lies in the gaps of the one below.
    rows = [divmod(k, 8) for k in range(64)]
    heap = tuple(disc(f"B{r}{c}", 0.51 * c + 0.25 * (r % 2), 0.3 + 0.5 * r) for r, c in rows)
    moved = simulate(Scene((*heap, floor(Material(friction=0.3)))), 0.5)
    assert "robust" in moved.modes.values() and events(moved, "robust")


@pytest.mark.parametrize("seconds, rate", [(-1, 60), (float("nan"), 60), (1, 0), (1, -5), (float("inf"), 60)])
def test_times_that_are_none_are_refused(seconds: float, rate: float) -> None:
    with pytest.raises(SceneError, match="positive"):
        simulate(Scene(), seconds, rate)
    with pytest.raises(SceneError, match="positive"):
        simulate_many([Scene()], seconds, rate)


@pytest.mark.parametrize("accuracy", [0.0, -1e-9, float("nan"), float("inf"), 1.0])
def test_accuracies_that_are_none_are_refused(accuracy: float) -> None:
    with pytest.raises(SceneError, match="accuracy"):
        simulate(pendulum(1.0), 1, accuracy=accuracy)


def test_modes_and_threads_that_are_none_are_refused() -> None:
    with pytest.raises(SceneError, match="mode"):
        simulate(pendulum(1.0), 1, mode="fast")
    with pytest.raises(SceneError, match="thread"):
        simulate_many([pendulum(1.0)], 1, threads=0)
