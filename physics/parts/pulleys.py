"""Wires over pulleys: two wires that touch one fixed circle are one wire that runs over it.

A pulley is drawn as a fixed circle, and the wire over it as two wires, one from each load, that end on the
circle where they touch it. They are one wire where both are tangents there (within `aslant`) and go round
the circle in the same sense; a wire that ends on a fixed circle otherwise hangs from it. Two that touch
alone make a pulley: of three it is not clear which go together.

Scene: SI units, y up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import acos, atan2, hypot, pi, radians, sin, sqrt

from physics.parts.given import to_metres
from physics.scene import Pulley, Vector
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Wire


@dataclass(frozen=True, slots=True)
class PulleyRule:
    """When a wire touches a circle rather than hangs from it."""

    aslant: float = radians(35)
    """Radians between a wire and the tangent where it ends: a hand ends beside the point that is meant, and
    what hangs from a circle is 90 degrees off."""


RULE = PulleyRule()


@dataclass(frozen=True, slots=True)
class Run:
    """A wire over a pulley: parts, the two wires as drawn, from its start to its end; over: the pulley;
    ends: the loads' labels; places: where on them it is fixed, m; rest: its length, m."""

    parts: tuple[Component, Component]
    over: Pulley
    ends: tuple[str | None, str | None]
    places: tuple[Vector, Vector]
    rest: float


@dataclass(frozen=True, slots=True)
class _Touching:
    """A wire that touches a circle. load: what its other end holds, and where, m; sense: of the way round
    from the load on, 1 anticlockwise, −1 clockwise."""

    part: Component
    load: str | None
    place: Vector
    sense: float


def runs_over(sketch: Sketch) -> tuple[Run, ...]:
    """All wires over pulleys on a page."""
    found: list[Run] = []
    for wheel in sketch.components:
        if not wheel.fixed or not isinstance(wheel.shape, Circle):
            continue
        touching = [one for one in (_touching(part, wheel) for part in sketch.components) if one is not None]
        if len(touching) != 2 or touching[0].sense == touching[1].sense:
            continue
        first, second = touching
        if first.load == second.load is not None or second.load == wheel.label:
            continue
        rest = _length(first, second, wheel.shape)
        if rest is not None:
            found.append(
                Run(
                    (first.part, second.part),
                    Pulley(wheel.label, clockwise=first.sense < 0),
                    (first.load, second.load),
                    (first.place, second.place),
                    rest,
                )
            )
    return tuple(found)


def _touching(part: Component, wheel: Component) -> _Touching | None:
    if not isinstance(part.shape, Wire) or part.ends.count(wheel.label) != 1:
        return None
    assert isinstance(wheel.shape, Circle)
    at = part.ends.index(wheel.label)
    ends = to_metres(part.shape.start), to_metres(part.shape.end)
    (x, y), (far_x, far_y), (cx, cy) = ends[at], ends[1 - at], to_metres(wheel.shape.centre)
    arm, way = (x - cx, y - cy), (x - far_x, y - far_y)
    turning = (arm[0] * way[1] - arm[1] * way[0]) / ((hypot(*arm) * hypot(*way)) or 1.0)
    if abs(turning) < sin(pi / 2 - RULE.aslant):
        return None
    return _Touching(part, part.ends[1 - at], ends[1 - at], 1.0 if turning > 0 else -1.0)


def _length(first: _Touching, second: _Touching, wheel: Circle) -> float | None:
    """Both straight pieces and the arc between them, m; None for a load that reaches into the wheel."""
    (cx, cy), radius = to_metres(wheel.centre), to_metres((wheel.radius, 0.0))[0]
    straight: list[float] = []
    turned: list[float] = []
    for one in (first, second):
        dx, dy = one.place[0] - cx, one.place[1] - cy
        distance = hypot(dx, dy)
        if distance <= radius:
            return None
        straight.append(sqrt(distance**2 - radius**2))
        # Where the wire meets the wheel, seen from its middle: ahead of the load in the wire's sense.
        turned.append(atan2(dy, dx) + one.sense * acos(radius / distance))
    arc = (first.sense * (turned[1] - turned[0])) % (2 * pi)
    return sum(straight) + radius * arc


def drawn_as(sketch: Sketch, label: str) -> str:
    """The label under which a scene knows a wire: that of the first of the two that run over a pulley."""
    runs: Sequence[Run] = runs_over(sketch)
    return next((run.parts[0].label for run in runs if label == run.parts[1].label), label)
