"""Every format of labelled ink: what was written is read again, and the data sets' own files are read as they are."""

from __future__ import annotations

import json
import os
from collections import Counter
from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from strategies import inks

from sketch.files import collect, dollar_xml, formats, marked, parquet, quickdraw, unipen, xml_tree
from sketch.files.errors import FileError
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke

REAL = os.environ.get("INKLINED_REAL_INK")
ORIGINALS = Path(REAL or "") / "formats"
needs_originals = pytest.mark.skipif(not REAL, reason="INKLINED_REAL_INK names no folder of real ink")

names = st.none() | st.text(
    st.characters(exclude_categories=("Cc", "Cs", "Co", "Cn")), min_size=1, max_size=6
)
values = st.recursive(
    st.none() | st.booleans() | st.integers(-9, 9) | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=2),
    max_leaves=4,
)
rows = st.builds(
    Row,
    label=names,
    ink=inks(),
    writer=names,
    extra=st.dictionaries(st.sampled_from(["source", "set", "n"]), values, max_size=2),
)


def held(row: Row, form: str) -> Row:
    """The row without what the format has no place for."""
    lost = formats.FORMATS[form].losses(row)
    strokes = tuple(
        Stroke(s.points, None if "times" in lost else s.times, None if "pressure" in lost else s.pressure)
        for s in row.ink
    )
    return Row(
        row.label,
        Ink(strokes),
        None if "writer" in lost else row.writer,
        {} if "extra" in lost else row.extra,
    )


def without_marks(row: Row, form: str) -> Row:
    return replace(
        row, extra={key: value for key, value in row.extra.items() if key != formats.FORMATS[form].own}
    )


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(written=st.lists(rows, min_size=1, max_size=3), form=st.sampled_from(list(formats.FORMATS)))
def test_reading_what_was_written_gives_all_that_the_format_holds_to_the_bit(
    tmp_path_factory: pytest.TempPathFactory, written: list[Row], form: str
) -> None:
    if form in ("unipen", "dollar"):
        written = [row for row in written if len(row.ink)]
    if form == "dollar":
        written = [row for row in written if row.label is None or dollar_xml.label_of(row.label) == row.label]
    if not written:
        return
    place = tmp_path_factory.mktemp("rows") / f"rows{formats.FORMATS[form].suffixes[0]}"
    assert formats.write(place, written, form) == len(written)
    files, passed = collect.files_in([place])
    read = [row for file in collect.collect(files) for row in file.rows]
    assert not passed
    expected = [held(row, form) for row in written]
    if form == "inkml":
        expected = [replace(row, label=strip(row.label), writer=strip(row.writer)) for row in expected]
    assert [without_marks(row, form) for row in read] == expected


def strip(text: str | None) -> str | None:
    """InkML's annotations are kept without the white space around them."""
    return None if text is None else text.strip()


def test_what_a_format_has_no_place_for_is_told() -> None:
    row = Row("a", Ink((Stroke([[1, 2]], [0], [1]),)), "w", {"source": "x"})
    assert {name: form.losses(row) for name, form in formats.FORMATS.items()} == {
        "jsonl": (),
        "parquet": (),
        "inkml": ("extra",),
        "dollar": ("extra",),
        "quickdraw": ("writer", "pressure"),
        "unipen": ("extra",),
    }


# The data sets' own files -----------------------------------------------------------------------


@needs_originals
@pytest.mark.parametrize("path", sorted(ORIGINALS.glob("*.inkml")), ids=lambda path: path.stem)
def test_expressions_and_flow_charts_are_read_with_their_groups_and_survive_writing(
    path: Path, tmp_path: Path
) -> None:
    (row,) = marked.read(path).rows
    text = path.read_text(encoding="utf-8")
    assert len(row.ink) == text.count("<trace ")
    marks = marked.marks_of(row)
    assert row.writer and row.label == marks.annotation("truth")
    (outer,) = marks.groups
    named = [k for group in outer.groups for k in group.strokes]
    assert sorted(named) == sorted(set(named))
    assert len(named) == text.count("<traceView")
    assert {group.href for group in outer.groups} <= ids_of(marks.truths[0])
    marked.write(tmp_path / "again.inkml", row)
    assert marked.read(tmp_path / "again.inkml").rows == (row,)


def ids_of(truth: str) -> set[str | None]:
    """The names of a truth's elements; None, for a group that names none, is among them."""
    root = xml_tree.parse(truth.encode(), "truth")
    return {None} | {element.attributes.get("id") for element in root.everything()}


@needs_originals
def test_parts_of_marked_ink_are_rows_of_their_own() -> None:
    (row,) = marked.read(ORIGINALS / "crohme_103_em_1.inkml").rows
    parts = marked.parts(row)
    assert [(part.label, len(part.ink)) for part in parts] == [
        ("e", 1), ("v", 1), ("c", 1), ("(", 1), ("1", 1), (")", 1), ("=", 2),
    ]  # fmt: skip
    assert {part.writer for part in parts} == {"103"}
    (chart,) = marked.read(ORIGINALS / "fc_writer10_10b.inkml").rows
    assert Counter(part.label for part in marked.parts(chart))["arrow"] == 4


@needs_originals
@pytest.mark.parametrize("path", sorted(ORIGINALS.glob("*.xml")), ids=lambda path: path.stem)
def test_gestures_are_read_and_written_back_attribute_by_attribute(path: Path, tmp_path: Path) -> None:
    (row,) = dollar_xml.read(path).rows
    before = xml_tree.parse(path.read_bytes(), path)
    assert before.attributes["NumPts"] == str(sum(len(stroke) for stroke in row.ink))
    assert row.writer == before.attributes["Subject"]
    assert not (row.label or "").endswith(("0", "1", "~", "-"))
    dollar_xml.write(tmp_path / "again.xml", row)
    after = xml_tree.parse((tmp_path / "again.xml").read_bytes(), "again")
    assert same(before, after)


def same(before: xml_tree.Element, after: xml_tree.Element) -> bool:
    """Equal elements, numbers by their values."""

    def values(element: xml_tree.Element) -> dict[str, object]:
        is_point = element.name == "Point"
        return {k: Decimal(v) if is_point else v for k, v in element.attributes.items()}

    return values(before) == values(after) and all(
        same(a, b) for a, b in zip(before.children, after.children, strict=True)
    )


@needs_originals
@pytest.mark.parametrize("word", ["cloud", "star"])
def test_quick_drawings_come_back_as_the_same_json(word: str, tmp_path: Path) -> None:
    path = ORIGINALS / f"quickdraw_{word}.ndjson"
    loaded = quickdraw.read(path)
    assert len(loaded.rows) == 10 and not loaded.notices
    assert {row.label for row in loaded.rows} == {word}
    quickdraw.write(tmp_path / "again.ndjson", loaded.rows)
    before, after = (
        [json.loads(line) for line in file.read_text().splitlines()]
        for file in (path, tmp_path / "again.ndjson")
    )
    assert before == after


@needs_originals
@pytest.mark.parametrize("form", ["jsonl", "parquet"])
def test_every_original_survives_our_own_formats(form: str, tmp_path: Path) -> None:
    files, passed = collect.files_in([ORIGINALS])
    read = list(collect.collect(files))
    assert len(files) == 20 and not passed
    assert all(file.failure is None and not file.lost for file in read)
    every = [row for file in read for row in file.rows]
    assert len(every) == 38
    place = tmp_path / f"all{formats.FORMATS[form].suffixes[0]}"
    formats.write(place, every)
    assert list(formats.read(place).rows) == every


# UNIPEN, by its definition ----------------------------------------------------------------------

SAMPLE = """.VERSION 1.0
.DATA_SOURCE ours
.COMMENT words that go on
over lines
.HIERARCHY WORD CHARACTER
.COORD X Y T
.WRITER_ID w7
.SEGMENT WORD 0-2 OK "it"
.SEGMENT CHARACTER 0-1 OK "i"
.SEGMENT CHARACTER 2 ? "t\\"\\\\"
.PEN_DOWN
 1 -2 0
 1 -9 12
.PEN_UP
.PEN_DOWN
 1 5 40
.PEN_UP
.COORD X Y P
.PEN_DOWN
 4 -3 0.5
 8 -3 1
.PEN_UP
"""


def test_unipen_s_finest_segments_are_the_rows(tmp_path: Path) -> None:
    path = tmp_path / "a.unipen"
    path.write_text(SAMPLE)
    dotted, crossed = unipen.read(path).rows
    assert dotted == Row("i", Ink((Stroke([[1, 2], [1, 9]], [0, 0.012]), Stroke([[1, -5]], [0.04]))), "w7")
    assert crossed == Row('t"\\', Ink((Stroke([[4, 3], [8, 3]], None, [0.5, 1]),)), "w7", {"quality": "?"})


def test_unipen_without_segments_is_one_row_and_a_rate_gives_times(tmp_path: Path) -> None:
    path = tmp_path / "a.unipen"
    path.write_text(".COORD X Y\n.POINTS_PER_SECOND 100\n.PEN_DOWN\n0 2\n1 1\n.PEN_UP\n5 5\n.PEN_DOWN\n2 2\n")
    (row,) = unipen.read(path).rows
    assert row == Row(None, Ink((Stroke([[0, -2], [1, -1]], [0, 0.01]), Stroke([[2, -2]], [0.03]))))


def test_unipen_names_every_segment_and_component_that_is_lost(tmp_path: Path) -> None:
    path = tmp_path / "a.unipen"
    path.write_text(
        '.COORD X Y\n.SEGMENT CHARACTER 0 OK "a"\n.SEGMENT CHARACTER 1 OK "b"\n.SEGMENT CHARACTER 7 OK "c"\n'
        '.SEGMENT CHARACTER x OK "d"\n.PEN_DOWN\n0 0\n.PEN_UP\n.PEN_DOWN\n1 nan\n.PEN_UP\n.PEN_DOWN\n2 2\n'
    )
    loaded = unipen.read(path)
    assert [row.label for row in loaded.rows] == ["a"]
    assert [(notice.line, notice.lost) for notice in loaded.notices] == [
        (5, True), (9, True), (3, True), (4, True), (1, True),
    ]  # fmt: skip


def test_unipen_s_own_definitions_and_included_files_are_no_ink(tmp_path: Path) -> None:
    """The format defines itself by .RESERVE and .KEYWORD statements, which a file may repeat; labels may stand in a file that
    includes the ink's."""
    path = tmp_path / "a.unipen"
    head = (
        '.RESERVE [N] Number: 1 2 3\n.KEYWORD .PEN_DOWN [N] [.]\nBegin of a component.\n.ALPHABET "a" "b"\n'
    )
    path.write_text(head + SAMPLE)
    assert [row.label for row in unipen.read(path).rows] == ["i", 't"\\']
    path.write_text(
        '.INCLUDE lib/ink.dat\n.COORD X Y\n.PEN_DOWN\n0 0\n.PEN_UP\n.SEGMENT CHARACTER 0 OK "a"\n'
    )
    loaded = unipen.read(path)
    assert [row.label for row in loaded.rows] == ["a"]
    assert [(notice.line, notice.lost) for notice in loaded.notices] == [(1, False)]
    assert "lib/ink.dat" in str(loaded.notices[0])


def test_a_parquet_file_of_others_is_refused_by_its_columns(tmp_path: Path) -> None:
    import pyarrow as pa
    from pyarrow import parquet as arrow

    arrow.write_table(pa.table({"label": ["a"], "x": [1.0]}), tmp_path / "a.parquet")
    with pytest.raises(FileError, match="lacks the columns stroke, y, t, p"):
        parquet.read(tmp_path / "a.parquet")
