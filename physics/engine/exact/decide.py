"""Which rows hold: the complementarity problem of contacts, friction and wires, by an active set.

At the level of accelerations: a contact presses or opens, never both; it sticks while friction can hold
it, and otherwise slips against its friction. One row changes at a time, the one that is most wrong,
until none is. Sources: Baraff (1994), Fast contact force computation; Featherstone (2008), ch. 11.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from math import prod
from typing import Any

import numpy as np

from physics.engine.cells import head
from physics.engine.exact.integrate import unpack
from physics.engine.exact.machine import MACHINE, Machine, accelerations, poses, row_of, state, velocities
from physics.engine.exact.solve import NORMAL, TANGENT, accelerate, demand
from physics.engine.exact.touch import TOUCHING
from physics.engine.rows import CORD, FREE, GIVEN, OFF, ON, POINT, SLIDE, STICK
from physics.engine.tables import WORLD, gravity, masses
from physics.engine.world import IntArray, Table, World
from physics.jit import kernel, part
from sketch.ink import FloatArray

SLOW = 1e-8
"""m/s: a slower rate or slip is none."""
FORCE = 1e-10
"""Share of the greatest force by which a force may be wrong."""
WEAK = 1e-9
"""Share of the greatest acceleration by which an acceleration may be wrong."""
TRIES = 60
"""Changes of the set, for each row, before the worst one first gives way to the first one first."""

SETS = 1024
"""Sets of rows that are all tried where changing one at a time finds no end: five contacts at rest with friction."""

CLOSE, OPEN, SLIP, HOLD = 1, 2, 3, 4


class Undecided(ArithmeticError):
    """No set of rows was found that fits: more contacts, or tighter jams, than this method is made for.

    jams: rows (numbers) that slip, the likeliest first: one of them may be such as can neither hold nor leave, as in
    Painlevé's paradox: its friction would press it the harder the more it is pressed.
    """

    def __init__(self, jams: tuple[int, ...]) -> None:
        super().__init__()
        self.jams = jams


def decide(world: World, rows: Table, make: Callable[[Table], Machine], time: float) -> Machine:
    """Sets status and grip of all rows so that forces and accelerations agree; the machine that does it.

    Rows come with a guess: contacts and wires that hold now, and those that no longer do. make: the machine
    for rows as they are, in the state of this moment. Raises Undecided.
    """
    guess = rows.copy()
    machine, last = _changed_in_turn(world, rows, make, time)
    if machine is None:
        rows[:] = guess
        machine = _tried_all(world, rows, make, time)
    if machine is None:
        slips = np.flatnonzero((rows["kind"] <= POINT) & (np.abs(rows["slip"]) > SLOW) & (rows["mu"] > 0.0))
        slowest = slips[np.argsort(np.abs(rows["slip"][slips]), kind="stable")].tolist()
        raise Undecided(tuple(sorted(slowest, key=lambda k: k != last)))
    return machine


def _changed_in_turn(
    world: World, rows: Table, make: Callable[[Table], Machine], time: float
) -> tuple[Machine | None, int]:
    """Changes one row at a time until all agree; None, and the row that was changed last, where that does not end."""
    seen: set[bytes] = set()
    change = np.zeros(2, np.int64)
    orderly = False
    k = -1
    for _ in range(TRIES + 4 * len(rows)):
        machine = make(rows)
        accelerated(world.cells, machine.cells, time)
        wrong(world.cells, machine.cells, orderly, change)
        k, what = int(change[0]), int(change[1])
        if what == 0:
            return machine, k
        row, found = rows[k], machine.rows[k]
        if what == CLOSE:
            row["status"] = ON
            take_grip(machine.rows, k)
            row["grip"], row["sigma"] = found["grip"], found["sigma"]
            _join_partner(rows, row)
        elif what == OPEN:
            row["status"] = OFF
        elif what == SLIP:
            row["grip"], row["sigma"] = SLIDE, -np.sign(found["rub"])
        else:
            row["grip"] = STICK
        state = rows["status"].tobytes() + rows["grip"].tobytes() + np.sign(rows["sigma"]).tobytes()
        if state in seen:
            if orderly:
                break
            orderly = True
            seen.clear()
        seen.add(state)
    return None, k


def _tried_all(world: World, rows: Table, make: Callable[[Table], Machine], time: float) -> Machine | None:
    """The first set of rows that agrees, of all that there are; None where none does, or there are too many."""
    free = np.flatnonzero((rows["kind"] <= CORD) | (rows["kind"] == GIVEN)).tolist()
    ways = [_ways(rows[k]) for k in free]
    if prod(map(len, ways)) > SETS:
        return None
    change = np.zeros(2, np.int64)
    for chosen in product(*ways):
        for k, way in zip(free, chosen, strict=True):
            rows[k]["status"], rows[k]["grip"], rows[k]["sigma"] = way
        machine = make(rows)
        accelerated(world.cells, machine.cells, time)
        wrong(world.cells, machine.cells, True, change)
        if change[1] == 0:
            return machine
    return None


def _ways(row: Any) -> list[tuple[int, int, float]]:
    """Every (status, grip, sigma) that a row may have as it goes now."""
    sigma = float(np.sign(row["slip"]))
    if row["kind"] == CORD or row["mu"] <= 0.0:
        grips = [(FREE, 0.0)]
    elif abs(row["slip"]) > SLOW:
        grips = [(SLIDE, sigma)]
    else:
        grips = [(STICK, 0.0), (SLIDE, 1.0), (SLIDE, -1.0)]
    held = [(ON, grip, sense) for grip, sense in grips]
    if row["kind"] == GIVEN:
        return held
    away = (OFF, *grips[0])
    closed = row["gap"] <= TOUCHING and row["rate"] <= SLOW
    return [*held, away] if closed else [away]


def _join_partner(rows: Table, row: Any) -> None:
    """A contact that closes beside one of the same pair that is about to slip, slips with it: two corners of one
    side cannot do otherwise."""
    same = (rows["source"] == row["source"]) & (rows["kind"] <= POINT) & (rows["status"] == ON)
    for other in rows[same & (rows["grip"] == SLIDE) & (np.abs(rows["slip"]) <= SLOW)]:
        if row["grip"] == STICK:
            row["grip"], row["sigma"] = SLIDE, other["sigma"]


@part
def grip_of(row: Any) -> None:
    """The grip that a contact's slip says it has: it slips, or is held until friction turns out too weak."""
    if row.mu <= 0.0 or row.kind == CORD:
        row.grip = FREE
    elif abs(row.slip) > SLOW:
        row.grip, row.sigma = SLIDE, np.sign(row.slip)
    else:
        row.grip = STICK


@kernel
def take_grip(rows: Table, k: int) -> None:
    """`grip_of` for row k of a table of its own."""
    grip_of(rows[k])


@kernel
def accelerated(cells: FloatArray, memory: FloatArray, t: float) -> None:
    """Accelerations and forces of the machine's state."""
    w, m = head(cells, WORLD), head(memory, MACHINE)
    unpack(state(m), m.movable, poses(m), velocities(m))
    accelerate(w, m, t)


@part
def quickest(w: Any, m: Any) -> float:
    """The greatest acceleration about, m/s²."""
    most = max(1e-12, abs(gravity(w)[0]), abs(gravity(w)[1]))
    acc = accelerations(m)
    for i in range(m.movable):
        for a in range(2):
            most = max(most, abs(acc[i, a]))
    for k in range(m.rows):
        most = max(most, abs(row_of(m, k).c))
    return most


@kernel
def wrong(cells: FloatArray, memory: FloatArray, orderly: bool, change: IntArray) -> None:
    """change ← (the row that is most wrong, or, orderly, the first that is; what mends it, 0: none is)."""
    w, m = head(cells, WORLD), head(memory, MACHINE)
    mass, g, acc = masses(w), gravity(w), accelerations(m)
    greatest = 1e-12
    for i in range(m.movable):
        for a in range(2):
            greatest = max(greatest, mass[i, a] * abs(g[a]))
    for k in range(m.rows):
        greatest = max(greatest, abs(row_of(m, k).force))
    swift = quickest(w, m)
    worst = 1.0
    change[1] = 0
    for k in range(m.rows):
        row = row_of(m, k)
        size = 0.0
        what = 0
        if row.status == OFF:
            if row.kind <= CORD and row.gap <= TOUCHING and row.rate <= SLOW:
                size, what = -demand(row, NORMAL, acc) / (WEAK * swift), CLOSE
        else:
            if row.kind <= CORD:
                size, what = -row.force / (FORCE * greatest), OPEN
                if row.grip == STICK and row.kind != CORD and abs(row.rub) > FORCE * greatest:
                    # It may pull only because it may not slip.
                    what = SLIP
            if row.grip != FREE and row.kind != CORD and size <= 1.0:
                bound = row.bound if row.kind == GIVEN else row.mu * row.force
                if row.grip == STICK:
                    size, what = (abs(row.rub) - bound) / (FORCE * greatest), SLIP
                elif abs(row.slip) <= SLOW:
                    size, what = -row.sigma * demand(row, TANGENT, acc) / (WEAK * swift), HOLD
        if size > worst and not (orderly and change[1] != 0):
            worst = size
            change[0], change[1] = k, what


@kernel
def pressing(memory: FloatArray) -> None:
    """Notes for every row how its gap accelerates as things are: below zero, it is pressed shut."""
    m = head(memory, MACHINE)
    for k in range(m.rows):
        row = row_of(m, k)
        row.press = demand(row, NORMAL, accelerations(m))


@kernel
def leaving(cells: FloatArray, memory: FloatArray, gone: FloatArray) -> None:
    """gone (rows,) ← 1 for contacts that hold no longer and are about to open: they need not be kept."""
    w, m = head(cells, WORLD), head(memory, MACHINE)
    swift = quickest(w, m)
    for k in range(m.rows):
        row = row_of(m, k)
        gone[k] = 0.0
        idle = row.kind <= POINT and row.status == OFF
        if idle and (row.rate > SLOW or demand(row, NORMAL, accelerations(m)) > WEAK * swift):
            gone[k] = 1.0
