"""What a hand does to the path it means: small functions from paths to paths, each a variation that can be left out.

Frame: page units, y down; a path is (n, 2). Amounts are fractions of the stroke's size unless said otherwise.
"""

from __future__ import annotations

from math import cos, exp, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.chance import Key, normal, split, two_normals, uniform
from data_gen.hand.curves import backwards, joined, moved, piece, point, size
from data_gen.hand.jit import part
from data_gen.hand.names import BOW, ENDS, FIELD, HOOKS, RETRACING, SPARSE, WOBBLE
from sketch.ink import FloatArray

HOOK = (0.02, 0.06)
"""Length of a hook, fraction of the stroke's size."""
HOOK_MOST = 10.0
"""Hooks are never longer than this, page units: the hand's flick does not grow with the drawing."""
RETRACED = (0.05, 0.2)
"""Share of a path that is gone over again."""
STRAY = 0.02
"""Standard deviation with which the ends of a letter's stroke stray."""


@part
def hooked(path: FloatArray, share: float, key: Key) -> FloatArray:
    """Now and then a short hook where the pen comes down or leaves."""
    r = split(key, HOOKS)
    at_start, at_end, length = uniform(r), uniform(r), uniform(r)
    angle_start, angle_end = 2 * pi * uniform(r), 2 * pi * uniform(r)
    reach = min(HOOK_MOST, size(path) * (HOOK[0] + length * (HOOK[1] - HOOK[0])))
    if at_start < share:
        x, y = path[0, 0] + reach * cos(angle_start), path[0, 1] + reach * sin(angle_start)
        path = joined(point(x, y), path)
    if at_end < share:
        x, y = path[-1, 0] + reach * cos(angle_end), path[-1, 1] + reach * sin(angle_end)
        path = joined(path, point(x, y))
    return path


@part
def retraced(path: FloatArray, share: float, key: Key) -> FloatArray:
    """Now and then the last part is gone back over, a little beside itself."""
    r = split(key, RETRACING)
    chosen, far = uniform(r) < share, RETRACED[0] + (RETRACED[1] - RETRACED[0]) * uniform(r)
    aside = 0.012 * normal(r), 0.012 * normal(r)
    if not chosen or len(path) < 2:
        return path
    again = backwards(piece(path, 1.0 - far, 1.0))
    reach = size(path)
    for k in range(1, len(again)):
        for axis in range(2):
            again[k, axis] += reach * aside[axis] * k / (len(again) - 1)
    return joined(path, again[1:])


@part
def late(path: FloatArray, share: float) -> FloatArray:
    """The first share of an evenly spaced path as a straight line: what a device sees that wakes up late."""
    seen = min(int(share * (len(path) - 1)), len(path) - 1)
    bridged = moved(path, 0.0, 0.0)
    for k in range(1, seen):
        for axis in range(2):
            bridged[k, axis] = path[0, axis] + (path[seen, axis] - path[0, axis]) * (k / seen)
    return bridged


PATH_POINTS = 128
"""Evenly spaced points that carry a meant path: 14 for each loop of a spring with nine coils."""
PERIODS = np.array([0.5, 1.0, 1.5, 2.0, 3.0, 4.5, 6.5, 9.0])
"""Periods of the waves along a stroke that make up its wobble,"""
FADING = 0.5
"""and the power of the period by which they fade: slow ones are memory and posture, quick ones correction."""
_WEIGHTS = PERIODS**-FADING / np.sqrt(np.sum(PERIODS ** (-2 * FADING)))
_COSINES, _SINES = (
    wave(np.outer(np.linspace(0.0, 2 * np.pi, PATH_POINTS), PERIODS)) for wave in (np.cos, np.sin)
)


@part
def wobbled(path: FloatArray, amount: float, key: Key) -> FloatArray:
    """Waver of both coordinates along a path of `PATH_POINTS` evenly spaced points; amount: rms displacement."""
    r = split(key, WOBBLE)
    scale = amount * size(path)
    weights = np.empty((4, len(PERIODS)))
    for k in range(len(PERIODS)):
        for half in range(2):
            x, y = two_normals(r)
            weights[half, k], weights[2 + half, k] = scale * _WEIGHTS[k] * x, scale * _WEIGHTS[k] * y
    found = np.empty((len(path), 2))
    for j in range(len(path)):
        x, y = path[j, 0], path[j, 1]
        for k in range(len(PERIODS)):
            c, s = _COSINES[j, k], _SINES[j, k]
            x += weights[0, k] * c + weights[1, k] * s
            y += weights[2, k] * c + weights[3, k] * s
        found[j, 0], found[j, 1] = x, y
    return found


@part
def bowed(path: FloatArray, amount: float, key: Key) -> FloatArray:
    """The whole stroke bent like a bow; amount: the sagitta's standard deviation over the chord."""
    sagitta = amount * normal(split(key, BOW))
    dx, dy = path[-1, 0] - path[0, 0], path[-1, 1] - path[0, 1]
    found = np.empty((len(path), 2))
    for k in range(len(path)):
        place = 2.0 * k / (len(path) - 1) - 1.0
        rise = sagitta * (1.0 - place * place)
        found[k, 0], found[k, 1] = path[k, 0] - rise * dy, path[k, 1] + rise * dx
    return found


@part
def warped(path: FloatArray, frame: FloatArray, amount: float, key: Key) -> FloatArray:
    """A smooth distortion of the plane about a frame (low x, low y, high x, high y), which strokes may share:
    quadratic and cubic terms of the coordinates, so that they bulge, skew and taper as a whole."""
    r = split(key, FIELD)
    reach = max(hypot(frame[2] - frame[0], frame[3] - frame[1]), 1e-9)
    weights = np.empty((2, 4))
    for axis in range(2):
        for k in range(4):
            weights[axis, k] = amount * reach * normal(r)
    found = np.empty((len(path), 2))
    for k in range(len(path)):
        x = (path[k, 0] - (frame[0] + frame[2]) / 2) * (2 / reach)
        y = (path[k, 1] - (frame[1] + frame[3]) / 2) * (2 / reach)
        square = x * x + y * y
        for axis in range(2):
            found[k, axis] = path[k, axis] + (
                weights[axis, 0] * x * y
                + weights[axis, 1] * (x * x - y * y)
                + weights[axis, 2] * x * square
                + weights[axis, 3] * y * square
            )
    return found


@part
def strayed(points: FloatArray, begun: int, ended: int, key: Key) -> None:
    """Both ends of a letter's stroke (rows begun : ended) stray by themselves: cubic weights fade within the
    first and last third."""
    r = split(key, ENDS)
    reach = STRAY * size(points[begun:ended])
    for axis in range(2):
        first, last = reach * normal(r), reach * normal(r)
        for k in range(begun, ended):
            place = (k - begun) / max(ended - begun - 1, 1)
            points[k, axis] += (1 - place) ** 3 * first + place**3 * last


@part
def thinned(count: int, key: Key) -> NDArray[np.int64]:
    """Which samples a busy device sees: 12 to 60, unevenly, and after the first long none."""
    r = split(key, SPARSE)
    uniform(r)  # whether, drawn in `item`
    kept = min(12 + int(48 * uniform(r) ** 1.5), count)
    places = np.empty(kept)
    places[0] = 0.0
    first = 0.04 + 0.26 * uniform(r) ** 1.5
    total = 0.0
    for k in range(1, kept):
        total += exp(0.35 * normal(r))
        places[k] = total
    seen = np.empty(kept, dtype=np.int64)
    seen[0] = 0
    found = 1
    for k in range(1, kept):
        share = first + (1 - first) * (places[k] - places[1]) / max(total - places[1], 1e-9)
        index = round(share * (count - 1))
        if index > seen[found - 1]:
            seen[found] = index
            found += 1
    return seen[:found]
