"""Ink as the arrays that the ONNX file takes, and pages too large for it as parts that overlap.

The contract of the arrays stands in README.md beside this file.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketch.ink import FloatArray, Ink, Stroke

Feeds = dict[str, NDArray[np.generic]]


@dataclass(frozen=True, slots=True)
class WindowRule:
    """How a page is divided whose strokes cannot all look at one another: time and memory grow as the square."""

    most: int = 96
    """Strokes read together: a page of diagrams is seldom more."""
    around: int = 32
    """Of these the nearest neighbours of a part, which are looked at but answered elsewhere."""


WINDOW = WindowRule()


def feeds(strokes: Sequence[Stroke], page: NDArray[np.int64] | None = None) -> Feeds:
    """The inputs of the ONNX file for these strokes, at least one. page: each stroke's page, (s,); all of one
    page by default."""
    counts = [len(stroke) for stroke in strokes]
    points = [stroke.points for stroke in strokes]
    times = [np.zeros(len(stroke)) if stroke.times is None else stroke.times for stroke in strokes]
    alone = len(counts) == 1  # the usual question of an app while one draws
    return {
        "points": points[0] if alone else np.concatenate(points),
        "times": times[0] if alone else np.concatenate(times),
        "stroke": np.repeat(np.arange(len(counts)), counts),
        "page": np.zeros(len(counts), dtype=np.int64) if page is None else page,
        "timed": np.array([stroke.times is not None for stroke in strokes], dtype=np.float32),
    }


def windows(ink: Ink, rule: WindowRule = WINDOW) -> list[tuple[NDArray[np.int64], int]]:
    """The page's strokes as sets that are read together, each in drawing order, and how many of each are
    answered there: those stand first in the set's own list. Every stroke is answered once.

    A page is halved across its longer side until its parts are small enough.
    """
    if len(ink) <= rule.most:
        return [(np.arange(len(ink)), len(ink))] if len(ink) else []
    centres = np.array([(stroke.points.min(axis=0) + stroke.points.max(axis=0)) / 2 for stroke in ink])
    found: list[tuple[NDArray[np.int64], int]] = []
    for part in _halved(np.arange(len(ink)), centres, rule.most - rule.around):
        low, high = centres[part].min(axis=0), centres[part].max(axis=0)
        outside = np.maximum(np.maximum(low - centres, centres - high), 0.0)
        away = np.hypot(outside[:, 0], outside[:, 1])
        away[part] = np.inf
        near = np.sort(np.argsort(away, kind="stable")[: rule.around])
        found.append((np.concatenate([part, near]), len(part)))
    return found


def _halved(strokes: NDArray[np.int64], centres: FloatArray, most: int) -> list[NDArray[np.int64]]:
    if len(strokes) <= most:
        return [np.sort(strokes)]
    axis = int(np.argmax(np.ptp(centres[strokes], axis=0)))
    order = strokes[np.argsort(centres[strokes, axis], kind="stable")]
    middle = len(order) // 2
    return [*_halved(order[:middle], centres, most), *_halved(order[middle:], centres, most)]
