"""How a person writes mathematics: proportions and habits, and the ranges that they are drawn from.

Lengths are in heights of a capital.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from data_gen.writers import Writer
from data_gen.writing.form import RULE as FORM
from data_gen.writing.form import FormRule

Range = tuple[float, float]


@dataclass(frozen=True, slots=True)
class TypeRule:
    """Ranges of writers' habits (uniform), and how far a sign strays from them (standard deviations).
    Lengths are in heights of a capital."""

    x_height: Range = (0.48, 0.9)
    descent: Range = (0.25, 0.5)
    digit: Range = (0.8, 1.05)
    axis: Range = (0.3, 0.5)
    gap: Range = (0.05, 0.38)
    space: Range = (0.0, 0.35)
    """What is left beside signs of operation and relation beyond the gap."""
    script: Range = (0.45, 0.9)
    drop: Range = (0.05, 0.5)
    """How far the baseline of a subscript lies below its base's."""
    rise: Range = (0.4, 0.95)
    """How high the baseline of an exponent lies, of the base's height."""
    bar_gap: Range = (0.08, 0.35)
    overhang: Range = (0.0, 0.35)
    stacked_size: Range = (0.7, 1.0)
    larger: Range = (1.0, 3.0)
    """Size of letters against those beside a diagram: devices for mathematics alone are larger or finer."""
    slope: float = 0.025
    """Of the baseline."""
    drift: float = 0.04
    """Amplitude of a slow wave of the baseline."""
    uneven: Range = (0.02, 0.14)
    """Of the logarithm of a sign's size."""
    loose: float = 0.35
    """Relative, of gaps."""
    jump: Range = (0.01, 0.08)
    """Of a sign's baseline."""
    turn: float = 0.05
    """Radians."""
    lean: float = 0.1
    """Shear of a single sign beyond the writer's slant."""
    aspect: float = 0.16
    """Of the logarithm of a sign's width over its height."""
    bulge: float = 0.35
    """Of the logarithm of a bracket's width."""
    two_strokes: float = 0.25
    """Share of roots whose hook and bar are two strokes."""
    shift: float = 0.05
    """Of a stroke within its sign, of the sign's size."""
    ways: int = 99
    """Ways of a sign that people know at most: the first so many authored."""
    other_way: float = 0.12
    """Share of signs formed otherwise than is the writer's use."""
    swapped: float = 0.1
    """Share of writers who draw the strokes of a sign in another order."""
    backwards: float = 0.08
    """Share of writers who draw a straight stroke from its other end."""
    clockwise: float = 0.25
    """Share of writers who draw a loop the other way round than it was authored."""
    reversed: float = 0.02
    """Share of writers who draw any other stroke from its other end."""
    freedom: Range = (0.3, 1.5)
    """How far somebody's signs depart from how they were authored (`FormRule`)."""
    unlifted: float = 0.05
    """Share of signs whose strokes are run together."""
    joined: float = 0.4
    """Share of functions' names written without lifting the pen."""
    delayed: float = 0.12
    """Share of rows whose dots and bars are put when the row is done."""


RULE = TypeRule()


@dataclass(frozen=True, slots=True)
class Usual:
    """Somebody's way of a sign: which allograph, its strokes' order, which of them are drawn backwards, and the seed
    of what his differs in from the authored one."""

    way: int
    order: tuple[int, ...]
    turned: tuple[bool, ...]
    hand: int


@dataclass(frozen=True, slots=True)
class Habits:
    """One person's mathematics: the writer, his proportions, and the chance of the moment."""

    writer: Writer
    measures: dict[str, float]
    rng: np.random.Generator = field(repr=False)
    usual: dict[str, Usual] = field(default_factory=dict[str, "Usual"], repr=False)
    """How he forms the signs that he has written so far."""
    rule: TypeRule = RULE
    form: FormRule = FORM

    def __getitem__(self, name: str) -> float:
        return self.measures[name]

    def about(self, name: str) -> float:
        """A measure as it turns out this once."""
        return self.measures[name] * float(np.exp(0.5 * self.rule.loose * self.rng.standard_normal()))


def habits(writer: Writer, rng: np.random.Generator, rule: TypeRule = RULE, form: FormRule = FORM) -> Habits:
    """The mathematics of a writer."""
    ranged = ("x_height", "descent", "digit", "axis", "gap", "space", "script", "drop", "rise", "bar_gap",
              "overhang", "stacked_size", "uneven", "jump", "freedom")  # fmt: skip
    measures = {name: float(rng.uniform(*getattr(rule, name))) for name in ranged}
    measures["slope"] = float(rule.slope * rng.standard_normal())
    measures["bar_order"] = float(rng.random())
    measures["root_last"] = float(rng.random())
    larger = replace(writer, height=writer.height * float(rng.uniform(*rule.larger)))
    return Habits(larger, measures, rng, rule=rule, form=form)
