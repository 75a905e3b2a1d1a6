"""Landings: what has just come to press stops within one kick, and such an acceleration does not last."""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.robust.collide import FAST
from physics.engine.robust.groups import join, root
from physics.engine.robust.manifold import ONE, OTHER, PN, TARGET, WN
from physics.engine.robust.memory import (
    ACTIVE,
    ASIDE,
    CONTACTS,
    GOAL,
    IMPULSE,
    LANDED,
    acc_of,
    bars_of,
    ends_of,
    force_of,
    real_of,
    row_of,
    tally_of,
    whole_of,
)
from physics.engine.rows import CORD
from physics.engine.tables import inverses, masses, reaches
from physics.jit import part

LANDING = 2.0
"""An acceleration that is greater by this factor than all forces but the contacts' would make it is a landing's."""


@part
def landed(m: Any) -> None:
    """Tells whether a kick stopped something that was still apart and did not press before (`WN`, `ASIDE`: the
    impulses of the kick before)."""
    real, bars, tally = real_of(m), bars_of(m), tally_of(m)
    tally[LANDED] = 0
    for k in range(tally[CONTACTS]):
        if real[PN, k] > 0.0 and real[WN, k] == 0.0 and real[TARGET, k] < -FAST:
            tally[LANDED] = 1
    for k in range(m.rows):
        fresh = bars[k, IMPULSE] > 0.0 and bars[k, ASIDE] == 0.0
        if row_of(m, k).kind == CORD and fresh and bars[k, GOAL] < -FAST:
            tally[LANDED] = 1


@part
def forget(w: Any, m: Any) -> None:
    """Accelerations that a landing made are none to go on with: what is held up by anything fixed has none, what
    presses and pulls each other freely has its common one, so that momentum is kept."""
    acc, force, inverse, mass, reach = acc_of(m), force_of(m), inverses(w), masses(w), reaches(w)
    real, whole, bars, ends = real_of(m), whole_of(m), bars_of(m), ends_of(m)
    bodies = len(acc)
    group, held, struck, total = np.arange(bodies), np.zeros(bodies), np.zeros(bodies), np.zeros((bodies, 3))
    contacts = tally_of(m)[CONTACTS]
    for turn in range(2):
        # Groups first, then what holds them.
        for k in range(contacts):
            if real[PN, k] > 0.0:
                _meet(group, held, inverse, turn, whole[ONE, k], whole[OTHER, k])
        for k in range(m.rows):
            if bars[k, ACTIVE] == 1.0 and bars[k, IMPULSE] != 0.0:
                _meet(group, held, inverse, turn, ends[k, 0], ends[k, 1])
    for i in range(bodies):
        if inverse[i, 0] > 0.0:
            most = LANDING * (abs(force[i, 0]) * inverse[i, 0] + abs(force[i, 1]) * inverse[i, 1])
            turned = most + LANDING * abs(force[i, 2]) * inverse[i, 2] * reach[i]
            at = root(group, i)
            if abs(acc[i, 0]) + abs(acc[i, 1]) > most:
                struck[at] = 1.0
                if held[at] == 1.0:
                    acc[i, 0], acc[i, 1], acc[i, 2] = 0.0, 0.0, 0.0
            elif abs(acc[i, 2]) * reach[i] > turned:
                struck[at] = 1.0
                if held[at] == 1.0:
                    acc[i, 2] = 0.0
            total[at, 0] += mass[i, 0] * acc[i, 0]
            total[at, 1] += mass[i, 1] * acc[i, 1]
            total[at, 2] += mass[i, 0]
    for i in range(bodies):
        at = root(group, i)
        if struck[at] == 1.0 and held[at] == 0.0 and inverse[i, 0] > 0.0:
            acc[i, 0], acc[i, 1], acc[i, 2] = total[at, 0] / total[at, 2], total[at, 1] / total[at, 2], 0.0


@part
def _meet(group: Any, held: Any, inverse: Any, turn: int, i: int, j: int) -> None:
    """Bodies that press or pull each other: one group on the first turn; on the second, held if one is fixed."""
    if turn == 0:
        join(group, inverse, i, j)
    elif inverse[i, 0] == 0.0:
        held[root(group, j)] = 1.0
    elif inverse[j, 0] == 0.0:
        held[root(group, i)] = 1.0
