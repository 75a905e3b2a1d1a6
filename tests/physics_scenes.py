"""Small scenes with a closed-form motion, for the tests of this room. SI units, y up."""

from __future__ import annotations

from math import cos, hypot, sin

from physics.formula.program import constant
from physics.scene import (
    Anchor,
    Block,
    Body,
    Disc,
    Edge,
    Material,
    Scene,
    Support,
    WireLink,
    block_inertia,
    disc_inertia,
)

G = 9.81


def disc(
    label: str,
    x: float,
    y: float,
    radius: float = 0.25,
    mass: float = 1.0,
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
    material: Material = Material(),
    fixed: bool = False,
) -> Body:
    inertia = disc_inertia(mass, radius)
    return Body(label, Disc(radius), (x, y), mass, inertia, 0.0, fixed, velocity, material)


def box(
    label: str,
    x: float,
    y: float,
    width: float,
    height: float,
    mass: float = 1.0,
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
    material: Material = Material(),
    fixed: bool = False,
) -> Body:
    w, h = width / 2, height / 2
    corners = ((-w, -h), (w, -h), (w, h), (-w, h))
    return Body(
        label, Block(corners), (x, y), mass, block_inertia(mass, corners), 0.0, fixed, velocity, material
    )


def floor(material: Material = Material()) -> Body:
    """Its upper side is y = 0."""
    return box("floor", 0.0, -0.5, 40.0, 1.0, fixed=True, material=material)


def incline(angle: float, length: float = 6.0, material: Material = Material()) -> Body:
    """Foot on the right at (length cos θ, 0), top at (0, length sin θ)."""
    corners = ((0.0, 0.0), (length * cos(angle), 0.0), (0.0, length * sin(angle)))
    cx, cy = sum(x for x, _ in corners) / 3, sum(y for _, y in corners) / 3
    local = tuple((x - cx, y - cy) for x, y in corners)
    return Body("incline", Block(local), (cx, cy), 1.0, 1.0, 0.0, True, (0.0, 0.0, 0.0), material)


def on_incline(
    angle: float, radius: float = 0.25, mass: float = 1.0, length: float = 6.0
) -> tuple[tuple[float, float], tuple[float, float], Body]:
    """(its centre, the unit vector downhill, a disc that touches the incline 1 m from its top)."""
    down = (cos(angle), -sin(angle))
    x = down[0] + radius * sin(angle)
    y = length * sin(angle) + down[1] + radius * cos(angle)
    return (x, y), down, disc("ball", x, y, radius, mass)


def supported(angle: float, share: float) -> Scene:
    """Worked example E6: the normal force of a ball on an incline, times a share."""
    _, _, ball = on_incline(angle)
    body = incline(angle)
    assert isinstance(body.shape, Block)
    edge = Edge(body.shape.vertices[1], body.shape.vertices[2])
    return Scene(
        (body, ball),
        supports=(Support("f_1", "ball", "incline", constant(share * G * cos(angle)), edge),),
    )


def hanging(left: float | None, right: float | None) -> Scene:
    """Worked example E7: a box of 1 kg on two wires at 45°, g = 10; tensions in N, None: the engine's."""

    def wire(label: str, side: float, tension: float | None) -> WireLink:
        return WireLink(
            label,
            Anchor("box", (0.3 * side, 0.3)),
            Anchor(None, (1.3 * side, 1.3)),
            hypot(1.0, 1.0),
            None if tension is None else constant(tension),
        )

    return Scene(
        (box("box", 0.0, 0.0, 0.6, 0.6),),
        wires=(wire("left", -1.0, left), wire("right", 1.0, right)),
        gravity=(0.0, -10.0),
    )


def pendulum(angle: float, length: float = 1.0) -> Scene:
    """A small disc on a wire to the origin, let go at an angle from the vertical."""
    bob = disc("bob", length * sin(angle), -length * cos(angle), 0.05)
    wire = WireLink("wire", Anchor("bob", (0.0, 0.0)), Anchor(None, (0.0, 0.0)), length)
    return Scene((bob,), wires=(wire,))
