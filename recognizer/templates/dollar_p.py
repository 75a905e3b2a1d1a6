"""$P: a drawing as a cloud of points, whatever the order of its strokes.

Vatavu, Anthony and Wobbrock, "Gestures as point clouds: a $P recognizer for user interface prototypes", ICMI 2012. Points:
32, scaled by the longer side of their box, about their centroid. Distance: points of one cloud are given, in turn, to
the nearest of the other not yet given away, the earlier the more it weighs; least over starting points and over
which cloud gives. The paper calls it Greedy-5, ε = 0.5.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from recognizer.jit import kernel
from recognizer.templates.points import Compared, as_cloud, box_sides, centred, positive
from sketch.ink import FloatArray, Ink

POINTS = 32
STRIDE = 5
"""From one starting point to the next: ⌊n^(1 − ε)⌋ with ε = 0.5."""


def normalised(drawings: Sequence[Ink]) -> FloatArray:
    """Clouds of one size about the origin, (B, 32, 2)."""
    points = as_cloud(drawings, POINTS)
    return centred(points / positive(box_sides(points).max(axis=1))[:, None, None])


@kernel
def _distances(drawings: FloatArray, templates: FloatArray) -> FloatArray:
    found = np.empty((len(drawings), len(templates)))
    for i in range(len(drawings)):
        for j in range(len(templates)):
            best = np.inf
            for start in range(0, POINTS, STRIDE):
                there = _given(drawings[i], templates[j], start, best)
                back = _given(templates[j], drawings[i], start, min(best, there))
                best = min(best, there, back)
            found[i, j] = best
    return found


@kernel
def _given(cloud: FloatArray, other: FloatArray, start: int, enough: float) -> float:
    """Weighted distance of points given from `start` on; what is more than `enough` need not be exact."""
    n = len(cloud)
    xs, ys = other[:, 0].copy(), other[:, 1].copy()  # those still free come first
    total = 0.0
    for rank in range(n):
        at = start + rank if start + rank < n else start + rank - n
        x, y = cloud[at, 0], cloud[at, 1]
        least, taken = np.inf, 0
        for place in range(n - rank):
            dx, dy = xs[place] - x, ys[place] - y
            apart = dx * dx + dy * dy
            if apart < least:
                least, taken = apart, place
        xs[taken], ys[taken] = xs[n - rank - 1], ys[n - rank - 1]
        total += (1.0 - rank / n) * np.sqrt(least)
        if total >= enough:
            break
    return total


class DollarP(Compared):
    """Clouds, the points of one given to those of the other."""

    described = staticmethod(normalised)
    apart = staticmethod(_distances)
