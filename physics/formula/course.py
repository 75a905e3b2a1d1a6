"""Equations of motion that a student gives in place of Newton's (row M7), differentiated.

A position is a function of time, x(t): its velocity is dx/dt and its acceleration d²x/dt². A velocity
may depend on time and on where the body is: its acceleration is the total derivative
∂v/∂t + v_x ∂v/∂x + v_y ∂v/∂y + ω ∂v/∂φ.

Names are replaced by what they stand for before anything is differentiated, so that no dependence
stays hidden behind one. What jumps (sign, floor, ceiling) has the derivative that it has beside its
jumps: zero; |u| has sign(u) u'.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import sympy

from physics.formula.program import (
    DEPTH,
    STATE,
    Lookup,
    Node,
    Program,
    ProgramError,
    Reading,
    compile_tree,
)
from physics.formula.skeleton import TOO_DEEP
from physics.scene import Course

RATES: dict[str, str | None] = {
    "t": None,  # its rate is 1
    "x": "v_x",
    "y": "v_y",
    "phi": "omega",
}
"""What a velocity may depend on -> the rate at which that changes."""

LONGEST, LONGEST_DERIVED = 100, 1000
"""Instructions of a formula, and of its first derivative, beyond which it is not differentiated: far
more than handwriting has. Derivatives grow with the square, and SymPy takes seconds there."""

LARGE = 1000
"""Whole numbers beyond this become floats: SymPy would work out their powers to the last digit."""


def course(
    name: str,
    body: str,
    axis: Literal["x", "y"],
    tree: Node,
    given: Literal["position", "velocity"],
    lookup: Lookup,
    text: str,
) -> Course:
    """The equation `tree` for one coordinate (m, or m/s) of a body's centre, with its derivatives.

    lookup: as for `compile_tree`; text: the formula as its reader knows it. Raises ProgramError, in
    words, for a position that depends on more than time, a velocity that depends on velocities, and
    whatever no program can be made of.
    """
    stated = compile_tree(tree, lookup, text)
    _check_length(stated, LONGEST)
    for quantity, spoken in _read_by(stated):
        if given == "position" and quantity != "t":
            raise ProgramError(f"a position may depend on the time t alone, not on {spoken}")
        if quantity not in RATES:
            raise ProgramError(f"a velocity may depend on time and place, not on {spoken}; a force may")
    names = _Names(lookup, {}, stated.unspecified)
    whole = _resolved(tree, names, ())
    reads = sorted(str(symbol) for symbol in whole.free_symbols)
    first = _rate(whole, reads, names)
    changing = names.program(first, f"d/dt ({text})")
    if given == "velocity":
        return Course(name, body, axis, None, stated, changing)
    _check_length(changing, LONGEST_DERIVED)
    second = _rate(first, reads, names)
    return Course(name, body, axis, stated, changing, names.program(second, f"d²/dt² ({text})"))


@dataclass(frozen=True, slots=True)
class _Names:
    """What names stand for: other bodies' quantities by a symbol's name, as far as found; names that
    nobody explains."""

    lookup: Lookup
    readings: dict[str, Reading]
    unspecified: tuple[str, ...]

    def quantity(self, symbol: str) -> str:
        return self.readings[symbol].quantity if symbol in self.readings else symbol

    def symbol(self, reading: Reading) -> Node:
        """Its name can be nobody's: no formula has brackets in a name."""
        name = f"{reading.quantity}[{reading.body}]"
        self.readings[name] = reading
        return _real(name)

    def rate(self, symbol: str) -> Node:
        """d(symbol)/dt."""
        rate = RATES[self.quantity(symbol)]
        if rate is None:
            return sympy.Integer(1)
        reading = self.readings.get(symbol)
        return _real(rate) if reading is None else self.symbol(Reading(rate, reading.body))

    def program(self, tree: Node, text: str) -> Program:
        made = compile_tree(_plain(tree), self.readings.get, text)
        return replace(made, unspecified=self.unspecified)


def _read_by(program: Program) -> list[tuple[str, str]]:
    """What a program reads of the motion: (quantity, the same in words)."""
    found: list[tuple[str, str]] = []
    for operation, operand in program.code:
        if operation == "read":
            body, index = divmod(int(operand), len(STATE))
            owner = f" of {program.others[body - 1]}" if body else ""
            found.append((STATE[index], STATE[index] + owner))
    return found


def _check_length(program: Program, longest: int) -> None:
    if len(program.code) > longest:
        raise ProgramError("a formula too long to be differentiated")


def _rate(tree: Node, reads: list[str], names: _Names) -> Node:
    """The total derivative by time of a tree that depends on `reads` alone."""
    parts = [sympy.diff(tree, _real(read)) * names.rate(read) for read in reads]
    return sympy.Add(*parts)


def _resolved(tree: Node, names: _Names, within: tuple[str, ...]) -> Node:
    """Every name replaced by what it stands for, until what the motion has is all that is left."""
    if len(within) > DEPTH:
        raise ProgramError(TOO_DEEP)
    if isinstance(tree, int | float):
        return _number(tree)
    if not isinstance(tree, sympy.Expr):
        raise ProgramError(f"{tree} has no value that is a single number")
    meanings = {symbol: _meaning(str(symbol), names, within) for symbol in tree.free_symbols}
    found = _smooth(tree).xreplace(meanings)
    return _number(int(found)) if found.is_Integer else found


def _meaning(name: str, names: _Names, within: tuple[str, ...]) -> Node:
    if name in within:
        raise ProgramError(f"{name} is defined by itself")
    meaning = names.lookup(name)
    if isinstance(meaning, Reading):
        return names.symbol(meaning)
    if meaning is not None:
        return _resolved(meaning, names, (*within, name))
    if name in STATE:
        return _real(name)
    return sympy.Integer(0)


def _number(value: float) -> Node:
    whole = float(value).is_integer() and abs(value) <= LARGE
    return sympy.Integer(int(value)) if whole else sympy.Float(float(value))


def _real(name: str) -> Node:
    return sympy.Symbol(name, real=True)


class _Size(sympy.Function):
    """|u|, of which SymPy knows nothing but its derivative: sign(u)."""

    def fdiff(self, argindex: int = 1) -> Node:
        del argindex
        return _Sign(self.args[0])


class _Jumping(sympy.Function):
    """What is constant but for its jumps."""

    def fdiff(self, argindex: int = 1) -> Node:
        del argindex
        return sympy.Integer(0)


class _Sign(_Jumping):
    """sign(u)."""


class _Floor(_Jumping):
    """floor(u)."""


class _Ceiling(_Jumping):
    """ceiling(u)."""


_STAND_INS: tuple[tuple[Node, Node], ...] = (
    (sympy.Function("norm"), _Size),
    (sympy.Abs, _Size),
    (sympy.sign, _Sign),
    (sympy.floor, _Floor),
    (sympy.ceiling, _Ceiling),
)


def _smooth(tree: Node) -> Node:
    """Functions that SymPy would differentiate by cases, or as distributions, as those above."""
    tree = tree.replace(sympy.Max, lambda *numbers: _extreme(numbers, 1))
    tree = tree.replace(sympy.Min, lambda *numbers: _extreme(numbers, -1))
    for function, stand_in in _STAND_INS:
        tree = tree.replace(function, stand_in)
    return tree


def _extreme(numbers: tuple[Node, ...], sense: int) -> Node:
    """max(a, b) = (a + b + |a − b|)/2; min with a minus."""
    first = numbers[0]
    for other in numbers[1:]:
        gap: Node = _Size(first - other)
        first = (first + other + sense * gap) / 2
    return first


def _plain(tree: Node) -> Node:
    """SymPy's own functions again. Unevaluated, or SymPy would take |exp(t)| for a complex number's."""
    for function, stand_in in _STAND_INS[1:]:
        tree = tree.replace(stand_in, lambda u, function=function: function(u, evaluate=False))
    return tree
