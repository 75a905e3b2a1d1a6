"""pymunk 7 (Chipmunk 2D): sequential impulses, double precision, symplectic Euler.

Its manual's practice, in metres: wires are pin joints, pins are pivot joints, springs are damped
springs; `collision_slop`, made for pixels, comes down to a millimetre; sleeping and damping stay off.
Elasticities and frictions of a pair are multiplied, so each body gets the root of its own.
"""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np

from peers.world import Rows, Setting, Triple, World, load, movable
from physics.scene import Anchor, Body, Disc, Scene

ITERATIONS = 10
"""The manual's "sufficient for most": smaller steps buy more accuracy for the same time."""

SLOP = 0.001
"""Overlap that contacts keep so that they stay in touch, m."""

FEW = 2
"""Up to so many bodies are read off one by one, more by the package's batch."""


class ChipmunkWorld:
    """A scene in pymunk."""

    def __init__(self, scene: Scene, setting: Setting) -> None:
        pymunk = load("pymunk")
        space: Any = pymunk.Space()
        space.gravity, space.iterations, space.collision_slop = scene.gravity, ITERATIONS, SLOP
        made: dict[str, Any] = {body.label: _body(pymunk, space, body) for body in scene.bodies}

        def end(anchor: Anchor) -> Any:
            return space.static_body if anchor.body is None else made[anchor.body]

        self._wires: dict[str, Any] = {}
        for wire in scene.wires:
            joint = pymunk.PinJoint(end(wire.start), end(wire.end), wire.start.point, wire.end.point)
            joint.distance = wire.rest
            self._wires[wire.label] = joint
        pins: list[Any] = []
        for pin in scene.pins:
            joint = pymunk.PivotJoint(end(pin.start), end(pin.end), pin.start.point, pin.end.point)
            joint.collide_bodies = False
            pins.append(joint)
        springs: list[Any] = [
            pymunk.DampedSpring(
                end(spring.start), end(spring.end), spring.start.point, spring.end.point, spring.rest,
                spring.stiffness, spring.damping,
            )
            for spring in scene.springs
        ]  # fmt: skip
        joints: list[Any] = [*self._wires.values(), *pins, *springs]
        if joints:
            space.add(*joints)
        self._space, self._step = space, 1 / setting.hertz
        self._bodies = [made[body.label] for body in movable(scene)]
        self._batch: Any = load("pymunk.batch")
        self._fields = self._batch.BodyFields.POSITION | self._batch.BodyFields.ANGLE
        self._buffer: Any = self._batch.Buffer()

    def advance(self, steps: int) -> None:
        take, step = self._space.step, self._step
        for _ in range(steps):
            take(step)

    def places(self) -> Rows:
        if len(self._bodies) <= FEW:
            return [(*body.position, body.angle) for body in self._bodies]
        self._buffer.clear()
        self._batch.get_space_bodies(self._space, self._fields, self._buffer)
        rows = np.frombuffer(self._buffer.float_buf()).reshape(-1, 3)
        return rows[: len(self._bodies)].copy()  # movable bodies come first, in the order they were added

    def speeds(self) -> list[Triple]:
        return [(*body.velocity, body.angular_velocity) for body in self._bodies]

    def tensions(self) -> dict[str, float]:
        return {label: joint.impulse / self._step for label, joint in self._wires.items()}


def build(scene: Scene, setting: Setting) -> World:
    """The scene in pymunk."""
    return ChipmunkWorld(scene, setting)


def _body(pymunk: Any, space: Any, body: Body) -> Any:
    made = pymunk.Body(body_type=pymunk.Body.STATIC) if body.fixed else pymunk.Body(body.mass, body.inertia)
    made.position, made.angle = body.position, body.angle
    if not body.fixed:
        made.velocity, made.angular_velocity = body.velocity[:2], body.velocity[2]
    if isinstance(body.shape, Disc):
        shape = pymunk.Circle(made, body.shape.radius)
    else:
        shape = pymunk.Poly(made, body.shape.vertices)
    shape.elasticity = sqrt(body.material.restitution or 0.0)
    shape.friction = sqrt(body.material.friction or 0.0)
    space.add(made, shape)
    return made
