"""What an event changes for good: rows that let go, slip or stick, wires that break, given normal forces and
courses that end. Impacts are another matter (physics.engine.exact.strike)."""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.exact.tell import Teller
from physics.engine.forces import clearance_at, length_at
from physics.engine.rows import CORD, OFF, ON, SLIDE, STICK
from physics.engine.world import IntArray, Names, Table, World
from sketch.ink import FloatArray


def happen(
    world: World, rows: Table, hit: IntArray, pos: FloatArray, vel: FloatArray, tell: Teller, time: float
) -> None:
    """Marks in rows and world what the watched functions that crossed zero say (physics.engine.exact.watch).
    Of a wire's turns about its pulley nothing is marked: they are reckoned anew when rows are gathered."""
    n, links, supports = 3 * len(rows), len(world.links), len(world.supports)
    for k in np.flatnonzero(hit).tolist():
        if k < n:
            row_event(world, rows[k // 3], k % 3, tell, time)
        elif k < n + links:
            _break_given(world, k - n, pos, tell, time)
        elif k < n + links + 2 * supports:
            _support_event(world, *divmod(k - n - links, 2), pos, vel, tell, time)


def row_event(world: World, row: Any, which: int, tell: Teller, time: float) -> None:
    """which: 0 its force ends, 1 its friction turns or gives way, 2 its wire carries no more."""
    if which == 0 and row["status"] == ON:
        row["status"] = OFF
        if row["kind"] == CORD:
            tell.wire(time, "slack", row)
    elif which == 1 and row["grip"] == STICK:
        row["grip"], row["sigma"] = SLIDE, -np.sign(row["rub"])
    elif which == 1:
        row["grip"] = STICK
    elif which == 2 and row["kind"] == CORD:
        world.links[row["source"]]["broken"] = 1
        tell.broken(time, int(row["source"]), f"it would have to carry {row['force']:.4g} N")


def overloaded(world: World, rows: Table) -> list[Any]:
    """Wires that would have to carry more than they can."""
    if not len(world.links):
        return []
    limits = world.links["limit"]
    return [
        row
        for row in rows[(rows["kind"] == CORD) & (rows["status"] == ON)]
        if row["force"] > limits[row["source"]] * (1 + 1e-12)
    ]


def release(world: World, names: Names, body: int, tell: Teller, time: float) -> None:
    """A body that collides leaves its course (row M8)."""
    for k, course in enumerate(world.courses):
        if course["body"] == body and course["on"]:
            course["on"] = 0
            axis = int(course["axis"])
            world.inverse[body, axis] = 1.0 / world.mass[body, axis]
            tell.released(time, body, names.courses[k])


def _break_given(world: World, k: int, pos: FloatArray, tell: Teller, time: float) -> None:
    link = world.links[k]
    off = float(length_at(world.cells, k, pos)) - float(link["rest"])
    link["broken"] = 1
    change = "longer" if off > 0 else "shorter"
    tell.broken(time, k, f"{abs(off):.3g} m {change} than drawn, under the tension given")


def _support_event(
    world: World, k: int, which: int, pos: FloatArray, vel: FloatArray, tell: Teller, time: float
) -> None:
    """A body under a given normal force leaves its edge, sinks in and is struck back, or rises."""
    support = world.supports[k]
    i, j = int(support["i"]), int(support["j"])
    if which == 0:
        support["over"] = 0
        return
    gap, rate, nx, ny = clearance_at(world.cells, k, pos, vel)
    if gap > 0:
        support["risen"] = 1
        tell.risen(time, k, i, j)
        return
    # Struck back without loss, on the centres of mass: twice what stops it.
    inverse = world.inverse[:, 0]
    give = inverse[i] + inverse[j]
    blow = -2 * rate / give if give and rate < 0 else 0.0
    for body, sign in ((i, 1.0), (j, -1.0)):
        vel[body, 0] += sign * blow * nx * inverse[body]
        vel[body, 1] += sign * blow * ny * inverse[body]
    tell.sunk(time, k, i, j)
