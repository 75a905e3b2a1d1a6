"""Laws of the published features: closed forms of simple figures, and what leaves them unchanged."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import inks

from data_gen import ideals
from data_gen.strokes import generate
from recognizer.classical import hbf49 as h
from recognizer.classical import rubine as r
from recognizer.classical.hbf49 import hbf49
from recognizer.classical.rubine import rubine
from sketch.ink import Ink, Stroke

DRAWN = [Ink((item.stroke,)) for item in generate(60, 12)]
SQUARE = Ink((Stroke([(0, 0), (100, 0), (100, 100), (0, 100), (0, 0)]),))
LINE = Ink((Stroke([(10, 20), (40, 20), (110, 20)]),))
ROUND = Ink((Stroke(ideals.circle((50, 50), 60)),))


def named(module, row) -> dict[str, float]:
    return dict(zip(module.NAMES, row.tolist(), strict=True))


def mapped(ink: Ink, change) -> Ink:
    return Ink(tuple(Stroke(change(stroke.points), stroke.times) for stroke in ink))


def test_a_square_has_its_closed_forms():
    found = named(h, hbf49([SQUARE])[0])
    assert found["length"] == pytest.approx(4)
    assert found["ends apart"] == found["ends' direction, cosine"] == 0
    assert found["initial direction, cosine"] == pytest.approx(1)
    assert found["downward share"] == pytest.approx(0.25)
    assert found["angle of the box's diagonal"] == pytest.approx(np.pi / 4)
    assert found["box over length"] == pytest.approx(0.5)
    assert found["curvature"] == pytest.approx(3 * np.pi / 2)
    assert found["perpendicularity"] == pytest.approx(3)
    assert found["greatest k-angle"] == pytest.approx(np.pi / 2)
    assert found["direction near 0°"] == found["direction near 90°"] == pytest.approx(0.5)
    assert found["hull over box"] == pytest.approx(1)
    assert found["compactness"] == pytest.approx(16)


def test_a_level_line_has_its_closed_forms():
    found = named(h, hbf49([LINE])[0])
    assert (found["start x"], found["end x"], found["start y"]) == pytest.approx((0, 1, 0.5))
    assert found["ends apart over length"] == pytest.approx(1)
    assert found["ends' direction, cosine"] == pytest.approx(1)
    assert found["direction near 0°"] == found["turn near 0°"] == pytest.approx(1)
    assert found["curvature"] == found["mean direction"] == pytest.approx(0, abs=1e-9)
    # 17 points at 0 … 16 steps: the variance of their places, by the number of points.
    assert found["Hu's invariant 1"] == pytest.approx((17**2 - 1) / 12 / 17)


def test_a_circle_turns_once_and_is_compact():
    found = named(h, hbf49([ROUND])[0])
    assert found["length"] == pytest.approx(np.pi, rel=0.01)
    assert found["curvature"] == pytest.approx(2 * np.pi, rel=0.03)
    assert found["hull over box"] == pytest.approx(np.pi / 4, rel=0.02)
    assert found["compactness"] == pytest.approx(4 * np.pi, rel=0.02)
    assert found["deviation"] == pytest.approx(0.5, rel=0.01)


def test_shares_of_ink_of_directions_and_of_turns_sum_to_one():
    found = hbf49(DRAWN)
    moving = found[:, h.NAMES.index("length")] > 0
    for word in ("ink in", "direction near", "turn near"):
        shares = found[:, [name.startswith(word) for name in h.NAMES]].sum(axis=1)
        assert shares[moving] == pytest.approx(1)


@given(st.floats(1e-3, 1e3), st.floats(-1e4, 1e4), st.floats(-1e4, 1e4))
@settings(max_examples=20, deadline=None)
def test_where_and_how_large_a_drawing_is_changes_no_feature_of_hbf49_or_of_sized_rubine(scale, x, y):
    moved = [mapped(ink, lambda points: scale * points + (x, y)) for ink in DRAWN[:12]]
    assert hbf49(moved) == pytest.approx(hbf49(DRAWN[:12]), rel=1e-5, abs=1e-5)
    assert r.shape([SQUARE, LINE, ROUND]) == pytest.approx(
        r.shape([mapped(ink, lambda points: scale * points + (x, y)) for ink in (SQUARE, LINE, ROUND)]),
        rel=1e-5,
        abs=1e-5,
    )


def test_a_quarter_turn_changes_none_of_hus_invariants():
    turned = [mapped(ink, lambda points: points @ np.array([[0, 1], [-1, 0]])) for ink in DRAWN]
    hu = [name.startswith("Hu") for name in h.NAMES]
    assert hbf49(turned)[:, hu] == pytest.approx(hbf49(DRAWN)[:, hu], rel=1e-6, abs=1e-9)


def test_a_mirror_changes_the_sign_of_hus_seventh_invariant_alone():
    mirrored = [mapped(ink, lambda points: points * (-1, 1)) for ink in DRAWN]
    hu = [name.startswith("Hu") for name in h.NAMES]
    signs = (1, 1, 1, 1, 1, 1, -1)
    assert hbf49(mirrored)[:, hu] == pytest.approx(hbf49(DRAWN)[:, hu] * signs, rel=1e-6, abs=1e-9)


def test_a_drawing_in_parts_differs_from_the_same_in_one_stroke_only_where_the_pen_was_lifted():
    points = ROUND[0].points
    cut = len(points) // 2
    parts = Ink((Stroke(points[: cut + 1]), Stroke(points[cut:])))
    whole, pieces = (named(h, row) for row in hbf49([ROUND, parts]))
    assert (whole["strokes"], pieces["strokes"]) == (1, 2)
    for name in ("length", "hull over box", "compactness", "start x", "end y", "ends apart", "deviation"):
        assert pieces[name] == pytest.approx(whole[name], abs=0.02)


@pytest.mark.parametrize("features", [hbf49, rubine, r.shape])
def test_a_drawing_has_the_same_features_in_any_company(features):
    alone = np.concatenate([features([ink]) for ink in DRAWN[:15]])
    assert features(DRAWN)[:15] == pytest.approx(alone, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("features", [hbf49, rubine, r.shape])
@given(inks())
@settings(max_examples=60, deadline=None)
def test_features_of_any_ink_are_finite(features, ink):
    if len(ink):
        assert np.isfinite(features([ink, ink])).all()


@pytest.mark.parametrize("features", [hbf49, rubine, r.shape])
def test_no_drawing_has_no_features_and_one_without_strokes_is_refused(features):
    assert features([]).shape[0] == 0
    if features is hbf49:
        with pytest.raises(ValueError, match="drawing 1 has no stroke"):
            features([SQUARE, Ink()])


def test_rubines_features_of_a_right_angle_are_the_papers():
    times = np.arange(7) * 0.1
    path = [(0, 0), (10, 0), (20, 0), (30, 0), (30, 10), (30, 20), (30, 40)]
    found = named(r, rubine([Ink((Stroke(path, times),))])[0])
    assert found["initial direction, cosine"] == pytest.approx(1)
    assert found["box diagonal"] == pytest.approx(50)
    assert found["angle of the box's diagonal"] == pytest.approx(np.arctan2(40, 30))
    assert found["ends apart"] == pytest.approx(50)
    assert (found["ends' direction, cosine"], found["ends' direction, sine"]) == pytest.approx((0.6, 0.8))
    assert found["length"] == pytest.approx(70)
    assert found["turned, signed"] == found["turned, absolute"] == pytest.approx(np.pi / 2)
    assert found["sharpness"] == pytest.approx((np.pi / 2) ** 2)
    assert found["greatest speed, squared"] == pytest.approx(200.0**2)
    assert found["duration"] == pytest.approx(0.6)


def test_jiggle_below_three_units_changes_none_of_rubines_features():
    path = [(0, 0), (1, 1), (10, 0), (11, 0), (30, 0), (30, 1), (30, 40)]
    clean = [(0, 0), (10, 0), (30, 0), (30, 40)]
    jiggled, smooth = (Ink((Stroke(points),)) for points in (path, clean))
    assert rubine([jiggled]) == pytest.approx(rubine([smooth]))


def test_drawn_the_other_way_round_rubine_turns_the_other_way():
    column = r.NAMES.index("turned, signed")
    backwards = Ink((Stroke(ROUND[0].points[::-1]),))
    there, back = rubine([ROUND, backwards])[:, column]
    assert there == pytest.approx(-back, rel=0.05)
    assert abs(there) == pytest.approx(2 * np.pi, rel=0.1)
