"""The best polyline through a path: see `recognizer.geometric.legs`."""

from __future__ import annotations

from math import hypot

import numpy as np

from recognizer.jit import kernel
from sketch.ink import FloatArray


@kernel
def line_errors(points: FloatArray) -> FloatArray:
    """Sum of squared distances of points i … j from their own best line, (n, n); infinite where j <= i."""
    n = len(points)
    errors = np.full((n, n), np.inf)
    mx, my = points[:, 0].mean(), points[:, 1].mean()
    for i in range(n):
        sx = sy = sxx = sxy = syy = 0.0
        for j in range(i, n):
            x, y = points[j, 0] - mx, points[j, 1] - my
            sx += x
            sy += y
            sxx += x * x
            sxy += x * y
            syy += y * y
            if j > i:
                m = j - i + 1
                xx, xy, yy = sxx - sx * sx / m, sxy - sx * sy / m, syy - sy * sy / m
                errors[i, j] = max(0.5 * (xx + yy) - hypot(0.5 * (xx - yy), xy), 0.0)
    return errors


@kernel
def legs_of(errors: FloatArray, most: int) -> tuple[FloatArray, FloatArray]:
    """Summed errors of the best polylines of 1 … `most` legs, (most,), and the break before each last point, (most, n)."""
    n = len(errors)
    totals = np.empty(most)
    before = np.zeros((most, n))
    total = errors[0].copy()
    totals[0] = total[-1]
    for leg in range(1, most):
        through = np.full(n, np.inf)
        for last in range(leg + 1, n):
            for first in range(leg, last):
                reached = total[first] + errors[first, last]
                if reached < through[last]:
                    through[last] = reached
                    before[leg, last] = first
        total = through
        totals[leg] = total[-1]
    return totals, before
