"""Swings of a path about an axis: see `recognizer.geometric.teeth`."""

from __future__ import annotations

from math import atan2, hypot

import numpy as np

from recognizer.jit import kernel, part
from sketch.ink import FloatArray


@kernel
def turning_points(values: FloatArray, least: float) -> list[int]:
    """Indices of the ends and the turning points of a signal that moves by `least` between them."""
    found = [0]
    low = high = rising = 0
    for index in range(len(values)):
        value = values[index]
        if value > values[high]:
            high = index
        if value < values[low]:
            low = index
        if rising >= 0 and value < values[high] - least:
            if rising > 0 or high > 0:
                found.append(high)
            rising, low, high = -1, index, index
        elif rising <= 0 and value > values[low] + least:
            if rising < 0 or low > 0:
                found.append(low)
            rising, low, high = 1, index, index
    found.append(high if rising > 0 else low if rising < 0 else len(values) - 1)
    return found


@part
def swings_about(
    path: FloatArray, ax: float, ay: float, visible: float, swing: float, whole: float
) -> tuple[int, float, float, float, float]:
    """Legs, unevenness, progress, pitch and height of the swings of a path about an axis: see `Teeth`."""
    across = ay * -path[:, 0] + ax * path[:, 1]
    width = across.max() - across.min()
    if width < visible:
        return 1, 0.0, 1.0, 1.0, width
    turns = turning_points(across, swing * width)
    count = len(turns)
    along = np.empty(count)
    heights = np.empty(count - 1)
    for k in range(count):
        along[k] = path[turns[k], 0] * ax + path[turns[k], 1] * ay
        if k > 0:
            heights[k - 1] = abs(across[turns[k]] - across[turns[k - 1]])
    heights.sort()
    half = (count - 1) // 2
    typical = heights[half] if (count - 1) % 2 else 0.5 * (heights[half - 1] + heights[half])
    kept = heights[heights > whole * typical]
    progress = 1.0
    for side in range(2):
        way = 0.0
        last = 1 + side
        for k in range(3 + side, count - 1, 2):
            way += abs(along[k] - along[last])
            last = k
        if way > 0:
            progress = min(progress, abs(along[last] - along[1 + side]) / way)
    pitch = abs(along[-1] - along[0]) * 2 / max(count - 1, 1)
    return len(kept), kept.std() / kept.mean(), progress, pitch, typical


@kernel
def teeth_of(
    path: FloatArray, chord: float, visible: float, swing: float, whole: float
) -> tuple[float, float, int, float, float, float, float]:
    """Axis (x, y) and measures of the swings about whichever axis shows them best: the chord, where the ends are
    that far apart, or one of the principal axes."""
    n = len(path)
    mx, my = path[:, 0].mean(), path[:, 1].mean()
    xx = xy = yy = 0.0
    for i in range(n):
        x, y = path[i, 0] - mx, path[i, 1] - my
        xx += x * x
        xy += x * y
        yy += y * y
    angle = 0.5 * atan2(2 * xy, xx - yy)
    axes = np.empty((3, 2))
    axes[1, 0], axes[1, 1] = -np.sin(angle), np.cos(angle)
    axes[2, 0], axes[2, 1] = np.cos(angle), np.sin(angle)
    x, y = path[-1, 0] - path[0, 0], path[-1, 1] - path[0, 1]
    length = hypot(x, y)
    first = 1
    if length > chord:
        first = 0
        axes[0, 0], axes[0, 1] = x / length, y / length
    best = (0.0, 0.0, 0, 0.0, 0.0, 0.0, 0.0)
    most = -1.0
    for k in range(first, 3):
        legs, uneven, progress, pitch, height = swings_about(
            path, axes[k, 0], axes[k, 1], visible, swing, whole
        )
        merit = legs * progress / (1.0 + uneven)
        if merit > most:
            most = merit
            best = (axes[k, 0], axes[k, 1], legs, uneven, progress, pitch, height)
    return best
