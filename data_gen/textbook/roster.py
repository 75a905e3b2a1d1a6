"""All textbook problems: ten families, each problem drawn anew from a random generator.

made = exercise("incline", "acceleration", np.random.default_rng([seed, draw]))
page = meaning(in_reading_order(made.answered(made.answers[0])))
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from data_gen.textbook import (
    atwood,
    circular,
    collisions,
    energy,
    equilibrium,
    incline,
    orbit,
    pendulum,
    projectile,
    springs,
)
from data_gen.textbook.exercise import RULE, Exercise

FAMILIES: Mapping[str, Mapping[str, Callable[[np.random.Generator], Exercise]]] = {
    "projectile": projectile.PROBLEMS,
    "incline": incline.PROBLEMS,
    "equilibrium": equilibrium.PROBLEMS,
    "springs": springs.PROBLEMS,
    "pendulum": pendulum.PROBLEMS,
    "atwood": atwood.PROBLEMS,
    "collisions": collisions.PROBLEMS,
    "circular motion": circular.PROBLEMS,
    "energy": energy.PROBLEMS,
    "orbit": orbit.PROBLEMS,
}
"""Family -> what is asked -> the maker of the problem."""
TRIES = 100
"""Draws after which a problem is taken to have no numbers that tell its answers apart."""


def names() -> Iterator[tuple[str, str]]:
    """(family, name) of every problem."""
    for family, problems in FAMILIES.items():
        for name in problems:
            yield family, name


def exercise(family: str, name: str, rng: np.random.Generator) -> Exercise:
    """The problem drawn anew, with at least three wrong answers that are wrong with its numbers.

    Raises ValueError on a name that is not known.
    """
    if family not in FAMILIES:
        raise ValueError(f"no family is called {family!r}; there are {', '.join(FAMILIES)}")
    if name not in FAMILIES[family]:
        raise ValueError(f"{family} has no problem {name!r}; it has {', '.join(FAMILIES[family])}")
    for _ in range(TRIES):
        made = FAMILIES[family][name](rng)
        if len(made.answers) > RULE.wrong:
            return replace(made, name=f"{family}: {name}")
    raise AssertionError(f"{family}: {name} has never {RULE.wrong} wrong answers in {TRIES} draws")
