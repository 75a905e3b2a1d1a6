"""$N: several strokes as one, in every order and sense in which they might have been drawn.

Anthony and Wobbrock, "A lightweight multistroke recognizer for user interface prototypes", GI 2010, with the closed form
that made it fast, "$N-Protractor: a fast and accurate multistroke recognizer", GI 2012. A template of s strokes becomes
s! 2^s templates of one stroke; a drawing is its strokes in the order drawn. Points: 96, turned by the indicative
angle, scaled to a square, or in proportion where one side is less than 0.3 of the other (lines), so that straight lines stay
straight. Templates that start in another direction by more than 30° are passed over, unless all of a label do.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations, product
from math import cos, radians

import numpy as np

from recognizer.templates.points import (
    IntArray,
    as_one_stroke,
    box_sides,
    by_label,
    centred,
    indicative_angle,
    positive,
    turned,
)
from recognizer.templates.protractor import angles, unit
from sketch.ink import FloatArray, Ink, Stroke

POINTS = 96
THIN = 0.3
"""Lesser side over greater: a drawing below this is a line and is scaled in proportion."""
START = 12
"""The start's direction goes from the first point to the one so many points on."""
ALIKE = cos(radians(30.0))
"""Cosine between the starts of two drawings that may be the same."""
MOST = 4
"""Strokes of a template that are put in every order: 384 ways; with five there would be 3,840. Templates of more
strokes are remembered as they were drawn, and backwards."""
PASSED_OVER = np.pi
"""The distance to a template that starts otherwise: the greatest there is."""


@dataclass(frozen=True, slots=True, eq=False)
class DollarN:
    """templates: (U, 96, 2) as unit vectors; starts: (U, 2) their first directions; labels: (U,)."""

    templates: FloatArray
    starts: FloatArray
    labels: IntArray

    @classmethod
    def of(cls, templates: Sequence[Ink], labels: IntArray) -> DollarN:
        ways = [
            (way, label) for ink, label in zip(templates, labels.tolist(), strict=True) for way in drawn(ink)
        ]
        return cls(
            *_normalised([way for way, _ in ways]), np.array([label for _, label in ways], dtype=np.int64)
        )

    def nearest(self, drawings: Sequence[Ink]) -> FloatArray:
        points, starts = _normalised(drawings)
        apart = angles(points, self.templates)
        alike = starts @ self.starts.T >= ALIKE
        near = by_label(np.where(alike, apart, PASSED_OVER), self.labels)
        return np.where(near == PASSED_OVER, by_label(np.maximum(apart, np.pi / 2), self.labels), near)


def drawn(ink: Ink) -> Iterator[Ink]:
    """The ink in every order and sense of its strokes."""
    strokes = [(Stroke(stroke.points), Stroke(stroke.points[::-1])) for stroke in ink]
    if len(strokes) > MOST:
        yield Ink(tuple(there for there, _ in strokes))
        yield Ink(tuple(back for _, back in reversed(strokes)))
        return
    for order in permutations(strokes):
        for senses in product((0, 1), repeat=len(order)):
            yield Ink(tuple(stroke[sense] for stroke, sense in zip(order, senses, strict=True)))


def _normalised(drawings: Sequence[Ink]) -> tuple[FloatArray, FloatArray]:
    """Drawings as unit vectors (B, 96, 2), and the directions in which they start (B, 2)."""
    points = as_one_stroke(drawings, POINTS)
    points = turned(centred(points), -indicative_angle(points))
    sides = box_sides(points)
    line = sides.min(axis=1) <= THIN * sides.max(axis=1)
    scale = np.where(line[:, None], sides.max(axis=1, keepdims=True), sides)
    points = unit(centred(points / positive(scale)[:, None]))
    first = points[:, START] - points[:, 0]
    return points, first / positive(np.hypot(first[:, 0], first[:, 1]))[:, None]
