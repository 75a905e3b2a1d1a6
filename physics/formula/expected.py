"""What a physics page speaks for, when its handwriting can be read in several ways.

A prior for the reader of handwriting: the logarithm of how much less a reading is expected than a formula of
quantities that pages have. It weighs readings and forbids none.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy

from physics.formula.quantities import quantities_named
from sketch.formula.lexer import FormulaError
from sketch.formula.parse import parse
from sketch.writing.rows import Row, formula


@dataclass(frozen=True, slots=True)
class Expectation:
    """Natural logarithms taken off."""

    senseless: float = 2.5
    """For what is no formula."""
    incomplete: float = 0.7
    """For a formula that equates nothing."""
    unnamed: float = 1.0
    """For an equation whose left side is not a single name."""
    unknown: float = 0.4
    """For each name that no component has a quantity of."""


EXPECTATION = Expectation()


def expected(row: Row, rule: Expectation = EXPECTATION) -> float:
    """0 for an equation that gives a quantity of the page, less for anything else."""
    try:
        tree = parse(formula(row))
    except FormulaError:
        return -rule.senseless
    names = {symbol.name for symbol in tree.free_symbols if isinstance(symbol, sympy.Symbol)}
    off = rule.unknown * sum(not quantities_named(name) for name in names)
    if not isinstance(tree, sympy.Equality):
        off += rule.incomplete
    elif not isinstance(tree.lhs, sympy.Symbol):
        off += rule.unnamed
    return -off
