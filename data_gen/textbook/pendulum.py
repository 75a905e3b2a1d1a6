"""A ball on a wire, let go at an angle.

The closed forms are the point mass's, at the ball's centre. The ball's own turning makes them wrong by a
quarter of (radius / length)², 0.15 % at most with these ranges, and an amplitude of 0.15 rad the
period's by 0.14 %: both within what judging forgives for three digits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, degrees, pi, sin, sqrt

import numpy as np

from data_gen.diagrams.problem import (
    PER_METRE,
    Span,
    block,
    maybe_gravity,
    point,
    rectangle,
    xy,
)
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, pick, remark
from sketch.page import Component
from sketch.shapes import Circle, Point, Wire


@dataclass(frozen=True, slots=True)
class PendulumRanges:
    """A small ball on a long wire under a block."""

    angles: tuple[tuple[str, float], ...] = (
        ("pi/5", pi / 5),
        ("pi/6", pi / 6),
        ("pi/8", pi / 8),
        ("0.5", 0.5),
        ("0.7", 0.7),
    )
    small: tuple[tuple[str, float], ...] = (("0.1", 0.1), ("0.12", 0.12), ("0.15", 0.15))
    lengths: tuple[str, ...] = ("1.8", "2", "2.2", "2.5")
    """m, from the pin to the ball's middle."""
    radius: Span = (11.0, 13.0)
    masses: tuple[str, ...] = ("0.5", "1.5", "2", "3")


RANGES = PendulumRanges()


@dataclass(frozen=True, slots=True)
class Hung:
    """A pendulum as drawn."""

    situation: Situation
    angle: float
    length: float
    mass: float
    g: float
    ball: tuple[str, Point]
    wire: tuple[str, Point]


def hung(rng: np.random.Generator, angles: tuple[tuple[str, float], ...] = RANGES.angles) -> Hung:
    """A pendulum let go at one of these angles."""
    written, angle = angles[rng.integers(len(angles))]
    length_text, length = pick(rng, RANGES.lengths)
    side = float(rng.choice([-1, 1]))
    high = xy(300 + rng.uniform(-40, 40), rng.uniform(60, 90))
    way = xy(side * sin(angle), cos(angle))
    radius = float(rng.uniform(*RANGES.radius))
    centre = high + PER_METRE * length * way
    low = centre - radius * way
    mass_text, mass = pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    given += (
        remark(f"d = {length_text}"),
        remark(f"theta = {written}", "wire", point(0.85 * high + 0.15 * low)),
        remark(f"m = {mass_text}", "ball", point(centre)),
    )
    parts = (
        block("ceiling", rectangle(high - xy(70, 35), high + xy(70, 0)), fixed=True),
        Component(Wire(point(high), point(low)), label="wire", ends=("ceiling", "ball")),
        Component(Circle(point(centre), radius), label="ball"),
    )
    return Hung(
        Situation(parts, given, 2.0),
        angle,
        length,
        mass,
        g,
        ("ball", point(centre)),
        ("wire", point(0.5 * (high + low))),
    )


def period(rng: np.random.Generator) -> Exercise:
    at = hung(rng, RANGES.small)
    value = 2 * pi * sqrt(at.length / at.g)
    formula = rng.random() < 0.5
    return ask(
        "With what period does the pendulum swing?",
        at.situation,
        at.ball,
        "T",
        "s",
        value,
        (
            Wrong("forgot 2 pi", sqrt(at.length / at.g), "sqrt(d/g)" if formula else None),
            Wrong("turned upside down", 2 * pi * sqrt(at.g / at.length), "2 pi sqrt(g/d)"),
            Wrong("factor 2", value / 2),
            Wrong("forgot g", 2 * pi * sqrt(at.length)),
        ),
        "2 pi sqrt(d/g)" if formula else None,
    )


def greatest_speed(rng: np.random.Generator) -> Exercise:
    at = hung(rng)
    value = sqrt(2 * at.g * at.length * (1 - cos(at.angle)))
    formula = rng.random() < 0.5
    return ask(
        "What is the greatest speed of the ball?",
        at.situation,
        at.ball,
        "v_max",
        "m/s",
        value,
        (
            Wrong(
                "sine for cosine",
                sqrt(2 * at.g * at.length * (1 - sin(at.angle))),
                "sqrt(2 g d (1 - sin(theta)))" if formula else None,
            ),
            Wrong("forgot the root", value**2, "2 g d (1 - cos(theta))" if formula else None),
            Wrong("forgot g", value / sqrt(at.g)),
            Wrong("factor 2 under the root", value / sqrt(2)),
        ),
        "sqrt(2 g d (1 - cos(theta)))" if formula else None,
    )


def tension_at_start(rng: np.random.Generator) -> Exercise:
    at = hung(rng)
    weight = at.mass * at.g
    formula = rng.random() < 0.5
    return ask(
        "What is the wire's tension at the moment when the ball is let go?",
        at.situation,
        at.wire,
        "T_0",
        "N",
        weight * cos(at.angle),
        (
            Wrong("sine for cosine", weight * sin(at.angle), "|W| sin(theta)" if formula else None),
            Wrong("forgot g", at.mass * cos(at.angle), "m cos(theta)" if formula else None),
            Wrong("left out the angle", weight),
            Wrong("degrees for radians", weight * cos(degrees(at.angle))),
        ),
        "|W| cos(theta)" if formula else None,
    )


def greatest_tension(rng: np.random.Generator) -> Exercise:
    at = hung(rng)
    weight = at.mass * at.g
    return ask(
        "What is the greatest tension of the wire?",
        at.situation,
        at.wire,
        "T_max",
        "N",
        weight * (3 - 2 * cos(at.angle)),
        (
            Wrong("sine for cosine", weight * (3 - 2 * sin(at.angle))),
            Wrong("forgot g", at.mass * (3 - 2 * cos(at.angle))),
            Wrong("wrong sign", weight * (3 + 2 * cos(at.angle)), "|W| (3 + 2 cos(theta))"),
            Wrong("factor 2", weight * (3 - 2 * cos(at.angle)) / 2),
        ),
        "|W| (3 - 2 cos(theta))" if rng.random() < 0.5 else None,
    )


def acceleration_at_start(rng: np.random.Generator) -> Exercise:
    at = hung(rng)
    return ask(
        "What is the ball's acceleration at the moment when it is let go?",
        at.situation,
        at.ball,
        "a_0",
        "m/s²",
        at.g * sin(at.angle),
        (
            Wrong("sine for cosine", at.g * cos(at.angle)),
            Wrong("forgot g", sin(at.angle)),
            Wrong("left out the angle", at.g),
            Wrong("degrees for radians", at.g * sin(degrees(at.angle))),
        ),
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "period": period,
    "greatest speed": greatest_speed,
    "tension at the start": tension_at_start,
    "greatest tension": greatest_tension,
    "acceleration at the start": acceleration_at_start,
}
"""What is asked -> the problem drawn anew from a random generator."""
