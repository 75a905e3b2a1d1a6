"""The working memory of robust mode as its kernels see it: one piece, headed by `MEMORY` (see
physics.engine.cells). The accessors are named after the fields of `physics.engine.robust.crowd.Crowd`, whose
arrays are views of the same memory; `m` is always its head. Bodies: the page, too, as the last.
"""

from __future__ import annotations

from typing import Any

from physics.engine.cells import Layout, grid, integer_grid, integers, line, record
from physics.engine.robust.manifold import REALS, WHOLES
from physics.engine.rows import ROW
from physics.jit import accessor
from sketch.ink import FloatArray

CONTACTS, PAIRS, EVENTS, RECORDS, PRESSED, NEEDS, DONE, STOPPED, STILL, SWEPT = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
"""Columns of `tally`: contacts; pairs that are near; events, records and recorded contact forces; what must
grow; substeps done; the program without a value (−1: none); substeps without any motion; whether the pairs
were ever swept."""
TALLY = 10

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


BLOCKS = (
    "pos",
    "vel",
    "acc",
    "now",
    "before",
    "start",
    "shift",
    "force",
    "total",
    "turns",
    "when",
    "real",
    "whole",
    "old_real",
    "old_whole",
    "near",
    "seen",
    "touching",
    "home",
    "room",
    "boxes",
    "order",
    "table",
    "rows",
    "bars",
    "jacobian",
    "ends",
    "asked",
    "motion",
    "power",
    "ledger",
    "reals",
    "tally",
    "events",
)
COUNTS = ("bodies", "columns", "near", "pairs", "rows", "asked", "entries", "events")
"""columns: contacts that there is room for; asked: given normal forces and courses; entries: of the ledger."""
LAYOUT = Layout(BLOCKS, COUNTS)
MEMORY = LAYOUT.head
_ROW = ROW.itemsize


@accessor
def pos_of(m: Any) -> FloatArray:
    """(bodies, 3) poses now."""
    return grid(m, m.pos_at, m.bodies, 3)


@accessor
def vel_of(m: Any) -> FloatArray:
    """(bodies, 3) velocities half a substep ago."""
    return grid(m, m.vel_at, m.bodies, 3)


@accessor
def acc_of(m: Any) -> FloatArray:
    """(bodies, 3) accelerations of the last kick."""
    return grid(m, m.acc_at, m.bodies, 3)


@accessor
def now_of(m: Any) -> FloatArray:
    """(bodies, 3) velocities now."""
    return grid(m, m.now_at, m.bodies, 3)


@accessor
def before_of(m: Any) -> FloatArray:
    """(bodies, 3) velocities before an impact."""
    return grid(m, m.before_at, m.bodies, 3)


@accessor
def start_of(m: Any) -> FloatArray:
    """(bodies, 3) velocities at the start of the substep."""
    return grid(m, m.start_at, m.bodies, 3)


@accessor
def shift_of(m: Any) -> FloatArray:
    """(bodies, 3) what impacts within the substep add to the way."""
    return grid(m, m.shift_at, m.bodies, 3)


@accessor
def force_of(m: Any) -> FloatArray:
    """(bodies, 3) forces, constraints' apart, N, N, N m."""
    return grid(m, m.force_at, m.bodies, 3)


@accessor
def total_of(m: Any) -> FloatArray:
    """(bodies, 3) all forces, N, N, N m."""
    return grid(m, m.total_at, m.bodies, 3)


@accessor
def turns_of(m: Any) -> FloatArray:
    """(bodies, 2) cosine and sine of every angle."""
    return grid(m, m.turns_at, m.bodies, 2)


@accessor
def when_of(m: Any) -> FloatArray:
    """(bodies,) moment within the substep of a body's last impact, s."""
    return line(m, m.when_at, m.bodies)


@accessor
def real_of(m: Any) -> FloatArray:
    """(REALS, columns) the contacts' numbers."""
    return grid(m, m.real_at, REALS, m.columns)


@accessor
def whole_of(m: Any) -> Any:
    """(WHOLES, columns) the contacts' integers."""
    return integer_grid(m, m.whole_at, WHOLES, m.columns)


@accessor
def old_real_of(m: Any) -> FloatArray:
    """The same when they were last found."""
    return grid(m, m.old_real_at, REALS, m.columns)


@accessor
def old_whole_of(m: Any) -> Any:
    """The same when they were last found."""
    return integer_grid(m, m.old_whole_at, WHOLES, m.columns)


@accessor
def near_of(m: Any) -> Any:
    """(near, 3) pairs that are near: the pair, its first contact, how many."""
    return integer_grid(m, m.near_at, m.near, 3)


@accessor
def seen_of(m: Any) -> FloatArray:
    """(near, 5) relative place and both angles when its contacts were found; 1 once they were."""
    return grid(m, m.seen_at, m.near, 5)


@accessor
def touching_of(m: Any) -> Any:
    """(pairs,) substep in which they last touched."""
    return integers(m, m.touching_at, m.pairs)


@accessor
def home_of(m: Any) -> FloatArray:
    """(bodies, 3) poses at the last sweep."""
    return grid(m, m.home_at, m.bodies, 3)


@accessor
def room_of(m: Any) -> FloatArray:
    """(bodies,) how far each may go until the next, m."""
    return line(m, m.room_at, m.bodies)


@accessor
def boxes_of(m: Any) -> FloatArray:
    """(bodies − 1, 4) x from, x to, y from, y to."""
    return grid(m, m.boxes_at, m.bodies - 1, 4)


@accessor
def order_of(m: Any) -> Any:
    """(bodies − 1,) bodies by x."""
    return integers(m, m.order_at, m.bodies - 1)


@accessor
def table_of(m: Any) -> Any:
    """(bodies − 1, bodies − 1) number of a pair, −1: none."""
    return integer_grid(m, m.table_at, m.bodies - 1, m.bodies - 1)


@accessor
def row_of(m: Any, k: int) -> Any:
    """Row k: wires and pins, then the rubbing under given normal forces."""
    return record(m, m.rows_at + k * _ROW, ROW)


@accessor
def bars_of(m: Any) -> FloatArray:
    """(rows, BARS)."""
    return grid(m, m.bars_at, m.rows, BARS)


@accessor
def jacobian_of(m: Any) -> FloatArray:
    """(rows, 6)."""
    return grid(m, m.jacobian_at, m.rows, 6)


@accessor
def ends_of(m: Any) -> Any:
    """(rows, 2) their bodies."""
    return integer_grid(m, m.ends_at, m.rows, 2)


@accessor
def asked_of(m: Any) -> FloatArray:
    """(given normal forces + courses,) sizes, N, and the next places, m, from the student's programs."""
    return line(m, m.asked_at, m.asked)


@accessor
def motion_of(m: Any) -> FloatArray:
    """(bodies − 1,) smoothed motion, (m/s)²."""
    return line(m, m.motion_at, m.bodies - 1)


@accessor
def power_of(m: Any) -> FloatArray:
    """(entries,) rates of the ledger, W."""
    return line(m, m.power_at, m.entries)


@accessor
def ledger_of(m: Any) -> FloatArray:
    """(entries,) heat and works, J."""
    return line(m, m.ledger_at, m.entries)


@accessor
def reals_of(m: Any) -> FloatArray:
    """(1,) see `LAST`."""
    return line(m, m.reals_at, 1)


@accessor
def tally_of(m: Any) -> Any:
    """(TALLY,) see `CONTACTS`."""
    return integers(m, m.tally_at, TALLY)


@accessor
def events_of(m: Any) -> FloatArray:
    """(events, EVENT)."""
    return grid(m, m.events_at, m.events, EVENT)
