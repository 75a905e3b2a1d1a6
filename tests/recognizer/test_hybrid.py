"""Laws of the stack of net and geometry."""

from __future__ import annotations

import numpy as np
import pytest

from data_gen.strokes import generate
from evaluation.statistics.paired import mcnemar
from evaluation.stroke_contest import stroke_contest
from evaluation.suites import generated_strokes
from recognizer.geometric.recognizer import Geometric
from recognizer.hybrid import LASSO, Hybrid, Stack, StackError, alone, completed, load, scores_of
from recognizer.learned.recognizer import Learned
from sketch.ink import Ink
from sketch.page import STROKE_KINDS

PAGE = Ink(tuple(item.stroke for item in generate(60, 9)))


def kinds(claims):
    return [claim.kind for claim in claims]


def test_who_hears_the_net_alone_says_what_it_says():
    net, alone = Learned().recognize(PAGE), Hybrid(Stack(1.0, 0.0, 0.0)).recognize(PAGE)
    assert kinds(alone) == kinds(net)
    assert scores_of(alone) == pytest.approx(scores_of(net), abs=2e-3)  # none is believed below 1e-4


@pytest.mark.parametrize(
    ("stack", "geometry"),
    [(Stack(0.0, 1.0, 0.0), alone), (Stack(0.0, 1.0, 1.0), Geometric().recognize)],
    ids=["alone", "on the page"],
)
def test_who_hears_geometry_alone_says_what_it_says_of_all_but_lassos(stack, geometry):
    said, meant = Hybrid(stack).recognize(PAGE), geometry(PAGE)
    told = [k for k, claim in enumerate(said) if "lasso" not in (claim.kind, meant[k].kind)]
    assert len(told) > 40
    assert all(said[k].kind == meant[k].kind for k in told)


def test_of_lassos_that_it_does_not_find_geometry_says_nothing():
    rng = np.random.default_rng(7)
    net, geometry = rng.dirichlet(np.ones(len(STROKE_KINDS)), (2, 200))
    found = completed(geometry, net)
    silent = geometry.argmax(axis=1) != LASSO
    assert found.sum(axis=1) == pytest.approx(np.ones(200))
    assert found[silent, LASSO] == pytest.approx(net[silent, LASSO])
    assert found[~silent] == pytest.approx(geometry[~silent])
    # Among the other kinds it says what it said.
    assert found[silent, 0] / found[silent, 1] == pytest.approx(geometry[silent, 0] / geometry[silent, 1])


@pytest.mark.parametrize("other", ["learned", "geometric"])
def test_it_is_no_worse_than_either_beyond_noise_on_generated_ink(right, other):
    pair = mcnemar(right["hybrid"], right[other])
    assert pair.only_first >= pair.only_second or (pair.p is not None and pair.p > 0.05)


@pytest.fixture(scope="module")
def right():
    results = stroke_contest(generated_strokes(360, 8123), ("hybrid", "learned", "geometric"))
    return {result.name: result.right for result in results}


def test_where_both_say_the_same_so_does_the_hybrid():
    net, geometry, both = (rival.recognize(PAGE) for rival in (Learned(), Geometric(), Hybrid()))
    bare = alone(PAGE)
    agreed = [k for k in range(len(PAGE)) if net[k].kind == geometry[k].kind == bare[k].kind]
    assert len(agreed) > 20
    assert all(both[k].kind == net[k].kind for k in agreed)
    assert not any(both[k].rejected for k in agreed)


def test_shares_are_probabilities():
    rng = np.random.default_rng(1)
    net, bare, page = rng.dirichlet(np.ones(len(STROKE_KINDS)), (3, 50))
    assert load().shares(net, bare, page).sum(axis=1) == pytest.approx(np.ones(50))


def test_weights_that_cannot_be_used_are_refused_with_the_command_that_makes_them(tmp_path):
    for text in (
        "",
        "{}",
        '{"net": "much", "geometry": 1, "context": 1}',
        '{"net": 1, "geometry": 1}',
        "[1, 2]",
    ):
        (tmp_path / "weights.json").write_text(text)
        with pytest.raises(StackError, match=r"training\.stack"):
            load(tmp_path / "weights.json")


def test_an_empty_page_has_no_claims():
    assert Hybrid().recognize(Ink()) == ()
