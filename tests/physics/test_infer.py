"""What a drawing implies: which way given forces act, what they replace, and what is seen of wrong ones."""

from __future__ import annotations

from math import cos, pi, radians, sin, sqrt

import numpy as np
import pytest
from physics_pages import ball_on_incline, box_on_wires, page, rectangle
from physics_workshop import shaken

from physics.build import build
from physics.infer import RULE, skin_of
from physics.outcome import outcome
from physics.pipeline import Motion, move
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon, Wire

G = 9.81
FLOOR = Component(rectangle(0, 300, 900, 340), label="F", fixed=True)
ANGLE = pi / 6


def gaps(motion: Motion, angle: float = ANGLE) -> np.ndarray:
    """How high the ball B is over the incline A through time, m."""
    incline, ball = motion.scene.body("A"), motion.scene.body("B")
    foot = np.array(incline.position) + min(incline.shape.vertices)
    out = np.array([-sin(angle), cos(angle)])
    return (motion.trajectory.path("B") - foot) @ out - ball.shape.radius


def drawn(share: float, noise: float) -> Sketch:
    """E6, exactly or as an unsteady hand leaves it."""
    exact = ball_on_incline(share)
    return exact if noise == 0 else shaken(exact, noise, 4)


@pytest.mark.parametrize("noise", [0.0, 0.7, 2.0])
def test_with_the_right_normal_force_speed_is_a_straight_line_of_slope_g_sin_theta(noise: float) -> None:
    motion = move(drawn(1.0, noise), 0.9)
    assert outcome(motion).fates == {"B": "rolls"}
    times = motion.trajectory.times
    np.testing.assert_allclose(motion.trajectory.speed("B"), G * sin(ANGLE) * times, rtol=1e-9)
    assert np.abs(gaps(motion)).max() < 1e-9
    assert motion.notices == ()


@pytest.mark.parametrize("noise", [0.0, 0.7, 2.0])
def test_with_nine_tenths_of_it_the_ball_sinks_by_what_is_missing_and_bounces(noise: float) -> None:
    motion = move(drawn(0.9, noise), 1.0)
    skin = skin_of(motion.scene.body("B"))
    assert motion.scene.supports[0].skin == skin
    assert skin > 0.05  # metres: 5 page units and more are seen
    into = 0.1 * G * cos(ANGLE)
    times, height = motion.trajectory.times, gaps(motion)
    bounces = [event.time for event in motion.trajectory.events if event.kind == "bounce"]
    # Down to the skin in sqrt(2 skin / a), up to the surface in as long, and down again; the foot is near then.
    sinks = sqrt(2 * skin / into)
    assert bounces == pytest.approx([sinks], rel=1e-6)
    assert height.min() == pytest.approx(-skin, rel=0.02)
    assert np.abs(height[np.abs(times - 2 * sinks) < 0.01]).max() < 1e-3
    phase = np.abs((times + sinks) % (2 * sinks) - sinks)
    np.testing.assert_allclose(height, -into * phase**2 / 2, atol=1e-6)
    assert outcome(motion).fates == {"B": "bounces"}


@pytest.mark.parametrize("noise", [0.0, 0.7, 2.0])
def test_with_eleven_tenths_of_it_the_ball_leaves_the_incline(noise: float) -> None:
    motion = move(drawn(1.1, noise), 0.9)
    times = motion.trajectory.times
    np.testing.assert_allclose(gaps(motion), 0.1 * G * cos(ANGLE) * times**2 / 2, atol=1e-9)
    assert outcome(motion).fates == {"B": "flies off"}
    assert gaps(motion)[-1] > 0.3


@pytest.mark.parametrize("noise", [0.0, 0.7, 2.0])
def test_with_both_tensions_right_the_box_stays_within_a_nanometre_for_ten_seconds(noise: float) -> None:
    exact = box_on_wires("5 sqrt(2)", "5 sqrt(2)")
    motion = move(exact if noise == 0 else shaken(exact, noise, 2), 10)
    poses = motion.trajectory.poses
    assert np.abs(poses - poses[0]).max() < 1e-9
    assert outcome(motion).fates == {"E": "stays"}
    assert not outcome(motion).broken


@pytest.mark.parametrize("noise", [0.0, 0.7, 2.0])
@pytest.mark.parametrize(("left", "right"), [("6", "5 sqrt(2)"), ("5 sqrt(2)", "6")])
def test_with_one_tension_at_six_the_box_moves_and_a_wire_breaks(left: str, right: str, noise: float) -> None:
    exact = box_on_wires(left, right)
    motion = move(exact if noise == 0 else shaken(exact, noise, 2), 2)
    found = outcome(motion)
    assert found.fates["E"] != "stays"
    first = next(event for event in motion.trajectory.events if event.kind == "break")
    assert first.bodies == (("C",) if left == "6" else ("D",))
    # It breaks when its length has left that of the equilibrium by the stated share.
    wire = next(wire for wire in motion.scene.wires if wire.label == first.bodies[0])
    assert wire.tolerance == RULE.yields * wire.rest
    start = motion.trajectory.at(np.array([0.01])).path("E")[0] - motion.trajectory.path("E")[0]
    missing = (sqrt(50) - 6) * (1 if left == "6" else -1)
    # From rest under what is missing along that wire, 1 kg.
    expected = np.array([missing, -abs(missing)]) / sqrt(2) * 0.01**2 / 2
    np.testing.assert_allclose(start, expected, rtol=1e-2)


def on_incline(kind: str, remarks: tuple[tuple[str, str | None, None], ...]) -> Sketch:
    """A ball or a block B of 1 kg upon the incline A of 30 degrees."""
    foot, base, up, out = (
        np.array([100.0, 400.0]),
        320.0,
        (cos(ANGLE), -sin(ANGLE)),
        (-sin(ANGLE), -cos(ANGLE)),
    )
    triangle = Polygon([foot, np.add(foot, (base, 0)), np.add(foot, (base, -base * np.tan(ANGLE)))])
    at = foot + 250 * np.array(up)
    if kind == "ball":
        centre = at + 25 * np.array(out)
        shape: Circle | Polygon = Circle((float(centre[0]), float(centre[1])), 25.0)
    else:
        corners = ((-25, 0), (25, 0), (25, 30), (-25, 30))
        shape = Polygon([at + a * np.array(up) + b * np.array(out) for a, b in corners])
    parts = (Component(triangle, label="A", fixed=True), Component(shape, label="B"))
    said = (("theta = pi/6", "A", (150.0, 390.0)), ("m = 1", "B", None), *remarks)
    return page(parts, said)


@pytest.mark.parametrize("kind", ["ball", "block"])
@pytest.mark.parametrize(
    "remarks",
    [
        (("f_k = 0.2*N", "B", None),),
        (("mu = 0.2", "B", None), ("f = mu N", "B", None)),
        (("f_1 = |W| cos(theta)", "B", None), ("f_2 = 0.2 |W| cos(theta)", "B", None)),
        (("f_2 = 0.2 |W| cos(theta)", "B", None), ("f_1 = |W| cos(theta)", "B", None)),
        (("N = |W| cos(theta)", "B", None), ("f_1 = N", "B", None), ("f_k = 0.2*N", "B", None)),
        (("mu_k = 0.2", "B", None), ("N = m g cos(theta)", "B", None), ("F_k = mu_k N", "B", None)),
    ],
)
def test_friction_that_is_given_acts_along_the_incline_against_the_motion(kind, remarks) -> None:
    motion = move(on_incline(kind, remarks), 0.6)
    assert not motion.notices
    speed = motion.trajectory.speed("B")
    slope = G * (sin(ANGLE) - 0.2 * cos(ANGLE))
    np.testing.assert_allclose(speed[1:], slope * motion.trajectory.times[1:], rtol=1e-9)


@pytest.mark.parametrize("kind", ["ball", "block"])
def test_friction_slows_what_goes_up_and_what_comes_down(kind: str) -> None:
    up = (("v_x = 2 cos(pi/6)", "B", None), ("v_y = 2 sin(pi/6)", "B", None), ("f_k = 0.2*N", "B", None))
    motion = move(on_incline(kind, up), 0.8)
    rising, sinking = (G * (sin(ANGLE) + share * cos(ANGLE)) for share in (0.2, -0.2))
    along = (motion.trajectory.path("B") - motion.trajectory.path("B")[0]) @ (cos(ANGLE), sin(ANGLE))
    turn = 2 / rising
    t = motion.trajectory.times
    top = 2 / rising
    expected = np.where(t < turn, 2 * t - rising * t**2 / 2, top * 1.0 - sinking * (t - turn) ** 2 / 2)
    np.testing.assert_allclose(along, expected, atol=1e-6)


def test_friction_that_can_hold_a_block_holds_it_and_nearly_holds_a_ball() -> None:
    much = (("f_s = 0.8*N", "B", None),)
    held = move(on_incline("block", much), 3.0)
    assert np.abs(held.trajectory.poses - held.trajectory.poses[0]).max() < 1e-9
    ball = move(on_incline("ball", much), 3.0)
    assert outcome(ball).fates == {"B": "stays"}
    assert ball.trajectory.speed("B").max() < RULE.creeps


def test_a_scalar_force_on_a_level_floor_stands_in_for_the_floor() -> None:
    box = Component(rectangle(100, 250, 160, 300), label="B")
    scene = build(page((FLOOR, box), (("N = m g", "B", None),))).scene
    (support,) = scene.supports
    assert (support.on, support.body) == ("F", "B")
    edge = support.edge
    assert edge is not None
    assert edge.start[1] == edge.end[1] == 0.2  # the upper side, whose outside is on its right
    assert edge.start[0] > edge.end[0]


def test_of_two_things_that_it_touches_a_solid_bears_on_the_one_below_it() -> None:
    wall = Component(rectangle(0, 0, 40, 300), label="W", fixed=True)
    ball = Component(Circle((70.0, 270.0), 30.0), label="B")
    (support,) = build(page((wall, FLOOR, ball), (("f_1 = 3", "B", None),))).scene.supports
    assert support.on == "F"


def test_what_cannot_be_inferred_is_told_and_not_used() -> None:
    free = Component(Circle((200.0, 100.0), 30.0), label="B")
    for text in ("f_1 = 3", "f_k = 2"):
        built = build(page((FLOOR, free), ((text, "B", None),)))
        assert built.scene.forces == built.scene.supports == ()
        assert any("rests on nothing" in notice and "(0, 5)" in notice for notice in built.notices)
    resting = Component(Circle((200.0, 270.0), 30.0), label="B")
    built = build(page((FLOOR, resting), (("f_k = -1", "B", None),)))
    assert any("not below zero" in notice for notice in built.notices)


def test_forces_on_what_is_fixed_are_told_and_so_is_a_second_normal_force() -> None:
    ball = Component(Circle((200.0, 270.0), 30.0), label="B")
    said = (("f = 3", "F", None), ("N = 4", "B", None), ("f_1 = 5", "B", None))
    built = build(page((FLOOR, ball), said))
    assert any("F is fixed" in notice for notice in built.notices)
    assert any("N = 4 and f_1 = 5" in notice for notice in built.notices)
    (support,) = built.scene.supports
    assert support.name == "f_1"
    assert built.scene.forces == ()


def test_without_an_association_the_engine_supplies_the_true_forces() -> None:
    ball = build(on_incline("ball", ())).scene
    assert ball.supports == ball.forces == ()
    motion = move(on_incline("block", ()), 0.5)
    contact = motion.trajectory.force("contact with A", "B").values
    np.testing.assert_allclose(np.hypot(*contact.T), G * cos(ANGLE), rtol=1e-9)
    block, bob = Component(rectangle(0, 0, 90, 30), label="A", fixed=True), Circle((45.0, 150.0), 20.0)
    wire = Component(Wire((45.0, 30.0), (45.0, 130.0)), label="C", ends=("A", "B"))
    hung = move(page((block, Component(bob, label="B"), wire), (("m = 2", "B", None),)), 1.0)
    assert hung.scene.wires[0].tension is None
    np.testing.assert_allclose(np.hypot(*hung.trajectory.force("T of C", "B").values.T), 2 * G, rtol=1e-9)


def test_friction_said_of_a_ball_replaces_the_engines_own() -> None:
    said = (("mu = 0.3", "B", None), ("f_k = mu N", "B", None))
    scene = build(on_incline("ball", said)).scene
    assert scene.body("B").material.friction == 0
    assert [force.name for force in scene.forces] == ["f_k"]
    slower = move(on_incline("ball", (("mu = 0.3", "B", None),)), 0.5)
    # The engine's own friction makes it roll: two thirds of g sin θ.
    assert slower.trajectory.speed("B")[-1] == pytest.approx(2 / 3 * G * sin(ANGLE) * 0.5, rel=1e-6)


def test_friction_ends_where_the_incline_ends() -> None:
    motion = move(on_incline("ball", (("f_k = 0.2*N", "B", None),)), 2.0)
    force = motion.trajectory.force("f_k", "B").values
    path = motion.trajectory.path("B")
    gone = path[:, 0] < 1.0 - 0.25
    assert gone.any()
    assert np.abs(force[gone]).max() == 0
    assert np.hypot(*force[:30].T)[1:] == pytest.approx(0.2 * G * cos(ANGLE))


def test_an_angle_in_degrees_of_the_drawn_page_is_not_what_the_force_follows_but_the_corrected_one() -> None:
    motion = move(ball_on_incline(1.0, pi / 6, radians(24), 3.0), 0.6)
    (support,) = motion.scene.supports
    assert support.edge is not None
    dx = support.edge.end[0] - support.edge.start[0]
    dy = support.edge.end[1] - support.edge.start[1]
    assert abs(dy / dx) == pytest.approx(np.tan(pi / 6), rel=1e-12)
