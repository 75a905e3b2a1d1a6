"""What happens once in a crowd: wires that break or go slack, given normal forces too small or too great,
courses that end, bodies that come to rest. Each is noted as (time, kind, number, value)."""

from __future__ import annotations

from typing import Any

from physics.engine.forces import clearance, ends_of, normal_of
from physics.engine.robust.collide import FAST, approach
from physics.engine.robust.manifold import GAP, HIT, ONE, OTHER, PAIR, TAU, renew
from physics.engine.robust.memory import (
    ACTIVE,
    BUCKLED,
    CONTACTS,
    DONE,
    EVENTS,
    GIVES,
    IMPULSE,
    PAIRS,
    acc_of,
    bars_of,
    events_of,
    motion_of,
    near_of,
    now_of,
    pos_of,
    real_of,
    row_of,
    seen_of,
    tally_of,
    touching_of,
    turns_of,
    vel_of,
    whole_of,
)
from physics.engine.robust.rates import opening
from physics.engine.rows import CORD
from physics.engine.tables import course_of, inverses, link_of, masses, reaches, support_of
from physics.engine.world import WIRE
from physics.jit import part

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
def note(m: Any, time: float, kind: float, number: int, value: float) -> None:
    """One event more; the caller has seen to it that there is room."""
    tally, events = tally_of(m), events_of(m)
    at = tally[EVENTS]
    events[at, 0], events[at, 1], events[at, 2], events[at, 3] = time, kind, number, value
    tally[EVENTS] = at + 1


@part
def watch_contacts(m: Any, t: float, struck: bool) -> None:
    """Notes impacts of bodies that were apart, and who touches whom."""
    real, whole, touching, done = real_of(m), whole_of(m), touching_of(m), tally_of(m)[DONE]
    for k in range(tally_of(m)[CONTACTS]):
        pair = whole[PAIR, k]
        if struck and real[HIT, k] > 0.0 and touching[pair] < done - 1:
            note(m, t + real[TAU, k], IMPACT, pair, real[HIT, k])
            touching[pair] = done
        if real[GAP, k] <= TOUCH:
            touching[pair] = done


@part
def release(w: Any, m: Any, t: float, h: float, lag: float) -> None:
    """Ends the courses of bodies that are about to collide."""
    whole, real, pos, vel, acc, turns = whole_of(m), real_of(m), pos_of(m), vel_of(m), acc_of(m), turns_of(m)
    inverse = inverses(w)
    for k in range(tally_of(m)[CONTACTS]):
        closing, pull = opening(real, whole, k, vel), opening(real, whole, k, acc)
        rate, when = approach(real[GAP, k], closing, pull, lag, h)
        if rate >= -FAST:
            continue
        for c in range(w.courses):
            course = course_of(w, c)
            if course.on == 1 and (course.body == whole[ONE, k] or course.body == whole[OTHER, k]):
                course.on = 0
                inverse[course.body, course.axis] = 1.0 / masses(w)[course.body, course.axis]
                acc[course.body, course.axis] = 0.0
                note(m, t + when, RELEASED, c, 0.0)
        renew(k, pos, turns, inverse, real, whole)


@part
def watch_supports(w: Any, m: Any, t: float) -> None:
    """Strikes back what sank too deep into its support, and ends supports that were left."""
    pos, vel, near, seen, inverse = pos_of(m), vel_of(m), near_of(m), seen_of(m), inverses(w)
    for k in range(w.supports):
        support = support_of(w, k)
        if support.over == 0:
            continue
        gap, rate, along = clearance(w, k, pos, vel)
        if support.length > 0.0 and (along < 0.0 or along > support.length):
            support.over = 0
            for q in range(tally_of(m)[PAIRS]):
                if near[q, 0] == support.pair:
                    seen[q, 4] = 0.0
        elif gap < -support.skin and rate < 0.0:
            # Struck back without loss, on the centres of mass: twice what stops it.
            nx, ny = normal_of(w, k, pos)
            i, j = support.i, support.j
            give = nx * nx * (inverse[i, 0] + inverse[j, 0])
            give += ny * ny * (inverse[i, 1] + inverse[j, 1])
            blow = -2.0 * rate / give if give > 0.0 else 0.0
            vel[i, 0] += inverse[i, 0] * blow * nx
            vel[i, 1] += inverse[i, 1] * blow * ny
            vel[j, 0] -= inverse[j, 0] * blow * nx
            vel[j, 1] -= inverse[j, 1] * blow * ny
            note(m, t, BOUNCE, k, -rate)
        elif gap > support.skin and support.risen == 0:
            support.risen = 1
            note(m, t, LIFT, k, gap)


@part
def watch_wires(w: Any, m: Any, t: float, kick: float, h: float) -> None:
    """Breaks wires, and notes which go slack. kick: the length of the substep's kick, s."""
    bars = bars_of(m)
    for k in range(m.rows):
        row = row_of(m, k)
        if row.kind != CORD or bars[k, ACTIVE] == 0.0:
            continue
        link: Any = link_of(w, row.source)
        pull = max(bars[k, IMPULSE] / kick, bars[k, GIVES] / h)
        bars[k, GIVES] = 0.0
        if pull > link.limit:
            link.broken = 1
            note(m, t, BREAK, row.source, pull)
        elif row.gap > LOOSE and bars[k, BUCKLED] == 0.0:
            bars[k, BUCKLED] = 1.0
            note(m, t, SLACK, row.source, row.gap)
        elif bars[k, BUCKLED] == 1.0 and row.gap <= 0.0:
            bars[k, BUCKLED] = 0.0
            note(m, t, TAUT, row.source, 0.0)
    for k in range(w.links):
        link = link_of(w, k)
        if link.kind == WIRE and link.tension >= 0 and link.broken == 0:
            length = ends_of(w, k, pos_of(m))[8]
            if abs(length - link.rest) > link.tolerance:
                link.broken = 1
                note(m, t, STRETCHED, k, length - link.rest)


@part
def watch_rest(w: Any, m: Any, t: float, movable: int) -> None:
    """Notes who comes to rest; once a frame."""
    motion, now, acc, reach = motion_of(m), now_of(m), acc_of(m), reaches(w)
    for i in range(movable):
        was = motion[i]
        frame = now[i, 0] ** 2 + now[i, 1] ** 2 + now[i, 2] ** 2
        net = frame if was == float("inf") else (1.0 - SMOOTHING) * was + SMOOTHING * frame
        pulled = (acc[i, 0] ** 2 + acc[i, 1] ** 2) ** 0.5
        if pulled > CALM_ACCELERATION or abs(acc[i, 2]) * reach[i] > CALM_ACCELERATION:
            net = max(net, CALM)
        motion[i] = net
        if net < CALM <= was:
            note(m, t, REST, i, 0.0)
