"""Everything that pushes or pulls a body, contacts and taut wires apart.

Evaluated in the middle of a step. Each force is stated by name, so that it can be shown, and
marked as the student's where its work is the student's.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, isnan

from physics.engine.rows import Row, Turns
from physics.engine.world import Cord, Prop, Spring, World
from physics.formula.program import Program
from physics.scene import Vector


class FormulaStopped(ArithmeticError):
    """A student's formula had no value. Caught by the run, which stops there and says so."""

    def __init__(self, name: str, body: str, program: Program) -> None:
        super().__init__(
            f"{name} of {body} = {program.text} has no value (0/0, overflow, or a root or logarithm of what has none)"
        )
        self.body = body


@dataclass(frozen=True, slots=True)
class Act:
    """One force (x, y), N, on body i at point (px, py), m, in the world."""

    name: str
    i: int
    x: float
    y: float
    px: float
    py: float
    student: bool


def acting(
    world: World, pos: list[float], turns: Turns, vel: list[float], time: float
) -> tuple[list[Act], list[Row]]:
    """All forces but the constraints', and the rows along which given normal forces may rub.

    Raises FormulaStopped when a formula has no value.
    """
    acts: list[Act] = []
    gx, gy = world.gravity
    if gx or gy:
        for i, mass in enumerate(world.mass):
            if world.inverse[3 * i]:
                acts.append(Act("weight", i, mass * gx, mass * gy, pos[3 * i], pos[3 * i + 1], False))
    for spring in world.springs:
        acts += _spring(spring, pos, turns, vel)
    for push in world.pushes:
        x, y = (_value(world, push.name, push.i, program, pos, vel, time) for program in (push.x, push.y))
        acts.append(Act(push.name, push.i, x, y, pos[3 * push.i], pos[3 * push.i + 1], True))
    for cord in world.cords:
        if cord.tension is not None and not cord.broken:
            size = _value(world, f"T of {cord.label}", cord.reader, cord.tension, pos, vel, time)
            acts += _pull(f"T of {cord.label}", cord, size, pos, turns)
    rubbing: list[Row] = []
    for prop in world.props:
        if prop.over:
            size = _value(world, prop.name, prop.i, prop.force, pos, vel, time)
            acts += _support(world, prop, size, pos, turns)
            if prop.row.mu > 0 and abs(clearance(prop, turns)) < prop.skin:
                prop.row.pn = max(size, 0.0)
                rubbing.append(prop.row)
    return acts, rubbing


def state_of(world: World, body: int, pos: list[float], vel: list[float], time: float) -> tuple[float, ...]:
    """Values of `STATE` for one body."""
    if body >= len(world.labels):
        return (time, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    at = 3 * body
    vx, vy = vel[at], vel[at + 1]
    return (time, pos[at], pos[at + 1], pos[at + 2], vx, vy, hypot(vx, vy), vel[at + 2])


def clearance(prop: Prop, turns: Turns) -> float:
    """Gap between a propped body and its edge, m, for the row as last refreshed; negative: sunk in."""
    if not prop.solid.corners:
        return prop.row.gap
    cosine, sine = turns[prop.i]
    nx, ny = prop.row.nx, prop.row.ny
    lowest = min(nx * (cosine * x - sine * y) + ny * (sine * x + cosine * y) for x, y in prop.solid.corners)
    return prop.row.gap + lowest


def elongation(spring: Spring, pos: list[float], turns: Turns) -> float:
    """How much longer than at rest a spring is, m."""
    (ax, ay), (bx, by) = place(spring.i, spring.end_i, pos, turns), place(spring.j, spring.end_j, pos, turns)
    return hypot(bx - ax, by - ay) - spring.rest


def place(body: int, point: Vector, pos: list[float], turns: Turns) -> Vector:
    """A point of a body's frame in the world, m."""
    cosine, sine = turns[body]
    x, y = point
    return pos[3 * body] + cosine * x - sine * y, pos[3 * body + 1] + sine * x + cosine * y


def _value(
    world: World, name: str, body: int, program: Program, pos: list[float], vel: list[float], time: float
) -> float:
    value = program.value(state_of(world, body, pos, vel, time))
    if isnan(value):
        raise FormulaStopped(name, world.labels[body] if body < len(world.labels) else "the page", program)
    return value


def _spring(spring: Spring, pos: list[float], turns: Turns, vel: list[float]) -> tuple[Act, Act]:
    i, j = spring.i, spring.j
    (ax, ay), (bx, by) = place(i, spring.end_i, pos, turns), place(j, spring.end_j, pos, turns)
    dx, dy = bx - ax, by - ay
    length = hypot(dx, dy)
    ux, uy = (dx / length, dy / length) if length > 0 else (0.0, 0.0)
    pull = spring.stiffness * (length - spring.rest)
    if spring.damping:
        i3, j3 = 3 * i, 3 * j
        vx = vel[j3] - vel[j3 + 2] * (by - pos[j3 + 1]) - vel[i3] + vel[i3 + 2] * (ay - pos[i3 + 1])
        vy = vel[j3 + 1] + vel[j3 + 2] * (bx - pos[j3]) - vel[i3 + 1] - vel[i3 + 2] * (ax - pos[i3])
        pull += spring.damping * (ux * vx + uy * vy)
    name = f"spring {spring.label}"
    return (
        Act(name, i, pull * ux, pull * uy, ax, ay, False),
        Act(name, j, -pull * ux, -pull * uy, bx, by, False),
    )


def _pull(name: str, cord: Cord, size: float, pos: list[float], turns: Turns) -> tuple[Act, Act]:
    row = cord.row
    (ax, ay), (bx, by) = place(row.i, row.end_i, pos, turns), place(row.j, row.end_j, pos, turns)
    length = hypot(bx - ax, by - ay)
    ux, uy = ((bx - ax) / length, (by - ay) / length) if length > 0 else (0.0, 0.0)
    return (
        Act(name, row.i, size * ux, size * uy, ax, ay, True),
        Act(name, row.j, -size * ux, -size * uy, bx, by, True),
    )


def _support(world: World, prop: Prop, size: float, pos: list[float], turns: Turns) -> list[Act]:
    row = prop.row
    row.refresh(pos, turns, world.inverse)
    if prop.length is not None:
        (x, y), (nx, ny) = row.end_i, row.normal
        cosine, sine = turns[row.i]
        dx, dy = pos[row.j3] - pos[row.i3], pos[row.j3 + 1] - pos[row.i3 + 1]
        along = -ny * (cosine * dx + sine * dy - x) + nx * (cosine * dy - sine * dx - y)
        if not 0.0 <= along <= prop.length:
            prop.over = False
            return []
    x, y = row.nx * size, row.ny * size
    at = (pos[row.j3], pos[row.j3 + 1])
    return [Act(prop.name, prop.i, x, y, *at, True), Act(prop.name, prop.j, -x, -y, *at, True)]
