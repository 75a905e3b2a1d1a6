"""Forces by name at given times, and energies: what both modes tell of the motion that they found.

Weight, springs, and all that the student gives follow from the state alone; kernels evaluate them
frame by frame. Frame: SI units, y up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from physics.engine.cells import head
from physics.engine.forces import ends_of, normal_of, pull_of, pulls
from physics.engine.rows import turned
from physics.engine.tables import WORLD, link_of, push_of, support_of, value
from physics.engine.world import SPRING, WIRE, Names, World
from physics.jit import kernel
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Act:
    """One force on one body through time. body: row in `Names.bodies`; values: (T, 2) N; points: (T, 2) m;
    unique: see `physics.trajectory.ForceSeries`."""

    name: str
    body: int
    values: FloatArray
    points: FloatArray
    unique: bool = True


def applied(
    world: World, names: Names, times: FloatArray, pos: FloatArray, vel: FloatArray, wound: FloatArray
) -> list[Act]:
    """Weight, springs, the student's forces, given normal forces and tensions.

    times: (T,) s; pos, vel: (T, bodies + 1, 3); wound: (T, links) of wires over pulleys, rad. Wires that are broken and supports that are over give zero.
    """
    frames, page = len(times), len(names.bodies)
    links, pushes, supports = len(world.links), len(world.pushes), len(world.supports)
    pulled, points = np.zeros((frames, links, 4)), np.zeros((frames, links, 4))
    pushed, given = np.zeros((frames, pushes, 2)), np.zeros((frames, supports, 2))
    _frames(world.cells, times, pos, vel, wound, pulled, points, pushed, given)
    acts: list[Act] = []
    if np.any(world.gravity):
        for body in range(names.movable):
            weight = np.broadcast_to(world.mass[body, 0] * world.gravity, (frames, 2))
            acts.append(Act("weight", body, weight, pos[:, body, :2]))
    for number in range(links):
        link: Any = world.links[number]
        if link["kind"] != SPRING and not (link["kind"] == WIRE and link["tension"] >= 0):
            continue
        name = f"spring {names.links[number]}" if link["kind"] == SPRING else f"T of {names.links[number]}"
        for body, start in ((int(link["i"]), 0), (int(link["j"]), 2)):
            if body < page:
                part = slice(start, start + 2)
                acts.append(Act(name, body, pulled[:, number, part], points[:, number, part]))
    for number in range(pushes):
        push: Any = world.pushes[number]
        body = int(push["body"])
        acts.append(Act(names.pushes[number], body, pushed[:, number], pos[:, body, :2]))
    for number in range(supports):
        support: Any = world.supports[number]
        # On the centre of mass of the body that is held: the student speaks of points.
        at = pos[:, int(support["i"]), :2]
        acts.append(Act(names.supports[number], int(support["i"]), given[:, number], at))
        acts.append(Act(names.supports[number], int(support["j"]), -given[:, number], at))
    return acts


@kernel
def _frames(
    cells: FloatArray,
    times: FloatArray,
    pos: FloatArray,
    vel: FloatArray,
    wound: FloatArray,
    pulled: FloatArray,
    points: FloatArray,
    pushed: FloatArray,
    given: FloatArray,
) -> None:
    w = head(cells, WORLD)
    for frame in range(len(times)):
        t, x, v = times[frame], pos[frame], vel[frame]
        for k in range(w.links):
            if pulls(w, k):
                link_of(w, k).wound = wound[frame, k]
                pull, _ = pull_of(w, k, t, x, v)
                ax, ay, bx, by, ux, uy, wx, wy, _ = ends_of(w, k, x)
                i, j = link_of(w, k).i, link_of(w, k).j
                pulled[frame, k, 0], pulled[frame, k, 1] = pull * ux, pull * uy
                pulled[frame, k, 2], pulled[frame, k, 3] = pull * wx, pull * wy
                points[frame, k, 0], points[frame, k, 1] = x[i, 0] + ax, x[i, 1] + ay
                points[frame, k, 2], points[frame, k, 3] = x[j, 0] + bx, x[j, 1] + by
        for k in range(w.pushes):
            push = push_of(w, k)
            pushed[frame, k, 0] = value(w, push.x, t, x, v)
            pushed[frame, k, 1] = value(w, push.y, t, x, v)
        for k in range(w.supports):
            support = support_of(w, k)
            if support.over == 1:
                size = value(w, support.force, t, x, v)
                nx, ny = normal_of(w, k, x)
                given[frame, k, 0], given[frame, k, 1] = size * nx, size * ny


def link_ends(world: World, pos: FloatArray) -> FloatArray:
    """Where links end, (T, links, 2, 2) m. pos: (T, bodies + 1, 3)."""
    ends = np.zeros((len(pos), len(world.links), 2, 2))
    if len(world.links):
        _ends(world.cells, pos, ends)
    return ends


@kernel
def _ends(cells: FloatArray, pos: FloatArray, ends: FloatArray) -> None:
    w = head(cells, WORLD)
    for frame in range(len(pos)):
        for k in range(w.links):
            link = link_of(w, k)
            i, j = link.i, link.j
            ax, ay = turned(pos[frame, i, 2], link.ax, link.ay)
            bx, by = turned(pos[frame, j, 2], link.bx, link.by)
            ends[frame, k, 0, 0], ends[frame, k, 0, 1] = pos[frame, i, 0] + ax, pos[frame, i, 1] + ay
            ends[frame, k, 1, 0], ends[frame, k, 1, 1] = pos[frame, j, 0] + bx, pos[frame, j, 1] + by


def energies(
    world: World, names: Names, pos: FloatArray, vel: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """(kinetic, potential, elastic), (T,) J each, of all that can move. pos, vel: (T, bodies + 1, 3)."""
    mass = world.mass[: names.movable]
    kinetic = 0.5 * np.einsum("tbk,bk,tbk->t", vel[:, : names.movable], mass, vel[:, : names.movable])
    potential = -np.einsum("tbk,b,k->t", pos[:, : names.movable, :2], mass[:, 0], world.gravity)
    elastic = np.zeros(len(pos))
    springs = np.flatnonzero(world.links["kind"] == SPRING)
    if len(springs):
        ends = link_ends(world, pos)[:, springs]
        stretch = np.hypot(*np.moveaxis(ends[:, :, 1] - ends[:, :, 0], 2, 0)) - world.links["rest"][springs]
        elastic = 0.5 * stretch**2 @ world.links["stiffness"][springs]
    return kinetic, potential, elastic
