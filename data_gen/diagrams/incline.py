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
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Circle, Point

SLOPES: tuple[tuple[str, float], ...] = (
    ("pi/5", pi / 5),
    ("pi/6", pi / 6),
    ("pi/7", pi / 7),
    ("pi/8", pi / 8),
    ("0.5", 0.5),
    ("0.6", 0.6),
)
"""As written and in radians: steep enough to see things roll and above the 12 degrees below which a drawn edge is
taken for level, flat enough to fit on the page."""


@dataclass(frozen=True, slots=True)
class TriangleRanges:
    """A right-angled triangle. ground: height of its base on the page; height: at most, so that it leaves room for its
    mathematics; aside: from the middle of the page, to either side."""

    base: Span = (270.0, 380.0)
    ground: Span = (330.0, 400.0)
    aside: float = 60.0
    height: float = 240.0


@dataclass(frozen=True, slots=True)
class Triangle:
    """An incline: foot, corner (the right angle) and top, (2,) page units; angle at the foot, rad, and as written;
    side: which way it rises."""

    foot: FloatArray
    corner: FloatArray
    top: FloatArray
    angle: float
    written: str
    side: float

    @property
    def vertices(self) -> FloatArray:
        """(3, 2)."""
        return np.array([self.foot, self.corner, self.top])

    @property
    def up(self) -> FloatArray:
        """The unit vector up the long side."""
        return xy(self.side * cos(self.angle), -sin(self.angle))

    @property
    def out(self) -> FloatArray:
        """The unit vector out of the long side."""
        return xy(-self.side * sin(self.angle), -cos(self.angle))

    @property
    def at_foot(self) -> Point:
        """Where its angle is tapped."""
        return point(0.75 * self.foot + 0.25 * centroid(self.vertices))


def triangle(rng: np.random.Generator, ranges: TriangleRanges) -> Triangle:
    """A right-angled triangle with one of the angles that are written on inclines."""
    written, angle = SLOPES[rng.integers(len(SLOPES))]
    base = min(rng.uniform(*ranges.base), ranges.height / tan(angle))
    side = float(rng.choice([-1, 1]))
    middle = 300 - side * base / 2 + rng.uniform(-ranges.aside, ranges.aside)
    foot = np.array([middle, rng.uniform(*ranges.ground)])
    corner = foot + xy(side * base, 0)
    return Triangle(foot, corner, corner - xy(0, base * tan(angle)), angle, written, side)


@dataclass(frozen=True, slots=True)
class InclineRanges:
    """A right-angled triangle with a ball on its long side."""

    triangle: TriangleRanges = TriangleRanges()
    radius: Span = (18.0, 36.0)
    along: Span = (0.72, 0.9)
    """Where the ball touches, from the foot (0) to the top (1)."""
    stop: float = 0.12
    """Watched until the ball is this share of the long side away from the foot."""


def incline_and_ball(answer: str, rng: np.random.Generator) -> Problem:
    """Right: f_1 balances the weight's part into the incline and the ball rolls; low and high: a tenth off."""
    ranges = InclineRanges()
    at = triangle(rng, ranges.triangle)
    long = at.top - at.foot
    radius = float(rng.uniform(*ranges.radius))
    along = float(rng.uniform(*ranges.along))
    centre = at.foot + along * long + radius * at.out

    gravity, remarks = maybe_gravity(rng)
    scale = {"right": "", "low": "0.9 ", "high": "1.1 "}[answer]
    remarks += (
        Remark(f"theta = {at.written}", (("incline", at.at_foot),)),
        Remark(f"f_1 = {scale}|W| cos(theta)", (("ball", point(centre)),)),
    )
    if rng.random() < 0.3:
        remarks += (Remark(f"m = {rng.integers(1, 6)}", (("ball", point(centre)),)),)
    slide = (along - ranges.stop) * float(np.linalg.norm(long)) / PER_METRE
    fate = {"right": "rolls", "low": "bounces", "high": "flies off"}[answer]
    return Problem(
        (block("incline", at.vertices, fixed=True), Component(Circle(point(centre), radius), label="ball")),
        remarks,
        seconds=sqrt(2 * slide / (gravity * sin(at.angle))),
        expected=Expected({"ball": frozenset({fate})}),
    )
