"""Metrics of read mathematics."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen.writing.grammars import mixed
from evaluation.metrics.mathematics import Found, mistakes, same, signs, structure
from sketch.writing.rows import Node, row_of

SEEDS = st.integers(0, 10_000)


@settings(deadline=None, max_examples=40)
@given(SEEDS)
def test_a_reading_without_mistakes_is_the_same_and_only_that(seed: int) -> None:
    rng = np.random.default_rng(seed)
    one, other = mixed(rng), mixed(rng)
    assert mistakes(one, one) == 0
    assert same(one, one)
    assert structure(one) == structure(one)
    assert (mistakes(one, other) == 0) == same(one, other)
    assert mistakes(one, other) == mistakes(other, one)


@pytest.mark.parametrize(
    ("truth", "claim", "count"),
    [
        ("x + y", "x + z", 1),
        ("x _ 2", "x 2", 1),
        ("x ^ 2", "x _ 2", 1),
        ("x ^ 2", "y _ 2", 2),
        (r"\frac{a}{b}", "a - b", 4),
        ("1 2 3", "1 3", 1),
        ("a b", "", 2),
    ],
)
def test_each_sign_and_each_relation_counts_once(truth: str, claim: str, count: int) -> None:
    assert mistakes(row_of(truth), row_of(claim)) == count


def test_structure_looks_past_names() -> None:
    assert structure(row_of("x ^ 2 + y")) == structure(row_of("a ^ b - c"))
    assert structure(row_of("x ^ 2")) != structure(row_of("x _ 2"))
    assert structure(row_of(r"\frac{a}{b}")) != structure(row_of("a b"))


def test_a_sign_is_right_when_its_strokes_and_its_name_are() -> None:
    claim = (Node("X", (0, 1), sup=(Node("2", (2,)),)), Node("=", (3,)))
    found = signs([("x", (1, 0)), ("2", (2,)), ("=", (3, 4))], claim)
    assert found == [Found("x", "X"), Found("2", "2"), Found("=", None)]
    assert [one.right for one in found] == [False, True, False]
    assert [one.merged for one in found] == [True, True, False]
