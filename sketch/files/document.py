"""The project's own document, `.inklined`: a page with its meaning, as JSON.

    {"format": "inklined", "version": 1,
     "ink": [{"points": [[x, y], …], "times": [s, …], "pressure": [p, …]}, …],
     "components": [{"label": "A", "shape": {"kind": "circle", "centre": [x, y], "radius": r},
                     "strokes": [0], "fixed": false, "ends": [null, "B"]}, …],
     "expressions": [{"text": "g = 10", "strokes": [], "at": [x, y], "confidence": 1.0, "alternatives": []}, …],
     "associations": [{"expression": 0, "component": "A", "anchor": [x, y]}, …],
     "gestures": [{"kind": "tap", "stroke": 3}, …]}

Page units, y down; times in seconds. Numbers are written so that reading gives the same page to
the bit. Formulas are kept as text and read again on loading. What a key may be left out is what the
page's types have a default for.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar, assert_never, cast

import numpy as np

from sketch.files.errors import FileError
from sketch.files.store import read_text, write_text
from sketch.formula.parse import expression
from sketch.ink import Ink, InkError, Stroke
from sketch.page import (
    GESTURE_KINDS,
    Association,
    Component,
    Expression,
    Gesture,
    Sketch,
    SketchError,
)
from sketch.shapes import Arrow, Circle, Point, Polygon, Shape, ShapeError, Spring, Wire, kind_of

FORMAT = "inklined"
VERSION = 1

Json = Mapping[str, Any]
T = TypeVar("T")


def read(path: str | Path) -> Sketch:
    """The page in a `.inklined` file (packed when the name ends in .gz). Raises FileError."""
    return loads(read_text(path), source=path)


def write(path: str | Path, sketch: Sketch) -> None:
    """Save the page, whole or not at all. Raises FileError when the folder cannot be written to."""
    write_text(path, dumps(sketch))


def dumps(sketch: Sketch) -> str:
    """The page as a JSON document, one stroke or part of the page on a line."""
    ink = f'"ink": [{_lines([_of_stroke(stroke) for stroke in sketch.ink])}]'
    return f'{{"format": "{FORMAT}", "version": {VERSION},\n{ink},\n{_meaning(sketch)}}}\n'


def dumps_meaning(sketch: Sketch) -> str:
    """The same document without the ink: for whoever keeps the ink elsewhere."""
    return f'{{"format": "{FORMAT}", "version": {VERSION},\n{_meaning(sketch)}}}\n'


def _meaning(sketch: Sketch) -> str:
    parts = {
        "components": [_of_component(component) for component in sketch.components],
        "expressions": [_of_expression(expression) for expression in sketch.expressions],
        "associations": [
            {"expression": a.expression, "component": a.component, "anchor": a.anchor}
            for a in sketch.associations
        ],
        "gestures": [{"kind": gesture.kind, "stroke": gesture.stroke} for gesture in sketch.gestures],
    }
    return ",\n".join(f'"{name}": [{_lines(items)}]' for name, items in parts.items())


def loads(text: str, source: str | Path = "document") -> Sketch:
    """The page in a JSON document; `source` is what an error calls it.

    Raises FileError for text that is no JSON, no inklined document, of a newer version, or that holds
    what no page can.
    """
    document = _document(text, source)
    return _with_meaning(document, _Reader(source).each(document, "ink", _stroke), source)


def loads_meaning(text: str, ink: Ink, source: str | Path = "document") -> Sketch:
    """The page of this ink with the meaning in a document of `dumps_meaning`. Raises FileError as `loads`."""
    return _with_meaning(_document(text, source), ink.strokes, source)


def _document(text: str, source: str | Path) -> Json:
    try:
        document = json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        raise FileError(source, f"is not JSON: {error.msg}", f"line {error.lineno}") from None
    except (ValueError, RecursionError) as error:
        raise FileError(source, f"is not JSON that can be read: {error}") from None
    _check_version(document, source)
    return cast(Json, document)


def _with_meaning(document: Json, strokes: tuple[Stroke, ...], source: str | Path) -> Sketch:
    reader = _Reader(source)
    try:
        return Sketch(
            Ink(strokes),
            components=reader.each(document, "components", _component),
            expressions=reader.each(document, "expressions", _expression),
            associations=reader.each(document, "associations", _association),
            gestures=reader.each(document, "gestures", _gesture),
        )
    except (InkError, SketchError) as error:
        raise FileError(source, str(error)) from None


def _check_version(document: object, source: str | Path) -> None:
    if not isinstance(document, dict) or cast(Json, document).get("format") != FORMAT:
        raise FileError(source, f'is not an inklined document, which begins with {{"format": "{FORMAT}"')
    version = cast(Json, document).get("version")
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        raise FileError(source, f"has version {version!r}; a whole number from 1 to {VERSION} is read")
    if version > VERSION:
        raise FileError(
            source,
            f"is of version {version}, this inklined reads up to {VERSION}; update inklined to open it",
        )


class _Malformed(ValueError):
    """What is wrong with one item; the reader adds which."""


class _Reader:
    """Reads the document's lists and names the item that could not be read."""

    def __init__(self, source: str | Path) -> None:
        self._source = source

    def each(self, document: Json, name: str, read_item: Callable[[Json], T]) -> tuple[T, ...]:
        items = document.get(name, [])
        if not isinstance(items, list):
            raise FileError(self._source, f"{name} must be a list")
        return tuple(
            self._item(name, index, item, read_item) for index, item in enumerate(cast(list[object], items))
        )

    def _item(self, name: str, index: int, item: object, read_item: Callable[[Json], T]) -> T:
        place = f"{name}[{index}]"
        if not isinstance(item, dict):
            raise FileError(self._source, "must be an object in braces", place)
        try:
            return read_item(cast(Json, item))
        except KeyError as missing:
            raise FileError(self._source, f"lacks {missing}", place) from None
        except (_Malformed, InkError, ShapeError) as error:
            raise FileError(self._source, str(error), place) from None


def _of_stroke(stroke: Stroke) -> Json:
    channels = {"points": stroke.points, "times": stroke.times, "pressure": stroke.pressure}
    return {name: channel.tolist() for name, channel in channels.items() if channel is not None}


def _stroke(item: Json) -> Stroke:
    points = [
        _point(point, f"points[{index}]") for index, point in enumerate(_list(item["points"], "points"))
    ]
    channels = (
        None if item.get(name) is None else _numbers(item[name], name) for name in ("times", "pressure")
    )
    return Stroke(points, *channels)


def _of_component(component: Component) -> Json:
    return {
        "label": component.label,
        "shape": _of_shape(component.shape),
        "strokes": component.strokes,
        "fixed": component.fixed,
        "ends": component.ends,
    }


def _component(item: Json) -> Component:
    ends = _list(item.get("ends", [None, None]), "ends")
    if len(ends) != 2:
        raise _Malformed(f"ends has {len(ends)} entries; it needs two, labels or null")
    return Component(
        shape=_shape(_typed(item["shape"], dict, "shape", "an object in braces")),
        strokes=_indices(item.get("strokes", [])),
        label=_typed(item["label"], str, "label", "text"),
        fixed=_typed(item.get("fixed", False), bool, "fixed", "true or false"),
        ends=(_text_or_none(ends[0], "ends"), _text_or_none(ends[1], "ends")),
    )


def _of_shape(shape: Shape) -> Json:
    kind = {"kind": kind_of(shape)}
    match shape:
        case Circle(centre, radius):
            return {**kind, "centre": centre, "radius": radius}
        case Polygon():
            return {**kind, "vertices": shape.vertices.tolist()}
        case Spring(start, end, coils, width):
            return {**kind, "start": start, "end": end, "coils": coils, "width": width}
        case Wire(start, end) | Arrow(start, end):
            return {**kind, "start": start, "end": end}
        case _:
            assert_never(shape)


def _shape(item: Json) -> Shape:
    match item.get("kind"):
        case "circle":
            return Circle(_point(item["centre"], "centre"), _number(item["radius"], "radius"))
        case "polygon":
            return Polygon([_point(vertex, "vertices") for vertex in _list(item["vertices"], "vertices")])
        case "spring":
            return Spring(*_ends(item), _number(item["coils"], "coils"), _number(item["width"], "width"))
        case "wire":
            return Wire(*_ends(item))
        case "arrow":
            return Arrow(*_ends(item))
        case kind:
            raise _Malformed(f"a shape of kind {kind!r}; known are circle, polygon, spring, wire, arrow")


def _ends(item: Json) -> tuple[Point, Point]:
    return _point(item["start"], "start"), _point(item["end"], "end")


def _of_expression(expression: Expression) -> Json:
    return {
        "text": expression.text,
        "strokes": expression.strokes,
        "at": expression.at,
        "confidence": expression.confidence,
        "alternatives": expression.alternatives,
    }


def _expression(item: Json) -> Expression:
    text = _text_or_none(item["text"], "text")
    at = None if item.get("at") is None else _point(item["at"], "at")
    strokes = _indices(item.get("strokes", []))
    alternatives = _list(item.get("alternatives", []), "alternatives")
    return replace(
        Expression(None, strokes, at) if text is None else expression(text, strokes, at),
        confidence=_number(item.get("confidence", 1.0), "confidence"),
        alternatives=tuple(_typed(other, str, "alternatives", "texts") for other in alternatives),
    )


def _association(item: Json) -> Association:
    return Association(
        expression=_typed(item["expression"], int, "expression", "a whole number"),
        component=_typed(item["component"], str, "component", "a label"),
        anchor=_point(item["anchor"], "anchor"),
    )


def _gesture(item: Json) -> Gesture:
    kind = item["kind"]
    if kind not in GESTURE_KINDS:
        raise _Malformed(f"a gesture of kind {kind!r}; known are {', '.join(GESTURE_KINDS)}")
    return Gesture(kind, _typed(item["stroke"], int, "stroke", "a whole number"))


def _typed(value: object, kind: type[T], name: str, wanted: str) -> T:
    if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
        raise _Malformed(f"{name} is {_shown(value)}; it must be {wanted}")
    return value


def _text_or_none(value: object, name: str) -> str | None:
    return None if value is None else _typed(value, str, name, "text or null")


def _number(value: object, name: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _Malformed(f"{name} is {_shown(value)}; it must be a number")
    try:
        number = float(value)
    except OverflowError:
        number = float("inf")
    if abs(number) == float("inf"):
        raise _Malformed(f"{name} is {_shown(value)}; it must be a finite number")
    return number


def _list(value: object, name: str) -> list[object]:
    return cast(list[object], _typed(value, list, name, "a list"))


def _numbers(value: object, name: str) -> list[float]:
    return [_number(entry, f"{name}[{index}]") for index, entry in enumerate(_list(value, name))]


def _indices(value: object) -> tuple[int, ...]:
    return tuple(_typed(entry, int, "strokes", "whole numbers") for entry in _list(value, "strokes"))


def _point(value: object, name: str) -> Point:
    numbers = _numbers(value, name)
    if len(numbers) != 2:
        raise _Malformed(f"{name} has {len(numbers)} numbers; a point has two, x and y")
    return (numbers[0], numbers[1])


def _shown(value: object, most: int = 40) -> str:
    text = json.dumps(value)
    return text if len(text) <= most else text[:most] + "…"


def _lines(items: Sequence[Json]) -> str:
    return ",".join(f"\n  {json.dumps(item, allow_nan=False, default=_native)}" for item in items)


def _native(value: object) -> object:
    """numpy's numbers, which shapes computed with it may hold, as Python's."""
    if isinstance(value, np.generic):
        return cast(object, value.item())
    raise TypeError(f"{value!r} cannot be written to a document")


def _refuse_constant(name: str) -> float:
    raise ValueError(f"{name} stands in it; numbers must be finite")
