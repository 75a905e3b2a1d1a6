"""Bodies in free flight: dropped, thrown up, thrown level, thrown at an angle."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, degrees, pi, sin, sqrt

import numpy as np

from data_gen.diagrams.problem import PER_METRE, Remark, Span, block, maybe_gravity, rectangle, xy
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, pick, remark
from sketch.page import Component
from sketch.shapes import Circle, Point


@dataclass(frozen=True, slots=True)
class FlightRanges:
    """A ball above a fixed floor."""

    radius: Span = (13.0, 22.0)
    ground: Span = (385.0, 415.0)
    heights: tuple[str, ...] = ("1.5", "1.8", "2", "2.4", "2.5", "2.8")
    """m, of fall: what fits on the page."""
    masses: tuple[str, ...] = ("0.5", "2", "3", "4")
    level: tuple[str, ...] = ("1.5", "2", "3", "4")
    """m/s, of a level throw: lands on the floor as drawn."""
    up: tuple[str, ...] = ("3", "3.5", "4", "4.5")
    angles: tuple[tuple[str, float], ...] = (
        ("pi/3", pi / 3),
        ("pi/5", pi / 5),
        ("pi/6", pi / 6),
        ("1", 1.0),
        ("0.6", 0.6),
    )
    slanting: tuple[str, ...] = ("4", "4.5", "5", "5.5")


RANGES = FlightRanges()


@dataclass(frozen=True, slots=True)
class Flight:
    """A ball above a floor. height: of its fall, m."""

    situation: Situation
    height: float
    mass: float
    g: float
    spot: Point

    @property
    def about(self) -> tuple[str, Point]:
        """The ball."""
        return ("ball", self.spot)


def flight(
    rng: np.random.Generator, given: tuple[str, ...], said: tuple[Remark, ...] = (), low: bool = False
) -> Flight:
    """given: of the ball; said: of the whole page; low: it lies on the floor instead."""
    ground, radius = float(rng.uniform(*RANGES.ground)), float(rng.uniform(*RANGES.radius))
    height_text, height = ("0", 0.0) if low else pick(rng, RANGES.heights)
    centre = (float(rng.uniform(70, 110)), ground - radius - PER_METRE * height)
    floor = rectangle(xy(15, ground), xy(585, ground + rng.uniform(20, 30)))
    mass_text, mass = pick(rng, RANGES.masses)
    g, lines = maybe_gravity(rng)
    lines += said
    lines += () if low else (remark(f"h = {height_text}"),)
    lines += tuple(remark(text, "ball", centre) for text in (f"m = {mass_text}", *given))
    parts = (block("floor", floor, fixed=True), Component(Circle(centre, radius), label="ball"))
    return Flight(Situation(parts, lines, 1.0), height, mass, g, centre)


def landing_speed(rng: np.random.Generator) -> Exercise:
    at = flight(rng, ())
    value = sqrt(2 * at.g * at.height)
    formula = rng.random() < 0.5
    return ask(
        "How fast is the dropped ball when it reaches the floor?",
        at.situation,
        at.about,
        "v_f",
        "m/s",
        value,
        (
            Wrong("forgot the root", value**2, "2 g h" if formula else None),
            Wrong("forgot g", sqrt(2 * at.height), "sqrt(2 h)" if formula else None),
            Wrong("factor 2 under the root", value / sqrt(2), "sqrt(g h)" if formula else None),
            Wrong("factor 2", 2 * value),
        ),
        "sqrt(2 g h)" if formula else None,
    )


def falling_time(rng: np.random.Generator) -> Exercise:
    at = flight(rng, ())
    value = sqrt(2 * at.height / at.g)
    formula = rng.random() < 0.5
    return ask(
        "How long does the ball fall?",
        at.situation,
        at.about,
        "t_f",
        "s",
        value,
        (
            Wrong("forgot the root", value**2, "2 h/g" if formula else None),
            Wrong("factor 2 under the root", value / sqrt(2), "sqrt(h/g)" if formula else None),
            Wrong("forgot g", sqrt(2 * at.height)),
            Wrong("factor 2", value / 2),
        ),
        "sqrt(2 h/g)" if formula else None,
    )


def level_range(rng: np.random.Generator) -> Exercise:
    text, start = pick(rng, RANGES.level)
    at = flight(rng, (f"v_x = {text}",))
    value = start * sqrt(2 * at.height / at.g)
    return ask(
        "How far to the right does the ball that is thrown level reach the floor?",
        at.situation,
        at.about,
        "x_f",
        "m",
        value,
        (
            Wrong("factor 2 under the root", value / sqrt(2)),
            Wrong("forgot g", start * sqrt(2 * at.height)),
            Wrong("factor 2", 2 * value),
            Wrong("wrong sign", -value),
        ),
    )


def landing_speed_of_throw(rng: np.random.Generator) -> Exercise:
    text, start = pick(rng, RANGES.level)
    at = flight(rng, (f"v_x = {text}",))
    value = sqrt(start**2 + 2 * at.g * at.height)
    return ask(
        "How fast is the ball that is thrown level when it reaches the floor?",
        at.situation,
        at.about,
        "v_f",
        "m/s",
        value,
        (
            Wrong("forgot the start velocity", sqrt(2 * at.g * at.height)),
            Wrong("forgot the root", value**2),
            Wrong("factor 2", 2 * value),
            Wrong("turned upside down", 1 / value),
        ),
    )


def velocity_after(rng: np.random.Generator) -> Exercise:
    text, start = pick(rng, RANGES.up)
    after, time = pick(rng, ("0.2", "0.25", "0.5", "0.55"))
    at = flight(rng, (f"v_y = {text}",), (remark(f"t = {after}"),))
    value = start - at.g * time
    return ask(
        "What is the upward velocity of the ball after the time t?",
        at.situation,
        at.about,
        "v_yt",
        "m/s",
        value,
        (
            Wrong("wrong sign", -value),
            Wrong("gravity upwards", start + at.g * time),
            Wrong("forgot the start velocity", -at.g * time),
            Wrong("forgot g", start - time),
        ),
    )


def greatest_height(rng: np.random.Generator) -> Exercise:
    text, start = pick(rng, RANGES.up)
    at = flight(rng, (f"v_y = {text}",))
    value = start**2 / (2 * at.g)
    return ask(
        "How high above its start does the ball rise?",
        at.situation,
        at.about,
        "h_max",
        "m",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("forgot g", start**2 / 2),
            Wrong("wrong sign", -value),
            Wrong("unit not converted", 100 * value),
        ),
    )


@dataclass(frozen=True, slots=True)
class _Slanting:
    flight: Flight
    start: float
    angle: float


def _slanting(rng: np.random.Generator) -> _Slanting:
    text, start = pick(rng, RANGES.slanting)
    written, angle = RANGES.angles[rng.integers(len(RANGES.angles))]
    thrown = f"v_0 = ({text} cos(theta), {text} sin(theta))"
    return _Slanting(flight(rng, (thrown,), (remark(f"theta = {written}"),), low=True), start, angle)


def slanting_range(rng: np.random.Generator) -> Exercise:
    made = _slanting(rng)
    at, start, angle = made.flight, made.start, made.angle
    value = start**2 * sin(2 * angle) / at.g
    return ask(
        "How far does the ball that is thrown at an angle fly?",
        at.situation,
        at.about,
        "x_f",
        "m",
        value,
        (
            Wrong("factor 2", value / 2),
            Wrong("forgot g", start**2 * sin(2 * angle)),
            Wrong("wrong sign", -value),
            Wrong("unit not converted", 100 * value),
        ),
    )


def slanting_height(rng: np.random.Generator) -> Exercise:
    made = _slanting(rng)
    at, start, angle = made.flight, made.start, made.angle
    value = (start * sin(angle)) ** 2 / (2 * at.g)
    return ask(
        "How high does the ball that is thrown at an angle rise?",
        at.situation,
        at.about,
        "h_max",
        "m",
        value,
        (
            Wrong("sine for cosine", (start * cos(angle)) ** 2 / (2 * at.g)),
            Wrong("factor 2", 2 * value),
            Wrong("forgot g", (start * sin(angle)) ** 2 / 2),
            Wrong("degrees for radians", (start * sin(degrees(angle))) ** 2 / (2 * at.g)),
        ),
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "landing speed": landing_speed,
    "falling time": falling_time,
    "level range": level_range,
    "landing speed of a throw": landing_speed_of_throw,
    "velocity after a time": velocity_after,
    "greatest height": greatest_height,
    "slanting range": slanting_range,
    "slanting height": slanting_height,
}
"""What is asked -> the problem drawn anew from a random generator."""
