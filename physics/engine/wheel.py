"""A wire round a wheel: the shortest way from end to end that does not cross the wheel's disc.

Which way that is depends on how the wire came to lie: `wound` (rad) is the angle that the wire sweeps about the
wheel's centre from its start to its end, anti-clockwise above zero, whole turns counted. It changes continuously
as the ends move, so it is told from their directions, which give it but for whole turns, and from what it was
shortly before. Of all wires that sweep the same angle the shortest is straight where the line from end to end
passes the disc on the wire's side, and else two tangents and the arc between them (Brouwer: a string's taut
position within its homotopy class). Its length changes smoothly where it comes to touch the wheel, and it may lie on
either side of it and go round as often as it will.

An end within the radius counts as one on the rim: the wire begins at its direction and leaves along the tangent.

Frame: SI units, y up; ends are relative to the wheel's centre.
"""

from __future__ import annotations

from math import acos, atan2, cos, floor, hypot, pi, sin, sqrt

from physics.jit import part

TURN = 2.0 * pi
UNWOUND = 1.75 * pi
"""rad: a wire drawn so that it would go farther round its wheel than this has left it, and is straight."""


@part
def swept(ax: float, ay: float, bx: float, by: float, near: float) -> float:
    """The angle from the direction of a to that of b that is nearest to `near`, rad."""
    angle = atan2(ax * by - ay * bx, ax * bx + ay * by)
    return angle + TURN * floor((near - angle) / TURN + 0.5)


@part
def aside(x: float, y: float, radius: float) -> float:
    """The angle about the centre between the direction of an end and the point where its tangent touches, rad."""
    distance = hypot(x, y)
    return acos(radius / distance) if distance > radius else 0.0


@part
def leaving(x: float, y: float, radius: float, sense: float) -> tuple[float, float, float]:
    """(length of the tangent from (x, y), unit vector along it towards (x, y)). sense: +1 where the wire goes on
    round the wheel anti-clockwise from here."""
    straight = sqrt(max(x * x + y * y - radius * radius, 0.0))
    touch = atan2(y, x) + sense * aside(x, y, radius)
    # The wire leaves along the tangent, against the way round.
    return straight, sense * sin(touch), -sense * cos(touch)


@part
def bent(
    ax: float, ay: float, bx: float, by: float, radius: float, wound: float
) -> tuple[float, float, float, float, float, float, float]:
    """Of a wire from a to b that was wound about so far a moment ago: (its arc on the wheel, m; the length of the
    tangent at a and the unit vector along it towards a; the same at b). An arc of zero: it is straight from a to b,
    and the rest says nothing."""
    angle = swept(ax, ay, bx, by, wound)
    arc = abs(angle) - aside(ax, ay, radius) - aside(bx, by, radius)
    if arc <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    sense = 1.0 if angle > 0.0 else -1.0
    first, ux, uy = leaving(ax, ay, radius, sense)
    second, wx, wy = leaving(bx, by, radius, -sense)
    return radius * arc, first, ux, uy, second, wx, wy


def drawn(start: tuple[float, float], end: tuple[float, float], radius: float, clockwise: bool) -> float:
    """`wound` of a wire that is drawn between two points about a wheel in this sense, rad."""
    (ax, ay), (bx, by) = start, end
    sense = -1.0 if clockwise else 1.0
    spare = sum(acos(min(radius / max(hypot(x, y), 1e-300), 1.0)) for x, y in (start, end))
    arc = sense * atan2(ax * by - ay * bx, ax * bx + ay * by) - spare
    arc -= TURN * floor((arc - UNWOUND) / TURN + 1.0)
    return sense * (arc + spare)
