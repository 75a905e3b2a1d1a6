"""Bodies on an incline: a ball on a smooth one, a box on a rough one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, degrees, sin, sqrt, tan

import numpy as np

from data_gen.diagrams.incline import TriangleRanges, triangle
from data_gen.diagrams.problem import PER_METRE, Span, block, maybe_gravity, point
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, number, pick, remark
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Circle, Point

TRIANGLE = TriangleRanges(base=(290.0, 390.0), ground=(340.0, 400.0), aside=50.0)


@dataclass(frozen=True, slots=True)
class SlopeRanges:
    """A right-angled triangle, fixed, with a body on its long side."""

    triangle: TriangleRanges = TRIANGLE
    radius: Span = (18.0, 32.0)
    box: tuple[Span, Span] = ((50.0, 75.0), (28.0, 40.0))
    """Width and height: too flat to tip."""
    along: float = 0.84
    """Where the body starts, from the foot (0) to the top (1)."""
    room: float = 0.6
    """Share of the long side that it may cover."""
    masses: tuple[str, ...] = ("0.5", "1.5", "2", "3", "4")
    rough: tuple[str, ...] = ("0.1", "0.15", "0.2", "0.25")
    sticking: tuple[str, ...] = ("0.8", "0.9", "1.1")


RANGES = SlopeRanges()


@dataclass(frozen=True, slots=True)
class Slope:
    """A drawn incline. up: the unit vector up the long side, page frame; length: m, of what can be covered."""

    situation: Situation
    angle: float
    written: str
    side: float
    length: float
    mass: float
    mu: float
    g: float
    spot: Point

    @property
    def about(self) -> tuple[str, Point]:
        """The body on it."""
        return ("body", self.spot)

    @property
    def down(self) -> float:
        """The acceleration down the incline of what slides, m/s²."""
        return self.g * (sin(self.angle) - self.mu * cos(self.angle))

    def timed(self, rng: np.random.Generator) -> tuple[Slope, float]:
        """With a time on the page by which the body has covered some of the way."""
        most = sqrt(2 * self.length / self.down)
        time = float(f"{rng.uniform(0.5, 0.9) * most:.2f}")
        return self.given(f"t = {time:g}"), time

    def given(self, *texts: str, about: str | None = None) -> Slope:
        """With more lines on the page."""
        lines = tuple(remark(text, about, self.spot) for text in texts)
        old = self.situation
        return Slope(
            Situation(old.components, (*old.given, *lines), old.seconds),
            self.angle,
            self.written,
            self.side,
            self.length,
            self.mass,
            self.mu,
            self.g,
            self.spot,
        )


def slope(rng: np.random.Generator, coefficients: tuple[str, ...] = (), low: float = 0.84) -> Slope:
    """An incline with a ball, or with a box where there is friction (a ball would roll). low: where the body
    stands, from the foot (0) to the top (1)."""
    drawn = triangle(rng, RANGES.triangle)
    place = drawn.foot + low * (drawn.top - drawn.foot)
    body, middle = _box(rng, place, drawn.up, drawn.out) if coefficients else _ball(rng, place, drawn.out)
    mass_text, mass = pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    given += (
        remark(f"theta = {drawn.written}", "incline", drawn.at_foot),
        remark(f"m = {mass_text}", "body", middle),
    )
    mu = 0.0
    if coefficients:
        mu_text, mu = pick(rng, coefficients)
        given += (remark(f"mu = {mu_text}", "body", middle),)
    length = RANGES.room * float(np.linalg.norm(drawn.top - drawn.foot)) / PER_METRE
    parts = (block("incline", drawn.vertices, fixed=True), body)
    situation = Situation(parts, given, 0.8)
    return Slope(situation, drawn.angle, drawn.written, drawn.side, length, mass, mu, g, middle)


def _ball(rng: np.random.Generator, place: FloatArray, out: FloatArray) -> tuple[Component, Point]:
    radius = float(rng.uniform(*RANGES.radius))
    centre = point(place + radius * out)
    return Component(Circle(centre, radius), label="body"), centre


def _box(
    rng: np.random.Generator, place: FloatArray, up: FloatArray, out: FloatArray
) -> tuple[Component, Point]:
    width, height = (rng.uniform(*span) for span in RANGES.box)
    low, high = place - width / 2 * up, place + width / 2 * up
    return block("body", np.array([low, high, high + height * out, low + height * out])), point(
        place + height / 2 * out
    )


def normal_force(rng: np.random.Generator) -> Exercise:
    at = slope(rng)
    weight = at.mass * at.g
    formula = rng.random() < 0.5
    return ask(
        "With what force does the incline hold the ball?",
        at.situation,
        at.about,
        "N",
        "N",
        weight * cos(at.angle),
        (
            Wrong("sine for cosine", weight * sin(at.angle), "|W| sin(theta)" if formula else None),
            Wrong("forgot g", at.mass * cos(at.angle), "m cos(theta)" if formula else None),
            Wrong("degrees for radians", weight * cos(degrees(at.angle))),
            Wrong("left out the angle", weight),
            Wrong("wrong sign", -weight * cos(at.angle)),
        ),
        "|W| cos(theta)" if formula else None,
    )


def acceleration(rng: np.random.Generator) -> Exercise:
    at = slope(rng)
    formula = rng.random() < 0.5
    return ask(
        "With what acceleration does the ball go down the smooth incline?",
        at.situation,
        at.about,
        "a",
        "m/s²",
        at.g * sin(at.angle),
        (
            Wrong("sine for cosine", at.g * cos(at.angle), "g cos(theta)" if formula else None),
            Wrong("forgot g", sin(at.angle), "sin(theta)" if formula else None),
            Wrong("degrees for radians", at.g * sin(degrees(at.angle))),
            Wrong("left out the angle", at.g),
        ),
        "g sin(theta)" if formula else None,
    )


def speed(rng: np.random.Generator) -> Exercise:
    at, time = slope(rng).timed(rng)
    value = at.g * sin(at.angle) * time
    formula = rng.random() < 0.3
    return ask(
        "How fast is the ball after the time t?",
        at.situation,
        at.about,
        "v_t",
        "m/s",
        value,
        (
            Wrong("sine for cosine", at.g * cos(at.angle) * time),
            Wrong("forgot g", sin(at.angle) * time, "sin(theta) t" if formula else None),
            Wrong("factor 2", value / 2, "1/2 g sin(theta) t" if formula else None),
            Wrong("degrees for radians", at.g * sin(degrees(at.angle)) * time),
        ),
        "g sin(theta) t" if formula else None,
    )


def kinetic_energy(rng: np.random.Generator) -> Exercise:
    at, time = slope(rng).timed(rng)
    gained = at.g * sin(at.angle) * time
    value = 0.5 * at.mass * gained**2
    return ask(
        "What kinetic energy has the ball after the time t?",
        at.situation,
        at.about,
        "E_kt",
        "J",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("sine for cosine", 0.5 * at.mass * (at.g * cos(at.angle) * time) ** 2),
            Wrong("forgot g", value / at.g**2),
            Wrong("weight for mass", value * at.g),
        ),
    )


def momentum(rng: np.random.Generator) -> Exercise:
    at, time = slope(rng).timed(rng)
    value = at.mass * at.g * sin(at.angle) * time
    return ask(
        "What momentum has the ball after the time t?",
        at.situation,
        at.about,
        "p_t",
        "kg m/s",
        value,
        (
            Wrong("sine for cosine", at.mass * at.g * cos(at.angle) * time),
            Wrong("weight for mass", value * at.g),
            Wrong("forgot g", value / at.g),
            Wrong("factor 2", value / 2),
        ),
    )


def rough_acceleration(rng: np.random.Generator) -> Exercise:
    at = slope(rng, RANGES.rough)
    s, c = sin(at.angle), cos(at.angle)
    formula = rng.random() < 0.5
    return ask(
        "With what acceleration does the box slide down the rough incline?",
        at.situation,
        at.about,
        "a",
        "m/s²",
        at.down,
        (
            Wrong("forgot friction", at.g * s),
            Wrong("wrong sign", at.g * (s + at.mu * c), "g (sin(theta) + mu cos(theta))"),
            Wrong(
                "sine for cosine",
                at.g * (c - at.mu * s),
                "g (cos(theta) - mu sin(theta))" if formula else None,
            ),
            Wrong("forgot g", s - at.mu * c, "sin(theta) - mu cos(theta)" if formula else None),
        ),
        "g (sin(theta) - mu cos(theta))" if formula else None,
    )


def sliding_friction(rng: np.random.Generator) -> Exercise:
    at = slope(rng, RANGES.rough)
    value = at.mu * at.mass * at.g * cos(at.angle)
    formula = rng.random() < 0.5
    return ask(
        "What force of friction acts on the sliding box?",
        at.situation,
        at.about,
        "f_k",
        "N",
        value,
        (
            Wrong("sine for cosine", value * tan(at.angle), "mu |W| sin(theta)" if formula else None),
            Wrong("left out the angle", at.mu * at.mass * at.g),
            Wrong("forgot g", value / at.g, "mu m cos(theta)" if formula else None),
            Wrong("degrees for radians", at.mu * at.mass * at.g * cos(degrees(at.angle))),
        ),
        "mu |W| cos(theta)" if formula else None,
    )


def static_friction(rng: np.random.Generator) -> Exercise:
    at = slope(rng, RANGES.sticking)
    weight = at.mass * at.g
    return ask(
        "What force of friction holds the box at rest?",
        at.situation,
        at.about,
        "f_s",
        "N",
        weight * sin(at.angle),
        (
            Wrong("sine for cosine", weight * cos(at.angle)),
            Wrong("forgot g", at.mass * sin(at.angle)),
            Wrong("degrees for radians", weight * sin(degrees(at.angle))),
            Wrong("wrong sign", -weight * sin(at.angle)),
        ),
    )


def way_up(rng: np.random.Generator) -> Exercise:
    at = slope(rng, RANGES.rough, low=0.2)
    s, c = sin(at.angle), cos(at.angle)
    braking = at.g * (s + at.mu * c)
    most = sqrt(2 * braking * 0.55 * at.length / RANGES.room)
    start = float(f"{rng.uniform(0.6, 0.95) * most:.1f}")
    sign = "" if at.side > 0 else "-"
    at = at.given(f"v_0 = ({sign}{start:g} cos(theta), {start:g} sin(theta))", about="body")
    return ask(
        "After what time does the box that is pushed up the rough incline stop?",
        at.situation,
        at.about,
        "t_s",
        "s",
        start / braking,
        (
            Wrong("forgot friction", start / (at.g * s)),
            Wrong("wrong sign", start / at.down, f"{number(start)}/(g (sin(theta) - mu cos(theta)))"),
            Wrong("forgot g", start / (s + at.mu * c)),
            Wrong("factor 2", 0.5 * start / braking),
        ),
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "normal force": normal_force,
    "acceleration": acceleration,
    "speed": speed,
    "kinetic energy": kinetic_energy,
    "momentum": momentum,
    "rough acceleration": rough_acceleration,
    "sliding friction": sliding_friction,
    "static friction": static_friction,
    "way up": way_up,
}
"""What is asked -> the problem drawn anew from a random generator."""
