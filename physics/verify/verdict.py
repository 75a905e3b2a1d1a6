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
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Literal

import sympy

from physics.build import build
from physics.formula.dimensions import Finding, check
from physics.formula.meaning import Meanings, Said, read
from physics.formula.names import constant_of, lookup, solid_of
from physics.formula.program import STATE, Node, ProgramError, compile_tree
from physics.formula.units import has_units
from physics.parts.links import RULE as LINKS
from physics.parts.pulleys import drawn_as
from physics.rectify import rectify
from physics.scene import Scene, SceneError
from physics.verify.asked import Asked, asked
from physics.verify.changed import ANGLES, mistaken, saying, weightless, without
from physics.verify.misconceptions import (
    WORDS,
    Misconception,
    of_formula,
    of_number,
)
from physics.verify.truth import About, state_at, true_value, truth
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
    open: float = 1.37
    """What the page leaves open is multiplied by this (a number that no exact relation hides behind), to see
    whether the true value hangs on it."""
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
    label: str
    said: Said
    asked: Asked
    finding: Finding | None


def verify(sketch: Sketch) -> tuple[Verdict, ...]:
    """A verdict on every answer of a corrected page, in the order of association. Never raises for what a
    page may hold."""
    meanings = read(sketch)
    answers = _answers(sketch, meanings)
    bare = without(sketch, {answer.number for answer in answers})
    return tuple(_judged(sketch, bare, meanings, answer) for answer in answers)


def _answers(sketch: Sketch, meanings: Meanings) -> list[_Answer]:
    findings = {finding.expression: finding for finding in check(sketch, meanings)}
    found: list[_Answer] = []
    for said in meanings.said:
        if said.component is None or said.expression is None or isinstance(said.tree, sympy.Tuple):
            continue
        what = asked(said.name, sketch.component(said.component).kind)
        if what is not None:
            finding = findings.get(said.expression)
            found.append(_Answer(said.expression, said.component, said, what, finding))
    return found


@dataclass(frozen=True, slots=True)
class _Page:
    """A page without its answers, set up to be asked. label: of what the answer is
    associated with."""

    sketch: Sketch
    meanings: Meanings
    scene: Scene
    about: About
    label: str

    def true(self) -> float:
        return true_value(self.scene, self.about)

    def value(self, tree: Node, names: Meanings) -> float | None:
        """What an answer's formula gives here, at the moment that is asked about; None if nothing."""
        masses = {body.label: body.mass for body in self.scene.bodies}
        find = lookup(self.sketch, names, self.label, masses, -self.scene.gravity[1])
        try:
            program = compile_tree(tree, find)
        except ProgramError:
            return None
        if program.unspecified:
            return None
        state = [0.0] * (len(STATE) * (1 + len(program.others)))
        if not program.constant:
            state = self._state((solid_of(self.sketch, self.label), *program.others))
        value = program.value(state)
        return value if isfinite(value) else None

    def _state(self, labels: tuple[str | None, ...]) -> list[float]:
        moment = state_at(self.scene, self.about)
        state: list[float] = []
        for label in labels:
            if label is None or label not in moment.bodies:
                state += [0.0] * len(STATE)
                continue
            start, column = self.scene.body(label).position, moment.column(label)
            (x, y, angle), (v_x, v_y, omega) = moment.poses[0, column], moment.velocities[0, column]
            speed = float(moment.speed(label)[0])
            state += [moment.times[0], x - start[0], y - start[1], angle, v_x, v_y, speed, omega]
        return [float(value) for value in state]


def _asked_of(sketch: Sketch, bare: Sketch, answer: _Answer) -> _Page:
    """The page without answers, and what is asked of it. Raises NotDetermined, SceneError."""
    meanings = read(bare)
    scene = build(bare).scene
    on, label = None, answer.label
    if answer.asked.kind in ("normal", "friction"):
        on = _support(sketch, answer, scene)
        if on is None:
            raise NotDetermined(f"{answer.label} rests on nothing, so there is no such force")
    elif answer.asked.kind == "tension":
        label = drawn_as(bare, answer.label)
        if all(wire.label != label for wire in scene.wires):
            raise NotDetermined(f"{answer.label} joins nothing that it could hold")
    elif all(body.label != answer.label or body.fixed for body in scene.bodies):
        raise NotDetermined(f"{answer.label} cannot move")
    time = meanings.find("t", None)
    at = None
    if time is not None and time.component is None:
        at = constant_of(time, lookup(bare, meanings, None, {}, -scene.gravity[1]))
    return _Page(bare, meanings, scene, About(answer.asked, label, on, at), answer.label)


def _support(sketch: Sketch, answer: _Answer, scene: Scene) -> str | None:
    """What carries the body: what a given normal force would stand in for."""
    given = build(saying(sketch, "N", sympy.Integer(1), answer.label)).scene.supports
    found = next((support.on for support in given if support.body == answer.label), None)
    return found if any(body.label == found for body in scene.bodies) else None


def _judged(sketch: Sketch, bare: Sketch, meanings: Meanings, answer: _Answer) -> Verdict:
    tree = answer.said.tree
    given: float | None = None
    try:
        page = _asked_of(sketch, bare, answer)
        given = page.value(tree, meanings)
        true = truth(page.scene, page.about)
        if given is None:
            raise NotDetermined("the answer itself has no value: a name in it is nowhere explained")
        _refuse_if_open(sketch, bare, meanings, answer, (true.value, given))
    except (NotDetermined, SceneError) as reason:
        message = f"{answer.said.text} is not determined by this page: {reason}."
        return _verdict(answer, "not determined", given, None, None, None, message)
    margin = max(JUDGING.relative * abs(true.value), JUDGING.absolute) + (true.bound or 0.0)
    near = abs(given - true.value) <= margin
    # Numbers put in for quantities leave a formula without its dimensions, but right; units that are written
    # must be the right ones.
    if near and (answer.finding is None or not has_units(answer.said.given)):
        message = f"{answer.said.text} is right: {true.value:.4g} {answer.asked.unit}."
        message += "" if answer.finding is None else f" But {answer.finding.message}"
        return _verdict(answer, "right", given, true.value, true.bound, None, message)
    cause = None if near else _explained(page, meanings, answer, given, true.value)
    parts = [f"{answer.said.text} is wrong: it is {true.value:.4g} {answer.asked.unit}"]
    if cause is not None:
        parts.append(f"; it seems that {WORDS[cause]}")
    message = "".join(parts) + "."
    if answer.finding is not None:
        message += f" {answer.finding.message}"
    return _verdict(answer, "wrong", given, true.value, true.bound, cause, message)


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
        answer.label,
        said.name,
        said.text,
        status,
        given,
        true,
        answer.asked.unit,
        error,
        bound,
        answer.finding,
        said.converted,
        cause,
        message,
    )


def _refuse_if_open(
    sketch: Sketch, bare: Sketch, meanings: Meanings, answer: _Answer, values: tuple[float, float]
) -> None:
    """Raises NotDetermined where the true value hangs on what nobody gave and the answer does not."""
    opened = _opened(bare)
    changed = bare
    for _, name, value, label in opened:
        changed = saying(changed, name, sympy.Float(value), label)
    if not opened or not _hangs(sketch, changed, meanings, answer, values):
        return
    for what, name, value, label in opened:
        if _hangs(sketch, saying(bare, name, sympy.Float(value), label), meanings, answer, values):
            raise NotDetermined(f"it hangs on {what} of {label}, which the page does not say")
    raise NotDetermined("it hangs on masses and materials that the page does not say")


def _hangs(
    sketch: Sketch, changed: Sketch, meanings: Meanings, answer: _Answer, values: tuple[float, float]
) -> bool:
    """Whether on the changed page the true value is another while the answer's is the same."""
    true, given = values
    try:
        page = _asked_of(sketch, changed, answer)
        other = page.true()
    except (NotDetermined, SceneError):
        return True
    same = max(JUDGING.relative * abs(true), JUDGING.absolute)
    if abs(other - true) <= same:
        return False
    return page.value(answer.said.tree, _renewed(meanings, page.meanings)) == given


def _renewed(meanings: Meanings, changed: Meanings) -> Meanings:
    """What the page with answers says, and the newer things that the changed one says."""
    return Meanings((*meanings.said, *(said for said in changed.said if said not in meanings.said)), ())


def _opened(bare: Sketch) -> list[tuple[str, str, float, str]]:
    """(what, its name, another value, label) for all that the page leaves open."""
    meanings = read(bare)
    scene = build(bare).scene
    found: list[tuple[str, str, float, str]] = []
    for body in scene.bodies:
        kind = bare.component(body.label).kind
        if not body.fixed and meanings.of(body.label, "mass", kind) is None:
            found.append(("the mass", "m", JUDGING.open * body.mass, body.label))
    for spring in scene.springs:
        if meanings.of(spring.label, "stiffness", "spring") is None:
            found.append(("the stiffness", "k", JUDGING.open * LINKS.stiffness, spring.label))
    if all(body.material.restitution is None for body in scene.bodies):
        for body in scene.bodies:
            if not body.fixed:
                found.append(("the restitution", "e", 0.5 * JUDGING.open, body.label))
    return found


def _explained(
    page: _Page, meanings: Meanings, answer: _Answer, given: float, true: float
) -> Misconception | None:
    """The misconception that makes the given answer of the true value to all its digits, the likeliest of
    several; where none does, one that comes near."""
    exact, half = _written(answer, given)
    if abs(given - true) <= min(JUDGING.rounding * half, JUDGING.coarse * abs(true)):
        return "rounded too coarsely"
    nearest: Misconception | None = None
    for cause, made, wanted in _compared(page, meanings, answer, given, true):
        off = abs(made - wanted) / max(abs(wanted), JUDGING.absolute)
        if off <= exact:
            return cause
        if off <= JUDGING.near and nearest is None:
            nearest = cause
    return nearest


def _compared(
    page: _Page, meanings: Meanings, answer: _Answer, given: float, true: float
) -> Iterator[tuple[Misconception, float, float]]:
    """(misconception, what it makes, what that must be): of a formula, corrected, the true value; of the true
    value, spoilt, the given one."""
    if answer.said.tree.free_symbols:
        for cause, corrected in of_formula(answer.said.tree):
            value = page.value(corrected, meanings)
            if value is not None:
                yield cause, value, true
    yield "wrong sign", -true, given
    g = -page.scene.gravity[1]
    masses = {body.label: body.mass for body in page.scene.bodies if not body.fixed}
    yield from _spoilt(page, answer, given, mistaken(page.sketch, page.meanings, masses, g))
    for cause, value in of_number(true, _angles(page), abs(g) or 1.0):
        yield cause, value, given
    yield from _spoilt(page, answer, given, weightless(page.sketch, g))


def _spoilt(
    page: _Page, answer: _Answer, given: float, pages: Iterable[tuple[Misconception, Sketch]]
) -> Iterator[tuple[Misconception, float, float]]:
    """The true values of pages as misconceptions see them, where they have one."""
    for cause, other in pages:
        try:
            seen = _asked_of(page.sketch, rectify(other).sketch, answer)
            yield cause, seen.true(), given
        except (NotDetermined, SceneError):
            continue


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


def _angles(page: _Page) -> tuple[float, ...]:
    """All angles that the page names, rad."""
    found: list[float] = []
    for said in page.meanings.said:
        if said.name.partition("_")[0] in ANGLES:
            value = constant_of(said, lookup(page.sketch, page.meanings, said.component, {}, 9.81))
            found += [] if value is None else [value]
    return tuple(dict.fromkeys(found))
