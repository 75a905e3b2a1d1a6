"""Two loads on a wire over a pulley: both hanging, or one on a table.

The pulley is a fixed circle; the wire is drawn as two, which touch the circle on either side.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from data_gen.diagrams.problem import Span, block, maybe_gravity, point, rectangle, xy
from data_gen.textbook.exercise import Exercise, Situation, Wrong, ask, pick, remark
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Circle, Point, Wire


@dataclass(frozen=True, slots=True)
class PulleyRanges:
    """A wheel and two loads."""

    wheel: Span = (38.0, 55.0)
    half: Span = (20.0, 30.0)
    clear: float = 14.0
    """Page units: a load is narrower than the wheel by so much on either side, or two would seem to touch."""
    drop: Span = (110.0, 150.0)
    masses: tuple[str, ...] = ("1", "1.5", "2", "3", "4", "5")
    rough: tuple[str, ...] = ("0.1", "0.15", "0.2")
    times: tuple[str, ...] = ("0.2", "0.25", "0.3")
    """s: before a load comes to the wheel."""


RANGES = PulleyRanges()


@dataclass(frozen=True, slots=True)
class Machine:
    """first: of the left load, or of the one on the table; second: of the right, hanging one; kg."""

    situation: Situation
    first: float
    second: float
    mu: float
    g: float
    body: tuple[str, Point]
    wire: tuple[str, Point]


def _load(name: str, low: FloatArray, half: float) -> tuple[Component, Point]:
    """A box that hangs from the middle of its top side."""
    box = rectangle(low - xy(half, 0), low + xy(half, 2 * half))
    return block(name, box), point(box.mean(axis=0))


def hanging(rng: np.random.Generator) -> Machine:
    """Atwood's machine."""
    wheel = float(rng.uniform(*RANGES.wheel))
    middle = xy(300 + rng.uniform(-50, 50), rng.uniform(80, 110))
    sides = (middle - xy(wheel, 0), middle + xy(wheel, 0))
    lows = [side + xy(0, rng.uniform(*RANGES.drop)) for side in sides]
    names = ("left load", "right load")
    halves = [min(float(rng.uniform(*RANGES.half)), wheel - RANGES.clear) for _ in names]
    loads = [_load(name, low, half) for name, low, half in zip(names, lows, halves, strict=True)]
    texts = [str(text) for text in rng.choice(RANGES.masses, size=2, replace=False)]
    g, given = maybe_gravity(rng)
    given += tuple(
        remark(f"m = {text}", name, spot) for text, name, (_, spot) in zip(texts, names, loads, strict=True)
    )
    wires = [
        Component(Wire(point(side), point(low)), label=wire, ends=("wheel", name))
        for wire, side, low, name in zip(("left wire", "right wire"), sides, lows, names, strict=True)
    ]
    parts = (
        Component(Circle(point(middle), wheel), label="wheel", fixed=True),
        *(load for load, _ in loads),
        *wires,
    )
    return Machine(
        Situation(parts, given, 0.4),
        float(texts[0]),
        float(texts[1]),
        0.0,
        g,
        ("left load", loads[0][1]),
        ("left wire", point(0.5 * (sides[0] + lows[0]))),
    )


def on_a_table(rng: np.random.Generator, rough: tuple[str, ...] = ()) -> Machine:
    """A box on a table is pulled by a load that hangs over the edge."""
    wheel, half = float(rng.uniform(*RANGES.wheel)), float(rng.uniform(*RANGES.half))
    table = float(rng.uniform(170, 200))
    right = 330 + float(rng.uniform(-15, 15))
    wire_height = table - half  # in the middle of the box's side
    middle = xy(right + wheel + 6, wire_height + wheel)
    top, side = middle - xy(0, wheel), middle + xy(wheel, 0)
    low = side + xy(0, rng.uniform(105, 125))
    near = xy(right - rng.uniform(150, 180), wire_height)
    box = rectangle(near - xy(2.4 * half, half), near + xy(0, half))
    load, spot = _load("load", low, min(half, wheel - RANGES.clear))
    texts = [str(text) for text in rng.choice(RANGES.masses, size=2, replace=False)]
    g, given = maybe_gravity(rng)
    body = point(box.mean(axis=0))
    given += (remark(f"m = {texts[0]}", "box", body), remark(f"m = {texts[1]}", "load", spot))
    mu = 0.0
    if rough:
        rough_text, mu = pick(rng, rough)
        given += (remark(f"mu = {rough_text}", "box", body),)
    parts = (
        block("table", rectangle(xy(40, table), xy(right, table + 40)), fixed=True),
        Component(Circle(point(middle), wheel), label="wheel", fixed=True),
        block("box", box),
        load,
        Component(Wire(point(near), point(top)), label="level wire", ends=("box", "wheel")),
        Component(Wire(point(side), point(low)), label="upright wire", ends=("wheel", "load")),
    )
    return Machine(
        Situation(parts, given, 0.4),
        float(texts[0]),
        float(texts[1]),
        mu,
        g,
        ("box", body),
        ("upright wire", point(0.5 * (side + low))),
    )


def _timed(rng: np.random.Generator, at: Machine) -> tuple[Machine, float]:
    text, time = pick(rng, RANGES.times)
    old = at.situation
    return replace(at, situation=replace(old, given=(*old.given, remark(f"t = {text}")))), time


def acceleration(rng: np.random.Generator) -> Exercise:
    at = hanging(rng)
    value = at.g * (at.second - at.first) / (at.first + at.second)
    return ask(
        "With what acceleration does the left load go upwards?",
        at.situation,
        at.body,
        "a_y",
        "m/s²",
        value,
        (
            Wrong("wrong sign", -value),
            Wrong("forgot g", value / at.g),
            Wrong("factor 2", 2 * value),
        ),
    )


def tension(rng: np.random.Generator) -> Exercise:
    at = hanging(rng)
    value = 2 * at.first * at.second * at.g / (at.first + at.second)
    return ask(
        "What is the tension of the wire?",
        at.situation,
        at.wire,
        "T",
        "N",
        value,
        (
            Wrong("factor 2", value / 2),
            Wrong("forgot g", value / at.g),
            Wrong("wrong sign", -value),
            Wrong("weight for mass", value * at.g),
        ),
    )


def velocity(rng: np.random.Generator) -> Exercise:
    at, time = _timed(rng, hanging(rng))
    value = at.g * (at.second - at.first) / (at.first + at.second) * time
    return ask(
        "What is the left load's velocity upwards after the time t?",
        at.situation,
        at.body,
        "v_yt",
        "m/s",
        value,
        (
            Wrong("wrong sign", -value),
            Wrong("forgot g", value / at.g),
            Wrong("factor 2", value / 2),
        ),
    )


def table_acceleration(rng: np.random.Generator) -> Exercise:
    at = on_a_table(rng)
    value = at.g * at.second / (at.first + at.second)
    return ask(
        "With what acceleration is the box pulled along the smooth table?",
        at.situation,
        at.body,
        "a",
        "m/s²",
        value,
        (
            Wrong("forgot g", value / at.g),
            Wrong("masses exchanged", at.g * at.first / (at.first + at.second)),
            Wrong("factor 2", value / 2),
            Wrong("wrong sign", -value),
        ),
    )


def rough_table(rng: np.random.Generator) -> Exercise:
    at = on_a_table(rng, RANGES.rough)
    value = at.g * (at.second - at.mu * at.first) / (at.first + at.second)
    smooth = at.g * at.second / (at.first + at.second)
    return ask(
        "With what acceleration is the box pulled along the rough table?",
        at.situation,
        at.body,
        "a",
        "m/s²",
        value,
        (
            Wrong("forgot friction", smooth),
            Wrong("forgot g", value / at.g),
            Wrong("masses exchanged", at.g * (at.first - at.mu * at.second) / (at.first + at.second)),
            Wrong("factor 2", value / 2),
        ),
    )


def table_tension(rng: np.random.Generator) -> Exercise:
    at = on_a_table(rng)
    value = at.g * at.first * at.second / (at.first + at.second)
    return ask(
        "What is the tension of the wire between the box on the table and the load?",
        at.situation,
        at.wire,
        "T",
        "N",
        value,
        (
            Wrong("factor 2", 2 * value),
            Wrong("forgot g", value / at.g),
            Wrong("weight for mass", value * at.g),
            Wrong("wrong sign", -value),
        ),
    )


PROBLEMS: Mapping[str, Callable[[np.random.Generator], Exercise]] = {
    "acceleration": acceleration,
    "tension": tension,
    "velocity": velocity,
    "table": table_acceleration,
    "rough table": rough_table,
    "tension at a table": table_tension,
}
"""What is asked -> the problem drawn anew from a random generator."""
