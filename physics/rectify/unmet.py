"""Angles that a page says and that its drawing does not have: told to the student, with what would be right.

An angle cannot be had where it is none of an incline or a link (30 radians, where degrees were meant), where it stands
against another one, or where the student has undone its correction. Page units, y down.
"""

from __future__ import annotations

from math import degrees, pi

from physics.formula.names import number_said
from physics.parts.given import Spoken
from physics.rectify.angles import drawn_at
from physics.rectify.incline import RULE as INCLINE
from physics.rectify.incline import inclined
from sketch.page import Component, Sketch
from sketch.shapes import Polygon, Spring, Wire

HELD = 1e-6
"""Radians: an angle that is off by more does not hold."""


def unmet(sketch: Sketch, spoken: Spoken) -> tuple[str, ...]:
    """A sentence for each angle that is said of an incline, a spring or a wire and does not hold."""
    found: list[str] = []
    for part in sketch.components:
        said = spoken.of(part, "angle")
        limits = None if said is None else _limits(part)
        angle = None if said is None or limits is None else number_said(sketch, spoken.meanings, said)
        if said is None or limits is None or angle is None:
            continue
        low, high = limits
        if not low <= angle <= high:
            what = "an incline" if isinstance(part.shape, Polygon) else f"a {part.kind}"
            in_degrees = "°" in said.text or "deg" in said.text
            size = f"{degrees(angle):.4g}°" if in_degrees else f"{angle:.4g} radians, {degrees(angle):.4g}°"
            hint = "" if in_degrees or not high < angle <= 90 else f"; write {angle:g}° for degrees"
            found.append(
                f"{said.text} of {part.label} is {size}: the angle of {what} lies between {degrees(low):.0f}° "
                f"and {degrees(high):.0f}°{hint}. The drawing keeps its own."
            )
            continue
        drawn = _drawn(sketch, spoken, part)
        if drawn is not None and abs(drawn - angle) > HELD:
            found.append(
                f"{said.text} of {part.label} does not hold: as it is drawn, its angle is {degrees(drawn):.4g}°."
            )
    return tuple(found)


def _limits(part: Component) -> tuple[float, float] | None:
    """Between which angles (radians) a component can be inclined; None for what is no incline and no link."""
    match part.shape:
        case Polygon():
            flattest = INCLINE.flattest
            return None if inclined(part.shape) is None else (flattest, pi / 2 - flattest)
        case Spring() | Wire():
            one, other = part.ends
            return None if one is not None and one == other else (0.0, pi / 2)
        case _:
            return None


def _drawn(sketch: Sketch, spoken: Spoken, part: Component) -> float | None:
    """The angle that a component has, as it is measured there, radians."""
    if isinstance(part.shape, Polygon):
        return inclined(part.shape)
    return drawn_at(sketch, spoken, part)
