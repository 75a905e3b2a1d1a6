"""Training by several processes, which `torchrun` starts on one machine or many; alone, all of this is nothing.

Each process makes and holds its own shards of the corpus and works on its own part of every batch; gradients are averaged over the
processes at every step (DistributedDataParallel over gloo), so that all have the same weights at all times. No files are shared:
the one of rank 0 keeps the checkpoint, calibrates and exports.
"""

from __future__ import annotations

import os
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import torch
import torch.distributed as distributed


@dataclass(frozen=True, slots=True)
class Processes:
    """rank: which of them this is, from 0; count: how many there are."""

    rank: int = 0
    count: int = 1

    @property
    def leads(self) -> bool:
        """Whether this one keeps files and speaks."""
        return self.rank == 0

    def total(self, number: int) -> int:
        """The sum of every process's number."""
        if self.count == 1:
            return number
        summed = torch.tensor(number)
        distributed.all_reduce(summed)
        return int(summed)

    def told(self, value: Any) -> Any:
        """What the one of rank 0 has, in all of them."""
        if self.count == 1:
            return value
        box = [value]
        distributed.broadcast_object_list(box, src=0)
        return box[0]


ALONE = Processes()


@contextmanager
def processes() -> Generator[Processes]:
    """Those that torchrun started, joined for as long as the block lasts; this one alone where it did not."""
    if int(os.environ.get("WORLD_SIZE", "1")) == 1:
        yield ALONE
        return
    distributed.init_process_group("gloo")
    try:
        yield Processes(distributed.get_rank(), distributed.get_world_size())
    finally:
        distributed.destroy_process_group()
