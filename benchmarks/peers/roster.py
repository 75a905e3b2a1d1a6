"""The engines that are compared, and the settings at which each is run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from peers import box2d, box2d3, chipmunk, own
from peers.world import RATE, Run, Setting, play
from physics.scene import Scene

INKLINED = "inklined"
HERTZ = tuple(RATE * 2**k for k in range(7))
"""Steps a second for the peers: 60 to 3840."""

ACCURACIES = tuple(10.0**-k for k in range(3, 13))
SUBSTEPS = (4, 8)
"""Of Box2D 3: its default, and twice as many."""


@dataclass(frozen=True, slots=True)
class Engine:
    """run(scene, seconds, setting, observe); settings: from coarse to fine, the first a peer's usual one."""

    name: str
    run: Callable[[Scene, float, Setting, bool], Run]
    settings: tuple[Setting, ...]

    @property
    def usual(self) -> Setting:
        """What its users get who say nothing: 60 steps a second, or inklined's default accuracy."""
        return Setting()

    def words(self, setting: Setting) -> str:
        """The setting as a table names it."""
        if self.name == INKLINED:
            return f"accuracy {setting.accuracy:.0e}"
        parts = f" x {setting.substeps}" if self.name == "Box2D 3" else ""
        return f"{setting.hertz} Hz{parts}"


def engines(names: Sequence[str] = (), hertz: Sequence[int] = HERTZ) -> list[Engine]:
    """Those of these names, all for none; peers at these rates."""
    plain = tuple(Setting(hertz=rate) for rate in hertz)
    parted = tuple(Setting(hertz=rate, substeps=parts) for rate in hertz for parts in SUBSTEPS)
    everyone = [
        Engine(INKLINED, own.run, tuple(Setting(accuracy=accuracy) for accuracy in ACCURACIES)),
        Engine("pymunk", partial(play, chipmunk.build), plain),
        Engine("Box2D 2.3", partial(play, box2d.build), plain),
        Engine("Box2D 3", partial(play, box2d3.build), parted),
    ]
    return [engine for engine in everyone if not names or engine.name in names]


NAMES = tuple(engine.name for engine in engines())
