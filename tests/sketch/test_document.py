"""The `.inklined` document: to the bit and back, and clear about what it cannot be."""

from __future__ import annotations

import gzip
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from strategies import sketches

from sketch.files import document
from sketch.files.errors import FileError
from sketch.ink import Ink, Stroke
from sketch.page import Component, Sketch
from sketch.shapes import Circle


@settings(max_examples=80, deadline=None)
@given(sketches())
def test_reading_what_was_written_gives_the_same_page_to_the_bit(sketch: Sketch) -> None:
    again = document.loads(document.dumps(sketch))
    assert again == sketch
    assert [(e.tree, e.problem) for e in again.expressions] == [
        (e.tree, e.problem) for e in sketch.expressions
    ]
    assert document.dumps(again) == document.dumps(sketch)


def test_files_are_the_same_page_packed_or_not(tmp_path: Path) -> None:
    sketch = Sketch(Ink((Stroke([[0.1, 0.2]], [0.3]),)), (Component(Circle((np.float64(1), 2), 3), (0,)),))
    for name in ("page.inklined", "page.inklined.gz"):
        document.write(tmp_path / name, sketch)
        assert document.read(tmp_path / name) == sketch
    assert (
        gzip.decompress((tmp_path / "page.inklined.gz").read_bytes())
        == (tmp_path / "page.inklined").read_bytes()
    )


def test_a_failed_write_leaves_the_old_file_and_no_litter(tmp_path: Path) -> None:
    path = tmp_path / "page.inklined"
    document.write(path, Sketch())
    before = path.read_bytes()
    with pytest.raises(FileError, match="cannot be written"):
        document.write(tmp_path / "missing" / "page.inklined", Sketch())
    path.chmod(0o640)
    document.write(path, Sketch(Ink((Stroke([[1, 2]]),))))
    assert path.read_bytes() != before
    assert path.stat().st_mode & 0o777 == 0o640
    assert [file.name for file in tmp_path.iterdir()] == ["page.inklined"]


def edited(**parts: Any) -> str:
    return json.dumps({"format": "inklined", "version": 1, **parts})


WIRE = {"kind": "wire", "start": [0, 0], "end": [1, 1]}


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "is not JSON: Expecting value"),
        ("{", "line 1: is not JSON"),
        ("[" * 100_000, "is not JSON that can be read"),
        ("[]", "is not an inklined document"),
        ('{"format": "svg"}', "is not an inklined document"),
        ('{"format": "inklined"}', "has version None"),
        ('{"format": "inklined", "version": 2}', "update inklined to open it"),
        ('{"format": "inklined", "version": 1, "ink": [{"points": [[NaN, 0]]}]}', "NaN stands in it"),
        (edited(ink={}), "ink must be a list"),
        (edited(ink=[3]), r"ink\[0\]: must be an object"),
        (edited(ink=[{}]), r"ink\[0\]: lacks 'points'"),
        (edited(ink=[{"points": []}]), r"ink\[0\]: .*points"),
        (edited(ink=[{"points": [[1, 2, 3]]}]), r"ink\[0\]: points\[0\] has 3 numbers; a point has two"),
        (edited(ink=[{"points": [[1, "2"]]}]), r'points\[0\]\[1\] is "2"; it must be a number'),
        (edited(ink=[{"points": [[1, 2]], "times": [1, 2]}]), "one value per point"),
        (edited(ink=[{"points": [[1, 2], [1, 2]], "times": [2, 1]}]), "time runs backwards at point 1"),
        (edited(ink=[{"points": [[1, 10**400]]}]), "must be a finite number"),
        (
            '{"format": "inklined", "version": 1, "ink": [{"points": [[1, 1e999]]}]}',
            "must be a finite number",
        ),
        (edited(components=[{"label": "A", "shape": {"kind": "star"}}]), "known are circle, polygon"),
        (
            edited(components=[{"label": "A", "shape": {"kind": "circle", "centre": [0, 0]}}]),
            "lacks 'radius'",
        ),
        (edited(components=[{"label": "A", "shape": {**WIRE, "end": [0, 0]}}]), "a wire of no length"),
        (edited(components=[{"label": 1, "shape": WIRE}]), "label is 1; it must be text"),
        (
            edited(components=[{"label": "A", "shape": WIRE, "fixed": 1}]),
            "fixed is 1; it must be true or false",
        ),
        (
            edited(components=[{"label": "A", "shape": WIRE, "ends": ["B"]}]),
            "ends has 1 entries; it needs two",
        ),
        (edited(components=[{"label": "A", "shape": WIRE, "ends": [None, "B"]}]), "'B', which is not there"),
        (
            edited(components=[{"label": "A", "shape": WIRE, "strokes": [0]}]),
            "names stroke 0; the page has 0",
        ),
        (edited(components=[{"label": "A", "shape": WIRE, "strokes": [True]}]), "strokes is true"),
        (edited(expressions=[{}]), r"expressions\[0\]: lacks 'text'"),
        (edited(associations=[{"expression": 0, "component": "A", "anchor": [0, 0]}]), "names expression 0"),
        (edited(gestures=[{"kind": "wave", "stroke": 0}]), "known are tap, scribble, lasso"),
    ],
)
def test_a_broken_document_is_refused_with_the_place_and_what_would_be_right(text: str, says: str) -> None:
    with pytest.raises(FileError, match=says) as caught:
        document.loads(text, "page.inklined")
    assert str(caught.value).startswith("page.inklined")
    assert "\n" not in str(caught.value)


def test_a_missing_file_a_folder_and_binary_data_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="there is no such file"):
        document.read(tmp_path / "none.inklined")
    with pytest.raises(FileError, match="cannot be read"):
        document.read(tmp_path)
    (tmp_path / "bytes.inklined").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(FileError, match="is not UTF-8 text"):
        document.read(tmp_path / "bytes.inklined")
    (tmp_path / "half.inklined.gz").write_bytes(gzip.compress(b"{}" * 1000)[:20])
    with pytest.raises(FileError, match="cannot be read"):
        document.read(tmp_path / "half.inklined.gz")


def test_ten_thousand_strokes_and_one_dot_and_nothing_are_pages() -> None:
    many = Sketch(Ink(tuple(Stroke([[k, k], [k + 1, k]]) for k in range(10_000))))
    for sketch in (many, Sketch(Ink((Stroke([[1, 2]]),))), Sketch()):
        assert document.loads(document.dumps(sketch)) == sketch
