"""A planet about a fixed sun, F = −c r / r³ with c = G M m, written on the page as a force.

The page is the plane of the orbit, so nothing weighs on it. x and y of the force are measured from where
the planet was drawn, at the distance d to the right of the sun.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from data_gen.diagrams.problem import PER_METRE, Span, point, xy
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, number, pick, remark
from sketch.page import Component
from sketch.shapes import Circle, Point


@dataclass(frozen=True, slots=True)
class OrbitRanges:
    """How large and how fast."""

    distances: tuple[str, ...] = ("1.2", "1.5", "1.6")
    """m, of the planet at its start."""
    speeds: tuple[str, ...] = ("1.5", "2", "2.5", "3")
    """m/s, upwards."""
    masses: tuple[str, ...] = ("0.5", "2", "3", "4")
    stretch: tuple[float, ...] = (1.2, 1.3, 1.4)
    """v² r / (c/m): 1 is a circle, 2 a parabola."""
    sun: Span = (16.0, 24.0)
    planet: Span = (9.0, 12.0)


RANGES = OrbitRanges()


@dataclass(frozen=True, slots=True)
class Orbit:
    """strength: c / m, m³/s²; far: the greatest distance from the sun, m."""

    situation: Situation
    distance: float
    speed: float
    mass: float
    strength: float
    about: tuple[str, Point]

    @property
    def axis(self) -> float:
        """The long half axis, m, by the energy of the orbit."""
        return 1 / (2 / self.distance - self.speed**2 / self.strength)

    @property
    def far(self) -> float:
        """The greatest distance from the sun, m."""
        return 2 * self.axis - self.distance


def orbit(rng: np.random.Generator, stretch: float) -> Orbit:
    """A planet at its smallest distance (stretch above 1) or on a circle (1)."""
    distance_text, distance = pick(rng, RANGES.distances)
    speed_text, speed = pick(rng, RANGES.speeds)
    mass_text, mass = pick(rng, RANGES.masses)
    pull = number(mass * speed**2 * distance / stretch)
    sun = xy(300 + (70 if stretch > 1 else 0) + rng.uniform(-15, 15), 225 + rng.uniform(-20, 20))
    planet = point(sun + xy(PER_METRE * distance, 0))
    below = f"((x + {distance_text})^2 + y^2)^(3/2)"
    given = (
        remark("g = 0"),
        remark(f"d = {distance_text}"),
        remark(f"c = {pull}"),
        remark(f"m = {mass_text}", "planet", planet),
        remark(f"v_y = {speed_text}", "planet", planet),
        remark(f"F = (-c (x + {distance_text})/{below}, -c y/{below})", "planet", planet),
    )
    parts = (
        Component(Circle(point(sun), float(rng.uniform(*RANGES.sun))), label="sun", fixed=True),
        Component(Circle(planet, float(rng.uniform(*RANGES.planet))), label="planet"),
    )
    situation = Situation(parts, given, 3.0)
    return Orbit(situation, distance, speed, mass, float(pull) / mass, ("planet", planet))


def _ellipse(rng: np.random.Generator) -> Orbit:
    return orbit(rng, float(rng.choice(RANGES.stretch)))


def circle_period(rng: np.random.Generator) -> Exercise:
    at = orbit(rng, 1.0)
    value = 2 * pi * at.distance / at.speed
    return ask(
        "How long does the planet take to go round once on its circle?",
        at.situation,
        at.about,
        "T",
        "s",
        value,
        (
            Wrong("forgot 2 pi", at.distance / at.speed),
            Wrong("factor 2", value / 2),
            Wrong("turned upside down", 1 / value),
        ),
    )


def acceleration(rng: np.random.Generator) -> Exercise:
    at = orbit(rng, 1.0)
    value = at.strength / at.distance**2
    formula = rng.random() < 0.5
    return ask(
        "What is the acceleration of the planet at the distance d?",
        at.situation,
        at.about,
        "a_0",
        "m/s²",
        value,
        (
            Wrong("forgot the square", at.strength / at.distance, "c/(m d)"),
            Wrong("factor 2", 2 * value, "2 c/(m d^2)" if formula else None),
            Wrong("wrong sign", -value),
        ),
        "c/(m d^2)" if formula else None,
    )


def far_point(rng: np.random.Generator) -> Exercise:
    at = _ellipse(rng)
    value = -2 * at.axis
    return ask(
        "Where, measured to the right from its start, does the planet turn back?",
        at.situation,
        at.about,
        "x_min",
        "m",
        value,
        (
            Wrong("factor 2", value / 2),
            Wrong("wrong sign", -value),
            Wrong("unit not converted", 100 * value),
        ),
    )


def slowest(rng: np.random.Generator) -> Exercise:
    at = _ellipse(rng)
    value = at.speed * at.distance / at.far
    return ask(
        "What is the smallest speed of the planet?",
        at.situation,
        at.about,
        "v_min",
        "m/s",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("forgot the root", value**2),
            Wrong("turned upside down", 1 / value),
            Wrong("wrong sign", -value),
        ),
    )


def ellipse_period(rng: np.random.Generator) -> Exercise:
    at = _ellipse(rng)
    value = 2 * pi * sqrt(at.axis**3 / at.strength)
    return ask(
        "How long does the planet take to go round once on its ellipse?",
        at.situation,
        at.about,
        "T",
        "s",
        value,
        (
            Wrong("forgot 2 pi", value / (2 * pi)),
            Wrong("factor 2", value / 2),
            Wrong("turned upside down", 1 / value),
            Wrong("forgot the root", value**2),
        ),
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "period on a circle": circle_period,
    "acceleration": acceleration,
    "far point": far_point,
    "smallest speed": slowest,
    "period on an ellipse": ellipse_period,
}
"""What is asked -> the problem drawn anew from a random generator."""
