"""One substep of robust mode, and many.

Leapfrog (position Verlet: Verlet 1967; with contacts: Moreau 1999): velocities live half a substep before
poses, the first kick is half a one, so poses are exact for constant acceleration, along a flat incline
too. A substep: poses put right; impacts; a kick by all forces and the impulses that keep gaps open; a
drift. A gap may close, but not more: its rate must be at least −gap / h, which is a drift of just that gap.
Wires and pins are held by the same law from both sides, with the rate that their bending adds (SHAKE:
Ryckaert, Ciccotti and Berendsen 1977).

Velocities at the time of the poses are the mean of both kicks' sides, before an impact.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.cells import head
from physics.engine.forces import add, clearance, powers, put, wind
from physics.engine.robust.collide import strike
from physics.engine.robust.crowd import Record
from physics.engine.robust.groups import blows
from physics.engine.robust.keep import keep, mark
from physics.engine.robust.landing import forget, landed
from physics.engine.robust.manifold import GAP, NX, NY, ONE, OTHER, PN, PT, TARGET, WN
from physics.engine.robust.memory import (
    ACTIVE,
    ASIDE,
    CONTACTS,
    DONE,
    EVENTS,
    GOAL,
    IMPULSE,
    LANDED,
    LAST,
    LEAST,
    MEMORY,
    MOST,
    NEEDS,
    PRESSED,
    RECORDS,
    STILL,
    STOPPED,
    acc_of,
    asked_of,
    bars_of,
    before_of,
    ends_of,
    force_of,
    jacobian_of,
    ledger_of,
    now_of,
    pos_of,
    power_of,
    real_of,
    reals_of,
    row_of,
    shift_of,
    start_of,
    tally_of,
    total_of,
    turns_of,
    vel_of,
    when_of,
    whole_of,
)
from physics.engine.robust.near import find
from physics.engine.robust.project import project
from physics.engine.robust.rates import haul, opening, press, rate_of
from physics.engine.robust.soft import bring_up, settle
from physics.engine.robust.watch import release, watch_contacts, watch_rest, watch_supports, watch_wires
from physics.engine.rows import CORD, GIVEN, PIN_X, PIN_Y, POINT, refresh
from physics.engine.tables import (
    WORLD,
    course_of,
    inverses,
    link_of,
    masses,
    support_of,
    value,
)
from physics.jit import kernel, part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

ROUNDS = 40.0
"""Of sweeps in a substep; a float, for numba compiles a function anew for every integer constant."""
CLOSE = 1e-12
"""m/s: sweeps end when no rate changes by more."""
CREEP = 5e-4
"""m: the most that a wire or pin is put right within a substep: what was drawn wrong is not torn right."""
QUIET = 5e-13
"""m/s: below it on every body nothing moves."""
FRAME = 60
"""Frames of the smoothed motion (row E2) in a second."""
ASLEEP = 60
"""Substeps without motion after which a scene that reads no time sleeps."""


@part
def _ask(w: Any, m: Any, movable: int, t: float, h: float) -> bool:
    """Has the student's programs tell the sizes of given normal forces, and the velocities that take bodies
    under an equation where it says. False if one has no value (`STOPPED`: which)."""
    vel, pos, now, asked, force, start = (
        vel_of(m),
        pos_of(m),
        now_of(m),
        asked_of(m),
        force_of(m),
        start_of(m),
    )
    stopped = -1
    supports = w.supports
    for k in range(supports):
        support = support_of(w, k)
        if support.over == 1:
            asked[k] = value(w, support.force, t, pos, now)
    for k in range(w.courses):
        course = course_of(w, k)
        if course.on == 0:
            continue
        i, a = course.body, course.axis
        here = pos[i, a]
        if course.position >= 0:
            there = value(w, course.position, t + h, pos, now)
            vel[i, a] = (there - here) / h
        else:
            # Read in the middle of the substep, by a first guess of the way there.
            pos[i, a] = here + 0.5 * h * value(w, course.velocity, t, pos, now)
            vel[i, a] = value(w, course.velocity, t + 0.5 * h, pos, now)
            pos[i, a] = here
            there = here + h * vel[i, a]
        asked[supports + k] = there
        if not np.isfinite(there):
            stopped = course.position if course.position >= 0 else course.velocity
    total = 0.0
    for i in range(movable):
        total += force[i, 0] + force[i, 1] + force[i, 2]
    if np.isfinite(total) and stopped < 0:
        return True
    for program in range(w.programs):
        if stopped < 0 and not np.isfinite(value(w, program, t, pos, now)):
            stopped = program
    for i in range(len(vel)):
        for q in range(3):
            vel[i, q] = start[i, q]
    tally_of(m)[STOPPED] = max(stopped, 0)
    return False


@part
def _begin(w: Any, m: Any, lag: float) -> None:
    """Velocities at the time of the poses, as far as they are known before the kick: accelerations are taken to be
    those of the last one, but where a landing made them."""
    pos, vel, acc, now, start = pos_of(m), vel_of(m), acc_of(m), now_of(m), start_of(m)
    turns, when = turns_of(m), when_of(m)
    wind(w, pos)
    for k in range(m.rows):
        row = row_of(m, k)
        if row.kind == CORD:
            row.wound = link_of(w, row.source).wound
    if tally_of(m)[LANDED] == 1:
        forget(w, m)
    for i in range(len(pos)):
        when[i] = np.inf
        turns[i, 0], turns[i, 1] = np.cos(pos[i, 2]), np.sin(pos[i, 2])
        for q in range(3):
            start[i, q] = vel[i, q]
            now[i, q] = vel[i, q] + lag * acc[i, q]


@part
def _sync(w: Any, m: Any, lag: float, kick: float, struck: bool) -> None:
    """Accelerations by the kick, and velocities at its time."""
    vel, acc, now, start, before = vel_of(m), acc_of(m), now_of(m), start_of(m), before_of(m)
    inverse = inverses(w)
    hit = blows(w, m) if struck else np.zeros(len(vel))
    for i in range(len(vel)):
        for q in range(3):
            free = inverse[i, q] > 0.0
            acc[i, q] = (vel[i, q] - (before[i, q] if free else start[i, q])) / kick
            # What is struck, and what it acts on, has another velocity at once; before that, it went on as it did.
            if hit[i] == 0.0 or not free:
                now[i, q] = start[i, q] + lag * acc[i, q]


@part
def _drift(w: Any, m: Any, movable: int, h: float, struck: bool) -> None:
    """Poses after h seconds, and whether anything moved (`STILL`)."""
    vel, acc, pos, shift, asked, tally = (
        vel_of(m),
        acc_of(m),
        pos_of(m),
        shift_of(m),
        asked_of(m),
        tally_of(m),
    )
    quiet = not struck
    for i in range(movable):
        for q in range(3):
            quiet = quiet and abs(vel[i, q]) <= QUIET and abs(h * acc[i, q]) <= QUIET
            pos[i, q] += h * vel[i, q] + shift[i, q]
            shift[i, q] = 0.0
    for k in range(w.courses):
        course = course_of(w, k)
        if course.on == 1:
            pos[course.body, course.axis] = asked[w.supports + k]
    tally[STILL] = tally[STILL] + 1 if quiet else 0


@part
def _changed(vel: FloatArray, start: FloatArray, i: int) -> bool:
    return vel[i, 0] != start[i, 0] or vel[i, 1] != start[i, 1] or vel[i, 2] != start[i, 2]


@part
def _goals(w: Any, m: Any, h: float, kick: float, struck: bool) -> None:
    """The rate that each contact and row must have after the kick, and their impulses of the last one."""
    jacobian, ends, pos, now, asked = jacobian_of(m), ends_of(m), pos_of(m), now_of(m), asked_of(m)
    real, bars = real_of(m), bars_of(m)
    last = reals_of(m)[LAST]
    warm = kick / last if last > 0.0 else 0.0
    vel, before, whole, shift, start = vel_of(m), before_of(m), whole_of(m), shift_of(m), start_of(m)
    for i in range(len(vel)):
        for q in range(3):
            before[i, q] = vel[i, q]
    for k in range(tally_of(m)[CONTACTS]):
        gap = real[GAP, k]
        if struck:
            gap += opening(real, whole, k, shift)
        # What is too near already is moved away (`part_overlaps`), never driven: that would make energy.
        real[TARGET, k] = -max(gap, 0.0) / h
        real[PN, k] *= warm
        real[PT, k] *= warm
        real[WN, k] = real[PN, k]
    for k in range(m.rows):
        row = row_of(m, k)
        if struck and (_changed(vel, start, row.i) or _changed(vel, start, row.j)):
            refresh(row, pos, vel)
        bars[k, IMPULSE] *= warm
        bars[k, ASIDE] = bars[k, IMPULSE]
        if row.kind == GIVEN or row.kind == POINT:
            support = support_of(w, row.source)
            gap = clearance(w, row.source, pos, now)[0]
            most = 0.0
            if support.over == 1 and row.mu > 0.0 and abs(gap) < support.skin:
                most = kick * row.mu * max(asked[row.source], 0.0)
            bars[k, ACTIVE], bars[k, GOAL], bars[k, LEAST], bars[k, MOST] = 1.0, 0.0, -most, most
            bars[k, IMPULSE] = min(max(bars[k, IMPULSE], -most), most)
            continue
        gap = row.gap
        if gap < 0.0 or row.kind != CORD:
            gap = min(max(gap, -CREEP), CREEP)
        off = gap + 0.5 * h * h * row.c
        if struck:
            off += rate_of(jacobian, ends, k, shift)
        bars[k, GOAL] = -off / h


@part
def _kick(w: Any, m: Any, movable: int, kick: float) -> float:
    """Velocities after the kick; the heat that its constraints make, J: pins make none."""
    jacobian, ends = jacobian_of(m), ends_of(m)
    vel, real, whole, bars, inverse = vel_of(m), real_of(m), whole_of(m), bars_of(m), inverses(w)
    contacts, force, before, mass = tally_of(m)[CONTACTS], force_of(m), before_of(m), masses(w)
    for i in range(movable):
        for q in range(3):
            vel[i, q] += kick * inverse[i, q] * force[i, q]
    for k in range(contacts):
        if real[PN, k] != 0.0 or real[PT, k] != 0.0:
            press(real, whole, inverse, k, real[PN, k], real[PT, k], vel)
    for k in range(len(bars)):
        if bars[k, ACTIVE] == 0.0:
            bars[k, IMPULSE] = 0.0
        elif bars[k, IMPULSE] != 0.0:
            haul(jacobian, ends, inverse, k, bars[k, IMPULSE], vel)
    settle(real, whole, bars, jacobian, ends, inverse, contacts, vel, ROUNDS, CLOSE, 1.0)
    heat = 0.0
    for i in range(movable):
        for q in range(3):
            if inverse[i, q] > 0.0:
                gain = mass[i, q] * (vel[i, q] - before[i, q]) - kick * force[i, q]
                heat -= 0.5 * (vel[i, q] + before[i, q]) * gain
    for k in range(len(bars)):
        if row_of(m, k).kind in (PIN_X, PIN_Y):
            rate = rate_of(jacobian, ends, k, vel) + rate_of(jacobian, ends, k, before)
            heat += 0.5 * bars[k, IMPULSE] * rate
    return heat


@part
def _sum_up(m: Any, kick: float) -> None:
    """All forces on each body, those of contacts and rows too."""
    force, jacobian, bars = force_of(m), jacobian_of(m), bars_of(m)
    real, whole, total = real_of(m), whole_of(m), total_of(m)
    for i in range(len(total)):
        for q in range(3):
            total[i, q] = force[i, q]
    for k in range(tally_of(m)[CONTACTS]):
        normal, along = real[PN, k] / kick, real[PT, k] / kick
        x, y = real[NX, k] * normal - real[NY, k] * along, real[NY, k] * normal + real[NX, k] * along
        put(total, whole[ONE, k], -x, -y, 0.0, 0.0)
        put(total, whole[OTHER, k], x, y, 0.0, 0.0)
    for k in range(m.rows):
        row = row_of(m, k)
        for q in range(3):
            total[row.i, q] += jacobian[k, q] * bars[k, IMPULSE] / kick
            total[row.j, q] += jacobian[k, 3 + q] * bars[k, IMPULSE] / kick


@kernel
def run(
    cells: FloatArray,
    memory: FloatArray,
    record: Record,
    begin: float,
    h: float,
    each: int,
    frame: int,
    until: int,
    room: float,
    sleepy: bool,
) -> None:
    """Substeps until `until` are done, a table is full (`NEEDS`: how many pairs are near), a formula has no value
    (`STOPPED`: which), or all sleep (sleepy: they may).

    begin: when the first one was, s; h: their length, s; each: substeps from record to record; frame: from
    frame to frame; room: see `sweep`.
    """
    w, m = head(cells, WORLD), head(memory, MEMORY)
    movable = w.movable
    tally, ledger, power = tally_of(m), ledger_of(m), power_of(m)
    pos, now, acc, force, total = pos_of(m), now_of(m), acc_of(m), force_of(m), total_of(m)
    tally[NEEDS] = 0
    many = 2 * m.near + 2 * w.links + 2 * w.supports + w.courses + movable
    while tally[DONE] < until:
        done = tally[DONE]
        full = tally[RECORDS] >= len(record.pos) or tally[PRESSED] + m.near > len(record.forces)
        if full or tally[EVENTS] + many > m.events:
            return
        t = begin + done * h
        kick, lag = (h, 0.5 * h) if done > 0 else (0.5 * h, 0.0)
        _begin(w, m, lag)
        if not find(w, m, movable, h, room):
            return
        bring_up(w, m)
        righted = project(w, m, h)
        add(w, t, pos, now, force)
        if not _ask(w, m, movable, t, h):
            return
        if w.courses > 0:
            release(w, m, t, h, lag)
        watch_supports(w, m, t)
        loss = strike(w, m, h, lag)
        struck = loss >= 0.0
        watch_contacts(m, t, struck)
        _goals(w, m, h, kick, struck)
        heat = _kick(w, m, movable, kick)
        _sync(w, m, lag, kick, struck)
        if w.courses > 0:
            _sum_up(m, kick)
        # Heat and work of the kick, half of it before the time t.
        powers(w, t, pos, now, acc, total, heat / kick, power)
        for k in range(len(ledger)):
            ledger[k] += lag * power[k]
        if done % each == 0:
            keep(w, m, record, kick)
        if struck:
            mark(w, m, record, (done % each) * h)
        landed(m)
        for k in range(len(ledger)):
            ledger[k] += 0.5 * h * power[k]
        ledger[0] += max(loss, 0.0)
        _drift(w, m, movable, h, struck or righted)
        watch_wires(w, m, t, kick, h)
        reals_of(m)[LAST] = kick
        tally[DONE] += 1
        if done % frame == 0:
            watch_rest(w, m, t, movable)
            if sleepy and tally[STILL] >= ASLEEP:
                return
