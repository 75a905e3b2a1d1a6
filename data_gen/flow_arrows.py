"""Arrows as they are drawn between the boxes of charts: shafts with elbows, in pieces, small or wide heads, put on in
any way.

`hand.lines.arrow` draws arrows as gestures are; these are for a net to learn from beside them. What is drawn: strokes that are
meant, (n, 2), about one unit large, y down.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class FlowRule:
    """How such arrows vary."""

    elbows: tuple[float, ...] = (0.45, 0.27, 0.21, 0.07)
    """Shares of shafts with no elbow, one, two and three."""
    leg: tuple[float, float] = (0.15, 1.0)
    """Log-uniform range of a leg's length."""
    askew: float = 0.04
    """Standard deviation of a leg's heading from a right angle to the last, radians."""
    lifted: float = 0.25
    """Share of elbows at which the pen is lifted; half of them are gone over from the other end."""
    head: tuple[float, float] = (0.07, 0.5)
    """Log-uniform range of a barb's length over the whole arrow's size."""
    opening: tuple[float, float] = (0.35, 1.0)
    """Half the angle of the head, radians."""
    uneven: float = 0.2
    """Standard deviation of the logarithm of a barb's length, and of its angle in radians."""
    off: float = 0.12
    """Standard deviation of how far a head is from the tip, fraction of a barb."""
    short: float = 0.35
    """Share of shafts that stop short of a head put round them, by up to 0.7 of a barb."""
    first: float = 0.12
    """Share of heads that are drawn before the shaft."""


RULE = FlowRule()


def flow_arrow(rng: np.random.Generator, rule: FlowRule = RULE) -> list[FloatArray]:
    """The strokes of one such arrow in drawing order."""
    shaft = _shaft(rng, rule)
    size = float(np.hypot(*np.ptp(shaft, axis=0)))
    low, high = rule.head
    barb = size * low * (high / low) ** rng.random()
    way = shaft[-1] - shaft[-2]
    heading = float(np.arctan2(way[1], way[0]))
    opening = rng.uniform(*rule.opening)
    barbs = [
        shaft[-1] - barb * np.exp(rule.uneven * rng.standard_normal()) * _along(heading + angle)
        for angle in (side * opening + rule.uneven * rng.standard_normal() for side in _sides(rng))
    ]
    tip = shaft[-1] + rule.off * barb * rng.standard_normal(2)
    pieces = _pieces(shaft, rng, rule)
    return [path / size for path in _headed(pieces, barbs, tip, barb, rng, rule)]


def _headed(
    pieces: list[FloatArray],
    barbs: list[FloatArray],
    tip: FloatArray,
    barb: float,
    rng: np.random.Generator,
    rule: FlowRule,
) -> list[FloatArray]:
    """The shaft's strokes with the head put on in one of six ways."""
    one, other = barbs
    end, how = pieces[-1][-1], rng.random()
    if how < 0.22:
        # The last of the shaft goes on to one barb; the other is put to it, from the tip or towards it.
        far = one + rule.off * barb * rng.standard_normal(2)
        second = np.stack([tip, other]) if rng.random() < 0.7 else np.stack([other, tip])
        return [*pieces[:-1], np.concatenate([pieces[-1], far[None]]), second]
    if how < 0.4:
        # In one stroke: out to one barb, back to the tip, out to the other; or straight across.
        back = [tip] if rng.random() < 0.8 else []
        return [*pieces[:-1], np.concatenate([pieces[-1], np.array([one, *back, other])])]
    if rng.random() < rule.short:
        way = end - pieces[-1][-2]
        reach = float(np.hypot(*way))
        pieces = [*pieces[:-1], pieces[-1].copy()]
        pieces[-1][-1] = end - way / max(reach, 1e-9) * min(0.7 * barb * rng.random(), 0.6 * reach)
    if how < 0.68:
        head = [np.array([one, tip, other])]
    elif how < 0.82:
        head = [_bowl(one, tip, other)]
    elif how < 0.93:
        head = [np.stack([tip, one]), np.stack([tip, other])]
        head = [path[::-1] if rng.random() < 0.3 else path for path in head]
    else:
        head = [np.array([one, tip, other, one])]
    return [*head, *pieces] if rng.random() < rule.first else [*pieces, *head]


def _bowl(one: FloatArray, tip: FloatArray, other: FloatArray) -> FloatArray:
    """A head whose tip is round: a parabola through all three."""
    t = np.linspace(-1.0, 1.0, 16)[:, None]
    return tip + 0.5 * t * (other - one) + t * t * (0.5 * (one + other) - tip)


def _shaft(rng: np.random.Generator, rule: FlowRule) -> FloatArray:
    """Corners of the shaft, its end last; legs at right angles, one without elbows is at times a little bowed."""
    elbows = int(rng.choice(len(rule.elbows), p=rule.elbows))
    low, high = rule.leg
    heading = float(rng.integers(4)) * np.pi / 2
    if elbows == 0:
        heading += float(rng.choice([0.0, 0.0, rng.uniform(-np.pi, np.pi)]))
    points = [np.zeros(2)]
    for _ in range(elbows + 1):
        points.append(
            points[-1]
            + low * (high / low) ** rng.random() * _along(heading + rule.askew * rng.standard_normal())
        )
        heading += float(rng.choice([-1.0, 1.0])) * np.pi / 2
    if elbows or rng.random() < 0.5:
        return np.array(points)
    t = np.linspace(0.0, 1.0, 9)[:, None]
    way = points[1]
    return t * way + 0.25 * rng.standard_normal() * t * (1 - t) * np.array([way[1], -way[0]])


def _pieces(shaft: FloatArray, rng: np.random.Generator, rule: FlowRule) -> list[FloatArray]:
    """The shaft in one stroke or in several; the last runs towards the tip."""
    cuts = [k for k in range(1, len(shaft) - 1) if len(shaft) < 6 and rng.random() < rule.lifted]
    pieces = [shaft[a : b + 1] for a, b in pairwise([0, *cuts, len(shaft) - 1])]
    loose = [piece + 0.01 * rng.standard_normal(piece.shape) for piece in pieces]
    return [*(piece[::-1] if rng.random() < 0.5 else piece for piece in loose[:-1]), loose[-1]]


def _along(angle: float) -> FloatArray:
    return np.array([np.cos(angle), np.sin(angle)])


def _sides(rng: np.random.Generator) -> tuple[float, float]:
    return (1.0, -1.0) if rng.random() < 0.5 else (-1.0, 1.0)
