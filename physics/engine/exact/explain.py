"""What a recorded run was at any time: states by dense output, and forces by the rows that held then."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from physics.engine.acts import Act, applied
from physics.engine.cells import head
from physics.engine.exact.integrate import unpack
from physics.engine.exact.machine import MACHINE, accelerations, forces_of, poses, row_of, velocities
from physics.engine.exact.solve import accelerate
from physics.engine.forces import follow
from physics.engine.rows import CORD, FREE, GIVEN, ON, turned
from physics.engine.tables import WORLD
from physics.engine.world import Names, Table, World
from physics.jit import kernel
from sketch.ink import FloatArray

if TYPE_CHECKING:
    from physics.engine.exact.run import Mode


def follow_frames(modes: Sequence[Mode], times: FloatArray, pos: FloatArray, vel: FloatArray) -> None:
    """Puts bodies under a student's equation exactly where it says they are, in every frame."""
    starts = np.array([mode.start for mode in modes])
    which = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, None)
    for m in np.unique(which):
        here = slice(int(np.searchsorted(which, m)), int(np.searchsorted(which, m, side="right")))
        _follow(modes[m].world.cells, times[here], pos[here], vel[here])


@kernel
def _follow(cells: FloatArray, times: FloatArray, pos: FloatArray, vel: FloatArray) -> None:
    w = head(cells, WORLD)
    for k in range(len(times)):
        follow(w, times[k], pos[k], vel[k])


def explain(
    modes: Sequence[Mode], names: Names, times: FloatArray, states: FloatArray
) -> tuple[list[Act], FloatArray]:
    """All forces, and accelerations (T, bodies + 1, 3), at ascending times with their states."""
    bodies = len(names.bodies) + 1
    acc = np.zeros((len(times), bodies, 3))
    acts: dict[tuple[str, int], Act] = {}
    starts = np.array([mode.start for mode in modes])
    which = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, None)
    for m in np.unique(which):
        here = slice(int(np.searchsorted(which, m)), int(np.searchsorted(which, m, side="right")))
        mode = modes[m]
        n = here.stop - here.start
        pos, vel = np.zeros((n, bodies, 3)), np.zeros((n, bodies, 3))
        pos[:] = mode.machine.pos
        pulls = np.zeros((n, len(mode.machine.rows), 10))
        totals = np.zeros((n, bodies, 3))
        _explain(
            mode.world.cells,
            mode.machine.cells.copy(),
            times[here],
            states[here],
            pos,
            vel,
            acc[here],
            pulls,
            totals,
        )
        found = [
            *applied(mode.world, names, times[here], pos, vel, np.tile(mode.world.links["wound"], (n, 1))),
            *_constraints(mode.machine.rows, names, pulls),
            *_courses(mode.world, names, pos, acc[here], totals),
        ]
        for act in found:
            key = (act.name, act.body)
            if key not in acts:
                points = np.full((len(times), 2), np.nan)
                acts[key] = Act(act.name, act.body, np.zeros((len(times), 2)), points, True)
            whole = acts[key]
            whole.values[here] += act.values
            whole.points[here] = act.points
            if not act.unique:
                acts[key] = Act(act.name, act.body, whole.values, whole.points, False)
    return list(acts.values()), acc


@kernel
def _explain(
    cells: FloatArray,
    memory: FloatArray,
    times: FloatArray,
    states: FloatArray,
    pos: FloatArray,
    vel: FloatArray,
    acc: FloatArray,
    pulls: FloatArray,
    totals: FloatArray,
) -> None:
    """pulls (T, rows, 10): on j the normal force x, y, the rubbing x, y, and where; on i the normal force, and
    where."""
    w, m = head(cells, WORLD), head(memory, MACHINE)
    place, speed = poses(m), velocities(m)
    for k in range(len(times)):
        unpack(states[k], m.movable, place, speed)
        accelerate(w, m, times[k])
        for r in range(m.rows):
            row = row_of(m, r)
            if row.status != ON:
                continue
            for a in range(2):
                pulls[k, r, a], pulls[k, r, 2 + a] = row.J[3 + a] * row.force, row.T[3 + a] * row.rub
                pulls[k, r, 6 + a] = row.J[a] * row.force
            pulls[k, r, 4], pulls[k, r, 5] = row.px, row.py
            pulls[k, r, 8], pulls[k, r, 9] = row.px, row.py
            if row.kind == CORD:
                x, y = turned(place[row.j, 2], row.bx, row.by)
                pulls[k, r, 4], pulls[k, r, 5] = place[row.j, 0] + x, place[row.j, 1] + y
        for i in range(m.bodies):
            for a in range(3):
                pos[k, i, a], vel[k, i, a] = place[i, a], speed[i, a]
                acc[k, i, a], totals[k, i, a] = accelerations(m)[i, a], forces_of(m)[i, a]


def _constraints(rows: Table, names: Names, pulls: FloatArray) -> list[Act]:
    """Forces of wires, pins and contacts: one for each pair and part, at the centre of pressure. Corners of either of
    two blocks on faces of the other are one contact."""
    groups: dict[tuple[str, int, bool], list[tuple[int, bool]]] = {}
    for r, row in enumerate(rows):
        if row["status"] != ON:
            continue
        i, j, kind = int(row["i"]), int(row["j"]), int(row["kind"])
        for body, other, on_j in ((j, i, True), (i, j, False)):
            if body >= len(names.bodies):
                continue
            if CORD <= kind < GIVEN:
                name = f"{'T of' if kind == CORD else 'pin'} {names.links[row['source']]}"
                groups.setdefault((name, body, False), []).append((r, on_j))
                continue
            if kind != GIVEN:
                groups.setdefault((f"contact with {names.bodies[other]}", body, False), []).append((r, on_j))
            if row["grip"] != FREE:
                groups.setdefault((f"friction of {names.bodies[other]}", body, True), []).append((r, on_j))
    return [_summed(name, body, rubs, rows, pulls, of) for (name, body, rubs), of in groups.items()]


def _summed(
    name: str, body: int, rubs: bool, rows: Table, pulls: FloatArray, of: list[tuple[int, bool]]
) -> Act:
    """Several rows as one force, each as it acts on its second body or on its first. pulls: (T, rows, 10)."""
    members = [r for r, _ in of]
    on_j = np.array([second for _, second in of])[None, :, None]
    mine = pulls[:, members]
    if rubs:
        values = np.where(on_j, mine[:, :, 2:4], -mine[:, :, 2:4]).sum(axis=1)
    else:
        values = np.where(on_j, mine[:, :, 0:2], mine[:, :, 6:8]).sum(axis=1)
    sizes = np.hypot(mine[:, :, 0], mine[:, :, 1])
    whole = sizes.sum(axis=1, keepdims=True)
    shares = np.where(whole > 0.0, sizes / np.where(whole > 0.0, whole, 1.0), 1.0 / len(members))
    points = (shares[:, :, None] * np.where(on_j, mine[:, :, 4:6], mine[:, :, 8:10])).sum(axis=1)
    # How two corners of one face share their load is nobody's question, if nothing else carries it.
    return Act(name, body, values, points, all(bool(rows[r]["unique"]) for r in members))


def _courses(
    world: World, names: Names, pos: FloatArray, accelerations: FloatArray, totals: FloatArray
) -> list[Act]:
    """What a course adds to all other forces, so that its body follows it."""
    acts: list[Act] = []
    for name, course in zip(names.courses, world.courses, strict=True):
        if course["on"]:
            body, axis = int(course["body"]), int(course["axis"])
            values = np.zeros((len(pos), 2))
            values[:, axis] = world.mass[body, axis] * accelerations[:, body, axis] - totals[:, body, axis]
            acts.append(Act(name, body, values, pos[:, body, :2].copy(), True))
    return acts
