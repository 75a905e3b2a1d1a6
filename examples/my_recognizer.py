"""A recognizer in twenty lines: straight strokes are wires, closed ones circles, the rest is mathematics.

inklined compare --recognizer examples.my_recognizer:Simple learned
"""

from recognizer.claims import Claim, claim_for
from sketch.geometry import closure
from sketch.ink import Ink, Stroke
from sketch.page import StrokeKind


class Simple:
    name = "simple"
    claims: frozenset[StrokeKind] = frozenset({"wire", "circle", "math"})

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        return tuple(self._claim(stroke) for stroke in ink)

    def _claim(self, stroke: Stroke) -> Claim:
        gap = closure(stroke.points)  # 0: the ends meet; 1: as straight as can be
        kind: StrokeKind = "circle" if gap < 0.1 else "wire" if gap > 0.95 else "math"
        return claim_for(kind, confidence=0.8)
