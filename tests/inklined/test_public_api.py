"""The public functions: a page in, its meaning and its motion out."""

from __future__ import annotations

import pytest

import inklined
from data_gen.pages import page
from sketch.files import document
from sketch.ink import Ink


def test_ink_and_the_file_that_holds_it_are_read_alike_but_for_typed_mathematics(tmp_path):
    drawn = page("pendulum", 8, 3)
    document.write(tmp_path / "page.inklined", drawn.truth)
    from_file = inklined.analyze(tmp_path / "page.inklined", "geometric")
    from_ink = inklined.analyze(drawn.truth.ink, "geometric")
    assert from_file.components == from_ink.components
    assert all(written.text is None for written in from_ink.expressions)
    assert {written.text for written in from_file.expressions} >= {
        written.text for written in drawn.truth.expressions
    }


def test_what_was_read_can_be_moved():
    drawn = page("mass-on-spring", 8, 1)
    motion = inklined.move(inklined.analyze(drawn.truth.ink, "learned"), seconds=0.5, rate=60)
    assert motion.trajectory.times[-1] == pytest.approx(0.5)
    solids = [part for part in drawn.truth.components if part.kind in ("circle", "polygon")]
    assert len(motion.trajectory.bodies) == len(solids) > 1


@pytest.mark.parametrize(("answer", "status"), [("right", "right"), ("low", "wrong"), ("high", "wrong")])
def test_the_answer_on_a_page_is_judged(answer, status):
    drawn = page("incline-and-ball", 8, 3, answer)
    (verdict,) = inklined.judge(drawn.truth)
    assert verdict.status == status
    assert verdict.error == pytest.approx({"right": 0.0, "low": 0.1, "high": 0.1}[answer], abs=1e-9)


def test_compare_scores_those_who_are_named():
    (paper,) = inklined.compare(recognizers=["paper"], strokes=45, seed=1)
    assert paper.name == "paper"
    assert paper.scores.n == 45


def test_an_empty_page_is_read_and_stands_still():
    motion = inklined.move(inklined.analyze(Ink(), "paper"))
    assert motion.trajectory.bodies == ()


def test_an_unknown_recognizer_is_refused_by_name():
    with pytest.raises(ValueError, match="magic"):
        inklined.analyze(Ink(), "magic")
