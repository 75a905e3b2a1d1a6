"""Exact mode: one cluster of bodies from event to event.

    run = ExactRun(world, names, pos, vel, time, accuracy)
    run.advance(until); run.states(times); run.observe(times)

Between events the rows that hold stay the same and the motion is smooth (flow.py); at an event the
bodies' contacts are found anew, impacts are struck (strike.py), and it is decided which rows hold next
(decide.py). Frame: SI units, y up.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.acts import Act
from physics.engine.exact import decide as de
from physics.engine.exact import flow as fl
from physics.engine.exact import strike as st
from physics.engine.exact.explain import explain, follow_frames, sample
from physics.engine.exact.integrate import projected
from physics.engine.exact.machine import FIRST, POWERS, H, Machine, T, machine_of
from physics.engine.exact.solve import LARGEST, system_of
from physics.engine.exact.tell import Teller
from physics.engine.exact.touch import TOUCHING, all_touching
from physics.engine.forces import clearance_at, length_at
from physics.engine.rows import (
    CORD,
    GIVEN,
    OFF,
    ON,
    PIN_X,
    PIN_Y,
    POINT,
    ROW,
    SLIDE,
    STICK,
    refresh_table,
)
from physics.engine.world import PIN, WIRE, Names, Table, World, copied
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
STUCK = 40
"""Events at one moment after which exact mode gives up."""
LARGE = 64
"""Contacts at once beyond which exact mode gives up in favour of robust mode: the time to decide which of
them hold grows with their cube."""
CALM = 1e-7
"""m/s and m/s²: a cluster whose smoothed motion and accelerations are below it sleeps."""
SOLVED = 1e-12
"""m/s and m/s²: velocities and accelerations below it are zero but for rounding, and need no smoothing."""
SMOOTHED = 20
"""Frames of 1/60 s of which the smoothed motion keeps a trace above rounding (0.2 to the 20th)."""
RATTLE = 12
"""Events within `CROWD_TIME` after which a rebound must rise ten times as high as before to be one."""
SLUGGISH = 3e-2
"""m/s: what opens faster is never held shut, unless it was hit."""
CARRIED = ("status", "grip", "sigma", "shut")
"""What a row keeps from one moment to the next."""


class TooMuch(ArithmeticError):
    """Exact mode cannot go on from here; robust mode can."""


@dataclass(slots=True)
class Mode:
    """A stretch in which the same rows hold: its tables, and the steps recorded in it."""

    world: World
    machine: Machine
    start: float
    spans: list[FloatArray] = field(default_factory=list[FloatArray])
    dense: list[FloatArray] = field(default_factory=list[FloatArray])


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
        ledger: FloatArray | None = None,
    ) -> None:
        self.world, self.names, self.accuracy = world, names, accuracy
        self.time = self.start = time
        self.pos, self.vel = pos.copy(), vel.copy()
        count = 1 + sum(len(t) for t in (world.pushes, world.links, world.supports, world.courses))
        self.works = np.zeros(count) if ledger is None else ledger.copy()
        self.step = FIRST
        self.stopped = self.asleep = False
        self.events: list[Event] = []
        self.modes: list[Mode] = []
        self.tell = Teller(names, self.events)
        self.rows = np.zeros(0, ROW)
        self.lately: list[float] = []
        self.pending: dict[int, float] = {}
        self.moved = np.zeros(names.movable, bool)

    def advance(self, until: float) -> None:
        """Goes on until `time` is `until` or later, or the run has stopped."""
        if not self.modes:
            self._separate()
            self._settle()
        while self.time < until and not self.stopped:
            if self.asleep:
                self._lie(until)
                return
            mode = self.modes[-1]
            code = fl.flow(mode.world.cells, mode.machine.cells, until, self.accuracy)
            self._keep(mode)
            if code in (fl.HAPPENED, fl.MET, fl.SWITCHED):
                self._happen(code)
            elif code == fl.STOPPED:
                self._stop()
            elif code == fl.CRAWLS and not self.names.timeless:
                # A formula that grows without bound, as 1/(t − 1) does.
                self._stop()
            elif code == fl.CRAWLS:
                raise TooMuch
            else:
                self._try_sleep()

    def cut(self, time: float) -> None:
        """Forgets what happened after `time`; nothing can follow but reading what is left."""
        self.events[:] = [event for event in self.events if event.time <= time]
        self.modes = [mode for mode in self.modes if mode.start <= time]
        self.world = self.modes[-1].world
        self.time = time

    def states(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Poses and velocities, (T, bodies + 1, 3), at ascending times."""
        y = self._sampled(times)
        n = self.names.movable
        pos = np.broadcast_to(self.pos, (len(times), *self.pos.shape)).copy()
        vel = np.zeros_like(pos)
        pos[:, :n] = y[:, : 3 * n].reshape(-1, n, 3)
        vel[:, :n] = y[:, 3 * n : 6 * n].reshape(-1, n, 3)
        if self.stopped:
            # At the very moment at which a formula has no value, neither has the rate of what it drives.
            np.nan_to_num(vel, copy=False, nan=0.0, posinf=0.0, neginf=0.0)
        if len(self.world.courses):
            follow_frames(self.modes, times, pos, vel)
        return pos, vel

    def ledger(self, times: FloatArray) -> FloatArray:
        """Heat and works, (T, entries) J, at ascending times."""
        return self._sampled(times)[:, 6 * self.names.movable :]

    def observe(self, times: FloatArray) -> tuple[list[Act], FloatArray]:
        """(forces, accelerations (T, bodies + 1, 3)) at ascending times."""
        return explain(self.modes, self.names, times, self._sampled(times))

    def _sampled(self, times: FloatArray) -> FloatArray:
        if not any(mode.spans for mode in self.modes):
            return np.broadcast_to(self._packed(), (len(times), len(self._packed()))).copy()
        return sample(self.modes, times)

    def _packed(self) -> FloatArray:
        n = self.names.movable
        return np.concatenate([self.pos[:n].ravel(), self.vel[:n].ravel(), self.works])

    def _keep(self, mode: Mode) -> None:
        """Takes away what was recorded, and the state that was reached."""
        machine, n = mode.machine, self.names.movable
        steps = int(machine.recorded[0])
        if steps:
            mode.spans.append(machine.spans[:steps].copy())
            mode.dense.append(machine.record[:steps].copy())
        self.pos[:n] = machine.y[: 3 * n].reshape(n, 3)
        self.vel[:n] = machine.y[3 * n : 6 * n].reshape(n, 3)
        self.works = machine.y[6 * n :].copy()
        self.time, self.step = float(machine.clock[T]), float(machine.clock[H])

    def _machine(self, rows: Table) -> Machine:
        """The machine for these rows, in the state of this moment."""
        world, n = self.world, len(rows)
        system = system_of(rows, world.inverse)
        if len(system.row) > LARGEST:
            raise TooMuch
        counts = {
            "programs": len(world.spans),
            "pairs": len(world.pairs),
            "watched": 3 * n + len(world.links) + 2 * len(world.supports),
            "ledger": len(self.works),
            "movable": self.names.movable,
        }
        clock = np.array([self.time, self.step, 1.0, -1.0])
        return machine_of(rows, system, counts, self.pos, self.vel, self._packed(), clock)

    def _separate(self) -> None:
        """Moves bodies apart that overlap at the start."""
        separate(self.world, self.pos, self.vel, self.tell, self.time)

    def _touching(self) -> Table:
        """Every contact, refreshed."""
        return _touching(self.world, self.pos, self.vel)

    def _settle(self) -> None:
        """Finds what touches, strikes what meets, decides what holds, and starts a new mode."""
        rows = self._gathered()
        self._strike(rows)
        rows = rows[~((rows["kind"] <= POINT) & (rows["rate"] > st.APPROACH))]
        try:
            machine = de.decide(self.world, rows, self._machine, self.time)
        except de.Undecided as undecided:
            self._unjam(rows, undecided.jam)
            self._settle()
            return
        if projected(self.world.cells, machine.cells):
            self._adopt(machine)
            machine = self._machine(rows)
            de.accelerated(self.world.cells, machine.cells, self.time)
        gone = np.zeros(len(rows))
        de.leaving(self.world.cells, machine.cells, gone)
        if gone.any():
            rows = rows[gone == 0]
            machine = self._machine(rows)
            de.accelerated(self.world.cells, machine.cells, self.time)
        if self._break_overloaded(machine):
            self._settle()
            return
        if machine.status[0]:
            self.tell.open_forces(self.time, self.world, machine.rows)
        self.rows = machine.rows
        self._begin(machine)

    def _break_overloaded(self, machine: Machine) -> bool:
        """Breaks wires that would have to carry more than they can; whether there were any."""
        limits = self.world.links["limit"]
        rows = machine.rows
        over = [
            row
            for row in rows[(rows["kind"] == CORD) & (rows["status"] == ON)]
            if row["force"] > limits[row["source"]] * (1 + 1e-12)
        ]
        for row in over:
            self._row_event(row, 2)
        self.rows = rows
        return bool(over)

    def _adopt(self, machine: Machine) -> None:
        n = self.names.movable
        self.pos[:n] = machine.y[: 3 * n].reshape(n, 3)
        self.vel[:n] = machine.y[3 * n : 6 * n].reshape(n, 3)

    def _begin(self, machine: Machine) -> None:
        self.modes.append(Mode(self.world, machine, self.time))
        if not fl.begin(self.world.cells, machine.cells):
            self._stop()
            return
        self._try_sleep()

    def _gathered(self) -> Table:
        """All rows of this moment, each as it was where it was there before."""
        before = {(int(r["kind"]), int(r["source"]), int(r["feature"])): r for r in self.rows}
        contacts, standing = self._touching(), _standing_rows(self.world)
        rows = np.concatenate([contacts, standing]) if len(standing) else contacts
        refresh_table(rows, self.pos, self.vel)
        for row in rows:
            known = before.get((int(row["kind"]), int(row["source"]), int(row["feature"])))
            if row["kind"] >= PIN_X:
                row["status"] = ON
            if known is not None:
                for name in CARRIED:
                    row[name] = known[name]
            elif row["kind"] <= CORD:
                row["status"] = ON if row["gap"] <= TOUCHING else OFF
                de.take_grip(row)
            elif row["kind"] == GIVEN:
                de.take_grip(row)
        return rows

    def _strike(self, rows: Table) -> None:
        """Impacts of this moment, if there are any: changes velocities, and what rows are."""
        closed = (rows["gap"] <= TOUCHING) & (rows["kind"] < GIVEN)
        approach = closed & (rows["kind"] <= CORD) & (rows["rate"] < -st.APPROACH)
        pins = (rows["kind"] >= PIN_X) & (rows["kind"] < GIVEN) & (np.abs(rows["rate"]) > st.APPROACH)
        struck = np.zeros(len(rows))
        lately = sum(when > self.time - CROWD_TIME for when in self.lately)
        # A wire and a floor may hand a body to and fro for ever: the faster they do, the higher it must rise.
        rise = st.RISE * 10.0 ** min(lately // RATTLE, 4)
        if approach.any() or pins.any():
            for row in rows[approach & (rows["kind"] <= POINT)]:
                self._release(int(row["i"]))
                self._release(int(row["j"]))
            self._press(rows, approach)
            rows["shut"] = 0
            self.works[0] += st.strike(
                self.world.cells,
                rows,
                self.pos,
                self.vel,
                rise,
                lately > CROWD,
                np.zeros_like(self.vel),
                struck,
            )
            self.tell.impacts(self.time, rows, struck)
        if not self._hold(rows, closed & (rows["kind"] <= CORD), rise) and not (approach.any() or pins.any()):
            return
        for k in np.flatnonzero(closed & (rows["kind"] == CORD)):
            row = rows[k]
            if row["status"] == OFF and approach[k]:
                self.tell.wire(self.time, "taut", row)
            row["status"] = ON if row["rate"] <= st.APPROACH else OFF
        for k in np.flatnonzero(rows["kind"] <= POINT):
            rows[k]["status"] = ON
            de.take_grip(rows[k])
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
            self.works[0] += st.hold(self.world.cells, rows, self.pos, self.vel, rise)
            before, held = held, rows["bound"] == st.HELD
            if np.array_equal(before, held):
                break
        return bool(held.any())

    def _press(self, rows: Table, free: BoolArray) -> None:
        """Notes how the gaps of rows accelerate while some of them do not hold."""
        without = rows.copy()
        without["status"][free] = OFF
        machine = self._machine(without)
        de.accelerated(self.world.cells, machine.cells, self.time)
        de.pressing(machine.cells)
        rows["press"] = machine.rows["press"]

    def _unjam(self, rows: Table, jam: int) -> None:
        """Stops the slip that no forces can go with. Raises TooMuch where that is not what is wrong."""
        heat = st.unjam(self.world.cells, rows, self.pos, self.vel, jam) if jam >= 0 else np.nan
        if not heat >= 0:
            raise TooMuch
        self._count()
        self.works[0] += heat
        for row in rows[rows["kind"] <= POINT]:
            de.take_grip(row)
        self.rows = rows

    def _note_shut(self, row: Any, speed: float) -> None:
        """When the rebounds that are left out would have ended: flights of 2 e v / a, each e times the last."""
        e, press = float(row["e"]), -float(row["press"])
        left = 2 * e * speed / (press * (1 - e)) if press > 0 and e < 1 else 0.0
        for body in (int(row["i"]), int(row["j"])):
            self.pending[body] = max(self.pending.get(body, 0.0), self.time + left)

    def _release(self, body: int) -> None:
        """A body that collides leaves its course (row M8)."""
        for k, course in enumerate(self.world.courses):
            if course["body"] == body and course["on"]:
                course["on"] = 0
                axis = int(course["axis"])
                self.world.inverse[body, axis] = 1.0 / self.world.mass[body, axis]
                self.tell.released(self.time, body, self.names.courses[k])

    def _happen(self, code: int) -> None:
        """One event: marks what it changes, then settles."""
        self._count()
        self.world = copied(self.world, self.names.movable)
        if code == fl.HAPPENED:
            machine = self.modes[-1].machine
            de.accelerated(self.world.cells, machine.cells, self.time)
            # A copy: the machine's own rows tell what held until now.
            self.rows = machine.rows.copy()
            rows, links = 3 * len(self.rows), len(self.world.links)
            for k in np.flatnonzero(machine.hit):
                if k < rows:
                    self._row_event(self.rows[k // 3], int(k % 3))
                elif k < rows + links:
                    self._break_given(int(k) - rows)
                else:
                    self._support_event(*divmod(int(k) - rows - links, 2))
        self._settle()

    def _count(self) -> None:
        """Counts an event of this moment. Raises TooMuch where they would never end."""
        self.lately = [when for when in self.lately if when > self.time - ENDLESS_TIME]
        self.lately.append(self.time)
        if sum(when > self.time - 1e-12 for when in self.lately) > STUCK or len(self.lately) > ENDLESS:
            raise TooMuch

    def _row_event(self, row: Any, which: int) -> None:
        if which == 0 and row["status"] == ON:
            row["status"] = OFF
            if row["kind"] == CORD:
                self.tell.wire(self.time, "slack", row)
        elif which == 1 and row["grip"] == STICK:
            row["grip"], row["sigma"] = SLIDE, -np.sign(row["rub"])
        elif which == 1:
            row["grip"] = STICK
        elif which == 2 and row["kind"] == CORD:
            self.world.links[row["source"]]["broken"] = 1
            self.tell.broken(self.time, int(row["source"]), f"it would have to carry {row['force']:.4g} N")

    def _break_given(self, k: int) -> None:
        link = self.world.links[k]
        off = float(length_at(self.world.cells, k, self.pos)) - float(link["rest"])
        link["broken"] = 1
        change = "longer" if off > 0 else "shorter"
        self.tell.broken(self.time, k, f"{abs(off):.3g} m {change} than drawn, under the tension given")

    def _support_event(self, k: int, which: int) -> None:
        """A body under a given normal force leaves its edge, sinks in and is struck back, or rises."""
        support = self.world.supports[k]
        i, j = int(support["i"]), int(support["j"])
        if which == 0:
            support["over"] = 0
            return
        gap, rate, nx, ny = clearance_at(self.world.cells, k, self.pos, self.vel)
        if gap > 0:
            support["risen"] = 1
            self.tell.risen(self.time, k, i, j)
            return
        # Struck back without loss, on the centres of mass: twice what stops it.
        inverse = self.world.inverse[:, 0]
        give = inverse[i] + inverse[j]
        blow = -2 * rate / give if give and rate < 0 else 0.0
        for body, sign in ((i, 1.0), (j, -1.0)):
            self.vel[body, 0] += sign * blow * nx * inverse[body]
            self.vel[body, 1] += sign * blow * ny * inverse[body]
        self.tell.sunk(self.time, k, i, j)

    def _stop(self) -> None:
        """A formula has no value: names it."""
        self.stopped = True
        self.tell.stopped(self.time, self.world, self.pos, self.vel, self.step)

    def _try_sleep(self) -> None:
        """Sleeps where nothing moves, nothing pulls, and nothing depends on time (row E2)."""
        n = 3 * self.names.movable
        machine = self.modes[-1].machine
        rates = np.abs(machine.slopes[0, : 2 * n])
        self.moved |= rates[:n].reshape(-1, 3).max(axis=1, initial=0.0) > CALM
        still = rates.max(initial=0.0)
        if not self.names.timeless or still > CALM or (still > SOLVED and self._smoothed() > CALM**2):
            return
        machine.y[n : 2 * n] = 0.0
        machine.slopes[0] = 0.0
        self.vel[: self.names.movable] = 0.0
        self.asleep = True
        for i in np.flatnonzero(self.moved):
            self.tell.rests(max(self.time, self.pending.get(int(i), 0.0)), int(i))
        self.moved[:] = False

    def _smoothed(self) -> float:
        """The greatest smoothed motion of any body, (m/s)²: frame = ‖v‖² + ω², net ← 0.2 net + 0.8 frame."""
        times = self.time - np.arange(SMOOTHED) / 60.0
        times = times[times > max(self.start, max(self.pending.values(), default=self.start))][::-1]
        if len(times) == 0 or self.pending:
            return 0.0
        n = self.names.movable
        speeds = self._sampled(times)[:, 3 * n : 6 * n].reshape(len(times), n, 3)
        net = np.zeros(n)
        for frame in (speeds**2).sum(axis=2):
            net = 0.2 * net + 0.8 * frame
        return float(net.max(initial=0.0))

    def _lie(self, until: float) -> None:
        """Stays as it is."""
        mode = self.modes[-1]
        mode.spans.append(np.array([[self.time, until]]))
        dense = np.zeros((1, POWERS, len(mode.machine.y)))
        dense[0, 0] = mode.machine.y
        mode.dense.append(dense)
        self.time = until


def separate(world: World, pos: FloatArray, vel: FloatArray, tell: Teller, time: float) -> None:
    """Moves bodies apart that overlap, changing pos, and tells so. Raises TooMuch where that does not end."""
    met: set[tuple[int, int]] = set()
    for _ in range(400):
        rows = _touching(world, pos, vel)
        overlapping = rows[rows["gap"] < -TOUCHING]
        met |= {(min(row["i"], row["j"]), max(row["i"], row["j"])) for row in overlapping}
        if st.overlap(world.cells, rows, pos) <= 0.5 * TOUCHING:
            break
    else:
        if met:
            raise TooMuch
    for i, j in sorted(met):
        tell.separated(time, int(i), int(j))


def _touching(world: World, pos: FloatArray, vel: FloatArray) -> Table:
    """Every contact, refreshed. Raises TooMuch where there are more than exact mode can decide."""
    pairs = len(world.pairs)
    room = np.zeros(4 * pairs + 4 if pairs < 4 * LARGE else 16 * LARGE, ROW)
    n = int(all_touching(world.cells, pos, vel, TOUCHING, room))
    if n < 0 or n > LARGE:
        raise TooMuch
    return room[:n].copy()


def _standing_rows(world: World) -> Table:
    """Rows of wires, pins, and slips under given normal forces: those that are there whatever touches."""
    made: list[Any] = []
    for k, link in enumerate(world.links):
        if link["broken"] or (link["kind"] == WIRE and link["tension"] >= 0):
            continue
        kinds = (CORD,) if link["kind"] == WIRE else (PIN_X, PIN_Y) if link["kind"] == PIN else ()
        for kind in kinds:
            row = np.zeros(1, ROW)[0]
            row["kind"], row["i"], row["j"], row["source"] = kind, link["i"], link["j"], k
            for name in ("ax", "ay", "bx", "by"):
                row[name] = link[name]
            row["length"], row["unique"], row["feature"] = link["rest"], 1, -1
            if kind == CORD and link["over"] >= 0:
                row["feature"], row["sigma"], row["ri"] = (
                    link["over"],
                    link["sense"],
                    world.radius[link["over"]],
                )
            made.append(row)
    for k, support in enumerate(world.supports):
        if support["over"] and support["mu"] > 0:
            row = np.zeros(1, ROW)[0]
            row["kind"], row["i"], row["j"], row["source"] = GIVEN, support["j"], support["i"], k
            row["ax"], row["ay"], row["nx0"], row["ny0"] = (
                support[name] for name in ("ax", "ay", "nx", "ny")
            )
            row["rj"], row["length"], row["mu"] = world.radius[support["i"]], support["length"], support["mu"]
            row["status"], row["grip"], row["unique"] = ON, STICK, 1
            made.append(row)
    return np.array(made, ROW) if made else np.zeros(0, ROW)
