"""What a diagram's maker hands over, and the pieces that several makers need.

Frame: page units, y down, a page of about 600 x 450; 100 page units are a metre.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Point, Polygon

PER_METRE = 100.0
"""Page units in a metre."""
GRAVITY = 9.81
"""m/s², where the page says nothing else."""
RESTITUTION = 0.5
"""Share of the closing speed kept by a collision, where the page says nothing else."""

Span = tuple[float, float]
"""Drawn uniformly between its two ends."""


@dataclass(frozen=True, slots=True)
class Remark:
    """A line of mathematics in the formula language, with what it governs: pairs of a component's
    label and the spot on it (page units) where it was associated. None at all: the whole page."""

    text: str
    about: tuple[tuple[str, Point], ...] = ()


@dataclass(frozen=True, slots=True)
class Expected:
    """What must be seen. fates: for each movable label the fates that are right; breaks: links of
    which at least one must break (empty: none may)."""

    fates: Mapping[str, frozenset[str]]
    breaks: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Problem:
    """A diagram as it was meant: shapes without ink, mathematics without a place on the page.

    seconds: how long to watch so that the answer shows and nothing has left the scene yet.
    """

    components: tuple[Component, ...]
    remarks: tuple[Remark, ...]
    seconds: float
    expected: Expected


def ceiling(rng: np.random.Generator) -> tuple[Component, FloatArray]:
    """A fixed block near the page's top, and where a link leaves its lower side."""
    left = np.array([rng.uniform(200, 280), rng.uniform(30, 80)])
    width, height = rng.uniform(90, 190), rng.uniform(28, 55)
    part = block("ceiling", rectangle(left, left + xy(width, height)), fixed=True)
    return part, left + xy(rng.uniform(0.3, 0.7) * width, height)


def maybe_gravity(rng: np.random.Generator) -> tuple[float, tuple[Remark, ...]]:
    """Every third page states its own g, for the whole page."""
    return (10.0, (Remark("g = 10"),)) if rng.random() < 1 / 3 else (GRAVITY, ())


def rectangle(one: FloatArray, other: FloatArray) -> FloatArray:
    """The upright rectangle between two opposite corners, (4, 2), from the top left to the right."""
    (left, top), (right, bottom) = np.minimum(one, other), np.maximum(one, other)
    return np.array([[left, top], [right, top], [right, bottom], [left, bottom]])


def block(label: str, vertices: FloatArray, fixed: bool = False) -> Component:
    """A polygon from its corners, (n, 2)."""
    return Component(Polygon(vertices), label=label, fixed=fixed)


def point(values: FloatArray) -> Point:
    """The place (2,) as a pair, which shapes and anchors are made of."""
    return (float(values[0]), float(values[1]))


def xy(x: float, y: float) -> FloatArray:
    """A place or a step on the page, (2,)."""
    return np.array([x, y], dtype=float)
