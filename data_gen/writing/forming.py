"""A sign as somebody writes it: his way of it, its strokes in his order and sense, formed as his hand forms them."""

from __future__ import annotations

import numpy as np

from data_gen.glyphs.alphabet import shares, styles
from data_gen.writing.form import bent, curves, is_loop
from data_gen.writing.habits import Habits, TypeRule, Usual
from sketch.geometry import bounding_box
from sketch.ink import FloatArray


def sign_of(name: str, by: Habits) -> tuple[list[FloatArray], float]:
    """The strokes of one way of writing the sign, filling the unit box, and its width over its height."""
    rng = by.rng
    usual = by.usual.get(name)
    if usual is None or rng.random() < by.rule.other_way:
        usual = _usual(name, rng, by.rule)
        by.usual.setdefault(name, usual)
    ways = styles(name)[usual.way]
    freedom = by["freedom"]
    own = bent([ways[k] for k in usual.order], freedom, np.random.default_rng(usual.hand), by.form)
    paths = curves(bent(own, by.form.now * freedom, rng, by.form), rng, by.form)
    paths = [path[::-1] if turned else path for path, turned in zip(paths, usual.turned, strict=True)]
    if 1 < len(paths) < 4 and name not in ("=", "i", "j", "\\Vert") and rng.random() < by.rule.unlifted:
        paths = [np.concatenate(paths)]
    low, high = bounding_box(np.concatenate(paths))
    size = high - low
    box = np.where(size > 1e-6, size, 1.0)
    spread = by.rule.shift if len(paths) > 1 else 0.0
    unit = [
        (path - low) / box + spread * rng.standard_normal(2) * np.where(size > 1e-6, 1.0, 0.0)
        for path in paths
    ]
    return unit, float(size[0] / size[1]) if size[1] > 1e-6 else 10.0


def _usual(name: str, rng: np.random.Generator, rule: TypeRule) -> Usual:
    """Somebody's way of the sign."""
    ways = styles(name)
    known = shares(name)[: rule.ways]
    way = int(rng.choice(len(known), p=known / known.sum()))
    strokes = ways[way]
    count = len(strokes)
    order = rng.permutation(count) if count > 1 and rng.random() < rule.swapped else range(count)
    chosen = tuple(map(int, order))
    size = float(np.max(np.ptp(np.concatenate([points for points, _ in strokes]), axis=0)))
    turned = tuple(bool(rng.random() < _backwards(strokes[k][0], size, rule)) for k in chosen)
    return Usual(way, chosen, turned, int(rng.integers(1 << 62)))


def _backwards(points: FloatArray, size: float, rule: TypeRule) -> float:
    """The share of writers who draw such a stroke from its other end."""
    if is_loop(points, size):
        return rule.clockwise
    return rule.backwards if len(points) == 2 else rule.reversed
