"""What moved, how, and why: the one result of every engine.

Frame: SI units, x to the right, y *up*, angles anti-clockwise in radians. Row k of every array
belongs to `times[k]`; column b to body `bodies[b]`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from sketch.ink import FloatArray

EventKind = Literal["impact", "bounce", "break", "slack", "taut", "lift-off", "rest", "stopped"]


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened at one time (seconds): what, to whom (labels), in words."""

    time: float
    kind: EventKind
    bodies: tuple[str, ...]
    message: str


@dataclass(frozen=True, slots=True, eq=False)
class ForceSeries:
    """One force on one body through time.

    name: "weight", "contact with B", "T of C", or as the student named it; values: (T, 2) newtons;
    points: (T, 2) metres, where it acts.
    """

    name: str
    body: str
    values: FloatArray
    points: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Energy:
    """The ledger, (T,) joules each: kinetic + potential + elastic + dissipated − work of the student's
    forces is constant where the engine is right."""

    kinetic: FloatArray
    potential: FloatArray
    elastic: FloatArray
    dissipated: FloatArray
    worked: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """times: (T,) s; bodies: labels; poses: (T, B, 3) x, y (m), angle (rad) of the centre of mass;
    velocities, accelerations: (T, B, 3) the same per s and per s²; anchors: for each link its two
    end points through time, (T, 2, 2) m, NaN once it is broken."""

    times: FloatArray
    bodies: tuple[str, ...]
    poses: FloatArray
    velocities: FloatArray
    accelerations: FloatArray
    forces: tuple[ForceSeries, ...]
    events: tuple[Event, ...]
    energy: Energy
    anchors: dict[str, FloatArray] = field(default_factory=dict[str, FloatArray])

    def column(self, label: str) -> int:
        """The column of the body with this label. Raises KeyError when it has none."""
        try:
            return self.bodies.index(label)
        except ValueError:
            raise KeyError(label) from None

    def path(self, label: str) -> FloatArray:
        """Centre of mass through time, (T, 2) m."""
        return self.poses[:, self.column(label), :2]

    def speed(self, label: str) -> FloatArray:
        """‖v‖ through time, (T,) m/s."""
        return np.linalg.norm(self.velocities[:, self.column(label), :2], axis=1)
