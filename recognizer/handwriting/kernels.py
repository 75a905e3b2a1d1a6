"""What the net of signs looks at, from strokes of equal spacing: compiled by numba once and kept on disk.

Frame: page units, y down. A group is a set of strokes that may be one sign; its line's scale is the
height of a letter there. Images are `SIDE` pixels square, 0 where there is no ink and 1 where there is.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from recognizer.jit import kernel
from sketch.ink import FloatArray

Indices = NDArray[np.int64]
Floats = NDArray[np.float32]

POINTS = 64
"""Points of equal spacing along the ink of a group."""
CHANNELS = 5
"""x, y in the group's own frame, the pen's direction (cosine, sine), 1 where a stroke begins."""
SIDE = 28
IMAGES = 3
"""The group filling the image; the group at the line's scale; what is around it at the line's scale."""
WINDOW = 1.7
"""Half the side of what is looked at around a group's middle, in the line's scale."""
NUMBERS = 6
"""Width, height (logarithms, in the line's scale), whether the scale is known, strokes, length, straightness."""
STEP = 0.45
"""Pixels between the dots that a line is drawn with."""
SURE = 1e-9
"""Share of the ink's length by which a place may lie beyond a step's end and still be on it: where the ink ends is not
left to rounding, which differs from one machine to the next."""


@kernel
def looks(
    points: FloatArray,
    ends: Indices,
    boxes: FloatArray,
    members: Indices,
    member_ends: Indices,
    scales: FloatArray,
    alone: NDArray[np.bool_],
    sequence: Floats,
    images: Floats,
    numbers: Floats,
) -> None:
    """Fills in sequence (B, 5, 64), images (B, 3, 28, 28) and numbers (B, 6) for B groups.

    points (n, 2) of all strokes, one below the other, ends (s,) where each stroke ends, boxes (s, 4) of each;
    members: the strokes of the groups one after another in drawing order, member_ends (B,) where each group
    ends; scales (B,) of the lines; alone (B,): neither scale nor neighbours are looked at.
    """
    for b in range(len(member_ends)):
        first = 0 if b == 0 else member_ends[b - 1]
        group = members[first : member_ends[b]]
        left, top, right, bottom = np.inf, np.inf, -np.inf, -np.inf
        for k in range(len(group)):
            box = boxes[group[k]]
            left, top = min(left, box[0]), min(top, box[1])
            right, bottom = max(right, box[2]), max(bottom, box[3])
        size = max(right - left, bottom - top)
        scale = scales[b]
        if alone[b]:
            scale = max(size, 1e-9)
        size = max(size, 1e-3 * scale, 1e-12)
        middle_x, middle_y = 0.5 * (left + right), 0.5 * (top + bottom)
        length = _sequence(points, ends, group, middle_x, middle_y, size, sequence[b])
        pixel = SIDE - 5.0
        _drawn(points, ends, group, middle_x, middle_y, pixel / size, images[b, 0])
        window = SIDE / (2 * WINDOW * scale)
        _drawn(points, ends, group, middle_x, middle_y, window, images[b, 1])
        if not alone[b]:
            _around(points, ends, boxes, group, middle_x, middle_y, window, WINDOW * scale, images[b, 2])
        numbers[b, 0] = np.log(max(right - left, 0.01 * scale) / scale)
        numbers[b, 1] = np.log(max(bottom - top, 0.01 * scale) / scale)
        numbers[b, 2] = 0.0 if alone[b] else 1.0
        numbers[b, 3] = 0.5 * len(group)
        numbers[b, 4] = 0.3 * length / size
        a, z = points[0 if group[0] == 0 else ends[group[0] - 1]], points[ends[group[-1]] - 1]
        numbers[b, 5] = np.hypot(z[0] - a[0], z[1] - a[1]) / size


@kernel
def _sequence(
    points: FloatArray, ends: Indices, group: Indices, x: float, y: float, size: float, out: Floats
) -> float:
    """Points of equal spacing along the ink; returns the ink's length."""
    total = 0.0
    for k in range(len(group)):
        start = 0 if group[k] == 0 else ends[group[k] - 1]
        for i in range(start + 1, ends[group[k]]):
            total += np.hypot(points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1])
    step = total / (POINTS - 1)
    place = 0
    done, wanted = 0.0, 0.0
    for k in range(len(group)):
        start, end = (0 if group[k] == 0 else ends[group[k] - 1]), ends[group[k]]
        begun = True
        for i in range(start, end - 1):
            dx, dy = points[i + 1, 0] - points[i, 0], points[i + 1, 1] - points[i, 1]
            part = np.hypot(dx, dy)
            while place < POINTS and part > 0 and wanted <= (done + part) * (1.0 + SURE):
                share = (wanted - done) / part
                out[0, place] = 2 * (points[i, 0] + share * dx - x) / size
                out[1, place] = 2 * (points[i, 1] + share * dy - y) / size
                out[2, place], out[3, place] = dx / part, dy / part
                out[4, place] = 1.0 if begun else 0.0
                begun = False
                place += 1
                wanted = place * step
            done += part
    last = ends[group[-1]] - 1
    while place < POINTS:
        out[0, place], out[1, place] = 2 * (points[last, 0] - x) / size, 2 * (points[last, 1] - y) / size
        out[2, place] = out[2, place - 1] if place else 0.0
        out[3, place] = out[3, place - 1] if place else 0.0
        out[4, place] = 0.0
        place += 1
    return total


@kernel
def _drawn(
    points: FloatArray, ends: Indices, group: Indices, x: float, y: float, scale: float, image: Floats
) -> None:
    """Draws the group with its middle at the image's, `scale` pixels to the page unit."""
    for k in range(len(group)):
        start = 0 if group[k] == 0 else int(ends[group[k] - 1])
        _stroke(points, start, int(ends[group[k]]), x, y, scale, image)


@kernel
def _around(
    points: FloatArray,
    ends: Indices,
    boxes: FloatArray,
    group: Indices,
    x: float,
    y: float,
    scale: float,
    reach: float,
    image: Floats,
) -> None:
    """Draws all strokes but the group's that come near."""
    for s in range(len(ends)):
        box = boxes[s]
        if box[0] > x + reach or box[2] < x - reach or box[1] > y + reach or box[3] < y - reach:
            continue
        own = False
        for k in range(len(group)):
            own = own or group[k] == s
        if not own:
            _stroke(points, 0 if s == 0 else ends[s - 1], ends[s], x, y, scale, image)


@kernel
def _stroke(
    points: FloatArray, start: int, end: int, x: float, y: float, scale: float, image: Floats
) -> None:
    half = 0.5 * (SIDE - 1)
    if end - start == 1:
        _dot((points[start, 0] - x) * scale + half, (points[start, 1] - y) * scale + half, 1.0, image)
    for i in range(start, end - 1):
        ax, ay = (points[i, 0] - x) * scale + half, (points[i, 1] - y) * scale + half
        bx, by = (points[i + 1, 0] - x) * scale + half, (points[i + 1, 1] - y) * scale + half
        count = min(int(np.hypot(bx - ax, by - ay) / STEP) + 1, 400)
        for j in range(count):
            share = j / count
            _dot(ax + share * (bx - ax), ay + share * (by - ay), 0.7, image)


@kernel
def _dot(px: float, py: float, ink: float, image: Floats) -> None:
    if px < 0 or py < 0 or px >= SIDE - 1 or py >= SIDE - 1:
        return
    column, row = int(px), int(py)
    u, v = px - column, py - row
    for r in range(2):
        for c in range(2):
            share = (v if r else 1 - v) * (u if c else 1 - u) * ink
            image[row + r, column + c] = min(image[row + r, column + c] + share, 1.0)
