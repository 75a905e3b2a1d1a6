"""Pages that say too little, too much or what cannot be: a notice each, never an exception."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from physics_pages import page, rectangle

from physics.build import build
from physics.pipeline import move
from sketch.formula.parse import expression
from sketch.page import Association, Component, Sketch
from sketch.shapes import Arrow, Circle, Polygon, Spring, Wire

CEILING = Component(rectangle(100, 0, 300, 40), label="A", fixed=True)
BALL = Component(Circle((200.0, 160.0), 20.0), label="B")
WIRE = Component(Wire((200.0, 40.0), (200.0, 140.0)), label="C", ends=("A", "B"))
SPRING = Component(Spring((200.0, 40.0), (200.0, 140.0), 5, 20), label="C", ends=("A", "B"))


@pytest.mark.parametrize(
    ("parts", "remark", "label", "said"),
    [
        ((CEILING, BALL, WIRE), "k = 3", "B", "stiffness"),
        ((CEILING, BALL, SPRING), "T = 3", "C", "tension"),
        ((CEILING, BALL, WIRE), "m = 0", "B", "above zero"),
        ((CEILING, BALL, WIRE), "m = -2", "B", "above zero"),
        ((CEILING, BALL, WIRE), "e = 2", "B", "between 0 and 1"),
        ((CEILING, BALL, WIRE), "mu = -1", "B", "not below zero"),
        ((CEILING, BALL, WIRE), "T = q", "C", "q in T = q of C has no value"),
        ((CEILING, BALL, WIRE), "T = T", "C", "defined by itself"),
        ((CEILING, BALL, WIRE), "f = 3", "B", "rests on nothing"),
        ((CEILING, BALL, WIRE), "L = 0", "C", "above zero"),
        ((CEILING, BALL, WIRE), "v = 2", "B", "to the right"),
        ((CEILING, BALL, WIRE), "v_x = t", "B", "changes in time"),
        ((CEILING, BALL, WIRE), "5 = 7", "B", "name = value"),
        ((CEILING, BALL, WIRE), "m = (((", "B", "can be read"),
        ((CEILING, BALL, WIRE), "m = 3", None, "whole page"),
        ((CEILING, BALL, WIRE), "q = 3", "B", "not a quantity"),
        ((CEILING, BALL, WIRE), "F = v W", "B", "two vectors"),
        ((CEILING, BALL, WIRE), "F = (1, 2, 3)", "B", "two"),
        ((CEILING, BALL, WIRE), "g = 1/0", None, "g"),
    ],
)
def test_what_cannot_be_is_explained(
    parts: tuple[Component, ...], remark: str, label: str | None, said: str
) -> None:
    motion = move(page(parts, ((remark, label, None),)), 0.2)
    assert any(said in notice for notice in motion.notices), motion.notices
    assert np.isfinite(motion.trajectory.poses).all()


def test_the_newest_of_two_values_wins_visibly() -> None:
    built = build(page((BALL,), (("m = 2", "B", None), ("m = 5", "B", None))))
    assert built.scene.body("B").mass == 5
    assert any("newest" in notice for notice in built.notices)


def test_links_with_free_ends_are_pinned_to_the_page_and_useless_ones_left_out() -> None:
    loose = Component(Wire((200.0, 40.0), (200.0, 140.0)), label="C", ends=(None, "B"))
    motion = move(page((BALL, loose)), 1)
    assert any("pinned" in notice for notice in motion.notices)
    assert np.abs(motion.trajectory.poses - motion.trajectory.poses[0]).max() < 1e-9
    for ends in ((None, None), ("B", "B")):
        built = build(page((BALL, Component(Wire((200.0, 40.0), (200.0, 140.0)), label="C", ends=ends))))
        assert built.scene.wires == ()
        assert any("does not join" in notice for notice in built.notices)


def test_a_hollow_shape_is_filled_and_a_flat_one_left_out_with_a_notice() -> None:
    arrowhead = Component(Polygon([(0, 0), (100, 50), (0, 100), (40, 50)]), label="A")
    flat = Component(Polygon([(300, 0), (350, 0), (400, 0)]), label="B")
    motion = move(page((arrowhead, flat)), 0.5)
    assert motion.trajectory.bodies == ("A",)
    assert any("not convex" in notice for notice in motion.notices)
    assert any("no area" in notice for notice in motion.notices)


def test_an_empty_page_moves_nothing() -> None:
    motion = move(Sketch(), 1)
    assert motion.trajectory.bodies == ()
    assert len(motion.trajectory.times) == 61
    assert motion.notices == ()


names = st.sampled_from(
    [
        "m",
        "mu",
        "e",
        "v",
        "v_x",
        "v_y",
        "omega",
        "f_1",
        "F",
        "N_2",
        "T",
        "T_1",
        "k",
        "L",
        "theta",
        "g",
        "W",
        "x",
        "y",
        "t",
        "a_B",
        "m_A",
        "q",
    ]
)
values = st.sampled_from(
    [
        "0",
        "1",
        "-3",
        "1/0",
        "sqrt(-1)",
        "10^400",
        "(0, 5)",
        "|W|",
        "W",
        "v",
        "m g",
        "t",
        "1/t",
        "log(x)",
        "theta",
        "q",
        "f_1",
        "pi/4",
        "-mu v",
        "(t, 1/(t - 0.1))",
        "exp(exp(exp(9)))",
        "",
        "((",
        "(1,2,3)",
        "m_A",
    ]
)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(names, values, st.sampled_from([None, *"ABCDEF"])), max_size=5), st.data())
def test_no_page_raises_and_nan_never_appears(
    said: list[tuple[str, str, str | None]], data: st.DataObject
) -> None:
    number = st.floats(0, 400)
    parts = [
        Component(rectangle(0, 380, 500, 420), label="A", fixed=True),
        Component(Circle((data.draw(number), data.draw(number)), data.draw(st.floats(1, 60))), label="B"),
        Component(rectangle(200, 200, 260, 250), label="C", fixed=data.draw(st.booleans())),
        Component(
            Wire((1.0, 2.0), (data.draw(number), 300.0)),
            label="D",
            ends=data.draw(st.sampled_from([("A", "B"), (None, "C"), ("B", "C")])),
        ),
        Component(
            Spring((5.0, 2.0), (data.draw(number), 300.0), 3, 5),
            label="E",
            ends=data.draw(st.sampled_from([("A", "B"), ("C", None), ("B", "B")])),
        ),
        Component(Arrow((0, 0), (1, 1)), label="F"),
    ]
    expressions = tuple(expression(f"{name} = {value}") for name, value, _ in said)
    associations = tuple(
        Association(k, label, (100.0, 100.0)) for k, (_, _, label) in enumerate(said) if label is not None
    )
    motion = move(Sketch(components=tuple(parts), expressions=expressions, associations=associations), 0.3)
    trajectory = motion.trajectory
    for array in (trajectory.poses, trajectory.velocities, trajectory.accelerations):
        assert np.isfinite(array).all()
    for force in trajectory.forces:
        assert np.isfinite(force.values).all()
        assert np.isfinite(force.points).all()
