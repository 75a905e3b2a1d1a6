"""Writing a formula and reading it back gives the same tree."""

from __future__ import annotations

import pytest
import sympy
from hypothesis import assume, given, settings
from strategies import trees
from sympy.core.basic import Basic

from sketch.formula.lexer import decimals
from sketch.formula.parse import LIMITS, parse
from sketch.formula.print import latex, plain


@settings(max_examples=100, deadline=None)
@given(trees)
def test_parse_is_inverse_to_plain(tree: Basic) -> None:
    text = plain(tree)
    assume(len(text) <= LIMITS.characters)
    assert parse(text) == tree
    assert text.isascii()


@settings(max_examples=100, deadline=None)
@given(trees)
def test_parse_is_inverse_to_latex(tree: Basic) -> None:
    text = latex(tree)
    assume(len(text) <= LIMITS.characters)
    assert parse(text) == tree


@pytest.mark.parametrize(
    ("text", "typed", "typeset"),
    [
        ("f_1 = |W| cos(theta)", "f_1 = |W|*cos(theta)", r"f_{1} = \left|W\right| \cos\left(\theta\right)"),
        ("theta = pi/6", "theta = pi/6", r"\theta = \frac{\pi}{6}"),
        ("T_1 = 5 sqrt(2)", "T_1 = 5*sqrt(2)", r"T_{1} = 5 \sqrt{2}"),
        ("y = 3t - 1/2 g t^2", "y = 3*t - g*t^2/2", r"y = 3 t - \frac{g t^{2}}{2}"),
        ("F = -G M m / r^2", "F = -G*M*m/r^2", r"F = -\frac{G M m}{r^{2}}"),
        ("f = (0, 5)", "f = (0, 5)", r"f = \left(0, 5\right)"),
        ("g = 9.81", "g = 9.81", "g = 9.81"),
        ("x = 1/8", "x = 1/8", r"x = \frac{1}{8}"),
        ("||a|-b|^2".replace("||a|-b|", "abs(|a|-b)"), "abs(|a| - b)^2", r"\abs\left(\left|a\right| - b\right)^{2}"),
        ("m = 5 kg", "m = 5 kg", r"m = 5\,\mathrm{kg}"),
        ("v = -36 km/h", "v = -36 km/h", r"v = -36\,\mathrm{km/h}"),
        ("F = 5m", "F = 5*m", "F = 5m"),
        ("theta = 30°", "theta = 30 deg", r"\theta = 30^{\circ}"),
        ("T = 5 sqrt(2) N", "T = 5*sqrt(2) N", r"T = 5 \sqrt{2}\,\mathrm{N}"),
        ("x = 3 m/s t", "x = (3 m/s)*t", r"x = \left(3\,\mathrm{m/s}\right) t"),
        ("ΣF = m a", "sum(F) = a*m", r"\sum F = a m"),
        ("v_1' = 2", "v_1' = 2", "v_{1}' = 2"),
        ("(e)^2 e^t", "(e)^2*exp(t)", r"\left(e\right)^{2} \exp\left(t\right)"),
    ],
)  # fmt: skip
def test_formulas_look_as_a_person_writes_them(text: str, typed: str, typeset: str) -> None:
    assert plain(parse(text)) == typed
    assert latex(parse(text)) == typeset


def test_what_is_no_formula_is_not_written() -> None:
    with pytest.raises(ValueError, match="not part of the formula language"):
        plain(sympy.Matrix([[1]]))
    with pytest.raises(ValueError, match="not part of the formula language"):
        latex(sympy.zoo)


@pytest.mark.parametrize(
    ("text", "typed", "typeset"),
    [
        ("mu = 0.5", "mu = 0.5", r"\mu = 0.5"),
        ("theta = 0.25 rad", "theta = 0.25 rad", r"\theta = 0.25\,\mathrm{rad}"),
        ("E = .5 m v^2", "E = 0.5*m*v^2", "E = 0.5m v^{2}"),
        ("x = -1.5 + y^0.5", "x = y^0.5 - 1.5", "x = y^{0.5} - 1.5"),
        ("f = (0.5, 1/2)", "f = (0.5, 0.5)", r"f = \left(0.5, 0.5\right)"),
        ("E = 1/2 m v^2", "E = m*v^2/2", r"E = \frac{m v^{2}}{2}"),
    ],
)
def test_what_was_written_as_a_decimal_is_shown_as_one_and_is_the_same_number(
    text: str, typed: str, typeset: str
) -> None:
    tree, written = parse(text), decimals(text)
    assert plain(tree, written) == typed
    assert latex(tree, written) == typeset
    assert parse(typed) == tree
