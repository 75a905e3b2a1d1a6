"""A scene through time: clusters of bodies that have to do with each other, each on its own.

    run = Simulation(scene); run.run_to(10.0); trajectory = run.trajectory(60.0)

Bodies that nothing joins are simulated apart, so that they never influence each other, not even in the
last bit. When two of them meet, their clusters are one from that moment on. A cluster is simulated
exactly (physics.engine.exact) until it has more contacts than that is made for; then small steps with
soft contacts take over (physics.engine.robust), which an event tells.

Neither the steps nor the search for meetings depend on how far the run was asked to go: a run that was
stopped and goes on equals one that was not.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from math import floor, inf, isfinite

import numpy as np

from physics.engine.exact.parting import separate
from physics.engine.exact.run import ExactRun
from physics.engine.exact.standing import TooMuch
from physics.engine.exact.tell import Teller
from physics.engine.exact.touch import TOUCHING, near_pairs
from physics.engine.meetings import Meeting, first_meeting
from physics.engine.robust.run import RobustRun
from physics.engine.source import SceneSource
from physics.engine.world import Names, World, copied, start_of, world_of
from physics.scene import Scene, SceneError
from physics.trajectory import Event, Mode, Trajectory
from sketch.ink import FloatArray

ACCURACY = 1e-11
"""m and m/s a step (relative above 1): a pendulum is then right to 1e-9 after ten seconds."""
EPOCH = 0.25
"""s: clusters go on for so long before it is looked whether any have met."""
STIFFEST = 20_000.0
"""1/s: a spring that swings faster would cost more than a minute's work a second."""


@dataclass(slots=True)
class Strand:
    """A cluster from when it formed until it was merged into another: members (labels), its runs one after
    another (exact, then robust), and the time it ends."""

    members: tuple[str, ...]
    runs: list[ExactRun | RobustRun]
    end: float = inf
    notes: list[Event] = field(default_factory=list[Event])

    @property
    def run(self) -> ExactRun | RobustRun:
        """The run that is on its way."""
        return self.runs[-1]

    @property
    def mode(self) -> Mode:
        """How it is simulated."""
        return "exact" if isinstance(self.run, ExactRun) else "robust"


class Simulation:
    """A scene on its way. Mutable; can be pickled at any time, and goes on as if it had not been."""

    def __init__(self, scene: Scene, mode: Mode | None = None, accuracy: float = ACCURACY) -> None:
        """mode: None chooses for each cluster. Raises SceneError for an accuracy that is none, and for springs too
        stiff for their load."""
        if not 0 < accuracy < 1:
            raise SceneError(f"an accuracy of {accuracy:g} is none; it must lie between 0 and 1")
        self.scene, self.mode, self.accuracy = scene, mode, float(accuracy)
        self.time = 0.0
        self.strands: list[Strand] = []
        self.known: dict[frozenset[str], tuple[World, Names]] = {}
        labels = tuple(body.label for body in scene.bodies if not body.fixed)
        if labels:
            world, names = self._tables(labels)
            if scene.springs:
                _refuse_too_stiff(world)
            groups = _clusters(scene, labels, world, names)
            for group in groups:
                made = self._fresh(group)
                pos, vel = start_of(scene, made[1])
                notes: list[Event] = []
                if mode == "robust":
                    # Exact mode does so itself. A crowd too thick for it is let out step by step.
                    with suppress(TooMuch):
                        separate(made[0], pos, vel, Teller(made[1], notes), 0.0)
                self.strands.append(Strand(group, [self._begun(*made, pos, vel, 0.0)], notes=notes))

    def run_to(self, seconds: float) -> None:
        """Goes on until everything has been simulated up to `seconds`, or a formula has no value."""
        if not isfinite(seconds):
            raise SceneError(f"cannot move for {seconds:g} s; it must be a number")
        seconds = float(seconds)  # of whole numbers numba would compile everything anew
        while self.time < seconds and self.stopped == inf:
            live = self._live()
            # One cluster alone meets nobody: it may go on to the end.
            until = seconds if len(live) < 2 else EPOCH * (floor(self.time / EPOCH + 1e-9) + 1)
            for strand in live:
                self._advance(strand, until)
            if len(live) > 1:
                self._merge_all(until)
            self.time = until
        self._start_all()

    @property
    def stopped(self) -> float:
        """When a formula first had no value, s; infinite if none ever has."""
        return min((s.run.time for s in self._live() if s.run.stopped), default=inf)

    def trajectory(self, rate: float = 60.0, seconds: float | None = None) -> Trajectory:
        """The motion so far (or up to `seconds`), on a grid of so many frames a second."""
        until = self.time if seconds is None else seconds
        if not (isfinite(rate) and rate > 0):
            raise SceneError(f"cannot show {rate:g} frames a second; it must be a positive number")
        times = np.arange(floor(until * rate + 1e-9) + 1) / rate
        source = SceneSource(self.scene, tuple(self.strands), self.stopped)
        poses, velocities = source.states(times)
        return Trajectory(
            times,
            tuple(body.label for body in self.scene.bodies),
            poses,
            velocities,
            self._events(float(times[-1])),
            {label: strand.mode for strand in self._live() for label in strand.members},
            source,
        )

    def _tables(self, members: tuple[str, ...]) -> tuple[World, Names]:
        """The world of such movable bodies as it is at the start; not to be changed."""
        key = frozenset(members)
        if key not in self.known:
            self.known[key] = world_of(self.scene, members)
        return self.known[key]

    def _fresh(self, members: tuple[str, ...]) -> tuple[World, Names]:
        """The same, for a run to change."""
        world, names = self._tables(members)
        return copied(world), names

    def _live(self) -> list[Strand]:
        return [strand for strand in self.strands if strand.end == inf]

    def _events(self, until: float) -> tuple[Event, ...]:
        last = min(until, self.stopped) + 1e-9
        events = [
            event
            for strand in self.strands
            for event in (*strand.notes, *(e for run in strand.runs for e in run.events))
            if event.time <= min(last, strand.end)
        ]
        return tuple(sorted(events, key=lambda event: event.time))

    def _begun(
        self, world: World, names: Names, pos: FloatArray, vel: FloatArray, time: float
    ) -> ExactRun | RobustRun:
        if self.mode == "robust":
            return RobustRun(world, names, pos, vel, time)
        return ExactRun(world, names, pos, vel, time, self.accuracy, patient=self.mode == "exact")

    def _start_all(self) -> None:
        """Looks at the scene at its start, even where nobody asked for more."""
        for strand in self._live():
            self._advance(strand, 0.0)

    def _advance(self, strand: Strand, until: float) -> None:
        run = strand.run
        try:
            run.advance(until)
        except TooMuch:
            if self.mode == "exact":
                raise SceneError(
                    f"{', '.join(strand.members)} touch in more places than exact mode can decide (at {run.time:.4g} s); "
                    "leave the choice of the mode open, or choose robust"
                ) from None
            assert isinstance(run, ExactRun)
            message = "many contacts: from here on solved together in small steps (robust mode)"
            strand.notes.append(Event(run.time, "robust", strand.members, message))
            strand.runs.append(RobustRun(run.world, run.names, run.pos, run.vel, run.time, run.works))
            self._advance(strand, until)

    def _merge_all(self, until: float) -> None:
        """Merges clusters that meet before `until`, the first to meet first."""
        while True:
            live = self._live()
            found = first_meeting(self.scene, live, self.time, until, self._tables)
            if found is None:
                return
            self._merge(found)
            self._advance(self.strands[-1], until)

    def _merge(self, met: Meeting) -> None:
        """One cluster instead of two, from the moment they meet."""
        both = (met.first, met.second)
        members = tuple(
            body.label for body in self.scene.bodies if any(body.label in strand.members for strand in both)
        )
        world, names = self._fresh(members)
        pos, vel = start_of(self.scene, names)
        robust = False
        for strand in both:
            _rewind(strand, met.time)
            places, speeds = strand.run.states(np.array([met.time]))
            strand.run.cut(met.time)
            old_world, old_names = strand.run.world, strand.run.names
            for k in range(old_names.movable):
                at = names.bodies.index(old_names.bodies[k])
                pos[at], vel[at] = places[0, k], speeds[0, k]
            _carry(old_world, old_names, world, names)
            strand.end = met.time
            robust = robust or isinstance(strand.run, RobustRun)
        run = (
            RobustRun(world, names, pos, vel, met.time)
            if robust
            else self._begun(world, names, pos, vel, met.time)
        )
        self.strands.append(Strand(members, [run]))


def _rewind(strand: Strand, time: float) -> None:
    """Drops the runs that a cluster began only after `time`, and what was noted of them: it never got there."""
    strand.runs[:] = [strand.runs[0], *(run for run in strand.runs[1:] if run.start <= time)]
    strand.notes[:] = [event for event in strand.notes if event.time <= time]


def _carry(old: World, old_names: Names, new: World, names: Names) -> None:
    """What has changed for good: broken wires, turns about pulleys, given normal forces that are over, courses that ended."""
    for k, label in enumerate(old_names.links):
        at = names.links.index(label)
        new.links["broken"][at] |= old.links["broken"][k]
        new.links["wound"][at] = old.links["wound"][k]
    for k, support in enumerate(old.supports):
        key = (old_names.supports[k], old_names.bodies[support["i"]])
        at = next(q for q, s in enumerate(new.supports) if (names.supports[q], names.bodies[s["i"]]) == key)
        for field_ in ("over", "risen"):
            new.supports[field_][at] = support[field_]
    for course in old.courses:
        key = (old_names.bodies[course["body"]], int(course["axis"]))
        at = next(q for q, c in enumerate(new.courses) if (names.bodies[c["body"]], int(c["axis"])) == key)
        if not course["on"]:
            body, axis = int(new.courses["body"][at]), int(course["axis"])
            new.courses["on"][at] = 0
            new.inverse[body, axis] = 1.0 / new.mass[body, axis]


def _clusters(scene: Scene, labels: Sequence[str], world: World, names: Names) -> list[tuple[str, ...]]:
    """Movable bodies in groups of those that are linked, read each other, or touch at the start."""
    parent = {label: label for label in labels}

    def root(label: str) -> str:
        while parent[label] != label:
            label = parent[label]
        return label

    def join(one: str | None, other: str | None) -> None:
        if one in parent and other in parent:
            parent[root(other)] = root(one)

    if len(labels) > 1:
        for link in (*scene.springs, *scene.wires, *scene.pins):
            join(link.start.body, link.end.body)
        for support in scene.supports:
            join(support.body, support.on)
        for body, program in _readers(scene):
            for other in program:
                join(body, other)
        pos, _ = start_of(scene, names)
        found = np.zeros((len(world.pairs), 2), np.int64)
        for i, j in found[: int(near_pairs(world.cells, pos, TOUCHING, found))]:
            join(names.bodies[i], names.bodies[j])
    groups: dict[str, list[str]] = {}
    for label in labels:
        groups.setdefault(root(label), []).append(label)
    return [tuple(group) for group in groups.values()]


def _readers(scene: Scene) -> list[tuple[str | None, tuple[str, ...]]]:
    """(body, labels of those whose motion its formulas read)."""
    found: list[tuple[str | None, tuple[str, ...]]] = []
    for force in scene.forces:
        found += [(force.body, force.x.others), (force.body, force.y.others)]
    found += [(support.body, support.force.others) for support in scene.supports]
    found += [(course.body, course.velocity.others) for course in scene.courses]
    for wire in scene.wires:
        if wire.tension is not None:
            found += [(end.body, wire.tension.others) for end in (wire.start, wire.end)]
    return found


def _refuse_too_stiff(world: World) -> None:
    """Gershgorin's bound on the natural frequencies that the springs give the scene: for a spring, what all
    springs at either of its bodies can do to it."""
    springs = world.links[world.links["kind"] == 0]
    total = np.zeros(len(world.mass))
    for spring in springs:
        for end in ("i", "j"):
            total[spring[end]] += spring["stiffness"]
    for spring in springs:
        square = 0.0
        for body, x, y in (
            (spring["i"], spring["ax"], spring["ay"]),
            (spring["j"], spring["bx"], spring["by"]),
        ):
            give = world.inverse[body, 0] + world.inverse[body, 2] * (x * x + y * y)
            square += float(total[body] * give)
        if square > STIFFEST**2:
            raise SceneError(
                f"a spring would swing at {square**0.5 / 6.283:.3g} Hz; make it softer or its load heavier, "
                f"below {STIFFEST / 6.283:.0f} Hz"
            )
