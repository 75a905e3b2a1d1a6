"""Balls that meet on a smooth floor, and one that is dropped on it. With e the coefficient of restitution:
v₁' = (m₁ − e m₂) v / (m₁ + m₂), v₂' = (1 + e) m₁ v / (m₁ + m₂)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import sqrt

import numpy as np

from data_gen.diagrams.problem import Span, block, point, rectangle, xy
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, pick, remark
from data_gen.textbook.projectile import flight
from sketch.page import Component
from sketch.shapes import Circle, Point


@dataclass(frozen=True, slots=True)
class CollisionRanges:
    """Two balls of one size on a smooth floor."""

    radius: Span = (20.0, 32.0)
    gap: Span = (70.0, 130.0)
    masses: tuple[str, ...] = ("1", "2", "3", "4", "5")
    speeds: tuple[str, ...] = ("1.5", "2", "2.5", "3")
    partial: tuple[str, ...] = ("0.4", "0.5", "0.6", "0.7")
    bouncy: tuple[str, ...] = ("0.6", "0.7", "0.8")


RANGES = CollisionRanges()


@dataclass(frozen=True, slots=True)
class Meeting:
    """The first runs into the second. speed: signed, to the right."""

    situation: Situation
    first: float
    second: float
    speed: float
    e: float
    spots: tuple[Point, Point]

    def after(self, e: float) -> tuple[float, float]:
        """Both velocities after a meeting with that restitution."""
        both = self.first + self.second
        return (
            self.speed * (self.first - e * self.second) / both,
            self.speed * (1 + e) * self.first / both,
        )

    @property
    def exchanged(self) -> Meeting:
        """The same with the masses exchanged."""
        return Meeting(self.situation, self.second, self.first, self.speed, self.e, self.spots)


def meeting(rng: np.random.Generator, restitutions: tuple[str, ...]) -> Meeting:
    """Two balls of different masses."""
    side = int(rng.choice([-1, 1]))
    radius, ground = float(rng.uniform(*RANGES.radius)), float(rng.uniform(300, 380))
    first = xy(300 - side * rng.uniform(130, 180), ground - radius)
    second = first + xy(side * (2 * radius + rng.uniform(*RANGES.gap)), 0)
    one, other = (str(text) for text in rng.choice(RANGES.masses, size=2, replace=False))
    text, speed = pick(rng, RANGES.speeds)
    bounce_text, e = pick(rng, restitutions)
    spots = (point(first), point(second))
    given = (
        remark(f"m = {one}", "first", spots[0]),
        remark(f"m = {other}", "second", spots[1]),
        remark(f"v_x = {text if side > 0 else '-' + text}", "first", spots[0]),
        remark(f"e = {bounce_text}", "first", spots[0]),
        remark(f"e = {bounce_text}", "second", spots[1]),
        # Of balls that differ by a pen's width one is pressed down as they meet: it must not hop for ever.
        remark("e = 0", "floor", (300.0, ground + 15)),
    )
    parts = (
        Component(Circle(spots[0], radius), label="first"),
        Component(Circle(spots[1], radius), label="second"),
        block("floor", rectangle(xy(15, ground), xy(585, ground + 30)), fixed=True),
    )
    way = abs(second[0] - first[0]) / 100 / speed
    return Meeting(Situation(parts, given, way + 0.3), float(one), float(other), side * speed, e, spots)


def _velocity(at: Meeting, who: int, question: str) -> Exercise:
    value = at.after(at.e)[who]
    return ask(
        question,
        at.situation,
        (("first", "second")[who], at.spots[who]),
        "v_xa",
        "m/s",
        value,
        (
            Wrong("wrong sign", -value),
            Wrong("masses exchanged", at.exchanged.after(at.e)[who]),
            *([] if at.e == 1 else [Wrong("elastic for inelastic", at.after(1.0)[who])]),
            *([] if at.e == 0 else [Wrong("inelastic for elastic", at.after(0.0)[who])]),
            Wrong("factor 2", 2 * value),
        ),
    )


def elastic_first(rng: np.random.Generator) -> Exercise:
    return _velocity(
        meeting(rng, ("1",)), 0, "What is the first ball's velocity to the right after the elastic impact?"
    )


def elastic_second(rng: np.random.Generator) -> Exercise:
    return _velocity(
        meeting(rng, ("1",)), 1, "What is the second ball's velocity to the right after the elastic impact?"
    )


def inelastic(rng: np.random.Generator) -> Exercise:
    return _velocity(
        meeting(rng, ("0",)), 0, "With what velocity to the right do the balls go on that stay together?"
    )


def partial(rng: np.random.Generator) -> Exercise:
    return _velocity(
        meeting(rng, RANGES.partial),
        1,
        "What is the second ball's velocity to the right after the impact?",
    )


def heat(rng: np.random.Generator) -> Exercise:
    at = meeting(rng, RANGES.partial)
    whole = 0.5 * at.first * at.second / (at.first + at.second) * at.speed**2
    value = whole * (1 - at.e**2)
    return ask(
        "How much kinetic energy becomes heat in the impact?",
        at.situation,
        ("first", at.spots[0]),
        "Q_a",
        "J",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("inelastic for elastic", whole),
            Wrong("wrong sign", -value),
            Wrong("weight for mass", 9.81 * value),
        ),
    )


def momentum(rng: np.random.Generator) -> Exercise:
    at = meeting(rng, RANGES.partial)
    value = at.second * at.after(at.e)[1]
    return ask(
        "What is the second ball's momentum to the right after the impact?",
        at.situation,
        ("second", at.spots[1]),
        "p_xa",
        "kg m/s",
        value,
        (
            Wrong("wrong sign", -value),
            Wrong("elastic for inelastic", at.second * at.after(1.0)[1]),
            Wrong("inelastic for elastic", at.second * at.after(0.0)[1]),
            Wrong("weight for mass", 9.81 * value),
            Wrong("factor 2", 2 * value),
        ),
    )


def bounce(rng: np.random.Generator) -> Exercise:
    text, e = pick(rng, RANGES.bouncy)
    at = flight(rng, (f"e = {text}",))
    value = e * sqrt(2 * at.g * at.height)
    return ask(
        "With what velocity upwards does the dropped ball leave the floor?",
        at.situation,
        at.about,
        "v_ya",
        "m/s",
        value,
        (
            Wrong("elastic for inelastic", value / e),
            Wrong("wrong sign", -value),
            Wrong("forgot g", value / sqrt(at.g)),
            Wrong("factor 2 under the root", value / sqrt(2)),
        ),
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "elastic, first ball": elastic_first,
    "elastic, second ball": elastic_second,
    "inelastic": inelastic,
    "partly elastic": partial,
    "heat": heat,
    "momentum": momentum,
    "bounce": bounce,
}
"""What is asked -> the problem drawn anew from a random generator."""
