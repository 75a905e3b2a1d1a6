"""A hanging chain of links and its motion, computed to convergence by other means than the engine's.

Link i, 0 at the top, is as long as every other and carries its mass (1 kg) in its middle, with a rod's
moment of inertia; pins join them, the first to the origin. Its body is a disc small enough never to meet
another, so that nothing but the pins acts.

The reference takes the angles θ of the links as coordinates (there are no constraints left then): with
c_ij = m l² (n − max(i, j) − ½) and on the diagonal m l² (n − i − ¾) + I,
Σ_j c_ij cos(θ_i − θ_j) θ̈_j = −Σ_j c_ij sin(θ_i − θ_j) θ̇_j² − g m l (n − i − ½) sin θ_i,
angles from straight down, by DOP853 at a relative tolerance of 1e-12.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, sin

import numpy as np
from scipy.integrate import solve_ivp

from physics.scene import Anchor, Body, Disc, Material, Pin, Scene
from sketch.ink import FloatArray

G = 9.81
MASS = 1.0
SLENDER = 0.05
"""A disc's radius, of its link's length."""

TOLERANCE = 1e-12


def chain(links: int, length: float, angle: float) -> Scene:
    """A straight chain at an angle from the vertical, at rest."""
    along = (sin(angle), -cos(angle))
    bodies = tuple(
        Body(
            f"link {i}",
            Disc(SLENDER * length),
            ((i + 0.5) * length * along[0], (i + 0.5) * length * along[1]),
            MASS,
            MASS * length**2 / 12,
            angle,
            material=Material(restitution=0.0, friction=0.0),
        )
        for i in range(links)
    )
    upper, lower = (0.0, length / 2), (0.0, -length / 2)
    pins = tuple(
        Pin(
            f"pin {i}",
            Anchor(f"link {i}", upper),
            Anchor(f"link {i - 1}", lower) if i else Anchor(None, (0.0, 0.0)),
        )
        for i in range(links)
    )
    return Scene(bodies, pins=pins)


def chain_places(links: int, length: float, angle: float, seconds: float) -> Callable[[float], FloatArray]:
    """Where the links' middles truly are, (links, 2) m, at a time up to `seconds`."""
    index = np.arange(links)
    heavier = np.maximum(index[:, None], index[None, :])
    coupling = MASS * length**2 * (links - heavier - 0.5)
    coupling[index, index] = MASS * length**2 * (links - index - 0.75) + MASS * length**2 / 12
    pull = G * MASS * length * (links - index - 0.5)

    def derivative(_: float, state: FloatArray) -> FloatArray:
        angles, rates = state[:links], state[links:]
        apart = angles[:, None] - angles[None, :]
        force = -(coupling * np.sin(apart)) @ rates**2 - pull * np.sin(angles)
        turning = np.linalg.solve(coupling * np.cos(apart), force)
        return np.concatenate((rates, np.asarray(turning, dtype=np.float64)))

    start = np.concatenate((np.full(links, angle), np.zeros(links)))
    motion = solve_ivp(
        derivative, (0.0, seconds), start, "DOP853", dense_output=True, rtol=TOLERANCE, atol=TOLERANCE
    )

    def places(t: float) -> FloatArray:
        # What is asked for is the run's end, where the interpolation is the solution itself.
        angles: FloatArray = motion.sol(t)[:links]
        steps = length * np.column_stack((np.sin(angles), -np.cos(angles)))
        return np.cumsum(steps, axis=0) - steps / 2

    return places
