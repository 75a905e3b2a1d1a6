"""Plane geometry of polylines, as functions of (n, 2) arrays in page units.

Turning is positive where a path bends from +x towards +y, which on a page (y down) is
clockwise to the eye.
"""

from __future__ import annotations

from math import hypot, inf

import numpy as np

from sketch.ink import FloatArray
from sketch.shapes import Circle, Point, Polygon, Solid


def distinct(points: FloatArray, tolerance: float = 0.0) -> FloatArray:
    """The path without points that lie within `tolerance` of the one before; (m, 2), m >= 1."""
    steps = points[1:] - points[:-1]
    kept = np.ones(len(points), dtype=bool)
    kept[1:] = np.hypot(steps[:, 0], steps[:, 1]) > tolerance
    return points[kept]


def arc_lengths(points: FloatArray) -> FloatArray:
    """Distance travelled from the first point to each point, (n,)."""
    steps = points[1:] - points[:-1]
    travelled = np.zeros(len(points))
    np.cumsum(np.hypot(steps[:, 0], steps[:, 1]), out=travelled[1:])
    return travelled


def path_length(points: FloatArray) -> float:
    """Length of the polyline; 0 for a single point."""
    return float(arc_lengths(points)[-1])


def resample(points: FloatArray, count: int) -> FloatArray:
    """`count` >= 2 points at equal spacing along the path, ends kept: (count, 2).

    A path of no length gives `count` copies of its first point.
    """
    travelled = arc_lengths(points)
    if travelled[-1] == 0:
        return np.repeat(points[:1], count, axis=0)
    wanted = np.arange(count) * (travelled[-1] / (count - 1))
    # As complex numbers both coordinates are interpolated in one pass.
    plane = np.ascontiguousarray(points, dtype=np.float64).view(np.complex128)[:, 0]
    even = np.interp(wanted, travelled, plane).view(np.float64).reshape(count, 2)
    even[-1] = points[-1]
    return even


def turning(points: FloatArray) -> FloatArray:
    """Signed exterior angle at each inner point, radians in (−π, π]: (n − 2,); 0 at repeats."""
    steps = np.diff(points, axis=0)
    before, after = steps[:-1], steps[1:]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.arctan2(cross, np.einsum("ij,ij->i", before, after))


def closure(points: FloatArray) -> float:
    """Distance between the ends as a fraction of the path's length: 0 closed, 1 straight.

    A path of no length counts as closed.
    """
    length = path_length(points)
    return float(np.linalg.norm(points[-1] - points[0])) / length if length > 0 else 0.0


def self_intersections(points: FloatArray) -> FloatArray:
    """Where a polyline properly crosses itself: (k, 2), each row the positions (i + s, j + t) of
    a crossing of segment i at s with segment j at t, i < j, ordered by i.

    Neighbouring segments and those that only touch end to end do not count. Work and memory grow
    with n²; resample long strokes first.
    """
    if len(points) < 4:
        return np.empty((0, 2))
    start, step = points[:-1], np.diff(points, axis=0)
    first, second = np.triu_indices(len(step), k=2)
    offset = start[second] - start[first]
    along, across = step[first], step[second]
    determinant = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (offset[:, 0] * across[:, 1] - offset[:, 1] * across[:, 0]) / determinant
        t = (offset[:, 0] * along[:, 1] - offset[:, 1] * along[:, 0]) / determinant
    hit = (determinant != 0) & (s >= 0) & (s < 1) & (t >= 0) & (t < 1)
    return np.column_stack([first[hit] + s[hit], second[hit] + t[hit]])


def bounding_box(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(low, high) corners, each (2,)."""
    return points.min(axis=0), points.max(axis=0)


def diagonal(points: FloatArray) -> float:
    """Length of the bounding box's diagonal: a stroke's size."""
    low, high = bounding_box(points)
    return float(np.linalg.norm(high - low))


def signed_area(vertices: FloatArray) -> float:
    """Shoelace area; positive when the vertices turn from +x towards +y."""
    x, y = vertices[:, 0], vertices[:, 1]
    around = x[:-1] @ y[1:] - y[:-1] @ x[1:]
    return 0.5 * float(around + x[-1] * y[0] - y[-1] * x[0])


def centroid(vertices: FloatArray) -> FloatArray:
    """Centre of area of a simple polygon, (2,); the vertices' mean if it has no area."""
    area = signed_area(vertices)
    low, high = bounding_box(vertices)
    if abs(area) <= 1e-12 * float(np.prod(high - low) + 1e-300):
        return vertices.mean(axis=0)
    origin = vertices[0]
    here, there = vertices - origin, np.roll(vertices, -1, axis=0) - origin
    cross = here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]
    return origin + ((here + there) * cross[:, None]).sum(axis=0) / (6 * area)


def solid_area(shape: Solid) -> float:
    """Area in square page units, never negative."""
    if isinstance(shape, Circle):
        return float(np.pi) * shape.radius**2
    return abs(signed_area(shape.vertices))


def nearest_on_segment(start: FloatArray, end: FloatArray, point: FloatArray) -> FloatArray:
    """The point of segment start-end nearest to `point`, (2,)."""
    along = end - start
    length2 = float(along @ along)
    share = 0.0 if length2 == 0 else float(np.clip((point - start) @ along / length2, 0.0, 1.0))
    return start + share * along


def nearest_on_boundary(shape: Solid, point: Point) -> Point:
    """The point of a solid's boundary nearest to `point` (its centre goes straight up)."""
    px, py = point
    if isinstance(shape, Circle):
        x, y = shape.centre
        distance = hypot(px - x, py - y)
        ux, uy = ((px - x) / distance, (py - y) / distance) if distance > 0 else (0.0, -1.0)
        return x + shape.radius * ux, y + shape.radius * uy
    # Polygons have few edges: plain floats are several times faster here than arrays.
    best, found = inf, (px, py)
    vertices = shape.vertices.tolist()
    for (x1, y1), (x2, y2) in zip(vertices, vertices[1:] + vertices[:1], strict=True):
        dx, dy = x2 - x1, y2 - y1
        length2 = dx * dx + dy * dy
        share = 0.0 if length2 == 0 else min(max(((px - x1) * dx + (py - y1) * dy) / length2, 0.0), 1.0)
        x, y = x1 + share * dx, y1 + share * dy
        distance = hypot(x - px, y - py)
        if distance < best:
            best, found = distance, (x, y)
    return found


def contains(shape: Solid, point: Point) -> bool:
    """Whether the point lies inside the solid or on its boundary (even-odd rule)."""
    x, y = point
    if isinstance(shape, Circle):
        return float(np.hypot(x - shape.centre[0], y - shape.centre[1])) <= shape.radius
    if nearest_on_boundary(shape, point) == (x, y):
        return True
    inside = False
    vertices = shape.vertices.tolist()
    for (x1, y1), (x2, y2) in zip(vertices, vertices[1:] + vertices[:1], strict=True):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) * (x2 - x1) / (y2 - y1):
            inside = not inside
    return inside


def signed_distance(shape: Solid, point: Point) -> float:
    """Distance from the point to the solid's boundary, negative inside; page units."""
    foot = nearest_on_boundary(shape, point)
    distance = float(np.hypot(point[0] - foot[0], point[1] - foot[1]))
    return -distance if contains(shape, point) else distance


def polygon_of(shape: Solid, steps: int = 64) -> FloatArray:
    """Vertices of the solid, (n, 2): a polygon's own, a circle's `steps`-gon."""
    if isinstance(shape, Polygon):
        return shape.vertices
    angle = np.arange(steps) * (2 * np.pi / steps)
    return np.asarray(shape.centre) + shape.radius * np.column_stack([np.cos(angle), np.sin(angle)])
