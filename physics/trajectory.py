"""What moved, how, and why: the one result of every engine.

Frame: SI units, x to the right, y *up*, angles anti-clockwise in radians. Row k of every array
belongs to `times[k]`; column b to body `bodies[b]`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from hashlib import sha256
from typing import Literal, Protocol

import numpy as np

from sketch.ink import FloatArray

EventKind = Literal[
    "impact",  # two bodies meet
    "bounce",  # struck back by a given normal force that is too small
    "break",  # a wire breaks
    "slack",  # a wire goes slack
    "taut",  # a wire is taut again
    "lift-off",  # a given normal force that is too great lifts its body off
    "rest",  # a body comes to rest
    "released",  # a body leaves the course that its equation gave it, for it has collided
    "separated",  # bodies that overlapped at the start were moved apart
    "not unique",  # forces that the laws of motion leave open: the smallest are given
    "robust",  # from here on many contacts are solved together, step by step
    "stopped",  # a formula has no value: the run ends
]

Mode = Literal["exact", "robust"]
"""exact: events located, accelerations solved; robust: small steps, soft contacts."""


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened at one time (seconds): what, to whom (labels), in words; speed: how fast the
    bodies of an impact closed, m/s."""

    time: float
    kind: EventKind
    bodies: tuple[str, ...]
    message: str
    speed: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ForceSeries:
    """One force on one body through time.

    name: "weight", "contact with B" (its normal part), "friction of B", "T of C", "spring C", "pin C", or
    as the student named it; values: (T, 2) newtons; points: (T, 2) metres, where it acts; unique: whether
    the laws of motion settle it at all times (a table on three legs leaves them open; the smallest
    forces are given).
    """

    name: str
    body: str
    values: FloatArray
    points: FloatArray
    unique: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Energy:
    """The ledger, (T,) joules each: kinetic + potential + elastic + dissipated + corrected − worked is constant
    where the engine is right. dissipated: heat of friction, damping and impacts; corrected: what the small steps of
    robust mode took (negative: gave) by being no shorter, zero in exact mode; worked: by the student's forces;
    works: the same for each of them, by (name, body)."""

    kinetic: FloatArray
    potential: FloatArray
    elastic: FloatArray
    dissipated: FloatArray
    corrected: FloatArray
    worked: FloatArray
    works: Mapping[tuple[str, str], FloatArray] = field(default_factory=dict[tuple[str, str], FloatArray])


@dataclass(frozen=True, slots=True, eq=False)
class Observed:
    """What follows from the motion at some times: see `Trajectory`."""

    accelerations: FloatArray
    forces: tuple[ForceSeries, ...]
    energy: Energy
    anchors: dict[str, FloatArray]


class Source(Protocol):
    """What an engine keeps of a run: the motion at any time of it, not on a grid alone."""

    def states(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Poses and velocities, (T, B, 3) each, at ascending times (s)."""
        ...

    def observe(self, times: FloatArray) -> Observed:
        """Accelerations, forces, energies and ends of links at ascending times (s)."""
        ...


@dataclass(frozen=True, eq=False)
class Trajectory:
    """times: (T,) s; bodies: labels; poses: (T, B, 3) x, y (m), angle (rad) of the centre of mass;
    velocities: (T, B, 3) the same per s; modes: how each movable body was simulated at the end;
    source: the same motion at any time.

    Accelerations, forces, energies and ends of links are worked out when they are first asked for.
    """

    times: FloatArray
    bodies: tuple[str, ...]
    poses: FloatArray
    velocities: FloatArray
    events: tuple[Event, ...]
    modes: Mapping[str, Mode]
    source: Source

    @property
    def accelerations(self) -> FloatArray:
        """(T, B, 3), m/s² and rad/s²; at an event, those after it."""
        return self._observed.accelerations

    @property
    def forces(self) -> tuple[ForceSeries, ...]:
        """Every force on every body, by name."""
        return self._observed.forces

    @property
    def energy(self) -> Energy:
        """The ledger of the whole scene."""
        return self._observed.energy

    @property
    def anchors(self) -> dict[str, FloatArray]:
        """For each link its two end points through time, (T, 2, 2) m, NaN once it is broken."""
        return self._observed.anchors

    @cached_property
    def _observed(self) -> Observed:
        return self.source.observe(self.times)

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

    def force(self, name: str, body: str) -> ForceSeries:
        """The force of that name on that body. Raises KeyError when there is none."""
        for one in self.forces:
            if (one.name, one.body) == (name, body):
                return one
        raise KeyError((name, body))

    def at(self, times: FloatArray) -> Trajectory:
        """The same motion at other times (ascending, s, within the run), by dense output."""
        poses, velocities = self.source.states(times)
        return replace(self, times=times, poses=poses, velocities=velocities)

    def until(self, seconds: float) -> Trajectory:
        """The frames up to and including `seconds`, and the events up to then."""
        n = int(np.searchsorted(self.times, seconds + 1e-9, side="right"))
        if n >= len(self.times):
            return self
        events = tuple(event for event in self.events if event.time <= seconds)
        return replace(
            self, times=self.times[:n], poses=self.poses[:n], velocities=self.velocities[:n], events=events
        )

    def digest(self) -> str:
        """A hash of every bit of times, poses and velocities: equal for the same motion."""
        hashed = sha256()
        for array in (self.times, self.poses, self.velocities):
            hashed.update(np.ascontiguousarray(array).tobytes())
        return hashed.hexdigest()
