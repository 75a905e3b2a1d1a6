"""The order in which a page is corrected.

Shapes first (C1), then the incline and what rests on it (C3), contacts (C2), the ends of links on
the boundaries that result (C4), and their angles last (C5), since nothing afterwards may turn
them again. Each step is a pure function of the page; a page that is exact already comes out as
it went in, and correcting twice is correcting once.
"""

from __future__ import annotations

from physics.formula.meaning import read
from physics.formula.names import mass_of
from physics.rectify.angles import aim
from physics.rectify.attachments import attach
from physics.rectify.contacts import touch
from physics.rectify.correction import Rectified
from physics.rectify.incline import tilt
from physics.rectify.straighten import straighten
from sketch.page import Sketch


def rectify(sketch: Sketch) -> Rectified:
    """The corrected page with all corrections, in the order in which they were made."""
    meanings = read(sketch)

    def mass(label: str) -> float:
        return mass_of(sketch, meanings, sketch.component(label))[0]

    straight = straighten(sketch)
    tilted = tilt(straight.sketch, meanings)
    touching = touch(tilted.sketch, mass)
    attached = attach(touching.sketch)
    aimed = aim(attached.sketch, meanings)
    steps = (straight, tilted, touching, attached, aimed)
    return Rectified(aimed.sketch, tuple(made for step in steps for made in step.corrections))
