"""Box2D 3.1 (the `pyb2d3` package): soft constraints solved in substeps, single precision.

Its manual's practice: substeps instead of iterations (4 by default), restitution threshold 0, sleeping
off, continuous collision on; wires are rigid distance joints, pins revolute joints, springs soft distance
joints given by their frequency. Contacts are springs of 30 Hz by default and never stiffer than a quarter of
the substep's rate: the tuning is raised to that limit here, for otherwise a pile sinks by 8 mm at any number
of steps. Joints are springs of 60 Hz; the engine can tune them, its Python package cannot.
"""

from __future__ import annotations

from math import hypot
from typing import Any

import numpy as np

from peers.world import Rows, Setting, Triple, World, load, movable, spring_hertz
from physics.scene import Anchor, Body, Disc, Scene

STIFFEST = 0.25
"""The engine's own limit on a constraint's frequency, of the substep's rate."""

CONTACT_HERTZ, DAMPING_RATIO, PUSH_VELOCITY = 30.0, 10.0, 3.0
"""The engine's defaults for contacts: Hz, none, m/s."""

FEW = 3
"""Up to so many bodies are read off one by one, more by the package's batch."""


class Box2D3World:
    """A scene in Box2D 3."""

    def __init__(self, scene: Scene, setting: Setting) -> None:
        library = load("pyb2d3")
        world: Any = library.World(gravity=scene.gravity, restitution_threshold=0.0)
        world.sleeping_enabled = False
        hertz = max(CONTACT_HERTZ, STIFFEST * setting.hertz * setting.substeps)
        world.set_contact_tuning(hertz, DAMPING_RATIO, PUSH_VELOCITY)
        made: dict[str, Any] = {body.label: _body(library, world, body) for body in scene.bodies}
        ground: Any = world.create_static_body()

        def end(anchor: Anchor) -> Any:
            return ground if anchor.body is None else made[anchor.body]

        self._wires: dict[str, Any] = {
            wire.label: world.create_distance_joint(
                end(wire.start), end(wire.end), local_anchor_a=wire.start.point,
                local_anchor_b=wire.end.point, length=wire.rest, collide_connected=True,
            )
            for wire in scene.wires
        }  # fmt: skip
        for pin in scene.pins:
            world.create_revolute_joint(
                end(pin.start), end(pin.end), local_anchor_a=pin.start.point,
                local_anchor_b=pin.end.point, collide_connected=False,
            )  # fmt: skip
        for spring in scene.springs:
            world.create_distance_joint(
                end(spring.start), end(spring.end), local_anchor_a=spring.start.point,
                local_anchor_b=spring.end.point, length=spring.rest, enable_spring=True,
                hertz=spring_hertz(scene, spring), damping_ratio=0.0, collide_connected=True,
            )  # fmt: skip
        self._world, self._step, self._substeps = world, 1 / setting.hertz, setting.substeps
        self._bodies = [made[body.label] for body in movable(scene)]
        self._batch: Any = library.Bodies()
        for body in self._bodies:
            self._batch.append(body.id)

    def advance(self, steps: int) -> None:
        take, step, substeps = self._world.step, self._step, self._substeps
        for _ in range(steps):
            take(step, substeps)

    def places(self) -> Rows:
        if len(self._bodies) <= FEW:
            return [(body.position.x, body.position.y, body.angle) for body in self._bodies]
        turned = self._batch.get_rotations()
        angles = np.arctan2(turned[:, 1], turned[:, 0])
        return np.column_stack((self._batch.get_positions(), angles))

    def speeds(self) -> list[Triple]:
        return [(*_xy(body.linear_velocity), body.angular_velocity) for body in self._bodies]

    def tensions(self) -> dict[str, float]:
        return {label: hypot(*_xy(joint.get_constraint_force())) for label, joint in self._wires.items()}


def build(scene: Scene, setting: Setting) -> World:
    """The scene in Box2D 3."""
    return Box2D3World(scene, setting)


def _xy(vector: Any) -> tuple[float, float]:
    return vector.x, vector.y


def _body(library: Any, world: Any, body: Body) -> Any:
    create = world.create_static_body if body.fixed else world.create_dynamic_body
    made = create(position=body.position, rotation=library.make_rot(body.angle))
    material = library.surface_material(
        friction=body.material.friction or 0.0, restitution=body.material.restitution or 0.0
    )
    kind = library.shape_def(density=1.0, material=material)
    if isinstance(body.shape, Disc):
        made.create_shape(kind, library.circle(radius=body.shape.radius))
    else:
        made.create_shape(kind, library.polygon(points=body.shape.vertices))
    if not body.fixed:
        mass = library.MassData()
        mass.mass, mass.center, mass.rotational_inertia = body.mass, (0.0, 0.0), body.inertia
        made.mass_data = mass
        made.linear_velocity, made.angular_velocity = body.velocity[:2], body.velocity[2]
    return made
