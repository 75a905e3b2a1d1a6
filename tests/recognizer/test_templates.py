"""Laws of the template matchers, each as its paper has it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import inks

from data_gen.strokes import generate
from recognizer.published import PUBLISHED
from recognizer.templates import dollar_p, dollar_q
from recognizer.templates.dollar_n import DollarN, drawn
from recognizer.templates.dollar_one import DollarOne
from recognizer.templates.dollar_p import DollarP
from recognizer.templates.dollar_q import DollarQ
from recognizer.templates.jackknife import Jackknife
from recognizer.templates.penny_pincher import PennyPincher
from recognizer.templates.points import by_label
from recognizer.templates.protractor import Protractor
from sketch.ink import Ink, Stroke

MATCHERS = (DollarOne, Protractor, DollarN, DollarP, DollarQ, PennyPincher, Jackknife)
TURNING = (DollarOne, Protractor, DollarN)
SENSELESS = (DollarN, DollarP, DollarQ)
"""Those that look past how a drawing is turned; past the order and sense of its strokes."""
MIX = {"circle": 0.2, "polygon": 0.2, "spring": 0.2, "arrow": 0.2, "math": 0.2}
DRAWN = [Ink((item.stroke,)) for item in generate(30, 77, mix=MIX)]
LABELS = np.arange(30)


def mapped(ink: Ink, change) -> Ink:
    return Ink(tuple(Stroke(change(stroke.points)) for stroke in ink))


def in_parts(ink: Ink) -> Ink:
    """The one stroke of an ink cut in two at its middle point."""
    points = ink[0].points
    cut = len(points) // 2
    return Ink((Stroke(points[: cut + 1]), Stroke(points[cut:])))


@pytest.fixture(scope="module")
def remembering():
    return {matcher: matcher.of(DRAWN, LABELS) for matcher in MATCHERS}


def test_the_lists_of_what_papers_look_past_are_the_rosters():
    named = {f"{m.__module__.rsplit('.', 1)[1]}:{m.__name__}": m for m in MATCHERS}
    for one in PUBLISHED.values():
        if one.matcher:
            matcher = named.pop(one.matcher)
            assert (one.turns, one.senses) == (matcher in TURNING, matcher in SENSELESS)
    assert not named


@pytest.mark.parametrize("matcher", MATCHERS)
def test_what_was_learnt_is_nearest_to_itself(matcher, remembering):
    distances = remembering[matcher].nearest(DRAWN)
    assert distances.shape == (30, 30)
    assert (distances >= 0).all()
    assert (distances.argmin(axis=1) == LABELS).all()
    # $1 does not try the angle of zero itself, but one within two degrees of it.
    assert np.diag(distances).max() < (4.0 if matcher is DollarOne else 1e-6)


@pytest.mark.parametrize("matcher", MATCHERS)
@given(scale=st.floats(0.01, 100), x=st.floats(-1e3, 1e3), y=st.floats(-1e3, 1e3))
@settings(max_examples=8, deadline=None)
def test_place_and_scale_change_no_distance(matcher, remembering, scale, x, y):
    moved = [mapped(ink, lambda points: scale * points + (x, y)) for ink in DRAWN[:8]]
    nearest = remembering[matcher].nearest
    # $Q's coordinates are whole numbers: a point may fall to the next one by rounding.
    assert nearest(moved) == pytest.approx(
        nearest(DRAWN[:8]), rel=1e-4, abs=2e-3 if matcher is DollarQ else 1e-5
    )


@pytest.mark.parametrize("matcher", TURNING)
@given(angle=st.floats(-np.pi, np.pi))
@settings(max_examples=8, deadline=None)
def test_a_turn_changes_no_distance_where_the_paper_says_so(matcher, remembering, angle):
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    turned = [mapped(ink, lambda points: points @ turn) for ink in DRAWN[:8]]
    nearest = remembering[matcher].nearest
    assert nearest(turned) == pytest.approx(nearest(DRAWN[:8]), rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("matcher", [m for m in MATCHERS if m not in TURNING])
def test_a_quarter_turn_changes_distances_where_turns_matter(matcher, remembering):
    turned = [mapped(ink, lambda points: points @ np.array([[0.0, 1.0], [-1.0, 0.0]])) for ink in DRAWN]
    assert np.diag(remembering[matcher].nearest(turned)).mean() > 0.05


@pytest.mark.parametrize("matcher", SENSELESS)
def test_order_and_sense_of_strokes_change_no_kind_where_the_paper_says_so(matcher):
    # No springs: the loops of a coil lie closer than the points that stand for it, and any shift reorders them.
    mix = {"circle": 0.3, "polygon": 0.3, "arrow": 0.4}
    items = generate(12, 77, mix=mix)
    parts = [in_parts(Ink((item.stroke,))) for item in items]
    kinds = np.array([sorted(mix).index(item.kind) for item in items])
    remembered = matcher.of(parts, kinds)
    for change in (
        lambda ink: Ink(ink.strokes[::-1]),
        lambda ink: mapped(ink, lambda points: points[::-1]),
        lambda ink: Ink((ink[1], *mapped(Ink((ink[0],)), lambda points: points[::-1]))),
    ):
        changed = remembered.nearest([change(ink) for ink in parts])
        assert (changed.argmin(axis=1) == kinds).all()


@pytest.mark.parametrize("matcher", [m for m in MATCHERS if m not in SENSELESS])
def test_the_sense_of_drawing_matters_to_the_others(matcher, remembering):
    backwards = [mapped(ink, lambda points: points[::-1]) for ink in DRAWN]
    own = np.diag(remembering[matcher].nearest(backwards))
    assert np.median(own) > 10 * np.median(np.diag(remembering[matcher].nearest(DRAWN))) + 1e-3


def test_n_draws_a_template_of_s_strokes_in_every_order_and_sense():
    stroke = Stroke([(0, 0), (1, 2)])
    assert [len(list(drawn(Ink((stroke,) * s)))) for s in (1, 2, 3, 4, 5)] == [2, 8, 48, 384, 2]


def test_n_keeps_lines_straight_where_one_scales_them_into_their_wobble():
    rng = np.random.default_rng(2)
    along = np.linspace(0, 200, 60)
    lines = [
        Ink((Stroke(np.column_stack([along, rng.standard_normal(60).cumsum() * 0.2])),)) for _ in range(6)
    ]
    labels = np.zeros(3, dtype=np.int64)
    n, one = (matcher.of(lines[:3], labels).nearest(lines[3:]) for matcher in (DollarN, DollarOne))
    assert n.max() < 0.1
    assert one.min() > 10  # of a square of 250


def test_qs_bounds_leave_out_work_and_next_to_nothing_else():
    clouds = dollar_q.normalised(DRAWN)
    found = DollarQ.of(DRAWN, LABELS).nearest(DRAWN)
    exact = np.empty((30, 30))
    for i, ours in enumerate(clouds):
        for j, theirs in enumerate(clouds):
            exact[i, j] = min(
                dollar_q._given(a, b, start, np.inf)
                for a, b in ((ours, theirs), (theirs, ours))
                for start in range(0, dollar_q.POINTS, dollar_q.STRIDE)
            )
    exact = np.sqrt(exact / (32 * 33 / 2)) / dollar_q.RANGE
    assert (found >= exact - 1e-12).all()
    # The table names the nearest point of a cell, not of a place: a bound may be a little too high.
    assert (found == pytest.approx(exact, rel=0.05)) and np.mean(np.isclose(found, exact)) > 0.9


def test_qs_bound_of_the_first_start_is_no_more_than_giving_costs():
    clouds = dollar_q.normalised(DRAWN)
    tables = dollar_q._tables(clouds)
    bounds = np.array(
        [dollar_q._bounds(clouds[0], other, table) for other, table in zip(clouds, tables, strict=True)]
    )
    costs = np.array(
        [[dollar_q._given(clouds[0], other, start, np.inf) for start in range(0, 32, 5)] for other in clouds]
    )
    # A table knows the nearest to its cell: two cells, squared, by weight, is what it may be wrong by.
    assert (bounds <= costs + (2 * dollar_q.CELL) ** 2 * 32 * 33 / 2).all()
    assert (bounds > 0.3 * costs).mean() > 0.5  # a bound that tells nothing would leave nothing out


def test_p_gives_every_point_once():
    line = np.column_stack([np.linspace(0, 1, 32), np.zeros(32)])
    assert dollar_p._given(line, line[::-1].copy(), 0, np.inf) == pytest.approx(0)
    beside = line + np.array([0.0, 0.5])
    assert dollar_p._given(line, beside, 7, np.inf) == pytest.approx(0.5 * (32 * 33 / 2) / 32)


def test_penny_pinchers_opposite_is_as_far_as_can_be():
    line = Ink((Stroke([(0, 0), (9, 0)]),))
    back = Ink((Stroke([(9, 0), (0, 0)]),))
    up = Ink((Stroke([(0, 0), (0, 9)]),))
    found = PennyPincher.of([line], np.zeros(1, dtype=np.int64)).nearest([line, up, back])
    assert found[:, 0] == pytest.approx([0, 1, 2])


def test_warping_forgives_uneven_pace_that_penny_pincher_does_not():
    # The corner comes later where the first leg is longer.
    first = Ink((Stroke([(0, 0), (100, 0), (100, 100)]),))
    other = Ink((Stroke([(0, 0), (150, 0), (150, 100)]),))
    labels = np.zeros(1, dtype=np.int64)
    warped, pinched = (m.of([first], labels).nearest([other])[0, 0] for m in (Jackknife, PennyPincher))
    assert warped < 0.5 * pinched


@pytest.mark.parametrize("matcher", MATCHERS)
@given(ink=inks())
@settings(max_examples=30, deadline=None)
def test_any_ink_has_a_finite_distance(matcher, remembering, ink):
    if len(ink):
        assert np.isfinite(remembering[matcher].nearest([ink])).all()
        assert np.isfinite(matcher.of([ink], np.zeros(1, dtype=np.int64)).nearest(DRAWN[:2])).all()


def test_the_nearest_of_each_label_is_found():
    distances = np.array([[3.0, 1.0, 2.0, 0.5], [1.0, 4.0, 0.1, 7.0]])
    assert by_label(distances, np.array([1, 0, 1, 0])).tolist() == [[0.5, 2.0], [4.0, 0.1]]
