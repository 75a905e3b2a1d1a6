"""$Q: $P made fast by lower bounds from a look-up table.

Vatavu, Anthony and Wobbrock, "$Q: a super-quick, articulation-invariant stroke-gesture recognizer for low-resource devices",
MobileHCI 2018. Points: 32, whole numbers from 0 to 1023. Distance: $P's, of squared distances, weights 32 to 1. Before points are
given away, each is compared with the one that the other cloud's table (64 × 64 cells) names as nearest there: the
weighted sum for every starting point costs 32 steps, and where it reaches the least distance known so far the
giving is left out. Here the least is known by label, since a recognizer tells how near every kind is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from recognizer.jit import kernel
from recognizer.templates.points import IntArray, as_cloud, box_sides, centred, positive
from sketch.ink import FloatArray, Ink

POINTS = 32
STRIDE = 5
"""From one starting point to the next: ⌊n^(1 − ε)⌋ with ε = 0.5."""
RANGE = 1024
"""Coordinates are whole numbers below this;"""
CELL = 16
"""a cell of the table is so wide."""
GRID = RANGE // CELL

Cells = NDArray[np.int64]
Tables = NDArray[np.uint8]
"""Of points' numbers, 0 to 31: with a byte each 280 templates take 1.1 MB."""


@dataclass(frozen=True, slots=True, eq=False)
class DollarQ:
    """templates: (T, 32, 2) whole numbers; tables: (T, 64, 64) the nearest point by column and row; labels: (T,)."""

    templates: Cells
    tables: Tables
    labels: IntArray

    @classmethod
    def of(cls, templates: Sequence[Ink], labels: IntArray) -> DollarQ:
        clouds = normalised(templates)
        return cls(clouds, _tables(clouds), labels)

    def nearest(self, drawings: Sequence[Ink]) -> FloatArray:
        """The square root of the paper's least distance over the sum of weights: an average distance."""
        clouds = normalised(drawings)
        kinds = int(self.labels.max()) + 1
        least = _nearest(clouds, _tables(clouds), self.templates, self.tables, self.labels, kinds)
        return np.sqrt(least / (POINTS * (POINTS + 1) / 2)) / RANGE


def normalised(drawings: Sequence[Ink]) -> Cells:
    """Clouds of one size about the middle of the table, (B, 32, 2) whole numbers."""
    points = as_cloud(drawings, POINTS)
    sized = centred(points / positive(box_sides(points).max(axis=1))[:, None, None])
    # About its centroid a cloud of size 1 may reach from −1 to 1: half the range holds it.
    return np.clip(np.rint((sized / 2 + 0.5) * (RANGE - 1)), 0, RANGE - 1).astype(np.int64)


@kernel
def _tables(clouds: Cells) -> Tables:
    tables = np.empty((len(clouds), GRID, GRID), dtype=np.uint8)
    for c in range(len(clouds)):
        for column in range(GRID):
            for row in range(GRID):
                least = 4 * RANGE * RANGE
                for k in range(POINTS):
                    dx = clouds[c, k, 0] // CELL - column
                    dy = clouds[c, k, 1] // CELL - row
                    apart = dx * dx + dy * dy
                    if apart < least:
                        least = apart
                        tables[c, column, row] = k
    return tables


@kernel
def _nearest(
    clouds: Cells, tables: Tables, templates: Cells, template_tables: Tables, labels: IntArray, kinds: int
) -> FloatArray:
    found = np.full((len(clouds), kinds), np.inf)
    for i in range(len(clouds)):
        for j in range(len(templates)):
            best = found[i, labels[j]]
            there = _bounds(clouds[i], templates[j], template_tables[j])
            back = _bounds(templates[j], clouds[i], tables[i])
            for which in range(len(there)):
                if there[which] < best:
                    best = min(best, _given(clouds[i], templates[j], which * STRIDE, best))
                if back[which] < best:
                    best = min(best, _given(templates[j], clouds[i], which * STRIDE, best))
            found[i, labels[j]] = best
    return found


@kernel
def _bounds(cloud: Cells, other: Cells, table: Tables) -> FloatArray:
    """What giving costs at least, for every starting point: each point to the one its cell names."""
    so_far = np.empty(POINTS)
    first, running = 0.0, 0.0
    for k in range(POINTS):
        nearest = table[cloud[k, 0] // CELL, cloud[k, 1] // CELL]
        dx, dy = other[nearest, 0] - cloud[k, 0], other[nearest, 1] - cloud[k, 1]
        running += dx * dx + dy * dy
        so_far[k] = running
        first += (POINTS - k) * (dx * dx + dy * dy)
    bounds = np.empty((POINTS + STRIDE - 1) // STRIDE)
    bounds[0] = first
    for which in range(1, len(bounds)):
        start = which * STRIDE
        # Starting later, every point weighs `start` more, and those before the start `n` less.
        bounds[which] = first + start * so_far[-1] - POINTS * so_far[start - 1]
    return bounds


@kernel
def _given(cloud: Cells, other: Cells, start: int, enough: float) -> float:
    """Weighted squared distance of points given from `start` on; stops where it reaches `enough`."""
    xs, ys = other[:, 0].copy(), other[:, 1].copy()  # those still free come first
    total = 0.0
    for rank in range(POINTS):
        at = start + rank if start + rank < POINTS else start + rank - POINTS
        x, y = cloud[at, 0], cloud[at, 1]
        least, taken = 4 * RANGE * RANGE, 0
        for place in range(POINTS - rank):
            dx, dy = xs[place] - x, ys[place] - y
            apart = dx * dx + dy * dy
            if apart < least:
                least, taken = apart, place
        last = POINTS - rank - 1
        xs[taken], ys[taken] = xs[last], ys[last]
        total += (POINTS - rank) * least
        if total >= enough:
            break
    return total
