"""Malformed formulas and impossible associations: each an explanation, none an exception, no hang.

Every case is read, checked for its dimensions and built into a scene; the explanation is a notice of
the page, or a finding of the analysis.
"""

from __future__ import annotations

import time

import pytest
from formula_pages import saying
from hypothesis import given, settings
from hypothesis import strategies as st

from fuzz_formulas import NAMES
from physics.build import build
from physics.formula.dimensions import check
from physics.formula.meaning import read

NOT_A_FORMULA: list[tuple[str, str]] = [
    ("", "empty"),
    ("   ", "empty"),
    ("=", "expected a number, a name or an opening bracket"),
    ("m =", "the formula ends"),
    ("= 5", "expected a number"),
    ("m == 5", "expected a number"),
    ("m = = 5", "expected a number"),
    ("m = 5 = 6", "one equals sign"),
    ("m = 5,", "a decimal has a point"),
    ("g = 9,81", "a decimal has a point"),
    ("m = 5.", "a point stands between digits"),
    ("m = .", "a point stands between digits"),
    ("m = 5..2", "a point stands between digits"),
    ("m = 5 5", "write * between them"),
    ("m = (5", "to close the ("),
    ("m = 5)", "expected an operator"),
    ("m = [5", "to close the ["),
    ("m = {5", "to close the {"),
    ("m = (5]", "to close the ("),
    ("m = ()", "expected a number"),
    ("f = (1,)", "expected a number"),
    ("f = (,1)", "expected a number"),
    ("f = ((1,2),3)", "components are scalars"),
    ("m = |5", "to close the |"),
    ("m = ||5|", "needs || to close"),
    ("m = 5 +", "the formula ends"),
    ("m = * 5", "expected a number"),
    ("m = 5 */ 2", "expected a number"),
    ("m = 2^", "the formula ends"),
    ("m = ^2", "expected a number"),
    ("m = 5^^2", "expected a number"),
    ("m2 = 5", "m_2, m*2 or m^2"),
    ("x_ = 5", "a subscript is made of letters and digits"),
    ("_x = 5", "a subscript belongs to a letter"),
    ("f_{1 = 5", "a subscript is made of letters and digits"),
    ("f_{} = 5", "a subscript is made of letters and digits"),
    ("m ≈ 5", "only = relates"),
    ("m < 5", "only = relates"),
    (r"m \le 5", "only = relates"),
    ("m := 5", "no meaning"),
    ("m = 5;", "no meaning"),
    ("m = 5!", "no meaning"),
    ("m = 50%", "no meaning"),
    ("m = ?", "no meaning"),
    ("m = 5€", "no meaning"),
    ("m = \"5\"", "no meaning"),
    ("m = 五", "no meaning"),
    ("$m = 5$", "without the signs"),
    (r"m = 5 \\", "without the signs"),
    (r"\theta = \frac{1}", "the formula ends"),
    (r"\frac = 5", "expected a number"),
    (r"\sqrt12 = x", "braces"),
    (r"\fraq{1}{2} = x", "is not known"),
    (r"\Theta = \foo", "is not known"),
    ("m = \\", "a backslash begins a command"),
    (r"v = \dot{x}", "derivatives are not read"),
    (r"\vec{} = 5", "takes one letter"),
    (r"m = 5\,\text{apples}", "one letter or a unit"),
    (r"\sum_{i=1}^{3} F = m a", "without limits"),
    ("x = 2 ± 1", "one value"),
    ("theta = x°", "degrees stand after a number"),
    ("theta = °", "expected a number"),
    ("m = 5 kg^2.5", "a unit's power is a whole number"),
    ("m = 5 kg^x", "a unit's power is a whole number"),
    ("m = 1/0", "division by zero"),
    ("m = 0^-1", "no real number"),
    ("m = sqrt(-1)", "no real root"),
    ("m = (-8)^(1/3)", "no real root"),
    ("m = ln(0) 1/0", "division by zero"),
    ("m = 9^9^9^9", "too large"),
    ("m = 10^400", "too large"),
    ("m = 1e999999", "too large"),
    ("f = (1,2) + 3", "cannot be added"),
    ("f = (1,2) + (1,2,3)", "different length"),
    ("f = (1,2) (3,4)", "cannot be multiplied"),
    ("f = (1,2)^2", "has no power"),
    ("f = 1/(1,2)", "has no power"),
    ("m = cos((1,2))", "takes a scalar"),
    ("m = sin", "the formula ends"),
    ("m = sin()", "expected a number"),
    ("m = ln^{-1}(2)", "has no inverse"),
    ("m = " + "(" * 200, "nested more than"),
    ("m = " + "9" * 400, "at most"),
    ("m = " + "x + " * 400, "at most"),
    ("__import__('os')", "a subscript belongs to a letter"),
    ("m = lambda: 5", "no meaning"),
    ("m = [x for x in y]; 5", "no meaning"),
    ("5 = 7", "name = value"),
    ("m", "name = value"),
    ("5", "name = value"),
    ("m + 5", "name = value"),
    ("(1, 2)", "name = value"),
    ("3 kg = 5 m", "name = value"),
]  # fmt: skip

IMPOSSIBLE: list[tuple[str, str | None, str]] = [
    ("k = 3", "B", "a ball does not stretch"),
    ("k = 3", "C", "a block does not stretch"),
    ("k = 3", "D", "a wire does not stretch"),
    ("T = 3", "E", "what a spring pulls with"),
    ("T_1 = 3", "B", "say it of the wire"),
    ("T_1 = 3", "C", "say it of the wire"),
    ("m = 3", "D", "wires weigh nothing"),
    ("m = 3", "E", "springs weigh nothing"),
    ("rho = 3", "D", "wires weigh nothing"),
    ("W = 3", "E", "springs weigh nothing"),
    ("L = 3", "B", "as large as it is drawn"),
    ("L = 3", "C", "as large as it is drawn"),
    ("F = 3", "D", "the force in a wire is its tension"),
    ("mu = 0.3", "E", "only what slides"),
    ("mu = 0.3", "D", "only what slides"),
    ("e = 0.3", "D", "only what bounces"),
    ("e = 0.3", "E", "only what bounces"),
    ("v = 3", "E", "a spring moves with what hangs from it"),
    ("v = 3", "D", "a wire moves with what hangs from it"),
    ("g = 10", "B", "all things fall alike"),
    ("g = 10", "D", "all things fall alike"),
    ("m = 3", None, "tap the ball or the block whose mass"),
    ("F = 3", None, "that it acts on"),
    ("theta = 1", None, "tap the incline"),
    ("T_1 = 1", None, "tap the wire"),
    ("k = 1", None, "tap the spring"),
    ("mu = 1", None, "that slides"),
    ("e = 1", None, "that bounces"),
    ("q = 3", "B", "not a quantity"),
    ("v_Z = 3 m", "B", "v_Z is a velocity"),
    ("m = 0", "B", "above zero"),
    ("m = -2 kg", "B", "above zero"),
    ("W = 0", "B", "above zero"),
    ("rho = 0", "B", "above zero"),
    ("e = 2", "B", "between 0 and 1"),
    ("mu = -1", "B", "not below zero"),
    ("L = 0", "D", "above zero"),
    ("k = -1", "E", "not below zero"),
    ("g = t / t^0 x", None, "g"),
    ("T = T", "D", "defined by itself"),
    ("T = q", "D", "q in T = q of D has no value"),
    ("f = 3", "B", "rests on nothing"),
    ("F = (1, 2, 3)", "B", "two"),
    ("F = v W", "B", "two vectors"),
    ("F = v + 3", "B", "adds a vector to a number"),
    ("m = 3 m", "B", "3*m"),
    ("m = 3 s", "B", "m is a mass (kg), but 3 s is a time (s)"),
    ("v = 3 kg", "B", "but 3 kg is a mass"),
    ("F = 5 J", "B", "but 5 J is an energy"),
    ("k = 3 kg/m", "E", "k is a stiffness"),
    ("theta = 3 m", "F", "theta is a plain number"),
    ("v = 2", "B", "to the right"),
    ("x = x", "B", "a position may depend on the time"),
    ("x = 3", "A", "is fixed"),
    ("s = 3", "B", "has no direction"),
    ("m = t", "B", "above zero"),
    ("½mv² = mgh", "B", "lacking"),
    ("m g = 3 + g m", "B", "does not hold"),
    ("x^2 = -1", "B", "no real numbers"),
]  # fmt: skip


def explained(text: str, label: str | None) -> list[str]:
    sketch = saying((text, label))
    built = build(sketch)
    return [*built.notices, *(finding.message for finding in check(sketch, read(sketch)))]


def test_there_are_a_hundred_of_them_and_more() -> None:
    assert len(NOT_A_FORMULA) + len(IMPOSSIBLE) >= 150


@pytest.mark.parametrize(("text", "says"), NOT_A_FORMULA, ids=lambda value: repr(value[:24]))
def test_what_is_no_formula_is_explained(text: str, says: str) -> None:
    started = time.process_time()
    told = explained(text, "B")
    assert any(says in notice for notice in told), told
    assert time.process_time() - started < 2


@pytest.mark.parametrize(("text", "label", "says"), IMPOSSIBLE, ids=lambda value: str(value)[:24])
def test_what_cannot_be_is_explained(text: str, label: str | None, says: str) -> None:
    started = time.process_time()
    told = explained(text, label)
    assert any(says in notice for notice in told), told
    assert time.process_time() - started < 4


names = st.sampled_from(NAMES)
values = st.sampled_from(
    ["0", "1", "-3", "2.5", "5\\,kg", "|W|", "W", "v", "t", "1/t", "theta", "q", "f_1", "pi/4", "-mu*v", "m*g", "m_C", "v_B", "sin(t)", "sqrt(x)", "(0,5)", "(t,1/t)", "exp(exp(9))", "(1,2,3)", "((", "m*a", "36\\,km/h", "30°", "2\\,m", "1/2*m*v^2"]
)  # fmt: skip
lines = st.one_of(
    st.tuples(names, values).map(" = ".join),
    st.tuples(values, values).map(" = ".join),
    st.text(st.sampled_from("xyemkgNsW0123456789.+-*/^=()[]{}|‖,_ \\√πθ²°'Σ½"), max_size=24),
)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(lines, st.sampled_from([None, *"ABCDEF"])), min_size=1, max_size=4))
def test_any_page_is_read_built_and_checked_without_an_exception(said: list[tuple[str, str | None]]) -> None:
    sketch = saying(*said)
    meanings = read(sketch)
    assert all(notice.strip() for notice in meanings.notices)
    check(sketch, meanings)
    build(sketch)
