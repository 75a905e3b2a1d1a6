"""Laws of what is observed: closed forms, agreement of quantities with each other, and round trips."""

import csv
import io
from math import sqrt

import numpy as np
import pytest
from physics_pages import ball_on_incline, page, rectangle

from physics import observables
from physics.observables import ObservableError, arrows, columns, observe, observe_all, quantities
from physics.pipeline import move
from sketch.page import Component
from sketch.shapes import Circle, Spring

G = 9.81


def thrown():
    return move(
        page(
            (Component(Circle((100.0, 100.0), 10.0), label="A"),),
            (("v_0 = (2, 3)", "A", None), ("m = 2", "A", None)),
        ),
        1.0,
    )


def swinging():
    return move(
        page(
            (
                Component(rectangle(250, 20, 350, 60), label="A", fixed=True),
                Component(rectangle(270, 160, 330, 210), label="B"),
                Component(Spring((300.0, 60.0), (300.0, 160.0), 6.0, 20.0), label="C", ends=("A", "B")),
            ),
            (("m = 2", "B", None), ("k = 50", "C", None)),
        ),
        2.0,
    )


def seen(motion, body, quantity):
    return observe(motion.scene, motion.trajectory, body, quantity)


def test_a_thrown_balls_observables_are_those_of_a_parabola():
    motion = thrown()
    t = motion.trajectory.times
    velocity = np.column_stack([np.full_like(t, 2.0), 3 - G * t])
    rise = 3 * t - G * t**2 / 2
    for quantity, wanted in {
        "velocity": velocity,
        "speed": np.hypot(*velocity.T),
        "acceleration": np.tile([0.0, -G], (len(t), 1)),
        "net force": np.tile([0.0, -2 * G], (len(t), 1)),
        "weight": np.tile([0.0, -2 * G], (len(t), 1)),
        "x-displacement": 2 * t,
        "y-displacement": rise,
        "momentum": 2 * velocity,
        "kinetic energy": (velocity**2).sum(axis=1),
        "potential energy": 2 * G * rise,
        "work of weight": -2 * G * rise,
        "angular velocity": np.zeros_like(t),
    }.items():
        np.testing.assert_allclose(seen(motion, "A", quantity).values, wanted, atol=1e-11)


def test_the_works_of_all_forces_make_the_kinetic_energy():
    """Also of springs and contacts, whose work the ledger does not keep by name."""
    for motion, body in ((swinging(), "B"), (move(ball_on_incline(), 0.5), "B")):
        works = [name for name in quantities(motion.trajectory, body) if name.startswith("work of ")]
        total = sum(seen(motion, body, name).values for name in works)
        gained = seen(motion, body, "kinetic energy").values
        np.testing.assert_allclose(total, gained - gained[0], atol=1e-9)


def test_the_net_force_is_the_sum_of_all_forces():
    motion = swinging()
    forces = [one.values for one in motion.trajectory.forces if one.body == "B"]
    np.testing.assert_allclose(sum(forces), seen(motion, "B", "net force").values, atol=1e-8)


def test_a_body_that_follows_an_equation_of_motion_has_all_observables():
    """Row M7: x = 0.3 sin(4t), so a = −4.8 sin(4t) and the net force m a."""
    motion = move(
        page(
            (Component(Circle((300.0, 200.0), 10.0), label="A"),),
            (("x = 0.3 sin(4t)", "A", None), ("y = 0", "A", None), ("m = 2", "A", None)),
        ),
        1.0,
    )
    t = motion.trajectory.times
    np.testing.assert_allclose(seen(motion, "A", "velocity").values[:, 0], 1.2 * np.cos(4 * t), atol=1e-12)
    np.testing.assert_allclose(seen(motion, "A", "net force").values[:, 0], -9.6 * np.sin(4 * t), atol=1e-11)


def test_a_table_comes_back_from_csv_and_parquet_to_the_bit():
    parquet = pytest.importorskip("pyarrow.parquet")
    motion = swinging()
    series = observe_all(motion.scene, motion.trajectory, "B")
    table = columns(series)
    assert "velocity y of B (m/s)" in table
    head, *rows = csv.reader(io.StringIO(observables.csv(series)))
    assert head == list(table)
    np.testing.assert_array_equal(np.array(rows, float), np.column_stack(list(table.values())))
    again = parquet.read_table(io.BytesIO(observables.parquet(series)))
    assert again.column_names == list(table)
    for name, values in table.items():
        np.testing.assert_array_equal(again[name].to_numpy(), values)


def test_arrows_follow_the_magnitude_and_forces_share_a_scale():
    motion = swinging()
    run = motion.trajectory
    series = [seen(motion, "B", name) for name in ("weight", "spring C", "velocity")]
    for frame in (0, 20, 60):
        drawn = {one.name: one for one in arrows(run, series, frame, chosen="velocity")}
        lengths = {
            name: sqrt((one.tip[0] - one.tail[0]) ** 2 + (one.tip[1] - one.tail[1]) ** 2)
            for name, one in drawn.items()
        }
        spring = series[1].size[frame]
        if "spring C" in drawn:
            assert lengths["spring C"] / lengths["weight"] == pytest.approx(spring / (2 * G))
        assert drawn["weight"].tip[1] > drawn["weight"].tail[1]  # the page's y points down
        assert drawn["weight"].tail == pytest.approx(tuple(run.path("B")[frame] * (100, -100)))
        assert {name: one.weight for name, one in drawn.items()} == {
            name: "bold" if name == "velocity" else "normal" for name in drawn
        }


def test_a_figure_has_a_graph_for_each_unit():
    motion = swinging()
    series = observe_all(motion.scene, motion.trajectory, "B")
    assert len(observables.figure(series).axes) == len({one.unit for one in series})


def test_what_is_not_there_is_refused_with_what_is():
    motion = swinging()
    with pytest.raises(ObservableError, match=r"'A' is nothing that can move here; B can"):
        seen(motion, "A", "velocity")
    with pytest.raises(ObservableError, match=r"B has no 'warmth' to observe; it has velocity, speed"):
        seen(motion, "B", "warmth")
    with pytest.raises(ObservableError, match=r"there is no frame 500; the motion has 121"):
        arrows(motion.trajectory, [seen(motion, "B", "velocity")], 500)
    with pytest.raises(ObservableError, match="nothing to write"):
        columns([])
    other = observe(motion.scene, motion.trajectory.until(1.0), "B", "speed")
    with pytest.raises(ObservableError, match="of other times"):
        columns([seen(motion, "B", "velocity"), other])
