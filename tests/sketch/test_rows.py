"""Rows of signs and their LaTeX are two forms of one thing."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sketch.formula.parse import parse
from sketch.writing.rows import Node, Row, RowError, formula, known, latex, nodes_of, row_of
from sketch.writing.signs import EXTENTS, FRACTION, NUMBER, ROOT, SIGNS, extent

PLAIN = st.sampled_from(
    [sign for sign in SIGNS if sign not in (FRACTION, ROOT, "\\vec", "\\hat", "'", "[", "]")]
)


def _rows(inner: st.SearchStrategy[Row]) -> st.SearchStrategy[Row]:
    part = inner.filter(bool)
    letter = st.builds(Node, PLAIN, sub=st.one_of(st.just(()), part), sup=st.one_of(st.just(()), part))
    fraction = st.builds(Node, st.just(FRACTION), over=part, under=part)
    root = st.builds(Node, st.just(ROOT), inside=part)
    arrow = st.builds(Node, st.sampled_from("vFa"), accent=st.just(Node("\\vec")))
    return st.lists(st.one_of(letter, fraction, root, arrow), min_size=1, max_size=4).map(tuple)


ROWS = st.recursive(st.lists(st.builds(Node, PLAIN), min_size=1, max_size=4).map(tuple), _rows, max_leaves=12)


@given(ROWS)
def test_a_row_is_read_back_from_its_latex(row: Row) -> None:
    assert row_of(latex(row)) == row


@given(ROWS)
def test_every_sign_of_a_row_is_met_once(row: Row) -> None:
    names = [node.name for node in nodes_of(row) if node.name not in (FRACTION, ROOT)]
    written = [token for token in latex(row).split() if token not in ("{", "}", "^", "_", "\\frac", "\\sqrt")]
    assert sorted(names) == sorted(written)
    assert known(row)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (r"x^2", r"{x} ^ { 2 }"),
        (r"x^2_1", r"x_1^{2}"),
        (r"\left( a \right)", "(a)"),
        (r"a \lt b", "a < b"),
        (r"f^\prime", "f'"),
        (r"\frac12", r"\frac{1}{2}"),
        (r"\mathrm{d}x", "dx"),
        (r"\|W\|", r"\Vert W \Vert"),
    ],
)
def test_spacing_braces_and_synonyms_do_not_matter(one: str, other: str) -> None:
    assert latex(row_of(one)) == latex(row_of(other))


@pytest.mark.parametrize(
    ("one", "other"), [("x^2", "x_2"), ("x^{2y}", "x^2 y"), ("x", "X"), (r"\times", "x")]
)
def test_what_reads_otherwise_is_another_row(one: str, other: str) -> None:
    assert latex(row_of(one)) != latex(row_of(other))


@pytest.mark.parametrize("text", ["x^", "{x", "x}", r"\frac{1}", r"\vec{ab}"])
def test_braces_that_do_not_fit_are_refused(text: str) -> None:
    with pytest.raises(RowError):
        row_of(text)


@pytest.mark.parametrize(
    ("row", "typed"),
    [
        (r"f _ { 1 } = - \mu v", "f_1 = -mu v"),
        (r"\theta = \frac { \pi } { 6 }", "theta = pi/6"),
        (r"v _ { A x } = 9 . 8 1 t", "v_Ax = 9.81 t"),
        (r"v _ { 1 } ^ { ' } = 3", "v_1' = 3"),
        (r"\alpha = 3 0 ^ { \circ }", "alpha = 30°"),
        (r"f = \Vert W \Vert \cos \theta", "f = ‖W‖ cos theta"),
        (r"T = 2 \pi \sqrt { \frac { l } { g } }", "T = 2 pi sqrt(l/g)"),
        (r"\vec { F } = ( 0 , 5 )", "F = (0, 5)"),
    ],
)
def test_a_row_means_what_the_typed_formula_means(row: str, typed: str) -> None:
    assert parse(formula(row_of(row))) == parse(typed)


def test_every_sign_has_a_number_and_a_part_of_the_line() -> None:
    assert [NUMBER[sign] for sign in SIGNS] == list(range(len(SIGNS)))
    assert {extent(sign) for sign in SIGNS} == set(EXTENTS)
