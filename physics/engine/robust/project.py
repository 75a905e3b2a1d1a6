"""Poses put right: overlap let out, pins and wires closed, by the least that does it.

Velocities stay as they are, so this gives no speed and keeps momentum; what energy it takes or gives is told by
the run's ledger. Shifts of poses are found as impulses are, in the metric of the masses (Jakobsen 2001; Müller
and others 2007, position based dynamics), without friction.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.robust.manifold import GAP, PN, PT, TARGET, WN, WT
from physics.engine.robust.memory import (
    ACTIVE,
    ASIDE,
    CONTACTS,
    GOAL,
    IMPULSE,
    bars_of,
    ends_of,
    jacobian_of,
    pos_of,
    real_of,
    row_of,
    shift_of,
    tally_of,
    turns_of,
    whole_of,
)
from physics.engine.robust.soft import bring_up, settle
from physics.engine.rows import CORD, GIVEN, POINT
from physics.engine.tables import inverses
from physics.jit import part

SLOP = 1e-6
"""m: overlap that is left as it is, and far below what can be seen."""
LOOSE = 1e-6
"""m: by so much a pin or wire may be wrong: the next substep puts that right by itself."""
SPEED = 1.0
"""m/s: however deep the overlap or however wrong the drawing."""
TURNS = 4
"""Linearized this often."""
SWEEPS = 12.0
"""Rounds of sweeps in each."""
CLOSE = 1e-9
"""m: shifts that change by less are found."""


@part
def project(w: Any, m: Any, h: float) -> bool:
    """Puts poses right; whether any had to be. Contacts and rows are up to date before and after."""
    real, bars, pos, shift, turns = real_of(m), bars_of(m), pos_of(m), shift_of(m), turns_of(m)
    contacts, rows, inverse = tally_of(m)[CONTACTS], m.rows, inverses(w)
    moved = False
    for _ in range(TURNS):
        deep, wrong = 0.0, 0.0
        for k in range(contacts):
            deep = max(deep, -real[GAP, k])
        for k in range(rows):
            row = row_of(m, k)
            if bars[k, ACTIVE] == 1.0 and row.kind != GIVEN and row.kind != POINT:
                wrong = max(wrong, -row.gap if row.kind == CORD else abs(row.gap))
        if deep <= SLOP and wrong <= LOOSE:
            break
        moved = True
        most = SPEED * h / TURNS
        for k in range(contacts):
            real[WN, k], real[WT, k], real[PN, k], real[PT, k] = real[PN, k], real[PT, k], 0.0, 0.0
            real[TARGET, k] = min(-real[GAP, k], most)
        for k in range(rows):
            row = row_of(m, k)
            bars[k, ASIDE], bars[k, IMPULSE] = bars[k, IMPULSE], 0.0
            if row.kind == GIVEN or row.kind == POINT:
                bars[k, ACTIVE] = 0.0
            else:
                bars[k, GOAL] = min(max(-row.gap, -most), most) if row.kind != CORD else min(-row.gap, most)
        settle(
            real, whole_of(m), bars, jacobian_of(m), ends_of(m), inverse, contacts, shift, SWEEPS, CLOSE, 0.0
        )
        for k in range(contacts):
            real[PN, k], real[PT, k] = real[WN, k], real[WT, k]
        for k in range(rows):
            bars[k, IMPULSE] = bars[k, ASIDE]
        for i in range(len(shift)):
            for q in range(3):
                if inverse[i, q] > 0.0:
                    pos[i, q] += shift[i, q]
                shift[i, q] = 0.0
            turns[i, 0], turns[i, 1] = np.cos(pos[i, 2]), np.sin(pos[i, 2])
        bring_up(w, m)
    return moved
