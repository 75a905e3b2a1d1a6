"""The benchmark of the published rivals runs, on little ink, and its intervals are Student's."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from data_gen.strokes import generate
from rivals import as_text, mean
from sketch.files import jsonl
from sketch.ink import Ink

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def test_rivals_taught_by_generated_ink_and_by_people_are_told_and_written(tmp_path: Path) -> None:
    rows = [jsonl.Row(item.kind, Ink((item.stroke,)), f"w{item.index % 60}") for item in generate(400, 6)]
    jsonl.write(tmp_path / "ink.jsonl.gz", rows)
    target = tmp_path / "figures.json"
    sizes = ("--draws", "2", "--rows", "40", "--strokes", "7", "--recognizer", "penny-pincher", "rubine")
    command = [sys.executable, str(BENCHMARKS / "rivals.py"), "--ink", str(tmp_path / "ink.jsonl.gz"), *sizes]
    done = subprocess.run(
        [*command, "--json", str(target)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "INKLINED_CACHE": str(tmp_path / "cache")},
    )
    assert done.returncode == 0, done.stderr
    figures = json.loads(target.read_text(encoding="utf-8"))
    for name in ("penny-pincher", "rubine"):
        generated = figures["generated"][name]
        assert 0.3 < generated["five"] <= 1
        assert generated["kinds_rejected"] < 0.2
        assert generated["ms"] > 0
        one, ten = (figures["people"][size][name]["five"] for size in ("1", "10"))
        assert one[0] < ten[0] + 0.1  # more rows teach more
    assert as_text(figures) in done.stdout


def test_the_interval_of_the_mean_is_students() -> None:
    middle, half = mean([0.4, 0.6, 0.5, None])
    assert middle == pytest.approx(0.5)
    assert half == pytest.approx(4.302653 * np.std([0.4, 0.6, 0.5], ddof=1) / 3**0.5, rel=1e-6)
    assert mean([0.7]) == (0.7, 0.0)
