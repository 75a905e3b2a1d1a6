"""A page as an SVG picture: its ink in grey, what it is taken to be drawn over it in colour.

Frame: page units, y down. Solids that are fixed are hatched; ends of links are full dots where they
are attached and open ones where they are not; dotted lines lead from formulas to what they govern.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sketch.figures import Pen, draw_path, draw_shapes, draw_text
from sketch.ink import FloatArray
from sketch.page import Expression, Sketch
from sketch.shapes import Point, outline

View = tuple[float, float, float, float]
"""Left, top, width, height of what is shown, page units."""


@dataclass(frozen=True, slots=True)
class Look:
    """How a picture looks; lengths in points, of which the picture's longer side has `points`."""

    points: float = 360.0
    margin: float = 12.0
    ink: str = "#b8b8b8"
    gesture: str = "#8cc6ea"
    text: str = "#222222"
    problem: str = "#b00020"
    leader: str = "#777777"
    paper: str | None = "#ffffff"
    text_size: float = 9.0
    letter_width: float = 0.52
    """Of a serif italic, on average, as a share of the text's size."""
    row: float = 1.5
    """Height of a line of text as a share of its size."""


LOOK = Look()


def draw(sketch: Sketch, width: float = 480.0, view: View | None = None, look: Look = LOOK) -> str:
    """The page as an SVG document.

    width: of the picture in pixels; view: the part of the page to show, all of it when None.
    """
    shown = view or view_of(sketch, look)
    pen = pen_for(shown, look)
    stands = _stands(sketch, shown, look)
    pieces = [
        draw_ink(sketch, pen, look),
        draw_shapes(sketch.components, pen),
        *_leaders(sketch, stands, pen, look),
        *(
            _expression(expression, at, pen, look)
            for expression, at in zip(sketch.expressions, stands, strict=True)
            if expression.text is not None
        ),
    ]
    return picture(pieces, shown, width, look)


def picture(pieces: Sequence[str], view: View, width: float = 480.0, look: Look = LOOK) -> str:
    """Pieces of SVG put together as a document, `width` pixels wide."""
    pen = pen_for(view, look)
    box = " ".join(pen.number(value) for value in view)
    x, y, w, h = (pen.number(value) for value in view)
    paper = (
        ""
        if look.paper is None
        else f'<rect x="{x}" y="{y}" width="{w}" height="{h}" fill="{look.paper}"/>\n'
    )
    body = "\n".join(piece for piece in pieces if piece)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="{width:g}" height="{width * view[3] / view[2]:g}">\n'
        f"{paper}{body}\n</svg>\n"
    )


def view_of(sketch: Sketch, look: Look = LOOK) -> View:
    """All of a page with a margin; a square of 100 units for an empty one."""
    extents = [np.reshape(sketch.ink.bounds(), (2, 2))] if sketch.ink.strokes else []
    extents += [outline(component.shape) for component in sketch.components]
    extents += [np.array([association.anchor]) for association in sketch.associations]
    extents += [np.array([expression.at]) for expression in sketch.expressions if expression.at is not None]
    view = view_around(np.concatenate(extents), look) if extents else (0.0, 0.0, 100.0, 100.0)
    return _with_room_for_text(sketch, view, look)


def view_around(points: FloatArray, look: Look = LOOK) -> View:
    """A view of the points, (n, 2), with a margin; never thinner than a fifth of its longer side."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, size = (low + high) / 2, high - low
    longer = float(size.max()) or max(1.0, float(np.abs(middle).max()) * 1e-6)
    size = np.maximum(size, longer / 5) + 2 * look.margin * longer / look.points
    left, top = (middle - size / 2).tolist()
    return (left, top, float(size[0]), float(size[1]))


def pen_for(view: View, look: Look = LOOK) -> Pen:
    """The pen that suits a view."""
    return Pen(max(view[2], view[3]) / look.points)


def draw_ink(sketch: Sketch, pen: Pen, look: Look = LOOK) -> str:
    """The strokes as they were drawn; gestures in a colour of their own."""
    gestures = {gesture.stroke for gesture in sketch.gestures}
    return "\n".join(
        draw_path(stroke.points, pen, look.gesture if index in gestures else look.ink, 1.8)
        for index, stroke in enumerate(sketch.ink)
    )


def _with_room_for_text(sketch: Sketch, view: View, look: Look) -> View:
    """The view, widened for formulas that reach beyond it and with rows above for those without a place."""
    size = look.text_size * pen_for(view, look).unit
    left, top, right, bottom = view[0], view[1], view[0] + view[2], view[1] + view[3]
    for expression in sketch.expressions:
        width = look.letter_width * size * len(expression.text or "")
        place = _place(sketch, expression, size)
        if place is None:
            top -= look.row * size
            right = max(right, left + width)
        else:
            left, right = min(left, place[0] - width / 2), max(right, place[0] + width / 2)
            bottom = max(bottom, place[1] + size)
    return (left, top, right - left, bottom - top)


def _stands(sketch: Sketch, view: View, look: Look) -> list[Point]:
    """Where each formula is written: at its own place, else in a row of its own at the upper left."""
    unit = pen_for(view, look).unit
    stands: list[Point] = []
    row = 0.0
    for expression in sketch.expressions:
        place = _place(sketch, expression, look.text_size * unit)
        if place is None:
            row += look.row * look.text_size * unit
            place = (view[0] + 4 * unit, view[1] + row)
        stands.append(place)
    return stands


def _place(sketch: Sketch, expression: Expression, size: float) -> Point | None:
    """Below its own ink, so that both can be read; where it stands when it has none; None: nowhere."""
    if not expression.strokes:
        return expression.at
    ink = sketch.ink.points_of(expression.strokes)
    low, high = ink.min(axis=0), ink.max(axis=0)
    return (float(low[0] + high[0]) / 2, float(high[1]) + 0.8 * size)


def _expression(expression: Expression, at: Point, pen: Pen, look: Look) -> str:
    colour = look.text if expression.problem is None else look.problem
    anchor = "middle" if expression.strokes or expression.at else "start"
    return draw_text(expression.text or "", at, pen, colour, look.text_size, expression.problem, anchor)


def _leaders(sketch: Sketch, stands: Sequence[Point], pen: Pen, look: Look) -> list[str]:
    return [
        draw_path([stands[association.expression], association.anchor], pen, look.leader, 0.8, dots=True)
        for association in sketch.associations
    ]
