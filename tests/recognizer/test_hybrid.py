"""Laws of the stack of net and geometry."""

from __future__ import annotations

import numpy as np
import pytest

from data_gen.strokes import generate
from recognizer.geometric.recognizer import Geometric
from recognizer.hybrid import Hybrid, Stack, StackError, load, scores_of
from recognizer.learned.recognizer import Learned
from sketch.ink import Ink
from sketch.page import STROKE_KINDS

PAGE = Ink(tuple(item.stroke for item in generate(60, 9)))


def kinds(claims):
    return [claim.kind for claim in claims]


def test_who_hears_the_net_alone_says_what_it_says():
    net, alone = Learned().recognize(PAGE), Hybrid(Stack(1.0, 0.0)).recognize(PAGE)
    assert kinds(alone) == kinds(net)
    assert scores_of(alone) == pytest.approx(scores_of(net), abs=2e-3)  # none is believed below 1e-4


def test_who_hears_geometry_alone_says_what_it_says():
    assert kinds(Hybrid(Stack(0.0, 1.0)).recognize(PAGE)) == kinds(Geometric().recognize(PAGE))


def test_where_both_say_the_same_so_does_the_hybrid():
    net, geometry, both = (rival.recognize(PAGE) for rival in (Learned(), Geometric(), Hybrid()))
    agreed = [k for k in range(len(PAGE)) if net[k].kind == geometry[k].kind]
    assert len(agreed) > 20
    assert all(both[k].kind == net[k].kind for k in agreed)
    assert not any(both[k].rejected for k in agreed)


def test_shares_are_probabilities():
    rng = np.random.default_rng(1)
    net, geometry = rng.dirichlet(np.ones(len(STROKE_KINDS)), (2, 50))
    assert load().shares(net, geometry).sum(axis=1) == pytest.approx(np.ones(50))


def test_weights_that_cannot_be_used_are_refused_with_the_command_that_makes_them(tmp_path):
    for text in ("", "{}", '{"net": "much", "geometry": 1}', "[1, 2]"):
        (tmp_path / "weights.json").write_text(text)
        with pytest.raises(StackError, match=r"training\.stack"):
            load(tmp_path / "weights.json")


def test_an_empty_page_has_no_claims():
    assert Hybrid().recognize(Ink()) == ()
