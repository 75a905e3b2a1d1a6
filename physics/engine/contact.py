"""Where two solids meet or nearly meet: discs and convex blocks.

Blocks: separating axes over the faces of both, then the other's most opposed edge clipped to
the face's sides (two points at most). A disc meets a block on a face or at a corner.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from physics.engine.rows import FACE, POINT, Row, Turns
from physics.scene import Block, Body, Disc

Vector = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Solid:
    """A body's outline as contact wants it, in its own frame. corners, normals: empty for a disc;
    normal k is the outward unit normal of the face from corner k to the next. reach: m, the
    farthest point from the centre of mass."""

    radius: float
    corners: tuple[Vector, ...]
    normals: tuple[Vector, ...]
    reach: float


def solid_of(body: Body) -> Solid:
    """The outline of a body, ready for contact."""
    match body.shape:
        case Disc(radius):
            return Solid(radius, (), (), radius)
        case Block(vertices):
            normals: list[Vector] = []
            for (x1, y1), (x2, y2) in zip(vertices, (*vertices[1:], vertices[0]), strict=True):
                length = hypot(x2 - x1, y2 - y1) or 1.0
                normals.append(((y2 - y1) / length, (x1 - x2) / length))
            return Solid(0.0, vertices, tuple(normals), max(hypot(x, y) for x, y in vertices))


@dataclass(frozen=True, slots=True)
class Pair:
    """Two bodies that may meet; number: which pair; e, mu: restitution and friction between them."""

    number: int
    i: int
    j: int
    solid_i: Solid
    solid_j: Solid
    e: float
    mu: float


def meet(pair: Pair, pos: list[float], turns: Turns, margin: float) -> list[Row]:
    """The rows of a pair whose gap may be below `margin` (m), not yet refreshed."""
    one, other = pair.solid_i, pair.solid_j
    i3, j3 = 3 * pair.i, 3 * pair.j
    dx, dy = pos[j3] - pos[i3], pos[j3 + 1] - pos[i3 + 1]
    reach = one.reach + other.reach + margin
    if dx * dx + dy * dy > reach * reach:
        return []
    if not one.corners and not other.corners:
        row = Row(
            POINT,
            (pair.number, 0),
            (pair.i, pair.j),
            (0.0, 0.0),
            (0.0, 0.0),
            one.radius + other.radius,
            radius_i=one.radius,
            e=pair.e,
            mu=pair.mu,
        )
        return [row]
    if not other.corners:
        return _disc_on_block(pair, (pair.i, pair.j), one, other.radius, pos, turns, margin)
    if not one.corners:
        return _disc_on_block(pair, (pair.j, pair.i), other, one.radius, pos, turns, margin)
    return _block_on_block(pair, pos, turns, margin)


def _disc_on_block(
    pair: Pair,
    bodies: tuple[int, int],
    block: Solid,
    radius: float,
    pos: list[float],
    turns: Turns,
    margin: float,
) -> list[Row]:
    i, j = bodies
    cosine, sine = turns[i]
    dx, dy = pos[3 * j] - pos[3 * i], pos[3 * j + 1] - pos[3 * i + 1]
    cx, cy = cosine * dx + sine * dy, cosine * dy - sine * dx
    best, face = -1e300, 0
    for k, ((x, y), (nx, ny)) in enumerate(zip(block.corners, block.normals, strict=True)):
        separation = nx * (cx - x) + ny * (cy - y)
        if separation > best:
            best, face = separation, k
    if best - radius > margin:
        return []
    x1, y1 = block.corners[face]
    x2, y2 = block.corners[(face + 1) % len(block.corners)]
    share = (cx - x1) * (x2 - x1) + (cy - y1) * (y2 - y1)
    if best > 0.0:
        corner = (x1, y1) if share < 0.0 else None
        if share > (x2 - x1) ** 2 + (y2 - y1) ** 2:
            corner = (x2, y2)
        if corner is not None:
            name = (pair.number, -1)
            return [Row(POINT, name, bodies, corner, (0.0, 0.0), radius, e=pair.e, mu=pair.mu)]
    name = (pair.number, face)
    return [Row(FACE, name, bodies, (x1, y1), (0.0, 0.0), radius, block.normals[face], e=pair.e, mu=pair.mu)]


def _block_on_block(pair: Pair, pos: list[float], turns: Turns, margin: float) -> list[Row]:
    seen_by_i = _seen(pair.solid_j.corners, pair.j, pair.i, pos, turns)
    gap_i, face_i = _widest(pair.solid_i, seen_by_i)
    if gap_i > margin:
        return []
    seen_by_j = _seen(pair.solid_i.corners, pair.i, pair.j, pos, turns)
    gap_j, face_j = _widest(pair.solid_j, seen_by_j)
    if gap_j > margin:
        return []
    # A hair's preference for i, so that two faces that lie flush do not take turns.
    if gap_j > gap_i + 1e-5:
        bodies, block, face, seen, local, side = (
            (pair.j, pair.i),
            pair.solid_j,
            face_j,
            seen_by_j,
            pair.solid_i,
            8,
        )
    else:
        bodies, block, face, seen, local, side = (
            (pair.i, pair.j),
            pair.solid_i,
            face_i,
            seen_by_i,
            pair.solid_j,
            0,
        )
    nx, ny = block.normals[face]
    x1, y1 = block.corners[face]
    x2, y2 = block.corners[(face + 1) % len(block.corners)]
    tx, ty = -ny, nx  # along the face, anti-clockwise
    length = tx * (x2 - x1) + ty * (y2 - y1)
    start, end = _opposed(seen, nx, ny)
    u1 = tx * (seen[start][0] - x1) + ty * (seen[start][1] - y1)
    u2 = tx * (seen[end][0] - x1) + ty * (seen[end][1] - y1)
    if u1 == u2:
        return []
    rows: list[Row] = []
    for slot, u in enumerate((min(max(u1, 0.0), length), min(max(u2, 0.0), length))):
        share = (u - u1) / (u2 - u1)
        if not 0.0 <= share <= 1.0:
            continue
        ax, ay = local.corners[start]
        bx, by = local.corners[end]
        point = (ax + share * (bx - ax), ay + share * (by - ay))
        depth = nx * (seen[start][0] + share * (seen[end][0] - seen[start][0]) - x1) + ny * (
            seen[start][1] + share * (seen[end][1] - seen[start][1]) - y1
        )
        if depth <= margin:
            name = (pair.number, side + slot)
            rows.append(Row(FACE, name, bodies, (x1, y1), point, 0.0, (nx, ny), e=pair.e, mu=pair.mu))
    return rows


def _seen(corners: tuple[Vector, ...], of: int, by: int, pos: list[float], turns: Turns) -> list[Vector]:
    """Corners of body `of` in the frame of body `by`."""
    co, so = turns[of]
    cb, sb = turns[by]
    cosine, sine = cb * co + sb * so, cb * so - sb * co
    dx, dy = pos[3 * of] - pos[3 * by], pos[3 * of + 1] - pos[3 * by + 1]
    ox, oy = cb * dx + sb * dy, cb * dy - sb * dx
    return [(ox + cosine * x - sine * y, oy + sine * x + cosine * y) for x, y in corners]


def _widest(block: Solid, points: list[Vector]) -> tuple[float, int]:
    """The face of the block that the points keep farthest from, and how far."""
    best, face = -1e300, 0
    for k, ((x, y), (nx, ny)) in enumerate(zip(block.corners, block.normals, strict=True)):
        nearest = min([nx * px + ny * py for px, py in points]) - nx * x - ny * y
        if nearest > best:
            best, face = nearest, k
    return best, face


def _opposed(points: list[Vector], nx: float, ny: float) -> tuple[int, int]:
    """The edge of the points whose outward normal looks most against (nx, ny)."""
    best, edge = 1e300, (0, 1)
    count = len(points)
    for k in range(count):
        (x1, y1), (x2, y2) = points[k], points[(k + 1) % count]
        length = hypot(x2 - x1, y2 - y1) or 1.0
        facing = ((y2 - y1) * nx + (x1 - x2) * ny) / length
        if facing < best:
            best, edge = facing, (k, (k + 1) % count)
    return edge
