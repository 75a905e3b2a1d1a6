"""Wires over pulleys on a page: two wires that touch a fixed circle on either side are one."""

import numpy as np
import pytest
from physics_pages import page, rectangle

from physics.build import build
from physics.engine import simulate
from sketch.page import Component
from sketch.shapes import Circle, Wire


def machine(left=2.0, right=3.0, fixed=True, hangs=False, turned=False):
    """A wheel C between the loads A and B; hangs: the wires leave it below, where they do not touch it."""
    spots = [(255.0, 130.0), (345.0, 130.0)] if hangs else [(250.0, 100.0), (350.0, 100.0)]
    if hangs:
        spots = [(290.0, 149.0), (310.0, 149.0)]
    lows = [(spots[0][0], 250.0), (spots[1][0], 280.0)]
    wires = [
        Component(Wire(spot, low), label=label, ends=("C", load))
        if not turned
        else Component(Wire(low, spot), label=label, ends=(load, "C"))
        for spot, low, label, load in zip(spots, lows, ("D", "E"), ("A", "B"), strict=True)
    ]
    return page(
        (
            Component(rectangle(lows[0][0] - 30, 250, lows[0][0] + 9, 290), label="A"),
            Component(rectangle(lows[1][0] - 9, 280, lows[1][0] + 30, 320), label="B"),
            Component(Circle((300.0, 100.0), 50.0), label="C", fixed=fixed),
            *wires,
        ),
        ((f"m = {left}", "A", None), (f"m = {right}", "B", None)),
    )


@pytest.mark.parametrize("turned", [False, True])
def test_two_tangents_of_a_fixed_circle_are_one_wire_as_long_as_it_was_drawn(turned):
    (wire,) = build(machine(turned=turned)).scene.wires
    assert wire.label == "D"
    assert wire.over is not None
    assert wire.over.body == "C"
    assert wire.over.clockwise
    assert wire.rest == pytest.approx(1.5 + 1.8 + 0.5 * np.pi, abs=1e-12)


def test_the_loads_move_as_atwoods():
    """a = g (m₂ − m₁) / (m₁ + m₂), T = 2 m₁ m₂ g / (m₁ + m₂): at the start, whatever their shapes."""
    scene = build(
        page(
            (
                Component(rectangle(230, 250, 270, 290), label="A"),
                Component(rectangle(330, 280, 370, 320), label="B"),
                Component(Circle((300.0, 100.0), 50.0), label="C", fixed=True),
                Component(Wire((250.0, 100.0), (250.0, 250.0)), label="D", ends=("C", "A")),
                Component(Wire((350.0, 100.0), (350.0, 280.0)), label="E", ends=("C", "B")),
            ),
            (("m = 2", "A", None), ("m = 3", "B", None)),
        )
    ).scene
    moved = simulate(scene, 0.5)
    rate = 9.81 / 5
    assert np.allclose(moved.path("A")[:, 1] - moved.path("A")[0, 1], rate * moved.times**2 / 2, atol=1e-10)
    assert np.allclose(moved.force("T of D", "B").values, [0, 2 * 2 * 3 * 9.81 / 5], atol=1e-9)


def test_wires_that_hang_from_a_circle_or_touch_one_that_moves_are_two():
    assert len(build(machine(hangs=True)).scene.wires) == 2
    assert len(build(machine(fixed=False)).scene.wires) == 2
    assert all(wire.over is None for wire in build(machine(hangs=True)).scene.wires)


def test_a_given_tension_of_either_piece_is_the_whole_wires():
    drawn = machine()
    for label in ("D", "E"):
        said = page(drawn.components, ((("T = 7"), label, None),))
        (wire,) = build(said).scene.wires
        assert wire.tension is not None
        assert wire.tension.value(()) == 7.0
