"""Training by two processes over gloo, started by torchrun: one net, fitted as one process would that averages both gradients."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import torch
import training_rank as rank
from torch import nn

from recognizer.learned.recognizer import Learned
from sketch.ink import Ink, Stroke
from training.batches import answers, batches, look
from training.dataset import Corpus, joined, make_corpus
from training.fit import loss_of
from training.nets import PageNet
from training.relations import Relations

TORCHRUN = (sys.executable, "-m", "torch.distributed.run", "--standalone", "--nproc-per-node", "2")
SCRIPT = Path(rank.__file__)


def torchrun(*words: object) -> None:
    """Two processes; fails with what they said."""
    path = os.pathsep.join([str(Path.cwd()), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [*TORCHRUN, *map(str, words)],
        capture_output=True,
        text=True,
        timeout=300,
        env={**os.environ, "PYTHONPATH": path},
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]


@pytest.fixture(scope="module")
def fitted(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, dict[str, torch.Tensor]]]:
    """What each of the two has after training."""
    folder = tmp_path_factory.mktemp("two")
    torchrun(SCRIPT, folder)
    return [torch.load(folder / f"{k}.pt", weights_only=True) for k in (0, 1)]


@pytest.fixture(scope="module")
def parts() -> list[Corpus]:
    return [make_corpus(rank.PLAN, rank.SEED, 1, shard=rank.SHARD, rank=k, of=2) for k in (0, 1)]


def test_the_parts_of_two_processes_are_the_corpus_of_one(parts: list[Corpus]) -> None:
    whole = make_corpus(rank.PLAN, rank.SEED, 1, shard=rank.SHARD)
    assert all(0.3 < len(part.kind) / len(whole.kind) < 0.7 for part in parts)
    both = joined(parts)
    assert sorted(map(bytes, both.paths)) == sorted(map(bytes, whole.paths))


def test_both_have_the_same_weights_to_the_bit(fitted: list[dict[str, dict[str, torch.Tensor]]]) -> None:
    first, second = (each["net"] for each in fitted)
    for name in dict(PageNet(rank.SIZE).named_parameters()):
        assert torch.equal(first[name], second[name]), name
    assert fitted[0]["total"] == fitted[1]["total"] == sum(each["strokes"] for each in fitted)


def test_they_are_those_of_one_process_that_averages_the_gradients_of_both_parts(
    fitted: list[dict[str, dict[str, torch.Tensor]]], parts: list[Corpus]
) -> None:
    rule = rank.RULE
    torch.manual_seed(rank.SEED)
    net = PageNet(rank.SIZE).train()
    untrained = {name: value.detach().clone() for name, value in net.named_parameters()}
    steps = sum(len(part.kind) for part in parts) // rule.batch
    optimizer = torch.optim.AdamW(net.parameters(), lr=rule.rate, weight_decay=rule.decay)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimizer, max_lr=rule.rate, total_steps=steps * rule.epochs, pct_start=0.2
    )
    looked, relations = [look(part) for part in parts], Relations()
    for epoch in range(rule.epochs):
        own = ([epoch], [epoch, 1])
        order = [batches(part, steps, np.random.default_rng([rank.SEED, 1, *key])) for part, key in zip(parts, own, strict=True)]  # fmt: skip
        flips = [np.random.default_rng([rank.SEED, 2, *key]) if epoch < rule.epochs - rule.both else None for key in own]  # fmt: skip
        for both in zip(*order, strict=True):
            optimizer.zero_grad(set_to_none=True)
            for k, batch in enumerate(both):
                (loss_of(answers(net, looked[k], relations, batch, flips[k]), rule) / 2).backward()
            nn.utils.clip_grad_norm_(net.parameters(), rule.clip)
            optimizer.step()
            schedule.step()
    for name, value in net.named_parameters():
        assert torch.allclose(value, fitted[0]["net"][name], atol=2e-5), name
        if name.startswith("encoder.convolutions") and value.ndim > 1:
            assert not torch.allclose(value, untrained[name], atol=1e-3), name


def test_a_training_of_two_that_was_stopped_is_taken_up_and_ends_in_the_same_weights(
    fitted: list[dict[str, dict[str, torch.Tensor]]], tmp_path: Path
) -> None:
    torchrun(SCRIPT, tmp_path, 1)
    torchrun(SCRIPT, tmp_path)
    resumed = torch.load(tmp_path / "1.pt", weights_only=True)["net"]
    for name in dict(PageNet(rank.SIZE).named_parameters()):
        assert torch.equal(resumed[name], fitted[1]["net"][name]), name


def test_torchrun_trains_calibrates_and_exports_one_net(tmp_path: Path) -> None:
    file = tmp_path / "mine.onnx"
    words = ["--drawings", 300, "--epochs", 1, "--threads", 1, "--out", file, "--work", tmp_path / "work"]
    torchrun("-m", "training", *words)
    card = json.loads(file.with_suffix(".json").read_text("utf-8"))
    assert card["processes"] == 2 and card["parity_with_torch"] < 1e-4
    (claim,) = Learned(file).recognize(Ink((Stroke([(0, 0), (50, 2), (100, 0)]),)))
    assert claim.scores.sum() == pytest.approx(1)
