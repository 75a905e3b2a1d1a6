"""Impacts of a crowd: Newton's restitution, each at its own moment within a substep.

What would close within the substep is struck: those that approach are solved together, then those that
approach in consequence (so a Newton's cradle works). An impulse at the moment τ of a substep h moves a
body only h − τ long, so the way is put right by −τ Δv: a bounce is then as exact as the free flight.
"""

from __future__ import annotations

from math import hypot, sqrt

from physics.engine.crowd import (
    ACTIVE,
    ASIDE,
    CONTACTS,
    GIVES,
    GOAL,
    HEFT,
    IMPULSE,
    LEAST,
    WHEN,
    Crowd,
)
from physics.engine.manifold import (
    BOUNCE,
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
    TARGET,
    TAU,
    WN,
    WT,
)
from physics.engine.rows import CORD
from physics.engine.soft import haul, opening, press, rate_of, settle
from physics.engine.world import World
from physics.jit import part
from sketch.ink import FloatArray

FAST = 1e-4
"""m/s: what closes more slowly, over what gravity makes in a substep, lands without an impact."""
ROUNDS = 8
"""Of impacts in consequence of one another within a substep; after them all that still close are dead."""
SWEEPS = 60.0
"""Rounds of sweeps in one."""
CLOSE = 1e-11
"""m/s: sweeps of an impact end when no rate changes by more."""
ROUNDING = 1e-12
"""Share by which rounding may raise the kinetic energy in an impact."""


@part
def kinetic(mass: FloatArray, movable: int, vel: FloatArray) -> float:
    """J."""
    total = 0.0
    for i in range(movable):
        for q in range(3):
            total += 0.5 * mass[i, q] * vel[i, q] ** 2
    return total


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
def strike(world: World, crowd: Crowd, movable: int, h: float, lag: float) -> float:
    """Gives all that collides within the substep its velocity afterwards; the energy that
    is lost, J, or −1 if nothing collides. HIT of a contact becomes the fastest approach, m/s, of those that were struck, else zero."""
    vel, real, whole, bars = crowd.vel, crowd.real, crowd.whole, crowd.bars
    contacts, rows = crowd.tally[CONTACTS], len(crowd.rows)
    gx, gy = world.gravity[0], world.gravity[1]
    acc, since = crowd.acc, crowd.when
    for k in range(contacts):
        real[k, HIT] = 0.0
    rounds = 0
    energy = kinetic(world.mass, movable, vel)
    while rounds <= ROUNDS:
        struck = False
        for k in range(contacts):
            pull = opening(real, whole, k, acc)
            rate, when = approach(real[k, GAP], opening(real, whole, k, vel), pull, lag, h)
            whole[k, LIVE] = 0
            if rate < -FAST - h * abs(real[k, NX] * gx + real[k, NY] * gy):
                if not struck and rounds == 0:
                    _begin(crowd)
                struck = True
                whole[k, LIVE] = 1
                real[k, HIT] = max(real[k, HIT], -rate)
                real[k, RATE], real[k, TAU] = rate, when
                real[k, TARGET] = -(lag + when) * pull
                if rounds > 0:
                    real[k, TAU] = max(when, since[whole[k, ONE]], since[whole[k, OTHER]])
        for k in range(rows):
            row = crowd.rows[k]
            rate = rate_of(crowd.jacobian, crowd.ends, k, vel)
            bars[k, GOAL] = min(rate, 0.0) if bars[k, LEAST] == 0.0 else rate
            bars[k, WHEN] = -1.0
            if row.kind == CORD and bars[k, ACTIVE] == 1.0:
                rate, when = approach(
                    row.gap, rate, rate_of(crowd.jacobian, crowd.ends, k, crowd.acc), lag, h
                )
                if rate < -FAST - 2.0 * h * (abs(row.c) + hypot(gx, gy)):
                    if not struck and rounds == 0:
                        _begin(crowd)
                    struck = True
                    bars[k, GOAL], bars[k, WHEN] = 0.0, when
        if not struck:
            break
        _solve(world, crowd, movable, rounds < ROUNDS)
        rounds += 1
    if rounds > 0:
        for k in range(contacts):
            real[k, PN], real[k, PT] = real[k, WN], real[k, WT]
        for k in range(rows):
            bars[k, IMPULSE] = bars[k, ASIDE]
    for k in range(contacts):
        whole[k, LIVE] = 1
    return max(energy - kinetic(world.mass, movable, vel), 0.0) if rounds > 0 else -1.0


@part
def _begin(crowd: Crowd) -> None:
    """Keeps the impulses of the last substep aside."""
    real, bars = crowd.real, crowd.bars
    for k in range(crowd.tally[CONTACTS]):
        real[k, WN], real[k, WT] = real[k, PN], real[k, PT]
    for k in range(len(crowd.rows)):
        bars[k, ASIDE] = bars[k, IMPULSE]


@part
def _solve(world: World, crowd: Crowd, movable: int, lively: bool) -> None:
    """One round. Newton's restitution and friction together can create energy (Kane and Levinson 1985): then
    the round is dead, which never does."""
    vel, real, whole, bars = crowd.vel, crowd.real, crowd.whole, crowd.bars
    contacts, rows, inverse = crowd.tally[CONTACTS], len(bars), world.inverse
    energy = kinetic(world.mass, movable, vel)
    for attempt in range(2):
        for k in range(contacts):
            real[k, PN], real[k, PT] = 0.0, 0.0
            if whole[k, LIVE] == 1 and attempt == 0 and lively:
                real[k, TARGET] -= real[k, BOUNCE] * real[k, RATE]
        for k in range(rows):
            bars[k, IMPULSE] = 0.0
        settle(real, whole, bars, crowd.jacobian, crowd.ends, inverse, contacts, vel, SWEEPS, CLOSE)
        if not lively or attempt == 1 or kinetic(world.mass, movable, vel) <= energy * (1.0 + ROUNDING):
            break
        for k in range(contacts):
            if whole[k, LIVE] == 1:
                press(real, whole, inverse, k, -real[k, PN], -real[k, PT], vel)
                real[k, TARGET] += real[k, BOUNCE] * real[k, RATE]
        for k in range(rows):
            haul(crowd.jacobian, crowd.ends, inverse, k, -bars[k, IMPULSE], vel)
    for k in range(contacts):
        if whole[k, LIVE] == 1 and real[k, PN] > 0.0:
            when = real[k, TAU]
            press(real, whole, inverse, k, -when * real[k, PN], -when * real[k, PT], crowd.shift)
            crowd.when[whole[k, ONE]] = max(crowd.when[whole[k, ONE]], when)
            crowd.when[whole[k, OTHER]] = max(crowd.when[whole[k, OTHER]], when)
    for k in range(rows):
        if bars[k, HEFT] > 0.0 and bars[k, IMPULSE] != 0.0:
            i, j = crowd.rows[k].i, crowd.rows[k].j
            when = bars[k, WHEN] if bars[k, WHEN] >= 0.0 else max(crowd.when[i], crowd.when[j])
            haul(crowd.jacobian, crowd.ends, inverse, k, -when * bars[k, IMPULSE], crowd.shift)
            bars[k, GIVES] = max(bars[k, GIVES], bars[k, IMPULSE])
