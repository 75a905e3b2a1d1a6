"""What can be done to a page, as values that a log keeps: each turns one board into the next.

`undo` and `redo` are entries of the log like any other (see `studio.history`), so that they, too, outlive the server.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, assert_never, cast

from physics.rectify.correction import RULES, Rule
from sketch.edit import associated, rewritten, without_association
from sketch.files import document
from sketch.files.errors import FileError
from sketch.formula.parse import expression
from sketch.ink import Ink, Stroke
from sketch.page import SketchError
from sketch.shapes import Point
from studio.asked import list_of, number_of, point_of, text_of, whole_of
from studio.board import NOTHING, Board, Selection, loose, moved, places, with_stroke, without
from studio.limits import LIMITS, Refused


@dataclass(frozen=True, slots=True)
class Draw:
    """A stroke, by its name, comes onto the page."""

    stroke: str


@dataclass(frozen=True, slots=True)
class Read:
    """The page is read: its meaning as a document without ink; by whom."""

    meaning: str
    by: str


@dataclass(frozen=True, slots=True)
class Erase:
    strokes: tuple[str, ...] = ()
    components: tuple[str, ...] = ()
    lines: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Select:
    """This and nothing else is selected."""

    strokes: tuple[str, ...] = ()
    components: tuple[str, ...] = ()
    lines: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Move:
    """What is selected is dragged, page units."""

    dx: float
    dy: float


@dataclass(frozen=True, slots=True)
class Fix:
    component: str
    fixed: bool


@dataclass(frozen=True, slots=True)
class Associate:
    """Lines govern a component, where it was tapped."""

    lines: tuple[int, ...]
    component: str
    anchor: Point


@dataclass(frozen=True, slots=True)
class Dissociate:
    line: int
    component: str


@dataclass(frozen=True, slots=True)
class Write:
    """A formula is typed: a new one (line None) that stands at `at`, or in the place of one that is there. strokes:
    the ink that says so, where a new one is what somebody wrote by hand and nobody has read."""

    text: str
    line: int | None = None
    at: Point | None = None
    strokes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Leave:
    """A correction is not to be made."""

    rule: Rule
    component: str


@dataclass(frozen=True, slots=True)
class Correct:
    """A correction that was left out is made again."""

    rule: Rule
    component: str


@dataclass(frozen=True, slots=True)
class Title:
    title: str


@dataclass(frozen=True, slots=True)
class Open:
    """A page comes from a file: its strokes by name, and its meaning as a document without ink."""

    strokes: tuple[str, ...]
    meaning: str
    title: str


Action = (
    Draw
    | Read
    | Erase
    | Select
    | Move
    | Fix
    | Associate
    | Dissociate
    | Write
    | Leave
    | Correct
    | Title
    | Open
)
KINDS: Mapping[str, type[Action]] = {
    kind.__name__.lower(): kind
    for kind in (
        Draw, Read, Erase, Select, Move, Fix, Associate, Dissociate, Write, Leave, Correct, Title, Open,
    )
}  # fmt: skip
BY_HAND = frozenset(KINDS) - {"draw", "read", "open"}
"""What a browser may ask for as it is; the others are the server's own, made of what a browser sends."""
Strokes = Callable[[str], Stroke]


def done(board: Board, action: Action, strokes: Strokes) -> Board:
    """The board after the action; strokes: the raw stroke of a name. Raises Refused for what cannot be done."""
    try:
        return _done(board, action, strokes)
    except (SketchError, FileError) as error:
        raise Refused(str(error)) from None
    except KeyError as missing:
        raise Refused(f"there is no {missing} on this page") from None


def _done(board: Board, action: Action, strokes: Strokes) -> Board:
    sketch = board.sketch
    match action:
        case Draw(name):
            return with_stroke(board, name, strokes(name))
        case Read(meaning):
            read = document.loads_meaning(meaning, sketch.ink, "reading")
            return replace(board, sketch=read, selected=NOTHING, analyzed=True)
        case Erase(names, labels, lines):
            return without(board, set(names), labels, set(lines))
        case Select(names, labels, lines):
            known = Selection(
                frozenset(names) & frozenset(board.names),
                frozenset(sketch.component(label).label for label in labels),
                frozenset(line for line in lines if 0 <= line < len(sketch.expressions)),
            )
            return replace(board, selected=known)
        case Move(dx, dy):
            if not board.selected:
                raise Refused("nothing is selected that could be moved; circle it first")
            return moved(board, dx, dy)
        case Fix(label, fixed):
            sketch.component(label)
            parts = tuple(replace(p, fixed=fixed) if p.label == label else p for p in sketch.components)
            return replace(board, sketch=replace(sketch, components=parts), selected=NOTHING)
        case Associate(lines, label, anchor):
            for line in lines:
                sketch = associated(sketch, line, label, anchor)
            return replace(board, sketch=sketch, selected=NOTHING)
        case Dissociate(line, label):
            return replace(board, sketch=without_association(sketch, line, label), selected=NOTHING)
        case Write():
            return _written(board, action)
        case Leave(rule, label):
            return replace(board, without=board.without | {(rule, label)})
        case Correct(rule, label):
            return replace(board, without=board.without - {(rule, label)})
        case Title(title):
            return replace(board, title=title)
        case Open(names, meaning, title):
            ink = Ink(tuple(strokes(name) for name in names))
            read = document.loads_meaning(meaning, ink, title)
            return Board(names, read, ((0.0, 0.0),) * len(names), title=title, analyzed=bool(read.components))
        case _:
            assert_never(action)


def _written(board: Board, new: Write) -> Board:
    sketch = board.sketch
    if new.line is not None:
        return replace(board, sketch=rewritten(sketch, new.line, new.text, at=new.at), selected=NOTHING)
    if len(sketch.expressions) >= LIMITS.lines:
        raise Refused(f"the page has {LIMITS.lines} formulas, which is the most it may have")
    inked, free = places(board, new.strokes), set(loose(board))
    if not free.issuperset(inked) or len(inked) < len(set(new.strokes)):
        raise Refused("some of that ink is gone or has been read as something else; write the formula again")
    at = new.at
    if inked:
        points = sketch.ink.points_of(inked)
        x, y = ((points.min(axis=0) + points.max(axis=0)) / 2).tolist()
        at = (x, y)
    more = (*sketch.expressions, expression(new.text, inked, at))
    return replace(board, sketch=replace(sketch, expressions=more), selected=NOTHING)


def dumps(action: Action) -> str:
    """An action as JSON, for the log and for browsers."""
    return json.dumps({"do": type(action).__name__.lower(), **asdict(action)})


def loads(text: str) -> Action:
    """What `dumps` made."""
    return from_json(json.loads(text))


def from_json(item: object) -> Action:
    """An action from plain values that anybody may have sent. Raises Refused that says what is wrong."""
    if not isinstance(item, dict):
        raise Refused("an action is an object in braces with a key 'do'")
    given = cast(dict[str, Any], item)
    kind = KINDS.get(str(given.get("do")))
    if kind is None:
        raise Refused(f"no action is called {str(given.get('do'))[:40]!r}; there are {', '.join(KINDS)}")
    wanted = {one.name: str(one.type) for one in fields(kind)}
    unknown = given.keys() - wanted.keys() - {"do"}
    if unknown:
        raise Refused(f"{given['do']} has no {sorted(unknown)[0][:40]!r}; it takes {', '.join(wanted)}")
    values = {name: _value(given[name], of, name) for name, of in wanted.items() if name in given}
    try:
        return kind(**values)
    except TypeError as error:
        raise Refused(f"{given['do']}: {error}") from None


def _value(value: object, of: str, name: str) -> Any:
    """The value as the type that a field declares."""
    match of:
        case "str":
            most = LIMITS.formula if name == "text" else LIMITS.title if name == "title" else None
            return text_of(value, name, most)
        case "Rule":
            if value not in RULES:
                raise Refused(f"{name} must be one of {', '.join(RULES)}")
            return value
        case "bool":
            if not isinstance(value, bool):
                raise Refused(f"{name} must be true or false")
            return value
        case "float":
            return number_of(value, name)
        case "int" | "int | None":
            return None if value is None and of != "int" else whole_of(value, name)
        case "Point" | "Point | None":
            return None if value is None and of != "Point" else point_of(value, name)
        case "tuple[int, ...]":
            return tuple(whole_of(one, name) for one in list_of(value, name))
        case _:
            return tuple(text_of(one, name, 80) for one in list_of(value, name))
