"""Equations of motion that the page gives its solids (row M7): which they are, and what they say.

A position (`x`, `y`, or a pair `r` or `s`) is one always: metres from where the centre was drawn, right
and up, so that `x = 0.1 sin(2 t)` sets out from there. A velocity is one where it reads the time or the
motion (a pair: where either part does); a constant one is the velocity at the start (row M2), and `v_0`
is never more than that. Of several equations for one coordinate the newest holds.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isfinite
from typing import Literal

from physics.formula.course import course
from physics.formula.meaning import Said, names_used, quantity_of
from physics.formula.program import Node, Program, ProgramError
from physics.formula.vectors import split
from physics.parts.given import Page, formula
from physics.scene import Course
from sketch.page import Component

Axis = Literal["x", "y"]


@dataclass(frozen=True, slots=True)
class CourseRule:
    """What counts as setting out from the drawn place."""

    jump: float = 1e-6
    """m: a thousandth of a pen's line. What begins further away is said to jump."""


RULE = CourseRule()
STARTS = ("v_0", "v_0x", "v_0y")
"""Velocities that are of the start by name."""


def courses_of(page: Page, part: Component) -> tuple[Course, ...]:
    """The equations that move a solid: one for each coordinate at most."""
    stated = [
        one for one in (_statement(page, part, said) for said in _newest(page, part)) if one is not None
    ]
    if part.fixed:
        for one in stated:
            if one.given != "start":
                page.notices.append(f"{one.said.text}: {part.label} is fixed, so it is not used.")
        return ()
    found: list[Course] = []
    for axis in ("x", "y"):
        about = [one for one in stated if axis in one.trees]
        moving = [one for one in about if one.given != "start"]
        if not moving:
            continue
        made = _course(page, part, moving[-1], axis)
        if made is None:
            continue
        found.append(made)
        for one in about:
            if one is not moving[-1]:
                page.notices.append(
                    f"{one.said.text} of {part.label} is not used for {axis}, "
                    f"which {moving[-1].said.text} gives."
                )
    return tuple(found)


def moves(page: Page, part: Component, said: Said) -> bool:
    """Whether a velocity is an equation of motion, rather than what a solid has at the start."""
    if said.name in STARTS:
        return False
    try:
        pair = split(said.tree)
    except ProgramError:
        return False
    return page.varies(said, part.label, (said.tree,) if pair is None else pair)


@dataclass(frozen=True, slots=True)
class _Statement:
    """What is said of a solid's motion; given: "start" for a velocity that is no equation of motion."""

    said: Said
    given: Literal["position", "velocity", "start"]
    trees: dict[Axis, Node]


def _newest(page: Page, part: Component) -> list[Said]:
    """The newest of each name that is said of a component, the newest of all last."""
    newest: dict[str, Said] = {}
    for said in page.meanings.said:
        if said.component == part.label:
            newest.pop(said.name, None)
            newest[said.name] = said
    return list(newest.values())


def _statement(page: Page, part: Component, said: Said) -> _Statement | None:
    quantity = said.quantity or quantity_of(said.name, part.kind)
    match None if quantity is None else quantity.role:
        case "x" | "y" as axis:
            return _Statement(said, "position", {axis: said.tree})
        case "v_x" | "v_y" as role:
            axis = "x" if role == "v_x" else "y"
            return _Statement(said, _velocity(page, part, said), {axis: said.tree})
        case "position" | "velocity" as role:
            return _of_both(page, part, said, role)
        case _:
            return None


def _of_both(
    page: Page, part: Component, said: Said, role: Literal["position", "velocity"]
) -> _Statement | None:
    try:
        pair = split(said.tree)
    except ProgramError as error:
        if role == "position":  # a velocity is refused where the start is worked out
            page.refuse(said, part.label, error)
        return None
    given = role if role == "position" else _velocity(page, part, said)
    if pair is not None:
        return _Statement(said, given, {"x": pair[0], "y": pair[1]})
    if role == "position":
        if said.name not in names_used(page.meanings.said):
            page.notices.append(
                f"{said.text} of {part.label} has no direction; write it as a pair, such as (t, 0). It is not used."
            )
        return None
    if given == "velocity":
        page.notices.append(f"{said.text} of {part.label} has no direction; it is taken to the right.")
    return _Statement(said, given, {"x": said.tree})


def _velocity(page: Page, part: Component, said: Said) -> Literal["velocity", "start"]:
    return "velocity" if moves(page, part, said) else "start"


def _course(page: Page, part: Component, statement: _Statement, axis: Axis) -> Course | None:
    """The equation for one coordinate, if it can be one."""
    said, label = statement.said, part.label
    given = "position" if statement.given == "position" else "velocity"
    try:
        made = course(said.name, label, axis, statement.trees[axis], given, page.names(label), formula(said))
    except ProgramError as error:
        page.refuse(said, label, error)
        return None
    drawn = page.starts[label]["xy".index(axis)]
    made = replace(
        made,
        position=None if made.position is None else _raised(made.position, drawn),
        velocity=page.from_start(made.velocity, label),
        acceleration=page.from_start(made.acceleration, label),
    )
    begins = [
        page.at_start(program, label)
        for program in (made.position, made.velocity, made.acceleration)
        if program is not None
    ]
    if not all(isfinite(value) for value in begins):
        page.notices.append(
            f"{said.text} of {label} has no value at the start, or changes without limit there; it is not used."
        )
        return None
    page.tell_zeros(said, label, made.velocity)
    if made.position is None:
        page.notices.append(
            f"{said.text} of {label} changes in time; {label} follows it, whatever forces act."
        )
    elif abs(begins[0] - drawn) > RULE.jump:
        page.notices.append(
            f"{said.text} of {label}: {axis} is {begins[0] - drawn:.3g} m at the start, so {label} jumps there from where it was drawn."
        )
    return made


def _raised(program: Program, by: float) -> Program:
    return replace(program, code=(*program.code, ("push", by), ("add", 0.0)))
