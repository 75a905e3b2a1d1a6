"""Ink along given paths: many strokes at once, each by its writer and from its own key.

Frame: page units, y down; seconds. The motion itself is in `data_gen.hand`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from data_gen.hand.names import Mask, mask
from data_gen.hand.pen import ink_of
from data_gen.writers import Writer, habits_of
from sketch.ink import FloatArray, Stroke

EVERY = mask()


def draw(
    paths: Sequence[FloatArray], writer: Writer, rng: np.random.Generator, on: Mask = EVERY
) -> list[Stroke]:
    """Draws each path, (n, 2) page units, as one stroke of one writer; times start at 0 in each."""
    return draw_each(paths, [writer] * len(paths), rng, on)


def draw_each(
    paths: Sequence[FloatArray], writers: Sequence[Writer], rng: np.random.Generator, on: Mask = EVERY
) -> list[Stroke]:
    """Draws path k, (n, 2) page units, by writer k; on: which variations are (`data_gen.hand.names.mask`)."""
    if not paths:
        return []
    keys = rng.integers(1 << 55, size=len(paths)).astype(np.uint64) << np.uint64(8)
    points, times, pressure, used = ink_of(
        np.ascontiguousarray(np.concatenate(paths), dtype=float),
        np.cumsum([len(path) for path in paths]),
        np.arange(1, len(paths) + 1),
        np.array([np.concatenate([path.min(axis=0), path.max(axis=0)]) for path in paths]),
        habits_of(writers),
        keys,
        np.zeros(len(paths), dtype=np.int64),
        on,
    )
    return [
        Stroke.trusted(points[a:b].copy(), times[a:b].copy(), pressure[a:b].copy())
        for a, b in zip([0, *used.tolist()], used.tolist(), strict=False)
    ]
