"""$1: one stroke against templates, turned until they match best.

Wobbrock, Wilson and Li, "Gestures without libraries, toolkits or training: a $1 recognizer for user interface
prototypes", UIST 2007. Points: 64, turned so that the first lies on the −x axis seen from the centroid, scaled to a
square of 250 without regard to proportions, about the origin. Distance: mean distance of corresponding
points, least over turns within ±45° by golden section search to 2°. As the paper says, it cannot tell
circles from ellipses, the sense of drawing matters, and straight lines are scaled into what their wobble gives.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import pi, sqrt

import numpy as np

from recognizer.jit import kernel
from recognizer.templates.points import (
    Compared,
    as_one_stroke,
    box_sides,
    centred,
    indicative_angle,
    positive,
    turned,
)
from sketch.ink import FloatArray, Ink

POINTS = 64
SIDE = 250.0
"""Of the square, in units of the distances."""
REACH = pi / 4
"""Turns that are tried lie within this to either side, radians;"""
FINE = pi / 90
"""the search stops when it knows the best to within this."""
GOLDEN = (sqrt(5.0) - 1.0) / 2.0


def normalised(drawings: Sequence[Ink]) -> FloatArray:
    """Drawings as the paper's steps 1 to 3 leave them, (B, 64, 2)."""
    points = as_one_stroke(drawings, POINTS)
    points = turned(centred(points), -indicative_angle(points))
    return centred(points * (SIDE / positive(box_sides(points)))[:, None])


@kernel
def _distances(drawings: FloatArray, templates: FloatArray) -> FloatArray:
    found = np.empty((len(drawings), len(templates)))
    for i in range(len(drawings)):
        for j in range(len(templates)):
            found[i, j] = _at_best_angle(drawings[i], templates[j])
    return found


@kernel
def _at_best_angle(drawing: FloatArray, template: FloatArray) -> float:
    low, high = -REACH, REACH
    first = GOLDEN * low + (1.0 - GOLDEN) * high
    second = (1.0 - GOLDEN) * low + GOLDEN * high
    at_first = _at_angle(drawing, template, first)
    at_second = _at_angle(drawing, template, second)
    while high - low > FINE:
        if at_first < at_second:
            high, second, at_second = second, first, at_first
            first = GOLDEN * low + (1.0 - GOLDEN) * high
            at_first = _at_angle(drawing, template, first)
        else:
            low, first, at_first = first, second, at_second
            second = (1.0 - GOLDEN) * low + GOLDEN * high
            at_second = _at_angle(drawing, template, second)
    return min(at_first, at_second)


@kernel
def _at_angle(drawing: FloatArray, template: FloatArray, angle: float) -> float:
    cos, sin = np.cos(angle), np.sin(angle)
    total = 0.0
    for k in range(len(drawing)):
        x = cos * drawing[k, 0] - sin * drawing[k, 1] - template[k, 0]
        y = sin * drawing[k, 0] + cos * drawing[k, 1] - template[k, 1]
        total += np.sqrt(x * x + y * y)
    return total / len(drawing)


class DollarOne(Compared):
    """Drawings as the paper's steps 1 to 3 leave them, point by point at the best angle."""

    described = staticmethod(normalised)
    apart = staticmethod(_distances)
