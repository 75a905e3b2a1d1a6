"""Laws of the contest over strokes, and of the suites it runs on."""

from __future__ import annotations

import gzip
import json

import pytest

from evaluation.stroke_contest import stroke_contest
from evaluation.suites import claim_of_row, generated_strokes, strokes_from_files
from evaluation.summary import stroke_summary
from evaluation.table import column
from recognizer.claims import claim_for
from sketch.files.errors import FileError

SUITE = generated_strokes(120, 4)


@pytest.fixture(scope="module")
def results():
    return stroke_contest(SUITE, ("paper", "geometric"))


def without_latency(summary):
    for result in summary["recognizers"].values():
        del result["latency_ms"]
    return summary


def test_the_order_of_recognizers_changes_no_score(results):
    turned = stroke_contest(SUITE, ("geometric", "paper"))
    first, second = (without_latency(stroke_summary(SUITE, each)) for each in (results, turned))
    assert first["recognizers"] == second["recognizers"]


def test_two_processes_give_the_scores_of_one():
    large = generated_strokes(401, 4)
    one, two = (
        without_latency(stroke_summary(large, stroke_contest(large, ("paper",), jobs))) for jobs in (1, 2)
    )
    assert one == two


def test_single_and_several_and_all_rows_add_up(results):
    for result in results:
        assert result.single.n + result.several.n == result.scores.n == len(SUITE.labels)
        assert result.claimable.n + sum(result.unclaimable.values()) == result.scores.n
        assert sum(result.right) == pytest.approx((result.scores.accuracy or 0) * result.scores.n)


def test_a_row_of_several_strokes_is_claimed_by_the_greatest_sum():
    claims = [claim_for("wire", 0.9), claim_for("arrow", 0.6), claim_for("arrow", 0.5)]
    assert claim_of_row(claims).kind == "arrow"
    assert not claim_of_row(claims).rejected
    assert claim_of_row([claim_for("math", 0.4, rejected=True)]).rejected


def test_every_row_of_a_file_is_scored_or_told(tmp_path):
    dot = [[[0, 0, None]]]
    rows = [
        {"label": "tap", "writer": None, "strokes": dot},
        {"label": "arrow", "writer": "x", "strokes": dot * 2},
        {"label": "star", "writer": "x", "strokes": dot},
        {"label": "star", "writer": "x", "strokes": dot},
        {"label": None, "writer": "x", "strokes": dot},
    ]
    path = tmp_path / "rows.jsonl.gz"
    with gzip.open(path, "wt") as file:
        file.writelines(json.dumps(row) + "\n" for row in rows)
    suite = strokes_from_files([path])
    assert (suite.rows, suite.labels, suite.single) == (5, ("tap", "arrow"), (True, False))
    assert (dict(suite.unknown), suite.unlabelled) == ({"star": 2}, 1)
    assert strokes_from_files([path, path]).rows == 10


def test_a_file_whose_labels_are_all_unknown_is_reported_with_no_score(tmp_path):
    path = tmp_path / "stars.jsonl"
    path.write_text('{"label": "star", "writer": null, "strokes": [[[0, 0, null], [1, 2, null]]]}\n')
    suite = strokes_from_files([path])
    summary = stroke_summary(suite, stroke_contest(suite, ("paper",)))
    assert summary["scored"] == 0
    assert summary["recognizers"]["paper"]["accuracy"] is None
    assert summary["recognizers"]["paper"]["unclaimable"] == {"star": 1}


def test_files_without_any_label_are_refused(tmp_path):
    path = tmp_path / "bare.jsonl"
    path.write_text('{"label": null, "writer": null, "strokes": [[[0, 0, null]]]}\n')
    with pytest.raises(FileError, match="label"):
        strokes_from_files([path])


def test_the_best_of_a_column_is_what_looks_best():
    assert [cell.best for cell in column([0.991, 0.9912, 0.5, None], 1, 100)] == [True, True, False, False]
    assert [cell.best for cell in column([2.0, 1.0], 1, low=True)] == [False, True]
    assert not any(cell.best for cell in column([1.0, 1.0], 1))
