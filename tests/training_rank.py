"""One of the processes that `torchrun` starts in `test_processes`: fits a tiny net on its part of a tiny corpus.

    torchrun --nproc-per-node 2 tests/training_rank.py FOLDER [EPOCHS]

Writes what it has to FOLDER/RANK.pt; the one of rank 0 keeps its checkpoint in FOLDER too. EPOCHS: stop after so many.
"""

from __future__ import annotations

import sys
from pathlib import Path

import torch

from training.dataset import make_corpus
from training.drawings import Plan
from training.fit import FitRule, fit
from training.nets import NetSize
from training.processes import processes

PLAN = Plan(alone=120, strewn=8, pages=3, doodles=12, arrows=6, signs=3)
RULE = FitRule(epochs=2, both=1, batch=64)
SIZE = NetSize(width=8, stroke=16, message=8, heads=2, dropout=0.0)
SEED, SHARD = 5, 20


def main(folder: Path, until: int | None) -> None:
    torch.set_num_threads(1)
    with processes() as among:
        corpus = make_corpus(PLAN, SEED, 1, shard=SHARD, rank=among.rank, of=among.count)
        file = folder / "checkpoint.pt" if among.leads else None
        net = fit(corpus, SEED, RULE, SIZE, checkpoint=file, until=until, among=among)
        told = {"net": net.state_dict(), "strokes": len(corpus.kind), "total": among.total(len(corpus.kind))}
        torch.save(told, folder / f"{among.rank}.pt")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else None)
