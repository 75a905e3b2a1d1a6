"""The page's circles and polygons as bodies: shape, mass, material, velocity at the start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import hypot, inf

from physics.formula.meaning import PER_METRE, Said
from physics.formula.names import constant_of
from physics.formula.program import ProgramError
from physics.formula.vectors import split
from physics.parts.courses import moves
from physics.parts.given import Page
from physics.scene import Block, Body, Course, Disc, Material, block_inertia, disc_inertia
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Point, Polygon


@dataclass(frozen=True, slots=True)
class SolidRule:
    """What counts as a solid."""

    thin: float = 1.0
    """Square page units: a polygon of less area is a line, not a block."""


RULE = SolidRule()


@dataclass(frozen=True, slots=True)
class Figure:
    """A component that has a body. corners: of a polygon's convex hull, page units, anti-clockwise to the eye, ()
    for a circle; centre: of mass, page units; filled: the hull's area over the polygon's own, infinite
    where it crosses itself so that it has none."""

    part: Component
    corners: tuple[Point, ...]
    centre: Point
    filled: float = 1.0


def solids_of(sketch: Sketch, notices: list[str]) -> list[Figure]:
    """The components that have a body."""
    found: list[Figure] = []
    for part in sketch.components:
        if isinstance(part.shape, Circle):
            found.append(Figure(part, (), part.shape.centre))
        elif isinstance(part.shape, Polygon):
            filled = _filled(part.shape)
            if filled is None:
                notices.append(f"{part.label} encloses no area; it is not part of the motion.")
            else:
                found.append(Figure(part, *filled))
    return found


@lru_cache(maxsize=1024)  # an edited formula changes no shape
def _filled(polygon: Polygon) -> tuple[tuple[Point, ...], Point, float] | None:
    """(corners, centre, filled) of a `Figure`; None for what encloses no area."""
    drawn: list[Point] = [(x, y) for x, y in polygon.vertices.tolist()]
    corners = hull(drawn)
    area, centre = _area_and_centre(corners)
    if area < RULE.thin:
        return None
    own = _area_and_centre(drawn)[0]
    return tuple(corners), centre, area / own if own >= RULE.thin else inf


def body_of(page: Page, figure: Figure, courses: Sequence[Course]) -> Body:
    """The body of a component, at rest or as the page says. courses: of all bodies."""
    part = figure.part
    mass, centre = page.masses[part.label], page.starts[part.label]
    material = Material(
        page.constant(part, "restitution", 0.0, 1.0, "a coefficient of restitution lies between 0 and 1"),
        page.constant(part, "friction", 0.0, 1e9, "a coefficient of friction is not below zero"),
    )
    own = {course.axis: course for course in courses if course.body == part.label}
    velocity = (0.0, 0.0, 0.0) if part.fixed else _velocity(page, part, own)
    if isinstance(part.shape, Circle):
        disc = Disc(part.shape.radius / PER_METRE)
        inertia = disc_inertia(mass, disc.radius)
        return Body(part.label, disc, centre, mass, inertia, 0.0, part.fixed, velocity, material)
    if figure.filled > 1.001:
        page.notices.append(f"{part.label} is not convex; it moves as if its hollows were filled.")
    cx, cy = figure.centre
    local = tuple(((x - cx) / PER_METRE, (cy - y) / PER_METRE) for x, y in figure.corners)
    inertia = block_inertia(mass, local)
    return Body(part.label, Block(local), centre, mass, inertia, 0.0, part.fixed, velocity, material)


def _velocity(page: Page, part: Component, courses: dict[str, Course]) -> tuple[float, float, float]:
    """At the start. A speed without direction is taken to the right, visibly; a coordinate that has an
    equation begins as that says."""
    must = "a velocity must be a number"
    x = y = 0.0
    said = page.said(part, "velocity")
    if said is not None and not moves(page, part, said):
        try:
            pair = split(said.tree)
        except ProgramError:
            pair = None
        if pair is None:
            x = page.value(said, part.label, -1e6, 1e6, must) or 0.0
            if x:
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
        said = page.said(part, role)
        if said is None or moves(page, part, said):
            continue
        value = page.value(said, part.label, -1e6, 1e6, must)
        if value is not None:
            x, y = (value, y) if role == "v_x" else (x, value)
    x, y = (
        page.at_start(courses[axis].velocity, part.label) if axis in courses else value
        for axis, value in (("x", x), ("y", y))
    )
    return x, y, page.constant(part, "spin", -1e6, 1e6, "an angular velocity must be a number") or 0.0


def hull(vertices: list[Point]) -> list[Point]:
    """The convex hull, anti-clockwise to the eye from the leftmost, no vertex on a straight edge, whichever way the
    vertices run; the vertices as they are where they enclose nothing. Andrew's monotone chain."""
    points = sorted(set(vertices))
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
    found = chains[0] + chains[1]
    return found if len(found) >= 3 else vertices


def _area_and_centre(corners: list[Point]) -> tuple[float, Point]:
    """(area, centre of area) of a simple polygon; the mean corner where it has no area. Measured from a corner,
    so that a page's size costs no digits."""
    x0, y0 = corners[0]
    twice = cx = cy = 0.0
    for (x1, y1), (x2, y2) in pairwise([*corners, corners[0]]):
        ax, ay, bx, by = x1 - x0, y1 - y0, x2 - x0, y2 - y0
        cross = ax * by - ay * bx
        twice += cross
        cx += cross * (ax + bx)
        cy += cross * (ay + by)
    if twice == 0:
        count = len(corners)
        return 0.0, (sum(x for x, _ in corners) / count, sum(y for _, y in corners) / count)
    return abs(twice) / 2, (x0 + cx / (3 * twice), y0 + cy / (3 * twice))
