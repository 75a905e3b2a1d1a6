"""Published features with scikit-learn's learners: logistic regression, a support vector machine, a forest.

The features are scaled to mean 0 and variance 1 and cut at some standard deviations: compactness and Hu's invariants have
tails that would outweigh everything else.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from sklearn.calibration import CalibratedClassifierCV
from sklearn.ensemble import RandomForestClassifier
from sklearn.linear_model import LogisticRegression
from sklearn.svm import SVC

from recognizer.classical.linear import Features
from recognizer.samples import IntArray, Sample, Scorer, Trainer, labelled
from sketch.ink import FloatArray, Ink
from sketch.page import StrokeKind


@dataclass(frozen=True, slots=True)
class LearnerRule:
    """Numbers of the learners; scikit-learn's own defaults where none is named."""

    cut: float = 5.0
    """Standard deviations beyond which a feature is cut."""
    trees: int = 100
    """Of the forest: scikit-learn's default; each costs time on every stroke."""
    penalty: float = 10.0
    """C of the support vector machine with a radial kernel: samples are clean, a boundary may follow them."""
    folds: int = 3
    """Of the machine's calibration, or as many as the rarest kind has samples."""
    doubt: float = 1e-4
    """The least probability that is believed: a forest says 0 where no tree votes."""


RULE = LearnerRule()
Learner = Callable[[FloatArray, IntArray, int], Any]
"""From scaled features (n, F), labels (n,) and a seed to a fitted classifier of scikit-learn."""


@dataclass(frozen=True, slots=True, eq=False)
class Learnt:
    """A scorer: the logarithm of what a fitted classifier says each kind's probability is, or its margins where it tells
    none; no classifier where it knows one kind alone. seen: (n, F) scaled features of what it learnt from."""

    kinds: tuple[StrokeKind, ...]
    features: Features
    mean: FloatArray
    scale: FloatArray
    classifier: Any
    seen: FloatArray

    def weigh(self, drawings: Sequence[Ink]) -> tuple[FloatArray, FloatArray]:
        """A drawing is familiar whose features lie near those of something learnt: the classifier itself is sure
        of much that it never saw."""
        if not len(drawings):
            return np.empty((0, len(self.kinds))), np.empty(0)
        scaled = _scaled(self.features(drawings), self.mean, self.scale)
        return self._evidence(scaled), -np.log(np.maximum(_nearest(scaled, self.seen), RULE.doubt))

    def _evidence(self, scaled: FloatArray) -> FloatArray:
        if self.classifier is None:
            return np.zeros((len(scaled), 1))
        if hasattr(self.classifier, "predict_proba"):
            shares = np.asarray(self.classifier.predict_proba(scaled), dtype=np.float64)
            return np.log(np.maximum(shares, RULE.doubt))
        margins = np.asarray(self.classifier.decision_function(scaled), dtype=np.float64)
        return margins if margins.ndim == 2 else np.column_stack([-margins, margins])


def by_learner(features: Features, learner: Learner) -> Trainer:
    """A trainer of the learner on these features. With samples of one kind alone it knows that kind alone."""

    def train(samples: Sequence[Sample], rng: np.random.Generator) -> Scorer:
        kinds, labels = labelled(samples)
        found = features([sample.ink for sample in samples])
        mean, spread = found.mean(axis=0), found.std(axis=0)
        scale = np.where(spread > 0, spread, 1.0)
        scaled = _scaled(found, mean, scale)
        fitted = learner(scaled, labels, int(rng.integers(2**31))) if len(kinds) > 1 else None
        return Learnt(kinds, features, mean, scale, fitted, scaled)

    return train


def logistic(features: FloatArray, labels: IntArray, _seed: int) -> Any:
    """Multinomial logistic regression: scikit-learn's linear learner that tells probabilities."""
    return LogisticRegression(max_iter=400).fit(features, labels)


def machine(features: FloatArray, labels: IntArray, seed: int) -> Any:
    """A support vector machine with a radial kernel, calibrated by Platt's sigmoids. With a single sample of some kind
    there is nothing to calibrate on: its margins then speak for themselves."""
    bare = SVC(C=RULE.penalty, random_state=seed)
    folds = min(RULE.folds, int(np.bincount(labels).min()))
    if folds < 2:
        return bare.fit(features, labels)
    together: Any = False  # one machine, where scikit-learn's stubs know of many only
    return CalibratedClassifierCV(bare, cv=folds, ensemble=together).fit(features, labels)


def forest(features: FloatArray, labels: IntArray, seed: int) -> Any:
    """A random forest; what its leaves' shares vote for."""
    return RandomForestClassifier(RULE.trees, random_state=seed, n_jobs=1).fit(features, labels)


def _scaled(features: FloatArray, mean: FloatArray, scale: FloatArray) -> FloatArray:
    return np.clip((features - mean) / scale, -RULE.cut, RULE.cut)


def _nearest(rows: FloatArray, seen: FloatArray) -> FloatArray:
    """The distance of each row (B, F) to the nearest that was seen (n, F): (B,)."""
    squared = (rows**2).sum(axis=1)[:, None] - 2 * rows @ seen.T + (seen**2).sum(axis=1)
    return np.sqrt(np.maximum(squared.min(axis=1), 0.0))
