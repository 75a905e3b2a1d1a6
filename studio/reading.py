"""Reading a page on demand (row P2), and the one seam where handwriting is read.

What has been read stays as it was read until it is erased: a second Analyze adds what was drawn since. Asked by another
recognizer's name, the page is read anew, and what is the same ink keeps its label, whether it is fixed, and what was
associated with it. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache

from physics.formula.expected import expected
from recognizer.claims import Grouping, Recognizer
from recognizer.handwriting.reader import Reading as HandReading
from recognizer.handwriting.roster import reader_of
from recognizer.interpret import Note, interpret
from recognizer.roster import ROSTER, recognizer
from sketch.files import document
from sketch.formula.lexer import FormulaError, decimals
from sketch.formula.parse import expression, parse
from sketch.formula.print import plain
from sketch.ink import Ink
from sketch.page import Association, Component, Expression, Sketch, label
from studio.actions import Read
from studio.board import Board, unread
from studio.limits import Refused

READER = "learned"
"""Who reads a page when nobody else is named."""
SURE = 0.5
"""Readings of handwriting that are less likely to be right are asked of the person instead."""
GESTURES = "geometric"
"""Who tells gestures from drawing as they are made: the quickest."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What a line of handwriting says: text in the formula language (LaTeX or plain), how sure the reader is (0 to
    1), and what else it may be, likeliest first."""

    text: str
    confidence: float = 1.0
    alternatives: tuple[str, ...] = ()


HandReader = Callable[[Ink], Reading | None]
"""Reads the strokes of one line; None where it would rather not say, and the person types."""


def handwriting(line: Ink) -> Reading | None:
    """What a line of ink says, in the way that people type it, where it is likelier right than not and a formula."""
    said = as_typed(reader_of("net").read(line.strokes, prior=expected))
    return said if said is not None and said.confidence >= SURE else None


def as_typed(said: HandReading) -> Reading | None:
    """A reading in the way that people type it; None where the likeliest is no formula."""
    texts = [_typed(text) for text in (said.text, *(latex for latex, _ in said.alternatives))]
    if texts[0] is None:
        return None
    others = dict.fromkeys(text for text in texts[1:] if text is not None and text != texts[0])
    return Reading(texts[0], said.confidence, tuple(others))


def _typed(text: str) -> str | None:
    """A formula as it is typed; None for what is none."""
    try:
        return plain(parse(text), decimals(text))
    except FormulaError:
        return None


HAND_READER: HandReader = handwriting
"""The seam for a reader of handwriting: the function that every unread line of ink is given to."""


@cache
def rival(name: str) -> Recognizer:
    """The recognizer of that name, made once. Raises Refused for a name that nobody bears."""
    if name not in ROSTER:
        raise Refused(f"no recognizer is called {name[:40]!r}; there are {', '.join(ROSTER)}")
    return recognizer(name)


def reader() -> Grouping:
    """Who reads a page when nobody else is named."""
    found = rival(READER)
    assert isinstance(found, Grouping)
    return found


def analyzed(board: Board, name: str = READER, anew: bool = False, hand: HandReader | None = None) -> Read:
    """The page as it is read now, as an action. anew: components that are there may be read otherwise; hand: who reads
    handwriting."""
    old = board.sketch
    notes = [Note(line.text, line.at) for line in old.expressions if line.text is not None]
    found = interpret(old.ink, rival(name), notes)
    meant = _merged(old, found, anew)
    read = hand or HAND_READER
    meant = replace(meant, expressions=tuple(_read(old.ink, line, read) for line in meant.expressions))
    return Read(document.dumps_meaning(meant), name)


def _merged(old: Sketch, found: Sketch, anew: bool) -> Sketch:
    """What was found in what was there: components of the same ink are the same component."""
    same = _same(old, found)
    kept = () if anew else old.components
    taken = {stroke for part in kept for stroke in part.strokes}
    if not anew:  # what is a formula stays one, though its signs may look like things
        taken |= {stroke for line in old.expressions if line.text is not None for stroke in line.strokes}
    fresh = [part for part in found.components if not taken.intersection(part.strokes)]
    names = _names(old, found, same, anew)
    parts = [*kept]
    for part in fresh:
        before = same.get(part.label)
        start, end = (None if end is None else names.get(end) for end in part.ends)
        fixed = part.fixed if before is None else before.fixed
        parts.append(replace(part, label=names[part.label], fixed=fixed, ends=(start, end)))
    lines = _lines(old, found, {stroke for part in parts for stroke in part.strokes})
    labels = {part.label for part in parts}
    links = tuple(
        Association(one.expression, one.component, one.anchor)
        for one in old.associations
        if one.component in labels
    )
    owned = {stroke for part in parts for stroke in part.strokes}
    owned |= {stroke for line in lines for stroke in line.strokes}
    gestures = tuple(one for one in found.gestures if one.stroke not in owned)
    return Sketch(found.ink, tuple(parts), lines, links, gestures)


def _same(old: Sketch, found: Sketch) -> dict[str, Component]:
    """For the label of a component that was found the one that was there, if most of the ink is the same."""
    same: dict[str, Component] = {}
    for part in found.components:
        for before in old.components:
            common = len(set(part.strokes) & set(before.strokes))
            if 2 * common > max(len(part.strokes), len(before.strokes)) and part.kind == before.kind:
                same[part.label] = before
    return same


def _names(old: Sketch, found: Sketch, same: dict[str, Component], anew: bool) -> dict[str, str]:
    """The label that each component that was found is to bear: its old one, or the next that is free."""
    used = {part.label for part in old.components} if not anew else {part.label for part in same.values()}
    names = {new: before.label for new, before in same.items()}
    rank = 0
    for part in found.components:
        if part.label in names:
            continue
        while label(rank) in used:
            rank += 1
        names[part.label] = label(rank)
        used.add(label(rank))
    return names


def _lines(old: Sketch, found: Sketch, drawn: set[int]) -> tuple[Expression, ...]:
    """The formulas that were there, in their order, each with its ink and what has been written on to it since, which
    is why it is to be read again (row R4); then new lines."""
    used = set(drawn)
    loose = {stroke for stroke, kind in enumerate(old.kinds()) if kind is None}
    lines: list[Expression] = []

    def take(line: Expression, strokes: Sequence[int]) -> None:
        own = tuple(stroke for stroke in strokes if stroke not in used)
        used.update(own)
        lines.append(replace(line, strokes=own))

    for line in old.expressions:
        match = next((other for other in found.expressions if _is(other, line)), None)
        now = () if match is None else match.strokes
        if line.strokes:  # with it belongs what nobody has read, and nothing of another line's
            now = sorted({*line.strokes, *(loose.intersection(now) if set(now) & set(line.strokes) else ())})
        take(unread(line) if line.strokes and set(now) - used != set(line.strokes) else line, now)
    for line in found.expressions:
        if line.text is None and not used.issuperset(line.strokes):
            take(line, line.strokes)
    return tuple(lines)


def _is(found: Expression, line: Expression) -> bool:
    """Whether a line that was found is one that was there: the same formula at its place, or the same unread ink."""
    if line.text is not None:
        return (found.text, found.at) == (line.text, line.at)
    return found.text is None and bool(set(found.strokes) & set(line.strokes))


def _read(ink: Ink, line: Expression, reader: HandReader) -> Expression:
    """A line that nobody has read, as the reader reads it."""
    if line.text is not None or not line.strokes:
        return line
    said = reader(Ink(tuple(ink[stroke] for stroke in line.strokes)))
    if said is None:
        return line
    read = expression(said.text, line.strokes, line.at)
    return replace(read, confidence=said.confidence, alternatives=said.alternatives)
