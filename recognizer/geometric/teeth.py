"""Springs: teeth or coils that advance along an axis.

Whether pointed, wavy or coiled, a spring seen along its axis swings from side to side, regularly,
and moves on. Frame: equally spaced points of a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, sin

import numpy as np

from recognizer.geometric.kernels import swings_about, turning_points
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
    """axis: unit vector; legs: swings of at least half the ordinary height; uneven: their
    heights' standard deviation over their mean; progress: net way along the axis of the turning
    points of either side over their whole way (1: always onward); pitch: mean way along the axis
    of two legs; height: median leg, across the axis."""

    axis: tuple[float, float]
    legs: int
    uneven: float
    progress: float
    pitch: float
    height: float


def teeth(path: FloatArray, rule: TeethRule = TEETH) -> Teeth:
    """The swings of a path about the axis that shows them best: its chord or one of its principal
    axes."""
    even = np.ascontiguousarray(path)
    return max((_about(even, axis, rule) for axis in _axes(even)), key=_merit)


def swings(across: FloatArray, least: float) -> list[int]:
    """Indices of the ends and the turning points of a signal that moves by `least` between them."""
    return list(turning_points(np.ascontiguousarray(across), least))


def _axes(path: FloatArray) -> list[tuple[float, float]]:
    centred = path - path.mean(axis=0)
    (xx, xy), (_, yy) = (centred.T @ centred).tolist()
    angle = 0.5 * atan2(2 * xy, xx - yy)
    axes = [(-sin(angle), cos(angle)), (cos(angle), sin(angle))]
    x, y = (path[-1] - path[0]).tolist()
    length = hypot(x, y)
    return [(x / length, y / length), *axes] if length > TEETH.chord else axes


def _merit(found: Teeth) -> float:
    return found.legs * found.progress / (1.0 + found.uneven)


def _about(path: FloatArray, axis: tuple[float, float], rule: TeethRule) -> Teeth:
    return Teeth(axis, *swings_about(path, *axis, rule.visible, rule.swing, rule.whole))
