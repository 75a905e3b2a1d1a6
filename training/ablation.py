"""Which realism matters: each variation of the generator left out in turn, and what that costs on people's ink.

    python -m training.ablation --ink shapes.jsonl.gz --out benchmarks/results/ablation.txt

For every name in `data_gen.hand.names.VARIATIONS` a small net is trained on drawings made without it, all else
the same to the bit, and read on the rows given. What it loses against the net that has seen them all is
told in points of balanced accuracy over the labels, with a 95 % interval from 1,000 resamplings of the
writers, the same for both nets. A net from another seed shows what chance alone does. Lines that are
already in the log beside the table are not run again.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from rich.console import Console

from data_gen.hand.names import VARIATIONS
from data_gen.strokes import Recipe
from sketch.files import jsonl
from sketch.page import STROKE_KINDS
from training.dataset import Corpus, corpus_of, make_corpus
from training.drawings import Drawing, Plan
from training.fit import FitRule, fit, say
from training.nets import NetSize

Right = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class AblationRule:
    """Small and short: differences of a point are sought, not the last tenth."""

    drawings: int = 16_000
    epochs: int = 4
    seed: int = 71
    resamplings: int = 1_000


RULE = AblationRule()
SIZE = NetSize(width=24, stroke=48, message=16, heads=2, rounds=1)
ALL, AGAIN = "(nothing)", "(nothing, another seed)"


@dataclass(frozen=True, slots=True, eq=False)
class People:
    """Rows of people's ink: as a corpus, with each row's label and its writer's number, (R,)."""

    corpus: Corpus
    label: NDArray[np.int64]
    writer: NDArray[np.int64]


def main(arguments: list[str] | None = None) -> int:
    """Runs what the log does not hold yet, then writes the table."""
    options = _options(arguments)
    console = Console(stderr=True)
    torch.set_num_threads(options.threads)
    people = read_people(options.ink)
    log = options.out.with_suffix(".jsonl")
    log.parent.mkdir(parents=True, exist_ok=True)
    found = logged(log)
    for name in (ALL, *(options.only or (AGAIN, *VARIATIONS))):
        if name not in found:
            found[name] = right_without(name, people, options.threads)
            with log.open("a", encoding="utf-8") as lines:
                lines.write(json.dumps({"without": name, "right": found[name].astype(int).tolist()}) + "\n")
            console.print(f"without {name}: {100 * balanced(found[name], people.label):.2f} %", markup=False)
    table = "\n".join(_table(found, people, options.ink.name))
    options.out.write_text(table + "\n", "utf-8")
    sys.stdout.write(table + "\n")
    return 0


def read_people(file: Path) -> People:
    """The rows of a JSON Lines file that bear the label of a kind."""
    rows = [row for row in jsonl.read(file).rows if row.label in STROKE_KINDS and len(row.ink)]
    label = [STROKE_KINDS.index(row.label) for row in rows if row.label is not None]
    pages = [
        Drawing(row.ink.strokes, (kind,) * len(row.ink), (0,) * len(row.ink))
        for row, kind in zip(rows, label, strict=True)
    ]
    writers = {name: number for number, name in enumerate(sorted({str(row.writer) for row in rows}))}
    return People(
        corpus_of(pages, np.random.default_rng(0)),
        np.array(label),
        np.array([writers[str(row.writer)] for row in rows]),
    )


def right_without(name: str, people: People, jobs: int, rule: AblationRule = RULE) -> Right:
    """Which rows a small net reads right that was trained without the variation."""
    without = () if name in (ALL, AGAIN) else (name,)
    seed = rule.seed + (name == AGAIN)
    plan = Plan(rule.drawings, strewn=0, pages=0, doodles=0, arrows=0, signs=0, recipe=Recipe(without))
    corpus = make_corpus(plan, seed, jobs)
    net = fit(corpus, seed, FitRule(epochs=rule.epochs, both=1), SIZE)
    said = say(net, people.corpus)
    shares = torch.softmax(torch.from_numpy(said.logits), dim=1).numpy()
    rows = np.add.reduceat(shares, people.corpus.first[:-1])
    return rows.argmax(axis=1) == people.label


def balanced(right: Right, label: NDArray[np.int64], rows: NDArray[np.int64] | None = None) -> float:
    """Mean share of right rows over the labels, of some rows (with repetition) or all."""
    chosen = np.arange(len(label)) if rows is None else rows
    counts = np.bincount(label[chosen])
    hits = np.bincount(label[chosen], weights=right[chosen])
    return float((hits[counts > 0] / counts[counts > 0]).mean())


def interval(
    one: Right,
    other: Right,
    label: NDArray[np.int64],
    writer: NDArray[np.int64],
    rule: AblationRule = RULE,
) -> tuple[float, float]:
    """95 % interval of how much better `one` is than `other`, writers resampled with repetition. label, writer:
    their numbers for each row, (R,)."""
    rng = np.random.default_rng(rule.seed)
    by_writer = [np.flatnonzero(writer == k) for k in range(int(writer.max()) + 1)]
    gains: list[float] = []
    for _ in range(rule.resamplings):
        drawn = rng.integers(len(by_writer), size=len(by_writer))
        rows = np.concatenate([by_writer[k] for k in drawn.tolist()])
        gains.append(balanced(one, label, rows) - balanced(other, label, rows))
    low, high = np.quantile(gains, [0.025, 0.975])
    return float(low), float(high)


def _table(found: dict[str, Right], people: People, ink: str) -> Iterable[str]:
    writers = len(np.unique(people.writer))
    yield f"python -m training.ablation --ink {ink}"
    yield (
        f"{date.today().isoformat()}, seed {RULE.seed}; {RULE.drawings:,} drawings, {RULE.epochs} epochs, a net of width "
        f"{SIZE.width}; {len(people.label):,} rows of {writers} writers"
    )
    base = found[ALL]
    yield f"balanced accuracy with every variation: {100 * balanced(base, people.label):.1f} %"
    yield ""
    yield f"{'without':26}{'points lost':>12}   95 % interval"
    names = [name for name in found if name != ALL]
    lost = {name: balanced(base, people.label) - balanced(found[name], people.label) for name in names}
    for name in sorted(names, key=lambda name: -lost[name]):
        low, high = interval(base, found[name], people.label, people.writer)
        yield f"{name:26}{100 * lost[name]:12.1f}   {100 * low:5.1f} … {100 * high:4.1f}"


def logged(log: Path) -> dict[str, Right]:
    """Which rows each net read right, by what it was trained without."""
    if not log.exists():
        return {}
    lines: Sequence[dict[str, object]] = [json.loads(line) for line in log.read_text("utf-8").splitlines()]
    return {str(line["without"]): np.array(line["right"], dtype=bool) for line in lines}


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m training.ablation", description="Which realism matters: variations left out in turn."
    )
    parser.add_argument("--ink", type=Path, required=True, help="labelled rows of people's ink, JSON Lines")
    parser.add_argument(
        "--out", type=Path, default=Path("ablation.txt"), help="the table; the log lies beside it"
    )
    parser.add_argument(
        "--only",
        nargs="*",
        choices=(AGAIN, *VARIATIONS),
        metavar="NAME",
        help="leave out these alone, and nothing (default: each in turn)",
    )
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1)
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
