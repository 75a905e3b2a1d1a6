"""`oracle`: told the truth, it claims exactly that. Its score is the ceiling of everything after
recognition, so that recognition error and back-end error are never mixed up."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from recognizer.claims import Bonds, Claim, claim_for
from sketch.ink import Ink
from sketch.page import STROKE_KINDS, Sketch, StrokeKind


class Oracle:
    """Claims what the truth says of each stroke, and which strokes are one component; rejects the strokes that it gives
    to nobody.

    It knows the truth's own ink alone: recognize raises ValueError for any other.
    """

    name = "oracle"
    claims: frozenset[StrokeKind] = frozenset(STROKE_KINDS)

    def __init__(self, truth: Sketch) -> None:
        self._ink = truth.ink
        self._kinds = truth.kinds()
        parts = [sorted(component.strokes) for component in truth.components]
        pairs = sorted(pair for part in parts for pair in combinations(part, 2))
        self._bonds = Bonds(np.array(pairs, dtype=np.int64).reshape(-1, 2), np.ones(len(pairs)))

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """Certain claims, one a stroke."""
        if ink != self._ink:
            raise ValueError(f"this oracle was told of another page ({len(self._kinds)} strokes)")
        return tuple(
            claim_for("math", 1.0, rejected=True) if kind is None else claim_for(kind, 1.0)
            for kind in self._kinds
        )

    def read(self, ink: Ink) -> tuple[tuple[Claim, ...], Bonds]:
        """The same, and the strokes that are one component."""
        return self.recognize(ink), self._bonds
