"""Bodies that were drawn overlapping, moved apart before anything moves.

Frame: SI units, y up.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.exact.standing import TooMuch, touching_rows
from physics.engine.exact.strike import overlap
from physics.engine.exact.tell import Teller
from physics.engine.exact.touch import TOUCHING, gaps_between
from physics.engine.world import World
from sketch.ink import FloatArray

SWEEPS = 400
"""Over all that overlap; two bodies are apart after one."""

Couple = tuple[int, int]


def separate(world: World, pos: FloatArray, vel: FloatArray, tell: Teller, time: float) -> None:
    """Moves bodies apart that overlap, changing pos, and tells so. Raises TooMuch where that does not end."""
    if not len(world.pairs):
        return
    drawn = pos.copy()
    met, apart = _pushed_apart(world, pos, vel)
    if not apart and _taken_out(world, drawn, met):
        # A body was pushed to and fro between two that are fixed.
        pos[:] = drawn
        more, apart = _pushed_apart(world, pos, vel)
        met |= more
    if not apart and met:
        raise TooMuch
    for i, j in sorted(met):
        tell.separated(time, i, j)


def _pushed_apart(world: World, pos: FloatArray, vel: FloatArray) -> tuple[set[Couple], bool]:
    """(couples that overlapped on the way, whether none does any more)."""
    met: set[Couple] = set()
    for _ in range(SWEEPS):
        rows = touching_rows(world, pos, vel)
        if not len(rows):
            return met, True
        overlapping = rows[rows["gap"] < -TOUCHING]
        met |= {(int(min(row["i"], row["j"])), int(max(row["i"], row["j"]))) for row in overlapping}
        if overlap(world.cells, rows, pos) <= 0.5 * TOUCHING:
            return met, True
    return met, False


def _taken_out(world: World, pos: FloatArray, met: set[Couple]) -> bool:
    """Moves each body whose centre is within one that is fixed, and that another fixed one keeps there, out of all
    such, by the least that takes it past a face of one of them, not downwards where it can be helped. Changes pos;
    tells whether there was any. What is merely too large for a gap stays jammed in it."""
    fixed: NDArray[np.bool_] = (world.inverse == 0.0).all(axis=1)
    solid = {int(k) for pair in world.pairs for k in (pair["i"], pair["j"]) if fixed[k]}
    down, moved = world.gravity, False
    for body in sorted({k for couple in met for k in couple if not fixed[k]}):
        against = [one if other == body else other for one, other in sorted(met) if body in (one, other)]
        against = [other for other in against if fixed[other]]
        if len(against) < 2 or not any(_holds(world, pos, other, pos[body, :2]) for other in against):
            continue
        ways = _ways_out(world, pos, body, against)
        for shift in sorted(ways, key=lambda way: (bool(way @ down > 0.0), float(np.hypot(*way)))):
            there = pos.copy()
            there[body, :2] += shift
            if all(_gap(world, there, body, other) >= -TOUCHING for other in solid):
                pos[:] = there
                moved = True
                break
    return moved


def _ways_out(world: World, pos: FloatArray, body: int, against: list[int]) -> list[FloatArray]:
    """For each face of these blocks the shift, m, that brings a body to it from within."""
    ways: list[FloatArray] = []
    for other in against:
        corners, normals = _outline(world, pos, other)
        for at, normal in zip(corners, normals, strict=True):
            deep = float(normal @ at) - _nearest(world, pos, body, normal)
            if deep > 0.0:
                ways.append(deep * normal)
    return ways


def _outline(world: World, pos: FloatArray, body: int) -> tuple[FloatArray, FloatArray]:
    """Corners, m, and outward normals of a block in the world, (n, 2); of a disc none."""
    mine = slice(int(world.first[body]), int(world.first[body] + world.sides[body]))
    c, s = np.cos(pos[body, 2]), np.sin(pos[body, 2])
    turn = np.array([[c, s], [-s, c]])
    return world.corners[mine] @ turn + pos[body, :2], world.normals[mine] @ turn


def _holds(world: World, pos: FloatArray, body: int, point: FloatArray) -> bool:
    """Whether a point is within a block."""
    corners, normals = _outline(world, pos, body)
    return bool(len(corners)) and float(np.einsum("kc,kc->k", normals, point - corners).max()) < 0.0


def _nearest(world: World, pos: FloatArray, body: int, normal: FloatArray) -> float:
    """How far along a direction the part of a body lies that is the least far, m."""
    corners, _ = _outline(world, pos, body)
    if len(corners):
        return float((corners @ normal).min())
    return float(normal @ pos[body, :2] - world.radius[body])


def _gap(world: World, pos: FloatArray, i: int, j: int) -> float:
    found: Any = np.zeros(1)
    gaps_between(world.cells, pos[None], i, j, found)
    return float(found[0])
