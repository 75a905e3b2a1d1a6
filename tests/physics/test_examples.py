"""The two worked examples (E6, E7), from a page to its outcome; and the defaults of a bare page."""

from __future__ import annotations

from math import pi, radians, sin, sqrt

import numpy as np
import pytest
from physics_pages import ball_on_incline, box_on_wires, page, rectangle

from physics.outcome import outcome
from physics.pipeline import move
from sketch.page import Component
from sketch.shapes import Circle, Spring, Wire


@pytest.mark.parametrize(("share", "fate"), [(1.0, "rolls"), (0.9, "bounces"), (1.1, "flies off")])
@pytest.mark.parametrize(("drawn", "gap"), [(pi / 6, 0.0), (radians(33), 5.0), (radians(27), -4.0)])
def test_the_ball_does_what_the_normal_force_says_however_roughly_it_is_drawn(
    share: float, fate: str, drawn: float, gap: float
) -> None:
    motion = move(ball_on_incline(share, pi / 6, drawn, gap), 0.9)
    assert outcome(motion).fates == {"B": fate}
    assert motion.notices == ()
    if share == 1.0:
        speed = motion.trajectory.speed("B")
        assert np.abs(speed - 9.81 * sin(pi / 6) * motion.trajectory.times).max() < 1e-9


@pytest.mark.parametrize("lean", [0.0, 0.08, -0.08])
def test_the_box_stays_on_two_right_tensions(lean: float) -> None:
    motion = move(box_on_wires("5 sqrt(2)", "5 sqrt(2)", lean), 10)
    assert outcome(motion).fates == {"E": "stays"}
    assert not outcome(motion).broken
    assert np.abs(motion.trajectory.poses - motion.trajectory.poses[0]).max() < 1e-6


@pytest.mark.parametrize(("left", "right"), [("6", "5 sqrt(2)"), ("5 sqrt(2)", "8"), ("6", "6"), ("8", "8")])
def test_the_box_moves_and_breaks_a_wire_on_wrong_tensions(left: str, right: str) -> None:
    found = outcome(move(box_on_wires(left, right), 2))
    assert found.fates["E"] != "stays"
    assert found.broken


def test_a_page_without_mathematics_moves_by_its_defaults() -> None:
    ball = Component(Circle((200.0, 100.0), 50.0), label="A")
    motion = move(page((ball,)), 0.5)
    body = motion.scene.body("A")
    assert body.mass == pytest.approx(pi * 0.25)
    assert outcome(motion).fates == {"A": "falls"}
    t = motion.trajectory.times
    assert np.abs(motion.trajectory.path("A")[:, 1] - (-1.0 - 9.81 / 2 * t**2)).max() < 1e-12


def test_a_hanging_ball_swings_and_a_spring_is_as_long_at_rest_as_drawn() -> None:
    ceiling = Component(rectangle(100, 0, 300, 40), label="A", fixed=True)
    bob = Component(Circle((300.0, 180.0), 20.0), label="B")
    wire = Component(
        Wire((200.0, 40.0), (300 - 20 / sqrt(2.96) * 1.0, 180 - 20 / sqrt(2.96) * 1.4)),
        label="C",
        ends=("A", "B"),
    )
    assert outcome(move(page((ceiling, bob, wire)), 2)).fates == {"B": "swings"}
    mass = Component(Circle((200.0, 160.0), 20.0), label="B")
    spring = Component(Spring((200.0, 40.0), (200.0, 140.0), 5, 20), label="C", ends=("A", "B"))
    motion = move(page((ceiling, mass, spring), (("m = 1", "B", None), ("k = 40", "C", None))), 2)
    lowest = motion.trajectory.path("B")[:, 1].min()
    assert lowest == pytest.approx(-1.6 - 2 * 9.81 / 40, abs=2e-3)
    assert outcome(motion).fates == {"B": "swings"}


def test_a_struck_ball_rolls_along_the_floor_and_a_dropped_one_bounces() -> None:
    ground = Component(rectangle(0, 300, 600, 340), label="F", fixed=True)
    first = Component(Circle((100.0, 270.0), 30.0), label="A")
    second = Component(Circle((300.0, 270.0), 30.0), label="B")
    motion = move(page((ground, first, second), (("v_x = 2", "A", None),)), 1.5)
    assert outcome(motion).fates == {"A": "rolls", "B": "rolls"}
    # Equal masses, restitution ½: a quarter of the speed stays, three quarters go on.
    assert motion.trajectory.velocities[-1, motion.trajectory.column("A"), 0] == pytest.approx(0.5)
    assert motion.trajectory.velocities[-1, motion.trajectory.column("B"), 0] == pytest.approx(1.5)
    dropped = Component(Circle((300.0, 100.0), 30.0), label="A")
    motion = move(page((ground, dropped), (("e = 0.9", "A", None),)), 3)
    assert outcome(motion).fates == {"A": "bounces"}


def test_a_constant_of_one_thing_serves_another_and_vectors_push() -> None:
    ground = Component(rectangle(0, 300, 600, 340), label="F", fixed=True)
    block = Component(rectangle(100, 260, 160, 300), label="A")
    remarks = (("k = 3", "F", None), ("m = 2", "A", None), ("F = (2 k, 0)", "A", None))
    motion = move(page((ground, block), remarks), 1)
    assert np.abs(motion.trajectory.path("A")[:, 0] - 1.3 - 1.5 * motion.trajectory.times**2).max() < 1e-9
    assert motion.notices == ()


def test_drag_slows_a_ball_as_the_exponential_does() -> None:
    ball = Component(Circle((100.0, 100.0), 30.0), label="A")
    remarks = (
        ("g = 0", None, None),
        ("m = 2", "A", None),
        ("v_x = 3", "A", None),
        ("mu = 1", "A", None),
        ("F = -mu v", "A", None),
    )
    motion = move(page((ball,), remarks), 2)
    assert np.abs(motion.trajectory.speed("A") - 3 * np.exp(-motion.trajectory.times / 2)).max() < 5e-3
