"""When a cluster has come to rest (row E2): neither moves nor is about to, by its solved accelerations and by its
motion smoothed over some frames."""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.cells import head
from physics.engine.exact.machine import MACHINE, slope
from physics.engine.exact.record import Record
from physics.jit import kernel
from sketch.ink import FloatArray

CALM = 1e-7
"""m/s and m/s²: a cluster whose smoothed motion and accelerations are below it sleeps."""
SOLVED = 1e-12
"""m/s and m/s²: velocities and accelerations below it are zero but for rounding, and need no smoothing."""
SMOOTHED = 20
"""Frames of 1/60 s of which the smoothed motion keeps a trace above rounding (0.2 to the 20th)."""


def at_rest(lively: float, record: Record, movable: int, time: float, since: float | None) -> bool:
    """lively: see `liveliest`; since: the time from which on the recorded motion tells, s; None: it tells nothing."""
    if lively > CALM:
        return False
    return lively <= SOLVED or since is None or _smoothed(record, movable, time, since) <= CALM**2


def _smoothed(record: Record, movable: int, time: float, since: float) -> float:
    """The greatest smoothed motion of any body, (m/s)²: frame = ‖v‖² + ω², net ← 0.2 net + 0.8 frame."""
    times = time - np.arange(SMOOTHED) / 60.0
    times = times[times > since][::-1]
    if len(times) == 0 or not record.count:
        return 0.0
    speeds = record.states(times)[:, 3 * movable : 6 * movable].reshape(len(times), movable, 3)
    net = np.zeros(movable)
    for frame in (speeds**2).sum(axis=2):
        net = 0.2 * net + 0.8 * frame
    return float(net.max(initial=0.0))


@kernel
def liveliest(memory: FloatArray, calm: float, moved: Any) -> float:
    """The greatest velocity or acceleration of any body, m/s and m/s² (rad/s and rad/s²). moved (movable,) ← True
    for those faster than `calm`."""
    m = head(memory, MACHINE)
    rate = slope(m, 0)
    most = 0.0
    for i in range(m.movable):
        for a in range(3):
            speed = abs(rate[3 * i + a])
            moved[i] = moved[i] or speed > calm
            most = max(most, speed, abs(rate[3 * (m.movable + i) + a]))
    return float(most)
