"""Six diagrams of a mechanics course, each drawn anew from a random generator, with the whole truth.

Frame: page units, y down, a page of about 600 x 450; 100 page units are a metre. Velocities and
angles in the mathematics are SI with y up. The first two diagrams are the worked examples of
the sketch-based physics tutor of Cheema and LaViola; they come with right and wrong answers.
What each diagram must do when it is set in motion follows from how it was made, and stands
beside it as `Expected`.

Shapes that are meant to touch touch exactly, links end exactly on boundaries, angles are exactly
those in the mathematics. What a pen makes of that is another file's business. Textbook problems, whose
answers are numbers to be judged, are in `data_gen.textbook.roster`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from data_gen.diagrams.balls import two_balls
from data_gen.diagrams.incline import incline_and_ball
from data_gen.diagrams.pendulum import pendulum
from data_gen.diagrams.problem import Expected, Problem
from data_gen.diagrams.spring import mass_on_spring
from data_gen.diagrams.stack import stack_of_boxes
from data_gen.diagrams.wires import TENSIONS, box_on_two_wires
from sketch.geometry import bounding_box
from sketch.page import Component, label
from sketch.shapes import outline

_DIAGRAMS: dict[str, Callable[[str, np.random.Generator], Problem]] = {
    "incline-and-ball": incline_and_ball,
    "box-on-two-wires": box_on_two_wires,
    "mass-on-spring": mass_on_spring,
    "pendulum": pendulum,
    "two-balls": two_balls,
    "stack-of-boxes": stack_of_boxes,
}
PROBLEMS: tuple[str, ...] = tuple(_DIAGRAMS)
"""The names of the six diagrams."""
ANSWERS: dict[str, tuple[str, ...]] = {
    "incline-and-ball": ("right", "low", "high"),
    "box-on-two-wires": tuple(TENSIONS),
    "mass-on-spring": ("right",),
    "pendulum": ("right",),
    "two-balls": ("right",),
    "stack-of-boxes": ("right",),
}
"""For each diagram the answers that a page can bear, the right one first."""

_ROW = 60.0
"""Height of a row in which people read from left to right, page units."""
_LABELS = tuple(label(rank) for rank in range(26))


def problem(name: str, answer: str, rng: np.random.Generator) -> Problem:
    """The diagram `name` of `PROBLEMS` with one of its `ANSWERS`, sized and placed by `rng`.

    Raises ValueError on a name or an answer that is not known.
    """
    if name not in PROBLEMS:
        raise ValueError(f"no problem is called {name!r}; there are {', '.join(PROBLEMS)}")
    if answer not in ANSWERS[name]:
        raise ValueError(f"{name} has no answer {answer!r}; it has {', '.join(ANSWERS[name])}")
    return in_reading_order(_DIAGRAMS[name](answer, rng))


def in_reading_order(drawn: Problem) -> Problem:
    """The same diagram with labels A, B … given out row by row from the top, each row from the left."""

    def place(component: Component) -> tuple[int, float]:
        x, y = np.mean(bounding_box(outline(component.shape)), axis=0)
        return (round(float(y) / _ROW), float(x))

    def named(end: str | None) -> str | None:
        return None if end is None else letter[end]

    ordered = sorted(drawn.components, key=place)
    letter = {part.label: label for part, label in zip(ordered, _LABELS, strict=False)}
    return replace(
        drawn,
        components=tuple(
            replace(part, label=letter[part.label], ends=(named(part.ends[0]), named(part.ends[1])))
            for part in ordered
        ),
        remarks=tuple(
            replace(remark, about=tuple((letter[name], spot) for name, spot in remark.about))
            for remark in drawn.remarks
        ),
        expected=Expected(
            {letter[name]: fates for name, fates in drawn.expected.fates.items()},
            frozenset(letter[name] for name in drawn.expected.breaks),
        ),
    )
