"""Opening a page picks the format by the file's name."""

from __future__ import annotations

from pathlib import Path

import pytest

from sketch.files import document, inkml, jsonl
from sketch.files.errors import FileError
from sketch.files.jsonl import Row
from sketch.files.pages import open_page
from sketch.ink import Ink, Stroke
from sketch.page import Component, Sketch
from sketch.shapes import Circle

INK = Ink((Stroke([[1, 2], [3, 4]], [0, 0.1]),))


@pytest.mark.parametrize("packed", ["", ".gz"])
def test_every_format_opens_as_a_page(tmp_path: Path, packed: str) -> None:
    sketch = Sketch(INK, (Component(Circle((2, 3), 1), (0,)),))
    document.write(tmp_path / f"a.inklined{packed}", sketch)
    inkml.write(tmp_path / f"a.INKML{packed}", INK)
    jsonl.write(tmp_path / f"a.b.jsonl{packed}", [Row("circle", INK), Row("wire", Ink())])
    assert open_page(tmp_path / f"a.inklined{packed}") == sketch
    assert open_page(tmp_path / f"a.INKML{packed}") == Sketch(INK)
    assert open_page(str(tmp_path / f"a.b.jsonl{packed}")) == Sketch(INK)


def test_an_unknown_kind_of_file_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"known are \.inklined, \.inkml, \.jsonl"):
        open_page(tmp_path / "a.png")
