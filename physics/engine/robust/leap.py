"""All active rows of a crowd solved at once, where sweeps crawl: long chains, heavy bodies on light ones.

Which contacts press and which of them stick is guessed from the sweeps so far; with that the impulses are the
answer of a linear system, found by multipliers with a stiff penalty (Hestenes 1969; Powell 1969): forces that
are not unique change no more than they must. What then would pull or rub too much is let go, what would enter is
taken in, and it is solved again: an active set (Alart and Curnier 1991, without the line search).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.envelope import DEAREST, factorized, filled, laid_out, numbered, solved
from physics.engine.robust.manifold import (
    CA,
    CB,
    KN,
    KT,
    LIVE,
    MU,
    NX,
    NY,
    ONE,
    OTHER,
    PN,
    PT,
    TA,
    TARGET,
    TB,
)
from physics.engine.robust.memory import ACTIVE, GOAL, HEFT, IMPULSE, LEAST, MOST
from physics.engine.robust.rates import haul, opening, press, rate_of, slipping
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

STIFFNESS = 1e8
"""Of the penalty, against the mass that a row meets: what multipliers leave shrinks by it in each round."""
TURNS = 8
"""Guesses of what is active."""
ROUNDS = 12
"""Rounds of multipliers; only slipping takes more than two or three."""
EXACT = 1e-13
"""m/s, and as a share of the greatest rate that was lacking: what is left of it."""
LEFT = 1e-6
"""The same at most where all rounds are over. Rows that contradict one another are never right: each round would
press on them more, up to impulses whose rounding alone throws bodies off the page."""
WRONG = 1e-10
"""m/s: a rate that is less than wanted by no more is right."""
SLIPS = 0.999
"""Share of its bound at which friction is taken to slip."""

OFF, HELD, FORTH, BACK = 0, 1, 2, 3
"""A contact does not press; presses and sticks; slips, so that friction is along the tangent, or against it."""


@part
def leap(
    real: FloatArray,
    whole: IntArray,
    bars: FloatArray,
    jacobian: FloatArray,
    ends: IntArray,
    inverse: FloatArray,
    contacts: int,
    vel: FloatArray,
    rub: float,
) -> bool:
    """Impulses that make all active rates right, and velocities with them. False, and nothing changed, if no set
    of active rows was found, or if it would cost more than sweeps. rub: 0 without friction, else 1."""
    bodies, rows = len(inverse), len(bars)
    state, held = np.zeros(contacts, np.int64), np.zeros(rows, np.int64)
    kept, pulls, speed = np.empty((2, contacts)), np.empty(rows), vel.copy()
    for k in range(contacts):
        kept[0, k], kept[1, k] = real[PN, k], real[PT, k]
        if whole[LIVE, k] == 1 and real[PN, k] > 0.0 and real[KN, k] > 0.0:
            most = rub * real[MU, k] * real[PN, k]
            state[k] = HELD
            if most > 0.0 and abs(real[PT, k]) >= SLIPS * most:
                state[k] = FORTH if real[PT, k] > 0.0 else BACK
    for k in range(rows):
        pulls[k] = bars[k, IMPULSE]
        if bars[k, ACTIVE] == 1.0 and bars[k, HEFT] > 0.0:
            held[k] = 1 if bars[k, LEAST] < pulls[k] < bars[k, MOST] else 0
    place, first, base = (
        np.empty(bodies, np.int64),
        np.empty(3 * bodies, np.int64),
        np.empty(3 * bodies + 1, np.int64),
    )
    most_rows = 2 * contacts + rows
    who, source = np.empty((most_rows, 2), np.int64), np.empty((most_rows, 2), np.int64)
    way, stiff = np.zeros((most_rows, 6)), np.empty(most_rows)
    done = False
    for _ in range(TURNS):
        count = _gather(
            real, whole, bars, jacobian, ends, inverse, contacts, rub, state, held, who, source, way, stiff
        )
        found = numbered(who, count, inverse, place)
        if found == 0 or laid_out(who, count, place, found, first, base) > DEAREST:
            break
        matrix = np.zeros(base[3 * found])
        filled(who, way, stiff, count, place, inverse, base, matrix)
        if not factorized(first, base, 3 * found, matrix):
            break
        if not _multiply(
            real, whole, bars, jacobian, ends, inverse, contacts, vel, rub,
            state, who, source, way, stiff, count, place, first, base, found, matrix,
        ):  # fmt: skip
            break
        if not _revise(real, whole, bars, jacobian, ends, inverse, contacts, vel, rub, state, held):
            done = True
            break
    if not done:
        for k in range(contacts):
            real[PN, k], real[PT, k] = kept[0, k], kept[1, k]
        for k in range(rows):
            bars[k, IMPULSE] = pulls[k]
        for i in range(bodies):
            for q in range(3):
                vel[i, q] = speed[i, q]
    return done


@part
def _gather(
    real: FloatArray,
    whole: IntArray,
    bars: FloatArray,
    jacobian: FloatArray,
    ends: IntArray,
    inverse: FloatArray,
    contacts: int,
    rub: float,
    state: IntArray,
    held: IntArray,
    who: IntArray,
    source: IntArray,
    way: FloatArray,
    stiff: FloatArray,
) -> int:
    """Lists the active rows: bodies, what they are (0 normal, 1 tangent, 2 bar; number), way, stiffness."""
    count = 0
    for k in range(contacts):
        if state[k] == OFF:
            continue
        nx, ny = real[NX, k], real[NY, k]
        sticks = state[k] == HELD and rub * real[MU, k] > 0.0 and real[KT, k] > 0.0
        for kind in range(2 if sticks else 1):
            who[count, 0], who[count, 1] = whole[ONE, k], whole[OTHER, k]
            source[count, 0], source[count, 1] = kind, k
            if kind == 0:
                way[count, 0], way[count, 1], way[count, 2] = -nx, -ny, -real[CA, k]
                way[count, 3], way[count, 4], way[count, 5] = nx, ny, real[CB, k]
                stiff[count] = STIFFNESS * real[KN, k]
            else:
                way[count, 0], way[count, 1], way[count, 2] = ny, -nx, -real[TA, k]
                way[count, 3], way[count, 4], way[count, 5] = -ny, nx, real[TB, k]
                stiff[count] = STIFFNESS * real[KT, k]
            count += 1
    for k in range(len(bars)):
        if held[k] == 1:
            who[count, 0], who[count, 1] = ends[k, 0], ends[k, 1]
            source[count, 0], source[count, 1] = 2, k
            for q in range(6):
                way[count, q] = jacobian[k, q]
            stiff[count] = STIFFNESS * bars[k, HEFT]
            count += 1
    for k in range(count):
        for q in range(6):
            if inverse[who[k, q // 3], q % 3] == 0.0:
                way[k, q] = 0.0
    return count


@part
def _multiply(
    real: FloatArray,
    whole: IntArray,
    bars: FloatArray,
    jacobian: FloatArray,
    ends: IntArray,
    inverse: FloatArray,
    contacts: int,
    vel: FloatArray,
    rub: float,
    state: IntArray,
    who: IntArray,
    source: IntArray,
    way: FloatArray,
    stiff: FloatArray,
    count: int,
    place: IntArray,
    first: IntArray,
    base: IntArray,
    found: int,
    matrix: FloatArray,
) -> bool:
    """Rounds of multipliers on the rows listed, until their rates are right; whether they are."""
    lacks, side = np.empty(count), np.empty(3 * found)
    greatest, lacked = 0.0, 0.0
    for turn in range(ROUNDS + 1):
        worst = 0.0
        side[:] = 0.0
        for k in range(count):
            kind, number = source[k, 0], source[k, 1]
            if kind == 0:
                lacks[k] = real[TARGET, number] - opening(real, whole, number, vel)
            elif kind == 1:
                lacks[k] = -slipping(real, whole, number, vel)
            else:
                lacks[k] = bars[number, GOAL] - rate_of(jacobian, ends, number, vel)
            worst = max(worst, abs(lacks[k]))
            for q in range(6):
                i = place[who[k, q // 3]]
                if i >= 0:
                    side[3 * i + q % 3] += stiff[k] * lacks[k] * way[k, q]
        greatest = max(greatest, worst)
        if turn == 0:
            lacked = worst
        if worst <= EXACT * (1.0 + greatest):
            return True
        if turn == ROUNDS:
            return worst <= LEFT * (1.0 + lacked)
        solved(first, base, 3 * found, matrix, side)
        for k in range(count):
            gain = 0.0
            for q in range(6):
                i = place[who[k, q // 3]]
                if i >= 0:
                    gain += way[k, q] * side[3 * i + q % 3]
            lacks[k] = stiff[k] * (lacks[k] - gain)
        for k in range(count):
            kind, number, more = source[k, 0], source[k, 1], lacks[k]
            if kind == 0:
                real[PN, number] += more
                press(real, whole, inverse, number, more, 0.0, vel)
            elif kind == 1:
                real[PT, number] += more
                press(real, whole, inverse, number, 0.0, more, vel)
            else:
                bars[number, IMPULSE] += more
                haul(jacobian, ends, inverse, number, more, vel)
        for k in range(contacts):
            if state[k] == FORTH or state[k] == BACK:
                most = rub * real[MU, k] * max(real[PN, k], 0.0)
                _rub(real, whole, inverse, k, most if state[k] == FORTH else -most, vel)
    return False


@part
def _rub(
    real: FloatArray, whole: IntArray, inverse: FloatArray, k: int, wanted: float, vel: FloatArray
) -> None:
    """Brings the friction of contact k to a given impulse."""
    more = wanted - real[PT, k]
    if more != 0.0:
        real[PT, k] = wanted
        press(real, whole, inverse, k, 0.0, more, vel)


@part
def _revise(
    real: FloatArray,
    whole: IntArray,
    bars: FloatArray,
    jacobian: FloatArray,
    ends: IntArray,
    inverse: FloatArray,
    contacts: int,
    vel: FloatArray,
    rub: float,
    state: IntArray,
    held: IntArray,
) -> bool:
    """Corrects the guess of what is active, with impulses back within their bounds; whether it was wrong."""
    wrong = False
    # Rates first: to let one go changes those of others.
    for k in range(contacts):
        if whole[LIVE, k] == 0 or real[KN, k] == 0.0:
            continue
        if state[k] == OFF:
            if opening(real, whole, k, vel) < real[TARGET, k] - WRONG:
                state[k] = -1
                wrong = True
        elif state[k] != HELD:
            slip = slipping(real, whole, k, vel)
            if (slip if state[k] == FORTH else -slip) > WRONG:
                state[k] = HELD
                wrong = True
    for k in range(len(bars)):
        if held[k] == 0 and bars[k, ACTIVE] == 1.0 and bars[k, HEFT] > 0.0 and bars[k, LEAST] == 0.0:
            short = rate_of(jacobian, ends, k, vel) < bars[k, GOAL] - WRONG
            if short and bars[k, MOST] > 0.0:
                held[k] = -1
                wrong = True
    for k in range(contacts):
        if state[k] == -1:
            state[k] = HELD
        elif state[k] != OFF:
            if real[PN, k] < 0.0:
                press(real, whole, inverse, k, -real[PN, k], -real[PT, k], vel)
                real[PN, k], real[PT, k], state[k] = 0.0, 0.0, OFF
                wrong = True
            elif state[k] == HELD:
                most = rub * real[MU, k] * real[PN, k]
                if abs(real[PT, k]) > most and rub * real[MU, k] > 0.0:
                    state[k] = FORTH if real[PT, k] > 0.0 else BACK
                    wrong = wrong or abs(real[PT, k]) > most * (1.0 + 1e-9)
                    _rub(real, whole, inverse, k, most if real[PT, k] > 0.0 else -most, vel)
    for k in range(len(bars)):
        if held[k] == -1:
            held[k] = 1
        elif held[k] == 1:
            wanted = min(max(bars[k, IMPULSE], bars[k, LEAST]), bars[k, MOST])
            if wanted != bars[k, IMPULSE]:
                haul(jacobian, ends, inverse, k, wanted - bars[k, IMPULSE], vel)
                bars[k, IMPULSE], held[k] = wanted, 0
                wrong = True
    return wrong
