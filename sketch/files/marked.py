"""InkML with its marks: annotations, trace groups with their labels, and truths in XML, as CROHME and the flow-chart data
sets have them (Mouchère et al., IJDAR 2016; Awal et al., ICFHR 2011).

    <annotation type="truth">$e^v$</annotation> <annotationXML type="truth"><math>…</math></annotationXML>
    <trace id="0">…</trace>
    <traceGroup xml:id="9"><annotation type="truth">e</annotation><traceView traceDataRef="0"/><annotationXML href="e_1"/></traceGroup>

A file is one row: its label the annotation `truth`, its writer the annotation `writer`, all marks in the row's extra
`inkml`. `parts` makes a row of each innermost group instead: the symbols of an expression, the figures of a flow chart.
XML is kept by its elements, attributes and text: prefixes, comments and white space around text are not marks.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, cast
from xml.sax.saxutils import escape, quoteattr

from sketch.files import inkml, xml_tree
from sketch.files.errors import FileError, Notice
from sketch.files.jsonl import Loaded, Row
from sketch.files.store import read_bytes, write_text
from sketch.files.xml_tree import Element
from sketch.ink import Ink

TRUTH, WRITER = "truth", "writer"


@dataclass(frozen=True, slots=True)
class Group:
    """label: its annotation `truth`; strokes: those that it names itself, not by way of a group within; href: of its
    annotationXML; id: xml:id."""

    label: str | None = None
    strokes: tuple[int, ...] = ()
    href: str | None = None
    id: str | None = None
    groups: tuple[Group, ...] = ()


@dataclass(frozen=True, slots=True)
class Marks:
    """annotations: (type, text) in the file's order; truths: annotationXML elements as XML; ids: of each stroke's trace."""

    annotations: tuple[tuple[str, str], ...] = ()
    truths: tuple[str, ...] = ()
    ids: tuple[str | None, ...] = ()
    groups: tuple[Group, ...] = ()

    def annotation(self, kind: str) -> str | None:
        """The first annotation of that type."""
        return next((text for name, text in self.annotations if name == kind), None)


def read(path: str | Path) -> Loaded:
    """The file's ink with its marks, as one row. Raises FileError."""
    return parse(xml_tree.parse(read_bytes(path), path), path)


def parse(root: Element, source: str | Path) -> Loaded:
    """The row of a file that is parsed already. Raises FileError."""
    loaded = inkml.ink_of(root, source)
    notices = list(loaded.notices)
    marks = Marks(
        annotations=tuple((e.attributes.get("type", ""), e.text.strip()) for e in root.named("annotation")),
        truths=tuple(element.written() for element in root.named("annotationXML")),
        ids=tuple(trace.attributes.get("id") for trace in loaded.traces),
        groups=_groups(root, loaded.traces, notices),
    )
    row = Row(marks.annotation(TRUTH), loaded.ink, marks.annotation(WRITER), {"inkml": _plain(marks)})
    return Loaded((row,), tuple(notices))


def parts(row: Row) -> tuple[Row, ...]:
    """A row for each innermost group with a label, of its own strokes, by the same writer. Extra `of` says whose part it
    is: the file's annotation `UI`, where it has one. Raises ValueError for marks that are none."""
    marks = marks_of(row)
    whole = marks.annotation("UI")
    return tuple(
        Row(
            group.label,
            Ink(tuple(row.ink[k] for k in group.strokes)),
            row.writer,
            {"of": whole} if whole else {},
        )
        for group in _innermost(marks.groups)
        if group.label is not None and group.strokes
    )


def marks_of(row: Row) -> Marks:
    """The marks that a row carries; none where it has no `inkml`. Raises ValueError when they are no marks, or name strokes
    that the row has not."""
    kept: Any = row.extra.get("inkml", {})
    try:
        marks = Marks(
            annotations=tuple((str(name), str(text)) for name, text in kept.get("annotations", ())),
            truths=tuple(str(text) for text in kept.get("truths", ())),
            ids=tuple(None if name is None else str(name) for name in kept.get("ids", ())),
            groups=tuple(_group(group) for group in kept.get("groups", ())),
        )
    except (AttributeError, KeyError, RecursionError, TypeError, ValueError) as error:
        raise ValueError(f'its "inkml" holds no marks of InkML: {error}') from None
    if any(not 0 <= k < len(row.ink) for group in _everywhere(marks.groups) for k in group.strokes):
        raise ValueError(f'a group of its "inkml" names a stroke that is not among its {len(row.ink)}')
    return marks


def write(path: str | Path, row: Row) -> None:
    """Saves the row, whole or not at all. Raises FileError as `dumps`, and where it cannot be written."""
    write_text(path, dumps(row, path))


def dumps(row: Row, source: str | Path = "InkML") -> str:
    """The row as InkML with its marks. What the row says of its label and writer goes before its marks. Raises FileError for
    marks that are none, or hold a character that XML has not."""
    try:
        marks = _current(marks_of(row), row)
    except ValueError as error:
        raise FileError(source, str(error)) from None
    ids = _ids(marks, len(row.ink))
    text = "".join(
        (
            *(
                f"<annotation type={quoteattr(n)}>{escape(text)}</annotation>\n"
                for n, text in marks.annotations
            ),
            *(f"{truth}\n" for truth in marks.truths),
            inkml.definitions(row.ink),
            *(inkml.trace(s, f" id={quoteattr(name)}") for s, name in zip(row.ink, ids, strict=True)),
            *(_written(group, ids) for group in marks.groups),
        )
    )
    bad = xml_tree.UNWRITABLE.search(text)
    if bad is not None:
        raise FileError(source, f"its marks hold {bad[0]!r}, a character that XML has not")
    return inkml.framed(text)


def _current(marks: Marks, row: Row) -> Marks:
    """The marks with the row's own label and writer."""
    annotations = list(marks.annotations)
    for kind, said in ((TRUTH, row.label), (WRITER, row.writer)):
        if said is None or marks.annotation(kind) == said:
            continue
        place = next((k for k, (name, _) in enumerate(annotations) if name == kind), None)
        if place is None:
            annotations.append((kind, said))
        else:
            annotations[place] = (kind, said)
    return replace(marks, annotations=tuple(annotations))


def _ids(marks: Marks, count: int) -> list[str]:
    """A name for each trace: its own, where it is the only one to bear it."""
    names = [name if name else None for name in (*marks.ids, *[None] * count)][:count]
    taken = {name for name in names if name is not None}
    given: list[str] = []
    for k, name in enumerate(names):
        own = name if name is not None and name not in given else None
        if own is None:
            own = str(k)
            while own in taken or own in given:
                own += "_"
        given.append(own)
    return given


def _written(group: Group, ids: Sequence[str]) -> str:
    name = "" if group.id is None else f" xml:id={quoteattr(group.id)}"
    label = "" if group.label is None else f'<annotation type="{TRUTH}">{escape(group.label)}</annotation>'
    views = "".join(f"<traceView traceDataRef={quoteattr(ids[k])}/>" for k in group.strokes)
    href = "" if group.href is None else f"<annotationXML href={quoteattr(group.href)}/>"
    within = "".join(_written(each, ids) for each in group.groups)
    return f"<traceGroup{name}>{label}{views}{href}{within}</traceGroup>\n"


def _groups(root: Element, traces: Sequence[Element], notices: list[Notice]) -> tuple[Group, ...]:
    by_element = {id(trace): k for k, trace in enumerate(traces)}
    by_name: dict[str, tuple[int, ...]] = {}
    for k, trace in enumerate(traces):
        by_name.setdefault(trace.attributes.get("id", ""), (k,))

    def strokes(element: Element) -> Iterator[int]:
        for child in element.children:
            if child.name == "trace" and id(child) in by_element:
                yield by_element[id(child)]
            elif child.name == "traceView":
                reference = child.attributes.get("traceDataRef", "").removeprefix("#")
                if reference not in by_name or not reference:
                    notices.append(
                        Notice(child.line, f"a group names trace {reference!r}, which is no ink", lost=False)
                    )
                yield from by_name.get(reference, ()) if reference else ()

    def group(element: Element) -> Group:
        annotations = list(element.named("annotation"))
        label = next((a.text.strip() for a in annotations if a.attributes.get("type") == TRUTH), None)
        hrefs = (a.attributes.get("href") for a in element.named("annotationXML"))
        made = Group(
            label=label if label is not None or not annotations else annotations[0].text.strip(),
            strokes=tuple(strokes(element)),
            href=next((href for href in hrefs if href is not None), None),
            id=element.attributes.get("id"),
            groups=tuple(group(child) for child in element.named("traceGroup")),
        )
        if made.id is not None:
            every = tuple(k for one in _everywhere((made,)) for k in one.strokes)
            by_name.setdefault(made.id, every)
        return made

    return tuple(group(element) for element in root.named("traceGroup"))


def _everywhere(groups: Sequence[Group]) -> Iterator[Group]:
    for group in groups:
        yield group
        yield from _everywhere(group.groups)


def _innermost(groups: Sequence[Group]) -> Iterator[Group]:
    return (group for group in _everywhere(groups) if not group.groups)


def _plain(marks: Marks) -> dict[str, Any]:
    """As JSON has it: tuples as lists, what is empty left out."""
    return cast(dict[str, Any], _lists(asdict(marks)))


def _lists(value: Any) -> Any:
    match value:
        case dict():
            fields = cast(dict[str, Any], value)
            return {key: _lists(each) for key, each in fields.items() if each not in (None, ())}
        case tuple() | list():
            return [_lists(each) for each in cast(Sequence[Any], value)]
        case _:
            return value


def _group(written: Mapping[str, Any]) -> Group:
    strokes = tuple(written.get("strokes", ()))
    if not all(isinstance(k, int) for k in strokes):
        raise ValueError("strokes of a group must be whole numbers")
    return Group(
        *(_text(written.get("label")), strokes, _text(written.get("href")), _text(written.get("id"))),
        groups=tuple(_group(each) for each in written.get("groups", ())),
    )


def _text(value: object) -> str | None:
    return None if value is None else str(value)
