"""Impulses of a crowd: contacts and rows (wires, pins, rubbing) swept again and again.

Projected Gauss-Seidel (Moreau 1988; Jean and Moreau 1992): each takes the impulse that makes its own
rate right, clamped to what it may be: a contact only pushes, friction stays within Coulomb's bound.
Sweeps go forth and back and begin with the last substep's impulses, which are the answer wherever
nothing changes. Where that has not settled after a few rounds all active rows are solved at once
(physics.engine.robust.leap), and sweeps go on from there.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.leap import leap
from physics.engine.robust.manifold import (
    CA,
    CB,
    DN,
    DT,
    EASE,
    KN,
    KT,
    LIVE,
    MU,
    NX,
    NY,
    ON,
    ONE,
    OT,
    OTHER,
    PN,
    PT,
    TA,
    TARGET,
    TB,
    renew_all,
)
from physics.engine.robust.memory import (
    ACTIVE,
    CONTACTS,
    GOAL,
    HEFT,
    IMPULSE,
    LEAST,
    MOST,
    OLD,
    WAY,
    bars_of,
    jacobian_of,
    now_of,
    pos_of,
    real_of,
    row_of,
    tally_of,
    turns_of,
    whole_of,
)
from physics.engine.robust.rates import haul, press, rate_of
from physics.engine.rows import CORD, GIVEN, POINT, refresh
from physics.engine.tables import inverses, link_of, support_of
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

SMALL, ENOUGH = 1e-7, 6.0
"""m/s: smaller changes need no more than so many rounds; at rest the next substep goes on where this one ended."""
PATIENCE = 3.0
"""Rounds of sweeps before all is solved at once."""


@part
def bring_up(w: Any, m: Any) -> None:
    """Contacts and rows at the poses of now."""
    pos = pos_of(m)
    renew_all(tally_of(m)[CONTACTS], pos, turns_of(m), inverses(w), real_of(m), whole_of(m))
    bring_up_rows(w, m, pos, now_of(m))


@part
def bring_up_rows(w: Any, m: Any, pos: FloatArray, vel: FloatArray) -> None:
    """Rows at these poses and velocities."""
    jacobian, bars, inverse = jacobian_of(m), bars_of(m), inverses(w)
    for k in range(m.rows):
        row = row_of(m, k)
        refresh(row, pos, vel)
        light = 0.0
        rubs = row.kind == GIVEN or row.kind == POINT
        for q in range(6):
            jacobian[k, q] = row.T[q] if rubs else row.J[q]
            light += jacobian[k, q] ** 2 * inverse[row.i if q < 3 else row.j, q % 3]
        bars[k, HEFT] = 1.0 / light if light > 0.0 else 0.0
        if rubs:
            support = support_of(w, row.source)
            active = support.over == 1 and row.mu > 0.0
        else:
            link = link_of(w, row.source)
            active = link.broken == 0
            bars[k, LEAST] = 0.0 if row.kind == CORD else -np.inf
            bars[k, MOST] = np.inf
        bars[k, ACTIVE] = 1.0 if active else 0.0


@part
def _sweep(
    real: FloatArray,
    whole: IntArray,
    bars: FloatArray,
    jacobian: FloatArray,
    ends: IntArray,
    inverse: FloatArray,
    contacts: int,
    vel: FloatArray,
    rub: float,
    back: int,
) -> float:
    """Once over all rows and contacts; the greatest change of a rate, m/s."""
    change = 0.0
    rows = len(bars)
    for step in range(rows):
        k = rows - 1 - step if back == 1 else step
        heft = bars[k, HEFT]
        if bars[k, ACTIVE] == 0.0 or heft == 0.0:
            continue
        wanted = bars[k, IMPULSE] - (rate_of(jacobian, ends, k, vel) - bars[k, GOAL]) * heft
        wanted = min(max(wanted, bars[k, LEAST]), bars[k, MOST])
        more = wanted - bars[k, IMPULSE]
        if more != 0.0:
            bars[k, IMPULSE] = wanted
            haul(jacobian, ends, inverse, k, more, vel)
            change = max(change, abs(more) / heft)
    for step in range(contacts):
        k = contacts - 1 - step if back == 1 else step
        if whole[LIVE, k] == 0:
            continue
        i, j = whole[ONE, k], whole[OTHER, k]
        nx, ny, ca, cb = real[NX, k], real[NY, k], real[CA, k], real[CB, k]
        ux, uy, uw = vel[i, 0], vel[i, 1], vel[i, 2]
        wx, wy, ww = vel[j, 0], vel[j, 1], vel[j, 2]
        ix, iy, iw = inverse[i, 0], inverse[i, 1], inverse[i, 2]
        jx, jy, jw = inverse[j, 0], inverse[j, 1], inverse[j, 2]
        old = real[PN, k]
        if rub * real[MU, k] > 0.0:
            ta, tb = real[TA, k], real[TB, k]
            slip = nx * (wy - uy) - ny * (wx - ux) + tb * ww - ta * uw
            most, was = rub * real[MU, k] * max(old, 0.0), real[PT, k]
            along = min(max(was - slip * real[KT, k], -most), most)
            real[PT, k] = along
            more = along - was
            ux, uy, uw = ux + ix * ny * more, uy - iy * nx * more, uw - iw * ta * more
            wx, wy, ww = wx - jx * ny * more, wy + jy * nx * more, ww + jw * tb * more
            change = max(change, abs(more) * real[EASE, k])
        rate = nx * (wx - ux) + ny * (wy - uy) + cb * ww - ca * uw
        wanted = max(old - (rate - real[TARGET, k]) * real[KN, k], 0.0)
        real[PN, k] = wanted
        more = wanted - old
        vel[i, 0], vel[i, 1], vel[i, 2] = ux - ix * nx * more, uy - iy * ny * more, uw - iw * ca * more
        vel[j, 0], vel[j, 1], vel[j, 2] = wx + jx * nx * more, wy + jy * ny * more, ww + jw * cb * more
        change = max(change, abs(more) * real[EASE, k])
    return change


@part
def settle(
    real: FloatArray,
    whole: IntArray,
    bars: FloatArray,
    jacobian: FloatArray,
    ends: IntArray,
    inverse: FloatArray,
    contacts: int,
    vel: FloatArray,
    rounds: float,
    close: float,
    rub: float,
) -> None:
    """Sweeps forth and back until no rate changes by more than `close`, m/s, at most so many rounds, and at most
    `ENOUGH` once changes are `SMALL`. Before a round all go on along a conjugate direction (Silcowitz, Niebuhr
    and Erleben 2010), for sweeps alone carry a force only one contact further each time."""
    done, share, gone, again = 0.0, 0.0, 0.0, PATIENCE
    while True:
        for k in range(contacts):
            dn, dt = share * real[DN, k], share * real[DT, k]
            if whole[LIVE, k] == 1 and (dn != 0.0 or dt != 0.0):
                press(real, whole, inverse, k, dn, dt, vel)
            else:
                dn, dt = 0.0, 0.0
            real[ON, k], real[OT, k] = real[PN, k], real[PT, k]
            real[PN, k] += dn
            real[PT, k] += dt
            real[DN, k], real[DT, k] = dn, dt
        for k in range(len(bars)):
            more = share * bars[k, WAY] if bars[k, ACTIVE] == 1.0 and bars[k, HEFT] > 0.0 else 0.0
            if more != 0.0:
                haul(jacobian, ends, inverse, k, more, vel)
            bars[k, OLD], bars[k, WAY] = bars[k, IMPULSE], more
            bars[k, IMPULSE] += more
        change = 0.0
        for back in range(2):
            change = _sweep(real, whole, bars, jacobian, ends, inverse, contacts, vel, rub, back)
            if change <= close:
                return
        done += 1.0
        if done >= rounds or (change <= SMALL and done >= ENOUGH):
            return
        if done == again:
            again += PATIENCE + done
            if leap(real, whole, bars, jacobian, ends, inverse, contacts, vel, rub):
                share, gone = 0.0, 0.0
                for k in range(contacts):
                    real[DN, k], real[DT, k] = 0.0, 0.0
                for k in range(len(bars)):
                    bars[k, WAY] = 0.0
                continue
        # Gradient: what the sweeps alone changed. Direction: it and a share of the one before.
        size = 0.0
        for k in range(contacts):
            if whole[LIVE, k] == 1:
                gn, gt = real[PN, k] - real[ON, k] - real[DN, k], real[PT, k] - real[OT, k] - real[DT, k]
                size += (gn * gn + gt * gt) * real[EASE, k]
                real[DN, k] += gn
                real[DT, k] += gt
        for k in range(len(bars)):
            if bars[k, ACTIVE] == 1.0 and bars[k, HEFT] > 0.0:
                more = bars[k, IMPULSE] - bars[k, OLD] - bars[k, WAY]
                size += more * more / bars[k, HEFT]
                bars[k, WAY] += more
        share = min(size / gone, 1.0) if gone > 0.0 else 0.0
        gone = size
