"""A scene turned into tables: what the kernels work on.

Bodies that can move come first (rows 0 to movable − 1), then the fixed ones, then the page, which
nothing moves, so that an anchor on the page is like any other. SI units, y up; poses and
velocities are (bodies, 3): x, y, angle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, hypot, inf, sin, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from physics.engine.tables import COURSE, LAYOUT, LINK, PAIR, PUSH, SUPPORT
from physics.formula.kernel import Packed, pack
from physics.formula.program import Program
from physics.scene import Anchor, Body, Disc, Material, Scene, SpringLink, WireLink
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]
Table = NDArray[np.void]
"""An array of records."""

DEFAULT_RESTITUTION = 0.5
"""Between two bodies of which nothing is said: a wooden ball on a table."""

SPRING, WIRE, PIN = 0, 1, 2


class World(NamedTuple):
    """The tables of one cluster of bodies and all that is fixed."""

    gravity: FloatArray
    mass: FloatArray
    """(bodies, 3): kg, kg, kg m²."""
    inverse: FloatArray
    """(bodies, 3): 1 / mass; zero for what is fixed and along a course."""
    radius: FloatArray
    """(bodies,) m, of discs; zero for blocks."""
    first: IntArray
    sides: IntArray
    """(bodies,) rows of `corners` that are a block's; none for discs."""
    reach: FloatArray
    """(bodies,) m: the farthest point from the centre of mass."""
    corners: FloatArray
    """(corners, 2) m, in the body's frame, anti-clockwise."""
    normals: FloatArray
    """(corners, 2): outward unit normal of the edge from each corner to the next."""
    edges: FloatArray
    """(corners,) m: that edge's length."""
    links: Table
    pairs: Table
    pushes: Table
    supports: Table
    courses: Table
    ops: IntArray
    args: FloatArray
    who: IntArray
    spans: IntArray
    switches: IntArray
    stack: FloatArray
    cells: FloatArray
    """The memory that all of these are views of (physics.engine.tables)."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled as its tables, which are views of one memory again when they are read."""
        return gathered, (self[:-1], int(LAYOUT.head_of(self.cells)["movable"]))


@dataclass(frozen=True, slots=True)
class Names:
    """What the rows of a `World` are called: bodies (the page is not one), movable: how many of them can
    move; links, pushes, supports, courses; programs: text of each."""

    bodies: tuple[str, ...]
    movable: int
    links: tuple[str, ...]
    pushes: tuple[str, ...]
    supports: tuple[str, ...]
    courses: tuple[str, ...]
    programs: tuple[str, ...]
    timeless: bool
    """No program reads anything: a body at rest stays at rest."""


def world_of(scene: Scene, members: Sequence[str]) -> tuple[World, Names]:
    """The tables of the movable bodies `members` (in the scene's order), of all that is fixed, and of what
    acts on them."""
    chosen = set(members)
    bodies = [body for body in scene.bodies if body.label in chosen]
    fixed = [body for body in scene.bodies if body.fixed]
    everyone = bodies + fixed
    number = {body.label: k for k, body in enumerate(everyone)}
    page = len(everyone)

    def end(anchor: Anchor) -> int:
        return page if anchor.body is None else number[anchor.body]

    def ours(*labels: str | None) -> bool:
        return any(label in chosen for label in labels)

    programs = _Programs(number)
    links = [
        link for link in (*scene.springs, *scene.wires, *scene.pins) if ours(link.start.body, link.end.body)
    ]
    table = np.zeros(len(links), LINK)
    for row, link in zip(table, links, strict=True):
        i, j = end(link.start), end(link.end)
        row["i"], row["j"] = i, j
        row["ax"], row["ay"] = link.start.point
        row["bx"], row["by"] = link.end.point
        row["tension"], row["over"], row["limit"] = -1, -1, inf
        row["reader"] = i if i < len(bodies) else j
        if isinstance(link, WireLink):
            row["kind"], row["rest"], row["tolerance"] = WIRE, link.rest, link.tolerance
            row["limit"] = inf if link.limit is None else link.limit
            if link.tension is not None:
                row["tension"] = programs.add(link.tension, int(row["reader"]))
            if link.over is not None:
                row["over"], row["sense"] = number[link.over.body], -1.0 if link.over.clockwise else 1.0
        elif isinstance(link, SpringLink):
            row["kind"], row["rest"] = SPRING, link.rest
            row["stiffness"], row["damping"] = link.stiffness, link.damping
        else:
            row["kind"] = PIN
    pushes = [force for force in scene.forces if force.body in chosen]
    push_table = np.zeros(len(pushes), PUSH)
    for row, push in zip(push_table, pushes, strict=True):
        at = number[push.body]
        row["body"], row["x"], row["y"] = at, programs.add(push.x, at), programs.add(push.y, at)
    courses = [course for course in scene.courses if course.body in chosen]
    course_table = np.zeros(len(courses), COURSE)
    for row, course in zip(course_table, courses, strict=True):
        at = number[course.body]
        row["body"], row["axis"], row["on"] = at, 0 if course.axis == "x" else 1, 1
        row["position"] = -1 if course.position is None else programs.add(course.position, at)
        row["velocity"], row["acceleration"] = (
            programs.add(course.velocity, at),
            programs.add(course.acceleration, at),
        )
    supports = [support for support in scene.supports if ours(support.body, support.on)]
    support_table = np.zeros(len(supports), SUPPORT)
    for row, support in zip(support_table, supports, strict=True):
        i, j = number[support.body], number[support.on]
        row["i"], row["j"], row["over"], row["pair"] = i, j, 1, -1
        row["force"], row["skin"] = programs.add(support.force, i), support.skin
        row["mu"] = meeting(everyone[i].material, everyone[j].material)[1]
        if support.edge is not None:
            (x1, y1), (x2, y2) = support.edge.start, support.edge.end
            length = hypot(x2 - x1, y2 - y1)
            row["ax"], row["ay"], row["length"] = x1, y1, length
            row["nx"], row["ny"] = (y2 - y1) / length, (x1 - x2) / length
    packed = programs.packed()
    mass, inverse = _masses(everyone, len(bodies))
    for row in course_table:
        inverse[row["body"], row["axis"]] = 0.0
    arrays: tuple[NDArray[Any], ...] = (
        np.asarray(scene.gravity, float),
        mass,
        inverse,
        *_shapes(everyone),
        table,
        _pairs(everyone, len(bodies), table, support_table),
        push_table,
        support_table,
        course_table,
        packed.ops,
        packed.args,
        packed.who,
        packed.spans,
        packed.switches.astype(np.int64),
        np.zeros(max(packed.depth, 1)),
    )
    world = gathered(arrays, len(bodies))
    names = Names(
        tuple(body.label for body in everyone),
        len(bodies),
        tuple(link.label for link in links),
        tuple(push.name for push in pushes),
        tuple(support.name for support in supports),
        tuple(course.name for course in courses),
        tuple(program.text for program, _, _ in programs.bound),
        all(program.constant for program, _, _ in programs.bound) and not courses,
    )
    return world, names


def gathered(arrays: Sequence[NDArray[Any]], movable: int) -> World:
    """A world of copies of these arrays (the fields of `World` but the last), in one piece of memory."""
    named = dict(zip(World._fields, arrays, strict=False))
    cells = LAYOUT.laid(
        {
            "bodies": len(named["mass"]),
            "movable": movable,
            "vertices": len(named["corners"]),
            **{name: len(named[name]) for name in ("links", "pairs", "pushes", "supports", "courses")},
            "code": len(named["ops"]),
            "programs": len(named["spans"]),
            "depth": len(named["stack"]),
        },
        named,
    )
    return World._make((*(LAYOUT.view(cells, name, array) for name, array in named.items()), cells))


def copied(world: World, movable: int) -> World:
    """The same in memory of its own."""
    return gathered(world[:-1], movable)


def start_of(scene: Scene, names: Names) -> tuple[FloatArray, FloatArray]:
    """Poses and velocities at the start, (bodies + 1, 3): the page comes last."""
    pos, vel = np.zeros((len(names.bodies) + 1, 3)), np.zeros((len(names.bodies) + 1, 3))
    known = {body.label: body for body in scene.bodies}
    for k, label in enumerate(names.bodies):
        body = known[label]
        pos[k] = (*body.position, body.angle)
        vel[k] = body.velocity
    return pos, vel


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


class _Programs:
    """Programs bound to the bodies that they read, in the order in which they were added."""

    def __init__(self, number: dict[str, int]) -> None:
        self.number = number
        self.bound: list[tuple[Program, int, tuple[int, ...]]] = []

    def add(self, program: Program, body: int) -> int:
        self.bound.append((program, body, tuple(self.number[label] for label in program.others)))
        return len(self.bound) - 1

    def packed(self) -> Packed:
        return pack(self.bound)


def _masses(everyone: list[Body], movable: int) -> tuple[FloatArray, FloatArray]:
    mass = np.ones((len(everyone) + 1, 3))
    inverse = np.zeros_like(mass)
    for k, body in enumerate(everyone):
        mass[k] = (body.mass, body.mass, body.inertia)
    inverse[:movable] = 1.0 / mass[:movable]
    return mass, inverse


def _shapes(
    everyone: list[Body],
) -> tuple[FloatArray, IntArray, IntArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    radius, reach = np.zeros(len(everyone) + 1), np.zeros(len(everyone) + 1)
    first, count = np.zeros(len(everyone) + 1, np.int64), np.zeros(len(everyone) + 1, np.int64)
    corners: list[tuple[float, float]] = []
    normals: list[tuple[float, float]] = []
    edges: list[float] = []
    for k, body in enumerate(everyone):
        if isinstance(body.shape, Disc):
            radius[k] = reach[k] = body.shape.radius
            continue
        vertices = body.shape.vertices
        first[k], count[k] = len(corners), len(vertices)
        reach[k] = max(hypot(x, y) for x, y in vertices)
        for (x1, y1), (x2, y2) in zip(vertices, (*vertices[1:], vertices[0]), strict=True):
            length = hypot(x2 - x1, y2 - y1)
            corners.append((x1, y1))
            normals.append(((y2 - y1) / length, (x1 - x2) / length) if length > 0 else (0.0, 0.0))
            edges.append(length)
    return (
        radius,
        first,
        count,
        reach,
        np.asarray(corners, float).reshape(-1, 2),
        np.asarray(normals, float).reshape(-1, 2),
        np.asarray(edges, float),
    )


def _pairs(everyone: list[Body], movable: int, links: Table, supports: Table) -> Table:
    """Pairs with one that moves, but those that a pin joins.

    A load may well hit the wheel that its own wire runs over."""
    apart = {frozenset((int(link["i"]), int(link["j"]))) for link in links if link["kind"] == PIN}
    given = {frozenset((int(s["i"]), int(s["j"]))): k for k, s in enumerate(supports)}
    rows: list[tuple[int, int, int, float, float, float, float]] = []
    sizes = [_size(body) for body in everyone]
    reaches = [_reach(body) for body in everyone]
    for i in range(movable):
        for j in range(i + 1, len(everyone)):
            key = frozenset((i, j))
            if key in apart:
                continue
            if key in given:
                supports[given[key]]["pair"] = len(rows)
            e, mu = meeting(everyone[i].material, everyone[j].material)
            rows.append((i, j, given.get(key, -1), e, mu, reaches[i] + reaches[j], min(sizes[i], sizes[j])))
    return np.array(rows, PAIR) if rows else np.zeros(0, PAIR)


def _reach(body: Body) -> float:
    return (
        body.shape.radius
        if isinstance(body.shape, Disc)
        else max(hypot(x, y) for x, y in body.shape.vertices)
    )


def _size(body: Body) -> float:
    """The least width of a body, m: what another could miss if it moved that far unseen."""
    if isinstance(body.shape, Disc):
        return 2 * body.shape.radius
    vertices = body.shape.vertices
    widths: list[float] = []
    for (x1, y1), (x2, y2) in zip(vertices, (*vertices[1:], vertices[0]), strict=True):
        length = hypot(x2 - x1, y2 - y1)
        if length > 0:
            nx, ny = (y2 - y1) / length, (x1 - x2) / length
            widths.append(max((x1 - x) * nx + (y1 - y) * ny for x, y in vertices))
    return min(widths)


def placed(point: tuple[float, float], pose: FloatArray) -> tuple[float, float]:
    """A point of a body's frame in the world."""
    c, s = cos(pose[2]), sin(pose[2])
    return float(pose[0] + c * point[0] - s * point[1]), float(pose[1] + s * point[0] + c * point[1])
