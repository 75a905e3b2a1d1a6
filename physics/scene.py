"""What is to be moved: bodies, links, forces. The input of every engine.

Frame: SI units, x to the right, y *up*, angles anti-clockwise in radians. A body's own frame
has its origin in the centre of mass and turns with the body; an anchor on the page (body
None) is a point of the world.

Whatever cannot be moved is refused here with a `SceneError`, so that an engine may trust
what it is given.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, isfinite, pi, sin
from typing import Literal

from physics.formula.program import STATE, Program

Vector = tuple[float, float]


class SceneError(ValueError):
    """A scene that cannot be moved: the message says what, where and what would be right."""


@dataclass(frozen=True, slots=True)
class Material:
    """How a body meets others; None where the page says nothing.

    restitution: 0 (dead) to 1 (elastic); friction: Coulomb's coefficient, not below 0. Where two
    bodies meet, the one that says something speaks for both; if both do, the geometric mean holds.
    """

    restitution: float | None = None
    friction: float | None = None


@dataclass(frozen=True, slots=True)
class Disc:
    """A disc of this radius (m) about its centre of mass."""

    radius: float


@dataclass(frozen=True, slots=True)
class Block:
    """A convex block: vertices (m) about its centre of mass, anti-clockwise."""

    vertices: tuple[Vector, ...]


Shape = Disc | Block


@dataclass(frozen=True, slots=True)
class Body:
    """A solid. position: its centre of mass, m; mass: kg; inertia: about the centre of mass,
    kg m²; velocity: (m/s, m/s, rad/s). A fixed body never moves, whatever its mass.

    Raises SceneError on numbers that are not finite, no mass, no inertia, no area, a block that
    is not convex and anti-clockwise.
    """

    label: str
    shape: Shape
    position: Vector
    mass: float
    inertia: float
    angle: float = 0.0
    fixed: bool = False
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    material: Material = Material()

    def __post_init__(self) -> None:
        name = f"body {self.label!r}"
        _finite(name, *self.position, self.angle, *self.velocity, self.mass, self.inertia)
        if self.mass <= 0 or self.inertia <= 0:
            raise SceneError(
                f"{name} has mass {self.mass:g} kg and inertia {self.inertia:g} kg m²; both must be above zero"
            )
        if self.fixed and any(self.velocity):
            raise SceneError(f"{name} is fixed and has a velocity; a fixed body's must be zero")
        _check_shape(name, self.shape)
        restitution, friction = self.material.restitution, self.material.friction
        if restitution is not None and not 0 <= restitution <= 1:
            raise SceneError(f"{name} has restitution {restitution:g}; it must lie between 0 and 1")
        if friction is not None and not 0 <= friction < float("inf"):
            raise SceneError(f"{name} has friction {friction:g}; it must not be below 0")


@dataclass(frozen=True, slots=True)
class Anchor:
    """A point of a body, in its own frame, m; with body None a point of the world."""

    body: str | None
    point: Vector


@dataclass(frozen=True, slots=True)
class SpringLink:
    """A spring that pulls and pushes. rest: m; stiffness: N/m; damping: N s/m along its axis."""

    label: str
    start: Anchor
    end: Anchor
    rest: float
    stiffness: float
    damping: float = 0.0


@dataclass(frozen=True, slots=True)
class Pulley:
    """The fixed disc that a wire runs over without friction, and the sense in which it goes round it
    on its way from its start to its end, as drawn. The disc is solid, for the wire as for its loads: the wire
    may wind farther round it, come off it, and lie against its other side, but never passes through it."""

    body: str
    clockwise: bool


@dataclass(frozen=True, slots=True)
class WireLink:
    """An inextensible wire that may hang slack. rest: its length, m, with what lies on a pulley.

    tension: the student's, in newtons: it *replaces* the wire's constraint by a pull of that size
    along the wire, and the wire breaks when its length differs from rest by more than
    `tolerance` (m). None: the engine supplies the true tension. limit: the tension, N, at which the
    wire breaks; None: it holds whatever comes. over: the pulley that it runs over.
    """

    label: str
    start: Anchor
    end: Anchor
    rest: float
    tension: Program | None = None
    tolerance: float = 0.05
    limit: float | None = None
    over: Pulley | None = None


@dataclass(frozen=True, slots=True)
class Pin:
    """Two points held together, free to turn. Bodies that a pin joins do not collide with each other."""

    label: str
    start: Anchor
    end: Anchor


Link = SpringLink | WireLink | Pin


@dataclass(frozen=True, slots=True)
class Force:
    """A student's force on a body, at its centre of mass: one program for each direction, N."""

    name: str
    body: str
    x: Program
    y: Program


@dataclass(frozen=True, slots=True)
class Edge:
    """The edge of a block from start to end, in the block's frame (m), outside on its right."""

    start: Vector
    end: Vector


@dataclass(frozen=True, slots=True)
class Support:
    """A student's normal force: it *replaces* what body `on` gives to `body`.

    It acts on the body's centre of mass along the outward normal of `edge` (None: `on` is a disc,
    and the line of centres is meant) for as long as the centre stands over the edge. A body that
    sinks deeper than `skin` (m) is struck back without loss; one that rises higher has left.
    """

    name: str
    body: str
    on: str
    force: Program
    edge: Edge | None
    skin: float = 0.03


@dataclass(frozen=True, slots=True)
class Course:
    """A student's equation of motion for one coordinate of a body's centre, in place of Newton's (row M7).

    position (m): a program of time alone, or None where the student gives the velocity; velocity
    (m/s) and acceleration (m/s²): as given or derived. A given velocity is integrated once, a given
    position not at all. It holds until the body collides (row M8).
    """

    name: str
    body: str
    axis: Literal["x", "y"]
    position: Program | None
    velocity: Program
    acceleration: Program


@dataclass(frozen=True, slots=True)
class Scene:
    """Everything that moves, and what moves it. gravity: m/s².

    Programs are evaluated over `STATE` (physics.formula.program) of the body that they act on; a
    wire's tension over that of its movable end.
    Raises SceneError when a label is not there or is borne twice, or a link cannot be.
    """

    bodies: tuple[Body, ...] = ()
    springs: tuple[SpringLink, ...] = ()
    wires: tuple[WireLink, ...] = ()
    forces: tuple[Force, ...] = ()
    supports: tuple[Support, ...] = ()
    gravity: Vector = (0.0, -9.81)
    pins: tuple[Pin, ...] = ()
    courses: tuple[Course, ...] = ()

    def __post_init__(self) -> None:
        _finite("gravity", *self.gravity)
        labels = [body.label for body in self.bodies]
        links: tuple[Link, ...] = (*self.springs, *self.wires, *self.pins)
        everyone = labels + [link.label for link in links]
        twice = {label for label in everyone if everyone.count(label) > 1}
        if twice:
            raise SceneError(f"label {min(twice)!r} is borne twice; labels must be unique")
        for link in links:
            _check_link(link, labels)
        for wire in self.wires:
            if wire.over is not None:
                self._check_pulley(wire, wire.over, labels)
        for act in (*self.forces, *self.supports):
            if act.body not in labels:
                raise SceneError(f"force {act.name!r} acts on {act.body!r}, which is not there")
        self._check_courses(labels)
        self._check_programs(labels)
        for support in self.supports:
            if support.on not in labels or support.on == support.body:
                raise SceneError(
                    f"force {support.name!r} stands in for {support.on!r}, which cannot support it"
                )
            if isinstance(self.body(support.on).shape, Block) and support.edge is None:
                raise SceneError(
                    f"force {support.name!r} stands in for a block; it must name one of its edges"
                )

    def _check_pulley(self, wire: WireLink, pulley: Pulley, labels: list[str]) -> None:
        wheel = self.body(pulley.body) if pulley.body in labels else None
        if wheel is None or not wheel.fixed or not isinstance(wheel.shape, Disc):
            raise SceneError(f"wire {wire.label!r} runs over {pulley.body!r}; a pulley must be a fixed disc")
        for anchor in (wire.start, wire.end):
            if anchor.body == wheel.label:
                raise SceneError(f"wire {wire.label!r} ends on {wheel.label!r}, the pulley that it runs over")
            (x, y), (cx, cy) = self._place(anchor), wheel.position
            if hypot(x - cx, y - cy) <= wheel.shape.radius * (1 - 1e-9):
                raise SceneError(
                    f"wire {wire.label!r} ends inside {wheel.label!r}, the pulley that it runs over"
                )

    def _place(self, anchor: Anchor) -> Vector:
        if anchor.body is None:
            return anchor.point
        body, (x, y) = self.body(anchor.body), anchor.point
        c, s = cos(body.angle), sin(body.angle)
        return body.position[0] + c * x - s * y, body.position[1] + s * x + c * y

    def _check_courses(self, labels: list[str]) -> None:
        given: set[tuple[str, str]] = set()
        for course in self.courses:
            name = f"equation {course.name!r}"
            if course.body not in labels:
                raise SceneError(f"{name} moves {course.body!r}, which is not there")
            if self.body(course.body).fixed:
                raise SceneError(f"{name} moves {course.body!r}, which is fixed")
            if (course.body, course.axis) in given:
                raise SceneError(f"{name} gives {course.body!r} a second {course.axis}; one is enough")
            given.add((course.body, course.axis))
            if course.position is not None and any(
                operation == "read" and operand % len(STATE) != 0
                for operation, operand in course.position.code
            ):
                raise SceneError(f"{name} gives a position, which may depend on the time t alone")

    def _check_programs(self, labels: list[str]) -> None:
        used: list[tuple[str, Program | None]] = [(wire.label, wire.tension) for wire in self.wires]
        used += [(force.name, program) for force in self.forces for program in (force.x, force.y)]
        used += [(support.name, support.force) for support in self.supports]
        for course in self.courses:
            used += [(course.name, p) for p in (course.position, course.velocity, course.acceleration)]
        for name, program in used:
            if program is None:
                continue
            absent = [label for label in program.others if label not in labels]
            if absent:
                raise SceneError(f"formula of {name!r} reads the motion of {absent[0]!r}, which is not there")
            reads = [operand for operation, operand in program.code if operation == "read"]
            if not all(0 <= operand < len(STATE) * (1 + len(program.others)) for operand in reads):
                raise SceneError(f"formula of {name!r} reads more than the bodies that it names have")

    def body(self, label: str) -> Body:
        """The body that bears the label. Raises KeyError when there is none."""
        for body in self.bodies:
            if body.label == label:
                return body
        raise KeyError(label)


def disc_inertia(mass: float, radius: float) -> float:
    """½ m r², kg m²."""
    return 0.5 * mass * radius * radius


def block_inertia(mass: float, vertices: tuple[Vector, ...]) -> float:
    """Of an even block about its centre of mass, where its vertices are measured from; kg m²."""
    area = second = 0.0
    for (x1, y1), (x2, y2) in zip(vertices, (*vertices[1:], vertices[0]), strict=True):
        cross = x1 * y2 - x2 * y1
        area += cross
        second += cross * (x1 * x1 + x1 * x2 + x2 * x2 + y1 * y1 + y1 * y2 + y2 * y2)
    return mass * second / (6 * area)


def area_of(shape: Shape) -> float:
    """m²; negative for a block that runs clockwise."""
    if isinstance(shape, Disc):
        return pi * shape.radius**2
    around = zip(shape.vertices, (*shape.vertices[1:], shape.vertices[0]), strict=True)
    return 0.5 * sum(x1 * y2 - x2 * y1 for (x1, y1), (x2, y2) in around)


def _check_shape(name: str, shape: Shape) -> None:
    if isinstance(shape, Disc):
        _finite(name, shape.radius)
        if shape.radius <= 0:
            raise SceneError(f"{name} has radius {shape.radius:g} m; it must be above zero")
        return
    vertices = shape.vertices
    for vertex in vertices:
        _finite(name, *vertex)
    if len(vertices) < 3 or area_of(shape) <= 0:
        raise SceneError(f"{name} needs at least three vertices, anti-clockwise, that enclose an area")
    span = max(hypot(x, y) for x, y in vertices)
    count = len(vertices)
    for k in range(count):
        (x0, y0), (x1, y1), (x2, y2) = vertices[k - 1], vertices[k], vertices[(k + 1) % count]
        if (x1 - x0) * (y2 - y1) - (y1 - y0) * (x2 - x1) < -1e-9 * span * span:
            raise SceneError(f"{name} is not convex at vertex {k}; only convex blocks can be moved")


def _check_link(link: Link, labels: list[str]) -> None:
    name = f"link {link.label!r}"
    _finite(name, *link.start.point, *link.end.point)
    for anchor in (link.start, link.end):
        if anchor.body is not None and anchor.body not in labels:
            raise SceneError(f"{name} is attached to {anchor.body!r}, which is not there")
    if link.start.body == link.end.body:
        raise SceneError(f"{name} has both ends on one body; it must join two")
    if isinstance(link, Pin):
        return
    _finite(name, link.rest)
    if link.rest <= 0:
        raise SceneError(f"{name} has length {link.rest:g} m; it must be above zero")
    if isinstance(link, SpringLink):
        _finite(name, link.stiffness, link.damping)
        if link.stiffness < 0 or link.damping < 0:
            raise SceneError(f"{name} has stiffness {link.stiffness:g} N/m; it must not be below zero")
    elif link.tolerance <= 0:
        raise SceneError(f"{name} breaks at a tolerance of {link.tolerance:g} m; it must be above zero")
    elif link.limit is not None and not 0 <= link.limit < float("inf"):
        raise SceneError(f"{name} breaks at a tension of {link.limit:g} N; it must not be below zero")


def _finite(name: str, *values: float) -> None:
    if not all(isfinite(value) for value in values):
        raise SceneError(f"{name} holds a number that is not finite; NaN and infinity are not accepted")
