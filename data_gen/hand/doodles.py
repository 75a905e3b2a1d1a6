"""Ink that is none of the kinds: hearts, clouds, stars, squiggles, signatures, houses, faces, lightning, spirals,
bent and knotted doodles. Nobody should read them; a recognizer that rejects is tried on them.

Drawings as in `closed`, one unit large, y down; the count is the doodle's number in `DOODLES`.
"""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.batch import DOODLE, Drawings, blank, put
from data_gen.hand.chance import Key, State, between, key_of, normal, split, uniform
from data_gen.hand.closed import SHAPE, Drawing
from data_gen.hand.curves import box, joined, line, more, moved, one, point, scaled, superellipse
from data_gen.hand.item import place
from data_gen.hand.jit import kernel, part
from data_gen.hand.names import DIRECTION, SEVERAL
from data_gen.hand.person import sampled
from data_gen.hand.signs import Pools, picked
from sketch.ink import FloatArray

SEVERAL_SHARE = 0.4
"""Share of doodles that may be of several strokes."""

DOODLES = (
    "heart",
    "cloud",
    "flower",
    "open star",
    "crescent",
    "signature",
    "squiggle",
    "knot",
    "house",
    "face",
    "lightning",
    "stick figure",
    "spiral",
    "stairs",
    "leaf",
    "fish",
)


@kernel
def drawings(
    seed: Key,
    first: int,
    count: int,
    shares: FloatArray,
    groups: FloatArray,
    on: NDArray[np.bool_],
    pools: Pools,
) -> Drawings:
    """Doodles first … first + count − 1 of a seed, as `item.drawings` gives the kinds."""
    batch = blank(count, groups.shape[1])
    for number in range(count):
        key = key_of(seed, np.uint64(first + number)) & ~np.uint64(255)
        habits = sampled(key, shares, groups)
        several = on[SEVERAL] and uniform(split(key, SEVERAL)) < SEVERAL_SHARE
        path, ends, detail = _doodle(key, on, several, pools)
        place(path, DOODLE, key, habits, on)
        batch = put(batch, number, DOODLE, detail, key, habits, path, ends, on)
    return batch


@part
def _doodle(key: Key, on: NDArray[np.bool_], several: bool, pools: Pools) -> Drawing:
    """One of `DOODLES`; those of several strokes only where that is asked for."""
    r = split(key, SHAPE)
    which = int(len(DOODLES) * uniform(r))
    if not several and (8 <= which <= 9 or which == 11):
        which = int(8 * uniform(r))
    if which == 8:
        points, ends = _house(r)
    elif which == 9:
        points, ends = _face(r)
    elif which == 11:
        points, ends = _figure(r)
    else:
        path = _single(which, r, pools)
        if uniform(split(key, DIRECTION)) < 0.5 and on[DIRECTION]:
            path = scaled(path, -1.0, 1.0)
        points, ends = one(path)
    return points, ends, which


@part
def _single(which: int, r: State, pools: Pools) -> FloatArray:
    if which == 0:
        return _heart(r)
    if which == 1:
        return _lobed(r, 5 + int(5 * uniform(r)), -0.3, 0.55)
    if which == 2:
        return _lobed(r, 5 + int(4 * uniform(r)), 0.25 + 0.2 * uniform(r), 1.0)
    if which == 3:
        return _open_star(r)
    if which == 4:
        return _crescent(r)
    if which == 5:
        return _signature(r, pools)
    if which == 6:
        return _spline(r, 5 + int(6 * uniform(r)), 0.35)
    if which == 7:
        return _spline(r, 8 + int(9 * uniform(r)), 1.0)
    if which == 10:
        return _lightning(r)
    if which == 12:
        return _spiral(r)
    if which == 13:
        return _stairs(r)
    if which == 14:
        return _leaf(r)
    return _fish(r)


@part
def _heart(r: State) -> FloatArray:
    path = np.empty((80, 2))
    sweep, wide, deep = 2 * pi * between(r, 0.95, 1.04), between(r, 0.8, 1.3), between(r, 0.7, 1.2)
    for k in range(80):
        t = sweep * k / 79
        path[k, 0] = -wide * 0.5 * sin(t) ** 3
        path[k, 1] = -(13 * cos(t) - 5 * deep * cos(2 * t) - 2 * cos(3 * t) - cos(4 * t)) / 34
    return path


@part
def _lobed(r: State, lobes: int, depth: float, flat: float) -> FloatArray:
    """A cloud (cusps inwards, depth below 0) or a flower (waves)."""
    count = 24 * lobes
    path = np.empty((count, 2))
    sweep, phase = 2 * pi * between(r, 0.94, 1.05), 2 * pi * uniform(r)
    uneven = np.empty(lobes + 2)
    for k in range(lobes + 2):
        uneven[k] = 1.0 + 0.25 * normal(r)
    for k in range(count):
        t = sweep * k / (count - 1)
        wave = (t * lobes / (2 * pi)) % 1.0
        bump = abs(sin(pi * wave)) if depth < 0 else 0.5 - 0.5 * cos(2 * pi * wave)
        radius = 0.35 + abs(depth) * 0.45 * bump * uneven[int(t * lobes / (2 * pi))]
        path[k, 0], path[k, 1] = radius * cos(t + phase), flat * radius * sin(t + phase)
    return path


@part
def _open_star(r: State) -> FloatArray:
    """The outline of a star with 4 to 7 points."""
    points = 4 + int(4 * uniform(r))
    inner = between(r, 0.3, 0.55)
    path = np.empty((2 * points + 1, 2))
    for k in range(2 * points + 1):
        radius = (0.5 if k % 2 == 0 else 0.5 * inner) * (1 + 0.08 * normal(r))
        angle = pi * k / points - pi / 2 + 0.04 * normal(r)
        path[k, 0], path[k, 1] = radius * cos(angle), radius * sin(angle)
    return path


@part
def _crescent(r: State) -> FloatArray:
    opening, depth = between(r, 0.5, 0.9), between(r, 0.35, 0.7)
    outer = superellipse(0.0, 0.0, 0.5, 0.5, opening, 2 * pi - 2 * opening, 2.0, 0.0)
    inner = superellipse(0.5 * cos(opening), 0.0, 0.5 * depth, 0.5 * sin(opening), 1.5 * pi, -pi, 2.0, 0.0)
    return joined(outer, inner)


@part
def _signature(r: State, pools: Pools) -> FloatArray:
    """Five to nine letters, joined, shrinking, with a flourish."""
    path = np.empty((0, 2))
    x = 0.0
    count = 5 + int(5 * uniform(r))
    for k in range(count):
        letter, _ends = picked(pools.letters, r)
        scale = (1.0 if k == 0 else 0.6) * between(r, 0.6, 1.2)
        low, _top, high, _bottom = box(letter)
        path = joined(path, scaled(moved(letter, x / scale - low, 0.0), scale, scale))
        x += scale * (high - low) + 0.1
    if uniform(r) < 0.5:
        path = joined(path, line(x + 0.3, 0.2 * normal(r), between(r, 0.0, 0.6) * x, 0.6 + 0.2 * normal(r)))
    return scaled(moved(path, -x / 2, 0.0), 1 / x, 1 / x)


@part
def _spline(r: State, nodes: int, loop: float) -> FloatArray:
    """A Catmull-Rom curve through random points: across the page (small loop) or all over it (1)."""
    knots = np.empty((nodes + 2, 2))
    for k in range(nodes + 2):
        knots[k, 0] = loop * (uniform(r) - 0.5) + (1 - loop) * (k / (nodes + 1) - 0.5)
        knots[k, 1] = (uniform(r) - 0.5) * between(r, 0.5, 1.0)
    path = np.empty((10 * (nodes - 1) + 1, 2))
    for k in range(nodes - 1):
        for j in range(10):
            t = j / 10
            for axis in range(2):
                a, b, c, d = knots[k, axis], knots[k + 1, axis], knots[k + 2, axis], knots[k + 3, axis]
                path[10 * k + j, axis] = 0.5 * (
                    2 * b
                    + (c - a) * t
                    + (2 * a - 5 * b + 4 * c - d) * t * t
                    + (3 * b - a - 3 * c + d) * t * t * t
                )
    path[10 * (nodes - 1), 0], path[10 * (nodes - 1), 1] = knots[nodes, 0], knots[nodes, 1]
    return path


_BOLT = ((0.1, -0.5), (-0.2, 0.05), (0.0, 0.05), (-0.15, 0.5), (0.25, -0.08), (0.08, -0.08), (0.28, -0.5))
"""Corners of a bolt of lightning."""


@part
def _lightning(r: State) -> FloatArray:
    path = np.empty((7, 2))
    for k in range(7):
        path[k, 0], path[k, 1] = _BOLT[k][0] + 0.04 * normal(r), _BOLT[k][1] + 0.04 * normal(r)
    return path


@part
def _spiral(r: State) -> FloatArray:
    turns, count = between(r, 2.2, 4.5), 140
    start, power = 2 * pi * uniform(r), between(r, 0.7, 1.3)
    path = np.empty((count, 2))
    for k in range(count):
        t = k / (count - 1)
        angle = start + 2 * pi * turns * t
        path[k, 0], path[k, 1] = 0.5 * t**power * cos(angle), 0.5 * t**power * sin(angle)
    return path


@part
def _stairs(r: State) -> FloatArray:
    steps = 3 + int(4 * uniform(r))
    path = np.zeros((2 * steps + 1, 2))
    for k in range(2 * steps):
        path[k + 1, 0], path[k + 1, 1] = path[k, 0], path[k, 1]
        path[k + 1, k % 2] += (1.0 if k % 2 == 0 else -1.0) / steps * (1 + 0.15 * normal(r))
    return moved(path, -0.5, 0.5)


@part
def _leaf(r: State) -> FloatArray:
    """Two arcs that meet in two tips, and a stem."""
    fat = between(r, 0.2, 0.35)
    path = np.empty((62, 2))
    for k in range(60):
        t = 2 * k / 59
        path[k, 0] = (t if t < 1 else 2 - t) - 0.5
        path[k, 1] = fat * sin(pi * min(t, 1.0)) if t < 1 else -fat * sin(pi * (2 - t))
    path[60, 0], path[60, 1] = -0.5, 0.0
    path[61, 0], path[61, 1] = between(r, 0.1, 0.4), 0.05 * normal(r)
    return path


@part
def _fish(r: State) -> FloatArray:
    """A loop whose ends cross to a tail."""
    path = np.empty((70, 2))
    tail, fat = between(r, 0.5, 0.8), between(r, 0.2, 0.35)
    for k in range(70):
        t = -pi * (0.5 + tail / 2) + 2 * pi * (0.5 + tail / 2) * k / 69
        path[k, 0], path[k, 1] = 0.5 * cos(t), fat * sin(t)
        if abs(t) > pi / 2:
            beyond = abs(t) - pi / 2
            path[k, 0] = -0.45 * beyond
            path[k, 1] = (fat - 0.55 * beyond) * (1.0 if t > 0 else -1.0)
    return path


@part
def _house(r: State) -> tuple[FloatArray, NDArray[np.int64]]:
    roof = between(r, 0.2, 0.45)
    points, ends = one(joined(line(-0.4, 0.0, -0.4, 0.5), line(0.4, 0.5, 0.4, 0.0)))
    points, ends = more(points, ends, joined(line(-0.5, 0.0, 0.0, -roof), point(0.5, 0.0)))
    x = between(r, -0.3, 0.1)
    return more(points, ends, joined(line(x, 0.5, x, 0.2), line(x + 0.18, 0.2, x + 0.18, 0.5)))


@part
def _face(r: State) -> tuple[FloatArray, NDArray[np.int64]]:
    points, ends = one(superellipse(0.0, 0.0, 0.5, 0.5, -pi / 2, -2.03 * pi, 2.0, 0.0))
    for side in (-1, 1):
        points, ends = more(points, ends, line(0.18 * side, -0.18, 0.18 * side, -0.1 + 0.05 * uniform(r)))
    mood = between(r, -0.15, 0.2)
    mouth = np.empty((12, 2))
    for k in range(12):
        t = 2 * k / 11 - 1
        mouth[k, 0], mouth[k, 1] = 0.25 * t, 0.2 + mood * (1 - t * t)
    return more(points, ends, mouth)


@part
def _figure(r: State) -> tuple[FloatArray, NDArray[np.int64]]:
    points, ends = one(superellipse(0.0, -0.38, 0.12, 0.12, -pi / 2, -2.02 * pi, 2.0, 0.0))
    points, ends = more(points, ends, line(0.0, -0.26, 0.03 * normal(r), 0.15))
    points, ends = more(points, ends, line(-0.25, -0.1 + 0.05 * normal(r), 0.25, -0.1 + 0.05 * normal(r)))
    return more(points, ends, joined(line(-0.2, 0.5, 0.0, 0.15), point(0.2, 0.5)))
