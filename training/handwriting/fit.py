"""Fitting the net of signs, reproducibly, on shards of generated lines; stopped, it goes on after its last epoch."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from recognizer.handwriting.line import Looks, looks_of
from sketch.writing.signs import FRACTION, NUMBER
from training.handwriting.corpus import JUNK, Example
from training.handwriting.nets import SignNet


@dataclass(frozen=True, slots=True)
class SignFitRule:
    """How the net of signs is trained."""

    epochs: int = 6
    lines: int = 32
    """Lines in a batch; each has some 20 groups."""
    rate: float = 3e-3
    """Peak of a one-cycle learning rate (Smith 2018), AdamW."""
    decay: float = 1e-2
    smoothing: float = 0.02
    """Label smoothing: some signs are others by anybody's eye."""
    alone: float = 0.25
    """Share of the lines whose signs are looked at as if nothing else were on the page."""
    dots: float = 0.25
    """Share of dots and degrees that are: without its line a dot may look like any sign, and a degree is a zero."""


RULE = SignFitRule()
_DOTS = (NUMBER["."], NUMBER["\\cdot"], NUMBER["\\circ"])


def fit(
    corpus: Sequence[Example],
    seed: int,
    rule: SignFitRule = RULE,
    progress: Callable[[float, float], None] = lambda _share, _loss: None,
    checkpoint: Path | None = None,
) -> SignNet:
    """A net trained on the lines. `progress` is told the share done and the running loss."""
    torch.manual_seed(seed)
    net = SignNet()
    net.to(memory_format=torch.channels_last)  # pyright: ignore[reportCallIssue, reportArgumentType]
    steps = rule.epochs * -(-len(corpus) // rule.lines)
    optimizer = torch.optim.AdamW(net.parameters(), lr=rule.rate, weight_decay=rule.decay)
    schedule = torch.optim.lr_scheduler.OneCycleLR(
        optimizer, rule.rate, total_steps=steps + 1, pct_start=0.15
    )
    first = 0
    if checkpoint is not None and checkpoint.exists():
        kept = torch.load(checkpoint, weights_only=True)
        net.load_state_dict(kept["net"])
        optimizer.load_state_dict(kept["optimizer"])
        schedule.load_state_dict(kept["schedule"])
        first = int(kept["epoch"])
    running, done = 0.0, first * -(-len(corpus) // rule.lines)
    for epoch in range(first, rule.epochs):
        rng = np.random.default_rng([seed, epoch])
        torch.manual_seed(seed + epoch)
        net.train()
        order = rng.permutation(len(corpus))
        for begin in range(0, len(order), rule.lines):
            inputs, target = batch([corpus[k] for k in order[begin : begin + rule.lines]], rng, rule)
            loss = nn.functional.cross_entropy(net(*inputs), target, label_smoothing=rule.smoothing)
            optimizer.zero_grad(set_to_none=True)
            loss.backward()
            nn.utils.clip_grad_norm_(net.parameters(), 5.0)
            optimizer.step()
            schedule.step()
            done += 1
            running = loss.item() if done == 1 else 0.98 * running + 0.02 * loss.item()
            progress(done / steps, running)
        if checkpoint is not None:
            partial = checkpoint.with_suffix(".partial")
            torch.save(
                {
                    "net": net.state_dict(),
                    "optimizer": optimizer.state_dict(),
                    "schedule": schedule.state_dict(),
                    "epoch": epoch + 1,
                },
                partial,
            )
            partial.replace(checkpoint)
    return net.eval()


def batch(
    lines: Sequence[Example], rng: np.random.Generator, rule: SignFitRule = RULE
) -> tuple[tuple[Tensor, Tensor, Tensor], Tensor]:
    """What the net is shown of these lines, and what it should say."""
    parts: list[Looks] = []
    answers: list[int] = []
    for one in lines:
        if rng.random() < rule.alone:
            chosen = [
                (g, NUMBER["-"] if s == NUMBER[FRACTION] else s)
                for g, s in zip(one.groups, one.signs, strict=True)
                if s != JUNK and (s not in _DOTS or rng.random() < rule.dots)
            ]
            parts.append(looks_of(one.line, [group for group, _ in chosen], alone=True))
            answers += [sign for _, sign in chosen]
        else:
            parts.append(looks_of(one.line, one.groups))
            answers += one.signs
    return stacked(parts), torch.tensor(answers)


def stacked(parts: Sequence[Looks]) -> tuple[Tensor, Tensor, Tensor]:
    """The looks of several lines as one batch."""
    return (
        torch.from_numpy(np.concatenate([part.sequence for part in parts])),
        torch.from_numpy(np.concatenate([part.images for part in parts])),
        torch.from_numpy(np.concatenate([part.numbers for part in parts])),
    )
