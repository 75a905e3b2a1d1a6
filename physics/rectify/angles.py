"""C5: a spring or a wire gets the angle that the page says it has.

An angle tapped nearer to the link's top end is measured from the vertical, nearer to its bottom
end from the horizontal. Which end gives way is chosen so that the motion is changed least:

- a body that hangs from this link alone follows it about the fixed end, as a bob does;
- a body that several links hold stays where it is, or correcting one wire would slacken the
  other: there the end at the fixed block slides along the block's boundary (the wire's length
  changes), and where the wire would miss the block, the block itself follows. A block is
  scenery: where exactly it stands changes nothing that anybody asked.

Page units, y down.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import atan2, cos, hypot, pi, sin

from physics.formula.meaning import GRAVITY, Meanings
from physics.formula.names import constant_of, lookup
from physics.rectify.correction import Rectified, changes, moved, reshaped, shift, turn
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Point, Polygon, Solid, Spring, Wire


@dataclass(frozen=True, slots=True)
class AngleRule:
    """How far a correction may go."""

    exact: float = 1e-10
    """Radians: an angle this near is left alone."""
    slide: float = 0.35
    """Share of the link's length by which its end may slide along a block; beyond, the block follows."""


RULE = AngleRule()


def aim(sketch: Sketch, meanings: Meanings) -> Rectified:
    """C5 on every spring and wire that an angle is said of."""
    after = sketch
    for part in sketch.components:
        said = meanings.of(part.label, "angle", part.kind) if isinstance(part.shape, Spring | Wire) else None
        if said is None or said.anchor is None:
            continue
        angle = constant_of(said, lookup(sketch, meanings, part.label, {}, GRAVITY))
        if angle is not None and 0 <= angle <= pi / 2:
            after = _aimed(after, part.label, angle, said.anchor)
    return Rectified(after, changes("C5", _why, sketch, after))


def _why(part: Component) -> str:
    if isinstance(part.shape, Spring | Wire):
        return f"{part.label}: it is given the angle that the page says it has."
    return f"{part.label}: it follows a link that was given its angle."


def _aimed(sketch: Sketch, label: str, angle: float, anchor: Point) -> Sketch:
    part = sketch.component(label)
    shape = part.shape
    assert isinstance(shape, Spring | Wire)
    kept, yielding = _roles(sketch, part)
    fixed_end, moving_end = (shape.start, shape.end) if kept == 0 else (shape.end, shape.start)
    dx, dy = moving_end[0] - fixed_end[0], moving_end[1] - fixed_end[1]
    length = hypot(dx, dy)
    top, bottom = sorted((shape.start, shape.end), key=lambda end: end[1])
    near_top = hypot(anchor[0] - top[0], anchor[1] - top[1]) < hypot(
        anchor[0] - bottom[0], anchor[1] - bottom[1]
    )
    level, rise = (sin(angle), cos(angle)) if near_top else (cos(angle), sin(angle))
    ux, uy = (level if dx >= 0 else -level), (rise if dy >= 0 else -rise)
    off = atan2(dx * uy - dy * ux, dx * ux + dy * uy)
    if abs(off) <= RULE.exact:
        return sketch
    holder = part.ends[yielding]
    if holder is None:
        return _with_end(sketch, part, yielding, (fixed_end[0] + length * ux, fixed_end[1] + length * uy))
    solid = sketch.component(holder)
    assert isinstance(solid.shape, Circle | Polygon)
    if solid.fixed or _held_by_several(sketch, holder):
        hit = _first_hit(solid.shape, fixed_end, (ux, uy))
        if hit is not None and hypot(hit[0] - moving_end[0], hit[1] - moving_end[1]) <= RULE.slide * length:
            return _with_end(sketch, part, yielding, hit)
    if isinstance(solid.shape, Circle):
        return moved(sketch, holder, turn(fixed_end, off))
    step = (fixed_end[0] + length * ux - moving_end[0], fixed_end[1] + length * uy - moving_end[1])
    return moved(sketch, holder, shift(*step))


def _roles(sketch: Sketch, part: Component) -> tuple[int, int]:
    """(which end stays, which gives way): 0 the start, 1 the end."""
    free = [_follows(sketch, label) for label in part.ends]
    if free[0] != free[1]:
        return (1, 0) if free[0] else (0, 1)
    # Neither end's body can simply follow: what is fixed gives way, for what several links hold stays.
    stays = [label is not None and not sketch.component(label).fixed for label in part.ends]
    return (1, 0) if stays[1] and not stays[0] else (0, 1)


def _follows(sketch: Sketch, label: str | None) -> bool:
    """Whether a body hangs from one link only."""
    return label is not None and not sketch.component(label).fixed and not _held_by_several(sketch, label)


def _held_by_several(sketch: Sketch, label: str) -> bool:
    return sum(label in part.ends for part in sketch.components) > 1


def _with_end(sketch: Sketch, part: Component, which: int, place: Point) -> Sketch:
    assert isinstance(part.shape, Spring | Wire)
    start, end = (place, part.shape.end) if which == 0 else (part.shape.start, place)
    return (
        sketch if start == end else reshaped(sketch, {part.label: replace(part.shape, start=start, end=end)})
    )


def _first_hit(solid: Solid, origin: Point, direction: Point) -> Point | None:
    """Where a ray from outside first meets a solid's boundary."""
    ux, uy = direction
    if isinstance(solid, Circle):
        x, y = origin[0] - solid.centre[0], origin[1] - solid.centre[1]
        half = x * ux + y * uy
        root = half * half - (x * x + y * y - solid.radius**2)
        distances = [-half - root**0.5] if root >= 0 else []
    else:
        distances = []
        vertices = solid.vertices.tolist()
        for (x1, y1), (x2, y2) in zip(vertices, vertices[1:] + vertices[:1], strict=True):
            ex, ey = x2 - x1, y2 - y1
            cross = ux * ey - uy * ex
            if cross == 0:
                continue
            x, y = x1 - origin[0], y1 - origin[1]
            if 0 <= (x * uy - y * ux) / cross <= 1:
                distances.append((x * ey - y * ex) / cross)
    ahead = [distance for distance in distances if distance > 0]
    return (origin[0] + min(ahead) * ux, origin[1] + min(ahead) * uy) if ahead else None
