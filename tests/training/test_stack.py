"""Laws of the fit of the hybrid's two weights."""

from __future__ import annotations

import json

import numpy as np
import pytest

from recognizer.hybrid import load, logged
from sketch.page import STROKE_KINDS
from training.stack import Heard, fit, main


def heard(bold: float, noise: float) -> Heard:
    """A net whose log odds are `bold` times what is true, and a geometry that says something of its own."""
    rng = np.random.default_rng(4)
    logits = 1.5 * rng.standard_normal((6000, len(STROKE_KINDS)))
    true = softmax(logits)
    kind = (true.cumsum(axis=1) > rng.random((6000, 1))).argmax(axis=1)
    alone = softmax(noise * rng.standard_normal(logits.shape))
    return Heard(softmax(bold * logits), alone, alone, kind)


def softmax(logits: np.ndarray) -> np.ndarray:
    shares = np.exp(logits - logits.max(axis=1, keepdims=True))
    return shares / shares.sum(axis=1, keepdims=True)


def test_who_knows_is_heard_and_who_knows_nothing_is_not():
    told = heard(1.0, 1.0)
    stack = fit(told, told)
    assert stack.net == pytest.approx(1, abs=0.06)
    assert stack.geometry == pytest.approx(0, abs=0.06)


def test_who_is_half_as_bold_as_he_may_be_is_heard_twice():
    told = heard(0.5, 1.0)
    assert fit(told, told).net == pytest.approx(2, abs=0.12)


def test_a_page_that_tells_what_the_net_does_not_is_heard():
    told = heard(1.0, 1.0)
    blind = Heard(np.full_like(told.net, 1 / len(STROKE_KINDS)), told.alone, told.page, told.kind)
    telling = Heard(blind.net, blind.alone, softmax(np.log(told.alone) + np.log(told.net)), told.kind)
    assert fit(told, telling).context == pytest.approx(1, abs=0.1)
    assert fit(told, Heard(told.net, told.alone, telling.page[::-1], told.kind)).context < 0.1


def test_the_fit_is_no_worse_on_what_it_was_fitted_to_than_either_alone():
    told = heard(2.0, 0.5)
    swapped = Heard(told.alone, told.net, told.net, told.kind)
    for each in (told, swapped):
        both = fit(each, each).shares(each.net, each.alone, each.page)
        losses = [
            -logged(scores)[np.arange(len(each.kind)), each.kind].mean()
            for scores in (both, each.net, each.alone)
        ]
        # Of lassos that geometry does not find the net alone is heard.
        assert losses[0] <= min(losses[1:]) + 0.05


def test_the_command_writes_weights_that_the_hybrid_loads(tmp_path):
    out = tmp_path / "hybrid.json"
    assert main(["--strokes", "100", "--pages", "3", "--seed", "5", "--out", str(out)]) == 0
    assert load(out).net > 0
    told = json.loads(out.read_text())
    assert told["command"] == "python -m training.stack --strokes 100 --pages 3 --seed 5"
    for place in ("strokes", "on_pages"):
        assert set(told["held_out"][place]) == {"geometric", "learned", "hybrid"}
