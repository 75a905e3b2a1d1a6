"""What a published rival learns from, and what it answers with before its answers are calibrated."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol, cast

import numpy as np
from numpy.typing import NDArray

from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind

IntArray = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Sample:
    """A drawing of one symbol (one stroke or more), what it is, and who drew it (None: not known).

    Raises ValueError when there is no stroke."""

    ink: Ink
    kind: StrokeKind
    writer: str | None = None

    def __post_init__(self) -> None:
        if not len(self.ink):
            raise ValueError(f"a sample of {self.kind} without strokes; it needs one at least")


class Scorer(Protocol):
    """A rival that has learnt: how much speaks for each of its kinds."""

    @property
    def kinds(self) -> tuple[StrokeKind, ...]:
        """The K kinds that it has seen samples of, in the order of `STROKE_KINDS`."""
        ...

    def weigh(self, drawings: Sequence[Ink]) -> tuple[FloatArray, FloatArray]:
        """For B drawings of one symbol each: how much speaks for each kind, (B, K), and how familiar a drawing looks at
        all, (B,). All finite; the more, the likelier. Differences between kinds are log odds up to a factor that
        calibration finds; familiarity is on a scale of the scorer's own."""
        ...


Trainer = Callable[[Sequence[Sample], np.random.Generator], Scorer]
"""From samples of at least one kind to a scorer; the same samples and generator give the same scorer."""


def labelled(samples: Sequence[Sample]) -> tuple[tuple[StrokeKind, ...], IntArray]:
    """The kinds that occur, in the order of `STROKE_KINDS`, and which of them each sample is, (n,). Labels of somebody's own, as
    protocols over any set of gestures have them, come after the kinds in alphabetical order.

    Raises ValueError when there is no sample."""
    if not samples:
        raise ValueError("nothing to learn from: there is no sample of any kind")
    present = {sample.kind for sample in samples}
    own = cast(set[StrokeKind], present.difference(STROKE_KINDS))
    kinds: tuple[StrokeKind, ...] = (*(kind for kind in STROKE_KINDS if kind in present), *sorted(own))
    return kinds, np.array([kinds.index(sample.kind) for sample in samples], dtype=np.int64)
