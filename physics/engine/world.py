"""A scene turned into tables: what the kernels work on.

Bodies that can move come first (rows 0 to movable − 1), then the fixed ones, then the page, which
nothing moves, so that an anchor on the page is like any other. SI units, y up; poses and
velocities are (bodies, 3): x, y, angle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate
from math import cos, hypot, inf, sin, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from physics.engine.tables import COURSE, LAYOUT, LINK, PAIR, PUSH, SUPPORT
from physics.engine.wheel import drawn
from physics.formula.kernel import Packed, pack
from physics.formula.program import Program
from physics.scene import (
    Anchor,
    Block,
    Body,
    Course,
    Disc,
    Material,
    Pulley,
    Scene,
    SpringLink,
    Vector,
    WireLink,
)
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
        return viewed, (self.cells,)


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
    rows: list[tuple[Any, ...]] = []
    for link in links:
        i, j = end(link.start), end(link.end)
        kind, tension, over, wound = PIN, -1, -1, 0.0
        rest = stiffness = damping = tolerance = 0.0
        limit = inf
        reader = i if i < len(bodies) else j
        if isinstance(link, WireLink):
            kind, rest, tolerance = WIRE, link.rest, link.tolerance
            limit = inf if link.limit is None else link.limit
            if link.tension is not None:
                tension = programs.add(link.tension, reader)
            if link.over is not None:
                over, wound = number[link.over.body], _drawn(link, link.over, everyone, i, j)
        elif isinstance(link, SpringLink):
            kind, rest, stiffness, damping = SPRING, link.rest, link.stiffness, link.damping
        indices = (kind, i, j, tension, reader, over, 0)
        sizes = (rest, stiffness, damping, tolerance, limit, wound)
        rows.append((*indices, *link.start.point, *link.end.point, *sizes))
    pushes = [force for force in scene.forces if force.body in chosen]
    pushed = [
        (at, programs.add(push.x, at), programs.add(push.y, at))
        for push in pushes
        for at in (number[push.body],)
    ]
    courses = [course for course in scene.courses if course.body in chosen]
    followed = [_course(course, number[course.body], programs) for course in courses]
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
    for body, axis, *_ in followed:
        inverse[body, axis] = 0.0
    outlines = [_outline(body.shape) for body in everyone]
    pinned = {(min(i, j), max(i, j)) for kind, i, j, *_ in rows if kind == PIN}
    held = {
        (min(i, j), max(i, j)): k
        for k, (i, j) in enumerate((number[support.body], number[support.on]) for support in supports)
    }
    pairs = _pairs(everyone, len(bodies), outlines, pinned, held)
    for k, pair in enumerate(pairs):
        if pair[2] >= 0:
            support_table[pair[2]]["pair"] = k
    arrays: tuple[NDArray[Any], ...] = (
        np.asarray(scene.gravity, float),
        mass,
        inverse,
        *_shapes(outlines),
        np.array(rows, LINK),
        np.array(pairs, PAIR),
        np.array(pushed, PUSH),
        support_table,
        np.array(followed, COURSE),
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
    plan = LAYOUT.plan(
        len(named["mass"]),
        movable,
        len(named["corners"]),
        len(named["links"]),
        len(named["pairs"]),
        len(named["pushes"]),
        len(named["supports"]),
        len(named["courses"]),
        len(named["ops"]),
        len(named["spans"]),
        len(named["stack"]),
    )
    return World._make(plan.filled(arrays))


def viewed(cells: FloatArray) -> World:
    """The world that such cells hold."""
    return World._make((*LAYOUT.plan_of(cells).views(cells), cells))


def copied(world: World) -> World:
    """The same in memory of its own."""
    return viewed(world.cells.copy())


def start_of(scene: Scene, names: Names) -> tuple[FloatArray, FloatArray]:
    """Poses and velocities at the start, (bodies + 1, 3): the page comes last."""
    known = {body.label: body for body in scene.bodies}
    everyone = [known[label] for label in names.bodies]
    still = (0.0, 0.0, 0.0)
    return (
        np.array([*((*body.position, body.angle) for body in everyone), still], float),
        np.array([*(body.velocity for body in everyone), still], float),
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


def _course(course: Course, at: int, programs: _Programs) -> tuple[int, ...]:
    position = -1 if course.position is None else programs.add(course.position, at)
    velocity, acceleration = programs.add(course.velocity, at), programs.add(course.acceleration, at)
    return at, 0 if course.axis == "x" else 1, position, velocity, acceleration, 1


def _masses(everyone: list[Body], movable: int) -> tuple[FloatArray, FloatArray]:
    page = (1.0, 1.0, 1.0)
    mass = np.array([*((body.mass, body.mass, body.inertia) for body in everyone), page], float)
    inverse = np.zeros_like(mass)
    inverse[:movable] = 1.0 / mass[:movable]
    return mass, inverse


@dataclass(frozen=True, slots=True)
class _Outline:
    """Of a shape: see `World`; size: its least width, m, what another could miss if it moved that far unseen."""

    radius: float
    reach: float
    size: float
    corners: tuple[Vector, ...] = ()
    normals: tuple[Vector, ...] = ()
    edges: tuple[float, ...] = ()


@lru_cache(4096)
def _outline(shape: Disc | Block) -> _Outline:
    if isinstance(shape, Disc):
        return _Outline(shape.radius, shape.radius, 2 * shape.radius)
    vertices = shape.vertices
    normals: list[Vector] = []
    edges: list[float] = []
    widths: list[float] = []
    for (x1, y1), (x2, y2) in zip(vertices, (*vertices[1:], vertices[0]), strict=True):
        length = hypot(x2 - x1, y2 - y1)
        nx, ny = ((y2 - y1) / length, (x1 - x2) / length) if length > 0 else (0.0, 0.0)
        normals.append((nx, ny))
        edges.append(length)
        if length > 0:
            widths.append(max((x1 - x) * nx + (y1 - y) * ny for x, y in vertices))
    reach = max(hypot(x, y) for x, y in vertices)
    return _Outline(0.0, reach, min(widths), vertices, tuple(normals), tuple(edges))


def _shapes(outlines: list[_Outline]) -> tuple[NDArray[Any], ...]:
    """radius, first, sides, reach, corners, normals, edges: see `World`."""
    sides = [len(one.corners) for one in outlines]
    return (
        np.array([*(one.radius for one in outlines), 0.0]),
        np.array([*(0 if n == 0 else end - n for n, end in zip(sides, accumulate(sides), strict=True)), 0]),
        np.array([*sides, 0]),
        np.array([*(one.reach for one in outlines), 0.0]),
        np.array([corner for one in outlines for corner in one.corners], float),
        np.array([normal for one in outlines for normal in one.normals], float),
        np.array([edge for one in outlines for edge in one.edges], float),
    )


def _pairs(
    everyone: list[Body],
    movable: int,
    outlines: list[_Outline],
    pinned: set[tuple[int, int]],
    given: dict[tuple[int, int], int],
) -> list[tuple[int, int, int, float, float, float, float]]:
    """Rows of `PAIR`: pairs with one that moves, but those that a pin joins. given: the support of a pair.

    A load may well hit the wheel that its own wire runs over."""
    rows: list[tuple[int, int, int, float, float, float, float]] = []
    met: dict[tuple[int, int], tuple[float, float]] = {}
    kinds: dict[Material, int] = {}
    material = [kinds.setdefault(body.material, k) for k, body in enumerate(everyone)]
    for i in range(movable):
        one = outlines[i]
        for j in range(i + 1, len(everyone)):
            if (i, j) in pinned:
                continue
            both, other = (material[i], material[j]), outlines[j]
            if both not in met:
                met[both] = meeting(everyone[i].material, everyone[j].material)
            sizes = (one.reach + other.reach, min(one.size, other.size))
            rows.append((i, j, given.get((i, j), -1), *met[both], *sizes))
    return rows


def _drawn(link: WireLink, over: Pulley, everyone: list[Body], i: int, j: int) -> float:
    """How far a wire is wound about its pulley as it is drawn, rad. i, j: the rows of its two ends, the page last."""
    wheel = next(body for body in everyone if body.label == over.body)
    ends: list[Vector] = []
    for at, anchor in ((i, link.start), (j, link.end)):
        pose = (*everyone[at].position, everyone[at].angle) if at < len(everyone) else (0.0, 0.0, 0.0)
        x, y = placed(anchor.point, np.array(pose))
        ends.append((x - wheel.position[0], y - wheel.position[1]))
    assert isinstance(wheel.shape, Disc)
    return drawn(ends[0], ends[1], wheel.shape.radius, over.clockwise)


def placed(point: tuple[float, float], pose: FloatArray) -> tuple[float, float]:
    """A point of a body's frame in the world."""
    c, s = cos(pose[2]), sin(pose[2])
    return float(pose[0] + c * point[0] - s * point[1]), float(pose[1] + s * point[0] + c * point[1])
