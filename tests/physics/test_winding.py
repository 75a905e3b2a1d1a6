"""Wires that wind round their pulleys and off them again: closed forms of the involute, and boxes at the rim."""

from __future__ import annotations

from dataclasses import replace
from math import acos, atan2, hypot, pi, sqrt
from typing import Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from physics_scenes import atwood, box, disc, mechanical, off, sound

from physics.engine import simulate
from physics.engine.wheel import drawn
from physics.scene import Anchor, Pulley, Scene, WireLink
from physics.trajectory import Mode

modes = pytest.mark.parametrize("mode", ["exact", "robust"])
RADIUS, FOOT = 0.3, 1.0
"""m: of the wheel; how far below the point of touch on its right the wire is tied to the page."""


def tethered(reach: float, speed: float, turned: float = 0.0) -> Scene:
    """A puck without weight on a wire from the page, up along the right of a wheel at the origin. reach: of the wire
    beyond the point of touch, m; turned: how far round the wheel it lies at the start, anti-clockwise, rad. The puck
    goes on round it with `speed`, m/s (negative: back)."""
    free = reach - RADIUS * turned
    c, s = np.cos(turned), np.sin(turned)
    place = (RADIUS * c - free * s, RADIUS * s + free * c)
    puck = disc("puck", *place, 0.01, velocity=(-speed * c, -speed * s, 0.0))
    tie = Anchor(None, (RADIUS, -FOOT)), Anchor("puck", (0.0, 0.0))
    wire = WireLink("wire", *tie, FOOT + reach, over=Pulley("wheel", clockwise=False))
    return Scene((disc("wheel", 0, 0, RADIUS, fixed=True), puck), wires=(wire,), gravity=(0.0, 0.0))


def free_part(path: np.ndarray) -> np.ndarray:
    """Of the wire, from the point of touch to the puck, m."""
    return np.sqrt(np.maximum((path**2).sum(axis=1) - RADIUS**2, 0.0))


@modes
def test_a_puck_winds_its_wire_round_a_wheel_again_and_again(mode: Mode) -> None:
    """The involute's arc: s² = s₀² − 2 r v t, at the same speed; 1.4 turns in all."""
    reach, speed = 3.0, 2.0
    moved = simulate(tethered(reach, speed), 7.0, mode=mode)
    near = 1e-8 if mode == "exact" else 2e-3
    wanted = np.sqrt(reach**2 - 2 * RADIUS * speed * moved.times)
    assert (reach - wanted[-1]) / RADIUS > 2.2 * pi
    assert off(free_part(moved.path("puck")), wanted, 1.0) < near
    assert off(np.hypot(*moved.velocities[:, moved.column("puck"), :2].T), speed, speed) < near
    if mode == "exact":
        assert moved.modes["puck"] == "exact"


@modes
def test_a_wire_winds_off_its_wheel_and_onto_its_other_side(mode: Mode) -> None:
    """Back along the involute, a circle about where it is tied, and the involute about the other tangent."""
    reach, speed, turned = 2.0, 2.0, 1.5 * pi
    scene = tethered(reach, -speed, turned)
    moved = simulate(scene, 12.0, mode=mode)
    near = 1e-7 if mode == "exact" else 5e-3
    start = reach - RADIUS * turned
    times, free = moved.times, free_part(moved.path("puck"))
    off_at = (reach**2 - start**2) / (2 * RADIUS * speed)
    # From straight up clockwise to the other tangent: a whole turn but twice the angle to the wheel's centre.
    on_at = off_at + (FOOT + reach) * (2 * pi - 2 * atan2(RADIUS, FOOT)) / speed
    first, circle, last = times < off_at, (times > off_at) & (times < on_at), times > on_at
    assert first.any() and circle.any() and last.sum() > 10
    assert off(free[first], np.sqrt(start**2 + 2 * RADIUS * speed * times[first]), 1.0) < near
    tie = np.array([RADIUS, -FOOT])
    assert off(np.hypot(*(moved.path("puck")[circle] - tie).T), FOOT + reach, 1.0) < near
    assert off(free[last], np.sqrt(reach**2 - 2 * RADIUS * speed * (times[last] - on_at)), 1.0) < near
    assert off(np.hypot(*moved.velocities[:, moved.column("puck"), :2].T), speed, speed) < near


@pytest.mark.parametrize("mode", ["auto", "robust"])
def test_a_wire_keeps_its_turns_when_its_puck_meets_a_body_that_had_nothing_to_do_with_it(
    mode: Literal["auto", "robust"],
) -> None:
    reach, speed = 3.0, 2.0
    alone = tethered(reach, speed)
    # Where the puck comes by after six seconds, wound by 5.5 rad.
    there = simulate(alone, 6.0).path("puck")[-1]
    scene = replace(alone, bodies=(*alone.bodies, disc("other", *there, 0.01)))
    moved = simulate(scene, 7.0, mode=mode)
    assert np.hypot(*moved.velocities[-1, moved.column("other"), :2]) > 0.25 * speed
    path = moved.path("puck")
    assert np.hypot(*np.diff(path, axis=0).T).max() < 1.01 * speed / 60
    turned = np.unwrap(np.arctan2(path[:, 1], path[:, 0])) - np.arctan2(free_part(path), RADIUS)
    assert (free_part(path) + RADIUS * turned).max() < reach + 1e-3


def test_a_box_pulled_over_the_edge_of_its_table_goes_into_the_wheel_and_on() -> None:
    bodies = (
        box("A", 1.2326, -1.5111, 0.652, 0.5433, 1.5),
        box("table", 1.8731, -1.98275, 2.9462, 0.4, fixed=True),
        disc("wheel", 3.8925, -1.99745, 0.48635, fixed=True),
        box("F", 4.37885, -3.3544, 0.5433, 0.5433, 5.0),
    )
    ends = Anchor("A", (0.326, 0.0)), Anchor("F", (0.0, 0.27165))
    wire = WireLink("C", *ends, 4.18312, over=Pulley("wheel", clockwise=True))
    scene = Scene(bodies, wires=(wire,))
    moved = simulate(scene, 3)
    sound(moved, scene)
    assert np.hypot(*(moved.anchors["C"][:, 0] - moved.anchors["C"][:, 1]).T).max() < wire.rest + 1e-3
    assert moved.modes["A"] == "exact"
    assert len(moved.events) < 100
    before = moved.times < 0.6
    energy = mechanical(moved)
    assert off(energy[before], energy[0], abs(energy[0])) < 1e-9


@settings(max_examples=12, deadline=None)
@given(
    st.floats(0.05, 20.0),
    st.floats(0.05, 20.0),
    st.floats(0.05, 1.0),
    st.sampled_from(["auto", "robust"]),
)
def test_whatever_hangs_on_a_wheel_its_wire_is_never_longer_than_it_is(
    left: float, right: float, radius: float, mode: Literal["auto", "robust"]
) -> None:
    scene = atwood(left, right, radius)
    moved = simulate(scene, 2, mode=mode)
    ends = moved.anchors["wire"]
    assert np.hypot(*(ends[:, 0] - ends[:, 1]).T).max() <= scene.wires[0].rest + 2e-3
    for label in ("A", "B"):
        assert np.hypot(*moved.path(label).T).min() >= radius + 0.1 - 1e-3


@given(st.floats(-pi, pi), st.floats(-pi, pi), st.floats(1.0, 5.0), st.floats(1.0, 5.0), st.booleans())
def test_a_wire_is_drawn_round_its_wheel_in_its_sense_but_never_nearly_all_round(
    one: float, other: float, near: float, far: float, clockwise: bool
) -> None:
    start, end = (near * np.cos(one), near * np.sin(one)), (far * np.cos(other), far * np.sin(other))
    wound = drawn(start, end, 1.0, clockwise)
    turns = (wound - (other - one)) / (2 * pi)
    assert turns == pytest.approx(round(turns), abs=1e-9)
    arc = (-wound if clockwise else wound) - acos(min(1 / hypot(*start), 1)) - acos(min(1 / hypot(*end), 1))
    assert -0.25 * pi - 1e-9 <= arc <= 1.75 * pi + 1e-9


def test_the_wire_of_an_atwood_machine_is_drawn_half_round_its_wheel() -> None:
    wound = drawn((-0.3, -2.0), (0.3, -3.0), 0.3, clockwise=True)
    spare = acos(0.3 / sqrt(0.3**2 + 4)) + acos(0.3 / sqrt(0.3**2 + 9))
    assert -wound - spare == pytest.approx(pi)
