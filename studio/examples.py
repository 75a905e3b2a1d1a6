"""Ten pages that come with the studio, drawn by simulated people.

    python -m studio.examples     remakes studio/pages/ from their seeds

Ink is rounded as a digitizer rounds it: to a tenth of a page unit and a millisecond.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from sketch.files import document
from sketch.ink import Ink, Stroke
from sketch.page import Sketch
from studio.limits import Refused

FOLDER = Path(__file__).parent / "pages"


@dataclass(frozen=True, slots=True)
class Example:
    """problem, answer: of `data_gen.problems`; where answer is None, "family: problem" of `data_gen.textbook`."""

    name: str
    title: str
    about: str
    problem: str
    answer: str | None
    seed: int = 7


EXAMPLES: tuple[Example, ...] = (
    Example("incline", "Ball on an incline", "The right normal force rolls it down: its speed is a straight line.", "incline-and-ball", "right"),
    Example("incline-low", "Ball on an incline, force too small", "It sinks in and bounces.", "incline-and-ball", "low"),
    Example("incline-high", "Ball on an incline, force too great", "It flies off.", "incline-and-ball", "high"),
    Example("wires", "Box on two wires", "The right tensions hold it where it is.", "box-on-two-wires", "right"),
    Example("wires-low", "Box on two wires, wrong tension", "It moves, and a wire breaks.", "box-on-two-wires", "low-left"),
    Example("spring", "Mass on a spring", "Simple harmonic motion.", "mass-on-spring", "right"),
    Example("pendulum", "Pendulum", "It swings as far as it was held aside.", "pendulum", "right"),
    Example("balls", "Two balls meet", "Momentum goes from one to the other.", "two-balls", "right"),
    Example("stack", "Stack of boxes", "It stays.", "stack-of-boxes", "right"),
    Example("atwood", "Two weights over a pulley", "The heavier one goes down; its acceleration is an answer.", "atwood: acceleration", None),
)  # fmt: skip


def example(name: str) -> tuple[Sketch, str]:
    """The page, and what it is called. Raises Refused for a name that is none."""
    for one in EXAMPLES:
        if one.name == name:
            return document.read(FOLDER / f"{name}.inklined"), one.title
    raise Refused(f"there is no example {name[:40]!r}; there are {', '.join(one.name for one in EXAMPLES)}")


def rounded(sketch: Sketch) -> Sketch:
    """The page with ink as a digitizer gives it."""
    return replace(
        sketch,
        ink=Ink(
            tuple(
                Stroke(
                    np.round(stroke.points, 1),
                    None if stroke.times is None else np.round(stroke.times, 3),
                    None if stroke.pressure is None else np.round(stroke.pressure, 2),
                )
                for stroke in sketch.ink
            )
        ),
    )


def drawn(one: Example) -> Sketch:
    """The example as its simulated person draws it."""
    from data_gen.pages import page
    from evaluation.textbook_pens import penned

    if one.answer is not None:
        return rounded(page(one.problem, one.seed, 0, one.answer).truth)
    family, _, name = one.problem.partition(": ")
    return rounded(penned((family, name), one.seed, 0).truth)


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for each in EXAMPLES:
        document.write(FOLDER / f"{each.name}.inklined", drawn(each))
