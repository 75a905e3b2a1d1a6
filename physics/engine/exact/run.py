"""Exact mode: one cluster of bodies from event to event.

    run = ExactRun(world, names, pos, vel, time, accuracy)
    run.advance(until); run.states(times); run.observe(times)

Between events the rows that hold stay the same and the motion is smooth (flow.py); at an event the
bodies' contacts are found anew, impacts are struck (strike.py), and it is decided which rows hold next
(decide.py). Frame: SI units, y up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.acts import Act
from physics.engine.exact import decide as de
from physics.engine.exact import flow as fl
from physics.engine.exact import happen as ha
from physics.engine.exact import strike as st
from physics.engine.exact.blow import HELD, JAMMED
from physics.engine.exact.explain import explain, follow_frames
from physics.engine.exact.integrate import projected
from physics.engine.exact.machine import FIRST, H, Machine, T, machine_of
from physics.engine.exact.moments import CRAWLS, FULL, HAPPENED, MET, STOPPED, SWITCHED
from physics.engine.exact.parting import separate
from physics.engine.exact.record import Record
from physics.engine.exact.rest import CALM, at_rest, liveliest
from physics.engine.exact.solve import LARGEST, system_of
from physics.engine.exact.standing import SLUGGISH, TooMuch, closes, gathered_rows, parts
from physics.engine.exact.tell import Teller
from physics.engine.exact.touch import TOUCHING
from physics.engine.rows import CORD, GIVEN, OFF, ON, PIN_X, POINT, ROW
from physics.engine.world import IntArray, Names, Table, World, copied
from physics.trajectory import Event
from sketch.ink import FloatArray

BoolArray = NDArray[np.bool_]

ENDLESS = 1000
"""Events within `ENDLESS_TIME` after which exact mode gives up: it would go on for ever."""
ENDLESS_TIME = 0.02
"""s."""
CROWD = 400
"""Events within `CROWD_TIME` after which nothing rebounds any more."""
CROWD_TIME = 1e-3
"""s."""
CREEP = 1e-4
"""m/s: what slips slower in such a crowd of events is stopped: between two others a disc may roll to and fro, each
time a little less, without end."""
MANY = 16
"""Bodies that can move from which on a crowd is left to robust mode, where there is a choice, as soon as it has
more events than bodies within `ENDLESS_TIME`: each costs as much as all robust steps between two frames."""
SHAKEN = 20
"""Events at one moment after which nothing rebounds any more: corners that hand a blow round lose little each time."""
STUCK = 80
"""Events at one moment after which exact mode gives up."""
LOOKS = 64
"""Steps after which it is looked whether a cluster has come to rest while nothing happened."""
CRAWL = 512
"""Steps within `CRAWL_TIME` after which exact mode gives up. The stiffest spring takes some for each 1e-5 s, and a
formula that grows without bound is stopped by the step's length long before."""
CRAWL_TIME = 1e-6
"""s."""
RATTLE = 12
"""Events within `CROWD_TIME` after which a rebound must rise ten times as high as before to be one."""


@dataclass(slots=True)
class Mode:
    """A stretch in which the same rows hold: its tables, when it begins, and which recorded step is its first."""

    world: World
    machine: Machine
    start: float
    first: int


class ExactRun:
    """A cluster on its way. Mutable: it grows with the run. `advance` raises TooMuch where robust mode must
    take over; `pos`, `vel`, `works` and `time` are then as far as this mode got."""

    def __init__(
        self,
        world: World,
        names: Names,
        pos: FloatArray,
        vel: FloatArray,
        time: float,
        accuracy: float,
        patient: bool = True,
    ) -> None:
        """patient: goes on however many events there are (see `MANY`)."""
        self.world, self.names, self.accuracy, self.patient = world, names, accuracy, patient
        self.time = self.start = time
        self.pos, self.vel = pos.copy(), vel.copy()
        count = 1 + sum(len(t) for t in (world.pushes, world.links, world.supports, world.courses))
        self.works = np.zeros(count)
        self.step = FIRST
        self.stopped = self.asleep = False
        self.events: list[Event] = []
        self.modes: list[Mode] = []
        self.record = Record(6 * names.movable + count)
        self.limited = bool(np.isfinite(world.links["limit"]).any()) if len(world.links) else False
        self.tell = Teller(names, self.events)
        self.rows = np.zeros(0, ROW)
        self.lately: list[float] = []
        self.pending: dict[int, float] = {}
        self.moved = np.zeros(names.movable, bool)

    def advance(self, until: float) -> None:
        """Goes on until `time` is `until` or later, or the run has stopped."""
        if not self.modes:
            separate(self.world, self.pos, self.vel, self.tell, self.time)
            self._settle()
        while self.time < until and not self.stopped:
            if self.asleep:
                self.record.rest(self.modes[-1].machine.y, self.time, until)
                self.time = until
                return
            code = self._flow(self.modes[-1], until)
            if code in (HAPPENED, MET, SWITCHED):
                self._happen(code)
            elif code == STOPPED:
                self._stop()
            elif code == CRAWLS and not self.names.timeless:
                # A formula that grows without bound, as 1/(t − 1) does.
                self._stop()
            elif code == CRAWLS:
                raise TooMuch
            elif code == FULL:
                if self._crawls():
                    raise TooMuch
                self._try_sleep()

    def cut(self, time: float) -> None:
        """Forgets what happened after `time`; nothing can follow but reading what is left."""
        self.events[:] = [event for event in self.events if event.time <= time]
        gone = [mode.first for mode in self.modes if mode.start > time]
        self.modes = [mode for mode in self.modes if mode.start <= time]
        self.record.count = min(gone, default=self.record.count)
        self.world = self.modes[-1].world
        self.time = time

    def states(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Poses and velocities, (T, bodies + 1, 3), at ascending times."""
        n = self.names.movable
        pos, vel = np.zeros((2, len(times), *self.pos.shape))
        pos[:, n:] = self.pos[n:]
        if self.record.count:
            self.record.frames(times, n, pos, vel)
        else:
            pos[:, :n], vel[:, :n] = self.pos[:n], self.vel[:n]
        if self.stopped:
            # At the very moment at which a formula has no value, neither has the rate of what it drives.
            np.nan_to_num(vel, copy=False, nan=0.0, posinf=0.0, neginf=0.0)
        if len(self.world.courses):
            follow_frames(self.modes, times, pos, vel)
        return pos, vel

    def place(self, time: float, at: IntArray, pos: FloatArray) -> None:
        """Writes the poses at one time into the rows `at` of pos, (bodies, 3), one for each that can move."""
        if self.record.count and not len(self.world.courses):
            self.record.place(time, at, pos)
        else:
            pos[at] = self.states(np.array([time]))[0][0, : self.names.movable]

    def ledger(self, times: FloatArray) -> FloatArray:
        """Heat and works, (T, entries) J, at ascending times."""
        return self._sampled(times)[:, 6 * self.names.movable :]

    def corrected(self, times: FloatArray) -> FloatArray:
        """Energy that the steps themselves have taken, (T,) J: none that is not an error."""
        return np.zeros(len(times))

    def observe(self, times: FloatArray) -> tuple[list[Act], FloatArray]:
        """(forces, accelerations (T, bodies + 1, 3)) at ascending times."""
        return explain(self.modes, self.names, times, self._sampled(times))

    def _sampled(self, times: FloatArray) -> FloatArray:
        if not self.record.count:
            return np.broadcast_to(self._packed(), (len(times), len(self._packed()))).copy()
        return self.record.states(times)

    def _packed(self) -> FloatArray:
        n = self.names.movable
        return np.concatenate([self.pos[:n].ravel(), self.vel[:n].ravel(), self.works])

    def _flow(self, mode: Mode, until: float) -> int:
        """Goes on while nothing happens; why it ended: see `flow`."""
        machine, record = mode.machine, self.record
        most = record.count + LOOKS - (record.count - mode.first) % LOOKS
        record.make_room(most)
        code = fl.flow(
            mode.world.cells, machine.cells, record.spans, record.dense, most, until, self.accuracy
        )
        record.count = int(machine.recorded[0])
        self._adopt(machine)
        self.works = machine.y[6 * self.names.movable :].copy()
        self.time, self.step = float(machine.clock[T]), float(machine.clock[H])
        return code

    def _machine(self, rows: Table) -> Machine:
        """The machine for these rows, in the state of this moment."""
        world = self.world
        system = system_of(rows, world.inverse)
        if len(system.row) > LARGEST:
            raise TooMuch
        counts = (
            self.names.movable,
            len(self.works),
            3 * len(rows) + 2 * len(world.links) + 2 * len(world.supports),
            len(world.spans),
            len(world.pairs),
        )
        return machine_of(rows, system, counts, self.pos, self.vel, self.works, self.time, self.step)

    def _settle(self) -> None:
        """Finds what touches, strikes what meets, decides what holds, and starts a new mode."""
        rows = gathered_rows(self.world, self.rows, self.pos, self.vel)
        if closes(rows):
            self._strike(rows)
        creeps = (rows["kind"] <= POINT) & (rows["mu"] > 0.0) & (rows["gap"] <= TOUCHING)
        creeps &= (np.abs(rows["slip"]) > de.SLOW) & (np.abs(rows["slip"]) < CREEP)
        if len(self.lately) > CROWD and creeps.any():
            self._stop_slips(rows, creeps)
        if parts(rows):
            rows = rows[~((rows["kind"] <= POINT) & (rows["rate"] > st.APPROACH))]
        try:
            machine = de.decide(self.world, rows, self._machine, self.time)
        except de.Undecided as undecided:
            self._unjam(rows, undecided.jams)
            self._settle()
            return
        if projected(self.world.cells, machine.cells):
            self._adopt(machine)
            de.accelerated(self.world.cells, machine.cells, self.time)
        gone = np.zeros(len(rows))
        if len(rows):
            de.leaving(self.world.cells, machine.cells, gone)
        if gone.any():
            rows = rows[gone == 0]
            machine = self._machine(rows)
            de.accelerated(self.world.cells, machine.cells, self.time)
        self.rows = machine.rows
        over = ha.overloaded(self.world, self.rows) if self.limited else []
        if over:
            for row in over:
                ha.row_event(self.world, row, 2, self.tell, self.time)
            self._settle()
            return
        if not machine.unique:
            self.tell.open_forces(self.time, self.world, machine.rows)
        self._begin(machine)

    def _adopt(self, machine: Machine) -> None:
        n = self.names.movable
        self.pos[:n] = machine.y[: 3 * n].reshape(n, 3)
        self.vel[:n] = machine.y[3 * n : 6 * n].reshape(n, 3)

    def _begin(self, machine: Machine) -> None:
        self.modes.append(Mode(self.world, machine, self.time, self.record.count))
        machine.recorded[0] = self.record.count
        if not fl.begin(self.world.cells, machine.cells):
            self._stop()
            return
        self._try_sleep()

    def _strike(self, rows: Table) -> None:
        """Impacts of this moment, and what opens slowly: changes velocities, and what rows are."""
        closed = (rows["gap"] <= TOUCHING) & (rows["kind"] < GIVEN)
        approach = closed & (rows["kind"] <= CORD) & (rows["rate"] < -st.APPROACH)
        pins = (rows["kind"] >= PIN_X) & (rows["kind"] < GIVEN) & (np.abs(rows["rate"]) > st.APPROACH)
        struck = np.zeros(len(rows))
        lately = sum(when > self.time - CROWD_TIME for when in self.lately)
        # A wire and a floor may hand a body to and fro for ever: the faster they do, the higher it must rise.
        rise = st.RISE * 10.0 ** min(lately // RATTLE, 4)
        if approach.any() or pins.any():
            for row in rows[approach & (rows["kind"] <= POINT)]:
                for body in (int(row["i"]), int(row["j"])):
                    ha.release(self.world, self.names, body, self.tell, self.time)
            self._press(rows, approach)
            rows["shut"] = 0
            before = np.zeros_like(self.vel)
            crowded = lately > CROWD or self._at_once() > SHAKEN
            self._lose(st.strike(self.world.cells, rows, self.pos, self.vel, rise, crowded, before, struck))
            self.tell.impacts(self.time, rows, struck)
        if not self._hold(rows, closed & (rows["kind"] <= CORD), rise) and not (approach.any() or pins.any()):
            return
        for k in np.flatnonzero(closed & (rows["kind"] == CORD)):
            row = rows[k]
            if row["status"] == OFF and approach[k]:
                self.tell.wire(self.time, "taut", row)
            row["status"] = ON if row["rate"] <= st.APPROACH else OFF
        for k in np.flatnonzero(rows["kind"] <= POINT).tolist():
            rows[k]["status"] = ON
            de.take_grip(rows, k)
            if rows[k]["shut"]:
                self._note_shut(rows[k], float(struck[k]))

    def _hold(self, rows: Table, closed: BoolArray, rise: float) -> bool:
        """Holds what opens so slowly that it would be pressed shut again at once, and what opens in consequence;
        whether there was any."""
        held = np.zeros(len(rows), bool)
        rows["bound"] = 0.0
        for _ in range(len(rows)):
            slow = closed & ~held & (rows["rate"] > st.APPROACH) & (rows["rate"] < SLUGGISH)
            if not slow.any():
                break
            self._press(rows, slow)
            self._lose(st.hold(self.world.cells, rows, self.pos, self.vel, rise))
            before, held = held, rows["bound"] == HELD
            if np.array_equal(before, held):
                break
        return bool(held.any())

    def _lose(self, heat: float) -> None:
        """Enters the heat of a blow, J. Raises TooMuch where no blow was found."""
        if not heat >= -np.inf:
            raise TooMuch
        self.works[0] += heat

    def _press(self, rows: Table, free: BoolArray) -> None:
        """Notes how the gaps of rows accelerate while some of them do not hold."""
        without = rows.copy()
        without["status"][free] = OFF
        machine = self._machine(without)
        de.accelerated(self.world.cells, machine.cells, self.time)
        de.pressing(machine.cells)
        rows["press"] = machine.rows["press"]

    def _unjam(self, rows: Table, jams: tuple[int, ...]) -> None:
        """Stops a slip that no forces can go with. Raises TooMuch where that is not what is wrong."""
        for jam in jams:
            if self._stop_slips(rows, np.arange(len(rows)) == jam) and rows[jam]["force"] > 0.0:
                self._count()
                self.rows = rows
                return
        raise TooMuch

    def _stop_slips(self, rows: Table, which: BoolArray) -> bool:
        """Stops them by impulses, whatever these take; nothing changes where there are none that do, or where they
        would do more than stop."""
        vel = self.vel.copy()
        rows["bound"] = np.where(which, JAMMED, 0.0)
        heat = st.stop(self.world.cells, rows, self.pos, self.vel)
        if not heat >= 0:
            self.vel[:] = vel
            return False
        self.works[0] += heat
        for k in np.flatnonzero(rows["kind"] <= POINT).tolist():
            de.take_grip(rows, k)
        return True

    def _note_shut(self, row: Any, speed: float) -> None:
        """When the rebounds that are left out would have ended: flights of 2 e v / a, each e times the last."""
        e, press = float(row["e"]), -float(row["press"])
        left = 2 * e * speed / (press * (1 - e)) if press > 0 and e < 1 else 0.0
        for body in (int(row["i"]), int(row["j"])):
            self.pending[body] = max(self.pending.get(body, 0.0), self.time + left)

    def _happen(self, code: int) -> None:
        """One event: marks what it changes, then settles."""
        self._count()
        self.world = copied(self.world)
        if code == HAPPENED:
            machine = self.modes[-1].machine
            de.accelerated(self.world.cells, machine.cells, self.time)
            # A copy: the machine's own rows tell what held until now.
            self.rows = machine.rows.copy()
            ha.happen(self.world, self.rows, machine.hit, self.pos, self.vel, self.tell, self.time)
        self._settle()

    def _count(self) -> None:
        """Counts an event of this moment. Raises TooMuch where they would never end."""
        self.lately = [when for when in self.lately if when > self.time - ENDLESS_TIME]
        self.lately.append(self.time)
        if self._at_once() > STUCK or len(self.lately) > ENDLESS:
            raise TooMuch
        if not self.patient and len(self.lately) > self.names.movable >= MANY:
            raise TooMuch

    def _at_once(self) -> int:
        """How many events there have been at this moment."""
        return sum(when > self.time - 1e-12 for when in self.lately)

    def _crawls(self) -> bool:
        """Whether so many steps went no way at all: more would not end."""
        before = self.record.count - CRAWL
        return before >= 0 and self.time - float(self.record.spans[before, 0]) < CRAWL_TIME

    def _stop(self) -> None:
        """A formula has no value: names it. Raises TooMuch where there is no formula: then it is the contacts that
        have no answer."""
        if not len(self.world.spans):
            raise TooMuch
        self.stopped = True
        self.tell.stopped(self.time, self.world, self.pos, self.vel, self.step)

    def _try_sleep(self) -> None:
        """Sleeps where nothing moves, nothing pulls, and nothing depends on time (row E2)."""
        if not self.names.timeless:
            return
        n = self.names.movable
        machine = self.modes[-1].machine
        lively = liveliest(machine.cells, CALM, self.moved)
        if not at_rest(lively, self.record, n, self.time, None if self.pending else self.start):
            return
        machine.y[3 * n : 6 * n] = 0.0
        machine.slopes[0] = 0.0
        self.vel[:n] = 0.0
        self.asleep = True
        for i in np.flatnonzero(self.moved):
            self.tell.rests(max(self.time, self.pending.get(int(i), 0.0)), int(i))
        self.moved[:] = False
