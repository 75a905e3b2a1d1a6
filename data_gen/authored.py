"""Drawings that are authored in Python, by writers drawn at random: for the net to learn from, beside what `strokes` draws.

Nothing here is part of a suite, so that families may be added without changing what others were measured on. Item i of a seed
depends on (seed, i) alone. Frame: page units, y down; seconds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from data_gen.flow_arrows import flow_arrow
from data_gen.hand.doodles import DOODLES
from data_gen.hand.item import SIZE
from data_gen.hand.names import mask
from data_gen.hand.pen import ink_of
from data_gen.oddities import ODDITIES
from data_gen.strokes import EVERYBODY, LabelledItem, Recipe
from data_gen.writers import habits_of, sample_writer
from sketch.ink import FloatArray, Stroke
from sketch.page import StrokeKind

NAMES = (*DOODLES, *ODDITIES)
"""All families of ink that is none of the kinds, in the order of their numbers."""
SIGNS: Mapping[str, tuple[tuple[tuple[float, float], ...], ...]] = {
    "star of two triangles": (
        ((0.0, -1.0), (0.9, 0.5), (-0.9, 0.5), (0.0, -1.0)),
        ((0.0, 1.0), (0.9, -0.5), (-0.9, -0.5), (0.0, 1.0)),
    ),
    "N of three strokes": (
        ((-0.6, 1.0), (-0.6, -1.0)),
        ((-0.6, -1.0), (0.6, 1.0)),
        ((0.6, 1.0), (0.6, -1.0)),
    ),
    "N of two strokes": (((-0.6, -1.0), (-0.6, 1.0)), ((-0.6, -1.0), (0.6, 1.0), (0.6, -1.0))),
}
"""Signs whose strokes are those of other kinds, by their corners."""
ASTRAY = 0.08
"""Standard deviation of the corners of such a sign."""


def oddities(count: int, seed: int, start: int = 0, recipe: Recipe = EVERYBODY) -> list[LabelledItem]:
    """Ink that is none of the kinds, of the families in `ODDITIES`; an item's count is its place in `NAMES`."""
    names = tuple(ODDITIES)
    found: list[LabelledItem] = []
    for index in range(start, start + count):
        rng = np.random.default_rng([seed, index, 19])
        which = int(rng.integers(len(names)))
        paths = ODDITIES[names[which]](rng)
        if rng.random() < 0.5:
            paths = [path * [-1.0, 1.0] for path in paths]
        angle = 0.15 * rng.standard_normal() if rng.random() < 0.8 else rng.uniform(-np.pi, np.pi)
        paths = [path[::-1] if rng.random() < 0.4 else path for path in paths]
        found.append(_item(None, paths, float(angle), len(DOODLES) + which, index, rng, recipe))
    return found


def flow_arrows(count: int, seed: int, start: int = 0, recipe: Recipe = EVERYBODY) -> list[LabelledItem]:
    """Arrows as in `data_gen.flow_arrows`; an item's count is its number of strokes."""
    found: list[LabelledItem] = []
    for index in range(start, start + count):
        rng = np.random.default_rng([seed, index, 23])
        paths = flow_arrow(rng)
        found.append(_item("arrow", paths, 0.05 * rng.standard_normal(), len(paths), index, rng, recipe))
    return found


def signs(count: int, seed: int, start: int = 0, recipe: Recipe = EVERYBODY) -> list[LabelledItem]:
    """Mathematics as in `SIGNS`, its strokes in any order; an item's count is its number of strokes."""
    names = tuple(SIGNS)
    found: list[LabelledItem] = []
    for index in range(start, start + count):
        rng = np.random.default_rng([seed, index, 29])
        meant = [np.array(corners) for corners in SIGNS[names[int(rng.integers(len(names)))]]]
        paths = [meant[k] + ASTRAY * rng.standard_normal(meant[k].shape) for k in rng.permutation(len(meant))]
        paths = [path[::-1] if rng.random() < 0.4 else path for path in paths]
        found.append(_item("math", paths, 0.07 * rng.standard_normal(), len(paths), index, rng, recipe))
    return found


def _item(
    kind: StrokeKind | None,
    paths: Sequence[FloatArray],
    angle: float,
    count: int,
    index: int,
    rng: np.random.Generator,
    recipe: Recipe,
) -> LabelledItem:
    """The paths turned, at a random size and place, drawn by somebody."""
    every = np.concatenate(paths)
    low, high = every.min(axis=0), every.max(axis=0)
    size = SIZE[0] * (SIZE[1] / SIZE[0]) ** rng.random() / max(float(np.hypot(*(high - low))), 1e-9)
    c, s = size * np.cos(angle), size * np.sin(angle)
    place = np.array([[c, s], [-s, c]]), rng.uniform(0.0, 500.0, 2)
    placed = [(path - (low + high) / 2) @ place[0] + place[1] for path in paths]
    every = np.concatenate(placed)
    writer = sample_writer(rng, recipe.profile)
    points, times, pressure, used = ink_of(
        np.ascontiguousarray(every),
        np.cumsum([len(path) for path in placed]),
        np.array([len(placed)]),
        np.concatenate([every.min(axis=0), every.max(axis=0)])[None],
        habits_of([writer]),
        rng.integers(1 << 55, size=1).astype(np.uint64) << np.uint64(8),
        np.zeros(1, dtype=np.int64),
        mask(*recipe.without),
    )
    timed, pressed = writer.untimed <= 0, writer.unpressed <= 0
    strokes = tuple(
        Stroke.trusted(
            points[a:b].copy(),
            times[a:b].copy() if timed else None,
            pressure[a:b].copy() if pressed else None,
        )
        for a, b in zip([0, *used.tolist()], used.tolist(), strict=False)
    )
    return LabelledItem(kind, strokes, index, count)
