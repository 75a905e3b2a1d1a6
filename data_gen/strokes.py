"""Single drawings with truth: what kind was meant, and the ink that a random writer made of it.

Item i of a seed depends on (seed, i) alone, to the bit, however many are made at once and whichever
processes make them. Frame: page units, y down; seconds.

`items` gives drawings in one or several strokes (a box in four, an arrow in two, a sign of mathematics with
all its strokes); `generate` gives drawings in one stroke alone, which is what stroke classifiers are
compared on; `doodles` gives ink that is none of the kinds.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from data_gen.glyphs.lone import pools
from data_gen.hand import doodles as scrawl
from data_gen.hand import item
from data_gen.hand.batch import PART, Drawings
from data_gen.hand.doodles import DOODLES
from data_gen.hand.names import Mask, mask
from data_gen.hand.pen import ink_of
from data_gen.writers import population
from sketch.ink import FloatArray, Stroke, readonly
from sketch.page import STROKE_KINDS, StrokeKind

BATCH = 512
"""Items made by one call of the kernel: large enough to amortise it, small enough for the cache."""

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


@dataclass(frozen=True, slots=True)
class LabelledItem:
    """kind: what was meant, None for a doodle; strokes: what the pen did, in order, times running on;
    index: its number under the seed; count: corners of a polygon, legs of a zig-zag, minus the loops of a
    coil, strokes meant of an arrow, a ring, a dashed line or a sign, the number in `DOODLES` of a doodle."""

    kind: StrokeKind | None
    strokes: tuple[Stroke, ...]
    index: int
    count: int

    @property
    def form(self) -> str:
        """What the count says, in words."""
        match self.kind:
            case None:
                return DOODLES[self.count]
            case "polygon":
                return f"{self.count} corners"
            case "spring":
                return f"{self.count} legs" if self.count > 0 else f"{-self.count} loops"
            case _:
                return f"{self.count} strokes meant"


@dataclass(frozen=True, slots=True)
class Recipe:
    """Whose ink is made, and with which variations.

    without: names of `data_gen.hand.names.VARIATIONS` that are left out; profile: one of
    `data_gen.writers.PROFILES`, None for everybody in their shares.
    Raises ValueError on names that are none.
    """

    without: tuple[str, ...] = ()
    profile: str | None = None

    def __post_init__(self) -> None:
        mask(*self.without)
        population(self.profile)


EVERYBODY = Recipe()


def items(
    count: int,
    seed: int,
    start: int = 0,
    mix: Mapping[StrokeKind, float] = EQUAL,
    recipe: Recipe = EVERYBODY,
) -> list[LabelledItem]:
    """Items start … start + count − 1 of a seed, in one stroke or several. `mix` gives the shares of the kinds; a
    different mix is a different corpus. Leaving a variation out changes nothing that others do.

    Raises ValueError on a negative count, start or seed, or shares that do not sum to 1.
    """
    return list(_stream(count, seed, start, _cumulative(mix), recipe))


def generate(
    count: int,
    seed: int,
    start: int = 0,
    mix: Mapping[StrokeKind, float] = EQUAL,
    recipe: Recipe = EVERYBODY,
) -> list[LabelledStroke]:
    """The same, all of them drawn in one stroke."""
    return list(stream(count, seed, start, mix, recipe))


def stream(
    count: int,
    seed: int,
    start: int = 0,
    mix: Mapping[StrokeKind, float] = EQUAL,
    recipe: Recipe = EVERYBODY,
) -> Iterator[LabelledStroke]:
    """The same as `generate`, a batch at a time in memory."""
    shares = _cumulative(mix)
    _checked(count, seed, start)
    return _singles(count, seed, start, shares, recipe)


def formula_strokes(
    count: int, seed: int, start: int = 0, recipe: Recipe = EVERYBODY
) -> list[LabelledStroke]:
    """Strokes as they stand inside formulas: bars and rings too, all of them mathematics.

    They need their neighbours to be read; `generate` leaves them out of "math" for that reason.
    """
    return list(_singles(count, seed, start, _only(PART), recipe))


def doodles(count: int, seed: int, start: int = 0, recipe: Recipe = EVERYBODY) -> list[LabelledItem]:
    """Ink that is none of the kinds: hearts, clouds, signatures, stick figures, knots … (`DOODLES`)."""
    _checked(count, seed, start)
    shares, groups = population(recipe.profile)
    on = mask(*recipe.without)
    if count == 0:
        return []
    made = scrawl.drawings(np.uint64(seed), start, count, shares, groups, on, pools())
    return list(_inked(start, made, on))


def meant(
    kind: StrokeKind, seed: int, index: int = 0, recipe: Recipe = EVERYBODY
) -> tuple[tuple[FloatArray, ...], int]:
    """The ideal drawing of a kind, before any hand or page: paths (n, 2), one unit large, and its count."""
    shares, groups = population(recipe.profile)
    only, on = _only(STROKE_KINDS.index(kind)), mask(*recipe.without)
    made = item.drawings(np.uint64(seed), index, 1, only, shares, groups, on, pools(), False)
    ends = made.ends[: made.items[-1]]
    return tuple(np.split(made.points[: ends[-1]], ends[:-1])), int(made.labels[0, 1])


def _singles(
    count: int, seed: int, start: int, cumulative: FloatArray, recipe: Recipe
) -> Iterator[LabelledStroke]:
    alone = Recipe((*recipe.without, "several_strokes", "broken"), recipe.profile)
    for made in _stream(count, seed, start, cumulative, alone):
        assert made.kind is not None
        yield LabelledStroke(made.kind, made.strokes[0], made.index)


def _stream(
    count: int, seed: int, start: int, cumulative: FloatArray, recipe: Recipe
) -> Iterator[LabelledItem]:
    _checked(count, seed, start)
    shares, groups = population(recipe.profile)
    on, tables = mask(*recipe.without), pools()
    for first in range(start, start + count, BATCH):
        size = min(BATCH, start + count - first)
        made = item.drawings(np.uint64(seed), first, size, cumulative, shares, groups, on, tables, True)
        yield from _inked(first, made, on)


def _inked(first: int, made: Drawings, on: Mask) -> Iterator[LabelledItem]:
    """The drawings with their ink, as values; strokes own their points, so that a kept one does not keep its batch."""
    points, times, pressure, used = ink_of(
        made.points,
        made.ends[: made.items[-1]],
        made.items,
        made.frames,
        made.habits,
        made.keys,
        made.thin,
        on,
    )
    ends = used.tolist()
    stroke = at = 0
    for offset, (last, (kind, count), (timed, pressed)) in enumerate(
        zip(made.items.tolist(), made.labels.tolist(), made.known.tolist(), strict=True)
    ):
        strokes: list[Stroke] = []
        while stroke < last:
            end = ends[stroke]
            strokes.append(
                Stroke.trusted(
                    points[at:end].copy(),
                    times[at:end].copy() if timed else None,
                    pressure[at:end].copy() if pressed else None,
                )
            )
            at, stroke = end, stroke + 1
        yield LabelledItem(_KINDS[kind], tuple(strokes), first + offset, count)


_KINDS: tuple[StrokeKind | None, ...] = (*STROKE_KINDS, None, "math")
"""Labels of the kernels' kinds: those of the page, doodles, strokes inside formulas."""


def _checked(count: int, seed: int, start: int) -> None:
    if count < 0 or start < 0 or seed < 0:
        raise ValueError(f"count {count}, start {start} and seed {seed}: all must be zero or more")


def _cumulative(mix: Mapping[StrokeKind, float]) -> FloatArray:
    shares = np.array([mix.get(kind, 0.0) for kind in STROKE_KINDS])
    if abs(shares.sum() - 1) > 1e-9 or shares.min() < 0:
        raise ValueError(
            f"the shares of the kinds sum to {shares.sum():g}; they must be positive and sum to 1"
        )
    return readonly(np.cumsum(shares))


def _only(kind: int) -> FloatArray:
    """Cumulative shares that give all to one of the kernels' kinds."""
    return readonly(np.arange(len(_KINDS)) >= kind)
