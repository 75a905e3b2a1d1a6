"""Random scenes: floors, slopes, discs, blocks, springs, wires, pins, materials. SI units, y up.

Scene `index` of a seed depends on the two alone. Every scene is sound: it has area, mass and places for
everything, wires are long enough, pins hold points that coincide; one in twenty begins with bodies that
overlap (and then has no wires and pins, which might forbid to part them).
"""

from __future__ import annotations

from math import cos, hypot, pi, sin, tau

import numpy as np

from physics.scene import (
    Anchor,
    Block,
    Body,
    Disc,
    Material,
    Pin,
    Scene,
    Shape,
    SpringLink,
    Vector,
    WireLink,
    area_of,
    block_inertia,
    disc_inertia,
)

G = 9.81
OVERLAPPING = 0.05
"""Share of scenes that begin with an overlap."""

PILE = 0.05
"""Share of scenes with many bodies."""

TRIES = 200
"""Places tried for a body before it is left out."""


def scene_at(seed: int, index: int) -> Scene:
    """The scene of this index."""
    rng = np.random.default_rng([seed, index])
    grounds = _grounds(rng)
    overlapping = rng.random() < OVERLAPPING
    count = int(rng.integers(8, 21)) if rng.random() < PILE else int(rng.integers(1, 7))
    bodies = _bodies(rng, count, grounds, overlapping)
    springs: list[SpringLink] = []
    wires: list[WireLink] = []
    pins: list[Pin] = []
    for k in range(int(rng.integers(0, 4))):
        kind = str(rng.choice(["spring"] if overlapping else ["spring", "wire", "pin"]))
        start, other = _ends(rng, bodies)
        match kind:
            case "spring":
                springs.append(_spring(rng, f"spring {k}", start, other))
            case "wire":
                wires.append(_wire(rng, f"wire {k}", start, other))
            case _:
                pins.append(_pin(rng, f"pin {k}", start, other))
    gravity = (0.0, 0.0) if rng.random() < 0.1 else (0.0, -G)
    return Scene((*grounds, *bodies), tuple(springs), tuple(wires), gravity=gravity, pins=tuple(pins))


def radius_of(shape: Shape) -> float:
    """Of the circle about the centre of mass that holds the shape, m."""
    if isinstance(shape, Disc):
        return shape.radius
    return max(hypot(x, y) for x, y in shape.vertices)


def world_point(body: Body, point: Vector) -> Vector:
    """A point of the body's own frame in the world."""
    (x, y), c, s = point, cos(body.angle), sin(body.angle)
    return body.position[0] + c * x - s * y, body.position[1] + s * x + c * y


def own_point(body: Body, point: Vector) -> Vector:
    """A point of the world in the body's own frame."""
    x, y = point[0] - body.position[0], point[1] - body.position[1]
    c, s = cos(body.angle), sin(body.angle)
    return c * x + s * y, c * y - s * x


def _material(rng: np.random.Generator) -> Material:
    restitution = [None, 0.0, 1.0, float(rng.random())][int(rng.integers(4))]
    friction = [None, 0.0, float(rng.random()), float(rng.random())][int(rng.integers(4))]
    return Material(restitution, friction)


def _grounds(rng: np.random.Generator) -> list[Body]:
    """A floor (its upper side is y = 0) in most scenes, and in some a slope on it."""
    made: list[Body] = []
    if rng.random() < 0.85:
        made.append(
            _fixed("floor", (0.0, -0.5), ((-20, -0.5), (20, -0.5), (20, 0.5), (-20, 0.5)), _material(rng))
        )
    if rng.random() < 0.3:
        width, height = rng.uniform(2.0, 5.0), rng.uniform(0.5, 2.5)
        corners = ((-width / 3, -height / 3), (2 * width / 3, -height / 3), (-width / 3, 2 * height / 3))
        at = (float(rng.uniform(-4, 0)), height / 3)
        made.append(_fixed("slope", at, corners, _material(rng)))
    return made


def _fixed(label: str, at: Vector, corners: tuple[Vector, ...], material: Material) -> Body:
    return Body(label, Block(corners), at, 1.0, 1.0, fixed=True, material=material)


def _bodies(rng: np.random.Generator, count: int, grounds: list[Body], overlapping: bool) -> list[Body]:
    made: list[Body] = []
    for k in range(count):
        shape = _shape(rng)
        reach = radius_of(shape)
        for _ in range(TRIES):
            at = (float(rng.uniform(-4, 4)), float(rng.uniform(0, 5)))
            if overlapping or _free(at, reach, made, grounds):
                made.append(_body(rng, f"body {k}", shape, at))
                break
    return made


def _free(at: Vector, reach: float, bodies: list[Body], grounds: list[Body]) -> bool:
    apart = (
        hypot(at[0] - body.position[0], at[1] - body.position[1]) > reach + radius_of(body.shape)
        for body in bodies
    )
    return all(apart) and all(_above(ground, at) > reach for ground in grounds)


def _above(ground: Body, at: Vector) -> float:
    """How far a point is outside of a block, by its edges: at least so far, m."""
    assert isinstance(ground.shape, Block)
    corners = [world_point(ground, vertex) for vertex in ground.shape.vertices]
    heights: list[float] = []
    for (x1, y1), (x2, y2) in zip(corners, (*corners[1:], corners[0]), strict=True):
        heights.append(((y2 - y1) * (at[0] - x1) - (x2 - x1) * (at[1] - y1)) / hypot(x2 - x1, y2 - y1))
    return max(heights)


def _shape(rng: np.random.Generator) -> Shape:
    match int(rng.integers(3)):
        case 0:
            return Disc(float(rng.uniform(0.1, 0.4)))
        case 1:
            w, h = float(rng.uniform(0.1, 0.4)), float(rng.uniform(0.1, 0.4))
            return Block(((-w, -h), (w, -h), (w, h), (-w, h)))
        case _:
            return _polygon(rng)


def _polygon(rng: np.random.Generator) -> Block:
    """Three to six corners on a circle, no two of them close together; about its own centre of mass."""
    corners, radius = int(rng.integers(3, 7)), float(rng.uniform(0.15, 0.4))
    turns = (np.arange(corners) + rng.uniform(-0.3, 0.3, corners)) * tau / corners
    points = [(radius * cos(turn), radius * sin(turn)) for turn in turns.tolist()]
    area = cx = cy = 0.0
    for (x1, y1), (x2, y2) in zip(points, (*points[1:], points[0]), strict=True):
        cross = x1 * y2 - x2 * y1
        area, cx, cy = area + cross / 2, cx + (x1 + x2) * cross / 6, cy + (y1 + y2) * cross / 6
    return Block(tuple((x - cx / area, y - cy / area) for x, y in points))


def _body(rng: np.random.Generator, label: str, shape: Shape, at: Vector) -> Body:
    density = 10 ** rng.uniform(-3, 3) if rng.random() < 0.05 else 10 ** rng.uniform(-0.5, 0.5)
    mass = float(density * area_of(shape))
    if isinstance(shape, Disc):
        inertia = disc_inertia(mass, shape.radius)
    else:
        inertia = block_inertia(mass, shape.vertices)
    velocity = (0.0, 0.0, 0.0)
    if rng.random() < 0.5:
        vx, vy, turning = rng.normal(0.0, 2.0, 3).tolist()
        velocity = (vx, vy, turning)
    upright = rng.random() < 0.4
    angle = 0.0 if upright else float(rng.uniform(-pi, pi))
    return Body(label, shape, at, mass, inertia, angle, False, velocity, _material(rng))


def _ends(rng: np.random.Generator, bodies: list[Body]) -> tuple[Body, Body | None]:
    """A body, and another or None for a point of the world."""
    first = int(rng.integers(len(bodies)))
    others = [body for k, body in enumerate(bodies) if k != first]
    if not others or rng.random() < 0.5:
        return bodies[first], None
    return bodies[first], others[int(rng.integers(len(others)))]


def _within(rng: np.random.Generator, body: Body) -> Vector:
    """A point of the body's own frame: its centre as often as not."""
    if rng.random() < 0.5:
        return 0.0, 0.0
    reach, turn = 0.5 * radius_of(body.shape) * float(rng.random()), float(rng.uniform(0, tau))
    return reach * cos(turn), reach * sin(turn)


def _anchors(rng: np.random.Generator, start: Body, other: Body | None) -> tuple[Anchor, Anchor, float]:
    """The two ends of a spring or wire, and how far they are apart, m: never nothing."""
    point = _within(rng, start)
    x, y = world_point(start, point)
    if other is None:
        end = Anchor(None, (x + float(rng.uniform(-1, 1)), y + float(rng.uniform(0.5, 2))))
        return Anchor(start.label, point), end, hypot(end.point[0] - x, end.point[1] - y)
    far = _within(rng, other)
    u, v = world_point(other, far)
    return Anchor(start.label, point), Anchor(other.label, far), max(hypot(u - x, v - y), 0.01)


def _spring(rng: np.random.Generator, label: str, start: Body, other: Body | None) -> SpringLink:
    near, far, apart = _anchors(rng, start, other)
    damping = float(rng.uniform(0, 2)) if rng.random() < 0.5 else 0.0
    return SpringLink(
        label, near, far, apart * float(rng.uniform(0.6, 1.3)), float(10 ** rng.uniform(1, 2.7)), damping
    )


def _wire(rng: np.random.Generator, label: str, start: Body, other: Body | None) -> WireLink:
    near, far, apart = _anchors(rng, start, other)
    slack = 1.0 if rng.random() < 0.5 else float(rng.uniform(1.0, 1.3))
    limit = float(10 ** rng.uniform(0, 2)) if rng.random() < 0.1 else None
    return WireLink(label, near, far, apart * slack, limit=limit)


def _pin(rng: np.random.Generator, label: str, start: Body, other: Body | None) -> Pin:
    """To the world, or halfway between two bodies, which it then holds like arms."""
    if other is None:
        point = _within(rng, start)
        return Pin(label, Anchor(start.label, point), Anchor(None, world_point(start, point)))
    middle = (
        (start.position[0] + other.position[0]) / 2,
        (start.position[1] + other.position[1]) / 2,
    )
    return Pin(
        label, Anchor(start.label, own_point(start, middle)), Anchor(other.label, own_point(other, middle))
    )
