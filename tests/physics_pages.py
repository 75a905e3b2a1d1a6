"""Small exact pages, without ink. Page units, y down."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin, tan

import numpy as np

from sketch.formula.parse import expression
from sketch.page import Association, Component, Sketch
from sketch.shapes import Circle, Point, Polygon, Wire


def page(
    components: Sequence[Component], remarks: Sequence[tuple[str, str | None, Point | None]] = ()
) -> Sketch:
    """remarks: (text, label or None for the whole page, anchor)."""
    expressions = tuple(expression(text) for text, _, _ in remarks)
    associations = tuple(
        Association(k, label, anchor or (0.0, 0.0))
        for k, (_, label, anchor) in enumerate(remarks)
        if label is not None
    )
    return Sketch(components=tuple(components), expressions=expressions, associations=associations)


def rectangle(left: float, top: float, right: float, bottom: float) -> Polygon:
    """Anti-clockwise to the eye, from the top left."""
    return Polygon([(left, top), (left, bottom), (right, bottom), (right, top)])


def ball_on_incline(
    share: float = 1.0,
    angle: float = pi / 6,
    drawn: float | None = None,
    gap: float = 0.0,
    written: str = "pi/6",
) -> Sketch:
    """E6: the incline A drawn at one angle, said to have another; the ball B rests on it."""
    drawn = angle if drawn is None else drawn
    foot, base, radius = np.array([100.0, 400.0]), 320.0, 25.0
    up = np.array([cos(drawn), -sin(drawn)])
    out = np.array([-sin(drawn), -cos(drawn)])
    centre = foot + 0.8 * base / cos(drawn) * up + (radius + gap) * out
    triangle = Polygon([foot, np.add(foot, (base, 0)), np.add(foot, (base, -base * tan(drawn)))])
    factor = "" if share == 1.0 else f"{share} "
    return page(
        (
            Component(triangle, label="A", fixed=True),
            Component(Circle((float(centre[0]), float(centre[1])), radius), label="B"),
        ),
        (
            (f"theta = {written}", "A", (150.0, 390.0)),
            (f"f_1 = {factor}|W| cos(theta)", "B", None),
        ),
    )


def box_on_wires(left: str, right: str, lean: float = 0.0) -> Sketch:
    """E7: the box E on wires C and D to the blocks A and B; the left wire leans off by some radians."""
    angle = pi / 4 + lean
    end = (250.0 - 140 * cos(angle), 250.0 - 140 * sin(angle))
    other = (350.0 + 140 * cos(pi / 4), 250.0 - 140 * sin(pi / 4))
    return page(
        (
            Component(rectangle(end[0] - 30, end[1] - 40, end[0] + 30, end[1]), label="A", fixed=True),
            Component(
                rectangle(other[0] - 30, other[1] - 40, other[0] + 30, other[1]), label="B", fixed=True
            ),
            Component(Wire(end, (250.0, 250.0)), label="C", ends=("A", "E")),
            Component(Wire(other, (350.0, 250.0)), label="D", ends=("B", "E")),
            Component(rectangle(250, 250, 350, 320), label="E"),
        ),
        (
            ("g = 10", None, None),
            ("m = 1", "E", None),
            (f"T_1 = {left}", "C", None),
            (f"T_2 = {right}", "D", None),
            ("theta = pi/4", "C", end),
            ("theta = pi/4", "D", other),
        ),
    )
