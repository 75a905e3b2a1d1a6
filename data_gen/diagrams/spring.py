"""A mass on a spring: hanging from a block, or beside a wall on a smooth floor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from data_gen.diagrams.problem import (
    Expected,
    Problem,
    Remark,
    Span,
    block,
    ceiling,
    maybe_gravity,
    point,
    rectangle,
    xy,
)
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Circle, Spring


@dataclass(frozen=True, slots=True)
class SpringRanges:
    """A mass hanging on a spring, or beside a wall on a smooth floor with a push."""

    length: Span = (85.0, 150.0)
    width: Span = (18.0, 34.0)
    coils: tuple[int, int] = (4, 9)
    side: Span = (50.0, 85.0)
    radius: Span = (22.0, 40.0)
    stiffness: tuple[int, ...] = (20, 30, 40, 50)
    """N/m: with 1 kg, weight stretches such springs by 0.2 to 0.5 m, which is to be seen."""
    push: tuple[str, ...] = ("1", "-1", "1.5", "0.5")
    """m/s."""
    seconds: float = 2.0


def mass_on_spring(_answer: str, rng: np.random.Generator) -> Problem:
    """Three of five masses hang and are let go; the others stand beside a wall and are pushed."""
    return (_hanging_mass if rng.random() < 0.6 else _mass_beside_wall)(rng)


def _hanging_mass(rng: np.random.Generator) -> Problem:
    ranges = SpringRanges()
    anchor, high = ceiling(rng)
    low = high + xy(0, rng.uniform(*ranges.length))
    if rng.random() < 0.5:
        half, height = rng.uniform(*ranges.side) / 2, rng.uniform(*ranges.side)
        mass = block("mass", rectangle(low - xy(half, 0), low + xy(half, height)))
        middle = low + xy(0, height / 2)
    else:
        radius = float(rng.uniform(*ranges.radius))
        middle = low + xy(0, radius)
        mass = Component(Circle(point(middle), radius), label="mass")
    spring = _spring(rng, high, low, ("ceiling", "mass"))
    gravity = maybe_gravity(rng)[1]
    remarks = gravity + _spring_remarks(rng, 0.5 * (high + low), middle)
    return Problem((anchor, spring, mass), remarks, ranges.seconds, Expected({"mass": frozenset({"swings"})}))


def _mass_beside_wall(rng: np.random.Generator) -> Problem:
    ranges = SpringRanges()
    side = float(rng.choice([-1, 1]))  # which way the spring points, seen from the wall
    ground = rng.uniform(330, 390)
    wall = np.array([300 - side * rng.uniform(150, 200), ground])
    thickness, tall = rng.uniform(30, 55), rng.uniform(110, 170)
    width, height = rng.uniform(*ranges.side, size=2)
    near = wall + xy(0, -height / 2)
    far = near + xy(side * rng.uniform(*ranges.length), 0)
    box = rectangle(far - xy(0, height / 2), far + xy(side * width, height / 2))
    near_end, far_end = wall - xy(side * thickness, 0), xy(300 + side * rng.uniform(230, 280), ground)
    floor = rectangle(near_end, far_end + xy(0, rng.uniform(25, 45)))
    parts = (
        block("wall", rectangle(wall - xy(side * thickness, tall), wall), fixed=True),
        block("floor", floor, fixed=True),
        block("mass", box),
        _spring(rng, near, far, ("wall", "mass")),
    )
    middle = box.mean(axis=0)
    push = Remark(f"v_x = {rng.choice(ranges.push)}", (("mass", point(middle)),))
    remarks = (push, *_spring_remarks(rng, 0.5 * (near + far), middle))
    return Problem(parts, remarks, ranges.seconds, Expected({"mass": frozenset({"swings", "rolls"})}))


def _spring(rng: np.random.Generator, start: FloatArray, end: FloatArray, ends: tuple[str, str]) -> Component:
    ranges = SpringRanges()
    coils = float(rng.integers(ranges.coils[0], ranges.coils[1] + 1))
    shape = Spring(point(start), point(end), coils, float(rng.uniform(*ranges.width)))
    return Component(shape, label="spring", ends=ends)


def _spring_remarks(rng: np.random.Generator, spring: FloatArray, mass: FloatArray) -> tuple[Remark, ...]:
    ranges = SpringRanges()
    remarks: tuple[Remark, ...] = ()
    if rng.random() < 0.7:
        remarks += (Remark(f"k = {rng.choice(ranges.stiffness)}", (("spring", point(spring)),)),)
    if rng.random() < 0.5:
        remarks += (Remark("m = 1", (("mass", point(mass)),)),)
    return remarks
