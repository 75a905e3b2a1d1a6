"""Ideal curves as kernels: what `data_gen.ideals` offers to Python and the families build upon.

Frame: page units (or units of the shape), y down; polylines (n, 2), corners single vertices.
"""

from __future__ import annotations

from math import cos, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.jit import part
from sketch.ink import FloatArray

ARC_STEP = pi / 30
"""Angle between neighbouring points of an arc, radians: the sagitta is 0.14 % of the radius."""


@part
def joined(first: FloatArray, second: FloatArray) -> FloatArray:
    """One path after the other."""
    path = np.empty((len(first) + len(second), 2))
    for k in range(len(first)):
        path[k, 0], path[k, 1] = first[k, 0], first[k, 1]
    for k in range(len(second)):
        path[len(first) + k, 0], path[len(first) + k, 1] = second[k, 0], second[k, 1]
    return path


@part
def backwards(path: FloatArray) -> FloatArray:
    """The path from its end."""
    found = np.empty((len(path), 2))
    for k in range(len(path)):
        found[k, 0], found[k, 1] = path[len(path) - 1 - k, 0], path[len(path) - 1 - k, 1]
    return found


@part
def scaled(path: FloatArray, across: float, down: float) -> FloatArray:
    """Multiplied by a factor for each axis."""
    found = np.empty((len(path), 2))
    for k in range(len(path)):
        found[k, 0], found[k, 1] = across * path[k, 0], down * path[k, 1]
    return found


@part
def moved(path: FloatArray, x: float, y: float) -> FloatArray:
    found = np.empty((len(path), 2))
    for k in range(len(path)):
        found[k, 0], found[k, 1] = path[k, 0] + x, path[k, 1] + y
    return found


@part
def point(x: float, y: float) -> FloatArray:
    """A path of one point."""
    path = np.empty((1, 2))
    path[0, 0], path[0, 1] = x, y
    return path


@part
def line(x0: float, y0: float, x1: float, y1: float) -> FloatArray:
    path = np.empty((2, 2))
    path[0, 0], path[0, 1] = x0, y0
    path[1, 0], path[1, 1] = x1, y1
    return path


@part
def superellipse(
    x: float, y: float, a: float, b: float, start: float, sweep: float, squareness: float, egg: float
) -> FloatArray:
    """|x/a|^k + |y/b|^k = 1 from angle `start` through `sweep`; egg: narrower towards +x."""
    count = max(8, int(abs(sweep) / ARC_STEP) + 2)
    path = np.empty((count, 2))
    for k in range(count):
        angle = start + k * (sweep / (count - 1))
        c, s = cos(angle), sin(angle)
        if squareness != 2.0:
            reach = (abs(c) ** squareness + abs(s) ** squareness) ** (-1.0 / squareness)
            c, s = reach * c, reach * s
        path[k, 0] = x + a * c
        path[k, 1] = y + b * s * (1.0 - egg * c)
    return path


@part
def polygon(corners: FloatArray, start: float, overlap: float) -> FloatArray:
    """Once around, from `start` (sides travelled, fractional), ending `overlap` (fraction of the perimeter)
    past the start, or before it where negative."""
    count = len(corners)
    reached = np.zeros(count + 1)
    for k in range(count):
        after = (k + 1) % count
        reached[k + 1] = reached[k] + hypot(
            corners[after, 0] - corners[k, 0], corners[after, 1] - corners[k, 1]
        )
    perimeter = reached[count]
    whole = int(start) % count
    part_of_side = start - int(start)
    begin = reached[whole] + part_of_side * (reached[whole + 1] - reached[whole])
    end, hair = begin + perimeter * (1.0 + overlap), 1e-9 * perimeter
    path = np.empty((3 * count + 2, 2))
    path[0, 0], path[0, 1] = _on_loop(corners, reached, begin)
    n = 1
    for turn in range(3):
        for k in range(count):
            if begin + hair < reached[k] + turn * perimeter < end - hair:
                path[n, 0], path[n, 1] = corners[k, 0], corners[k, 1]
                n += 1
    path[n, 0], path[n, 1] = _on_loop(corners, reached, end)
    return path[: n + 1]


@part
def _on_loop(corners: FloatArray, reached: FloatArray, distance: float) -> tuple[float, float]:
    count = len(corners)
    place = distance % reached[count]
    side = 0
    while side < count - 1 and reached[side + 1] <= place:
        side += 1
    length = reached[side + 1] - reached[side]
    share = (place - reached[side]) / length if length > 0 else 0.0
    after = (side + 1) % count
    return (
        corners[side, 0] + share * (corners[after, 0] - corners[side, 0]),
        corners[side, 1] + share * (corners[after, 1] - corners[side, 1]),
    )


@part
def coil(loops: float, length: float, width: float, lead: float, lean: float) -> FloatArray:
    """A trochoid along +x between two straight leads, from (0, 0) to (length, 0)."""
    body = length * (1 - 2 * lead)
    steps = max(16, int(loops * pi / ARC_STEP))
    most = 2 * pi * loops
    # The loop must run backwards faster than the axis advances, or it is a wave and not a coil.
    backward = max(lean * width / 2, 1.6 * body / most)
    sunk = width / 2 * (1 - cos(most)) / most
    path = np.zeros((steps + 2, 2))
    for k in range(steps):
        phase = k * (most / (steps - 1))
        path[k + 1, 0] = lead * length + body * phase / most - backward * sin(phase)
        path[k + 1, 1] = width / 2 * (1 - cos(phase)) - phase * sunk
    path[steps + 1, 0], path[steps + 1, 1] = length, 0.0
    return path if lead > 0 else path[1 : steps + 1]


@part
def zigzag(spacing: FloatArray, heights: FloatArray, length: float, width: float, lead: float) -> FloatArray:
    """len(spacing) legs along +x between two straight leads, from (0, 0) to (length, 0).

    spacing: relative advance of each leg; heights: relative size of each inner peak.
    """
    legs = len(spacing)
    path = np.zeros((legs + 3, 2))
    total = 0.0
    for k in range(legs):
        total += spacing[k]
    scale = (1 - 2 * lead) * length / total
    path[1, 0] = lead * length
    for k in range(legs):
        path[k + 2, 0] = path[k + 1, 0] + spacing[k] * scale
        if k < legs - 1:
            path[k + 2, 1] = width / 2 * heights[k] * (1.0 if k % 2 == 0 else -1.0)
    path[legs + 2, 0] = length
    return path if lead > 0 else path[1 : legs + 2]


@part
def lengths(path: FloatArray) -> FloatArray:
    """Distance travelled at each point, (n,)."""
    travelled = np.zeros(len(path))
    for k in range(1, len(path)):
        travelled[k] = travelled[k - 1] + hypot(path[k, 0] - path[k - 1, 0], path[k, 1] - path[k - 1, 1])
    return travelled


@part
def at(path: FloatArray, travelled: FloatArray, places: FloatArray) -> FloatArray:
    """Points of the path at distances that rise, (len(places), 2)."""
    found = np.empty((len(places), 2))
    last = len(path) - 1
    k = 0
    for j in range(len(places)):
        while k < last - 1 and travelled[k + 1] <= places[j]:
            k += 1
        after = min(k + 1, last)
        step = travelled[after] - travelled[k]
        share = min(max((places[j] - travelled[k]) / step, 0.0), 1.0) if step > 0 else 0.0
        for axis in range(2):
            found[j, axis] = path[k, axis] + share * (path[after, axis] - path[k, axis])
    return found


@part
def resampled(path: FloatArray, count: int) -> FloatArray:
    """`count` points of equal spacing."""
    travelled = lengths(path)
    places = np.empty(count)
    for k in range(count):
        places[k] = travelled[-1] * k / (count - 1)
    return at(path, travelled, places)


@part
def piece(path: FloatArray, begin: float, end: float) -> FloatArray:
    """The part of a path between two shares of its length; corners between them are kept."""
    travelled = lengths(path)
    low, high = begin * travelled[-1], end * travelled[-1]
    inner = np.empty((len(path) + 2, 2))
    bounds = np.empty(2)
    bounds[0], bounds[1] = low, high
    ends = at(path, travelled, bounds)
    inner[0, 0], inner[0, 1] = ends[0, 0], ends[0, 1]
    n = 1
    for k in range(len(path)):
        if low < travelled[k] < high:
            inner[n, 0], inner[n, 1] = path[k, 0], path[k, 1]
            n += 1
    inner[n, 0], inner[n, 1] = ends[1, 0], ends[1, 1]
    return inner[: n + 1]


@part
def box(path: FloatArray) -> tuple[float, float, float, float]:
    """Low x, low y, high x, high y."""
    x0 = y0 = np.inf
    x1 = y1 = -np.inf
    for k in range(len(path)):
        x0, x1 = min(x0, path[k, 0]), max(x1, path[k, 0])
        y0, y1 = min(y0, path[k, 1]), max(y1, path[k, 1])
    return x0, y0, x1, y1


@part
def size(path: FloatArray) -> float:
    """Diagonal of the bounding box."""
    x0, y0, x1, y1 = box(path)
    return hypot(x1 - x0, y1 - y0)


@part
def turned(path: FloatArray, angle: float) -> FloatArray:
    """Turned about the origin, towards +y for positive angles."""
    c, s = cos(angle), sin(angle)
    found = np.empty((len(path), 2))
    for k in range(len(path)):
        found[k, 0] = c * path[k, 0] - s * path[k, 1]
        found[k, 1] = s * path[k, 0] + c * path[k, 1]
    return found


@part
def bent(path: FloatArray, sagittas: FloatArray) -> FloatArray:
    """Each side as a shallow arc of nine pieces; sagittas: share of each side, (n − 1,)."""
    count = len(path) - 1
    found = np.empty((9 * count + 1, 2))
    for k in range(count):
        dx, dy = path[k + 1, 0] - path[k, 0], path[k + 1, 1] - path[k, 1]
        for j in range(9):
            t = j / 9
            rise = 4 * t * (1 - t) * sagittas[k]
            found[9 * k + j, 0] = path[k, 0] + t * dx - rise * dy
            found[9 * k + j, 1] = path[k, 1] + t * dy + rise * dx
    found[9 * count, 0], found[9 * count, 1] = path[count, 0], path[count, 1]
    return found


@part
def waved(peaks: FloatArray) -> FloatArray:
    """A wave through the same peaks: half a cosine between neighbours."""
    count = len(peaks) - 1
    found = np.empty((8 * count + 1, 2))
    for k in range(count):
        for j in range(8):
            t = j / 8
            found[8 * k + j, 0] = peaks[k, 0] + t * (peaks[k + 1, 0] - peaks[k, 0])
            found[8 * k + j, 1] = peaks[k, 1] + (1 - cos(pi * t)) / 2 * (peaks[k + 1, 1] - peaks[k, 1])
    found[8 * count, 0], found[8 * count, 1] = peaks[count, 0], peaks[count, 1]
    return found


@part
def one(path: FloatArray) -> tuple[FloatArray, NDArray[np.int64]]:
    """A drawing of one stroke: its points, and where its strokes end."""
    ends = np.empty(1, dtype=np.int64)
    ends[0] = len(path)
    return path, ends


@part
def more(
    points: FloatArray, ends: NDArray[np.int64], path: FloatArray
) -> tuple[FloatArray, NDArray[np.int64]]:
    """The drawing with one stroke more."""
    longer = np.empty(len(ends) + 1, dtype=np.int64)
    for k in range(len(ends)):
        longer[k] = ends[k]
    longer[len(ends)] = len(points) + len(path)
    return joined(points, path), longer
