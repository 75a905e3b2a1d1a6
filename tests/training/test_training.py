"""Training end to end on a tiny corpus: reproducible, calibrated, exported without loss."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import onnx
import pytest
import torch

from recognizer.learned.recognizer import Learned
from sketch.ink import Ink, Stroke
from training.__main__ import main
from training.calibrate import temperature
from training.dataset import Corpus, make_corpus
from training.export import export, parity
from training.fit import FitRule, fit, logits_of
from training.nets import StrokeNet, parameters_of

QUICK = FitRule(epochs=2, batch=64)


@pytest.fixture(scope="module")
def corpus() -> Corpus:
    return make_corpus(600, seed=3, jobs=1)


def test_a_corpus_is_remade_from_its_seed_whatever_the_number_of_processes(corpus: Corpus) -> None:
    again = make_corpus(600, seed=3, jobs=2)
    assert np.array_equal(corpus.sequence, again.sequence)
    assert np.array_equal(corpus.whole, again.whole)
    assert np.array_equal(corpus.kind, again.kind)


def test_the_net_is_small() -> None:
    assert parameters_of(StrokeNet()) <= 150_000


def test_the_same_seed_gives_the_same_weights(corpus: Corpus) -> None:
    torch.set_num_threads(1)
    first, second = (fit(corpus, seed=5, rule=QUICK) for _ in range(2))
    for one, other in zip(first.parameters(), second.parameters(), strict=True):
        assert torch.equal(one, other)


def test_training_learns(corpus: Corpus) -> None:
    net = fit(corpus, seed=5, rule=FitRule(epochs=6, batch=64))
    accuracy = (logits_of(net, corpus).argmax(axis=1) == corpus.kind).mean()
    assert accuracy > 0.6, "nine kinds: chance is about a fifth"


def test_temperature_recovers_the_heat_that_was_put_in() -> None:
    rng = np.random.default_rng(0)
    logits = 3 * rng.standard_normal((20_000, 5))
    shares = np.exp(logits) / np.exp(logits).sum(axis=1, keepdims=True)
    kind = (shares.cumsum(axis=1) > rng.random((20_000, 1))).argmax(axis=1)
    assert temperature((2.5 * logits).astype(np.float32), kind) == pytest.approx(2.5, rel=0.05)


def test_the_onnx_file_answers_as_torch_does(corpus: Corpus, tmp_path: Path) -> None:
    net = fit(corpus, seed=5, rule=QUICK)
    file = tmp_path / "net.onnx"
    export(net, 1.3, file, {"inklined": "{}"})
    assert parity(net, 1.3, file, corpus) < 1e-5
    assert [path.name for path in tmp_path.iterdir()] == ["net.onnx"], "no sidecar"
    model = onnx.load(file)
    assert model.graph.input[0].type.tensor_type.shape.dim[0].dim_param, "the batch is dynamic"
    assert str(Path.cwd()).encode() not in file.read_bytes(), "no machine path in what ships"


def test_the_command_trains_a_net_that_the_recognizer_can_use(tmp_path: Path) -> None:
    file = tmp_path / "mine.onnx"
    assert main(["--strokes", "600", "--epochs", "2", "--threads", "1", "--out", str(file)]) == 0
    card = json.loads(file.with_suffix(".json").read_text("utf-8"))
    assert card["seed"] == 1 and card["strokes"] == 600
    (claim,) = Learned(file).recognize(Ink((Stroke([(0, 0), (50, 2), (100, 0)]),)))
    assert claim.scores.sum() == pytest.approx(1)


def test_a_senseless_number_of_strokes_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["--strokes", "0"])
    assert "at least 1" in capsys.readouterr().err
