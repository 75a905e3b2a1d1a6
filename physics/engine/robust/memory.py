"""The working memory of robust mode as its kernels see it: one piece, headed by `MEMORY` (see
physics.engine.cells). The accessors are named after the fields of `physics.engine.robust.crowd.Crowd`, whose
arrays are views of the same memory; `m` is always its head. Bodies: the page, too, as the last.
"""

from __future__ import annotations

from physics.engine.cells import REAL, WHOLE, Layout
from physics.engine.robust.manifold import REALS, WHOLES
from physics.engine.rows import ROW

CONTACTS, PAIRS, EVENTS, RECORDS, PRESSED, NEEDS, DONE, STOPPED, STILL, SWEPT = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
LANDED = 10
"""Columns of `tally`: contacts; pairs that are near; events, records and recorded contact forces; what must
grow; substeps done; the program without a value (−1: none); substeps without any motion; whether the pairs
were ever swept; whether something landed in the last kick."""
TALLY = 11

BUCKLED, GIVES, LEAST, MOST, GOAL, HEFT = 0, 1, 2, 3, 4, 5
"""Columns of `bars`, one line for each row of `rows`: whether its wire hangs slack; the greatest impulse of an
impact in this substep, N s; bounds of its impulse, N s; the rate wanted, m/s; the mass it meets, kg."""
IMPULSE, WHEN, ASIDE, ACTIVE, OLD, WAY, CLOSING, SPURT, BLOW = 6, 7, 8, 9, 10, 11, 12, 13, 14
"""Impulse; moment of an impact, s; impulse kept aside; taking part; impulse a round ago, and the direction in
which it goes on; its rate before an impact, and what that gains until then, m/s; whether the impact is its own."""
BARS = 15

LAST = 0
"""Column of `reals`: length of the last kick, s."""

EVENT = 4
"""An event: time, kind, number, value."""

FORCE = 6
"""A recorded contact force: normal, friction, where it acts: on the pair's second body."""


BLOCKS = {
    "pos": (REAL, ("bodies", 3)),
    "vel": (REAL, ("bodies", 3)),
    "acc": (REAL, ("bodies", 3)),
    "now": (REAL, ("bodies", 3)),
    "before": (REAL, ("bodies", 3)),
    "start": (REAL, ("bodies", 3)),
    "shift": (REAL, ("bodies", 3)),
    "place": (REAL, ("bodies", 3)),
    "force": (REAL, ("bodies", 3)),
    "total": (REAL, ("bodies", 3)),
    "turns": (REAL, ("bodies", 2)),
    "when": (REAL, ("bodies",)),
    "real": (REAL, (REALS, "columns")),
    "whole": (WHOLE, (WHOLES, "columns")),
    "old_real": (REAL, (REALS, "columns")),
    "old_whole": (WHOLE, (WHOLES, "columns")),
    "near": (WHOLE, ("near", 3)),
    "seen": (REAL, ("near", 5)),
    "touching": (WHOLE, ("pairs",)),
    "home": (REAL, ("bodies", 3)),
    "room": (REAL, ("bodies",)),
    "boxes": (REAL, ("solids", 4)),
    "order": (WHOLE, ("solids",)),
    "table": (WHOLE, ("solids", "solids")),
    "rows": (ROW, ("rows",)),
    "bars": (REAL, ("rows", BARS)),
    "jacobian": (REAL, ("rows", 6)),
    "ends": (WHOLE, ("rows", 2)),
    "asked": (REAL, ("asked",)),
    "motion": (REAL, ("solids",)),
    "power": (REAL, ("entries",)),
    "ledger": (REAL, ("entries",)),
    "reals": (REAL, (1,)),
    "tally": (WHOLE, (TALLY,)),
    "events": (REAL, ("events", EVENT)),
}
COUNTS = ("bodies", "solids", "columns", "near", "pairs", "rows", "asked", "entries", "events")
"""solids: bodies without the page; columns: contacts that there is room for; asked: given normal
forces and courses; entries: of the ledger."""
LAYOUT = Layout(BLOCKS, COUNTS)
MEMORY = LAYOUT.head

pos_of = LAYOUT.numbers("pos")
"""(bodies, 3) poses now."""
vel_of = LAYOUT.numbers("vel")
"""(bodies, 3) velocities half a substep ago."""
acc_of = LAYOUT.numbers("acc")
"""(bodies, 3) accelerations of the last kick."""
now_of = LAYOUT.numbers("now")
"""(bodies, 3) velocities now."""
before_of = LAYOUT.numbers("before")
"""(bodies, 3) velocities before an impact."""
start_of = LAYOUT.numbers("start")
"""(bodies, 3) velocities at the start of the substep."""
shift_of = LAYOUT.numbers("shift")
"""(bodies, 3) what impacts within the substep add to the way."""
place_of = LAYOUT.numbers("place")
"""(bodies, 3) poses at the moment of an impact."""
force_of = LAYOUT.numbers("force")
"""(bodies, 3) forces, constraints' apart, N, N, N m."""
total_of = LAYOUT.numbers("total")
"""(bodies, 3) all forces, N, N, N m."""
turns_of = LAYOUT.numbers("turns")
"""(bodies, 2) cosine and sine of every angle."""
when_of = LAYOUT.numbers("when")
"""(bodies,) moment within the substep of a body's last impact, s."""
real_of = LAYOUT.numbers("real")
"""(REALS, columns) the contacts' numbers."""
whole_of = LAYOUT.integers("whole")
"""(WHOLES, columns) the contacts' integers."""
old_real_of = LAYOUT.numbers("old_real")
"""The same when they were last found."""
old_whole_of = LAYOUT.integers("old_whole")
"""The same when they were last found."""
near_of = LAYOUT.integers("near")
"""(near, 3) pairs that are near: the pair, its first contact, how many."""
seen_of = LAYOUT.numbers("seen")
"""(near, 5) relative place and both angles when its contacts were found; 1 once they were."""
touching_of = LAYOUT.integers("touching")
"""(pairs,) substep in which they last touched."""
home_of = LAYOUT.numbers("home")
"""(bodies, 3) poses at the last sweep."""
room_of = LAYOUT.numbers("room")
"""(bodies,) how far each may go until the next, m."""
boxes_of = LAYOUT.numbers("boxes")
"""(solids, 4) x from, x to, y from, y to."""
order_of = LAYOUT.integers("order")
"""(solids,) bodies by x."""
table_of = LAYOUT.integers("table")
"""(solids, solids) number of a pair, −1: none."""
row_of = LAYOUT.records("rows")
"""Row k: wires and pins, then the rubbing under given normal forces."""
bars_of = LAYOUT.numbers("bars")
"""(rows, BARS)."""
jacobian_of = LAYOUT.numbers("jacobian")
"""(rows, 6)."""
ends_of = LAYOUT.integers("ends")
"""(rows, 2) their bodies."""
asked_of = LAYOUT.numbers("asked")
"""(given normal forces + courses,) sizes, N, and the next places, m, from the student's programs."""
motion_of = LAYOUT.numbers("motion")
"""(solids,) smoothed motion, (m/s)²."""
power_of = LAYOUT.numbers("power")
"""(entries,) rates of the ledger, W."""
ledger_of = LAYOUT.numbers("ledger")
"""(entries,) heat and works, J."""
reals_of = LAYOUT.numbers("reals")
"""(1,) see `LAST`."""
tally_of = LAYOUT.integers("tally")
"""(TALLY,) see `CONTACTS`."""
events_of = LAYOUT.numbers("events")
"""(events, EVENT)."""
