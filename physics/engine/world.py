"""A scene turned into numbers: what the steps work on.

Bodies are numbered as in the scene; one more stands for the page, which nothing moves, so that
an anchor on the page is like any other. Poses and velocities are flat lists, three per body.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, sqrt

from physics.engine.contact import Pair, Solid, solid_of
from physics.engine.rows import FACE, POINT, WIRE, Row
from physics.formula.program import Program
from physics.scene import Anchor, Material, Scene, Vector

DEFAULT_RESTITUTION = 0.5
"""Between two bodies of which nothing is said: a wooden ball on a table."""


@dataclass(slots=True)
class Spring:
    """i, j: bodies; ends in their frames, m."""

    label: str
    i: int
    j: int
    end_i: Vector
    end_j: Vector
    rest: float
    stiffness: float
    damping: float


@dataclass(slots=True)
class Cord:
    """A wire. row: its constraint; tension: the student's instead; reader: whose state that reads."""

    label: str
    row: Row
    tension: Program | None
    tolerance: float
    reader: int
    broken: bool = False
    slack: bool = False


@dataclass(slots=True)
class Push:
    """A student's force on body i."""

    name: str
    i: int
    x: Program
    y: Program


@dataclass(slots=True)
class Prop:
    """A student's normal force on body i instead of what j gives; row: the place where they touch.

    length: of the edge, m (None: round a disc); mu: friction of the pair.
    """

    name: str
    i: int
    j: int
    force: Program
    row: Row
    solid: Solid
    length: float | None
    skin: float
    over: bool = True
    risen: bool = False
    sinking: bool = False


@dataclass(slots=True)
class World:
    labels: tuple[str, ...]
    mass: list[float]
    inertia: list[float]
    inverse: list[float]
    """Three per body: 1/m, 1/m, 1/I; zero for what is fixed, and for the page."""
    gravity: Vector
    pairs: list[Pair]
    spare: dict[tuple[int, int], Pair]
    """Pairs that a student's normal force stands in for, for when it ends."""
    springs: list[Spring]
    cords: list[Cord]
    pushes: list[Push]
    props: list[Prop]
    timeless: bool
    """No program reads anything of the motion: a body at rest stays at rest."""


def world_of(scene: Scene) -> World:
    """The numbers of a scene."""
    number = {body.label: index for index, body in enumerate(scene.bodies)}
    inverse: list[float] = []
    for body in scene.bodies:
        inverse += [0.0] * 3 if body.fixed else [1 / body.mass, 1 / body.mass, 1 / body.inertia]
    inverse += [0.0] * 3
    solids = [solid_of(body) for body in scene.bodies]
    supported = {tuple(sorted((number[s.body], number[s.on]))) for s in scene.supports}
    pairs: list[Pair] = []
    spare: dict[tuple[int, int], Pair] = {}
    for i, first in enumerate(scene.bodies):
        for j in range(i + 1, len(scene.bodies)):
            second = scene.bodies[j]
            if first.fixed and second.fixed:
                continue
            e, mu = meeting(first.material, second.material)
            pair = Pair(len(pairs) + len(spare), i, j, solids[i], solids[j], e, mu)
            if (i, j) in supported:
                spare[i, j] = pair
            else:
                pairs.append(pair)
    programs = [push.x for push in scene.forces] + [push.y for push in scene.forces]
    programs += [support.force for support in scene.supports]
    programs += [wire.tension for wire in scene.wires if wire.tension is not None]
    page = len(scene.bodies)

    def end(anchor: Anchor) -> int:
        return page if anchor.body is None else number[anchor.body]

    cords: list[Cord] = []
    for index, wire in enumerate(scene.wires):
        i, j = end(wire.start), end(wire.end)
        row = Row(WIRE, (-1, index), (i, j), wire.start.point, wire.end.point, wire.rest)
        reader = i if inverse[3 * i] > 0 else j
        cords.append(Cord(wire.label, row, wire.tension, wire.tolerance, reader))
    springs = [
        Spring(s.label, end(s.start), end(s.end), s.start.point, s.end.point, s.rest, s.stiffness, s.damping)
        for s in scene.springs
    ]
    props: list[Prop] = []
    for index, support in enumerate(scene.supports):
        i, j = number[support.body], number[support.on]
        _, mu = meeting(scene.bodies[i].material, scene.bodies[j].material)
        name, solid = (-2, index), solids[i]
        if support.edge is None:
            row = Row(POINT, name, (j, i), (0.0, 0.0), (0.0, 0.0), solids[j].radius + solid.radius, mu=mu)
            row.radius_i = solids[j].radius
            length = None
        else:
            (x1, y1), (x2, y2) = support.edge.start, support.edge.end
            length = hypot(x2 - x1, y2 - y1)
            normal = ((y2 - y1) / length, (x1 - x2) / length)
            row = Row(FACE, name, (j, i), (x1, y1), (0.0, 0.0), solid.radius, normal, mu=mu)
        row.given = True
        props.append(Prop(support.name, i, j, support.force, row, solid, length, support.skin))
    return World(
        tuple(body.label for body in scene.bodies),
        [body.mass for body in scene.bodies],
        [body.inertia for body in scene.bodies],
        inverse,
        scene.gravity,
        pairs,
        spare,
        springs,
        cords,
        [Push(push.name, number[push.body], push.x, push.y) for push in scene.forces],
        props,
        all(program.constant for program in programs),
    )


def meeting(first: Material, second: Material) -> tuple[float, float]:
    """(restitution, friction) where two materials meet: see `Material`."""
    return (
        _between(first.restitution, second.restitution, DEFAULT_RESTITUTION),
        _between(first.friction, second.friction, 0.0),
    )


def _between(first: float | None, second: float | None, default: float) -> float:
    said = [value for value in (first, second) if value is not None]
    if not said:
        return default
    return said[0] if len(said) == 1 else sqrt(said[0] * said[1])


def quickest(world: World) -> float:
    """A bound on the natural frequencies (rad/s) that the springs give the scene: for a spring, what
    all springs at either of its bodies can do to it (Gershgorin's row sums)."""
    stiffness = [0.0] * (len(world.labels) + 1)
    for spring in world.springs:
        stiffness[spring.i] += spring.stiffness
        stiffness[spring.j] += spring.stiffness
    found = 0.0
    for spring in world.springs:
        square = 0.0
        for body, (x, y) in ((spring.i, spring.end_i), (spring.j, spring.end_j)):
            # A lever adds the body's turning to what gives way.
            give = world.inverse[3 * body] + world.inverse[3 * body + 2] * (x * x + y * y)
            square += stiffness[body] * give
        found = max(found, square)
    return sqrt(found)
