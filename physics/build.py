"""From a corrected page to a scene: page units to metres, mathematics to numbers and programs.

100 page units are a metre; the page's y points down, the scene's up. What the page leaves open
gets a default; what it says and cannot be is left out. Either way a notice tells the student.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, nan
from typing import assert_never

import numpy as np

from physics.formula.meaning import (
    GRAVITY,
    PER_METRE,
    Meanings,
    Role,
    Said,
    constant_of,
    lookup,
    mass_of,
    read,
    split,
)
from physics.formula.program import Lookup, Program, ProgramError, compile_tree
from physics.rectify.separation import apart
from physics.scene import (
    Anchor,
    Block,
    Body,
    Disc,
    Edge,
    Force,
    Material,
    Scene,
    SpringLink,
    Support,
    Vector,
    WireLink,
    block_inertia,
    disc_inertia,
)
from sketch.geometry import centroid, signed_area, solid_area
from sketch.ink import FloatArray
from sketch.page import Component, Sketch
from sketch.shapes import Arrow, Circle, Point, Polygon, Spring, Wire


@dataclass(frozen=True, slots=True)
class BuildRule:
    """What a page means where it says nothing (row M1), and what counts as touching."""

    stiffness: float = 50.0
    """N/m: a kilogram stretches such a spring by 20 units."""
    yields: float = 0.05
    """Share of its length by which a wire under a given tension may be off before it breaks: it
    forgives a tension rounded to two digits (5√2 as 7.1), not one that is 15 % wrong."""
    touching: float = 0.5
    """Page units: a gap below this is a contact that a given normal force may stand in for."""
    thin: float = 1.0
    """Square page units: a polygon of less area is a line, not a block."""


RULE = BuildRule()


@dataclass(frozen=True, slots=True)
class Built:
    """A scene, and what has to be said about it."""

    scene: Scene
    notices: tuple[str, ...]


def build(sketch: Sketch) -> Built:
    """The scene of a page. Never raises for what a page may hold: what cannot be is left out, and
    a notice says so."""
    meanings = read(sketch)
    notices = list(meanings.notices)
    g = _gravity(sketch, meanings, notices)
    solids = [
        part
        for part in sketch.components
        if isinstance(part.shape, Circle | Polygon) and _solid(part, notices)
    ]
    masses = {part.label: _mass(sketch, meanings, part, notices) for part in solids}
    page = _Page(sketch, meanings, masses, g, notices)
    bodies = tuple(_body(page, part) for part in solids)
    springs, wires = _links(page, {body.label: body for body in bodies})
    forces, supports = _forces(page, bodies)
    scene = Scene(bodies, springs, wires, forces, supports, (0.0, -g))
    return Built(scene, tuple(dict.fromkeys(notices)))


def to_metres(point: Point) -> Vector:
    """A place of the page (units, y down) in the scene (m, y up)."""
    return point[0] / PER_METRE, -point[1] / PER_METRE


@dataclass(frozen=True, slots=True)
class _Page:
    sketch: Sketch
    meanings: Meanings
    masses: dict[str, float]
    g: float
    notices: list[str]

    def names(self, label: str) -> Lookup:
        return lookup(self.sketch, self.meanings, label, self.masses, self.g)

    def constant(self, part: Component, role: Role, low: float, high: float, must: str) -> float | None:
        """A constant that the page gives a component, None when it gives none that can be."""
        said = self.meanings.of(part.label, role, part.kind)
        if said is None:
            return None
        value = constant_of(said, self.names(part.label))
        if value is None or not low <= value <= high:
            self.notices.append(f"{said.text} of {part.label}: {must}; it is not used.")
            return None
        self.report(said, part.label)
        return value

    def program(self, said: Said, label: str, tree: object) -> Program | None:
        """A formula's program; what has no value counts as zero, visibly."""
        try:
            made = compile_tree(tree, self.names(label), said.text.partition("=")[2].strip() or said.text)
        except ProgramError as error:
            self.notices.append(f"{said.text} of {label} cannot be worked out: {error}. It is not used.")
            return None
        for name in made.unspecified:
            self.notices.append(
                f"{name} in {said.text} of {label} has no value on this page; it counts as zero."
            )
        return made

    def report(self, said: Said, label: str) -> None:
        made = self.program(said, label, said.tree)
        if made is not None and not made.constant:
            self.notices.append(f"{said.text} of {label} changes in time; its value at the start is used.")


def _gravity(sketch: Sketch, meanings: Meanings, notices: list[str]) -> float:
    said = meanings.of(None, "gravity", None)
    if said is None:
        return GRAVITY
    value = constant_of(said, lookup(sketch, meanings, None, {}, GRAVITY))
    if value is None:
        notices.append(
            f"{said.text}: the acceleration of free fall must be a number; {GRAVITY} m/s² is used."
        )
        return GRAVITY
    return value


def _solid(part: Component, notices: list[str]) -> bool:
    if isinstance(part.shape, Polygon) and solid_area(Polygon(_hull(part.shape.vertices))) < RULE.thin:
        notices.append(f"{part.label} encloses no area; it is not part of the motion.")
        return False
    return True


def _mass(sketch: Sketch, meanings: Meanings, part: Component, notices: list[str]) -> float:
    mass, notice = mass_of(sketch, meanings, part)
    if notice is not None:
        notices.append(notice)
    return mass


def _body(page: _Page, part: Component) -> Body:
    mass = page.masses[part.label]
    material = Material(
        page.constant(part, "restitution", 0.0, 1.0, "a coefficient of restitution lies between 0 and 1"),
        page.constant(part, "friction", 0.0, 1e9, "a coefficient of friction is not below zero"),
    )
    velocity = (0.0, 0.0, 0.0) if part.fixed else _velocity(page, part)
    if isinstance(part.shape, Circle):
        disc = Disc(part.shape.radius / PER_METRE)
        centre = to_metres(part.shape.centre)
        inertia = disc_inertia(mass, disc.radius)
        return Body(part.label, disc, centre, mass, inertia, 0.0, part.fixed, velocity, material)
    assert isinstance(part.shape, Polygon)
    vertices = _hull(part.shape.vertices)
    if abs(signed_area(vertices)) > 1.001 * abs(signed_area(part.shape.vertices)):
        page.notices.append(f"{part.label} is not convex; it moves as if its hollows were filled.")
    middle = centroid(vertices)
    local = tuple((float(x) / PER_METRE, -float(y) / PER_METRE) for x, y in vertices - middle)
    centre = to_metres((float(middle[0]), float(middle[1])))
    inertia = block_inertia(mass, local)
    return Body(part.label, Block(local), centre, mass, inertia, 0.0, part.fixed, velocity, material)


def _velocity(page: _Page, part: Component) -> tuple[float, float, float]:
    """At the start. A speed without direction is taken to the right, visibly."""
    must = "a velocity must be a number"
    x = y = 0.0
    said = page.meanings.of(part.label, "velocity", part.kind)
    if said is not None:
        try:
            pair = split(said.tree)
        except ProgramError:
            pair = None
        if pair is None:
            value = page.constant(part, "velocity", -1e6, 1e6, must)
            x = value or 0.0
            if value:
                page.notices.append(
                    f"{said.text} of {part.label} has no direction; it is taken to the right."
                )
        else:
            parts = [
                constant_of(Said(said.name, said.component, tree, said.text), page.names(part.label))
                for tree in pair
            ]
            x, y = (0.0 if value is None else value for value in parts)
    for role in ("v_x", "v_y"):
        value = page.constant(part, role, -1e6, 1e6, must)
        if value is not None:
            x, y = (value, y) if role == "v_x" else (x, value)
    return x, y, page.constant(part, "spin", -1e6, 1e6, "an angular velocity must be a number") or 0.0


def _links(page: _Page, bodies: dict[str, Body]) -> tuple[tuple[SpringLink, ...], tuple[WireLink, ...]]:
    springs: list[SpringLink] = []
    wires: list[WireLink] = []
    for part in page.sketch.components:
        match part.shape:
            case Spring() | Wire():
                link = _link(page, part, part.shape, bodies)
                if isinstance(link, SpringLink):
                    springs.append(link)
                elif link is not None:
                    wires.append(link)
            case Circle() | Polygon() | Arrow():
                pass
            case _:
                assert_never(part.shape)
    return tuple(springs), tuple(wires)


def _link(
    page: _Page, part: Component, shape: Spring | Wire, bodies: dict[str, Body]
) -> SpringLink | WireLink | None:
    """A link with both ends placed. An end that hangs free is pinned to the page where it was drawn:
    drawn links are meant to hold something, and the page is what they then hold on to."""
    ends = [end if end in bodies else None for end in part.ends]
    if ends[0] == ends[1]:
        page.notices.append(f"{part.label} does not join two things; it is not part of the motion.")
        return None
    if None in ends:
        page.notices.append(
            f"One end of {part.label} is attached to nothing; it is pinned to the page there."
        )
    start, end = (
        _anchor(place, bodies.get(label or ""))
        for place, label in zip((shape.start, shape.end), ends, strict=True)
    )
    drawn = hypot(shape.end[0] - shape.start[0], shape.end[1] - shape.start[1]) / PER_METRE
    rest = page.constant(part, "length", 1e-6, 1e6, "a length must be a number above zero") or drawn
    if isinstance(shape, Spring):
        stiffness = page.constant(
            part, "stiffness", 0.0, 1e9, "a stiffness must be a number, and not below zero"
        )
        return SpringLink(part.label, start, end, rest, RULE.stiffness if stiffness is None else stiffness)
    said = page.meanings.of(part.label, "tension", "wire")
    tension = None if said is None else page.program(said, part.label, said.tree)
    return WireLink(part.label, start, end, rest, tension, RULE.yields * rest)


def _anchor(place: Point, body: Body | None) -> Anchor:
    x, y = to_metres(place)
    return (
        Anchor(None, (x, y))
        if body is None
        else Anchor(body.label, (x - body.position[0], y - body.position[1]))
    )


def _forces(page: _Page, bodies: tuple[Body, ...]) -> tuple[tuple[Force, ...], tuple[Support, ...]]:
    """A vector is a force like any other; a scalar is the normal force that the student gives in
    place of what the body rests on."""
    forces: list[Force] = []
    supports: list[Support] = []
    zero = Program("0", (("push", 0.0),))
    newest = {(said.component, said.name): said for said in page.meanings.said}
    for (label, name), said in newest.items():
        part = None if label is None else page.sketch.component(label)
        if part is None or label is None or not isinstance(part.shape, Circle | Polygon):
            continue
        if name.partition("_")[0] not in ("f", "F", "N", "R") or label not in page.masses or part.fixed:
            continue
        try:
            pair = split(said.tree)
        except ProgramError as error:
            page.notices.append(f"{said.text} of {label} cannot be worked out: {error}. It is not used.")
            continue
        axis = name[-1] if "_" in name and name[-1] in "xy" else None
        if pair is None and axis is None:
            support = _support(page, part, said, bodies, taken={held.body for held in supports})
            supports += [] if support is None else [support]
            continue
        trees = pair if pair is not None else (said.tree, None) if axis == "x" else (None, said.tree)
        x, y = (zero if tree is None else page.program(said, label, tree) for tree in trees)
        if x is not None and y is not None:
            forces.append(Force(name, label, x, y))
    return tuple(forces), tuple(supports)


def _support(
    page: _Page, part: Component, said: Said, bodies: tuple[Body, ...], taken: set[str]
) -> Support | None:
    """The given normal force in place of whatever carries the body: of all that it touches, what
    faces gravity most."""
    program = page.program(said, part.label, said.tree)
    if program is None:
        return None
    assert isinstance(part.shape, Circle | Polygon)
    if part.label in taken:
        page.notices.append(
            f"{said.text}: {part.label} has been given a normal force already; this one is not used."
        )
        return None
    best: tuple[float, str, Vector] | None = None
    for other in page.sketch.components:
        if other.label == part.label or other.label not in page.masses:
            continue
        assert isinstance(other.shape, Circle | Polygon)
        gap, (nx, ny) = apart(other.shape, part.shape)
        if gap <= RULE.touching and (best is None or -ny > best[0]):
            best = (-ny, other.label, (nx, -ny))
    if best is None:
        page.notices.append(
            f"{said.text} of {part.label} has no direction, since {part.label} rests on nothing; "
            "write it as a pair, such as (0, 5). It is not used."
        )
        return None
    on = next(body for body in bodies if body.label == best[1])
    edge = _edge(on, best[2])
    return Support(said.name, part.label, on.label, program, edge)


def _edge(body: Body, normal: Vector) -> Edge | None:
    """The edge of a block whose outward normal is nearest to `normal`; None for a disc."""
    if isinstance(body.shape, Disc):
        return None
    vertices = body.shape.vertices
    best, found = -nan, None
    for (x1, y1), (x2, y2) in zip(vertices, (*vertices[1:], vertices[0]), strict=True):
        facing = ((y2 - y1) * normal[0] + (x1 - x2) * normal[1]) / (hypot(x2 - x1, y2 - y1) or 1.0)
        if found is None or facing > best:
            best, found = facing, Edge((x1, y1), (x2, y2))
    return found


def _hull(vertices: FloatArray) -> FloatArray:
    """The convex hull, (k, 2), anti-clockwise to the eye, no vertex on a straight edge; (n, 2) as they
    are where they enclose nothing. Andrew's monotone chain."""
    points = sorted({(float(x), float(y)) for x, y in vertices})
    if len(points) < 3:
        return vertices
    chains: list[list[Point]] = []
    span = max(hypot(x - points[0][0], y - points[0][1]) for x, y in points)
    for way in (points, points[::-1]):
        chain: list[Point] = []
        for x, y in way:
            while len(chain) > 1:
                (x1, y1), (x2, y2) = chain[-2:]
                if (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1) < -1e-9 * span * span:
                    break
                chain.pop()
            chain.append((x, y))
        chains.append(chain[:-1])
    hull = np.array(chains[0] + chains[1])
    return hull if len(hull) >= 3 else vertices
