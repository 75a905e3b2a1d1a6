"""The bench's commands: figures that come again, examinations, plans."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from evaluation.cards import rows_hash
from evaluation.exports import as_latex
from evaluation.formula_suites import generated_formulas
from evaluation.table import Cell, Table
from inklined.cli import run
from sketch.files import formats, jsonl
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke


@pytest.fixture(scope="module")
def compared(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which a comparison wrote all that it can."""
    folder = tmp_path_factory.mktemp("compared")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        assert run(["generate", "strokes", "ink.jsonl", "--count", "60", "--seed", "3"]) == 0
        words = ["compare", "--ink", "ink.jsonl", "--strokes", "45", "--recognizer", "paper", "geometric"]
        words += [
            "--jobs",
            "1",
            "--seed",
            "5",
            "--json",
            "scores.json",
            "--report",
            "report.html",
            "--tables",
            "tables",
        ]
        assert run(words) == 0
    return folder


def test_every_measure_has_its_interval_and_its_n(compared):
    figures = json.loads((compared / "scores.json").read_text())
    told = figures["statistics"]["standings"]
    assert {one["suite"] for one in told} == {"ink.jsonl", "45 generated strokes, seed 5"}
    for one in told:
        for name, value in one["values"].items():
            assert name in ("paper", "geometric")
            assert 0 <= value["low"] <= value["value"] <= value["high"] <= 1
            assert value["n"] in (45, 60) or one["measure"] == "five kinds"
    by_suite = {(one["suite"], one["measure"]): one["values"] for one in told}
    assert by_suite["ink.jsonl", "balanced accuracy"]["paper"]["value"] == pytest.approx(
        figures["recognizers"]["paper"]["balanced_accuracy"]
    )
    (pair, *_) = figures["statistics"]["pairs"]
    first, second = (figures["recognizers"][name]["accuracy"] for name in (pair["first"], pair["second"]))
    assert pair["difference"] == pytest.approx(first - second)
    assert pair["apart"]["value"] == pytest.approx(pair["difference"])
    assert pair["apart"]["low"] <= pair["apart"]["value"] <= pair["apart"]["high"]
    for name in ("paper", "geometric"):
        memory = figures["recognizers"][name]["memory_mb"]
        assert 0 <= memory["grown"] < 1000 and memory["learnt"] == 0


def test_the_figures_say_where_they_come_from_and_come_again(compared, monkeypatch, capsys):
    monkeypatch.chdir(compared)
    origin = json.loads((compared / "scores.json").read_text())["provenance"]
    assert origin["arguments"][:3] == ["compare", "--ink", "ink.jsonl"]
    assert set(origin["hashes"]) == {"ink.jsonl", "45 generated strokes, seed 5"}
    html = (compared / "report.html").read_text()
    assert all(digest in html for digest in origin["hashes"].values())
    assert "inklined compare --ink ink.jsonl" in html
    capsys.readouterr()
    assert run(["reproduce", "scores.json"]) == 0
    assert "Every figure is what scores.json says" in capsys.readouterr().out
    figures = json.loads((compared / "scores.json").read_text())
    figures["recognizers"]["paper"]["accuracy"] = 0.123
    (compared / "other.json").write_text(json.dumps(figures))
    assert run(["reproduce", "other.json"]) == 1
    told = capsys.readouterr()
    assert "recognizers.paper.accuracy: 0.123, then" in told.out
    assert "1 figures are not what other.json says" in told.err


def test_readers_of_mathematics_are_compared_on_the_same_expressions(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    rows = [
        Row(row.label, row.ink, f"w{k % 2}", row.extra) for k, row in enumerate(generated_formulas(6, 3).rows)
    ]
    jsonl.write(tmp_path / "math.jsonl", [*rows, Row("no { mathematics", rows[0].ink)])
    words = ["compare", "--formulas", "math.jsonl", "--formula-rows", "3", "--expressions", "1"]
    words += ["--jobs", "1", "--json", "f.json", "--tables", "tables", "--report", "f.html"]
    assert run(words) == 0
    said = capsys.readouterr().out
    assert "1 rows whose label is no mathematics" in said and "3 rows more are there" in said
    told = json.loads((tmp_path / "f.json").read_text())
    assert [one["suite"] for one in told["formulas"]] == ["math.jsonl", "1 generated expressions, seed 2026"]
    people = told["formulas"][0]["readers"]
    assert people.keys() == {"net", "dollar-p"}
    by = {(one["suite"], one["measure"]): one["values"] for one in told["statistics"]["standings"]}
    for name, one in people.items():
        right = by["math.jsonl", "expressions right"][name]
        assert right["n"] == 3 and right["clusters"] == len({f"w{k % 2}" for k in (0, 2, 5)})
        assert right["value"] == pytest.approx(one["expression_rate"])
        assert by["math.jsonl", "signs right"][name]["value"] == pytest.approx(one["symbol_accuracy"])
        assert one["memory_mb"]["grown"] > 1 and one["memory_mb"]["learnt"] > 0.05
    (pair, *_) = told["statistics"]["pairs"]
    assert {pair["first"], pair["second"]} == {"net", "dollar-p"} and pair["test"] == "mcnemar"
    html = (tmp_path / "f.html").read_text()
    assert 'id="formulas"' in html and told["provenance"]["hashes"]["math.jsonl"] in html
    assert any("expressions" in path.name for path in (tmp_path / "tables").glob("*.csv"))


def test_rows_without_mathematics_are_none_to_compare_readers_on(tmp_path, capsys):
    place = tmp_path / "bare.jsonl"
    jsonl.write(place, [Row(None, Ink((Stroke([[0, 0], [1, 1]]),)))])
    assert run(["compare", "--formulas", str(place)]) == 1
    assert "no row is labelled with mathematics" in capsys.readouterr().err


def test_figures_that_nothing_can_be_had_again_from_are_refused(tmp_path, capsys):
    (tmp_path / "a.json").write_text("{}")
    assert run(["reproduce", str(tmp_path / "a.json")]) == 1
    assert "holds no figures of inklined compare" in capsys.readouterr().err


def test_every_table_is_written_as_csv_and_latex(compared):
    names = sorted(path.name for path in (compared / "tables").iterdir())
    assert len(names) % 2 == 0 and len(names) >= 12
    assert {name.rpartition(".")[2] for name in names} == {"csv", "tex"}
    for path in (compared / "tables").glob("*.csv"):
        rows = list(csv.reader(path.open(encoding="utf-8")))
        assert len({len(row) for row in rows}) == 1
    for path in (compared / "tables").glob("*.tex"):
        text = path.read_text()
        assert text.count("{") == text.count("}") and r"\toprule" in text


def test_latex_keeps_no_letter_that_it_would_read():
    text = as_latex(Table("50 % & more", ("", "a_b"), (("x#", Cell("1–2", best=True)),)))
    assert r"\textbf{1--2}" in text and r"a\_b" in text and r"50 \% \& more" in text and r"x\#" in text


SHAPES = {
    "vee": [[0, 0], [5, 10], [10, 0]],
    "line": [[0, 0], [5, 0], [10, 0]],
    "hook": [[0, 0], [0, 10], [6, 10]],
}


@pytest.fixture
def gestures(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(1)
    rows = [
        Row(label, Ink((Stroke(np.array(path) + rng.normal(0, 0.5, (3, 2)), [0, 0.1, 0.2]),)), f"w{w}")
        for w in range(3)
        for label, path in SHAPES.items()
        for _ in range(4)
    ]
    jsonl.write(tmp_path / "gestures.jsonl", rows)
    return tmp_path


def figures(folder: Path) -> dict[str, object]:
    return json.loads((folder / "out.json").read_text())


def test_protocols_on_gestures_of_any_name(gestures, capsys):
    ink = ["gestures.jsonl", "--json", "out.json", "--jobs", "1"]
    assert run(["protocol", "user-dependent", *ink, "--recognizer", "protractor", "dollar-p", "--templates", "1", "3", "--trials", "2"]) == 0  # fmt: skip
    said = capsys.readouterr().out
    assert "18 tests of 3 writers each" in said and "Holm-corrected" in said
    assert [(m["name"], m["templates"]) for m in figures(gestures)["marks"]] == [
        ("protractor", 1), ("dollar-p", 1), ("protractor", 3), ("dollar-p", 3),
    ]  # fmt: skip
    assert (
        run(
            [
                "protocol",
                "user-independent",
                *ink,
                "--recognizer",
                "protractor",
                "--folds",
                "3",
                "--templates",
                "2",
            ]
        )
        == 0
    )
    assert figures(gestures)["marks"][0]["best"][0]["n"] == 36


@pytest.mark.parametrize(
    ("words", "code", "says"),
    [
        (
            ["protocol", "zero-shot", "gestures.jsonl", "--recognizer", "paper"],
            1,
            "no row bears a label that is a stroke kind",
        ),
        (["protocol", "user-dependent", "gestures.jsonl", "--templates", "9"], 1, "ask for fewer templates"),
        (
            ["protocol", "user-dependent", "gestures.jsonl", "--recognizer", "paper"],
            2,
            "examines those that learn",
        ),
        (["protocol", "psychic", "gestures.jsonl"], 2, "known are user-dependent"),
        (["early", "gestures.jsonl", "--recognizer", "paper"], 1, "stroke kind"),
        (["stress", "--axis", "weather"], 2, "known are tremor"),
        (["plan", "--first", "0.1", "--second", "0.1"], 2, "cannot be told apart"),
        (["compare", "--expressions", "2", "--reader", "nobody"], 2, "known are net, dollar-p"),
        (["compare", "--expressions", "2", "--recognizer", "paper"], 2, "--reader says who reads"),
        (["evaluate", "out", "--pages", "3", "--problems", "2"], 2, "a folder holds one of them"),
        (["generate", "strokes", "a.inkml"], 2, "inkml is a file a row"),
        (["generate", "strokes", "a.jsonl", "--cluster", "tcp://127.0.0.1:1"], 2, "name a folder"),
    ],
)
@pytest.mark.usefixtures("gestures")
def test_what_cannot_be_examined_is_said_in_a_line(words, code, says, capsys):
    assert run(words) == code
    error = capsys.readouterr().err
    assert says in error and error.count("\n") == 1


def test_strokes_are_generated_in_any_form_alike(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = ["--count", "50", "--seed", "3"]
    for place in ("a.jsonl.gz", "a.parquet"):
        assert run(["generate", "strokes", place, *words]) == 0
    assert run(["generate", "strokes", "parts", *words, "--shard", "20"]) == 0
    assert "3 parts made, 0 were there" in capsys.readouterr().out
    assert run(["generate", "strokes", "parts", *words, "--shard", "20"]) == 0
    assert "0 parts made, 3 were there" in capsys.readouterr().out
    found = [rows_hash(formats.read(Path(place)).rows) for place in ("a.jsonl.gz", "a.parquet")]
    parts = [row for part in sorted(Path("parts").glob("*.parquet")) for row in formats.read(part).rows]
    assert {*found, rows_hash(parts)} == {found[1]}


def test_pages_drawn_by_two_processes_are_those_of_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for folder, jobs in (("one", "1"), ("two", "2")):
        assert run(["generate", "pages", folder, "--count", "4", "--seed", "5", "--jobs", jobs]) == 0
    one, two = (
        {path.name: path.read_bytes() for path in Path(folder).iterdir()} for folder in ("one", "two")
    )
    assert one == two and len(one) == 4


def test_early_stress_gestures_and_plans_are_told_and_written(gestures, capsys):
    assert run(["generate", "strokes", "ink.jsonl", "--count", "40", "--seed", "3"]) == 0
    out = ["--json", "out.json", "--jobs", "1"]
    assert run(["early", "ink.jsonl", "--recognizer", "paper", "--steps", "2", *out]) == 0
    assert [one["fraction"] for one in figures(gestures)["paper"]] == [0.5, 1.0]
    assert run(["stress", "--recognizer", "paper", "--axis", "rate", "--strokes", "30", *out]) == 0
    (curve,) = figures(gestures)["curves"]
    assert (curve["axis"], curve["levels"][:2]) == ("rate", [None, 60.0])
    assert figures(gestures)["worst_group"].keys() == {"paper"}
    assert (
        run(["gestures", "gestures.jsonl", "--per-writer", "--json", "out.json", "--tables", "tables"]) == 0
    )
    assert figures(gestures)["relative_accuracy"].keys() == set(SHAPES)
    assert run(["plan", "--first", "0.08", "--second", "0.02", "--per-writer", "20", "--alike", "0.1"]) == 0
    assert "design effect 2.90" in capsys.readouterr().out
    assert run(["plan", "--margin", "0.05"]) == 0
    assert "385 rows by 385 writers: margin 0.05" in capsys.readouterr().out
