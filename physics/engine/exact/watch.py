"""What may happen within a step: functions of the motion that are above zero until it does.

Rows have three each: a force that may not pull (or a slack wire's slack), a friction that may not
exceed its bound (or a slip that may not turn), and a place or strength that may not be left. Links and
given normal forces follow, and how far wires have turned about their pulleys; then the gaps of all pairs, which are watched along the whole step.
Frame: SI units, y up.
"""

from __future__ import annotations

from math import hypot
from typing import Any

from physics.engine import forces
from physics.engine.exact.integrate import between, unpack
from physics.engine.exact.machine import dense_of, poses, row_of, slope, velocities
from physics.engine.exact.touch import newcomers, separation
from physics.engine.rows import CORD, FACE, GIVEN, ON, POINT, SLIDE, STICK, turned
from physics.engine.tables import (
    branch,
    corners,
    counts,
    firsts,
    link_of,
    normals,
    pair_of,
    radii,
    reaches,
    support_of,
)
from physics.engine.world import WIRE, IntArray
from physics.jit import part
from sketch.ink import FloatArray

NOTHING = 1e300
SLIP = 1e-9
"""m/s: slower slip is none."""
LENGTH = 1e-9
"""m: how far past its limit a place must be before something has happened; crossings are then located to
rounding."""
WINDING = 1.0
"""rad: a wire that has turned so far about its pulley is reckoned from there on."""
SWEEP = 1.5
"""rad: the most that a wire may turn about its pulley in a step, by a bound on it; with `WINDING`, less than half a
turn, beyond which it could not be told from a turn the other way."""
SHARE = 1e-10
"""The same of a force, as a share of the greatest one."""


@part
def watches(w: Any, rows: int) -> int:
    """How many functions `watch` fills in, for so many rows."""
    return 3 * rows + 2 * w.links + 2 * w.supports


@part
def watch(w: Any, m: Any, greatest: float, seen: FloatArray) -> None:
    """Values at this moment, for rows as last refreshed and solved, each in units of its tolerance.

    greatest: the greatest force about, N.
    """
    pos, vel = poses(m), velocities(m)
    force_unit = SHARE * greatest
    for k in range(m.rows):
        row = row_of(m, k)
        at = 3 * k
        seen[at] = seen[at + 1] = seen[at + 2] = NOTHING
        if row.status != ON:
            if row.kind <= CORD:
                seen[at] = row.gap / LENGTH
            continue
        if row.kind <= CORD:
            seen[at] = row.force / force_unit
        if row.grip == STICK and row.kind != CORD:
            bound = row.bound if row.kind == GIVEN else row.mu * row.force
            seen[at + 1] = (bound - abs(row.rub)) / force_unit
        elif row.grip == SLIDE:
            seen[at + 1] = row.sigma * row.slip / SLIP
        if row.kind == FACE:
            seen[at + 2] = min(row.along, row.length - row.along) / LENGTH
        elif row.kind == CORD:
            seen[at + 2] = (link_of(w, row.source).limit - row.force) / force_unit
        elif row.kind == POINT and counts(w)[row.i] > 0:
            seen[at + 2] = _round_corner(w, pos, row.i, row.feature, row.j) / LENGTH
    at = 3 * m.rows
    for k in range(w.links):
        link = link_of(w, k)
        seen[at + k] = NOTHING
        if link.kind == WIRE and link.tension >= 0 and link.broken == 0:
            length = forces.ends_of(w, k, pos)[8]
            seen[at + k] = (link.tolerance - abs(length - link.rest)) / LENGTH
    at += w.links
    for k in range(w.supports):
        support = support_of(w, k)
        seen[at + 2 * k] = seen[at + 2 * k + 1] = NOTHING
        if support.over:
            gap, rate, along = forces.clearance(w, k, pos, vel)
            if support.length > 0.0:
                seen[at + 2 * k] = min(along, support.length - along) / LENGTH
            # Within the skin on its way down, or on its way up until it has risen once.
            sunk = (gap + support.skin) / LENGTH if rate < 0.0 else NOTHING
            risen = (support.skin - gap) / LENGTH if support.risen == 0 else NOTHING
            seen[at + 2 * k + 1] = min(sunk, risen)
    at += 2 * w.supports
    for k in range(w.links):
        seen[at + k] = NOTHING
        if link_of(w, k).over >= 0 and link_of(w, k).broken == 0:
            seen[at + k] = (WINDING - abs(forces.wound_now(w, k, pos) - link_of(w, k).wound)) / LENGTH


@part
def _round_corner(w: Any, pos: FloatArray, i: int, feature: int, j: int) -> float:
    """How far the centre of a disc j on a corner of block i is from coming to lie over a face again, m."""
    low, n = firsts(w)[i], counts(w)[i]
    q = low + feature
    before = q - 1 if feature > 0 else low + n - 1
    x, y = turned(-pos[i, 2], pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1])
    dx, dy = x - corners(w)[q, 0], y - corners(w)[q, 1]
    on_next = -normals(w)[q, 1] * dx + normals(w)[q, 0] * dy
    on_last = -normals(w)[before, 1] * dx + normals(w)[before, 0] * dy
    return min(-on_next, on_last)


@part
def decisions(w: Any, m: Any, t: float, taken: IntArray) -> None:
    """Which branches the formulas take at this moment, one number each."""
    for p in range(w.programs):
        taken[p] = branch(w, p, t, poses(m), velocities(m))


@part
def touched(m: Any, p: int) -> bool:
    """Whether a pair has rows of contact that hold: where none does, it may meet anywhere."""
    for k in range(m.rows):
        row = row_of(m, k)
        if row.source == p and row.kind <= POINT and row.status == ON:
            return True
    return False


@part
def pair_gap(w: Any, m: Any, p: int, joined: bool) -> float:
    """What is watched of a pair, m: its gap, or where it touches already, that of what does not yet."""
    i, j = pair_of(w, p).i, pair_of(w, p).j
    if not joined:
        return separation(w, poses(m), i, j)
    return newcomers(w, m, i, j, p)


@part
def quickness(w: Any, m: Any, p: int) -> float:
    """A bound on how fast any points of a pair close, m/s, at this moment."""
    i, j, vel = pair_of(w, p).i, pair_of(w, p).j, velocities(m)
    speed = hypot(vel[j, 0] - vel[i, 0], vel[j, 1] - vel[i, 1])
    return speed + abs(vel[i, 2]) * reaches(w)[i] + abs(vel[j, 2]) * reaches(w)[j]


@part
def whirl(w: Any, m: Any) -> float:
    """A bound on how fast any wire turns about its pulley at this moment, rad/s; an end within the wheel counts as
    one halfway to its rim."""
    pos, vel = poses(m), velocities(m)
    fastest = 0.0
    for k in range(w.links):
        link = link_of(w, k)
        if link.over < 0 or link.broken != 0:
            continue
        ax, ay, bx, by = forces.ends_of(w, k, pos)[:4]
        turning = 0.0
        for end in range(2):
            body, x, y = (link.i, ax, ay) if end == 0 else (link.j, bx, by)
            dx, dy = pos[body, 0] + x - pos[link.over, 0], pos[body, 1] + y - pos[link.over, 1]
            speed = hypot(vel[body, 0] - vel[body, 2] * y, vel[body, 1] + vel[body, 2] * x)
            turning += speed / max(hypot(dx, dy), 0.5 * float(radii(w)[link.over]))
        fastest = max(fastest, turning)
    return fastest


@part
def whirls(w: Any, m: Any, h: float) -> bool:
    """Whether a wire may turn farther about its pulley than can be told, in the step just made dense."""
    fastest = 0.0
    scratch = slope(m, 1)
    for s in range(1, 3):
        between(dense_of(m), 0.5 * s, scratch)
        unpack(scratch, m.movable, poses(m), velocities(m))
        fastest = max(fastest, whirl(w, m))
    return fastest * h > SWEEP


@part
def excused(w: Any, p: int) -> bool:
    """Whether a given normal force stands in for the contact of a pair."""
    support = pair_of(w, p).support
    return support >= 0 and support_of(w, support).over == 1
