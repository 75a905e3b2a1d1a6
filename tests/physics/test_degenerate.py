"""Scenes at the edge of sense: refused with a reason, or moved soundly."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import asin, hypot, sqrt

import numpy as np
import pytest
from physics_scenes import (
    G,
    T,
    atwood,
    block,
    box,
    disc,
    events,
    floor,
    force,
    ledger,
    mechanical,
    off,
    overlap,
    pendulum,
    place_course,
    size_of,
    sound,
    spring,
    stays,
    wire,
)

from physics.engine import simulate
from physics.scene import (
    Anchor,
    Block,
    Body,
    Disc,
    Edge,
    Material,
    Pin,
    Pulley,
    Scene,
    SceneError,
    SpringLink,
    Support,
    WireLink,
)
from physics.trajectory import Mode

WEIGHTLESS = (0.0, 0.0)
modes = pytest.mark.parametrize("mode", ["exact", "robust"])


# Refused ----------------------------------------------------------------------------------------

A, B = Anchor("A", (0, 0)), Anchor("B", (0, 0))
WALL = Anchor(None, (1, 1))
ONE, TWO = disc("A", 0, 0), disc("B", 2, 0)


def over(wheel: Body, at: str = "wheel", end: Anchor = B) -> Scene:
    bent = WireLink("W", A, end, 9.0, over=Pulley(at, clockwise=True))
    return Scene((disc("A", -2, -2), disc("B", 2, -2), wheel), wires=(bent,))


REFUSED: list[tuple[Callable[[], object], str]] = [
    (lambda: disc("A", 0, 0, mass=0.0), "mass"),
    (lambda: disc("A", 0, 0, mass=-1.0), "mass"),
    (lambda: Body("A", Disc(1.0), (0, 0), 1, 0.0), "inertia"),
    (lambda: Body("A", Disc(0.0), (0, 0), 1, 1), "radius"),
    (lambda: Body("A", Disc(1.0), (float("nan"), 0), 1, 1), "finite"),
    (lambda: Body("A", Disc(1.0), (0, 0), float("inf"), 1), "finite"),
    (lambda: Body("A", Block(((0, 0), (1, 0), (2, 0))), (0, 0), 1, 1), "area"),
    (lambda: Body("A", Block(((0, 0), (1, 0))), (0, 0), 1, 1), "area"),
    (lambda: Body("A", Block(((0, 0), (1, 1), (1, 0))), (0, 0), 1, 1), "anti-clockwise"),
    (lambda: Body("A", Block(((-1, -1), (1, -1), (0, 0), (1, 1))), (0, 0), 1, 1), "convex"),
    (lambda: disc("A", 0, 0, material=Material(1.5)), "restitution"),
    (lambda: disc("A", 0, 0, material=Material(None, -0.1)), "friction"),
    (lambda: disc("A", 0, 0, velocity=(1, 0, 0), fixed=True), "fixed"),
    (lambda: Scene((ONE, ONE)), "twice"),
    (lambda: Scene((ONE, TWO), wires=(WireLink("A", A, WALL, 1.0),)), "twice"),
    (lambda: Scene((ONE,), gravity=(0.0, float("nan"))), "finite"),
    (lambda: Scene((ONE,), wires=(WireLink("W", A, WALL, 0.0),)), "length"),
    (lambda: Scene((ONE,), wires=(WireLink("W", A, B, 1.0),)), "not there"),
    (lambda: Scene((ONE,), wires=(WireLink("W", A, A, 1.0),)), "both ends"),
    (lambda: Scene((ONE,), wires=(WireLink("W", A, WALL, 1.0, limit=-1.0),)), "tension"),
    (lambda: Scene((ONE,), wires=(WireLink("W", A, WALL, 1.0, tolerance=0.0),)), "tolerance"),
    (lambda: Scene((ONE,), (SpringLink("S", A, WALL, 1.0, -1.0),)), "stiffness"),
    (lambda: Scene((ONE,), (SpringLink("S", A, WALL, 1.0, 1.0, -1.0),)), "zero"),
    (lambda: Scene((ONE,), pins=(Pin("P", A, A),)), "both ends"),
    (lambda: Scene((ONE,), forces=(force("F", "B", 1.0),)), "not there"),
    (lambda: Scene((ONE,), courses=(place_course("x", "B", "x", T),)), "not there"),
    (lambda: Scene((ONE,), courses=(place_course("x", "A", "x", T),) * 2), "second"),
    (lambda: Scene((disc("A", 0, 0, fixed=True),), courses=(place_course("x", "A", "x", T),)), "fixed"),
    (lambda: over(disc("wheel", 0, 0)), "fixed disc"),
    (lambda: over(box("wheel", 0, 0, 1, 1, fixed=True)), "fixed disc"),
    (lambda: over(disc("wheel", 0, 0, fixed=True), "nobody"), "fixed disc"),
    (lambda: over(disc("wheel", 0, 0, fixed=True), end=Anchor("wheel", (0, 0))), "ends on"),
    (lambda: over(disc("wheel", -2, -2, fixed=True)), "inside"),
]


@pytest.mark.parametrize(
    ("make", "said"), REFUSED, ids=[f"{k}-{said}" for k, (_, said) in enumerate(REFUSED)]
)
def test_what_cannot_be_moved_is_refused_with_a_reason(make: Callable[[], object], said: str) -> None:
    with pytest.raises(SceneError, match=said):
        make()


def test_a_given_support_must_name_an_edge_of_the_block_that_it_stands_for() -> None:
    push = force("N", "A", 1.0).x
    with pytest.raises(SceneError, match="edges"):
        Scene((ONE, floor()), supports=(Support("N", "A", "floor", push, None),))
    with pytest.raises(SceneError, match="cannot support"):
        Scene((ONE, floor()), supports=(Support("N", "A", "A", push, Edge((0, 0), (1, 0))),))


# Overlapping at the start -----------------------------------------------------------------------


@modes
@pytest.mark.parametrize("gap", [1e-9, 1e-3, 0.1, 0.4, 0.499999])
def test_discs_drawn_into_each_other_are_moved_apart_before_the_start_and_stay(
    gap: float, mode: Mode
) -> None:
    scene = Scene((disc("A", 0, 0), disc("B", 0.5 - gap, 0, mass=3.0)), gravity=WEIGHTLESS)
    moved = simulate(scene, 1, mode=mode)
    sound(moved, scene)
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-9
    # Apart along the line of centres, and no farther than need be.
    assert hypot(*(moved.path("A")[0] - moved.path("B")[0])) == pytest.approx(0.5, abs=1e-6)
    if gap > 1e-6:
        assert [set(event.bodies) for event in events(moved, "separated")] == [{"A", "B"}]
        assert events(moved, "separated")[0].time == 0.0


@modes
def test_concentric_discs_are_moved_apart_in_some_direction(mode: Mode) -> None:
    scene = Scene((disc("A", 1, 1), disc("B", 1, 1)), gravity=WEIGHTLESS)
    moved = simulate(scene, 1, mode=mode)
    sound(moved, scene)
    assert not moved.velocities.any()


@modes
@pytest.mark.parametrize("body", [disc("A", 0, 0, 0.2), box("A", 0, 0, 0.6, 0.4)], ids=["disc", "box"])
@pytest.mark.parametrize("deep", [1e-3, 0.1, 0.3])
def test_a_body_drawn_into_the_floor_stands_on_it_without_being_thrown_up(
    body: Body, deep: float, mode: Mode
) -> None:
    scene = Scene((replace(body, position=(0.0, 0.2 - deep)), floor(Material(friction=0.5))))
    moved = simulate(scene, 1, mode=mode)
    sound(moved, scene, 1e-3 if mode == "robust" else 1e-6)
    assert off(moved.path("A"), np.array([0.0, 0.2]), 1.0) < (1e-3 if mode == "robust" else 1e-6)
    assert np.abs(moved.velocities).max() < (1e-2 if mode == "robust" else 1e-9)
    assert [event.kind for event in moved.events if event.kind == "separated"] == ["separated"]


def test_two_boxes_drawn_crossed_are_moved_apart_by_the_shortest_way() -> None:
    scene = Scene((box("A", 0, 0, 1.0, 1.0), box("B", 0.9, 0.2, 1.0, 1.0)), gravity=WEIGHTLESS)
    moved = simulate(scene, 1)
    sound(moved, scene)
    assert moved.path("B")[0, 0] - moved.path("A")[0, 0] == pytest.approx(1.0, abs=1e-6)
    assert moved.path("B")[0, 1] - moved.path("A")[0, 1] == pytest.approx(0.2, abs=1e-6)


@modes
@pytest.mark.parametrize("body", [disc("A", 0, 0, 0.2), box("A", 0, 0, 0.3, 0.2)], ids=["disc", "box"])
@pytest.mark.parametrize("at", [(-0.5, 0.1), (0.0, 0.3), (0.9, 0.02)])
def test_what_is_drawn_within_a_slope_on_its_floor_is_taken_out_of_both(
    body: Body, at: tuple[float, float], mode: Mode
) -> None:
    slope = block("slope", 0, 0.5, ((-1.0, -0.5), (2.0, -0.5), (-1.0, 1.0)), fixed=True)
    scene = Scene((replace(body, position=at), floor(), slope))
    moved = simulate(scene, 1, mode=mode)
    assert overlap(moved, scene) < (1e-3 if mode == "robust" else 1e-6)
    assert moved.path("A")[0, 1] > 0.0
    if mode == "exact":
        sound(moved, scene)


def test_a_disc_jammed_between_a_floor_and_a_ceiling_too_near_stays_finite_and_slow() -> None:
    scene = Scene((disc("A", 0, 0.2, 0.25), floor(), box("ceiling", 0, 0.9, 4, 1, fixed=True)))
    moved = simulate(scene, 1)
    assert np.isfinite(moved.poses).all()
    assert np.abs(moved.velocities).max() < 10


# Mass ratios ------------------------------------------------------------------------------------


@modes
@pytest.mark.parametrize("masses", [(1e-3, 1e3), (1e3, 1e-3), (1.0, 1e6), (1e6, 1.0)])
def test_a_stack_of_a_million_to_one_stays_and_carries_its_weight(
    masses: tuple[float, float], mode: Mode
) -> None:
    low, high = masses
    bodies = (floor(), box("low", 0, 0.2, 0.6, 0.4, low), box("high", 0.05, 0.6, 0.6, 0.4, high))
    moved = simulate(Scene(bodies), 3, mode=mode)
    assert off(moved.poses, moved.poses[0], 1.0) < (1e-9 if mode == "exact" else 1e-3)
    if mode == "exact":
        weight = (low + high) * G
        assert off(moved.force("contact with floor", "low").values, np.array([0, weight]), weight) < 1e-9
        assert off(moved.force("contact with low", "high").values, np.array([0, high * G]), high * G) < 1e-9


def test_a_grain_bounces_off_a_boulder_and_a_boulder_goes_on_through_a_grain() -> None:
    for grain, boulder in ((2.0, 0.0), (0.0, 2.0)):
        bodies = (
            disc("grain", -1, 0, mass=1e-3, velocity=(grain, 0, 0), material=Material(1.0)),
            disc("boulder", 1, 0, mass=1e3, velocity=(-boulder, 0, 0)),
        )
        moved = simulate(Scene(bodies, gravity=WEIGHTLESS), 1.5)
        total, speed = 1e3 + 1e-3, grain + boulder
        wanted = np.array([grain - 2e3 / total * speed, -boulder + 2e-3 / total * speed])
        assert off(moved.velocities[-1, :, 0], wanted, 4.0) < 1e-12


@pytest.mark.parametrize("masses", [(1e-3, 1e3), (1e3, 1e-3)])
def test_two_bobs_of_a_million_to_one_hang_on_one_string(masses: tuple[float, float]) -> None:
    bodies = tuple(disc(f"B{k}", 0, -1.0 - k, 0.05, mass) for k, mass in enumerate(masses))
    links = (wire("top", "B0", (0.0, 0.0), 1.0), wire("low", "B1", "B0", 1.0))
    moved = simulate(Scene(bodies, wires=links), 3)
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-10
    assert off(size_of(moved, "T of low", "B1"), masses[1] * G, masses[1] * G) < 1e-9
    assert off(size_of(moved, "T of top", "B0"), sum(masses) * G, sum(masses) * G) < 1e-9


# Links at their limits --------------------------------------------------------------------------


def test_a_wire_with_both_ends_at_one_place_lets_its_body_fall_to_its_length() -> None:
    moved = simulate(Scene((disc("A", 0, 0),), wires=(wire("W", "A", (0.0, 0.0), 1.0),)), 2)
    fall = sqrt(2 / G)
    assert [event.time for event in events(moved, "taut")] == [pytest.approx(fall, abs=1e-9)]
    assert off(moved.path("A")[moved.times > fall], np.array([0.0, -1.0]), 1.0) < 1e-9


def test_a_wire_drawn_longer_than_it_is_pulls_its_body_in_before_the_start() -> None:
    scene = Scene((disc("A", 0, -1.3, 0.1),), wires=(wire("W", "A", (0.0, 0.0), 1.0),))
    moved = simulate(scene, 1)
    assert off(moved.path("A"), np.array([0.0, -1.0]), 1.0) < 1e-9
    assert off(moved.velocities, 0.0, 1.0) < 1e-9


def test_a_pin_drawn_with_its_ends_apart_brings_them_together_before_the_start() -> None:
    scene = Scene(
        (disc("A", 0, -1.0, 0.1),), pins=(Pin("P", Anchor("A", (0.0, 0.8)), Anchor(None, (0.0, 0.0))),)
    )
    moved = simulate(scene, 1)
    ends = moved.anchors["P"]
    assert off(ends[:, 0], ends[:, 1], 1.0) < 1e-9
    assert off(moved.velocities, 0.0, 1.0) < 1e-9


def test_a_spring_with_both_ends_at_one_place_has_no_direction_and_no_force() -> None:
    scene = Scene((disc("A", 0, 0),), (spring("S", "A", (0.0, 0.0), 1.0, 50.0),), gravity=WEIGHTLESS)
    moved = simulate(scene, 2)
    assert np.isfinite(moved.poses).all()
    assert off(ledger(moved), ledger(moved)[0], 25.0) < 1e-6


def test_a_spring_that_a_body_flies_through_keeps_its_energy() -> None:
    # Through the other end, where its direction turns about: it swings between ±1.2.
    scene = Scene((disc("A", 1.2, 0),), (spring("S", "A", (0.0, 0.0), 0.5, 50.0),), gravity=WEIGHTLESS)
    moved = simulate(scene, 3)
    assert off(mechanical(moved), 0.5 * 50 * 0.7**2, 0.5 * 50 * 0.7**2) < 1e-6
    assert off(moved.path("A")[:, 1], 0.0, 1.0) < 1e-9


def test_wires_between_what_is_fixed_do_nothing() -> None:
    fixed = (disc("A", 0, 0, fixed=True), disc("B", 2, 0, fixed=True))
    links = (wire("W", "A", "B", 1.0), wire("V", "A", (0.0, 5.0), 9.0))
    moved = simulate(Scene((*fixed, disc("free", 9, 0)), wires=links), 1)
    assert stays(moved, "A") and stays(moved, "B")
    assert off(moved.path("free")[:, 1], -G / 2 * moved.times**2, G) < 1e-12


def test_a_very_stiff_spring_and_a_very_soft_one_move_their_load_soundly() -> None:
    for stiffness in (1e7, 1e-9, 0.0):
        scene = Scene((disc("A", 0, -1.0),), (spring("S", "A", (0.0, 0.0), 1.0, stiffness),))
        moved = simulate(scene, 0.2)
        sound(moved, scene)
        if stiffness < 1:
            assert off(moved.path("A")[:, 1], -1 - G / 2 * moved.times**2, G) < 1e-9
        else:
            assert off(moved.path("A")[:, 1], -1.0, 1.0) < 2.01 * G / stiffness


@modes
def test_a_load_pulled_up_to_its_pulley_and_beyond_stays_on_its_wire(mode: Mode) -> None:
    scene = atwood(0.1, 5.0)
    moved = simulate(scene, 2, mode=mode)
    if mode == "exact":
        sound(moved, scene)
    # Small steps err by a little each time the load whips round: of a kilojoule turned over, not more than this.
    assert mechanical(moved).max() < mechanical(moved)[0] + 0.1
    assert overlap(moved, scene, every=4) < 1e-3
    ends = moved.anchors["wire"]
    # However it goes round the wheel, a taut string from end to end is no longer than the wire.
    longest = scene.wires[0].rest + (1e-3 if mode == "robust" else 1e-9)
    assert np.hypot(*(ends[:, 0] - ends[:, 1]).T).max() <= longest


def test_a_wire_that_lifts_off_its_pulley_runs_straight_and_keeps_its_length() -> None:
    # The string bends a little over the wheel; the load is thrown up until it is straight, and falls back.
    wheel = disc("wheel", 0, 0, 0.2, fixed=True)
    load = disc("load", 2.0, 0.0, 0.05, velocity=(0, 3.0, 0))
    rest = 2 * sqrt(2.0**2 - 0.2**2) + 0.2 * 2 * asin(0.2 / 2.0)
    ends_of = Anchor(None, (-2.0, 0.0)), Anchor("load", (0.0, 0.0))
    rope = WireLink("rope", *ends_of, rest, over=Pulley("wheel", clockwise=True))
    scene = Scene((wheel, load), wires=(rope,))
    moved = simulate(scene, 2)
    sound(moved, scene)
    ends = moved.anchors["rope"]
    assert np.hypot(*(ends[:, 0] - ends[:, 1]).T).max() <= rope.rest + 1e-9


# Sizes and places -------------------------------------------------------------------------------


def test_a_pendulum_a_thousand_kilometres_away_swings_like_one_here() -> None:
    here = pendulum(1.0)
    bob, link = here.bodies[0], here.wires[0]
    far = replace(bob, position=(bob.position[0] + 1e6, bob.position[1] - 1e6))
    there = replace(link, end=Anchor(None, (1e6, -1e6)))
    near, distant = simulate(here, 3), simulate(Scene((far,), wires=(there,)), 3)
    assert off(distant.path("bob") - (1e6, -1e6), near.path("bob"), 1.0) < 1e-7


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("mode", ["exact", "robust"])
def test_bodies_of_a_millimetre_and_of_a_kilometre_bounce_and_rest_alike(size: float, mode: Mode) -> None:
    # Lengths times s and times times √s: the same motion.
    ground = box("floor", 0, -0.5 * size, 40 * size, size, fixed=True)
    scene = Scene((disc("A", 0, 1.25 * size, 0.25 * size, size**2), ground))
    moved = simulate(scene, 4 * sqrt(size), 60 / sqrt(size), mode=mode)
    rest = events(moved, "rest")
    if mode == "exact":
        assert rest[0].time == pytest.approx(3 * sqrt(2 * size / G), rel=1e-6)
    near = (1e-6 if mode == "exact" else 1e-3) * max(size, 1.0)
    assert moved.path("A")[-1, 1] == pytest.approx(0.25 * size, abs=near)
    assert overlap(moved, scene, every=8) < near


def test_what_rests_for_ten_thousand_seconds_rests() -> None:
    bodies = (floor(Material(friction=0.5)), box("A", 0, 0.2, 0.6, 0.4), box("B", 0.1, 0.6, 0.6, 0.4))
    moved = simulate(Scene(bodies), 10_000, 0.1)
    assert len(moved.times) == 1001
    for label in ("A", "B"):
        assert off(moved.poses[:, moved.column(label)], moved.poses[0, moved.column(label)], 1.0) < 1e-12


def test_a_page_of_fixed_bodies_alone_and_an_empty_page_stay() -> None:
    moved = simulate(Scene((floor(), box("A", 0, 2, 1, 1, fixed=True))), 5)
    assert stays(moved, "A") and not moved.events
    assert simulate(Scene(), 1).poses.shape == (61, 0, 3)


def test_without_gravity_and_forces_what_touches_stays_in_touch() -> None:
    bodies = (floor(), disc("A", 0, 0.25), box("B", 0.55, 0.25, 0.6, 0.5))
    moved = simulate(Scene(bodies, gravity=WEIGHTLESS), 5)
    assert stays(moved, "A") and stays(moved, "B")
