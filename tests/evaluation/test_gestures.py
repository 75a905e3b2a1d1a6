"""GREAT's and AGATe's measures: by hand, by what must not change them, and by the papers' own figures."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evaluation.gestures import agreement
from evaluation.gestures.elicitation import elicitation, rate_interval
from evaluation.gestures.relative import relative_accuracy, resampled, task_axis
from evaluation.gestures.tables import MEASURES, study
from sketch.files.jsonl import Row
from sketch.ink import Ink, Stroke


def drawing(*paths, seconds: float | None = 1.0) -> Ink:
    """Strokes along these paths, each at an even pace for so long, one after another."""
    strokes, begun = [], 0.0
    for path in paths:
        points = np.asarray(path, dtype=float)
        times = None if seconds is None else begun + np.linspace(0, seconds, len(points))
        strokes.append(Stroke(points, times))
        begun += (seconds or 0) + 0.2
    return Ink(tuple(strokes))


LINE = np.column_stack([np.linspace(0, 100, 50), np.zeros(50)])
BEND = np.array([[0, 0], [50, 0], [50, 50]], dtype=float)
CROSS = ([[0, 0], [100, 100]], [[0, 100], [100, 0]])


def test_drawings_that_are_all_alike_have_no_error_at_all():
    for ink in (drawing(LINE), drawing(*CROSS)):
        found = relative_accuracy(ink, task_axis([ink, ink, ink]))
        assert [getattr(found, name) for name in MEASURES] == pytest.approx([0] * 12, abs=1e-9)


def test_a_longer_slower_line_is_so_much_longer_and_slower():
    axis = task_axis([drawing(LINE)])
    found = relative_accuracy(drawing(1.5 * LINE, seconds=3.0), axis)
    assert found.length_error == pytest.approx(50)
    assert found.time_error == pytest.approx(2)
    assert found.speed_error == pytest.approx(50)  # 150 in 3 s against 100 in 1 s
    assert found.shape_error == pytest.approx(np.abs(np.linspace(-25, 25, 32)).mean())
    assert (found.size_error, found.bending_error, found.stroke_error, found.order_error) == pytest.approx(
        (0, 0, 0, 0), abs=1e-9
    )


def test_a_right_angle_bends_by_a_right_angle_and_covers_a_square():
    found = relative_accuracy(drawing(BEND), task_axis([drawing(LINE)]))
    assert found.bending_error * 30 == pytest.approx(np.pi / 2)
    assert found.size_error == pytest.approx(2500)


def test_strokes_in_another_order_cost_order_and_no_more_of_the_shape_than_resampling_does():
    axis = task_axis([drawing(*CROSS)] * 2)
    found = relative_accuracy(drawing(*CROSS[::-1]), axis)
    step = (
        200 * np.sqrt(2) / 31
    )  # the join of the strokes falls between two points: each lies up to half a step beside
    assert found.shape_error <= step / 2
    assert found.order_error > 10 * 32 * found.shape_error
    assert relative_accuracy(drawing(CROSS[0]), axis).stroke_error == -1


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 1000), st.floats(-500, 500), st.floats(-500, 500))
def test_where_a_gesture_stands_does_not_matter(seed: int, x: float, y: float):
    rng = np.random.default_rng(seed)
    inks = [drawing(rng.random((6, 2)) * 80, rng.random((4, 2)) * 80) for _ in range(3)]
    there = Ink(tuple(stroke.moved_to(stroke.points + np.array([x, y])) for stroke in inks[0]))
    axis = task_axis(inks)
    here, moved = (relative_accuracy(ink, axis) for ink in (inks[0], there))
    for name in MEASURES:
        assert getattr(moved, name) == pytest.approx(getattr(here, name), abs=1e-6)


def test_a_single_stroke_s_axis_is_the_mean_and_its_ends_the_ends():
    points, times = resampled(drawing(LINE))
    assert points[:, 0].tolist() == pytest.approx(np.linspace(-50, 50, 32).tolist())
    assert times is not None and times[-1] == pytest.approx(1.0)
    assert resampled(Ink((Stroke([[3, 4]]),)))[0].tolist() == [[0, 0]] * 32
    axis = task_axis([drawing(LINE), drawing(3 * LINE)])
    assert np.ptp(axis.points[:, 0]) == pytest.approx(200)
    with pytest.raises(ValueError, match="one stroke at least"):
        task_axis([Ink()])


# Agreement --------------------------------------------------------------------------------------


def test_the_agreement_rate_is_the_share_of_pairs_who_agree():
    """Vatavu and Wobbrock (2015): 20 participants, of whom 15, 3 and 2 propose the same, agree by (105 + 3 + 1) / 190."""
    proposals = "a" * 15 + "b" * 3 + "c" * 2
    assert agreement.agreement_rate(proposals) == pytest.approx(109 / 190)
    assert agreement.disagreement_rate(proposals) == pytest.approx(81 / 190)
    assert agreement.agreement_rate("a") is None


@given(st.lists(st.tuples(st.sampled_from("ab"), st.sampled_from("ab")), min_size=2, max_size=9))
def test_rates_count_pairs(proposals: list[tuple[str, str]]):
    first, second = [a for a, _ in proposals], [b for _, b in proposals]
    n = len(proposals)
    pairs = [(i, j) for i in range(n) for j in range(n) if i != j]
    both = sum(first[i] == first[j] and second[i] == second[j] for i, j in pairs) / len(pairs)
    assert agreement.coagreement_rate(first, second) == pytest.approx(both)
    across = np.mean([a == b for a in first for b in second])
    assert agreement.between_rate(first, second) == pytest.approx(across)


def test_whether_agreement_differs_is_cochran_s_q_over_pairs():
    """statsmodels 0.15.0: cochrans_q of the 15 pairs' agreements."""
    first, second, third = "aaaaab", "aabbcc", "abcdef"
    assert agreement.agreement_differs(first, second, third) == pytest.approx(
        (REFERENCE_Q, REFERENCE_P), rel=1e-9
    )
    assert agreement.agreement_differs("ab", "ab") == (0.0, 1.0)


REFERENCE_Q, REFERENCE_P = 14.363636363636363, 0.0007602842497212092


def test_ways_of_drawing_are_told_by_directions_and_consistency_by_who_made_them():
    right, down = drawing(LINE), drawing(LINE[:, ::-1])
    assert agreement.way_of(right) == (("right",),) and agreement.way_of(down) == (("down",),)
    assert agreement.way_of(drawing(BEND, [[0, 0]])) == (("right", "down"), ("dot",))
    rows = [Row("x", ink, writer) for ink, writer in ((right, "u"), (right, "u"), (down, "v"), (right, "v"))]
    (found,) = agreement.consistency(rows)
    assert (found.drawings, found.ways) == (4, 2)
    assert found.within == pytest.approx(0.5)
    assert found.between == pytest.approx(0.5)


def test_a_study_of_gestures_has_a_row_for_every_label_and_leaves_out_what_is_not_known():
    rows = [Row(label, drawing(LINE * k, seconds=None), f"w{k}") for label in "ba" for k in (1, 2, 3)]
    tables, figures = study(rows)
    assert [name for name, *_ in tables[0].rows] == ["a", "b"]
    assert figures["relative_accuracy"]["a"]["time_error"] is None
    assert figures["relative_accuracy"]["a"]["length_error"]["value"] == pytest.approx(0, abs=1e-9)
    assert figures["relative_accuracy"]["a"]["shape_error"]["clusters"] == 3
    with pytest.raises(ValueError, match="no row bears a label"):
        study([])


def test_an_elicitation_study_is_read_from_a_table_of_proposals():
    text = "zoom,undo\n" + "".join(
        f"{a},{b}\n" for a, b in zip("p" * 15 + "q" * 3 + "rr", "abcdefghij" * 2, strict=True)
    )
    found = elicitation(text)
    zoom, undo = found.referents
    assert zoom.agreement.value == pytest.approx(109 / 190)
    assert (zoom.agreement.n, zoom.distinct, zoom.favourite, zoom.favoured) == (20, 3, "p", 15)
    assert zoom.agreement.low < 109 / 190 < zoom.agreement.high
    assert undo.agreement.value == pytest.approx(10 / 190)
    assert found.p is not None and found.p < 1e-9
    with_none = elicitation('a\nx\nx\n""\n  \nx\n')  # an empty line is nobody, an empty word no proposal
    assert with_none.referents[0].agreement.n == 3


@pytest.mark.parametrize(
    ("text", "says"),
    [("", "line 1"), ("a,b\nx,y\nz\n", "line 3 has 1 proposals"), ("a\nx\n", "two at least")],
)
def test_a_table_that_is_no_study_says_where(text: str, says: str):
    with pytest.raises(ValueError, match=says):
        elicitation(text)


def test_the_jackknife_interval_of_agreement_holds_the_truth():
    """Proposals drawn with chances 0.6, 0.3, 0.1: two participants agree with chance 0.46."""
    rng = np.random.default_rng(4)
    held = 0
    for _ in range(200):
        found = rate_interval(rng.choice(3, size=25, p=[0.6, 0.3, 0.1]).tolist())
        held += (found.low or 0) <= 0.46 <= (found.high or 0)
    assert held / 200 >= 0.9
