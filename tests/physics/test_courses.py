"""Equations of motion (M7): their derivatives against differences, what is refused, and how pages say them."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from physics_pages import page, rectangle

from physics.build import build
from physics.formula.course import course
from physics.formula.kernel import branches, pack
from physics.formula.program import STATE, Lookup, Node, Program, ProgramError, Reading
from physics.scene import Course, Scene
from sketch.formula.parse import parse
from sketch.page import Component
from sketch.shapes import Circle, Wire

T, X, Y, PHI = (sympy.Symbol(name) for name in ("t", "x", "y", "phi"))


MOTION = (("x", "y", "phi"), ("v_x", "v_y", "omega"))


def tree(text: str) -> Node:
    return parse(f"f = {text}").args[1]


def nobody(_: str) -> None:
    return None


def position(of: Node, names: Lookup = nobody) -> Course:
    return course("x", "B", "x", of, "position", names, "given")


def velocity(of: Node, names: Lookup = nobody) -> Course:
    return course("v_x", "B", "x", of, "velocity", names, "given")


def at(program: Program, **known: float) -> float:
    return program.value([known.get(name, 0.0) for name in STATE])


def smooth(leaves: list[sympy.Basic]) -> st.SearchStrategy[sympy.Basic]:
    """Trees that have derivatives everywhere."""
    numbers = [sympy.Integer(2), sympy.Rational(-3, 4), sympy.Float(0.3), sympy.pi]
    one = st.sampled_from([sympy.sin, sympy.cos, sympy.atan, sympy.tanh, sympy.Abs])
    return st.recursive(
        st.sampled_from([*leaves, *leaves, *numbers]),
        lambda inner: st.one_of(
            st.builds(lambda f, a: f(a), one, inner),
            st.builds(lambda a, b: a + b, inner, inner),
            st.builds(lambda a, b: a * b, inner, inner),
            st.builds(lambda a: a**2, inner),
        ),
        max_leaves=6,
    )


def difference(value: object, step: float = 1e-4) -> float:
    """The derivative at 0, to the fourth order in the step."""
    assert callable(value)
    return (8 * (value(step) - value(-step)) - (value(2 * step) - value(-2 * step))) / (12 * step)


def has_corner(made: Course, state: object) -> bool:
    """Whether an |…| reaches nought near the step 0, where it has no rate of change."""
    return _switches(made.position or made.velocity, state) or _switches(made.acceleration, state)


def _switches(program: Program, state: object) -> bool:
    assert callable(state)
    packed = pack([(program, 0, ())])
    signatures: set[int] = set()
    for step in (-2e-4, -1e-4, 0.0, 1e-4, 2e-4):
        now = state(step)
        pos, vel = np.array([[[now.get(name, 0.0) for name in names]] for names in MOTION])
        stack = np.zeros(packed.depth)
        program_at = (packed.ops, packed.args, packed.who, 0, len(packed.ops), now["t"])
        signatures.add(branches(*program_at, pos, vel, stack))
    return len(signatures) > 1


def agree(found: float, wanted: float) -> bool:
    return found == pytest.approx(wanted, rel=1e-6, abs=1e-6)


@settings(max_examples=100, deadline=None)
@given(smooth([T]), st.floats(-2, 2))
def test_a_position_s_velocity_and_acceleration_are_its_rates_of_change(of: sympy.Basic, t: float) -> None:
    try:
        made = position(of)
    except ProgramError as error:
        assert "too long" in str(error)
        return
    assert made.position is not None
    assert at(made.position, t=t) == pytest.approx(float(of.subs(T, t)), rel=1e-9, abs=1e-9)
    if has_corner(made, lambda step: {"t": t + step}):
        return
    for lower, higher in ((made.position, made.velocity), (made.velocity, made.acceleration)):
        rate = difference(lambda step, program=lower: at(program, t=t + step))
        assert agree(at(higher, t=t), rate)


@settings(max_examples=100, deadline=None)
@given(smooth([T, X, Y, PHI]), st.tuples(*[st.floats(-2, 2)] * 7))
def test_a_velocity_s_acceleration_is_its_rate_of_change_along_the_motion(
    of: sympy.Basic, now: tuple[float, ...]
) -> None:
    t, x, y, phi, v_x, v_y, omega = now
    try:
        made = velocity(of)
    except ProgramError as error:
        assert "too long" in str(error)
        return
    assert made.position is None

    def moved(step: float) -> dict[str, float]:
        rates = {"v_x": v_x, "v_y": v_y, "omega": omega}
        return {"t": t + step, "x": x + v_x * step, "y": y + v_y * step, "phi": phi + omega * step} | rates

    if not has_corner(made, moved):
        rate = difference(lambda step: at(made.velocity, **moved(step)))
        assert agree(at(made.acceleration, **moved(0.0)), rate)


def test_uniform_acceleration_has_the_textbook_s_derivatives_to_the_bit() -> None:
    made = position(tree("3 + 2 t - 4.905 t^2"))
    for t in (0.0, 0.3, 7.0):
        assert at(made.velocity, t=t) == 2 - 9.81 * t
        assert at(made.acceleration, t=t) == -9.81


def test_a_dependence_on_time_hidden_behind_names_is_differentiated() -> None:
    names = {"A": tree("2 h"), "h": tree("t^2"), "k": 3.0}
    made = position(tree("k A"), names.get)
    assert at(made.velocity, t=5.0) == 60.0
    assert at(made.acceleration, t=5.0) == 12.0


def test_a_dependence_on_place_hidden_behind_names_is_differentiated() -> None:
    made = velocity(tree("-h"), {"h": tree("2 x")}.get)
    assert at(made.acceleration, x=9.0, v_x=3.0) == -6.0


def test_a_dependence_on_another_body_s_place_changes_with_that_body_s_velocity() -> None:
    made = velocity(tree("2 p"), {"p": Reading("x", "C")}.get)
    assert made.acceleration.others == ("C",)
    own, other = [0.0] * len(STATE), [0.0] * len(STATE)
    own[STATE.index("v_x")], other[STATE.index("v_x")] = 100.0, 7.0
    assert made.acceleration.value(own + other) == 14.0


@pytest.mark.parametrize(
    ("function", "before", "after"),
    [
        (lambda: sympy.Max(T, 2, -T), 0.0, 1.0),
        (lambda: sympy.Min(T, 2), 1.0, 0.0),
        (lambda: sympy.Abs(T - 2), -1.0, 1.0),
        (lambda: sympy.Function("norm")(T - 2), -1.0, 1.0),
        (lambda: T * sympy.sign(T - 2), -1.0, 1.0),
        (lambda: T * sympy.floor(T / 2), 0.0, 1.0),
        (lambda: T * sympy.ceiling(T / 2), 1.0, 2.0),
    ],
)
def test_what_jumps_has_the_derivative_that_it_has_beside_its_jumps(
    function: object, before: float, after: float
) -> None:
    assert callable(function)
    made = position(function())
    assert at(made.velocity, t=1.5) == before
    assert at(made.velocity, t=2.5) == after
    assert at(made.acceleration, t=2.5) == 0.0


def test_names_without_a_value_count_as_zero_in_the_derivatives_too() -> None:
    made = position(tree("q t^n + 2 t"))
    assert set(made.velocity.unspecified) == {"q", "n"}
    assert at(made.velocity, t=0.0) == 2.0
    assert at(made.acceleration, t=0.0) == 0.0


@pytest.mark.parametrize("text", ["x", "2 t + y", "v_x t", "omega", "v"])
def test_a_position_that_depends_on_more_than_time_is_refused(text: str) -> None:
    with pytest.raises(ProgramError, match="depend on the time t alone, not on"):
        position(tree(text))


@pytest.mark.parametrize("text", ["-v_x", "t + v_y", "||v||", "omega"])
def test_a_velocity_that_depends_on_velocities_is_refused(text: str) -> None:
    with pytest.raises(ProgramError, match="time and place, not on"):
        velocity(tree(text))
    with pytest.raises(ProgramError, match="v_x of C"):
        velocity(tree("p"), {"p": Reading("v_x", "C")}.get)


def test_what_is_no_formula_of_motion_is_refused() -> None:
    nest = T
    for _ in range(150):
        nest = sympy.sin(nest)
    for of in (tree("(1, 2)"), sympy.true, sympy.I * T, sympy.Function("h")(T), nest):
        with pytest.raises(ProgramError):
            position(of)
    with pytest.raises(ProgramError, match="defined by itself"):
        velocity(tree("a"), {"a": tree("b"), "b": tree("a")}.get)


# Pages. A ball drawn at (200, 160): 2 m to the right and 1.6 m down.

BALL = Component(Circle((200.0, 160.0), 20.0), label="B")
OTHER = Component(Circle((300.0, 160.0), 20.0), label="C")
FIXED = Component(rectangle(0, 300, 400, 340), label="A", fixed=True)
WIRE = Component(Wire((200.0, 180.0), (200.0, 300.0)), label="D", ends=("B", "A"))


def scene(*remarks: str, about: str = "B") -> tuple[Scene, tuple[str, ...]]:
    built = build(page((FIXED, BALL, OTHER, WIRE), tuple((text, about, None) for text in remarks)))
    return built.scene, built.notices


def test_a_page_without_equations_has_no_courses() -> None:
    made, notices = scene("v_x = 3", "v_y = 2", "v_0 = (1, 1)", "m = 2", "F = (0, 3 t)")
    assert made.courses == ()
    assert made.body("B").velocity[:2] == (3.0, 2.0)
    assert notices == ()


@pytest.mark.parametrize("text", ["x = 0.1 sin(2 t)", "x(t) = 0.1 sin(2 t)", "0.1 sin(2 t) = x"])
def test_a_position_sets_out_from_where_the_shape_was_drawn(text: str) -> None:
    made, notices = scene(text)
    (one,) = made.courses
    assert (one.body, one.axis) == ("B", "x")
    assert one.position is not None
    for t in (0.0, 0.4, 3.0):
        assert at(one.position, t=t) == pytest.approx(2 + 0.1 * math.sin(2 * t), rel=1e-15)
        assert at(one.velocity, t=t) == pytest.approx(0.2 * math.cos(2 * t), rel=1e-15)
        assert at(one.acceleration, t=t) == pytest.approx(-0.4 * math.sin(2 * t), rel=1e-15, abs=1e-15)
    assert made.body("B").velocity == (0.2, 0.0, 0.0)
    assert notices == ()


@pytest.mark.parametrize("text", ["r = (t, t^2)", "s = t (1, t)", "(x, y) = (t, t^2)", "r(t) = (t, t^2)"])
def test_a_pair_gives_both_coordinates_with_y_upwards(text: str) -> None:
    made, notices = scene(text)
    across, upwards = made.courses
    assert (across.axis, upwards.axis) == ("x", "y")
    assert across.position is not None
    assert upwards.position is not None
    assert at(across.position, t=3.0) == 5.0
    assert at(upwards.position, t=3.0) == pytest.approx(-1.6 + 9.0, rel=1e-15)
    assert at(upwards.velocity, t=3.0) == 6.0
    assert notices == ()


def test_a_velocity_that_varies_is_an_equation_and_a_constant_one_is_the_start_s() -> None:
    made, notices = scene("v_x = 2 cos(t)", "v_y = 3")
    (one,) = made.courses
    assert one.position is None
    assert at(one.velocity, t=1.0) == 2 * math.cos(1.0)
    assert made.body("B").velocity == (2.0, 3.0, 0.0)
    assert len(notices) == 1
    assert "follows it, whatever forces act" in notices[0]


def test_a_pair_of_velocities_is_one_equation_where_either_part_varies() -> None:
    made, _ = scene("v = (3, 4 - 9.81 t)")
    across, upwards = made.courses
    assert at(across.velocity, t=5.0) == 3.0
    assert at(across.acceleration, t=5.0) == 0.0
    assert at(upwards.velocity, t=1.0) == 4 - 9.81
    assert at(upwards.acceleration, t=5.0) == -9.81
    assert scene("v = (3, 4)")[0].courses == ()


def test_the_velocity_at_the_start_by_name_is_never_an_equation() -> None:
    made, notices = scene("v_{0x} = 2 + t")
    assert made.courses == ()
    assert made.body("B").velocity[0] == 2.0
    assert any("its value at the start is used" in notice for notice in notices)


def test_places_in_formulas_are_measured_from_where_the_shape_was_drawn() -> None:
    made, _ = scene("v_x = 1 - 2 x", "v_y = -y")
    across, upwards = made.courses
    assert at(across.velocity, x=2.0, y=-1.6) == 1.0
    assert at(across.velocity, x=2.5, y=-1.6) == 0.0
    assert at(across.acceleration, x=2.5, v_x=3.0) == -6.0
    assert at(upwards.velocity, x=2.0, y=-1.1) == pytest.approx(-0.5, rel=1e-15)
    made, _ = scene("F = (-4 x, -4 y)")
    assert at(made.forces[0].x, x=2.25, y=-1.6) == -1.0
    assert at(made.forces[0].y, x=2.25, y=-1.6) == 0.0


def test_an_equation_uses_the_constants_of_the_page() -> None:
    made, notices = scene("x = L_0 sin(w t)", "L_0 = 0.1", "w = 2", "y = -g t^2 / 2")
    across, upwards = made.courses
    assert at(across.velocity, t=0.0) == 0.2
    assert at(upwards.acceleration, t=3.0) == -9.81
    assert notices == ()


def test_a_formula_reads_the_velocity_of_another_body() -> None:
    made, notices = scene("F = (-2 v_C, v_xC - omega_C)")
    force = made.forces[0]
    assert force.x.others == force.y.others == ("C",)
    other = [0.0, 3.0, -1.6, 0.0, 3.0, 4.0, 5.0, 1.0]
    assert force.x.value([0.0] * len(STATE) + other) == -10.0
    assert force.y.value([0.0] * len(STATE) + other) == 2.0
    assert notices == ()


@pytest.mark.parametrize(
    ("remarks", "about", "said", "courses"),
    [
        (("x = 1 + t",), "B", "x is 1 m at the start, so B jumps there", 1),
        (("x = 3",), "B", "x is 3 m at the start", 1),
        (("x = sin(t)", "v_x = 3"), "B", "v_x = 3 of B is not used for x, which x = sin(t) gives", 1),
        (("v_x = t", "x = t"), "B", "v_x = t of B is not used for x, which x = t gives", 1),
        (("x = t", "v_x = t"), "B", "x = t of B is not used for x, which v_x = t gives", 1),
        (("x = t", "x = 2 t"), "B", "the newest, x = 2 t, is used", 1),
        (("x = 2 y",), "B", "on the time t alone, not on y", 0),
        (("v_x = -v_y",), "B", "time and place, not on v_y", 0),
        (("x = log(t)",), "B", "no value at the start", 0),
        (("x = sqrt(t)",), "B", "changes without limit there", 0),
        (("x = q t",), "B", "q in x = q t of B has no value on this page", 1),
        (("x = (t, t)",), "B", "single number", 0),
        (("r = t",), "B", "has no direction; write it as a pair", 0),
        (("r = (1, 2, 3)",), "B", "two", 0),
        (("v = 2 t",), "B", "it is taken to the right", 1),
        (("x = t",), "A", "A is fixed", 0),
        (("x = t",), "D", "belongs to a ball or a block, and a wire (D) has none", 0),
    ],
)
def test_what_an_equation_changes_or_cannot_be_is_explained(
    remarks: tuple[str, ...], about: str, said: str, courses: int
) -> None:
    made, notices = scene(*remarks, about=about)
    assert len(made.courses) == courses
    assert any(said in notice for notice in notices), notices


def test_a_name_that_other_formulas_use_is_a_mere_name() -> None:
    made, notices = scene("r = 2", "F = (r, 0)")
    assert made.courses == ()
    assert at(made.forces[0].x) == 2.0
    assert notices == ()


sides = st.sampled_from(
    ["x", "y", "r", "s", "(x, y)", "v", "v_x", "v_y", "(v_x, v_y)", "x(t)", "v_0", "q", "phi"]
)
values = st.sampled_from(
    ["t", "3", "0", "q", "1/t", "x", "-v", "v_C", "x q", "(t, x)", "(sin(t), |y|)", "v_xB", "sqrt(t) x", "||v||"]
)  # fmt: skip


@settings(max_examples=100, deadline=None)
@given(st.lists(st.tuples(sides, values, st.sampled_from("ABCD")), max_size=6))
def test_no_page_of_equations_raises_and_every_course_has_a_value_at_the_start(
    said: list[tuple[str, str, str]],
) -> None:
    remarks = tuple((f"{side} = {value}", label, None) for side, value, label in said)
    made = build(page((FIXED, BALL, OTHER, WIRE), remarks)).scene
    for one in made.courses:
        body = made.body(one.body)
        state = [0.0, *body.position, *[0.0] * (len(STATE) - 3)] * (1 + len(one.velocity.others))
        assert math.isfinite(one.velocity.value(state))
        assert body.velocity["xy".index(one.axis)] == one.velocity.value(state)
