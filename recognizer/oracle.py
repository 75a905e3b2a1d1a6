"""`oracle`: told the truth, it claims exactly that. Its score is the ceiling of everything after
recognition, so that recognition error and back-end error are never mixed up."""

from __future__ import annotations

from recognizer.claims import Claim, claim_for
from sketch.ink import Ink
from sketch.page import STROKE_KINDS, Sketch, StrokeKind


class Oracle:
    """Claims what the truth says of each stroke; rejects the strokes that it gives to nobody.

    It knows the truth's own ink alone: recognize raises ValueError for any other.
    """

    name = "oracle"
    claims: frozenset[StrokeKind] = frozenset(STROKE_KINDS)

    def __init__(self, truth: Sketch) -> None:
        self._ink = truth.ink
        self._kinds = truth.kinds()

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """Certain claims, one a stroke."""
        if ink != self._ink:
            raise ValueError(f"this oracle was told of another page ({len(self._kinds)} strokes)")
        return tuple(
            claim_for("math", 1.0, rejected=True) if kind is None else claim_for(kind, 1.0)
            for kind in self._kinds
        )
