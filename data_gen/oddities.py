"""What people draw that is nothing here, for a net to learn what it does not know: things (`objects.json`) and
families of curves without a name.

A family is a function of a generator of random numbers to the strokes that are meant, (n, 2) each, any size, y down.
Variety is the point: knots and proportions of one and the same family are drawn anew each time, so that what is common to
all families is that they are none of the kinds. Letters joined to words, waves and five-pointed stars are not here: they are
mathematics ("everything else") by the meaning of the kinds. Curves of Lissajous are left to those who measure.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np

from data_gen.glyphs import alphabet
from sketch.ink import FloatArray

Family = Callable[[np.random.Generator], list[FloatArray]]


@dataclass(frozen=True, slots=True)
class OddityRule:
    """How far one drawing of a family is from another."""

    knot: float = 0.035
    """Standard deviation of a knot of a thing, fraction of its size."""
    bulge: float = 0.06
    """Rms of a smooth distortion of the whole, fraction of its size."""
    joined: float = 0.25
    """Share of things of several strokes that are drawn without lifting the pen."""


RULE = OddityRule()


def _thing(name: str, rng: np.random.Generator) -> list[FloatArray]:
    """A thing with its knots astray, as a whole bent out of shape; at times in one stroke."""
    waves = RULE.bulge * rng.standard_normal((4, 2))
    paths: list[FloatArray] = []
    for points, corners in alphabet.knots(name):
        shape = points / 10 + RULE.knot * rng.standard_normal(points.shape)
        x, y = shape[:, :1], shape[:, 1:]
        bent = np.sin(np.pi * np.concatenate([x, y, x + y, x - y], axis=1))
        paths.append(alphabet.curve(shape + bent @ waves, corners))
    return [np.concatenate(paths)] if rng.random() < RULE.joined else paths


def _turns(rng: np.random.Generator, sweep: float = 2 * np.pi, count: int = 160) -> FloatArray:
    """Angles of a way round that begins anywhere and does not quite close, or goes on a little."""
    return np.linspace(0.0, sweep * (1 + 0.03 * rng.standard_normal()), count) + rng.uniform(0, 2 * np.pi)


def _polar(radius: FloatArray, angle: FloatArray, flat: float = 1.0) -> FloatArray:
    return np.column_stack([radius * np.cos(angle), flat * radius * np.sin(angle)])


def _blob(rng: np.random.Generator) -> list[FloatArray]:
    """A closed outline with bays: a few harmonics of the radius."""
    angle, rank = _turns(rng), np.arange(2, 7)
    bays = np.sin(angle[:, None] * rank + rng.uniform(0, 2 * np.pi, 5)) @ (rng.standard_normal(5) / rank**0.5)
    return [_polar(1.0 + rng.uniform(0.3, 0.6) * bays / np.abs(bays).max(), angle, rng.uniform(0.5, 1))]


def _puffs(rng: np.random.Generator) -> list[FloatArray]:
    """A cloud: bows of uneven width along an oval, some with a flat base."""
    count, flat = int(rng.integers(4, 12)), rng.uniform(0.4, 0.8)
    edges = np.cumsum(np.concatenate([[0.0], rng.uniform(0.5, 1.5, count)]))
    angle = edges / edges[-1] * 2 * np.pi * (1 + 0.03 * rng.standard_normal()) + rng.uniform(0, 2 * np.pi)
    spots = _polar(np.ones(count + 1), angle, flat) + 0.06 * rng.standard_normal((count + 1, 2))
    if rng.random() < 0.4:
        spots[:, 1] = np.minimum(spots[:, 1], 0.3 * flat)
    inward = -1.0 if rng.random() < 0.15 else 1.0
    bows = [
        _bow(a, b, inward * rng.uniform(0.25, 0.7))
        if a[1] < 0.29 * flat or b[1] < 0.29 * flat
        else np.stack([a, b])
        for a, b in pairwise(spots)
    ]
    return [np.concatenate(bows)]


def _bow(start: FloatArray, end: FloatArray, sagitta: float) -> FloatArray:
    """A bow from start to end, to the left of the way by so much of the chord."""
    along, chord = np.linspace(0.0, 1.0, 14)[:, None], end - start
    return start + along * chord + sagitta * np.sin(np.pi * along) * np.array([chord[1], -chord[0]])


def _ragged(rng: np.random.Generator) -> list[FloatArray]:
    """A closed outline of straight sides with corners that point inwards."""
    count = int(rng.integers(5, 12))
    angle = np.sort(rng.uniform(0, 2 * np.pi, count)) + rng.uniform(0, 2 * np.pi)
    radius = np.where(np.arange(count) % 2 == 0, rng.uniform(0.7, 1.0, count), rng.uniform(0.2, 0.55, count))
    corners = _polar(radius, angle)
    return [np.concatenate([corners, corners[:1]])]


def _crossed(rng: np.random.Generator) -> list[FloatArray]:
    """A closed line of straight legs to random places that crosses itself."""
    corners = rng.random((int(rng.integers(6, 11)), 2))
    return [np.concatenate([corners, corners[:1]])]


def _ramble(rng: np.random.Generator, sharp: float = 0.0) -> list[FloatArray]:
    """A walk whose heading wanders; sharp: share of its knots that are corners."""
    count = int(rng.integers(12, 24))
    heading = np.cumsum(rng.uniform(0.5, 1.3) * rng.standard_normal(count)) + rng.uniform(0, 2 * np.pi)
    steps = rng.uniform(0.4, 1.6, (count, 1)) * np.column_stack([np.cos(heading), np.sin(heading)])
    points = np.cumsum(steps, axis=0)
    return [alphabet.curve(points, (np.flatnonzero(rng.random(count - 2) < sharp) + 1).tolist())]


def _battlement(rng: np.random.Generator) -> list[FloatArray]:
    """Rectangular waves."""
    count = int(rng.integers(3, 8))
    wide, high = rng.uniform(0.4, 1.2, 2 * count), np.repeat(rng.uniform(0.6, 1.2, count), 2)
    x = np.repeat(np.concatenate([[0.0], np.cumsum(wide)]), 2)[1:-1]
    y = np.concatenate([np.array([0.0, h, h, 0.0]) for h in high[::2]])
    return [np.column_stack([x, y[: len(x)]])]


def _maze(rng: np.random.Generator) -> list[FloatArray]:
    """A spiral of straight legs and right angles, or of as many sides as a polygon."""
    legs, corner = int(rng.integers(7, 16)), 2 * np.pi / int(rng.choice([3, 4, 4, 5]))
    heading = corner * np.arange(legs) + rng.uniform(0, 2 * np.pi)
    reach = np.linspace(0.15, 1.0, legs) * rng.uniform(0.85, 1.15, legs)
    return [np.cumsum(reach[:, None] * np.column_stack([np.cos(heading), np.sin(heading)]), axis=0)]


def _rose(rng: np.random.Generator) -> list[FloatArray]:
    """Petals that all pass through the middle."""
    petals = int(rng.integers(3, 8))
    angle = np.linspace(0, np.pi * (2 if petals % 2 == 0 else 1), 40 * petals) + rng.uniform(0, np.pi)
    return [_polar(np.cos(petals * angle) + rng.uniform(-0.15, 0.15), angle, rng.uniform(0.7, 1))]


def _rolling(rng: np.random.Generator) -> list[FloatArray]:
    """A ring of loops, inwards or outwards."""
    loops, depth = int(rng.integers(3, 9)), rng.uniform(0.35, 0.9)
    angle, way = _turns(rng, count=40 * loops), -1.0 if rng.random() < 0.5 else 1.0
    small = _polar(np.full(len(angle), depth), way * loops * angle)
    return [_polar(np.ones(len(angle)), angle, rng.uniform(0.6, 1)) + small]


def _curls(rng: np.random.Generator) -> list[FloatArray]:
    """A line with two to four curls, far apart, on either side."""
    count = int(rng.integers(2, 5))
    parts = [np.array([[0.0, 0.0]])]
    for _ in range(count):
        start = parts[-1][-1] + [rng.uniform(0.8, 1.6), 0.3 * rng.standard_normal()]
        side, size = float(rng.choice([-1.0, 1.0])), rng.uniform(0.3, 0.7)
        turn = np.linspace(0.0, 2 * np.pi * rng.uniform(0.9, 1.1), 24)
        parts.append(start + size * np.column_stack([np.sin(turn), side * (1 - np.cos(turn))]))
    parts.append(parts[-1][-1:] + np.array([[rng.uniform(0.6, 1.4), 0.0]]))
    return [np.concatenate(parts)]


def _drop(rng: np.random.Generator) -> list[FloatArray]:
    """A tear: a ring with one long tip."""
    angle = np.linspace(0, 2 * np.pi, 80)
    x, y = np.cos(angle), np.sin(angle) * np.sin(angle / 2) ** rng.uniform(1.2, 3)
    return [np.column_stack([x * rng.uniform(1, 1.8), y])]


def _bean(rng: np.random.Generator) -> list[FloatArray]:
    """A ring with one deep bay."""
    angle = np.linspace(0, 2 * np.pi, 90) + rng.uniform(0, 2 * np.pi)
    bay = np.exp(-(((np.angle(np.exp(1j * angle))) / rng.uniform(0.4, 0.8)) ** 2))
    return [_polar(1 - rng.uniform(0.5, 0.85) * bay, angle, rng.uniform(0.8, 1.4))]


def _lumps(rng: np.random.Generator) -> list[FloatArray]:
    """Things that are something, joined up to one that is nothing: rings, boxes, teeth and curls without lifting."""
    chosen = rng.choice(4, 3 if rng.random() < 0.3 else 2, replace=False)
    parts, at = list[FloatArray](), np.zeros(2)
    for kind in chosen.tolist():
        part = (_ring, _box, _teeth, _coils)[kind](rng)
        angle = rng.uniform(-1.2, 1.2)
        c, s = np.cos(angle), np.sin(angle)
        part = (part - part[0]) @ np.array([[c, s], [-s, c]]) * rng.uniform(0.6, 1.4)
        parts.append(at + part)
        at = parts[-1][-1] + [rng.uniform(0.0, 0.5), 0.0]
    return [np.concatenate(parts)]


def _ring(rng: np.random.Generator) -> FloatArray:
    return _polar(np.full(40, 0.5), _turns(rng, count=40))


def _box(rng: np.random.Generator) -> FloatArray:
    return np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]) * rng.uniform(0.6, 1.3, 2)


def _teeth(rng: np.random.Generator) -> FloatArray:
    place = np.arange(int(rng.integers(4, 8)), dtype=np.float64)
    return np.column_stack([0.3 * place, (place % 2) * rng.uniform(0.4, 0.9)])


def _coils(rng: np.random.Generator) -> FloatArray:
    turn = np.linspace(0, 2 * np.pi * rng.integers(2, 5), 90)
    return np.column_stack([0.06 * turn + 0.25 * np.sin(turn), 0.4 * np.cos(turn)])


def _foreign(rng: np.random.Generator) -> list[FloatArray]:
    """A sign of no alphabet that is known: five to ten bars, hooks and bows in a square."""
    return [_stick(rng) for _ in range(int(rng.integers(5, 11)))]


def _stick(rng: np.random.Generator) -> FloatArray:
    start = rng.integers(0, 4, 2) / 3 + 0.05 * rng.standard_normal(2)
    end = start + rng.choice([(1, 0), (0, 1), (0.6, 0.6), (-0.6, 0.6), (0.35, 0), (0, 0.35)]) * rng.uniform(
        0.5, 1
    )
    if rng.random() < 0.25:
        return np.stack([start, end, end + 0.25 * rng.standard_normal(2)])
    return _bow(start, end, 0.3 * rng.standard_normal() if rng.random() < 0.3 else 0.03)


def _bush(rng: np.random.Generator) -> list[FloatArray]:
    """A stem in one stroke with branches gone over twice."""
    count = int(rng.integers(3, 7))
    parts = [np.array([[0.0, 0.0]])]
    for k in range(count):
        node = np.array([0.06 * rng.standard_normal(), -(k + 1) / count])
        tip = node + np.array([(-1) ** k * rng.uniform(0.3, 0.6), -rng.uniform(0.05, 0.4)])
        parts.append(np.stack([node, tip, node]))
    return [np.concatenate(parts)]


def _teasel(rng: np.random.Generator) -> list[FloatArray]:
    """A ring of spikes: a star of many points, a sun in one stroke, a hedgehog."""
    count = 2 * int(rng.integers(8, 16))
    angle = np.arange(count + 1) * 2 * np.pi / count
    radius = np.where(np.arange(count + 1) % 2 == 0, 1.0, rng.uniform(0.5, 0.8)) * rng.uniform(
        0.9, 1.1, count + 1
    )
    return [_polar(radius, angle, rng.uniform(0.6, 1))[: count + 1 - int(rng.integers(0, count // 3))]]


def _tangle(rng: np.random.Generator) -> list[FloatArray]:
    """A curve through random places, closed upon itself."""
    knots = rng.random((int(rng.integers(6, 14)), 2))
    return [alphabet.curve(np.concatenate([knots, knots[:1]]), ())]


_CURVES: Mapping[str, Family] = {
    "battlement": _battlement,
    "bean": _bean,
    "blob": _blob,
    "bush": _bush,
    "crossed polygon": _crossed,
    "curls": _curls,
    "drop": _drop,
    "foreign sign": _foreign,
    "joined kinds": _lumps,
    "maze": _maze,
    "puffs": _puffs,
    "ragged polygon": _ragged,
    "ramble": _ramble,
    "ramble with corners": partial(_ramble, sharp=0.6),
    "ring of loops": _rolling,
    "ring of spikes": _teasel,
    "rose": _rose,
    "tangle": _tangle,
}

ODDITIES: Mapping[str, Family] = _CURVES | {name: partial(_thing, name) for name in alphabet.objects()}
"""All families by name, in the order of their numbers."""
