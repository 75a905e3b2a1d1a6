"""inklined itself: the whole call of `simulate`, scene packing and trajectory included."""

from __future__ import annotations

from time import process_time

import numpy as np

from peers.world import RATE, Run, Setting, uninterrupted
from physics.engine import simulate
from physics.scene import Scene, WireLink
from physics.trajectory import Trajectory
from sketch.ink import FloatArray


def run(scene: Scene, seconds: float, setting: Setting, observe: bool) -> Run:
    """One run; only the call of `simulate` is timed."""
    with uninterrupted():
        begun = process_time()
        trajectory = simulate(scene, seconds, float(RATE), accuracy=setting.accuracy)
        cpu = process_time() - begun
    columns = [trajectory.column(body.label) for body in scene.bodies if not body.fixed]
    places = trajectory.poses[:, columns]
    if not observe:
        return Run(cpu, places)
    pulls = {wire.label: _pull(trajectory, wire) for wire in scene.wires}
    return Run(cpu, places, trajectory.velocities[:, columns], pulls)


def _pull(trajectory: Trajectory, wire: WireLink) -> FloatArray:
    name = f"T of {wire.label}"
    one = next(force for force in trajectory.forces if force.name == name)
    return np.linalg.norm(one.values, axis=1)
