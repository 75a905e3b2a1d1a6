"""Pictures of a motion: moments side by side as SVG, an animation as GIF, and its single frames.

Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from PIL import Image, ImageColor, ImageDraw

from evaluation.frames import Frame, frames, view, watchable
from evaluation.parallel import Progress, silent
from physics.pipeline import Motion
from sketch.figures import COLOURS, Pen, coil, draw_path, draw_shapes
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Circle, Polygon, Spring, outline


@dataclass(frozen=True, slots=True)
class PictureLayout:
    """How strips and animations are laid out."""

    moments: int = 5
    """Frames in a strip: start, end, and enough between to see a bounce."""
    points: float = 150.0
    """The width of a strip's frame, of which the pen's thin line is one."""
    gap: float = 8.0
    """Between frames, in points."""
    caption: float = 16.0
    """Height of the line that tells the time, in points."""
    trail: str = "#9a9a9a"
    paper: str = "#ffffff"
    caption_colour: str = "#6d685f"
    pixels: int = 480
    """Width of an animation."""
    oversampling: int = 2
    """Drawn so many times larger and reduced: PIL does not smooth its lines."""
    line: float = 2.5
    """Width of an animation's lines, pixels."""
    step: float = 0.04
    """Seconds between two frames of an animation: what every viewer of GIF can show."""
    hold: float = 1.0
    """Seconds for which the last frame stays."""
    most: int = 1500
    """Frames of an animation, at most: a minute's."""


LAYOUT = PictureLayout()


def strip(motion: Motion, seconds: float, layout: PictureLayout = LAYOUT) -> str:
    """SVG of moments from the start to `seconds`, side by side, each with its time and with the way
    that every moving body has come; to an earlier end when everything that moves has left by then."""
    shown = frames(motion, watchable(motion, seconds), layout.moments)
    left, top, wide, high = view(shown)
    pen = Pen(wide / layout.points)
    gap, caption = layout.gap * pen.unit, layout.caption * pen.unit
    full, tall = len(shown) * (wide + gap) - gap, high + caption
    number = pen.number
    parts = [
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {number(full)} {number(tall)}" role="img" '
            f'aria-label="{len(shown)} moments of the motion">'
        ),
        f'<rect width="{number(full)}" height="{number(tall)}" fill="{layout.paper}"/>',
    ]
    for k, one in enumerate(shown):
        x = k * (wide + gap)
        parts.append(
            f'<svg x="{number(x)}" y="0" width="{number(wide)}" height="{number(high)}" '
            f'viewBox="{number(left)} {number(top)} {number(wide)} {number(high)}">'
        )
        parts.extend(_drawn(one, pen, layout, names=k == 0))
        parts.append("</svg>")
        parts.append(
            f'<text x="{number(x + wide / 2)}" y="{number(tall - 0.35 * caption)}" text-anchor="middle" '
            f'font-family="system-ui, sans-serif" font-size="{number(0.55 * caption)}" '
            f'fill="{layout.caption_colour}">{one.seconds:.2f} s</text>'
        )
        if k:
            edge = np.array([[x - gap / 2, 0], [x - gap / 2, tall]])
            parts.append(draw_path(edge, pen, "#e4dfd4", 0.6))
    return "".join(parts) + "</svg>\n"


def animation(
    motion: Motion, seconds: float, progress: Progress = silent, layout: PictureLayout = LAYOUT
) -> bytes:
    """GIF of the motion from the start to `seconds`, in real time, over and over."""
    count = min(layout.most, max(2, round(seconds / layout.step) + 1))
    images = [
        image.quantize(colors=64, dither=Image.Dither.NONE)
        for image in images_of(motion, seconds, count, progress, layout)
    ]
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


def images_of(
    motion: Motion, seconds: float, count: int, progress: Progress = silent, layout: PictureLayout = LAYOUT
) -> Iterator[Image.Image]:
    """So many frames from the start to `seconds`, at equal times, as RGB images of one size, both sides even."""
    shown = frames(motion, seconds, count)
    box = view(shown)
    for k, one in enumerate(shown, start=1):
        yield _image(one, box, layout)
        progress("Drawing frames", k, count)


def _drawn(one: Frame, pen: Pen, layout: PictureLayout, names: bool) -> list[str]:
    """A frame's pieces of SVG, from the back to the front."""
    trails = [
        draw_path(_thinned(trail, pen.unit), pen, layout.trail, 1.0, dots=True)
        for trail in one.trails
        if len(trail) > 1
    ]
    spokes = [draw_path(spoke, pen, COLOURS["circle"]) for spoke in one.spokes]
    return [*trails, draw_shapes(one.components, pen, names=names), *spokes]


def _thinned(points: FloatArray, step: float) -> FloatArray:
    """The path without points nearer than `step` to the last one kept; its end stays."""
    kept = [0]
    for k in range(1, len(points)):
        if np.hypot(*(points[k] - points[kept[-1]])) >= step:
            kept.append(k)
    return points[[*kept, len(points) - 1]]


def _image(one: Frame, box: tuple[float, float, float, float], layout: PictureLayout) -> Image.Image:
    left, top, wide, high = box
    size = (layout.pixels, max(2, 2 * round(layout.pixels * high / wide / 2)))
    scale = layout.oversampling * layout.pixels / wide
    image = Image.new("RGB", (layout.oversampling * size[0], layout.oversampling * size[1]), layout.paper)
    pencil = ImageDraw.Draw(image)
    thick = round(layout.line * layout.oversampling)

    def pixels(points: FloatArray) -> list[tuple[float, float]]:
        return [(float(x), float(y)) for x, y in (points - [left, top]) * scale]

    for trail in one.trails:
        if len(trail) > 1:
            pencil.line(pixels(trail), fill=layout.trail, width=max(1, thick // 3))
    for part in sorted(one.components, key=lambda part: isinstance(part.shape, Circle | Polygon)):
        colour, points = COLOURS[part.kind], pixels(_outline(part))
        if isinstance(part.shape, Circle | Polygon):
            pencil.polygon(points, fill=_tint(colour, 0.28 if part.fixed else 0.12))
        pencil.line(points, fill=colour, width=thick, joint="curve")
    for spoke in one.spokes:
        pencil.line(pixels(np.array(spoke)), fill=COLOURS["circle"], width=max(1, thick // 2))
    return image.resize(size, Image.Resampling.LANCZOS)


def _outline(part: Component) -> FloatArray:
    return coil(part.shape) if isinstance(part.shape, Spring) else outline(part.shape)


def _tint(colour: str, share: float) -> tuple[int, int, int]:
    """The colour thinned on white paper."""
    red, green, blue = ImageColor.getrgb(colour)[:3]
    return (_mixed(red, share), _mixed(green, share), _mixed(blue, share))


def _mixed(channel: int, share: float) -> int:
    return round(255 - share * (255 - channel))
