"""Ink in the W3C's Ink Markup Language (InkML, Recommendation of 20 September 2011).

Read are traces, also in nested groups, with channels X, Y, T (time) and F (force, our pressure) in any
order, described by traceFormats, inkSources and contexts; other channels are passed over. Coordinates are
taken as page units whatever their unit; T is milliseconds unless its channel says otherwise, and
`timeOffset` (milliseconds) is added. Traces in `definitions` are not on the page, nor are pen-up traces.

Written is every number in full, times in seconds: reading gives the same ink to the bit.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from decimal import Decimal
from itertools import pairwise
from pathlib import Path

from sketch.files import traces, xml_tree
from sketch.files.decimals import unshifted
from sketch.files.errors import FileError, Notice
from sketch.files.store import read_bytes, write_text
from sketch.files.xml_tree import Element
from sketch.ink import Ink, InkError, Stroke

NAMESPACE = "http://www.w3.org/2003/InkML"

_TIME_PLACES = {"s": 0, "ms": 3, "us": 6, "ns": 9}
"""By unit of T: places to move the point by for seconds."""


@dataclass(frozen=True, slots=True)
class LoadedInk:
    """The ink of a file, a notice for whatever was not taken as it stood, and the trace that each stroke is of."""

    ink: Ink
    notices: tuple[Notice, ...] = ()
    traces: tuple[Element, ...] = field(default=(), compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class _Format:
    """Names of the regular channels in order, places to move T's point by, number of intermittent ones."""

    channels: tuple[str, ...] = ("X", "Y")
    time_places: int = 3
    intermittent: int = 0


def read(path: str | Path) -> Ink:
    """The ink of a file (packed when its name ends in .gz). Raises FileError."""
    return load(path).ink


def load(path: str | Path) -> LoadedInk:
    """The ink of a file and what was not taken as it stood: empty traces, and times that are unknown for
    some points or run backwards. Raises FileError."""
    return _load(read_bytes(path), path)


def loads(text: str, source: str | Path = "InkML") -> Ink:
    """The ink of an InkML text; `source` is what an error calls it. Raises FileError."""
    return _load(text.encode("utf-8"), source).ink


def write(path: str | Path, ink: Ink) -> None:
    """Save the ink, whole or not at all. Raises FileError when the folder cannot be written to."""
    write_text(path, dumps(ink))


def dumps(ink: Ink) -> str:
    """The ink as InkML: a context for each set of channels in use, a trace for each stroke."""
    return framed(definitions(ink) + "".join(trace(stroke) for stroke in ink))


def framed(body: str) -> str:
    """A whole InkML text around its elements."""
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<ink xmlns="{NAMESPACE}">\n{body}</ink>\n'


def definitions(ink: Ink) -> str:
    """The contexts that the ink's traces name."""
    kinds = sorted({_channels_of(stroke) for stroke in ink})
    return f"<definitions>\n{''.join(_context(channels) for channels in kinds)}</definitions>\n"


def trace(stroke: Stroke, attributes: str = "") -> str:
    """A stroke as an element; attributes: more of them, as they are written."""
    return f'<trace contextRef="#{_channels_of(stroke)}"{attributes}>{_trace_text(stroke)}</trace>\n'


def _channels_of(stroke: Stroke) -> str:
    return f"XY{'' if stroke.times is None else 'T'}{'' if stroke.pressure is None else 'F'}"


def _context(channels: str) -> str:
    units = {"T": ' units="s"'}
    described = "".join(f'<channel name="{name}" type="decimal"{units.get(name, "")}/>' for name in channels)
    return (
        f'<context xml:id="{channels}"><inkSource xml:id="pen-{channels}"><traceFormat>{described}'
        "</traceFormat></inkSource></context>\n"
    )


def _trace_text(stroke: Stroke) -> str:
    columns = [stroke.points[:, 0], stroke.points[:, 1]]
    columns += [channel for channel in (stroke.times, stroke.pressure) if channel is not None]
    rows = zip(*([_number(value) for value in column.tolist()] for column in columns), strict=True)
    return ", ".join(map(" ".join, rows))


def _number(value: float) -> str:
    """Shortest decimal of a float64; InkML knows no exponents."""
    text = repr(value)
    return f"{Decimal(text):f}" if "e" in text else text


def _load(data: bytes, source: str | Path) -> LoadedInk:
    return ink_of(xml_tree.parse(data, source), source)


def ink_of(root: Element, source: str | Path) -> LoadedInk:
    """The ink of a file that is parsed already. Raises FileError."""
    if root.name != "ink":
        raise FileError(
            source, f"its outermost element is <{root.name}>; InkML has <ink>", f"line {root.line}"
        )
    page = _Page(source, root)
    page.walk(root, _Format())
    try:
        return LoadedInk(Ink(tuple(page.strokes)), tuple(page.notices), tuple(page.taken))
    except InkError as error:
        raise FileError(source, str(error)) from None


class _Page:
    """What has been read of a file so far."""

    def __init__(self, source: str | Path, root: Element) -> None:
        self.strokes: list[Stroke] = []
        self.notices: list[Notice] = []
        self.taken: list[Element] = []
        self._source = source
        self._by_id = {e.attributes["id"]: e for e in root.everything() if "id" in e.attributes}

    def walk(self, group: Element, current: _Format) -> None:
        """Take the traces of a group in order; a context or format holds for what follows it."""
        for element in group.children:
            match element.name:
                case "traceFormat" | "context":
                    current = self._format(element, current)
                case "traceGroup":
                    self.walk(element, self._referred(element, "contextRef", current))
                case "trace" if element.attributes.get("type", "penDown") != "penUp":
                    self._take(element, self._referred(element, "contextRef", current), current)
                case _:
                    pass

    def _format(self, element: Element, current: _Format, chain: int = 0) -> _Format:
        """The format that a traceFormat, context or inkSource gives; `current` where it gives none."""
        if chain > len(self._by_id):
            raise self._error(element, "its references run in a circle")
        if element.name == "traceFormat":
            return self._trace_format(element)
        for reference in ("contextRef", "inkSourceRef", "traceFormatRef"):
            current = self._referred(element, reference, current, chain + 1)
        for child in element.children:
            if child.name in ("inkSource", "traceFormat"):
                current = self._format(child, current, chain + 1)
        return current

    def _referred(self, element: Element, attribute: str, current: _Format, chain: int = 0) -> _Format:
        target = element.attributes.get(attribute)
        if target is None:
            return current
        found = self._by_id.get(target.removeprefix("#"))
        if found is None:
            if target == "#DefaultContext":
                return _Format()
            raise self._error(element, f"{attribute} names {target!r}, which is not in the file")
        return self._format(found, current, chain)

    def _trace_format(self, element: Element) -> _Format:
        channels = list(element.named("channel"))
        names = tuple(channel.attributes.get("name", "") for channel in channels)
        if not {"X", "Y"} <= set(names):
            raise self._error(element, f"has channels {', '.join(names) or 'none'}; X and Y are needed")
        unit = next(
            (c.attributes.get("units", "ms") for c in channels if c.attributes.get("name") == "T"), "ms"
        )
        if unit not in _TIME_PLACES:
            raise self._error(element, f"gives T in {unit!r}; known units are {', '.join(_TIME_PLACES)}")
        extra = sum(len(list(group.named("channel"))) for group in element.named("intermittentChannels"))
        return _Format(names, _TIME_PLACES[unit], extra)

    def _take(self, element: Element, form: _Format, stated: _Format) -> None:
        """Add a trace's stroke. Published files name a context whose format is not the one they use but
        state the right one beside it: where only that one fits, it is taken."""
        try:
            try:
                rows = traces.points(element.text, len(form.channels), form.intermittent)
            except traces.TraceError:
                if len(stated.channels) == len(form.channels):
                    raise
                rows = traces.points(element.text, len(stated.channels), stated.intermittent)
                self._notice(
                    element, f"its context does not fit; read as {' '.join(stated.channels)}", lost=False
                )
                form = stated
            if rows:
                self.strokes.append(self._stroke(element, form, rows))
                self.taken.append(element)
            else:
                self._notice(element, "an empty trace is left out", lost=True)
        except (traces.TraceError, InkError) as error:
            raise self._error(element, str(error)) from None

    def _stroke(self, element: Element, form: _Format, rows: list[list[Decimal | None]]) -> Stroke:
        columns = dict(zip(form.channels, zip(*rows, strict=True), strict=True))
        points = list(zip(*(_floats(columns[name]) for name in "XY"), strict=True))
        times = self._times(element, form, columns["T"]) if "T" in columns else None
        pressure = _floats(columns["F"]) if "F" in columns and None not in columns["F"] else None
        if "F" in columns and pressure is None:
            self._notice(element, "F is unknown at some points and left out", lost=False)
        return Stroke(points, times, pressure)

    def _times(
        self, element: Element, form: _Format, column: tuple[Decimal | None, ...]
    ) -> list[float] | None:
        known = [value for value in column if value is not None]
        if len(known) < len(column):
            self._notice(element, "T is unknown at some points and left out", lost=False)
            return None
        times = [unshifted(value, form.time_places) for value in known]
        offset = self._offset(element)
        if offset:
            times = [time + offset for time in times]
        if any(after < before for before, after in pairwise(times)):
            self._notice(element, "times run backwards and are left out", lost=False)
            return None
        return times

    def _offset(self, element: Element) -> float:
        """timeOffset in seconds."""
        written = element.attributes.get("timeOffset", "0")
        try:
            return unshifted(Decimal(written), 3)
        except ArithmeticError:
            raise self._error(element, f"timeOffset is {written!r}; it must be milliseconds") from None

    def _notice(self, element: Element, text: str, *, lost: bool) -> None:
        self.notices.append(Notice(element.line, f"stroke {len(self.strokes)}: {text}", lost))

    def _error(self, element: Element, reason: str) -> FileError:
        return FileError(self._source, reason, f"line {element.line}, <{element.name}>")


def _floats(column: tuple[Decimal | None, ...]) -> list[float]:
    if None in column:
        raise traces.TraceError("X or Y is unknown at some points; every point needs both")
    return [float(value) for value in column if value is not None]
