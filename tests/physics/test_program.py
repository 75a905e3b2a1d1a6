"""The postfix programs against SymPy, and what they must never do."""

from __future__ import annotations

import math

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from physics.formula.program import STATE, Program, ProgramError, compile_tree
from sketch.formula.parse import parse

T, X, V = sympy.Symbol("t"), sympy.Symbol("x"), sympy.Symbol("v_x")
A, B = sympy.Symbol("a"), sympy.Symbol("b")
GIVEN = {"a": 1.3, "b": -0.7}
LEAVES = st.sampled_from([T, X, V, A, B, sympy.pi, sympy.Integer(2), sympy.Rational(-3, 4), sympy.Float(0.3)])


def _grown(inner: st.SearchStrategy[sympy.Basic]) -> st.SearchStrategy[sympy.Basic]:
    one = st.sampled_from(
        [sympy.sin, sympy.cos, sympy.tan, sympy.exp, sympy.Abs, sympy.sqrt, sympy.log, sympy.atan, sympy.asin]
    )
    return st.one_of(
        st.builds(lambda f, a: f(a), one, inner),
        st.builds(lambda a, b: a + b, inner, inner),
        st.builds(lambda a, b: a * b, inner, inner),
        st.builds(lambda a, b: a / b, inner, inner),
        st.builds(lambda a, n: a**n, inner, st.integers(-3, 3)),
    )


TREES = st.recursive(LEAVES, _grown, max_leaves=8)


def lookup(name: str) -> float | None:
    return GIVEN.get(name)


def state(t: float, x: float, v: float) -> list[float]:
    values = dict.fromkeys(STATE, 0.0) | {"t": t, "x": x, "v_x": v}
    return [values[name] for name in STATE]


@settings(max_examples=200, deadline=None)
@given(TREES, st.floats(-2, 2), st.floats(-2, 2), st.floats(-2, 2))
def test_a_program_has_the_value_that_sympy_gives_its_tree(
    tree: sympy.Basic, t: float, x: float, v: float
) -> None:
    try:
        program = compile_tree(tree, lookup)
    except ProgramError:
        return
    found = program.value(state(t, x, v))
    assert isinstance(found, float)
    assert not math.isinf(found)
    wanted = sympy.N(tree.subs({T: t, X: x, V: v, A: GIVEN["a"], B: GIVEN["b"]}), 30)
    if math.isnan(found) or not wanted.is_real or not wanted.is_finite:
        return
    assert found == pytest.approx(float(wanted), rel=1e-6, abs=1e-9)


@pytest.mark.parametrize(
    "text",
    [
        "x/x",
        "1/x",
        "sqrt(-1 - x)",
        "log(x)",
        "exp(1000 + x)",
        "10^(400 + x)",
        "asin(2 + x)",
        "(-1 + x)^(1/2)",
    ],
)
def test_what_has_no_value_is_not_a_number_and_never_an_exception(text: str) -> None:
    tree = parse(f"f = {text}").args[1]
    found = compile_tree(tree, lookup).value(state(0.0, 0.0, 0.0))
    # SymPy itself cancels x/x to 1 while the tree is built.
    assert math.isnan(found) or text == "x/x"


def test_constants_are_folded_to_a_single_number() -> None:
    tree = parse("f_1 = 0.9 |W| cos(theta)").args[1]
    program = compile_tree(tree, {"W": 19.62, "theta": sympy.pi / 6}.get)
    assert program.code == (("push", pytest.approx(0.9 * 19.62 * math.cos(math.pi / 6), rel=1e-15)),)
    assert program.constant


def test_names_that_nobody_gives_count_as_zero_and_are_listed() -> None:
    program = compile_tree(parse("f = k x + mu").args[1], lambda _: None)
    assert program.unspecified == ("k", "mu") or program.unspecified == ("mu", "k")
    assert program.value(state(1.0, 5.0, 0.0)) == 0.0
    assert not program.constant


def test_definitions_are_followed_through_definitions() -> None:
    names = {"f": parse("f = 2 h").args[1], "h": parse("h = t + a").args[1], "a": 3.0}
    assert compile_tree(sympy.Symbol("f"), names.get).value(state(4.0, 0, 0)) == 14.0


def test_a_definition_that_goes_round_in_a_circle_is_refused() -> None:
    names = {"a": sympy.Symbol("b") + 1, "b": sympy.Symbol("a") * 2}
    with pytest.raises(ProgramError, match="defined by itself"):
        compile_tree(sympy.Symbol("a"), names.get)


def test_what_is_no_number_is_refused() -> None:
    for tree in (sympy.Tuple(1, 2), sympy.true, sympy.Function("h")(T), sympy.I):
        with pytest.raises(ProgramError):
            compile_tree(tree, lambda _: None)


def test_a_program_is_a_value_that_can_be_written_by_hand() -> None:
    program = Program("t + 1", (("read", 0.0), ("push", 1.0), ("add", 0.0)))
    assert program.value([2.0]) == 3.0
