"""Box2D 2.3 (the `Box2D` package): sequential impulses with position correction, single precision.

Its manual's practice: 8 velocity and 3 position iterations, warm starting and continuous collision on,
sleeping off; wires are rigid distance joints, pins revolute joints, springs soft distance joints given by
their frequency. Polygons carry a skin of 1 cm (`b2_polygonRadius`) outside of what is drawn: they are
drawn smaller by that much here, so that surfaces meet where the scene says.
"""

from __future__ import annotations

from math import hypot
from typing import Any

from peers.world import Setting, Triple, World, load, movable, place, spring_hertz
from physics.scene import Anchor, Body, Disc, Scene, Vector

VELOCITY_ITERATIONS, POSITION_ITERATIONS = 8, 3


class Box2DWorld:
    """A scene in Box2D 2.3."""

    def __init__(self, scene: Scene, setting: Setting) -> None:
        library = load("Box2D")
        world: Any = library.b2World(gravity=scene.gravity, doSleep=False)
        world.continuousPhysics = world.warmStarting = True
        made: dict[str, Any] = {body.label: _body(library, world, body) for body in scene.bodies}
        ground: Any = world.CreateStaticBody() if scene.springs or scene.wires or scene.pins else None

        def end(anchor: Anchor) -> Any:
            return ground if anchor.body is None else made[anchor.body]

        self._wires: dict[str, Any] = {
            wire.label: world.CreateDistanceJoint(
                bodyA=end(wire.start), bodyB=end(wire.end), localAnchorA=wire.start.point,
                localAnchorB=wire.end.point, length=wire.rest, collideConnected=True,
            )
            for wire in scene.wires
        }  # fmt: skip
        for pin in scene.pins:
            world.CreateRevoluteJoint(
                bodyA=end(pin.start), bodyB=end(pin.end), localAnchorA=pin.start.point,
                localAnchorB=pin.end.point, collideConnected=False,
            )  # fmt: skip
        for spring in scene.springs:
            world.CreateDistanceJoint(
                bodyA=end(spring.start), bodyB=end(spring.end), anchorA=place(scene, spring.start),
                anchorB=place(scene, spring.end), length=spring.rest,
                frequencyHz=spring_hertz(scene, spring), dampingRatio=0.0, collideConnected=True,
            )  # fmt: skip
        self._world, self._hertz = world, setting.hertz
        self._bodies = [made[body.label] for body in movable(scene)]

    def advance(self, steps: int) -> None:
        take, step = self._world.Step, 1 / self._hertz
        for _ in range(steps):
            take(step, VELOCITY_ITERATIONS, POSITION_ITERATIONS)

    def places(self) -> list[Triple]:
        rows: list[Triple] = []
        for body in self._bodies:
            at = body.position  # the package copies it: once, not once for x and once for y
            rows.append((at.x, at.y, body.angle))
        return rows

    def speeds(self) -> list[Triple]:
        return [(*body.linearVelocity, body.angularVelocity) for body in self._bodies]

    def tensions(self) -> dict[str, float]:
        return {label: hypot(*joint.GetReactionForce(self._hertz)) for label, joint in self._wires.items()}


def build(scene: Scene, setting: Setting) -> World:
    """The scene in Box2D 2.3."""
    return Box2DWorld(scene, setting)


def _body(library: Any, world: Any, body: Body) -> Any:
    if isinstance(body.shape, Disc):
        shape = library.b2CircleShape(radius=body.shape.radius)
    else:
        shape = library.b2PolygonShape(vertices=inset(body.shape.vertices, library.b2_polygonRadius))
    fixture = library.b2FixtureDef(
        shape=shape,
        density=1.0,
        friction=body.material.friction or 0.0,
        restitution=body.material.restitution or 0.0,
    )
    create = world.CreateStaticBody if body.fixed else world.CreateDynamicBody
    made = create(position=body.position, angle=body.angle, fixtures=fixture)
    if not body.fixed:
        made.massData = library.b2MassData(mass=body.mass, center=(0, 0), I=body.inertia)
        made.linearVelocity, made.angularVelocity = body.velocity[:2], body.velocity[2]
    return made


def inset(vertices: tuple[Vector, ...], by: float) -> list[Vector]:
    """A convex polygon's edges moved inwards (anti-clockwise: to the left) by a length, and where they
    meet then."""
    moved: list[Vector] = []
    for (x0, y0), (x1, y1), (x2, y2) in zip(
        (vertices[-1], *vertices[:-1]), vertices, (*vertices[1:], vertices[0]), strict=True
    ):
        a, b = hypot(x1 - x0, y1 - y0), hypot(x2 - x1, y2 - y1)
        (ux, uy), (vx, vy) = ((x1 - x0) / a, (y1 - y0) / a), ((x2 - x1) / b, (y2 - y1) / b)
        along = by / (ux * vy - uy * vx)  # both edges move by `by`: the corner slides along both of them
        moved.append((x1 + along * (vx - ux), y1 + along * (vy - uy)))
    return moved
