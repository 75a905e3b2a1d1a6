"""Generated strokes as arrays of features: what the net is trained and calibrated on.

No human ink comes in here. Rows are made in shards, each from its own stretch of stroke indices,
so that the same (seed, count) gives the same arrays whatever the number of processes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np
from joblib import Parallel, delayed
from numpy.typing import NDArray

from data_gen.strokes import MIX, LabelledStroke, formula_strokes, generate
from recognizer.learned.features import GLOBAL_FEATURES, PAGE_FEATURES, of_strokes, standing
from sketch.page import STROKE_KINDS, StrokeKind

Float32 = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class CorpusRule:
    """Shares of the corpus and how strokes stand on the pages they are imagined on."""

    shard: int = 4096
    """Strokes made at a time by one process: seconds of work, 13 MB of features."""
    formula: float = 0.10
    """Share of strokes that stand inside formulas, where bars and rings are mathematics."""
    company: float = 0.5
    """Share of the other strokes that are imagined among others; the rest stand alone."""
    resting: float = 0.5
    """A tap with more different points than this (of `few_points`) trembles: its size alone tells it."""
    lasso_alone: float = 0.15
    """The same for lassos standing alone: with nothing inside it, a lasso is a badly drawn circle."""


CORPUS_RULE = CorpusRule()

RELATIVE_SIZE: dict[StrokeKind, tuple[float, float]] = {
    "circle": (0.05, 1.0),
    "polygon": (0.06, 1.0),
    "spring": (0.06, 1.0),
    "wire": (0.05, 1.0),
    "arrow": (0.05, 1.0),
    "tap": (0.0005, 0.009),
    "scribble": (0.04, 1.0),
    "lasso": (0.08, 1.0),
    "math": (0.01, 0.6),
}
"""Log-uniform range of a stroke's size against its page's, by kind: rough on purpose."""

FORMULA_SIZE = (0.005, 0.05)
"""The same for strokes inside formulas: letters 2 to 4 % of a page, their bars and dots less."""


@dataclass(frozen=True, slots=True, eq=False)
class Corpus:
    """sequence (B, 12, 64), whole (B, 26) float32 features; kind (B,) indices into `STROKE_KINDS`."""

    sequence: Float32
    whole: Float32
    kind: NDArray[np.int64]


def make_corpus(
    count: int, seed: int, jobs: int, progress: Callable[[int], None] = lambda _done: None
) -> Corpus:
    """`count` generated strokes as features; `progress` is told the strokes done so far."""
    firsts = list(range(0, count, CORPUS_RULE.shard))
    tasks = (delayed(_shard)(seed, first, min(CORPUS_RULE.shard, count - first)) for first in firsts)
    parts: list[Corpus] = []
    done = 0
    made = cast("Iterable[Corpus]", Parallel(n_jobs=jobs, return_as="generator")(tasks))
    for part in made:
        parts.append(part)
        done += len(part.kind)
        progress(done)
    return _joined(parts)


def _shard(seed: int, first: int, count: int) -> Corpus:
    in_formulas = round(count * CORPUS_RULE.formula)
    made = generate(count - in_formulas, seed, first, MIX)
    inside = formula_strokes(in_formulas, seed + 1, first)
    rng = np.random.default_rng([seed, first, 7])
    strokes = made + inside
    sequence, overall = of_strokes([item.stroke.points for item in strokes])
    trembling = overall[: len(made), GLOBAL_FEATURES.index("different points (few)")] > CORPUS_RULE.resting
    page = np.concatenate([_imagined_page(made, trembling, rng), _imagined_formula(len(inside), rng)])
    return Corpus(
        sequence.astype(np.float32),
        np.concatenate([overall, page], axis=1).astype(np.float32),
        np.array([STROKE_KINDS.index(item.kind) for item in strokes]),
    )


def _imagined_page(
    strokes: Sequence[LabelledStroke], trembling: NDArray[np.bool_], rng: np.random.Generator
) -> NDArray[np.float64]:
    """Page features as if each stroke stood on some page, or alone: (n, 4). Trembling taps stand on pages
    only: alone, a tremble that fills the eye is a drawing."""
    found = np.zeros((len(strokes), len(PAGE_FEATURES)))
    for row, item, many in zip(found, strokes, trembling.tolist(), strict=True):
        u = rng.random(4)
        alone = CORPUS_RULE.lasso_alone if item.kind == "lasso" else 1 - CORPUS_RULE.company
        if item.kind == "tap" and many:
            alone = 0.0
        if u[0] < alone:
            continue
        low, high = RELATIVE_SIZE[item.kind]
        inside = 0.0
        if item.kind == "lasso":
            inside = 0.03 + 0.9 * u[2]
        elif item.kind in ("circle", "polygon") and u[3] < 0.6:
            # Taps lie inside, and a neighbour's centre may lie inside the bounding box.
            inside = 0.4 * u[2] ** 2
        row[:] = standing(np.array([low * (high / low) ** u[1]]), np.array([inside]))[0]
    return found


def _imagined_formula(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    low, high = FORMULA_SIZE
    return standing(low * (high / low) ** rng.random(count), np.zeros(count))


def _joined(parts: Sequence[Corpus]) -> Corpus:
    return Corpus(
        np.concatenate([part.sequence for part in parts]),
        np.concatenate([part.whole for part in parts]),
        np.concatenate([part.kind for part in parts]),
    )
