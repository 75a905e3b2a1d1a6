"""Dimensional analysis (row M9): what is consistent, what is not, and which term it is; units in SI."""

from __future__ import annotations

from fractions import Fraction

import pint
import pytest
from formula_pages import saying
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Rational, pi, sqrt

from physics.formula.dimensions import check
from physics.formula.meaning import read
from physics.formula.si import NUMBER, Dimension
from physics.formula.units import SIZES, factor
from sketch.formula.names import UNIT_NAMES


@pytest.mark.parametrize(
    ("text", "label"),
    [
        ("m = 5 kg", "B"),
        ("m = 5", "B"),
        ("f_1 = 5", "B"),
        ("f_1 = |W| cos(theta)", "B"),
        ("f = (0, 5)", "B"),
        ("f = (0, 5) N", "B"),
        ("F = (m g sin(theta), -k y)", "B"),
        ("y = 3t - 1/2 g t^2", "B"),
        ("y = 3 m/s t - 1/2 g t^2", "B"),
        ("x = 0.1 sin(2 t)", "B"),
        ("v_x = 2 t", "B"),
        ("f_1 = -mu v", "B"),
        ("f_2 = mu m g cos(theta)", "B"),
        ("E = 1/2 m v^2 + m g h", "B"),
        ("E = 1/2 k x^2", "E"),
        ("p = m v", "B"),
        ("tau = F d", "B"),
        ("T = 2 pi sqrt(m/k)", "B"),
        ("T = 2 pi sqrt(L/g)", "B"),
        ("a = v^2/r", "B"),
        ("F = -G M m/r^2", "B"),
        ("omega = sqrt(k/m)", "B"),
        ("v = 36 km/h", "B"),
        ("v_2 = v + 2", "B"),
        ("f_1 = 0.5 exp(-b t)", "B"),
        ("theta = 30°", "F"),
        ("alpha = 2 rad/s^2", "B"),
        ("W_1 = F d cos(theta)", "B"),
        ("P = F v", "B"),
        ("½mv² = mgh", "B"),
        ("T_1 sin(alpha) + T_2 sin(beta) = W", "B"),
        ("ΣF = m a", "B"),
        ("c = 3 kg/s", "B"),
        ("q = 5", "B"),
    ],
)
def test_what_is_right_passes(text: str, label: str) -> None:
    sketch = saying(("mu = 0.5", "B"), ("theta = pi/6", "F"), (text, label))
    assert check(sketch, read(sketch)) == ()


@pytest.mark.parametrize(
    ("text", "label", "left", "right", "term"),
    [
        ("v = g t^2", "B", "m/s", "m", "g*t^2"),
        ("E = 1/2 m v", "B", "J", "kg m/s", "m*v/2"),
        ("p = m v^2", "B", "kg m/s", "J", "m*v^2"),
        ("F = 5 m", "B", "N", "m", "5 m"),
        ("m = 3 s", "B", "kg", "s", "3 s"),
        ("F = m v", "B", "N", "kg m/s", "m*v"),
        ("F = m g + m v", "B", "N", "kg m/s", "m*v"),
        ("a = g + v", "B", "m/s²", "m/s", "v"),
        ("f_1 = m cos(theta)", "B", "N", "kg", "m*cos(theta)"),
        ("T = m", "D", "N", "kg", "m"),
        ("T = 2 pi sqrt(g/L)", "B", "s", "1/s", "2*pi*sqrt(g/L)"),
        ("k = 20 N", "E", "N/m", "N", "20 N"),
        ("x = sin(t)", "B", "m", "s", "t"),
        ("x = exp(v)", "B", "m", "m/s", "v"),
        ("y = 2^t", "B", "m", "s", "t"),
        ("y = h^t", "B", "m", "s", "t"),
        ("f_1 = (0, m)", "B", "N", "kg", "m"),
        ("theta = 3 m", "F", "1", "m", "3 m"),
        ("W = m", "B", "N", "kg", "m"),
        ("½mv = mgh", "B", "kg m/s", "J", "g*h*m"),
        ("v_2 = h + v", "B", "m/s", "m", "h"),
        ("mu = 3 N", "B", "1", "N", "3 N"),
    ],
)
def test_what_is_wrong_is_found_with_the_term_that_is(
    text: str, label: str, left: str, right: str, term: str
) -> None:
    sketch = saying(("g = 10 m/s^2", None), (text, label))
    (finding,) = check(sketch, read(sketch))
    assert finding.expression == 1
    assert finding.component == label
    assert (str(finding.left), str(finding.right), finding.term) == (left, right, term)
    assert text in finding.message


def test_a_name_of_the_students_own_has_the_dimension_of_its_value() -> None:
    sketch = saying(("c = 3 m", "B"), ("F = c", "B"))
    (finding,) = check(sketch, read(sketch))
    assert (finding.expression, str(finding.right)) == (1, "m")
    assert check(saying(("c = 3", "B"), ("F = c", "B")), read(saying(("c = 3", "B"), ("F = c", "B")))) == ()


@pytest.mark.parametrize(
    ("text", "label", "value", "says"),
    [
        ("v = 36 km/h", "B", 10, "36 km/h is 10 m/s"),
        ("m = 500 g", "B", Rational(1, 2), "500 gram is 0.5 kg"),
        ("theta = 30°", "F", pi / 6, "30 deg is 0.523599 rad"),
        ("theta = 30 deg", "F", pi / 6, "30 deg is 0.523599 rad"),
        ("omega = 60 rpm", "B", 2 * pi, "60 rpm is 6.28319 rad/s"),
        ("t = 2 h", "B", 7200, "2 hour is 7200 s"),
        ("h = 20 cm", "B", Rational(1, 5), "20 cm is 0.2 m"),
        ("k = 2 N/cm", "E", 200, "2 N/cm is 200 N/m"),
        ("F = 3 kN", "B", 3000, "3 kN is 3000 N"),
        ("T = 5 sqrt(2) N", "D", 5 * sqrt(2), None),
        ("m = 5 kg", "B", 5, None),
        ("m = 5", "B", 5, None),
        ("x = 1/2 m", "B", Rational(1, 2), None),
        ("v = 30 mph", "B", Rational(30 * 1609344, 3600000), "30 mph is 13.4112 m/s"),
    ],
)  # fmt: skip
def test_units_become_si_and_the_conversion_is_told(
    text: str, label: str, value: object, says: str | None
) -> None:
    (said,) = read(saying((text, label))).said
    assert said.tree == value
    assert said.converted == says


def test_letters_are_read_as_what_they_can_be_and_that_is_told() -> None:
    for text, label, told in (
        ("m_B = 2 m", "B", "2*m"),
        ("m = 500 g", "C", "gram"),
        ("a = 5 N/m", "B", "5*N/m"),
    ):
        sketch = saying((text, label))
        assert any(told in notice for notice in read(sketch).notices)
        assert check(sketch, read(sketch)) == ()
    assert any("newton" in notice for notice in read(saying(("f_1 = 0.3 N", "B"), ("N = 5", "B"))).notices)


def test_units_tell_which_of_two_quantities_a_name_is() -> None:
    for text, role in (
        ("alpha = 30°", "angle"),
        ("R = 2 m", "distance"),
        ("R = 2 N", "force"),
        ("W = 3 J", "work"),
    ):
        (said,) = read(saying((text, "C"))).said
        assert said.quantity is not None
        assert said.quantity.role == role


def test_every_unit_of_the_language_has_a_dimension_and_a_size() -> None:
    registry = pint.UnitRegistry()
    assert set(SIZES) == set(UNIT_NAMES)
    for name, size in SIZES.items():
        there = registry.Quantity(
            1.0,
            {"mph": "mile/hour", "h": "hour", "deg": "degree", "lbf": "force_pound", "rev": "revolution"}.get(
                name, name
            ),
        )
        of_base = there.to_base_units()
        assert float(factor(name)) == pytest.approx(of_base.magnitude, rel=1e-12), name
        powers = {unit: Fraction(str(power)) for unit, power in of_base.unit_items() if unit != "radian"}
        assert powers.get("kilogram", 0) == size.kilograms, name
        assert powers.get("meter", 0) == size.metres, name
        assert powers.get("second", 0) == size.seconds, name
    assert SIZES["deg"] == NUMBER


symbols = st.sampled_from(
    ["m", "g", "h", "v", "t", "k", "L", "theta", "mu", "q", "2", "3 kg", "5 m", "x", "W", "F", "30°"]
)
formulas = st.recursive(
    symbols,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["+", "-", "*", "/"]), inner).map(
            lambda p: f"({p[0]}) {p[1]} ({p[2]})"
        ),
        inner.map(lambda text: f"sin({text})"),
        inner.map(lambda text: f"sqrt({text})"),
        st.tuples(inner, st.sampled_from(["2", "-1", "1/2", "t"])).map(lambda p: f"({p[0]})^({p[1]})"),
    ),
    max_leaves=8,
)


@settings(max_examples=100, deadline=None)
@given(
    st.sampled_from(["m", "v", "F", "E", "theta", "q", "p", "alpha"]),
    formulas,
    st.sampled_from([None, *"BCDEF"]),
)
def test_no_formula_upsets_the_analysis(name: str, formula: str, label: str | None) -> None:
    sketch = saying((f"{name} = {formula}", label))
    for finding in check(sketch, read(sketch)):
        assert finding.message


@given(st.lists(st.fractions(-3, 3, max_denominator=4), min_size=6, max_size=6))
def test_dimensions_that_are_equal_are_one_key(exponents: list[Fraction]) -> None:
    one, other = Dimension(*exponents[:3]), Dimension(*exponents[3:])
    there_and_back = one * other / other
    assert there_and_back == one
    assert len({one, there_and_back, other}) == (1 if one == other else 2)
