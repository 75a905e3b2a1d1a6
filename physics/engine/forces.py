"""Everything that pushes or pulls a body, constraints apart: weight, springs, the student's forces.

Frame: SI units, y up. `add` sums the forces and their moments about the centres of mass; `powers`
tells the rate at which each of them works, for the energy ledger. What a formula has no value for
is NaN, which the step that asked will notice.
"""

from __future__ import annotations

from math import hypot
from typing import Any

from physics.engine.cells import head
from physics.engine.rows import turned
from physics.engine.tables import (
    WORLD,
    corners,
    counts,
    course_of,
    firsts,
    gravity,
    link_of,
    masses,
    push_of,
    radii,
    support_of,
    value,
)
from physics.engine.wheel import bent, swept
from physics.engine.world import SPRING, WIRE, World
from physics.jit import kernel, part
from sketch.ink import FloatArray


@part
def put(force: FloatArray, i: int, fx: float, fy: float, rx: float, ry: float) -> None:
    """Adds a force on body i that acts at (rx, ry) from its centre of mass."""
    force[i, 0] += fx
    force[i, 1] += fy
    force[i, 2] += rx * fy - ry * fx


@part
def follow(w: Any, t: float, pos: FloatArray, vel: FloatArray) -> None:
    """Puts bodies under a student's equation where it says they are, and gives them its velocity."""
    for k in range(w.courses):
        course = course_of(w, k)
        if course.on:
            if course.position >= 0:
                pos[course.body, course.axis] = value(w, course.position, t, pos, vel)
            vel[course.body, course.axis] = value(w, course.velocity, t, pos, vel)


@part
def ends_of(
    w: Any, k: int, pos: FloatArray
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """Of link k: levers of its two ends (world frame), unit vectors along which each end is pulled, length."""
    link = link_of(w, k)
    i, j = link.i, link.j
    ax, ay = turned(pos[i, 2], link.ax, link.ay)
    bx, by = turned(pos[j, 2], link.bx, link.by)
    if link.over >= 0:
        cx, cy = pos[link.over, 0], pos[link.over, 1]
        arc, first, ux, uy, second, wx, wy = bent(
            pos[i, 0] + ax - cx,
            pos[i, 1] + ay - cy,
            pos[j, 0] + bx - cx,
            pos[j, 1] + by - cy,
            float(radii(w)[link.over]),
            link.wound,
        )
        if arc > 0.0:
            return ax, ay, bx, by, -ux, -uy, -wx, -wy, first + second + arc
    dx, dy = pos[j, 0] + bx - pos[i, 0] - ax, pos[j, 1] + by - pos[i, 1] - ay
    length = hypot(dx, dy)
    ux, uy = 0.0, 0.0
    if length > 0.0:
        ux, uy = dx / length, dy / length
    return ax, ay, bx, by, ux, uy, -ux, -uy, length


@part
def wound_now(w: Any, k: int, pos: FloatArray) -> float:
    """How far wire k is wound about its pulley, rad, if it has turned by less than half a turn since `link.wound`."""
    link = link_of(w, k)
    i, j, wheel = link.i, link.j, link.over
    ax, ay = turned(pos[i, 2], link.ax, link.ay)
    bx, by = turned(pos[j, 2], link.bx, link.by)
    cx, cy = pos[wheel, 0], pos[wheel, 1]
    return swept(
        pos[i, 0] + ax - cx, pos[i, 1] + ay - cy, pos[j, 0] + bx - cx, pos[j, 1] + by - cy, link.wound
    )


@part
def wind(w: Any, pos: FloatArray) -> None:
    """Brings what links tell of their turns about pulleys up to these poses."""
    for k in range(w.links):
        if link_of(w, k).over >= 0:
            link_of(w, k).wound = wound_now(w, k, pos)


@part
def pull_of(w: Any, k: int, t: float, pos: FloatArray, vel: FloatArray) -> tuple[float, float]:
    """(the force with which link k pulls its ends together, how fast it lengthens); a wire's is the student's."""
    link = link_of(w, k)
    ax, ay, bx, by, ux, uy, wx, wy, length = ends_of(w, k, pos)
    i, j = link.i, link.j
    growth = -ux * (vel[i, 0] - vel[i, 2] * ay) - uy * (vel[i, 1] + vel[i, 2] * ax)
    growth -= wx * (vel[j, 0] - vel[j, 2] * by) + wy * (vel[j, 1] + vel[j, 2] * bx)
    if link.kind == SPRING:
        return link.stiffness * (length - link.rest) + link.damping * growth, growth
    return value(w, link.tension, t, pos, vel), growth


@part
def pulls(w: Any, k: int) -> bool:
    """Whether link k pulls by a law of its own: a spring, or a wire whose tension the student gives."""
    link = link_of(w, k)
    return link.broken == 0 and (link.kind == SPRING or (link.kind == WIRE and link.tension >= 0))


@part
def add(w: Any, t: float, pos: FloatArray, vel: FloatArray, force: FloatArray) -> None:
    """Sums all forces but the constraints' into force, (bodies, 3): N, N, N m."""
    gx, gy = gravity(w)[0], gravity(w)[1]
    mass = masses(w)
    for i in range(len(force)):
        force[i, 0] = mass[i, 0] * gx
        force[i, 1] = mass[i, 0] * gy
        force[i, 2] = 0.0
    for k in range(w.links):
        if pulls(w, k):
            pull, _ = pull_of(w, k, t, pos, vel)
            ax, ay, bx, by, ux, uy, wx, wy, _ = ends_of(w, k, pos)
            put(force, link_of(w, k).i, pull * ux, pull * uy, ax, ay)
            put(force, link_of(w, k).j, pull * wx, pull * wy, bx, by)
    for k in range(w.pushes):
        push = push_of(w, k)
        force[push.body, 0] += value(w, push.x, t, pos, vel)
        force[push.body, 1] += value(w, push.y, t, pos, vel)
    for k in range(w.supports):
        support = support_of(w, k)
        if support.over:
            size = value(w, support.force, t, pos, vel)
            nx, ny = normal_of(w, k, pos)
            # On both centres of mass: the student speaks of points.
            force[support.i, 0] += size * nx
            force[support.i, 1] += size * ny
            force[support.j, 0] -= size * nx
            force[support.j, 1] -= size * ny


@part
def normal_of(w: Any, k: int, pos: FloatArray) -> tuple[float, float]:
    """The direction of a given normal force: out of the edge, or along the line of centres from a disc."""
    support = support_of(w, k)
    if support.length > 0.0:
        return turned(pos[support.j, 2], support.nx, support.ny)
    dx, dy = pos[support.i, 0] - pos[support.j, 0], pos[support.i, 1] - pos[support.j, 1]
    distance = hypot(dx, dy)
    return (dx / distance, dy / distance) if distance > 0.0 else (0.0, 1.0)


@part
def clearance(w: Any, k: int, pos: FloatArray, vel: FloatArray) -> tuple[float, float, float]:
    """Of given normal force k: (gap between its body and the edge, m, negative: sunk in; how fast the gap
    opens, m/s; how far along the edge the centre of mass stands, m)."""
    support = support_of(w, k)
    i, j = support.i, support.j
    nx, ny = normal_of(w, k, pos)
    dx, dy = pos[i, 0] - pos[j, 0], pos[i, 1] - pos[j, 1]
    ux, uy = vel[i, 0] - vel[j, 0], vel[i, 1] - vel[j, 1]
    along = 0.0
    gap = hypot(dx, dy) - float(radii(w)[j])
    rate = nx * ux + ny * uy
    if support.length > 0.0:
        ax, ay = turned(pos[j, 2], support.ax, support.ay)
        gap = nx * (dx - ax) + ny * (dy - ay)
        along = -ny * (dx - ax) + nx * (dy - ay)
        rate += vel[j, 2] * (-ny * dx + nx * dy)
    if counts(w)[i] == 0:
        return gap - float(radii(w)[i]), rate, along
    lowest = 1e300
    lever = 0.0
    for q in range(firsts(w)[i], firsts(w)[i] + counts(w)[i]):
        x, y = turned(pos[i, 2], corners(w)[q, 0], corners(w)[q, 1])
        if nx * x + ny * y < lowest:
            lowest = nx * x + ny * y
            lever = x * ny - y * nx
    return gap + lowest, rate + vel[i, 2] * lever, along


def ledger_size(world: World) -> int:
    """Entries of the ledger: heat, then the work of each push, link, given normal force and course."""
    return 1 + len(world.pushes) + len(world.links) + len(world.supports) + len(world.courses)


@part
def powers(
    w: Any,
    t: float,
    pos: FloatArray,
    vel: FloatArray,
    acceleration: FloatArray,
    total: FloatArray,
    rubbed: float,
    power: FloatArray,
) -> None:
    """Rates of the ledger's entries, W. total: all forces on each body, constraints' too, (bodies, 3);
    rubbed: heat of friction, W."""
    power[0] = rubbed
    at = 1
    for k in range(w.pushes):
        push = push_of(w, k)
        power[at] = value(w, push.x, t, pos, vel) * vel[push.body, 0]
        power[at] += value(w, push.y, t, pos, vel) * vel[push.body, 1]
        at += 1
    for k in range(w.links):
        power[at] = 0.0
        if pulls(w, k):
            pull, growth = pull_of(w, k, t, pos, vel)
            if link_of(w, k).kind == SPRING:
                power[0] += link_of(w, k).damping * growth * growth
            else:
                power[at] = -pull * growth
        at += 1
    for k in range(w.supports):
        support = support_of(w, k)
        power[at] = 0.0
        if support.over:
            size = value(w, support.force, t, pos, vel)
            nx, ny = normal_of(w, k, pos)
            power[at] = size * nx * (vel[support.i, 0] - vel[support.j, 0])
            power[at] += size * ny * (vel[support.i, 1] - vel[support.j, 1])
        at += 1
    for k in range(w.courses):
        course = course_of(w, k)
        power[at] = 0.0
        if course.on:
            # What the course itself adds to all other forces, so that the body follows it.
            i, a = course.body, course.axis
            power[at] = (masses(w)[i, a] * acceleration[i, a] - total[i, a]) * vel[i, a]
        at += 1


@kernel
def value_at(cells: FloatArray, program: int, t: float, pos: FloatArray, vel: FloatArray) -> float:
    """`value`, from Python."""
    return value(head(cells, WORLD), program, t, pos, vel)


@kernel
def length_at(cells: FloatArray, link: int, pos: FloatArray) -> float:
    """The length of a link, m, from Python."""
    return ends_of(head(cells, WORLD), link, pos)[8]


@kernel
def clearance_at(
    cells: FloatArray, support: int, pos: FloatArray, vel: FloatArray
) -> tuple[float, float, float, float]:
    """Of a given normal force, from Python: gap, m; its rate, m/s; the normal."""
    w = head(cells, WORLD)
    gap, rate, _ = clearance(w, support, pos, vel)
    nx, ny = normal_of(w, support, pos)
    return gap, rate, nx, ny
