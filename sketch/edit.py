"""Edits of a page's meaning that leave everything else as it is, associations above all (row P5).

    page = rewritten(page, 2, "m = 3")          # what was associated with line 2 still is
    page = associated(page, 2, "A", (310, 120))

Each takes a page and returns another. Frame: page units, y down. All raise SketchError for a line or a
component that is not there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sketch.formula.parse import expression as read
from sketch.page import Association, Component, Expression, Sketch, SketchError
from sketch.shapes import Point


def rewritten(
    sketch: Sketch, line: int, text: str, strokes: Sequence[int] | None = None, at: Point | None = None
) -> Sketch:
    """The page with a line of mathematics written anew; its associations outlive that. strokes, at: those
    of the new writing, where there is one; otherwise those that the line had."""
    old = _line(sketch, line)
    new = replace(
        read(text),
        strokes=old.strokes if strokes is None else tuple(strokes),
        at=old.at if at is None else at,
    )
    return replace(sketch, expressions=(*sketch.expressions[:line], new, *sketch.expressions[line + 1 :]))


def without_line(sketch: Sketch, line: int) -> Sketch:
    """The page with a line of mathematics erased, and all that it was associated with let go."""
    _line(sketch, line)
    kept = [one for one in sketch.associations if one.expression != line]
    return replace(
        sketch,
        expressions=(*sketch.expressions[:line], *sketch.expressions[line + 1 :]),
        associations=tuple(replace(one, expression=one.expression - (one.expression > line)) for one in kept),
    )


def associated(sketch: Sketch, line: int, component: str, anchor: Point) -> Sketch:
    """The page with a line associated with a component, where it was tapped. Once associated already, it is so
    at the new place, and newest: the newest association wins where two contradict each other."""
    _line(sketch, line)
    _component(sketch, component)
    others = without_association(sketch, line, component).associations
    return replace(sketch, associations=(*others, Association(line, component, anchor)))


def without_association(sketch: Sketch, line: int, component: str) -> Sketch:
    """The page with a line that has nothing to do with a component any more; both stay."""
    kept = (one for one in sketch.associations if (one.expression, one.component) != (line, component))
    return replace(sketch, associations=tuple(kept))


def without_component(sketch: Sketch, label: str) -> Sketch:
    """The page with a component erased. What hung on it hangs free; lines that were associated with it stay."""
    _component(sketch, label)
    return replace(
        sketch,
        components=tuple(_let_go(part, label) for part in sketch.components if part.label != label),
        associations=tuple(one for one in sketch.associations if one.component != label),
    )


def _let_go(part: Component, label: str) -> Component:
    if label not in part.ends:
        return part
    start, end = part.ends
    return replace(part, ends=(None if start == label else start, None if end == label else end))


def _line(sketch: Sketch, line: int) -> Expression:
    if not 0 <= line < len(sketch.expressions):
        raise SketchError(f"there is no line {line} of mathematics; the page has {len(sketch.expressions)}")
    return sketch.expressions[line]


def _component(sketch: Sketch, label: str) -> Component:
    try:
        return sketch.component(label)
    except KeyError:
        there = ", ".join(part.label for part in sketch.components) or "nothing"
        raise SketchError(f"there is no component {label!r}; the page has {there}") from None
