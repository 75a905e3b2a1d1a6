"""Small scenes with a closed-form motion, for the tests of this room. SI units, y up."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import cos, hypot, sin

import numpy as np
import sympy
from shapely import MultiPoint, Point, Polygon

from physics.formula.program import Program, compile_tree, constant
from physics.scene import (
    Anchor,
    Block,
    Body,
    Course,
    Disc,
    Edge,
    Force,
    Material,
    Pin,
    Pulley,
    Scene,
    SpringLink,
    Support,
    Vector,
    WireLink,
    block_inertia,
    disc_inertia,
)
from physics.trajectory import Event, EventKind, Trajectory

G = 9.81
T, X, Y, V_X, V_Y, V = sympy.symbols("t x y v_x v_y v")
"""What a student's formula may read of its body."""

# Solids -----------------------------------------------------------------------------------------


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


def block(
    label: str,
    x: float,
    y: float,
    corners: tuple[Vector, ...],
    mass: float = 1.0,
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
    material: Material = Material(),
    fixed: bool = False,
) -> Body:
    """corners: about the centre of mass."""
    inertia = block_inertia(mass, corners)
    return Body(label, Block(corners), (x, y), mass, inertia, 0.0, fixed, velocity, material)


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
    return block(label, x, y, ((-w, -h), (w, -h), (w, h), (-w, h)), mass, velocity, material, fixed)


def floor(material: Material = Material(), label: str = "floor", x: float = 0.0) -> Body:
    """Its upper side is y = 0."""
    return box(label, x, -0.5, 40.0, 1.0, fixed=True, material=material)


def incline(angle: float, length: float = 6.0, material: Material = Material()) -> Body:
    """Foot on the right at (length cos θ, 0), top at (0, length sin θ)."""
    corners = ((0.0, 0.0), (length * cos(angle), 0.0), (0.0, length * sin(angle)))
    cx, cy = sum(x for x, _ in corners) / 3, sum(y for _, y in corners) / 3
    local = tuple((x - cx, y - cy) for x, y in corners)
    return block("incline", cx, cy, local, fixed=True, material=material)


def downhill(angle: float) -> np.ndarray:
    """The unit vector down the incline."""
    return np.array([cos(angle), -sin(angle)])


def laid(body: Body, angle: float, above: float, along: float = 1.0, length: float = 6.0) -> Body:
    """A body turned with the incline, its centre so far above the surface and so far from the top; its
    velocity is meant along the incline and away from it."""
    down, out = downhill(angle), np.array([sin(angle), cos(angle)])
    x, y = np.array([0.0, length * sin(angle)]) + along * down + above * out
    (ahead, away), spin = body.velocity[:2], body.velocity[2]
    v_x, v_y = ahead * down + away * out
    turned = 0.0 if isinstance(body.shape, Disc) else -angle
    return replace(body, position=(float(x), float(y)), angle=turned, velocity=(float(v_x), float(v_y), spin))


# Links and formulas -----------------------------------------------------------------------------


def wire(
    label: str, body: str, end: Vector | str, rest: float, at: Vector = (0.0, 0.0), limit: float | None = None
) -> WireLink:
    """From a body to a point of the world, or to the centre of another body."""
    other = Anchor(end, (0.0, 0.0)) if isinstance(end, str) else Anchor(None, end)
    return WireLink(label, Anchor(body, at), other, rest, limit=limit)


def spring(
    label: str, body: str, end: Vector | str, rest: float, stiffness: float, damping: float = 0.0
) -> SpringLink:
    """From the centre of a body to a point of the world, or to the centre of another body."""
    other = Anchor(end, (0.0, 0.0)) if isinstance(end, str) else Anchor(None, end)
    return SpringLink(label, Anchor(body, (0.0, 0.0)), other, rest, stiffness, damping)


def formula(tree: sympy.Basic | float) -> Program:
    """The program of a student's formula over t, x, y, v_x, v_y, v."""
    return compile_tree(tree if isinstance(tree, sympy.Basic) else float(tree), lambda _: None)


def force(name: str, body: str, x: sympy.Basic | float, y: sympy.Basic | float = 0.0) -> Force:
    return Force(name, body, formula(x), formula(y))


def course(name: str, body: str, axis: str, velocity: sympy.Basic, derived: sympy.Basic) -> Course:
    """A velocity equation and the acceleration that follows from it."""
    assert axis in ("x", "y")
    return Course(name, body, axis, None, formula(velocity), formula(derived))


def place_course(name: str, body: str, axis: str, position: sympy.Basic) -> Course:
    """A position equation in t."""
    assert axis in ("x", "y")
    rates = [formula(sympy.diff(position, T, n)) for n in (1, 2)]
    return Course(name, body, axis, formula(position), *rates)


# Scenes -----------------------------------------------------------------------------------------


def supported(angle: float, share: float) -> Scene:
    """Worked example E6: the normal force of a ball on an incline, times a share."""
    body, ball = incline(angle), laid(disc("ball", 0, 0), angle, 0.25)
    assert isinstance(body.shape, Block)
    edge = Edge(body.shape.vertices[1], body.shape.vertices[2])
    support = Support("f_1", "ball", "incline", constant(share * G * cos(angle)), edge)
    return Scene((body, ball), supports=(support,))


def hanging(left: float | None, right: float | None) -> Scene:
    """Worked example E7: a box of 1 kg on two wires at 45°, g = 10; tensions in N, None: the engine's."""

    def one(label: str, side: float, tension: float | None) -> WireLink:
        start, end = Anchor("box", (0.3 * side, 0.3)), Anchor(None, (1.3 * side, 1.3))
        return WireLink(label, start, end, hypot(1.0, 1.0), None if tension is None else constant(tension))

    return Scene(
        (box("box", 0.0, 0.0, 0.6, 0.6),),
        wires=(one("left", -1.0, left), one("right", 1.0, right)),
        gravity=(0.0, -10.0),
    )


def pendulum(
    angle: float, length: float = 1.0, mass: float = 1.0, limit: float | None = None, speed: float = 0.0
) -> Scene:
    """A small disc on a wire to the origin, at an angle from the vertical, with a speed along the circle."""
    velocity = (speed * cos(angle), speed * sin(angle), 0.0)
    bob = disc("bob", length * sin(angle), -length * cos(angle), 0.05, mass, velocity)
    return Scene((bob,), wires=(wire("wire", "bob", (0.0, 0.0), length, limit=limit),))


def chain(angles: tuple[float, ...]) -> Scene:
    """Bobs of 1 kg, each on a wire of 1 m from the one above, at angles from the vertical."""
    x = y = 0.0
    bobs: list[Body] = []
    wires: list[WireLink] = []
    for n, angle in enumerate(angles):
        x, y = x + sin(angle), y - cos(angle)
        bobs.append(disc(f"B{n}", x, y, 0.05))
        wires.append(wire(f"W{n}", f"B{n}", f"B{n - 1}" if n else (0.0, 0.0), 1.0))
    return Scene(tuple(bobs), wires=tuple(wires))


def rod_pendulum(angle: float, length: float = 1.2, width: float = 0.1) -> Scene:
    """An even bar pinned to the origin by its upper end, at an angle from the vertical."""
    reach = length / 2
    bar = replace(box("bar", reach * sin(angle), -reach * cos(angle), width, length, mass=2.0), angle=angle)
    return Scene((bar,), pins=(Pin("pin", Anchor("bar", (0.0, reach)), Anchor(None, (0.0, 0.0))),))


def atwood(left: float, right: float, radius: float = 0.3) -> Scene:
    """Two masses, kg, on a wire over a fixed wheel at the origin."""
    bodies = (
        disc("wheel", 0, 0, radius, fixed=True),
        disc("A", -radius, -2.0, 0.1, left),
        disc("B", radius, -3.0, 0.1, right),
    )
    over = Pulley("wheel", clockwise=True)
    rest = 5.0 + np.pi * radius
    return Scene(bodies, wires=(WireLink("wire", Anchor("A", (0, 0)), Anchor("B", (0, 0)), rest, over=over),))


# What is looked at ------------------------------------------------------------------------------


def off(found: np.ndarray, wanted: np.ndarray | float, size: float) -> float:
    """The greatest error, as a share of the size of the quantity."""
    return float(np.abs(np.asarray(found) - wanted).max() / size)


def way(moved: Trajectory, label: str, direction: np.ndarray) -> np.ndarray:
    """How far a body has gone in a direction, (T,) m."""
    path = moved.path(label)
    return (path - path[0]) @ direction


def stays(moved: Trajectory, label: str) -> bool:
    """Whether a body never moves, to the last bit."""
    column = moved.column(label)
    return bool(np.all(moved.poses[:, column] == moved.poses[0, column])) and not np.any(
        moved.velocities[:, column]
    )


def size_of(moved: Trajectory, name: str, body: str) -> np.ndarray:
    """The size of a force through time, (T,) N."""
    return np.hypot(*moved.force(name, body).values.T)


def mechanical(moved: Trajectory) -> np.ndarray:
    """Kinetic, potential and elastic energy through time, (T,) J."""
    energy = moved.energy
    return energy.kinetic + energy.potential + energy.elastic


def ledger(moved: Trajectory) -> np.ndarray:
    """What is constant where an engine is right, (T,) J."""
    energy = moved.energy
    return mechanical(moved) + energy.dissipated + energy.corrected - energy.worked


def events(moved: Trajectory, kind: EventKind) -> list[Event]:
    return [event for event in moved.events if event.kind == kind]


def overlap(moved: Trajectory, scene: Scene, every: int = 1) -> float:
    """The deepest that two solids ever are in each other, m; those that a pin joins may be."""
    joined = {frozenset((pin.start.body, pin.end.body)) for pin in scene.pins}
    deepest = 0.0
    for a, b in combinations(scene.bodies, 2):
        if (a.fixed and b.fixed) or {a.label, b.label} in joined:
            continue
        poses = moved.poses[::every, [moved.column(a.label), moved.column(b.label)]]
        reach = _reach(a) + _reach(b)
        near = np.hypot(*(poses[:, 0, :2] - poses[:, 1, :2]).T) < reach
        for at_a, at_b in poses[near]:
            deepest = max(deepest, _depth(a, at_a, b, at_b))
    return deepest


def _reach(body: Body) -> float:
    shape = body.shape
    return shape.radius if isinstance(shape, Disc) else max(hypot(x, y) for x, y in shape.vertices)


def _corners(shape: Block, pose: np.ndarray) -> np.ndarray:
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.asarray(shape.vertices) @ np.array([[c, s], [-s, c]]) + pose[:2]


def _depth(a: Body, at_a: np.ndarray, b: Body, at_b: np.ndarray) -> float:
    """Of a pair. Two blocks: how far the origin is from the edge of their Minkowski difference."""
    match a.shape, b.shape:
        case Disc(first), Disc(second):
            return first + second - float(np.hypot(*(at_a - at_b)[:2]))
        case Block(), Disc():
            return _depth(b, at_b, a, at_a)
        case Disc(radius), Block():
            solid, centre = Polygon(_corners(b.shape, at_b)), Point(at_a[:2])
            gap = solid.exterior.distance(centre)
            return radius + gap if solid.contains(centre) else radius - gap
        case Block(), Block():
            corners_a, corners_b = _corners(a.shape, at_a), _corners(b.shape, at_b)
            apart = (corners_a[:, None] - corners_b[None]).reshape(-1, 2)
            hull, origin = MultiPoint(apart).convex_hull, Point(0.0, 0.0)
            return hull.exterior.distance(origin) if hull.contains(origin) else 0.0
    raise AssertionError((a.shape, b.shape))


def angles(moved: Trajectory, label: str) -> np.ndarray:
    """Of a body's centre about the origin from straight down, anti-clockwise, (T,) rad."""
    x, y = moved.path(label).T
    return np.arctan2(x, -y)


def sound(moved: Trajectory, scene: Scene, deep: float = 1e-6) -> None:
    """Asserts that a motion is finite, that nothing is in anything else by more than `deep` (m), and that
    no energy came from nowhere."""
    assert np.isfinite(moved.poses).all() and np.isfinite(moved.velocities).all()
    assert overlap(moved, scene, every=4) < deep
    total = mechanical(moved)
    assert np.diff(total).max(initial=0.0) < 1e-6 * (1 + np.abs(total).max())
