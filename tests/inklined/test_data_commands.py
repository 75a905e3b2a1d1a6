"""`inklined import`, `export` and `suites` as a person meets them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from inklined.cli import run
from sketch.files import formats, jsonl
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke

ROWS = [
    Row(label, Ink((Stroke([[k, 0], [k, 5], [3, k]], [0, 0.1, 0.2]),)), f"w{k % 2}")
    for k, label in enumerate("abcab")
]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with the same rows as gestures, one of them broken, and files that are no ink."""
    formats.write(tmp_path / "gestures", ROWS, "dollar")
    (tmp_path / "gestures" / "broken.xml").write_text("<Gesture")
    (tmp_path / "gestures" / "README.txt").write_text("read me")
    return tmp_path


def test_a_folder_of_files_becomes_a_suite_and_whatever_is_broken_is_named(folder, capsys, monkeypatch):
    monkeypatch.chdir(folder)
    assert (
        run(["import", "gestures", "--out", "suite.parquet", "--json", "said.json", "--licence", "ours"]) == 0
    )
    told = capsys.readouterr().out
    assert "5 rows, 5 strokes, 2 writers from 5 of 6 files" in told
    assert "broken.xml" in told and "not well-formed" in told
    assert [(row.label, row.ink, row.writer) for row in formats.read(folder / "suite.parquet").rows] == [
        (row.label, row.ink, row.writer) for row in ROWS
    ]
    said = json.loads((folder / "said.json").read_text())
    assert said["suite"]["labels"] == {"a": 2, "b": 2, "c": 1}
    assert sum(file["failure"] is not None for file in said["files"]) == 1
    assert said["passed_over"] == ["gestures/README.txt"]
    assert json.loads((folder / "suite.parquet.card.json").read_text()) == said["suite"]


def test_a_suite_has_one_hash_whatever_it_is_kept_in_and_a_changed_file_is_found_out(
    folder, capsys, monkeypatch
):
    monkeypatch.chdir(folder)
    assert run(["import", "gestures", "--out", "suite.parquet"]) == 0
    assert run(["import", "suite.parquet", "--out", "suite.jsonl.gz", "--name", "other"]) == 0
    capsys.readouterr()
    assert run(["suites", "suite.parquet", "suite.jsonl.gz", "--check", "--json"]) == 0
    cards = json.loads(capsys.readouterr().out)
    assert len({card["hash"] for card in cards}) == 1 and [card["name"] for card in cards] == [
        "suite",
        "other",
    ]
    formats.write(folder / "suite.parquet", ROWS[1:])
    assert run(["suites", "suite.parquet", "--check"]) == 1
    assert "does not hold what its card says" in capsys.readouterr().err


@pytest.mark.parametrize("form", list(formats.FORMATS))
def test_a_suite_is_exported_to_every_format_and_what_is_lost_is_told(form, folder, capsys, monkeypatch):
    monkeypatch.chdir(folder)
    jsonl.write(folder / "suite.jsonl", ROWS)
    place = f"out{formats.FORMATS[form].suffixes[0]}"
    assert run(["export", "suite.jsonl", place, "--label", "a", "b"]) == 0
    told = capsys.readouterr().out
    assert f"4 rows in {place}" in told
    assert ("no place for writer" in told) == (form == "quickdraw")
    assert run(["import", place, "--out", "back.jsonl", "--format", form]) == 0
    assert [row.ink for row in jsonl.read(folder / "back.jsonl").rows] == [
        row.ink for row in ROWS if row.label != "c"
    ]


@pytest.mark.parametrize(
    ("words", "code", "says"),
    [
        (["import", "gestures", "--out", "suite.xml"], 2, "a suite is a .parquet"),
        (["import", "nothing", "--out", "suite.parquet"], 1, "no such file or folder"),
        (
            ["import", "gestures/README.txt", "--out", "s.parquet"],
            1,
            "nothing of any of the 1 files could be read",
        ),
        (["import", "gestures", "--out", "s.parquet", "--format", "xyz"], 2, "known are jsonl, parquet"),
        (["export", "gestures/broken.xml", "out.jsonl"], 1, "not well-formed XML"),
        (["export", "suite.jsonl", "gestures", "--format", "dollar"], 1, "is there already"),
        (
            ["export", "suite.jsonl", "out.jsonl", "--label", "zz"],
            2,
            "no row of suite.jsonl has the label zz",
        ),
    ],
)
def test_what_cannot_be_done_is_said_in_a_line(words, code, says, folder, capsys, monkeypatch):
    monkeypatch.chdir(folder)
    jsonl.write(folder / "suite.jsonl", ROWS)
    assert run(words) == code
    error = capsys.readouterr().err
    assert says in error and error.count("\n") == 1
    assert not (folder / "s.parquet").exists()


def test_the_generated_suites_have_cards_and_hashes_that_stay(capsys):
    seen = []
    for _ in range(2):
        assert run(["suites", "--json"]) == 0
        seen.append(json.loads(capsys.readouterr().out))
    assert seen[0] == seen[1]
    assert [card["place"] for card in seen[0]] == ["strokes", "pages", "problems", "stress"]
    assert len({card["hash"] for card in seen[0]}) == 4
