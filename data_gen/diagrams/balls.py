"""Two balls on a smooth floor, one sent against the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from data_gen.diagrams.problem import (
    PER_METRE,
    RESTITUTION,
    Expected,
    Problem,
    Remark,
    Span,
    block,
    point,
    rectangle,
    xy,
)
from sketch.page import Component
from sketch.shapes import Circle


@dataclass(frozen=True, slots=True)
class TwoBallsRanges:
    """Two equal balls on a smooth floor; one is given a velocity towards the other."""

    radius: Span = (20.0, 36.0)
    gap: Span = (70.0, 150.0)
    """Free way between them."""
    speeds: tuple[str, ...] = ("1", "1.5", "2", "3")
    """m/s."""
    margin: float = 30.0
    """Watched until a ball is this close to the floor's end, page units."""
    seconds: float = 2.0


def two_balls(_answer: str, rng: np.random.Generator) -> Problem:
    """Nothing is asked: both move on the floor once they have met."""
    ranges = TwoBallsRanges()
    side = int(rng.choice([-1, 1]))  # the way the first ball moves
    radius = float(rng.uniform(*ranges.radius))
    ground = rng.uniform(300, 380)
    first = np.array([300 - side * rng.uniform(130, 180), ground - radius])
    second = first + xy(side * (2 * radius + rng.uniform(*ranges.gap)), 0)
    low, high = np.array([30 + rng.uniform(0, 30), ground]), np.array([570 - rng.uniform(0, 30), ground])
    floor = rectangle(low, high + xy(0, rng.uniform(25, 45)))
    speed = str(rng.choice(ranges.speeds))
    velocity = speed if side > 0 else f"-{speed}"
    remarks = [Remark(f"v_x = {velocity}", (("first", point(first)),))]
    masses = [1.0, 1.0]
    if rng.random() < 0.5:
        # The second is never the lighter one: the first would hunt it over the edge at once.
        masses = [1.0, float(rng.integers(1, 4))]
        remarks += [
            Remark(f"m = {mass:g}", ((name, point(middle)),))
            for name, middle, mass in zip(("first", "second"), (first, second), masses, strict=True)
        ]
    ends = side * np.array([low[0], high[0]])
    way = (side * (second - first)[0] - 2 * radius) / PER_METRE
    room = (ends.max() - ranges.margin - side * second[0]) / PER_METRE
    # Along the line of centres: momentum is kept, and RESTITUTION of the closing speed.
    struck = (1 + RESTITUTION) * float(speed) * masses[0] / (masses[0] + masses[1])
    moving = frozenset({"rolls"})
    return Problem(
        (
            Component(Circle(point(first), radius), label="first"),
            Component(Circle(point(second), radius), label="second"),
            block("floor", floor, fixed=True),
        ),
        tuple(remarks),
        seconds=min(ranges.seconds, way / float(speed) + room / struck),
        expected=Expected({"first": moving, "second": moving}),
    )
