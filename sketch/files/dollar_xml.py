"""Gestures in the XML of the $-family's data sets: $1's, one stroke a file, and $N's, with <Stroke> elements.

    <Gesture Name="arrow01" Subject="2" Speed="slow" …> <Point X="43" Y="230" T="11405472" Pressure="128"/> … </Gesture>

A file is one drawing. Its label is the name without the number of the repetition (`arrow01`, `T~01`, `T-01`), its writer
the subject. All attributes are kept as they are in the row's extra `gesture`, so that writing gives them back; Y grows
downward, T is milliseconds, Pressure the device's own.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal, InvalidOperation
from itertools import pairwise
from pathlib import Path
from typing import Any, cast
from xml.sax.saxutils import quoteattr

from sketch.files import xml_tree
from sketch.files.decimals import plainly, shifted, unshifted
from sketch.files.errors import FileError, Notice
from sketch.files.jsonl import Loaded, Row
from sketch.files.store import read_bytes, write_text
from sketch.files.xml_tree import Element
from sketch.ink import Ink, InkError, Stroke

_REPETITION = re.compile(r"[~_\- ]?\d+$")
_MILLI = 3


def read(path: str | Path) -> Loaded:
    """The drawing of a file, as its only row. Raises FileError."""
    return parse(xml_tree.parse(read_bytes(path), path), path)


def parse(root: Element, source: str | Path) -> Loaded:
    """The drawing of a file that is parsed already. Raises FileError."""
    if root.name != "Gesture":
        raise FileError(
            source, f"its outermost element is <{root.name}>; a gesture has <Gesture>", f"line {root.line}"
        )
    within = list(root.named("Stroke"))
    notices: list[Notice] = []
    try:
        ink = Ink(tuple(_stroke(element, source, notices) for element in (within or [root])))
    except InkError as error:
        raise FileError(source, str(error)) from None
    name = root.attributes.get("Name")
    extra = {"gesture": {"attributes": dict(root.attributes), "stroke_elements": bool(within)}}
    return Loaded(
        (Row(label_of(name), ink, root.attributes.get("Subject"), cast(dict[str, Any], extra)),),
        tuple(notices),
    )


def label_of(name: str | None) -> str | None:
    """The name without the number of the repetition; a name that is a number only stays."""
    return None if name is None else _REPETITION.sub("", name) or name


def write(path: str | Path, row: Row) -> None:
    """Saves a drawing, whole or not at all. Raises FileError as `dumps`, and where it cannot be written."""
    write_text(path, dumps(row, path))


def dumps(row: Row, source: str | Path = "gesture") -> str:
    """The drawing as XML: with <Stroke> elements unless it is one stroke that came without one. Raises FileError for a row
    without strokes, whose `gesture` is not what `read` makes of one, or with a character that XML has not."""
    attributes, elements = _form(row, source)
    if not len(row.ink):
        raise FileError(source, "a drawing without strokes cannot be written as a gesture")
    head = "".join(f" {name}={quoteattr(value)}" for name, value in attributes.items())
    if len(row.ink) == 1 and not elements:
        body = _points(row.ink[0], "  ")
    else:
        body = "".join(
            f'  <Stroke index="{k}">\n{_points(stroke, "    ")}  </Stroke>\n'
            for k, stroke in enumerate(row.ink, start=1)
        )
    return f'<?xml version="1.0" encoding="utf-8" standalone="yes"?>\n<Gesture{head}>\n{body}</Gesture>\n'


def _form(row: Row, source: str | Path) -> tuple[dict[str, str], bool]:
    """The attributes to write, and whether strokes have elements. What the row says of itself goes before."""
    kept: Any = row.extra.get("gesture", {})
    if not isinstance(kept, Mapping) or not isinstance(
        cast(Mapping[str, Any], kept).get("attributes", {}), Mapping
    ):
        raise FileError(source, 'its "gesture" must hold "attributes", names with texts')
    form = cast(Mapping[str, Any], kept)
    attributes = {
        str(name): str(value)
        for name, value in cast(Mapping[str, object], form.get("attributes", {})).items()
    }
    bad = next((name for name in attributes if not re.fullmatch(r"[A-Za-z_][\w.-]*", name)), None)
    if bad is not None:
        raise FileError(source, f"{bad!r} cannot be the name of an attribute")
    if row.label is not None and label_of(attributes.get("Name")) != row.label:
        attributes["Name"] = row.label
    if row.writer is not None:
        attributes["Subject"] = row.writer
    for name, value in attributes.items():
        if xml_tree.UNWRITABLE.search(value):
            raise FileError(source, f"{name} {value!r} holds a character that XML has not")
    return attributes, bool(form.get("stroke_elements"))


def _points(stroke: Stroke, indent: str) -> str:
    columns = {"X": stroke.points[:, 0], "Y": stroke.points[:, 1]}
    texts = {name: [plainly(value) for value in column.tolist()] for name, column in columns.items()}
    if stroke.times is not None:
        texts["T"] = [shifted(time, _MILLI) for time in stroke.times.tolist()]
    if stroke.pressure is not None:
        texts["Pressure"] = [plainly(value) for value in stroke.pressure.tolist()]
    columns_written = [[f'{name}="{text}"' for text in column] for name, column in texts.items()]
    return "".join(f"{indent}<Point {' '.join(row)} />\n" for row in zip(*columns_written, strict=True))


def _stroke(element: Element, source: str | Path, notices: list[Notice]) -> Stroke:
    points = list(element.named("Point"))
    if not points:
        raise FileError(source, "has no <Point>; a stroke needs one at least", _at(element))
    xy = [[_number(point, name, source) for name in ("X", "Y")] for point in points]
    times = _times(element, points, source, notices)
    pressed = all("Pressure" in point.attributes for point in points)
    pressure = [_number(point, "Pressure", source) for point in points] if pressed else None
    if not pressed and any("Pressure" in point.attributes for point in points):
        notices.append(Notice(element.line, "Pressure is known at some points only and left out", lost=False))
    try:
        return Stroke(xy, times, pressure)
    except InkError as error:
        raise FileError(source, str(error), _at(element)) from None


def _times(
    element: Element, points: list[Element], source: str | Path, notices: list[Notice]
) -> list[float] | None:
    known = [unshifted(_decimal(point, "T", source), _MILLI) for point in points if "T" in point.attributes]
    if not known:
        return None
    if len(known) < len(points):
        notices.append(Notice(element.line, "T is known at some points only and left out", lost=False))
        return None
    if any(after < before for before, after in pairwise(known)):
        notices.append(Notice(element.line, "times run backwards and are left out", lost=False))
        return None
    return known


def _number(point: Element, name: str, source: str | Path) -> float:
    return float(_decimal(point, name, source))


def _decimal(point: Element, name: str, source: str | Path) -> Decimal:
    written = point.attributes.get(name)
    if written is None:
        raise FileError(source, f"lacks {name}", _at(point))
    try:
        value = Decimal(written)
    except InvalidOperation:
        value = Decimal("NaN")
    if not value.is_finite():
        raise FileError(source, f"{name} is {written[:40]!r}; it must be a finite number", _at(point))
    return value


def _at(element: Element) -> str:
    return f"line {element.line}, <{element.name}>"
