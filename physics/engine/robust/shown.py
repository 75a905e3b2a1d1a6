"""The forces of robust mode's contacts, wires and pins by name, from what was recorded of them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.acts import Act, link_ends
from physics.engine.cells import head
from physics.engine.forces import ends_of
from physics.engine.robust.crowd import Record
from physics.engine.rows import CORD, PIN_X, PIN_Y
from physics.engine.tables import WORLD, link_of
from physics.engine.world import Names, Table, World
from physics.jit import kernel
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]


def joint_acts(
    world: World, names: Names, rows: Table, pulls: FloatArray, pos: FloatArray, wound: FloatArray
) -> list[Act]:
    """Tensions, forces of pins, and friction under given normal forces.

    pulls: (T, rows) N, along each row; pos: (T, bodies + 1, 3); wound: (T, links) of wires over pulleys, rad.
    """
    acts: list[Act] = []
    if not len(rows):
        return acts
    ends = link_ends(world, pos)
    ways = np.zeros((len(pos), len(world.links), 4))
    _ways(world.cells, pos, wound, ways)
    for k in range(len(rows)):
        row: Any = rows[k]
        number, size = int(row["source"]), pulls[:, k, None]
        if row["kind"] == CORD:
            for body, end in ((int(row["i"]), 0), (int(row["j"]), 1)):
                if body < len(names.bodies):
                    way = ways[:, number, 2 * end : 2 * end + 2]
                    acts.append(Act(f"T of {names.links[number]}", body, size * way, ends[:, number, end]))
        elif row["kind"] == PIN_X:
            force = np.concatenate([size, pulls[:, k + 1, None]], axis=1)
            for body, end, sign in ((int(row["i"]), 0, -1.0), (int(row["j"]), 1, 1.0)):
                if body < len(names.bodies):
                    acts.append(Act(f"pin {names.links[number]}", body, sign * force, ends[:, number, end]))
        elif row["kind"] != PIN_Y and row["mu"] > 0:
            acts += _rubbing(world, names, row, size, pos)
    return acts


def _rubbing(world: World, names: Names, row: Any, size: FloatArray, pos: FloatArray) -> list[Act]:
    on, body = int(row["i"]), int(row["j"])
    support: Any = world.supports[int(row["source"])]
    if support["length"] > 0:
        c, s = np.cos(pos[:, on, 2]), np.sin(pos[:, on, 2])
        normal = np.stack([c * support["nx"] - s * support["ny"], s * support["nx"] + c * support["ny"]], 1)
    else:
        way = pos[:, body, :2] - pos[:, on, :2]
        normal = way / np.maximum(np.hypot(*way.T), 1e-300)[:, None]
    force = size * np.stack([-normal[:, 1], normal[:, 0]], 1)
    at = pos[:, body, :2] - row["rj"] * normal
    return [
        Act(f"friction of {names.bodies[on]}", body, force, at),
        Act(f"friction of {names.bodies[body]}", on, -force, at),
    ]


def contact_acts(world: World, names: Names, record: Record, at: IntArray, pos: FloatArray) -> list[Act]:
    """Normal forces and friction of all pairs that touch at any of these records, both ways.

    at: (T,) records; pos: (T, bodies + 1, 3). Where there is no force it is shown at the centre of mass.
    They are taken to be unique if there are no more of them than equations of motion.
    """
    stop = record.ends[at]
    start = np.where(at > 0, record.ends[np.maximum(at - 1, 0)], 0)
    many = stop - start
    frames = np.repeat(np.arange(len(at)), many)
    chosen = np.repeat(start - np.cumsum(many) + many, many) + np.arange(int(many.sum()))
    pairs, forces = record.pairs[chosen], record.forces[chosen]
    if not len(pairs):
        return []
    unique = _settled(world, names, pairs, frames)
    acts: list[Act] = []
    order = np.argsort(pairs, kind="stable")
    numbers, begins = np.unique(pairs[order], return_index=True)
    for number, mine in zip(numbers, np.split(order, begins[1:]), strict=True):
        pair: Any = world.pairs[int(number)]
        for body, other, sign in (
            (int(pair["j"]), int(pair["i"]), 1.0),
            (int(pair["i"]), int(pair["j"]), -1.0),
        ):
            points = pos[:, body, :2].copy()
            points[frames[mine]] = forces[mine, 4:6]
            for name, part in (
                (f"contact with {names.bodies[other]}", 0),
                (f"friction of {names.bodies[other]}", 2),
            ):
                if part == 2 and pair["mu"] == 0:
                    continue
                values = np.zeros((len(at), 2))
                values[frames[mine]] = sign * forces[mine, part : part + 2]
                acts.append(Act(name, body, values, points, unique))
    return acts


def _settled(world: World, names: Names, pairs: NDArray[np.int32], frames: IntArray) -> bool:
    """Whether unknown forces are never more than equations: three for each body, against one for a disc's
    contact, two for that of two blocks, and one for friction."""
    table = world.pairs
    blocks = (world.sides[table["i"]] > 0) & (world.sides[table["j"]] > 0)
    unknown = 1 + blocks.astype(np.int64) + (table["mu"] > 0)
    return bool(np.bincount(frames, unknown[pairs]).max() <= 3 * names.movable)


@kernel
def _ways(cells: FloatArray, pos: FloatArray, wound: FloatArray, ways: FloatArray) -> None:
    """Unit vectors along which a link pulls its ends."""
    w = head(cells, WORLD)
    for frame in range(len(pos)):
        for k in range(w.links):
            link_of(w, k).wound = wound[frame, k]
            _, _, _, _, ux, uy, wx, wy, _ = ends_of(w, k, pos[frame])
            ways[frame, k, 0], ways[frame, k, 1] = ux, uy
            ways[frame, k, 2], ways[frame, k, 3] = wx, wy
