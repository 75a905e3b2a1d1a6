"""The suites that inklined makes itself, each a command and a seed away: what they are, and their cards.

A generated suite's hash is of what was generated, so that two machines can tell whether they compare on the same ink.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from evaluation.cards import Card, Tally
from sketch.files.jsonl import Row
from sketch.ink import Ink

SAMPLE = 200
"""Rows (or pages) whose hash stands on a card that is only shown: enough to tell versions of the generator apart."""


@dataclass(frozen=True, slots=True)
class Generated:
    """about: one line; version: grows when what it means changes; command: what uses it; rows: the first so many of a seed."""

    about: str
    kind: str
    version: str
    command: str
    rows: Callable[[int, int], Iterator[Row]]


def _strokes(count: int, seed: int) -> Iterator[Row]:
    from data_gen.strokes import stream

    return (Row(item.kind, Ink((item.stroke,)), extra={"index": item.index}) for item in stream(count, seed))


def _pages(count: int, seed: int) -> Iterator[Row]:
    from data_gen.pages import pages

    return (Row(page.name, page.truth.ink, extra={"answer": page.answer}) for page in pages(count, seed))


def _problems(count: int, seed: int) -> Iterator[Row]:
    from data_gen.textbook.roster import names
    from evaluation.textbook import drawn

    every = list(names())
    for index in range(count):
        turn, which = divmod(index, len(every))
        name = every[which]
        made = drawn(name, seed, turn)
        yield Row(
            ": ".join(name), Ink(), extra={"value": made.value, "answers": [a.text for a in made.answers]}
        )


def _stress(count: int, seed: int) -> Iterator[Row]:
    from evaluation.stress import AXES, stressed

    clean = list(_strokes(max(1, count // len(AXES)), seed))
    for name, axis in AXES.items():
        for k, row in enumerate(clean):
            ink = stressed(row.ink, name, axis.levels[-1], seed, k)
            yield Row(row.label, ink, extra={"axis": name, "level": axis.levels[-1]})


SUITES: dict[str, Generated] = {
    "strokes": Generated(
        "single strokes of nine kinds by simulated writers",
        "strokes",
        "1",
        "inklined compare --strokes 1800",
        _strokes,
    ),
    "pages": Generated(
        "six diagrams with right and wrong answers, whole pages of ink",
        "pages",
        "1",
        "inklined compare --pages 30",
        _pages,
    ),
    "problems": Generated(
        "61 textbook problems with right answers and named wrong ones",
        "problems",
        "1",
        "inklined problems",
        _problems,
    ),
    "stress": Generated(
        "the strokes again, each axis of stress at its strongest", "stress", "1", "inklined stress", _stress
    ),
}


def card(name: str, seed: int, count: int = SAMPLE) -> Card:
    """The card of the first rows of a generated suite. Raises KeyError for a name that is not in `SUITES`."""
    suite = SUITES[name]
    tally = Tally()
    for _ in tally.passing(suite.rows(count, seed)):
        pass
    return tally.card(name, suite.version, f"generated, seed {seed}", suite.kind, "MIT")
