"""The contract of every published rival, whatever it learns with; and laws of calibration and rejection."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import inks

from data_gen import ideals
from data_gen.strokes import generate
from recognizer.calibrated import RULE, Calibrated, Calibration, calibrate, temperature
from recognizer.published import PUBLISHED
from recognizer.samples import Sample, labelled
from sketch.geometry import resample
from sketch.ink import Ink, Stroke
from sketch.page import STROKE_KINDS

NAMES = list(PUBLISHED)
KINDS = ("circle", "polygon", "spring", "wire", "math")
MIX = dict.fromkeys(KINDS, 0.2)
SAMPLES = [Sample(Ink((item.stroke,)), item.kind) for item in generate(60, 31, mix=MIX)]
HELD_OUT = [Sample(Ink((item.stroke,)), item.kind) for item in generate(60, 32, mix=MIX)]
NOISE = [Ink((Stroke(np.random.default_rng(k).standard_normal((25, 2)) * 60),)) for k in range(30)]
"""Random heaps of lines: of no kind."""
TAUGHT: dict[str, Calibrated] = {}


def taught(name: str) -> Calibrated:
    if name not in TAUGHT:
        scorer = PUBLISHED[name].trainer()(SAMPLES, np.random.default_rng(5))
        TAUGHT[name] = Calibrated(name, scorer, calibrate(scorer, HELD_OUT, NOISE))
    return TAUGHT[name]


def mapped(ink: Ink, change) -> Ink:
    return Ink(tuple(Stroke(change(stroke.points), stroke.times) for stroke in ink))


@pytest.mark.parametrize("name", NAMES)
def test_it_bears_its_name_and_claims_what_it_was_shown_and_dots(name):
    assert taught(name).name == name
    assert taught(name).claims == {*KINDS, "tap"}


@pytest.mark.parametrize("name", NAMES)
def test_it_knows_what_it_was_shown(name):
    claims = taught(name).classify([sample.ink for sample in SAMPLES])
    right = np.mean([claim.kind == sample.kind for claim, sample in zip(claims, SAMPLES, strict=True)])
    # Templates are nearest to themselves; straight boundaries (Rubine's, the regression's) cannot follow every sample.
    assert right == 1.0 if PUBLISHED[name].matcher else right > 0.75


@pytest.mark.parametrize("name", NAMES)
def test_it_reads_strangers_strokes_far_better_than_chance(name):
    claims = taught(name).classify([sample.ink for sample in HELD_OUT])
    assert np.mean([claim.kind == sample.kind for claim, sample in zip(claims, HELD_OUT, strict=True)]) > 0.45


@pytest.mark.parametrize("name", NAMES)
@given(scale=st.floats(0.3, 5.0), x=st.floats(-3e3, 3e3), y=st.floats(-3e3, 3e3))
@settings(max_examples=5, deadline=None)
def test_moving_and_scaling_a_drawing_changes_no_claim(name, scale, x, y):
    inks = [sample.ink for sample in SAMPLES[:10]]
    moved = [mapped(ink, lambda points: scale * points + (x, y)) for ink in inks]
    before, after = (taught(name).classify(drawn) for drawn in (inks, moved))
    # The likeliest kind but where two are as likely to within rounding ($Q's points are whole numbers).
    for one, other in zip(before, after, strict=True):
        assert other.score(one.kind) > other.confidence - 0.05


@pytest.mark.parametrize("name", NAMES)
def test_claims_are_probabilities_over_the_kinds_it_knows(name):
    unknown = [STROKE_KINDS.index(kind) for kind in STROKE_KINDS if kind not in KINDS]
    for claim in taught(name).classify([*NOISE, *(sample.ink for sample in HELD_OUT)]):
        assert claim.scores.sum() == pytest.approx(1)
        assert claim.scores[unknown] == pytest.approx(0)


@pytest.mark.parametrize("name", NAMES)
def test_a_page_has_one_claim_a_stroke_and_neighbours_change_none_but_dots(name):
    strokes = [sample.ink[0] for sample in HELD_OUT[:8]]
    dot = Stroke([(500.0, 500.0), (500.4, 500.0)], [0.0, 0.05])
    claims = taught(name).recognize(Ink((*strokes, dot)))
    assert [claim.kind for claim in claims[:8]] == [
        claim.kind for claim in taught(name).classify([Ink((stroke,)) for stroke in strokes])
    ]
    assert claims[8].kind == "tap"
    assert taught(name).recognize(Ink()) == ()


BAD = {
    "one point": Ink((Stroke([(5, 5)]),)),
    "identical points": Ink((Stroke([(5, 5)] * 40), Stroke([(7, 7)] * 3))),
    "two points": Ink((Stroke([(0, 0), (100, 0)]),)),
    "there and back": Ink((Stroke([(0, 0), (100, 0), (0, 0)]),)),
    "far away": Ink((Stroke(ideals.circle((9e8, -9e8), 5)),)),
    "huge": Ink((Stroke(1e8 * ideals.circle((0, 0), 5)),)),
    "10,000 points": Ink((Stroke(resample(ideals.circle((0, 0), 50), 10_000)),)),
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("what", BAD)
def test_any_ink_gets_one_claim_a_stroke(name, what):
    assert len(taught(name).recognize(BAD[what])) == len(BAD[what])
    assert len(taught(name).classify([BAD[what]])) == 1


@pytest.mark.parametrize("name", NAMES)
@given(ink=inks())
@settings(max_examples=10, deadline=None)
def test_any_ink_that_was_accepted_is_read(name, ink):
    assert len(taught(name).recognize(ink)) == len(ink)


@pytest.mark.parametrize("name", NAMES)
def test_the_same_lesson_gives_the_same_rival_and_it_survives_being_stored(name):
    again = PUBLISHED[name].trainer()(SAMPLES, np.random.default_rng(5))
    stored = pickle.loads(pickle.dumps(taught(name)))
    drawings = [sample.ink for sample in HELD_OUT[:12]]
    evidence, familiar = again.weigh(drawings)
    assert taught(name).strangeness(drawings) == pytest.approx(stored.strangeness(drawings), rel=1e-12)
    assert evidence.argmax(axis=1).tolist() == [
        again.kinds.index(claim.kind) for claim in stored.classify(drawings)
    ]
    assert np.isfinite(familiar).all()


@pytest.mark.parametrize("name", NAMES)
def test_one_sample_of_each_kind_and_one_of_one_kind_are_enough_to_learn(name):
    one_each = [next(sample for sample in SAMPLES if sample.kind == kind) for kind in KINDS]
    for samples in (one_each, one_each[:2], one_each[:1]):
        scorer = PUBLISHED[name].trainer()(samples, np.random.default_rng(1))
        evidence, familiar = scorer.weigh([sample.ink for sample in HELD_OUT])
        assert evidence.shape == (len(HELD_OUT), len(samples))
        assert np.isfinite(evidence).all() and np.isfinite(familiar).all()
    assert calibrate(scorer, HELD_OUT, NOISE).temperature > 0


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_learnt_from_nothing(name):
    with pytest.raises(ValueError, match="nothing to learn from"):
        PUBLISHED[name].trainer()([], np.random.default_rng(0))


@pytest.mark.parametrize("name", NAMES)
def test_most_of_what_is_of_a_kind_is_kept_and_what_is_of_none_looks_stranger(name):
    held_out = [sample.ink for sample in HELD_OUT]
    kept = [not claim.rejected for claim in taught(name).classify(held_out)]
    assert np.mean(kept) == pytest.approx(RULE.keep, abs=0.02)
    ours, theirs = taught(name).strangeness(held_out), taught(name).strangeness(NOISE)
    assert np.mean(theirs[:, None] > ours) > 0.7  # the area under the curve; 0.5 tells nothing


def test_a_drawing_in_two_strokes_is_one_to_those_that_look_past_order():
    square = np.array([(0, 0), (100, 0), (100, 100), (0, 100), (0, 0)], dtype=float)
    one = Ink((Stroke(resample(square, 81)),))
    two = Ink((Stroke(resample(square[2:], 41)), Stroke(resample(square[:3][::-1], 41))))
    for name in ("dollar-p", "dollar-q"):
        first, second = taught(name).classify([one, two])
        assert first.kind == second.kind


def test_a_sample_without_strokes_is_refused():
    with pytest.raises(ValueError, match="a sample of wire without strokes"):
        Sample(Ink(), "wire")


def test_labels_are_in_the_order_of_the_kinds():
    kinds, labels = labelled([SAMPLES[0], Sample(SAMPLES[0].ink, "math"), Sample(SAMPLES[0].ink, "circle")])
    assert list(kinds) == sorted(kinds, key=STROKE_KINDS.index)
    assert [kinds[label] for label in labels[1:]] == ["math", "circle"]


def test_the_temperature_of_evidence_that_is_true_is_one_and_of_bold_evidence_more():
    rng = np.random.default_rng(3)
    logits = rng.standard_normal((20_000, 4)) * 2
    shares = np.exp(logits) / np.exp(logits).sum(axis=1, keepdims=True)
    truth = (shares.cumsum(axis=1) > rng.random((20_000, 1))).argmax(axis=1)
    assert temperature(logits, truth) == pytest.approx(1, abs=0.05)
    assert temperature(3 * logits, truth) == pytest.approx(3, abs=0.15)


def test_calibration_needs_held_out_samples_of_what_the_scorer_knows():
    scorer = PUBLISHED["penny-pincher"].trainer()(SAMPLES, np.random.default_rng(1))
    with pytest.raises(ValueError, match="no held-out sample of circle, polygon"):
        calibrate(scorer, [Sample(SAMPLES[0].ink, "lasso")], NOISE)


def test_without_strangers_the_rarest_of_the_kinds_are_rejected():
    scorer = PUBLISHED["penny-pincher"].trainer()(SAMPLES, np.random.default_rng(1))
    found = calibrate(scorer, HELD_OUT, [])
    assert found.weights == (1.0, 1.0)
    assert isinstance(found, Calibration)
