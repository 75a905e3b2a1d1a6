"""Fitting the stroke net, reproducibly: the same seed, corpus and thread count give the same weights."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import torch
from torch import nn

from training.dataset import Corpus
from training.nets import StrokeNet


@dataclass(frozen=True, slots=True)
class FitRule:
    """How the net is trained."""

    epochs: int = 8
    batch: int = 512
    rate: float = 4e-3
    """Peak of a one-cycle learning rate (Smith 2018), AdamW."""
    decay: float = 1e-2
    smoothing: float = 0.01
    """Label smoothing: some drawings of one kind are another kind by anybody's eye."""


RULE = FitRule()


def fit(
    corpus: Corpus,
    seed: int,
    rule: FitRule = RULE,
    progress: Callable[[float, float], None] = lambda _share, _loss: None,
) -> StrokeNet:
    """Trains on the corpus. `progress` is told the share done and the running loss."""
    torch.manual_seed(seed)
    torch.use_deterministic_algorithms(True)
    net = StrokeNet()
    sequence = torch.from_numpy(corpus.sequence)
    whole = torch.from_numpy(corpus.whole)
    kind = torch.from_numpy(corpus.kind)
    steps = max(1, len(kind) // rule.batch)
    optimizer = torch.optim.AdamW(net.parameters(), lr=rule.rate, weight_decay=rule.decay)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimizer, max_lr=rule.rate, total_steps=steps * rule.epochs, pct_start=0.2
    )
    judge = nn.CrossEntropyLoss(label_smoothing=rule.smoothing)
    order = np.random.default_rng([seed, 1])
    running = float(np.log(9))
    net.train()
    for epoch in range(rule.epochs):
        shuffled = torch.from_numpy(order.permutation(len(kind)))
        for step in range(steps):
            rows = shuffled[step * rule.batch : (step + 1) * rule.batch]
            optimizer.zero_grad(set_to_none=True)
            loss = judge(net(sequence[rows], whole[rows]), kind[rows])
            loss.backward()
            optimizer.step()
            schedule.step()
            running += 0.02 * (float(loss.detach()) - running)
            progress((epoch + (step + 1) / steps) / rule.epochs, running)
    return net.eval()


def logits_of(net: StrokeNet, corpus: Corpus) -> np.ndarray[tuple[int, int], np.dtype[np.float32]]:
    """The net's answers to a whole corpus, (B, 9)."""
    with torch.no_grad():
        parts = [
            net(torch.from_numpy(corpus.sequence[a : a + 4096]), torch.from_numpy(corpus.whole[a : a + 4096]))
            for a in range(0, len(corpus.kind), 4096)
        ]
    return torch.cat(parts).numpy()
