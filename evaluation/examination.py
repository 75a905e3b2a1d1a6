"""A protocol's guesses drawn together: accuracies with their intervals, and who beats whom."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from evaluation.lessons import writer_of
from evaluation.protocols import BEST, Guess
from evaluation.statistics.intervals import Interval, balanced
from evaluation.statistics.paired import McNemar, mcnemar
from evaluation.statistics.several import holm
from evaluation.table import Cell, Table
from sketch.files.jsonl import Row


@dataclass(frozen=True, slots=True)
class Mark:
    """A recognizer at so many templates. best: accuracy when the label may be among the first 1, 2, … guesses; errors: share of
    tests that are wrong, in the customary form of the gesture literature."""

    name: str
    templates: int
    best: tuple[Interval, ...]

    @property
    def accuracy(self) -> Interval:
        return self.best[0]


@dataclass(frozen=True, slots=True)
class Duel:
    """Two recognizers on the same tests at the most templates; adjusted: p after Holm's correction for all duels."""

    first: str
    second: str
    test: McNemar
    adjusted: float | None


def marks(rows: Sequence[Row], guesses: Sequence[Guess], seed: int = 0) -> list[Mark]:
    """For every recognizer and number of templates, in the order in which they come; intervals clustered by writer."""
    found: dict[tuple[str, int], list[Guess]] = {}
    for guess in guesses:
        found.setdefault((guess.name, guess.templates), []).append(guess)
    return [
        Mark(
            name,
            templates,
            tuple(
                balanced(
                    [[one.label in one.best[:n] for one in own] for n in range(1, BEST + 1)],
                    [0] * len(own),
                    [writer_of(rows[one.row]) for one in own],
                    np.random.default_rng(seed),
                )
            ),
        )
        for (name, templates), own in found.items()
    ]


def duels(guesses: Sequence[Guess]) -> list[Duel]:
    """Every two recognizers, test by test, at the most templates."""
    most = max((guess.templates for guess in guesses), default=0)
    right: dict[str, dict[tuple[int, int], bool]] = {}
    for guess in guesses:
        if guess.templates == most:
            right.setdefault(guess.name, {})[guess.trial, guess.row] = guess.right
    pairs = list(combinations(right, 2))
    tests = [mcnemar(list(right[a].values()), [right[b][key] for key in right[a]]) for a, b in pairs]
    told = [k for k, test in enumerate(tests) if test.p is not None]
    adjusted = dict(zip(told, holm([tests[k].p or 0.0 for k in told]), strict=True))
    return [
        Duel(a, b, test, adjusted.get(k)) for k, ((a, b), test) in enumerate(zip(pairs, tests, strict=True))
    ]


def spread(value: Interval, digits: int = 1, signed: bool = False) -> str:
    """A share in percent with its interval: 93.1 (91.0–95.0); signed, a difference: +2.1 (−0.3 to +4.5)."""

    def percent(share: float) -> str:
        return f"{100 * share:{'+' if signed else ''}.{digits}f}".replace("-", "−")

    if value.low is None or value.high is None:
        return percent(value.value)
    to = " to " if signed else "–"
    return f"{percent(value.value)} ({percent(value.low)}{to}{percent(value.high)})"


def tables(caption: str, found: Sequence[Mark], fought: Sequence[Duel]) -> list[Table]:
    """Accuracy by templates, N-best at the most of them, and the duels."""
    counts = sorted({mark.templates for mark in found})
    names = list(dict.fromkeys(mark.name for mark in found))
    by = {(mark.name, mark.templates): mark for mark in found}
    n, writers = found[0].accuracy.n, found[0].accuracy.clusters
    told = [
        Table(
            f"{caption}: accuracy in % (95 % interval, clustered by writer); {n} tests of {writers} writers each.",
            ("", *(f"{count} templates" if count else "untaught" for count in counts)),
            tuple((name, *(Cell(spread(by[name, count].accuracy)) for count in counts)) for name in names),
        ),
        Table(
            f"The label among the first guesses, in %, at {counts[-1]} templates.",
            ("", *(f"first {k}" if k > 1 else "first" for k in range(1, BEST + 1))),
            tuple((name, *(Cell(spread(value)) for value in by[name, counts[-1]].best)) for name in names),
        ),
    ]
    if fought:
        told.append(duel_table(fought))
    return told


def duel_table(fought: Sequence[Duel]) -> Table:
    """Every two recognizers in a row."""
    return Table(
        "Pairs: tests that one alone has right, exact McNemar p (Holm-corrected for all pairs), odds and their 95 % interval.",
        ("", "first alone", "second alone", "p", "p, Holm", "odds", "interval"),
        tuple(
            (
                f"{duel.first} – {duel.second}",
                *(
                    Cell(text)
                    for text in (
                        str(duel.test.only_first),
                        str(duel.test.only_second),
                        probability(duel.test.p),
                        probability(duel.adjusted),
                        _number(duel.test.odds),
                        f"{_number(duel.test.odds_low)}–{_number(duel.test.odds_high)}",
                    )
                ),
            )
            for duel in fought
        ),
    )


def probability(p: float | None) -> str:
    """As papers print it."""
    if p is None:
        return "–"
    return "< 1e-300" if p < 1e-300 else f"{p:.3f}" if p >= 0.001 else f"{p:.1e}"


def plain(found: Sequence[Mark], fought: Sequence[Duel]) -> dict[str, Any]:
    """As JSON has it."""
    from dataclasses import asdict

    return {
        "marks": [
            {"name": m.name, "templates": m.templates, "best": [asdict(i) for i in m.best]} for m in found
        ],
        "pairs": [
            {"first": d.first, "second": d.second, "p_holm": d.adjusted, **_finite(asdict(d.test))}
            for d in fought
        ],
    }


def _finite(values: dict[str, Any]) -> dict[str, Any]:
    """JSON has no infinity: null stands for it."""
    return {key: None if value == float("inf") else value for key, value in values.items()}


def _number(value: float | None) -> str:
    return "–" if value is None else "∞" if value == float("inf") else f"{value:.2g}"
