"""Impacts of a crowd: Newton's restitution, each at its own moment within a substep.

What would close within the substep is struck: those that approach are solved together, then those that
approach in consequence (so a Newton's cradle works). An impulse at the moment τ of a substep h moves a
body only h − τ long, so the way is put right by −τ Δv: a bounce is then as exact as the free flight.
"""

from __future__ import annotations

from math import hypot, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.groups import join, root
from physics.engine.robust.manifold import (
    BOUNCE,
    GAIN,
    GAP,
    HIT,
    LIVE,
    NX,
    NY,
    ONE,
    OTHER,
    PN,
    PT,
    RATE,
    SLIP,
    TARGET,
    TAU,
    WN,
    WT,
    renew,
)
from physics.engine.robust.memory import (
    ACTIVE,
    ASIDE,
    BLOW,
    CLOSING,
    CONTACTS,
    GIVES,
    GOAL,
    IMPULSE,
    SPURT,
    WHEN,
    acc_of,
    bars_of,
    ends_of,
    jacobian_of,
    place_of,
    pos_of,
    real_of,
    row_of,
    shift_of,
    tally_of,
    turns_of,
    vel_of,
    when_of,
    whole_of,
)
from physics.engine.robust.rates import haul, opening, press, rate_of, slipping
from physics.engine.robust.soft import bring_up, bring_up_rows, settle
from physics.engine.rows import CORD
from physics.engine.tables import gravity, inverses
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

FAST = 1e-4
"""m/s: what closes more slowly, over what gravity makes in a substep, lands without an impact."""
ROUNDS = 8
"""Of impacts in consequence of one another within a substep; after them, for as many again, all that still close
are dead, together with what was struck before."""
SWEEPS = 60.0
"""Rounds of sweeps in one."""
TAUT = 2e-6
"""m: a wire with no more slack bears a blow."""
CLOSE = 1e-11
"""m/s: sweeps of an impact end when no rate changes by more."""
ROUNDING = 1e-12
"""Share of what approaches bring that rounding may add to the energy."""


@part
def approach(gap: float, rate: float, pull: float, lag: float, h: float) -> tuple[float, float]:
    """(rate at which a gap closes, m/s, zero if it does not within h; when). rate: half a substep `lag` ago;
    pull: how the rate changes, m/s²."""
    now = rate + lag * pull
    if gap <= 0.0:
        return min(now, 0.0), 0.0
    if gap + h * now + 0.5 * h * h * pull >= 0.0:
        return 0.0, 0.0
    last = -sqrt(max(now * now - 2.0 * pull * gap, 0.0))
    when = 2.0 * gap / (-now - last) if now + last < 0.0 else h
    return last, min(when, h)


@part
def strike(w: Any, m: Any, h: float, lag: float) -> float:
    """Gives all that collides within the substep its velocity afterwards; the energy that is lost, J, or −1 if
    nothing collides. HIT of a contact becomes the fastest approach, m/s, if it was struck, else zero."""
    vel, real, whole, bars = vel_of(m), real_of(m), whole_of(m), bars_of(m)
    contacts, rows = tally_of(m)[CONTACTS], m.rows
    gx, gy = gravity(w)[0], gravity(w)[1]
    acc, jacobian, ends, shift = acc_of(m), jacobian_of(m), ends_of(m), shift_of(m)
    for k in range(contacts):
        real[HIT, k] = 0.0
    rounds = 0
    loss = 0.0
    while rounds <= 2 * ROUNDS:
        struck = False
        for k in range(contacts):
            pull = opening(real, whole, k, acc)
            gap = real[GAP, k]
            if rounds > 0:
                gap += opening(real, whole, k, shift)
            rate, when = approach(gap, opening(real, whole, k, vel), pull, lag, h)
            whole[LIVE, k] = 0
            if rate < -FAST - h * max(abs(real[NX, k] * gx + real[NY, k] * gy), abs(pull)):
                if not struck and rounds == 0:
                    _begin(m)
                struck = True
                whole[LIVE, k] = 1
                real[HIT, k] = max(real[HIT, k], -rate)
                real[TAU, k] = when
        for k in range(rows):
            row = row_of(m, k)
            rate = rate_of(jacobian, ends, k, vel)
            bars[k, GOAL], bars[k, BLOW], bars[k, SPURT], bars[k, WHEN] = rate, 0.0, 0.0, h
            if row.kind == CORD and bars[k, ACTIVE] == 1.0:
                # A slack wire bears nothing.
                bars[k, GOAL] = min(rate, 0.0) if row.gap <= TAUT else -np.inf
                pull = rate_of(jacobian, ends, k, acc)
                gap = row.gap
                if rounds > 0:
                    gap += rate_of(jacobian, ends, k, shift)
                fast, when = approach(gap, rate, pull, lag, h)
                if fast < -FAST - 2.0 * h * (abs(row.c) + hypot(gx, gy)):
                    if not struck and rounds == 0:
                        _begin(m)
                    struck = True
                    bars[k, GOAL], bars[k, SPURT] = -(lag + when) * pull, (lag + when) * pull
                    bars[k, WHEN], bars[k, BLOW] = when, 1.0
        if not struck:
            break
        if rounds >= ROUNDS:
            # What was struck before takes part, for a dead blow is no blow to what it is pressed against.
            for k in range(contacts):
                if whole[LIVE, k] == 0 and real[HIT, k] > 0.0:
                    whole[LIVE, k], real[TAU, k] = 1, h
        _agree(w, m, h)
        _aim(m, inverses(w), lag)
        if rows > 0:
            _aim_rows(w, m)
        loss += _solve(w, m, rounds < ROUNDS)
        bring_up(w, m)
        rounds += 1
    if rounds > 0:
        for k in range(contacts):
            real[PN, k], real[PT, k] = real[WN, k], real[WT, k]
        for k in range(rows):
            bars[k, IMPULSE] = bars[k, ASIDE]
    for k in range(contacts):
        whole[LIVE, k] = 1
    return max(loss, 0.0) if rounds > 0 else -1.0


@part
def _begin(m: Any) -> None:
    """Keeps the impulses of the last substep aside."""
    real, bars = real_of(m), bars_of(m)
    for k in range(tally_of(m)[CONTACTS]):
        real[WN, k], real[WT, k] = real[PN, k], real[PT, k]
    for k in range(m.rows):
        bars[k, ASIDE] = bars[k, IMPULSE]


@part
def _agree(w: Any, m: Any, h: float) -> None:
    """All that is struck together is struck at one moment, the first of its blows: what is struck too soon enters
    nothing, and a blow runs through wires and pins at once. It may be before the last blow, for the ways are
    straight, and to go back along one changes neither momentum nor its moment. Poses at that moment go to `place`."""
    real, whole, bars, ends = real_of(m), whole_of(m), bars_of(m), ends_of(m)
    pos, vel, shift, place, inverse = pos_of(m), vel_of(m), shift_of(m), place_of(m), inverses(w)
    contacts, bodies = tally_of(m)[CONTACTS], len(pos)
    group, first = np.arange(bodies), np.full(bodies, h)
    for k in range(contacts):
        if whole[LIVE, k] == 1:
            join(group, inverse, whole[ONE, k], whole[OTHER, k])
    for k in range(m.rows):
        if bars[k, ACTIVE] == 1.0 and bars[k, GOAL] > -np.inf:
            join(group, inverse, ends[k, 0], ends[k, 1])
    for k in range(contacts):
        if whole[LIVE, k] == 1:
            for end in range(2):
                at = root(group, whole[ONE + end, k])
                first[at] = min(first[at], real[TAU, k])
    for k in range(m.rows):
        for end in range(2):
            at = root(group, ends[k, end])
            first[at] = min(first[at], bars[k, WHEN])
    for k in range(contacts):
        if whole[LIVE, k] == 1:
            real[TAU, k] = _moment(group, inverse, first, whole[ONE, k], whole[OTHER, k])
    for k in range(m.rows):
        bars[k, WHEN] = _moment(group, inverse, first, ends[k, 0], ends[k, 1])
    for i in range(bodies):
        when = first[root(group, i)]
        for q in range(3):
            place[i, q] = pos[i, q] + shift[i, q] + when * vel[i, q]


@part
def _moment(group: IntArray, inverse: FloatArray, first: FloatArray, i: int, j: int) -> float:
    """When bodies i and j are struck: what is fixed says nothing."""
    return first[root(group, i if inverse[i, 0] > 0.0 or inverse[i, 2] > 0.0 else j)]


@part
def _aim(m: Any, inverse: FloatArray, lag: float) -> None:
    """Normals and levers of what is struck, where bodies are at the moment of the blow: through other points it
    would change their angular momentum."""
    vel, acc, real, whole, place = vel_of(m), acc_of(m), real_of(m), whole_of(m), place_of(m)
    turns = turns_of(m).copy()
    for i in range(len(place)):
        turns[i, 0], turns[i, 1] = np.cos(place[i, 2]), np.sin(place[i, 2])
    for k in range(tally_of(m)[CONTACTS]):
        if whole[LIVE, k] == 1:
            renew(k, place, turns, inverse, real, whole)
            real[GAIN, k] = (lag + real[TAU, k]) * opening(real, whole, k, acc)
            real[RATE, k] = opening(real, whole, k, vel) + real[GAIN, k]


@part
def _aim_rows(w: Any, m: Any) -> None:
    """The same for wires and pins: what is not struck itself keeps the rate that it has there."""
    vel, bars, jacobian, ends = vel_of(m), bars_of(m), jacobian_of(m), ends_of(m)
    bring_up_rows(w, m, place_of(m), vel)
    for k in range(m.rows):
        bars[k, CLOSING] = rate_of(jacobian, ends, k, vel)
        if bars[k, BLOW] == 0.0 and bars[k, GOAL] > -np.inf:
            bars[k, GOAL] = min(bars[k, CLOSING], 0.0) if row_of(m, k).kind == CORD else bars[k, CLOSING]


@part
def _solve(w: Any, m: Any, lively: bool) -> float:
    """One round; the energy that it takes, J. Newton's restitution and friction together can create energy (Kane
    and Levinson 1985): then the round is dead, which never does."""
    vel, real, whole, bars = vel_of(m), real_of(m), whole_of(m), bars_of(m)
    contacts, rows, inverse = tally_of(m)[CONTACTS], len(bars), inverses(w)
    jacobian, ends, shift, since = jacobian_of(m), ends_of(m), shift_of(m), when_of(m)
    for k in range(contacts):
        real[SLIP, k] = slipping(real, whole, k, vel)
    bounce, loss = 1.0 if lively else 0.0, 0.0
    while True:
        for k in range(contacts):
            real[PN, k], real[PT, k] = 0.0, 0.0
            real[TARGET, k] = -real[GAIN, k] - bounce * real[BOUNCE, k] * real[RATE, k]
        for k in range(rows):
            bars[k, IMPULSE] = 0.0
        settle(real, whole, bars, jacobian, ends, inverse, contacts, vel, SWEEPS, CLOSE, 1.0)
        loss = 0.0
        scale = 0.0
        for k in range(contacts):
            if whole[LIVE, k] == 1:
                rate = opening(real, whole, k, vel) + real[GAIN, k]
                loss -= 0.5 * real[PN, k] * (real[RATE, k] + rate)
                loss -= 0.5 * real[PT, k] * (real[SLIP, k] + slipping(real, whole, k, vel))
                scale -= real[PN, k] * real[RATE, k]
        if bounce == 0.0 or loss >= -ROUNDING * scale:
            break
        bounce = 0.0
        for k in range(contacts):
            if whole[LIVE, k] == 1:
                press(real, whole, inverse, k, -real[PN, k], -real[PT, k], vel)
        for k in range(rows):
            haul(jacobian, ends, inverse, k, -bars[k, IMPULSE], vel)
    for k in range(contacts):
        if whole[LIVE, k] == 1 and real[PN, k] > 0.0:
            i, j, when = whole[ONE, k], whole[OTHER, k], real[TAU, k]
            press(real, whole, inverse, k, -when * real[PN, k], -when * real[PT, k], shift)
            since[i], since[j] = min(since[i], when), min(since[j], when)
    for k in range(rows):
        if bars[k, IMPULSE] != 0.0:
            rate = rate_of(jacobian, ends, k, vel)
            loss -= bars[k, IMPULSE] * (0.5 * (bars[k, CLOSING] + rate) + bars[k, SPURT])
            for end in range(2):
                since[ends[k, end]] = min(since[ends[k, end]], bars[k, WHEN])
            haul(jacobian, ends, inverse, k, -bars[k, WHEN] * bars[k, IMPULSE], shift)
            bars[k, GIVES] = max(bars[k, GIVES], bars[k, IMPULSE])
    return loss
