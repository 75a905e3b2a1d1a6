"""What happens once in a crowd: wires that break or go slack, given normal forces too small or too great,
courses that end, bodies that come to rest. Each is noted as (time, kind, number, value)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.collide import FAST, approach
from physics.engine.robust.crowd import ACTIVE, BUCKLED, CONTACTS, DONE, EVENTS, GIVES, IMPULSE, PAIRS, Crowd
from physics.engine.robust.forces import clearance, ends_of, normal_of
from physics.engine.robust.manifold import GAP, HIT, ONE, OTHER, PAIR, TAU, renew
from physics.engine.robust.rows import CORD
from physics.engine.robust.soft import opening
from physics.engine.world import WIRE, World
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

IMPACT, BREAK, SLACK, TAUT, BOUNCE, LIFT, RELEASED, REST, STRETCHED = (
    0.0,
    1.0,
    2.0,
    3.0,
    4.0,
    5.0,
    6.0,
    7.0,
    8.0,
)
"""Kinds; number is a pair, link, support, course or body; value a speed, m/s, a force, N, or a
length, m. Floats, for numba compiles a function anew for every integer constant that it is called with."""

TOUCH = 1e-4
"""m: bodies nearer than this were not apart."""
LOOSE = 1e-3
"""m: a wire that is shorter by this hangs slack, to the eye."""
CALM = 1e-7
"""(m/s)² of smoothed motion below which a body rests: 0.3 mm/s."""
CALM_ACCELERATION = 1e-3
"""m/s²: it rests only if it is not about to fall, either (a pendulum's turning point is no rest)."""
SMOOTHING = 0.8
"""Share of the newest frame, at 60 Hz, in the smoothed motion (row E2)."""


@part
def note(tally: IntArray, events: FloatArray, time: float, kind: float, number: int, value: float) -> None:
    """One event more; the caller has seen to it that there is room."""
    at = tally[EVENTS]
    events[at, 0], events[at, 1], events[at, 2], events[at, 3] = time, kind, number, value
    tally[EVENTS] = at + 1


@part
def watch_contacts(crowd: Crowd, t: float, struck: bool) -> None:
    """Notes impacts of bodies that were apart, and who touches whom."""
    real, whole, touching, done = crowd.real, crowd.whole, crowd.touching, crowd.tally[DONE]
    for k in range(crowd.tally[CONTACTS]):
        pair = whole[PAIR, k]
        if struck and real[HIT, k] > 0.0 and touching[pair] < done - 1:
            note(crowd.tally, crowd.events, t + real[TAU, k], IMPACT, pair, real[HIT, k])
            touching[pair] = done
        if real[GAP, k] <= TOUCH:
            touching[pair] = done


@part
def release(world: World, crowd: Crowd, t: float, h: float, lag: float) -> None:
    """Ends the courses of bodies that are about to collide."""
    whole = crowd.whole
    for k in range(crowd.tally[CONTACTS]):
        gap = crowd.real[GAP, k]
        rate, when = approach(
            gap, opening(crowd.real, whole, k, crowd.vel), opening(crowd.real, whole, k, crowd.acc), lag, h
        )
        if rate >= -FAST:
            continue
        for c in range(len(world.courses)):
            course = world.courses[c]
            if course.on == 1 and (course.body == whole[ONE, k] or course.body == whole[OTHER, k]):
                course.on = 0
                world.inverse[course.body, course.axis] = 1.0 / world.mass[course.body, course.axis]
                crowd.acc[course.body, course.axis] = 0.0
                note(crowd.tally, crowd.events, t + when, RELEASED, c, 0.0)
        renew(k, crowd.pos, crowd.turns, world.inverse, crowd.real, whole)


@part
def watch_supports(world: World, crowd: Crowd, t: float) -> None:
    """Strikes back what sank too deep into its support, and ends supports that were left."""
    for k in range(len(world.supports)):
        support = world.supports[k]
        if support.over == 0:
            continue
        gap, rate, along = clearance(world, k, crowd.pos, crowd.vel)
        if support.length > 0.0 and (along < 0.0 or along > support.length):
            support.over = 0
            for q in range(crowd.tally[PAIRS]):
                if crowd.near[q, 0] == support.pair:
                    crowd.seen[q, 4] = 0.0
        elif gap < -support.skin and rate < 0.0:
            # Struck back without loss, on the centres of mass: twice what stops it.
            nx, ny = normal_of(world, k, crowd.pos)
            i, j = support.i, support.j
            give = nx * nx * (world.inverse[i, 0] + world.inverse[j, 0])
            give += ny * ny * (world.inverse[i, 1] + world.inverse[j, 1])
            blow = -2.0 * rate / give if give > 0.0 else 0.0
            crowd.vel[i, 0] += world.inverse[i, 0] * blow * nx
            crowd.vel[i, 1] += world.inverse[i, 1] * blow * ny
            crowd.vel[j, 0] -= world.inverse[j, 0] * blow * nx
            crowd.vel[j, 1] -= world.inverse[j, 1] * blow * ny
            note(crowd.tally, crowd.events, t, BOUNCE, k, -rate)
        elif gap > support.skin and support.risen == 0:
            support.risen = 1
            note(crowd.tally, crowd.events, t, LIFT, k, gap)


@part
def watch_wires(world: World, crowd: Crowd, t: float, kick: float, h: float) -> None:
    """Breaks wires, and notes which go slack. kick: the length of the substep's kick, s."""
    bars = crowd.bars
    for k in range(len(crowd.rows)):
        row = crowd.rows[k]
        if row.kind != CORD or bars[k, ACTIVE] == 0.0:
            continue
        link: Any = world.links[row.source]
        pull = max(bars[k, IMPULSE] / kick, bars[k, GIVES] / h)
        bars[k, GIVES] = 0.0
        if pull > link.limit:
            link.broken = 1
            note(crowd.tally, crowd.events, t, BREAK, row.source, pull)
        elif row.gap > LOOSE and bars[k, BUCKLED] == 0.0:
            bars[k, BUCKLED] = 1.0
            note(crowd.tally, crowd.events, t, SLACK, row.source, row.gap)
        elif bars[k, BUCKLED] == 1.0 and row.gap <= 0.0:
            bars[k, BUCKLED] = 0.0
            note(crowd.tally, crowd.events, t, TAUT, row.source, 0.0)
    for k in range(len(world.links)):
        link = world.links[k]
        if link.kind == WIRE and link.tension >= 0 and link.broken == 0:
            length = ends_of(world, k, crowd.pos)[8]
            if abs(length - link.rest) > link.tolerance:
                link.broken = 1
                note(crowd.tally, crowd.events, t, STRETCHED, k, length - link.rest)


@part
def watch_rest(world: World, crowd: Crowd, t: float, movable: int) -> None:
    """Notes who comes to rest; once a frame."""
    motion, now, acc, reach = crowd.motion, crowd.now, crowd.acc, world.reach
    for i in range(movable):
        was = motion[i]
        frame = now[i, 0] ** 2 + now[i, 1] ** 2 + now[i, 2] ** 2
        net = frame if was == float("inf") else (1.0 - SMOOTHING) * was + SMOOTHING * frame
        pulled = (acc[i, 0] ** 2 + acc[i, 1] ** 2) ** 0.5
        if pulled > CALM_ACCELERATION or abs(acc[i, 2]) * reach[i] > CALM_ACCELERATION:
            net = max(net, CALM)
        motion[i] = net
        if net < CALM <= was:
            note(crowd.tally, crowd.events, t, REST, i, 0.0)
