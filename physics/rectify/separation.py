"""How far apart two solids are, and which way. Page units, y down; polygons are taken as convex."""

from __future__ import annotations

from math import hypot

import numpy as np

from sketch.geometry import nearest_on_boundary, nearest_on_segment, signed_area, signed_distance
from sketch.ink import FloatArray
from sketch.shapes import Circle, Point, Polygon, Solid

FLUSH = 1e-9
"""Page units: nearer than this, the minimum-distance vector has no direction of its own."""


def apart(one: Solid, other: Solid) -> tuple[float, Point]:
    """(gap, unit direction from `one` to `other`): the gap, negative for an overlap, is what `other`
    must be moved by against the direction so that the two just touch.

    Circles: along the line of centres; otherwise along the minimum-distance vector, or, for an overlap,
    across the face that it takes least to leave by.
    """
    if isinstance(one, Circle) and isinstance(other, Circle):
        dx, dy = other.centre[0] - one.centre[0], other.centre[1] - one.centre[1]
        distance = hypot(dx, dy)
        direction = (dx / distance, dy / distance) if distance > 0 else (0.0, -1.0)
        return distance - one.radius - other.radius, direction
    if isinstance(one, Polygon) and isinstance(other, Polygon):
        return _blocks(one.vertices, other.vertices)
    if isinstance(other, Circle):
        assert isinstance(one, Polygon)
        return _block_to_circle(one, other)
    gap, (x, y) = apart(other, one)
    return gap, (-x, -y)


def outward(vertices: FloatArray) -> FloatArray:
    """Unit normals of the edges, (n, 2), edge k from vertex k to the next."""
    steps = np.roll(vertices, -1, axis=0) - vertices
    lengths = np.maximum(np.hypot(steps[:, 0], steps[:, 1]), 1e-300)
    side = 1.0 if signed_area(vertices) > 0 else -1.0
    return side * np.column_stack([steps[:, 1], -steps[:, 0]]) / lengths[:, None]


def _block_to_circle(block: Polygon, circle: Circle) -> tuple[float, Point]:
    distance = signed_distance(block, circle.centre)
    if distance > FLUSH:
        foot = nearest_on_boundary(block, circle.centre)
        x, y = circle.centre[0] - foot[0], circle.centre[1] - foot[1]
        length = hypot(x, y)
        return distance - circle.radius, (x / length, y / length)
    normals = outward(block.vertices)
    depths = np.einsum("ij,ij->i", normals, np.asarray(circle.centre) - block.vertices)
    face = int(np.argmax(depths))
    return float(depths[face]) - circle.radius, (float(normals[face, 0]), float(normals[face, 1]))


def _blocks(one: FloatArray, other: FloatArray) -> tuple[float, Point]:
    best, direction = -np.inf, np.array([0.0, -1.0])
    for block, seen, sign in ((one, other, 1.0), (other, one, -1.0)):
        normals = outward(block)
        gaps = (seen @ normals.T).min(axis=0) - np.einsum("ij,ij->i", normals, block)
        face = int(np.argmax(gaps))
        if gaps[face] > best:
            best, direction = float(gaps[face]), sign * normals[face]
    if best > FLUSH:
        step = _nearest(one, other)
        distance = float(np.hypot(*step))
        # Face to face the two agree, up to rounding; the face's normal has no rounding in it.
        if distance > best * (1 + 1e-9) + FLUSH:
            best, direction = distance, step / distance
    return best, (float(direction[0]), float(direction[1]))


def _nearest(one: FloatArray, other: FloatArray) -> FloatArray:
    """The shortest step from a point of `one` to a point of `other`, (2,)."""
    steps: list[FloatArray] = []
    for block, points, sign in ((one, other, 1.0), (other, one, -1.0)):
        for start, end in zip(block, np.roll(block, -1, axis=0), strict=True):
            steps += [sign * (point - nearest_on_segment(start, end, point)) for point in points]
    return min(steps, key=lambda step: float(step @ step))
