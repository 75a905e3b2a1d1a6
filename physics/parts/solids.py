"""The page's circles and polygons as bodies: shape, mass, material, velocity at the start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot

import numpy as np

from physics.formula.meaning import PER_METRE, Said
from physics.formula.names import constant_of
from physics.formula.program import ProgramError
from physics.formula.vectors import split
from physics.parts.courses import moves
from physics.parts.given import Page, to_metres
from physics.scene import Block, Body, Course, Disc, Material, Vector, block_inertia, disc_inertia
from sketch.geometry import centroid, signed_area, solid_area
from sketch.ink import FloatArray
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Point, Polygon, Solid


@dataclass(frozen=True, slots=True)
class SolidRule:
    """What counts as a solid."""

    thin: float = 1.0
    """Square page units: a polygon of less area is a line, not a block."""


RULE = SolidRule()


def solids_of(sketch: Sketch, notices: list[str]) -> list[Component]:
    """The components that have a body."""
    found: list[Component] = []
    for part in sketch.components:
        if isinstance(part.shape, Polygon) and solid_area(Polygon(hull(part.shape.vertices))) < RULE.thin:
            notices.append(f"{part.label} encloses no area; it is not part of the motion.")
        elif isinstance(part.shape, Circle | Polygon):
            found.append(part)
    return found


def centre_of(shape: Solid) -> Vector:
    """The centre of mass, m."""
    if isinstance(shape, Circle):
        return to_metres(shape.centre)
    middle = centroid(hull(shape.vertices))
    return to_metres((float(middle[0]), float(middle[1])))


def body_of(page: Page, part: Component, courses: Sequence[Course]) -> Body:
    """The body of a component, at rest or as the page says. courses: of all bodies."""
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
    assert isinstance(part.shape, Polygon)
    vertices = hull(part.shape.vertices)
    if abs(signed_area(vertices)) > 1.001 * abs(signed_area(part.shape.vertices)):
        page.notices.append(f"{part.label} is not convex; it moves as if its hollows were filled.")
    local = tuple((float(x) / PER_METRE, -float(y) / PER_METRE) for x, y in vertices - centroid(vertices))
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


def hull(vertices: FloatArray) -> FloatArray:
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
