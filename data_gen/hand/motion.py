"""The motion of a pen along the path it means to draw, as kernels.

Kinematics after the sigma-lognormal model (Plamondon 1995; O'Reilly and Plamondon 2009): a movement is the
vector sum of strokelets, each travelling its own piece of the path with a lognormal speed, the next one
starting before the last has ended, so that corners are rounded by overlap in time as a hand rounds them.
Strokelets part at corners, and after two turns of smooth path; within one the pen slows down where
the path bends, by the two-thirds power law (Viviani and Flash 1995: speed as curvature to the power −1/3).

Frame: page units, y down; seconds.
"""

from __future__ import annotations

from math import atan2, ceil, cos, exp, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr

from data_gen.hand.chance import Key, normal, split
from data_gen.hand.curves import lengths
from data_gen.hand.jit import part
from data_gen.hand.names import KINEMATICS, RATE, ROUNDING, SPEED
from data_gen.hand.person import OVERLAP, PACE, SAMPLES
from sketch.ink import FloatArray

Indices = NDArray[np.int64]

CORNER_TURN = 0.7
"""A path that turns by more than this within ±2 points has a corner there, radians,"""
CONCENTRATED = 0.65
"""if at least this share of the turn within ±6 points falls there: a loop of a coil has none."""
SMOOTH_TURN = 13.0
"""A new strokelet begins after this much smooth turning, radians: a ring is drawn in one, two loops of a coil too."""
LONG_TURN = 4.5
"""A strokelet that turns by more than this takes longer in proportion, radians,"""
STEADY_TURN, STEADY = 6.0, 0.5
"""and one that turns by so much is half as peaked in speed as a straight one."""
BEND_SPAN = 4
"""Curvature is taken over ± this many points."""
LEAST_BEND = 1.5
"""Curvature below this over the stroke's size is straight: the pen runs at its strokelet's speed."""
SIGMA = 0.35
"""Width of a strokelet's lognormal, log seconds: the skewed bell of measured speed profiles."""
REACH = 2.6
"""A strokelet is followed over ± this many sigmas; the tails left out are 0.9 % of it and are rescaled."""
SMOOTH_OVERLAP = 0.45
"""Share of a strokelet's time that the next one shares where the path is smooth."""
ISOCHRONY = 0.35
"""A stroke's time grows as its length to this power: long ones are drawn faster (Viviani 1982),"""
WITHIN = 2.0 / 3.0
"""and a strokelet's within its stroke to this one."""
UNIT_LENGTH = 40.0
"""Page units that a strokelet of the writer's mean time covers."""
SHORTEST, SLOWEST = 0.03, 25.0
"""No strokelet is quicker, no stroke slower than this, seconds."""
UNEVEN = 0.12
"""Standard deviation of the logarithm of a strokelet's time."""
PER_TURN = 2.8
"""Samples for each radian that a stroke turns at least: nobody draws rings so fast that a slow device sees triangles."""
FEWEST, MOST = 2, 360
"""Samples of a stroke that moves; more are thinned evenly, real strokes of these kinds stay below."""
USUAL_RATE, USUAL_PACE = 100.0, 5.5
"""Samples and strokelets a second where these do not vary."""

TIMING = 1003
"""The name under which the strokelets' random numbers are split off."""


@part
def travelled(
    path: FloatArray, habits: FloatArray, on: NDArray[np.bool_], key: Key
) -> tuple[FloatArray, FloatArray]:
    """Points (m, 2) and times (m,) of a pen that follows an evenly spaced path (n, 2)."""
    along = lengths(path)
    total_length = along[-1]
    turned = _turned_so_far(path)
    breaks, smooth = _strokelets(turned)
    start, end = _timing(along, turned, breaks, smooth, habits, on, key)
    total = end[-1]
    rate = habits[SAMPLES] if on[RATE] else USUAL_RATE
    bends = 0.0
    for k in range(1, len(turned)):
        bends += abs(turned[k] - turned[k - 1])
    fewest = min(FEWEST + int(PER_TURN * bends), 60)
    count = min(max(ceil(total * rate) + 1, fewest), MOST)
    interval = total / (count - 1)
    times = np.empty(count)
    for i in range(count):
        times[i] = i * interval
    points = np.empty((count, 2))
    if not on[KINEMATICS] or total_length == 0.0:
        for i in range(count):
            points[i, 0], points[i, 1] = _place(path, (len(path) - 1) * (i / (count - 1)))
        return points, times
    effort = _effort(path, along, turned)
    for i in range(count):
        points[i, 0], points[i, 1] = path[0, 0], path[0, 1]
    for k in range(len(start)):
        first, last = breaks[k], breaks[k + 1]
        opening = min(int(start[k] / interval) + 1, count)
        closing = min(ceil(end[k] / interval), count)
        if k == len(start) - 1:
            closing = count - 1
        j = first
        steady = STEADY * min(abs(turned[last] - turned[first]) / STEADY_TURN, 1.0)
        for i in range(opening, closing):
            phase = min(max((i * interval - start[k]) / (end[k] - start[k]), 0.0), 1.0)
            share = steady * phase + (1.0 - steady) * _progress(phase)
            wanted = effort[first] + share * (effort[last] - effort[first])
            while j < last - 1 and effort[j + 1] <= wanted:
                j += 1
            x, y = _place(path, j + (wanted - effort[j]) / (effort[j + 1] - effort[j]))
            points[i, 0] += x - path[first, 0]
            points[i, 1] += y - path[first, 1]
        for i in range(closing, count):
            points[i, 0] += path[last, 0] - path[first, 0]
            points[i, 1] += path[last, 1] - path[first, 1]
    return points, times


@part
def _place(path: FloatArray, place: float) -> tuple[float, float]:
    """The point at a fractional index."""
    low = min(int(place), len(path) - 2)
    share = min(max(place - low, 0.0), 1.0)
    return (
        path[low, 0] + share * (path[low + 1, 0] - path[low, 0]),
        path[low, 1] + share * (path[low + 1, 1] - path[low, 1]),
    )


@part
def _turned_so_far(path: FloatArray) -> FloatArray:
    """Signed turn up to and with each point, radians, (n,)."""
    turned = np.zeros(len(path))
    before = 0.0
    for k in range(len(path) - 1):
        heading = atan2(path[k + 1, 1] - path[k, 1], path[k + 1, 0] - path[k, 0])
        if k > 0:
            step = heading - before
            if step > pi:
                step -= 2 * pi
            elif step < -pi:
                step += 2 * pi
            turned[k] = turned[k - 1] + step
        before = heading
    turned[-1] = turned[-2]
    return turned


@part
def _within(turned: FloatArray, k: int, span: int) -> float:
    """Turn within ± span points, absolute."""
    low, high = max(k - span - 1, 0), min(k + span, len(turned) - 1)
    return abs(turned[high] - turned[low])


@part
def _strokelets(turned: FloatArray) -> tuple[Indices, NDArray[np.bool_]]:
    """Where strokelets begin and the last one ends, and whether the path is smooth there."""
    last = len(turned) - 1
    breaks, smooth = np.empty(len(turned), dtype=np.int64), np.zeros(len(turned), dtype=np.bool_)
    breaks[0] = 0
    count = 1
    run = 0.0
    k = 2
    while k < last - 1:
        run += abs(turned[k] - turned[k - 1])
        sharp = _within(turned, k, 2)
        if sharp > CORNER_TURN and sharp >= CONCENTRATED * _within(turned, k, 6):
            # The sharpest of the next few points is the corner.
            best = k
            for j in range(k + 1, min(k + 4, last - 1)):
                if abs(turned[j] - turned[j - 1]) > abs(turned[best] - turned[best - 1]):
                    best = j
            breaks[count], smooth[count] = best, False
            count += 1
            run = 0.0
            k = best + 3
        elif run > SMOOTH_TURN:
            breaks[count], smooth[count] = k, True
            count += 1
            run = 0.0
            k += 3
        else:
            k += 1
    breaks[count] = last
    return breaks[: count + 1], smooth[: count + 1]


@part
def _timing(
    along: FloatArray,
    turned: FloatArray,
    breaks: Indices,
    smooth: NDArray[np.bool_],
    habits: FloatArray,
    on: NDArray[np.bool_],
    key: Key,
) -> tuple[FloatArray, FloatArray]:
    """Start and end of each strokelet, seconds; ends are in order."""
    state = split(key, TIMING)
    count = len(breaks) - 1
    start, end = np.zeros(count), np.zeros(count)
    pace = habits[PACE] if on[SPEED] else USUAL_PACE
    mean = max(along[-1] / count, 1e-9)
    usual = (mean / UNIT_LENGTH) ** ISOCHRONY / pace
    before = 0.0
    for k in range(count):
        length = along[breaks[k + 1]] - along[breaks[k]]
        uneven = exp(UNEVEN * normal(state)) if on[SPEED] else 1.0
        bend = abs(turned[breaks[k + 1]] - turned[breaks[k]])
        duration = max(usual * (length / mean) ** WITHIN, SHORTEST) * uneven * max(1.0, bend / LONG_TURN)
        if k > 0:
            shared = habits[OVERLAP] if on[ROUNDING] else 0.0
            if smooth[k]:
                shared = max(shared, SMOOTH_OVERLAP)
            start[k] = end[k - 1] - shared * min(before, duration)
        end[k] = start[k] + duration
        before = duration
    squeeze = min(1.0, SLOWEST / end[-1])
    for k in range(count):
        start[k] *= squeeze
        end[k] *= squeeze
    return start, end


@part
def _effort(path: FloatArray, along: FloatArray, turned: FloatArray) -> FloatArray:
    """Length weighted by the slowness that curvature asks for, up to each point: rises by more where it bends."""
    n = len(path)
    x0 = y0 = np.inf
    x1 = y1 = -np.inf
    for k in range(n):
        x0, x1 = min(x0, path[k, 0]), max(x1, path[k, 0])
        y0, y1 = min(y0, path[k, 1]), max(y1, path[k, 1])
    scale = hypot(x1 - x0, y1 - y0)
    hair = 1e-9 * along[-1]
    effort = np.zeros(n)
    for k in range(n - 1):
        low, high = max(k - BEND_SPAN, 0), min(k + BEND_SPAN, n - 1)
        span = along[high] - along[low]
        bend = abs(turned[high] - turned[low]) / span * scale if span > 0 else 0.0
        slow = np.cbrt(bend + LEAST_BEND)
        effort[k + 1] = effort[k] + slow * (along[k + 1] - along[k]) + hair
    return effort


def _lognormal_bell() -> FloatArray:
    """Share of a strokelet done at evenly spaced phases of its time (0 start, 1 end): a lognormal's distribution
    function, cut at ± `REACH` sigmas and rescaled, so that 0 and 1 are met exactly."""
    low, high = exp(-REACH * SIGMA), exp(REACH * SIGMA)
    time = np.linspace(low, high, PHASES + 1)
    tail = float(ndtr(-REACH))
    table = (ndtr(np.log(time) / SIGMA) - tail) / (1 - 2 * tail)
    table[0], table[-1] = 0.0, 1.0
    return table


PHASES = 512
"""Steps of the table of a strokelet's progress: linear between them it is right to 2e-6."""
_PROGRESS = _lognormal_bell()


@part
def _progress(phase: float) -> float:
    place = phase * PHASES
    low = min(int(place), PHASES - 1)
    return _PROGRESS[low] + (place - low) * (_PROGRESS[low + 1] - _PROGRESS[low])


@part
def pressed(count: int, mean: float, key: Key) -> FloatArray:
    """Pressure rises within the first tenth of a stroke, falls in the last, and drifts in between."""
    drift = normal(split(key, TIMING + 1))
    found = np.empty(count)
    for i in range(count):
        place = i / max(count - 1, 1)
        envelope = min(1.0, 0.35 + 6.5 * min(place, 1 - place))
        found[i] = min(max(mean * envelope * (1.0 + drift * place * (1 - place) * (1 - 2 * place)), 0.0), 1.0)
    return found


@part
def swung(points: FloatArray, interval: float, amount: float, frequency: float, key: Key) -> None:
    """Tremor: an oscillation at the hand's own frequency whose strength comes and goes; amount: page units."""
    state = split(key, TIMING + 2)
    step = 2 * pi * interval * frequency * exp(0.08 * normal(state))
    # Three oscillations as turning arrows: the strength, x and y.
    c, s = np.empty(3), np.empty(3)
    turn_c, turn_s = np.empty(3), np.empty(3)
    for k in range(3):
        phase = 3.0 * normal(state)
        c[k], s[k] = cos(phase), sin(phase)
        turn_c[k], turn_s[k] = cos(0.23 * step if k == 0 else step), sin(0.23 * step if k == 0 else step)
    for i in range(len(points)):
        swell = amount * (1.0 + 0.4 * s[0])
        points[i, 0] += swell * s[1]
        points[i, 1] += swell * c[2]
        for k in range(3):
            c[k], s[k] = c[k] * turn_c[k] - s[k] * turn_s[k], s[k] * turn_c[k] + c[k] * turn_s[k]
