"""A motion at one instant, back on the page: where every component stands.

Frame: page units, y down, from the trajectory's metres, y up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import assert_never

import numpy as np

from physics.formula.meaning import PER_METRE
from physics.pipeline import Motion
from sketch.figures import Pose, posed
from sketch.geometry import bounding_box, centroid
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Arrow, Circle, Point, Polygon, Solid, Spring, Wire, outline

REACH = 0.6
"""How far around the page a picture follows what leaves it, as a share of the page's size."""
Spoke = tuple[Point, Point]


@dataclass(frozen=True, slots=True)
class Frame:
    """seconds; components: at their places, links that are broken left out; spokes: from a moving
    circle's centre to the same spot of its rim, so that its turning is seen; trails: the way each
    moving body's centre has come, (k, 2) page units; broken: labels of the links that broke by now."""

    seconds: float
    components: tuple[Component, ...]
    spokes: tuple[Spoke, ...]
    trails: tuple[FloatArray, ...]
    broken: tuple[str, ...]


def frame(motion: Motion, seconds: float) -> Frame:
    """The frame of the trajectory nearest to `seconds`."""
    trajectory = motion.trajectory
    k = int(np.argmin(np.abs(trajectory.times - seconds)))
    components: list[Component] = []
    spokes: list[Spoke] = []
    broken: list[str] = []
    for component in motion.rectified.components:
        match component.shape:
            case Circle() | Polygon() as solid:
                moved, spoke = _solid(component, solid, motion, k)
                components.append(moved)
                spokes.extend(spoke)
            case Spring() | Wire():
                link = _link(component, motion, k)
                if link is None:
                    broken.append(component.label)
                else:
                    components.append(link)
            case Arrow():
                components.append(component)
            case _:
                assert_never(component.shape)
    trails = tuple(
        to_page(trajectory.path(part.label)[: k + 1])
        for part in motion.rectified.components
        if _moves(part, motion)
    )
    return Frame(float(trajectory.times[k]), tuple(components), tuple(spokes), trails, tuple(broken))


def frames(motion: Motion, seconds: float, count: int) -> list[Frame]:
    """`count` >= 2 frames, evenly spread from the start to `seconds`."""
    return [frame(motion, time) for time in np.linspace(0.0, seconds, count).tolist()]


def to_page(metres: FloatArray) -> FloatArray:
    """Metres, y up → page units, y down; any shape (…, 2)."""
    return metres * [PER_METRE, -PER_METRE]


def watchable(motion: Motion, seconds: float, reach: float = REACH) -> float:
    """The time until which something is to be seen: `seconds`, or when the last of the moving bodies
    has got farther than `reach` of the page's size away from the page."""
    low, high = _box([frame(motion, 0.0)])
    away = reach * float(np.linalg.norm(high - low))
    trajectory = motion.trajectory
    movable = [part.label for part in motion.rectified.components if _moves(part, motion)]
    near = np.zeros(len(trajectory.times), dtype=bool)
    for label in movable:
        path = to_page(trajectory.path(label))
        near |= np.all((path >= low - away) & (path <= high + away), axis=1)
    if not movable or near[-1]:
        return seconds
    return min(seconds, max(float(trajectory.times[near].max(initial=0.0)), 0.2 * seconds))


def view(
    shown: Sequence[Frame], margin: float = 0.06, reach: float = REACH
) -> tuple[float, float, float, float]:
    """(left, top, width, height) that shows the first frame whole and the others as far as they stay
    within `reach` of its size around it: what falls off the page must not shrink everything else."""
    first, every = _box(shown[:1]), _box(shown)
    size = float(np.linalg.norm(first[1] - first[0]))
    low = np.maximum(every[0], first[0] - reach * size) - margin * size
    high = np.minimum(every[1], first[1] + reach * size) + margin * size
    return (float(low[0]), float(low[1]), float(high[0] - low[0]), float(high[1] - low[1]))


def _moves(component: Component, motion: Motion) -> bool:
    return component.label in motion.trajectory.bodies and not component.fixed


def _box(shown: Sequence[Frame]) -> tuple[FloatArray, FloatArray]:
    points = [outline(part.shape) for one in shown for part in one.components]
    return bounding_box(np.concatenate(points)) if points else (np.zeros(2), np.full(2, 100.0))


def _solid(component: Component, solid: Solid, motion: Motion, k: int) -> tuple[Component, list[Spoke]]:
    """The solid at frame k, and its spoke if it is a circle that may move."""
    if not _moves(component, motion):
        return component, []
    x, y, angle = motion.trajectory.poses[k, motion.trajectory.column(component.label)].tolist()
    centre = solid.centre if isinstance(solid, Circle) else centroid(solid.vertices)
    dx, dy = (to_page(np.array([x, y])) - centre).tolist()
    moved = posed(solid, Pose(dx, dy, -angle))
    spokes: list[Spoke] = []
    if isinstance(moved, Circle):
        rim = np.add(moved.centre, moved.radius * np.array([np.cos(angle), -np.sin(angle)]))
        spokes.append((moved.centre, _point(rim)))
    return replace(component, shape=moved), spokes


def _link(component: Component, motion: Motion, k: int) -> Component | None:
    """The spring or wire at frame k; None once it is broken. What the engine does not know stays."""
    anchors = motion.trajectory.anchors.get(component.label)
    if anchors is None:
        return component
    if not np.isfinite(anchors[k]).all():
        return None
    start, end = (_point(place) for place in to_page(anchors[k]))
    if start == end:
        return None
    match component.shape:
        case Spring(_, _, coils, width):
            return replace(component, shape=Spring(start, end, coils, width))
        case _:
            return replace(component, shape=Wire(start, end))


def _point(values: FloatArray) -> Point:
    return (float(values[0]), float(values[1]))
