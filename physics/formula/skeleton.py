"""A SymPy tree taken apart into operations, names and numbers: what a program is made of once its names are known.

A page is compiled anew whenever one of its formulas is edited; most of its trees are then the same as before, while what
their names stand for is not. Trees never change, so that what was once taken apart is remembered.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from physics.formula.operations import LOG_TO_BASE, UNARY, operated

Node = Any
"""A SymPy tree; SymPy has no types of its own."""

DEPTH = 200
"""Deepest nesting that is compiled, definitions included: far beyond handwriting, well within
Python's own recursion limit."""
TOO_DEEP = "a formula nested too deeply to be evaluated"
FUNCTIONS: dict[str, str] = {"Abs": "abs", "norm": "abs", "ln": "log"} | {name: name for name in UNARY}
"""SymPy's name of a function of one argument -> the operation. The length of a scalar is its size."""


@dataclass(frozen=True, slots=True)
class Constant:
    """Code that reads nothing."""

    code: tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True)
class Name:
    """What must be looked up."""

    name: str


@dataclass(frozen=True, slots=True)
class Refused:
    """What has no value, in words: said only when a program comes to it."""

    reason: str


@dataclass(frozen=True, slots=True)
class Operation:
    """One of `UNARY`, `BINARY` (from the left, of two or more) or `LOG_TO_BASE` on its parts."""

    operation: str
    parts: tuple[Part, ...]


Part = Constant | Name | Refused | Operation
"""A tree taken apart, all of it folded that does not depend on what names stand for."""


@lru_cache(maxsize=4096)
def part_of(tree: Node) -> Part:
    """The tree taken apart."""
    return _taken_apart(tree, 0)


def _taken_apart(tree: Node, depth: int) -> Part:
    # Here: what was compiled can be evaluated without SymPy, which takes half a second to import.
    import sympy

    if depth > DEPTH:
        return Refused(TOO_DEEP)
    if getattr(tree, "is_number", False) and not tree.args:
        return _number(tree)
    if isinstance(tree, sympy.Symbol):
        return Name(tree.name)
    if isinstance(tree, sympy.Add | sympy.Mul | sympy.Min | sympy.Max):
        operation = {"Add": "add", "Mul": "multiply", "Min": "min", "Max": "max"}[type(tree).__name__]
        return _combined(operation, tree.args, depth)
    if isinstance(tree, sympy.Pow):
        base, exponent = tree.args
        if exponent == sympy.Rational(1, 2):
            return _combined("sqrt", (base,), depth)
        if exponent == -1:
            return _combined("invert", (base,), depth)
        return _combined("power", tree.args, depth)
    name = type(tree).__name__
    if name == "atan2":
        return _combined("atan2", tree.args, depth)
    if name in FUNCTIONS and len(tree.args) == 1:
        return _combined(FUNCTIONS[name], tree.args, depth)
    if name == "log" and len(tree.args) == 2:
        return _combined(LOG_TO_BASE, tree.args, depth)
    return Refused(f"{tree} has no value that is a single number")


def _combined(operation: str, trees: Sequence[Node], depth: int) -> Part:
    parts = tuple(_taken_apart(tree, depth + 1) for tree in trees)
    codes = [list(part.code) for part in parts if isinstance(part, Constant)]
    if len(codes) == len(parts):
        return Constant(tuple(operated(operation, codes)))
    return Operation(operation, parts)


def _number(tree: Node) -> Part:
    try:
        value = float(tree)
    except (TypeError, ValueError, OverflowError):
        return Refused(f"{tree} is not a real number")
    return Constant((("push", value if math.isfinite(value) else math.nan),))
