"""A mass that hangs on a spring and is let go, or is pushed away from a wall on a smooth floor."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from data_gen.diagrams.problem import Span, block, ceiling, maybe_gravity, point, rectangle, xy
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, pick, remark
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Point, Spring


@dataclass(frozen=True, slots=True)
class SpringRanges:
    """A spring as long as it rests, with a mass."""

    length: Span = (90.0, 140.0)
    width: Span = (18.0, 30.0)
    coils: tuple[int, int] = (5, 9)
    half: Span = (25.0, 36.0)
    stiffness: tuple[str, ...] = ("20", "30", "40", "50", "80")
    masses: tuple[str, ...] = ("0.5", "0.8", "1.2", "1.5")
    """kg: stretches such springs by a metre at most."""
    push: tuple[str, ...] = ("1", "1.5", "2", "2.5")


RANGES = SpringRanges()


@dataclass(frozen=True, slots=True)
class Swing:
    """A mass on a spring."""

    situation: Situation
    mass: float
    stiffness: float
    g: float
    push: float
    spot: Point

    @property
    def about(self) -> tuple[str, Point]:
        """The mass."""
        return ("mass", self.spot)


def _spring(rng: np.random.Generator, start: FloatArray, end: FloatArray, holder: str) -> Component:
    coils = float(rng.integers(RANGES.coils[0], RANGES.coils[1] + 1))
    shape = Spring(point(start), point(end), coils, float(rng.uniform(*RANGES.width)))
    return Component(shape, label="spring", ends=(holder, "mass"))


def hanging(rng: np.random.Generator) -> Swing:
    """Let go where the spring is at rest."""
    anchor, high = ceiling(rng)
    low = high + xy(0, rng.uniform(*RANGES.length))
    half = float(rng.uniform(*RANGES.half))
    box = rectangle(low - xy(half, 0), low + xy(half, 1.6 * half))
    middle = point(box.mean(axis=0))
    mass_text, mass = pick(rng, RANGES.masses)
    stiff_text, stiffness = pick(rng, RANGES.stiffness)
    g, given = maybe_gravity(rng)
    given += (
        remark(f"k = {stiff_text}", "spring", point(0.5 * (high + low))),
        remark(f"m = {mass_text}", "mass", middle),
    )
    parts = (anchor, _spring(rng, high, low, "ceiling"), block("mass", box))
    return Swing(Situation(parts, given, 2.0), mass, stiffness, g, 0.0, middle)


def pushed(rng: np.random.Generator) -> Swing:
    """On a smooth floor, pushed away from the wall that the spring is fixed to."""
    ground = float(rng.uniform(320, 380))
    wall = xy(110, ground)
    half = float(rng.uniform(*RANGES.half))
    near = wall - xy(0, half)
    far = near + xy(rng.uniform(*RANGES.length), 0)
    box = rectangle(far - xy(0, half), far + xy(2 * half, half))
    middle = point(box.mean(axis=0))
    mass_text, mass = pick(rng, RANGES.masses)
    stiff_text, stiffness = pick(rng, ("50", "80", "100"))
    push_text, push = pick(rng, RANGES.push)
    given = (
        remark(f"k = {stiff_text}", "spring", point(0.5 * (near + far))),
        remark(f"m = {mass_text}", "mass", middle),
        remark(f"v_x = {push_text}", "mass", middle),
    )
    parts = (
        block("wall", rectangle(wall - xy(40, 130), wall), fixed=True),
        block("floor", rectangle(wall - xy(40, 0), xy(585, ground + 30)), fixed=True),
        block("mass", box),
        _spring(rng, near, far, "wall"),
    )
    return Swing(Situation(parts, given, 2.0), mass, stiffness, 9.81, push, middle)


def period(rng: np.random.Generator) -> Exercise:
    at = hanging(rng)
    value = 2 * pi * sqrt(at.mass / at.stiffness)
    formula = rng.random() < 0.5
    return ask(
        "With what period does the mass swing?",
        at.situation,
        at.about,
        "T",
        "s",
        value,
        (
            Wrong("forgot 2 pi", value / (2 * pi), "sqrt(m/k)" if formula else None),
            Wrong("turned upside down", (2 * pi) ** 2 / value, "2 pi sqrt(k/m)"),
            Wrong("weight for mass", value * sqrt(at.g)),
            Wrong("factor 2", value / 2),
            Wrong("turned upside down", 1 / value),
        ),
        "2 pi sqrt(m/k)" if formula else None,
    )


def lowest_point(rng: np.random.Generator) -> Exercise:
    at = hanging(rng)
    value = -2 * at.mass * at.g / at.stiffness
    return ask(
        "Where, measured upwards from where it is let go, is the lowest point of the mass?",
        at.situation,
        at.about,
        "y_min",
        "m",
        value,
        (
            Wrong("factor 2", value / 2),
            Wrong("wrong sign", -value),
            Wrong("forgot g", value / at.g),
            Wrong("weight for mass", value * at.g),
        ),
    )


def greatest_speed(rng: np.random.Generator) -> Exercise:
    at = hanging(rng)
    value = at.g * sqrt(at.mass / at.stiffness)
    formula = rng.random() < 0.5
    return ask(
        "What is the greatest speed of the mass?",
        at.situation,
        at.about,
        "v_max",
        "m/s",
        value,
        (
            Wrong("forgot g", value / at.g, "sqrt(m/k)" if formula else None),
            Wrong("factor 2", value / 2),
            Wrong("forgot the root", value**2),
            Wrong("weight for mass", value * sqrt(at.g)),
        ),
        "g sqrt(m/k)" if formula else None,
    )


def greatest_energy(rng: np.random.Generator) -> Exercise:
    at = hanging(rng)
    value = (at.mass * at.g) ** 2 / (2 * at.stiffness)
    return ask(
        "What is the greatest kinetic energy of the mass?",
        at.situation,
        at.about,
        "E_kmax",
        "J",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("forgot g", value / at.g**2),
            Wrong("wrong sign", -value),
            Wrong("unit not converted", 1000 * value),
        ),
    )


def amplitude(rng: np.random.Generator) -> Exercise:
    at = pushed(rng)
    value = at.push * sqrt(at.mass / at.stiffness)
    return ask(
        "How far does the mass that is pushed get from its start?",
        at.situation,
        at.about,
        "x_max",
        "m",
        value,
        (
            Wrong("forgot the root", value**2),
            Wrong("factor 2", value / 2),
            Wrong("weight for mass", value * sqrt(at.g)),
            Wrong("unit not converted", 100 * value),
        ),
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "period": period,
    "lowest point": lowest_point,
    "greatest speed": greatest_speed,
    "greatest energy": greatest_energy,
    "amplitude": amplitude,
}
"""What is asked -> the problem drawn anew from a random generator."""
