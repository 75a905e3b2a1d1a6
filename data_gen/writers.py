"""Writers: the habits that one person keeps from stroke to stroke, and the groups of people.

A habit is a number with a unit. Each has a spread over adults, and named groups differ from adults in
some of them, for stated reasons; a group is a composition of habits, nothing else. Ranges are what
people with a mouse, a finger or a pen show on loosely guided drawings.

Sources: Plamondon 1995 (strokelets); Elble and Koller, Tremor (1990): physiological tremor 8-12 Hz and
small, essential tremor 4-8 Hz and up to centimetres; Meulenbroek and van Galen 1988, Hamstra-Bletz and
Blöte 1990 (children of 6 to 9: slower, larger, less smooth, unsteady in size, joints miss); Arter,
McCall and Boscott 1996, Atasavun Uysal and Düger 2012 (low vision: larger, slower, ends missed, overlaps).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from operator import attrgetter
from typing import Literal, cast

import numpy as np

from data_gen.hand.person import person
from sketch.ink import FloatArray, readonly


@dataclass(frozen=True, slots=True)
class Writer:
    """One person's habits, in the order in which the kernels of `data_gen.hand` read them."""

    slant: float
    """Shear x += slant · (−y) of letters; right-handers lean right (about 0.1)."""
    stretch: float
    """log of width over height of letters against the copybook's."""
    wobble: float
    """Slow waver of a path, rms fraction of the stroke's size: memory of form and arm posture."""
    tremor: float
    """Oscillation of the hand, amplitude as a fraction of the stroke's size."""
    shake: float
    """Frequency of the tremor, Hz."""
    overlap: float
    """How much of a strokelet's time the next one shares; more haste rounds corners more."""
    speed: float
    """Strokelets per second: 4 to 9 in handwriting (Plamondon 1995)."""
    hooks: float
    """Share of strokes with a small hook at pen-down or pen-up."""
    gap: float
    """Mean of the closing error of closed shapes, fraction of the perimeter; negative stops short."""
    closing: float
    """Standard deviation of the closing error, fraction of the perimeter."""
    corner: float
    """Standard deviation with which corners miss their place, fraction of the shape's size."""
    rate: float
    """Samples per second of the digitiser: 20 (slow web page) to 250 Hz (tablet)."""
    grid: float
    """Pixel size in page units to which points are rounded; 0 for a sub-pixel stylus."""
    jitter: float
    """White noise of the digitiser, rms page units."""
    late: float
    """Share of each stroke that a slow device misses after pen-down and bridges by a straight line."""
    zigzag: float
    """Share of springs drawn as zig-zag, the rest as coils."""
    pieces: float
    """Share of shapes drawn in several strokes, lifting the pen at corners."""
    broken: float
    """Share of strokes that break in two."""
    retrace: float
    """Share of strokes that go over a part of their path again."""
    height: float
    """Height of a capital letter, page units."""
    pressure: float
    """Mean pressure, 0 to 1."""
    untimed: float
    """Above 0: the device gives no times."""
    unpressed: float
    """Above 0: the device gives no pressure."""


@dataclass(frozen=True, slots=True)
class Spread:
    """How a habit is spread over people.

    law: "uniform" low + (high − low) u^power; "log-uniform" low (high / low)^u; "normal" mean low, s.d. high;
    "log-normal" median low, s.d. of the logarithm high; "pick" low, high or power, each a third.
    least: whatever falls below it is it.
    """

    law: Literal["uniform", "log-uniform", "normal", "log-normal", "pick"]
    low: float
    high: float
    power: float = 1.0
    least: float = -np.inf


LAWS = ("uniform", "log-uniform", "normal", "log-normal", "pick")

ADULT: Mapping[str, Spread] = {
    "slant": Spread("normal", 0.08, 0.13),
    "stretch": Spread("normal", 0.0, 0.15),
    "wobble": Spread("log-normal", 0.0095, 0.5),
    "tremor": Spread("log-normal", 0.0006, 0.7),
    "shake": Spread("uniform", 8.0, 12.0),
    "overlap": Spread("uniform", 0.05, 0.45),
    "speed": Spread("log-normal", 4.6, 0.4),
    "hooks": Spread("uniform", 0.0, 0.35, 2.0),
    "gap": Spread("normal", 0.0, 0.02),
    "closing": Spread("log-normal", 0.025, 0.4),
    "corner": Spread("log-normal", 0.018, 0.3),
    "rate": Spread("uniform", 20.0, 250.0, 2.0),
    "grid": Spread("pick", 0.0, 1.0, 0.25),
    "jitter": Spread("log-normal", 0.12, 0.6),
    "late": Spread("uniform", -0.72, 0.18, 1.0, 0.0),
    "zigzag": Spread("uniform", 0.0, 1.0),
    "pieces": Spread("uniform", 0.0, 0.5, 2.0),
    "broken": Spread("uniform", 0.0, 0.06, 2.0),
    "retrace": Spread("uniform", 0.0, 0.08, 2.0),
    "height": Spread("uniform", 16.0, 30.0),
    "pressure": Spread("uniform", 0.35, 0.7),
    "untimed": Spread("uniform", -5.0, 1.0),
    "unpressed": Spread("uniform", -2.0, 1.0),
}

PROFILES: Mapping[str, Mapping[str, Spread]] = {
    "adult": ADULT,
    # A child of 6 to 9: strokelets fewer a second and less fused, the path unsteady, corners and
    # closures missed by several times an adult's error, letters large, the pen lifted more often.
    "child": {
        **ADULT,
        "wobble": Spread("log-normal", 0.020, 0.4),
        "tremor": Spread("log-normal", 0.0015, 0.5),
        "overlap": Spread("uniform", 0.0, 0.25),
        "speed": Spread("log-normal", 3.2, 0.3),
        "closing": Spread("log-normal", 0.05, 0.4),
        "corner": Spread("log-normal", 0.035, 0.3),
        "stretch": Spread("normal", 0.0, 0.25),
        "slant": Spread("normal", 0.0, 0.2),
        "pieces": Spread("uniform", 0.0, 0.7),
        "broken": Spread("uniform", 0.0, 0.15),
        "retrace": Spread("uniform", 0.0, 0.15),
        "height": Spread("uniform", 24.0, 48.0),
        "pressure": Spread("uniform", 0.5, 0.9),
    },
    # Essential or parkinsonian tremor: 4 to 8 Hz, 0.5 to 3 % of the drawing, slower, contact lost now and
    # then, hooks where the pen comes down shaking.
    "tremor": {
        **ADULT,
        "tremor": Spread("log-uniform", 0.005, 0.03),
        "shake": Spread("uniform", 4.0, 8.0),
        "speed": Spread("log-normal", 3.6, 0.3),
        "overlap": Spread("uniform", 0.0, 0.3),
        "hooks": Spread("uniform", 0.1, 0.5),
        "broken": Spread("uniform", 0.0, 0.2),
        "closing": Spread("log-normal", 0.035, 0.4),
        "rate": Spread("log-uniform", 40.0, 250.0),
    },
    # Low vision: the hand is steady but the eye does not guide it: ends and corners are missed, closures
    # gape or overlap, letters are large, lines are gone over again.
    "low_vision": {
        **ADULT,
        "wobble": Spread("log-normal", 0.015, 0.4),
        "speed": Spread("log-normal", 4.0, 0.3),
        "gap": Spread("normal", 0.0, 0.04),
        "closing": Spread("log-normal", 0.07, 0.4),
        "corner": Spread("log-normal", 0.04, 0.3),
        "retrace": Spread("uniform", 0.0, 0.3),
        "pieces": Spread("uniform", 0.0, 0.6),
        "height": Spread("uniform", 30.0, 60.0),
    },
}

SHARES: Mapping[str, float] = {"adult": 0.82, "child": 0.08, "tremor": 0.05, "low_vision": 0.05}
"""The population: groups that recognizers meet seldom are given more than their share of it."""

_FIELDS = tuple(item.name for item in fields(Writer))


def spreads(profile: str) -> FloatArray:
    """The spreads of a group as the kernels read them, (habits, 5): number of the law, low, high, power, least.

    Raises ValueError when there is no such group.
    """
    if profile not in PROFILES:
        raise ValueError(f"no group of writers is called {profile!r}; there are {', '.join(PROFILES)}")
    table = PROFILES[profile]
    rows = [table[name] for name in _FIELDS]
    return readonly([[LAWS.index(row.law), row.low, row.high, row.power, row.least] for row in rows])


def population(profile: str | None = None) -> tuple[FloatArray, FloatArray]:
    """Cumulative shares (groups,) and spreads (groups, habits, 5) of everybody, or of one group alone.

    Raises ValueError when there is no such group.
    """
    if profile is not None:
        return readonly([1.0]), readonly(spreads(profile)[None])
    return readonly(np.cumsum(list(SHARES.values()))), readonly(np.stack([spreads(name) for name in SHARES]))


def sample_writer(rng: np.random.Generator, profile: str | None = None) -> Writer:
    """A person drawn at random from everybody, or from one group. Consumes one variate."""
    habits = person(np.uint64(rng.integers(1 << 63)), *population(profile))
    return Writer(*habits.tolist())


def habits_of(writers: Sequence[Writer]) -> FloatArray:
    """The writers' habits as the kernels read them, (writers, habits)."""
    return np.array([cast(tuple[float, ...], _HABITS(writer)) for writer in writers], dtype=float)


_HABITS = attrgetter(*_FIELDS)
