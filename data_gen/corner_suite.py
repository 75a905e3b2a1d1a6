"""Strokes whose corners are known: polylines, and figures of lines and arcs.

For finders of corners (`benchmarks/corners.py`). A figure is walked like a turtle walks it: straight
on, round a bend, or turning on the spot, which makes a corner; then a simulated writer draws it. The ends
of a stroke are not counted as corners. Frame: page units, y down; angles in radians.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import cos, exp, log, pi, radians, sin
from typing import assert_never

import numpy as np

from data_gen.hand.curves import ARC_STEP
from data_gen.pen import draw
from data_gen.writers import Writer, sample_writer
from sketch.geometry import diagonal
from sketch.ink import FloatArray, Stroke


@dataclass(frozen=True, slots=True)
class CornerSuiteRule:
    """What is drawn, and how large."""

    legs: tuple[int, int] = (2, 8)
    """Legs of a polyline, both included."""
    uneven: float = 2.5
    """Longest leg of a polyline over its shortest, at most."""
    turn: tuple[float, float] = (radians(40), radians(150))
    """Turn at a polyline's corner. The bluntest of any shape here, an octagon's, is 45°; more than this is a line drawn
    back over itself."""
    turn_at_arc: tuple[float, float] = (radians(45), radians(135))
    """The same where a line or an arc meets an arc: an arc that bends away hides a slighter one."""
    bend: tuple[float, float] = (0.35, 0.8)
    """Radius of an arc in a chain over the longest of its lines."""
    sweep: tuple[float, float] = (radians(60), radians(200))
    """How far an arc of a chain goes round."""
    size: tuple[float, float] = (80.0, 420.0)
    """Log-uniform range of a figure's diagonal, page units: with eight legs on 1-unit pixels the shortest
    leg still has some ten pixels."""


RULE = CornerSuiteRule()
RATES = (20.0, 250.0)
"""Log-uniform range of the rate that `sample_writer` draws, Hz."""


@dataclass(frozen=True, slots=True)
class Hand:
    """Whose strokes a suite has. rate: log-uniform range of the digitiser, Hz; hooks: whether writers have
    the habit of them; everything else is as `sample_writer` draws it."""

    rate: tuple[float, float] = (60.0, 250.0)
    hooks: bool = True


TABLET = Hand()
"""Digitisers from a mouse or touch screen on: what corner finders have been measured on."""
SLOW = Hand(rate=(20.0, 60.0))
"""A busy web page: two or three samples on a short leg, and none at the corner itself."""
UNHOOKED = Hand(hooks=False)


@dataclass(frozen=True, slots=True)
class Ahead:
    """Straight on by a length."""

    length: float


@dataclass(frozen=True, slots=True)
class Bend:
    """Round an arc; sweep: positive from +x towards +y."""

    radius: float
    sweep: float


@dataclass(frozen=True, slots=True)
class Turn:
    """On the spot: a corner."""

    angle: float


Step = Ahead | Bend | Turn


@dataclass(frozen=True, slots=True, eq=False)
class CornerStroke:
    """stroke: the ink; corners: (k, 2) page units, where it was meant to turn, in drawing order, its ends
    not among them; family: what figure it is; index: its number under the seed."""

    stroke: Stroke
    corners: FloatArray
    family: str
    index: int


def polylines(count: int, seed: int, hand: Hand = TABLET) -> list[CornerStroke]:
    """`count` polylines, each by a writer of its own."""
    return _drawn(count, seed, hand, {"polyline": _polyline})


def line_arcs(count: int, seed: int, hand: Hand = TABLET) -> list[CornerStroke]:
    """`count` figures of lines and arcs, the families in turn, each by a writer of its own."""
    return _drawn(count, seed, hand, FIGURES)


def walk(steps: Sequence[Step], heading: float = 0.0) -> tuple[FloatArray, FloatArray]:
    """The path, (n, 2), and the corners on it, (k, 2), of a walk that begins at the origin."""
    path, corners = [(0.0, 0.0)], list[tuple[float, float]]()
    for step in steps:
        x, y = path[-1]
        match step:
            case Ahead(length):
                path.append((x + length * cos(heading), y + length * sin(heading)))
            case Bend(radius, sweep):
                side = radius if sweep > 0 else -radius
                pieces = max(4, int(abs(sweep) / ARC_STEP) + 1)
                for piece in range(1, pieces + 1):
                    way = heading + sweep * piece / pieces
                    path.append((x + side * (sin(way) - sin(heading)), y - side * (cos(way) - cos(heading))))
                heading += sweep
            case Turn(angle):
                corners.append((x, y))
                heading += angle
            case _:
                assert_never(step)
    return np.array(path), np.array(corners).reshape(-1, 2)


def _drawn(
    count: int, seed: int, hand: Hand, families: dict[str, Callable[[np.random.Generator], list[Step]]]
) -> list[CornerStroke]:
    names = list(families)
    rngs = [np.random.default_rng([seed, index]) for index in range(count)]
    writers = [_with_hand(sample_writer(rng), hand) for rng in rngs]
    meant = [_placed(families[names[k % len(names)]](rng), rng) for k, rng in enumerate(rngs)]
    return [
        CornerStroke(draw([path], writer, rng)[0], corners, names[k % len(names)], k)
        for k, ((path, corners), writer, rng) in enumerate(zip(meant, writers, rngs, strict=True))
    ]


def _with_hand(writer: Writer, hand: Hand) -> Writer:
    """The writer at that device. One that wakes up late leaves corners out of the ink: nobody finds those."""
    low, high = hand.rate
    place = log(writer.rate / RATES[0]) / log(RATES[1] / RATES[0])
    rate = low * (high / low) ** place
    return replace(writer, rate=rate, late=0.0, hooks=writer.hooks if hand.hooks else 0.0)


def _placed(steps: list[Step], rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """The walk at a random angle, mirrored half of the time, at a random size."""
    path, corners = walk(steps, float(rng.uniform(0, 2 * pi)))
    low, high = RULE.size
    scale = np.full(2, exp(float(rng.uniform(log(low), log(high)))) / diagonal(path))
    scale[0] *= rng.choice([-1.0, 1.0])
    return scale * path, scale * corners


def _polyline(rng: np.random.Generator) -> list[Step]:
    legs = int(rng.integers(RULE.legs[0], RULE.legs[1] + 1))
    steps: list[Step] = [_line(rng)]
    for _ in range(legs - 1):
        steps += [_corner(rng, RULE.turn), _line(rng)]
    return steps


def _line(rng: np.random.Generator) -> Ahead:
    return Ahead(exp(-log(RULE.uneven) * float(rng.random())))


def _corner(rng: np.random.Generator, turn: tuple[float, float]) -> Turn:
    return Turn(float(rng.uniform(*turn) * rng.choice([-1.0, 1.0])))


def _arc(rng: np.random.Generator) -> Bend:
    return Bend(float(rng.uniform(*RULE.bend)), float(rng.uniform(*RULE.sweep) * rng.choice([-1.0, 1.0])))


def _chain(rng: np.random.Generator) -> list[Step]:
    """Two to four lines and arcs; two lines always meet in a corner, an arc goes on smoothly or in one."""
    steps: list[Step] = []
    for _ in range(int(rng.integers(2, 5))):
        piece = _arc(rng) if rng.random() < 0.5 else _line(rng)
        if steps:
            straight = isinstance(piece, Ahead) and isinstance(steps[-1], Ahead)
            if straight or rng.random() < 0.5:
                steps.append(_corner(rng, RULE.turn_at_arc))
        steps.append(piece)
    return steps


def _letter_d(rng: np.random.Generator) -> list[Step]:
    height = float(rng.uniform(0.7, 1.3))
    return [Ahead(height), Turn(pi / 2), Bend(height / 2, pi)]


def _arch(rng: np.random.Generator) -> list[Step]:
    return [_line(rng), Bend(float(rng.uniform(0.2, 0.5)), pi), _line(rng)]


def _gate(rng: np.random.Generator) -> list[Step]:
    leg, radius = float(rng.uniform(0.4, 1.0)), float(rng.uniform(0.25, 0.5))
    return [Ahead(leg), Bend(radius, pi), Ahead(leg), Turn(pi / 2), Ahead(2 * radius)]


def _letter_s(rng: np.random.Generator) -> list[Step]:
    sweep = float(rng.uniform(radians(140), radians(230)))
    return [Bend(0.5, sweep), Bend(float(rng.uniform(0.35, 0.65)), -sweep)]


def _letter_j(rng: np.random.Generator) -> list[Step]:
    return [Ahead(1.0), Bend(float(rng.uniform(0.2, 0.45)), float(rng.uniform(pi / 2, pi)))]


def _sector(rng: np.random.Generator) -> list[Step]:
    return [
        Ahead(1.0),
        Turn(pi / 2),
        Bend(1.0, float(rng.uniform(radians(50), radians(120)))),
        Turn(pi / 2),
        Ahead(1.0),
    ]


def _hills(rng: np.random.Generator) -> list[Step]:
    """Two or three arches side by side, as in an m."""
    sweep = float(rng.uniform(radians(120), pi))
    hill: list[Step] = [Bend(0.5, sweep)]
    steps = list(hill)
    for _ in range(int(rng.integers(1, 3))):
        steps += [Turn(-sweep), *hill]
    return steps


def _stadium(rng: np.random.Generator) -> list[Step]:
    leg, radius = float(rng.uniform(0.4, 1.0)), float(rng.uniform(0.25, 0.5))
    return [Ahead(leg), Bend(radius, pi), Ahead(leg), Bend(radius, pi)]


FIGURES: dict[str, Callable[[np.random.Generator], list[Step]]] = {
    "chain": _chain,
    "D": _letter_d,
    "arch": _arch,
    "gate": _gate,
    "S": _letter_s,
    "J": _letter_j,
    "sector": _sector,
    "hills": _hills,
    "stadium": _stadium,
}
"""Arches are U turns too: they stand at any angle."""
