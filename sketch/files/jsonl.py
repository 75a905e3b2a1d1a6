"""Labelled ink as JSON Lines: one page or stroke a row, packed when the name ends in .gz.

    {"label": "circle", "writer": "w7", "strokes": [[[x, y, t_ms_or_null], …], …], …}

y grows downward; a file's times are milliseconds, a Stroke's seconds. `label` and `writer` may be
null or left out; every other key is kept as it is in `extra`. Pressure has no place in the triples:
where strokes have it, the optional key `pressure` holds a list (or null) for each stroke.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from pathlib import Path
from typing import Any, cast

import numpy as np

from sketch.files.decimals import shifted, unshifted
from sketch.files.errors import FileError, Notice
from sketch.files.store import read_text, written
from sketch.ink import LIMITS, FloatArray, Ink, InkError, Stroke

_MILLI = 3
"""Places that the point moves from seconds to milliseconds."""
_WHOLE = 2.0**53
"""Whole numbers below it are exact in float64, so that dividing one rounds once, as it should."""
_LONG_LINE = 1 << 20
"""Characters of a line from which on it is looked at before it is parsed."""
_STROKE_END = re.compile(r"\]\s*\]")
_LEVELS = 3
"""Brackets that open before a page's first point."""
_OWN_KEYS = ("label", "writer", "strokes", "pressure")


@dataclass(frozen=True, slots=True)
class Row:
    """One row: its ink, what it is said to be, who wrote it, and the file's other keys."""

    label: str | None
    ink: Ink
    writer: str | None = None
    extra: dict[str, Any] = field(default_factory=dict[str, Any])


@dataclass(frozen=True, slots=True)
class Loaded:
    """Rows in the file's order, and a notice for whatever was not taken as it stood."""

    rows: tuple[Row, ...]
    notices: tuple[Notice, ...] = ()

    @property
    def lost(self) -> int:
        """How many rows of the file are not among `rows`."""
        return sum(notice.lost for notice in self.notices)


class RowError(ValueError):
    """Why a row cannot be read."""


def read(path: str | Path) -> Loaded:
    """Every row that can be read, and a notice for every other. Blank lines are no rows.

    Times that run backwards, or are known for some points only, are left out with a notice.
    Raises FileError when the file cannot be opened or no row of it can be read.
    """
    return rows_of(read_text(path), path, _row)


def rows_of(text: str, path: str | Path, read_row: Callable[[str], tuple[Row, list[str]]]) -> Loaded:
    """The rows of a file's lines, by a reader that gives a line's row and remarks on what was left out of it, or raises
    RowError or InkError. Raises FileError when no row can be read."""
    rows: list[Row] = []
    notices: list[Notice] = []
    for number, line in enumerate(text.split("\n"), start=1):
        if not line.strip():
            continue
        try:
            row, remarks = read_row(line)
        except (RowError, InkError) as error:
            notices.append(Notice(number, f"the row is left out: {error}", lost=True))
            continue
        rows.append(row)
        notices.extend(Notice(number, remark, lost=False) for remark in remarks)
    if not rows:
        reason = str(notices[0]) if notices else "it is empty"
        raise FileError(path, f"no row of it can be read; {reason}")
    return Loaded(tuple(rows), tuple(notices))


def write(path: str | Path, rows: Iterable[Row]) -> None:
    """Save the rows, all or nothing, a row at a time in memory. Raises FileError when the folder cannot be written to or a
    row's `extra` holds what JSON has not."""
    with written(path) as file:
        for row in rows:
            try:
                line = _line(row)
            except (TypeError, ValueError) as error:
                raise FileError(path, f"a row's extra keys cannot be written as JSON: {error}") from None
            file.write(f"{line}\n".encode())


def _line(row: Row) -> str:
    strokes = ", ".join(_triples(stroke) for stroke in row.ink)
    parts = [f'"label": {json.dumps(row.label)}, "writer": {json.dumps(row.writer)}, "strokes": [{strokes}]']
    if any(stroke.pressure is not None for stroke in row.ink):
        channels = [None if stroke.pressure is None else stroke.pressure.tolist() for stroke in row.ink]
        parts.append(f'"pressure": {json.dumps(channels)}')
    clash = sorted(set(row.extra) & set(_OWN_KEYS))
    if clash:
        raise ValueError(f"{clash[0]!r} is a key of the row itself")
    parts.extend(
        f"{json.dumps(key)}: {json.dumps(value, allow_nan=False)}" for key, value in row.extra.items()
    )
    return f"{{{', '.join(parts)}}}"


def _triples(stroke: Stroke) -> str:
    times = (
        ["null"] * len(stroke)
        if stroke.times is None
        else [shifted(t, _MILLI) for t in stroke.times.tolist()]
    )
    points = zip(stroke.points.tolist(), times, strict=True)
    return f"[{', '.join(f'[{x!r}, {y!r}, {t}]' for (x, y), t in points)}]"


def _row(line: str) -> tuple[Row, list[str]]:
    """The row and remarks on what was left out of it. Raises RowError or InkError."""
    fields = decoded(line)
    if not isinstance(fields.get("strokes"), list):
        raise RowError('it has no list of strokes; needed is "strokes": [[[x, y, t], …], …]')
    written = cast(list[object], fields["strokes"])
    ink, remarks = ink_of(written, _pressures(fields.get("pressure"), len(written)))
    extra = plain({key: value for key, value in fields.items() if key not in _OWN_KEYS})
    return Row(text_of(fields, "label"), ink, text_of(fields, "writer"), extra), remarks


def decoded(line: str) -> dict[str, Any]:
    """The JSON object on a line, numbers with more digits than a float64 is sure to keep as decimals. Raises RowError,
    InkError for more than any page may hold."""
    check_bounds(line)
    decoder = _DECIMALS if _LONG_NUMBER.search(line) else _FLOATS
    try:
        value: object = decoder.decode(line.strip())
    except json.JSONDecodeError as error:
        raise RowError(f"it is not JSON ({error.msg} at column {error.colno})") from None
    except (ValueError, ArithmeticError, RecursionError) as error:
        raise RowError(f"it is not JSON that can be read ({error})") from None
    if not isinstance(value, dict):
        raise RowError("it is not a JSON object in braces")
    return cast(dict[str, Any], value)


def ink_of(written: Sequence[object], pressures: Sequence[object] = ()) -> tuple[Ink, list[str]]:
    """The ink of strokes as lists of [x, y, t_ms or null], and remarks on what was left out. Raises RowError, InkError."""
    remarks: list[str] = []
    pressed = pressures or [None] * len(written)
    strokes = [_stroke(points, pressed[index], index, remarks) for index, points in enumerate(written)]
    return Ink(tuple(strokes)), remarks


def check_bounds(line: str) -> None:
    """Refuses a line whose longest stroke alone is more than any page may hold, before a list is made of it: each
    point costs some hundred times its characters as Python's lists. Raises InkError."""
    if len(line) < _LONG_LINE:
        return
    begun = longest = 0
    for end in _STROKE_END.finditer(line):
        longest = max(longest, line.count("[", begun, end.start()))
        begun = end.end()
    longest = max(longest, line.count("[", begun))
    if line.count("]") < LIMITS.points:  # few lists: one of them may be endless
        longest = max(longest, *(run.count(",") for run in line.split("]")))
    if longest > LIMITS.points + _LEVELS:
        raise InkError(f"a stroke of some {longest} points; at most {LIMITS.points} are accepted")


def _stroke(written: object, pressure: object, index: int, remarks: list[str]) -> Stroke:
    if not isinstance(written, list) or not written:
        raise RowError(f"stroke {index} has no points")
    points = cast(list[Any], written)
    if set(map(type, points)) != {list} or not set(map(len, points)) <= {2, 3}:
        raise RowError(f"stroke {index} has a point that is not [x, y, t] (t may be null)")
    _check_numbers([point[0] for point in points], f"x of stroke {index}")
    _check_numbers([point[1] for point in points], f"y of stroke {index}")
    known = [point[2] for point in points if len(point) == 3 and point[2] is not None]
    _check_numbers(known, f"t of stroke {index}")
    times = None
    if len(known) == len(points):
        times = _seconds(known)
        if (times[1:] < times[:-1]).any():
            remarks.append(f"stroke {index}: its times run backwards and are left out")
            times = None
    elif known:
        remarks.append(
            f"stroke {index}: only {len(known)} of {len(points)} points have a time; its times are left out"
        )
    try:
        return Stroke([point[:2] for point in points], times, cast(Any, pressure))
    except InkError as error:
        raise RowError(f"stroke {index}: {error}") from None


def _seconds(milliseconds: list[int | float | Decimal]) -> FloatArray:
    """The float64 nearest to each / 1000; whole numbers, as most are, all at once."""
    try:
        values = np.array(milliseconds, dtype=np.float64)
    except OverflowError:
        raise RowError("a time is beyond what float64 holds") from None
    short = set(map(type, milliseconds)) <= {int, float}
    if short and ((np.floor(values) == values) & (np.abs(values) < _WHOLE)).all():
        return values / 1000.0
    return np.array([unshifted(Decimal(str(value)), _MILLI) for value in milliseconds], dtype=np.float64)


def _pressures(written: object, count: int) -> list[object]:
    if written is None:
        return [None] * count
    if not isinstance(written, list) or len(cast(list[Any], written)) != count:
        raise RowError(f"its pressure must be a list with one entry for each of {count} strokes")
    channels = cast(list[Any], written)
    for index, channel in enumerate(channels):
        if channel is not None and not isinstance(channel, list):
            raise RowError(f"pressure of stroke {index} must be a list of numbers or null")
        _check_numbers(channel or [], f"pressure of stroke {index}")
    return channels


def _check_numbers(values: list[Any], name: str) -> None:
    if set(map(type, values)) <= {int, float, Decimal}:
        return
    wrong = next(value for value in values if type(value) not in (int, float, Decimal))
    raise RowError(f"{name} is {json.dumps(_floats(wrong))[:40]}; it must be a number")


def plain(fields: Mapping[str, Any]) -> dict[str, Any]:
    """JSON as Python usually has it: decimals become floats."""
    return {key: _floats(value) for key, value in fields.items()}


def text_of(fields: Mapping[str, Any], name: str) -> str | None:
    value = fields.get(name)
    if value is not None and not isinstance(value, str):
        raise RowError(f"{name} must be text or null")
    return value


def _floats(value: Any) -> Any:
    match value:
        case Decimal():
            return float(value)
        case list():
            return [_floats(entry) for entry in cast(list[Any], value)]
        case dict():
            return {key: _floats(entry) for key, entry in cast(dict[str, Any], value).items()}
        case _:
            return value


def _refuse_constant(name: str) -> float:
    raise ValueError(f"{name} stands in it; numbers must be finite")


_FLOATS = json.JSONDecoder(parse_constant=_refuse_constant)
_DECIMALS = json.JSONDecoder(parse_float=Decimal, parse_constant=_refuse_constant)
"""Slower, but keeps what the file says, so that moving the point of a time loses nothing."""
_LONG_NUMBER = re.compile(r"[0-9.]{16}")
"""A number of more than 14 digits: only shorter ones are sure to survive as float64."""
