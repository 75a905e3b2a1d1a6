"""Hypothesis strategies for the page's values: any ink, any sketch, any formula tree.

pytest puts this folder on the path (`pythonpath` in pyproject.toml): `from strategies import inks`.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy
from hypothesis import strategies as st
from sympy.core.basic import Basic

from sketch.formula.build import Unbuildable, add, call, multiply, power, reciprocal
from sketch.formula.names import FUNCTIONS, GREEK

# Formulas ---------------------------------------------------------------------------------------

_letters = st.sampled_from([*"abcdefgGFTWkmrtvxye", *sorted(GREEK - {"pi"})])
_subscripts = st.sampled_from(["", "", "", "_1", "_12", "_x", "_Ax", "_net", "_theta", "_1x", "_x0"])
symbols = st.builds(lambda letter, below: sympy.Symbol(letter + below), _letters, _subscripts)
numbers = st.integers(0, 50).map(sympy.Integer) | st.fractions(0, 100, max_denominator=200).map(
    lambda value: sympy.Rational(value.numerator, value.denominator)
)


def _or_symbol(build: Callable[..., Basic]) -> Callable[..., Basic]:
    """The built tree, or a plain symbol for operands that do not go together (1/0, √−1)."""

    def built(*operands: Basic) -> Basic:
        try:
            return build(*operands)
        except Unbuildable:
            return sympy.Symbol("q")

    return built


def _composites(scalars: st.SearchStrategy[Basic]) -> st.SearchStrategy[Basic]:
    names = st.sampled_from(sorted(FUNCTIONS))
    minus = sympy.S.NegativeOne
    return st.one_of(
        st.builds(_or_symbol(lambda *terms: add(terms)), scalars, scalars),
        st.builds(_or_symbol(lambda a, b, c: add([a, multiply([minus, b]), c])), scalars, scalars, scalars),
        st.builds(_or_symbol(lambda *factors: multiply(factors)), scalars, scalars, scalars),
        st.builds(_or_symbol(lambda a, b: multiply([a, reciprocal(b)])), scalars, scalars),
        st.builds(_or_symbol(power), scalars, scalars),
        st.builds(_or_symbol(lambda base: power(base, sympy.Rational(1, 2))), scalars),
        st.builds(_or_symbol(lambda name, argument: call(name, argument)), names, scalars),
    )


scalars = st.recursive(symbols | numbers | st.just(sympy.pi), _composites, max_leaves=12)
vectors = st.lists(scalars, min_size=2, max_size=3).map(lambda components: sympy.Tuple(*components))
trees = st.one_of(
    scalars,
    vectors,
    st.builds(lambda left, right: sympy.Equality(left, right, evaluate=False), scalars, scalars | vectors),
)
"""Any tree that the formula language has."""
