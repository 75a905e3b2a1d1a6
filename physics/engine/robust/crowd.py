"""The working memory of robust mode: arrays that its kernels read and write, step after step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.manifold import REALS, WHOLES
from physics.engine.robust.memory import BARS, BLOCKS, EVENT, LAYOUT
from physics.engine.rows import CORD, GIVEN, PIN_X, PIN_Y, POINT, ROW
from physics.engine.world import PIN, WIRE, Names, Table, World
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]


class Crowd(NamedTuple):
    """pos, vel: poses now, velocities half a substep ago; acc: of the last kick; now: velocities now; before:
    velocities before an impact; shift: what impacts within the substep add to the way; place: poses at an
    impact; all (bodies + 1, 3)."""

    pos: FloatArray
    vel: FloatArray
    acc: FloatArray
    now: FloatArray
    before: FloatArray
    start: FloatArray
    shift: FloatArray
    place: FloatArray
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
    cells: FloatArray
    """The memory that all of these are views of (physics.engine.robust.memory)."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled as its tables, which are views of one memory again when they are read."""
        return gathered, (self[:-1],)


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
    struck: FloatArray
    """(records, bodies + 1): how long after the record each body was struck, s; −1: not before the next."""
    jump: FloatArray
    """(records, bodies + 1, 3): by how much that changed its velocity."""
    wound: FloatArray
    """(records, links): how far wires were wound about their pulleys, rad."""


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

    arrays: tuple[NDArray[Any], ...] = (
        pos,
        vel,
        flat(),
        vel,
        flat(),
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
        ledger,
        np.zeros(1),
        np.array([0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0], np.int64),
        np.zeros((64, EVENT)),
    )
    return gathered(arrays)


def gathered(arrays: Sequence[NDArray[Any]]) -> Crowd:
    """A crowd of copies of these arrays (the fields of `Crowd` but the last), in one piece of memory."""
    named: dict[str, NDArray[Any]] = dict(zip(BLOCKS, arrays, strict=True))
    plan = LAYOUT.plan(
        len(named["pos"]),
        len(named["order"]),
        named["real"].shape[1],
        len(named["near"]),
        len(named["touching"]),
        len(named["rows"]),
        len(named["asked"]),
        len(named["ledger"]),
        len(named["events"]),
    )
    return Crowd._make(plan.filled(arrays))


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
            row["length"], row["feature"], row["wound"] = link["rest"], link["over"], link["wound"]
            row["ri"] = 0.0 if link["over"] < 0 else world.radius[link["over"]]
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
