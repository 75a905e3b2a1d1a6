"""Impacts: what velocities become when bodies meet, or a wire tautens.

Newton's restitution with Coulomb's friction. Contacts that approach at one moment are solved together;
those that approach in consequence come next, so that a blow runs through a row of balls as it does
through a Newton's cradle. Wires and pins take whatever impulse keeps them, without rebound. Restitution
and friction together can create energy (Kane and Levinson 1985); then there is as much restitution as
the energy allows.

Frame: SI units, y up. What the rows push in one blow: physics.engine.exact.blow.
"""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np

from physics.engine.cells import head
from physics.engine.exact.blow import HELD, JAMMED, blow
from physics.engine.exact.touch import TOUCHING
from physics.engine.rows import CORD, GIVEN, PIN_X, POINT, refresh, refresh_table
from physics.engine.tables import WORLD, inverses, masses
from physics.engine.world import Table
from physics.jit import kernel, part
from sketch.ink import FloatArray

APPROACH = 1e-9
"""m/s: slower ones do not meet."""
RISE = 1e-9
"""m: a rebound that would rise less stays away, and so does what would follow it: else there would be
infinitely many."""
ROUNDS = 60
"""Blows in consequence of one another, until they rebound no more and all that touches shares in them."""


@kernel
def strike(
    cells: FloatArray,
    rows: Table,
    pos: FloatArray,
    vel: FloatArray,
    rise: float,
    crowded: bool,
    before: FloatArray,
    struck: FloatArray,
) -> float:
    """Changes `vel`; returns the heat, J: NaN where no blow was found that fits. rows[k].press must be known.

    struck (rows,): how fast each contact closed when it was hit, m/s, zero if it was not. before: room for
    velocities. rise: m, see `RISE`; crowded: nothing rebounds.
    """
    w = head(cells, WORLD)
    energy = kinetic(w, vel)
    for k in range(len(rows)):
        struck[k] = 0.0
    for turn in range(8 * ROUNDS):
        refresh_table(rows, pos, vel)
        needed = False
        for k in range(len(rows)):
            row = rows[k]
            row.force = row.rub = 0.0
            # `bound` marks what takes part, `along` what it aims at: the rate afterwards.
            row.bound = 0.0
            if row.kind == GIVEN or row.gap > TOUCHING:
                continue
            if row.kind >= CORD:
                row.bound, row.along = 1.0, 0.0
                off = abs(row.rate) if row.kind >= PIN_X else -row.rate
                needed = needed or off > APPROACH
            elif row.rate >= -APPROACH and turn >= ROUNDS:
                # What is shut stays so: one after another, dead blows would go on without end.
                row.bound, row.along = 1.0, 0.0
            elif row.rate < -APPROACH:
                needed = True
                row.bound, row.along = 1.0, 0.0
                e = row.e
                rebound = e * row.rate
                low = row.press < 0.0 and rebound * rebound < -2.0 * row.press * rise and e < 1.0
                if low or crowded or turn >= ROUNDS:
                    e = 0.0
                    row.shut = 1
                row.along = -e * row.rate
                struck[k] = max(struck[k], -row.rate)
        if not needed:
            break
        for i in range(len(vel)):
            for a in range(3):
                before[i, a] = vel[i, a]
        start = kinetic(w, vel)
        found = blow(w, rows, vel)
        if kinetic(w, vel) > start * (1.0 + 1e-12):
            found = _calm(w, rows, vel, before, start) and found
        if not found:
            return np.nan
    refresh_table(rows, pos, vel)
    return energy - kinetic(w, vel)


@kernel
def hold(cells: FloatArray, rows: Table, pos: FloatArray, vel: FloatArray, rise: float) -> float:
    """Keeps shut, or taut, what would open by less than `rise` (m) before it is pressed shut again: two corners
    that lift each other, or two wires that slacken each other, would go on without end. Changes `vel`; returns the
    heat, J: NaN where no blow was found. rows[k].press must be known for those that open slowly; marks those that it holds `HELD`, and holds what
    is marked so already."""
    w = head(cells, WORLD)
    energy = kinetic(w, vel)
    needed = False
    for k in range(len(rows)):
        row = rows[k]
        if row.bound != HELD:
            row.bound = 0.0
        if row.kind == GIVEN or row.gap > TOUCHING:
            continue
        row.along = 0.0
        if row.bound == 0.0 and (row.kind >= PIN_X or row.rate <= APPROACH):
            # What is shut stays so: holding one contact must not push another in.
            row.bound = 1.0
        elif row.rate > APPROACH and row.rate**2 < -2.0 * row.press * rise and row.e < 1.0:
            row.bound = HELD
            needed = True
    if needed:
        if not blow(w, rows, vel):
            return np.nan
        refresh_table(rows, pos, vel)
    return energy - kinetic(w, vel)


@kernel
def stop(cells: FloatArray, rows: Table, pos: FloatArray, vel: FloatArray) -> float:
    """Stops the slip of rows marked `JAMMED` by impulses without an impact; what else is shut stays so. Changes `vel`;
    returns the heat, J: NaN where no blow was found.

    The rubbing may leave friction's cone a little where the blow sets another contact slipping: rigid bodies have no
    better answer where a row can neither hold nor leave (Painlevé 1895; Génot and Brogliato 1999)."""
    w = head(cells, WORLD)
    energy = kinetic(w, vel)
    refresh_table(rows, pos, vel)
    for k in range(len(rows)):
        row = rows[k]
        shut = row.gap <= TOUCHING and row.kind != GIVEN and (row.kind >= PIN_X or row.rate <= APPROACH)
        row.along = 0.0
        if row.bound != JAMMED:
            row.bound = 1.0 if shut else 0.0
    if not blow(w, rows, vel):
        return np.nan
    refresh_table(rows, pos, vel)
    return energy - kinetic(w, vel)


@part
def _calm(w: Any, rows: Table, vel: FloatArray, before: FloatArray, most: float) -> bool:
    """From the velocities before, as much of the way from the dead impact to the lively one as leaves the
    kinetic energy at `most`. Tells whether the dead one was found."""
    lively = vel.copy()
    for i in range(len(vel)):
        for a in range(3):
            vel[i, a] = before[i, a]
    for k in range(len(rows)):
        rows[k].along = 0.0
    found = blow(w, rows, vel)
    start, end = kinetic(w, vel), kinetic(w, lively)
    middle = kinetic(w, 0.5 * (vel + lively))
    # Along the way it is a parabola: start + slope s + bend s².
    bend = 2.0 * (start + end) - 4.0 * middle
    slope = end - start - bend
    room = max(most - start, 0.0)
    below = slope + sqrt(max(slope * slope + 4.0 * bend * room, 0.0))
    share = min(1.0, 2.0 * room / below) if below > 0.0 else 0.0
    for i in range(len(vel)):
        for a in range(3):
            vel[i, a] += share * (lively[i, a] - vel[i, a])
    return found


@part
def kinetic(w: Any, vel: FloatArray) -> float:
    """Of all that can move, J; along a course too."""
    total = 0.0
    for i in range(len(vel)):
        for a in range(3):
            if inverses(w)[i, a] > 0.0:
                total += 0.5 * masses(w)[i, a] * vel[i, a] ** 2
    return total


@kernel
def overlap(cells: FloatArray, rows: Table, pos: FloatArray) -> float:
    """Moves bodies that overlap apart, each by its share of mass, in one sweep over rows of contact; the
    deepest overlap before it, m."""
    inverse = inverses(head(cells, WORLD))
    deepest = 0.0
    still = pos * 0.0
    for k in range(len(rows)):
        row = rows[k]
        if row.kind > POINT:
            continue
        refresh(row, pos, still)
        deepest = max(deepest, -row.gap)
        if row.gap >= 0.0:
            continue
        # Shifted only: what was drawn upright stays upright.
        give = 0.0
        for a in range(2):
            give += row.J[a] ** 2 * inverse[row.i, a] + row.J[3 + a] ** 2 * inverse[row.j, a]
        if give > 0.0:
            for a in range(2):
                pos[row.i, a] -= inverse[row.i, a] * row.J[a] * row.gap / give
                pos[row.j, a] -= inverse[row.j, a] * row.J[3 + a] * row.gap / give
    return deepest
