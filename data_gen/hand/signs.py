"""Mathematics as drawings: letters, digits, signs and other marks, picked from tables of authored strokes."""

from __future__ import annotations

from math import cos, exp, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.chance import Key, State, normal, split, uniform
from data_gen.hand.closed import PARTS, SHAPE, Drawing
from data_gen.hand.curves import box, joined, more, moved, one, scaled
from data_gen.hand.jit import part
from data_gen.hand.names import ASPECT, CORNERS, DIRECTION, ENDS, PROPORTIONS
from data_gen.hand.paths import strayed
from sketch.ink import FloatArray

Indices = NDArray[np.int64]

MARK = 0.45
"""Share of single strokes of mathematics that are other marks: braces, stars, checks, curls."""
WORD = 0.05
"""Share of mathematics that are letters joined up to a word, or several signs in a row."""
STAR = 0.05
"""Share of mathematics that are five-pointed stars in one stroke."""
APART = 0.03
"""Standard deviation with which the strokes of a sign miss one another, fraction of its size."""


class Glyphs(NamedTuple):
    """Signs, their ways of being written and the strokes of these, one below the other: points (P, 2); where
    each stroke ends among the points, each way among the strokes, each sign among the ways."""

    points: FloatArray
    strokes: Indices
    ways: Indices
    signs: Indices


class Pools(NamedTuple):
    """symbols, marks: single strokes that are mathematics when alone; letters: those that words are made of;
    every: all strokes that stand in formulas; whole: signs with all of their strokes."""

    symbols: Glyphs
    marks: Glyphs
    letters: Glyphs
    every: Glyphs
    whole: Glyphs


@part
def picked(glyphs: Glyphs, r: State) -> tuple[FloatArray, Indices]:
    """A sign at random, in one of its ways at random: its points and where its strokes end."""
    sign = int(len(glyphs.signs) * uniform(r))
    first = glyphs.signs[sign - 1] if sign > 0 else 0
    way = first + int((glyphs.signs[sign] - first) * uniform(r))
    begun = glyphs.ways[way - 1] if way > 0 else 0
    base = glyphs.strokes[begun - 1] if begun > 0 else 0
    ends = np.empty(glyphs.ways[way] - begun, dtype=np.int64)
    for k in range(len(ends)):
        ends[k] = glyphs.strokes[begun + k] - base
    points = np.empty((ends[-1], 2))
    for k in range(len(points)):
        points[k, 0], points[k, 1] = glyphs.points[base + k, 0], glyphs.points[base + k, 1]
    return points, ends


@part
def mathematics(key: Key, _habits: FloatArray, on: NDArray[np.bool_], several: bool, pools: Pools) -> Drawing:
    """A letter, digit, sign or other mark that is no component when it stands alone."""
    r = split(key, SHAPE)
    u = uniform(r)
    if several:
        points, ends = _row(pools.whole, r, on) if u < WORD else picked(pools.whole, r)
        _loosen(points, ends, split(key, PARTS), on)
    elif u < WORD:
        points, ends = one(_word(pools.letters, r))
    elif u < WORD + STAR:
        points, ends = one(_star(key, on))
    else:
        points, ends = picked(pools.marks if u < WORD + STAR + MARK else pools.symbols, r)
    wide = exp(0.13 * normal(split(key, ASPECT))) if on[ASPECT] else 1.0
    points = scaled(points, wide, 1.0 / wide)
    if on[ENDS]:
        begun = 0
        for k in range(len(ends)):
            strayed(points, begun, ends[k], key + np.uint64(k))
            begun = ends[k]
    return points, ends, len(ends)


@part
def letter_part(key: Key, pools: Pools) -> Drawing:
    """Any stroke of any symbol of mathematics, bars and rings included: what stands in a formula."""
    points, ends = picked(pools.every, split(key, SHAPE))
    return points, ends, 1


@part
def _loosen(points: FloatArray, ends: Indices, r: State, on: NDArray[np.bool_]) -> None:
    """Each stroke of a sign shifted by itself."""
    begun = 0
    for k in range(len(ends)):
        x, y = APART * normal(r), APART * normal(r)
        if on[PROPORTIONS] and k > 0:
            for j in range(begun, ends[k]):
                points[j, 0] += x
                points[j, 1] += y
        begun = ends[k]


@part
def _row(whole: Glyphs, r: State, on: NDArray[np.bool_]) -> tuple[FloatArray, Indices]:
    """Two to five signs in a row."""
    count = 2 + int(4 * uniform(r))
    points, ends = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    x = 0.0
    for _ in range(count):
        sign, strokes = picked(whole, r)
        low, _top, high, _bottom = box(sign)
        begun = 0
        for k in range(len(strokes)):
            points, ends = more(points, ends, moved(sign[begun : strokes[k]], x - low, 0.0))
            begun = strokes[k]
        x += high - low + (0.2 + 0.15 * uniform(r) if on[PROPORTIONS] else 0.25)
    return scaled(moved(points, -x / 2, 0.0), 1 / x, 1 / x), ends


@part
def _word(letters: Glyphs, r: State) -> FloatArray:
    """Two to five letters of one stroke each, joined; none of those whose rows of legs look like a spring."""
    count = 2 + int(4 * uniform(r))
    path = np.empty((0, 2))
    x = 0.0
    for _ in range(count):
        letter, _ends = picked(letters, r)
        low, _top, high, _bottom = box(letter)
        path = joined(path, moved(letter, x - low, 0.0))
        x += high - low + 0.15
    return scaled(moved(path, -x / 2, 0.0), 1 / x, 1 / x)


@part
def _star(key: Key, on: NDArray[np.bool_]) -> FloatArray:
    """A pentagram, mostly begun at the lower left, its points uneven."""
    way = split(key, DIRECTION)
    usual, first, mirrored = uniform(way) < 0.7, int(5 * uniform(way)), uniform(way) < 0.4
    stray = split(key, CORNERS)
    path = np.empty((6, 2))
    for k in range(6):
        # The lower left point, the top, the lower right, the upper left, the upper right.
        turn = -2 + 2 * k if usual or not on[DIRECTION] else first + 2 * k
        angle = 2 * pi * turn / 5 - pi / 2
        path[k, 0], path[k, 1] = 0.5 * cos(angle), 0.5 * sin(angle)
        if on[CORNERS]:
            path[k, 0] += 0.05 * normal(stray)
            path[k, 1] += 0.05 * normal(stray)
    if mirrored and on[DIRECTION] and not usual:
        path = scaled(path, -1.0, 1.0)
    return path
