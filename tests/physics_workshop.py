"""Exact pages with much on them, and the same pages as an unsteady hand leaves them. Page units, y down."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, cos, hypot, pi, sin, tan

import numpy as np
from physics_pages import page, rectangle

from sketch.page import Component, Sketch
from sketch.shapes import Circle, Point, Polygon, Shape, Wire


def workshop(seed: int) -> Sketch:
    """A floor with a stack and a chain of balls on it; an incline with a box, a ball on the box, and a bob that
    hangs beside; a pendulum; a box on two wires. Angles are said of the incline, the pendulum and a wire."""
    rng = np.random.default_rng([5, seed])
    floor = Component(rectangle(0, 500, 1400, 540), label="F", fixed=True)
    ceiling = Component(rectangle(0, 0, 1400, 40), label="G", fixed=True)
    parts, remarks = [floor, ceiling], []

    bottom = 500.0
    for k in range(int(rng.integers(1, 4))):
        top = bottom - float(rng.uniform(40, 70))
        half = float(rng.uniform(45, 60)) - 6 * k
        parts.append(Component(rectangle(100 - half, top, 100 + half, bottom), label=f"S{k}"))
        bottom = top
    x, last = 220.0, 0.0
    for k in range(3):
        radius = float(rng.uniform(18, 30))
        if k:
            # The next ball on the floor touches the last: their centres are 2 √(r s) apart along it.
            x += 2 * float(np.sqrt(radius * last))
        parts.append(Component(Circle((x, 500 - radius), radius), label=f"C{k}"))
        last = radius

    angle = float(rng.uniform(0.3, 0.8))
    up, out = (cos(angle), -sin(angle)), (-sin(angle), -cos(angle))
    triangle = Polygon([(450, 500), (750, 500), (750, 500 - 300 * tan(angle))])
    parts.append(Component(triangle, label="I", fixed=True))
    remarks.append((f"theta = {angle!r}", "I", (480.0, 495.0)))
    way, size = float(rng.uniform(120, 200)), float(rng.uniform(36, 50))
    base = (450 + way * up[0], 500 + way * up[1])
    corners = [
        (base[0] + a * size * up[0] + b * size * out[0], base[1] + a * size * up[1] + b * size * out[1])
        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))
    ]
    parts.append(Component(Polygon(corners), label="R"))
    middle = (corners[2][0] + corners[3][0]) / 2, (corners[2][1] + corners[3][1]) / 2
    parts.append(Component(Circle((middle[0] + 15 * out[0], middle[1] + 15 * out[1]), 15.0), label="Q"))

    lean = float(rng.uniform(0.2, 0.7))
    end = (900 + 120 * sin(lean), 40 + 120 * cos(lean))
    parts.append(Component(Wire((900.0, 40.0), end), label="W", ends=("G", "P")))
    parts.append(Component(Circle((end[0] + 20 * sin(lean), end[1] + 20 * cos(lean)), 20.0), label="P"))
    remarks.append((f"theta = {lean!r}", "W", (900.0, 44.0)))
    parts.append(
        Component(Wire((end[0], end[1] + 0.0), (end[0] + 0.0, end[1] + 150.0)), label="H", ends=("P", "B"))
    )
    foot = (end[0] + 20 * sin(lean), end[1] + 20 * cos(lean) + 20)
    parts[-1] = replace(parts[-1], shape=Wire(foot, (foot[0], foot[1] + 60)))
    parts.append(Component(Circle((foot[0], foot[1] + 75), 15.0), label="B"))

    tilt = float(rng.uniform(0.6, 0.9))
    left, right = (
        (1180 - 100 * cos(tilt), 240 - 100 * sin(tilt)),
        (1260 + 100 * cos(tilt), 240 - 100 * sin(tilt)),
    )
    parts += [
        Component(rectangle(left[0] - 30, left[1] - 40, left[0] + 30, left[1]), label="X", fixed=True),
        Component(rectangle(right[0] - 30, right[1] - 40, right[0] + 30, right[1]), label="Y", fixed=True),
        Component(Wire(left, (1180.0, 240.0)), label="T", ends=("X", "K")),
        Component(Wire(right, (1260.0, 240.0)), label="U", ends=("Y", "K")),
        Component(rectangle(1180, 240, 1260, 300), label="K"),
    ]
    remarks += [(f"theta = {tilt!r}", "T", (1175.0, 236.0)), (f"theta = {tilt!r}", "U", (1265.0, 236.0))]
    return page(parts, remarks)


def shaken(sketch: Sketch, noise: float, seed: int) -> Sketch:
    """Every vertex, centre and end off by `noise` page units (standard deviation, each way)."""
    rng = np.random.default_rng([6, seed])

    def moved(shape: Shape) -> Shape:
        match shape:
            case Circle(centre, radius):
                x, y = np.asarray(centre) + noise * rng.normal(size=2)
                return Circle((float(x), float(y)), radius)
            case Polygon():
                return Polygon(shape.vertices + noise * rng.normal(size=shape.vertices.shape))
            case _:
                start, end = np.array([shape.start, shape.end]) + noise * rng.normal(size=(2, 2))
                return replace(shape, start=tuple(start.tolist()), end=tuple(end.tolist()))

    return replace(
        sketch, components=tuple(replace(part, shape=moved(part.shape)) for part in sketch.components)
    )


def redrawn(sketch: Sketch, seed: int) -> Sketch:
    """The same page with its shapes drawn in another order, polygons from another corner and the other way
    round, and links from their other ends."""
    rng = np.random.default_rng([7, seed])

    def other(part: Component) -> Component:
        if isinstance(part.shape, Polygon):
            vertices = np.roll(part.shape.vertices, int(rng.integers(9)), axis=0)
            return replace(part, shape=Polygon(vertices[::-1] if rng.random() < 0.5 else vertices))
        if not isinstance(part.shape, Circle) and rng.random() < 0.5:
            turned = replace(part.shape, start=part.shape.end, end=part.shape.start)
            return replace(part, shape=turned, ends=part.ends[::-1])
        return part

    order = rng.permutation(len(sketch.components))
    return replace(sketch, components=tuple(other(sketch.components[k]) for k in order))


def places(shape: Shape) -> list[Point]:
    """Vertices, centre or ends, in an order that does not depend on how the shape was drawn."""
    match shape:
        case Circle(centre, _):
            return [centre]
        case Polygon():
            return sorted(
                ((x, y) for x, y in shape.vertices.tolist()), key=lambda point: (round(point[0], 3), *point)
            )
        case _:
            return sorted([shape.start, shape.end])


def difference(one: Shape, other: Shape) -> float:
    """The farthest that a vertex, centre or end of one is from the nearest of the other, page units."""
    return max(min(hypot(x - u, y - v) for u, v in ends(other)) for x, y in ends(one))


def ends(shape: Shape) -> list[Point]:
    match shape:
        case Circle(centre, _):
            return [centre]
        case Polygon():
            return [(x, y) for x, y in shape.vertices.tolist()]
        case _:
            return [shape.start, shape.end]


ANGLES = ("theta", "alpha", "beta")


def angles_off(sketch: Sketch) -> dict[str, float]:
    """For every component that an angle is said of, by how much it fails, radians; measured anew here. A page's
    angles are said at the foot of a triangle, and of links from the end that the anchor is nearer to. The newest counts."""
    found: dict[str, float] = {}
    for association in sketch.associations:
        name, _, value = (sketch.expressions[association.expression].text or "").partition(" = ")
        shape = sketch.component(association.component).shape
        if not name.startswith(ANGLES) or isinstance(shape, Circle):
            continue
        wanted = float(sketch.expressions[association.expression].tree.rhs) if value else 0.0
        if isinstance(shape, Polygon):
            if len(shape.vertices) == 3:
                found[association.component] = abs(_foot_angle(shape) - wanted)
            continue
        (x1, y1), (x2, y2) = ends(shape)
        level, rise = abs(x2 - x1), abs(y2 - y1)
        top, bottom = sorted(ends(shape), key=lambda end: end[1])
        from_top = hypot(*np.subtract(association.anchor, top)) < hypot(
            *np.subtract(association.anchor, bottom)
        )
        found[association.component] = abs((atan2(level, rise) if from_top else atan2(rise, level)) - wanted)
    return found


def _foot_angle(triangle: Polygon) -> float:
    """The angle at the vertex of a right-angled triangle that lies on its level side and not above another."""
    vertices = triangle.vertices
    angles = []
    for k in range(3):
        one, other = vertices[k - 1] - vertices[k], vertices[(k + 1) % 3] - vertices[k]
        angles.append(abs(atan2(one[0] * other[1] - one[1] * other[0], one @ other)))
    corner = int(np.argmin(np.abs(np.array(angles) - pi / 2)))
    steep = [abs(vertices[k][1] - vertices[corner][1]) for k in range(3)]
    return angles[min((k for k in range(3) if k != corner), key=lambda k: steep[k])]
