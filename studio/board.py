"""A page of the studio: its ink by name, what it is taken to mean, and what is selected.

A board is a value. What people do to it are the actions of `studio.actions`, each a function from one board to the
next, so that a page is the fold of its log, and undo is the board before. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace

from physics.rectify import Key
from physics.rectify.correction import carried
from sketch.edit import without_component, without_line
from sketch.geometry import contains
from sketch.ink import Ink, Stroke
from sketch.page import Component, Expression, Gesture, Sketch
from sketch.shapes import Circle, Point, Polygon, Spring, Wire


@dataclass(frozen=True, slots=True)
class Selection:
    """What a lasso has taken: strokes by name, components by label, lines of mathematics by number."""

    strokes: frozenset[str] = frozenset()
    components: frozenset[str] = frozenset()
    lines: frozenset[int] = frozenset()

    def __bool__(self) -> bool:
        return bool(self.strokes or self.components or self.lines)


NOTHING = Selection()


@dataclass(frozen=True, slots=True)
class Board:
    """names: of the strokes of the sketch's ink, in step; sketch: the page as drawn and read, before correction;
    offsets: how far each stroke has been dragged from where the pen put it; without: corrections that are
    not to be made; analyzed: whether anybody has read the page."""

    names: tuple[str, ...] = ()
    sketch: Sketch = field(default_factory=Sketch)
    offsets: tuple[Point, ...] = ()
    without: frozenset[Key] = frozenset()
    selected: Selection = NOTHING
    title: str = ""
    analyzed: bool = False


def with_stroke(board: Board, name: str, stroke: Stroke) -> Board:
    """One stroke more; what was selected is let go."""
    return replace(
        board,
        names=(*board.names, name),
        offsets=(*board.offsets, (0.0, 0.0)),
        sketch=replace(board.sketch, ink=Ink((*board.sketch.ink, stroke))),
        selected=NOTHING,
    )


def without(
    board: Board, strokes: Collection[str], components: Collection[str] = (), lines: Collection[int] = ()
) -> Board:
    """The board with these erased. A component goes with its ink and the taps on it, a line with its ink; a line
    of which only some ink is erased stays, with all that it governs (row P5), and is to be read again (row R4)."""
    sketch = board.sketch
    gone = {index for index, name in enumerate(board.names) if name in strokes}
    for label in components:
        part = sketch.component(label)
        gone |= {*part.strokes, *_taps_on(sketch, part)}
        sketch = without_component(sketch, label)
    emptied = [
        number
        for number, line in enumerate(sketch.expressions)
        if number in lines or (line.strokes and gone.issuperset(line.strokes))
    ]
    for number in reversed(emptied):
        gone |= set(sketch.expressions[number].strokes)
        sketch = without_line(sketch, number)
    lines_left = tuple(
        unread(line) if gone.intersection(line.strokes) else line for line in sketch.expressions
    )
    return _kept(replace(board, sketch=replace(sketch, expressions=lines_left), selected=NOTHING), gone)


def unread(line: Expression) -> Expression:
    """A line whose ink is not what it was read from any more."""
    return Expression(None, line.strokes, line.at)


def _taps_on(sketch: Sketch, part: Component) -> set[int]:
    shape = part.shape
    if not isinstance(shape, Circle | Polygon):
        return set()
    taps = (gesture.stroke for gesture in sketch.gestures if gesture.kind == "tap")
    return {tap for tap in taps if contains(shape, _middle(sketch.ink[tap]))}


def _middle(stroke: Stroke) -> Point:
    x, y = stroke.points.mean(axis=0).tolist()
    return (x, y)


def _kept(board: Board, gone: Collection[int]) -> Board:
    """Without these strokes; all that names strokes by their places names the new ones."""
    sketch, kept = board.sketch, [index for index in range(len(board.names)) if index not in gone]
    place = {old: new for new, old in enumerate(kept)}

    def those(strokes: Iterable[int]) -> tuple[int, ...]:
        return tuple(place[index] for index in strokes if index in place)

    return replace(
        board,
        names=tuple(board.names[index] for index in kept),
        offsets=tuple(board.offsets[index] for index in kept),
        sketch=Sketch(
            Ink(tuple(sketch.ink[index] for index in kept)),
            tuple(replace(part, strokes=those(part.strokes)) for part in sketch.components),
            tuple(replace(line, strokes=those(line.strokes)) for line in sketch.expressions),
            sketch.associations,
            tuple(Gesture(one.kind, place[one.stroke]) for one in sketch.gestures if one.stroke in place),
        ),
    )


def moved(board: Board, dx: float, dy: float) -> Board:
    """What is selected, dragged: ink, shapes with their taps and with the near ends of what hangs on them, formulas;
    the places where formulas were tapped go along with what they were tapped on."""
    chosen, sketch = board.selected, board.sketch
    parts = [part for part in sketch.components if part.label in chosen.components]
    lines = [
        sketch.expressions[number] for number in sorted(chosen.lines) if number < len(sketch.expressions)
    ]
    going = {index for index, name in enumerate(board.names) if name in chosen.strokes}
    going.update(index for part in parts for index in (*part.strokes, *_taps_on(sketch, part)))
    going.update(index for line in lines for index in line.strokes)
    shift = [dx, dy]
    ink = Ink(
        tuple(
            stroke.moved_to(stroke.points + shift) if index in going else stroke
            for index, stroke in enumerate(sketch.ink)
        )
    )
    return replace(
        board,
        offsets=tuple(
            (x + dx, y + dy) if index in going else (x, y) for index, (x, y) in enumerate(board.offsets)
        ),
        sketch=replace(
            sketch,
            ink=ink,
            components=tuple(_carried(part, chosen.components, dx, dy) for part in sketch.components),
            expressions=tuple(
                _line_moved(line, dx, dy) if number in chosen.lines else line
                for number, line in enumerate(sketch.expressions)
            ),
            associations=tuple(
                replace(one, anchor=(one.anchor[0] + dx, one.anchor[1] + dy))
                if one.component in chosen.components
                else one
                for one in sketch.associations
            ),
        ),
    )


def _carried(part: Component, labels: Collection[str], dx: float, dy: float) -> Component:
    def place(point: Point) -> Point:
        return (point[0] + dx, point[1] + dy)

    if part.label in labels:
        return replace(part, shape=carried(part.shape, place))
    shape = part.shape
    if isinstance(shape, Spring | Wire) and any(end in labels for end in part.ends if end is not None):
        start, end = (
            place(point) if label in labels else point
            for label, point in zip(part.ends, (shape.start, shape.end), strict=True)
        )
        if start != end:
            return replace(part, shape=replace(shape, start=start, end=end))
    return part


def _line_moved(line: Expression, dx: float, dy: float) -> Expression:
    return line if line.at is None else replace(line, at=(line.at[0] + dx, line.at[1] + dy))


def loose(board: Board) -> list[int]:
    """The strokes, by their places, that nobody has read yet."""
    return [index for index, kind in enumerate(board.sketch.kinds()) if kind is None]


def titled(board: Board) -> str:
    """What a page is called: its name, or its first formulas."""
    if board.title:
        return board.title
    written = [line.text for line in board.sketch.expressions if line.text]
    return ", ".join(written[:3]) if written else "Untitled"


def places(board: Board, names: Sequence[str]) -> tuple[int, ...]:
    """Where strokes stand in the ink, by their names; those that are not there are left out."""
    place = {name: index for index, name in enumerate(board.names)}
    return tuple(sorted(place[name] for name in names if name in place))
