"""A run: a page corrected, built and simulated piece by piece, as numbers that a browser plays.

Every frame is a row of Float32: the time (s); for each body that moves x, y of its centre of mass (page units, y
down) and its angle (rad, clockwise to the eye); for each link x, y of its two ends, NaN once it is broken. What is observed is sent as
columns of its own. Frame of observables: SI, y up.
"""

from __future__ import annotations

import json
import struct
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evaluation.words import happened
from physics.build import Built, build
from physics.engine import Simulation
from physics.formula.meaning import PER_METRE
from physics.observables import Series, observe, quantities
from physics.outcome import outcome
from physics.pipeline import Motion
from physics.rectify import Rectified, rectify
from physics.trajectory import Trajectory
from sketch.geometry import centroid
from sketch.ink import FloatArray
from sketch.shapes import Circle, Polygon, Spring, Wire
from studio.board import Board
from studio.limits import LIMITS

RATE = 60.0
"""Frames a second."""
PIECE = 1.0
"""Seconds of motion that are sent at once."""


@dataclass(frozen=True, slots=True)
class Scene:
    """A page that is about to move."""

    corrected: Rectified
    built: Built


def scene_of(board: Board) -> Scene:
    """The board corrected and built."""
    corrected = rectify(board.sketch, board.without)
    return Scene(corrected, build(corrected.sketch, corrected.meanings))


def head(scene: Scene, run: int, seconds: float) -> dict[str, Any]:
    """What the columns of a run mean, and what its bodies look like about their centres."""
    movable = {body.label: body for body in scene.built.scene.bodies if not body.fixed}
    bodies: list[dict[str, Any]] = []
    for part in scene.corrected.sketch.components:
        if part.label not in movable:
            continue
        match part.shape:
            case Circle(_, radius):
                outline: dict[str, Any] = {"radius": radius}
            case Polygon():
                outline = {"vertices": (part.shape.vertices - centroid(part.shape.vertices)).tolist()}
            case _:
                continue
        bodies.append({"label": part.label, "kind": part.kind, "mass": movable[part.label].mass, **outline})
    links = [
        part.label for part in scene.corrected.sketch.components if isinstance(part.shape, Spring | Wire)
    ]
    return {
        "type": "run", "run": run, "seconds": seconds, "rate": RATE, "bodies": bodies, "links": links,
        "perMetre": PER_METRE, "notices": list(scene.built.notices),
    }  # fmt: skip


@dataclass(frozen=True, slots=True)
class Piece:
    """frames: (n, columns) Float32; events: those of this piece."""

    frames: NDArray[np.float32]
    events: tuple[dict[str, Any], ...]


def pieces(scene: Scene, seconds: float, stopped: Callable[[], bool]) -> Iterator[Piece | Trajectory]:
    """The run a second at a time, the whole trajectory last. Ends early where it takes longer than `LIMITS.patience`,
    where a formula has no value any more, and where nobody watches (stopped)."""
    began, told = time.monotonic(), 0
    simulation = Simulation(scene.built.scene)
    sent = 0
    until = 0.0
    while until < seconds and not stopped():
        until = min(until + PIECE, seconds)
        simulation.run_to(until)
        so_far = simulation.trajectory(RATE, min(until, simulation.stopped))
        events = tuple(
            {"time": one.time, "kind": one.kind, "bodies": one.bodies, "message": one.message, "speed": one.speed}
            for one in so_far.events[told:]
        )  # fmt: skip
        told = len(so_far.events)
        last = until >= seconds or simulation.stopped < until or time.monotonic() - began > LIMITS.patience
        new = so_far.at(so_far.times[sent:]) if sent else so_far
        sent = len(so_far.times)
        yield Piece(rows(scene, new), events)
        if last:
            yield so_far
            return


def rows(scene: Scene, trajectory: Trajectory) -> NDArray[np.float32]:
    """The frames of a trajectory as `head` says."""
    columns: list[FloatArray] = [trajectory.times[:, None]]
    movable = {body.label for body in scene.built.scene.bodies if not body.fixed}
    sketch = scene.corrected.sketch
    for part in sketch.components:
        if part.label in movable and isinstance(part.shape, Circle | Polygon):
            poses = trajectory.poses[:, trajectory.column(part.label)]
            columns.append(poses * [PER_METRE, -PER_METRE, -1.0])
    anchors = trajectory.anchors if any(isinstance(p.shape, Spring | Wire) for p in sketch.components) else {}
    for part in sketch.components:
        if isinstance(part.shape, Spring | Wire):
            ends = anchors.get(part.label)
            drawn = np.array([*part.shape.start, *part.shape.end])
            if ends is None:
                columns.append(np.tile(drawn, (len(trajectory.times), 1)))
            else:
                columns.append((ends * [PER_METRE, -PER_METRE]).reshape(-1, 4))
    return np.hstack(columns).astype(np.float32)


def motion_of(scene: Scene, trajectory: Trajectory) -> Motion:
    """The run as the rest of the house knows it."""
    corrected = scene.corrected
    return Motion(
        corrected.sketch, corrected.corrections, scene.built.scene, trajectory, scene.built.notices, corrected.displacement,
    )  # fmt: skip


def told(motion: Motion) -> list[str]:
    """What happened, in words."""
    return happened(motion, outcome(motion))


def observable(motion: Motion) -> dict[str, list[str]]:
    """What can be observed of each body that moves."""
    return {
        body.label: list(quantities(motion.trajectory, body.label))
        for body in motion.scene.bodies
        if not body.fixed
    }


def observed(motion: Motion, body: str, quantity: str) -> Series:
    """A quantity through the whole run. Raises ObservableError for what a body has not."""
    return observe(motion.scene, motion.trajectory, body, quantity)


def packed(told: dict[str, Any], numbers: NDArray[np.float32]) -> bytes:
    """One binary message: the length of a JSON text (4 bytes, little-endian), the text padded with spaces to whole
    fours, and Float32 numbers row by row."""
    text = json.dumps(told).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<I", len(text)) + text + numbers.astype("<f4").tobytes()
