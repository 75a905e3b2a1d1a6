"""`inklined read` as a process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from data_gen.writers import sample_writer
from data_gen.writing.habits import habits
from data_gen.writing.typeset import written
from sketch.files.jsonl import Row, write
from sketch.writing.rows import nodes_of, row_of


def process(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", "from inklined.cli import main; main()", *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=cwd,
        env={**os.environ, "COLUMNS": "120", "NO_COLOR": "1"},
        timeout=120,
        check=False,
    )


@pytest.fixture(scope="module")
def expressions(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("ink") / "expressions.jsonl.gz"
    rows: list[Row] = []
    for seed, text in enumerate(["F = m a", r"x ^ { 2 } = 4"]):
        rng = np.random.default_rng([5, seed])
        found = written(row_of(text), habits(sample_writer(rng), rng))
        symbols = [{"label": node.name, "strokes": list(node.strokes)} for node in nodes_of(found.row)]
        rows.append(Row(text, found.ink, "w", {"symbols": symbols}))
    write(path, [*rows, Row(None, rows[0].ink)])
    return path


def test_a_file_of_expressions_is_read_and_scored(expressions: Path, tmp_path: Path) -> None:
    finished = process("read", expressions, "--json", "read.json", cwd=tmp_path)
    assert finished.returncode == 0, finished.stderr
    found = json.loads((tmp_path / "read.json").read_text("utf-8"))
    assert found["rows"] == 3
    assert found["labelled"] == 2
    assert [item["truth"] for item in found["items"]] == ["F = m a", "x ^ { 2 } = 4", None]
    right = [item["claim"] == item["truth"] for item in found["items"][:2]]
    assert found["expression_rate"] == sum(right) / 2
    assert 0 <= found["symbol_accuracy"] <= 1
    assert 0 <= found["structure_rate"] <= 1
    assert found["latency_ms"]["p95"] > 0
    assert all(0 <= item["confidence"] <= 1 for item in found["items"])


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("none.jsonl", None, "no such file"),
        ("bad.jsonl", "{]\n", "not JSON"),
        ("empty.jsonl", "", "empty"),
        ("points.jsonl", '{"strokes": [[]]}\n', "no points"),
        ("nan.jsonl", '{"strokes": [[[NaN, 1, null]]]}\n', "finite"),
    ],
)
def test_what_cannot_be_read_is_told_in_one_line(
    name: str, text: str | None, words: str, tmp_path: Path
) -> None:
    if text is not None:
        (tmp_path / name).write_text(text, "utf-8")
    finished = process("read", name, "--json", "read.json", cwd=tmp_path)
    assert finished.returncode == 1
    assert words in finished.stderr
    assert finished.stderr.count("\n") == 1
    assert not (tmp_path / "read.json").exists()


def test_an_unknown_reader_is_named(expressions: Path, tmp_path: Path) -> None:
    finished = process("read", expressions, "--reader", "oracle", cwd=tmp_path)
    assert finished.returncode == 2
    assert "net, dollar-p" in finished.stderr
