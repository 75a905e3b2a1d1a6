"""What a hand does to the path it means, as small functions that compose.

A perturbation maps paths (B, N, 2), B strokes of N points each, to paths of the same shape. It
states how many standard normal variates each stroke needs and is handed exactly those, (B, draws),
so that any stroke can be made again alone from its own seed. Amounts are scalars or (B,) arrays;
lengths are fractions of the stroke's size (the diagonal of its bounding box).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from sketch.ink import FloatArray

Amount = float | FloatArray


@dataclass(frozen=True, slots=True)
class Perturbation:
    """draws: standard normals per stroke; apply: (paths (B, N, 2), normals (B, draws)) -> paths."""

    draws: int
    apply: Callable[[FloatArray, FloatArray], FloatArray]


def compose(*steps: Perturbation) -> Perturbation:
    """All steps, first to last."""

    def apply(paths: FloatArray, normals: FloatArray) -> FloatArray:
        used = 0
        for step in steps:
            paths = step.apply(paths, normals[:, used : used + step.draws])
            used += step.draws
        return paths

    return Perturbation(sum(step.draws for step in steps), apply)


def shear(amount: Amount) -> Perturbation:
    """Leans strokes to the right: x grows by `amount` per unit of height."""

    def apply(paths: FloatArray, _normals: FloatArray) -> FloatArray:
        return paths + np.stack([-_column(amount) * paths[..., 1], np.zeros_like(paths[..., 0])], axis=-1)

    return Perturbation(0, apply)


def stretch(amount: Amount) -> Perturbation:
    """Multiplies width over height by exp(amount), area kept."""

    def apply(paths: FloatArray, _normals: FloatArray) -> FloatArray:
        half = np.exp(0.5 * _column(amount))
        return np.stack([paths[..., 0] * half, paths[..., 1] / half], axis=-1)

    return Perturbation(0, apply)


def turn(amount: Amount) -> Perturbation:
    """Turns each stroke about its first point by `amount` radians times a normal variate."""

    def apply(paths: FloatArray, normals: FloatArray) -> FloatArray:
        angle = (np.broadcast_to(amount, len(paths)) * normals[:, 0])[:, None]
        cos, sin = np.cos(angle), np.sin(angle)
        start = paths[:, :1]
        x, y = (paths - start)[..., 0], (paths - start)[..., 1]
        return start + np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)

    return Perturbation(1, apply)


WAVES = 4
"""Slow waves along a stroke that make up its wobble."""


def wobble(amount: Amount) -> Perturbation:
    """Slow waver: `WAVES` sinusoids of 0.5, 1, 1.5 and 2 periods along the path, amplitude falling as 1/f, both axes.

    amount: rms displacement as a fraction of the size.
    """
    frequency = 0.5 * np.arange(1, WAVES + 1)
    weight = 1 / frequency / np.sqrt(np.sum(1 / frequency**2))

    def apply(paths: FloatArray, normals: FloatArray) -> FloatArray:
        along = np.linspace(0.0, 2 * np.pi, paths.shape[1])
        cos, sin = np.cos(np.outer(frequency, along)), np.sin(np.outer(frequency, along))
        waves = normals.reshape(len(paths), 2, 2, WAVES) * weight
        shift = waves[:, 0] @ cos + waves[:, 1] @ sin
        scale = (_column(amount) * sizes(paths)[:, None])[..., None]
        return paths + np.moveaxis(scale * shift, 1, 2)

    return Perturbation(4 * WAVES, apply)


def bow(amount: Amount) -> Perturbation:
    """Bends the whole stroke like a bow, `amount` (normal variate's standard deviation) of the chord."""

    def apply(paths: FloatArray, normals: FloatArray) -> FloatArray:
        along = np.linspace(-1.0, 1.0, paths.shape[1])
        chord = paths[:, -1] - paths[:, 0]
        beside = np.stack([-chord[:, 1], chord[:, 0]], axis=-1)
        sagitta = (np.broadcast_to(amount, len(paths)) * normals[:, 0])[:, None]
        return paths + (sagitta * (1 - along**2))[..., None] * beside[:, None, :]

    return Perturbation(1, apply)


def field(amount: Amount) -> Perturbation:
    """A smooth distortion of the plane: strokes bulge, skew and taper as a whole.

    Quadratic and cubic terms of the normalised coordinates; amount: rms displacement, fraction of
    the size. Unlike `wobble` it moves points that lie close together alike, wherever on the path they are.
    """

    def apply(paths: FloatArray, normals: FloatArray) -> FloatArray:
        low, high = extents(paths)
        size = np.maximum(np.hypot(*(high - low).T), 1e-9)[:, None]
        middle = (low + high) / 2
        x, y = ((paths[..., axis] - middle[:, axis, None]) * (2 / size) for axis in (0, 1))
        square = x * x + y * y
        terms = np.stack([x * y, x * x - y * y, x * square, y * square], axis=1)
        shift = normals.reshape(len(paths), 2, 4) @ terms
        return paths + np.moveaxis((_column(amount) * size)[..., None] * shift, 1, 2)

    return Perturbation(8, apply)


def extents(paths: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Low and high corners of each path's bounding box, (B, 2) each."""
    # Axis by axis: reducing the middle of three axes is several times slower.
    x, y = paths[..., 0], paths[..., 1]
    return np.stack([x.min(axis=1), y.min(axis=1)], axis=1), np.stack([x.max(axis=1), y.max(axis=1)], axis=1)


def sizes(paths: FloatArray) -> FloatArray:
    """Diagonal of each path's bounding box, (B,)."""
    low, high = extents(paths)
    return np.hypot(high[:, 0] - low[:, 0], high[:, 1] - low[:, 1])


def _column(amount: Amount) -> FloatArray:
    """A scalar or (B,) amount as a column that broadcasts over the points."""
    return np.asarray(amount, dtype=float).reshape(-1, 1)
