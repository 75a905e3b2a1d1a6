"""Generated handwriting of mathematics: its ink and its truth belong together."""

from __future__ import annotations

import numpy as np
import pytest

from data_gen.glyphs.alphabet import styles
from data_gen.writers import sample_writer
from data_gen.writing.grammars import Row, aslant, drill, general, mixed, physics
from data_gen.writing.habits import habits
from data_gen.writing.typeset import written
from sketch.writing.rows import known, latex, nodes_of, row_of
from sketch.writing.signs import FRACTION, FUNCTIONS, ROOT, SIGNS

GRAMMARS = (general, physics, mixed, drill, aslant)


def _by_somebody(row: Row, seed: int, pen: bool = True):
    rng = np.random.default_rng(seed)
    return written(row, habits(sample_writer(rng), rng), pen)


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_a_grammar_writes_known_signs_that_latex_can_hold(grammar) -> None:
    for seed in range(200):
        row = grammar(np.random.default_rng(seed))
        assert known(row)
        assert latex(row_of(latex(row))) == latex(row)
        assert "{ }" not in latex(row)


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_every_stroke_belongs_to_one_sign_and_every_sign_has_one(grammar) -> None:
    for seed in range(6):
        row = grammar(np.random.default_rng(seed))
        found = _by_somebody(row, seed)
        owned = [stroke for node in nodes_of(found.row) for stroke in node.strokes]
        assert sorted(owned) == list(range(len(found.ink)))
        assert all(node.strokes for node in nodes_of(found.row))
        assert latex(found.row) == latex(row)


def test_the_same_seed_writes_the_same_ink() -> None:
    row = general(np.random.default_rng(3))
    assert _by_somebody(row, 5).ink == _by_somebody(row, 5).ink
    assert _by_somebody(row, 5).ink != _by_somebody(row, 6).ink


def test_scripts_numerators_and_radicands_stand_where_they_belong() -> None:
    for seed in range(20):
        found = _by_somebody(
            row_of(r"x ^ { 2 } + x _ { 2 } + \frac { a } { b } + \sqrt { c }"), seed, pen=False
        )
        up, _, low, _, fraction, _, root = found.row

        def box(node, ink=found.ink):
            points = ink.points_of(node.strokes)
            return points.min(axis=0), points.max(axis=0)

        def middle(node, at=box):
            return np.mean(at(node), axis=0)

        assert middle(up.sup[0])[1] < middle(up)[1] < middle(low.sub[0])[1] + 60
        assert middle(low.sub[0])[1] > middle(low)[1]
        assert middle(fraction.over[0])[1] < middle(fraction)[1] < middle(fraction.under[0])[1]
        assert box(root)[0][0] < middle(root.inside[0])[0] < box(root)[1][0]


@pytest.mark.parametrize("sign", [sign for sign in SIGNS if sign not in (FRACTION, ROOT, *FUNCTIONS)])
def test_every_sign_can_be_written_in_two_ways_at_least(sign: str) -> None:
    ways = styles(sign)
    assert len(ways) >= 2 or sign == "-"
    assert all(np.isfinite(points).all() and len(points) > 1 for way in ways for points, _ in way)
