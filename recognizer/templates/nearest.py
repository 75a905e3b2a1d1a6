"""The template rivals: a drawing is of the kind of the nearest template, as each paper measures nearness."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from recognizer.samples import Sample, Scorer, Trainer, labelled
from recognizer.templates.points import Matcher
from sketch.ink import FloatArray, Ink
from sketch.page import StrokeKind

NEAREST = 1e-3
"""Distances below this count as this, for their logarithm; all matchers' are of the order of 0.1 to 100."""


@dataclass(frozen=True, slots=True, eq=False)
class Nearest:
    """A scorer: the evidence for a kind is the logarithm of how near its nearest template is, so that the odds of
    two kinds rest on the ratio of their distances, whatever their unit."""

    kinds: tuple[StrokeKind, ...]
    matcher: Matcher

    def weigh(self, drawings: Sequence[Ink]) -> tuple[FloatArray, FloatArray]:
        """What is nearest is also how familiar a drawing is."""
        if not len(drawings):
            return np.empty((0, len(self.kinds))), np.empty(0)
        evidence = -np.log(np.maximum(self.matcher.nearest(drawings), NEAREST))
        return evidence, evidence.max(axis=1)


def by_templates(matcher: type[Matcher]) -> Trainer:
    """A trainer that keeps every sample as a template of the matcher."""

    def train(samples: Sequence[Sample], _rng: np.random.Generator) -> Scorer:
        kinds, labels = labelled(samples)
        return Nearest(kinds, matcher.of([sample.ink for sample in samples], labels))

    return train
