"""Whole pages read from ink alone: drawing and mathematics sorted, every formula read as it is written.

What was associated with what is known, since a person taps it; what the lines say is read.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from data_gen.pages import Page
from evaluation.metrics.matching import match_components
from evaluation.metrics.motion import same_outcome
from evaluation.rivals import rival
from physics.formula.expected import expected
from physics.outcome import outcome
from physics.pipeline import move
from recognizer.handwriting.reader import Reader
from recognizer.interpret import Mathematics, Note, interpret
from recognizer.oracle import Oracle
from sketch.page import Sketch

ORACLE = "oracle"


@dataclass(frozen=True, slots=True)
class HandwrittenPage:
    """sorted: whether every stroke is drawing or mathematics as it was meant; read: lines read right, of `lines`;
    moves: whether the same happens as on the page as meant."""

    sorted: bool
    read: int
    lines: int
    moves: bool


def reads(reader: Reader) -> Mathematics:
    """The reader with what a physics page speaks for."""
    return partial(reader.read, prior=expected)


def untyped(sketch: Sketch) -> tuple[Note, ...]:
    """The page's formulas as notes without their text: where they stand, and what they were associated with."""
    anchors: dict[int, list[tuple[float, float]]] = {}
    for association in sketch.associations:
        anchors.setdefault(association.expression, []).append(association.anchor)
    return tuple(
        Note(None, written.at, anchor)
        for index, written in enumerate(sketch.expressions)
        if written.strokes
        for anchor in anchors.get(index, [None])
    )


def read_page(page: Page, name: str, mathematics: Mathematics) -> Sketch:
    """The page as a recognizer sorts it and a reader reads it; "oracle" is told what each stroke is."""
    recognizer = Oracle(page.truth) if name == ORACLE else rival(name)
    return interpret(page.truth.ink, recognizer, untyped(page.truth), mathematics)


def judged(page: Page, name: str, mathematics: Mathematics) -> HandwrittenPage:
    """One page, read and moved."""
    claim = read_page(page, name, mathematics)
    truth = page.truth
    pairs = match_components(truth, claim)
    by_strokes = {written.strokes: written for written in claim.expressions}
    right = 0
    for written in truth.expressions:
        found = by_strokes.get(written.strokes)
        right += found is not None and found.tree is not None and found.tree == written.tree
    sides = zip(truth.kinds(), claim.kinds(), strict=True)
    meant, seen = outcome(move(truth, page.seconds)), outcome(move(claim, page.seconds))
    return HandwrittenPage(
        sorted=all((true == "math") == (claimed == "math") for true, claimed in sides if true is not None),
        read=right,
        lines=len(truth.expressions),
        moves=same_outcome(pairs, meant, seen),
    )


def judge_all(
    pages: Sequence[Page],
    name: str,
    mathematics: Mathematics,
    tell: Callable[[int], None] = lambda _done: None,
) -> list[HandwrittenPage]:
    """Every page, read and moved."""
    found: list[HandwrittenPage] = []
    for index, page in enumerate(pages):
        found.append(judged(page, name, mathematics))
        tell(index + 1)
    return found
