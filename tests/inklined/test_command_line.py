"""The command as a person meets it: a process, its exit code, its two streams."""

from __future__ import annotations

import contextlib
import gzip
import io
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from inklined.cli import run


@contextlib.contextmanager
def environment(**settings: str) -> Iterator[None]:
    """The process's environment with these settings, as it was again afterwards."""
    before = dict(os.environ)
    os.environ.update(settings)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


def inklined(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    """The command within this process: as in its own, but for the seconds that a process costs."""
    out, err = io.StringIO(), io.StringIO()
    words = [str(argument) for argument in arguments]
    with (
        contextlib.chdir(cwd),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
        environment(COLUMNS="120", NO_COLOR="1", INKLINED_DEBUG=""),
    ):
        code = run(words)
    finished = subprocess.CompletedProcess(words, code, out.getvalue(), err.getvalue())
    assert "Traceback" not in finished.stdout + finished.stderr
    return finished


def process(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    """The command as a process of its own."""
    environment = {**os.environ, "COLUMNS": "120", "NO_COLOR": "1"}
    environment.pop("INKLINED_DEBUG", None)
    finished = subprocess.run(
        [sys.executable, "-c", "from inklined.cli import main; main()", *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=cwd,
        env=environment,
        timeout=120,
        check=False,
    )
    assert "Traceback" not in finished.stdout + finished.stderr
    return finished


def refusal(finished: subprocess.CompletedProcess[str], code: int) -> str:
    """The one line that a refused command says."""
    assert finished.returncode == code, finished.stderr
    lines = finished.stderr.strip().splitlines()
    assert len(lines) == 1, finished.stderr
    assert lines[0].startswith("inklined: ")
    return lines[0]


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a page of each diagram."""
    folder = tmp_path_factory.mktemp("pages")
    made = inklined("generate", "pages", folder, "--count", 6, "--seed", 5, cwd=folder)
    assert made.returncode == 0, made.stderr
    assert len(list(folder.glob("*.inklined"))) == 6
    return folder


@pytest.mark.parametrize(
    "command",
    ["", "compare", "analyze", "simulate", "generate", "generate strokes", "generate pages", "train"],
)
def test_help_of_every_command_ends_with_an_example_that_names_it(command, tmp_path):
    shown = inklined(*command.split(), "--help", cwd=tmp_path)
    assert shown.returncode == 0
    words = " ".join(shown.stdout.split())
    assert re.search(rf"Example: inklined {command}", words), shown.stdout


def test_generated_strokes_are_labelled_json_lines_of_the_kinds_asked_for(tmp_path):
    made = inklined("generate", "strokes", "a.jsonl.gz", "--count", 20, "--kind", "wire", cwd=tmp_path)
    assert made.returncode == 0, made.stderr
    with gzip.open(tmp_path / "a.jsonl.gz", "rt") as lines:
        rows = [json.loads(line) for line in lines]
    assert [row["label"] for row in rows] == ["wire"] * 20
    assert all(len(row["strokes"]) == 1 for row in rows)


def test_the_same_seed_gives_the_same_file(tmp_path):
    for name in ("a.jsonl", "b.jsonl"):
        assert inklined("generate", "strokes", name, "--count", 5, "--seed", 9, cwd=tmp_path).returncode == 0
    assert (tmp_path / "a.jsonl").read_bytes() == (tmp_path / "b.jsonl").read_bytes()


def test_compare_on_a_file_writes_the_figures_in_the_agreed_form(tmp_path):
    inklined("generate", "strokes", "a.jsonl", "--count", 60, "--seed", 3, cwd=tmp_path)
    with (tmp_path / "a.jsonl").open("a") as file:
        file.write('{"label": "star", "writer": null, "strokes": [[[0, 0, null], [5, 5, null]]]}\n')
    ran = inklined(
        *("compare", "--ink", "a.jsonl", "--recognizer", "paper", "geometric", "--json", "out.json"),
        cwd=tmp_path,
    )
    assert ran.returncode == 0, ran.stderr
    figures = json.loads((tmp_path / "out.json").read_text())
    assert figures["suite"] == "a.jsonl"
    assert figures["rows"] == 61
    assert figures["unknown_labels"] == {"star": 1}
    assert list(figures["recognizers"]) == ["paper", "geometric"]
    for result in figures["recognizers"].values():
        assert {"accuracy", "balanced_accuracy", "macro_f1", "ece", "per_class", "latency_ms"} <= set(result)
        assert all(0 <= result[name] <= 1 for name in ("accuracy", "balanced_accuracy", "macro_f1", "ece"))
        assert sum(kind["n"] for kind in result["per_class"].values()) == 60
        assert all({"n", "recall", "precision"} == set(kind) for kind in result["per_class"].values())
        assert 0 < result["latency_ms"]["p50"] <= result["latency_ms"]["p95"]
        assert result["unclaimable"]["star"] == 1
    assert figures["recognizers"]["paper"]["unclaimable"]["arrow"] > 0
    assert "star (1)" in " ".join(ran.stdout.split())
    assert "paper cannot claim" in " ".join(ran.stdout.split())
    assert not (tmp_path / "report.html").exists()


def test_several_files_are_one_suite_and_a_report_is_written_where_asked(tmp_path):
    for name in ("a.jsonl", "b.jsonl"):
        inklined("generate", "strokes", name, "--count", 9, cwd=tmp_path)
    ran = inklined(
        *("compare", "--ink", "a.jsonl", "b.jsonl", "--recognizer", "paper"),
        *("--json", "o.json", "--report", "r.html"),
        cwd=tmp_path,
    )
    assert ran.returncode == 0, ran.stderr
    assert json.loads((tmp_path / "o.json").read_text())["rows"] == 18
    assert "</html>" in (tmp_path / "r.html").read_text()


def test_analyze_tells_components_and_mathematics_and_writes_what_it_is_asked_for(pages):
    page = next(iter(pages.glob("*incline*")))
    ran = inklined(
        *("analyze", page, "--recognizer", "geometric"),
        *("--svg", "page.svg", "--out", "read.inklined", "--json", "page.json"),
        cwd=pages.parent,
    )
    assert ran.returncode == 0, ran.stderr
    assert "polygon" in ran.stdout
    assert "theta" in ran.stdout
    assert (pages.parent / "page.svg").read_text().startswith(("<svg", "<?xml"))
    told = json.loads((pages.parent / "page.json").read_text())
    assert {part["kind"] for part in told["components"]} >= {"polygon"}
    again = inklined("simulate", "read.inklined", "--seconds", 0.5, cwd=pages.parent)
    assert again.returncode == 0, again.stderr


def test_analyze_as_json_prints_nothing_else(pages):
    page = next(iter(pages.glob("*pendulum*")))
    ran = inklined("analyze", page, "--recognizer", "paper", "--json", "-", cwd=pages)
    assert json.loads(ran.stdout)["recognizer"] == "paper"


def test_simulate_says_what_happens_and_draws_it(pages, tmp_path):
    page = next(iter(pages.glob("*two-balls*")))
    ran = inklined("simulate", page, "--seconds", 1, "--svg", "s.svg", "--gif", "s.gif", cwd=tmp_path)
    assert ran.returncode == 0, ran.stderr
    assert "m/s at the end" in ran.stdout
    assert (tmp_path / "s.svg").read_text().startswith("<svg")
    assert (tmp_path / "s.gif").read_bytes().startswith(b"GIF89a")


def test_simulate_judges_the_answers_on_the_page(pages, tmp_path):
    page = next(iter(pages.glob("*incline*")))
    ran = inklined("simulate", page, cwd=tmp_path)
    assert ran.returncode == 0, ran.stderr
    assert " is right: " in " ".join(ran.stdout.split())


def test_a_missing_file_is_named(tmp_path):
    for command in (["analyze"], ["simulate"], ["compare", "--ink"]):
        assert "nowhere.jsonl" in refusal(inklined(*command, "nowhere.jsonl", cwd=tmp_path), 1)


def test_a_folder_is_no_file(tmp_path):
    assert "folder" in refusal(inklined("analyze", tmp_path, cwd=tmp_path), 1)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("broken.inklined", "{ not json"),
        ("broken.inklined", '{"format": "something else"}'),
        ("broken.inkml", "<ink><trace>1 2, 3"),
        ("broken.jsonl.gz", "not gzip"),
        ("page.png", "a picture"),
    ],
)
def test_a_broken_file_is_refused_in_one_line_that_names_it(name, content, tmp_path):
    (tmp_path / name).write_text(content)
    for command in ("analyze", "simulate"):
        assert name in refusal(inklined(command, name, cwd=tmp_path), 1)


def test_a_broken_labelled_file_is_refused_in_one_line_that_names_it(tmp_path):
    (tmp_path / "broken.jsonl.gz").write_bytes(b"\x1f\x8b broken")
    finished = inklined("compare", "--ink", "broken.jsonl.gz", "--recognizer", "paper", cwd=tmp_path)
    assert "broken.jsonl.gz" in refusal(finished, 1)


def test_a_file_without_a_single_labelled_row_is_told_so(tmp_path):
    (tmp_path / "bare.jsonl").write_text('{"strokes": [[[0, 0, null], [9, 9, null]]]}\n')
    finished = inklined("compare", "--ink", "bare.jsonl", "--recognizer", "paper", cwd=tmp_path)
    assert "label" in refusal(finished, 1)


def test_an_empty_page_and_one_dot_are_read_and_stand_still(tmp_path):
    (tmp_path / "empty.jsonl").write_text('{"label": null, "strokes": []}\n')
    (tmp_path / "dot.jsonl").write_text('{"label": null, "strokes": [[[3, 4, null]]]}\n')
    read = inklined("analyze", "dot.jsonl", "--recognizer", "geometric", cwd=tmp_path)
    assert read.returncode == 0, read.stderr
    assert "1 strokes" in read.stdout or "1 stroke" in read.stdout
    still = inklined("simulate", "dot.jsonl", "--recognizer", "geometric", cwd=tmp_path)
    assert still.returncode == 0, still.stderr
    assert "Nothing on the page can move" in still.stdout


def test_an_unknown_recognizer_is_refused_with_the_names_that_are_known(tmp_path):
    (tmp_path / "dot.jsonl").write_text('{"label": "tap", "strokes": [[[3, 4, null]]]}\n')
    for command in (["compare", "--recognizer", "magic"], ["analyze", "dot.jsonl", "--recognizer", "magic"]):
        line = refusal(inklined(*command, cwd=tmp_path), 2)
        assert "magic" in line
        assert "geometric" in line


@pytest.mark.parametrize(
    "arguments",
    [
        ["compare", "--strkes", "5"],
        ["compare", "--strokes", "many"],
        ["compare", "--seed", "-1"],
        ["compare", "--strokes", "0", "--pages", "0"],
        ["simulate"],
        ["simulate", "x.inklined", "--seconds", "-2"],
        ["generate", "strokes", "x.jsonl", "--kind", "cloud"],
        ["generate", "pages", "out", "--problem", "rocket"],
        ["generate", "pages", "out", "--answer", "maybe"],
        ["dance"],
    ],
)
def test_a_wrong_command_line_is_refused_in_one_line(arguments, tmp_path):
    refusal(inklined(*arguments, cwd=tmp_path), 2)


def test_what_was_read_is_never_written_over(pages, tmp_path):
    page = tmp_path / "page.inklined"
    page.write_bytes(next(iter(pages.glob("*stack*"))).read_bytes())
    before = page.read_bytes()
    for option in ("--out", "--svg", "--json"):
        finished = inklined("analyze", page, "--recognizer", "paper", option, page, cwd=tmp_path)
        assert "what was read" in refusal(finished, 1)
    assert "what was read" in refusal(inklined("simulate", page, "--gif", page, cwd=tmp_path), 1)
    assert page.read_bytes() == before


def test_a_folder_that_is_not_there_is_told_before_the_work(tmp_path):
    assert "no/such" in refusal(inklined("compare", "--report", "no/such/report.html", cwd=tmp_path), 1)


def test_train_passes_its_arguments_on(tmp_path):
    pytest.importorskip("torch", reason="training is not installed")
    assert inklined("train", "--no-such-option", cwd=tmp_path).returncode != 0


def test_importing_inklined_is_quick():
    code = "import time; t = time.perf_counter(); import inklined; print(time.perf_counter() - t)"
    spent = min(
        float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
        for _ in range(3)
    )
    assert spent < 0.3


def test_as_a_process_it_ends_with_the_same_code_and_line(tmp_path):
    for arguments in (["analyze", "nowhere.inklined"], ["compare", "--strkes"], ["dance"]):
        alone, within = process(*arguments, cwd=tmp_path), inklined(*arguments, cwd=tmp_path)
        assert (alone.returncode, alone.stderr) == (within.returncode, within.stderr)


FAILING = """class Failing:
    name = "failing"
    claims = frozenset()

    def recognize(self, ink):
        raise {error}
"""
"""Somebody's own recognizer that cannot recognize anything."""


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        ('ZeroDivisionError("by hand")', 70, "ZeroDivisionError: by hand; INKLINED_DEBUG=1 shows where"),
        ('ValueError("of its own")', 70, "INKLINED_DEBUG=1"),
        ("KeyboardInterrupt()", 130, "interrupted"),
        ('OSError(28, "No space left on device", "page.svg")', 1, "page.svg: No space left on device"),
    ],
)
def test_whatever_fails_within_is_one_line_and_a_code(error, code, words, tmp_path):
    (tmp_path / "dot.jsonl").write_text('{"label": "tap", "strokes": [[[3, 4, null]]]}\n')
    module = f"failing_with_{error.partition('(')[0].lower()}"
    (tmp_path / f"{module}.py").write_text(FAILING.format(error=error))
    finished = inklined("analyze", "dot.jsonl", "--recognizer", f"{module}:Failing", cwd=tmp_path)
    line = refusal(finished, code)
    assert words in line


def test_problems_prints_its_table_and_writes_its_figures(tmp_path: Path) -> None:
    """Of two families, since all of them take a minute: tests/evaluation/test_textbook.py judges them all."""
    done = inklined(
        "problems",
        "--draws",
        1,
        "--family",
        "incline",
        "energy",
        "--jobs",
        1,
        "--json",
        "out.json",
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stderr
    figures = json.loads((tmp_path / "out.json").read_text())
    assert set(figures) >= {
        "problems",
        "right_judged_right",
        "wrong_judged_wrong",
        "misconception_named",
        "families",
    }
    assert list(figures["families"]) == ["incline", "energy"]
    assert figures["problems"] == sum(family["problems"] for family in figures["families"].values())
    assert figures["right_judged_right"] == figures["wrong_judged_wrong"] == 1.0
    assert "misconception" in done.stdout
    nothing = inklined("problems", "--draws", 0, cwd=tmp_path)
    assert "leaves nothing to judge" in refusal(nothing, 2)
    unknown = inklined("problems", "--family", "optics", cwd=tmp_path)
    assert "there is no such name; known are projectile, incline" in refusal(unknown, 2)


def test_observe_writes_a_table_that_can_be_read_back(pages: Path, tmp_path: Path) -> None:
    page = next(pages.glob("*pendulum*.inklined"))
    done = inklined(
        "observe", page, "--body", "C", "--quantity", "velocity", "speed", "--csv", "c.csv", "--svg", "c.svg",
        "--parquet", "c.parquet", cwd=tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    head, *rows = (tmp_path / "c.csv").read_text().splitlines()
    assert head.startswith('"t (s)","velocity x of C (m/s)"')
    assert len(rows) == 121
    assert (tmp_path / "c.svg").read_text().startswith("<?xml")
    assert (tmp_path / "c.parquet").read_bytes()[:4] == b"PAR1"
    wrong = inklined("observe", page, "--body", "Z", cwd=tmp_path)
    assert "'Z' is nothing that can move here; C can" in refusal(wrong, 1)


# Rivals that learn ------------------------------------------------------------------------------


def test_every_recognizer_is_listed_with_what_it_is_and_whose(tmp_path):
    from recognizer.published import PUBLISHED
    from recognizer.roster import ROSTER

    told = json.loads(inklined("recognizers", "--json", cwd=tmp_path).stdout)
    assert [one["name"] for one in told] == [*ROSTER, *PUBLISHED]
    listed = inklined("recognizers", cwd=tmp_path).stdout
    for one in told:
        assert one["summary"] and one["source"] and one["learns_from"]
        assert one["name"] in listed and one["summary"] in listed


def test_published_rivals_learn_from_peoples_rows_and_their_writers_are_not_tested(tmp_path):
    drawn = inklined("generate", "strokes", "ink.jsonl", "--count", 160, "--seed", 3, cwd=tmp_path)
    assert drawn.returncode == 0
    lines = (tmp_path / "ink.jsonl").read_text().splitlines()
    rows = [{**json.loads(line), "writer": f"w{number % 16}"} for number, line in enumerate(lines)]
    (tmp_path / "ink.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
    with environment(INKLINED_CACHE=str(tmp_path / "cache")):
        finished = inklined(
            *("compare", "--ink", "ink.jsonl", "--train", "ink.jsonl", "--templates", 2, "--jobs", 1),
            *("--recognizer", "paper", "penny-pincher", "rubine", "--json", "out.json"),
            cwd=tmp_path,
        )
    assert finished.returncode == 0, finished.stderr
    figures = json.loads((tmp_path / "out.json").read_text())
    assert list(figures["recognizers"]) == ["paper", "penny-pincher", "rubine"]
    left_out = int(re.match(r"(\d+) rows are left out", figures["notices"][0])[1])
    assert left_out % 10 == 0  # ten rows a writer
    assert figures["rows"] == 160 - left_out > 0


def test_who_learns_must_be_named_and_be_able_to(tmp_path):
    (tmp_path / "stars.jsonl").write_text('{"label": "star", "strokes": [[[0, 0, null], [9, 9, null]]]}\n')
    nobody = inklined("compare", "--train", "stars.jsonl", "--recognizer", "paper", cwd=tmp_path)
    assert "--train teaches the published rivals" in refusal(nobody, 2)
    nothing = inklined("compare", "--train", "stars.jsonl", "--recognizer", "dollar-p", cwd=tmp_path)
    assert "no row to learn from: labels are star" in refusal(nothing, 1)
    gone = inklined("compare", "--train", "gone.jsonl", "--recognizer", "dollar-p", cwd=tmp_path)
    assert "gone.jsonl" in refusal(gone, 1)
