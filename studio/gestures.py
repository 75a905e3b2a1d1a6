"""What a stroke does to a page that may have been read already (row P3): draw, select, erase or tap.

The recognizers tell; here it is settled on what. They look at the page as it is shown, where clean shapes stand in the
place of the ink that drew them. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely

from recognizer.attach import Solids
from recognizer.claims import Recognizer
from recognizer.erase import erased, without_object
from sketch.figures import coil
from sketch.geometry import diagonal
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import Component, Expression, Sketch, StrokeKind
from sketch.shapes import Arrow, Circle, Point, Polygon, Spring, Wire, outline
from studio.actions import Action, Associate, Draw, Erase, Fix, Select
from studio.board import Board

Said = Literal["drawn", "lasso", "scribble", "tap"]


@dataclass(frozen=True, slots=True)
class GestureRule:
    """What is near enough, and what a gesture may be."""

    tap: float = 6.0
    """Page units: a stroke that spans less is a tap, whatever it looks like; people's hands tremble."""
    link: float = 14.0
    """Page units from a wire, spring or arrow within which a tap means it."""
    enclosed: float = 0.75
    """Share of a thing's points within a lasso from which it is taken."""
    around: float = 40.0
    """Page units around the stroke within which ink is shown to the recognizer, the latest strokes of it."""
    latest: int = 80
    letter: float = 9.0
    """Half the width that a typed letter is taken to have, page units, and 1.6 of it half its height."""


RULE = GestureRule()


@dataclass(frozen=True, slots=True)
class Thing:
    """A thing on the page as it is shown: whose the path is, a stroke's name, a label or a line's number."""

    kind: Literal["stroke", "component", "line"]
    name: str
    path: FloatArray


@dataclass(frozen=True, slots=True)
class Understood:
    """What a stroke was taken for, what is to be done about it (None: nothing), and in words."""

    said: Said
    action: Action | None
    words: str


def understood(board: Board, shown: Sketch, name: str, stroke: Stroke, recognizer: Recognizer) -> Understood:
    """What a stroke means on a board; shown: the corrected page, which is what the person sees.

    The first that fits: a tap on a shape or a formula; a scribble over something; a lasso around something; otherwise
    it draws.
    """
    things = _things(board, shown)
    if diagonal(stroke.points) <= RULE.tap:
        return _tapped(board, shown, _middle(stroke.points), name)
    near = [thing for thing in things if _meets(thing.path, stroke.points)][-RULE.latest :]
    seen = Ink((*(Stroke(path) for thing in near for path in _looks(thing)), stroke))
    ink = Ink((*(Stroke(thing.path) for thing in near), stroke))
    kind = recognizer.recognize(seen)[-1]
    last = len(near)
    kinds: list[StrokeKind | None] = [*("math" for _ in near), kind.kind]
    if kind.kind not in ("lasso", "scribble") or last in without_object(ink, kinds):
        return Understood("drawn", Draw(name), "")
    if kind.kind == "scribble":
        gone = [near[index] for index in sorted(erased(ink, kinds))]
        return _erasing(board, gone) if gone else Understood("drawn", Draw(name), "")
    taken = [thing for thing in things if _inside(stroke.points, thing.path) >= RULE.enclosed]
    return _selecting(taken) if taken else Understood("drawn", Draw(name), "")


def _things(board: Board, shown: Sketch) -> list[Thing]:
    """Everything that is to be seen, loose ink in the order in which it was drawn last."""
    owned = {stroke for part in shown.components for stroke in part.strokes}
    hidden = owned | {gesture.stroke for gesture in board.sketch.gestures}
    return [
        *(Thing("component", part.label, _path(part)) for part in shown.components),
        *(
            Thing("line", str(number), _typed(line))
            for number, line in enumerate(shown.expressions)
            if line.text is not None and line.at is not None and not line.strokes
        ),
        *(
            Thing("stroke", name, board.sketch.ink[index].points)
            for index, name in enumerate(board.names)
            if index not in hidden
        ),
    ]


def _path(part: Component) -> FloatArray:
    return coil(part.shape) if isinstance(part.shape, Spring) else outline(part.shape)


def _typed(line: Expression) -> FloatArray:
    """The rim of the box that a formula without ink is shown in."""
    assert line.at is not None and line.text is not None
    wide, high = RULE.letter * max(2, len(line.text)) / 2, 1.6 * RULE.letter
    x, y = line.at
    return np.array(
        [[x - wide, y - high], [x + wide, y - high], [x + wide, y + high], [x - wide, y + high], [x - wide, y - high]]
    )  # fmt: skip


def _looks(thing: Thing) -> list[FloatArray]:
    """What a recognizer is shown of a thing: a typed formula looks like writing, not like a box."""
    if thing.kind != "line":
        return [thing.path]
    (left, top), (right, bottom) = thing.path.min(axis=0).tolist(), thing.path.max(axis=0).tolist()
    angle = np.linspace(0.0, 5.8, 14)  # an open bow, as of a c
    bow = np.column_stack([0.35 * RULE.letter * np.cos(angle), 0.3 * (bottom - top) * np.sin(angle)])
    count = max(2, round((right - left) / RULE.letter))
    middles = [(left + (k + 0.5) * (right - left) / count, (top + bottom) / 2) for k in range(count)]
    return [bow + np.array(middle) for middle in middles]


def _meets(path: FloatArray, stroke: FloatArray) -> bool:
    low, high = stroke.min(axis=0) - RULE.around, stroke.max(axis=0) + RULE.around
    return bool(np.all(path.max(axis=0) >= low) and np.all(path.min(axis=0) <= high))


def _inside(lasso: FloatArray, path: FloatArray) -> float:
    """Share of the path within the lasso, closed by a straight line where it stands open."""
    ring = shapely.Polygon(lasso) if len(lasso) > 3 else shapely.LineString(lasso)
    area = shapely.union_all([shapely.make_valid(ring)]) if not ring.is_valid else ring
    return float(shapely.contains_xy(area, *path.T).mean())


def _tapped(board: Board, shown: Sketch, at: Point, name: str) -> Understood:
    chosen = tuple(sorted(board.selected.lines))
    part = _under(shown, at, links=bool(chosen))
    if part is None:
        if board.selected:
            return Understood("tap", Select(), "Let go.")
        return Understood("drawn", Draw(name), "")
    if chosen:
        what = ", ".join(board.sketch.expressions[line].text or "what is not read yet" for line in chosen)
        return Understood("tap", Associate(chosen, part.label, at), f"{what} is said of {part.label} now.")
    if board.selected.strokes and not board.selected.components:
        return Understood(
            "tap", None, "These strokes have not been read yet: Analyze first, or type what they say; then circle and tap."
        )  # fmt: skip
    fixed = not part.fixed
    return Understood(
        "tap", Fix(part.label, fixed), f"{part.label} {'stays where it is' if fixed else 'can move'} now."
    )


def _under(shown: Sketch, at: Point, links: bool) -> Component | None:
    """The component that a tap means; links: springs, wires and arrows too, which lie over solids."""
    if links:
        spot = shapely.Point(at)
        lines = [part for part in shown.components if isinstance(part.shape, Spring | Wire | Arrow)]
        near = [(shapely.LineString(outline(part.shape)).distance(spot), part.label, part) for part in lines]
        within = [one for one in near if one[0] <= RULE.link]
        if within:
            return min(within)[2]
    solids = [part for part in shown.components if isinstance(part.shape, Circle | Polygon)]
    index = Solids([part.shape for part in solids if isinstance(part.shape, Circle | Polygon)])
    found = index.tapped(at) if solids else None
    return None if found is None else solids[found]


def _erasing(board: Board, gone: Sequence[Thing]) -> Understood:
    strokes, labels, lines = _parted(gone)
    action = Erase(strokes, labels, lines)
    what = [*labels, *((_count(len(strokes), "stroke"),) if strokes else ())]
    what += [board.sketch.expressions[line].text or "a formula" for line in lines]
    return Understood("scribble", action, f"Erased {' and '.join(what)}.")


def _selecting(taken: Sequence[Thing]) -> Understood:
    strokes, labels, lines = _parted(taken)
    return Understood("lasso", Select(strokes, labels, lines), "")


def with_lines(board: Board, chosen: Select) -> Select:
    """A selection in which lines of mathematics of whose ink the better part is taken are taken as lines."""
    taken = set(chosen.strokes)
    lines = set(chosen.lines)
    for number, line in enumerate(board.sketch.expressions):
        inked = [board.names[stroke] for stroke in line.strokes]
        if inked and 2 * sum(name in taken for name in inked) > len(inked):
            lines.add(number)
            taken -= set(inked)
    return Select(tuple(sorted(taken)), chosen.components, tuple(sorted(lines)))


def _parted(things: Sequence[Thing]) -> tuple[tuple[str, ...], tuple[str, ...], tuple[int, ...]]:
    return (
        tuple(thing.name for thing in things if thing.kind == "stroke"),
        tuple(thing.name for thing in things if thing.kind == "component"),
        tuple(int(thing.name) for thing in things if thing.kind == "line"),
    )


def _count(n: int, what: str) -> str:
    return f"{n} {what}{'' if n == 1 else 's'}"


def _middle(points: FloatArray) -> Point:
    x, y = points.mean(axis=0).tolist()
    return (x, y)
