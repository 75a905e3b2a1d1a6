"""Pages that nobody meant: solids anywhere, links whose ends lie far from what they are attached to, angles said of
whatever is there. Page units, y down."""

from __future__ import annotations

import numpy as np
from physics_pages import page

from sketch.page import Component, Sketch
from sketch.shapes import Circle, Point, Polygon, Spring, Wire

ANGLES = ("pi/6", "pi/4", "pi/3", "0.2", "0.9", "1.4", "pi/2")


def junk(seed: int) -> Sketch:
    """One to five solids, up to four links between any two of them or none, and up to four angles."""
    rng = np.random.default_rng([8, seed])

    def anywhere() -> Point:
        return (float(rng.uniform(0, 600)), float(rng.uniform(0, 450)))

    parts: list[Component] = []
    for k in range(int(rng.integers(1, 6))):
        fixed = bool(rng.random() < 0.4)
        if rng.random() < 0.4:
            parts.append(Component(Circle(anywhere(), float(rng.uniform(3, 80))), label=f"S{k}", fixed=fixed))
        else:
            corners = np.array(anywhere()) + rng.uniform(-120, 120, size=(int(rng.integers(3, 6)), 2))
            parts.append(Component(Polygon(corners), label=f"S{k}", fixed=fixed))
    solids = [part.label for part in parts]
    for k in range(int(rng.integers(0, 5))):
        ends = tuple(None if rng.random() < 0.2 else str(rng.choice(solids)) for _ in range(2))
        start, end = anywhere(), anywhere()
        shape = Wire(start, end) if rng.random() < 0.6 else Spring(start, end, 5.0, 20.0)
        parts.append(Component(shape, label=f"L{k}", ends=(ends[0], ends[1])))
    said = [
        (f"theta = {rng.choice(ANGLES)}", str(rng.choice([part.label for part in parts])), anywhere())
        for _ in range(int(rng.integers(0, 5)))
    ]
    return page(parts, said)
