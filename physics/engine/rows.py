"""Constraints as rows: contacts, taut wires, pins, and the rubbing under a given normal force.

A row says how fast a gap between bodies i and j opens: rate = J · (v_i, v_j), with a tangent T that
says how fast they slip; `c` and `ct` are what the velocities alone add to the rates' own rates (J̇v),
so that gap̈ = J · a + c. A wire's gap is its slack. Forces along J open the gap.

Frame: SI units, y up. Sources: Featherstone (2008), Rigid Body Dynamics Algorithms, ch. 3 and 11;
the terms of second order are derived in the comments.
"""

from __future__ import annotations

from math import cos, hypot, sin
from typing import Any

import numpy as np

from physics.engine.wheel import bent
from physics.engine.world import Table
from physics.jit import kernel, part
from sketch.ink import FloatArray

FACE, POINT, CORD, PIN_X, PIN_Y, GIVEN = 0, 1, 2, 3, 4, 5
"""A point or disc of j on a face of i; of j on a point or disc of i; a wire; a pin's two rows; slip under a
given normal force, of the disc or block j on what i gives."""

OFF, ON = 0, 1
FREE, STICK, SLIDE = 0, 1, 2
"""No friction; held by it; slipping in the sense `sigma`."""

_INDICES = ("kind", "i", "j", "source", "feature", "status", "grip", "shut", "unique")
_PLACES = ("ax", "ay", "bx", "by", "nx0", "ny0", "ri", "rj", "length", "e", "mu", "sigma", "wound")
_FOUND = ("c", "ct", "gap", "rate", "slip", "nx", "ny", "px", "py", "along", "force", "rub", "bound", "press")
ROW = np.dtype(
    [(name, np.int64) for name in _INDICES]
    + [(name, np.float64) for name in (*_PLACES, *_FOUND)]
    + [("J", np.float64, (6,)), ("T", np.float64, (6,))]
)
"""source: the pair's, link's or support's number; feature: which corner and face; shut: the contact no longer
bounces; a on i and b on j: points in their frames; n0: the face's normal in i's frame, length: of the
face; (px, py): where it acts; along: the place on the face, m; force: N along J; rub: N along T; bound:
of |rub| under a given normal force; press: the gap's acceleration if the row did not hold, m/s²;
wound: of a wire over the wheel `feature` with radius ri (physics.engine.wheel), within half a turn, rad."""


@part
def turned(angle: float, x: float, y: float) -> tuple[float, float]:
    """A vector of a body's frame in the world."""
    c, s = cos(angle), sin(angle)
    return c * x - s * y, s * x + c * y


@part
def refresh(row: Any, pos: FloatArray, vel: FloatArray) -> None:
    """Brings all that a row says up to these poses and velocities."""
    if row.kind == FACE or row.kind == GIVEN:
        _refresh_face(row, pos, vel)
    elif row.kind == POINT:
        _refresh_point(row, pos, vel)
    elif row.kind == CORD:
        if row.feature >= 0:
            _refresh_over_pulley(row, pos, vel)
        else:
            _refresh_cord(row, pos, vel)
    else:
        _refresh_pin(row, pos, vel)
    i, j = row.i, row.j
    rate = 0.0
    slip = 0.0
    for k in range(3):
        rate += row.J[k] * vel[i, k] + row.J[3 + k] * vel[j, k]
        slip += row.T[k] * vel[i, k] + row.T[3 + k] * vel[j, k]
    row.rate = rate
    row.slip = slip


@part
def _refresh_face(row: Any, pos: FloatArray, vel: FloatArray) -> None:
    # With n fixed to i and d from i's centre to the point of j: gap = n·d − const; n' = ω_i t, t' = −ω_i n.
    i, j = row.i, row.j
    nx, ny = turned(pos[i, 2], row.nx0, row.ny0)
    ax, ay = turned(pos[i, 2], row.ax, row.ay)
    bx, by = turned(pos[j, 2], row.bx, row.by)
    tx, ty = -ny, nx
    dx, dy = pos[j, 0] + bx - pos[i, 0], pos[j, 1] + by - pos[i, 1]
    wi, wj = vel[i, 2], vel[j, 2]
    ux, uy = vel[j, 0] - vel[i, 0], vel[j, 1] - vel[i, 1]
    vx, vy = ux - wj * by, uy + wj * bx
    nd, nb, tb = nx * dx + ny * dy, nx * bx + ny * by, tx * bx + ty * by
    row.gap = nx * (dx - ax) + ny * (dy - ay) - row.rj
    row.along = tx * (dx - ax) + ty * (dy - ay)
    row.nx, row.ny = nx, ny
    row.px, row.py = pos[i, 0] + dx - row.rj * nx, pos[i, 1] + dy - row.rj * ny
    # Levers of n about i and j at the point: r × n; and of t: r × t = n·r.
    row.J[0], row.J[1], row.J[2] = -nx, -ny, -(dx * ny - dy * nx)
    row.J[3], row.J[4], row.J[5] = nx, ny, bx * ny - by * nx
    ni, nj = nd - row.rj, nb - row.rj
    row.T[0], row.T[1], row.T[2] = -tx, -ty, -ni
    row.T[3], row.T[4], row.T[5] = tx, ty, nj
    row.c = -wi * wi * nd + 2.0 * wi * (tx * vx + ty * vy) - wj * wj * nb
    opening = nx * vx + ny * vy + wi * (tx * dx + ty * dy)
    row.ct = -wi * (nx * ux + ny * uy) + wj * (wi - wj) * tb - wi * opening


@part
def _refresh_point(row: Any, pos: FloatArray, vel: FloatArray) -> None:
    i, j = row.i, row.j
    ax, ay = turned(pos[i, 2], row.ax, row.ay)
    bx, by = turned(pos[j, 2], row.bx, row.by)
    dx, dy = pos[j, 0] + bx - pos[i, 0] - ax, pos[j, 1] + by - pos[i, 1] - ay
    distance = hypot(dx, dy)
    if distance > 1e-300:
        nx, ny = dx / distance, dy / distance
    else:
        nx, ny, distance = 0.0, 1.0, 1e-300
    tx, ty = -ny, nx
    wi, wj = vel[i, 2], vel[j, 2]
    ux, uy = vel[j, 0] - vel[i, 0], vel[j, 1] - vel[i, 1]
    vx, vy = ux - wj * by + wi * ay, uy + wj * bx - wi * ax
    across = tx * vx + ty * vy
    turn = across / distance  # of the line between the two points, rad/s
    na, nb = nx * ax + ny * ay, nx * bx + ny * by
    ta, tb = tx * ax + ty * ay, tx * bx + ty * by
    row.gap = distance - row.ri - row.rj
    row.nx, row.ny = nx, ny
    row.px, row.py = pos[j, 0] + bx - row.rj * nx, pos[j, 1] + by - row.rj * ny
    row.J[0], row.J[1], row.J[2] = -nx, -ny, -(ax * ny - ay * nx)
    row.J[3], row.J[4], row.J[5] = nx, ny, bx * ny - by * nx
    row.T[0], row.T[1], row.T[2] = -tx, -ty, -(na + row.ri)
    row.T[3], row.T[4], row.T[5] = tx, ty, nb - row.rj
    row.c = across * turn - wj * wj * nb + wi * wi * na
    row.ct = -turn * (nx * ux + ny * uy) + wj * (turn - wj) * tb - wi * (turn - wi) * ta
    row.along = 0.0


@part
def _refresh_cord(row: Any, pos: FloatArray, vel: FloatArray) -> None:
    i, j = row.i, row.j
    ax, ay = turned(pos[i, 2], row.ax, row.ay)
    bx, by = turned(pos[j, 2], row.bx, row.by)
    dx, dy = pos[j, 0] + bx - pos[i, 0] - ax, pos[j, 1] + by - pos[i, 1] - ay
    distance = hypot(dx, dy)
    if distance > 1e-300:
        nx, ny = dx / distance, dy / distance
    else:
        nx, ny, distance = 0.0, 1.0, 1e-300
    wi, wj = vel[i, 2], vel[j, 2]
    vx = vel[j, 0] - vel[i, 0] - wj * by + wi * ay
    vy = vel[j, 1] - vel[i, 1] + wj * bx - wi * ax
    across = -ny * vx + nx * vy
    row.gap = row.length - distance
    row.nx, row.ny = nx, ny
    row.px, row.py = pos[i, 0] + ax, pos[i, 1] + ay
    row.J[0], row.J[1], row.J[2] = nx, ny, ax * ny - ay * nx
    row.J[3], row.J[4], row.J[5] = -nx, -ny, -(bx * ny - by * nx)
    row.c = -(across * across / distance - wj * wj * (nx * bx + ny * by) + wi * wi * (nx * ax + ny * ay))


@part
def _refresh_over_pulley(row: Any, pos: FloatArray, vel: FloatArray) -> None:
    i, j, wheel = row.i, row.j, row.feature
    cx, cy = pos[wheel, 0], pos[wheel, 1]
    ax, ay = turned(pos[i, 2], row.ax, row.ay)
    bx, by = turned(pos[j, 2], row.bx, row.by)
    arc, straight_i, ux, uy, straight_j, wx, wy = bent(
        pos[i, 0] + ax - cx, pos[i, 1] + ay - cy, pos[j, 0] + bx - cx, pos[j, 1] + by - cy, row.ri, row.wound
    )
    if arc <= 0.0:
        _refresh_cord(row, pos, vel)
        return
    row.gap = row.length - straight_i - straight_j - arc
    row.nx, row.ny = ux, uy
    row.px, row.py = pos[i, 0] + ax, pos[i, 1] + ay
    row.J[0], row.J[1], row.J[2] = -ux, -uy, -(ax * uy - ay * ux)
    row.J[3], row.J[4], row.J[5] = -wx, -wy, -(bx * wy - by * wx)
    vix, viy = vel[i, 0] - vel[i, 2] * ay, vel[i, 1] + vel[i, 2] * ax
    vjx, vjy = vel[j, 0] - vel[j, 2] * by, vel[j, 1] + vel[j, 2] * bx
    across_i, across_j = -uy * vix + ux * viy, -wy * vjx + wx * vjy
    bend = 0.0
    if straight_i > 0.0:
        bend += across_i * across_i / straight_i
    if straight_j > 0.0:
        bend += across_j * across_j / straight_j
    bend -= vel[i, 2] ** 2 * (ux * ax + uy * ay) + vel[j, 2] ** 2 * (wx * bx + wy * by)
    row.c = -bend


@part
def _refresh_pin(row: Any, pos: FloatArray, vel: FloatArray) -> None:
    i, j = row.i, row.j
    ax, ay = turned(pos[i, 2], row.ax, row.ay)
    bx, by = turned(pos[j, 2], row.bx, row.by)
    wi, wj = vel[i, 2], vel[j, 2]
    row.px, row.py = pos[i, 0] + ax, pos[i, 1] + ay
    row.J[:] = 0.0
    if row.kind == PIN_X:
        row.gap = pos[j, 0] + bx - pos[i, 0] - ax
        row.nx, row.ny = 1.0, 0.0
        row.J[0], row.J[2], row.J[3], row.J[5] = -1.0, ay, 1.0, -by
        row.c = -wj * wj * bx + wi * wi * ax
    else:
        row.gap = pos[j, 1] + by - pos[i, 1] - ay
        row.nx, row.ny = 0.0, 1.0
        row.J[1], row.J[2], row.J[4], row.J[5] = -1.0, -ax, 1.0, bx
        row.c = -wj * wj * by + wi * wi * ay


@kernel
def refresh_table(rows: Table, pos: FloatArray, vel: FloatArray) -> None:
    """`refresh` for every row of a table of its own."""
    for k in range(len(rows)):
        refresh(rows[k], pos, vel)
