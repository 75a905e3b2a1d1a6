"""Random numbers of an item that depend on its seed and its number alone.

SplitMix64 (Steele, Lea, Flood 2014): a counter run through a mixing function, so that a generator is one
64-bit number and costs nothing to make. Each variation draws from a generator of its own, split off
the item's key by its name: leaving one out changes no number that another draws.
"""

from __future__ import annotations

from math import cos, log, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.jit import part

Key = np.uint64
State = NDArray[np.uint64]
"""One number, (1,), that moves on with each draw."""

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_FIRST = np.uint64(0xBF58476D1CE4E5B9)
_SECOND = np.uint64(0x94D049BB133111EB)
_30, _27, _31, _11 = np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(11)
_STEP = 2.0**-53


@part
def mixed(number: Key) -> Key:
    z = (number ^ (number >> _30)) * _FIRST
    z = (z ^ (z >> _27)) * _SECOND
    return z ^ (z >> _31)


@part
def key_of(seed: Key, index: Key) -> Key:
    """The key of item `index` under a seed."""
    return mixed(mixed(seed + _GOLDEN) + _GOLDEN * (index + np.uint64(1)))


@part
def split(key: Key, name: int) -> State:
    """The generator that belongs to `name` under a key."""
    state = np.empty(1, dtype=np.uint64)
    state[0] = mixed(key ^ mixed(_GOLDEN * np.uint64(name + 1)))
    return state


@part
def uniform(state: State) -> float:
    """In [0, 1)."""
    state[0] += _GOLDEN
    return float(mixed(state[0]) >> _11) * _STEP


@part
def normal(state: State) -> float:
    """A standard normal variate (Box and Muller 1958)."""
    radius = sqrt(-2.0 * log(1.0 - uniform(state)))
    return radius * cos(2.0 * pi * uniform(state))


@part
def two_normals(state: State) -> tuple[float, float]:
    """Two for little more than the price of one."""
    radius = sqrt(-2.0 * log(1.0 - uniform(state)))
    angle = 2.0 * pi * uniform(state)
    return radius * cos(angle), radius * sin(angle)


@part
def between(state: State, low: float, high: float) -> float:
    """In [low, high)."""
    return low + (high - low) * uniform(state)
