"""What leaving a variation out costs: its figures by closed forms, and its log."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from sketch.files import jsonl
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke
from training import ablation
from training.ablation import ALL, People, balanced, interval, read_people


@pytest.fixture
def people(tmp_path: Path) -> People:
    ring = np.linspace(0, 2 * np.pi, 40)
    circle, line = Stroke(np.column_stack([np.cos(ring), np.sin(ring)])), Stroke([(0, 0), (9, 1)])
    rows = [Row("circle", Ink((circle,)), "ann"), Row("wire", Ink((line,)), "bob")] * 6
    rows += [Row("hyperbola", Ink((circle,)), "ann"), Row("arrow", Ink((line, line)), "cis")]
    jsonl.write(tmp_path / "rows.jsonl", rows)
    return read_people(tmp_path / "rows.jsonl")


def test_rows_without_the_label_of_a_kind_are_left_out(people: People) -> None:
    assert len(people.label) == 13 and len(np.unique(people.writer)) == 3
    assert people.corpus.sizes.tolist() == [1] * 12 + [2]


def test_every_label_counts_the_same_however_many_rows_it_has(people: People) -> None:
    right = np.ones(13, dtype=bool)
    right[-1] = False
    assert balanced(right, people.label) == pytest.approx(2 / 3)


def test_a_net_is_no_better_than_itself_and_one_that_is_always_right_is(people: People) -> None:
    right, wrong = np.ones(13, dtype=bool), np.zeros(13, dtype=bool)
    assert interval(right, right, people.label, people.writer) == (0.0, 0.0)
    assert interval(right, wrong, people.label, people.writer) == (1.0, 1.0)


@pytest.mark.usefixtures("people")
def test_what_the_log_holds_is_not_run_again(tmp_path: Path) -> None:
    log = tmp_path / "table.jsonl"
    names = (ALL, ablation.AGAIN, *ablation.VARIATIONS)
    log.write_text("".join(json.dumps({"without": name, "right": [1] * 12 + [0]}) + "\n" for name in names))
    out = tmp_path / "table.txt"
    assert ablation.main(["--ink", str(tmp_path / "rows.jsonl"), "--out", str(out), "--threads", "1"]) == 0
    table = out.read_text()
    assert all(name in table for name in names if name != ALL) and "66.7 %" in table


def test_a_name_that_is_no_variation_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        ablation.main(["--ink", str(tmp_path / "rows.jsonl"), "--only", "luck"])
    assert "luck" in capsys.readouterr().err
