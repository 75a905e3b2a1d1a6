"""Closed forms of what a student writes: forces, equations of motion, normal forces.

Errors are shares of the size of the quantity unless they are times, which are in seconds.
"""

from __future__ import annotations

from math import cos, log, pi, sin, sqrt

import numpy as np
import pytest
import sympy
from physics_scenes import (
    V_X,
    V_Y,
    G,
    T,
    V,
    X,
    Y,
    course,
    disc,
    downhill,
    events,
    floor,
    force,
    ledger,
    off,
    place_course,
    supported,
    way,
    wire,
)
from scipy.optimize import brentq

from physics.engine import simulate
from physics.scene import Material, Scene, SceneError

WEIGHTLESS = (0.0, 0.0)

# Forces -----------------------------------------------------------------------------------------


def test_a_force_linear_in_time_gives_a_cubic_way_and_its_work_is_the_kinetic_energy() -> None:
    moved = simulate(Scene((disc("A", 0, 0),), forces=(force("F", "A", 6 * T),), gravity=WEIGHTLESS), 2)
    assert off(moved.path("A")[:, 0], moved.times**3, 8) < 1e-12
    assert off(moved.velocities[:, 0, 0], 3 * moved.times**2, 12) < 1e-12
    assert off(moved.accelerations[:, 0, 0], 6 * moved.times, 12) < 1e-12
    assert off(moved.force("F", "A").values[:, 0], 6 * moved.times, 12) < 1e-12
    assert off(moved.energy.works["F", "A"], 4.5 * moved.times**4, 72) < 1e-12
    assert off(moved.energy.worked, moved.energy.kinetic, 72) < 1e-12


@pytest.mark.parametrize("k", [0.1, 2.0, 50.0])
def test_linear_drag_turns_a_throw_to_its_terminal_fall(k: float) -> None:
    mass, v_x, v_y = 2.0, 5.0, 8.0
    drag = force("D", "A", -k * V_X, -k * V_Y)
    moved = simulate(Scene((disc("A", 0, 0, mass=mass, velocity=(v_x, v_y, 0)),), forces=(drag,)), 4)
    rate = k / mass
    end = G / rate
    gone = (1 - np.exp(-rate * moved.times)) / rate
    wanted = np.column_stack([v_x * gone, (v_y + end) * gone - end * moved.times])
    assert off(moved.path("A"), wanted, np.abs(wanted).max()) < 1e-9
    assert off(ledger(moved), ledger(moved)[0], 0.5 * mass * (v_x**2 + v_y**2)) < 1e-9


@pytest.mark.parametrize("k", [0.05, 1.0, 20.0])
def test_with_quadratic_drag_a_fall_approaches_its_terminal_speed_as_tanh(k: float) -> None:
    # y = −(u²/g) ln cosh(g t/u), u = √(m g/k).
    mass = 2.0
    u = sqrt(mass * G / k)
    drag = force("D", "A", -k * V * V_X, -k * V * V_Y)
    moved = simulate(Scene((disc("A", 0, 0, mass=mass),), forces=(drag,)), 4)
    fallen = u * u / G * np.logaddexp(G * moved.times / u, -G * moved.times / u) - u * u / G * log(2)
    assert off(moved.path("A")[:, 1], -fallen, fallen[-1]) < 1e-9
    assert off(moved.velocities[:, 0, 1], -u * np.tanh(G * moved.times / u), u) < 1e-9


def test_quadratic_drag_alone_slows_a_body_as_the_logarithm_of_time() -> None:
    drag = force("D", "A", -0.5 * V * V_X, -0.5 * V * V_Y)
    scene = Scene((disc("A", 0, 0, velocity=(3.0, 4.0, 0)),), forces=(drag,), gravity=WEIGHTLESS)
    moved = simulate(scene, 5)
    gone = np.log1p(0.5 * 5 * moved.times) / 0.5
    assert off(moved.path("A"), np.outer(gone, [0.6, 0.8]), gone[-1]) < 1e-9


def kepler(eccentricity: float) -> Scene:
    """From the perihelion of an orbit with a = 1 m, GM = 4π² m³/s²: a year is a second."""
    centre = -4 * sympy.pi**2 * 2 / (X**2 + Y**2) ** sympy.Rational(3, 2)
    speed = 2 * pi * sqrt((1 + eccentricity) / (1 - eccentricity))
    planet = disc("planet", 1 - eccentricity, 0, 0.01, 2.0, (0, speed, 0))
    return Scene((planet,), forces=(force("F", "planet", centre * X, centre * Y),), gravity=WEIGHTLESS)


@pytest.mark.parametrize("eccentricity", [0.0, 0.3, 0.6, 0.9])
def test_a_planet_keeps_keplers_laws(eccentricity: float) -> None:
    # E − e sin E = 2π t/T, T² = 4π²a³/GM; x = cos E − e, y = √(1 − e²) sin E.
    moved = simulate(kepler(eccentricity), 3)
    mean = 2 * pi * moved.times
    anomaly = np.array(
        [brentq(lambda e, m=m: e - eccentricity * sin(e) - m, m - 1, m + 1, xtol=1e-15) for m in mean]
    )
    wide = sqrt(1 - eccentricity**2)
    wanted = np.column_stack([np.cos(anomaly) - eccentricity, wide * np.sin(anomaly)])
    assert off(moved.path("planet"), wanted, 1.0) < 1e-7
    (x, y), (v_x, v_y) = moved.path("planet").T, moved.velocities[:, 0, :2].T
    assert off(x * v_y - y * v_x, 2 * pi * wide, 2 * pi) < 1e-8
    energy = (v_x**2 + v_y**2) / 2 - 4 * pi**2 / np.hypot(x, y)
    assert off(energy, -2 * pi**2, 2 * pi**2) < 1e-7
    assert off(ledger(moved), ledger(moved)[0], moved.energy.kinetic.max()) < 1e-8


@pytest.mark.parametrize("eccentricity", [0.3, 0.6])
def test_the_year_of_a_planet_is_measured_where_it_crosses_its_axis(eccentricity: float) -> None:
    moved = simulate(kepler(eccentricity), 1.1)

    def height(time: float) -> float:
        return float(moved.at(np.array([time])).path("planet")[0, 1])

    year = brentq(height, 0.9, 1.1, xtol=1e-14)
    assert year == pytest.approx(1.0, rel=1e-7)


def test_a_force_off_from_a_moment_on_is_met_on_the_kink() -> None:
    # F = 4 max(0, 1 − t): v = 4 t − 2 t², then 2; x = 2 t² − 2 t³/3, then 4/3 + 2 (t − 1).
    push = force("F", "A", 4 * sympy.Max(0, 1 - T))
    moved = simulate(Scene((disc("A", 0, 0),), forces=(push,), gravity=WEIGHTLESS), 3)
    t = np.minimum(moved.times, 1)
    wanted = 2 * t**2 - 2 * t**3 / 3 + 2 * (moved.times - t)
    assert off(moved.path("A")[:, 0], wanted, wanted[-1]) < 1e-9


def test_a_force_that_jumps_with_a_sign_is_switched_at_its_place() -> None:
    # F = −8 sign(x) from x = 1: quarters of √(2/8) s, each a parabola.
    push = force("F", "A", -8 * sympy.sign(X))
    moved = simulate(Scene((disc("A", 1, 0),), forces=(push,), gravity=WEIGHTLESS), 5)
    quarter = sqrt(2 / 8)
    phase = (moved.times + quarter) % (4 * quarter)
    half = phase % (2 * quarter) - quarter
    wanted = np.where(phase < 2 * quarter, 1, -1) * (1 - 4 * half**2)
    assert off(moved.path("A")[:, 0], wanted, 1.0) < 1e-9


def test_two_forces_and_the_weight_in_balance_leave_a_body_at_rest() -> None:
    lift = (force("F_1", "A", 3.0, G), force("F_2", "A", -3.0))
    moved = simulate(Scene((disc("A", 1, 2),), forces=lift), 5)
    assert off(moved.poses, moved.poses[0], 1.0) < 1e-12


# Formulas without a value -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("tree", "time"),
    [(sympy.sqrt(1 - T), 1.0), (sympy.log(0.5 - T), 0.5), (sympy.sin(T) / X, 0.0), (sympy.asin(2 * T), 0.5)],
)
def test_a_formula_without_a_value_stops_the_run_and_is_named(tree: sympy.Basic, time: float) -> None:
    push = force("F_2", "A", tree)
    moved = simulate(Scene((disc("A", 0, 0),), forces=(push,), gravity=WEIGHTLESS), 2)
    stopped = events(moved, "stopped")
    assert [event.time for event in stopped] == [pytest.approx(time, abs=1e-9)]
    assert "F_2" in stopped[0].message and push.x.text in stopped[0].message
    assert np.isfinite(moved.poses).all() and np.isfinite(moved.velocities).all()
    assert len(moved.times) == 121
    late = moved.times > time
    assert np.all(moved.poses[late] == moved.poses[late][0])


def test_a_formula_that_overflows_stops_the_run() -> None:
    push = force("F", "A", sympy.exp(1000 * T))
    moved = simulate(Scene((disc("A", 0, 0),), forces=(push,), gravity=WEIGHTLESS), 2)
    assert len(events(moved, "stopped")) == 1
    assert np.isfinite(moved.poses).all()


# Equations of motion ----------------------------------------------------------------------------


def test_velocity_equations_of_a_throw_give_its_parabola_and_its_net_force() -> None:
    courses = (
        course("v_x", "A", "x", sympy.Integer(3), sympy.Integer(0)),
        course("v_y", "A", "y", 4 - G * T, sympy.Float(-G)),
    )
    moved = simulate(Scene((disc("A", 0, 0, mass=2.0),), courses=courses), 2)
    t = moved.times
    wanted = np.column_stack([3 * t, 4 * t - G / 2 * t**2])
    assert off(moved.path("A"), wanted, np.abs(wanted).max()) < 1e-12
    assert off(moved.velocities[:, 0, :2], np.column_stack([3 + 0 * t, 4 - G * t]), 2 * G) < 1e-12
    assert off(moved.accelerations[:, 0, :2], np.array([0.0, -G]), G) < 1e-12


def test_a_velocity_equation_in_x_leaves_y_to_gravity() -> None:
    moved = simulate(
        Scene((disc("A", 1, 0, velocity=(9, 5, 0)),), courses=(course("v_x", "A", "x", -2 * X, -2 * V_X),)), 2
    )
    t = moved.times
    assert off(moved.path("A")[:, 0], np.exp(-2 * t), 1.0) < 1e-9
    assert off(moved.velocities[:, 0, 0], -2 * np.exp(-2 * t), 2.0) < 1e-9
    assert off(moved.accelerations[:, 0, 0], 4 * np.exp(-2 * t), 4.0) < 1e-9
    assert off(moved.path("A")[:, 1], 5 * t - G / 2 * t**2, 2 * G) < 1e-12


def test_position_equations_are_not_integrated_at_all() -> None:
    courses = (place_course("x", "A", "x", sympy.cos(3 * T)), place_course("y", "A", "y", T**2))
    moved = simulate(Scene((disc("A", 1, 0),), courses=courses), 3)
    t = moved.times
    assert off(moved.path("A"), np.column_stack([np.cos(3 * t), t**2]), 1.0) < 1e-14
    assert off(moved.velocities[:, 0, :2], np.column_stack([-3 * np.sin(3 * t), 2 * t]), 3.0) < 1e-14
    assert off(moved.accelerations[:, 0, :2], np.column_stack([-9 * np.cos(3 * t), 2 + 0 * t]), 9.0) < 1e-14


def test_a_body_on_a_course_that_collides_is_released_and_then_obeys_newton() -> None:
    # At x = 2 t it strikes an equal disc 1.5 m ahead of its rim: it stops, the other goes on.
    bodies = (disc("A", 0, 0, material=Material(1.0)), disc("B", 2, 0))
    scene = Scene(bodies, courses=(place_course("x", "A", "x", 2 * T),), gravity=WEIGHTLESS)
    moved = simulate(scene, 2)
    assert [(e.time, e.bodies[0]) for e in events(moved, "released")] == [
        (pytest.approx(0.75, abs=1e-9), "A")
    ]
    t = moved.times
    assert off(moved.path("A")[:, 0], np.minimum(2 * t, 1.5), 2.0) < 1e-9
    assert off(moved.path("B")[:, 0], np.maximum(2 * t + 0.5, 2.0), 2.0) < 1e-9
    assert off(moved.accelerations[:, 0], 0.0, 1.0) < 1e-12


def test_a_course_of_two_coordinates_is_released_in_both() -> None:
    courses = (
        course("v_x", "A", "x", sympy.Integer(1), sympy.Integer(0)),
        course("v_y", "A", "y", sympy.Integer(-2), sympy.Integer(0)),
    )
    moved = simulate(Scene((disc("A", 0, 1.25), floor(Material(0.0))), courses=courses), 2)
    t = moved.times
    assert {round(event.time, 9) for event in events(moved, "released")} == {0.5}
    assert off(moved.path("A"), np.column_stack([t, np.maximum(1.25 - 2 * t, 0.25)]), 2.0) < 1e-9


def test_a_course_carries_what_hangs_on_it_and_feels_nothing() -> None:
    # A ball that hangs on a trolley with x'' = a leans back by tan φ = a/g, and stays so.
    a = 4.0
    lean = np.arctan(a / G)
    bodies = (disc("trolley", 0, 0, 0.1), disc("bob", -sin(lean), -cos(lean), 0.1, 3.0))
    courses = (place_course("x", "trolley", "x", a * T**2 / 2), place_course("y", "trolley", "y", 0 * T))
    moved = simulate(Scene(bodies, wires=(wire("wire", "bob", "trolley", 1.0),), courses=courses), 2)
    gone = a * moved.times**2 / 2
    assert off(moved.path("trolley"), np.column_stack([gone, 0 * gone]), gone[-1]) < 1e-12
    assert off(moved.path("bob"), np.column_stack([gone - sin(lean), 0 * gone - cos(lean)]), gone[-1]) < 1e-8
    tension = moved.force("T of wire", "bob").values
    assert off(tension, 3 * np.array([a, G]), 3 * G) < 1e-7


def test_a_position_equation_may_not_read_the_motion() -> None:
    made = place_course("x", "A", "x", X * T)
    with pytest.raises(SceneError, match="time t alone"):
        Scene((disc("A", 0, 0),), courses=(made,))


# Normal forces: the worked example of the page ---------------------------------------------------


@pytest.mark.parametrize("angle", [pi / 6, pi / 5])
def test_a_given_support_that_is_right_lets_the_ball_down_with_a_straight_speed(angle: float) -> None:
    moved = simulate(supported(angle, 1.0), 1.2)
    assert off(moved.speed("ball"), G * sin(angle) * moved.times, G) < 1e-9
    assert off(way(moved, "ball", downhill(angle)), G * sin(angle) * moved.times**2 / 2, G) < 1e-9
    assert not moved.events


def test_a_given_support_that_is_too_small_lets_the_ball_sink_and_strikes_it_back() -> None:
    # (1 − share) g cos θ into the surface: the skin of 3 cm after √(2 · 0.03 / …), then back without loss.
    angle, share = pi / 6, 0.9
    moved = simulate(supported(angle, share), 1.2)
    sink = (1 - share) * G * cos(angle)
    struck = sqrt(2 * 0.03 / sink)
    assert {event.kind for event in moved.events} == {"bounce"}
    times = [event.time for event in moved.events]
    assert times == pytest.approx([struck * (2 * k + 1) for k in range(len(times))], abs=1e-9)
    down = downhill(angle)
    rise = way(moved, "ball", np.array([-down[1], down[0]]))
    phase = (moved.times + struck) % (2 * struck) - struck
    assert off(rise, -sink * phase**2 / 2, 0.03) < 1e-8
    assert off(way(moved, "ball", down), G * sin(angle) * moved.times**2 / 2, G) < 1e-9


def test_a_given_support_that_is_too_great_lifts_the_ball_off() -> None:
    angle, share = pi / 6, 1.1
    moved = simulate(supported(angle, share), 1.2)
    assert [event.kind for event in moved.events] == ["lift-off"]
    down = downhill(angle)
    gone = G * sin(angle) * moved.times**2 / 2
    assert off(way(moved, "ball", down), gone, gone[-1]) < 1e-9
    rise = way(moved, "ball", np.array([-down[1], down[0]]))
    assert off(rise, 0.5 * (share - 1) * G * cos(angle) * moved.times**2, rise[-1]) < 1e-9
