"""What the benchmarks ask of an engine: a scene in, its motion read off at 60 Hz.

A peer is a game engine with a fixed step, adapted to `physics.scene.Scene`, so that every engine
is given the same bodies, masses, links and materials. SI units, y up, like the scene.
"""

from __future__ import annotations

import gc
import importlib
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import cos, hypot, isclose, pi, sin, sqrt
from time import process_time
from typing import Any, Protocol

import numpy as np

from physics.scene import Anchor, Body, Scene, SpringLink, Vector
from sketch.ink import FloatArray

RATE = 60
"""Frames a second that are read off, whatever the step."""

Triple = tuple[float, float, float]
Rows = Sequence[Triple] | FloatArray
"""A row of three for each movable body."""


class World(Protocol):
    """A peer's world. Rows stand for the scene's movable bodies, in the scene's order."""

    def advance(self, steps: int) -> None:
        """Take so many steps."""
        ...

    def places(self) -> Rows:
        """x, y (m), angle (rad) of the centres of mass."""
        ...

    def speeds(self) -> Rows:
        """The same per second."""
        ...

    def tensions(self) -> dict[str, float]:
        """The pull of each wire in the last step, N."""
        ...


@dataclass(frozen=True, slots=True)
class Setting:
    """How finely a run is computed. For a peer hertz, steps a second, and substeps, the parts of a step in
    engines that have them; for inklined accuracy, the tolerance of `simulate`."""

    hertz: int = RATE
    substeps: int = 4
    accuracy: float = 1e-10


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """cpu: seconds of the CPU; places, speeds: (F, B, 3), row 0 at time zero; tensions: (F,) N by label.

    Speeds and tensions are there when they were asked for; such a run's `cpu` counts reading them too.
    """

    cpu: float
    places: FloatArray
    speeds: FloatArray | None = None
    tensions: dict[str, FloatArray] | None = None


Build = Callable[[Scene, Setting], World]


def play(build: Build, scene: Scene, seconds: float, setting: Setting, observe: bool) -> Run:
    """One run of a peer; making its world is not timed, stepping and reading off are."""
    if setting.hertz % RATE:
        raise ValueError(f"{setting.hertz} steps a second are no multiple of the {RATE} frames read off")
    world, frames, steps = build(scene, setting), round(seconds * RATE), setting.hertz // RATE
    places, speeds, tensions = [world.places()], [world.speeds()], [world.tensions()]
    with uninterrupted():
        begun = process_time()
        for _ in range(frames):
            world.advance(steps)
            places.append(world.places())
            if observe:
                speeds.append(world.speeds())
                tensions.append(world.tensions())
        cpu = process_time() - begun
    if not observe:
        return Run(cpu, np.array(places))
    pulls = {label: np.array([row[label] for row in tensions]) for label in tensions[0]}
    return Run(cpu, np.array(places), np.array(speeds), pulls)


@contextmanager
def uninterrupted() -> Generator[None]:
    """No collection of garbage while time is taken."""
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def movable(scene: Scene) -> list[Body]:
    return [body for body in scene.bodies if not body.fixed]


def load(module: str) -> Any:
    """A peer's module; peers are an extra of their own. Raises SystemExit with what to install."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise SystemExit(
            f"{module} is not installed; pip install 'inklined[bench]' brings the peers"
        ) from error


def place(scene: Scene, anchor: Anchor) -> Vector:
    """Where an anchor is at the start, m, in the world."""
    x, y = anchor.point
    if anchor.body is None:
        return x, y
    body = scene.body(anchor.body)
    c, s = cos(body.angle), sin(body.angle)
    return body.position[0] + c * x - s * y, body.position[1] + s * x + c * y


def spring_hertz(scene: Scene, spring: SpringLink) -> float:
    """The frequency of a spring with the bodies at its ends, which is how the Box2Ds want its stiffness.

    Raises ValueError for a spring that is not attached to centres of mass: there the frequency depends
    on the pose.
    """
    ends = [scene.body(end.body) for end in (spring.start, spring.end) if end.body is not None]
    if any(not isclose(hypot(*end.point), 0.0) for end in (spring.start, spring.end) if end.body):
        raise ValueError(f"spring {spring.label!r} must be attached to centres of mass")
    return sqrt(spring.stiffness * sum(1 / body.mass for body in ends if not body.fixed)) / (2 * pi)
