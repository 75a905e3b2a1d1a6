"""Work and energy: a box that friction stops, a ball that falls, a pendulum that is struck."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from data_gen.diagrams.problem import PER_METRE, Span, block, maybe_gravity, point, rectangle, xy
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, number, pick, remark
from data_gen.textbook.projectile import flight
from sketch.page import Component
from sketch.shapes import Circle, Point, Wire


@dataclass(frozen=True, slots=True)
class BrakingRanges:
    """A box that is pushed along a rough floor, and a struck pendulum."""

    half: Span = (30.0, 45.0)
    tall: Span = (30.0, 45.0)
    speeds: tuple[str, ...] = ("2", "2.5", "3", "3.5")
    rough: tuple[str, ...] = ("0.2", "0.25", "0.3", "0.4")
    masses: tuple[str, ...] = ("0.5", "1.5", "2", "3", "4")
    lengths: tuple[str, ...] = ("2", "2.2", "2.5")
    radius: Span = (11.0, 13.0)
    spins: tuple[str, ...] = ("0.8", "1", "1.2")
    """rad/s: so slow that the wire stays taut."""


RANGES = BrakingRanges()


@dataclass(frozen=True, slots=True)
class Braking:
    """A box on its way to a stop."""

    situation: Situation
    mass: float
    speed: float
    mu: float
    g: float
    spot: Point

    @property
    def about(self) -> tuple[str, Point]:
        """The box."""
        return ("box", self.spot)


def braking(rng: np.random.Generator) -> Braking:
    """A flat box on a long rough floor, pushed to the right."""
    ground = float(rng.uniform(300, 380))
    half, tall = float(rng.uniform(*RANGES.half)), float(rng.uniform(*RANGES.tall))
    left = float(rng.uniform(25, 50))
    box = rectangle(xy(left, ground - tall), xy(left + 2 * half, ground))
    middle = point(box.mean(axis=0))
    speed_text, speed = pick(rng, RANGES.speeds)
    rough_text, mu = pick(rng, RANGES.rough)
    mass_text, mass = pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    given += tuple(
        remark(text, "box", middle)
        for text in (f"m = {mass_text}", f"mu = {rough_text}", f"v_x = {speed_text}")
    )
    parts = (
        block("floor", rectangle(xy(10, ground), xy(590, ground + 25)), fixed=True),
        block("box", box),
    )
    return Braking(Situation(parts, given, 2.0), mass, speed, mu, g, middle)


def braking_distance(rng: np.random.Generator) -> Exercise:
    at = braking(rng)
    value = at.speed**2 / (2 * at.mu * at.g)
    return ask(
        "How far does the box slide until it stops?",
        at.situation,
        at.about,
        "x_s",
        "m",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("forgot g", value * at.g),
            Wrong("wrong sign", -value),
            Wrong("unit not converted", 100 * value),
        ),
    )


def braking_time(rng: np.random.Generator) -> Exercise:
    at = braking(rng)
    value = at.speed / (at.mu * at.g)
    return ask(
        "After what time does the box stop?",
        at.situation,
        at.about,
        "t_s",
        "s",
        value,
        (
            Wrong("forgot g", value * at.g, f"{number(at.speed)}/mu"),
            Wrong("factor 2", value / 2),
            Wrong("turned upside down", 1 / value),
        ),
        f"{number(at.speed)}/(mu g)" if rng.random() < 0.5 else None,
    )


def heat(rng: np.random.Generator) -> Exercise:
    at = braking(rng)
    value = 0.5 * at.mass * at.speed**2
    return ask(
        "How much heat has come of the box's motion when it has stopped?",
        at.situation,
        at.about,
        "Q_s",
        "J",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("weight for mass", value * at.g),
            Wrong("wrong sign", -value),
        ),
    )


def falling_energy(rng: np.random.Generator) -> Exercise:
    at = flight(rng, ())
    value = at.mass * at.g * at.height
    formula = rng.random() < 0.5
    return ask(
        "What kinetic energy has the dropped ball when it reaches the floor?",
        at.situation,
        at.about,
        "E_kf",
        "J",
        value,
        (
            Wrong("forgot g", at.mass * at.height, "m h" if formula else None),
            Wrong("factor 2", value / 2, "1/2 m g h" if formula else None),
            Wrong("weight for mass", value * at.g, "|W| g h" if formula else None),
        ),
        "m g h" if formula else None,
    )


def struck_pendulum(rng: np.random.Generator) -> Exercise:
    """A ball that hangs on a wire is given a velocity (and the spin with which it follows the wire)."""
    length_text, length = pick(rng, RANGES.lengths)
    spin_text, spin = pick(rng, RANGES.spins)
    radius = float(rng.uniform(*RANGES.radius))
    high = xy(300 + rng.uniform(-40, 40), rng.uniform(60, 90))
    centre = high + xy(0, PER_METRE * length)
    low = centre - xy(0, radius)
    mass_text, _mass = pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    speed = spin * length
    ball = point(centre)
    given += (
        remark(f"d = {length_text}"),
        remark(f"m = {mass_text}", "ball", ball),
        remark(f"v_x = {number(speed)}", "ball", ball),
        remark(f"omega = {spin_text}", "ball", ball),
    )
    parts = (
        block("ceiling", rectangle(high - xy(70, 35), high + xy(70, 0)), fixed=True),
        Component(Wire(point(high), point(low)), label="wire", ends=("ceiling", "ball")),
        Component(Circle(ball, radius), label="ball"),
    )
    value = speed**2 / (2 * g)
    return ask(
        "How high does the ball on the wire rise that is struck?",
        Situation(parts, given, 2.0),
        ("ball", ball),
        "h_max",
        "m",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("forgot g", value * g),
            Wrong("wrong sign", -value),
            Wrong("unit not converted", 100 * value),
        ),
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "braking distance": braking_distance,
    "braking time": braking_time,
    "heat": heat,
    "falling energy": falling_energy,
    "struck pendulum": struck_pendulum,
}
"""What is asked -> the problem drawn anew from a random generator."""
