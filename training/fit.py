"""Fitting the net, reproducibly: the same seed, corpus, and numbers of threads and processes give the same weights to the bit,
also where training was stopped after an epoch and taken up again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn
from torch.nn.parallel import DistributedDataParallel

from training.batches import Answers, Pages, answers, batches, look
from training.dataset import Corpus
from training.drawings import NONE, UNASKED
from training.nets import SIZE, NetSize, PageNet
from training.processes import ALONE, Processes
from training.relations import Relations


@dataclass(frozen=True, slots=True)
class FitRule:
    """How the net is trained."""

    epochs: int = 4
    both: int = 1
    """Of these the last ones in which strokes are looked at in both drawing senses, as the finished net does."""
    batch: int = 512
    """Strokes in a batch, on average, of all processes together."""
    rate: float = 4e-3
    """Peak of a one-cycle learning rate (Smith 2018), AdamW."""
    decay: float = 1e-2
    smoothing: float = 0.01
    """Label smoothing: some drawings of one kind are another kind by anybody's eye."""
    strange: float = 0.5
    """Weight of telling strokes that are none of the kinds from the others,"""
    unsure: float = 0.1
    """of being sure of no kind where there is none (outlier exposure; Hendrycks, Mazeika and Dietterich 2019),"""
    together: float = 0.3
    """and of telling which strokes are one thing, against the weight of the kinds, 1."""
    clip: float = 5.0
    """Longest gradient."""


RULE = FitRule()
OWN = 1_000_003
"""Between the seeds of two processes' chance."""


class Asked(nn.Module):
    """The net with a corpus before it: a batch of its pages -> the loss of the answers."""

    def __init__(self, net: PageNet, corpus: Corpus, rule: FitRule) -> None:
        super().__init__()
        self.net, self.rule = net, rule
        self.looked, self.relations = look(corpus), Relations()

    def forward(self, batch: list[Pages], flips: np.random.Generator | None) -> Tensor:
        return loss_of(answers(self.net, self.looked, self.relations, batch, flips), self.rule)


def fit(
    corpus: Corpus,
    seed: int,
    rule: FitRule = RULE,
    size: NetSize = SIZE,
    progress: Callable[[float, float], None] = lambda _share, _loss: None,
    checkpoint: Path | None = None,
    until: int | None = None,
    among: Processes = ALONE,
) -> PageNet:
    """Trains on the corpus. `progress` is told the share done and the running loss.

    checkpoint: where the state is kept after every epoch, and taken up from if it is there; until: the
    number of epochs after which to stop, to be gone on with from the checkpoint; among: the processes that train together, each on a corpus of its own: all
    return the same weights.
    """
    torch.manual_seed(seed)
    torch.use_deterministic_algorithms(True)
    net = PageNet(size)
    asked: nn.Module = Asked(net, corpus, rule)
    if among.count > 1:
        asked = DistributedDataParallel(asked, find_unused_parameters=True)
    steps = max(1, among.total(len(corpus.kind)) // rule.batch)
    optimizer = torch.optim.AdamW(net.parameters(), lr=rule.rate, weight_decay=rule.decay)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimizer, max_lr=rule.rate, total_steps=steps * rule.epochs, pct_start=0.2
    )
    begun, running = 0, float(np.log(9))
    kept = checkpoint is not None and among.leads and checkpoint.exists()
    state = among.told(torch.load(checkpoint, weights_only=True) if kept and checkpoint else None)
    if state is not None:
        net.load_state_dict(state["net"])
        optimizer.load_state_dict(state["optimizer"])
        schedule.load_state_dict(state["schedule"])
        begun, running = int(state["epochs"]), float(state["running"])
    net.train()
    for epoch in range(begun, min(until or rule.epochs, rule.epochs)):
        torch.manual_seed(seed * 1_000 + epoch + 1 + OWN * among.rank)
        own = [epoch, among.rank] if among.rank else [epoch]
        order = np.random.default_rng([seed, 1, *own])
        flips = np.random.default_rng([seed, 2, *own]) if epoch < rule.epochs - rule.both else None
        for step, batch in enumerate(batches(corpus, steps, order)):
            optimizer.zero_grad(set_to_none=True)
            loss: Tensor = asked(batch, flips)
            loss.backward()
            nn.utils.clip_grad_norm_(net.parameters(), rule.clip)
            optimizer.step()
            schedule.step()
            running += 0.02 * (float(loss.detach()) - running)
            progress((epoch + (step + 1) / steps) / rule.epochs, running)
        if checkpoint is not None and among.leads:
            _keep(checkpoint, net, optimizer, schedule, epoch + 1, running)
    return net.eval()


def loss_of(found: list[Answers], rule: FitRule) -> Tensor:
    """Cross entropy of the kinds, of being none of them, and of which strokes are one thing, each over all that
    is asked."""
    kinds = torch.cat([one.kinds[_known(one)] for one in found])
    kind = torch.cat([one.pages.kind[_known(one)] for one in found])
    strange = torch.cat([one.strange[one.pages.there & (one.pages.kind != UNASKED)] for one in found])
    none = torch.cat([one.pages.kind[one.pages.there & (one.pages.kind != UNASKED)] == NONE for one in found])
    loss = nn.functional.cross_entropy(kinds, kind, label_smoothing=rule.smoothing)
    loss = loss + rule.strange * nn.functional.binary_cross_entropy_with_logits(strange, none.float())
    odd = [one.kinds[one.pages.there & (one.pages.kind == NONE)] for one in found]
    if any(len(logits) for logits in odd):
        loss = loss - rule.unsure * nn.functional.log_softmax(torch.cat(odd), dim=1).mean()
    paired = [_pairs(one) for one in found if one.kinds.shape[1] > 1]
    if any(len(truth) for _, truth in paired):
        logits, truths = (torch.cat(parts) for parts in zip(*paired, strict=True))
        loss = loss + rule.together * nn.functional.binary_cross_entropy_with_logits(logits, truths)
    return loss


def _known(one: Answers) -> Tensor:
    return one.pages.there & (one.pages.kind >= 0)


def _pairs(one: Answers) -> tuple[Tensor, Tensor]:
    """Logits and truth of the pairs of which it is known whether they are one thing."""
    thing = one.pages.thing
    asked = (one.company > 0) & (thing[:, :, None] != NONE) & (thing[:, None] != NONE)
    return one.together[asked], (thing[:, :, None] == thing[:, None])[asked].float()


@dataclass(frozen=True, slots=True, eq=False)
class Said:
    """The net's answers to a whole corpus, stroke by stroke in the corpus's order: logits (S, 9), strange (S,)
    logits, alone (S,): the stroke is its page's only one; for pairs that are asked: together logits and truth."""

    logits: np.ndarray[tuple[int, int], np.dtype[np.float32]]
    strange: np.ndarray[tuple[int], np.dtype[np.float32]]
    kind: np.ndarray[tuple[int], np.dtype[np.int64]]
    alone: np.ndarray[tuple[int], np.dtype[np.bool_]]
    together: np.ndarray[tuple[int], np.dtype[np.float32]]
    paired: np.ndarray[tuple[int], np.dtype[np.float32]]


def say(net: PageNet, corpus: Corpus) -> Said:
    """The net's answers to all of a corpus, by length of page."""
    looked, relations = look(corpus), Relations()
    parts: list[Answers] = []
    with torch.no_grad():
        for batch in batches(corpus, max(1, len(corpus.kind) // 2048), None):
            parts += answers(net, looked, relations, batch)
    there = [one.pages.there for one in parts]
    pairs = [_pairs(one) for one in parts if one.kinds.shape[1] > 1]
    order = torch.argsort(torch.cat([one.pages.rows[t] for one, t in zip(parts, there, strict=True)]))
    logits = torch.cat([one.kinds[t] for one, t in zip(parts, there, strict=True)])
    strange = torch.cat([one.strange[t] for one, t in zip(parts, there, strict=True)])
    return Said(
        logits[order].numpy(),
        strange[order].numpy(),
        corpus.kind,
        np.repeat(corpus.sizes == 1, corpus.sizes),
        torch.cat([said for said, _ in pairs] or [torch.zeros(0)]).numpy(),
        torch.cat([truth for _, truth in pairs] or [torch.zeros(0)]).numpy(),
    )


def _keep(
    file: Path,
    net: PageNet,
    optimizer: torch.optim.Optimizer,
    schedule: torch.optim.lr_scheduler.LRScheduler,
    epochs: int,
    running: float,
) -> None:
    """Writes the state beside its place first: a stop in the middle leaves the last whole one."""
    fresh = file.with_suffix(".new")
    torch.save(
        {
            "net": net.state_dict(),
            "optimizer": optimizer.state_dict(),
            "schedule": schedule.state_dict(),
            "epochs": epochs,
            "running": running,
        },
        fresh,
    )
    fresh.replace(file)
