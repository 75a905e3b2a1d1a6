"""What people draw when they mean a kind: random ideal paths for every kind of stroke.

Each family maps a generator to one path, (n, 2), about one unit in size, y down. A family holds
what differs from drawing to drawing (proportions, teeth, start and direction, closing); what
differs from hand to hand is the writer's (`writers`, `pen`).

What the kinds mean, where shapes shade into one another:
- a spring has at least five legs (M and W have four) or at least three loops;
- a scribble goes over its own ground: its legs advance by less than an eighth of their height;
- a wire may bend a little and may run back on itself by up to a third;
- a straight line, a ring or a triangle drawn alone is a component, though letters contain them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, exp, sin

import numpy as np

from data_gen import ideals
from data_gen.glyphs.lone import lone_strokes, pick
from sketch.ink import FloatArray
from sketch.page import STROKE_KINDS, StrokeKind

Family = Callable[[np.random.Generator], FloatArray]


@dataclass(frozen=True, slots=True)
class FamilyRule:
    """Shares and spreads of the families, judged by eye on what people draw."""

    aspect: float = 0.34
    """Standard deviation of log(width / height) of circles: most are a little oval, some slim."""
    closing: float = 0.035
    """Standard deviation of the closing error, fraction of the perimeter."""
    late_ring: float = 0.8
    """A normal variate above this makes a ring of few, unevenly seen points: one in five."""
    tail: float = 0.2
    """Share of closed shapes whose pen runs on straight past the closure."""
    mid_side: float = 0.12
    """Share of polygons begun in the middle of a side instead of at a corner."""
    bend: float = 0.035
    """Standard deviation of a side's sagitta, fraction of the side."""
    zigzag: float = 0.62
    """Share of springs drawn as zig-zags (rounded ones included), the rest are coils."""
    backtrack: float = 0.08
    """Share of wires whose end runs back on itself."""
    mark: float = 0.38
    """Share of mathematics that are other marks: braces, stars, checks, curls."""
    word: float = 0.05
    """Share of mathematics that are letters joined up to a word."""
    star: float = 0.06
    """Share of mathematics that are five-pointed stars in one stroke."""


RULE = FamilyRule()


def circle(rng: np.random.Generator) -> FloatArray:
    """Round closed curves: ovals, eggs, slightly boxy or spiralling ones; often begun at the top."""
    u, z = rng.random(6).tolist(), rng.standard_normal(8).tolist()
    aspect = exp(RULE.aspect * z[0] * (1.8 if u[0] < 0.15 else 1.0))
    start = -np.pi / 2 + (0.5 * z[1] if u[1] < 0.6 else 2 * np.pi * u[2])
    spread = RULE.closing * (2.5 if u[3] < 0.2 else 1.0)
    sweep = 2 * np.pi * min(max(1.02 + spread * z[2], 0.83), 1.3)
    squareness = 2.0 + 0.35 * max(-0.8, z[3])
    egg = min(max(0.13 * z[4], -0.4), 0.4)
    path = ideals.superellipse((0, 0), (0.5 * aspect**0.5, 0.5 / aspect**0.5), start, sweep, squareness, egg)
    drift = 1.0 + 0.05 * z[5] * (np.arange(len(path)) / len(path) - 0.5)
    path = path * drift[:, None]
    if z[6] > RULE.late_ring:
        path = _sparse(path, rng)
    return _with_tail(_directed(_turned(path, np.pi * u[4]), u[5]), rng)


def polygon(rng: np.random.Generator) -> FloatArray:
    """Convex polygons of 3 to 8 corners, sides a little bent, closed within a few percent."""
    u = rng.random(6).tolist()
    corners = _convex_corners(rng, u[0])
    start = float(int(u[1] * len(corners)))
    if u[2] < RULE.mid_side:
        start += 0.15 + 0.7 * u[3]
    spread = RULE.closing * (2.0 if u[5] < 0.2 else 0.8)
    overlap = 0.004 + spread * float(rng.standard_normal())
    path = _bent_sides(ideals.polygon(corners, start, max(-0.13, overlap)), rng)
    return _with_tail(_directed(path, u[4]), rng)


def spring(rng: np.random.Generator) -> FloatArray:
    """Zig-zags of five legs or more and coils of three loops or more, at any angle, often with leads."""
    u, z = rng.random(10).tolist(), rng.standard_normal(4).tolist()
    lead = 0.0 if u[0] < 0.5 else 0.03 + 0.17 * u[1]
    angle = 0.25 * z[0] if u[2] < 0.6 else 2 * np.pi * u[3]
    if u[4] < RULE.zigzag:
        legs = 5 + int(9 * u[5] ** 2.2)
        width = 0.14 * (0.95 / 0.14) ** u[6] * (6 / legs) ** 0.4
        spacing = np.exp(0.18 * rng.standard_normal(legs))
        # Saw teeth: every other leg nearly upright, or even leaning back.
        spacing[int(2 * u[7]) :: 2] *= 1.0 if u[8] < 0.45 else 0.15 + 0.7 * u[9]
        heights = np.exp(0.22 * rng.standard_normal(legs - 1))
        peaks = ideals.zigzag((0, 0), (1, 0), legs, width, lead, spacing, heights)
        if lead == 0.0:
            # Without leads the first and last legs start from the trough, not from the axis.
            peaks[0, 1] -= width / 2
            peaks[-1, 1] -= width / 2 if legs % 2 == 0 else -width / 2
        path = _rounded_peaks(peaks) if u[1] > 0.85 and legs >= 7 else peaks
    else:
        loops = 3 + int(6 * u[5] ** 1.5)
        width = 0.12 * (0.7 / 0.12) ** u[6]
        path = ideals.coil((0, 0), (1, 0), loops, width, lead, 0.25 + 0.45 * u[7])
        path = _uneven(path if u[8] < 0.5 else path * (1.0, -1.0), rng, 0.12)
    return _turned(path if u[9] < 0.7 else path[::-1], angle)


def wire(rng: np.random.Generator) -> FloatArray:
    """Nearly straight strokes at any angle: bent a little, sometimes with a run-back at the end."""
    u, z = rng.random(5).tolist(), rng.standard_normal(3).tolist()
    along = np.arange(24) / 23
    sag = 0.03 * z[0] * (2.0 if u[0] < 0.12 else 1.0)
    skew = 0.02 * z[1]
    path = np.column_stack([along, sag * 4 * along * (1 - along) + skew * np.sin(2 * np.pi * along)])
    if u[1] < RULE.backtrack:
        back = path[::-1][1 : 2 + int(8 * u[2])]
        path = np.concatenate([path, back + np.array([0.0, 0.01 * z[2]])])
    angle = (np.pi / 2) * int(4 * u[3]) + 0.1 * z[2] if u[4] < 0.6 else 2 * np.pi * u[3]
    return _turned(path, angle)


def arrow(rng: np.random.Generator) -> FloatArray:
    """Arrows in one stroke: straight or bent shaft, head open or closed, its barbs uneven."""
    u, z = rng.random(8).tolist(), rng.standard_normal(10)
    head = (0.1 + 0.5 * u[0]) * np.exp(0.2 * z[:2])
    opening = np.radians(14 + 44 * u[1]) + 0.15 * z[2:4]
    tip = np.array([1.0, 0.0])
    first = tip + head[0] * np.array([-np.cos(opening[0]), np.sin(opening[0])])
    second = tip + head[1] * np.array([-np.cos(opening[1]), -np.sin(opening[1])])
    # Many never quite return to the tip between the barbs, or overshoot it.
    again = tip + 0.22 * head.mean() * z[4:6]
    barbs = [first, second, again] if u[2] < 0.15 else [first, again, second]
    shaft = np.arange(16) / 15
    bend = 0.03 * z[6] if u[3] < 0.7 else 0.15 * z[6]
    bowed = np.column_stack([shaft, bend * 4 * shaft * (1 - shaft)])
    if u[4] < 0.06:
        bowed = np.array([[0.3, 0.6 + 0.5 * u[5]], [0.0, 0.0], [1.0, 0.0]])
    path = np.concatenate([bowed, barbs])
    if u[6] < 0.5:
        path = path * np.array([1.0, -1.0])
    return _turned(path, 2 * np.pi * u[7])


def tap(rng: np.random.Generator) -> FloatArray:
    """A dot: the pen comes down, hardly moves, and leaves. Its size is set in `strokes`."""
    u = rng.random(2)
    slide = 0.7 * rng.standard_normal((2, 2))
    return slide[:1] if u[0] < 0.4 else slide


def scribble(rng: np.random.Generator) -> FloatArray:
    """Rubbing out: dense strokes to and fro, or small loops, over the same ground."""
    u, z = rng.random(5), rng.standard_normal(2)
    legs = 6 + int(16 * u[0])
    if u[1] < 0.75:
        advance = (0.015 + 0.095 * u[2]) * np.exp(0.5 * rng.standard_normal(legs + 1))
        height = np.exp(0.15 * rng.standard_normal(legs + 1))
        side = np.where(np.arange(legs + 1) % 2 == 0, 0.5, -0.5)
        path = np.column_stack([np.cumsum(advance), side * height + 0.05 * rng.standard_normal(legs + 1)])
        path = _rounded_peaks(path) if u[3] < 0.4 else path
    else:
        phase = np.linspace(0.0, 2 * np.pi * (4 + 5 * u[0]), 160)
        swell = 1.0 + 0.15 * np.sin(0.37 * phase + z[0])
        path = np.column_stack(
            [0.04 * phase / np.pi + 0.5 * swell * np.cos(phase), 0.4 * swell * np.sin(phase)]
        )
    return _turned(path, 2 * np.pi * u[4])


def lasso(rng: np.random.Generator) -> FloatArray:
    """A loose loop thrown around things: closed or nearly, lobed, longer than high."""
    u, z = rng.random(4).tolist(), rng.standard_normal(9)
    count = int(len(_ROUND) * (0.93 + 0.17 * u[0]) / _MOST_ROUND)
    radius = np.maximum(1.0 + (_LOBES * z[:8]) @ _HARMONICS[:, :count], 0.3)
    path = radius[:, None] * _ROUND[:count] * (0.5, 0.5 * exp(-0.9 * u[1]))
    return _directed(_turned(path, 0.2 * float(z[8])), u[2])


_MOST_ROUND = 1.1
"""Turns of the longest lasso: it overlaps itself by a tenth."""
_AROUND = np.arange(80) * (2 * np.pi * _MOST_ROUND / 80)
_ROUND = np.column_stack([np.cos(_AROUND), np.sin(_AROUND)])
_ORDERS = np.arange(2, 6)
_HARMONICS = np.concatenate([np.cos(np.outer(_ORDERS, _AROUND)), np.sin(np.outer(_ORDERS, _AROUND))])
_LOBES = np.tile(0.16 / _ORDERS**0.8, 2)
"""Standard deviations of a lasso's lobes: two to five of them, the more the flatter."""


def mathematics(rng: np.random.Generator) -> FloatArray:
    """One stroke of a letter, digit, sign or other mark that is no component when it stands alone."""
    u = float(rng.random())
    if u < RULE.word:
        path = _word(rng)
    elif u < RULE.word + RULE.star:
        path = _star(rng)
    else:
        path = pick(lone_strokes("marks" if u < RULE.word + RULE.star + RULE.mark else "symbols"), rng)
    z = rng.standard_normal(6).tolist()
    wide = exp(0.11 * z[0])
    # Both ends of a letter stray by themselves: cubic weights fade within the first and last third.
    ramp = np.arange(len(path))[:, None] / (len(path) - 1)
    strayed = path * (wide, 1 / wide) + (1 - ramp) ** 3 * (0.02 * z[2], 0.02 * z[3])
    return _turned(strayed + ramp**3 * (0.02 * z[4], 0.02 * z[5]), 0.13 * z[1])


def letter_part(rng: np.random.Generator) -> FloatArray:
    """Any stroke of any symbol of mathematics, bars and rings included: what stands in a formula."""
    return _turned(pick(lone_strokes("all"), rng), 0.1 * float(rng.standard_normal()))


FAMILIES: dict[StrokeKind, Family] = {
    "circle": circle,
    "polygon": polygon,
    "spring": spring,
    "wire": wire,
    "arrow": arrow,
    "tap": tap,
    "scribble": scribble,
    "lasso": lasso,
    "math": mathematics,
}
assert tuple(FAMILIES) == STROKE_KINDS


def _star(rng: np.random.Generator) -> FloatArray:
    """A pentagram begun at any of its points, its points uneven."""
    u, z = rng.random(2), rng.standard_normal((6, 2))
    around = 2 * np.pi * (int(5 * u[0]) / 5 + 0.4 * np.arange(6)) - np.pi / 2
    return _directed(0.5 * np.column_stack([np.cos(around), np.sin(around)]) + 0.05 * z, u[1])


def _word(rng: np.random.Generator) -> FloatArray:
    """Two to five letters of one stroke each, joined; none of those whose rows of legs look like a spring."""
    count = 2 + int(4 * float(rng.random()))
    pieces: list[FloatArray] = []
    x = 0.0
    for _ in range(count):
        stroke = pick(lone_strokes("round letters"), rng)
        low, high = float(stroke[:, 0].min()), float(stroke[:, 0].max())
        pieces.append(np.add(stroke, (x - low, 0.0)))
        x += high - low + 0.15
    return (np.concatenate(pieces) - (x / 2, 0.0)) / x


def _sparse(path: FloatArray, rng: np.random.Generator) -> FloatArray:
    """A ring as a slow device sees a quick pen: 12 to 60 points, wide apart where the pen was quick, which
    is most of all at the start: a long chord stands there."""
    count = int(12 + 48 * rng.random() ** 1.5)
    gaps = np.exp(0.35 * rng.standard_normal(count))
    first = 0.04 + 0.26 * float(rng.random())
    gaps = np.concatenate([[first], (1 - first) * gaps / gaps.sum()])
    wanted = np.minimum(np.concatenate([[0.0], np.cumsum(gaps)]), 1.0)
    place = np.arange(len(path)) / (len(path) - 1)
    return np.column_stack([np.interp(wanted, place, path[:, axis]) for axis in (0, 1)])


def _convex_corners(rng: np.random.Generator, which: float) -> FloatArray:
    """Corners of a triangle, rectangle, rhombus, parallelogram or general convex polygon, one unit large."""
    u, z = rng.random(6).tolist(), rng.standard_normal(4).tolist()
    if which < 0.40:
        # Triangles: upright isosceles, right-angled or any whose smallest angle stays above 15 degrees.
        apex = np.array([0.5 + 0.25 * z[0], -exp(-0.15 + 0.4 * z[1])])
        if u[0] < 0.3:
            apex[0] = 0.0 if u[1] < 0.5 else 1.0
        corners = np.array([[0.0, 0.0], [1.0, 0.0], apex])
        angle = 0.08 * z[2] if u[2] < 0.65 else 2 * np.pi * u[3]
    elif which < 0.84:
        # One rectangle in eight is a plank: a floor, a shelf, a beam of up to 25:1.
        aspect = exp(0.5 * z[0]) if u[4] > 0.125 else exp(1.5 + 1.7 * u[5])
        half = 0.5 * np.array([aspect**0.5, aspect**-0.5])
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
        if which > 0.78:
            corners = corners + np.array([[0.3 * z[1], 0], [0.3 * z[1], 0], [0, 0], [0, 0]]) * half
        diamond = 0.70 < which < 0.78
        angle = (np.pi / 4 if diamond else 0.0) + (0.06 * z[2] if u[2] < 0.8 else 2 * np.pi * u[3])
        if diamond:
            corners = corners / half * 0.4
    else:
        count = 4 + int(5 * u[0] ** 1.7)
        gaps = 0.55 + rng.random(count)
        around = np.cumsum(gaps) / gaps.sum() * 2 * np.pi
        corners = 0.5 * np.column_stack([np.cos(around), np.sin(around)])
        angle = 2 * np.pi * u[3]
    jitter = 0.022 * rng.standard_normal(corners.shape)
    squeeze = np.array([1.0, exp(0.15 * z[3])])
    return _turned(corners + jitter, angle) * squeeze


def _bent_sides(path: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Each straight side as a shallow arc of its own."""
    along = path[1:] - path[:-1]
    sag = RULE.bend * rng.standard_normal((len(along), 1))
    sides = np.empty((len(along), len(_STEPS), 2))
    for axis, sense in ((0, -1), (1, 1)):
        across = sense * sag * along[:, 1 - axis, None]
        sides[..., axis] = path[:-1, axis, None] + _STEPS * along[:, axis, None] + _BULGE * across
    return np.concatenate([sides.reshape(-1, 2), path[-1:]])


_STEPS = np.arange(9) / 9
_BULGE = 4 * _STEPS * (1 - _STEPS)
"""A parabola's rise along a side whose sagitta is one."""


def _with_tail(path: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Now and then the pen runs on past the closure, straight along where it was going."""
    u, length, veer = rng.random(3).tolist()
    if u >= RULE.tail:
        return path
    heading = path[-1] - path[-3]
    norm = float(np.linalg.norm(heading))
    if norm == 0:
        return path
    step = _turned((heading / norm)[None] * (0.03 + 0.22 * length**1.5), 0.9 * (veer - 0.5))
    return np.concatenate([path, path[-1:] + step])


def _rounded_peaks(peaks: FloatArray) -> FloatArray:
    """A wave through the same peaks: half a cosine between neighbours."""
    steps = np.arange(8) / 8
    ease = (1 - np.cos(np.pi * steps)) / 2
    x = peaks[:-1, None, 0] + steps * np.diff(peaks[:, 0])[:, None]
    y = peaks[:-1, None, 1] + ease * np.diff(peaks[:, 1])[:, None]
    return np.concatenate([np.column_stack([x.ravel(), y.ravel()]), peaks[-1:]])


def _uneven(path: FloatArray, rng: np.random.Generator, amount: float) -> FloatArray:
    """Loops of varying height and pitch: a slow random swell across and along the axis."""
    x = np.arange(len(path)) * (np.pi / (len(path) - 1))
    waves = rng.standard_normal((2, 4)) @ np.sin(np.outer(np.arange(1, 5), x))
    uneven = path.copy()
    uneven[:, 0] += 0.15 * amount * waves[1]
    uneven[:, 1] *= np.exp(amount * waves[0])
    return uneven


def _directed(path: FloatArray, u: float) -> FloatArray:
    """Mirrored half of the time, so that both drawing senses occur."""
    return path if u < 0.5 else path * (-1.0, 1.0)


def _turned(path: FloatArray, angle: float) -> FloatArray:
    return path @ np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])
