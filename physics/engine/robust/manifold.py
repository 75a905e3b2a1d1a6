"""Where two solids meet or nearly meet, compiled: discs and convex blocks, two points at most.

Blocks: separating axes over the faces of both (Gottschalk 1996), then the other's most opposed edge
clipped to the face's sides. A disc meets a block on a face or at a corner. A contact is a column of
two tables, `REALS` lines of numbers and `WHOLES` of integers, and knows its place in the frames of
both bodies, so that it can be brought up to later poses by `renew`.

Frame: SI units, y up; the normal points from body ONE to body OTHER.
"""

from __future__ import annotations

from math import hypot
from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.engine.tables import corners, counts, edges, firsts, normals, pair_of, radii
from physics.jit import part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]

ONE, OTHER, KIND, PAIR, FEATURE, LIVE = 0, 1, 2, 3, 4, 5
WHOLES = 6
"""Bodies; on a face of ONE or from a point of it; the pair; which corner and face; taking part."""

AX, AY, BX, BY, MX, MY, RI, RJ, BOUNCE, MU = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
"""Points in the frames of both; the face's normal in that of ONE; radii about the points; restitution, friction."""
NX, NY, CA, CB, TA, TB, KN, KT, GAP, PX, PY = 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20
"""Normal; levers of normal and tangent about both; masses that they meet, kg; gap, m; place, m."""
PN, PT, TARGET, WN, WT, RATE, TAU, LIFT, HIT = 21, 22, 23, 24, 25, 26, 27, 28, 29
EASE, ON, OT, DN, DT, GAIN, SLIP = 30, 31, 32, 33, 34, 35, 36
"""Impulses along normal and tangent; the least rate wanted; impulses kept aside; a rate; a time; impulse of
the push out of overlap, kg m; how fast it was struck, m/s;
1 / mass along the normal; impulses a round ago, and the direction in which they go on; what the rate gains until
an impact, and the slip before it, m/s."""
REALS = 37

FACE, POINT = 0, 1

FLUSH = 1e-5
"""m: how much wider the second block's gap must be for its face to be the one that counts; without it, two
faces that lie flush take turns."""


@part
def meet(
    w: Any,
    pair: int,
    pos: FloatArray,
    turns: FloatArray,
    margin: float,
    real: FloatArray,
    whole: IntArray,
    at: int,
) -> int:
    """Writes the contacts of a pair whose gap is below `margin` (m) from row `at` on; how many there are.

    turns: (bodies, 2) cosine and sine of every body's angle.
    """
    row = pair_of(w, pair)
    count, radius = counts(w), radii(w)
    i, j = row.i, row.j
    dx, dy = pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]
    reach = row.reach + margin
    if dx * dx + dy * dy > reach * reach:
        return 0
    if count[i] == 0 and count[j] == 0:
        if hypot(dx, dy) - radius[i] - radius[j] > margin:
            return 0
        _put(w, pair, i, j, real, whole, at)
        real[RI, at], real[RJ, at] = radius[i], radius[j]
        return 1
    if count[i] == 0 or count[j] == 0:
        one, other = (i, j) if count[j] == 0 else (j, i)
        return _disc_on_block(w, pair, one, other, pos, turns, margin, real, whole, at)
    gap_i, face_i = _widest(w, i, j, pos, turns, margin)
    if gap_i > margin:
        return 0
    gap_j, face_j = _widest(w, j, i, pos, turns, margin)
    if gap_j > margin:
        return 0
    one, other, face = i, j, face_i
    if gap_j > gap_i + FLUSH:
        one, other, face = j, i, face_j
    return _clip(w, pair, one, other, face, pos, turns, margin, real, whole, at)


@part
def _put(w: Any, pair: int, i: int, j: int, real: FloatArray, whole: IntArray, at: int) -> None:
    whole[ONE, at], whole[OTHER, at], whole[KIND, at] = i, j, POINT
    whole[PAIR, at], whole[FEATURE, at], whole[LIVE, at] = pair, -1, 1
    for k in range(REALS):
        real[k, at] = 0.0
    real[BOUNCE, at], real[MU, at] = pair_of(w, pair).e, pair_of(w, pair).mu


@part
def _disc_on_block(
    w: Any,
    pair: int,
    i: int,
    j: int,
    pos: FloatArray,
    turns: FloatArray,
    margin: float,
    real: FloatArray,
    whole: IntArray,
    at: int,
) -> int:
    c, s = turns[i, 0], turns[i, 1]
    dx, dy = pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]
    x, y = c * dx + s * dy, c * dy - s * dx
    radius = radii(w)[j]
    first, count = firsts(w)[i], counts(w)[i]
    points, ways = corners(w), normals(w)
    best, face = -1e300, first
    for k in range(first, first + count):
        gap = ways[k, 0] * (x - points[k, 0]) + ways[k, 1] * (y - points[k, 1])
        if gap > best:
            best, face = gap, k
    if best - radius > margin:
        return 0
    x1, y1 = points[face, 0], points[face, 1]
    nx, ny = ways[face, 0], ways[face, 1]
    along = nx * (y - y1) - ny * (x - x1)
    if best > 0.0 and (along < 0.0 or along > edges(w)[face]):
        if along > 0.0:
            face = face + 1 if face + 1 < first + count else first
        x1, y1 = points[face, 0], points[face, 1]
        if hypot(x - x1, y - y1) - radius > margin:
            return 0
        _put(w, pair, i, j, real, whole, at)
    else:
        _put(w, pair, i, j, real, whole, at)
        whole[KIND, at], whole[FEATURE, at] = FACE, face
        real[MX, at], real[MY, at] = nx, ny
    real[AX, at], real[AY, at], real[RJ, at] = x1, y1, radius
    return 1


@part
def _widest(w: Any, i: int, j: int, pos: FloatArray, turns: FloatArray, margin: float) -> tuple[float, int]:
    """The face of i that keeps j farthest away, and how far; any face that keeps it beyond the margin."""
    ci, si, cj, sj = turns[i, 0], turns[i, 1], turns[j, 0], turns[j, 1]
    dx, dy = pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]
    x, y = ci * dx + si * dy, ci * dy - si * dx
    c, s = ci * cj + si * sj, ci * sj - si * cj
    points, ways = corners(w), normals(w)
    first, last = firsts(w)[j], firsts(w)[j] + counts(w)[j]
    best, face = -1e300, 0
    for k in range(firsts(w)[i], firsts(w)[i] + counts(w)[i]):
        nx, ny = ways[k, 0], ways[k, 1]
        mx, my = c * nx + s * ny, c * ny - s * nx  # the normal in j's frame
        nearest = 1e300
        for q in range(first, last):
            nearest = min(nearest, mx * points[q, 0] + my * points[q, 1])
        gap = nearest + nx * (x - points[k, 0]) + ny * (y - points[k, 1])
        if gap > best:
            best, face = gap, k
            if gap > margin:
                break
    return best, face


@part
def _clip(
    w: Any,
    pair: int,
    i: int,
    j: int,
    face: int,
    pos: FloatArray,
    turns: FloatArray,
    margin: float,
    real: FloatArray,
    whole: IntArray,
    at: int,
) -> int:
    ci, si, cj, sj = turns[i, 0], turns[i, 1], turns[j, 0], turns[j, 1]
    dx, dy = pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]
    x, y = ci * dx + si * dy, ci * dy - si * dx
    c, s = ci * cj + si * sj, ci * sj - si * cj
    points, ways = corners(w), normals(w)
    nx, ny = ways[face, 0], ways[face, 1]
    mx, my = c * nx + s * ny, c * ny - s * nx
    first, count = firsts(w)[j], counts(w)[j]
    most, start = 1e300, first
    for q in range(first, first + count):
        facing = mx * ways[q, 0] + my * ways[q, 1]
        if facing < most:
            most, start = facing, q
    end = start + 1 if start + 1 < first + count else first
    x1, y1 = points[face, 0], points[face, 1]
    ax, ay, bx, by = points[start, 0], points[start, 1], points[end, 0], points[end, 1]
    # Both ends of the edge in i's frame, along the face (anti-clockwise) and out of it.
    sx, sy = x + c * ax - s * ay - x1, y + s * ax + c * ay - y1
    ex, ey = x + c * bx - s * by - x1, y + s * bx + c * by - y1
    u1, u2 = nx * sy - ny * sx, nx * ey - ny * ex
    d1, d2 = nx * sx + ny * sy, nx * ex + ny * ey
    if u1 == u2:
        return 0
    found = 0
    for slot in range(2):
        u = min(max(u1 if slot == 0 else u2, 0.0), edges(w)[face])
        share = (u - u1) / (u2 - u1)
        if share < 0.0 or share > 1.0 or d1 + share * (d2 - d1) > margin:
            continue
        row = at + found
        _put(w, pair, i, j, real, whole, row)
        whole[KIND, row], whole[FEATURE, row] = FACE, 2 * face + slot
        real[AX, row], real[AY, row], real[MX, row], real[MY, row] = x1, y1, nx, ny
        real[BX, row], real[BY, row] = ax + share * (bx - ax), ay + share * (by - ay)
        found += 1
    return found


@part
def renew(
    k: int, pos: FloatArray, turns: FloatArray, inverse: FloatArray, real: FloatArray, whole: IntArray
) -> None:
    """Brings contact k up to these poses: gap, normal, levers, masses."""
    i, j = whole[ONE, k], whole[OTHER, k]
    ci, si, cj, sj = turns[i, 0], turns[i, 1], turns[j, 0], turns[j, 1]
    ax, ay = ci * real[AX, k] - si * real[AY, k], si * real[AX, k] + ci * real[AY, k]
    bx, by = cj * real[BX, k] - sj * real[BY, k], sj * real[BX, k] + cj * real[BY, k]
    dx, dy = pos[j, 0] + bx - pos[i, 0], pos[j, 1] + by - pos[i, 1]
    ri, rj = real[RI, k], real[RJ, k]
    if whole[KIND, k] == FACE:
        nx, ny = ci * real[MX, k] - si * real[MY, k], si * real[MX, k] + ci * real[MY, k]
        gap = nx * (dx - ax) + ny * (dy - ay) - rj
        ax, ay, ri = dx - rj * nx, dy - rj * ny, 0.0
    else:
        ux, uy = dx - ax, dy - ay
        distance = hypot(ux, uy)
        nx, ny = 0.0, 1.0
        if distance > 0.0:
            nx, ny = ux / distance, uy / distance
        gap = distance - ri - rj
    ca, cb = ax * ny - ay * nx, bx * ny - by * nx
    ta, tb = nx * ax + ny * ay + ri, nx * bx + ny * by - rj
    mx, my = inverse[i, 0] + inverse[j, 0], inverse[i, 1] + inverse[j, 1]
    wi, wj = inverse[i, 2], inverse[j, 2]
    light = nx * nx * mx + ny * ny * my + ca * ca * wi + cb * cb * wj
    aside = ny * ny * mx + nx * nx * my + ta * ta * wi + tb * tb * wj
    real[NX, k], real[NY, k], real[CA, k], real[CB, k], real[TA, k], real[TB, k] = nx, ny, ca, cb, ta, tb
    real[KN, k] = 1.0 / light if light > 0.0 else 0.0
    real[EASE, k] = light
    real[KT, k] = 1.0 / aside if aside > 0.0 else 0.0
    real[GAP, k], real[PX, k], real[PY, k] = gap, pos[j, 0] + bx - rj * nx, pos[j, 1] + by - rj * ny


@part
def renew_all(
    count: int, pos: FloatArray, turns: FloatArray, inverse: FloatArray, real: FloatArray, whole: IntArray
) -> None:
    """`renew` for every contact."""
    for k in range(count):
        renew(k, pos, turns, inverse, real, whole)
