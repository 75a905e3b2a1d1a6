"""Writers: the habits that one person keeps from stroke to stroke.

A habit is a number with a unit; `sample_writer` draws a person. Ranges are what adults with a
mouse, a finger or a pen show on loosely guided drawings; each field says why.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import exp
from operator import attrgetter

import numpy as np

from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class Writer:
    """One person's habits, as `data_gen.pen` and `data_gen.pages` read them."""

    slant: float
    """Shear x += slant · (−y) of letters; right-handers lean right (about 0.1)."""
    stretch: float
    """log of width over height of letters against the copybook's."""
    wobble: float
    """Slow waver of a path, rms fraction of the stroke's size: memory of form and arm posture."""
    tremor: float
    """Fast jitter, rms fraction of the stroke's size."""
    overlap: float
    """How much of a strokelet's time the next one shares; more haste rounds corners more."""
    speed: float
    """Strokelets per second: 4 to 9 in handwriting (Plamondon 1995)."""
    hooks: float
    """Share of strokes with a small hook at pen-down or pen-up."""
    gap: float
    """Mean of the closing error of closed shapes, fraction of the perimeter; negative stops short."""
    rate: float
    """Samples per second of the digitiser: 20 (slow web page) to 250 Hz (tablet)."""
    grid: float
    """Pixel size in page units to which points are rounded; 0 for a sub-pixel stylus."""
    late: float
    """Share of each stroke that a slow device misses after pen-down and bridges by a straight line."""
    zigzag: float
    """Share of springs drawn as zig-zag, the rest as coils."""
    pieces: float
    """Share of polygons drawn in several strokes, lifting the pen at corners."""
    height: float
    """Height of a capital letter, page units."""
    pressure: float
    """Mean pressure, 0 to 1."""


def sample_writer(rng: np.random.Generator) -> Writer:
    """A person drawn at random. Consumes the same number of variates whatever comes out."""
    u, z = rng.random(9).tolist(), rng.standard_normal(6).tolist()
    return Writer(
        slant=0.1 + 0.15 * z[0],
        stretch=0.15 * z[1],
        wobble=0.010 * exp(0.6 * z[2]),
        tremor=0.0013 * exp(0.7 * z[3]),
        overlap=0.05 + 0.4 * u[0],
        speed=5.5 * exp(0.35 * z[4]),
        hooks=0.35 * u[1] ** 2,
        gap=0.02 * z[5],
        rate=20.0 * (250.0 / 20.0) ** u[2],
        grid=(0.0, 1.0, 0.25)[int(3 * u[3])],
        late=max(0.0, 0.9 * (u[8] - 0.8)),
        zigzag=u[4],
        pieces=0.5 * u[5] ** 2,
        height=16 + 14 * u[6],
        pressure=0.35 + 0.35 * u[7],
    )


def habits(writers: Sequence[Writer]) -> dict[str, FloatArray]:
    """The writers' habits column by column: field -> (len(writers),)."""
    table = np.array([_HABITS(writer) for writer in writers], dtype=float)
    return {item.name: table[:, column] for column, item in enumerate(fields(Writer))}


_HABITS = attrgetter(*(item.name for item in fields(Writer)))
