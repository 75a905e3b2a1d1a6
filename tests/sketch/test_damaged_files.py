"""Damaged files of every format: named, counted, bounded in memory and time, and never the end of a reading."""

from __future__ import annotations

import gzip
import resource
import time
from pathlib import Path

import numpy as np
import pytest

from sketch.files import collect, formats
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke

GOOD = Row("circle", Ink((Stroke([[0, 0], [1, 2], [3, 4]], [0, 0.1, 0.2]), Stroke([[5, 5]]))), "w1")
FORMS = list(formats.FORMATS)
LIMIT_SECONDS = 20.0
"""Of CPU for a file of 100 MB: reading and unpacking it is most of that."""
LIMIT_BYTES = 1 << 30
"""Of memory for the same."""


def written(folder: Path, form: str, count: int = 3) -> Path:
    """A good file of that format, the first of a folder where a file is a row."""
    place = folder / f"good{formats.FORMATS[form].suffixes[0]}"
    formats.write(place, [GOOD] * count, form)
    return min(place.iterdir()) if place.is_dir() else place


def read(path: Path) -> collect.FileRead:
    (found,) = collect.collect([path])
    assert found.path == path
    return found


@pytest.mark.parametrize("form", FORMS)
def test_a_file_cut_short_anywhere_is_told_or_its_whole_rows_are_kept(form: str, tmp_path: Path) -> None:
    whole = written(tmp_path, form).read_bytes()
    path = tmp_path / f"cut{formats.FORMATS[form].suffixes[0]}"
    for end in np.linspace(0, len(whole) - 2, 40).astype(int).tolist():
        path.write_bytes(whole[:end])
        found = read(path)
        assert found.failure or found.lost or found.rows
        if form != "unipen":  # a point less is no damage that can be seen there
            assert all(row.ink == GOOD.ink for row in found.rows)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("encoding", ["utf-16", "latin-1"])
def test_a_wrong_encoding_is_named_or_read_right(form: str, encoding: str, tmp_path: Path) -> None:
    path = written(tmp_path, form, 1)
    row = Row("Kreis für café", GOOD.ink, "Ü")
    place = tmp_path / f"said{path.suffix}"
    formats.write(place, [row], form)
    file = min(place.iterdir()) if place.is_dir() else place
    if form == "parquet":
        file.write_bytes(file.read_bytes().decode("latin-1").encode(encoding))
    else:
        file.write_bytes(file.read_text(encoding="utf-8").encode(encoding))
    found = read(file)
    if found.failure is None:
        assert [one.ink for one in found.rows] == [GOOD.ink]
        assert form in ("jsonl", "quickdraw", "parquet")  # these are ASCII, or did not change


@pytest.mark.parametrize("form", [form for form in FORMS if form != "parquet"])
def test_packed_files_that_are_no_gzip_are_named(form: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{formats.FORMATS[form].suffixes[0]}.gz"
    path.write_bytes(gzip.compress(written(tmp_path, form).read_bytes())[:-9])
    assert "cannot be read" in str(read(path).failure)


BOMB = (
    "<!DOCTYPE x ["
    + "".join(f'<!ENTITY a{k} "{f"&a{k - 1};" * 10 if k else "ha"}">' for k in range(12))
    + "]>"
)


@pytest.mark.parametrize("suffix", ["inkml", "xml"])
@pytest.mark.parametrize("body", ["<ink><trace>&a11;</trace></ink>", '<Gesture Name="&a11;"/>'])
def test_entity_bombs_are_refused(suffix: str, body: str, tmp_path: Path) -> None:
    path = tmp_path / f"a.{suffix}"
    path.write_text(BOMB + body)
    assert "XML entities" in str(read(path).failure)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.inkml", "<ink><trace>1 2, NaN 3</trace></ink>"),
        ("a.xml", '<Gesture Name="a"><Point X="NaN" Y="1"/></Gesture>'),
        ("b.xml", '<Gesture Name="a"><Point X="1" Y="inf"/></Gesture>'),
        ("c.xml", '<Gesture Name="a"><Point X="1"/></Gesture>'),
        ("a.ndjson", '{"word": "a", "drawing": [[[1, NaN], [2, 3]]]}'),
        ("b.ndjson", '{"word": "a", "drawing": [[[1, 4], [2]]]}'),
        ("a.jsonl", '{"strokes": [[[1, Infinity, null]]]}'),
        ("a.unipen", ".COORD X Y\n.PEN_DOWN\n1 NaN\n"),
        ("a.txt", "1 2 3"),
        ("not-there.jsonl", None),
    ],
)
def test_what_cannot_be_read_is_a_failure_with_a_reason_and_ends_nothing(
    name: str, text: str | None, tmp_path: Path
) -> None:
    good, bad = written(tmp_path, "jsonl"), tmp_path / name
    if text is not None:
        bad.write_text(text)
    first, second = collect.collect([bad, good])
    assert first.failure and not first.rows
    assert len(second.rows) == 3


def test_not_a_number_in_parquet_costs_its_row_alone(tmp_path: Path) -> None:
    import pyarrow as pa
    from pyarrow import parquet

    place = written(tmp_path, "parquet")
    table = parquet.read_table(place)
    x = table.column("x").to_pylist()
    x[1][0] = float("nan")
    parquet.write_table(table.set_column(table.schema.get_field_index("x"), "x", pa.array(x)), place)
    found = read(place)
    assert (len(found.rows), found.lost) == (2, 1)
    assert "2: the row is left out" in found.remarks[0]


def huge(form: str) -> tuple[str, bytes, bytes, bytes]:
    """A name, and the head, one point and tail of a file that is one endless stroke."""
    match form:
        case "inkml":
            return "a.inkml", b"<ink><trace>1 2", b", 10 200", b"</trace></ink>"
        case "dollar":
            return "a.xml", b'<Gesture Name="a">', b'<Point X="10" Y="20" T="5"/>', b"</Gesture>"
        case "quickdraw":
            return "a.ndjson", b'{"drawing": [[[1', b",1", b"],[1],[1]]]}"
        case "unipen":
            return "a.unipen", b".COORD X Y\n.PEN_DOWN\n", b"10 20\n", b".PEN_UP\n"
        case _:
            return "a.jsonl", b'{"strokes": [[[1,2,0]', b",[1,2,0]", b"]]}"


@pytest.mark.parametrize("form", ["jsonl", "inkml", "dollar", "quickdraw", "unipen"])
def test_a_hundred_megabytes_of_one_stroke_are_refused_within_bounds(form: str, tmp_path: Path) -> None:
    name, head, point, tail = huge(form)
    path = tmp_path / name
    path.write_bytes(head + point * (100_000_000 // len(point)) + tail)
    before, begun = peak(), time.process_time()
    found = read(path)
    assert found.failure and not found.rows
    assert time.process_time() - begun < LIMIT_SECONDS
    assert peak() - before < LIMIT_BYTES


def peak() -> int:
    """The most memory that this process has had, bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
