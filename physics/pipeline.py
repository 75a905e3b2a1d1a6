"""A page set in motion.

motion = move(sketch, seconds=2.0)
"""

from __future__ import annotations

from dataclasses import dataclass

from physics.build import build
from physics.engine import simulate
from physics.rectify import Correction, rectify
from physics.scene import Scene
from physics.trajectory import Trajectory
from sketch.page import Sketch


@dataclass(frozen=True, slots=True)
class Motion:
    """rectified: the page as corrected; corrections: what was changed, and why; scene: what was
    moved; trajectory: how; notices: what the student should know."""

    rectified: Sketch
    corrections: tuple[Correction, ...]
    scene: Scene
    trajectory: Trajectory
    notices: tuple[str, ...]


def move(sketch: Sketch, seconds: float, rate: float = 60.0) -> Motion:
    """Corrects a page, builds its scene and simulates it for `seconds` (s) at `rate` frames a second.

    What a page says and cannot be is told in the notices, never raised. Raises SceneError for a time
    or a rate that is not a positive number, and for springs too stiff to be simulated.
    """
    corrected = rectify(sketch)
    built = build(corrected.sketch)
    trajectory = simulate(built.scene, seconds, rate)
    return Motion(corrected.sketch, corrected.corrections, built.scene, trajectory, built.notices)
