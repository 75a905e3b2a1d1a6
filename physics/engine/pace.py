"""One substep of robust mode, and many.

Leapfrog (position Verlet: Verlet 1967; with contacts: Moreau 1999): velocities live half a substep before
poses, the first kick is half a one, so poses are exact for constant acceleration, along a flat incline
too. A substep: impacts; a kick by all forces and the impulses that keep gaps open; a drift. A gap may
close, but not more: its rate must be at least −gap / h, which is a drift of just that gap.
Wires and pins are held by the same law from both sides, with the rate that their bending adds (SHAKE:
Ryckaert, Ciccotti and Berendsen 1977).

Velocities at the time of the poses are the mean of both kicks' sides, before an impact.
"""

from __future__ import annotations

import numpy as np

from physics.engine.crowd import (
    ACTIVE,
    CONTACTS,
    DONE,
    EVENTS,
    FORCE,
    GOAL,
    IMPULSE,
    LAST,
    LEAST,
    MOST,
    NEEDS,
    PRESSED,
    RECORDS,
    STILL,
    STOPPED,
    Crowd,
    Record,
)
from physics.engine.forces import add, clearance, powers, put, value
from physics.engine.manifold import GAP, NX, NY, PAIR, PN, PT, PX, PY, TARGET, I, J
from physics.engine.near import find
from physics.engine.rows import CORD, GIVEN, POINT
from physics.engine.soft import bring_up, opening, push_apart, rate_of, settle, haul, press
from physics.engine.collide import kinetic, strike
from physics.engine.watch import release, watch_contacts, watch_rest, watch_supports, watch_wires
from physics.engine.world import World
from physics.jit import kernel
from sketch.ink import FloatArray

SWEEPS = 12
"""Over all contacts in a substep: enough for what moves; what rests is finished in the next ones."""
CLOSE = 1e-13
"""m/s: sweeps end when no rate changes by more."""
CREEP = 5e-4
"""m: the most that a wire or pin is put right within a substep: what was drawn wrong is not torn right."""
QUIET = 1e-12
"""m/s: below it on every body nothing moves."""
FRAME = 60
"""Frames of the smoothed motion (row E2) in a second."""
ASLEEP = 60
"""Substeps without motion after which a scene that reads no time sleeps."""


@kernel
def substep(
    world: World, crowd: Crowd, record: Record, movable: int, t: float, h: float, room: float, keep: bool
) -> bool:
    """One substep of h seconds from time t; keep: put the state at t into the record. False if a formula has
    no value (`STOPPED`: which), or the tables are too small (`NEEDS`); then nothing has moved."""
    pos, vel, acc, now = crowd.pos, crowd.vel, crowd.acc, crowd.now
    tally, reals = crowd.tally, crowd.reals
    first = tally[DONE] == 0
    kick, lag = (0.5 * h, 0.0) if first else (h, 0.5 * h)
    for i in range(len(pos)):
        crowd.when[i] = 0.0
        crowd.turns[i, 0], crowd.turns[i, 1] = np.cos(pos[i, 2]), np.sin(pos[i, 2])
    if not find(world, crowd, movable, h, room):
        return False
    for i in range(len(pos)):
        for q in range(3):
            crowd.start[i, q] = vel[i, q]
            now[i, q] = vel[i, q] + lag * acc[i, q]
    add(world, t, pos, now, crowd.force)
    if not _lead(world, crowd, t, h) or not _sound(world, crowd, movable, t):
        for i in range(len(pos)):
            for q in range(3):
                vel[i, q] = crowd.start[i, q]
        return False
    bring_up(world, crowd)
    if len(world.courses) > 0:
        release(world, crowd, t, h, lag)
    watch_supports(world, crowd, t)
    energy = kinetic(world, movable, vel)
    struck = strike(world, crowd, movable, h, lag) > 0
    watch_contacts(world, crowd, t, struck)
    loss = energy - kinetic(world, movable, vel) if struck else 0.0
    for i in range(len(pos)):
        for q in range(3):
            crowd.before[i, q] = vel[i, q]
    _goals(world, crowd, t, h, kick, struck)
    rubbed = _kick(world, crowd, movable, kick)
    for i in range(len(pos)):
        for q in range(3):
            since = crowd.before[i, q] if world.inverse[i, q] > 0.0 else crowd.start[i, q]
            acc[i, q] = (vel[i, q] - since) / kick
            now[i, q] = crowd.start[i, q] + lag * acc[i, q]
    _account(world, crowd, t, h, rubbed / kick, record, keep, kick)
    crowd.ledger[0] += loss
    for i in range(len(pos)):
        for q in range(3):
            pos[i, q] += h * vel[i, q] + crowd.shift[i, q]
            crowd.shift[i, q] = 0.0
    for c in range(len(world.courses)):
        course = world.courses[c]
        if course.on == 1 and course.position >= 0:
            pos[course.body, course.axis] = value(world, course.position, t + h, pos, now)
    level = _potential(world, crowd, movable)
    pushed = push_apart(world, crowd, h)
    if pushed:
        crowd.ledger[0] -= _potential(world, crowd, movable) - level
    watch_wires(world, crowd, t, kick, h)
    reals[LAST] = kick
    quiet = not struck and not pushed
    for i in range(movable):
        for q in range(3):
            quiet = quiet and abs(vel[i, q]) <= QUIET and abs(h * acc[i, q]) <= QUIET
    tally[STILL] = tally[STILL] + 1 if quiet else 0
    tally[DONE] += 1
    return True


@kernel
def _lead(world: World, crowd: Crowd, t: float, h: float) -> bool:
    """Gives bodies under a student's equation the velocity that takes them where it says; whether it can be
    told (else `STOPPED`)."""
    for c in range(len(world.courses)):
        course = world.courses[c]
        if course.on == 0:
            continue
        i, a = course.body, course.axis
        if course.position >= 0:
            program = course.position
            crowd.vel[i, a] = (value(world, program, t + h, crowd.pos, crowd.now) - crowd.pos[i, a]) / h
        else:
            # Read in the middle of the substep, by a first guess of the way there.
            program = course.velocity
            here = crowd.pos[i, a]
            crowd.pos[i, a] = here + 0.5 * h * value(world, program, t, crowd.pos, crowd.now)
            crowd.vel[i, a] = value(world, program, t + 0.5 * h, crowd.pos, crowd.now)
            crowd.pos[i, a] = here
        if not np.isfinite(crowd.vel[i, a]):
            crowd.tally[STOPPED] = program
            return False
    return True


@kernel
def _sound(world: World, crowd: Crowd, movable: int, t: float) -> bool:
    """Whether all forces have a value (else `STOPPED` says which program has none)."""
    total = 0.0
    for i in range(movable):
        total += crowd.force[i, 0] + crowd.force[i, 1] + crowd.force[i, 2]
    if np.isfinite(total):
        return True
    for program in range(len(world.spans)):
        if not np.isfinite(value(world, program, t, crowd.pos, crowd.now)):
            crowd.tally[STOPPED] = program
            return False
    return True


@kernel
def _goals(world: World, crowd: Crowd, t: float, h: float, kick: float, struck: bool) -> None:
    """The rate that each contact and row must have after the kick, and their impulses of the last one."""
    real, bars = crowd.real, crowd.bars
    last = crowd.reals[LAST]
    warm = kick / last if last > 0.0 else 0.0
    for k in range(crowd.tally[CONTACTS]):
        gap = max(real[k, GAP], 0.0)
        if struck:
            gap += opening(crowd, k, crowd.shift)
        real[k, TARGET] = -gap / h
        real[k, PN] *= warm
        real[k, PT] *= warm
    for k in range(len(crowd.rows)):
        row = crowd.rows[k]
        bars[k, IMPULSE] *= warm
        if row.kind == GIVEN or row.kind == POINT:
            support = world.supports[row.source]
            gap = clearance(world, row.source, crowd.pos, crowd.now)[0]
            most = 0.0
            if support.over == 1 and row.mu > 0.0 and abs(gap) < support.skin:
                most = kick * row.mu * max(value(world, support.force, t, crowd.pos, crowd.now), 0.0)
            bars[k, ACTIVE], bars[k, GOAL], bars[k, LEAST], bars[k, MOST] = 1.0, 0.0, -most, most
            bars[k, IMPULSE] = min(max(bars[k, IMPULSE], -most), most)
            continue
        off = row.gap + 0.5 * h * h * row.c
        if struck:
            off += rate_of(crowd, k, crowd.shift)
        if off < 0.0 or row.kind != CORD:
            off = min(max(off, -CREEP), CREEP)
        bars[k, GOAL] = -off / h


@kernel
def _kick(world: World, crowd: Crowd, movable: int, kick: float) -> float:
    """Velocities after the kick; the heat that its constraints make, J."""
    vel, real, bars = crowd.vel, crowd.real, crowd.bars
    for i in range(movable):
        for q in range(3):
            vel[i, q] += kick * world.inverse[i, q] * crowd.force[i, q]
    for k in range(crowd.tally[CONTACTS]):
        if real[k, PN] != 0.0 or real[k, PT] != 0.0:
            press(world, crowd, k, real[k, PN], real[k, PT], vel)
    for k in range(len(crowd.rows)):
        if bars[k, ACTIVE] == 0.0:
            bars[k, IMPULSE] = 0.0
        elif bars[k, IMPULSE] != 0.0:
            haul(world, crowd, k, bars[k, IMPULSE], vel)
    settle(world, crowd, vel, SWEEPS, CLOSE)
    heat = 0.0
    for i in range(movable):
        for q in range(3):
            if world.inverse[i, q] > 0.0:
                gain = world.mass[i, q] * (vel[i, q] - crowd.before[i, q]) - kick * crowd.force[i, q]
                heat -= 0.5 * (vel[i, q] + crowd.before[i, q]) * gain
    return heat


@kernel
def _account(
    world: World,
    crowd: Crowd,
    t: float,
    h: float,
    rubbed: float,
    record: Record,
    keep: bool,
    kick: float,
) -> None:
    """Adds to the ledger what this kick makes of heat and work, half of it before the time t, and keeps the
    state at t. rubbed: W."""
    if len(world.courses) > 0:
        _sum_up(world, crowd, kick)
    powers(world, t, crowd.pos, crowd.now, crowd.acc, crowd.total, rubbed, crowd.power)
    if crowd.tally[DONE] > 0:
        for k in range(len(crowd.ledger)):
            crowd.ledger[k] += 0.5 * h * crowd.power[k]
    if keep:
        _keep(world, crowd, record, kick)
    for k in range(len(crowd.ledger)):
        crowd.ledger[k] += 0.5 * h * crowd.power[k]


@kernel
def _sum_up(world: World, crowd: Crowd, kick: float) -> None:
    """All forces on each body, those of contacts and rows too."""
    real, whole, total = crowd.real, crowd.whole, crowd.total
    for i in range(len(total)):
        for q in range(3):
            total[i, q] = crowd.force[i, q]
    for k in range(crowd.tally[CONTACTS]):
        normal, along = real[k, PN] / kick, real[k, PT] / kick
        x, y = real[k, NX] * normal - real[k, NY] * along, real[k, NY] * normal + real[k, NX] * along
        put(total, whole[k, I], -x, -y, 0.0, 0.0)
        put(total, whole[k, J], x, y, 0.0, 0.0)
    for k in range(len(crowd.rows)):
        row = crowd.rows[k]
        for q in range(3):
            total[row.i, q] += crowd.jacobian[k, q] * crowd.bars[k, IMPULSE] / kick
            total[row.j, q] += crowd.jacobian[k, 3 + q] * crowd.bars[k, IMPULSE] / kick


@kernel
def _keep(world: World, crowd: Crowd, record: Record, kick: float) -> None:
    real, whole, tally = crowd.real, crowd.whole, crowd.tally
    at, pressed = tally[RECORDS], tally[PRESSED]
    for i in range(len(crowd.pos)):
        for q in range(3):
            record.pos[at, i, q] = crowd.pos[i, q]
            record.vel[at, i, q] = crowd.now[i, q]
            record.acc[at, i, q] = crowd.acc[i, q]
    for k in range(len(crowd.ledger)):
        record.ledger[at, k] = crowd.ledger[k]
    for k in range(len(crowd.rows)):
        record.pulls[at, k] = crowd.bars[k, IMPULSE] / kick
    last = -1
    weight = 0.0
    for k in range(tally[CONTACTS]):
        normal, along = real[k, PN], real[k, PT]
        if normal <= 0.0:
            continue
        pair = whole[k, PAIR]
        if pair != last:
            last, weight = pair, 0.0
            record.pairs[pressed] = pair
            for q in range(FORCE):
                record.forces[pressed, q] = 0.0
            pressed += 1
        row = record.forces[pressed - 1]
        sign = (1.0 if whole[k, J] == world.pairs[pair].j else -1.0) / kick
        row[0] += sign * real[k, NX] * normal
        row[1] += sign * real[k, NY] * normal
        row[2] -= sign * real[k, NY] * along
        row[3] += sign * real[k, NX] * along
        weight += normal
        row[4] += (real[k, PX] - row[4]) * normal / weight
        row[5] += (real[k, PY] - row[5]) * normal / weight
    tally[PRESSED] = pressed
    record.ends[at] = pressed
    tally[RECORDS] = at + 1


@kernel
def _potential(world: World, crowd: Crowd, movable: int) -> float:
    level = 0.0
    for i in range(movable):
        level -= world.mass[i, 0] * (world.gravity[0] * crowd.pos[i, 0] + world.gravity[1] * crowd.pos[i, 1])
    return level


@kernel
def run(
    world: World,
    crowd: Crowd,
    record: Record,
    movable: int,
    begin: float,
    h: float,
    each: int,
    frame: int,
    until: int,
    room: float,
    sleepy: bool,
) -> None:
    """Substeps until `until` are done, a table is full, a formula has no value, or all sleep (sleepy: they may).

    begin: when the first one was, s; each: substeps from record to record; frame: from frame to frame; room:
    see `sweep`.
    """
    tally = crowd.tally
    tally[NEEDS] = 0
    while tally[DONE] < until:
        done = tally[DONE]
        many = 2 * len(crowd.near) + 2 * len(world.links) + 2 * len(world.supports) + len(world.courses) + movable
        if (
            tally[EVENTS] + many > len(crowd.events)
            or tally[RECORDS] >= len(record.pos)
            or tally[PRESSED] + len(crowd.near) > len(record.forces)
        ):
            return
        t = begin + done * h
        if not substep(world, crowd, record, movable, t, h, room, done % each == 0):
            return
        if done % frame == 0:
            watch_rest(world, crowd, t, movable)
            if sleepy and tally[STILL] >= ASLEEP:
                return
