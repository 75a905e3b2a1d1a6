"""What a recognizer says of a stroke, and what a recognizer is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sketch.ink import FloatArray, Ink, readonly
from sketch.page import STROKE_KINDS, StrokeKind


@dataclass(frozen=True, slots=True, eq=False)
class Claim:
    """One stroke's claim.

    scores: (9,) calibrated probabilities over `STROKE_KINDS`, in that order, summing to 1;
    rejected: the recognizer would rather not say (the scores still hold its best guess).
    """

    scores: FloatArray
    rejected: bool = False

    def __init__(self, scores: ArrayLike, rejected: bool = False) -> None:
        array = readonly(scores)
        if array.shape != (len(STROKE_KINDS),):
            raise ValueError(f"scores have shape {array.shape}; needed is ({len(STROKE_KINDS)},)")
        if not np.all(np.isfinite(array)) or array.min() < 0 or abs(array.sum() - 1) > 1e-6:
            raise ValueError("scores must be probabilities that sum to 1")
        object.__setattr__(self, "scores", array)
        object.__setattr__(self, "rejected", rejected)

    @classmethod
    def trusted(cls, scores: FloatArray, rejected: bool = False) -> Claim:
        """The same without looking: for scores (9,) that are probabilities by how they were made and that nobody else
        writes to."""
        claim = object.__new__(cls)
        scores.setflags(write=False)
        object.__setattr__(claim, "scores", scores)
        object.__setattr__(claim, "rejected", rejected)
        return claim

    @property
    def kind(self) -> StrokeKind:
        return STROKE_KINDS[int(np.argmax(self.scores))]

    @property
    def confidence(self) -> float:
        return float(self.scores.max())

    def score(self, kind: StrokeKind) -> float:
        return float(self.scores[STROKE_KINDS.index(kind)])


class Recognizer(Protocol):
    """A rival. It sees the whole page, so that it may use context; it answers stroke by stroke.

    claims: the kinds that it can claim at all; a stroke of any other kind it must get wrong, which
    a contest reports instead of hiding. recognize returns one claim for each stroke of the ink, in
    the ink's order, for any ink that `Ink` accepts, an empty page included. The same ink gives the
    same claims.
    """

    @property
    def name(self) -> str: ...

    @property
    def claims(self) -> frozenset[StrokeKind]: ...

    def recognize(self, ink: Ink) -> tuple[Claim, ...]: ...


@dataclass(frozen=True, slots=True, eq=False)
class Bonds:
    """Which strokes are one thing: pairs (m, 2) of stroke indices, the lesser first, none twice; scores (m,) the
    probability of each. Pairs that are not listed are not bound."""

    pairs: NDArray[np.int64]
    scores: FloatArray


@runtime_checkable
class Grouping(Recognizer, Protocol):
    """A recognizer that also says which strokes belong together; the others leave that to geometry."""

    def read(self, ink: Ink) -> tuple[tuple[Claim, ...], Bonds]: ...


def claim_for(kind: StrokeKind, confidence: float, rejected: bool = False) -> Claim:
    """A claim that gives `kind` its confidence and shares the rest equally among the others."""
    scores = np.full(len(STROKE_KINDS), (1 - confidence) / (len(STROKE_KINDS) - 1))
    scores[STROKE_KINDS.index(kind)] = confidence
    return Claim(scores, rejected)
