"""How a sign comes out of a hand: the authored knots of its strokes bent, stretched and moved before they are curves.

Frame: that of the glyphs, y down. Lengths are relative to the sign's box; a writer's freedom scales them all.
Nobody writes the copybook's 3: what makes a net know everybody's is that it never sees the same one twice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from data_gen.glyphs.alphabet import Knots, curve
from sketch.geometry import bounding_box
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class FormRule:
    """How far signs depart from how they were authored: standard deviations at freedom 1, and shares."""

    uneven: float = 0.17
    """Of the logarithm of the power that carries [0, 1] to [0, 1]: where the bar of a t and the waist of an 8 are."""
    swell: float = 0.16
    """Growth of the width from top to bottom, and of the height from left to right."""
    bow: float = 0.045
    """How far the middle of a side stands out, of the other side."""
    knot: float = 0.03
    """Of each knot, of the box's sides."""
    end: float = 0.03
    """Of the first and last knots beyond it: strokes begin early and end late."""
    slim: float = 0.35
    """A box counts as at least this wide for its height, and as high for its width, where knots are moved."""
    now: float = 0.45
    """Share of a writer's freedom in which two of his own signs differ."""
    rounded: float = 0.12
    """Share of signs whose corners are curves."""
    angular: float = 0.05
    """Share of signs whose curves are straight between their knots."""
    hooked: float = 0.07
    """Share of strokes with a tick where the pen comes down."""
    hook: float = 0.09
    """Its length, of the sign's size."""
    opened: float = 0.1
    """Where on a loop it is begun: standard deviation, of its length."""
    loop: float = 0.15
    """A stroke whose ends are nearer than this, of the sign's size, is a loop."""


RULE = FormRule()


def bent(
    way: Sequence[Knots], freedom: float, rng: np.random.Generator, rule: FormRule = RULE
) -> tuple[Knots, ...]:
    """The strokes of a sign with their knots moved, in the frame in which they came."""
    low, high = bounding_box(np.concatenate([points for points, _ in way]))
    size = high - low
    if not size.max() > 0:
        return tuple(way)
    box = np.where(size > 1e-9, size, 1.0)
    unit = np.maximum(size, rule.slim * size.max())
    power = np.exp(freedom * rule.uneven * rng.standard_normal(2))
    swell, bow = freedom * rule.swell * rng.standard_normal(2), freedom * rule.bow * rng.standard_normal(2)
    found: list[Knots] = []
    for points, corners in way:
        at = np.clip((points - low) / box, 0.0, 1.0) ** power
        other = at[:, ::-1]
        centred = (at - 0.5) * (1 + swell * (other - 0.5))
        moved = freedom * rule.knot * rng.standard_normal(points.shape)
        moved[[0, -1]] += freedom * rule.end * rng.standard_normal((2, 2))
        if len(points) > 2:  # what is straight stays so
            moved += bow * 4 * other * (1 - other)
        found.append((low + (centred + 0.5) * np.where(size > 1e-9, size, 0.0) + moved * unit, corners))
    return tuple(found)


def curves(way: Sequence[Knots], rng: np.random.Generator, rule: FormRule = RULE) -> list[FloatArray]:
    """The strokes through their knots, (n, 2) each: round or angular, some begun with a tick, loops anywhere."""
    low, high = bounding_box(np.concatenate([points for points, _ in way]))
    size = float((high - low).max())
    chance = rng.random()
    found: list[FloatArray] = []
    for points, corners in way:
        if chance < rule.angular:
            corners = tuple(range(1, len(points) - 1))
        elif chance > 1 - rule.rounded:
            corners = ()
        path = np.asarray(curve(points, corners))
        if is_loop(points, size, rule):
            path = np.roll(path, round(rule.opened * rng.standard_normal() * len(path)), axis=0)
        if len(points) > 2 and rng.random() < rule.hooked:
            turn = rng.uniform(0, 2 * np.pi)
            tick = path[0] + rule.hook * size * rng.random() * np.array([np.cos(turn), np.sin(turn)])
            path = np.concatenate([np.linspace(tick, path[0], 4)[:-1], path])
        found.append(path)
    return found


def is_loop(points: FloatArray, size: float, rule: FormRule = RULE) -> bool:
    """Whether a stroke ends where it began."""
    return len(points) > 4 and float(np.hypot(*(points[-1] - points[0]))) < rule.loop * size
