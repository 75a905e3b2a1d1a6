"""A page's answers judged by the engine (rows M9 and M10).

    for verdict in verify(rectify(page).sketch): print(verdict.message)

The true value comes from the same page without its answers: without all of them, so that a wrong tension
of one wire does not make the right one of the other wrong. What counts as an answer: `physics.verify.asked`.
Where the value hangs on something that the page leaves open (a mass that nobody gave), a number cannot be
judged and "not determined by this page" is the verdict; a formula that is right whatever the mass is, is
right.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import sympy

from physics.formula.dimensions import Finding, check
from physics.formula.meaning import Meanings, Said, read
from physics.formula.units import has_units
from physics.scene import SceneError
from physics.verify.asked import asked
from physics.verify.changed import without
from physics.verify.exam import Exam, Question
from physics.verify.misconceptions import WORDS, Misconception, of_formula, of_number
from physics.verify.watch import NotDetermined
from sketch.page import Sketch

Status = Literal["right", "wrong", "not determined"]


@dataclass(frozen=True, slots=True)
class Judging:
    """When an answer is right, and when a misconception explains it."""

    relative: float = 5e-3
    """Three significant digits are asked for, as in school: 1.005 rounded to 1.00 or 1.01 is off by 0.5 %,
    the most that rounding to three digits can do."""
    absolute: float = 1e-6
    """SI: for a true value of zero, where nothing is relative."""
    near: float = 5e-3
    """Relative: an answer so near to what a misconception gives is explained by it, as above."""
    formula: float = 1e-6
    """Relative: a formula is not rounded; what is left is the engine's error, and the idealisation."""
    rounding: float = 1.02
    """Half units of the last digit that was written: a number that was rounded is off by one at most."""
    coarse: float = 0.05
    """Relative: what is further off than this was not merely rounded."""


JUDGING = Judging()


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is to be said of one answer.

    expression: its number on the page; component: what it is associated with; name, text: as written;
    given, true: SI, None where there is none; unit: of both; error: relative, None where the true value is
    zero; bound: of the engine's own error, SI, None where it is not known; finding: what is wrong with its
    dimensions, None where they go together; converted: the conversion to SI that was made, in words;
    misconception: which known one explains a wrong answer; message: a sentence for the student.
    """

    expression: int
    component: str
    name: str
    text: str
    status: Status
    given: float | None
    true: float | None
    unit: str
    error: float | None
    bound: float | None
    finding: Finding | None
    converted: str | None
    misconception: Misconception | None
    message: str


@dataclass(frozen=True, slots=True)
class _Answer:
    """number: of its expression; finding: what is wrong with its dimensions."""

    number: int
    question: Question
    said: Said
    finding: Finding | None


def verify(sketch: Sketch) -> tuple[Verdict, ...]:
    """A verdict on every answer of a corrected page, in the order of association. Never raises for what a
    page may hold."""
    meanings = read(sketch)
    answers = _answers(sketch, meanings)
    try:
        exam = Exam(without(sketch, {answer.number for answer in answers}))
    except SceneError as reason:
        return tuple(_open_verdict(answer, None, str(reason)) for answer in answers)
    return tuple(_judged(exam, meanings, answer) for answer in answers)


def _answers(sketch: Sketch, meanings: Meanings) -> list[_Answer]:
    findings = {finding.expression: finding for finding in check(sketch, meanings)}
    found: list[_Answer] = []
    for said in meanings.said:
        if said.component is None or said.expression is None or isinstance(said.tree, sympy.Tuple):
            continue
        what = asked(said.name, sketch.component(said.component).kind)
        if what is not None:
            finding = findings.get(said.expression)
            found.append(_Answer(said.expression, Question(what, said.component), said, finding))
    return found


def _judged(exam: Exam, meanings: Meanings, answer: _Answer) -> Verdict:
    given: float | None = None
    try:
        true = exam.truth(answer.question)
        given = exam.value(answer.said.tree, meanings, answer.question)
        if given is None:
            raise NotDetermined("the answer itself has no value: a name in it is nowhere explained")
        _refuse_if_open(exam, meanings, answer, true.value, given)
    except (NotDetermined, SceneError) as reason:
        return _open_verdict(answer, given, str(reason))
    margin = max(JUDGING.relative * abs(true.value), JUDGING.absolute) + (true.bound or 0.0)
    near = abs(given - true.value) <= margin
    # Numbers put in for quantities leave a formula without its dimensions, but right; units that are written
    # must be the right ones.
    if near and (answer.finding is None or not has_units(answer.said.given)):
        message = f"{answer.said.text} is right: {true.value:.4g} {answer.question.asked.unit}."
        message += "" if answer.finding is None else f" But {answer.finding.message}"
        return _verdict(answer, "right", given, true.value, true.bound, None, message)
    cause = None if near else _explained(exam, meanings, answer, given, true.value)
    parts = [
        f"{answer.said.text} is wrong: it is {true.value:.4g} {answer.question.asked.unit}{_off(given, true.value)}"
    ]
    if cause is not None:
        parts.append(f"; it seems that {WORDS[cause]}")
    message = "".join(parts) + "."
    if answer.finding is not None:
        message += f" {answer.finding.message}"
    return _verdict(answer, "wrong", given, true.value, true.bound, cause, message)


def _off(given: float, true: float) -> str:
    """How far off an answer is, in words; nothing where that is no matter of a share."""
    if true == 0.0 or given / true <= 0.0 or given / true > 10.0:
        return ""
    times = given / true
    if times >= 2.0:
        return f", so this is {times:.2g} times as much"
    share = 100 * abs(times - 1.0)
    return f", so this is {share:.{2 if share < 10 else 3}g} % too {'great' if times > 1.0 else 'small'}"


def _verdict(
    answer: _Answer,
    status: Status,
    given: float | None,
    true: float | None,
    bound: float | None,
    cause: Misconception | None,
    message: str,
) -> Verdict:
    error = None if given is None or not true else abs(given - true) / abs(true)
    said = answer.said
    return Verdict(
        answer.number,
        answer.question.label,
        said.name,
        said.text,
        status,
        given,
        true,
        answer.question.asked.unit,
        error,
        bound,
        answer.finding,
        said.converted,
        cause,
        message,
    )


def _open_verdict(answer: _Answer, given: float | None, reason: str) -> Verdict:
    message = f"{answer.said.text} is not determined by this page: {reason}."
    return _verdict(answer, "not determined", given, None, None, None, message)


def _refuse_if_open(exam: Exam, meanings: Meanings, answer: _Answer, true: float, given: float) -> None:
    """Raises NotDetermined where the true value hangs on what nobody gave and the answer does not."""
    if not exam.opened or not _hangs(exam.otherwise, meanings, answer, true, given):
        return
    for one in exam.opened:
        if _hangs(exam.saying(one), meanings, answer, true, given):
            raise NotDetermined(f"it hangs on {one.what} of {one.label}, which the page does not say")
    raise NotDetermined("it hangs on masses and materials that the page does not say")


def _hangs(changed: Exam, meanings: Meanings, answer: _Answer, true: float, given: float) -> bool:
    """Whether on the changed page the true value is another while the answer's is the same."""
    try:
        other = changed.truth(answer.question).value
    except NotDetermined:
        return True
    if abs(other - true) <= max(JUDGING.relative * abs(true), JUDGING.absolute):
        return False
    # What the page with answers says, and the newer things that the changed one says.
    newer = (said for said in changed.meanings.said if said not in meanings.said)
    names = Meanings((*meanings.said, *newer), ())
    return changed.value(answer.said.tree, names, answer.question) == given


def _explained(
    exam: Exam, meanings: Meanings, answer: _Answer, given: float, true: float
) -> Misconception | None:
    """The misconception that makes the given answer of the true value to all its digits, the likeliest of
    several; where none does, one that comes near."""
    exact, half = _written(answer, given)
    if abs(given - true) <= min(JUDGING.rounding * half, JUDGING.coarse * abs(true)):
        return "rounded too coarsely"
    nearest: Misconception | None = None
    for cause, made, wanted in _compared(exam, meanings, answer, given, true):
        off = abs(made - wanted) / max(abs(wanted), JUDGING.absolute)
        if off <= exact:
            return cause
        if off <= JUDGING.near and nearest is None:
            nearest = cause
    return nearest


def _compared(
    exam: Exam, meanings: Meanings, answer: _Answer, given: float, true: float
) -> Iterator[tuple[Misconception, float, float]]:
    """(misconception, what it makes, what that must be): of a formula, corrected, the true value; of the true
    value, spoilt, the given one."""
    if answer.said.tree.free_symbols:
        for cause, corrected in of_formula(answer.said.tree):
            value = exam.value(corrected, meanings, answer.question)
            if value is not None:
                yield cause, value, true
    yield "wrong sign", -true, given
    for cause, value in exam.spoilt(answer.question, last=False):
        yield cause, value, given
    for cause, value in of_number(true, exam.angles, abs(exam.g) or 1.0):
        yield cause, value, given
    for cause, value in exam.spoilt(answer.question, last=True):
        yield cause, value, given


_NUMBER = re.compile(r"[^=]*=\s*-?\s*(?P<whole>\d*)(?:\.(?P<part>\d+))?\s*(?P<unit>[^\d\s].*)?")


def _written(answer: _Answer, value: float) -> tuple[float, float]:
    """(relative, SI) what rounding to the digits that were written may have changed; of a formula nothing."""
    found = _NUMBER.fullmatch(answer.said.text.strip())
    if found is None or answer.said.tree.free_symbols or not answer.said.tree.is_number:
        return JUDGING.formula, 0.0
    whole, part = found["whole"] or "0", found["part"] or ""
    written = float(f"{whole}.{part or 0}")
    # A unit scales the number and its last digit alike.
    half = 0.5 * 10.0 ** -len(part) / written if written else 0.0
    return min(max(JUDGING.rounding * half, JUDGING.formula), JUDGING.near), half * abs(value)
