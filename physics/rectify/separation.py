"""How far apart two solids are, and which way. Page units, y down; polygons are taken as convex.

A solid's `Outline` is its boundary in plain floats, from a first corner and in a sense that do not
depend on how it was drawn: a page is compared pair by pair, and arrays of four points are slower than
their arithmetic.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import hypot, pi, sqrt

from sketch.shapes import Circle, Point, Solid

FLUSH = 1e-9
"""Page units: nearer than this, the minimum-distance vector has no direction of its own."""
SURE = 1e-3
"""Page units: far more than rounding makes of heights on the largest page."""


@dataclass(frozen=True, slots=True)
class Outline:
    """corners: of a block, clockwise to the eye, from the leftmost, () for a disc; normals: outwards, of the
    side from each corner to the next; centre: a disc's, a block's mean corner; radius: a disc's, or 0;
    low, high: its box; size: the root of its area."""

    corners: tuple[Point, ...]
    normals: tuple[Point, ...]
    centre: Point
    radius: float
    low: Point
    high: Point
    size: float

    def shifted(self, dx: float, dy: float) -> Outline:
        """The outline moved by (dx, dy)."""
        return Outline(
            tuple((x + dx, y + dy) for x, y in self.corners),
            self.normals,
            (self.centre[0] + dx, self.centre[1] + dy),
            self.radius,
            (self.low[0] + dx, self.low[1] + dy),
            (self.high[0] + dx, self.high[1] + dy),
            self.size,
        )


@lru_cache(maxsize=1024)  # every step of a correction asks for those of all solids
def outline_of(solid: Solid) -> Outline:
    """A solid's outline."""
    if isinstance(solid, Circle):
        (x, y), r = solid.centre, solid.radius
        return Outline((), (), (x, y), r, (x - r, y - r), (x + r, y + r), sqrt(pi) * r)
    drawn: list[Point] = [(x, y) for x, y in solid.vertices.tolist()]
    twice = sum(x1 * y2 - x2 * y1 for (x1, y1), (x2, y2) in pairwise([*drawn, drawn[0]]))
    if twice < 0:
        drawn.reverse()
    first = drawn.index(min(drawn))
    corners = tuple(drawn[first:] + drawn[:first])
    normals: list[Point] = []
    for (x1, y1), (x2, y2) in pairwise([*corners, corners[0]]):
        length = hypot(x2 - x1, y2 - y1) or 1e-300
        normals.append(((y2 - y1) / length, (x1 - x2) / length))
    xs, ys = [x for x, _ in corners], [y for _, y in corners]
    centre = (sum(xs) / len(xs), sum(ys) / len(ys))
    return Outline(
        corners, tuple(normals), centre, 0.0, (min(xs), min(ys)), (max(xs), max(ys)), sqrt(abs(twice) / 2)
    )


def apart(one: Solid, other: Solid) -> tuple[float, Point]:
    """(gap, unit direction from `one` to `other`): the gap, negative for an overlap, is what `other`
    must be moved by against the direction so that the two just touch.

    Circles: along the line of centres; otherwise along the minimum-distance vector, or, for an overlap,
    across the face that it takes least to leave by.
    """
    return separation(outline_of(one), outline_of(other))


def separation(one: Outline, other: Outline) -> tuple[float, Point]:
    """`apart` of two outlines."""
    if other.corners:
        if one.corners:
            return _blocks(one, other)
        gap, (x, y) = _block_to_disc(other, one)
        return gap, (-x, -y)
    if one.corners:
        return _block_to_disc(one, other)
    dx, dy = other.centre[0] - one.centre[0], other.centre[1] - one.centre[1]
    distance = hypot(dx, dy)
    direction = (dx / distance, dy / distance) if distance > 0 else (0.0, -1.0)
    return distance - one.radius - other.radius, direction


def boxes_apart(one: Outline, other: Outline) -> float:
    """A lower bound of the gap, quickly: of the boxes around them; negative or zero where those meet."""
    return max(
        other.low[0] - one.high[0],
        one.low[0] - other.high[0],
        other.low[1] - one.high[1],
        one.low[1] - other.high[1],
    )


def nearest(outline: Outline, point: Point) -> Point:
    """The point of a solid's boundary nearest to a point (a disc's centre goes straight up)."""
    if outline.corners:
        feet = [_foot(start, end, point) for start, end in _sides(outline.corners)]
        return min(feet, key=lambda foot: hypot(foot[0] - point[0], foot[1] - point[1]))
    (cx, cy), radius = outline.centre, outline.radius
    x, y = point[0] - cx, point[1] - cy
    distance = hypot(x, y)
    return (cx + radius * x / distance, cy + radius * y / distance) if distance > 0 else (cx, cy - radius)


def _block_to_disc(block: Outline, disc: Outline) -> tuple[float, Point]:
    (cx, cy), corners = disc.centre, block.corners
    best, face = -1e300, 0
    for k, ((x, y), (nx, ny)) in enumerate(zip(corners, block.normals, strict=True)):
        height = nx * (cx - x) + ny * (cy - y)
        if height > best:
            best, face = height, k
    if best > FLUSH and not _over(block, face, disc.centre):
        foot_x, foot_y = min(
            (_foot(one, other, disc.centre) for one, other in _sides(corners)),
            key=lambda foot: hypot(cx - foot[0], cy - foot[1]),
        )
        x, y = cx - foot_x, cy - foot_y
        distance = hypot(x, y)
        if distance > 0:  # on the boundary of a hollow it is zero
            return distance - disc.radius, (x / distance, y / distance)
    return best - disc.radius, block.normals[face]


def _blocks(one: Outline, other: Outline) -> tuple[float, Point]:
    best, direction, over = -1e300, (0.0, -1.0), False
    for block, seen, sign in ((one, other, 1.0), (other, one, -1.0)):
        cx, cy = seen.centre
        for k, ((x, y), (nx, ny)) in enumerate(zip(block.corners, block.normals, strict=True)):
            if nx * (cx - x) + ny * (cy - y) < best - SURE:
                continue  # the mean corner is no lower than the lowest
            heights = [nx * px + ny * py for px, py in seen.corners]
            lowest = min(heights)
            gap = lowest - (nx * x + ny * y)
            # Of two faces that face each other, the one that the other's corner is over tells more.
            if gap > best or (gap > FLUSH and not over and gap >= best * (1 - 1e-12)):
                best, direction = max(gap, best), (sign * nx, sign * ny)
                over = gap > FLUSH and _over(block, k, seen.corners[heights.index(lowest)])
    if best > FLUSH and not over:
        x, y = _nearest(one, other)
        distance = hypot(x, y)
        if distance > best * (1 + 1e-12) + FLUSH:
            return distance, (x / distance, y / distance)
    return best, direction


def _over(block: Outline, face: int, point: Point) -> bool:
    """Whether a point outside a face lies straight above it: then its distance is that to the face, without
    the rounding of a quotient."""
    (x, y), (nx, ny) = block.corners[face], block.normals[face]
    u, v = block.corners[(face + 1) % len(block.corners)]
    along = -ny * (point[0] - x) + nx * (point[1] - y)
    return 0 <= along <= -ny * (u - x) + nx * (v - y)


def _nearest(one: Outline, other: Outline) -> Point:
    """The shortest step from a point of `one` to a point of `other`, which lie apart."""
    best, step = 1e300, (0.0, 0.0)
    for block, seen, sign in ((one, other, 1.0), (other, one, -1.0)):
        for start, end in _sides(block.corners):
            for x, y in seen.corners:
                foot = _foot(start, end, (x, y))
                dx, dy = x - foot[0], y - foot[1]
                if dx * dx + dy * dy < best:
                    best, step = dx * dx + dy * dy, (sign * dx, sign * dy)
    return step


def _sides(corners: tuple[Point, ...]) -> list[tuple[Point, Point]]:
    return list(zip(corners, (*corners[1:], corners[0]), strict=True))


def _foot(start: Point, end: Point, point: Point) -> Point:
    """The point of a segment nearest to `point`."""
    ex, ey = end[0] - start[0], end[1] - start[1]
    length2 = ex * ex + ey * ey
    share = 0.0 if length2 == 0 else ((point[0] - start[0]) * ex + (point[1] - start[1]) * ey) / length2
    share = min(1.0, max(0.0, share))
    return start[0] + share * ex, start[1] + share * ey
