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
from functools import lru_cache
from typing import Any, assert_never

STATE: tuple[str, ...] = ("t", "x", "y", "phi", "v_x", "v_y", "v", "omega")
"""What a program may read at every step: time (s), centre of mass (m) and angle (rad), velocity
(m/s), speed (m/s), angular velocity (rad/s)."""

Node = Any
"""A SymPy tree; SymPy has no types of its own."""

Lookup = Callable[[str], "Node | float | Reading | None"]
"""What a name stands for: a number, another tree, a quantity of another body's motion, or None when
nobody says."""

DEPTH = 200
"""Deepest nesting that is compiled, definitions included: far beyond handwriting, well within
Python's own recursion limit."""
TOO_DEEP = "a formula nested too deeply to be evaluated"


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
        try:
            stack: list[float] = []
            for operation, operand in self.code:
                if operation == "push":
                    stack.append(operand)
                elif operation == "read":
                    stack.append(state[int(operand)])
                elif operation in BINARY:
                    right = stack.pop()
                    stack[-1] = BINARY[operation](stack[-1], right)
                else:
                    stack[-1] = UNARY[operation](stack[-1])
                if not math.isfinite(stack[-1]):
                    return math.nan
        except (ArithmeticError, ValueError):
            return math.nan
        return stack[-1]


def constant(value: float, text: str | None = None) -> Program:
    """The program that is always this number."""
    return Program(f"{value:g}" if text is None else text, (("push", float(value)),))


def compile_tree(tree: Node, lookup: Lookup, text: str | None = None) -> Program:
    """The program of a scalar SymPy tree.

    Names of `STATE` are read from the motion unless `lookup` says something else of them; others
    are replaced by what `lookup` gives, through any number of definitions; None counts as zero and is
    listed in `unspecified`; a `Reading` is read from the motion of the body that it names. Raises ProgramError for a tree with parts that have no scalar value, or
    whose definitions go round in a circle.
    """
    names = _Names(lookup, {}, {})
    code = _emit_tree(tree, names, (), 0)
    return Program(
        str(tree) if text is None else text, tuple(code), tuple(names.unspecified), tuple(names.others)
    )


def _power(base: float, exponent: float) -> float:
    if exponent == 2:
        return base * base
    result = base**exponent
    return result if isinstance(result, float) else math.nan


BINARY: dict[str, Callable[[float, float], float]] = {
    "add": lambda a, b: a + b,
    "multiply": lambda a, b: a * b,
    "power": _power,
    "atan2": math.atan2,
    "min": min,
    "max": max,
}
UNARY: dict[str, Callable[[float], float]] = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "cot": lambda a: 1 / math.tan(a),
    "sec": lambda a: 1 / math.cos(a),
    "csc": lambda a: 1 / math.sin(a),
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "sinh": math.sinh,
    "cosh": math.cosh,
    "tanh": math.tanh,
    "exp": math.exp,
    "log": math.log,
    "sqrt": math.sqrt,
    "invert": lambda a: 1 / a,
    "abs": abs,
    "sign": lambda a: math.copysign(1.0, a) if a else 0.0,
    "floor": lambda a: float(math.floor(a)),
    "ceiling": lambda a: float(math.ceil(a)),
}
LOG_TO_BASE = "log to base"
"""Of two: the logarithm of the first to the base that is the second."""
FUNCTIONS: dict[str, str] = {"Abs": "abs", "norm": "abs", "ln": "log"} | {name: name for name in UNARY}
"""SymPy's name of a function of one argument -> the operation. The length of a scalar is its size."""

Code = list[tuple[str, float]]


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
        return [("push", _number(tree))]
    return _emit(_part_of(tree), names, within, depth)


def _emit(part: _Part, names: _Names, within: tuple[str, ...], depth: int) -> Code:
    """The code of a part, with what its names stand for. within: the names that are being defined."""
    if depth > DEPTH:
        raise ProgramError(TOO_DEEP)
    match part:
        case _Constant(code):
            return list(code)
        case _Name(name):
            return _defined(name, names, within, depth)
        case _Refused(reason):
            raise ProgramError(reason)
        case _Operation(operation, parts):
            return _operated(operation, [_emit(one, names, within, depth + 1) for one in parts])
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


@dataclass(frozen=True, slots=True)
class _Constant:
    """Code that reads nothing."""

    code: tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True)
class _Name:
    name: str


@dataclass(frozen=True, slots=True)
class _Refused:
    """What has no value, in words: said only when a program comes to it."""

    reason: str


@dataclass(frozen=True, slots=True)
class _Operation:
    operation: str
    parts: tuple[_Part, ...]


_Part = _Constant | _Name | _Refused | _Operation
"""A tree taken apart, all of it folded that does not depend on what names stand for."""


@lru_cache(maxsize=4096)
def _part_of(tree: Node) -> _Part:
    """Trees never change, and a page is compiled anew whenever one of its formulas is edited: taking a tree
    apart costs more than all that follows."""
    return _taken_apart(tree, 0)


def _taken_apart(tree: Node, depth: int) -> _Part:
    # Here: what was compiled can be evaluated without SymPy, which takes half a second to import.
    import sympy

    if depth > DEPTH:
        return _Refused(TOO_DEEP)
    if getattr(tree, "is_number", False) and not tree.args:
        try:
            return _Constant((("push", _number(tree)),))
        except ProgramError as error:
            return _Refused(str(error))
    if isinstance(tree, sympy.Symbol):
        return _Name(tree.name)
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
    return _Refused(f"{tree} has no value that is a single number")


def _combined(operation: str, trees: Sequence[Node], depth: int) -> _Part:
    parts = tuple(_taken_apart(tree, depth + 1) for tree in trees)
    codes = [list(part.code) for part in parts if isinstance(part, _Constant)]
    if len(codes) == len(parts):
        return _Constant(tuple(_operated(operation, codes)))
    return _Operation(operation, parts)


def _operated(operation: str, parts: list[Code]) -> Code:
    """The code of an operation on what these codes give, folded where that is a number."""
    if operation == LOG_TO_BASE:
        number, base = (_apply("log", part) for part in parts)
        return _fold("multiply", [number, _apply("invert", base)])
    return _apply(operation, parts[0]) if operation in UNARY else _fold(operation, parts)


def _fold(operation: str, parts: list[Code]) -> Code:
    code = parts[0]
    for part in parts[1:]:
        joined: Code = [*code, *part, (operation, 0.0)]
        code = _folded(joined) if len(code) == len(part) == 1 else joined
    return code


def _apply(operation: str, inside: Code) -> Code:
    joined: Code = [*inside, (operation, 0.0)]
    return _folded(joined) if len(inside) == 1 else joined


def _folded(code: Code) -> Code:
    """One number instead of the code, where it reads nothing and has a value."""
    if any(operation == "read" for operation, _ in code):
        return code
    value = Program("", tuple(code)).value(())
    return code if math.isnan(value) else [("push", value)]


def _number(tree: Node) -> float:
    try:
        value = float(tree)
    except (TypeError, ValueError, OverflowError):
        raise ProgramError(f"{tree} is not a real number") from None
    return value if math.isfinite(value) else math.nan
