"""One stroke from a path that is meant to the samples that a device reports, as kernels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.chance import Key, split, two_normals
from data_gen.hand.curves import resampled, size
from data_gen.hand.jit import kernel, part
from data_gen.hand.motion import pressed, swung, travelled
from data_gen.hand.names import (
    BOW,
    FIELD,
    HOOKS,
    JITTER,
    LATE,
    QUANTISATION,
    RETRACING,
    TREMOR,
    WOBBLE,
)
from data_gen.hand.paths import PATH_POINTS, bowed, hooked, late, retraced, thinned, warped, wobbled
from data_gen.hand.person import (
    GRID,
    HOOKED,
    LATENESS,
    NOISE,
    PRESSURE,
    RETRACES,
    SHAKE,
    SHAKING,
    WOBBLING,
)
from sketch.ink import FloatArray

FIELD_SHARE, BOW_SHARE = 0.6, 0.7
"""The plane's distortion and the whole stroke's bow against the waver of the path."""
TREMOR_MOST = 12.0
"""Amplitude of a tremor at most, page units: the hand shakes by its own measure, not the drawing's."""

Indices = NDArray[np.int64]
Samples = tuple[FloatArray, FloatArray, FloatArray]


@part
def inked(
    path: FloatArray, frame: FloatArray, habits: FloatArray, on: NDArray[np.bool_], key: Key
) -> Samples:
    """Points (m, 2), times (m,) and pressure (m,) of one stroke; frame: the box of the drawing it belongs to.

    The field is drawn from the key of the drawing's first stroke by way of the frame: strokes of one
    drawing that share a frame and differ in the key's lowest byte alone are distorted alike.
    """
    moves = len(path) > 1 and size(path) > 0
    if moves:
        if on[RETRACING]:
            path = retraced(path, habits[RETRACES], key)
        if on[HOOKS]:
            path = hooked(path, habits[HOOKED], key)
        path = resampled(path, PATH_POINTS)
        if on[LATE]:
            path = late(path, habits[LATENESS])
        if on[FIELD]:
            path = warped(path, frame, FIELD_SHARE * habits[WOBBLING], key & ~np.uint64(255))
        if on[WOBBLE]:
            path = wobbled(path, habits[WOBBLING], key)
        if on[BOW]:
            path = bowed(path, BOW_SHARE * habits[WOBBLING], key)
        points, times = travelled(path, habits, on, key)
    else:
        still = resampled(path, PATH_POINTS)
        points, times = travelled(still, habits, on, key)
    if on[TREMOR]:
        amount = min(habits[SHAKING] * size(path), TREMOR_MOST)
        swung(points, times[1] - times[0], amount, habits[SHAKE], key)
    if on[JITTER]:
        noise = split(key, JITTER)
        for k in range(len(points)):
            x, y = two_normals(noise)
            points[k, 0] += habits[NOISE] * x
            points[k, 1] += habits[NOISE] * y
    grid = habits[GRID]
    if on[QUANTISATION] and grid > 0:
        for k in range(len(points)):
            points[k, 0] = round(points[k, 0] / grid) * grid
            points[k, 1] = round(points[k, 1] / grid) * grid
    return points, times, pressed(len(points), habits[PRESSURE], key)


@kernel
def ink_of(
    paths: FloatArray,
    ends: Indices,
    items: Indices,
    frames: FloatArray,
    habits: FloatArray,
    keys: NDArray[np.uint64],
    thin: Indices,
    on: NDArray[np.bool_],
) -> tuple[FloatArray, FloatArray, FloatArray, Indices]:
    """The ink of many drawings, see `batch.Drawings`: points, times, pressure one below the other, and where each
    stroke ends. The lowest byte of the keys must be 0."""
    tape = np.empty((100 * len(ends) + 400, 4))
    used = np.zeros(len(ends), dtype=np.int64)
    at = begun = stroke = 0
    for item in range(len(items)):
        first = stroke
        while stroke < items[item]:
            key = keys[item] | np.uint64((stroke - first) & 255)
            points, times, pressure = inked(paths[begun : ends[stroke]], frames[item], habits[item], on, key)
            count = len(points)
            if at + count > len(tape):
                longer = np.empty((2 * (at + count), 4))
                for k in range(at):
                    for column in range(4):
                        longer[k, column] = tape[k, column]
                tape = longer
            seen = _seen(count, thin[item], key)
            for k in range(len(seen)):
                j = seen[k]
                tape[at + k, 0], tape[at + k, 1] = points[j, 0], points[j, 1]
                tape[at + k, 2], tape[at + k, 3] = times[j], pressure[j]
            at += len(seen)
            begun = ends[stroke]
            used[stroke] = at
            stroke += 1
    return tape[:at, :2].copy(), tape[:at, 2].copy(), tape[:at, 3].copy(), used


@part
def _seen(count: int, device: int, key: Key) -> Indices:
    """Which samples the device reports: all (0), what a busy one does (1), or the ends and the middle (3)."""
    if device == 1:
        return thinned(count, key)
    if device == 3:
        return np.arange(0, count, max(1, (count - 1) // 2))
    return np.arange(count)
