"""Everything that pushes or pulls a body, constraints apart: weight, springs, the student's forces.

Frame: SI units, y up. `add` sums the forces and their moments about the centres of mass; `powers`
tells the rate at which each of them works, for the energy ledger. What a formula has no value for
is NaN, which the step that asked will notice.
"""

from __future__ import annotations

from math import hypot

from physics.engine.robust.rows import turned, wrapped
from physics.engine.world import SPRING, WIRE, World
from physics.formula.kernel import evaluate
from physics.jit import kernel
from sketch.ink import FloatArray


@kernel
def value(world: World, program: int, t: float, pos: FloatArray, vel: FloatArray) -> float:
    """A program's value; NaN where it has none."""
    start, stop = world.spans[program, 0], world.spans[program, 1]
    return evaluate(world.ops, world.args, world.who, start, stop, t, pos, vel, world.stack)


@kernel
def put(force: FloatArray, i: int, fx: float, fy: float, rx: float, ry: float) -> None:
    """Adds a force on body i that acts at (rx, ry) from its centre of mass."""
    force[i, 0] += fx
    force[i, 1] += fy
    force[i, 2] += rx * fy - ry * fx


@kernel
def follow(world: World, t: float, pos: FloatArray, vel: FloatArray) -> None:
    """Puts bodies under a student's equation where it says they are, and gives them its velocity."""
    for k in range(len(world.courses)):
        course = world.courses[k]
        if course.on:
            if course.position >= 0:
                pos[course.body, course.axis] = value(world, course.position, t, pos, vel)
            vel[course.body, course.axis] = value(world, course.velocity, t, pos, vel)


@kernel
def ends_of(
    world: World, k: int, pos: FloatArray
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """Of link k: levers of its two ends (world frame), unit vectors along which each end is pulled, length."""
    link = world.links[k]
    i, j = link.i, link.j
    ax, ay = turned(pos[i, 2], link.ax, link.ay)
    bx, by = turned(pos[j, 2], link.bx, link.by)
    if link.over >= 0:
        wheel = link.over
        radius, cx, cy = world.radius[wheel], pos[wheel, 0], pos[wheel, 1]
        first, ux, uy, touch, _ = wrapped(pos[i, 0] + ax, pos[i, 1] + ay, cx, cy, radius, link.sense)
        second, wx, wy, leave, _ = wrapped(pos[j, 0] + bx, pos[j, 1] + by, cx, cy, radius, -link.sense)
        arc = link.sense * (leave - touch)
        arc -= 6.283185307179586 * (arc // 6.283185307179586)
        if arc < 5.497787143782138:
            return ax, ay, bx, by, -ux, -uy, -wx, -wy, first + second + radius * arc
    dx, dy = pos[j, 0] + bx - pos[i, 0] - ax, pos[j, 1] + by - pos[i, 1] - ay
    length = hypot(dx, dy)
    ux, uy = 0.0, 0.0
    if length > 0.0:
        ux, uy = dx / length, dy / length
    return ax, ay, bx, by, ux, uy, -ux, -uy, length


@kernel
def pull_of(world: World, k: int, t: float, pos: FloatArray, vel: FloatArray) -> tuple[float, float]:
    """(the force with which link k pulls its ends together, how fast it lengthens); a wire's is the student's."""
    link = world.links[k]
    ax, ay, bx, by, ux, uy, wx, wy, length = ends_of(world, k, pos)
    i, j = link.i, link.j
    growth = -ux * (vel[i, 0] - vel[i, 2] * ay) - uy * (vel[i, 1] + vel[i, 2] * ax)
    growth -= wx * (vel[j, 0] - vel[j, 2] * by) + wy * (vel[j, 1] + vel[j, 2] * bx)
    if link.kind == SPRING:
        return link.stiffness * (length - link.rest) + link.damping * growth, growth
    return value(world, link.tension, t, pos, vel), growth


@kernel
def pulls(world: World, k: int) -> bool:
    """Whether link k pulls by a law of its own: a spring, or a wire whose tension the student gives."""
    link = world.links[k]
    return link.broken == 0 and (link.kind == SPRING or (link.kind == WIRE and link.tension >= 0))


@kernel
def add(world: World, t: float, pos: FloatArray, vel: FloatArray, force: FloatArray) -> None:
    """Sums all forces but the constraints' into force, (bodies, 3): N, N, N m."""
    gx, gy = world.gravity[0], world.gravity[1]
    for i in range(len(force)):
        force[i, 0] = world.mass[i, 0] * gx
        force[i, 1] = world.mass[i, 0] * gy
        force[i, 2] = 0.0
    for k in range(len(world.links)):
        if pulls(world, k):
            pull, _ = pull_of(world, k, t, pos, vel)
            ax, ay, bx, by, ux, uy, wx, wy, _ = ends_of(world, k, pos)
            put(force, world.links[k].i, pull * ux, pull * uy, ax, ay)
            put(force, world.links[k].j, pull * wx, pull * wy, bx, by)
    for k in range(len(world.pushes)):
        push = world.pushes[k]
        force[push.body, 0] += value(world, push.x, t, pos, vel)
        force[push.body, 1] += value(world, push.y, t, pos, vel)
    for k in range(len(world.supports)):
        support = world.supports[k]
        if support.over:
            size = value(world, support.force, t, pos, vel)
            nx, ny = normal_of(world, k, pos)
            # On both centres of mass: the student speaks of points.
            force[support.i, 0] += size * nx
            force[support.i, 1] += size * ny
            force[support.j, 0] -= size * nx
            force[support.j, 1] -= size * ny


@kernel
def normal_of(world: World, k: int, pos: FloatArray) -> tuple[float, float]:
    """The direction of a given normal force: out of the edge, or along the line of centres from a disc."""
    support = world.supports[k]
    if support.length > 0.0:
        return turned(pos[support.j, 2], support.nx, support.ny)
    dx, dy = pos[support.i, 0] - pos[support.j, 0], pos[support.i, 1] - pos[support.j, 1]
    distance = hypot(dx, dy)
    return (dx / distance, dy / distance) if distance > 0.0 else (0.0, 1.0)


@kernel
def clearance(world: World, k: int, pos: FloatArray, vel: FloatArray) -> tuple[float, float, float]:
    """Of given normal force k: (gap between its body and the edge, m, negative: sunk in; how fast the gap
    opens, m/s; how far along the edge the centre of mass stands, m)."""
    support = world.supports[k]
    i, j = support.i, support.j
    nx, ny = normal_of(world, k, pos)
    dx, dy = pos[i, 0] - pos[j, 0], pos[i, 1] - pos[j, 1]
    ux, uy = vel[i, 0] - vel[j, 0], vel[i, 1] - vel[j, 1]
    along = 0.0
    gap = hypot(dx, dy) - world.radius[j]
    rate = nx * ux + ny * uy
    if support.length > 0.0:
        ax, ay = turned(pos[j, 2], support.ax, support.ay)
        gap = nx * (dx - ax) + ny * (dy - ay)
        along = -ny * (dx - ax) + nx * (dy - ay)
        rate += vel[j, 2] * (-ny * dx + nx * dy)
    if world.count[i] == 0:
        return gap - world.radius[i], rate, along
    lowest = 1e300
    lever = 0.0
    for q in range(world.first[i], world.first[i] + world.count[i]):
        x, y = turned(pos[i, 2], world.corners[q, 0], world.corners[q, 1])
        if nx * x + ny * y < lowest:
            lowest = nx * x + ny * y
            lever = x * ny - y * nx
    return gap + lowest, rate + vel[i, 2] * lever, along


@kernel
def ledger_size(world: World) -> int:
    """Entries of the ledger: heat, then the work of each push, link, given normal force and course."""
    return 1 + len(world.pushes) + len(world.links) + len(world.supports) + len(world.courses)


@kernel
def powers(
    world: World,
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
    for k in range(len(world.pushes)):
        push = world.pushes[k]
        power[at] = value(world, push.x, t, pos, vel) * vel[push.body, 0]
        power[at] += value(world, push.y, t, pos, vel) * vel[push.body, 1]
        at += 1
    for k in range(len(world.links)):
        power[at] = 0.0
        if pulls(world, k):
            pull, growth = pull_of(world, k, t, pos, vel)
            if world.links[k].kind == SPRING:
                power[0] += world.links[k].damping * growth * growth
            else:
                power[at] = -pull * growth
        at += 1
    for k in range(len(world.supports)):
        support = world.supports[k]
        power[at] = 0.0
        if support.over:
            size = value(world, support.force, t, pos, vel)
            nx, ny = normal_of(world, k, pos)
            power[at] = size * nx * (vel[support.i, 0] - vel[support.j, 0])
            power[at] += size * ny * (vel[support.i, 1] - vel[support.j, 1])
        at += 1
    for k in range(len(world.courses)):
        course = world.courses[k]
        power[at] = 0.0
        if course.on:
            # What the course itself adds to all other forces, so that the body follows it.
            i, a = course.body, course.axis
            power[at] = (world.mass[i, a] * acceleration[i, a] - total[i, a]) * vel[i, a]
        at += 1
