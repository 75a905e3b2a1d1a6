"""Handwritten symbols as strokes, authored here: the allographs of mathematics, and other marks.

Frame: a box about 10 units high, y down, the baseline of most letters at y = 10.

The files hold, for each symbol, its ways of being written ("allographs"), one string each: how often it
is met with beside the others and "|" where that is not once, and its strokes, split by "/", points "x y" by ",", and "*" after a point marks a sharp corner.
Between corners a stroke follows a Catmull-Rom curve through its points (Catmull and Rom 1974,
uniform parametrisation).
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from importlib import resources
from itertools import pairwise

import numpy as np

from sketch.ink import FloatArray, readonly

Knots = tuple[FloatArray, tuple[int, ...]]
"""A stroke before it is a curve: the points that `curve` goes through, (n, 2), and which of them are corners."""

STEPS = 8
"""Points put between two authored ones: the chord error of a half circle stays below 1 %."""


def symbols() -> tuple[str, ...]:
    """The symbols of mathematics that can be written, Greek ones as LaTeX commands."""
    return tuple(_parsed("allographs.json"))


def marks() -> tuple[str, ...]:
    """Other marks that people draw and that are no component: braces, checks, stars, curls."""
    return tuple(_parsed("marks.json"))


def variants(symbol: str) -> int:
    """In how many ways the symbol (or mark) can be written. Raises KeyError when it cannot."""
    return len(_ways(symbol))


def strokes(symbol: str, variant: int = 0) -> tuple[FloatArray, ...]:
    """The strokes of one way (modulo their number) of writing a symbol or mark, each (n, 2).

    Raises KeyError when the symbol cannot be written; `symbols()` and `marks()` list what can.
    """
    ways = _ways(symbol)
    return ways[variant % len(ways)]


_ALIKE = {"\\vec": "\\rightarrow", "\\hat": "\\hat"}
"""Signs of mathematics whose glyphs stand under another name."""


@cache
def styles(sign: str) -> tuple[tuple[Knots, ...], ...]:
    """All ways of writing a sign of mathematics (`sketch.writing.signs`), those of `symbols()` and further ones,
    each the knots of its strokes. Raises KeyError when it cannot be written."""
    name = _ALIKE.get(sign, sign)
    ways = (*_authored("handwriting.json").get(name, ()), *_authored("allographs.json").get(name, ()))
    if not ways:
        raise KeyError(f"no glyph for {sign!r}")
    return tuple(tuple(_knots(stroke) for stroke in _share(way)[1].split("/")) for way in ways)


@cache
def shares(sign: str) -> FloatArray:
    """Which share of people write a sign in each of its `styles`, (ways,)."""
    name = _ALIKE.get(sign, sign)
    ways = (*_authored("handwriting.json").get(name, ()), *_authored("allographs.json").get(name, ()))
    weights = np.array([_share(way)[0] for way in ways])
    return readonly(weights / weights.sum())


def _ways(symbol: str) -> tuple[tuple[FloatArray, ...], ...]:
    for file in ("allographs.json", "marks.json"):
        if symbol in _parsed(file):
            return _parsed(file)[symbol]
    raise KeyError(f"no glyph for {symbol!r}")


@cache
def _authored(file: str) -> dict[str, list[str]]:
    return json.loads(resources.files("data_gen.glyphs").joinpath(file).read_text("utf-8"))


@cache
def _parsed(file: str) -> dict[str, tuple[tuple[FloatArray, ...], ...]]:
    return {
        symbol: tuple(tuple(curve(*_knots(stroke)) for stroke in _share(way)[1].split("/")) for way in ways)
        for symbol, ways in _authored(file).items()
    }


def objects() -> tuple[str, ...]:
    """Things that people doodle and that mean nothing here: a whale, a key, a tent."""
    return tuple(_drawn())


def knots(thing: str) -> tuple[Knots, ...]:
    """The strokes of one of `objects()`. Raises KeyError where there is no such thing."""
    return _drawn()[thing]


def curve(points: FloatArray, corners: Sequence[int]) -> FloatArray:
    """A stroke through the points, sharp at the corners (places among the points, in order) alone."""
    ends = [0, *corners, len(points) - 1]
    pieces = [_catmull_rom(points[a : b + 1]) for a, b in pairwise(ends)]
    return readonly(np.concatenate([pieces[0], *(piece[1:] for piece in pieces[1:])]))


@cache
def _drawn() -> dict[str, tuple[Knots, ...]]:
    text = resources.files("data_gen.glyphs").joinpath("objects.json").read_text("utf-8")
    raw: dict[str, str] = json.loads(text)
    return {thing: tuple(_knots(stroke) for stroke in way.split("/")) for thing, way in raw.items()}


def _share(way: str) -> tuple[float, str]:
    """How often a way is met with, and its strokes."""
    weight, bar, strokes = way.partition("|")
    return (float(weight), strokes) if bar else (1.0, way)


def _knots(text: str) -> Knots:
    nodes = [node.strip() for node in text.split(",")]
    points = np.array([[float(number) for number in node.rstrip("*").split()] for node in nodes])
    return points, tuple(k for k in range(1, len(nodes) - 1) if nodes[k].endswith("*"))


def _catmull_rom(points: FloatArray) -> FloatArray:
    """A curve through the points, (n, 2) -> ((n - 1) * STEPS + 1, 2); two points stay a line."""
    if len(points) == 2:
        return points
    padded = np.concatenate([2 * points[:1] - points[1:2], points, 2 * points[-1:] - points[-2:-1]])
    p0, p1, p2, p3 = (padded[k : len(padded) - 3 + k, None, :] for k in range(4))
    t = (np.arange(STEPS) / STEPS)[None, :, None]
    curve = 0.5 * (
        2 * p1 + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t**2 + (3 * p1 - p0 - 3 * p2 + p3) * t**3
    )
    return np.concatenate([curve.reshape(-1, 2), points[-1:]])
