"""Where mathematics stands on a page: beside what it governs, over nothing.

Frame: page units, y down. A line of mathematics is a rectangle; it is put at the free place
nearest to the spot that it governs, as people write a value beside the thing it belongs to. What
governs the whole page goes to a corner.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sketch.geometry import resample
from sketch.ink import FloatArray
from sketch.page import Component
from sketch.shapes import Circle, Point, Polygon, Shape, Spring, outline

Size = tuple[float, float]
"""Width and height, page units."""


@dataclass(frozen=True, slots=True)
class Sheet:
    """The page and the room left free on it, page units."""

    width: float = 600.0
    height: float = 450.0
    margin: float = 12.0
    """Between a line and the page's edge."""
    clear: tuple[float, float] = (1.3, 0.6)
    """Between a line and the ink of a shape at its side and above or below it, in letter heights: a
    ball right beside the letters would be one of them."""
    between: tuple[float, float] = (1.6, 0.7)
    """Between two lines side by side and above one another, in letter heights: more than within one
    line, so that a reader can part them."""
    step: float = 12.0
    """Spacing of the places that are tried."""
    whim: float = 30.0
    """Mean of the extra distance that a writer puts up with, exponential: nobody minimises."""
    detail: float = 12.0
    """Spacing of the points that stand for a shape's outline."""


SHEET = Sheet()


def place(
    sizes: Sequence[Size],
    wishes: Sequence[Point | None],
    components: Sequence[Component],
    letter: float,
    rng: np.random.Generator,
) -> list[Point]:
    """The centre of each line: free of all shapes and of the lines before it.

    sizes: of each line; wishes: the spot it would stand at, None for a corner of the page; letter:
    height of a capital, page units. A line that finds no room is put below everything, where the page grows.
    """
    outlines = np.concatenate([_outline(component.shape) for component in components])
    between = (SHEET.between[0] * letter, SHEET.between[1] * letter)
    taken: list[tuple[Point, Size]] = []
    for size, wish in zip(sizes, wishes, strict=True):
        columns, rows = _lattice(size)
        grid = np.stack(np.meshgrid(columns, rows), axis=-1).reshape(-1, 2)
        corner = rng.integers(2, size=2) * [SHEET.width, SHEET.height]
        target = corner if wish is None else np.asarray(wish)
        free = _clear_of_ink(columns, rows, size, letter, outlines)
        for component in components:
            free &= ~_inside(component.shape, grid)
        for centre, other in taken:
            free &= _apart(grid, size, centre, other, between)
        cost = np.linalg.norm(grid - target, axis=1) + rng.exponential(SHEET.whim, len(grid))
        cost[~free] = np.inf
        best = int(np.argmin(cost))
        if np.isfinite(cost[best]):
            at = grid[best] + rng.uniform(-0.2, 0.2, 2) * SHEET.step
        else:
            floor = max([float(outlines[:, 1].max()), *(y + h / 2 for (_, y), (_, h) in taken)])
            at = np.array([SHEET.width / 2, floor + between[1] + SHEET.step + size[1] / 2])
        taken.append(((float(at[0]), float(at[1])), size))
    return [centre for centre, _ in taken]


def _lattice(size: Size) -> tuple[FloatArray, FloatArray]:
    """Columns and rows at whose crossings a line of this size lies on the page; at least one of each."""
    columns, rows = (
        np.arange(first, max(whole - first, first + SHEET.step), SHEET.step)
        for first, whole in (
            (size[0] / 2 + SHEET.margin, SHEET.width),
            (size[1] / 2 + SHEET.margin, SHEET.height),
        )
    )
    return columns, rows


def _clear_of_ink(
    columns: FloatArray, rows: FloatArray, size: Size, letter: float, ink: FloatArray
) -> NDArray[np.bool_]:
    """For each place, row by row, whether no point of the outlines lies in the line's rectangle or
    too near to it."""
    across = size[0] / 2 + SHEET.clear[0] * letter + SHEET.detail / 2
    down = size[1] / 2 + SHEET.clear[1] * letter + SHEET.detail / 2
    in_column = np.abs(ink[:, :1] - columns) < across
    in_row = np.abs(rows[:, None] - ink[:, 1]) < down
    # The product counts, for each row and column, the points that are in both.
    return (in_row.astype(np.float32) @ in_column.astype(np.float32) == 0).ravel()


def _apart(grid: FloatArray, size: Size, centre: Point, other: Size, between: Size) -> NDArray[np.bool_]:
    reach = (np.asarray(size) + other) / 2 + between
    return np.any(np.abs(grid - centre) >= reach, axis=1)


def _outline(shape: Shape) -> FloatArray:
    """Points along the shape's ink, `detail` apart; a spring is as wide as it is drawn."""
    path = outline(shape)
    length = float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
    points = resample(path, max(3, int(length / SHEET.detail) + 2))
    if isinstance(shape, Spring):
        along = np.subtract(shape.end, shape.start) / length
        aside = shape.width / 2 * np.array([-along[1], along[0]])
        points = np.concatenate([points - aside, points, points + aside])
    return points


def _inside(shape: Shape, grid: FloatArray) -> NDArray[np.bool_]:
    """Which places lie within a solid: a line there would seem to be a part of it."""
    match shape:
        case Circle(centre, radius):
            return np.linalg.norm(grid - centre, axis=1) < radius
        case Polygon(vertices):
            # Even-odd rule along a ray to the right.
            start, end = vertices, np.roll(vertices, -1, axis=0)
            spans = (start[:, 1] > grid[:, 1:]) != (end[:, 1] > grid[:, 1:])
            with np.errstate(divide="ignore", invalid="ignore"):
                slope = (end - start)[:, 0] / (end - start)[:, 1]
                crossing = start[:, 0] + (grid[:, 1:] - start[:, 1]) * slope
            crossings = np.count_nonzero(spans & (grid[:, :1] < crossing), axis=1)
            return np.asarray(crossings % 2 == 1)
        case _:
            return np.zeros(len(grid), dtype=bool)
