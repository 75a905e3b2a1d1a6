"""Pages of a corpus as padded tensors: pages of like length stand together, so that little is padding."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from training.dataset import Corpus
from training.features import Features, backwards
from training.nets import PageNet
from training.relations import Relations, own_frame, page_frame

LENGTHS = (1, 2, 4, 8, 16, 32, 64)
"""Pages are padded up to the next of these numbers of strokes."""


@dataclass(frozen=True, slots=True)
class Pages:
    """Pages padded to N strokes: there (P, N) bool, rows (P, N) which stroke of the corpus; the rest as in `Corpus`,
    (P, N, …)."""

    there: Tensor
    rows: Tensor
    paths: Tensor
    span: Tensor
    timed: Tensor
    kind: Tensor
    thing: Tensor


@dataclass(frozen=True, slots=True)
class Answers:
    """What the net says of padded pages, as `PageNet` returns it, and what is asked, as in `Pages`."""

    kinds: Tensor
    strange: Tensor
    together: Tensor
    company: Tensor
    pages: Pages


def batches(corpus: Corpus, steps: int, rng: np.random.Generator | None) -> Iterator[list[Pages]]:
    """The whole corpus in `steps` batches, each with its share of the pages of every length; in the corpus's
    order where `rng` is None."""
    sizes = corpus.sizes
    groups: list[list[NDArray[np.int64]]] = []
    for shorter, longest in zip((0, *LENGTHS), LENGTHS, strict=False):
        chosen = np.flatnonzero((sizes > shorter) & (sizes <= longest))
        if rng is not None:
            chosen = rng.permutation(chosen)
        groups.append(np.array_split(chosen, steps))
    for step in range(steps):
        yield [
            _padded(corpus, group[step], longest)
            for group, longest in zip(groups, LENGTHS, strict=True)
            if len(group[step])
        ]


@dataclass(frozen=True, slots=True)
class Looked:
    """The features of all strokes of a corpus: sequence (S, 15, 64) float16 to save memory, whole (S, 19)."""

    sequence: Tensor
    whole: Tensor


def look(corpus: Corpus, chunk: int = 4096) -> Looked:
    """Features of a corpus: they stay the same through training."""
    features = Features()
    sequences: list[Tensor] = []
    wholes: list[Tensor] = []
    with torch.no_grad():
        for first in range(0, len(corpus.kind), chunk):
            paths = torch.from_numpy(corpus.paths[first : first + chunk])
            sequence, whole = features(
                own_frame(paths), torch.from_numpy(corpus.distinct[first : first + chunk])
            )
            sequences.append(sequence.half())
            wholes.append(whole)
    return Looked(torch.cat(sequences), torch.cat(wholes))


def answers(
    net: PageNet,
    looked: Looked,
    relations: Relations,
    batch: list[Pages],
    flips: np.random.Generator | None = None,
) -> list[Answers]:
    """Runs the net: all strokes of the batch are encoded together, then each length of page is read. With
    `flips` each stroke is looked at in one drawing sense only, drawn at random."""
    rows = torch.cat([pages.rows[pages.there] for pages in batch])
    sequence, whole = looked.sequence[rows].float(), looked.whole[rows]
    if flips is None:
        encoded = net.encoder(sequence, whole)
    else:
        back = torch.from_numpy(flips.random(len(rows)) < 0.5)
        sequence[back] = backwards(sequence[back])
        encoded = net.encoder.in_one_sense(sequence, whole)
    found: list[Answers] = []
    at = 0
    for pages in batch:
        count, longest = pages.there.shape
        strokes = int(pages.there.sum())
        flat = torch.zeros(count * longest, encoded.shape[1])
        flat = flat.index_put((torch.nonzero(pages.there.flatten())[:, 0],), encoded[at : at + strokes])
        at += strokes
        with torch.no_grad():
            same = pages.there[:, :, None] & pages.there[:, None]
            on_page, standing = page_frame(pages.paths, same)
            between = relations(on_page, pages.span, pages.timed)
            company = same.float() * (1.0 - torch.eye(longest))
        kinds, strange, together = net(flat.reshape(count, longest, -1), standing, between, company)
        found.append(Answers(kinds, strange, together, company, pages))
    return found


def _padded(corpus: Corpus, chosen: NDArray[np.int64], longest: int) -> Pages:
    sizes = corpus.sizes[chosen]
    there = np.arange(longest) < sizes[:, None]
    rows = np.where(there, corpus.first[chosen][:, None] + np.arange(longest), corpus.first[chosen][:, None])

    def pick(values: NDArray[np.generic]) -> Tensor:
        return torch.from_numpy(values[rows])

    return Pages(
        torch.from_numpy(there),
        torch.from_numpy(rows),
        pick(corpus.paths),
        pick(corpus.span),
        pick(corpus.timed),
        pick(corpus.kind),
        pick(corpus.thing),
    )
