"""What people draw when they mean a spring, a wire, an arrow, a tap or a scribble: ideal paths, one unit large.

What the kinds mean, where shapes shade into one another: a spring has at least five legs (M and W have four)
or at least three loops; a scribble goes over its own ground, its legs advance by less than an eighth of
their height; a wire may bend a little and may run back on itself by up to a third. Drawings as in `closed`; the
count of a spring is its legs, or minus its loops.
"""

from __future__ import annotations

from math import cos, exp, pi, sin

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.chance import Key, State, between, normal, split, uniform
from data_gen.hand.closed import PARTS, SHAPE, Drawing, loosened
from data_gen.hand.curves import backwards, coil, joined, line, more, one, piece, point, scaled, waved, zigzag
from data_gen.hand.jit import part
from data_gen.hand.names import ASPECT, BACKTRACK, DIRECTION, PROPORTIONS, SIDES
from sketch.ink import FloatArray

ZIGZAG = 0.66
"""Share of springs drawn as zig-zags (rounded ones included), the rest are coils."""
BACKTRACKS = 0.08
"""Share of wires whose end runs back on itself."""
FORWARD = 0.92
"""Share of springs and wires drawn the way that one reads: left to right or downwards."""


@part
def spring(key: Key, _habits: FloatArray, on: NDArray[np.bool_], several: bool) -> Drawing:
    """Zig-zags of five legs or more and coils of three loops or more, often with leads."""
    r = split(key, SHAPE)
    lead = 0.0 if uniform(r) < 0.68 else 0.03 + 0.17 * uniform(r)
    if several and lead == 0.0:
        lead = 0.12
    zigzagged, count, shape = uniform(r) < ZIGZAG, uniform(r), uniform(r)
    wide = (uniform(r) + uniform(r)) / 2  # the middling widths are the usual ones
    if zigzagged:
        legs = 5 + int(9 * count**3.2)
        path = _zigzag(legs, wide, lead, split(key, PROPORTIONS), on)
        if shape > 0.85 and legs >= 7:
            path = waved(path)
        found = legs
    else:
        loops = 3 + int(6 * count**1.5)
        width = 0.12 * (0.7 / 0.12) ** wide if on[ASPECT] else 0.3
        path = coil(float(loops), 1.0, width, lead, 0.25 + 0.45 * shape)
        path = _uneven(path, split(key, PROPORTIONS)) if on[PROPORTIONS] else path
        found = -loops
    way = split(key, DIRECTION)
    mirrored, forward = uniform(way), uniform(way)
    if mirrored < (0.12 if zigzagged else 0.5) and on[DIRECTION]:
        path = scaled(path, 1.0, -1.0)
    if forward > FORWARD and on[DIRECTION]:
        path = backwards(path)
    if several:
        parts = split(key, PARTS)
        points, ends = one(loosened(piece(path, 0.0, 0.06), parts, on))
        points, ends = more(points, ends, piece(path, 0.06, 0.94))
        points, ends = more(points, ends, loosened(piece(path, 0.94, 1.0), parts, on))
        return points, ends, found
    points, ends = one(path)
    return points, ends, found


@part
def _zigzag(legs: int, wide: float, lead: float, r: State, on: NDArray[np.bool_]) -> FloatArray:
    """Teeth of uneven size; every other leg may be nearly upright, or even lean back; sizes may swell or fade."""
    width = 0.14 * (0.85 / 0.14) ** (wide if on[ASPECT] else 0.5) * (6 / legs) ** 0.4
    saw, lean, trend = uniform(r), 0.15 + 0.7 * uniform(r), 0.25 * normal(r)
    which = 1 if uniform(r) < 0.8 else 0  # the legs downwards are the steep ones, mostly
    spacing, heights = np.ones(legs), np.ones(legs - 1)
    if on[PROPORTIONS]:
        for k in range(legs):
            spacing[k] = exp(0.18 * normal(r)) * (lean if saw > 0.45 and k % 2 == which else 1.0)
        for k in range(legs - 1):
            heights[k] = exp(0.2 * normal(r) + trend * (k / legs - 0.5))
    # The first peak is upwards (y grows downward).
    path = scaled(zigzag(spacing, heights, 1.0, width, lead), 1.0, -1.0)
    if lead == 0.0:
        # Without leads the first and last legs start from the trough, not from the axis.
        path[0, 1] += width / 2
        path[-1, 1] += width / 2 if legs % 2 == 0 else -width / 2
    return path


@part
def _uneven(path: FloatArray, r: State) -> FloatArray:
    """Loops of varying height and pitch: a slow random swell across and along the axis."""
    waves = np.empty((2, 4))
    for k in range(4):
        waves[0, k], waves[1, k] = 0.12 * normal(r), 0.018 * normal(r)
    for k in range(len(path)):
        across = along = 0.0
        for order in range(4):
            wave = sin((order + 1) * pi * k / (len(path) - 1))
            across += waves[0, order] * wave
            along += waves[1, order] * wave
        path[k, 0] += along
        path[k, 1] *= exp(across)
    return path


@part
def wire(key: Key, _habits: FloatArray, on: NDArray[np.bool_], several: bool) -> Drawing:
    """Nearly straight strokes, sometimes with a run-back at the end; dashed or dotted in several strokes."""
    r = split(key, SIDES)
    bent = 2.2 if uniform(r) < 0.15 else 1.0
    sag, skew = 0.016 * normal(r) * bent, 0.009 * normal(r)
    path = np.empty((24, 2))
    for k in range(24):
        t = k / 23
        path[k, 0] = t
        path[k, 1] = sag * 4 * t * (1 - t) + skew * sin(2 * pi * t) if on[SIDES] else 0.0
    way = split(key, DIRECTION)
    if uniform(way) > FORWARD and on[DIRECTION]:
        path = backwards(path)
    if several:
        return _dashes(path, split(key, PARTS), on)
    back = split(key, BACKTRACK)
    chosen, far, aside = uniform(back), uniform(back), 0.012 * normal(back)
    if chosen < BACKTRACKS and on[BACKTRACK]:
        again = backwards(piece(path, 1.0 - 0.33 * far, 1.0))
        for k in range(len(again)):
            again[k, 1] += aside * k / max(1, len(again) - 1)
        path = joined(path, again[1:])
    points, ends = one(path)
    return points, ends, 1


@part
def _dashes(path: FloatArray, r: State, on: NDArray[np.bool_]) -> Drawing:
    """A line of 3 to 9 dashes, or of dots."""
    count = 3 + int(7 * uniform(r))
    dotted = uniform(r) < 0.35
    filled = between(r, 0.45, 0.75)
    points, ends = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    for k in range(count):
        uneven = 1.0 + 0.15 * normal(r) if on[PROPORTIONS] else 1.0
        long = 0.01 if dotted else min(max(filled * uneven, 0.2), 0.92) / count
        first = k / count + (0.1 / count * uniform(r) if on[PROPORTIONS] else 0.0)
        points, ends = more(points, ends, piece(path, min(first, 1.0 - long), min(first + long, 1.0)))
    return points, ends, count


@part
def arrow(key: Key, _habits: FloatArray, on: NDArray[np.bool_], several: bool) -> Drawing:
    """Arrows in one, two or three strokes: straight, bent or angular shaft, head open or closed, barbs uneven."""
    r = split(key, PROPORTIONS)
    head, opening = 0.14 + 0.7 * uniform(r) ** 1.6, 0.3 + 0.7 * uniform(r)
    if not on[PROPORTIONS]:
        head, opening = 0.25, 0.5
    barbs = np.empty((3, 2))
    barbs[2, 0], barbs[2, 1] = 1.0, 0.0
    for k in range(2):
        length, angle = head * exp(0.2 * normal(r)), opening + 0.15 * normal(r)
        if not on[PROPORTIONS]:
            length, angle = head, opening
        barbs[k, 0] = 1.0 - length * cos(angle)
        barbs[k, 1] = length * sin(angle) * (-1.0 if k == 0 else 1.0)
    # Many never quite return to the tip between the barbs, or overshoot it.
    missed = 0.15 * head if on[PROPORTIONS] else 0.0
    tip = point(1.0 + 0.3 * missed * normal(r), 0.3 * missed * normal(r))
    again = point(1.0 + missed * normal(r), missed * normal(r))
    shaft = _shaft(key, on)
    way = split(key, DIRECTION)
    swapped, from_tip = uniform(way) < 0.12 and on[DIRECTION], uniform(way) < 0.08 and on[DIRECTION]
    first, second = (barbs[1:2], barbs[0:1]) if swapped else (barbs[0:1], barbs[1:2])
    form = split(key, PARTS)
    closed, how = uniform(form) < 0.12, uniform(form)
    if not several:
        if closed:
            path = joined(joined(shaft, first), joined(second, tip))
        elif how < 0.1:
            path = joined(joined(shaft, first), joined(second, again))
        else:
            path = joined(joined(shaft, first), joined(again, second))
        points, ends = one(path)
        return points, ends, 1
    # A large head is put round a shaft that stops short of its tip, and now and then drawn before it.
    short, head_first = 0.6 * uniform(form) ** 2 * min(1.0, head / 0.4), uniform(form) < 0.2 and on[DIRECTION]
    if on[PROPORTIONS]:
        for k in range(len(shaft)):
            shaft[k, 0] *= 1.0 - short * cos(opening)
    if from_tip:
        shaft = backwards(shaft)
    points, ends = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    if not head_first:
        points, ends = more(points, ends, shaft)
    if closed:
        points, ends = more(points, ends, joined(joined(first, tip), joined(second, first)))
    elif how < 0.72:
        points, ends = more(points, ends, joined(joined(first, tip), second))
    elif how < 0.86:
        # Both barbs away from the tip.
        points, ends = more(points, ends, joined(tip, first))
        points, ends = more(points, ends, joined(again, second))
    else:
        points, ends = more(points, ends, joined(first, tip))
        points, ends = more(points, ends, joined(second, again))
    if head_first:
        points, ends = more(points, ends, shaft)
    return points, ends, len(ends)


@part
def _shaft(key: Key, on: NDArray[np.bool_]) -> FloatArray:
    """Straight or bowed; one in eight angular, as in flow charts."""
    r = split(key, SIDES)
    form, bend = uniform(r), normal(r)
    across, where = between(r, -0.9, 0.9), between(r, 0.1, 0.9)
    if form < 0.06 and on[PROPORTIONS]:
        return joined(line(1.0 - where, across, 0.0, 0.0), line(0.5, 0.0, 1.0, 0.0))
    if form < 0.12 and on[PROPORTIONS]:
        return joined(line(0.0, across, where, across), line(where, 0.0, 1.0, 0.0))
    path = np.empty((17, 2))
    sag = 0.13 * bend if form > 0.85 else 0.025 * bend
    for k in range(17):
        t = k / 16
        path[k, 0] = t
        path[k, 1] = sag * 4 * t * (1 - t) if on[SIDES] else 0.0
    return path


@part
def tap(key: Key) -> Drawing:
    """A dot: the pen comes down, hardly moves, and leaves. Its size is set in `item`."""
    r = split(key, SHAPE)
    still = uniform(r) < 0.1
    path = np.zeros((1 if still else 2, 2))
    for k in range(len(path)):
        path[k, 0], path[k, 1] = 0.7 * normal(r), 0.7 * normal(r)
    points, ends = one(path)
    return points, ends, 1


@part
def scribble(key: Key, _habits: FloatArray, on: NDArray[np.bool_], _several: bool) -> Drawing:
    """Rubbing out: dense strokes to and fro, or small loops, over the same ground."""
    r = split(key, SHAPE)
    legs = 6 + int(16 * uniform(r))
    looped, pace, rounded, swell = uniform(r) > 0.75, uniform(r), uniform(r) < 0.4, 2 * pi * uniform(r)
    uneven = split(key, PROPORTIONS)
    if looped:
        path = np.empty((160, 2))
        for k in range(160):
            phase = 2 * pi * (4 + 5 * pace) * k / 159
            growth = 1.0 + (0.15 * sin(0.37 * phase + swell) if on[PROPORTIONS] else 0.0)
            path[k, 0] = 0.04 * phase / pi + 0.5 * growth * cos(phase)
            path[k, 1] = 0.4 * growth * sin(phase)
    else:
        path = np.zeros((legs + 1, 2))
        x = 0.0
        for k in range(legs + 1):
            advance, height = exp(0.5 * normal(uneven)), exp(0.15 * normal(uneven))
            aside = 0.05 * normal(uneven)
            if not on[PROPORTIONS]:
                advance, height, aside = 1.0, 1.0, 0.0
            x += (0.015 + 0.095 * pace) * advance
            path[k, 0], path[k, 1] = x, (0.5 if k % 2 == 0 else -0.5) * height + aside
        path = waved(path) if rounded else path
    points, ends = one(path)
    return points, ends, legs
