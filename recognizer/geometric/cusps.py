"""Cusps: where a stroke turns sharply; its two ends always count.

Frame: points at equal spacing on a path whose bounding box has a diagonal of 1
(`recognizer.preprocess`). Row R2 of FEATURES.md names the detector; the paper gives neither
window nor angle, so both are reasoned from the shapes that must and must not have cusps.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

import numpy as np

from recognizer.geometric.kernels.paths import bend_angles
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class CuspRule:
    """What counts as a sharp turn."""

    reach: int = 2
    """Points looked at on either side. At a spacing of 1/40 of the size they span a tenth of it:
    longer than tremor, shorter than the side of any polygon worth drawing."""
    turn: float = radians(45)
    """A path that bends by more is a cusp. A hexagon's corner turns by 60°, a circle within this
    window by 8°, a coil of ten turns five times as long as wide by 29°."""


CUSPS = CuspRule()


def bends(points: FloatArray, reach: int = CUSPS.reach) -> FloatArray:
    """Signed angle between the chords that lead `reach` points to and from each point, radians in
    (−π, π]: (n,); 0 within `reach` of the ends."""
    return bend_angles(np.ascontiguousarray(points), reach)


def cusps(points: FloatArray, rule: CuspRule = CUSPS) -> list[int]:
    """Indices of the cusps in drawing order, both ends included.

    A cusp bends more than `rule.turn` and more than any other point within the window.
    """
    sharpness = np.abs(bends(points, rule.reach))
    inner: list[int] = []
    for index in np.flatnonzero(sharpness > rule.turn).tolist():
        window = sharpness[max(index - rule.reach, 0) : index + rule.reach + 1]
        if sharpness[index] < window.max():
            continue
        if not inner or index - inner[-1] > rule.reach:
            inner.append(index)
    return [0, *inner, len(points) - 1]
