"""A textbook problem drawn once: its diagram, what is given, what is asked, and answers right and wrong.

Frame: page units, y down, 100 of them a metre; quantities are SI with y up. The true value is the closed
form, worked out here in double precision, without the engine.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from data_gen.diagrams.problem import Expected, Problem, Remark
from physics.verify.misconceptions import Misconception
from sketch.page import Component
from sketch.shapes import Point


@dataclass(frozen=True, slots=True)
class ExerciseRule:
    """What makes an exercise worth setting."""

    apart: float = 0.03
    """Relative: a wrong answer nearer to the true value than this is none; judging forgives 0.5 %."""
    wrong: int = 3
    """Wrong answers at least; a draw with fewer is drawn anew."""
    digits: int = 4
    """Significant digits of an answer that is a number."""


RULE = ExerciseRule()


@dataclass(frozen=True, slots=True)
class Answer:
    """text: as a student writes it, in the formula language; misconception: that it comes from, None for
    the right one."""

    text: str
    misconception: Misconception | None = None


@dataclass(frozen=True, slots=True)
class Exercise:
    """given: with what it governs; about: the label of the thing that is asked about, and the spot where the
    answer is associated; value: the true one, SI; answers: the right one first."""

    name: str
    question: str
    components: tuple[Component, ...]
    given: tuple[Remark, ...]
    about: tuple[str, Point]
    quantity: str
    unit: str
    value: float
    answers: tuple[Answer, ...]
    seconds: float

    def answered(self, *answers: Answer) -> Problem:
        """The page with these answers after what is given."""
        remarks = (*self.given, *(Remark(answer.text, (self.about,)) for answer in answers))
        return Problem(self.components, remarks, self.seconds, Expected({}))


@dataclass(frozen=True, slots=True)
class Situation:
    """What several problems are about. seconds: how long it is worth watching."""

    components: tuple[Component, ...]
    given: tuple[Remark, ...]
    seconds: float


@dataclass(frozen=True, slots=True)
class Wrong:
    """A wrong answer: the misconception, and what comes of it, as a number (SI) or as a formula."""

    misconception: Misconception
    value: float
    formula: str | None = None


def ask(
    question: str,
    situation: Situation,
    about: tuple[str, Point],
    quantity: str,
    unit: str,
    value: float,
    wrong: Sequence[Wrong],
    formula: str | None = None,
) -> Exercise:
    """The exercise that asks for a quantity. formula: the right answer, where a student would leave it as one.

    Wrong answers that happen to be right with these numbers, or equal to one another, are left out.
    """
    kept: list[Wrong] = []
    for one in wrong:
        others = [value, *(other.value for other in kept)]
        if all(abs(one.value - other) > RULE.apart * max(abs(one.value), abs(other)) for other in others):
            kept.append(one)
    answers = [Answer(f"{quantity} = {number(value) if formula is None else formula}")]
    answers += [
        Answer(f"{quantity} = {number(one.value) if one.formula is None else one.formula}", one.misconception)
        for one in kept
    ]
    return Exercise(
        "",
        question,
        situation.components,
        situation.given,
        about,
        quantity,
        unit,
        value,
        tuple(answers),
        situation.seconds,
    )


def number(value: float) -> str:
    """A number to four significant digits, never with an exponent."""
    return np.format_float_positional(float(f"{value:.{RULE.digits}g}"), trim="-")


def remark(text: str, label: str | None = None, spot: Point = (0.0, 0.0)) -> Remark:
    """A line about one thing, or about the whole page."""
    return Remark(text, () if label is None else ((label, spot),))


def pick(rng: np.random.Generator, texts: Sequence[str]) -> tuple[str, float]:
    """One of several numbers, as written and as it is."""
    text = str(rng.choice(texts))
    return text, float(text)
