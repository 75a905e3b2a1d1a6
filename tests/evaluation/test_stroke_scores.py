"""Stroke scores against hand-computed values, scikit-learn and the laws they must obey."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.metrics import balanced_accuracy_score, confusion_matrix, f1_score, precision_score, recall_score

from evaluation.metrics.strokes import calibration_error, confusion, score
from recognizer.claims import claim_for
from sketch.page import STROKE_KINDS

kinds = st.sampled_from(STROKE_KINDS)
pairs = st.lists(st.tuples(kinds, kinds, st.floats(0.2, 1.0)), min_size=1, max_size=60)


def scores_of(items):
    return score([true for true, _, _ in items], [claim_for(kind, sure) for _, kind, sure in items])


def test_hand_computed_example():
    truth = ["circle", "circle", "circle", "wire", "math"]
    claims = [claim_for(kind, 0.8) for kind in ("circle", "circle", "wire", "wire", "circle")]
    found = score(truth, claims)
    assert found.n == 5
    assert found.accuracy == pytest.approx(3 / 5)
    assert found.balanced_accuracy == pytest.approx((2 / 3 + 1 + 0) / 3)
    assert found.macro_f1 == pytest.approx((2 * 2 / 6 + 2 * 1 / 3 + 0) / 3)
    assert found.ece == pytest.approx(0.2)
    assert found.per_class["circle"].precision == pytest.approx(2 / 3)
    assert found.per_class["math"].precision is None
    assert list(found.per_class) == ["circle", "wire", "math"]


@settings(max_examples=25, deadline=None)
@given(pairs)
def test_equals_scikit_learn(items):
    found = scores_of(items)
    truth, claimed = [true for true, _, _ in items], [kind for _, kind, _ in items]
    present = [kind for kind in STROKE_KINDS if kind in truth]
    assert found.confusion[:, :-1].tolist() == confusion_matrix(truth, claimed, labels=STROKE_KINDS).tolist()
    recalls = recall_score(truth, claimed, labels=present, average=None)
    precisions = precision_score(truth, claimed, labels=present, average=None, zero_division=0)
    assert found.balanced_accuracy == pytest.approx(recalls.mean())
    assert found.macro_f1 == pytest.approx(f1_score(truth, claimed, labels=present, average="macro"))
    for kind, recall, precision in zip(present, recalls, precisions, strict=True):
        assert found.per_class[kind].recall == pytest.approx(recall)
        assert (found.per_class[kind].precision or 0.0) == pytest.approx(precision)
    if set(claimed) <= set(truth) and len(present) > 1:
        assert found.balanced_accuracy == pytest.approx(balanced_accuracy_score(truth, claimed))


@given(pairs, st.randoms())
def test_the_order_of_items_changes_no_score(items, random):
    shuffled = list(items)
    random.shuffle(shuffled)
    one, other = scores_of(items), scores_of(shuffled)
    assert one.confusion.tolist() == other.confusion.tolist()
    assert one.ece == pytest.approx(other.ece)


@given(st.lists(kinds, min_size=1, max_size=40))
def test_a_perfect_and_certain_claim_scores_one_with_no_calibration_error(truth):
    found = score(truth, [claim_for(kind, 1.0) for kind in truth])
    assert (found.accuracy, found.balanced_accuracy, found.macro_f1, found.ece) == (1.0, 1.0, 1.0, 0.0)


def test_nothing_to_score_is_none_not_a_number():
    found = score([], [])
    assert (found.n, found.accuracy, found.balanced_accuracy, found.macro_f1, found.ece) == (0,) + (None,) * 4
    assert found.per_class == {}


def test_a_stroke_claimed_by_nobody_costs_recall_and_no_precision():
    table = confusion(["wire", "wire"], ["wire", None])
    assert table.sum() == 2
    assert table[STROKE_KINDS.index("wire"), -1] == 1


def test_a_claimer_as_right_as_it_is_sure_has_almost_no_calibration_error():
    rng = np.random.default_rng(7)
    sure = rng.uniform(0.2, 1.0, 40_000)
    assert calibration_error(sure, rng.random(40_000) < sure) < 0.02


def test_an_overconfident_claimers_calibration_error_is_its_excess():
    rng = np.random.default_rng(8)
    sure = rng.uniform(0.5, 1.0, 40_000)
    assert calibration_error(sure, rng.random(40_000) < sure - 0.3) == pytest.approx(0.3, abs=0.01)
