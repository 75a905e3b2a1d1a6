"""JSON Lines: rows to the bit and back, broken rows named, never silently lost."""

from __future__ import annotations

import json
import os
import re
import time
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import finite, inks

from sketch.files import jsonl
from sketch.files.decimals import shifted, unshifted
from sketch.files.errors import FileError
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke

REAL = os.environ.get("INKLINED_REAL_INK")

rows = st.builds(
    Row,
    label=st.none() | st.text(max_size=5),
    ink=inks(),
    writer=st.none() | st.text(max_size=5),
    extra=st.dictionaries(
        st.sampled_from(["source", "set", "n"]), st.integers() | finite | st.text(max_size=3)
    ),
)


@settings(max_examples=100, deadline=None)
@given(written=st.lists(rows, min_size=1, max_size=3), suffix=st.sampled_from(["", ".gz"]))
def test_reading_what_was_written_gives_the_same_rows_to_the_bit(
    tmp_path_factory: pytest.TempPathFactory, written: list[Row], suffix: str
) -> None:
    path = tmp_path_factory.mktemp("rows") / f"rows.jsonl{suffix}"
    jsonl.write(path, written)
    loaded = jsonl.read(path)
    assert loaded.rows == tuple(written)
    assert loaded.notices == ()


@given(finite)
def test_moving_the_point_of_a_number_and_back_changes_no_bit(value: float) -> None:
    there = shifted(value, 3)
    assert (
        repr(unshifted(json.loads(there, parse_float=__import__("decimal").Decimal), 3)) == repr(value)
        or value == 0
    )
    assert json.loads(shifted(0.25, 3)) == 250


def test_a_row_is_what_the_format_says(tmp_path: Path) -> None:
    path = tmp_path / "rows.jsonl"
    path.write_text(
        '{"label": "circle", "writer": null, "strokes": [[[1, 2, 0], [3.5, 4, 16.7]], [[5, 6, null]]], "source": "x", "n": 1.5}\n'
        "\n"
        '{"strokes": [[[1, 2]]]}\n',
        encoding="utf-8",
    )
    first, second = jsonl.read(path).rows
    assert first == Row(
        "circle",
        Ink((Stroke([[1, 2], [3.5, 4]], [0, 0.0167]), Stroke([[5, 6]]))),
        None,
        {"source": "x", "n": 1.5},
    )
    assert second == Row(None, Ink((Stroke([[1, 2]]),)))


GOOD = '{"strokes": [[[1, 2, null]]]}'


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("{", "not JSON"),
        ("[" * 100_000, "not JSON that can be read"),
        ("[1]", "not a JSON object"),
        ("{}", "no list of strokes"),
        ('{"strokes": 3}', "no list of strokes"),
        ('{"strokes": [[]]}', "stroke 0 has no points"),
        ('{"strokes": [[[1, 2, 3]], []]}', "stroke 1 has no points"),
        ('{"strokes": [[[1]]]}', r"not \[x, y, t\]"),
        ('{"strokes": [[3]]}', r"not \[x, y, t\]"),
        ('{"strokes": [[["1", 2, 3]]]}', 'x of stroke 0 is "1"'),
        ('{"strokes": [[[1, true, 3]]]}', "y of stroke 0 is true"),
        ('{"strokes": [[[1, 2, "3"]]]}', 't of stroke 0 is "3"'),
        ('{"strokes": [[[NaN, 2, 3]]]}', "NaN stands in it"),
        ('{"strokes": [[[1e999, 2, 3]]]}', "not a finite number"),
        ('{"strokes": [[[1, 2, 1e999]]]}', "not a finite number"),
        (f'{{"strokes": [[[1, 2, 1{"0" * 400}]]]}}', "beyond what float64 holds"),
        (f'{{"strokes": [[[1{"0" * 5000}, 2, 1]]]}}', "not JSON that can be read"),
        ('{"strokes": [[[1e10, 2, 3]]]}', "beyond"),
        ('{"strokes": [[[1, 2, 3]]], "label": 5}', "label must be text or null"),
        ('{"strokes": [[[1, 2, 3]]], "pressure": [[1, 2]]}', "one value per point"),
        ('{"strokes": [[[1, 2, 3]]], "pressure": [1]}', "must be a list of numbers or null"),
        ('{"strokes": [[[1, 2, 3]]], "pressure": []}', "one entry for each of 1 strokes"),
    ],
)  # fmt: skip
def test_a_broken_row_is_named_and_the_others_are_read(tmp_path: Path, line: str, says: str) -> None:
    path = tmp_path / "rows.jsonl"
    path.write_text(f"{GOOD}\n{line}\n{GOOD}\n", encoding="utf-8")
    loaded = jsonl.read(path)
    assert len(loaded.rows) == 2
    assert loaded.lost == 1
    assert loaded.notices[0].line == 2
    assert re.search(says, loaded.notices[0].text), loaded.notices[0].text


def test_times_that_run_backwards_or_are_partly_unknown_are_left_out_with_a_notice(tmp_path: Path) -> None:
    path = tmp_path / "rows.jsonl"
    path.write_text(
        '{"strokes": [[[1, 2, 5], [1, 3, 4]], [[1, 2, 5], [1, 3, null]], [[1, 2, 5]]]}\n', encoding="utf-8"
    )
    loaded = jsonl.read(path)
    assert [stroke.times is None for stroke in loaded.rows[0].ink] == [True, True, False]
    assert [(notice.line, notice.lost) for notice in loaded.notices] == [(1, False), (1, False)]
    assert "stroke 0: its times run backwards" in loaded.notices[0].text
    assert "stroke 1: only 1 of 2 points" in loaded.notices[1].text


@pytest.mark.parametrize(
    ("text", "says"),
    [("", "it is empty"), ("\n\n", "it is empty"), ("{\nx\n", "line 1: the row is left out")],
)
def test_a_file_without_a_readable_row_is_an_error(tmp_path: Path, text: str, says: str) -> None:
    path = tmp_path / "rows.jsonl"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FileError, match=says):
        jsonl.read(path)


def test_extra_keys_that_json_has_not_are_refused_before_anything_is_written(tmp_path: Path) -> None:
    for extra in ({"a": float("nan")}, {"a": {1, 2}}, {"strokes": []}):
        with pytest.raises(FileError, match="extra keys cannot be written"):
            jsonl.write(tmp_path / "rows.jsonl", [Row(None, Ink(), None, extra)])
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(REAL is None, reason="INKLINED_REAL_INK names no folder of people's ink")
def test_people_s_strokes_are_all_read_and_bad_clocks_are_named() -> None:
    started = time.process_time()
    loaded = jsonl.read(Path(REAL or "") / "shapes-dev.jsonl.gz")
    assert time.process_time() - started < 4.0
    assert (len(loaded.rows), loaded.lost, len(loaded.notices)) == (3537, 0, 148)
