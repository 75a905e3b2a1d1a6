"""Bodies held at rest by wires, forces and a floor."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, degrees, pi, sin, tan

import numpy as np

from data_gen.diagrams.problem import (
    Remark,
    Span,
    block,
    ceiling,
    maybe_gravity,
    point,
    rectangle,
    xy,
)
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, number, pick, remark
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Circle, Wire


@dataclass(frozen=True, slots=True)
class HeldRanges:
    """A ball or a box under a ceiling."""

    angles: tuple[tuple[str, float], ...] = (
        ("pi/5", pi / 5),
        ("pi/6", pi / 6),
        ("0.5", 0.5),
        ("0.6", 0.6),
        ("0.7", 0.7),
    )
    """From the vertical, at the wire's top end."""
    drop: Span = (120.0, 170.0)
    radius: Span = (20.0, 32.0)
    half: Span = (40.0, 55.0)
    masses: tuple[str, ...] = ("0.5", "1.5", "2", "3", "4")
    pulls: tuple[str, ...] = ("4", "5", "6", "8")
    hanging: float = 0.5
    """s: as long as a given tension holds a ball that a pen drew a little aside."""


RANGES = HeldRanges()


def _roof(top: float = 50.0) -> Component:
    """A long fixed block that wires hang from."""
    return block("ceiling", rectangle(xy(60, top - 30), xy(540, top)), fixed=True)


def _angle(rng: np.random.Generator, other: str = "") -> tuple[str, float]:
    angles = [one for one in RANGES.angles if one[0] != other]
    return angles[rng.integers(len(angles))]


def _wire(label: str, high: FloatArray, low: FloatArray, body: str) -> Component:
    return Component(Wire(point(high), point(low)), label=label, ends=("ceiling", body))


def _steep(name: str, written: str, wire: str, high: FloatArray, low: FloatArray) -> Remark:
    """An angle from the vertical, said near the top end of a wire."""
    return remark(f"{name} = {written}", wire, point(0.85 * high + 0.15 * low))


def two_wires(rng: np.random.Generator) -> Exercise:
    """A box on two wires that lean outwards alike."""
    written, angle = _angle(rng)
    drop, half = float(rng.uniform(*RANGES.drop)), float(rng.uniform(*RANGES.half))
    left, right = xy(300 - half, 50 + drop), xy(300 + half, 50 + drop)
    high_left, high_right = left - xy(drop * tan(angle), drop), right + xy(drop * tan(angle), -drop)
    box = rectangle(left, right + xy(0, rng.uniform(55, 80)))
    text, mass = pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    near = [("left wire", high_left, left), ("right wire", high_right, right)]
    angles = Remark(
        f"theta = {written}", tuple((name, point(0.85 * high + 0.15 * low)) for name, high, low in near)
    )
    given += (angles, remark(f"m = {text}", "box", point(box.mean(axis=0))))
    parts = (_roof(), block("box", box), *(_wire(name, high, low, "box") for name, high, low in near))
    weight = mass * g
    return ask(
        "What is the tension of the left wire?",
        Situation(parts, given, 2.0),
        ("left wire", point(0.5 * (left + high_left))),
        "T_1",
        "N",
        weight / (2 * cos(angle)),
        (
            Wrong("sine for cosine", weight / (2 * sin(angle))),
            Wrong("left out the angle", weight / 2),
            Wrong("factor 2", weight / cos(angle)),
            Wrong("forgot g", mass / (2 * cos(angle))),
            Wrong("degrees for radians", weight / (2 * cos(degrees(angle)))),
        ),
    )


def unequal_wires(rng: np.random.Generator) -> Exercise:
    """A ball on two wires that lean differently: T₁ sin α = T₂ sin β, T₁ cos α + T₂ cos β = W."""
    alpha_text, alpha = _angle(rng)
    beta_text, beta = _angle(rng, alpha_text)
    drop, radius = float(rng.uniform(*RANGES.drop)), float(rng.uniform(*RANGES.radius))
    left, right = xy(-sin(alpha), -cos(alpha)), xy(sin(beta), -cos(beta))
    centre = xy(300, 50 + drop + radius)
    ends = [
        (
            name,
            centre + (centre[1] - 50) / cos(angle) * way,
            centre + radius * way,
        )
        for name, way, angle in (("left wire", left, alpha), ("right wire", right, beta))
    ]
    text, mass = pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    given += (
        _steep("alpha", alpha_text, *ends[0]),
        _steep("beta", beta_text, *ends[1]),
        remark(f"m = {text}", "ball", point(centre)),
    )
    parts = (
        _roof(),
        Component(Circle(point(centre), radius), label="ball"),
        *(_wire(name, high, low, "ball") for name, high, low in ends),
    )
    weight = mass * g
    value = weight * sin(beta) / sin(alpha + beta)
    return ask(
        "What is the tension of the left wire?",
        Situation(parts, given, 2.0),
        ("left wire", point(0.5 * (ends[0][1] + ends[0][2]))),
        "T_1",
        "N",
        value,
        (
            Wrong("sine for cosine", weight * cos(beta) / sin(alpha + beta)),
            Wrong("left out the angle", weight / sin(alpha + beta)),
            Wrong("forgot g", value / g),
            Wrong("factor 2", value / 2),
        ),
        "|W| sin(beta)/sin(alpha + beta)" if rng.random() < 0.3 else None,
    )


def one_wire(rng: np.random.Generator) -> Exercise:
    anchor, high = ceiling(rng)
    low = high + xy(0, rng.uniform(90, 150))
    radius = float(rng.uniform(*RANGES.radius))
    centre = low + xy(0, radius)
    text, mass = pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    given += (_steep("theta", "0", "wire", high, low), remark(f"m = {text}", "ball", point(centre)))
    parts = (anchor, _wire("wire", high, low, "ball"), Component(Circle(point(centre), radius), label="ball"))
    formula = rng.random() < 0.5
    return ask(
        "What is the wire's tension?",
        Situation(parts, given, RANGES.hanging),
        ("wire", point(0.5 * (high + low))),
        "T",
        "N",
        mass * g,
        (
            Wrong("forgot g", mass, "m" if formula else None),
            Wrong("weight for mass", mass * g * g),
            Wrong("factor 2", mass * g / 2, "1/2 m g" if formula else None),
            Wrong("wrong sign", -mass * g),
        ),
        "m g" if formula else None,
    )


def two_balls(rng: np.random.Generator) -> Exercise:
    """One ball hangs from the other."""
    anchor, high = ceiling(rng)
    low = high + xy(0, rng.uniform(50, 80))
    one, other = (float(rng.uniform(*RANGES.radius)) for _ in range(2))
    upper = low + xy(0, one)
    second = upper + xy(0, one)
    third = second + xy(0, rng.uniform(50, 80))
    lower = third + xy(0, other)
    (upper_text, upper_mass), (lower_text, lower_mass) = pick(rng, RANGES.masses), pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    given += (
        _steep("theta", "0", "upper wire", high, low),
        _steep("theta", "0", "lower wire", second, third),
        remark(f"m = {upper_text}", "upper ball", point(upper)),
        remark(f"m = {lower_text}", "lower ball", point(lower)),
    )
    parts = (
        anchor,
        _wire("upper wire", high, low, "upper ball"),
        Component(Circle(point(upper), one), label="upper ball"),
        Component(Wire(point(second), point(third)), label="lower wire", ends=("upper ball", "lower ball")),
        Component(Circle(point(lower), other), label="lower ball"),
    )
    both = upper_mass + lower_mass
    return ask(
        "What is the tension of the upper wire?",
        Situation(parts, given, RANGES.hanging),
        ("upper wire", point(0.5 * (high + low))),
        "T",
        "N",
        both * g,
        (
            Wrong("forgot g", both),
            Wrong("weight for mass", both * g * g),
            Wrong("factor 2", both * g / 2),
            Wrong("wrong sign", -both * g),
        ),
    )


def pulled_aside(rng: np.random.Generator) -> Exercise:
    """A level force holds a ball on a wire aside: F = W tan θ."""
    written, angle = _angle(rng)
    anchor, high = ceiling(rng)
    side = float(rng.choice([-1, 1]))
    way = xy(side * sin(angle), cos(angle))
    length, radius = float(rng.uniform(110, 170)), float(rng.uniform(*RANGES.radius))
    low, centre = high + length * way, high + (length + radius) * way
    text, mass = pick(rng, RANGES.masses)
    g, given = maybe_gravity(rng)
    sign = "" if side > 0 else "-"
    given += (
        _steep("theta", written, "wire", high, low),
        remark(f"m = {text}", "ball", point(centre)),
        remark(f"F = ({sign}|W| tan(theta), 0)", "ball", point(centre)),
    )
    parts = (anchor, _wire("wire", high, low, "ball"), Component(Circle(point(centre), radius), label="ball"))
    weight = mass * g
    formula = rng.random() < 0.5
    return ask(
        "What is the tension of the wire?",
        Situation(parts, given, 1.0),
        ("wire", point(0.5 * (high + low))),
        "T",
        "N",
        weight / cos(angle),
        (
            Wrong("sine for cosine", weight / sin(angle), "|W|/sin(theta)" if formula else None),
            Wrong("left out the angle", weight),
            Wrong("forgot g", mass / cos(angle), "m/cos(theta)" if formula else None),
            Wrong("degrees for radians", weight / cos(degrees(angle))),
        ),
        "|W|/cos(theta)" if formula else None,
    )


def lightened(rng: np.random.Generator) -> Exercise:
    """A box on a floor is pulled up, but not off."""
    ground = float(rng.uniform(320, 380))
    floor = rectangle(xy(80, ground), xy(520, ground + 30))
    half, tall = float(rng.uniform(40, 60)), float(rng.uniform(50, 80))
    box = rectangle(xy(300 - half, ground - tall), xy(300 + half, ground))
    middle = point(box.mean(axis=0))
    text, mass = pick(rng, ("1.5", "2", "3", "4"))
    pull_text, pull = pick(rng, RANGES.pulls)
    g, given = maybe_gravity(rng)
    given += (remark(f"m = {text}", "box", middle), remark(f"F_1 = (0, {pull_text})", "box", middle))
    value = mass * g - pull
    return ask(
        "With what force does the floor hold the box?",
        Situation((block("floor", floor, fixed=True), block("box", box)), given, 1.0),
        ("box", middle),
        "N",
        "N",
        value,
        (
            Wrong("wrong sign", mass * g + pull, f"|W| + {pull_text}"),
            Wrong("forgot g", mass - pull, f"m - {pull_text}"),
            Wrong("factor 2", value / 2),
            Wrong("wrong sign", -value, f"{number(-value)}"),
        ),
        f"|W| - {pull_text}" if rng.random() < 0.5 else None,
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "two wires": two_wires,
    "unequal wires": unequal_wires,
    "one wire": one_wire,
    "two balls": two_balls,
    "pulled aside": pulled_aside,
    "lightened": lightened,
}
"""What is asked -> the problem drawn anew from a random generator."""
