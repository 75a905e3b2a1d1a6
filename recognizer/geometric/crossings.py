"""Where a stroke crosses itself: a coil does so once a turn, and always the same way.

Frame: points at equal spacing on a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

import numpy as np

from recognizer.geometric.kernels.paths import crossing_places
from sketch.ink import FloatArray


def crossings(points: FloatArray) -> FloatArray:
    """Positions along the path, in points, of the two visits to each crossing: (k, 2), i + s and
    j + t where segment i crosses segment j, i + 1 < j. Touching end to end does not count.

    As `sketch.geometry.self_intersections`, in a compiled loop: a stroke's recognition is mostly this.
    """
    if len(points) < 4:
        return np.empty((0, 2))
    return crossing_places(np.ascontiguousarray(points))
