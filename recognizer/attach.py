"""What belongs to what: link ends to solids, taps to solids, anchors to components.

Frame: page units, y down. Distances are judged against the sizes of the things themselves, so
that the page's scale is no matter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely

from sketch.geometry import contains, nearest_on_segment, signed_distance, solid_area
from sketch.ink import FloatArray, Stroke
from sketch.page import Component
from sketch.shapes import Circle, Link, Point, Polygon, Solid, Spring, Wire, outline


@dataclass(frozen=True, slots=True)
class AttachRule:
    """How near is attached."""

    of_link: float = 0.12
    """Gap over the link's length: people stop a tenth short of what they draw towards."""
    of_solid: float = 0.12
    """Gap over the square root of the solid's area: a gap that large shows as one."""
    tap: float = 0.04
    """A tap may miss a solid by this share of the square root of its area: a few units on a page."""


ATTACH = AttachRule()


class Solids:
    """The page's solids, indexed so that a search looks at the near ones only."""

    def __init__(self, shapes: Sequence[Solid], drawn: Sequence[Sequence[Stroke]] = ()) -> None:
        """drawn: the strokes of each solid, in step; a link is drawn to the ink as well as to the shape."""
        self.shapes = tuple(shapes)
        self.ink = [
            shapely.GeometryCollection([_line(stroke.points) for stroke in strokes]) for strokes in drawn
        ]
        self.sizes = np.sqrt([solid_area(shape) for shape in self.shapes])
        reach = max(ATTACH.tap, ATTACH.of_solid) * self.sizes
        boxes = [_box(shape) for shape in self.shapes]
        for box, line in zip(boxes, self.ink, strict=False):
            left, top, right, bottom = line.bounds
            box[:2], box[2:] = np.minimum(box[:2], (left, top)), np.maximum(box[2:], (right, bottom))
        corners = np.array(boxes).reshape(-1, 4) + reach[:, None] * np.array([-1.0, -1.0, 1.0, 1.0])
        self._tree = shapely.STRtree(shapely.box(*corners.T)) if boxes else shapely.STRtree([])

    def near(self, point: Point, reach: float = 0.0) -> list[tuple[float, int]]:
        """(signed distance, index) of the solids that may lie within reach, nearest first."""
        x, y = point
        found = self._tree.query(shapely.box(x - reach, y - reach, x + reach, y + reach))
        return sorted((signed_distance(self.shapes[index], point), index) for index in found.tolist())

    def holds(self, point: FloatArray) -> bool:
        """Whether the point, (2,), lies in a solid."""
        near = self.near((float(point[0]), float(point[1])))
        return bool(near) and near[0][0] <= 0

    def at_end(self, link: Link, end: Point) -> list[int]:
        """Indices of the solids to which this end of a link can be attached, the likeliest first:
        by the distance to the boundary or to its ink, whether the pen stopped short or ran inside."""
        length = float(np.hypot(link.end[0] - link.start[0], link.end[1] - link.start[1]))
        close: list[tuple[float, int]] = []
        for distance, index in self.near(end, ATTACH.of_link * length):
            away = abs(distance)
            if self.ink:
                away = min(away, self.ink[index].distance(shapely.Point(end)))
            if min(distance, away) <= max(ATTACH.of_link * length, ATTACH.of_solid * self.sizes[index]):
                close.append((away, index))
        return [index for _, index in sorted(close)]

    def ends(self, link: Link) -> tuple[int, int] | None:
        """The two different solids that a link connects (start, end); None where an end hangs free."""
        for first in (start := self.at_end(link, link.start)):
            for last in self.at_end(link, link.end):
                if first != last and (first == start[0] or last != start[0]):
                    return first, last
        return None

    def tapped(self, point: Point) -> int | None:
        """The solid that a tap means: the smallest that contains it, else the nearest within reach."""
        near = [
            (distance, index)
            for distance, index in self.near(point)
            if distance <= ATTACH.tap * self.sizes[index]
        ]
        inside = [index for distance, index in near if distance <= 0]
        if inside:
            return min(inside, key=lambda index: float(self.sizes[index]))
        return near[0][1] if near else None


def anchored(components: Sequence[Component], anchor: Point) -> Component | None:
    """The component that an anchor means: the smallest solid that contains it, else the component
    whose line lies nearest; None on a page without components."""
    holding = [
        (solid_area(component.shape), component)
        for component in components
        if isinstance(component.shape, Circle | Polygon) and contains(component.shape, anchor)
    ]
    links = [component for component in components if isinstance(component.shape, Spring | Wire)]
    touching = [component for component in links if _from_outline(component, anchor) == 0]
    if touching:
        return touching[0]
    if holding:
        return min(holding, key=lambda pair: pair[0])[1]
    return min(components, key=lambda component: _from_outline(component, anchor), default=None)


def _from_outline(component: Component, point: Point) -> float:
    path, target = outline(component.shape), np.asarray(point, dtype=float)
    feet = [nearest_on_segment(a, b, target) for a, b in pairwise(path)]
    return min(float(np.hypot(*(foot - target))) for foot in feet)


def _box(shape: Solid) -> FloatArray:
    path = outline(shape)
    return np.concatenate([path.min(axis=0), path.max(axis=0)])


def _line(points: FloatArray) -> shapely.LineString | shapely.Point:
    return shapely.LineString(points) if np.ptp(points, axis=0).any() else shapely.Point(points[0])
