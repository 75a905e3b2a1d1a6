"""The best polyline of k legs through a path, for every k at once.

Optimal segmentation by dynamic programming (Bellman, 1961) over total-least-squares errors: the
corners that come out are the best ones together, so that a rounded or a missed corner is no
matter of one window's luck. Frame: the caller's; n points cost n² each for the errors and for
every further leg.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from recognizer.geometric.kernels.legs import legs_of, line_errors
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Legs:
    """rms: (most,) root mean square distance of the points from the best polyline of 1, 2 … legs;
    before: (most, n) for each last point the break that the best polyline had before it."""

    rms: FloatArray
    before: FloatArray

    def breaks(self, count: int) -> list[int]:
        """Indices of the points where the best `count` legs begin and end: count + 1 of them."""
        found = [self.before.shape[1] - 1]
        for leg in range(count - 1, -1, -1):
            found.append(int(self.before[leg, found[-1]]))
        return found[::-1]


def best_legs(points: FloatArray, most: int) -> Legs:
    """The best polylines of up to `most` legs through points (n, 2), n > most; legs share the
    point where they meet."""
    totals, before = legs_of(leg_errors(points), most)
    return Legs(np.sqrt(totals / len(points)), before)


def leg_errors(points: FloatArray) -> FloatArray:
    """Sum of squared distances of points i … j from their own best line, (n, n); infinite where
    j <= i, so that every leg has a length. From running sums: no loop within a leg."""
    return line_errors(np.ascontiguousarray(points))
