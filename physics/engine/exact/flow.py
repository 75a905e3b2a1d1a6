"""The motion from one event to the next: steps of the length that the accuracy allows, up to the moment
within a step at which something happens, found to rounding (physics.engine.exact.moments).

Moments are first found on the step's dense output, then on true steps of that length, so that the
state at an event is as good as at any step's end. Frame: SI units, y up.
"""

from __future__ import annotations

from typing import Any

from physics.engine.cells import head
from physics.engine.exact.integrate import densify, derive, step, unpack
from physics.engine.exact.machine import (
    AT,
    GREATEST,
    MACHINE,
    POWERS,
    H,
    T,
    after,
    before,
    clock,
    dense_of,
    forces_of,
    hits,
    newest,
    poses,
    recorded,
    row_of,
    slope,
    state,
    takes,
    took,
    velocities,
)
from physics.engine.exact.moments import CRAWLS, FULL, MET, REACHED, STOPPED, SWITCHED, aim_of, first
from physics.engine.exact.watch import (
    LENGTH,
    SWEEP,
    decisions,
    pair_gap,
    touched,
    watch,
    whirl,
    whirls,
)
from physics.engine.tables import WORLD, gravity, masses
from physics.jit import kernel, part
from sketch.ink import FloatArray

LONGEST = 0.25
"""s: the longest step, so that no force dips below zero and returns unseen."""
SHORTEST = 1e-13
"""s (a share of the time above 1 s): a step that is no step."""


@kernel
def begin(cells: FloatArray, memory: FloatArray) -> bool:
    """Looks at everything at the start of a stretch. False where a formula has no value."""
    w, m = head(cells, WORLD), head(memory, MACHINE)
    now = clock(m)
    fine = derive(w, m, now[T], state(m), slope(m, 0))
    force, mass, g = forces_of(m), masses(w), gravity(w)
    greatest = 1e-9
    for i in range(m.movable):
        for a in range(2):
            greatest = max(greatest, abs(force[i, a]), mass[i, a] * abs(g[a]))
    for k in range(m.rows):
        greatest = max(greatest, abs(row_of(m, k).force))
    now[GREATEST] = greatest
    watch(w, m, greatest, before(m))
    decisions(w, m, now[T], took(m))
    return fine


@kernel
def flow(
    cells: FloatArray,
    memory: FloatArray,
    record: FloatArray,
    dense: FloatArray,
    most: int,
    until: float,
    accuracy: float,
) -> int:
    """Steps on until a step ends at `until` or later, or something happens: see the codes above.

    `begin` must have been called for these rows. Steps do not depend on `until`. They are written behind the
    first recorded(m)[0] of record (room, 2) and dense (room, 8, size), up to `most` in all.
    """
    w, m = head(cells, WORLD), head(memory, MACHINE)
    now, done = clock(m), recorded(m)
    while True:
        t = now[T]
        if t >= until:
            return REACHED
        if done[0] >= most:
            return FULL
        unpack(state(m), m.movable, poses(m), velocities(m))
        h = min(now[H], 0.5 * SWEEP / max(whirl(w, m), 1e-300))
        error = step(w, m, t, h, accuracy)
        if error > 1.0 or error != error:
            now[H] = h * (max(0.2, 0.9 * error**-0.125) if error < 1e100 else 0.25)
            if now[H] < SHORTEST * max(1.0, t):
                return STOPPED if error > 1e100 or error != error else CRAWLS
            continue
        watch(w, m, now[GREATEST], after(m))
        decisions(w, m, t + h, takes(m))
        if not densify(w, m, t, h) or whirls(w, m, h):
            now[H] = 0.5 * h
            if now[H] < SHORTEST * max(1.0, t):
                return CRAWLS
            continue
        code, share = first(w, m, t, h)
        if code == REACHED:
            now[H] = min(LONGEST, h * (min(5.0, 0.9 * error**-0.125) if error > 1e-8 else 5.0))
            _accept(m, t, h, record, dense)
            for k in range(m.watched):
                before(m)[k] = after(m)[k]
            continue
        share = _sharpen(w, m, code, t, h, share, accuracy)
        _accept(m, t, share * h, record, dense)
        return code


@part
def _accept(m: Any, t: float, h: float, record: FloatArray, dense: FloatArray) -> None:
    """Records the step just made dense, and makes its end the state."""
    n = recorded(m)[0]
    record[n, 0], record[n, 1] = t, t + h
    latest = dense_of(m)
    for q in range(POWERS):
        for k in range(m.size):
            dense[n, q, k] = latest[q, k]
    recorded(m)[0] = n + 1
    clock(m)[T] = t + h
    y, new, rate, last = state(m), newest(m), slope(m, 0), slope(m, 12)
    for k in range(m.size):
        y[k] = new[k]
        rate[k] = last[k]


@part
def _left(w: Any, m: Any, watched: int, pair: int, aim: float) -> float:
    """How far above its aim the state just reached has a watched function, or a pair's gap (pair >= 0)."""
    if pair >= 0:
        return pair_gap(w, m, pair, touched(m, pair)) / LENGTH
    watch(w, m, clock(m)[GREATEST], after(m))
    return after(m)[watched] - aim


@part
def _sharpen(
    w: Any,
    m: Any,
    code: int,
    t: float,
    h: float,
    share: float,
    accuracy: float,
) -> float:
    """Repeats the step with the length at which it happens, until what crosses zero is zero there by the
    step itself. Leaves newest(m) and dense_of(m) for that step; returns its share."""
    watched = -1
    for k in range(m.watched):
        if hits(m)[k] and (watched < 0 or before(m)[k] > before(m)[watched]):
            watched = k
    aim = aim_of(m, watched) if watched >= 0 else 0.0
    pair = int(clock(m)[AT]) if code == MET else -1
    hold = max(share, 1e-15)
    other, value_other = -1.0, 0.0
    x = hold
    for _ in range(6):
        step(w, m, t, x * h, accuracy)
        if code == SWITCHED or hold <= 1e-15:
            break
        value = _left(w, m, watched, pair, aim)
        if abs(value) < 1e-7:
            break
        if other < 0.0:
            # The first slope from a neighbour a thousandth of the step away, by a true step too.
            other = x * (1.0 - 1e-3)
            step(w, m, t, other * h, accuracy)
            value_other = _left(w, m, watched, pair, aim)
        if value == value_other:
            break
        better = x - value * (x - other) / (value - value_other)
        other, value_other = x, value
        if not 0.0 < better <= min(1.0, 2.0 * hold) or abs(better - x) < 1e-16:
            break
        x = better
    # Whatever was tried last: the state is that of the share returned.
    step(w, m, t, x * h, accuracy)
    densify(w, m, t, x * h)
    return x
