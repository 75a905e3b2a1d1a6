"""Which realism of handwriting matters: each variation left out in turn, and what that costs on people's signs.

    python -m training.handwriting.ablation --ink FOLDER --out benchmarks/results/handwriting-ablation.txt

A small net of signs is trained on lines written without the variation, all else from the same seeds, and told people's
signs where they stand in their lines (math-dev) and by themselves (symbols-dev). The table has points of
signs lost against the net that has seen every variation, twins of one shape merged, with a 95 % interval over resampled
writers. A net of another seed shows what chance alone does. What the log beside the table holds is not run again.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from rich.console import Console

from data_gen.writing.form import FormRule
from data_gen.writing.habits import TypeRule
from recognizer.handwriting.line import Group, Line, line_of, looks_of, spaced
from sketch.files import jsonl
from sketch.writing.rows import sign_named
from sketch.writing.signs import MERGED, NUMBER, SIGNS
from training.ablation import Right, balanced, interval, logged
from training.handwriting.corpus import Hand, example
from training.handwriting.fit import SignFitRule, fit, stacked
from training.handwriting.nets import SignNet


@dataclass(frozen=True, slots=True)
class SignAblationRule:
    """Small and short: differences of a point are sought, not the last tenth."""

    lines: int = 5_000
    epochs: int = 3
    seed: int = 73


RULE = SignAblationRule()
_NONE = (0.0, 0.0)
_ALL = TypeRule()


def _middle(name: str) -> tuple[float, float]:
    low, high = getattr(_ALL, name)
    return (0.5 * (low + high),) * 2


VARIATIONS: Mapping[str, Hand] = {
    "ways": Hand(TypeRule(ways=1)),
    "form": Hand(TypeRule(freedom=_NONE), FormRule(rounded=0.0, angular=0.0, hooked=0.0)),
    "order": Hand(
        TypeRule(swapped=0.0, backwards=0.0, clockwise=0.0, reversed=0.0, unlifted=0.0, delayed=0.0),
        FormRule(opened=0.0),
    ),
    "aslant": Hand(TypeRule(turn=0.0, lean=0.0, aspect=0.0, shift=0.0, bulge=0.0)),
    "baseline": Hand(TypeRule(uneven=_NONE, jump=_NONE, loose=0.0, slope=0.0, drift=0.0)),
    "proportions": Hand(
        replace(
            _ALL,
            **{
                name: _middle(name)
                for name in ("x_height", "descent", "digit", "axis", "script", "drop", "rise", "gap", "space")
            },
        )
    ),
    "pen": Hand(pen=False),
}
"""Each variation by name, as the hand that lacks it."""
ALL, AGAIN = "(nothing)", "(nothing, another seed)"


@dataclass(frozen=True, slots=True, eq=False)
class Signs:
    """People's signs: each a line, the group in it and whether it stands alone, with its sign's number and its writer's."""

    shown: tuple[tuple[Line, Group, bool], ...]
    sign: NDArray[np.int64]
    writer: NDArray[np.int64]

    @property
    def alone(self) -> NDArray[np.bool_]:
        return np.array([alone for _, _, alone in self.shown])


def main(arguments: list[str] | None = None) -> int:
    """Runs what the log does not hold yet, then writes the table."""
    options = _options(arguments)
    console = Console(stderr=True)
    torch.set_num_threads(options.threads)
    people = read_signs(options.ink)
    log = options.out.with_suffix(".jsonl")
    log.parent.mkdir(parents=True, exist_ok=True)
    found = logged(log)
    for name in (ALL, AGAIN, *VARIATIONS):
        if name not in found:
            found[name] = right_without(name, people, lambda told: console.print(told, markup=False))
            with log.open("a", encoding="utf-8") as lines:
                lines.write(json.dumps({"without": name, "right": found[name].astype(int).tolist()}) + "\n")
    table = "\n".join(_table(found, people))
    options.out.write_text(table + "\n", "utf-8")
    sys.stdout.write(table + "\n")
    return 0


def read_signs(folder: Path) -> Signs:
    """The signs of the vocabulary in math-dev (in their lines) and in symbols-dev (alone), those of CROHME 2013."""
    shown: list[tuple[Line, Group, bool]] = []
    sign: list[int] = []
    writer: list[str] = []
    for row in jsonl.read(folder / "math-dev.jsonl.gz").rows:
        if row.extra.get("set") != "crohme2013-test":
            continue
        line = line_of([spaced(stroke) for stroke in row.ink])
        for symbol in row.extra["symbols"]:
            name = sign_named(symbol["label"])
            if name in NUMBER:
                shown.append((line, tuple(sorted(symbol["strokes"])), False))
                sign.append(NUMBER[name])
                writer.append(f"m{row.writer}")
    for row in jsonl.read(folder / "symbols-dev.jsonl.gz").rows:
        name = sign_named(row.label or "")
        if row.extra.get("set") == "crohme2013" and name in NUMBER:
            line = line_of([spaced(stroke) for stroke in row.ink])
            shown.append((line, tuple(range(len(line))), True))
            sign.append(NUMBER[name])
            writer.append(f"s{row.writer}")
    names = {name: number for number, name in enumerate(sorted(set(writer)))}
    return Signs(tuple(shown), np.array(sign), np.array([names[name] for name in writer]))


def right_without(
    name: str, people: Signs, tell: Callable[[str], None], rule: SignAblationRule = RULE
) -> Right:
    """Which signs a small net tells right that was trained without the variation."""
    hand = VARIATIONS.get(name, Hand())
    seed = rule.seed + (name == AGAIN)
    corpus = [example(np.random.default_rng([seed, index]), hand=hand) for index in range(rule.lines)]
    net = fit(corpus, seed, SignFitRule(epochs=rule.epochs))
    right = told_right(net, people)
    tell(f"without {name}: {100 * right.mean():.1f} %")
    return right


@torch.inference_mode()
def told_right(net: SignNet, people: Signs, batch: int = 256) -> Right:
    """Which of the signs the net tells, twins merged."""
    merged = np.array([NUMBER[MERGED.get(name, name)] for name in SIGNS])
    found: list[NDArray[np.int64]] = []
    for start in range(0, len(people.shown), batch):
        parts = [looks_of(line, [group], alone) for line, group, alone in people.shown[start : start + batch]]
        found.append(net(*stacked(parts))[:, : len(SIGNS)].argmax(dim=1).numpy())
    return merged[np.concatenate(found)] == merged[people.sign]


def _table(found: Mapping[str, Right], people: Signs) -> Iterable[str]:
    yield "python -m training.handwriting.ablation --ink FOLDER"
    yield (
        f"{date.today().isoformat()}, seed {RULE.seed}; {RULE.lines:,} lines, {RULE.epochs} epochs; "
        f"{len(people.sign):,} signs of {len(np.unique(people.writer))} writers, twins of one shape merged"
    )
    parts = {"in their lines": ~people.alone, "alone": people.alone}
    base = found[ALL]
    for part, rows in parts.items():
        yield f"{part}: {100 * base[rows].mean():.1f} % of {rows.sum():,} with every variation"
    yield ""
    yield f"{'without':26}" + "".join(f"{'points lost ' + part:>28} {'95 % interval':>16}" for part in parts)
    one = np.zeros(len(people.sign), dtype=np.int64)
    lost = {name: float(base.mean() - right.mean()) for name, right in found.items() if name != ALL}
    for name in sorted(lost, key=lambda name: -lost[name]):
        row = f"{name:26}"
        for rows in parts.values():
            here, there = base[rows], found[name][rows]
            low, high = interval(here, there, one[rows], _renumbered(people.writer[rows]))
            gain = balanced(here, one[rows]) - balanced(there, one[rows])
            row += f"{100 * gain:28.1f} {100 * low:7.1f} … {100 * high:5.1f}"
        yield row


def _renumbered(writer: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.unique(writer, return_inverse=True)[1]


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m training.handwriting.ablation", description=__doc__)
    parser.add_argument(
        "--ink", type=Path, required=True, help="folder of math-dev and symbols-dev, JSON Lines"
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("handwriting-ablation.txt"),
        help="the table; the log lies beside it",
    )
    parser.add_argument("--threads", type=int, default=1)
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
