"""A ball on a wire that goes round a pin, and one on the top of a round hill.

Where the ball goes round a pin it turns with the wire, so it is given that spin (ω) as well as its velocity:
then every closed form is exact for a ball of any size.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from data_gen.diagrams.problem import PER_METRE, Span, block, maybe_gravity, point, rectangle, xy
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, number, pick, remark
from sketch.page import Component
from sketch.shapes import Circle, Point, Wire


@dataclass(frozen=True, slots=True)
class CircleRanges:
    """How large and how fast."""

    distances: tuple[str, ...] = ("1.2", "1.5", "1.6")
    """m, from the pin to the ball's middle."""
    spins: tuple[str, ...] = ("1.5", "2.5", "3", "4")
    """rad/s."""
    fast: tuple[str, ...] = ("3", "4", "5")
    radius: Span = (13.0, 20.0)
    hill: tuple[str, ...] = ("1.2", "1.5", "1.8")
    """m, from the hill's middle to the ball's."""
    speeds: tuple[str, ...] = ("1", "1.5", "2", "2.5")
    masses: tuple[str, ...] = ("0.5", "1.5", "2", "3")
    watched: float = 1.5
    """rad: a given tension keeps a ball that a pen drew a little aside on its circle for so long."""


RANGES = CircleRanges()


@dataclass(frozen=True, slots=True)
class Round:
    """A ball in circular motion. distance: from the middle of the circle, m; spin: rad/s."""

    situation: Situation
    mass: float
    distance: float
    spin: float
    g: float
    ball: tuple[str, Point]
    wire: tuple[str, Point]


def on_a_table(rng: np.random.Generator) -> Round:
    """Seen from above, where nothing weighs: the ball sets out to the right of the pin, or to the left."""
    side = float(rng.choice([-1, 1]))
    return _round(rng, xy(side, 0), RANGES.spins, level=True)


def upright(rng: np.random.Generator) -> Round:
    """Seen from the side: the ball goes through its lowest point."""
    return _round(rng, xy(0, 1), RANGES.fast, level=False)


def _round(rng: np.random.Generator, way: np.ndarray, spins: tuple[str, ...], level: bool) -> Round:
    pin = xy(300 + rng.uniform(-40, 40), 225 + rng.uniform(-30, 30))
    distance_text, distance = pick(rng, RANGES.distances)
    spin_text, spin = pick(rng, spins)
    radius = float(rng.uniform(*RANGES.radius))
    centre = pin + PER_METRE * distance * way
    low = centre - radius * way
    mass_text, mass = pick(rng, RANGES.masses)
    g, given = (0.0, (remark("g = 0"),)) if level else maybe_gravity(rng)
    ball = point(centre)
    speed = spin * distance
    # Anticlockwise, as a positive spin is: upwards on the right, to the right at the bottom.
    velocity = f"(0, {number(way[0] * speed)})" if level else f"({number(speed)}, 0)"
    given += (
        remark(f"d = {distance_text}"),
        remark(f"m = {mass_text}", "ball", ball),
        remark(f"v_0 = {velocity}", "ball", ball),
        remark(f"omega = {spin_text}", "ball", ball),
    )
    half = 12.0
    middle = pin - half * way
    parts = (
        block("pin", rectangle(middle - xy(half, half), middle + xy(half, half)), fixed=True),
        Component(Wire(point(pin), point(low)), label="wire", ends=("pin", "ball")),
        Component(Circle(ball, radius), label="ball"),
    )
    wire = ("wire", point(0.5 * (pin + low)))
    return Round(
        Situation(parts, given, RANGES.watched / spin), mass, distance, spin, g, ("ball", ball), wire
    )


def tension(rng: np.random.Generator) -> Exercise:
    at = on_a_table(rng)
    value = at.mass * at.spin**2 * at.distance
    formula = rng.random() < 0.5
    return ask(
        "What is the tension of the wire on which the ball goes round on a smooth table?",
        at.situation,
        at.wire,
        "T",
        "N",
        value,
        (
            Wrong("forgot the square", at.mass * at.spin * at.distance, "m omega d"),
            Wrong("factor 2", value / 2, "1/2 m omega^2 d" if formula else None),
            Wrong("wrong sign", -value, "-m omega^2 d" if formula else None),
            Wrong("factor 2", 2 * value),
        ),
        "m omega^2 d" if formula else None,
    )


def period(rng: np.random.Generator) -> Exercise:
    at = on_a_table(rng)
    value = 2 * pi / at.spin
    return ask(
        "How long does the ball take to go round once?",
        at.situation,
        at.ball,
        "T",
        "s",
        value,
        (
            Wrong("forgot 2 pi", 1 / at.spin),
            Wrong("turned upside down", 1 / value),
            Wrong("factor 2", value / 2),
        ),
    )


def acceleration(rng: np.random.Generator) -> Exercise:
    at = on_a_table(rng)
    value = at.spin**2 * at.distance
    formula = rng.random() < 0.5
    return ask(
        "What is the acceleration of the ball that goes round?",
        at.situation,
        at.ball,
        "a",
        "m/s²",
        value,
        (
            Wrong("forgot the square", at.spin * at.distance, "omega d"),
            Wrong("factor 2", value / 2, "1/2 omega^2 d" if formula else None),
            Wrong("wrong sign", -value),
        ),
        "omega^2 d" if formula else None,
    )


def tension_below(rng: np.random.Generator) -> Exercise:
    at = upright(rng)
    inward = at.mass * at.spin**2 * at.distance
    weight = at.mass * at.g
    return ask(
        "What is the tension of the wire at the moment when the ball is at its lowest point?",
        at.situation,
        at.wire,
        "T",
        "N",
        weight + inward,
        (
            Wrong("forgot gravity", inward),
            Wrong("wrong sign", inward - weight, "m omega^2 d - m g"),
            Wrong("forgot g", at.mass + inward),
            Wrong("factor 2", 2 * (weight + inward)),
        ),
        "m g + m omega^2 d" if rng.random() < 0.5 else None,
    )


def on_a_hill(rng: np.random.Generator) -> Exercise:
    """The ball runs over the top of a fixed circle: N = m (g − v²/r)."""
    distance_text, distance = pick(rng, RANGES.hill)
    radius = float(rng.uniform(*RANGES.radius))
    top = xy(300 + rng.uniform(-60, 60), rng.uniform(130, 170))
    hill = top + xy(0, PER_METRE * distance)
    g, given = maybe_gravity(rng)
    speed_text, speed = pick(rng, [text for text in RANGES.speeds if float(text) < 0.8 * sqrt(g * distance)])
    mass_text, mass = pick(rng, RANGES.masses)
    ball = point(top)
    given += (
        remark(f"d = {distance_text}"),
        remark(f"m = {mass_text}", "ball", ball),
        remark(f"v_x = {speed_text}", "ball", ball),
    )
    parts = (
        Component(Circle(point(hill), PER_METRE * distance - radius), label="hill", fixed=True),
        Component(Circle(ball, radius), label="ball"),
    )
    inward = mass * speed**2 / distance
    return ask(
        "With what force does the round hill hold the ball that runs over its top?",
        Situation(parts, given, 0.5),
        ("ball", ball),
        "N",
        "N",
        mass * g - inward,
        (
            Wrong("wrong sign", mass * g + inward, f"|W| + m {speed_text}^2/d"),
            Wrong("forgot the start velocity", mass * g),
            Wrong("factor 2", (mass * g - inward) / 2),
            Wrong("wrong sign", inward - mass * g),
        ),
        f"|W| - m {speed_text}^2/d" if rng.random() < 0.5 else None,
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "tension": tension,
    "period": period,
    "acceleration": acceleration,
    "tension below": tension_below,
    "on a hill": on_a_hill,
}
"""What is asked -> the problem drawn anew from a random generator."""
