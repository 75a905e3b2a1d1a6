"""What is kept of a run, record by record: states, forces of rows and contacts, and when bodies were struck."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.crowd import Record
from physics.engine.robust.manifold import HIT, NX, NY, ONE, OTHER, PAIR, PN, PT, PX, PY
from physics.engine.robust.memory import (
    ACTIVE,
    CONTACTS,
    FORCE,
    IMPULSE,
    PRESSED,
    RECORDS,
    acc_of,
    bars_of,
    before_of,
    ends_of,
    ledger_of,
    now_of,
    pos_of,
    real_of,
    start_of,
    tally_of,
    when_of,
    whole_of,
)
from physics.engine.tables import inverses, link_of, pair_of
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]


@part
def mark(w: Any, m: Any, record: Record, since: float) -> None:
    """Keeps when bodies were first struck. since: the last record, s."""
    start, before, when, at = start_of(m), before_of(m), when_of(m), tally_of(m)[RECORDS] - 1
    real, whole, bars, ends, inverse = real_of(m), whole_of(m), bars_of(m), ends_of(m), inverses(w)
    uneven = True
    while uneven:
        # What one blow after another joined is shown struck at once, for momentum goes from one to another.
        uneven = False
        for k in range(tally_of(m)[CONTACTS]):
            if real[HIT, k] > 0.0:
                uneven = _level(when, inverse, whole[ONE, k], whole[OTHER, k]) or uneven
        for k in range(m.rows):
            if bars[k, ACTIVE] == 1.0:
                uneven = _level(when, inverse, ends[k, 0], ends[k, 1]) or uneven
    earlier = False
    for i in range(len(start)):
        earlier = earlier or record.struck[at, i] >= 0.0
    for i in range(len(start)):
        if before[i, 0] != start[i, 0] or before[i, 1] != start[i, 1] or before[i, 2] != start[i, 2]:
            if record.struck[at, i] < 0.0:
                record.struck[at, i] = since + (when[i] if when[i] < np.inf else 0.0)
            for q in range(3):
                record.jump[at, i, q] += before[i, q] - start[i, q]
    if earlier:
        first = np.inf
        for i in range(len(start)):
            if record.struck[at, i] >= 0.0:
                first = min(first, record.struck[at, i])
        for i in range(len(start)):
            if record.struck[at, i] >= 0.0:
                record.struck[at, i] = first


@part
def _level(when: FloatArray, inverse: FloatArray, i: int, j: int) -> bool:
    """Brings the moments of two bodies that were both struck, and can move, to the first; whether they differed."""
    first = min(when[i], when[j])
    last = max(when[i], when[j])
    if first == last or last == np.inf or inverse[i, 0] == 0.0 or inverse[j, 0] == 0.0:
        return False
    when[i], when[j] = first, first
    return True


@part
def keep(w: Any, m: Any, record: Record, kick: float) -> None:
    """One record more: the state of now, and all forces of a kick that was so long (s)."""
    tally, bars, ledger, rows = tally_of(m), bars_of(m), ledger_of(m), m.rows
    at = tally[RECORDS]
    _copy(pos_of(m), record.pos, at)
    _copy(now_of(m), record.vel, at)
    _copy(acc_of(m), record.acc, at)
    for k in range(m.entries):
        record.ledger[at, k] = ledger[k]
    for k in range(rows):
        record.pulls[at, k] = bars[k, IMPULSE] / kick
    for k in range(w.links):
        record.wound[at, k] = link_of(w, k).wound
    tally[PRESSED] = _press_on(
        w,
        real_of(m),
        whole_of(m),
        tally[CONTACTS],
        record.pairs,
        record.forces,
        tally[PRESSED],
        kick,
    )
    record.ends[at] = tally[PRESSED]
    for i in range(record.struck.shape[1]):
        record.struck[at, i] = -1.0
        for q in range(3):
            record.jump[at, i, q] = 0.0
    tally[RECORDS] = at + 1


@part
def _copy(now: FloatArray, kept: FloatArray, at: int) -> None:
    for i in range(len(now)):
        for q in range(3):
            kept[at, i, q] = now[i, q]


@part
def _press_on(
    w: Any,
    real: FloatArray,
    whole: IntArray,
    contacts: int,
    numbers: NDArray[np.int32],
    forces: FloatArray,
    pressed: int,
    kick: float,
) -> int:
    """Adds the forces of pairs that press, each at its centre of pressure; how many there are now."""
    last = -1
    weight = 0.0
    for k in range(contacts):
        normal, along = real[PN, k], real[PT, k]
        if normal <= 0.0:
            continue
        pair = whole[PAIR, k]
        if pair != last:
            last, weight = pair, 0.0
            numbers[pressed] = pair
            for q in range(FORCE):
                forces[pressed, q] = 0.0
            pressed += 1
        at = pressed - 1
        sign = (1.0 if whole[OTHER, k] == pair_of(w, pair).j else -1.0) / kick
        forces[at, 0] += sign * real[NX, k] * normal
        forces[at, 1] += sign * real[NY, k] * normal
        forces[at, 2] -= sign * real[NY, k] * along
        forces[at, 3] += sign * real[NX, k] * along
        weight += normal
        forces[at, 4] += (real[PX, k] - forces[at, 4]) * normal / weight
        forces[at, 5] += (real[PY, k] - forces[at, 5]) * normal / weight
    return pressed
