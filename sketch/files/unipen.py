"""Ink in UNIPEN 1.0 (Guyon, Schomaker, Plamondon, Liberman and Janet, ICPR 1994), many drawings in a file.

    .COORD X Y T
    .SEGMENT CHARACTER 0-1 OK "a"
    .PEN_DOWN
     10 20 0
     11 22 10
    .PEN_UP

A statement is a line that begins with a point, and goes on until the next. Read are .COORD (X, Y, T in milliseconds, P),
.PEN_DOWN and .PEN_UP, .SEGMENT, .WRITER_ID (or .WRITER), .HIERARCHY and .POINTS_PER_SECOND, from which times are made where
there is no T; .INCLUDE is remarked, since no other file is opened; all others are passed over. Pen-down components are numbered from 0 through the file. Segments of the
hierarchy's finest level that occurs are the rows; a file without segments is one row. A segment names its components as
`0-3,5`; a cut within one (`3:12`) takes the component whole, and says so. UNIPEN's Y grows upward, ours downward.
Written are labels, writers, times and pressure; a row's other keys have no place in the format.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from itertools import pairwise
from pathlib import Path

from sketch.files.decimals import plainly, shifted, unshifted
from sketch.files.errors import FileError, Notice
from sketch.files.jsonl import Loaded, Row
from sketch.files.store import read_text, write_text
from sketch.ink import LIMITS, Ink, InkError, Stroke

_LABEL = re.compile(r'"((?:[^"\\]|\\.)*)"', re.S)
_ESCAPES = {"n": "\n", "t": "\t"}
_PIECE = re.compile(r"(\d+)(:\d+)?(?:-(\d+)(:\d+)?)?$")
_MILLI = 3
LEVEL = "CHARACTER"
"""The level that rows are written at."""


@dataclass(frozen=True, slots=True)
class _Segment:
    line: int
    level: str
    components: tuple[int, ...]
    cut: bool
    quality: str
    label: str | None
    writer: str | None


@dataclass(slots=True)
class _File:
    """What has been read so far. strokes: by component, None for one that was lost."""

    channels: tuple[str, ...] = ("X", "Y")
    writer: str | None = None
    rate: float | None = None
    hierarchy: tuple[str, ...] = ()
    strokes: list[Stroke | None] = field(default_factory=list["Stroke | None"])
    writers: list[str | None] = field(default_factory=list["str | None"])
    segments: list[_Segment] = field(default_factory=list[_Segment])
    notices: list[Notice] = field(default_factory=list[Notice])
    clock: float = 0.0

    def lose(self, line: int, text: str) -> None:
        self.notices.append(Notice(line, text, lost=True))

    def remark(self, line: int, text: str) -> None:
        self.notices.append(Notice(line, text, lost=False))


def read(path: str | Path) -> Loaded:
    """The rows of a file, and a notice for whatever was not taken as it stood. Raises FileError when the file cannot be
    opened or none of its ink can be read."""
    found = _File()
    for line, keyword, body in _statements(read_text(path)):
        _take(found, line, keyword, body)
    rows = tuple(_rows(found))
    if not rows:
        reason = str(found.notices[0]) if found.notices else "it has no .PEN_DOWN with points"
        raise FileError(path, f"no ink of it can be read; {reason}")
    return Loaded(rows, tuple(found.notices))


def write(path: str | Path, rows: Iterable[Row]) -> None:
    """Saves the rows, whole or not at all: a segment for each. Raises FileError for a row without strokes, which no segment
    can name."""
    lines = [".VERSION 1.0", f".HIERARCHY {LEVEL}"]
    component = 0
    writer: str | None = None
    for number, row in enumerate(rows):
        if not len(row.ink):
            raise FileError(
                path, f"row {number} has no strokes; a UNIPEN segment names one component at least"
            )
        if row.writer != writer:
            lines.append(f".WRITER_ID {_quoted(row.writer)}" if row.writer is not None else ".WRITER_ID")
            writer = row.writer
        label = "" if row.label is None else f" {_quoted(row.label)}"
        lines.append(f".SEGMENT {LEVEL} {component}-{component + len(row.ink) - 1} OK{label}")
        for stroke in row.ink:
            lines += _written(stroke)
        component += len(row.ink)
    write_text(path, "\n".join(lines) + "\n")


def _statements(text: str) -> Iterator[tuple[int, str, list[str]]]:
    """(line, keyword, the statement's lines without the keyword), in order."""
    at = line = 0
    while at < len(text):
        end = text.find("\n.", at)
        statement = text[at : len(text) if end < 0 else end]
        if statement.startswith("."):
            first, *body = statement.split("\n", LIMITS.points + 3)  # of more points none is a stroke's
            keyword, _, rest = first.rstrip().partition(" ")
            yield line + 1, keyword, [rest, *body]
        line += statement.count("\n") + 1
        at += len(statement) + 1


def _take(found: _File, line: int, keyword: str, body: list[str]) -> None:
    words = body[0].split()
    match keyword:
        case ".COORD":
            found.channels = tuple(words)
            if not {"X", "Y"} <= set(words):
                found.remark(line, f".COORD names {' '.join(words) or 'nothing'}; X and Y are needed")
        case ".PEN_DOWN":
            found.writers.append(found.writer)
            found.strokes.append(_component(found, line, body))
        case ".PEN_UP" if found.rate:
            found.clock += sum(bool(row.strip()) for row in body) / found.rate
        case ".SEGMENT":
            _segment(found, line, "\n".join(body))
        case ".WRITER_ID" | ".WRITER":
            label = _LABEL.search(body[0])
            found.writer = _unquoted(label) if label else " ".join(words) or None
        case ".INCLUDE":
            found.remark(line, f".INCLUDE names {' '.join(words)!r}, another file, which is not read")
        case ".HIERARCHY":
            found.hierarchy = tuple(words)
        case ".POINTS_PER_SECOND":
            try:
                rate = float(words[0]) if words else 0.0
            except ValueError:
                rate = 0.0
            found.rate = rate if 0 < rate < float("inf") else None
            if found.rate is None:
                found.remark(line, f".POINTS_PER_SECOND is {' '.join(words)!r}; it must be above 0")
        case _:
            pass


def _component(found: _File, line: int, body: list[str]) -> Stroke | None:
    """The stroke of a .PEN_DOWN; None, and a notice, when it is none."""
    number = len(found.strokes)
    rows = [row.split() for row in body if row.strip()] if len(body) < LIMITS.points + 3 else []
    if len(rows) > LIMITS.points or len(body) >= LIMITS.points + 3:
        found.lose(
            line, f"component {number} has more than the {LIMITS.points} points of a stroke and is left out"
        )
        return None
    if not rows:
        found.lose(line, f"component {number} has no points and is left out")
        return None
    width = len(found.channels)
    wrong = next((row for row in rows if len(row) != width), None)
    if wrong is not None or not {"X", "Y"} <= set(found.channels):
        shown = " ".join(wrong or [])[:40]
        found.lose(
            line, f"component {number} is left out: {shown!r} where {' '.join(found.channels)} are needed"
        )
        return None
    columns = dict(zip(found.channels, zip(*rows, strict=True), strict=True))
    try:
        points = [(float(x), -float(y)) for x, y in zip(columns["X"], columns["Y"], strict=True)]
        pressure = [float(value) for value in columns["P"]] if "P" in columns else None
        return Stroke(points, _times(found, line, columns.get("T"), len(points)), pressure)
    except (ArithmeticError, InkError, ValueError) as error:
        found.lose(line, f"component {number} is left out: {error}")
        return None


def _times(found: _File, line: int, column: tuple[str, ...] | None, count: int) -> list[float] | None:
    if column is not None:
        times = [unshifted(Decimal(value), _MILLI) for value in column]
        if any(after < before for before, after in pairwise(times)):
            found.remark(line, f"component {len(found.strokes)}: its times run backwards and are left out")
            return None
        return times
    if found.rate is None:
        return None
    begun = found.clock
    found.clock += count / found.rate
    return [begun + k / found.rate for k in range(count)]


def _segment(found: _File, line: int, text: str) -> None:
    level, _, rest = text.strip().partition(" ")
    label = _LABEL.search(rest)
    words = (rest[: label.start()] if label else rest).split()
    components: list[int] = []
    cut = False
    for piece in (words[0] if words else "").split(","):
        match = _PIECE.match(piece)
        if match is None:
            found.lose(line, f"a .SEGMENT names {piece!r}; it must be components such as 0-3,5")
            return
        first, last = int(match[1]), int(match[3] or match[1])
        if not first <= last < first + LIMITS.strokes:
            found.lose(line, f"a .SEGMENT names {piece!r}, which is no range of components")
            return
        components += range(first, last + 1)
        cut = cut or bool(match[2] or match[4])
    quality = words[1] if len(words) > 1 else "?"
    name = _unquoted(label) if label else None
    found.segments.append(_Segment(line, level, tuple(components), cut, quality, name, found.writer))


def _rows(found: _File) -> Iterator[Row]:
    if not found.segments:
        kept = [stroke for stroke in found.strokes if stroke is not None]
        if kept:
            yield Row(None, Ink(tuple(kept)), found.writer)
        return
    there = {segment.level for segment in found.segments}
    finest = next((level for level in reversed(found.hierarchy) if level in there), found.segments[-1].level)
    covered: set[int] = set()
    for segment in found.segments:
        if segment.level != finest:
            continue
        covered.update(segment.components)
        there_are = [k for k in segment.components if k < len(found.strokes)]
        strokes = [found.strokes[k] for k in there_are]
        if len(there_are) < len(segment.components) or None in strokes or not strokes:
            found.lose(
                segment.line, f"{finest} {segment.label!r} is left out: a component of it is not there"
            )
            continue
        if segment.cut:
            found.remark(segment.line, f"{finest} {segment.label!r} cuts a component, which is taken whole")
        try:
            ink = Ink(tuple(stroke for stroke in strokes if stroke is not None))
        except InkError as error:
            found.lose(segment.line, f"{finest} {segment.label!r} is left out: {error}")
            continue
        extra = {} if segment.quality == "OK" else {"quality": segment.quality}
        yield Row(segment.label, ink, found.writers[there_are[0]], extra)
    left = sum(k not in covered for k, stroke in enumerate(found.strokes) if stroke is not None)
    if left:
        found.lose(1, f"{left} components are in no {finest} segment and are left out")


def _written(stroke: Stroke) -> list[str]:
    channels = ["X", "Y"]
    columns = [
        [plainly(value) for value in stroke.points[:, 0].tolist()],
        [plainly(-value) for value in stroke.points[:, 1].tolist()],
    ]
    if stroke.times is not None:
        channels.append("T")
        columns.append([shifted(time, _MILLI) for time in stroke.times.tolist()])
    if stroke.pressure is not None:
        channels.append("P")
        columns.append([plainly(value) for value in stroke.pressure.tolist()])
    rows = (" " + " ".join(row) for row in zip(*columns, strict=True))
    return [f".COORD {' '.join(channels)}", ".PEN_DOWN", *rows, ".PEN_UP"]


def _quoted(label: str) -> str:
    text = label.replace("\\", "\\\\").replace('"', '\\"').replace("\t", "\\t").replace("\n", "\\n")
    return f'"{text}"'


def _unquoted(label: re.Match[str]) -> str:
    text = label[1].replace("\n", " ")
    return re.sub(r"\\(.)", lambda escaped: _ESCAPES.get(escaped[1], escaped[1]), text, flags=re.S)
