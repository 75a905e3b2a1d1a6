"""Drawings that are none of the kinds: what a recognizer that knows its limits rejects.

Each family is one that nobody means as a circle, polygon, spring, wire, arrow, erasing scribble or sign of mathematics. Drawn by the
same simulated pens as the kinds themselves. Frame: page units, y down; shape i of a seed depends on (seed, i) alone.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from data_gen.pen import draw
from data_gen.writers import sample_writer
from sketch.ink import FloatArray, Ink

SIZE = (60.0, 400.0)
"""Log-uniform range of their sizes, page units: as components have."""

Family = Callable[[np.random.Generator], FloatArray]


def strangers(count: int, seed: int) -> list[Ink]:
    """`count` drawings of one stroke that are of no kind, the families in turn."""
    return [_drawn(index, seed) for index in range(count)]


def doodle(rng: np.random.Generator) -> FloatArray:
    """An aimless curve that crosses itself: a few harmonics of random phase, not closed."""
    along = np.linspace(0.0, 1.0, 200)[:, None]
    rank = np.arange(1, 6)
    wave = np.sin(np.pi * along * rank * rng.uniform(0.8, 1.2, 5) + rng.uniform(0, 2 * np.pi, 5))
    return np.column_stack([wave @ (rng.standard_normal(5) / rank**0.4) for _ in range(2)])


def zigzag_path(rng: np.random.Generator) -> FloatArray:
    """Five to nine straight legs to random places."""
    return rng.random((int(rng.integers(6, 11)), 2))


def spiral(rng: np.random.Generator) -> FloatArray:
    """Two to four turns inwards or outwards."""
    turns = rng.uniform(2.0, 4.0)
    angle = np.linspace(0.0, 2 * np.pi * turns, 240)
    radius = np.linspace(0.08, 1.0, 240) ** rng.uniform(0.8, 1.2)
    path = np.column_stack([radius * np.cos(angle), rng.uniform(0.7, 1.0) * radius * np.sin(angle)])
    return path if rng.random() < 0.5 else path[::-1]


def knot(rng: np.random.Generator) -> FloatArray:
    """A closed curve of several crossings: Lissajous's, 2:3, 3:4 or 3:5."""
    first, second = ((2, 3), (3, 4), (3, 5))[int(rng.integers(3))]
    angle = np.linspace(0.0, 2 * np.pi, 240)
    phase = rng.uniform(0.3, 1.2)
    return np.column_stack([np.sin(first * angle + phase), rng.uniform(0.6, 1.0) * np.sin(second * angle)])


def cloud(rng: np.random.Generator) -> FloatArray:
    """A closed outline of five to nine lobes or spikes."""
    lobes = int(rng.integers(5, 10))
    angle = np.linspace(0.0, 2 * np.pi, 240) + rng.uniform(0, 2 * np.pi)
    wave = np.abs(np.sin(lobes * angle / 2)) if rng.random() < 0.5 else np.cos(lobes * angle)
    radius = 0.7 + rng.uniform(0.2, 0.35) * wave
    return np.column_stack([radius * np.cos(angle), rng.uniform(0.6, 1.0) * radius * np.sin(angle)])


def stairs(rng: np.random.Generator) -> FloatArray:
    """Three to six steps up or down."""
    steps = int(rng.integers(3, 7))
    corners = np.repeat(np.arange(steps + 1), 2).astype(np.float64)
    path = np.column_stack([corners[1:], corners[:-1]]) / steps
    return path * (1.0, rng.choice([-1.0, 1.0]) * rng.uniform(0.5, 1.2))


FAMILIES: tuple[Family, ...] = (doodle, zigzag_path, spiral, knot, cloud, stairs)


def _drawn(index: int, seed: int) -> Ink:
    rng = np.random.default_rng([seed, index])
    path = FAMILIES[index % len(FAMILIES)](rng)
    low, high = SIZE
    size = low * (high / low) ** rng.random()
    middle, span = 0.5 * (path.max(axis=0) + path.min(axis=0)), np.ptp(path, axis=0).max()
    return Ink(tuple(draw([size * (path - middle) / span + 500.0], sample_writer(rng), rng)))
