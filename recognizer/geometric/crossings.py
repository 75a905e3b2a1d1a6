"""Where a stroke crosses itself: a coil does so once a turn, and always the same way.

Frame: points at equal spacing on a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

import numpy as np

from sketch.geometry import self_intersections
from sketch.ink import FloatArray


def crossings(points: FloatArray) -> FloatArray:
    """Positions along the path, in points, of the two visits to each crossing: (k, 2)."""
    return self_intersections(points)


def signs(points: FloatArray, found: FloatArray) -> FloatArray:
    """For each crossing +1 where the later visit passes from left to right over the earlier one
    (y down: from +x towards +y), else −1: (k,). The loops of a coil agree."""
    steps = np.diff(points, axis=0)
    early, late = steps[found[:, 0].astype(int)], steps[found[:, 1].astype(int)]
    return np.sign(early[:, 0] * late[:, 1] - early[:, 1] * late[:, 0])
