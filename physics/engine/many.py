"""One scene, or many of different shapes in parallel."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from math import isfinite
from typing import Literal

from physics.engine.simulation import ACCURACY, Simulation
from physics.scene import Scene, SceneError
from physics.trajectory import Mode, Trajectory

Choice = Literal["auto"] | Mode
"""How to simulate: "auto" is exact where the contacts are few enough."""


def simulate(
    scene: Scene, seconds: float, rate: float = 60.0, *, mode: Choice = "auto", accuracy: float = ACCURACY
) -> Trajectory:
    """The motion of a scene, on a grid of floor(seconds · rate) + 1 times.

    seconds: >= 0; rate: frames per second, > 0; accuracy: m and m/s that a step may err by (relative above 1).
    Where a formula has no value, everything stands still from then on and an event "stopped" says why.
    Raises SceneError for times and modes that are none, for springs too stiff for their load, and where
    exact mode was forced on more contacts than it can decide.
    """
    if not (isfinite(seconds) and isfinite(rate) and seconds >= 0 and rate > 0):
        raise SceneError(
            f"cannot move for {seconds:g} s at {rate:g} frames a second; both must be positive numbers"
        )
    if mode not in ("auto", "exact", "robust"):
        raise SceneError(f"there is no mode {mode!r}; there are auto, exact and robust")
    run = Simulation(scene, None if mode == "auto" else mode, accuracy)
    run.run_to(seconds)
    return run.trajectory(rate, seconds)


def simulate_many(
    scenes: Sequence[Scene],
    seconds: float,
    rate: float = 60.0,
    *,
    threads: int = 1,
    mode: Choice = "auto",
    accuracy: float = ACCURACY,
) -> list[Trajectory]:
    """`simulate` for each scene, in so many threads; the same to the bit whatever their number. Raises SceneError as
    `simulate` does, and for less than one thread."""
    if threads < 1:
        raise SceneError(f"cannot simulate in {threads} threads; it takes one at least")
    one = partial(simulate, seconds=seconds, rate=rate, mode=mode, accuracy=accuracy)
    if threads == 1:
        return [one(scene) for scene in scenes]
    with ThreadPoolExecutor(threads) as pool:
        return list(pool.map(one, scenes))
