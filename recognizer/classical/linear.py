"""Rubine's linear classifier, in closed form.

Rubine, "Specifying gestures by example", SIGGRAPH 1991, section 4.2: with one covariance Σ pooled over the classes, class c
speaks with w_c0 + w_c · f, w_c = Σ⁻¹ μ_c, w_c0 = −½ w_c · μ_c. The evidence here is −½ the squared Mahalanobis distance to
μ_c, which is the same but for what all classes have in common, and tells strangers too (his section 4.3). Where Σ is singular (few samples,
or a feature that never varies) he leaves features out; here a small multiple of the identity is added, once features
are scaled to variance 1.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from recognizer.samples import Sample, Scorer, Trainer, labelled
from sketch.ink import FloatArray, Ink
from sketch.page import StrokeKind

Features = Callable[[Sequence[Ink]], FloatArray]
TINY = 1e-9
"""The least squared distance that a logarithm is taken of."""
RIDGE = 1e-3
"""Added to the pooled variances, which are about 1."""


@dataclass(frozen=True, slots=True, eq=False)
class Linear:
    """means: (K, F) of the scaled features; precision: (F, F) inverse of the pooled covariance; scale: (F,)."""

    kinds: tuple[StrokeKind, ...]
    features: Features
    means: FloatArray
    precision: FloatArray
    scale: FloatArray

    def weigh(self, drawings: Sequence[Ink]) -> tuple[FloatArray, FloatArray]:
        """A drawing is familiar that lies near some mean: Rubine's own test for gestures that are none."""
        if not len(drawings):
            return np.empty((0, len(self.kinds))), np.empty(0)
        offset = (self.features(drawings) / self.scale)[:, None] - self.means
        squared = np.einsum("bkf,fg,bkg->bk", offset, self.precision, offset)
        return -0.5 * squared, -np.log(np.maximum(squared.min(axis=1), TINY))


def by_rubine(features: Features) -> Trainer:
    """A trainer of Rubine's classifier on these features."""

    def train(samples: Sequence[Sample], _rng: np.random.Generator) -> Scorer:
        kinds, labels = labelled(samples)
        found = features([sample.ink for sample in samples])
        spread = found.std(axis=0)
        scale = np.where(spread > 0, spread, 1.0)
        scaled = found / scale
        means = np.array([scaled[labels == k].mean(axis=0) for k in range(len(kinds))])
        off = scaled - means[labels]
        pooled = off.T @ off / max(len(samples) - len(kinds), 1)
        precision = np.linalg.inv(pooled + RIDGE * np.eye(len(pooled)))
        return Linear(kinds, features, means, np.asarray(precision, dtype=np.float64), scale)

    return train
