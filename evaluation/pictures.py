"""Pictures of a motion: moments side by side as SVG, and an animation as GIF.

Both draw the same marks: what stands where at an instant. Frame: page units, y down.
"""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from typing import Literal, assert_never

import numpy as np
from PIL import Image, ImageDraw

from data_gen.ideals import arrow, zigzag
from evaluation.frames import Frame, frames, view
from evaluation.parallel import Progress, silent
from physics.pipeline import Motion
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Arrow, Circle, Polygon, Spring, Wire, outline

Role = Literal["fixed", "movable", "spring", "wire", "arrow", "spoke", "trail"]


@dataclass(frozen=True, slots=True)
class Pen:
    """stroke and fill: colours (fill "" for none); width: as a share of the picture's width."""

    stroke: str
    width: float
    fill: str = ""


PENS: dict[Role, Pen] = {
    "fixed": Pen("#6b665d", 0.005, "#ddd8cc"),
    "movable": Pen("#2763a8", 0.008, "#d6e4f5"),
    "spring": Pen("#3b8c62", 0.006),
    "wire": Pen("#a8702a", 0.006),
    "arrow": Pen("#8a5bb0", 0.006),
    "spoke": Pen("#2763a8", 0.005),
    "trail": Pen("#9dbfe6", 0.005),
}


@dataclass(frozen=True, slots=True)
class Mark:
    """A polyline, (n, 2) page units, and what it stands for; solids are closed and filled."""

    role: Role
    points: FloatArray


@dataclass(frozen=True, slots=True)
class PictureLayout:
    """Sizes of strips and animations."""

    moments: int = 5
    """Frames in a strip: start, end, and enough between to see a bounce."""
    gap: float = 0.04
    """Between frames, as a share of a frame's width."""
    caption: float = 0.1
    """Height of the line that tells the time, as a share of a frame's width."""
    pixels: int = 480
    """Width of an animation."""
    oversampling: int = 2
    """Drawn so many times larger and reduced: PIL does not smooth its lines."""
    step: float = 0.04
    """Seconds between two frames of an animation: what every viewer of GIF can show."""
    hold: float = 1.0
    """Seconds for which the last frame stays."""
    most: int = 1500
    """Frames of an animation, at most: a minute's."""


LAYOUT = PictureLayout()
PAPER = "#ffffff"


def strip(motion: Motion, seconds: float, layout: PictureLayout = LAYOUT) -> str:
    """SVG of moments from the start to `seconds`, side by side, each with its time and with the way
    that every moving body has come."""
    shown = frames(motion, seconds, layout.moments)
    left, top, wide, high = view(shown)
    advance = wide * (1 + layout.gap)
    full = advance * (len(shown) - 1) + wide
    tall = high + layout.caption * wide
    parts = [
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="strip" viewBox="0 0 {full:.1f} {tall:.1f}" role="img" '
            f'aria-label="{len(shown)} moments of the motion" font-family="system-ui, sans-serif">'
        ),
        f'<rect width="{full:.1f}" height="{tall:.1f}" fill="{PAPER}"/>',
    ]
    for k, one in enumerate(shown):
        x = k * advance
        parts.append(
            f'<svg x="{x:.1f}" width="{wide:.1f}" height="{high:.1f}" '
            f'viewBox="{left:.1f} {top:.1f} {wide:.1f} {high:.1f}">'
        )
        parts.extend(_svg_mark(mark, wide) for mark in marks(one))
        parts.append("</svg>")
        if k:
            edge = x - layout.gap * wide / 2
            parts.append(
                f'<line x1="{edge:.1f}" y1="0" x2="{edge:.1f}" y2="{tall:.1f}" stroke="#e4dfd4" '
                f'stroke-width="{0.006 * wide:.2f}"/>'
            )
        parts.append(
            f'<text x="{x + wide / 2:.1f}" y="{high + 0.72 * layout.caption * wide:.1f}" text-anchor="middle" '
            f'font-size="{0.6 * layout.caption * wide:.1f}" fill="#6d685f">{one.seconds:.2f} s</text>'
        )
    return "".join(parts) + "</svg>"


def animation(
    motion: Motion, seconds: float, progress: Progress = silent, layout: PictureLayout = LAYOUT
) -> bytes:
    """GIF of the motion from the start to `seconds`, in real time, over and over."""
    count = min(layout.most, max(2, round(seconds / layout.step) + 1))
    shown = frames(motion, seconds, count)
    box = view(shown)
    images: list[Image.Image] = []
    for k, one in enumerate(shown, start=1):
        images.append(_image(one, box, layout))
        progress("Drawing frames", k, count)
    pause = max(20, round(1000 * seconds / (count - 1)))
    stream = BytesIO()
    images[0].save(
        stream,
        format="GIF",
        save_all=True,
        append_images=images[1:],
        duration=[pause] * (count - 1) + [round(1000 * layout.hold)],
        loop=0,
    )
    return stream.getvalue()


def marks(one: Frame) -> list[Mark]:
    """What there is to draw, from the back to the front."""
    drawn = [Mark("trail", trail) for trail in one.trails if len(trail) > 1]
    drawn += [_mark(component) for component in sorted(one.components, key=lambda part: not part.fixed)]
    return drawn + [Mark("spoke", np.array(spoke)) for spoke in one.spokes]


def _mark(component: Component) -> Mark:
    match component.shape:
        case Circle() | Polygon():
            return Mark("fixed" if component.fixed else "movable", outline(component.shape, 48)[:-1])
        case Spring(start, end, coils, width):
            return Mark("spring", zigzag(start, end, max(2, round(2 * coils)), width))
        case Wire(start, end):
            return Mark("wire", np.array([start, end]))
        case Arrow(start, end):
            length = float(np.hypot(end[0] - start[0], end[1] - start[1]))
            return Mark("arrow", arrow(start, end, 0.15 * length, 0.5))
        case _:
            assert_never(component.shape)


def _svg_mark(mark: Mark, wide: float) -> str:
    pen = PENS[mark.role]
    points = mark.points if mark.role != "trail" else _thinned(mark.points, 0.004 * wide)
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points.tolist())
    name = "polygon" if pen.fill else "polyline"
    return (
        f'<{name} points="{path}" fill="{pen.fill or "none"}" stroke="{pen.stroke}" '
        f'stroke-width="{pen.width * wide:.2f}" stroke-linejoin="round" stroke-linecap="round"/>'
    )


def _thinned(points: FloatArray, step: float) -> FloatArray:
    """The path without points nearer than `step` to the last one kept; its end stays."""
    kept = [0]
    for k in range(1, len(points)):
        if np.hypot(*(points[k] - points[kept[-1]])) >= step:
            kept.append(k)
    return points[[*kept, len(points) - 1]]


def _image(one: Frame, box: tuple[float, float, float, float], layout: PictureLayout) -> Image.Image:
    left, top, wide, high = box
    size = (layout.pixels, max(1, round(layout.pixels * high / wide)))
    scale = layout.oversampling * layout.pixels / wide
    image = Image.new("RGB", (layout.oversampling * size[0], layout.oversampling * size[1]), PAPER)
    pencil = ImageDraw.Draw(image)
    for mark in marks(one):
        pen = PENS[mark.role]
        points = [(float(x), float(y)) for x, y in (mark.points - [left, top]) * scale]
        thick = max(2, round(pen.width * wide * scale))
        if pen.fill:
            pencil.polygon(points, fill=pen.fill)
            points.append(points[0])
        pencil.line(points, fill=pen.stroke, width=thick, joint="curve")
    reduced = image.resize(size, Image.Resampling.LANCZOS)
    return reduced.quantize(colors=64, dither=Image.Dither.NONE)
