"""The rows of one moment: what touches, and what holds bodies whatever touches; each as it was a moment ago."""

from __future__ import annotations

from typing import Any

import numpy as np

from physics.engine.cells import head
from physics.engine.exact.decide import grip_of
from physics.engine.exact.strike import APPROACH
from physics.engine.exact.touch import TOUCHING, all_touching
from physics.engine.forces import wind
from physics.engine.rows import CORD, GIVEN, OFF, ON, PIN_X, POINT, ROW, STICK, refresh
from physics.engine.tables import WORLD, link_of, radii, support_of
from physics.engine.world import PIN, SPRING, WIRE, Table, World
from physics.jit import kernel, part
from sketch.ink import FloatArray

LARGE = 64
"""Contacts at once beyond which exact mode gives up in favour of robust mode: the time to decide which of
them hold grows with their cube."""
SLUGGISH = 3e-2
"""m/s: what opens faster is never held shut, unless it was hit."""


class TooMuch(ArithmeticError):
    """Exact mode cannot go on from here; robust mode can."""


def touching_rows(world: World, pos: FloatArray, vel: FloatArray) -> Table:
    """Every contact, refreshed. Raises TooMuch where there are more than exact mode can decide."""
    rows = np.zeros(_room(world), ROW)
    n = int(all_touching(world.cells, pos, vel, TOUCHING, rows))
    if n < 0 or n > LARGE:
        raise TooMuch
    return rows[:n]


def gathered_rows(world: World, before: Table, pos: FloatArray, vel: FloatArray) -> Table:
    """All rows of this moment, refreshed, each as it was before where it was there.

    Raises TooMuch.
    """
    rows = np.zeros(_room(world) + 2 * len(world.links) + len(world.supports), ROW)
    n = int(_gather(world.cells, before, pos, vel, rows))
    if n < 0:
        raise TooMuch
    return rows[:n]


def _room(world: World) -> int:
    """How many contacts there may be, more than exact mode can decide apart."""
    pairs = len(world.pairs)
    return 4 * pairs + 4 if pairs < 4 * LARGE else 16 * LARGE


@kernel
def _gather(cells: FloatArray, before: Table, pos: FloatArray, vel: FloatArray, rows: Table) -> int:
    """Fills rows, and reckons wires' turns about their pulleys anew; how many rows there are, −1 for too many
    contacts."""
    w = head(cells, WORLD)
    n: Any = np.int64(0)
    if w.pairs > 0:
        n = all_touching(cells, pos, vel, TOUCHING, rows)
        if n < 0 or n > LARGE:
            return -1
    wind(w, pos)
    n = _standing(w, rows, n)
    for k in range(n):
        row = rows[k]
        refresh(row, pos, vel)
        if row.kind >= PIN_X:
            row.status = ON
        known = -1
        for q in range(len(before)):
            old = before[q]
            if old.kind == row.kind and old.source == row.source and old.feature == row.feature:
                known = q
        if known >= 0:
            old = before[known]
            row.status, row.grip, row.sigma, row.shut = old.status, old.grip, old.sigma, old.shut
        elif row.kind <= CORD:
            row.status = ON if row.gap <= TOUCHING else OFF
            grip_of(row)
        elif row.kind == GIVEN:
            grip_of(row)
    return n


@part
def _standing(w: Any, rows: Table, n: int) -> int:
    """Adds the rows of wires, pins, and slips under given normal forces: those that are there whatever touches."""
    for k in range(w.links):
        link = link_of(w, k)
        if link.broken or link.kind == SPRING or (link.kind == WIRE and link.tension >= 0):
            continue
        for turn in range(2 if link.kind == PIN else 1):
            row = rows[n]
            row.kind = CORD if link.kind == WIRE else PIN_X + turn
            row.i, row.j, row.source, row.feature = link.i, link.j, k, -1
            row.ax, row.ay, row.bx, row.by = link.ax, link.ay, link.bx, link.by
            row.length, row.unique = link.rest, 1
            if link.kind == WIRE and link.over >= 0:
                row.feature, row.wound, row.ri = link.over, link.wound, radii(w)[link.over]
            n += 1
    for k in range(w.supports):
        support = support_of(w, k)
        if support.over and support.mu > 0.0:
            row = rows[n]
            row.kind, row.i, row.j, row.source = GIVEN, support.j, support.i, k
            row.ax, row.ay, row.nx0, row.ny0 = support.ax, support.ay, support.nx, support.ny
            row.rj, row.length, row.mu = radii(w)[support.i], support.length, support.mu
            row.status, row.grip, row.unique = ON, STICK, 1
            n += 1
    return n


@kernel
def closes(rows: Table) -> bool:
    """Whether any bodies meet at this moment, or part so slowly that they may be pressed together again at once."""
    for k in range(len(rows)):
        row = rows[k]
        if row.kind >= GIVEN:
            continue
        if row.kind >= PIN_X:
            if abs(row.rate) > APPROACH:
                return True
        elif row.gap <= TOUCHING and (row.rate < -APPROACH or APPROACH < row.rate < SLUGGISH):
            return True
    return False


@kernel
def parts(rows: Table) -> bool:
    """Whether any bodies that touch leave each other."""
    found = False
    for k in range(len(rows)):
        found = found or (rows[k].kind <= POINT and rows[k].rate > APPROACH)
    return found
