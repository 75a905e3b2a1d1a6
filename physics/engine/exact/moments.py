"""The moment within a step at which something happens first: a watched function falls below zero, a formula takes
another branch, two bodies meet; found on the step's dense output.

Frame: SI units, y up. Sources: Dowell and Jarratt (1971), the Illinois method; Kiefer (1953), golden section.
"""

from __future__ import annotations

from math import ceil
from typing import Any

from physics.engine.exact.integrate import between, derive, unpack
from physics.engine.exact.machine import (
    AT,
    GREATEST,
    after,
    before,
    candidates,
    clock,
    dense_of,
    gaps,
    hits,
    kept,
    olds,
    poses,
    row_of,
    slope,
    state,
    takes,
    took,
    velocities,
)
from physics.engine.exact.touch import TOUCHING
from physics.engine.exact.watch import LENGTH, decisions, excused, pair_gap, quickness, touched, watch
from physics.engine.forces import ends_of
from physics.engine.rows import CORD, ON
from physics.engine.tables import link_of, pair_of
from physics.jit import part

REACHED, FULL, HAPPENED, MET, SWITCHED, STOPPED, CRAWLS = 0, 1, 2, 3, 4, 5, 6
"""Why `flow` came back: the time is reached; the record is full; a watched function crossed zero; two bodies
meet; a formula takes another branch; a formula has no value; the motion is too fast to follow."""

CORDS = 8
"""Places within a step at which the slack of a slack wire is looked at."""
SAMPLES = 256
"""Places within a step at which gaps are looked at, at most."""
STEEP = 1e4
"""Values of a watched function this many times apart say nothing of where between them it falls: forces grow without
bound where a body is about to pass its last hold."""
VERGE = 1e-3
"""Share of the way between two such places: so near the step's ends it is looked as well, since there the
slope tells whether a gap falls at first, or rises at last, and so may close and open unseen."""


@part
def first(w: Any, m: Any, t: float, h: float) -> tuple[int, float]:
    """What happens first within the step, and at which share of it."""
    code, share = REACHED, 1.0
    now = clock(m)
    hits(m)[:] = 0
    for k in range(m.watched):
        if after(m)[k] < -1.0:
            when = _falls(w, m, k, t, h, aim_of(m, k), 0.0, 1.0)
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
    taut, cord = _tautens(w, m, t, h, share)
    if taut < share - 1e-12:
        hits(m)[:] = 0
        hits(m)[cord] = 1
        code, share = HAPPENED, taut
    if code != HAPPENED:
        hits(m)[:] = 0
    for _ in range(m.watched):
        sooner = _sooner(w, m, t, h, share) if share < 1.0 else 2.0
        if sooner >= share - 1e-12:
            break
        code, share = HAPPENED, sooner
    return code, share


@part
def _sooner(w: Any, m: Any, t: float, h: float, share: float) -> float:
    """When a watched function falls that is below its aim by this share of the step though not at the step's end:
    where a body is about to pass its last hold, forces that would pull turn into pushes. 2 where none does. Marks it."""
    scratch = slope(m, 1)
    soonest, found = 2.0, -1
    for s in range(1, 5):
        at = 0.25 * s * share
        between(dense_of(m), at, scratch)
        derive(w, m, t + at * h, scratch, slope(m, 2))
        watch(w, m, clock(m)[GREATEST], after(m))
        for k in range(m.watched):
            if hits(m)[k] == 0 and after(m)[k] < -1.0:
                when = _falls(w, m, k, t, h, aim_of(m, k), 0.0, at)
                if when < soonest:
                    soonest, found = when, k
        if found >= 0:
            break
    if soonest < share - 1e-12:
        hits(m)[:] = 0
        hits(m)[found] = 1
    return soonest


@part
def aim_of(m: Any, k: int) -> float:
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
        if max(above, -below) > STEEP * min(above, -below):
            x = 0.5 * (low + high)
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
                at = _grazes(w, m, m.watched + p, t, h, older, x)
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
def _grazes(w: Any, m: Any, what: int, t: float, h: float, low: float, high: float) -> float:
    """The share at which a function falls below zero that is above it at low and at high and least in between
    (golden section); 2 if it stays above."""
    start = low
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
def _tautens(w: Any, m: Any, t: float, h: float, most: float) -> tuple[float, int]:
    """(share of the step at which a slack wire first tautens, at most `most`; which watched function that is), for
    those that are slack again at the step's end; (2, −1) if none does."""
    first, found = 2.0, -1
    scratch = slope(m, 1)
    for k in range(m.rows):
        row = row_of(m, k)
        if row.kind != CORD or row.status == ON:
            continue
        link = link_of(w, row.source)
        unpack(state(m), m.movable, poses(m), velocities(m))
        here = link.rest - ends_of(w, row.source, poses(m))[8]
        before_, last, older = here, 0.0, 0.0
        for s in range(CORDS + 2):
            x = most * _place(s, CORDS)
            between(dense_of(m), x, scratch)
            unpack(scratch, m.movable, poses(m), velocities(m))
            gap = link.rest - ends_of(w, row.source, poses(m))[8]
            at = 2.0
            if s > 0 and _may_dip(before_, here, gap, last - older, x - last):
                at = _grazes(w, m, 3 * k, t, h, older, x)
            elif gap < -LENGTH and here > LENGTH:
                at = _falls(w, m, 3 * k, t, h, 0.0, last, x)
            if at < first:
                first, found = at, 3 * k
                break
            before_, here, older, last = here, gap, last, x
    return first, found
