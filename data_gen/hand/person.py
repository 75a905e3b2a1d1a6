"""A person drawn at random: one number for each habit, in the order of `data_gen.writers.Writer`."""

from __future__ import annotations

from math import exp

import numpy as np

from data_gen.hand.chance import Key, normal, split, uniform
from data_gen.hand.jit import kernel, part
from sketch.ink import FloatArray

(
    SLANT,
    STRETCH,
    WOBBLING,
    SHAKING,
    SHAKE,
    OVERLAP,
    PACE,
    HOOKED,
    GAP,
    CLOSING,
    CORNER,
    SAMPLES,
    GRID,
    NOISE,
    LATENESS,
    ZIGZAG,
    PIECES,
    BREAKS,
    RETRACES,
    HEIGHT,
    PRESSURE,
    UNTIMED,
    UNPRESSED,
) = range(23)
"""Places of the habits."""

PERSON = 1000
"""The name under which a person's random numbers are split off an item's key."""


@part
def sampled(key: Key, shares: FloatArray, groups: FloatArray) -> FloatArray:
    """Habits (habits,) of somebody; shares: cumulative, of the groups (groups, habits, 5) of spreads."""
    state = split(key, PERSON)
    u = uniform(state)
    group = 0
    while group < len(shares) - 1 and u >= shares[group]:
        group += 1
    table = groups[group]
    habits = np.empty(len(table))
    for k in range(len(table)):
        law, low, high, power, least = table[k]
        u = uniform(state)
        if law == 0:
            value = low + (high - low) * u**power
        elif law == 1:
            value = low * (high / low) ** u
        elif law == 2:
            value = low + high * normal(state)
        elif law == 3:
            value = low * exp(high * normal(state))
        else:
            value = low if u < 1 / 3 else high if u < 2 / 3 else power
        habits[k] = max(value, least)
    return habits


@kernel
def person(key: Key, shares: FloatArray, groups: FloatArray) -> FloatArray:
    return sampled(key, shares, groups)
