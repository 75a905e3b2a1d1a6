"""Closed-form motions through the public `simulate`, at 60 frames a second: flight, springs, pendulums.

Errors are shares of the size of the quantity: of the way gone, of the amplitude, of the weight.
"""

from __future__ import annotations

from cmath import cosh, sinh
from math import cos, sin, sqrt

import numpy as np
import pytest
from physics_scenes import (
    G,
    T,
    angles,
    disc,
    force,
    ledger,
    mechanical,
    off,
    pendulum,
    rod_pendulum,
    size_of,
    spring,
)
from scipy.special import ellipj, ellipk
from sympy import cos as cosine

from physics.engine import simulate
from physics.scene import Scene

WEIGHTLESS = (0.0, 0.0)


def swing(angle: float, rate: float, t: np.ndarray) -> np.ndarray:
    """θ'' = −rate² sin θ, let go at `angle`: sin(θ/2) = k sn(K(k) − rate·t; k), k = sin(angle/2)."""
    k = sin(angle / 2)
    return 2 * np.arcsin(k * ellipj(ellipk(k * k) - rate * t, k * k)[0])


def ring(x: float, v: float, rate: float, damping: float, t: float) -> float:
    """x'' = −2·damping·x' − rate²·x from x, v. With s² = damping² − rate² it is
    e^(−damping·t) (x cosh st + (v + damping·x) sinh(st)/s), where sinh(st)/s → t as s → 0."""
    s = (damping**2 - rate**2 + 0j) ** 0.5
    sine = sinh(s * t) / s if s else t
    return float((np.exp(-damping * t) * (x * cosh(s * t) + (v + damping * x) * sine)).real)


# Flight -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("velocity", [(3.0, 4.0), (-0.1, 0.0), (0.0, 20.0)])
def test_a_projectile_follows_its_parabola_and_turns_evenly(velocity: tuple[float, float]) -> None:
    v_x, v_y = velocity
    moved = simulate(Scene((disc("A", 0, 0, velocity=(v_x, v_y, 2.0)),)), 3)
    t = moved.times
    wanted = np.column_stack([v_x * t, v_y * t - G / 2 * t**2])
    assert off(moved.path("A"), wanted, np.abs(wanted).max()) < 1e-12
    assert off(moved.velocities[:, 0, 1], v_y - G * t, 3 * G) < 1e-12
    assert off(moved.poses[:, 0, 2], 2 * t, 6) < 1e-12
    assert off(moved.force("weight", "A").values, np.array([0.0, -G]), G) < 1e-12


# Springs ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("stiffness", [5.0, 50.0, 5000.0])
def test_a_mass_on_a_spring_swings_harmonically_and_keeps_its_energy(stiffness: float) -> None:
    held = spring("S", "A", (0, 0), 1.0, stiffness)
    moved = simulate(Scene((disc("A", 1.2, 0, mass=2.0),), (held,), gravity=WEIGHTLESS), 10)
    stretch = 0.2 * np.cos(sqrt(stiffness / 2) * moved.times)
    assert off(moved.path("A")[:, 0], 1 + stretch, 0.2) < 1e-8
    assert off(size_of(moved, "spring S", "A"), np.abs(stiffness * stretch), stiffness * 0.2) < 1e-8
    assert off(mechanical(moved), stiffness * 0.02, stiffness * 0.02) < 1e-8


def test_a_hanging_mass_swings_about_m_g_over_k_below() -> None:
    moved = simulate(Scene((disc("A", 0, -1.0),), (spring("S", "A", (0, 0), 1.0, 40.0),)), 10)
    wanted = -1 - G / 40 * (1 - np.cos(sqrt(40) * moved.times))
    assert off(moved.path("A")[:, 1], wanted, G / 40) < 1e-8
    assert not moved.path("A")[:, 0].any()


@pytest.mark.parametrize("upright", [False, True])
@pytest.mark.parametrize("share", [0.1, 0.5, 1.0, 2.0], ids=["light", "under", "critical", "over"])
def test_a_damped_spring_dies_away_in_its_regime_and_the_rest_is_heat(share: float, upright: bool) -> None:
    mass, rate = 2.0, 4.0
    damping = share * rate
    held = spring("S", "A", (0, 0), 1.0, mass * rate**2, 2 * mass * damping)
    sag = G / rate**2 if upright else 0.0
    start = (0.0, -1.0 - sag - 0.2) if upright else (1.2, 0.0)
    speed = (0.0, -0.3, 0.0) if upright else (0.3, 0.0, 0.0)
    gravity = (0.0, -G) if upright else WEIGHTLESS
    moved = simulate(Scene((disc("A", *start, mass=mass, velocity=speed),), (held,), gravity=gravity), 5)
    stretch = np.array([ring(0.2, 0.3, rate, damping, t) for t in moved.times])
    length = -moved.path("A")[:, 1] if upright else moved.path("A")[:, 0]
    assert off(length, 1 + sag + stretch, 0.2) < 1e-8
    assert off(ledger(moved), ledger(moved)[0], mass * rate**2 * 0.02) < 1e-8
    assert moved.energy.dissipated[-1] > 0


@pytest.mark.parametrize("drive", [1.0, 3.9, 12.0])
@pytest.mark.parametrize("damping", [0.0, 3.0])
def test_a_driven_spring_has_its_transient_and_then_the_amplitude_of_resonance_theory(
    drive: float, damping: float
) -> None:
    # x'' + 2γx' + ω²x = (F/m) cos Ωt: x = A cos(Ωt − δ) + what the start leaves of the free motion,
    # A = (F/m) / √((ω² − Ω²)² + (2γΩ)²), tan δ = 2γΩ / (ω² − Ω²).
    mass, rate, push = 2.0, 4.0, 3.0
    held = spring("S", "A", (0, 0), 2.0, mass * rate**2, 2 * mass * damping)
    driven = (force("F", "A", push * cosine(drive * T)),)
    moved = simulate(Scene((disc("A", 2, 0, mass=mass),), (held,), forces=driven, gravity=WEIGHTLESS), 10)
    amplitude = push / mass / np.hypot(rate**2 - drive**2, 2 * damping * drive)
    lag = np.arctan2(2 * damping * drive, rate**2 - drive**2)
    free = (-amplitude * cos(lag), -amplitude * drive * sin(lag))
    wanted = amplitude * np.cos(drive * moved.times - lag)
    wanted += [ring(*free, rate, damping, t) for t in moved.times]
    assert off(moved.path("A")[:, 0], 2 + wanted, amplitude) < 1e-6
    if damping:
        late = moved.times > 7
        waves = np.column_stack([f(drive * moved.times[late]) for f in (np.cos, np.sin)])
        found = np.linalg.lstsq(waves, moved.path("A")[late, 0] - 2, rcond=None)[0]
        assert np.hypot(*found) == pytest.approx(amplitude, rel=1e-6)


def test_at_resonance_the_amplitude_grows_in_proportion_to_time() -> None:
    held = spring("S", "A", (0, 0), 5.0, 16.0)
    driven = (force("F", "A", 0.5 * cosine(4 * T)),)
    moved = simulate(Scene((disc("A", 5, 0),), (held,), forces=driven, gravity=WEIGHTLESS), 10)
    wanted = 0.5 * moved.times * np.sin(4 * moved.times) / (2 * 4)
    assert off(moved.path("A")[:, 0], 5 + wanted, 0.625) < 1e-6


def test_two_masses_on_a_spring_swing_with_their_reduced_mass_about_a_centre_that_drifts() -> None:
    light, heavy, stiffness, drift = 1.0, 3.0, 30.0, 0.4
    bodies = (
        disc("A", 0, 0, mass=light, velocity=(drift, 0, 0)),
        disc("B", 1.3, 0, mass=heavy, velocity=(drift, 0, 0)),
    )
    moved = simulate(Scene(bodies, (spring("S", "A", "B", 1.0, stiffness),), gravity=WEIGHTLESS), 10)
    rate = sqrt(stiffness * (light + heavy) / (light * heavy))
    stretch = 0.3 * np.cos(rate * moved.times)
    centre = 1.3 * heavy / (light + heavy) + drift * moved.times
    a, b = moved.path("A")[:, 0], moved.path("B")[:, 0]
    assert off(b - a, 1 + stretch, 0.3) < 1e-8
    assert off(a, centre - heavy / (light + heavy) * (1 + stretch), 0.3) < 1e-8
    assert off((light * a + heavy * b) / (light + heavy), centre, 4.0) < 1e-12


def test_three_springs_and_two_masses_swing_in_their_two_normal_modes() -> None:
    # Together at √(k/m), against each other at √((k + 2c)/m).
    k, c = 20.0, 3.0
    bodies = (disc("A", 1.1, 0, 0.1), disc("B", 2.0, 0, 0.1))
    links = (
        spring("left", "A", (0, 0), 1.0, k),
        spring("middle", "A", "B", 1.0, c),
        spring("right", "B", (3, 0), 1.0, k),
    )
    moved = simulate(Scene(bodies, links, gravity=WEIGHTLESS), 10)
    together = 0.05 * np.cos(sqrt(k) * moved.times)
    against = 0.05 * np.cos(sqrt(k + 2 * c) * moved.times)
    assert off(moved.path("A")[:, 0], 1 + together + against, 0.1) < 1e-8
    assert off(moved.path("B")[:, 0], 2 + together - against, 0.1) < 1e-8


# Pendulums --------------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [0.05, 0.8, 1.5])
def test_a_pendulum_swings_as_the_elliptic_functions_say(angle: float) -> None:
    moved = simulate(pendulum(angle), 10)
    assert off(angles(moved, "bob"), swing(angle, sqrt(G), moved.times), angle) < 1e-8
    assert off(np.hypot(*moved.path("bob").T), 1.0, 1.0) < 1e-8
    assert off(mechanical(moved), mechanical(moved)[0], G * (1 - cos(angle))) < 1e-8


@pytest.mark.parametrize("angle", [0.05, 0.8, 1.5])
def test_the_tension_of_a_pendulum_is_m_g_times_3_cos_theta_minus_2_cos_theta_0(angle: float) -> None:
    mass, length = 3.0, 0.7
    moved = simulate(pendulum(angle, length, mass), 10)
    at = swing(angle, sqrt(G / length), moved.times)
    pull = mass * G * (3 * np.cos(at) - 2 * cos(angle))
    wanted = pull[:, None] * np.column_stack([-np.sin(at), np.cos(at)])
    assert off(moved.force("T of wire", "bob").values, wanted, mass * G) < 1e-7


@pytest.mark.parametrize("angle", [0.1, 1.5, 3.0])
def test_a_physical_pendulum_swings_by_its_moment_of_inertia(angle: float) -> None:
    # θ'' = −m g d / (I + m d²) sin θ; an even bar of 1.2 m × 0.1 m by its end.
    scene = rod_pendulum(angle)
    bar, reach = scene.bodies[0], 0.6
    rate = sqrt(bar.mass * G * reach / (bar.inertia + bar.mass * reach**2))
    moved = simulate(scene, 10)
    wanted = swing(angle, rate, moved.times)
    assert off(moved.poses[:, 0, 2], wanted, angle) < 1e-8
    centre = reach * np.column_stack([np.sin(wanted), -np.cos(wanted)])
    assert off(moved.path("bar"), centre, reach) < 1e-8


@pytest.mark.parametrize("angle", [0.1, 1.5])
def test_the_pin_of_a_physical_pendulum_bears_weight_and_centripetal_force(angle: float) -> None:
    # The pin gives all but the weight: m a + m g up, a = d θ'² inward and d θ'' along the circle.
    scene = rod_pendulum(angle)
    bar, reach = scene.bodies[0], 0.6
    square = bar.mass * G * reach / (bar.inertia + bar.mass * reach**2)
    moved = simulate(scene, 5)
    at = swing(angle, sqrt(square), moved.times)
    inward = reach * 2 * square * (np.cos(at) - cos(angle))
    along = -reach * square * np.sin(at)
    wanted = bar.mass * np.column_stack(
        [along * np.cos(at) - inward * np.sin(at), G + along * np.sin(at) + inward * np.cos(at)]
    )
    assert off(moved.force("pin pin", "bar").values, wanted, bar.mass * G) < 1e-7
