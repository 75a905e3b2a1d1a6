"""Where bodies touch, how far apart they are, and which corner or face is about to touch next.

Discs and convex blocks. Two convex blocks are apart exactly if some face of either keeps all corners
of the other outside (separating axes), so the widest such face gives a gap whose sign is right.
Frame: SI units, y up.
"""

from __future__ import annotations

from math import hypot
from typing import Any

import numpy as np

from physics.engine.cells import head
from physics.engine.exact.machine import poses, row_of, velocities
from physics.engine.rows import FACE, FREE, OFF, POINT, STICK, refresh, turned
from physics.engine.tables import (
    WORLD,
    corners,
    counts,
    edges,
    firsts,
    normals,
    pair_of,
    radii,
    support_of,
)
from physics.engine.world import IntArray, Table
from physics.jit import kernel, part
from sketch.ink import FloatArray

TOUCHING = 1e-8
"""m: a gap below this is closed: far above rounding, a ten-thousandth of a hair."""
SAME = 1e-7
"""m: points of contact closer than this are one."""


@part
def within(pos: FloatArray, i: int, x: float, y: float) -> tuple[float, float]:
    """A point of the world in the frame of body i."""
    return turned(-pos[i, 2], x - pos[i, 0], y - pos[i, 1])


@part
def corner(w: Any, pos: FloatArray, i: int, q: int) -> tuple[float, float]:
    """Corner q (a row of `corners`) of body i in the world."""
    x, y = turned(pos[i, 2], corners(w)[q, 0], corners(w)[q, 1])
    return pos[i, 0] + x, pos[i, 1] + y


@part
def face_of(w: Any, pos: FloatArray, i: int, face: int) -> tuple[float, float, float, float]:
    """The outward normal of a face of block i in the world, and the corner where it begins, m."""
    nx, ny = turned(pos[i, 2], normals(w)[face, 0], normals(w)[face, 1])
    x, y = corner(w, pos, i, face)
    return nx, ny, x, y


@part
def outside(w: Any, i: int, x: float, y: float) -> tuple[float, int]:
    """How far outside block i its widest face keeps a point (x, y) of its frame, m, and that face."""
    best, face = -1e300, firsts(w)[i]
    for q in range(firsts(w)[i], firsts(w)[i] + counts(w)[i]):
        nx, ny = normals(w)[q, 0], normals(w)[q, 1]
        depth = nx * (x - corners(w)[q, 0]) + ny * (y - corners(w)[q, 1])
        if depth > best:
            best, face = depth, q
    return best, face


@part
def nearest(w: Any, i: int, x: float, y: float) -> tuple[float, int, int]:
    """Signed distance of a point of block i's frame from the block, the face it is nearest to, and the
    corner, −1 where it is nearest to the face itself."""
    best, face = outside(w, i, x, y)
    if best <= 0.0:
        return best, face, -1
    low = firsts(w)[i]
    n = counts(w)[i]
    distance, found, at = 1e300, face, -1
    for q in range(low, low + n):
        px, py = x - corners(w)[q, 0], y - corners(w)[q, 1]
        nx, ny = normals(w)[q, 0], normals(w)[q, 1]
        depth = nx * px + ny * py
        along = -ny * px + nx * py
        if 0.0 <= along <= edges(w)[q] and 0.0 <= depth < distance:
            distance, found, at = depth, q, -1
        if hypot(px, py) < distance:
            distance, found, at = hypot(px, py), q, q
    return distance, found, at


@part
def widest(w: Any, pos: FloatArray, i: int, j: int) -> tuple[float, int]:
    """The face of block i that keeps block j farthest away, and how far, m."""
    best, face = -1e300, firsts(w)[i]
    c, s = turned(pos[j, 2] - pos[i, 2], 1.0, 0.0)
    ox, oy = within(pos, i, pos[j, 0], pos[j, 1])
    for q in range(firsts(w)[i], firsts(w)[i] + counts(w)[i]):
        nx, ny = normals(w)[q, 0], normals(w)[q, 1]
        # The normal in j's frame, so that j's corners need no turning.
        mx, my = c * nx + s * ny, c * ny - s * nx
        low = 1e300
        for v in range(firsts(w)[j], firsts(w)[j] + counts(w)[j]):
            low = min(low, mx * corners(w)[v, 0] + my * corners(w)[v, 1])
        depth = low + nx * (ox - corners(w)[q, 0]) + ny * (oy - corners(w)[q, 1])
        if depth > best:
            best, face = depth, q
    return best, face


@part
def separation(w: Any, pos: FloatArray, i: int, j: int) -> float:
    """The gap between two bodies, m; between blocks never more than it is, negative where they overlap."""
    if counts(w)[i] == 0 and counts(w)[j] == 0:
        return hypot(pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]) - radii(w)[i] - radii(w)[j]
    if counts(w)[j] == 0:
        x, y = within(pos, i, pos[j, 0], pos[j, 1])
        return nearest(w, i, x, y)[0] - radii(w)[j]
    if counts(w)[i] == 0:
        x, y = within(pos, j, pos[i, 0], pos[i, 1])
        return nearest(w, j, x, y)[0] - radii(w)[i]
    return max(widest(w, pos, i, j)[0], widest(w, pos, j, i)[0])


@part
def newcomers(w: Any, m: Any, i: int, j: int, p: int) -> float:
    """The gap between two blocks that touch already, but for the corners that do, m: the least distance by which
    another corner of either is outside the other, or by which the best face keeps them off where that is less: edges
    may cross though no corner is inside, where one slides along a floor under a sharp tip. Discs touch at one place
    only: infinite."""
    if counts(w)[i] == 0 or counts(w)[j] == 0:
        return 1e300
    least, widest_of_both = 1e300, -1e300
    pos = poses(m)
    for k in range(m.rows):
        if row_of(m, k).source == p and row_of(m, k).kind == FACE:
            refresh(row_of(m, k), pos, velocities(m))
    for side in range(2):
        one, other = (i, j) if side == 0 else (j, i)
        for q in range(firsts(w)[one], firsts(w)[one] + counts(w)[one]):
            nx, ny, ax, ay = face_of(w, pos, one, q)
            kept_off = 1e300
            for v in range(firsts(w)[other], firsts(w)[other] + counts(w)[other]):
                px, py = corner(w, pos, other, v)
                if not _touches(m, p, px, py):
                    kept_off = min(kept_off, nx * (px - ax) + ny * (py - ay))
            widest_of_both = max(widest_of_both, kept_off)
        for v in range(firsts(w)[other], firsts(w)[other] + counts(w)[other]):
            px, py = corner(w, pos, other, v)
            if not _touches(m, p, px, py):
                x, y = within(pos, one, px, py)
                least = min(least, outside(w, one, x, y)[0])
    return min(least, widest_of_both)


@part
def _touches(m: Any, p: int, x: float, y: float) -> bool:
    """Whether a row of the pair acts at a point of the world, as last refreshed."""
    for k in range(m.rows):
        row = row_of(m, k)
        if row.source == p and row.kind == FACE and hypot(row.px - x, row.py - y) < 1e-5:
            return True
    return False


@part
def _blank(row: Any, w: Any, p: int, i: int, j: int) -> None:
    pair = pair_of(w, p)
    row.i, row.j, row.source = i, j, p
    row.e, row.mu = pair.e, pair.mu
    row.status = OFF
    row.grip = STICK if pair.mu > 0.0 else FREE
    row.shut = 0
    row.unique = 1
    row.sigma = 0.0
    row.ax, row.ay, row.bx, row.by, row.nx0, row.ny0 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    row.ri, row.rj, row.length = 0.0, 0.0, 1e300
    row.force, row.rub, row.bound = 0.0, 0.0, 0.0


@part
def _handed_on(
    w: Any, pos: FloatArray, vel: FloatArray, i: int, j: int, face: int, at: int
) -> tuple[int, int]:
    """Where the centre of disc j outside block i goes over from a face to the corner at its end, or back, at this
    very moment: which of the two it is from now on. face, at: as `nearest` finds them."""
    low, n = firsts(w)[i], counts(w)[i]
    if at < 0:
        along, drift = _passage(w, pos, vel, i, j, face)
        if along < TOUCHING and drift < 0.0:
            return face, face
        if along > edges(w)[face] - TOUCHING and drift > 0.0:
            return face, face + 1 if face + 1 < low + n else low
        return face, -1
    last = at - 1 if at > low else low + n - 1
    along, drift = _passage(w, pos, vel, i, j, at)
    if abs(along) < TOUCHING and drift > 0.0:
        return at, -1
    along, drift = _passage(w, pos, vel, i, j, last)
    if abs(along - edges(w)[last]) < TOUCHING and drift < 0.0:
        return last, -1
    return face, at


@part
def _passage(w: Any, pos: FloatArray, vel: FloatArray, i: int, j: int, face: int) -> tuple[float, float]:
    """How far along a face of block i the centre of disc j is, m, and how fast it goes along it, m/s."""
    x, y = within(pos, i, pos[j, 0], pos[j, 1])
    ux, uy = turned(-pos[i, 2], vel[j, 0] - vel[i, 0], vel[j, 1] - vel[i, 1])
    nx, ny = normals(w)[face, 0], normals(w)[face, 1]
    along = -ny * (x - corners(w)[face, 0]) + nx * (y - corners(w)[face, 1])
    return along, -ny * (ux + vel[i, 2] * y) + nx * (uy - vel[i, 2] * x)


@part
def _disc_on_block(
    w: Any, pos: FloatArray, vel: FloatArray, p: int, i: int, j: int, reach: float, rows: Table, n: int
) -> int:
    x, y = within(pos, i, pos[j, 0], pos[j, 1])
    distance, face, at = nearest(w, i, x, y)
    if distance - radii(w)[j] > reach:
        return n
    if distance > 0.0:
        face, at = _handed_on(w, pos, vel, i, j, face, at)
    row = rows[n]
    _blank(row, w, p, i, j)
    if at >= 0:
        row.kind, row.feature = POINT, at - firsts(w)[i]
        row.ax, row.ay = corners(w)[at, 0], corners(w)[at, 1]
    else:
        row.kind, row.feature = FACE, 1000 + face - firsts(w)[i]
        row.ax, row.ay = corners(w)[face, 0], corners(w)[face, 1]
        row.nx0, row.ny0 = normals(w)[face, 0], normals(w)[face, 1]
        row.length = edges(w)[face]
    row.rj = radii(w)[j]
    return n + 1


@part
def _corner_on_face(
    w: Any,
    pos: FloatArray,
    vel: FloatArray,
    p: int,
    i: int,
    face: int,
    j: int,
    v: int,
    reach: float,
    rows: Table,
    n: int,
    start: int,
) -> int:
    """Adds corner v of j on a face of i, where it is there, and nothing else is."""
    row = rows[n]
    _blank(row, w, p, i, j)
    row.kind = FACE
    row.feature = 1000 * (face - firsts(w)[i] + 1) + v - firsts(w)[j] + (0 if i < j else 500_000)
    row.ax, row.ay = corners(w)[face, 0], corners(w)[face, 1]
    row.bx, row.by = corners(w)[v, 0], corners(w)[v, 1]
    row.nx0, row.ny0 = normals(w)[face, 0], normals(w)[face, 1]
    row.length = edges(w)[face]
    refresh(row, pos, vel)
    if row.gap > reach or row.along < -SAME or row.along > row.length + SAME:
        return n
    # How fast the corner goes along the face, seen from it.
    wide = vel[j, 0] - vel[j, 2] * (row.py - pos[j, 1]) - vel[i, 0] + vel[i, 2] * (row.py - pos[i, 1])
    high = vel[j, 1] + vel[j, 2] * (row.px - pos[j, 0]) - vel[i, 1] - vel[i, 2] * (row.px - pos[i, 0])
    drift = -row.ny * wide + row.nx * high
    if (row.along < TOUCHING and drift < -1e-12) or (row.along > row.length - TOUCHING and drift > 1e-12):
        return n
    for k in range(start, n):
        if hypot(rows[k].px - row.px, rows[k].py - row.py) < SAME:
            return n
    return n + 1


@part
def _block_on_block(
    w: Any, pos: FloatArray, vel: FloatArray, p: int, i: int, j: int, reach: float, rows: Table, n: int
) -> int:
    gap_i, face_i = widest(w, pos, i, j)
    gap_j, face_j = widest(w, pos, j, i)
    if max(gap_i, gap_j) > reach:
        return n
    one, other, face, gap = i, j, face_i, gap_i
    if gap_j > gap_i + TOUCHING:
        one, other, face, gap = j, i, face_j, gap_j
    start = n
    n = _corners_on_face(w, pos, vel, p, one, face, other, gap, reach, rows, n, start)
    n = _flush_with_face(w, pos, vel, p, one, face, other, gap, reach, rows, n, start)
    if n == start:
        # Corner on corner, on its way past the end of this face: another face carries it, or one carries the other's.
        for side in range(2):
            mine, its = (one, other) if side == 0 else (other, one)
            for q in range(firsts(w)[mine], firsts(w)[mine] + counts(w)[mine]):
                if n == start and _keeps_off(w, pos, mine, q, its) > gap - SAME:
                    n = _corners_on_face(w, pos, vel, p, mine, q, its, gap, reach, rows, n, start)
    return n


@part
def _keeps_off(w: Any, pos: FloatArray, i: int, face: int, j: int) -> float:
    """How far a face of block i keeps block j away, m."""
    nx, ny, ax, ay = face_of(w, pos, i, face)
    least = 1e300
    for v in range(firsts(w)[j], firsts(w)[j] + counts(w)[j]):
        px, py = corner(w, pos, j, v)
        least = min(least, nx * (px - ax) + ny * (py - ay))
    return least


@part
def _corners_on_face(
    w: Any,
    pos: FloatArray,
    vel: FloatArray,
    p: int,
    one: int,
    face: int,
    other: int,
    gap: float,
    reach: float,
    rows: Table,
    n: int,
    start: int,
) -> int:
    """Adds the corners of the other block that lie on a face of this one."""
    nx, ny, ax, ay = face_of(w, pos, one, face)
    for v in range(firsts(w)[other], firsts(w)[other] + counts(w)[other]):
        px, py = corner(w, pos, other, v)
        if nx * (px - ax) + ny * (py - ay) <= gap + SAME:
            n = _corner_on_face(w, pos, vel, p, one, face, other, v, reach, rows, n, start)
    return n


@part
def _flush_with_face(
    w: Any,
    pos: FloatArray,
    vel: FloatArray,
    p: int,
    one: int,
    face: int,
    other: int,
    gap: float,
    reach: float,
    rows: Table,
    n: int,
    start: int,
) -> int:
    """Adds the ends of a face of this block that are carried by a face of the other which lies flush with it."""
    nx, ny, ax, ay = face_of(w, pos, one, face)
    low = firsts(w)[other]
    for q in range(low, low + counts(w)[other]):
        mx, my = turned(pos[other, 2], normals(w)[q, 0], normals(w)[q, 1])
        px, py = corner(w, pos, other, q)
        flush = nx * (px - ax) + ny * (py - ay) <= gap + SAME
        if flush and mx * nx + my * ny < -0.999999 and abs(mx * ny - my * nx) * edges(w)[q] < SAME:
            last = firsts(w)[one] + counts(w)[one] - 1
            after = face + 1 if face < last else firsts(w)[one]
            n = _corner_on_face(w, pos, vel, p, other, q, one, face, reach, rows, n, start)
            n = _corner_on_face(w, pos, vel, p, other, q, one, after, reach, rows, n, start)
    return n


@part
def touching(w: Any, pos: FloatArray, vel: FloatArray, p: int, reach: float, rows: Table, n: int) -> int:
    """Adds to rows[n:] the places where pair p touches (gaps below `reach`, m); returns the new n."""
    i, j = pair_of(w, p).i, pair_of(w, p).j
    dx, dy = pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]
    most = pair_of(w, p).reach + reach
    if dx * dx + dy * dy > most * most:
        return n
    if counts(w)[i] == 0 and counts(w)[j] == 0:
        if hypot(dx, dy) - radii(w)[i] - radii(w)[j] > reach:
            return n
        _blank(rows[n], w, p, i, j)
        rows[n].kind, rows[n].feature = POINT, 0
        rows[n].ri, rows[n].rj = radii(w)[i], radii(w)[j]
        return n + 1
    if counts(w)[j] == 0:
        return _disc_on_block(w, pos, vel, p, i, j, reach, rows, n)
    if counts(w)[i] == 0:
        return _disc_on_block(w, pos, vel, p, j, i, reach, rows, n)
    return _block_on_block(w, pos, vel, p, i, j, reach, rows, n)


@kernel
def all_touching(cells: FloatArray, pos: FloatArray, vel: FloatArray, reach: float, rows: Table) -> int:
    """Fills rows with every place where bodies touch (gaps below `reach`, m); returns how many. Where there
    is no room left, −1."""
    w = head(cells, WORLD)
    n: Any = np.int64(0)
    for p in range(w.pairs):
        support = pair_of(w, p).support
        if support >= 0 and support_of(w, support).over:
            continue
        if n + 4 > len(rows):
            return -1
        n = touching(w, pos, vel, p, reach, rows, n)
    for k in range(n):
        refresh(rows[k], pos, vel)
    return n


@kernel
def near_pairs(cells: FloatArray, pos: FloatArray, reach: float, found: IntArray) -> int:
    """Fills found (k, 2) with the bodies of pairs whose gap is below `reach`; returns how many there are."""
    w = head(cells, WORLD)
    n = 0
    for p in range(w.pairs):
        i, j = pair_of(w, p).i, pair_of(w, p).j
        dx, dy = pos[j, 0] - pos[i, 0], pos[j, 1] - pos[i, 1]
        most = pair_of(w, p).reach + reach
        if dx * dx + dy * dy <= most * most and separation(w, pos, i, j) <= reach:
            if n < len(found):
                found[n, 0], found[n, 1] = i, j
            n += 1
    return n


@kernel
def gaps_between(cells: FloatArray, pos: FloatArray, i: int, j: int, gaps: FloatArray) -> None:
    """gaps (T,) ← the gap between two bodies in each frame of pos (T, bodies, 3)."""
    w = head(cells, WORLD)
    for k in range(len(pos)):
        gaps[k] = separation(w, pos[k], i, j)
