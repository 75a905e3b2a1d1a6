"""Robust mode: a crowd of bodies stepped on a fixed grid of its own, and what is kept of it.

Everything happens in substeps of 1/240 s or shorter, counted from the start, so a run does not depend on
how it is cut into advances. The state at a time is known once the kick at that time is, so the working
memory is always one substep ahead of `time`.
"""

from __future__ import annotations

from math import ceil, sqrt
from typing import Any

import numpy as np

from physics.engine.acts import Act, applied, energies
from physics.engine.forces import ledger_size
from physics.engine.robust.broad import ROOM
from physics.engine.robust.crowd import Record, contact_room, crowd_of, gathered, near_room
from physics.engine.robust.memory import DONE, EVENTS, FORCE, NEEDS, PRESSED, RECORDS, STILL, STOPPED
from physics.engine.robust.pace import ASLEEP, run
from physics.engine.robust.shown import contact_acts, joint_acts
from physics.engine.robust.told import told, whose
from physics.engine.world import SPRING, IntArray, Names, World, copied
from physics.trajectory import Event
from sketch.ink import FloatArray

STEP = 1 / 60
"""s: bodies are looked at for rest, and a run may end, on this grid."""
SUBSTEPS = 4
"""Records in a step; as many substeps, or a multiple."""
ADVANCE = 0.1
"""rad: the most that the fastest spring may advance in a substep: its period errs by (0.1)²/24."""
MOST = 256
"""Substeps in a record: springs above 10 kHz are not followed."""


class RobustRun:
    """A run of robust mode. time: how far it has got, s; stopped: a formula has no value; events: in order of
    time. pos, vel: (bodies + 1, 3); ledger: its entries at the start. sleep: a scene without any motion that
    reads no time is not stepped on."""

    def __init__(
        self,
        world: World,
        names: Names,
        pos: FloatArray,
        vel: FloatArray,
        time: float,
        ledger: FloatArray | None = None,
        sleep: bool = True,
    ) -> None:
        self.world, self.given = copied(world), copied(world)
        self.names, self.start = names, time
        self.begun = self._energy(pos[None], vel[None])
        entries = ledger_size(world)
        self.crowd = crowd_of(self.world, names, pos, vel, np.zeros(entries) if ledger is None else ledger)
        self.each = _substeps(world)
        self.sleepy = sleep and names.timeless
        self.pitch = STEP / SUBSTEPS
        reach = world.reach[: names.movable]
        self.room = ROOM * float(reach.mean()) if len(reach) else 0.0
        bodies, rows = len(pos), len(self.crowd.rows)
        self.record = Record(
            np.zeros((8, bodies, 3)),
            np.zeros((8, bodies, 3)),
            np.zeros((8, bodies, 3)),
            np.zeros((8, entries)),
            np.zeros((8, rows)),
            np.zeros(8, np.int64),
            np.zeros((32, FORCE)),
            np.zeros(32, np.int32),
            np.full((8, bodies), -1.0),
            np.zeros((8, bodies, 3)),
            np.zeros((8, len(world.links))),
        )
        self.steps = 0
        self.stopped = self.asleep = False
        self.noted: list[tuple[float, Event]] = []
        self.ended: dict[tuple[str, int], float] = {}
        self._run(1)

    @property
    def time(self) -> float:
        """How far it has got, s."""
        return self.start + self.steps * STEP

    @property
    def events(self) -> list[Event]:
        """What happened up to `time`, in order of time."""
        until = np.inf if self.stopped else self.time + 1e-9
        found = [event for _, event in self.noted if event.time <= until]
        return sorted(found, key=lambda event: event.time)

    def advance(self, until: float) -> None:
        """Steps until `time` is at least `until`, s, or a formula has no value."""
        steps = ceil((until - self.start) / STEP - 1e-9)
        if steps <= self.steps or self.stopped:
            return
        if not self.asleep:
            self._run(1 + steps * SUBSTEPS * self.each)
        self.steps = steps
        if self.stopped:
            self.steps = (self._records() - 1) // SUBSTEPS

    def cut(self, time: float) -> None:
        """Forgets what was recorded after `time`, s, but the record that ends the way there. The run cannot go on
        from there."""
        kept = max(ceil((time - self.start) / self.pitch - 1e-9) + 1, 1)
        if kept < self._records():
            self.crowd.tally[RECORDS] = kept
            self.crowd.tally[PRESSED] = self.record.ends[kept - 1]
            self.world.links["wound"] = self.record.wound[kept - 1]
            self.asleep = False
        self.steps = min(self.steps, int((time - self.start) / STEP + 1e-9))
        self.noted = [(at, event) for at, event in self.noted if event.time <= time]
        self.ended = {key: at for key, at in self.ended.items() if at <= time}

    def states(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Poses and velocities, (T, bodies + 1, 3) each, at ascending times (s) up to `time`."""
        at, share = self._places(times)
        after = np.minimum(at + 1, self._records() - 1)
        record, h = self.record, self.pitch
        s = share[:, None, None]
        x0, x1 = record.pos[at], record.pos[after]
        v0, v1 = h * record.vel[at], h * record.vel[after]
        way = x1 - x0
        pos = x0 + s * (v0 + s * (3 * way - 2 * v0 - v1 + s * (v0 + v1 - 2 * way)))
        vel = (v0 + s * (6 * way - 4 * v0 - 2 * v1 + s * 3 * (v0 + v1 - 2 * way))) / h
        self._break(at, after, share, pos, vel)
        if self.asleep or self.stopped:
            vel[times > self.start + self.pitch * (self._records() - 1) + 1e-9] = 0.0
        return pos, vel

    def _break(
        self, at: IntArray, after: IntArray, share: FloatArray, pos: FloatArray, vel: FloatArray
    ) -> None:
        """Where a body is struck between two records, its velocity jumps, and it goes straight to where it ends; beside
        that, all go evenly from one to the other, those too that are not struck, so that momentum is kept on the way."""
        record, h = self.record, self.pitch
        frames = np.flatnonzero((record.struck[at] >= 0.0).any(axis=1) & (share > 0.0))
        if not len(frames):
            return
        first, last = at[frames], after[frames]
        x0, x1, v0, v1 = record.pos[first], record.pos[last], record.vel[first], record.vel[last]
        hit, jump, s = record.struck[first][:, :, None], record.jump[first], share[frames][:, None, None] * h
        even = (v1 - v0 - jump) / h
        turn = np.clip(hit, 0.0, h * (1.0 - 1e-9))
        apart = (x1 - x0 - h * (v0 + 0.5 * h * even)) / (h - turn)
        pos[frames] = x0 + s * (v0 + 0.5 * s * even) + np.maximum(s - turn, 0.0) * apart
        vel[frames] = v0 + s * even + (s > hit) * jump

    def place(self, time: float, at: IntArray, pos: FloatArray) -> None:
        """Writes the poses at one time into the rows `at` of pos, (bodies, 3), one for each that can move."""
        pos[at] = self.states(np.array([time]))[0][0, : self.names.movable]

    def ledger(self, times: FloatArray) -> FloatArray:
        """Heat and works, (T, entries) J: see `forces.ledger_size`."""
        at, share = self._places(self._known(times))
        after = np.minimum(at + 1, self._records() - 1)
        found = self.record.ledger
        return found[at] + share[:, None] * (found[after] - found[at])

    def corrected(self, times: FloatArray) -> FloatArray:
        """Energy that the steps themselves have taken (negative: given), (T,) J: errors of their length, poses put
        right. It is what neither rubbing nor damping nor an impact made heat of."""
        entries, first = self.ledger(times), self.record.ledger[0]
        booked = entries[:, 1:].sum(axis=1) - first[1:].sum() - (entries[:, 0] - first[0])
        return self.begun + booked - self._energy(*self.states(self._known(times)))

    def _known(self, times: FloatArray) -> FloatArray:
        """Times, none after the last record."""
        return np.minimum(times, self.start + self.pitch * (self._records() - 1))

    def _energy(self, pos: FloatArray, vel: FloatArray) -> FloatArray:
        """Kinetic, potential and elastic, (T,) J."""
        return sum(energies(self.given, self.names, pos, vel), np.zeros(len(pos)))

    def observe(self, times: FloatArray) -> tuple[list[Act], FloatArray]:
        """All forces, and accelerations (T, bodies + 1, 3): of the substep in which each time lies."""
        at, _ = self._places(times)
        pos, vel = self.states(times)
        wound = self.record.wound[at]
        acts = applied(self.given, self.names, times, pos, vel, wound)
        self._end(acts, times)
        acts += joint_acts(self.given, self.names, self.crowd.rows, self.record.pulls[at], pos, wound)
        acts += contact_acts(self.given, self.names, self.record, at, pos)
        accelerations = self.record.acc[at].copy()
        if self.asleep or self.stopped:
            accelerations[times > self.start + self.pitch * (self._records() - 1) + 1e-9] = 0.0
        return acts, accelerations

    def _records(self) -> int:
        return int(self.crowd.tally[RECORDS])

    def _places(self, times: FloatArray) -> tuple[IntArray, FloatArray]:
        """The record before each time, and how far to the next, 0 to 1."""
        units = (np.asarray(times) - self.start) / self.pitch
        whole = np.rint(units)
        units = np.where(np.abs(units - whole) < 1e-6, whole, units)
        at = np.clip(np.floor(units), 0, self._records() - 1).astype(np.int64)
        share = np.clip(units - at, 0.0, 1.0)
        return at, np.where(at == self._records() - 1, 0.0, share)

    def _run(self, until: int) -> None:
        """Substeps until so many are done; tables grow as they must."""
        crowd, frame = self.crowd, SUBSTEPS * self.each
        while int(crowd.tally[DONE]) < until and not self.stopped:
            self._make_room(until)
            run(
                self.world.cells,
                self.crowd.cells,
                self.record,
                self.start,
                self.pitch / self.each,
                self.each,
                frame,
                until,
                self.room,
                self.sleepy,
            )
            crowd = self.crowd
            self._tell()
            if int(crowd.tally[STOPPED]) >= 0:
                self._stop(int(crowd.tally[STOPPED]))
            elif self.sleepy and crowd.tally[STILL] >= ASLEEP and (crowd.tally[DONE] - 1) % frame == 0:
                self.asleep = True
                return

    def _make_room(self, until: int) -> None:
        crowd, record = self.crowd, self.record
        tally = crowd.tally
        if tally[NEEDS] > 0:
            pairs = int(1.5 * tally[NEEDS]) + 8
            real, whole, old_real, old_whole = contact_room(pairs)
            known = crowd.real.shape[1]
            real[:, :known], whole[:, :known] = crowd.real, crowd.whole
            near, seen = near_room(pairs)
            crowd = crowd._replace(
                real=real, whole=whole, old_real=old_real, old_whole=old_whole, near=near, seen=seen
            )
        noisy = 2 * (len(crowd.near) + len(self.world.links) + len(self.world.supports))
        noisy += len(self.world.courses) + len(self.names.bodies)
        if len(crowd.events) < 2 * noisy:
            crowd = crowd._replace(events=np.zeros((4 * noisy, crowd.events.shape[1])))
        if crowd is not self.crowd:
            self.crowd = gathered(crowd[:-1])
        wanted = max((until - 1) // self.each + 2, int(1.5 * self._records()))
        if self._records() >= len(record.pos) - 1:
            grown = max(wanted, len(record.pos))
            record = record._replace(
                **{name: _grown(getattr(record, name), grown) for name in ("pos", "vel", "acc")},
                **{
                    name: _grown(getattr(record, name), grown)
                    for name in ("ledger", "pulls", "ends", "struck", "jump", "wound")
                },
            )
        pressed = int(tally[PRESSED])
        if pressed + len(crowd.near) > len(record.forces):
            # As much as the records to come will need, if contacts stay as many as they are.
            last = pressed - int(record.ends[self._records() - 2]) if self._records() > 1 else 0
            grown = max(pressed + (len(record.pos) - self._records()) * (last + 1), int(1.5 * pressed))
            grown += 4 * len(crowd.near)
            record = record._replace(forces=_grown(record.forces, grown), pairs=_grown(record.pairs, grown))
        self.record = record

    def _tell(self) -> None:
        crowd = self.crowd
        for row in crowd.events[: int(crowd.tally[EVENTS])]:
            time, kind, number, size = float(row[0]), float(row[1]), int(row[2]), float(row[3])
            event, over = told(self.world, self.names, time, kind, number, size)
            self.noted.append((time, event))
            if over is not None:
                self.ended[over] = time
        crowd.tally[EVENTS] = 0
        for number in range(len(self.world.supports)):
            support: Any = self.world.supports[number]
            if support["over"] == 0:
                self.ended.setdefault(("support", number), self.start + self.pitch * self._records())

    def _stop(self, program: int) -> None:
        self.stopped = True
        name, body = whose(self.world, self.names, program)
        time = self.start + self.pitch / self.each * int(self.crowd.tally[DONE])
        text = self.names.programs[program]
        message = (
            f"{name} of {body} = {text} has no value (0/0, overflow, or a root or logarithm of what has none)"
        )
        self.noted.append((time, Event(time, "stopped", (body,), message)))

    def _end(self, acts: list[Act], times: FloatArray) -> None:
        """Nothing is given by a wire that broke or a support that is over, from then on."""
        for (kind, number), since in self.ended.items():
            gone = times >= since - 1e-9
            name = self.names.supports[number] if kind == "support" else f"T of {self.names.links[number]}"
            bodies: Any = self.world.supports[number] if kind == "support" else self.world.links[number]
            for act in acts:
                if act.name == name and act.body in (bodies["i"], bodies["j"]):
                    act.values[gone] = 0.0


def _grown(array: np.ndarray[Any, Any], rows: int) -> np.ndarray[Any, Any]:
    bigger = np.zeros((rows, *array.shape[1:]), array.dtype)
    bigger[: len(array)] = array
    return bigger


def _substeps(world: World) -> int:
    """Substeps in a record, so that the fastest spring and the strongest damper are followed."""
    fastest = 0.0
    h = STEP / SUBSTEPS
    for number in range(len(world.links)):
        link: Any = world.links[number]
        if link["kind"] == SPRING:
            ease = 0.0
            for body, x, y in ((link["i"], "ax", "ay"), (link["j"], "bx", "by")):
                ease += world.inverse[body, 0] + world.inverse[body, 2] * (link[x] ** 2 + link[y] ** 2)
            fastest = max(fastest, sqrt(link["stiffness"] * ease), link["damping"] * ease)
    return min(max(ceil(h * fastest / ADVANCE - 1e-9), 1), MOST)
