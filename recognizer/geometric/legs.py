"""The best polyline of k legs through a path, for every k at once.

Optimal segmentation by dynamic programming (Bellman, 1961) over total-least-squares errors: the
corners that come out are the best ones together, so that a rounded or a missed corner is no
matter of one window's luck. Frame: the caller's; n points cost n² each for the errors and for
every further leg.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

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
    errors = leg_errors(points)
    count = len(points)
    total = errors[0]
    totals, before = [total[-1]], [np.zeros(count)]
    for _ in range(1, most):
        through = total[:, None] + errors
        best = np.argmin(through, axis=0)
        total = through[best, np.arange(count)]
        totals.append(total[-1])
        before.append(best.astype(float))
    return Legs(np.sqrt(np.maximum(totals, 0.0) / count), np.array(before))


def leg_errors(points: FloatArray) -> FloatArray:
    """Sum of squared distances of points i … j from their own best line, (n, n); infinite where
    j <= i, so that every leg has a length. From running sums: no loop over legs."""
    centred = points - points.mean(axis=0)
    x, y = centred[:, 0], centred[:, 1]
    running = np.zeros((5, len(points) + 1))
    np.cumsum([x, y, x * x, y * y, x * y], axis=1, out=running[:, 1:])
    sums = running[:, None, 1:] - running[:, :-1, None]
    index = np.arange(len(points))
    number = np.maximum(index[None, :] - index[:, None] + 1, 1)
    sx, sy, sxx, syy, sxy = sums
    sxx = sxx - sx * sx / number
    syy = syy - sy * sy / number
    sxy = sxy - sx * sy / number
    # The smaller eigenvalue of the scatter matrix: what the best line leaves over.
    errors = 0.5 * (sxx + syy) - np.hypot(0.5 * (sxx - syy), sxy)
    return np.where(index[None, :] > index[:, None], np.maximum(errors, 0.0), np.inf)
