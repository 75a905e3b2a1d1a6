"""Single strokes with truth: what kind was meant, and the ink that a random writer made of it.

Stroke i of a seed depends on (seed, i) alone, to the bit, however many are made at once.
Frame: page units, y down.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import hypot

import numpy as np

from data_gen.families import FAMILIES, letter_part
from data_gen.pen import draw_batch, strokes_from
from data_gen.writers import Writer, sample_writer
from sketch.ink import FloatArray, Stroke
from sketch.page import STROKE_KINDS, StrokeKind


@dataclass(frozen=True, slots=True)
class StrokeRule:
    """Sizes and shares of single strokes."""

    batch: int = 512
    """Strokes drawn at once: large enough to amortise calls, small enough for the cache."""
    size: tuple[float, float] = (30.0, 420.0)
    """Log-uniform range of a stroke's size, page units; with the pixel grid it sets how coarse ink is."""
    tap_size: tuple[float, float] = (0.3, 3.0)
    """The same for taps: a resting hand moves by a pixel or two."""
    tap_grid: float = 0.5
    """A resting pen's points are at least this coarse, page units, on a device that reports no smaller move,"""
    resting: float = 0.5
    """and this share of taps comes from such a device; the others tremble from point to point."""
    loose: float = 1.5
    """Letters waver this much more than shapes, against their size: they are small and quick."""


RULE = StrokeRule()

MIX: Mapping[StrokeKind, float] = {
    "circle": 0.15,
    "polygon": 0.15,
    "spring": 0.15,
    "wire": 0.13,
    "arrow": 0.09,
    "tap": 0.06,
    "scribble": 0.04,
    "lasso": 0.04,
    "math": 0.19,
}
"""Shares of the kinds: what needs variety most, most. Suites draw them equally instead."""

EQUAL: Mapping[StrokeKind, float] = dict.fromkeys(STROKE_KINDS, 1 / len(STROKE_KINDS))


@dataclass(frozen=True, slots=True)
class LabelledStroke:
    """kind: what was meant; stroke: what the pen did; index: its number under the seed."""

    kind: StrokeKind
    stroke: Stroke
    index: int


def generate(
    count: int, seed: int, start: int = 0, mix: Mapping[StrokeKind, float] = EQUAL
) -> list[LabelledStroke]:
    """Strokes start … start + count − 1 of a seed. `mix` gives the shares of the kinds; a different mix
    is a different corpus. Raises ValueError on a negative count or start, or shares that do not sum to 1."""
    return list(stream(count, seed, start, mix))


def stream(
    count: int, seed: int, start: int = 0, mix: Mapping[StrokeKind, float] = EQUAL
) -> Iterator[LabelledStroke]:
    """The same as `generate`, a batch at a time in memory."""
    if count < 0 or start < 0:
        raise ValueError(f"count {count} and start {start}: both must be zero or more")
    shares = np.array([mix.get(kind, 0.0) for kind in STROKE_KINDS])
    if abs(shares.sum() - 1) > 1e-9 or shares.min() < 0:
        raise ValueError(
            f"the shares of the kinds sum to {shares.sum():g}; they must be positive and sum to 1"
        )
    for first in range(start, start + count, RULE.batch):
        indices = range(first, min(first + RULE.batch, start + count))
        yield from _batch(seed, indices, np.cumsum(shares).tolist())


def _batch(seed: int, indices: Sequence[int], cumulative: list[float]) -> list[LabelledStroke]:
    rngs = [np.random.default_rng([seed, index]) for index in indices]
    meant = [_meant(rng, cumulative) for rng in rngs]
    batch = draw_batch([path for _, path, _ in meant], [writer for _, _, writer in meant], rngs)
    return [
        LabelledStroke(kind, stroke, index)
        for (kind, _, _), stroke, index in zip(meant, strokes_from(batch), indices, strict=True)
    ]


def _meant(rng: np.random.Generator, cumulative: list[float]) -> tuple[StrokeKind, FloatArray, Writer]:
    """A kind, a path of that kind at its place and size, and the writer who will draw it."""
    u, large, x, y = rng.random(4).tolist()
    kind = STROKE_KINDS[min(bisect_right(cumulative, u), len(STROKE_KINDS) - 1)]
    writer = sample_writer(rng)
    path = FAMILIES[kind](rng)
    low, high = RULE.size
    if kind == "tap":
        low, high = RULE.tap_size
        coarse = RULE.tap_grid if float(rng.random()) < RULE.resting else 0.0
        writer = replace(writer, hooks=0.0, grid=max(writer.grid, coarse))
    elif kind == "math":
        writer = replace(writer, wobble=RULE.loose * writer.wobble)
    elif kind == "polygon":
        writer = replace(writer, wobble=_steadied(path) * writer.wobble)
    size = low * (high / low) ** large
    return kind, size * path + (500.0 * x, 500.0 * y), writer


def _steadied(path: FloatArray) -> float:
    """How much less a pen wavers along a polygon that is thin: the eye sees both of its long sides."""
    width, height = np.ptp(path, axis=0).tolist()
    return min(1.0, (2 * width * height) ** 0.5 / hypot(width, height))


def formula_strokes(count: int, seed: int, start: int = 0) -> list[LabelledStroke]:
    """Strokes as they stand inside formulas: bars and rings too, all of them mathematics.

    They need their neighbours to be read; `generate` leaves them out of "math" for that reason.
    """
    made: list[LabelledStroke] = []
    for first in range(start, start + count, RULE.batch):
        indices = range(first, min(first + RULE.batch, start + count))
        rngs = [np.random.default_rng([seed, index]) for index in indices]
        writers = [sample_writer(rng) for rng in rngs]
        paths = [writer.height * letter_part(rng) for writer, rng in zip(writers, rngs, strict=True)]
        loose = [replace(writer, wobble=RULE.loose * writer.wobble) for writer in writers]
        strokes = strokes_from(draw_batch(paths, loose, rngs))
        made += [
            LabelledStroke("math", stroke, index) for stroke, index in zip(strokes, indices, strict=True)
        ]
    return made
