"""A page without its answers, which can be asked: what is true, and what it would be for one who errs.

What was found out for one answer is kept for the next, so that judging thirty answers to one question
costs little more than judging one. SI units.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import isfinite, pi

import sympy

from physics.build import build
from physics.formula.meaning import Meanings, read
from physics.formula.names import MASS_ROLES, lookup, number_said, solid_of
from physics.formula.program import STATE, Node, ProgramError, compile_tree
from physics.parts.links import RULE as LINKS
from physics.parts.pulleys import drawn_as
from physics.rectify import rectify
from physics.scene import SceneError
from physics.verify.asked import Asked
from physics.verify.changed import ANGLES, mistaken, saying, weightless
from physics.verify.misconceptions import Misconception
from physics.verify.truth import About, Truth, state_at, true_value, truth
from physics.verify.watch import NotDetermined
from sketch.page import Sketch


@dataclass(frozen=True, slots=True)
class OpenRule:
    """How it is seen whether a value hangs on what the page leaves open."""

    factor: float = 1.37
    """What is left open is multiplied by this: a number that no exact relation hides behind."""
    restitution: float = 0.685
    """Instead of the default of 0.5."""


OPEN = OpenRule()


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked of which component (its label)."""

    asked: Asked
    label: str


@dataclass(frozen=True, slots=True)
class Open:
    """Something that the page leaves open. what: in words; name, value: as a page could say it otherwise."""

    what: str
    name: str
    value: float
    label: str


class Exam:
    """A page without answers, corrected. Mutable: it keeps what it has found out."""

    def __init__(self, sketch: Sketch) -> None:
        self.sketch = sketch
        self.meanings = read(sketch)
        self.scene = build(sketch).scene
        self._truths: dict[Question, Truth | str] = {}
        self._spoilt: dict[tuple[Question, bool], list[tuple[Misconception, float]]] = {}
        self._sources: dict[tuple[Question, bool], Iterator[tuple[Misconception, float]]] = {}

    @property
    def g(self) -> float:
        """m/s²; negative where the page has it point upwards."""
        return -self.scene.gravity[1]

    def truth(self, question: Question) -> Truth:
        """The true value with its bound. Raises NotDetermined where the page settles none."""
        if question not in self._truths:
            try:
                self._truths[question] = truth(self.scene, self.about(question))
            except (NotDetermined, SceneError) as reason:
                self._truths[question] = str(reason)
        found = self._truths[question]
        if isinstance(found, str):
            raise NotDetermined(found)
        return found

    def spoilt(self, question: Question, last: bool) -> Iterator[tuple[Misconception, float]]:
        """What the true value would be on the page as misconceptions see it, one after the other. last:
        those that are thought of last."""
        key = (question, last)
        kept = self._spoilt.setdefault(key, [])
        if key not in self._sources:
            self._sources[key] = self._misseen(question, last)
        done = 0
        while True:
            while done < len(kept):
                yield kept[done]
                done += 1
            one = next(self._sources[key], None)
            if one is None:
                return
            kept.append(one)

    def _misseen(self, question: Question, last: bool) -> Iterator[tuple[Misconception, float]]:
        masses = {body.label: body.mass for body in self.scene.bodies if not body.fixed}
        pages = (
            weightless(self.sketch, self.g) if last else mistaken(self.sketch, self.meanings, masses, self.g)
        )
        for cause, page in pages:
            try:
                other = Exam(rectify(page).sketch)
                yield cause, true_value(other.scene, other.about(question))
            except (NotDetermined, SceneError):
                continue

    def about(self, question: Question) -> About:
        """The question as the scene knows it. Raises NotDetermined where it can have no answer here."""
        label, kind = question.label, question.asked.kind
        on, known = None, label
        if kind in ("normal", "friction"):
            on = self._support(label)
            if on is None:
                raise NotDetermined(f"{label} rests on nothing, so there is no such force")
        elif kind == "tension":
            known = drawn_as(self.sketch, label)
            if all(wire.label != known for wire in self.scene.wires):
                raise NotDetermined(f"{label} joins nothing that it could hold")
        elif all(body.label != label or body.fixed for body in self.scene.bodies):
            raise NotDetermined(f"{label} cannot move")
        return About(question.asked, known, on, self._time)

    @cached_property
    def _time(self) -> float | None:
        """The time that the page gives, associated with nothing, s."""
        said = self.meanings.find("t", None)
        if said is None or said.component is not None:
            return None
        return number_said(self.sketch, self.meanings, said, self.g)

    def _support(self, label: str) -> str | None:
        """What carries a body: what a given normal force would stand in for."""
        given = build(saying(self.sketch, "N", sympy.Integer(1), label)).scene.supports
        return next((support.on for support in given if support.body == label), None)

    def value(self, tree: Node, names: Meanings, question: Question) -> float | None:
        """What a formula gives here, at the moment that is asked about; None if nothing. names: what its
        names mean."""
        masses = {body.label: body.mass for body in self.scene.bodies}
        try:
            program = compile_tree(tree, lookup(self.sketch, names, question.label, masses, self.g))
        except ProgramError:
            return None
        if program.unspecified:
            return None
        state: list[float] = []  # where nothing is read
        if not program.constant:
            state = self._state((solid_of(self.sketch, question.label), *program.others), question)
        value = program.value(state)
        return value if isfinite(value) else None

    def _state(self, labels: tuple[str | None, ...], question: Question) -> list[float]:
        moment = state_at(self.scene, self.about(question))
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

    @cached_property
    def angles(self) -> tuple[float, ...]:
        """All acute angles that the page names, rad."""
        found: list[float] = []
        for said in self.meanings.said:
            if said.name.partition("_")[0] in ANGLES:
                value = number_said(self.sketch, self.meanings, said, self.g)
                found += [] if value is None or not 0 < value < pi / 2 else [value]
        return tuple(dict.fromkeys(found))

    @cached_property
    def opened(self) -> tuple[Open, ...]:
        """All that the page leaves open."""
        found: list[Open] = []
        for body in self.scene.bodies:
            kind = self.sketch.component(body.label).kind
            given = any(self.meanings.of(body.label, role, kind) is not None for role in MASS_ROLES)
            if not body.fixed and not given:
                found.append(Open("the mass", "m", OPEN.factor * body.mass, body.label))
        for spring in self.scene.springs:
            if self.meanings.of(spring.label, "stiffness", "spring") is None:
                found.append(Open("the stiffness", "k", OPEN.factor * LINKS.stiffness, spring.label))
        if all(body.material.restitution is None for body in self.scene.bodies):
            found += [
                Open("the restitution", "e", OPEN.restitution, body.label)
                for body in self.scene.bodies
                if not body.fixed
            ]
        return tuple(found)

    @cached_property
    def otherwise(self) -> Exam:
        """The page with all that it leaves open changed."""
        return self.saying(*self.opened)

    def saying(self, *opened: Open) -> Exam:
        """The page with these things said otherwise."""
        changed = self.sketch
        for one in opened:
            changed = saying(changed, one.name, sympy.Float(one.value), one.label)
        return Exam(changed)
