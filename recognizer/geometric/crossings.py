"""Where a stroke crosses itself: a coil does so once a turn, and always the same way.

Frame: points at equal spacing on a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from sketch.ink import FloatArray


def crossings(points: FloatArray) -> FloatArray:
    """Positions along the path, in points, of the two visits to each crossing: (k, 2), i + s and
    j + t where segment i crosses segment j, i + 1 < j. Touching end to end does not count.

    As `sketch.geometry.self_intersections`, but pairs of segments whose boxes do not meet are dropped
    before anything is divided: a stroke's recognition is mostly this.
    """
    if len(points) < 4:
        return np.empty((0, 2))
    first, second = _pairs(len(points) - 1)
    (x, y), (dx, dy) = points[:-1].T, np.diff(points, axis=0).T
    middle_x, middle_y = x + 0.5 * dx, y + 0.5 * dy
    half_x, half_y = 0.5 * np.abs(dx), 0.5 * np.abs(dy)
    meet = np.abs(middle_x[second] - middle_x[first]) <= half_x[second] + half_x[first]
    first, second = first[meet], second[meet]
    meet = np.abs(middle_y[second] - middle_y[first]) <= half_y[second] + half_y[first]
    first, second = first[meet], second[meet]
    determinant = dx[first] * dy[second] - dy[first] * dx[second]
    offset_x, offset_y = x[second] - x[first], y[second] - y[first]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (offset_x * dy[second] - offset_y * dx[second]) / determinant
        t = (offset_x * dy[first] - offset_y * dx[first]) / determinant
        hit = (determinant != 0) & (s >= 0) & (s < 1) & (t >= 0) & (t < 1)
    return np.column_stack([first[hit] + s[hit], second[hit] + t[hit]])


@lru_cache(maxsize=512)
def _pairs(segments: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """All pairs of segments that are no neighbours."""
    return np.triu_indices(segments, k=2)
