"""The step from raw strokes to what the net of signs is shown, exported anew and joined with the net."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import onnx
import onnxruntime
import pytest
import torch

from recognizer.handwriting.line import groups, line_of, spaced
from sketch.ink import Stroke
from training.handwriting.looks import INPUTS, OUTPUTS, Looks, looks, owner_of
from training.handwriting.raw import HERE, joined, main


def _session(model: bytes) -> onnxruntime.InferenceSession:
    return onnxruntime.InferenceSession(model, providers=["CPUExecutionProvider"])


@pytest.fixture(scope="module")
def feeds() -> dict[str, np.ndarray]:
    rng = np.random.default_rng(5)
    strokes = [
        Stroke(np.cumsum(rng.normal(0, 3, (count, 2)), axis=0) + 12.0 * k)
        for k, count in enumerate((20, 1, 2, 35, 9))
    ]
    found = groups(line_of([spaced(stroke) for stroke in strokes]))
    most = max(len(group) for group in found)
    return {
        "points": np.concatenate([stroke.points for stroke in strokes]),
        "ends": np.cumsum([len(stroke) for stroke in strokes]),
        "groups": np.array([[*group, *[-1] * (most - len(group))] for group in found]),
        "alone": rng.random(len(found)) < 0.4,
    }


@pytest.fixture(scope="module")
def fresh() -> onnx.ModelProto:
    return looks()


def test_exported_anew_it_is_what_is_shipped_and_what_torch_computes(
    fresh: onnx.ModelProto, feeds: dict[str, np.ndarray]
) -> None:
    onnx.checker.check_model(fresh, full_check=True)
    here = _session(fresh.SerializeToString()).run(list(OUTPUTS), feeds)
    there = _session((HERE / "looks.onnx").read_bytes()).run(list(OUTPUTS), feeds)
    with torch.no_grad():
        told = Looks()(*(torch.from_numpy(feeds[name]) for name in INPUTS))
    for one, other, computed in zip(here, there, told, strict=True):
        assert np.array_equal(one, other)
        assert np.abs(one - computed.numpy()).max() < 2e-6


def test_joined_with_the_net_it_answers_as_the_two_do(tmp_path: Path, feeds: dict[str, np.ndarray]) -> None:
    assert main(["--out", str(tmp_path / "one.onnx")]) == 0
    (scores,) = _session((tmp_path / "one.onnx").read_bytes()).run(None, feeds)
    seen = _session((HERE / "looks.onnx").read_bytes()).run(list(OUTPUTS), feeds)
    (wanted,) = _session((HERE / "signs.onnx").read_bytes()).run(None, dict(zip(OUTPUTS, seen, strict=True)))
    assert np.abs(np.asarray(scores) - np.asarray(wanted)).max() < 1e-4


def test_what_does_not_fit_is_not_joined(fresh: onnx.ModelProto) -> None:
    with pytest.raises(ValueError, match="it should take sequence, images, numbers"):
        joined(fresh, onnx.load(HERE / "relations.onnx"))


def test_weights_that_are_not_there_are_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["--weights", str(tmp_path), "--out", str(tmp_path / "one.onnx")])
    assert "no signs.onnx" in capsys.readouterr().err


@pytest.mark.parametrize("runs", [[3], [1, 4, 4, 6], [2, 2, 2]])
def test_every_place_belongs_to_the_run_it_lies_in(runs: list[int]) -> None:
    wanted = np.searchsorted(runs, np.arange(runs[-1]), side="right")
    assert owner_of(torch.tensor(runs), runs[-1]).tolist() == wanted.tolist()
