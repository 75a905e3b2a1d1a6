"""From ink and claims to the page's meaning: a `Sketch`.

The order of disambiguation is row R3's: shapes, then springs, then wires, and what is left is
mathematics. A shape must enclose an area worth the name; a spring or a wire must end at a shape
at both ends, or it is its next best claim; a zero among letters is a letter. Frame: page units,
y down; sizes are compared with the page and with each other.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from recognizer.attach import Solids, anchored
from recognizer.claims import Bonds, Claim, Grouping, Recognizer
from recognizer.erase import erased, without_object
from recognizer.group import boxes_of, letter_height, lines
from recognizer.parts import Part, among_letters, arrows, links, shapes
from sketch.formula.parse import expression
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import Association, Component, Expression, Gesture, Sketch, StrokeKind, label
from sketch.shapes import COMPONENT_KINDS, Circle, Point, Polygon, outline


@dataclass(frozen=True, slots=True)
class Note:
    """A formula: as it was typed (None: what stands there in ink is read), where it stands on the page (None:
    nowhere in particular) and the spot on a component it was associated with (None: it holds for the whole
    page), page units. A formula associated with several components is several notes of one text at one place."""

    text: str | None
    at: Point | None = None
    anchor: Point | None = None


class Written(Protocol):
    """A line as it was read: in the formula language, the chance that all of it is right, other readings."""

    @property
    def text(self) -> str: ...

    @property
    def confidence(self) -> float: ...

    @property
    def alternatives(self) -> tuple[tuple[str, float], ...]: ...


Mathematics = Callable[[Sequence[Stroke]], Written]
"""Reads the strokes of one line of handwriting, in drawing order."""


@dataclass(frozen=True, slots=True)
class InterpretRule:
    """What is near enough on a page, and how it is read."""

    note: float = 2.0
    """Letter heights from a note's place to the ink of its line, at most."""
    point: float = 0.6
    """Letter heights from a dot that just misses a solid to the writing that it is part of instead."""
    arrow: float = 0.1
    """Belief in an arrow below which a stroke that found no other use is no arrow either: a net is then
    sure of something else, and what it thinks least unlikely means nothing."""
    row: float = 0.15
    """Share of the page's height within which two components stand in one row."""


RULE = InterpretRule()
DRAWN_KINDS: tuple[StrokeKind, ...] = (*COMPONENT_KINDS, "math")
"""What a stroke can be that is no gesture."""


def interpret(
    ink: Ink, recognizer: Recognizer, notes: Sequence[Note] = (), mathematics: Mathematics | None = None
) -> Sketch:
    """The page as the recognizer reads it, with typed formulas beside what was drawn. mathematics: who reads
    the lines that nobody typed; without one they stay unread.

    Strokes that the recognizer rejects, and erased ones, belong to nobody. Components are labelled A,
    B … in reading order; a shape's start and end stay where the pen put them.
    """
    claims, bonds = _read(ink, recognizer)
    meant: list[StrokeKind | None] = [None if claim.rejected else claim.kind for claim in claims]
    idle = without_object(ink, meant)
    named: list[StrokeKind | None] = [
        _next_best(claims[index]) if index in idle else kind for index, kind in enumerate(meant)
    ]
    gone = erased(ink, named)
    kinds: list[StrokeKind | None] = [None if index in gone else kind for index, kind in enumerate(named)]
    solids, held = links(ink, kinds, shapes(ink, kinds, bonds))
    pointing, writing = _leftover(ink, kinds, claims, [*solids, *held])
    marks = arrows(ink, pointing, bonds)
    taps = [index for index, kind in enumerate(kinds) if kind == "tap"]
    tapped, points = _tapped(ink, taps, solids, writing)
    components = _labelled(solids, held, marks, [tapped.get(tap) for tap in taps])
    expressions, associations = _written(
        ink, lines(ink, sorted([*writing, *points])), notes, components, mathematics
    )
    gestures = [Gesture("tap", tap) for tap in taps if tap not in points]
    for index, kind in enumerate(kinds):
        if kind == "scribble" or kind == "lasso":
            gestures.append(Gesture(kind, index))
    gestures.sort(key=lambda gesture: gesture.stroke)
    return Sketch(ink, components, expressions, associations, tuple(gestures))


def _read(ink: Ink, recognizer: Recognizer) -> tuple[tuple[Claim, ...], Bonds | None]:
    """What the recognizer says of each stroke, and of which strokes are one thing if it has a say in that."""
    return recognizer.read(ink) if isinstance(recognizer, Grouping) else (recognizer.recognize(ink), None)


def notes_of(sketch: Sketch) -> tuple[Note, ...]:
    """The formulas of a page, as if typed beside it: one note for each association, and one for each
    formula without any."""
    anchors: dict[int, list[Point]] = {}
    for association in sketch.associations:
        anchors.setdefault(association.expression, []).append(association.anchor)
    return tuple(
        Note(written.text, written.at, anchor)
        for index, written in enumerate(sketch.expressions)
        if written.text is not None
        for anchor in anchors.get(index, [None])
    )


def _next_best(claim: Claim) -> StrokeKind:
    """What a scribble or lasso is that has no object: the likeliest other kind, where there is one."""
    other = max(DRAWN_KINDS, key=claim.score)
    return other if claim.score(other) > 0 else claim.kind


def _leftover(
    ink: Ink, kinds: Sequence[StrokeKind | None], claims: Sequence[Claim], parts: Sequence[Part]
) -> tuple[list[int], list[int]]:
    """The strokes of arrows, and those of mathematics, among the strokes that drew no solid and no link:
    what their claims prefer, but a mark among letters is a letter."""
    used = {stroke for part in parts for stroke in part.strokes}
    left = [index for index, kind in enumerate(kinds) if kind in DRAWN_KINDS and index not in used]
    pointing = [index for index in left if _points(claims[index])]
    aside = set(pointing)
    writing = [index for index in left if index not in aside]
    letters = among_letters(ink, [(index,) for index in pointing], writing)
    return (
        [index for index, letter in zip(pointing, letters, strict=True) if not letter],
        sorted([*writing, *(index for index, letter in zip(pointing, letters, strict=True) if letter)]),
    )


def _points(claim: Claim) -> bool:
    """Whether a stroke that drew no solid and no link is part of an arrow rather than of mathematics."""
    return claim.score("arrow") > max(claim.score("math"), RULE.arrow)


def _tapped(
    ink: Ink, taps: Sequence[int], solids: Sequence[Part], writing: Sequence[int]
) -> tuple[dict[int, int], set[int]]:
    """Which solid (its position) each tap means, and which taps are points of the writing instead: those
    that lie in no solid, and nearer to the writing or on nothing at all."""
    index = Solids([part.shape for part in solids if isinstance(part.shape, Circle | Polygon)])
    boxes = boxes_of(ink, writing)
    reach = RULE.point * letter_height(boxes) if len(boxes) else 0.0
    tapped: dict[int, int] = {}
    points: set[int] = set()
    for tap in taps:
        spot = _point(ink[tap].points.mean(axis=0))
        inside = bool(near := index.near(spot)) and near[0][0] <= 0
        if not inside and len(boxes) and _gaps(boxes, spot).min() <= reach:
            points.add(tap)
        elif (solid := index.tapped(spot)) is not None:
            tapped[tap] = solid
        elif len(boxes):
            points.add(tap)  # a tap on nothing means nothing; a dot on a page of writing does
    return tapped, points


def _labelled(
    solids: Sequence[Part], held: Sequence[Part], marks: Sequence[Part], tapped: Sequence[int | None]
) -> tuple[Component, ...]:
    """All parts as components, in reading order, which is the order of their labels. A solid that was
    tapped an odd number of times is fixed."""
    parts = [*solids, *held, *marks]
    if not parts:
        return ()
    order = reading_order(np.array([outline(part.shape).mean(axis=0) for part in parts]))
    labels = {position: label(rank) for rank, position in enumerate(order)}
    return tuple(
        Component(
            shape=parts[position].shape,
            strokes=parts[position].strokes,
            label=labels[position],
            fixed=position < len(solids) and tapped.count(position) % 2 == 1,
            ends=(labels[ends[0]], labels[ends[1]]) if (ends := parts[position].ends) else (None, None),
        )
        for position in order
    )


def reading_order(centres: FloatArray, rule: InterpretRule = RULE) -> list[int]:
    """Positions of the centres (n, 2) row by row from the top, each row from the left. A row begins with
    the highest centre left and holds what lies within `rule.row` of the page's height below it."""
    height = float(np.ptp(centres[:, 1])) * rule.row
    row, top = np.zeros(len(centres), dtype=int), -np.inf
    for position in np.argsort(centres[:, 1], kind="stable").tolist():
        if centres[position, 1] > top + height:
            top = float(centres[position, 1])
            row[position] = row.max() + 1
        else:
            row[position] = row.max()
    return np.lexsort((centres[:, 0], row)).tolist()


def _written(
    ink: Ink,
    found: Sequence[tuple[int, ...]],
    notes: Sequence[Note],
    components: Sequence[Component],
    mathematics: Mathematics | None,
) -> tuple[tuple[Expression, ...], tuple[Association, ...]]:
    """The notes as expressions, each with the line of ink it stands at, then the lines that nobody has
    read; and what the notes' anchors associate them with."""
    boxes = np.array([_around(ink, line) for line in found]).reshape(-1, 4)
    strokes = [index for line in found for index in line]
    reach = RULE.note * letter_height(boxes_of(ink, strokes)) if strokes else 0.0
    free = set(range(len(found)))
    expressions: list[Expression] = []
    associations: list[Association] = []
    numbers: dict[tuple[str | None, Point | None], int] = {}
    for note in notes:
        key = (note.text, note.at)
        if key not in numbers:
            numbers[key] = len(expressions)
            line = _line_at(boxes, free, note.at, reach)
            free.discard(-1 if line is None else line)
            owned = () if line is None else found[line]
            if note.text is None:
                expressions.append(_read_line(ink, owned, note.at, mathematics))
            else:
                expressions.append(expression(note.text, owned, note.at))
        if note.anchor is not None and (meant := anchored(components, note.anchor)) is not None:
            associations.append(Association(numbers[key], meant.label, note.anchor))
    for line in sorted(free):
        left, top, right, bottom = boxes[line].tolist()
        middle = ((left + right) / 2, (top + bottom) / 2)
        expressions.append(_read_line(ink, found[line], middle, mathematics))
    return tuple(expressions), tuple(associations)


def _read_line(
    ink: Ink, strokes: tuple[int, ...], at: Point | None, mathematics: Mathematics | None
) -> Expression:
    """A line of handwriting as it is read; without text where nobody reads it or there is nothing to read."""
    if mathematics is None or not strokes:
        return Expression(None, strokes, at)
    read = mathematics([ink[index] for index in strokes])
    if not read.text:
        return Expression(None, strokes, at, confidence=read.confidence)
    others = tuple(text for text, _ in read.alternatives)
    return replace(expression(read.text, strokes, at), confidence=read.confidence, alternatives=others)


def _line_at(boxes: FloatArray, free: set[int], at: Point | None, reach: float) -> int | None:
    """The free line that contains the place or lies nearest to it within reach."""
    if at is None or not free:
        return None
    gaps = _gaps(boxes, at)
    nearest = min(free, key=lambda line: (gaps[line], line))
    return nearest if gaps[nearest] <= reach else None


def _around(ink: Ink, strokes: Sequence[int]) -> FloatArray:
    boxes = boxes_of(ink, strokes)
    return np.concatenate([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])


def _gaps(boxes: FloatArray, spot: Point) -> FloatArray:
    """Distance from the spot to each box, 0 within it: (n,)."""
    outside = np.maximum(np.maximum(boxes[:, :2] - spot, spot - boxes[:, 2:]), 0.0)
    return np.hypot(outside[:, 0], outside[:, 1])


def _point(values: FloatArray) -> Point:
    return (float(values[0]), float(values[1]))
