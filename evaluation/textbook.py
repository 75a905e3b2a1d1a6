"""Textbook problems judged: is a right answer judged right, a wrong one wrong, and is its misconception named?

Every problem is drawn several times with other numbers; the right answer and the wrong ones are put on the
page, and the page is corrected and verified as a student's would be.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from data_gen.pages import meaning
from data_gen.problems import in_reading_order
from data_gen.textbook.exercise import Answer, Exercise
from data_gen.textbook.roster import exercise
from evaluation.parallel import Progress, Workers, in_parallel, silent
from evaluation.table import Cell, Table
from physics.rectify import rectify
from physics.verify import Verdict, verify
from physics.verify.misconceptions import Misconception

Name = tuple[str, str]
"""Family and problem."""


@dataclass(frozen=True, slots=True)
class Judged:
    """One answer of one draw. seeded: the misconception that it was made from, None for the right answer;
    verdict: None where the answer was not seen to be one; value: the closed form."""

    name: Name
    draw: int
    answer: str
    seeded: Misconception | None
    verdict: Verdict | None
    value: float

    @property
    def as_it_should(self) -> bool:
        """Right judged right, wrong judged wrong."""
        wanted = "right" if self.seeded is None else "wrong"
        return self.verdict is not None and self.verdict.status == wanted

    @property
    def named(self) -> bool:
        """Whether the misconception that a wrong answer was made from is the one that is named."""
        return self.verdict is not None and self.verdict.misconception == self.seeded


@dataclass(frozen=True, slots=True)
class Shares:
    """Of some answers: how many problems, and the shares that are judged as they should be; None of none."""

    problems: int
    right: float | None
    wrong: float | None
    named: float | None


def judge_problems(
    names: Sequence[Name], draws: int, seed: int, workers: Workers = 1, progress: Progress = silent
) -> tuple[Judged, ...]:
    """Every answer of every problem, `draws` times."""
    tasks = [(name, seed, draw) for name in names for draw in range(draws)]
    judged = in_parallel(_judge, tasks, workers, "Judging answers", progress)
    return tuple(one for answers in judged for one in answers)


def drawn(name: Name, seed: int, draw: int) -> Exercise:
    """A draw of a problem: always the same for the same arguments, whatever other problems there are."""
    letters = [ord(letter) for letter in ": ".join(name)]
    return exercise(*name, np.random.default_rng([seed, draw, *letters]))


def judge(made: Exercise, answer: Answer) -> Verdict | None:
    """The verdict on an answer that stands alone beside its problem."""
    page = rectify(meaning(in_reading_order(made.answered(answer)))).sketch
    number = len(page.expressions) - 1
    return next((verdict for verdict in verify(page) if verdict.expression == number), None)


def _judge(task: tuple[Name, int, int]) -> list[Judged]:
    """All answers to one draw stand beside it at once, as thirty students' would: what the engine finds out
    for one of them serves the others."""
    name, seed, draw = task
    made = drawn(name, seed, draw)
    page = rectify(meaning(in_reading_order(made.answered(*made.answers)))).sketch
    verdicts = {verdict.expression: verdict for verdict in verify(page)}
    return [
        Judged(name, draw, answer.text, answer.misconception, verdicts.get(number), made.value)
        for number, answer in enumerate(made.answers, start=len(made.given))
    ]


def shares(judged: Iterable[Judged]) -> Shares:
    """How many are judged as they should be."""
    answers = list(judged)
    right = [one.as_it_should for one in answers if one.seeded is None]
    wrong = [one for one in answers if one.seeded is not None]
    return Shares(
        len({one.name for one in answers}),
        _share(right),
        _share([one.as_it_should for one in wrong]),
        _share([one.named for one in wrong]),
    )


def _share(these: Sequence[bool]) -> float | None:
    return sum(these) / len(these) if these else None


def by_family(judged: Sequence[Judged]) -> dict[str, Shares]:
    """The shares of each family."""
    families = dict.fromkeys(one.name[0] for one in judged)
    return {family: shares(one for one in judged if one.name[0] == family) for family in families}


def tables(judged: Sequence[Judged]) -> list[Table]:
    """All families and all problems, with what went otherwise than it should."""
    head = ("", "problems", "answers", "right judged right", "wrong judged wrong", "misconception named")
    rows = [
        (family, *_cells([one for one in judged if one.name[0] == family])) for family in by_family(judged)
    ]
    found = [Table("Textbook problems", head, (*rows, ("all", *_cells(judged))))]
    missed = [one for one in judged if not one.as_it_should]
    if missed:
        what = tuple(
            (
                ": ".join(one.name),
                Cell(str(one.draw)),
                Cell(one.answer),
                Cell(one.seeded or "right"),
                Cell("no answer seen" if one.verdict is None else one.verdict.message),
            )
            for one in missed
        )
        found.append(Table("Judged otherwise", ("", "draw", "answer", "made from", "verdict"), what))
    return found


def _cells(answers: Sequence[Judged]) -> tuple[Cell, ...]:
    of = shares(answers)
    texts = ["–" if share is None else f"{100 * share:.1f} %" for share in (of.right, of.wrong, of.named)]
    return tuple(Cell(text) for text in (str(of.problems), str(len(answers)), *texts))


def summary(judged: Sequence[Judged], draws: int, seed: int) -> dict[str, Any]:
    """The figures as plain values."""
    return {
        **_plain(shares(judged)),
        "answers": len(judged),
        "draws": draws,
        "seed": seed,
        "families": {family: _plain(of) for family, of in by_family(judged).items()},
    }


def _plain(of: Shares) -> dict[str, Any]:
    return {
        "problems": of.problems,
        "right_judged_right": of.right,
        "wrong_judged_wrong": of.wrong,
        "misconception_named": of.named,
    }
