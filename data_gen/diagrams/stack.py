"""Boxes on one another on a floor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from data_gen.diagrams.problem import (
    Expected,
    Problem,
    Span,
    block,
    maybe_gravity,
    rectangle,
    xy,
)


@dataclass(frozen=True, slots=True)
class StackRanges:
    """Two to four boxes on one another on a fixed floor."""

    boxes: tuple[int, int] = (2, 4)
    width: Span = (110.0, 170.0)
    height: Span = (45.0, 80.0)
    narrower: Span = (0.7, 0.95)
    """Each box's width as a share of that of the one below."""
    shift: float = 0.08
    """Largest offset of a box's middle from the middle of the one below, as a share of its own
    width: four such boxes keep every common centre of mass well inside what carries it."""
    seconds: float = 2.0


def stack_of_boxes(_answer: str, rng: np.random.Generator) -> Problem:
    """Nothing is asked: it stands."""
    ranges = StackRanges()
    middle = np.array([rng.uniform(260, 340), rng.uniform(350, 400)])
    reach = rng.uniform(170, 240)
    floor = rectangle(middle - xy(reach, 0), middle + xy(reach, rng.uniform(25, 45)))
    parts = [block("floor", floor, fixed=True)]
    width = rng.uniform(*ranges.width)
    count = int(rng.integers(ranges.boxes[0], ranges.boxes[1] + 1))
    for index in range(count):
        height = rng.uniform(*ranges.height)
        parts.append(
            block(f"box {index}", rectangle(middle - xy(width / 2, height), middle + xy(width / 2, 0)))
        )
        width *= rng.uniform(*ranges.narrower)
        middle = middle + xy(rng.uniform(-ranges.shift, ranges.shift) * width, -height)
    stays = {part.label: frozenset({"stays"}) for part in parts[1:]}
    return Problem(tuple(parts), maybe_gravity(rng)[1], ranges.seconds, Expected(stays))
