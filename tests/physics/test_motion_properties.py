"""What holds for any scene: momentum, energy, order, the same bits twice."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from physics_scenes import box, disc, floor

from physics.engine import simulate
from physics.scene import Anchor, Block, Body, Disc, Material, Scene, SceneError, SpringLink, WireLink

# A failing crowd says enough as it is; to shrink one takes minutes.
SCENES = settings(max_examples=25, deadline=None, phases=(Phase.explicit, Phase.reuse, Phase.generate))
number = st.floats(-1, 1)


@st.composite
def crowds(draw: st.DrawFn) -> tuple[Body, ...]:
    """Two to four solids on a loose grid, so that none overlap, moving at random."""
    bodies: list[Body] = []
    for k in range(draw(st.integers(2, 4))):
        x, y = 1.1 * (k % 2) + 0.1 * draw(number), 0.6 + 1.1 * (k // 2) + 0.1 * draw(number)
        velocity = (3 * draw(number), 3 * draw(number), 4 * draw(number))
        material = Material(draw(st.floats(0, 1)), draw(st.sampled_from([None, 0.0, 0.5])))
        mass = draw(st.floats(0.2, 5))
        if draw(st.booleans()):
            bodies.append(disc(f"B{k}", x, y, 0.35, mass, velocity, material))
        else:
            bodies.append(box(f"B{k}", x, y, 0.6, 0.5, mass, velocity, material))
    return tuple(bodies)


@SCENES
@given(crowds())
def test_momentum_is_kept_where_nothing_is_fixed(bodies: tuple[Body, ...]) -> None:
    moved = simulate(Scene(bodies, gravity=(0, 0)), 1)
    masses = np.array([body.mass for body in bodies])
    momentum = np.einsum("b,tbk->tk", masses, moved.velocities[:, :, :2])
    assert np.abs(momentum - momentum[0]).max() < 1e-9


@SCENES
@given(crowds())
def test_contacts_never_create_energy_and_the_ledger_balances(bodies: tuple[Body, ...]) -> None:
    moved = simulate(Scene((*bodies, floor(Material(0.5, 0.3)))), 1)
    energy = moved.energy
    total = energy.kinetic + energy.potential + energy.elastic
    scale = 1 + np.abs(total).max()
    assert np.diff(total).max() < 1e-3 * scale
    assert np.ptp(total + energy.dissipated - energy.worked) < 1e-6 * scale
    assert np.isfinite(moved.poses).all()


@SCENES
@given(crowds())
def test_nothing_falls_through_the_floor(bodies: tuple[Body, ...]) -> None:
    moved = simulate(Scene((*bodies, floor())), 2)
    heights = moved.poses[:, : len(bodies), 1]
    assert heights.min() > 0.25 - 0.05


@SCENES
@given(crowds())
def test_the_same_scene_moves_the_same_to_the_bit(bodies: tuple[Body, ...]) -> None:
    scene = Scene((*bodies, floor()))
    assert np.array_equal(simulate(scene, 0.5).poses, simulate(scene, 0.5).poses)


@SCENES
@given(st.floats(-pi, pi), number, number)
def test_turning_and_moving_the_world_turns_and_moves_the_motion(angle: float, dx: float, dy: float) -> None:
    def carried(x: float, y: float) -> tuple[float, float]:
        return cos(angle) * x - sin(angle) * y, sin(angle) * x + cos(angle) * y

    def scene(turned: bool) -> Scene:
        place = (
            (lambda x, y: tuple(np.add(carried(x, y), (dx, dy)).tolist()))
            if turned
            else (lambda x, y: (x, y))
        )
        turn = carried if turned else (lambda x, y: (x, y))
        bob = Body("bob", Disc(0.2), place(0.6, -0.8), 1.0, 0.02, velocity=(*turn(0.5, 0.0), 0.0))
        other = Body("other", Disc(0.2), place(1.5, -0.8), 2.0, 0.04)
        wire = WireLink("wire", Anchor("bob", (0, 0)), Anchor(None, place(0.0, 0.0)), 1.0)
        spring = SpringLink("spring", Anchor("other", (0, 0)), Anchor(None, place(1.5, 0.0)), 0.7, 30.0)
        return Scene((bob, other), (spring,), (wire,), gravity=turn(0.0, -9.81))

    plain, turned = simulate(scene(False), 0.5), simulate(scene(True), 0.5)
    for label in ("bob", "other"):
        wanted = [np.add(carried(x, y), (dx, dy)) for x, y in plain.path(label)]
        assert np.abs(turned.path(label) - wanted).max() < 1e-7


def test_bodies_that_do_not_meet_do_not_influence_each_other() -> None:
    alone = simulate(Scene((disc("A", 0, 0.8), floor())), 1)
    crowd = simulate(Scene((disc("A", 0, 0.8), floor(), disc("far", 9, 3.0, velocity=(1, 0, 0)))), 1)
    assert np.abs(alone.path("A") - crowd.path("A")).max() < 1e-9


def test_a_drawn_overlap_is_let_out_without_throwing_the_bodies_apart() -> None:
    moved = simulate(Scene((disc("A", 0, 0.2), floor())), 1)
    assert abs(moved.poses[-1, 0, 1] - 0.25) < 1e-3
    assert moved.speed("A").max() < 0.1


def test_frames_are_on_the_grid_from_zero_to_the_end() -> None:
    moved = simulate(Scene((disc("A", 0, 0),)), 1.5, 40)
    assert np.array_equal(moved.times, np.arange(61) / 40)
    assert simulate(Scene(), 0).times.tolist() == [0.0]


@pytest.mark.parametrize("seconds, rate", [(-1, 60), (float("nan"), 60), (1, 0), (float("inf"), 60)])
def test_times_that_are_none_are_refused(seconds: float, rate: float) -> None:
    with pytest.raises(SceneError, match="positive"):
        simulate(Scene(), seconds, rate)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: disc("A", 0, 0, mass=0.0), "mass"),
        (lambda: Body("A", Disc(0.0), (0, 0), 1, 1), "radius"),
        (lambda: Body("A", Disc(1.0), (float("nan"), 0), 1, 1), "finite"),
        (lambda: Body("A", Block(((0, 0), (1, 0), (2, 0))), (0, 0), 1, 1), "area"),
        (lambda: Body("A", Block(((0, 0), (1, 1), (1, 0))), (0, 0), 1, 1), "anti-clockwise"),
        (lambda: Body("A", Block(((-1, -1), (1, -1), (0, 0), (1, 1))), (0, 0), 1, 1), "convex"),
        (lambda: Scene((disc("A", 0, 0), disc("A", 1, 0))), "twice"),
        (
            lambda: Scene(
                (disc("A", 0, 0),), wires=(WireLink("W", Anchor("A", (0, 0)), Anchor(None, (0, 0)), 0.0),)
            ),
            "length",
        ),
        (
            lambda: Scene(
                (disc("A", 0, 0),), wires=(WireLink("W", Anchor("A", (0, 0)), Anchor("B", (0, 0)), 1.0),)
            ),
            "not there",
        ),
        (lambda: disc("A", 0, 0, material=Material(1.5)), "restitution"),
    ],
)
def test_what_cannot_be_moved_is_refused_with_a_reason(make: object, said: str) -> None:
    assert callable(make)
    with pytest.raises(SceneError, match=said):
        make()
