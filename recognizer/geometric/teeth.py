"""Springs: teeth or coils that advance along an axis.

Whether pointed, wavy or coiled, a spring seen along its axis swings from side to side, regularly,
and moves on. Frame: equally spaced points of a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import sqrt
from statistics import fmean

import numpy as np

from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class TeethRule:
    """What counts as a swing."""

    swing: float = 0.25
    """A move across the axis by this share of the whole width is a swing; less is tremor, or the
    end of a lead."""
    visible: float = 0.03
    """A width below this share of the size is a wire drawn by a trembling hand."""
    chord: float = 0.3
    """Ends this far apart, as a share of the size, give a direction worth trying as the axis."""
    whole: float = 0.5
    """A leg counts where it is half as high as the middle one: leads and half teeth do not."""


TEETH = TeethRule()


@dataclass(frozen=True, slots=True, eq=False)
class Teeth:
    """axis: (2,) unit vector; legs: swings of at least half the ordinary height; uneven: their
    heights' standard deviation over their mean; progress: net way along the axis of the turning
    points of either side over their whole way (1: always onward); pitch: mean way along the axis
    of two legs; height: median leg, across the axis."""

    axis: FloatArray
    legs: int
    uneven: float
    progress: float
    pitch: float
    height: float


def teeth(path: FloatArray, rule: TeethRule = TEETH) -> Teeth:
    """The swings of a path about the axis that shows them best: its chord or one of its principal
    axes."""
    return max((_about(path, axis, rule) for axis in _axes(path)), key=_merit)


def swings(across: FloatArray, least: float) -> list[int]:
    """Indices of the ends and the turning points of a signal that moves by `least` between them."""
    values = across.tolist()
    found = [0]
    low = high = 0
    rising = 0
    for index, value in enumerate(values):
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


def _axes(path: FloatArray) -> list[FloatArray]:
    centred = path - path.mean(axis=0)
    _, directions = np.linalg.eigh(centred.T @ centred)
    chord = path[-1] - path[0]
    length = float(np.hypot(*chord))
    axes = [directions[:, 0], directions[:, 1]]
    return [chord / length, *axes] if length > TEETH.chord else axes


def _merit(found: Teeth) -> float:
    return found.legs * found.progress / (1.0 + found.uneven)


def _about(path: FloatArray, axis: FloatArray, rule: TeethRule) -> Teeth:
    across = path @ np.array([-axis[1], axis[0]])
    width = float(across.max() - across.min())
    if width < rule.visible:
        return Teeth(axis, 1, 0.0, 1.0, 1.0, width)
    turns = swings(across, rule.swing * width)
    along = (path[turns] @ axis).tolist()
    sides = across[turns].tolist()
    heights = sorted(abs(b - a) for a, b in pairwise(sides))
    typical = _median(heights)
    whole = [height for height in heights if height > rule.whole * typical]
    inner = along[1:-1]
    return Teeth(
        axis=axis,
        legs=len(whole),
        uneven=_spread(whole) / fmean(whole),
        progress=min(_onward(inner[0::2]), _onward(inner[1::2])),
        pitch=abs(along[-1] - along[0]) * 2 / max(len(turns) - 1, 1),
        height=typical,
    )


def _onward(along: list[float]) -> float:
    way = sum(abs(b - a) for a, b in pairwise(along))
    return abs(along[-1] - along[0]) / way if way > 0 else 1.0


def _median(ordered: list[float]) -> float:
    """The middle of a short sorted list."""
    half = len(ordered) // 2
    return ordered[half] if len(ordered) % 2 else 0.5 * (ordered[half - 1] + ordered[half])


def _spread(values: list[float]) -> float:
    """Standard deviation of a short list: numpy would spend longer on its arguments."""
    mean = fmean(values)
    return sqrt(fmean([(value - mean) ** 2 for value in values]))
