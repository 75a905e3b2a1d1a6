"""Drawings as arrays: what the net is trained and calibrated on.

Rows are made in shards, each from its own stretch of the plan, so that the same (plan, seed) gives the same
arrays whatever the number of processes. Strokes are cleaned and spaced by `sketch.geometry`, in doubles, as
the ONNX file does by itself; a test holds the two together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import cast

import numpy as np
from joblib import Parallel, delayed
from numpy.typing import NDArray

from sketch.geometry import distinct, resample
from training.drawings import Drawing, Plan, drawings
from training.features import POINTS

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class CorpusRule:
    """How drawings become rows."""

    shard: int = 8_000
    """Drawings made at a time by one process: seconds of work."""
    most: int = 64
    """Strokes of a page that are looked at together; of a longer one the first."""
    untimed: float = 0.5
    """Share of drawings whose times are left out: much ink comes without."""
    pace: float = 0.7
    """Standard deviation of the logarithm of how much slower or faster a page is drawn than the generator's,"""
    hesitation: float = 0.8
    """and of each pause between strokes: nobody knows how long people think."""
    mixed: float = 0.12
    """Share of pages whose strokes come in any order: drawn, erased and drawn again."""


RULE = CorpusRule()


@dataclass(frozen=True, slots=True, eq=False)
class Corpus:
    """Strokes one below the other, page by page; page k owns rows first[k] : first[k + 1].

    paths (S, 64, 2) in the page's frame (middle of its box, diagonal 1), distinct (S,) different raw points, span
    (S, 2) first and last moment, timed (S,), kind and thing (S,) as in `Drawing`, first (P + 1,)."""

    paths: Float32
    distinct: Float32
    span: Float64
    timed: Float32
    kind: NDArray[np.int64]
    thing: NDArray[np.int64]
    first: NDArray[np.int64]

    @property
    def sizes(self) -> NDArray[np.int64]:
        """Strokes of each page, (P,)."""
        return np.diff(self.first)

    def save(self, file: Path) -> None:
        np.savez(file, **{item.name: getattr(self, item.name) for item in fields(self)})

    @classmethod
    def load(cls, file: Path) -> Corpus:
        with np.load(file) as stored:
            return cls(**{item.name: stored[item.name] for item in fields(cls)})


def make_corpus(
    plan: Plan,
    seed: int,
    jobs: int,
    progress: Callable[[float], None] = lambda _share: None,
    shard: int = RULE.shard,
    rank: int = 0,
    of: int = 1,
) -> Corpus:
    """The plan's drawings as arrays; `progress` is told the share done so far. With rank `rank` of `of` processes only every
    `of`-th shard: all of them together have what one alone would, where there are as many shards as processes."""
    parts = max(of, round(plan.total / shard))
    own = range(rank, parts, of)
    tasks = (delayed(_shard)(plan, seed, part, parts) for part in own)
    made: list[Corpus] = []
    for corpus in cast("Iterable[Corpus]", Parallel(n_jobs=jobs, return_as="generator")(tasks)):
        made.append(corpus)
        progress(len(made) / len(own))
    return joined(made)


def _shard(plan: Plan, seed: int, part: int, parts: int) -> Corpus:
    return corpus_of(list(drawings(plan, seed, part, parts)), np.random.default_rng([seed, part, 17]))


def corpus_of(pages: Sequence[Drawing], rng: np.random.Generator) -> Corpus:
    """Drawings as arrays, their timing and their order loosened by `rng`."""
    return joined([_page(page, rng) for page in pages])


def _page(page: Drawing, rng: np.random.Generator) -> Corpus:
    u = rng.random(2)
    count = min(len(page.strokes), RULE.most)
    order = np.arange(count)
    known = all(stroke.times is not None for stroke in page.strokes) and u[0] >= RULE.untimed
    if count > 2 and u[1] < RULE.mixed:
        order, known = rng.permutation(count), False
    strokes = [page.strokes[k] for k in order.tolist()]
    cleaned = [distinct(stroke.points) for stroke in strokes]
    paths = np.array([resample(points, POINTS) for points in cleaned])
    low, high = paths.min(axis=(0, 1)), paths.max(axis=(0, 1))
    size = float(np.hypot(*(high - low)))
    span = np.zeros((count, 2))
    if known:
        span = _hurried(np.array([(s.times[0], s.times[-1]) for s in strokes if s.times is not None]), rng)
    return Corpus(
        ((paths - (low + high) / 2) / (size if size > 0 else 1.0)).astype(np.float32),
        np.array([len(points) for points in cleaned], dtype=np.float32),
        span,
        np.full(count, known, dtype=np.float32),
        np.array(page.kinds)[order],
        np.array(page.things)[order],
        np.array([0, count]),
    )


def _hurried(span: Float64, rng: np.random.Generator) -> Float64:
    """The same strokes at another pace, with other pauses: (n, 2)."""
    pace = np.exp(RULE.pace * rng.standard_normal())
    pauses = np.concatenate([[0.0], np.maximum(span[1:, 0] - span[:-1, 1], 0.0)])
    pauses *= pace * np.exp(RULE.hesitation * rng.standard_normal(len(span)))
    lasted = pace * (span[:, 1] - span[:, 0])
    begun = np.cumsum(pauses) + np.concatenate([[0.0], np.cumsum(lasted[:-1])])
    return np.stack([begun, begun + lasted], axis=1)


def joined(parts: Sequence[Corpus]) -> Corpus:
    """Several corpora as one."""
    offsets = np.cumsum([0, *(part.first[-1] for part in parts)])
    firsts = [part.first[:-1] + offset for part, offset in zip(parts, offsets, strict=False)]
    return Corpus(
        np.concatenate([part.paths for part in parts]),
        np.concatenate([part.distinct for part in parts]),
        np.concatenate([part.span for part in parts]),
        np.concatenate([part.timed for part in parts]),
        np.concatenate([part.kind for part in parts]),
        np.concatenate([part.thing for part in parts]),
        np.concatenate([*firsts, offsets[-1:]]),
    )
