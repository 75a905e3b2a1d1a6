"""Who is learnt from and who is tested; early recognition; stress; what confidences are worth."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import inks

from data_gen.strokes import generate
from evaluation import examination, protocols
from evaluation.early import early_curves
from evaluation.metrics.calibration import reliability, risk_coverage
from evaluation.stress import AXES, stressed
from evaluation.stress_contest import Trial, groups, stroke_curves
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke

LABELS = ("vee", "caret", "line", "hook")
SHAPES = {
    "vee": [[0, 0], [5, 10], [10, 0]],
    "caret": [[0, 10], [5, 0], [10, 10]],
    "line": [[0, 0], [10, 0]],
    "hook": [[0, 0], [0, 10], [6, 10]],
}


def gestures(writers: int = 4, each: int = 6, seed: int = 1) -> list[Row]:
    """Four gestures with labels of nobody's vocabulary, each drawn so often by each writer."""
    rng = np.random.default_rng(seed)
    return [
        Row(
            label,
            Ink((Stroke(np.array(SHAPES[label]) + rng.normal(0, 0.6, (len(SHAPES[label]), 2))),)),
            f"w{w}",
        )
        for w in range(writers)
        for label in LABELS
        for _ in range(each)
    ]


def test_a_user_s_test_is_by_the_same_user_never_learnt_and_the_same_for_every_count():
    rows = gestures()
    splits = protocols.user_dependent(rows, [1, 3], 5, np.random.default_rng(2))
    assert len(splits) == 4 * 5 * 2
    for one, three in zip(splits[::2], splits[1::2], strict=True):
        assert one.test == three.test and set(one.train) <= set(three.train)
        assert not set(three.test) & set(three.train)
        assert len({rows[k].writer for k in (*three.train, *three.test)}) == 1
        assert Counter(rows[k].label for k in three.train) == dict.fromkeys(LABELS, 3)
        assert Counter(rows[k].label for k in three.test) == dict.fromkeys(LABELS, 1)
    with pytest.raises(ValueError, match="7 rows"):
        protocols.user_dependent(rows, [6], 1, np.random.default_rng(0))


def test_writers_who_are_tested_are_never_learnt_from_and_each_is_tested_once():
    rows = gestures()
    splits = protocols.user_independent(rows, [2], 3, np.random.default_rng(2))
    assert sorted(k for split in splits for k in split.test) == list(range(len(rows)))
    for split in splits:
        assert not {rows[k].writer for k in split.train} & {rows[k].writer for k in split.test}
    with pytest.raises(ValueError, match="cannot be left out"):
        protocols.user_independent(rows, [2], 9, np.random.default_rng(2))


def test_rivals_learn_gestures_of_any_name_and_more_guesses_are_never_worse():
    rows = gestures()
    splits = protocols.user_independent(rows, [1, 4], 2, np.random.default_rng(2))
    guesses = protocols.examine(rows, splits, ["protractor", "dollar-p"], seed=3)
    found = examination.marks(rows, guesses)
    assert [(mark.name, mark.templates) for mark in found] == [
        ("protractor", 1), ("dollar-p", 1), ("protractor", 4), ("dollar-p", 4),
    ]  # fmt: skip
    for mark in found:
        assert (mark.accuracy.n, mark.accuracy.clusters) == (len(rows), 4)
        assert all(a.value <= b.value for a, b in pairwise(mark.best))
        assert mark.best[3].value == 1.0  # there are but four labels
    assert min(mark.accuracy.value for mark in found if mark.name == "dollar-p") > 0.9
    (duel,) = examination.duels(guesses)
    assert (duel.first, duel.second, duel.test.n) == ("protractor", "dollar-p", len(rows))
    assert len(examination.tables("x", found, [duel])) == 3


def test_nobody_is_examined_who_cannot_learn_and_nothing_known_is_tested_untaught():
    rows = gestures(2)
    splits = protocols.user_independent(rows, [1], 2, np.random.default_rng(0))
    with pytest.raises(ValueError, match="geometric does not learn"):
        protocols.examine(rows, splits, ["geometric"])
    with pytest.raises(ValueError, match="stroke kind"):
        protocols.zero_shot(rows)


@settings(max_examples=40, deadline=None)
@given(inks(), st.floats(0, 1))
def test_the_beginning_of_ink_is_its_first_points(ink: Ink, fraction: float):
    shown = protocols.beginning(ink, fraction)
    assert len(shown) <= len(ink)
    for part, whole in zip(shown, ink, strict=False):
        assert 1 <= len(part) <= len(whole)
        assert (part.points == whole.points[: len(part)]).all()
    assert protocols.beginning(ink, 1.0) == ink


def test_half_of_a_line_is_half_of_its_points():
    line = Ink((Stroke(np.column_stack([np.arange(11), np.zeros(11)])),))
    assert len(protocols.beginning(line, 0.5)[0]) == 6


def test_early_curves_end_where_the_whole_stroke_is_seen():
    rows = [Row(item.kind, Ink((item.stroke,)), f"w{item.index % 5}") for item in generate(60, 8)]
    (curve,) = early_curves(rows, ["paper"], 4)
    whole = protocols.examine(rows, protocols.zero_shot(rows), ["paper"])
    recalls = [np.mean([g.right for g in whole if g.label == kind]) for kind in {row.label for row in rows}]
    assert curve.fractions == (0.25, 0.5, 0.75, 1.0)
    assert curve.values[-1].value == pytest.approx(np.mean(recalls))
    assert curve.values[0].value < curve.values[-1].value


# Stress -----------------------------------------------------------------------------------------

page = st.lists(st.integers(2, 40), min_size=1, max_size=4).map(
    lambda counts: Ink(
        tuple(
            Stroke(
                np.column_stack([np.linspace(0, 100, n), 30 * np.sin(np.arange(n) + k)]),
                np.linspace(k, k + 0.8, n),
            )
            for k, n in enumerate(counts)
        )
    )
)


@pytest.mark.parametrize("axis", list(AXES))
@settings(max_examples=15, deadline=None)
@given(ink=page, seed=st.integers(0, 99))
def test_the_first_level_changes_nothing_and_every_other_keeps_the_strokes(axis: str, ink: Ink, seed: int):
    levels = AXES[axis].levels
    assert stressed(ink, axis, levels[0], seed, 0) is ink
    for level in levels[1:]:
        changed = stressed(ink, axis, level, seed, 0)
        assert changed == stressed(ink, axis, level, seed, 0)
        assert len(changed) == len(ink)
        assert all(len(stroke) >= 2 for stroke in changed)


def test_each_axis_does_what_it_says():
    n = 200
    line = Ink((Stroke(np.column_stack([np.linspace(0, 100, n), np.zeros(n)]), np.linspace(0, 2, n)),))

    def at(axis: str, level: float) -> Stroke:
        return stressed(line, axis, level, 3, 0)[0]

    assert np.diff(at("rate", 10.0).times).mean() == pytest.approx(0.1, rel=0.06)
    assert at("speed", 4.0).times[-1] == pytest.approx(0.5) and len(at("speed", 4.0)) == n // 4 + 1
    assert at("gap", 0.2).points[-1, 0] == pytest.approx(80, abs=0.6)
    assert np.ptp(at("rotation", 90.0).points[:, 0]) == pytest.approx(0, abs=1e-9)
    assert np.ptp(at("scale", 4.0).points[:, 0]) == pytest.approx(400)
    assert at("order", 1.0).points[0, 0] == 100 and at("order", 1.0).times == pytest.approx(line[0].times)
    assert at("time", 1.0).times is None
    shaken = at("tremor", 0.02).points - line[0].points
    assert np.sqrt((shaken**2).sum(axis=1).mean()) == pytest.approx(2.0, rel=0.1)


def test_stress_is_the_contest_at_the_first_level_and_the_worst_group_the_lowest():
    made = generate(45, 6)
    curves = stroke_curves(Trial(("paper",), ("gap", "order"), 45, 6))
    right = protocols.examine(
        [Row(item.kind, Ink((item.stroke,))) for item in made],
        [protocols.Split((), tuple(range(45)), 0, 0)],
        ["paper"],
    )
    recalls = [np.mean([g.right for g in right if g.label == kind]) for kind in {item.kind for item in made}]
    assert [curve.axis for curve in curves] == ["gap", "order"]
    assert [curve.values[0].value for curve in curves] == pytest.approx([float(np.mean(recalls))] * 2)
    (one,) = groups(["paper"], 30, 6)
    assert list(one.values) == ["adult", "child", "tremor", "low_vision"]
    assert one.values[one.worst].value == min(value.value for value in one.values.values())


# Confidence -------------------------------------------------------------------------------------


@given(st.lists(st.tuples(st.floats(0, 1), st.booleans()), min_size=1, max_size=40))
def test_reliability_and_risk_count_every_claim(claims: list[tuple[float, bool]]):
    sure, right = [a for a, _ in claims], [b for _, b in claims]
    bins = reliability(sure, right)
    assert sum(one.n for one in bins) == len(claims)
    assert sum(one.n * one.right for one in bins) == pytest.approx(sum(right))
    risk = risk_coverage(sure, right)
    assert risk.coverage[-1] == pytest.approx(1)
    assert risk.risk[-1] == pytest.approx(1 - np.mean(right))
    assert all(a < b for a, b in pairwise(risk.coverage))


def test_refusing_the_unsure_leaves_the_surest_errors():
    risk = risk_coverage([0.9, 0.8, 0.7, 0.6], [True, True, False, True])
    assert risk.risk == pytest.approx((0, 0, 1 / 3, 1 / 4))
    assert (risk.at(0.5), risk.at(0.75), risk.at(1.0)) == pytest.approx((0, 1 / 3, 1 / 4))
    assert risk.area == pytest.approx((0 + 0 + 1 / 3 + 1 / 4) / 4)
    assert risk_coverage([0.5] * 4, [True, False] * 2).coverage == (1.0,)
    assert risk_coverage([], []).area is None
