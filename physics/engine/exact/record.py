"""What is kept of a run: its steps, one behind the other, each with its dense output.

Frame: SI units, y up. A state is one line of numbers: see physics.engine.exact.integrate.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.exact.integrate import between
from physics.engine.exact.machine import POWERS
from physics.engine.world import IntArray
from physics.jit import kernel, part
from sketch.ink import FloatArray

ROOM = 32
"""Steps that there is room for at first."""


class Record:
    """The steps of a run in order of time. Mutable: it grows. spans: (room, 2) s, begin and end of each; dense:
    (room, 8, size) their dense outputs; count: how many there are."""

    def __init__(self, size: int) -> None:
        self.spans, self.dense = np.empty((ROOM, 2)), np.empty((ROOM, POWERS, size))
        self.count = 0

    def __getstate__(self) -> dict[str, Any]:
        """Pickled without the room to spare."""
        kept = self.count
        return {"spans": self.spans[:kept].copy(), "dense": self.dense[:kept].copy(), "count": kept}

    def make_room(self, steps: int) -> None:
        """Makes room for so many steps in all."""
        if steps <= len(self.spans):
            return
        room = max(steps, 2 * len(self.spans))
        spans, dense = np.empty((room, 2)), np.empty((room, *self.dense.shape[1:]))
        spans[: self.count], dense[: self.count] = self.spans[: self.count], self.dense[: self.count]
        self.spans, self.dense = spans, dense

    def rest(self, y: FloatArray, begin: float, end: float) -> None:
        """Adds a step in which nothing moves, or makes the one that ends at `begin` longer."""
        last = self.count - 1
        if last >= 0 and self.spans[last, 1] == begin and not self.dense[last, 1:].any():
            self.spans[last, 1] = end
            return
        self.make_room(self.count + 1)
        self.spans[self.count] = begin, end
        self.dense[self.count] = 0.0
        self.dense[self.count, 0] = y
        self.count += 1

    def states(self, times: FloatArray) -> FloatArray:
        """States (T, size) at ascending times; before the first step and after the last, those there."""
        states = np.empty((len(times), self.dense.shape[2]))
        _states(self.spans, self.dense, self.count, times, states)
        return states

    def place(self, time: float, at: IntArray, pos: FloatArray) -> None:
        """Writes the poses of all bodies that can move, at one time, into the rows `at` of pos (bodies, 3)."""
        _place(self.spans, self.dense, self.count, time, at, pos)

    def frames(self, times: FloatArray, movable: int, pos: FloatArray, vel: FloatArray) -> None:
        """Fills in poses and velocities, (T, bodies, 3), of the first bodies, those that can move."""
        _frames(self.spans, self.dense, self.count, movable, times, pos, vel)


@part
def step_at(spans: FloatArray, count: int, t: float) -> int:
    """The last step that has begun by then; the first where none has."""
    low, high = 0, count
    while high - low > 1:
        middle = (low + high) // 2
        if spans[middle, 0] <= t:
            low = middle
        else:
            high = middle
    return low


@part
def share_of(spans: FloatArray, step: int, t: float) -> float:
    """Which share of a step has passed, 0 to 1."""
    length = spans[step, 1] - spans[step, 0]
    x = (t - spans[step, 0]) / length if length > 0.0 else 1.0
    return min(max(x, 0.0), 1.0)


@kernel
def _states(spans: FloatArray, dense: FloatArray, count: int, times: FloatArray, states: FloatArray) -> None:
    for k in range(len(times)):
        step = step_at(spans, count, times[k])
        between(dense[step], share_of(spans, step, times[k]), states[k])


@kernel
def _place(
    spans: FloatArray, dense: FloatArray, count: int, time: float, at: IntArray, pos: FloatArray
) -> None:
    y = np.empty(dense.shape[2])
    step = step_at(spans, count, time)
    between(dense[step], share_of(spans, step, time), y)
    for i in range(len(at)):
        for a in range(3):
            pos[at[i], a] = y[3 * i + a]


@kernel
def _frames(
    spans: FloatArray,
    dense: FloatArray,
    count: int,
    movable: int,
    times: FloatArray,
    pos: FloatArray,
    vel: FloatArray,
) -> None:
    y = np.empty(dense.shape[2])
    for k in range(len(times)):
        step = step_at(spans, count, times[k])
        between(dense[step], share_of(spans, step, times[k]), y)
        for i in range(movable):
            for a in range(3):
                pos[k, i, a] = y[3 * i + a]
                vel[k, i, a] = y[3 * (movable + i) + a]
