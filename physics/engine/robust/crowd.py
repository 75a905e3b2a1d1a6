"""The working memory of robust mode: arrays that its kernels read and write, step after step."""

from __future__ import annotations

from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.manifold import REALS, WHOLES
from physics.engine.robust.rows import CORD, GIVEN, PIN_X, PIN_Y, POINT, ROW
from physics.engine.world import PIN, WIRE, Names, Table, World
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

CONTACTS, PAIRS, EVENTS, RECORDS, PRESSED, NEEDS, DONE, STOPPED, STILL, SWEPT = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
"""Columns of `tally`: contacts; pairs that are near; events, records and recorded contact forces; what must
grow; substeps done; the program without a value (−1: none); substeps without any motion; whether the pairs
were ever swept."""

BUCKLED, GIVES, LEAST, MOST, GOAL, HEFT = 0, 1, 2, 3, 4, 5
"""Columns of `bars`, one line for each row of `rows`: whether its wire hangs slack; the greatest impulse of an
impact in this substep, N s; bounds of its impulse, N s; the rate wanted, m/s; the mass it meets, kg."""
IMPULSE, WHEN, ASIDE, ACTIVE, OLD, WAY, CLOSING = 6, 7, 8, 9, 10, 11, 12
"""Impulse; moment of an impact, s; impulse kept aside; taking part; impulse a round ago, and the direction in
which it goes on; how fast a wire tautens, m/s."""
BARS = 13

LAST = 0
"""Column of `reals`: length of the last kick, s."""

EVENT = 4
"""An event: time, kind, number, value."""

FORCE = 6
"""A recorded contact force: normal, friction, where it acts: on the pair's second body."""


class Crowd(NamedTuple):
    """pos, vel: poses now, velocities half a substep ago; acc: of the last kick; now: velocities now; before:
    velocities before an impact; shift: what impacts within the substep add to the way; all (bodies + 1, 3)."""

    pos: FloatArray
    vel: FloatArray
    acc: FloatArray
    now: FloatArray
    before: FloatArray
    start: FloatArray
    shift: FloatArray
    force: FloatArray
    total: FloatArray
    turns: FloatArray
    when: FloatArray
    """(bodies + 1,): moment within the substep of a body's last impact, s."""
    real: FloatArray
    whole: IntArray
    old_real: FloatArray
    old_whole: IntArray
    near: IntArray
    """(pairs near, 3): the pair, its first contact, how many."""
    seen: FloatArray
    """(pairs near, 5): relative place and both angles when its contacts were found; 1 once they were."""
    touching: IntArray
    """(pairs,): substep in which they last touched."""
    home: FloatArray
    room: FloatArray
    boxes: FloatArray
    order: IntArray
    table: IntArray
    rows: Table
    bars: FloatArray
    jacobian: FloatArray
    """(rows, 6)."""
    ends: IntArray
    """(rows, 2): their bodies."""
    asked: FloatArray
    """(given normal forces + courses,): sizes, N, and the next places, m, from the student's programs."""
    motion: FloatArray
    power: FloatArray
    ledger: FloatArray
    reals: FloatArray
    tally: IntArray
    events: FloatArray


class Record(NamedTuple):
    """What is kept: per record poses, velocities, accelerations (bodies + 1, 3), ledger, forces of rows, and
    up to where `forces` and `pairs` hold its contacts' forces."""

    pos: FloatArray
    vel: FloatArray
    acc: FloatArray
    ledger: FloatArray
    pulls: FloatArray
    ends: IntArray
    forces: FloatArray
    pairs: NDArray[np.int32]


def crowd_of(world: World, names: Names, pos: FloatArray, vel: FloatArray, ledger: FloatArray) -> Crowd:
    """Working memory at the start, before anything was found or swept."""
    bodies, pairs = len(names.bodies), len(world.pairs)
    rows = rows_of(world)
    table = np.full((bodies, bodies), -1, np.int64)
    for name in ("i", "j"):
        other = "j" if name == "i" else "i"
        table[world.pairs[name], world.pairs[other]] = np.arange(pairs)

    def flat() -> FloatArray:
        return np.zeros((bodies + 1, 3))

    return Crowd(
        pos.copy(),
        vel.copy(),
        flat(),
        vel.copy(),
        flat(),
        flat(),
        flat(),
        flat(),
        flat(),
        np.ones((bodies + 1, 2)),
        np.zeros(bodies + 1),
        *contact_room(16),
        *near_room(8),
        np.full(pairs, -1, np.int64),
        flat(),
        np.zeros(bodies + 1),
        np.zeros((bodies, 4)),
        np.arange(bodies),
        table,
        rows,
        np.zeros((len(rows), BARS)),
        np.zeros((len(rows), 6)),
        np.stack([rows["i"], rows["j"]], 1),
        np.zeros(len(world.supports) + len(world.courses)),
        np.full(bodies, np.inf),
        np.zeros(len(ledger)),
        ledger.copy(),
        np.zeros(1),
        np.array([0, 0, 0, 0, 0, 0, 0, -1, 0, 0], np.int64),
        np.zeros((64, EVENT)),
    )


def contact_room(pairs: int) -> tuple[FloatArray, IntArray, FloatArray, IntArray]:
    """Tables for the contacts of that many near pairs, now and a moment ago."""
    many = 2 * pairs
    return (
        np.zeros((REALS, many)),
        np.zeros((WHOLES, many), np.int64),
        np.zeros((REALS, many)),
        np.zeros((WHOLES, many), np.int64),
    )


def near_room(pairs: int) -> tuple[IntArray, FloatArray]:
    """Tables for that many near pairs."""
    return np.zeros((pairs, 3), np.int64), np.zeros((pairs, 5))


def rows_of(world: World) -> Table:
    """Rows of wires and pins, and of the rubbing under given normal forces, which come last."""
    found: list[Table] = []
    for number in range(len(world.links)):
        link: Any = world.links[number]
        if link["kind"] == WIRE and link["tension"] < 0:
            row = _joint(CORD, number, link)
            row["length"], row["feature"], row["sigma"] = link["rest"], link["over"], link["sense"]
            found.append(row)
        elif link["kind"] == PIN:
            found += [_joint(PIN_X, number, link), _joint(PIN_Y, number, link)]
    for number in range(len(world.supports)):
        support: Any = world.supports[number]
        row = np.zeros((), ROW)
        row["kind"] = GIVEN if support["length"] > 0 else POINT
        row["i"], row["j"], row["source"] = support["j"], support["i"], number
        row["ax"], row["ay"], row["nx0"], row["ny0"] = (
            support["ax"],
            support["ay"],
            support["nx"],
            support["ny"],
        )
        row["ri"], row["rj"] = world.radius[support["j"]], world.radius[support["i"]]
        row["mu"] = support["mu"]
        found.append(row)
    return np.array(found, ROW) if found else np.zeros(0, ROW)


def _joint(kind: int, number: int, link: Any) -> Table:
    row = np.zeros((), ROW)
    row["kind"], row["source"], row["feature"] = kind, number, -1
    for name in ("i", "j", "ax", "ay", "bx", "by"):
        row[name] = link[name]
    return cast(Table, row)
