"""Events in words, as a student reads them."""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.exact.decide import WEAK
from physics.engine.exact.solve import SINGULAR
from physics.engine.forces import value_at
from physics.engine.rows import CORD, GIVEN, ON, PIN_X, POINT
from physics.engine.world import Names, Table, World
from physics.trajectory import Event, EventKind
from sketch.ink import FloatArray

HEARD = 1e-6
"""m/s: slower impacts are not told."""


class Teller:
    """Adds events to a list, with the names of what they happen to."""

    def __init__(self, names: Names, events: list[Event]) -> None:
        self.names, self.events = names, events
        self.open: set[tuple[str, ...]] = set()

    def _say(self, time: float, kind: EventKind, bodies: tuple[str, ...], message: str) -> None:
        self.events.append(Event(time, kind, bodies, message))

    def _bodies(self, *rows: int) -> tuple[str, ...]:
        return tuple(self.names.bodies[k] for k in rows if k < len(self.names.bodies))

    def impacts(self, time: float, rows: Table, struck: FloatArray) -> None:
        """One for each pair that met: how fast it closed at its quickest point."""
        met: dict[tuple[str, ...], float] = {}
        for row, speed in zip(rows, struck, strict=True):
            if speed > HEARD and row["kind"] <= POINT:
                pair = self._bodies(*sorted((int(row["i"]), int(row["j"]))))
                met[pair] = max(met.get(pair, 0.0), float(speed))
        for pair, speed in met.items():
            message = f"{pair[0]} and {pair[1]} meet at {speed:.3g} m/s"
            self.events.append(Event(time, "impact", pair, message, speed))

    def wire(self, time: float, kind: EventKind, row: Any) -> None:
        """A wire goes slack or taut."""
        name = self.names.links[row["source"]]
        state = "hangs slack" if kind == "slack" else "is taut again"
        self._say(time, kind, (name, *self._bodies(int(row["i"]), int(row["j"]))), f"wire {name} {state}")

    def broken(self, time: float, link: int, why: str) -> None:
        """A wire breaks."""
        name = self.names.links[link]
        self._say(time, "break", (name,), f"wire {name} breaks: {why}")

    def released(self, time: float, body: int, course: str) -> None:
        """A body that collides leaves its course."""
        (name,) = self._bodies(body)
        message = f"{name} collides: its equation for {course} no longer holds, the laws of motion take over"
        self._say(time, "released", (name,), message)

    def separated(self, time: float, i: int, j: int) -> None:
        """Two bodies overlapped at the start."""
        pair = self._bodies(i, j)
        self._say(time, "separated", pair, f"{' and '.join(pair)} overlapped and were moved apart")

    def rests(self, time: float, body: int) -> None:
        """A body comes to rest."""
        (name,) = self._bodies(body)
        self._say(time, "rest", (name,), f"{name} rests")

    def sunk(self, time: float, support: int, i: int, j: int) -> None:
        """A given normal force is too small."""
        one, other = self._bodies(i, j)
        name = self.names.supports[support]
        message = f"{name} is too small to carry {one}: it sinks into {other} and is struck back"
        self._say(time, "bounce", (one, other), message)

    def risen(self, time: float, support: int, i: int, j: int) -> None:
        """A given normal force is too great."""
        one, other = self._bodies(i, j)
        name = self.names.supports[support]
        self._say(time, "lift-off", (one, other), f"{name} is greater than {one} needs: it leaves {other}")

    def stopped(self, time: float, world: World, pos: FloatArray, vel: FloatArray, ahead: float) -> None:
        """A formula has no value here, or just ahead."""
        found = (
            (name, body, program)
            for when in (time, time + max(ahead, 1e-12), time + 1e-9 * max(1.0, abs(time)))
            for name, body, program in self._formulas(world)
            if np.isnan(value_at(world.cells, program, when, pos + (when - time) * vel, vel))
        )
        name, body, program = next(found, ("a formula", "the page", -1))
        text = self.names.programs[program] if program >= 0 else "…"
        message = (
            f"{name} of {body} = {text} has no value (0/0, overflow, or a root or logarithm of what has none)"
        )
        self._say(time, "stopped", (body,), message)

    def _formulas(self, world: World) -> list[tuple[str, str, int]]:
        """(name, body, program) of every formula."""
        names = self.names

        def label(body: int) -> str:
            return names.bodies[body] if body < len(names.bodies) else "the page"

        found: list[tuple[str, str, int]] = []
        for name, push in zip(names.pushes, world.pushes, strict=True):
            found += [(name, label(int(push["body"])), int(push[axis])) for axis in ("x", "y")]
        for name, link in zip(names.links, world.links, strict=True):
            if link["tension"] >= 0 and not link["broken"]:
                reader = int(link["i"]) if int(link["i"]) < names.movable else int(link["j"])
                found.append((f"T of {name}", label(reader), int(link["tension"])))
        for name, support in zip(names.supports, world.supports, strict=True):
            if support["over"]:
                found.append((name, label(int(support["i"])), int(support["force"])))
        for name, course in zip(names.courses, world.courses, strict=True):
            if course["on"]:
                for what in ("position", "velocity", "acceleration"):
                    if course[what] >= 0:
                        found.append((name, label(int(course["body"])), int(course[what])))
        return found

    def open_forces(self, time: float, world: World, rows: Table) -> None:
        """Which forces the laws of motion leave open: marks those rows, and tells once of each set."""
        for k in undetermined(world, rows):
            rows[k]["unique"] = 0
        said = [row for row in rows if not row["unique"]]
        if not said:
            return
        told = tuple(dict.fromkeys(self.row_name(row) for row in said))
        if told not in self.open:
            self.open.add(told)
            message = f"{', '.join(told)}: the laws of motion leave these forces open; the smallest are given"
            bodies = tuple(
                dict.fromkeys(b for row in said for b in self._bodies(int(row["i"]), int(row["j"])))
            )
            self._say(time, "not unique", bodies, message)

    def row_name(self, row: Any) -> str:
        """The force of a row, in words."""
        if row["kind"] >= CORD and row["kind"] != GIVEN:
            name = self.names.links[row["source"]]
            return f"pin {name}" if row["kind"] >= PIN_X else f"T of {name}"
        i, j = (
            self.names.bodies[int(b)] if b < len(self.names.bodies) else "the page"
            for b in (row["i"], row["j"])
        )
        return f"contact of {j} with {i}"


def undetermined(world: World, rows: Table) -> list[int]:
    """Rows whose forces are not settled: those that take part in a null vector of (J W Jᵀ), normal parts.

    Two corners of one face that rub have two ways to share friction; that is nobody's question, so tangents
    are left out, and so are contacts of one pair, which are one force to a student.
    """
    holding = [k for k, row in enumerate(rows) if row["status"] == ON and row["kind"] != GIVEN]
    if len(holding) < 2:
        return []
    lines = np.zeros((len(holding), 3 * len(world.mass)))
    for line, k in zip(lines, holding, strict=True):
        row = rows[k]
        for body, part in ((int(row["i"]), row["J"][:3]), (int(row["j"]), row["J"][3:])):
            line[3 * body : 3 * body + 3] += part * np.sqrt(world.inverse[body])
    left, sizes, _ = np.linalg.svd(lines, full_matrices=True)
    rank = int((sizes > np.sqrt(SINGULAR) * sizes.max(initial=0.0)).sum())
    null = left[:, rank:]
    open_ = np.abs(null).max(axis=1, initial=0.0) > np.sqrt(WEAK)
    return [k for k, yes in zip(holding, open_, strict=True) if yes]
