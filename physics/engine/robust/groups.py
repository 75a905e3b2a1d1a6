"""Bodies in groups of those that act on each other (Tarjan 1975, halving paths)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.robust.manifold import HIT, ONE, OTHER, PN, WN
from physics.engine.robust.memory import (
    CONTACTS,
    before_of,
    real_of,
    start_of,
    tally_of,
    whole_of,
)
from physics.engine.tables import inverses, link_of
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]


@part
def root(group: IntArray, i: int) -> int:
    """The body that stands for the group of body i."""
    while group[i] != i:
        group[i] = group[group[i]]
        i = group[i]
    return i


@part
def join(group: IntArray, inverse: FloatArray, i: int, j: int) -> None:
    """Puts two bodies into one group, if both can move."""
    if (inverse[i, 0] > 0.0 or inverse[i, 2] > 0.0) and (inverse[j, 0] > 0.0 or inverse[j, 2] > 0.0):
        one, other = root(group, i), root(group, j)
        group[max(one, other)] = min(one, other)


@part
def blows(w: Any, m: Any) -> FloatArray:
    """1 for each body of whose group any was struck in this substep, else 0. A group is joined by links, by what
    presses now (PN) or did in the kick before (WN), and by blows."""
    start, before, inverse = start_of(m), before_of(m), inverses(w)
    real, whole = real_of(m), whole_of(m)
    bodies = len(start)
    group, struck = np.arange(bodies), np.zeros(bodies)
    for k in range(tally_of(m)[CONTACTS]):
        if real[PN, k] > 0.0 or real[WN, k] > 0.0 or real[HIT, k] > 0.0:
            join(group, inverse, whole[ONE, k], whole[OTHER, k])
    for k in range(w.links):
        link = link_of(w, k)
        if link.broken == 0:
            join(group, inverse, link.i, link.j)
    for i in range(bodies):
        if before[i, 0] != start[i, 0] or before[i, 1] != start[i, 1] or before[i, 2] != start[i, 2]:
            struck[root(group, i)] = 1.0
    for i in range(bodies):
        struck[i] = struck[root(group, i)]
    return struck
