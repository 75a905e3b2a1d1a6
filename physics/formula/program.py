"""Formulas compiled to a small postfix program over plain floats.

A SymPy tree becomes a tuple of instructions for a stack machine. Nothing is ever handed to
Python's evaluator, compiling takes microseconds, and whatever is constant is folded while
compiling. Evaluating never raises: 0/0, an overflow or a root of a negative number gives
NaN, which the caller must look for.

Names are SI quantities of one body: see `STATE`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import assert_never

from physics.formula.operations import BINARY as BINARY
from physics.formula.operations import UNARY as UNARY
from physics.formula.operations import Code as Code
from physics.formula.operations import evaluated, operated
from physics.formula.skeleton import DEPTH as DEPTH
from physics.formula.skeleton import TOO_DEEP, Constant, Name, Operation, Part, Refused, part_of
from physics.formula.skeleton import Node as Node

STATE: tuple[str, ...] = ("t", "x", "y", "phi", "v_x", "v_y", "v", "omega")
"""What a program may read at every step: time (s), centre of mass (m) and angle (rad), velocity
(m/s), speed (m/s), angular velocity (rad/s)."""

Lookup = Callable[[str], "Node | float | Reading | None"]
"""What a name stands for: a number, another tree, a quantity of another body's motion, or None when
nobody says."""


class ProgramError(ValueError):
    """A tree that no program can be made of: it says which part, and why."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What a body (label) has at the moment: one of `STATE`. Raises ProgramError for anything else."""

    quantity: str
    body: str

    def __post_init__(self) -> None:
        if self.quantity not in STATE:
            raise ProgramError(f"{self.quantity} is not read from a motion; {', '.join(STATE)} are")


@dataclass(frozen=True, slots=True)
class Program:
    """text: the formula as its reader knows it; code: (operation, operand) in postfix order;
    unspecified: names that nobody gave a value, and that count as zero; others: labels of further
    bodies that it reads.

    Operand k of a read is quantity k of its own body's `STATE`; k + j len(STATE) that of others[j - 1].
    """

    text: str
    code: tuple[tuple[str, float], ...]
    unspecified: tuple[str, ...] = ()
    others: tuple[str, ...] = ()

    @property
    def constant(self) -> bool:
        """Whether the program reads nothing of the motion."""
        return all(operation != "read" for operation, _ in self.code)

    def value(self, state: Sequence[float]) -> float:
        """The formula's value; NaN where it, or any part of it, has none. state: values of `STATE`, in
        that order, of its own body and then of each of `others`."""
        return evaluated(self.code, state)


def constant(value: float, text: str | None = None) -> Program:
    """The program that is always this number."""
    return Program(f"{value:g}" if text is None else text, (("push", float(value)),))


def compile_tree(tree: Node, lookup: Lookup, text: str | None = None) -> Program:
    """The program of a scalar SymPy tree.

    Names of `STATE` are read from the motion unless `lookup` says something else of them; others
    are replaced by what `lookup` gives, through any number of definitions; None counts as zero and is
    listed in `unspecified`; a `Reading` is read from the motion of the body that it names. Raises
    ProgramError for a tree with parts that have no scalar value, or whose definitions go round in a circle.
    """
    names = _Names(lookup, {}, {})
    code = _emit_tree(tree, names, (), 0)
    return Program(
        str(tree) if text is None else text, tuple(code), tuple(names.unspecified), tuple(names.others)
    )


@dataclass(frozen=True, slots=True)
class _Names:
    """What names stand for, and those found so far that nobody explains, or that are other bodies'; the
    dictionaries serve as sets that keep their order."""

    lookup: Lookup
    unspecified: dict[str, None]
    others: dict[str, None]

    def read(self, reading: Reading) -> Code:
        self.others.setdefault(reading.body)
        place = 1 + list(self.others).index(reading.body)
        return [("read", float(STATE.index(reading.quantity) + place * len(STATE)))]


def _emit_tree(tree: Node, names: _Names, within: tuple[str, ...], depth: int) -> Code:
    if isinstance(tree, float):
        return [("push", tree if math.isfinite(tree) else math.nan)]
    return _emit(part_of(tree), names, within, depth)


def _emit(part: Part, names: _Names, within: tuple[str, ...], depth: int) -> Code:
    """The code of a part, with what its names stand for. within: the names that are being defined."""
    if depth > DEPTH:
        raise ProgramError(TOO_DEEP)
    match part:
        case Constant(code):
            return list(code)
        case Name(name):
            return _defined(name, names, within, depth)
        case Refused(reason):
            raise ProgramError(reason)
        case Operation(operation, parts):
            return operated(operation, [_emit(one, names, within, depth + 1) for one in parts])
        case _:
            assert_never(part)


def _defined(name: str, names: _Names, within: tuple[str, ...], depth: int) -> Code:
    if name in within:
        raise ProgramError(f"{name} is defined by itself")
    meaning = names.lookup(name)
    if meaning is None and name in STATE:
        return [("read", float(STATE.index(name)))]
    if meaning is None:
        names.unspecified.setdefault(name)
        return [("push", 0.0)]
    if isinstance(meaning, Reading):
        return names.read(meaning)
    return _emit_tree(meaning, names, (*within, name), depth + 1)
