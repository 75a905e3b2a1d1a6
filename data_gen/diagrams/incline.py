"""A ball on an incline, held off it by the normal force that a student gives (worked example 1
of the sketch-based physics tutor of Cheema and LaViola).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin, sqrt, tan

import numpy as np

from data_gen.diagrams.problem import (
    PER_METRE,
    Expected,
    Problem,
    Remark,
    Span,
    block,
    maybe_gravity,
    point,
    xy,
)
from sketch.geometry import centroid
from sketch.page import Component
from sketch.shapes import Circle


@dataclass(frozen=True, slots=True)
class InclineRanges:
    """A right-angled triangle with a ball on its long side."""

    angles: tuple[tuple[str, float], ...] = (
        ("pi/5", pi / 5),
        ("pi/6", pi / 6),
        ("pi/7", pi / 7),
        ("pi/8", pi / 8),
        ("0.5", 0.5),
        ("0.6", 0.6),
    )
    """As written and in radians: steep enough to see it roll, flat enough to fit on the page."""
    base: Span = (270.0, 380.0)
    height: float = 240.0
    """At most: the triangle leaves room for its mathematics."""
    radius: Span = (18.0, 36.0)
    along: Span = (0.72, 0.9)
    """Where the ball touches, from the foot (0) to the top (1)."""
    stop: float = 0.12
    """Watched until the ball is this share of the long side away from the foot."""


def incline_and_ball(answer: str, rng: np.random.Generator) -> Problem:
    """Right: f_1 balances the weight's part into the incline and the ball rolls; low and high: a tenth off."""
    ranges = InclineRanges()
    written, angle = ranges.angles[rng.integers(len(ranges.angles))]
    base = min(rng.uniform(*ranges.base), ranges.height / tan(angle))
    side = float(rng.choice([-1, 1]))  # which way it rises
    foot = np.array([300 - side * base / 2 + rng.uniform(-60, 60), rng.uniform(330, 400)])
    corner = foot + xy(side * base, 0)
    top = corner - xy(0, base * tan(angle))
    radius = float(rng.uniform(*ranges.radius))
    along = float(rng.uniform(*ranges.along))
    outward = np.array([-side * sin(angle), -cos(angle)])
    centre = foot + along * (top - foot) + radius * outward
    vertices = np.array([foot, corner, top])

    gravity, remarks = maybe_gravity(rng)
    scale = {"right": "", "low": "0.9 ", "high": "1.1 "}[answer]
    remarks += (
        Remark(f"theta = {written}", (("incline", point(0.75 * foot + 0.25 * centroid(vertices))),)),
        Remark(f"f_1 = {scale}|W| cos(theta)", (("ball", point(centre)),)),
    )
    if rng.random() < 0.3:
        remarks += (Remark(f"m = {rng.integers(1, 6)}", (("ball", point(centre)),)),)
    slide = (along - ranges.stop) * float(np.linalg.norm(top - foot)) / PER_METRE
    fate = {"right": "rolls", "low": "bounces", "high": "flies off"}[answer]
    return Problem(
        (block("incline", vertices, fixed=True), Component(Circle(point(centre), radius), label="ball")),
        remarks,
        seconds=sqrt(2 * slide / (gravity * sin(angle))),
        expected=Expected({"ball": frozenset({fate})}),
    )
