"""The scenes of the engines' benchmark and what the textbook says of them. SI units, y up.

Each scene is one `Scene`, given to every engine alike. Discs and links are about a metre in size, where
game engines are at their best, and both materials of a pair are always given.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, hypot, radians, sin, sqrt
from typing import Literal

import numpy as np
from scipy.special import ellipj, ellipk

from engine_chain import chain, chain_places
from physics.scene import (
    Anchor,
    Block,
    Body,
    Disc,
    Material,
    Scene,
    SpringLink,
    Vector,
    WireLink,
    block_inertia,
    disc_inertia,
)
from sketch.ink import FloatArray

G = 9.81
SMOOTH = Material(restitution=0.0, friction=0.0)
ELASTIC = Material(restitution=1.0, friction=0.0)
ROUGH = Material(restitution=0.0, friction=0.6)
CORNER = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Case:
    """A scene and how an engine is judged by it.

    measure: "position" (m, of the worst body at `seconds`), "tension" (share of the true one, the worst in
    the second half of the run) or "displacement" (m, of the worst body at `seconds`); places: the true
    (B, 2) m of the movable bodies at a time; tension: the true one of every wire, N, at a time; swing: the
    energy (J) that drift is a share of, None where none is conserved or none at stake; single: whether the
    target for CPU time holds for it.
    """

    name: str
    scene: Scene
    measure: Literal["position", "tension", "displacement"]
    places: Callable[[float], FloatArray]
    tension: Callable[[float], float] | None = None
    swing: float | None = None
    seconds: float = 2.0
    single: bool = True


def disc(
    label: str,
    at: Vector,
    radius: float,
    mass: float,
    material: Material = SMOOTH,
    velocity: Vector = (0.0, 0.0),
) -> Body:
    inertia = disc_inertia(mass, radius)
    return Body(label, Disc(radius), at, mass, inertia, velocity=(*velocity, 0.0), material=material)


def box(
    label: str, at: Vector, width: float, height: float, material: Material = SMOOTH, fixed: bool = False
) -> Body:
    """1 kg."""
    w, h = width / 2, height / 2
    corners = ((-w, -h), (w, -h), (w, h), (-w, h))
    return Body(label, Block(corners), at, 1.0, block_inertia(1.0, corners), fixed=fixed, material=material)


def ramp(angle: float, length: float, material: Material = SMOOTH) -> Body:
    """A fixed right-angled incline: its foot on the right, its top at (0, length sin θ)."""
    corners = (CORNER, (length * cos(angle), 0.0), (0.0, length * sin(angle)))
    cx, cy = length * cos(angle) / 3, length * sin(angle) / 3
    local = tuple((x - cx, y - cy) for x, y in corners)
    return Body("incline", Block(local), (cx, cy), 1.0, 1.0, fixed=True, material=material)


def incline(angle: float, length: float, radius: float, material: Material = SMOOTH) -> tuple[Scene, Vector]:
    """A disc let go on an incline, 1 m from its top; and its place."""
    at = (cos(angle) + radius * sin(angle), (length - 1) * sin(angle) + radius * cos(angle))
    return Scene((ramp(angle, length, material), disc("ball", at, radius, 1.0, material))), at


def pendulum(amplitude: float, length: float) -> Scene:
    """A disc on a wire to the origin, let go at an angle from the vertical."""
    bob = disc("bob", (length * sin(amplitude), -length * cos(amplitude)), 0.1, 1.0)
    return Scene((bob,), wires=(WireLink("wire", Anchor("bob", CORNER), Anchor(None, CORNER), length),))


def two_wires(left: float, right: float) -> Scene:
    """A box of 1 kg on two wires from its upper corners at these angles from the horizontal."""

    def wire(label: str, side: float, angle: float) -> WireLink:
        x, y, length = 0.3 * side, 0.3, sqrt(2.0)
        up = (x + side * length * cos(angle), y + length * sin(angle))
        return WireLink(label, Anchor("box", (x, y)), Anchor(None, up), length)

    return Scene((box("box", CORNER, 0.6, 0.6),), wires=(wire("left", -1.0, left), wire("right", 1.0, right)))


def still(scene: Scene) -> Callable[[float], FloatArray]:
    """The places of bodies that ought not to move."""
    places = np.array([body.position for body in scene.bodies if not body.fixed])
    return lambda _: places


def cases() -> list[Case]:
    """All of them, in the order in which they are printed."""
    return [_incline(), _pendulum(), _spring(), _two_wires(), _collision(), _chain(), _pyramid()]


def _incline() -> Case:
    angle = radians(30)
    scene, (x, y) = incline(angle, 12.0, 0.25)

    def places(t: float) -> FloatArray:
        way = 0.5 * G * sin(angle) * t * t
        return np.array([[x + way * cos(angle), y - way * sin(angle)]])

    return Case("incline", scene, "position", places)


def _pendulum() -> Case:
    """θ = 2 asin(k cd(ωt, k)), k = sin(θ₀/2); the tension is mg(3 cos θ − 2 cos θ₀)."""
    amplitude, length = 1.0, 1.0
    k = sin(amplitude / 2)

    def angle(t: float) -> float:
        _, cn, dn, _ = ellipj(sqrt(G / length) * t, k * k)
        return 2 * float(np.arcsin(k * cn / dn))

    def places(t: float) -> FloatArray:
        return np.array([[length * sin(angle(t)), -length * cos(angle(t))]])

    return Case(
        "pendulum",
        pendulum(amplitude, length),
        "position",
        places,
        tension=lambda t: G * (3 * cos(angle(t)) - 2 * cos(amplitude)),
        swing=G * length * (1 - cos(amplitude)),
    )


def pendulum_period(amplitude: float, length: float) -> float:
    """Seconds."""
    return 4 * sqrt(length / G) * float(ellipk(sin(amplitude / 2) ** 2))


def _spring() -> Case:
    """A disc on a spring of 50 N/m, let go 0.3 m below where it would hang at rest."""
    stiffness, rest, amplitude = 50.0, 1.0, 0.3
    middle = -rest - G / stiffness
    bob = disc("bob", (0.0, middle - amplitude), 0.1, 1.0)
    spring = SpringLink("spring", Anchor("bob", CORNER), Anchor(None, CORNER), rest, stiffness)

    def places(t: float) -> FloatArray:
        return np.array([[0.0, middle - amplitude * cos(sqrt(stiffness) * t)]])

    swing = 0.5 * stiffness * amplitude**2
    return Case("spring", Scene((bob,), springs=(spring,)), "position", places, swing=swing)


def _two_wires() -> Case:
    scene = two_wires(radians(45), radians(45))
    return Case("two wires", scene, "tension", still(scene), tension=lambda _: G / sqrt(2.0))


def _collision() -> Case:
    """A disc strikes a heavier one at rest obliquely; normal velocities change by Newton's law, e = 1."""
    radius, (m, n), v, offset, gap = 0.25, (1.0, 2.0), np.array([3.0, 0.0]), 0.2, 1.7
    bodies = (
        disc("a", (-gap, -offset), radius, m, ELASTIC, (3.0, 0.0)),
        disc("b", CORNER, radius, n, ELASTIC),
    )
    across = sqrt((2 * radius) ** 2 - offset**2)
    meeting = (gap - across) / v[0]
    normal = np.array([across, offset]) / hypot(across, offset)
    impulse = 2 * m * n / (m + n) * (v @ normal)

    def places(t: float) -> FloatArray:
        first, second = np.array([-gap, -offset]) + v * t, np.zeros(2)
        past = max(t - meeting, 0.0)
        return np.array([first - impulse / m * past * normal, second + impulse / n * past * normal])

    return Case("collision", Scene(bodies, gravity=CORNER), "position", places)


def _chain() -> Case:
    links, length, angle = 15, 0.2, radians(60)
    places = chain_places(links, length, angle, 2.0)
    swing = links * G * links * length / 2 * (1 - cos(angle))
    scene = chain(links, length, angle)
    return Case("chain", scene, "position", places, swing=swing, single=False)


def _pyramid() -> Case:
    """55 boxes of half a metre in ten rows, each on two; they touch exactly and should not move."""
    side, rows = 0.5, 10
    boxes = [
        box(f"{row}.{k}", ((k - (rows - 1 - row) / 2) * side, (row + 0.5) * side), side, side, ROUGH)
        for row in range(rows)
        for k in range(rows - row)
    ]
    floor = box("floor", (0.0, -0.5), 20.0, 1.0, ROUGH, fixed=True)
    scene = Scene((floor, *boxes))
    return Case("pyramid", scene, "displacement", still(scene), seconds=5.0, single=False)
