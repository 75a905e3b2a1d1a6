"""Shapes as pieces of SVG, for a page and for the frames of a motion alike.

Frame: page units, y down, as SVG has it. A piece is text to be put inside an <svg> element; it refers to
nothing outside itself (no ids), so that many pictures fit into one document.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, assert_never
from xml.sax.saxutils import escape

import numpy as np

from sketch.geometry import centroid, polygon_of
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Arrow, Circle, ComponentKind, Link, Point, Polygon, Shape, Solid, Spring, Wire

COLOURS: dict[ComponentKind, str] = {
    "circle": "#0072B2",
    "polygon": "#D55E00",
    "spring": "#009E73",
    "wire": "#8C5A9E",
    "arrow": "#B58900",
}
"""After Okabe and Ito's palette, which colour-blind people tell apart; yellow and pink darkened for white paper."""

_MOST_COILS = 200
"""Drawn at most; more would be a solid bar."""
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


@dataclass(frozen=True, slots=True)
class Pen:
    """How fine to draw. unit: page units of one "point" (a thin line's width): pictures of large and small
    pages then look alike; places: decimals that coordinates are written with."""

    unit: float

    @property
    def places(self) -> int:
        return max(0, min(12, 2 - math.floor(math.log10(self.unit))))

    def number(self, value: float) -> str:
        text = f"{value:.{self.places}f}"
        return text.rstrip("0").rstrip(".") if "." in text else text

    def path(self, points: FloatArray | Sequence[Point]) -> str:
        """`M x y L x y …`, a single point doubled so that round caps make it a dot."""
        rows = [f"{self.number(x)} {self.number(y)}" for x, y in np.asarray(points).tolist()]
        return "M" + "L".join(rows if len(rows) > 1 else rows * 2)


@dataclass(frozen=True, slots=True)
class Pose:
    """A rigid motion of a solid: turned by `rotation` about its centre of area, then shifted.

    dx, dy: page units; rotation: radians from +x towards +y, clockwise to the eye.
    """

    dx: float = 0.0
    dy: float = 0.0
    rotation: float = 0.0


def posed(shape: Solid, pose: Pose) -> Solid:
    """The solid where the pose puts it."""
    match shape:
        case Circle((x, y), radius):
            return Circle((x + pose.dx, y + pose.dy), radius)
        case Polygon():
            middle = centroid(shape.vertices)
            cos, sin = math.cos(pose.rotation), math.sin(pose.rotation)
            turned = (shape.vertices - middle) @ np.array([[cos, sin], [-sin, cos]])
            return Polygon(turned + middle + [pose.dx, pose.dy])
        case _:
            assert_never(shape)


def draw_shapes(
    components: Iterable[Component],
    pen: Pen,
    poses: Mapping[str, Pose] | None = None,
    ends: Mapping[str, tuple[Point, Point]] | None = None,
    names: bool = True,
) -> str:
    """The components as SVG, links below solids.

    poses: by label, where a solid has moved to; a circle then shows a spoke, so that its turning is seen;
    ends: by label, where a link's ends are now; names: whether labels are written.
    """
    placed = [_placed(component, poses or {}, ends or {}) for component in components]
    placed.sort(key=lambda component: isinstance(component.shape, Circle | Polygon))
    return "\n".join(
        _component(component, pen, (poses or {}).get(component.label), names) for component in placed
    )


def draw_path(
    points: FloatArray | Sequence[Point], pen: Pen, colour: str, width: float = 1.0, dots: bool = False
) -> str:
    """A polyline; width in points; dots: dotted instead of drawn through."""
    dashes = f' stroke-dasharray="0 {pen.number(3 * pen.unit)}"' if dots else ""
    return (
        f'<path d="{pen.path(points)}" fill="none" stroke="{colour}" stroke-width="{pen.number(width * pen.unit)}" '
        f'stroke-linecap="round" stroke-linejoin="round"{dashes}/>'
    )


def draw_text(
    text: str,
    at: Point,
    pen: Pen,
    colour: str,
    size: float = 9.0,
    note: str | None = None,
    anchor: Literal["start", "middle"] = "middle",
) -> str:
    """A line of text that begins at a point or is centred on it, with a white rim so that it can be read
    over lines; size in points; note: what hovering over it tells."""
    title = f"<title>{xml_text(note)}</title>" if note else ""
    return (
        f'<text x="{pen.number(at[0])}" y="{pen.number(at[1])}" dy="0.35em" text-anchor="{anchor}" '
        f'font-family="serif" font-style="italic" font-size="{pen.number(size * pen.unit)}" fill="{colour}" '
        f'stroke="#ffffff" stroke-width="{pen.number(2.4 * pen.unit)}" stroke-linejoin="round" '
        f'paint-order="stroke">{title}{xml_text(text)}</text>'
    )


def xml_text(text: str) -> str:
    """Any text as XML character data; characters that XML has not become U+FFFD."""
    return escape(_NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text), {'"': "&quot;"})


def _placed(
    component: Component, poses: Mapping[str, Pose], ends: Mapping[str, tuple[Point, Point]]
) -> Component:
    match component.shape:
        case Circle() | Polygon() as solid:
            return replace(component, shape=posed(solid, poses.get(component.label, Pose())))
        case Spring() | Wire() | Arrow() as link:
            start, end = ends.get(component.label, (link.start, link.end))
            return (
                component if start == end else replace(component, shape=replace(link, start=start, end=end))
            )
        case _:
            assert_never(component.shape)


def _component(component: Component, pen: Pen, pose: Pose | None, names: bool) -> str:
    colour = COLOURS[component.kind]
    told = f"{component.label}: {component.kind}{', fixed' if component.fixed else ''}"
    parts = [f"<g><title>{xml_text(told)}</title>", _shape(component, colour, pen)]
    if isinstance(component.shape, Circle) and pose is not None:
        parts.append(draw_path([component.shape.centre, _rim(component.shape, pose.rotation)], pen, colour))
    if names:
        parts.append(draw_text(component.label, _label_at(component.shape, pen), pen, colour, size=8.0))
    return "".join([*parts, "</g>"])


def _shape(component: Component, colour: str, pen: Pen) -> str:
    match component.shape:
        case Circle((x, y), radius) as circle:
            at = f'cx="{pen.number(x)}" cy="{pen.number(y)}" r="{pen.number(radius)}"'
            return f"<circle {at} {_body(colour, pen)}/>" + (
                _hatch(circle, colour, pen) if component.fixed else ""
            )
        case Polygon() as polygon:
            outline = f'<path d="{pen.path(polygon.vertices)}Z" {_body(colour, pen)}/>'
            return outline + (_hatch(polygon, colour, pen) if component.fixed else "")
        case Spring() as spring:
            return draw_path(coil(spring), pen, colour, 1.5) + _ends(spring, component.ends, colour, pen)
        case Wire() as wire:
            return draw_path([wire.start, wire.end], pen, colour, 1.5) + _ends(
                wire, component.ends, colour, pen
            )
        case Arrow() as arrow:
            return draw_path([arrow.start, arrow.end], pen, colour, 1.5) + draw_path(
                _head(arrow, pen), pen, colour, 1.5
            )
        case _:
            assert_never(component.shape)


def _body(colour: str, pen: Pen) -> str:
    return (
        f'fill="{colour}" fill-opacity="0.1" stroke="{colour}" stroke-width="{pen.number(1.5 * pen.unit)}" '
        'stroke-linejoin="round"'
    )


def coil(spring: Spring) -> FloatArray:
    """A zig-zag with the spring's coils and width between straight leads, (n, 2) page units."""
    start, along = np.array(spring.start), np.subtract(spring.end, spring.start)
    length = float(np.hypot(*along))
    across = np.array([-along[1], along[0]]) / length * spring.width / 2
    teeth = 2 * int(min(max(round(spring.coils), 1), _MOST_COILS))
    share = np.concatenate([[0.0, 0.1], 0.1 + 0.8 * (np.arange(teeth) + 0.5) / teeth, [0.9, 1.0]])
    side = np.concatenate([[0.0, 0.0], 1.0 - 2.0 * (np.arange(teeth) % 2), [0.0, 0.0]])
    return start + share[:, None] * along + side[:, None] * across


def _hatch(shape: Solid, colour: str, pen: Pen) -> str:
    """Slanted lines inside a fixed solid, every few points and at most a hundred."""
    vertices = polygon_of(shape)
    slant = np.array([[1.0, 1.0], [-1.0, 1.0]]) / math.sqrt(2)
    turned = vertices @ slant.T
    low, high = float(turned[:, 1].min()), float(turned[:, 1].max())
    gap = max(5 * pen.unit, (high - low) / 100)
    lines: list[str] = []
    for level in np.arange(low + gap / 2, high, gap).tolist():
        crossings = _crossings(turned, level)
        for first, last in zip(crossings[::2], crossings[1::2], strict=False):
            lines.append(pen.path(np.array([[first, level], [last, level]]) @ slant))
    width = pen.number(0.6 * pen.unit)
    return (
        f'<path d="{"".join(lines)}" stroke="{colour}" stroke-width="{width}" fill="none"/>' if lines else ""
    )


def _crossings(vertices: FloatArray, level: float) -> list[float]:
    """Where a polygon's edges cross the line y = level: x of each, ascending."""
    ends = np.roll(vertices, -1, axis=0)
    crosses = (vertices[:, 1] > level) != (ends[:, 1] > level)
    a, b = vertices[crosses], ends[crosses]
    found = a[:, 0] + (level - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return sorted(found.tolist())


def _ends(link: Link, attached: tuple[str | None, str | None], colour: str, pen: Pen) -> str:
    """A dot at each end: full where it is attached, open where it hangs free."""
    fills = (colour if label is not None else "#ffffff" for label in attached)
    return "".join(
        f'<circle cx="{pen.number(x)}" cy="{pen.number(y)}" r="{pen.number(2 * pen.unit)}" fill="{fill}" '
        f'stroke="{colour}" stroke-width="{pen.number(pen.unit)}"/>'
        for (x, y), fill in zip((link.start, link.end), fills, strict=True)
    )


def _head(arrow: Arrow, pen: Pen) -> FloatArray:
    """The barbs: a third of the arrow's length, at most eight points, 25° to either side."""
    back = np.subtract(arrow.start, arrow.end)
    length = float(np.hypot(*back))
    back = back / length * min(8 * pen.unit, length / 3)
    cos, sin = math.cos(math.radians(25)), math.sin(math.radians(25))
    turn = np.array([[cos, -sin], [sin, cos]])
    return np.array([arrow.end + turn @ back, arrow.end, arrow.end + turn.T @ back])


def _rim(circle: Circle, angle: float) -> Point:
    return (
        circle.centre[0] + circle.radius * math.cos(angle),
        circle.centre[1] + circle.radius * math.sin(angle),
    )


def _label_at(shape: Shape, pen: Pen) -> Point:
    """In the middle of a solid, beside the middle of a link."""
    match shape:
        case Circle(centre, _):
            return centre
        case Polygon():
            x, y = centroid(shape.vertices).tolist()
            return (x, y)
        case Spring() | Wire() | Arrow():
            middle = np.add(shape.start, shape.end) / 2
            along = np.subtract(shape.end, shape.start)
            aside = np.array([along[1], -along[0]]) / float(np.hypot(*along))
            reach = 7 * pen.unit + (shape.width / 2 if isinstance(shape, Spring) else 0.0)
            x, y = (middle + aside * reach).tolist()
            return (x, y)
        case _:
            assert_never(shape)
