"""The motion from one event to the next: steps of the length that the accuracy allows, and the moment
within a step at which something happens, found to rounding.

Moments are first found on the step's dense output, then on true steps of that length, so that the
state at an event is as good as at any step's end. Frame: SI units, y up.
"""

from __future__ import annotations

from math import ceil
from typing import Any

from physics.engine.cells import head
from physics.engine.exact.integrate import between, densify, derive, step, unpack
from physics.engine.exact.machine import (
    AT,
    GREATEST,
    MACHINE,
    POWERS,
    H,
    T,
    after,
    before,
    candidates,
    clock,
    dense_of,
    forces_of,
    gaps,
    hits,
    kept,
    newest,
    olds,
    poses,
    recorded,
    row_of,
    slope,
    state,
    takes,
    took,
    velocities,
)
from physics.engine.exact.touch import TOUCHING
from physics.engine.exact.watch import (
    LENGTH,
    SWEEP,
    decisions,
    excused,
    pair_gap,
    quickness,
    touched,
    watch,
    whirl,
    whirls,
)
from physics.engine.tables import WORLD, gravity, masses, pair_of
from physics.jit import kernel, part
from sketch.ink import FloatArray

REACHED, FULL, HAPPENED, MET, SWITCHED, STOPPED, CRAWLS = 0, 1, 2, 3, 4, 5, 6
"""Why `flow` came back: the time is reached; the record is full; a watched function crossed zero; two bodies
meet; a formula takes another branch; a formula has no value; the motion is too fast to follow."""

LONGEST = 0.25
"""s: the longest step, so that no force dips below zero and returns unseen."""
SHORTEST = 1e-13
"""s (a share of the time above 1 s): a step that is no step."""
SAMPLES = 256
"""Places within a step at which gaps are looked at, at most."""
VERGE = 1e-3
"""Share of the way between two such places: so near the step's ends it is looked as well, since there the
slope tells whether a gap falls at first, or rises at last, and so may close and open unseen."""


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
        code, share = _first(w, m, t, h)
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
def _first(w: Any, m: Any, t: float, h: float) -> tuple[int, float]:
    """What happens first within the step, and at which share of it."""
    code, share = REACHED, 1.0
    now = clock(m)
    hits(m)[:] = 0
    for k in range(m.watched):
        if after(m)[k] < -1.0:
            when = _falls(w, m, k, t, h, _aim(m, k), 0.0, 1.0)
            if when < share - 1e-12:
                hits(m)[:k] = 0
            if when <= share + 1e-12:
                hits(m)[k] = 1
                code, share = HAPPENED, min(when, share)
    for p in range(m.programs):
        if takes(m)[p] != took(m)[p]:
            when = _switching(w, m, t, h)
            if when < share - 1e-12:
                code, share = SWITCHED, when
            break
    met, pair = _meeting(w, m, t, h, share)
    if met < share - 1e-12:
        now[AT] = pair
        code, share = MET, met
    if code != HAPPENED:
        hits(m)[:] = 0
    return code, share


@part
def _aim(m: Any, k: int) -> float:
    """What watched function k must fall below for something to have happened: zero, or its tolerance where it
    begins at zero."""
    return 0.0 if before(m)[k] > 1.0 else -1.0


@part
def _look(w: Any, m: Any, what: int, t: float, h: float, x: float) -> float:
    """A function of the motion at share x of the step, by the dense output: the watched function `what`, or, from
    m.watched on, the gap of a pair in units of `LENGTH`."""
    scratch = slope(m, 1)
    between(dense_of(m), x, scratch)
    if what >= m.watched:
        p = what - m.watched
        unpack(scratch, m.movable, poses(m), velocities(m))
        return pair_gap(w, m, p, touched(m, p)) / LENGTH
    derive(w, m, t + x * h, scratch, slope(m, 2))
    watch(w, m, clock(m)[GREATEST], kept(m))
    return kept(m)[what]


@part
def _falls(w: Any, m: Any, what: int, t: float, h: float, aim: float, low: float, high: float) -> float:
    """The share between low and high at which a function falls below `aim`, where it is at high: the Illinois
    method. Where it begins below and rises first (a bounce), the beginning is passed by halving towards it."""
    above, below = _look(w, m, what, t, h, low) - aim, _look(w, m, what, t, h, high) - aim
    if above <= 1.0:
        start = low
        x = high
        for _ in range(60):
            x = start + 0.5 * (x - start)
            above = _look(w, m, what, t, h, x) - aim
            if above > 0.0:
                break
            high, below = x, above
        if above <= 0.0:
            return high
        low = x
    side = 0
    for _ in range(80):
        x = (low * below - high * above) / (below - above)
        if not low < x < high or high - low < 1e-15:
            break
        value = _look(w, m, what, t, h, x) - aim
        if value > 0.0:
            low, above = x, value
            if side == 1:
                below *= 0.5
            side = 1
        else:
            high, below = x, value
            if side == -1:
                above *= 0.5
            side = -1
            if value == 0.0:
                break
    return high


@part
def _switching(w: Any, m: Any, t: float, h: float) -> float:
    """The share of the step just after which a formula takes another branch, by bisection."""
    low, high = 0.0, 1.0
    scratch = slope(m, 1)
    for _ in range(60):
        x = 0.5 * (low + high)
        if high - low < 4e-16 * max(1.0, t / h):
            break
        between(dense_of(m), x, scratch)
        unpack(scratch, m.movable, poses(m), velocities(m))
        decisions(w, m, t + x * h, takes(m))
        same = True
        for p in range(m.programs):
            same = same and takes(m)[p] == took(m)[p]
        if same:
            low = x
        else:
            high = x
    return high


@part
def _meeting(w: Any, m: Any, t: float, h: float, most: float) -> tuple[float, int]:
    """(share of the step at which two bodies first meet, at most `most`; the pair); (2, −1) if none do."""
    n, samples = _candidates(w, m, h)
    if n == 0:
        return 2.0, -1
    scratch = slope(m, 1)
    first, pair = 2.0, -1
    older, last = 0.0, 0.0
    for s in range(samples + 2):
        x = most * _place(s, samples)
        between(dense_of(m), x, scratch)
        unpack(scratch, m.movable, poses(m), velocities(m))
        for c in range(n):
            p = candidates(m)[c]
            gap = pair_gap(w, m, p, touched(m, p))
            at = 2.0
            if gap < -LENGTH:
                at = _falls(w, m, m.watched + p, t, h, 0.0, last, x)
            elif s > 0 and _may_dip(olds(m)[c], gaps(m)[c], gap, last - older, x - last):
                at = _grazes(w, m, p, t, h, older, x)
            if at < first:
                first, pair = at, p
            olds(m)[c] = gaps(m)[c]
            gaps(m)[c] = gap
            between(dense_of(m), x, scratch)
            unpack(scratch, m.movable, poses(m), velocities(m))
        if pair >= 0:
            return _earliest(w, m, n, t, h, last if first > last else older, first, pair)
        older, last = last, x
    return 2.0, -1


@part
def _earliest(
    w: Any, m: Any, n: int, t: float, h: float, low: float, first: float, pair: int
) -> tuple[float, int]:
    """The first of all candidates to meet, given that one does at share `first` and that none has at `low`: another
    may be in the midst of a dip by then."""
    for _ in range(n):
        earlier = False
        for c in range(n):
            p = candidates(m)[c]
            if p != pair and _look(w, m, m.watched + p, t, h, first) < -1.0:
                when = _falls(w, m, m.watched + p, t, h, 0.0, low, first)
                if when < first:
                    first, pair, earlier = when, p, True
        if not earlier:
            break
    return first, pair


@part
def _place(s: int, samples: int) -> float:
    """Where to look the s-th time, of samples + 2 times, as a share of the step."""
    if s == 0:
        return VERGE / samples
    if s < samples:
        return s / samples
    return 1.0 - VERGE / samples if s == samples else 1.0


@part
def _may_dip(before: float, here: float, after: float, back: float, on: float) -> bool:
    """Whether a gap that is least of three at the middle one may close about it: were it convex, it would stay
    above the two lines through neighbours. back, on: how far it is to either."""
    if here >= before or here >= after:
        return False
    return here - max((before - here) / back * on, (after - here) / on * back) < TOUCHING


@part
def _candidates(w: Any, m: Any, h: float) -> tuple[int, int]:
    """Lists the pairs that may meet within the step, with their gaps at its start; how many, and how many
    samples it takes not to miss one."""
    samples = 4
    n = 0
    for p in range(w.pairs):
        gaps(m)[p] = 0.0
    scratch = slope(m, 1)
    for s in range(3):
        between(dense_of(m), 0.5 * s, scratch)
        unpack(scratch, m.movable, poses(m), velocities(m))
        for p in range(w.pairs):
            gaps(m)[p] = max(gaps(m)[p], quickness(w, m, p))
    unpack(state(m), m.movable, poses(m), velocities(m))
    for p in range(w.pairs):
        pair = pair_of(w, p)
        way = 1.3 * gaps(m)[p] * h
        dx, dy = poses(m)[pair.j, 0] - poses(m)[pair.i, 0], poses(m)[pair.j, 1] - poses(m)[pair.i, 1]
        if way == 0.0 or dx * dx + dy * dy > (pair.reach + way) ** 2 or excused(w, p):
            continue
        gap = pair_gap(w, m, p, touched(m, p))
        if gap > way:
            continue
        samples = max(samples, min(SAMPLES, ceil(way / (0.25 * pair.size))))
        candidates(m)[n] = p
        gaps(m)[n] = gap
        olds(m)[n] = gap
        n += 1
    return n, samples


@part
def _grazes(w: Any, m: Any, p: int, t: float, h: float, low: float, high: float) -> float:
    """The share at which pair p meets where its gap is open at low and at high and least in between (golden
    section); 2 if it stays open."""
    start, what = low, m.watched + p
    golden = 0.6180339887498949
    for _ in range(60):
        one, two = high - golden * (high - low), low + golden * (high - low)
        first, second = _look(w, m, what, t, h, one), _look(w, m, what, t, h, two)
        if first < -1.0:
            return _falls(w, m, what, t, h, 0.0, start, one)
        if second < -1.0:
            return _falls(w, m, what, t, h, 0.0, start, two)
        if high - low < 1e-9:
            break
        if first < second:
            high = two
        else:
            low = one
    return 2.0


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
    aim = _aim(m, watched) if watched >= 0 else 0.0
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
