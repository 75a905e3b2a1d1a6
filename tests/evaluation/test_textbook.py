"""Every textbook problem, judged: right is right, wrong is wrong, and most misconceptions are named.

The full run, 25 draws each, is `inklined problems`; here one draw of each.
"""

import pytest

from data_gen.textbook.roster import names
from evaluation.textbook import by_family, drawn, judge, judge_problems, shares, summary, tables
from evaluation.textbook_pens import penned, pens_summary, pens_table, read_problems

EVERY = list(names())
POINT_MASS = ("pendulum", "energy: struck pendulum")
"""Problems whose closed form speaks of a point, where the engine moves a ball."""


@pytest.mark.parametrize("name", EVERY)
def test_right_answers_are_right_wrong_ones_wrong_and_the_engine_finds_the_closed_form(name):
    made = drawn(name, 5, 0)
    close = 3e-3 if made.name.startswith(POINT_MASS) else 1e-7
    for answer in made.answers:
        verdict = judge(made, answer)
        assert verdict is not None
        assert verdict.status == ("right" if answer.misconception is None else "wrong"), verdict
        assert verdict.true == pytest.approx(made.value, rel=close)
        assert verdict.bound is not None
        assert verdict.bound <= 1e-6 * abs(made.value)
        assert close == 3e-3 or abs(verdict.true - made.value) <= max(verdict.bound, 1e-7 * abs(made.value))


def test_the_misconception_is_named_in_nine_of_ten_wrong_answers():
    judged = judge_problems(EVERY, draws=1, seed=6)
    found = shares(judged)
    assert found.problems == len(EVERY)
    assert found.right == 1.0
    assert found.wrong == 1.0
    assert found.named is not None
    assert found.named >= 0.9
    plain = summary(judged, 1, 6)
    assert plain["problems"] == len(EVERY)
    assert plain["misconception_named"] == found.named
    assert list(plain["families"]) == list(by_family(judged))
    assert len(tables(judged)) == 1  # nothing was judged otherwise


def test_problems_that_pens_drew_are_read_and_move_as_was_meant():
    chosen = [("incline", "acceleration"), ("projectile", "greatest height")]
    read = read_problems(chosen, pens=1, seed=3, recognizers=("oracle",))
    assert [one.name for one in read] == chosen
    assert all(one.same for one in read)
    assert pens_summary(read)["oracle"]["pages"] == 2
    assert pens_table(read).rows[-1][0] == "all"
    assert penned(chosen[0], 3, 0).truth == penned(chosen[0], 3, 0).truth
