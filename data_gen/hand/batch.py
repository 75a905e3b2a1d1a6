"""A batch of drawings on its way from what is meant to ink."""

from __future__ import annotations

from math import hypot
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from data_gen.hand.chance import Key, split, uniform
from data_gen.hand.jit import part
from data_gen.hand.names import MISSING, SPARSE
from data_gen.hand.person import GRID, HOOKED, NOISE, UNPRESSED, UNTIMED, WOBBLING
from sketch.ink import FloatArray

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

CIRCLE, POLYGON, SPRING, WIRE, ARROW, TAP, SCRIBBLE, LASSO, MATH, DOODLE, PART = range(11)
"""Kinds in the order of `sketch.page.STROKE_KINDS`; none of them; a stroke inside a formula."""

TAP_GRID = 0.5
"""A resting pen's points are at least this coarse, page units, on a device that reports no smaller move,"""
RESTING = 0.6
"""and this share of taps comes from such a device; the others tremble from point to point."""
LOOSE = 0.8
"""Letters waver this much of what shapes do, against their size: they are practised."""
ROUND = 1.35
"""A pen wavers this much more on its way around a closed shape: it is the longest way to keep in mind."""
STRAIGHT = 0.35
"""A pen wavers this much less along one straight line: the simplest movement is the steadiest."""
THIN = (0.2, 0.05, 0.02, 0.04, 0.04, 0.6, 0.0, 0.03, 0.03, 0.03, 0.0)
"""Share of single strokes of a kind that a busy device sees at a few points only."""
REST = 1005
"""The name under which a tap's device is split off."""


class Drawings(NamedTuple):
    """points (P, 2), page units; ends (S,): where each stroke ends among the points; items (N,): where each
    drawing ends among the strokes; labels (N, 2): kind and count; habits (N, habits); keys (N,); frames (N, 4):
    low x, low y, high x, high y; thin (N,): how few points are seen, see `pen`; known (N, 2): whether times, pressure are."""

    points: FloatArray
    ends: Indices
    items: Indices
    labels: Indices
    habits: FloatArray
    keys: NDArray[np.uint64]
    frames: FloatArray
    thin: Indices
    known: Mask


@part
def blank(count: int, habits: int) -> Drawings:
    """Room for a number of drawings."""
    return Drawings(
        np.empty((100 * count + 100, 2)),
        np.empty(4 * count + 64, dtype=np.int64),
        np.zeros(count, dtype=np.int64),
        np.zeros((count, 2), dtype=np.int64),
        np.zeros((count, habits)),
        np.zeros(count, dtype=np.uint64),
        np.zeros((count, 4)),
        np.zeros(count, dtype=np.int64),
        np.ones((count, 2), dtype=np.bool_),
    )


@part
def put(
    batch: Drawings,
    number: int,
    kind: int,
    detail: int,
    key: Key,
    habits: FloatArray,
    path: FloatArray,
    path_ends: Indices,
    on: Mask,
) -> Drawings:
    """The batch with drawing `number`, which must be the next one."""
    strokes = batch.items[number - 1] if number > 0 else 0
    at = batch.ends[strokes - 1] if strokes > 0 else 0
    points, ends = batch.points, batch.ends
    if at + len(path) > len(points) or strokes + len(path_ends) > len(ends):
        points, ends = np.empty((2 * (at + len(path)), 2)), np.empty(2 * (strokes + len(path_ends)), np.int64)
        for k in range(at):
            points[k, 0], points[k, 1] = batch.points[k, 0], batch.points[k, 1]
        for k in range(strokes):
            ends[k] = batch.ends[k]
    for k in range(len(path)):
        points[at + k, 0], points[at + k, 1] = path[k, 0], path[k, 1]
    for k in range(len(path_ends)):
        ends[strokes + k] = at + path_ends[k]
    batch.items[number] = strokes + len(path_ends)
    batch.labels[number, 0], batch.labels[number, 1] = kind, detail
    batch.keys[number] = key
    set_frame(path, batch.frames[number])
    _settle(kind, key, batch.frames[number], habits)
    for k in range(len(habits)):
        batch.habits[number, k] = habits[k]
    if on[MISSING]:
        batch.known[number, 0], batch.known[number, 1] = habits[UNTIMED] <= 0, habits[UNPRESSED] <= 0
    single = len(path_ends) == 1
    if on[SPARSE] and single and uniform(split(key, SPARSE)) < THIN[kind]:
        batch.thin[number] = 3 if kind == TAP else 1
        if kind == TAP:
            batch.habits[number, NOISE] = batch.habits[number, WOBBLING] = 0.0
    return Drawings(
        points,
        ends,
        batch.items,
        batch.labels,
        batch.habits,
        batch.keys,
        batch.frames,
        batch.thin,
        batch.known,
    )


@part
def set_frame(points: FloatArray, frame: FloatArray) -> None:
    frame[0] = frame[1] = np.inf
    frame[2] = frame[3] = -np.inf
    for k in range(len(points)):
        for axis in range(2):
            frame[axis] = min(frame[axis], points[k, axis])
            frame[2 + axis] = max(frame[2 + axis], points[k, axis])


@part
def _settle(kind: int, key: Key, frame: FloatArray, habits: FloatArray) -> None:
    """Fits the habits to the drawing. Letters and lines waver less; so does a pen along polygons that are thin, since
    the eye sees both of their long sides; a tap has no hooks, and rests."""
    if kind in (MATH, PART, DOODLE):
        habits[WOBBLING] *= LOOSE
    elif kind == CIRCLE:
        habits[WOBBLING] *= ROUND
    elif kind == POLYGON:
        width, height = frame[2] - frame[0], frame[3] - frame[1]
        habits[WOBBLING] *= ROUND * min(1.0, (2 * width * height) ** 0.5 / max(hypot(width, height), 1e-9))
    elif kind == WIRE:
        habits[WOBBLING] *= STRAIGHT
    elif kind == TAP:
        habits[HOOKED] = 0.0
        if uniform(split(key, REST)) < RESTING:
            habits[NOISE] = 0.0
            habits[GRID] = max(habits[GRID], TAP_GRID)
