"""What each rule of correction does where several things have to agree."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, radians, sin, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from physics_pages import page, rectangle
from physics_workshop import angles_off, difference

from physics.pipeline import move
from physics.rectify import rectify
from physics.rectify.incline import raised
from physics.rectify.separation import apart
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Point, Polygon, Solid, Wire

FLOOR = Component(rectangle(0, 300, 900, 340), label="F", fixed=True)


def turned(vertices: list[Point], angle: float) -> np.ndarray:
    c, s = cos(angle), sin(angle)
    return np.array(vertices) @ np.array([[c, s], [-s, c]]) + (300, 200)


def straightened(vertices: np.ndarray) -> np.ndarray:
    after = rectify(page((Component(Polygon(vertices), label="A"),))).sketch.component("A").shape
    assert isinstance(after, Polygon)
    return after.vertices


def corner_angles(vertices: np.ndarray) -> np.ndarray:
    before, after = vertices - np.roll(vertices, 1, axis=0), np.roll(vertices, -1, axis=0) - vertices
    return np.abs(
        np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(1))
    )


def lengths(vertices: np.ndarray) -> np.ndarray:
    return np.hypot(*(np.roll(vertices, -1, axis=0) - vertices).T)


def solid(sketch: Sketch, label: str) -> Solid:
    shape = sketch.component(label).shape
    assert isinstance(shape, Circle | Polygon)
    return shape


def gap(sketch: Sketch, one: str, other: str) -> float:
    return abs(apart(solid(sketch, one), solid(sketch, other))[0])


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000), st.floats(0.3, 1.2), st.floats(0.2, 2.5))
def test_c1_makes_a_box_that_stands_aslant_right_angled_and_does_not_level_it(
    seed: int, angle: float, noise: float
) -> None:
    rng = np.random.default_rng(seed)
    meant = turned([(0, 0), (120, 0), (120, 70), (0, 70)], angle)
    after = straightened(meant + noise * rng.uniform(-1, 1, size=(4, 2)))
    np.testing.assert_allclose(corner_angles(after), pi / 2, atol=1e-11)
    # No vertex goes farther than the hand was off, and half as much again for the turn of the whole.
    assert difference(Polygon(after), Polygon(meant)) < 3 * noise


def test_c1_makes_a_nearly_square_box_square_where_the_hand_was_unsteady_and_not_where_it_was_sure() -> None:
    unsteady = np.array([(100, 101), (199, 98), (202, 200), (101, 199)], dtype=float)
    sides = lengths(straightened(unsteady))
    np.testing.assert_allclose(sides, sides[0], rtol=1e-12)
    sure = np.array([(100, 100), (200, 100), (200, 202), (100, 202)], dtype=float)
    np.testing.assert_array_equal(straightened(sure), sure)
    long = np.array([(100, 101), (249, 98), (252, 200), (101, 199)], dtype=float)
    sides = lengths(straightened(long))
    assert sides.max() > 1.4 * sides.min()


def test_c1_makes_opposite_sides_parallel_and_leaves_their_slant() -> None:
    meant = np.array([(0, 0), (100, 0), (150, 80), (50, 80)], dtype=float) + 200
    after = straightened(meant + np.array([(0.8, 0.5), (-0.9, -0.6), (1.2, 0.7), (-1, -0.4)]))
    steps = np.roll(after, -1, axis=0) - after
    level, slanted = (steps[k::2] for k in ((0, 1) if steps[0, 1] == 0 else (1, 0)))
    assert np.all(level[:, 1] == 0)
    assert abs(slanted[0, 0] * slanted[1, 1] - slanted[0, 1] * slanted[1, 0]) < 1e-9
    assert atan2(80, 50) == pytest.approx(atan2(*np.abs(slanted[0, ::-1])), abs=0.05)


@pytest.mark.parametrize("angle", [0.03, 0.1, 0.4])
@pytest.mark.parametrize(
    "vertices",
    [
        [(0.0, 0.0), (120.0, 0.0), (120.0, 70.0), (0.0, 70.0)],
        [(0.0, 0.0), (100.0, 0.0), (50.0, 50 * 3**0.5)],
        [(0.0, 0.0), (120.0, 0.0), (120.0, 70.0)],
    ],
)
def test_c1_leaves_what_is_exact_in_itself_turned_as_it_is(vertices: list[Point], angle: float) -> None:
    exact = turned(vertices, angle)
    np.testing.assert_array_equal(straightened(exact), exact)


def test_c1_leaves_a_bucket_whose_rim_and_floor_are_exactly_level() -> None:
    bucket = np.array([(0, 0), (100, 0), (88, 80), (12, 80)], dtype=float)
    np.testing.assert_array_equal(straightened(bucket), bucket)
    leaning = np.array([(0, 0), (160, 3), (160, 100), (0, 100)], dtype=float)
    assert np.ptp(straightened(leaning)[:, 1]) == pytest.approx(98.5)


@pytest.mark.parametrize("between", [56.0, 63.0])
def test_c2_a_ball_between_two_blocks_on_a_floor_touches_all_three(between: float) -> None:
    """With the ball on the floor the blocks cannot both stay: the lighter one makes room."""
    left = Component(rectangle(100, 200, 220, 301.5), label="A")
    right = Component(rectangle(220 + between, 240, 280 + between, 298), label="B")
    ball = Component(Circle((220 + between / 2, 268.0), 30.0), label="C")
    drawn = page((FLOOR, left, right, ball))
    after = rectify(drawn).sketch
    for one, other in (("F", "A"), ("F", "B"), ("F", "C"), ("A", "C"), ("B", "C")):
        assert gap(after, one, other) < 1e-9
    heavy, light = (
        abs(np.asarray(solid(after, label).vertices - solid(drawn, label).vertices)[0, 0]) for label in "AB"
    )
    assert light > 4 * heavy


def test_c2_gives_up_the_contact_that_cannot_be_and_keeps_the_others() -> None:
    walls = (
        Component(rectangle(100, 100, 200, 300), label="A", fixed=True),
        Component(rectangle(255, 100, 355, 300), label="B", fixed=True),
    )
    ball = Component(Circle((229.0, 268.0), 30.0), label="C")
    after = rectify(page((FLOOR, *walls, ball))).sketch
    assert gap(after, "F", "C") < 1e-9
    assert sorted([gap(after, "A", "C") < 1e-9, gap(after, "B", "C") < 1e-9]) == [False, True]
    assert difference(after.component("C").shape, rectify(after).sketch.component("C").shape) < 1e-9


@settings(max_examples=25, deadline=None)
@given(
    st.lists(st.floats(-5, 5), min_size=4, max_size=4), st.lists(st.floats(-2.5, 2.5), min_size=4, max_size=4)
)
def test_c2_closes_a_chain_of_balls_on_a_floor(off: list[float], up: list[float]) -> None:
    balls = [
        Component(Circle((100 + 60 * k + off[k], 270.0 + up[k]), 30.0), label="ABCD"[k]) for k in range(4)
    ]
    after = rectify(page((FLOOR, *balls))).sketch
    for label in "ABCD":
        assert gap(after, "F", label) < 1e-9
    for k in range(3):
        near = abs(off[k + 1] - off[k]) < 8
        assert gap(after, "ABCD"[k], "ABCD"[k + 1]) < 1e-9 or not near


def test_c2_leaves_boxes_that_stand_side_by_side_with_a_visible_gap() -> None:
    boxes = [Component(rectangle(100 + 80 * k, 240, 160 + 80 * k, 300), label="ABC"[k]) for k in range(3)]
    drawn = page((FLOOR, *boxes))
    assert rectify(drawn).sketch == drawn


def test_c2_lays_a_box_along_the_incline_that_it_was_drawn_upon() -> None:
    triangle = Component(
        Polygon([(100, 400), (500, 400), (500, 400 - 400 * tan(0.6))]), label="A", fixed=True
    )
    up, out = np.array([cos(0.6), -sin(0.6)]), np.array([-sin(0.6), -cos(0.6)])
    corners = [(100, 400) + (200 + a) * up + b * out for a, b in ((0, 3), (60, 4), (60, 44), (0, 43))]
    box = Component(Polygon(np.add(corners, [(0.6, 0.2), (-0.4, 0.9), (0.3, -0.5), (0.2, 0.1)])), label="B")
    motion = move(page((triangle, box)), 0.5)
    after = solid(motion.rectified, "B")
    assert isinstance(after, Polygon)
    # Its lower side lies along the incline: both its ends are on it, and it slides down without a jolt.
    depths = sorted(abs((after.vertices - (100, 400)) @ out))
    assert depths[:2] == pytest.approx([0, 0], abs=1e-8)
    speed = motion.trajectory.speed("B")
    np.testing.assert_allclose(speed[1:], 9.81 * sin(0.6) * motion.trajectory.times[1:], rtol=1e-7)


@settings(max_examples=60, deadline=None)
@given(
    st.floats(0.05, 1.5),
    st.floats(20, 900),
    st.floats(-pi, pi),
    st.sampled_from([-1.0, 1.0]),
    st.floats(0.1, 2.0),
)
def test_c3_the_new_top_is_straight_above_the_right_angle_and_seen_under_theta_from_the_foot(
    theta: float, base: float, lies: float, side: float, height: float
) -> None:
    """Both cases, (i) uphill and (ii) downhill, and any base: |p2' − foot| = base / cos θ, p2' − corner ⟂ base."""
    foot, along = np.array([50.0, 70.0]), np.array([cos(lies), sin(lies)])
    across = side * np.array([-along[1], along[0]])
    corner, top = foot + base * along, foot + base * along + height * base * across
    new = np.array(raised(tuple(foot.tolist()), tuple(corner.tolist()), tuple(top.tolist()), theta))
    assert (new - corner) @ along == pytest.approx(0, abs=1e-9 * base)
    assert (new - corner) @ across == pytest.approx(base * tan(theta), rel=1e-9)
    assert hypot(*(new - foot)) == pytest.approx(base / cos(theta), rel=1e-9)


def loaded_incline(drawn: float, said: float, downhill: bool) -> Sketch:
    """A box on an incline, a ball on the box, a peg at the top, a wire from the box to the peg along the incline, and a
    bob that hangs from the ball."""
    up, out = np.array([cos(drawn), -sin(drawn)]), np.array([-sin(drawn), -cos(drawn)])
    foot = np.array([100.0, 500.0])
    top = np.add(foot, (400, -400 * tan(drawn)))

    def at(along: float, above: float) -> Point:
        x, y = foot + along * up + above * out
        return (float(x), float(y))

    box = Polygon([at(170, 0), at(190, 0), at(190, 50), at(170, 50)])
    ball, peg = Circle(at(180, 90), 40.0), Circle((float(top[0]), float(top[1] - 12)), 12.0)
    hook = (ball.centre[0] - 40, ball.centre[1])
    parts = [
        Component(Polygon([foot, np.add(foot, (400, 0)), top]), label="A", fixed=True),
        Component(box, label="B"),
        Component(ball, label="C"),
        Component(peg, label="P", fixed=True),
        Component(Wire(at(190, 25), (float(top[0] - 12), float(top[1] - 12))), label="W", ends=("B", "P")),
        Component(Wire(hook, (hook[0], hook[1] + 25)), label="H", ends=("C", "D")),
        Component(Circle((hook[0], hook[1] + 35), 10.0), label="D"),
    ]
    if downhill:
        parts = [Component(mirrored(part.shape), (), part.label, part.fixed, part.ends) for part in parts]
    return page(parts, ((f"theta = {said!r}", "A", (150.0, 495.0)),))


def mirrored(shape: object) -> object:
    match shape:
        case Circle((x, y), radius):
            return Circle((700 - x, y), radius)
        case Polygon():
            return Polygon(shape.vertices * (-1, 1) + (700, 0))
        case Wire((x, y), (u, v)):
            return Wire((700 - x, y), (700 - u, v))


@pytest.mark.parametrize("downhill", [False, True])
@pytest.mark.parametrize("drawn", [0.45, 0.6])
def test_c3_takes_along_what_rests_what_rests_on_that_what_hangs_and_the_peg(
    drawn: float, downhill: bool
) -> None:
    sketch = loaded_incline(drawn, 0.5, downhill)
    after = rectify(sketch).sketch
    assert angles_off(after)["A"] < 1e-12
    foot = np.array([600.0 if downhill else 100.0, 500.0])
    for label in "BC":
        assert gap(after, "A" if label == "B" else "B", label) < 1e-9
        before, now = solid(sketch, label), solid(after, label)
        middles = [
            np.array(one.centre) if isinstance(one, Circle) else one.vertices.mean(axis=0)
            for one in (before, now)
        ]
        assert hypot(*(middles[1] - foot)) == pytest.approx(hypot(*(middles[0] - foot)), abs=1e-9)
    old, new = (solid(one, "A").vertices for one in (sketch, after))
    rise = new[np.argmin(new[:, 1])] - old[np.argmin(old[:, 1])]
    step = np.subtract(solid(after, "P").centre, solid(sketch, "P").centre)
    np.testing.assert_allclose(step, rise, atol=1e-9)
    wire, thread = after.component("H").shape, sketch.component("H").shape
    assert isinstance(wire, Wire)
    assert isinstance(thread, Wire)
    # The bob hangs as it hung: straight down, from where its hook has come to.
    assert wire.start[0] - wire.end[0] == pytest.approx(0, abs=1e-9)
    bob = solid(after, "D")
    assert isinstance(bob, Circle)
    assert hypot(bob.centre[0] - wire.end[0], bob.centre[1] - wire.end[1]) == pytest.approx(10, abs=1e-9)


def test_c5_what_hangs_from_a_bob_follows_it() -> None:
    ceiling = Component(rectangle(100, 0, 300, 40), label="A", fixed=True)
    end = (200 + 100 * sin(0.4), 40 + 100 * cos(0.4))
    middle = (200 + 120 * sin(0.4), 40 + 120 * cos(0.4))
    below = (middle[0], middle[1] + 20)
    parts = (
        ceiling,
        Component(Wire((200.0, 40.0), end), label="C", ends=("A", "B")),
        Component(Circle(middle, 20.0), label="B"),
        Component(Wire(below, (below[0], below[1] + 50)), label="D", ends=("B", "E")),
        Component(Circle((below[0], below[1] + 65), 15.0), label="E"),
    )
    corrected = rectify(page(parts, (("theta = 0.7", "C", (200.0, 45.0)),)))
    after = corrected.sketch
    assert angles_off(after)["C"] < 1e-12
    thread, bob = after.component("D").shape, solid(after, "E")
    assert isinstance(thread, Wire)
    assert isinstance(bob, Circle)
    assert hypot(thread.end[0] - thread.start[0], thread.end[1] - thread.start[1]) == pytest.approx(50)
    assert hypot(bob.centre[0] - thread.end[0], bob.centre[1] - thread.end[1]) == pytest.approx(15)
    assert {correction.key for correction in corrected.corrections} == {("C5", "C")}
    assert {correction.component for correction in corrected.corrections} == {"B", "C", "D", "E"}


def test_c5_two_wires_that_share_a_block_too_small_to_slide_along_are_both_given_their_angles() -> None:
    peg = Component(Circle((200.0, 60.0), 4.0), label="A", fixed=True)
    box = Component(rectangle(120, 200, 300, 260), label="E")
    left = Component(Wire((200.0, 64.0), (120.0, 200.0)), label="C", ends=("A", "E"))
    right = Component(Wire((200.0, 64.0), (300.0, 200.0)), label="D", ends=("A", "E"))
    said = (("theta = 1.1", "C", (121.0, 198.0)), ("theta = 0.85", "D", (299.0, 198.0)))
    after = rectify(page((peg, box, left, right), said)).sketch
    assert max(angles_off(after).values()) < 1e-9
    assert solid(after, "E") == box.shape
    assert difference(after.component("A").shape, rectify(after).sketch.component("A").shape) < 1e-9


def test_a_motion_is_of_the_page_without_the_corrections_that_were_undone() -> None:
    ball = Component(Circle((200.0, 264.0), 30.0), label="B")
    drawn = page((FLOOR, ball))
    corrected = move(drawn, 0.4)
    assert corrected.displacement == pytest.approx(6)
    assert np.abs(corrected.trajectory.poses - corrected.trajectory.poses[0]).max() < 1e-12
    (key,) = {correction.key for correction in corrected.corrections}
    dropped = move(drawn, 0.4, without={key})
    assert dropped.corrections == ()
    assert dropped.displacement == 0
    assert dropped.trajectory.path("B")[-1, 1] < -2.64 - 0.03


def test_a_correction_undone_that_changes_an_angle_leaves_the_incline_as_drawn() -> None:
    triangle = Component(
        Polygon([(100, 400), (420, 400), (420, 400 - 320 * tan(radians(27)))]), label="A", fixed=True
    )
    drawn = page((triangle,), (("theta = pi/6", "A", (150.0, 390.0)),))
    assert rectify(drawn, {("C3", "A")}).sketch == drawn
    assert rectify(drawn).sketch != drawn
