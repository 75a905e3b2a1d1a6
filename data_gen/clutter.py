"""What stands on a page and is nobody's: stray marks, and a sign that was crossed out.

Frame: page units, y down, each piece about the origin until it is put somewhere. A stray mark belongs to nothing in
the truth, and so does a crossed-out sign; the scribble over it is the gesture "scribble".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from data_gen.glyphs import alphabet
from data_gen.strokes import Recipe, meant
from sketch.geometry import bounding_box
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class ClutterRule:
    """How much clutter a cluttered page bears."""

    most: int = 3
    """Pieces at most, at least one."""
    crossed: float = 0.5
    """Share of pieces that are crossed-out signs; the rest are stray marks."""
    size: tuple[float, float] = (0.6, 1.8)
    """Size of a piece, heights of a capital letter."""
    beyond: tuple[float, float] = (1.1, 1.5)
    """How far a crossing-out reaches, over the size of what it covers."""


RULE = ClutterRule()
IN_ONE = Recipe(without=("several_strokes", "broken"))
"""A crossing-out is one stroke."""


@dataclass(frozen=True, slots=True, eq=False)
class Clutter:
    """paths: strokes in drawing order, each (n, 2); crossed: the last one is a scribble over the others."""

    paths: Sequence[FloatArray]
    crossed: bool


def clutter(letter: float, rng: np.random.Generator) -> list[Clutter]:
    """The pieces of a page; letter: height of a capital, page units."""
    return [_piece(letter, rng) for _ in range(int(rng.integers(1, RULE.most + 1)))]


def _piece(letter: float, rng: np.random.Generator) -> Clutter:
    crossed = bool(rng.random() < RULE.crossed)
    names = alphabet.symbols() if crossed else alphabet.marks()
    name = names[int(rng.integers(len(names)))]
    size = letter * float(rng.uniform(*RULE.size))
    ways = alphabet.strokes(name, int(rng.integers(alphabet.variants(name))))
    paths = _sized(ways, size)
    if not crossed:
        return Clutter(paths, False)
    (scribble,), _ = meant("scribble", int(rng.integers(1 << 31)), recipe=IN_ONE)
    reach = float(rng.uniform(*RULE.beyond)) * max(size, letter)
    return Clutter([*paths, *_sized([scribble], reach)], True)


def _sized(paths: Sequence[FloatArray], size: float) -> list[FloatArray]:
    """The paths together so large about the origin; a single dot stays one."""
    low, high = bounding_box(np.concatenate(paths))
    factor = size / max(float(np.max(high - low)), 1e-9) if np.any(high > low) else 1.0
    return [(path - (low + high) / 2) * factor for path in paths]
