"""A page set in motion.

motion = move(sketch, seconds=2.0)
other = move(sketch, seconds=2.0, without={motion.corrections[0].key})   # the first correction undone
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from physics.build import build
from physics.engine import simulate
from physics.rectify import Correction, Key, rectify
from physics.scene import Scene
from physics.trajectory import Trajectory
from sketch.page import Sketch


@dataclass(frozen=True, slots=True)
class Motion:
    """rectified: the page as corrected; corrections: what was changed, and why; scene: what was
    moved; trajectory: how; notices: what the student should know; displacement: the way of all vertices, centres
    and ends from where they were drawn, summed, page units."""

    rectified: Sketch
    corrections: tuple[Correction, ...]
    scene: Scene
    trajectory: Trajectory
    notices: tuple[str, ...]
    displacement: float


def move(sketch: Sketch, seconds: float, rate: float = 60.0, without: Iterable[Key] = ()) -> Motion:
    """Corrects a page, builds its scene and simulates it for `seconds` (s) at `rate` frames a second.

    without: corrections that are not to be made, by their keys (see `physics.rectify.rectify`).

    What a page says and cannot be is told in the notices, never raised. Raises SceneError for a time
    or a rate that is not a positive number, and for springs too stiff to be simulated.
    """
    corrected = rectify(sketch, without)
    built = build(corrected.sketch, corrected.meanings)
    trajectory = simulate(built.scene, seconds, rate)
    return Motion(
        corrected.sketch,
        corrected.corrections,
        built.scene,
        trajectory,
        built.notices,
        corrected.displacement,
    )
