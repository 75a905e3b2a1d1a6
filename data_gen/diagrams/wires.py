"""A box on two wires at 45°, its tensions given by a student (worked example 2 of the sketch-based
physics tutor of Cheema and LaViola).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from data_gen.diagrams.problem import (
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
from sketch.shapes import Point, Wire


@dataclass(frozen=True, slots=True)
class HangingBoxRanges:
    """A box of 1 kg on two wires at 45° to two blocks; only 5√2 N on each keeps it where it is."""

    width: Span = (80.0, 130.0)
    height: Span = (60.0, 110.0)
    reach: Span = (75.0, 115.0)
    """Each wire's horizontal (and vertical) extent; the two need not be equal."""
    block_width: Span = (50.0, 95.0)
    block_height: Span = (30.0, 60.0)
    seconds: float = 2.0


TENSIONS: dict[str, tuple[str, str]] = {
    "right": ("5 sqrt(2)", "5 sqrt(2)"),
    "low": ("6", "6"),
    "high": ("8", "8"),
    "low-left": ("6", "5 sqrt(2)"),
    "high-right": ("5 sqrt(2)", "8"),
}


def box_on_two_wires(answer: str, rng: np.random.Generator) -> Problem:
    """The answers are the tensions of `TENSIONS`, left and right."""
    ranges = HangingBoxRanges()
    half = rng.uniform(*ranges.width) / 2
    height = rng.uniform(*ranges.height)
    top = np.array([300 + rng.uniform(-20, 20), rng.uniform(225, 265)])  # middle of the box's top side
    parts = [block("box", rectangle(top - xy(half, 0), top + xy(half, height)))]
    remarks = [Remark("g = 10"), Remark("m = 1", (("box", point(top + xy(0, height / 2))),))]
    about: list[tuple[str, Point]] = []
    for name, side, tension in zip(("left", "right"), (-1.0, 1.0), TENSIONS[answer], strict=True):
        reach = rng.uniform(*ranges.reach)
        low = top + xy(side * half, 0)
        high = low + xy(side * reach, -reach)
        size = np.array([rng.uniform(*ranges.block_width), rng.uniform(*ranges.block_height)])
        if rng.random() < 0.7:  # ends under the block
            inner = high - xy(side * rng.uniform(0.25, 0.75) * size[0], size[1])
        else:  # ends on the side that faces the box
            inner = high - xy(0, rng.uniform(0.3, 0.7) * size[1])
        parts.append(
            block(f"{name} block", rectangle(inner, inner + xy(side * size[0], size[1])), fixed=True)
        )
        wire = f"{name} wire"
        parts.append(Component(Wire(point(high), point(low)), label=wire, ends=(f"{name} block", "box")))
        index = 1 if name == "left" else 2
        remarks.append(Remark(f"T_{index} = {tension}", ((wire, point(0.5 * (low + high))),)))
        about.append((wire, point(0.8 * high + 0.2 * low)))
    remarks.append(Remark("theta = pi/4", tuple(about)))
    right = answer == "right"
    return Problem(
        tuple(parts),
        tuple(remarks),
        ranges.seconds,
        Expected(
            {"box": frozenset({"stays"} if right else {"falls", "swings", "drifts", "flies off"})},
            frozenset() if right else frozenset({"left wire", "right wire"}),
        ),
    )
