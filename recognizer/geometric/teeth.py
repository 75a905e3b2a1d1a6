"""Springs: teeth or coils that advance along an axis.

Whether pointed, wavy or coiled, a spring seen along its axis swings from side to side, regularly,
and moves on. Frame: equally spaced points of a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from recognizer.geometric.kernels.teeth import teeth_of, turning_points
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
    x, y, legs, uneven, progress, pitch, height = teeth_of(
        np.ascontiguousarray(path), rule.chord, rule.visible, rule.swing, rule.whole
    )
    return Teeth((x, y), legs, uneven, progress, pitch, height)


def swings(across: FloatArray, least: float) -> list[int]:
    """Indices of the ends and the turning points of a signal that moves by `least` between them."""
    return list(turning_points(np.ascontiguousarray(across), least))
