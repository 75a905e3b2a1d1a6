"""A pendulum: a ball on a wire under a block, let go at an angle."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from data_gen.diagrams.problem import (
    Expected,
    Problem,
    Remark,
    Span,
    ceiling,
    maybe_gravity,
    point,
)
from sketch.page import Component
from sketch.shapes import Circle, Wire


@dataclass(frozen=True, slots=True)
class PendulumRanges:
    """A ball on a wire under a block, drawn at an angle."""

    angle: Span = (0.25, 0.9)
    """From the vertical, radians, to either side."""
    length: Span = (110.0, 210.0)
    radius: Span = (18.0, 38.0)
    seconds: float = 2.0


def pendulum(_answer: str, rng: np.random.Generator) -> Problem:
    """Nothing is asked: it swings."""
    ranges = PendulumRanges()
    anchor, high = ceiling(rng)
    angle = rng.uniform(*ranges.angle) * rng.choice([-1, 1])
    along = np.array([sin(angle), cos(angle)])
    length, radius = rng.uniform(*ranges.length), float(rng.uniform(*ranges.radius))
    low, centre = high + length * along, high + (length + radius) * along
    parts = (
        anchor,
        Component(Wire(point(high), point(low)), label="wire", ends=("ceiling", "ball")),
        Component(Circle(point(centre), radius), label="ball"),
    )
    remarks = maybe_gravity(rng)[1]
    if rng.random() < 0.4:
        remarks += (Remark(f"m = {rng.integers(1, 4)}", (("ball", point(centre)),)),)
    return Problem(parts, remarks, ranges.seconds, Expected({"ball": frozenset({"swings"})}))
