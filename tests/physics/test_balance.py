"""What stands on edges, in notches and on several legs; forces that the laws of motion leave open."""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, pi, sin, sqrt

import numpy as np
import pytest
from physics_scenes import G, block, box, disc, events, floor, off, sound, wire

from physics.engine import simulate
from physics.scene import Material, Scene


def test_a_disc_exactly_on_a_corner_balances() -> None:
    tip = block("tip", 0, -1 / 3, ((-1, -1 / 3), (1, -1 / 3), (0, 2 / 3)), fixed=True)
    peak = tip.position[1] + 2 / 3
    moved = simulate(Scene((tip, disc("A", 0.0, peak + 0.25))), 1)
    assert off(moved.path("A"), np.array([0.0, peak + 0.25]), 1.0) < 1e-9


def test_a_box_exactly_on_its_corner_balances_and_a_leaning_one_falls() -> None:
    for lean, falls in ((0.0, False), (1e-3, True)):
        tilted = replace(box("A", 0, 0, 0.6, 0.6), angle=pi / 4 + lean)
        tall = 0.6 * sqrt(0.5) * cos(lean)
        scene = Scene((floor(Material(0.0, 2.0)), replace(tilted, position=(0.0, tall))))
        moved = simulate(scene, 1)
        sound(moved, scene)
        assert (off(moved.poses[:, 1], moved.poses[0, 1], 1.0) > 1e-3) == falls


def test_a_disc_that_rolls_over_the_edge_of_a_table_turns_about_its_corner() -> None:
    table = box("table", -2, -0.5, 4, 1, fixed=True, material=Material(0.0, 2.0))
    scene = Scene((table, disc("A", -0.2, 0.25, velocity=(0.3, 0, -0.3 / 0.25))))
    moved = simulate(scene, 1.5)
    sound(moved, scene)
    assert moved.path("A")[-1, 1] < -0.5
    touch = (moved.path("A")[:, 0] > 0) & (moved.path("A")[:, 1] > 0.23)
    assert touch.any()
    assert off(np.hypot(*moved.path("A")[touch].T), 0.25, 1.0) < 1e-9


def test_a_disc_in_a_corner_of_floor_and_wall_leans_on_the_floor_alone() -> None:
    wall = box("wall", -0.5, 1, 1, 4, fixed=True)
    moved = simulate(Scene((floor(), wall, disc("A", 0.25, 0.25))), 2)
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-12
    assert off(moved.force("contact with floor", "A").values, np.array([0.0, G]), G) < 1e-12


def test_a_table_on_three_legs_has_forces_that_are_not_unique_and_says_so() -> None:
    legs = tuple(disc(f"leg{k}", float(k - 1), -0.1, 0.1, fixed=True) for k in range(3))
    moved = simulate(Scene((*legs, box("top", 0, 0.05, 2.4, 0.1, 3.0))), 2)
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-12
    found = [moved.force(f"contact with leg{k}", "top") for k in range(3)]
    assert not any(one.unique for one in found)
    # The smallest: the weight shared evenly.
    for one in found:
        assert off(one.values, np.array([0.0, G]), 3 * G) < 1e-9
    assert len(events(moved, "not unique")) == 1
    assert "top" in events(moved, "not unique")[0].bodies


def test_a_load_on_three_wires_at_one_place_has_tensions_that_are_not_unique() -> None:
    # To the height of 1 m at −1, 0 and 1 m: the smallest tensions solve J Jᵀ λ = W.
    hooks = [(-1.0, 1.0), (0.0, 1.0), (1.0, 1.0)]
    links = tuple(wire(f"W{k}", "A", hook, hypot(*hook)) for k, hook in enumerate(hooks))
    moved = simulate(Scene((disc("A", 0, 0, 0.1),), wires=links), 2)
    along = np.array([np.array(hook) / hypot(*hook) for hook in hooks]).T
    least = np.linalg.lstsq(along, np.array([0.0, G]), rcond=None)[0]
    for k in range(3):
        one = moved.force(f"T of W{k}", "A")
        assert not one.unique
        assert off(np.hypot(*one.values.T), least[k], G) < 1e-9
    assert events(moved, "not unique")


def test_a_box_on_a_floor_has_forces_that_are_unique() -> None:
    moved = simulate(Scene((floor(), box("A", 0, 0.2, 0.6, 0.4))), 1)
    assert moved.force("contact with floor", "A").unique
    assert not moved.events


def test_a_beam_on_two_supports_shares_its_weight_by_the_lever() -> None:
    legs = (disc("left", -1.0, -0.1, 0.1, fixed=True), disc("right", 0.5, -0.1, 0.1, fixed=True))
    moved = simulate(Scene((*legs, box("beam", 0, 0.05, 3.0, 0.1, 3.0))), 2)
    assert off(moved.force("contact with left", "beam").values, np.array([0.0, G]), 3 * G) < 1e-12
    assert off(moved.force("contact with right", "beam").values, np.array([0.0, 2 * G]), 3 * G) < 1e-12
    assert all(moved.force(f"contact with {leg.label}", "beam").unique for leg in legs)


def test_bounces_in_a_notch_come_to_an_end() -> None:
    sides = tuple(
        replace(
            box(label, 0, 0, 4.0, 1.0, fixed=True),
            angle=turn,
            position=(x, -0.5 * cos(turn) + 1.9 * sin(pi / 6)),
        )
        for label, turn, x in (
            ("left", -pi / 6, -1.9 * cos(pi / 6) - 0.5 * sin(pi / 6)),
            ("right", pi / 6, 1.9 * cos(pi / 6) + 0.5 * sin(pi / 6)),
        )
    )
    scene = Scene((*sides, disc("A", 0.3, 2.0)))
    moved = simulate(scene, 20)
    sound(moved, scene)
    assert np.abs(moved.velocities[-1]).max() < 1e-3
    assert moved.path("A")[-1] == pytest.approx([0.0, 0.25 / cos(pi / 6)], abs=1e-4)
