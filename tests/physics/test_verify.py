"""Laws of verdicts: what is right is right however it is written, what is wrong is wrong, what is open is open."""

from math import cos, pi, sin, sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from physics_pages import ball_on_incline, box_on_wires, page, rectangle

from physics.rectify import rectify
from physics.verify import verify
from physics.verify.asked import asked
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Wire

G = 9.81


def verdicts(sketch: Sketch):
    return verify(rectify(sketch).sketch)


def incline(answer: str, *given: tuple[str, str | None]) -> Sketch:
    """The ball B of 2 kg on a smooth incline A of 30 degrees, with an answer of the ball."""
    drawn = ball_on_incline()
    remarks = (("theta = pi/6", "A", (150.0, 390.0)), ("m = 2", "B", None))
    extra = tuple((text, label, None) for text, label in given)
    return page(drawn.components, (*remarks, *extra, (answer, "B", None)))


def dropped(answer: str, *given: tuple[str, str | None]) -> Sketch:
    """A ball A of radius 0.2 m whose middle is 2.2 m above the floor B."""
    return page(
        (
            Component(Circle((300.0, 80.0), 20.0), label="A"),
            Component(rectangle(50, 300, 550, 340), label="B", fixed=True),
        ),
        (*((text, label, None) for text, label in given), (answer, "A", None)),
    )


@pytest.mark.parametrize(
    ("answer", "true"),
    [
        ("N = |W| cos(theta)", 2 * G * cos(pi / 6)),
        ("N = m g cos(theta)", 2 * G * cos(pi / 6)),
        ("f_1 = 16.99", 2 * G * cos(pi / 6)),
        ("f_1 = 17.0", 2 * G * cos(pi / 6)),
        ("a = g sin(theta)", G / 2),
        ("a = 4.905", G / 2),
        ("a = 4.9", G / 2),
        ("a_y = -g sin(theta)^2", -G / 4),
        ("v_t = g sin(theta) t", 0.3 * G / 2),
        ("p_t = m g sin(theta) t", 0.3 * G),
        ("E_kt = 1/2 m (g sin(theta) t)^2", (0.3 * G / 2) ** 2),
    ],
)
def test_the_right_answer_is_right_however_it_is_written(answer, true):
    (verdict,) = verdicts(incline(answer, ("t = 0.3", None)))
    assert verdict.status == "right"
    assert verdict.true == pytest.approx(true if answer[0] != "a" or "_y" in answer else G / 2, rel=1e-9)
    assert verdict.bound is not None
    assert abs(verdict.true - true) <= max(verdict.bound, 1e-9) or answer.startswith("a =")


@pytest.mark.parametrize(
    ("answer", "cause"),
    [
        ("N = |W| sin(theta)", "sine for cosine"),
        ("N = 9.81", "sine for cosine"),
        ("N = m cos(theta)", "forgot g"),
        ("N = 1.732", "forgot g"),
        ("N = -16.99", "wrong sign"),
        ("N = 33.98", "factor 2"),
        ("N = 3.026", "degrees for radians"),
        ("N = |W| g cos(theta)", "weight for mass"),
        ("N = 166.7", "weight for mass"),
        ("N = 5", None),
    ],
)
def test_a_wrong_answer_is_explained_where_a_known_misconception_made_it(answer, cause):
    (verdict,) = verdicts(incline(answer))
    assert verdict.status == "wrong"
    assert verdict.misconception == cause
    assert verdict.true == pytest.approx(2 * G * cos(pi / 6), rel=1e-9)
    assert verdict.error == pytest.approx(abs(verdict.given - verdict.true) / verdict.true)
    assert answer in verdict.message


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        ("N = 15.29", "it is 16.99 N, so this is 10 % too small"),
        ("N = 17.5", "it is 16.99 N, so this is 3 % too great"),
        ("N = 166.7", "it is 16.99 N, so this is 9.8 times as much; it seems that the weight was put"),
        ("N = -16.99", "it is 16.99 N; it seems that a sign"),
    ],
)
def test_how_far_off_an_answer_is_is_said_as_people_say_it(answer, says):
    (verdict,) = verdicts(incline(answer))
    assert says in verdict.message


def test_a_number_rounded_to_fewer_digits_than_three_is_wrong_and_that_is_said():
    (coarse,) = verdicts(incline("a = 5"))
    assert (coarse.status, coarse.misconception) == ("wrong", "rounded too coarsely")
    (far,) = verdicts(incline("N = 20"))
    assert (far.status, far.misconception) == ("wrong", None)


@settings(max_examples=25, deadline=None)
@given(st.floats(-1e4, 1e4).map(lambda value: round(value, 3)))
def test_the_true_value_does_not_hang_on_the_answer(value):
    """The answer governs nothing while it is judged; and it is right exactly where it is near."""
    (verdict,) = verdicts(incline(f"N = {value:.3f}"))
    true = 2 * G * cos(pi / 6)
    assert verdict.true == pytest.approx(true, rel=1e-9)
    assert verdict.status == ("right" if abs(value - true) <= 0.005 * true else "wrong")


def test_a_wrong_tension_of_one_wire_does_not_make_the_right_one_of_the_other_wrong():
    """E7: both wires must carry 5√2 N."""
    found = {verdict.name: verdict for verdict in verdicts(box_on_wires("6", "5 sqrt(2)"))}
    assert found["T_1"].status == "wrong"
    assert found["T_2"].status == "right"
    assert all(one.true == pytest.approx(5 * sqrt(2), rel=1e-9) for one in found.values())


def test_what_hangs_on_a_mass_that_nobody_gave_is_not_determined_but_a_formula_can_be_right():
    drawn = ball_on_incline()
    angle = ("theta = pi/6", "A", (150.0, 390.0))
    (number,) = verdicts(page(drawn.components, (angle, ("N = 3", "B", None))))
    assert number.status == "not determined"
    assert "the mass of B" in number.message
    (formula,) = verdicts(page(drawn.components, (angle, ("N = |W| cos(theta)", "B", None))))
    assert formula.status == "right"
    (wrong,) = verdicts(page(drawn.components, (angle, ("N = |W| sin(theta)", "B", None))))
    assert wrong.status == "wrong"
    assert wrong.misconception == "sine for cosine"


@pytest.mark.parametrize(
    ("answer", "given", "true"),
    [
        ("v_f = 6.264", (), sqrt(2 * G * 2)),
        ("t_f = sqrt(4/g)", (), sqrt(4 / G)),
        ("v_yf = -6.264", (), -sqrt(2 * G * 2)),
        ("v_ya = 3.132", (("e = 0.5", "A"),), sqrt(2 * G * 2) / 2),
        ("x_f = 1.915", (("v_x = 3", "A"),), 3 * sqrt(4 / G)),
        ("h_max = 0.4587", (("v_y = 3", "A"),), 9 / (2 * G)),
        ("v_yt = -1.905", (("v_y = 3", "A"), ("t = 0.5", None)), 3 - G / 2),
        ("y_t = 0.2737", (("v_y = 3", "A"), ("t = 0.5", None)), 1.5 - G / 8),
    ],
)
def test_moments_are_what_the_convention_says(answer, given, true):
    (verdict,) = verdicts(dropped(answer, *given))
    assert verdict.status == "right", verdict.message
    assert verdict.true == pytest.approx(true, rel=1e-7)


@pytest.mark.parametrize(
    ("sketch", "reason"),
    [
        (dropped("v_t = 3"), "gives no time"),
        (dropped("t_s = 3", ("g = 0", None), ("v_x = 1", "A")), "does not stop"),
        (dropped("T = 2", ("g = 0", None)), "does not move to and fro"),
        (dropped("v_f = 2", ("g = 0", None)), "meets nothing"),
        (dropped("N = 2"), "rests on nothing"),
        (dropped("v_f = 2 q"), "nowhere explained"),
        (dropped("x_max = 2", ("v_x = 1", "A"), ("g = 0", None)), "still changing"),
    ],
)
def test_what_the_page_does_not_settle_is_not_determined_and_why_is_said(sketch, reason):
    (verdict,) = verdicts(sketch)
    assert verdict.status == "not determined"
    assert verdict.true is None
    assert reason in verdict.message


@pytest.mark.parametrize(
    ("answer", "said"),
    [("a = 490.5 cm/s^2", "cm"), ("a = 0.004905 km/s^2", "km")],
)
def test_units_are_converted_and_the_conversion_is_told(answer, said):
    (verdict,) = verdicts(incline(answer))
    assert verdict.status == "right", verdict.message
    assert verdict.given == pytest.approx(G / 2, rel=1e-3)
    assert verdict.converted is not None
    assert said in verdict.converted


def test_a_right_number_of_the_wrong_dimension_is_wrong_and_the_term_is_named():
    (verdict,) = verdicts(incline("a = 4.905 m/s"))
    assert verdict.status == "wrong"
    assert verdict.finding is not None
    assert verdict.finding.message in verdict.message
    (formula,) = verdicts(incline("a = |W| sin(theta)"))
    assert formula.status == "wrong"
    assert formula.finding is not None
    (fine,) = verdicts(incline("a = g sin(theta)"))
    assert fine.finding is None


def test_what_is_given_is_no_answer():
    for name in ("m", "mu", "e", "v", "v_0", "v_x", "v_y", "x", "y", "omega", "theta", "F_x", "g", "t"):
        assert asked(name, "circle") is None
    assert asked("T_1", "wire") is not None
    assert asked("L", "wire") is None
    assert asked("k", "spring") is None


def test_a_page_without_answers_has_no_verdicts_and_one_of_nonsense_does_not_raise():
    assert verify(Sketch()) == ()
    for text in ("N = ", "N = 1/0", "a = a", "v_f = sqrt(-1)", "T = (1, 2)", "N = x + t", "= 3"):
        for sketch in (incline(text), dropped(text)):
            assert all(one.status != "right" for one in verdicts(sketch))


def test_the_order_of_drawing_and_of_writing_changes_no_verdict():
    sketch = box_on_wires("6", "5 sqrt(2)")
    turned = Sketch(
        components=sketch.components[::-1],
        expressions=sketch.expressions,
        associations=sketch.associations[::-1],
    )
    plain, other = ({one.name: one for one in verdicts(page)} for page in (sketch, turned))
    for name, verdict in plain.items():
        assert other[name].status == verdict.status
        assert other[name].true == pytest.approx(verdict.true, rel=1e-9)
        assert other[name].misconception == verdict.misconception


def test_a_wires_tension_through_a_swing_is_greatest_at_the_bottom():
    """A ball on a long wire, let go at 60°: m g (3 − 2 cos 60°) = 2 m g, but for the ball's own size."""
    length, radius = 200.0, 6.0
    way = (sin(pi / 3), cos(pi / 3))
    low = (300 + length * way[0], 60 + length * way[1])
    centre = (low[0] + radius * way[0], low[1] + radius * way[1])
    swing = page(
        (
            Component(rectangle(250, 20, 350, 60), label="A", fixed=True),
            Component(Wire((300.0, 60.0), low), label="B", ends=("A", "C")),
            Component(Circle(centre, radius), label="C"),
        ),
        (("m = 2", "C", None), ("T_max = 39.2", "B", None)),
    )
    (verdict,) = verdicts(swing)
    assert verdict.status == "right"
    assert verdict.true == pytest.approx(2 * 2 * G, rel=2e-3)
