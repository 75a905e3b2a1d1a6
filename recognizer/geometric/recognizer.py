"""`geometric`: hand-made geometry at its best, stroke by stroke and then against the page.

Each stroke is weighed alone (`rules`), then what only the page can tell is added (`context`):
taps are tiny beside the other strokes, a scribble covers earlier ink, a lasso encloses it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, log, log1p

import numpy as np

from recognizer.claims import Claim, claim_for
from recognizer.geometric.context import gestures
from recognizer.geometric.heads import pieced_arrows
from recognizer.geometric.letters import marks, too_large, written
from recognizer.geometric.rules import Seen, seen
from recognizer.geometric.strangers import familiarity, is_stranger
from recognizer.geometric.symbols import attached, signs
from recognizer.group import chains
from sketch.ink import FloatArray, Ink, Stroke, readonly
from sketch.page import STROKE_KINDS, StrokeKind


@dataclass(frozen=True, slots=True)
class Confidence:
    """From evidence to probabilities."""

    temperature: float = 0.55
    """Divides the evidence before the softmax. 1 would take the soft bounds at their word, which are
    modest; on 3,500 generated strokes 0.55 gave the least calibration error: 0.042, and 0.009 without lassos, which
    nobody can tell from circles without what they enclose (1 gave 0.10 and 0.14)."""
    surprise: float = -6.0
    """Evidence, at least, of any kind: hands do what no rule foresees once in some thousand strokes."""
    reject: float = 0.45
    """Below this confidence the stroke is rejected: two kinds are then about equally likely."""
    sign: float = log(0.8)
    """Belief, its logarithm, in a sign where straight strokes cross on no shape: a wire that crosses another is
    as rare as people are careful."""
    large: float = log(0.2)
    """Added to the evidence for mathematics where a closed stroke is far larger than the page's letters: one in five at
    most is a great O or a box about a result."""
    closed: float = 2.0
    """What an outline's evidence may lack of that for mathematics to be thought of as one."""
    window: int = 256
    """Strokes in drawing order that are looked at together, more than a page of mathematics has: what belongs
    together was drawn together, and a heap of 10,000 strokes stays a matter of seconds."""
    overlap: int = 32
    """Strokes that two windows share, so that nothing falls between them."""
    gesture: float = 0.9
    """Of a gesture: its context is a conjunction of plain facts, wrong once in ten by their margins."""


CONFIDENCE = Confidence()
SHAFTS: tuple[StrokeKind, ...] = ("wire", "arrow", "math")
"""What strokes of an arrow may be taken for alone: a bent shaft is a letter then."""
SIDES: tuple[StrokeKind, ...] = ("wire", "math", "circle", "polygon")
"""What sides of an outline may be taken for alone."""


MATH = STROKE_KINDS.index("math")
OUTLINES = tuple(STROKE_KINDS.index(kind) for kind in ("circle", "polygon", "lasso"))
NOTHING = readonly(np.zeros(len(STROKE_KINDS)))
"""The evidence from a pen that never moved."""


class Geometric:
    """The geometric rival. It uses the page for gestures only."""

    name = "geometric"
    claims: frozenset[StrokeKind] = frozenset(STROKE_KINDS)

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """One claim a stroke, with a softmax of its evidence as scores."""
        looks = [seen(stroke.points) for stroke in ink]
        alone = [NOTHING if look is None else look.beliefs for look in looks]
        found = gestures(ink, looks)
        rows = together(ink, alone, [index for index, gesture in enumerate(found) if gesture is None])
        strange = strangers(ink, looks, [row is own for row, own in zip(rows, alone, strict=True)], rows)
        return tuple(
            claim(row, index in strange) if gesture is None else claim_for(gesture, CONFIDENCE.gesture)
            for index, (row, gesture) in enumerate(zip(rows, found, strict=True))
        )

    def strangeness(self, drawings: Sequence[Ink]) -> FloatArray:
        """How much each drawing looks like none of the kinds, (B,): that of its strangest stroke, each seen alone. The
        scale is the logarithm of a belief."""
        return np.array([max((_strangeness(stroke) for stroke in ink), default=0.0) for ink in drawings])


def together(ink: Ink, alone: Sequence[FloatArray], drawn: Sequence[int]) -> list[FloatArray]:
    """The evidence after a look at the strokes that were drawn beside each: shafts with their heads, sides
    that close an outline, strokes that make a sign. drawn: the strokes that are no gestures."""
    rows = list(alone)
    step = CONFIDENCE.window - CONFIDENCE.overlap
    for start in range(0, max(len(drawn) - CONFIDENCE.overlap, 1), step):
        _look_around(ink, rows, drawn[start : start + CONFIDENCE.window])
    return rows


def _look_around(ink: Ink, rows: list[FloatArray], drawn: Sequence[int]) -> None:
    """Changes the rows of those of the strokes that mean something together."""
    if len(drawn) < 2:
        return
    best = {index: STROKE_KINDS[int(np.argmax(rows[index]))] for index in drawn}
    letters = [i for i in drawn if best[i] == "math"]
    for index in too_large(ink, [i for i in drawn if _closed(rows[i])], letters):
        rows[index] = rows[index].copy()
        rows[index][MATH] += CONFIDENCE.large
        best[index] = STROKE_KINDS[int(np.argmax(rows[index]))]
    sides = {side for chain in chains(ink, [i for i in drawn if best[i] in SIDES]) for side in chain}
    outlines = [i for i in drawn if best[i] in ("circle", "polygon") or i in sides]
    open_ended = [i for i in drawn if best[i] in SHAFTS and i not in sides]
    ends = attached(ink, open_ended, outlines)
    arrows = pieced_arrows(
        ink, [i for i in open_ended if ends.get(i, 0) < 2], [i for i in outlines if best[i] == "polygon"]
    )
    paired = {index for arrow in arrows for index in arrow.strokes}
    for arrow in arrows:
        for index in arrow.strokes:
            rows[index] = made("arrow", arrow.belief, rows[index])
            best[index] = "arrow"
    for index in marks(ink, [i for i in open_ended if best[i] == "arrow" and i not in paired], letters):
        rows[index] = made("math", CONFIDENCE.sign, rows[index])
        best[index] = "math"
    free = [i for i in open_ended if i not in ends]
    straight, letters = ([i for i in free if best[i] == kind] for kind in ("wire", "math"))
    for index in signs(ink, straight, letters):
        rows[index] = made("math", CONFIDENCE.sign, rows[index])


def _closed(row: FloatArray) -> bool:
    """Whether a stroke closes an outline of whatever shape, as likely as that it is a letter."""
    return max(row[k] for k in OUTLINES) > row[MATH] - CONFIDENCE.closed


def made(kind: StrokeKind, belief: float, row: FloatArray) -> FloatArray:
    """The evidence of a stroke alone, together with the belief (its logarithm) that it is part of something
    of this kind: whatever is believed of that is not believed of anything else."""
    otherwise = row + log1p(-min(exp(belief), 1 - 1e-9))
    position = STROKE_KINDS.index(kind)
    otherwise[position] = max(otherwise[position], belief)
    return otherwise


def weigh(stroke: Stroke) -> FloatArray:
    """The evidence for each kind from one stroke seen alone, (9,); none from a pen that never moved."""
    look = seen(stroke.points)
    return NOTHING if look is None else look.beliefs


def strangers(
    ink: Ink, looks: Sequence[Seen | None], alone: Sequence[bool], rows: Sequence[FloatArray]
) -> set[int]:
    """The strokes that no kind explains. What others on the page make of a stroke is explained by them: only those that stand
    alone are asked, and not among letters."""
    odd = [
        index for index, look in enumerate(looks) if look is not None and alone[index] and is_stranger(look)
    ]
    if not odd:
        return set()
    letters = [index for index, row in enumerate(rows) if int(np.argmax(row)) == MATH]
    return set(odd) - set(written(ink, odd, letters))


def _strangeness(stroke: Stroke) -> float:
    look = seen(stroke.points)
    return 0.0 if look is None else -familiarity(look)


def claim(row: FloatArray, stranger: bool = False, rule: Confidence = CONFIDENCE) -> Claim:
    """Softmax of the evidence; rejected where two kinds are about equally likely, and a stranger."""
    beliefs: list[float] = row.tolist()
    best = max(beliefs)
    shares = [exp(max(belief - best, rule.surprise) / rule.temperature) for belief in beliefs]
    total = sum(shares)
    return Claim([share / total for share in shares], rejected=stranger or 1 / total < rule.reject)
