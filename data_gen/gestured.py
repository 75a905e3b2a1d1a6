"""Pages on which somebody lassoed, rubbed out or tapped something after it was drawn.

A gesture is thrown about, over or on one thing of a generated page, a component or a line of mathematics, by
the page's own writer. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from data_gen import drawing, pen
from data_gen.pages import Page, pages
from data_gen.strokes import Recipe, meant
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import GestureKind
from sketch.shapes import Circle, Polygon


@dataclass(frozen=True, slots=True)
class GestureRule:
    """How gestures lie to what they mean."""

    clear: tuple[float, float] = (1.25, 1.7)
    """Size of a lasso over what it must enclose: at its narrowest lobe it still passes outside."""
    margin: float = 12.0
    """Page units more, on either side: nobody threads a lasso along a wire."""
    cover: tuple[float, float] = (0.7, 1.2)
    """Size of a scribble over what it rubs out: mostly all of it, sometimes the middle."""
    pause: float = 1.0
    """Seconds after the page was drawn."""


RULE = GestureRule()
IN_TURN: tuple[GestureKind, ...] = ("lasso", "scribble", "tap")
IN_ONE = Recipe(without=("several_strokes", "broken"))
"""Gestures are made without lifting the pen."""


@dataclass(frozen=True, slots=True)
class GesturedPage:
    """page: as it was before; ink: with the gesture as its last stroke; kind; target: the strokes it means;
    index: its number under the seed."""

    page: Page
    ink: Ink
    kind: GestureKind
    target: tuple[int, ...]
    index: int


def gestured_pages(count: int, seed: int) -> Iterator[GesturedPage]:
    """`count` pages, each with a lasso, a scribble or a tap more, in turn."""
    for number, page in enumerate(pages(count, seed)):
        kind = IN_TURN[number % len(IN_TURN)]
        yield gestured(page, kind, np.random.default_rng([seed, page.index, 1]))


def gestured(page: Page, kind: GestureKind, rng: np.random.Generator) -> GesturedPage:
    """The page with one gesture more, at something that is there."""
    truth = page.truth
    solids = [part for part in truth.components if isinstance(part.shape, Circle | Polygon) and part.strokes]
    things = [thing.strokes for thing in (*truth.components, *truth.expressions) if thing.strokes]
    if kind == "tap":
        solid = solids[int(rng.integers(len(solids)))]
        assert isinstance(solid.shape, Circle | Polygon)
        path, target = drawing.tap(solid.shape, rng), solid.strokes
        writer = replace(page.writer, hooks=0.0)
    else:
        target = things[int(rng.integers(len(things)))]
        path, writer = _about(truth.ink.points_of(target), kind, rng), page.writer
    (stroke,) = pen.draw([path], writer, rng)
    times = stroke.times
    if times is not None and (last := truth.ink[-1].times) is not None:
        times = times + float(last[-1]) + RULE.pause
    ink = Ink((*truth.ink, Stroke(stroke.points, times, stroke.pressure)))
    return GesturedPage(page, ink, kind, target, page.index)


def _about(points: FloatArray, kind: GestureKind, rng: np.random.Generator) -> FloatArray:
    """A lasso about the points, or a scribble over them."""
    (path,), _ = meant(kind, int(rng.integers(2**31)), recipe=IN_ONE)
    low, high = points.min(axis=0), points.max(axis=0)
    middle, extent = 0.5 * (low + high), high - low + 2 * RULE.margin
    path = path - 0.5 * (path.min(axis=0) + path.max(axis=0))
    if kind == "lasso":
        # The largest box within the loop, whatever its lobes: half a diagonal for an ellipse.
        room = np.sqrt(0.5) * np.ptp(path, axis=0)
        return middle + float(rng.uniform(*RULE.clear)) * path * (extent / room)
    size = float(rng.uniform(*RULE.cover)) * float(np.hypot(*(high - low)))
    return middle + path * max(size, 2 * RULE.margin) / float(np.hypot(*np.ptp(path, axis=0)))
