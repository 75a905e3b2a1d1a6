"""Drawings in QuickDraw's ndjson: one drawing a line, each stroke as its columns.

    {"word": "cloud", "countrycode": "US", "recognized": true, "key_id": "…", "drawing": [[[x, …], [y, …], [t, …]], …]}

The raw files have times in milliseconds from the first point, the simplified ones have none. `word` is the label;
drawings are anonymous, so there is no writer; all other keys are kept in the row's extra. Y grows downward.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any, cast

from sketch.files import jsonl
from sketch.files.decimals import plainly, shifted
from sketch.files.errors import FileError
from sketch.files.jsonl import Loaded, Row, RowError
from sketch.files.store import read_text, write_text
from sketch.ink import Stroke

_OWN_KEYS = ("word", "drawing")
_MILLI = 3


def read(path: str | Path) -> Loaded:
    """Every drawing that can be read, and a notice for every other. Raises FileError when none can."""
    return jsonl.rows_of(read_text(path), path, _row)


def write(path: str | Path, rows: Iterable[Row]) -> None:
    """Saves the drawings, all or nothing. Writers and pressure have no place in the format and are not written.
    Raises FileError when the folder cannot be written to or a row's `extra` holds what JSON has not."""
    try:
        text = "".join(f"{_line(row)}\n" for row in rows)
    except (TypeError, ValueError) as error:
        raise FileError(path, f"a row cannot be written as JSON: {error}") from None
    write_text(path, text)


def _row(line: str) -> tuple[Row, list[str]]:
    """A QuickDraw line is one of ours, its columns made points."""
    fields = jsonl.decoded(line)
    drawing = fields.get("drawing")
    if not isinstance(drawing, list):
        raise RowError('it has no list of strokes; needed is "drawing": [[[x, …], [y, …], [t, …]], …]')
    strokes = [_triples(columns, k) for k, columns in enumerate(cast(list[Any], drawing))]
    extra = {key: value for key, value in fields.items() if key not in _OWN_KEYS}
    ink, remarks = jsonl.ink_of(strokes)
    return Row(jsonl.text_of(fields, "word"), ink, None, jsonl.plain(extra)), remarks


def _triples(columns: Any, index: int) -> list[list[Any]]:
    if not isinstance(columns, list) or not 2 <= len(cast(list[Any], columns)) <= 3:
        raise RowError(f"stroke {index} is not [[x, …], [y, …], [t, …]] (t may be left out)")
    lists = cast(list[Any], columns)
    if not all(isinstance(column, list) for column in lists) or len({len(column) for column in lists}) != 1:
        raise RowError(f"stroke {index} has columns that are no lists of one length")
    return [list(point) for point in zip(*lists, strict=True)]


def _line(row: Row) -> str:
    clash = sorted(set(row.extra) & set(_OWN_KEYS))
    if clash:
        raise ValueError(f"{clash[0]!r} is a key of the drawing itself")
    extra = "".join(
        f", {json.dumps(key)}: {json.dumps(value, allow_nan=False)}" for key, value in row.extra.items()
    )
    strokes = ",".join(_columns(stroke) for stroke in row.ink)
    return f'{{"word": {json.dumps(row.label)}{extra}, "drawing": [{strokes}]}}'


def _columns(stroke: Stroke) -> str:
    columns = [[plainly(value) for value in column.tolist()] for column in stroke.points.T]
    if stroke.times is not None:
        columns.append([shifted(time, _MILLI) for time in stroke.times.tolist()])
    return "[" + ",".join("[" + ",".join(column) + "]" for column in columns) + "]"
