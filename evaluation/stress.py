"""The same ink made harder, one property at a time: what a recognizer can bear, and whom it serves worst.

Each axis is a change of ink with a level; its first level changes nothing. Randomness depends on (seed, index) alone, so
that all recognizers, and all levels, meet the same tremor. Frame: page units, y down; seconds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np

from sketch.geometry import diagonal
from sketch.ink import FloatArray, Ink, Stroke

SHAKE = (4.0, 8.0)
"""Hertz of a pathological tremor (Elble and Koller 1990)."""
ASSUMED_RATE = 60.0
"""Points a second of ink that has no times: a screen's."""
FEWEST = 2
"""Points that are left of a stroke that had as many."""

Change = Callable[[Ink, float, np.random.Generator], Ink]


@dataclass(frozen=True, slots=True)
class Axis:
    """about: what grows; unit: of the levels; levels: the first is the ink as it is; change: of the ink at a level; moves: whether
    the page still means the same motion, so that motions may be compared."""

    about: str
    unit: str
    levels: tuple[float, ...]
    change: Change
    moves: bool = False


def stressed(ink: Ink, axis: str, level: float, seed: int, index: int) -> Ink:
    """The ink at a level of an axis. Raises KeyError for an axis that is not in `AXES`."""
    chosen = AXES[axis]
    return (
        ink if level == chosen.levels[0] else chosen.change(ink, level, np.random.default_rng([seed, index]))
    )


def tremor(ink: Ink, amplitude: float, rng: np.random.Generator) -> Ink:
    """An oscillation of 4 to 8 Hz in both directions, of that amplitude (rms) as a fraction of the ink's size."""
    size = _size(ink)
    rate = rng.uniform(*SHAKE)
    phases = rng.uniform(0, 2 * np.pi, 2)
    amounts = rng.uniform(0.5, 1.0, 2)
    amounts *= np.sqrt(2) * amplitude * size / np.sqrt((amounts**2).sum())

    def shaken(stroke: Stroke) -> Stroke:
        turns = 2 * np.pi * rate * _clock(stroke)[:, None]
        return stroke.moved_to(stroke.points + amounts * np.sin(turns + phases))

    return _each(ink, shaken)


def rate(ink: Ink, hertz: float, rng: np.random.Generator) -> Ink:
    """As a device of that rate sees it: the first point of every tick, and the last."""
    del rng

    def thinned(stroke: Stroke) -> Stroke:
        tick = np.floor(_clock(stroke) * hertz)
        kept = np.ones(len(stroke), dtype=bool)
        kept[1:-1] = tick[1:-1] > tick[:-2]
        return _chosen(stroke, kept)

    return _each(ink, thinned)


def speed(ink: Ink, factor: float, rng: np.random.Generator) -> Ink:
    """Drawn so many times as fast before the same device: fewer points, in less time."""
    del rng

    def hastened(stroke: Stroke) -> Stroke:
        kept = np.zeros(len(stroke), dtype=bool)
        kept[np.unique(np.floor(np.arange(0, len(stroke), factor)).astype(int))] = True
        kept[-1] = True
        fewer = _chosen(stroke, kept)
        times = None if fewer.times is None else fewer.times / factor
        return Stroke(fewer.points, times, fewer.pressure)

    return _each(ink, hastened)


def gap(ink: Ink, fraction: float, rng: np.random.Generator) -> Ink:
    """The pen lifted before the end: the last part of each stroke's length is missing, so that rings and corners gape."""
    del rng

    def cut(stroke: Stroke) -> Stroke:
        along = _along(stroke)
        if along[-1] == 0:
            return stroke
        kept = along <= (1 - fraction) * along[-1]
        kept[:FEWEST] = True
        return _chosen(stroke, kept)

    return _each(ink, cut)


def rotation(ink: Ink, degrees: float, rng: np.random.Generator) -> Ink:
    """Turned about its middle."""
    del rng
    turn = np.array(
        [[cos(radians(degrees)), sin(radians(degrees))], [-sin(radians(degrees)), cos(radians(degrees))]]
    )
    middle = _middle(ink)
    return _each(ink, lambda stroke: stroke.moved_to((stroke.points - middle) @ turn + middle))


def scale(ink: Ink, factor: float, rng: np.random.Generator) -> Ink:
    """Grown about its middle."""
    del rng
    middle = _middle(ink)
    return _each(ink, lambda stroke: stroke.moved_to((stroke.points - middle) * factor + middle))


def order(ink: Ink, share: float, rng: np.random.Generator) -> Ink:
    """That share of the strokes drawn the other way round, and as many of them in each other's place."""
    turned = rng.random(len(ink)) < share
    strokes = [
        _reversed(stroke) if back else stroke for stroke, back in zip(ink, turned.tolist(), strict=True)
    ]
    moved = np.flatnonzero(rng.random(len(ink)) < share)
    for place, other in zip(moved.tolist(), rng.permutation(moved).tolist(), strict=True):
        strokes[place] = _reversed(ink[other]) if turned[other] else ink[other]
    return Ink(tuple(strokes))


def missing_time(ink: Ink, share: float, rng: np.random.Generator) -> Ink:
    """That share of the strokes without times."""
    bare = rng.random(len(ink)) < share
    return Ink(
        tuple(
            Stroke(stroke.points, None, stroke.pressure) if gone else stroke
            for stroke, gone in zip(ink, bare.tolist(), strict=True)
        )
    )


AXES: Mapping[str, Axis] = {
    "tremor": Axis(
        "tremor of 4 to 8 Hz", "% of the size", (0.0, 0.005, 0.01, 0.02, 0.03, 0.05), tremor, True
    ),
    "rate": Axis("sampling rate", "Hz", (float("inf"), 60.0, 40.0, 30.0, 20.0, 15.0, 10.0), rate, True),
    "speed": Axis("speed of drawing", "times", (1.0, 1.5, 2.0, 3.0, 4.0, 6.0), speed, True),
    "gap": Axis("closure gap", "% of the length", (0.0, 0.02, 0.05, 0.1, 0.15, 0.2), gap, True),
    "rotation": Axis("rotation", "degrees", (0.0, 15.0, 30.0, 45.0, 60.0, 90.0, 135.0, 180.0), rotation),
    "scale": Axis("scale", "times", (1.0, 0.5, 0.25, 0.1, 2.0, 4.0, 10.0), scale),
    "order": Axis("strokes in another order and sense", "% of strokes", (0.0, 0.25, 0.5, 1.0), order),
    "time": Axis("strokes without times", "% of strokes", (0.0, 0.5, 1.0), missing_time, True),
}


def _each(ink: Ink, change: Callable[[Stroke], Stroke]) -> Ink:
    return Ink(tuple(change(stroke) for stroke in ink))


def _size(ink: Ink) -> float:
    return diagonal(np.concatenate([stroke.points for stroke in ink])) if len(ink) else 0.0


def _middle(ink: Ink) -> FloatArray:
    left, top, right, bottom = ink.bounds()
    return np.array([(left + right) / 2, (top + bottom) / 2])


def _clock(stroke: Stroke) -> FloatArray:
    """Seconds from the stroke's first point."""
    if stroke.times is None:
        return np.arange(len(stroke)) / ASSUMED_RATE
    return stroke.times - stroke.times[0]


def _along(stroke: Stroke) -> FloatArray:
    steps = np.linalg.norm(np.diff(stroke.points, axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _chosen(stroke: Stroke, kept: np.typing.NDArray[np.bool_]) -> Stroke:
    return Stroke(
        stroke.points[kept],
        None if stroke.times is None else stroke.times[kept],
        None if stroke.pressure is None else stroke.pressure[kept],
    )


def _reversed(stroke: Stroke) -> Stroke:
    """The same path from its end, in the same time."""
    times = None if stroke.times is None else stroke.times[0] + (stroke.times[-1] - stroke.times[::-1])
    return Stroke(stroke.points[::-1], times, None if stroke.pressure is None else stroke.pressure[::-1])
