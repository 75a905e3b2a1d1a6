"""Drawings from a seed and their numbers: who draws, what is meant, its place on the page. `pen` makes ink of them."""

from __future__ import annotations

from math import cos, exp, log, pi, sin

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.batch import (
    ARROW,
    CIRCLE,
    DOODLE,
    LASSO,
    MATH,
    PART,
    POLYGON,
    SCRIBBLE,
    SPRING,
    TAP,
    WIRE,
    Drawings,
    blank,
    put,
)
from data_gen.hand.chance import Key, key_of, normal, split, uniform
from data_gen.hand.closed import Drawing, circle, convex, lasso
from data_gen.hand.curves import more, piece
from data_gen.hand.jit import kernel, part
from data_gen.hand.lines import arrow, scribble, spring, tap, wire
from data_gen.hand.names import BROKEN, ROTATION, SEVERAL, SHEAR
from data_gen.hand.person import BREAKS, HEIGHT, PIECES, SLANT, sampled
from data_gen.hand.signs import Pools, letter_part, mathematics
from sketch.ink import FloatArray

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

WHERE = 1004
"""The name under which kind, size and place are split off."""
SIZE = (30.0, 420.0)
"""Log-uniform range of a drawing's size, page units; with the pixel grid it sets how coarse ink is."""
TAP_SIZE = (0.6, 4.0)
"""The same for taps: a resting hand moves by a pixel or two."""
SHEARED = 0.05
"""Standard deviation of the shear of shapes; letters have their writer's slant."""


@part
def _several(kind: int, habits: FloatArray, u: float) -> bool:
    """Whether the drawing is in several strokes."""
    if kind == CIRCLE:
        return u < 0.25 * habits[PIECES]
    if kind == POLYGON:
        return u < 0.05 + habits[PIECES]
    if kind == SPRING:
        return u < 0.1 * habits[PIECES]
    if kind == WIRE:
        return u < 0.06
    if kind == ARROW:
        return u < 0.46
    return (kind == MATH and u < 0.35) or (kind == DOODLE and u < 0.4)


@part
def _meant(kind: int, key: Key, habits: FloatArray, on: Mask, several: bool, pools: Pools) -> Drawing:
    """The ideal drawing of a kind, one unit large about the origin."""
    if kind == CIRCLE:
        return circle(key, habits, on, several)
    if kind == POLYGON:
        return convex(key, habits, on, several)
    if kind == SPRING:
        return spring(key, habits, on, several)
    if kind == WIRE:
        return wire(key, habits, on, several)
    if kind == ARROW:
        return arrow(key, habits, on, several)
    if kind == TAP:
        return tap(key)
    if kind == SCRIBBLE:
        return scribble(key, habits, on, several)
    if kind == LASSO:
        return lasso(key, habits, on, several)
    if kind == PART:
        return letter_part(key, pools)
    return mathematics(key, habits, on, several, pools)


@part
def _angle(kind: int, key: Key) -> float:
    """How the drawing is turned: most stand as one learned them, some any way."""
    r = split(key, ROTATION)
    u, z, any_way, quarter = uniform(r), normal(r), 2 * pi * uniform(r), pi / 2 * int(4 * uniform(r))
    if kind in (CIRCLE, LASSO):
        return 0.25 * z if u < 0.85 else any_way
    if kind == POLYGON:
        return 0.05 * z if u < 0.92 else any_way
    if kind == SPRING:
        return -0.22 + 0.15 * z if u < 0.82 else (pi / 2 + 0.1 * z if u < 0.91 else any_way)
    if kind == WIRE:
        if u < 0.36:
            return -0.05 + 0.06 * z
        if u < 0.76:
            return pi / 2 + 0.08 * z
        return pi / 4 * (1 if quarter < pi else -1) + 0.2 * z if u < 0.93 else any_way
    if kind == ARROW:
        # Rising to the right, as templates of gestures have it; along an axis, as in flow charts; any way.
        if u < 0.36:
            return -0.45 + 0.2 * z
        if u < 0.7:
            return 0.12 * z
        if u < 0.82:
            return pi / 2 + 0.08 * z
        return quarter + 0.08 * z if u < 0.9 else any_way
    if kind in (MATH, PART, DOODLE):
        return 0.07 * z if u < 0.97 else 0.3 * z
    return any_way


@part
def broken(points: FloatArray, ends: Indices, habits: FloatArray, key: Key) -> tuple[FloatArray, Indices]:
    """A drawing one of whose strokes the pen leaves and takes up again."""
    r = split(key, BROKEN)
    chosen, which, where, gap = uniform(r) < habits[BREAKS], uniform(r), uniform(r), 0.04 * uniform(r) ** 2
    if not chosen:
        return points, ends
    broken, begun = int(len(ends) * which), 0
    found, found_ends = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    for k in range(len(ends)):
        path = points[begun : ends[k]]
        begun = ends[k]
        if k == broken and len(path) > 1:
            cut = 0.2 + 0.6 * where
            found, found_ends = more(found, found_ends, piece(path, 0.0, cut - gap))
            found, found_ends = more(found, found_ends, piece(path, cut, 1.0))
        else:
            found, found_ends = more(found, found_ends, path)
    return found, found_ends


@part
def place(points: FloatArray, kind: int, key: Key, habits: FloatArray, on: Mask) -> None:
    """Brings the drawing to its size and place on the page, turned and sheared."""
    r = split(key, WHERE)
    uniform(r)  # the kind's
    large, x, y = uniform(r), 500.0 * uniform(r), 500.0 * uniform(r)
    low, high = TAP_SIZE if kind == TAP else SIZE
    size = habits[HEIGHT] if kind == PART else low * exp(log(high / low) * large)
    angle = _angle(kind, key) if on[ROTATION] else 0.0
    lean = habits[SLANT] if kind in (MATH, PART, DOODLE) else SHEARED * normal(split(key, SHEAR))
    if not on[SHEAR]:
        lean = 0.0
    c, s = size * cos(angle), size * sin(angle)
    for k in range(len(points)):
        u, v = c * points[k, 0] - s * points[k, 1], s * points[k, 0] + c * points[k, 1]
        points[k, 0], points[k, 1] = x + u - lean * v, y + v


@part
def _kind(u: float, cumulative: FloatArray) -> int:
    kind = 0
    while kind < len(cumulative) - 1 and u >= cumulative[kind]:
        kind += 1
    return kind


@kernel
def drawings(
    seed: Key,
    first: int,
    count: int,
    cumulative: FloatArray,
    shares: FloatArray,
    groups: FloatArray,
    on: Mask,
    pools: Pools,
    on_page: bool,
) -> Drawings:
    """Drawings first … first + count − 1 of a seed; on_page: at their size and place, or else as they are meant,
    one unit large about the origin."""
    batch = blank(count, groups.shape[1])
    for number in range(count):
        key = key_of(seed, np.uint64(first + number)) & ~np.uint64(255)
        kind = _kind(uniform(split(key, WHERE)), cumulative)
        habits = sampled(key, shares, groups)
        several = _several(kind, habits, uniform(split(key, SEVERAL))) and on[SEVERAL]
        path, ends, detail = _meant(kind, key, habits, on, several, pools)
        if on[BROKEN] and kind != TAP:
            path, ends = broken(path, ends, habits, key)
        if on_page:
            place(path, kind, key, habits, on)
        batch = put(batch, number, kind, detail, key, habits, path, ends, on)
    return batch
