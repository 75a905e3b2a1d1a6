"""SymPy trees from operands, within limits, so that no text can make SymPy work for long.

Arithmetic is SymPy's own (x + x is 2·x, 6/4 is 3/2); functions are left as written (cos(π/6)
stays). Vectors are Tuples: they add, and are multiplied by scalars, component by component.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy
from sympy.core.basic import Basic

from sketch.formula.names import FUNCTIONS, RECIPROCALS


class Unbuildable(ValueError):
    """Operands that do not go together; the message says why in one sentence."""


@dataclass(frozen=True, slots=True)
class BuildLimits:
    bits: int = 1024
    """Largest numerator or denominator: beyond it no float64 holds the number."""
    logarithm_bits: int = 10
    """The same for numbers beside a logarithm inside exp: SymPy turns exp(n·ln 3) into 3ⁿ in a product."""


LIMITS = BuildLimits()

_NOT_REAL: frozenset[Basic] = frozenset([sympy.zoo, sympy.nan, sympy.oo, -sympy.oo, sympy.I])


def add(terms: Sequence[Basic]) -> Basic:
    """The sum. Raises Unbuildable when scalars and vectors, or vectors of unequal length, are mixed."""
    scalars = [term for term in terms if isinstance(term, sympy.Expr)]
    vectors = [term for term in terms if isinstance(term, sympy.Tuple)]
    if not vectors:
        return _settled(sympy.Add(*scalars))
    if scalars:
        raise Unbuildable("a vector and a scalar cannot be added; give both the same number of components")
    if len({len(vector) for vector in vectors}) > 1:
        raise Unbuildable("vectors of different length cannot be added")
    return sympy.Tuple(*(add(column) for column in zip(*vectors, strict=True)))


def multiply(factors: Sequence[Basic]) -> Basic:
    """The product. Raises Unbuildable when two factors are vectors."""
    scalars = [factor for factor in factors if isinstance(factor, sympy.Expr)]
    vectors = [factor for factor in factors if isinstance(factor, sympy.Tuple)]
    if not vectors:
        return _settled(sympy.Mul(*scalars))
    if len(vectors) > 1:
        raise Unbuildable("two vectors cannot be multiplied; write the product of their components")
    return sympy.Tuple(*(multiply([*scalars, component]) for component in vectors[0]))


def reciprocal(operand: Basic) -> Basic:
    """1/operand. Raises Unbuildable for a vector or zero."""
    if operand == 0:
        raise Unbuildable("division by zero")
    return power(operand, sympy.Integer(-1))


def power(base: Basic, exponent: Basic) -> Basic:
    """base^exponent. Raises Unbuildable for vectors, for numbers beyond the limits and for powers that
    are no real number."""
    if not isinstance(base, sympy.Expr) or not isinstance(exponent, sympy.Expr):
        raise Unbuildable("a vector has no power; write ‖x‖^2 for the square of its length")
    if isinstance(exponent, sympy.Rational):
        if _bits(base) * max(1, abs(int(exponent.p)) // int(exponent.q)) > LIMITS.bits:
            raise Unbuildable(f"the power is too large a number; at most {LIMITS.bits} bits are held")
        if exponent.q > 1 and base.is_negative:
            raise Unbuildable("a negative number has no real root")
    return _settled(sympy.Pow(base, exponent))


def call(name: str, argument: Basic) -> Basic:
    """The function of that canonical name, not evaluated. |(3, 4)| is the vector's norm.

    Raises Unbuildable when a scalar function is given a vector.
    """
    if isinstance(argument, sympy.Tuple):
        if name not in ("abs", "norm"):
            raise Unbuildable(f"{name} takes a scalar, not a vector")
        name = "norm"
    if name in RECIPROCALS:
        return reciprocal(call(RECIPROCALS[name], argument))
    if name == "exp":
        return _exponential(argument)
    return FUNCTIONS[name](argument, evaluate=False)


def _exponential(argument: Basic) -> Basic:
    """e^argument; e^0 and e^1 are what SymPy makes of them inside a product."""
    if argument == 0 or argument == 1:
        return sympy.exp(argument)
    if argument.has(sympy.log) and _bits(argument) > LIMITS.logarithm_bits:
        raise Unbuildable("an exponential of a logarithm with so large a number; write it as a power")
    return sympy.exp(argument, evaluate=False)


def _bits(tree: Basic) -> int:
    """Bits of the largest numerator or denominator in the tree; 0 when it has no numbers but ±1."""
    numbers = tree.atoms(sympy.Rational)
    heights = (max(abs(int(number.p)), int(number.q)) for number in numbers)
    return max((height.bit_length() for height in heights if height > 1), default=0)


def _settled(tree: Basic) -> Basic:
    """The tree as SymPy leaves it: one pass may leave π·a·a² where the next makes it π·a³."""
    if not _NOT_REAL.isdisjoint(tree.atoms()):
        raise Unbuildable("the result is no real number")
    if _bits(tree) > LIMITS.bits:
        raise Unbuildable(f"a number is too large; at most {LIMITS.bits} bits are held")
    if isinstance(tree, sympy.Add | sympy.Mul):
        again = tree.func(*tree.args)
        return tree if again == tree else _settled(again)
    return tree
