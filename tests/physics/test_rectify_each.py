"""No correction makes an associated value worse: each of them, on generated pages that pens drew.

The pages are the two worked examples (E6: ball on an incline, E7: box on two wires) and every textbook problem with
an angle, as an oracle reads them, so that nothing but the hand and the fit is between what was meant and what is
corrected; and pages with everything on them, shaken. Angles in radians.
"""

from __future__ import annotations

from functools import cache

import pytest
from physics_workshop import ANGLES, angles_off, shaken, workshop

from data_gen.pages import page as generated
from data_gen.problems import ANSWERS
from data_gen.textbook.roster import names
from evaluation.textbook import drawn
from evaluation.textbook_pens import penned
from physics.rectify import rectify, undo
from physics.rectify.correction import reshaped, with_anchors
from recognizer.interpret import interpret, notes_of
from recognizer.oracle import Oracle
from sketch.page import Sketch

ROUNDING = 1e-9
EXAMPLES = [
    (name, answer, index)
    for name in ("incline-and-ball", "box-on-two-wires")
    for answer in ANSWERS[name]
    for index in range(8)
]


@cache
def _angled() -> list[tuple[str, str]]:
    """Textbook problems that say an angle of something."""
    return [
        name
        for name in names()
        if any(remark.about and remark.text.startswith(ANGLES) for remark in drawn(name, 5, 0).given)
    ]


def read(truth: Sketch) -> Sketch:
    return interpret(truth.ink, Oracle(truth), notes_of(truth))


def worse(before: dict[str, float], after: dict[str, float]) -> dict[str, float]:
    """By how much which angles have become worse."""
    return {
        label: after[label] - off
        for label, off in before.items()
        if label in after and after[label] > off + ROUNDING
    }


def assert_each_is_harmless(sketch: Sketch) -> None:
    corrected = rectify(sketch)
    now, was = sketch, angles_off(sketch)
    for one in corrected.corrections:
        now = with_anchors(now, reshaped(now, {one.component: one.after}))
        off = angles_off(now)
        assert not worse(was, off), (one.key, one.component)
        was = off
    # And none of them is better left out: every angle is as near to what is said of it as without it.
    whole = angles_off(corrected.sketch)
    for index, one in enumerate(corrected.corrections):
        assert not worse(angles_off(undo(corrected, index).sketch), whole), one.key
    assert all(off < ROUNDING for off in whole.values())


@pytest.mark.parametrize(("name", "answer", "index"), EXAMPLES)
def test_no_correction_of_a_worked_example_that_a_pen_drew_makes_an_angle_worse(
    name: str, answer: str, index: int
) -> None:
    assert_each_is_harmless(read(generated(name, 31, index, answer).truth))


@pytest.mark.parametrize("name", _angled(), ids=": ".join)
@pytest.mark.parametrize("index", range(2))
def test_no_correction_of_a_textbook_page_that_a_pen_drew_makes_an_angle_worse(
    name: tuple[str, str], index: int
) -> None:
    assert_each_is_harmless(read(penned(name, 31, index).truth))


@pytest.mark.parametrize("seed", range(12))
def test_no_correction_of_a_crowded_page_makes_an_angle_worse(seed: int) -> None:
    assert_each_is_harmless(shaken(workshop(seed), 1.5, seed))
