"""Single strokes of letters and marks: which of them are still mathematics when they stand alone.

A bar, a ring or a triangle alone is a wire, a circle or a polygon, whatever letter it was taken
from. Frame: y down; strokes about one unit large about their middle, those of `all` a tenth of the
authored size (a capital is one unit high).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Literal

import numpy as np

from data_gen.glyphs import alphabet
from data_gen.hand.signs import Glyphs, Pools
from sketch.geometry import closure, path_length
from sketch.ink import FloatArray

Pool = Literal["symbols", "marks", "round letters", "all"]
"""All symbols or all other marks, as far as they are mathematics when alone; letters without rows of legs,
which words are made of; and every stroke of every symbol but its dots, for formulas."""

STRAIGHT = 0.93
"""A stroke whose chord is more of its length than this is a wire when alone."""
SMALL = 2.5
"""A stroke shorter than this (a capital is 10 high) is a dot or a dash when alone."""
DOT = 1.0
"""A stroke no longer than this is a dot, which no eye tells from a tap: where it stands must decide."""
RING = 0.1
"""The ring of θ, φ or Q closes within this fraction of its length, and is a circle when alone."""

ARROWS = frozenset({r"\rightarrow", r"\Delta", r"\cdot", r"\ldots"})
"""Signs of several strokes that are no mathematics when they stand alone."""
OTHERS = frozenset({"0", "o", "O", r"\Delta", ".", r"\cdot", r"\ldots"})
"""Symbols that are a circle, a polygon or a tap when they stand alone."""


@cache
def pools() -> Pools:
    """The tables that the kernels pick from; frequent symbols stand in them several times."""
    return Pools(
        _table(_singles("symbols")),
        _table(_singles("marks")),
        _table(_singles("round letters")),
        _table(_singles("all")),
        _table(_whole()),
    )


Way = tuple[FloatArray, ...]
"""The strokes of one way of writing a sign."""


def _table(signs: Sequence[tuple[Way, ...]]) -> Glyphs:
    ways = [way for sign in signs for way in sign]
    strokes = [stroke for way in ways for stroke in way]
    return Glyphs(
        np.concatenate(strokes),
        np.cumsum([len(stroke) for stroke in strokes]),
        np.cumsum([len(way) for way in ways]),
        np.cumsum([len(sign) for sign in signs]),
    )


def _singles(pool: Pool) -> list[tuple[Way, ...]]:
    names = {
        "symbols": alphabet.symbols(),
        "marks": alphabet.marks(),
        "round letters": tuple("abcdeghloqsz"),
        "all": alphabet.symbols(),
    }[pool]
    found = [(_weight(name), tuple((stroke,) for stroke in _strokes(name, pool))) for name in names]
    return [ways for weight, ways in found if ways for _ in range(weight)]


def _whole() -> list[tuple[Way, ...]]:
    """Signs of several strokes, about one unit large about their middle."""
    found: list[tuple[Way, ...]] = []
    for name in alphabet.symbols() + alphabet.marks():
        ways = [alphabet.strokes(name, variant) for variant in range(alphabet.variants(name))]
        several = tuple(_centred(way) for way in ways if len(way) > 1 and name not in ARROWS)
        found += [several] * _weight(name) if several else []
    return found


def _centred(way: Way) -> Way:
    every = np.concatenate(way)
    low, high = every.min(axis=0), every.max(axis=0)
    size = float((high - low).max())
    return tuple((stroke - (low + high) / 2) / size for stroke in way)


def _weight(name: str) -> int:
    """How often a symbol is drawn against the others: digits and braces are met most, and are nearest to other kinds."""
    return 5 if name.startswith("brace") else 3 if name.isdigit() else 1


def _strokes(name: str, pool: Pool) -> tuple[FloatArray, ...]:
    every = [
        stroke for variant in range(alphabet.variants(name)) for stroke in alphabet.strokes(name, variant)
    ]
    if pool == "all":
        return tuple(stroke / 10 for stroke in every if path_length(stroke) > DOT)
    kept: Sequence[FloatArray] = [stroke for stroke in every if not _component_like(name, stroke)]
    if pool == "round letters":
        return tuple(stroke / 10 for stroke in kept)
    return tuple((stroke - stroke.mean(axis=0)) / np.ptp(stroke, axis=0).max() for stroke in kept)


def _component_like(name: str, stroke: FloatArray) -> bool:
    ring = name in {r"\theta", r"\phi", "Q"} and closure(stroke) < RING
    return name in OTHERS or path_length(stroke) < SMALL or ring or closure(stroke) > STRAIGHT
