"""Corners of a stroke of lines and arcs: where it turns at once, not where it bends.

The path is cut into the lines and arcs that explain it best for their number (optimal segmentation by
dynamic programming, Bellman 1961, with the errors of every line and of every arc from running sums);
a corner is where two pieces meet at an angle. Pieces too short to be meant are the rounding of a corner,
or a hook at an end. What straws (Wolin 2008; Xiong and LaViola 2010, `straws`) decide by windows of a fixed
length is decided by whole pieces here, so that an obtuse corner between long sides and a sharp one
between short sides are found by one rule. The pen's speed is left out: hands slow down in tight bends as in corners, and on simulated
pens the time spent at a place added nothing to what its shape tells.

Frame: the caller's; lengths within are fractions of the stroke's size, √12 times the rms distance of its
points from their centre (the length of a straight line), which turns with the page.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import atan2, hypot, pi, radians, sqrt

import numpy as np

from recognizer.geometric.cusps import bends
from recognizer.geometric.legs import leg_errors
from sketch.geometry import arc_lengths, distinct, resample
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class CornerRule:
    """What is a piece, and what is a corner."""

    points: int = 112
    """Points of the path: fourteen on each of eight legs."""
    waver: float = 0.006
    """Distance, rms, that ink strays from the line or arc it follows: tremor and pixels; slow waver bends a line
    to an arc and strays from neither."""
    price: float = 7.0
    """What one more piece must explain, in units of half squared wavers: its four numbers at half the
    logarithm of the points each, less what neighbouring points have in common."""
    arc: float = 3.0
    """What an arc costs more than a line."""
    tightest: float = 0.09
    """Radius of an arc, at least: tighter ones are rounded corners."""
    widest: float = radians(300)
    """Sweep of one arc, at most."""
    shortest: float = 0.055
    """Length of a piece, at least: a shorter one is the rounding of a corner."""
    hook: float = 0.1
    """Length of a piece at an end, at least: a shorter one is a hook of the pen coming down or leaving."""
    reach: float = 0.055
    """Length of the two chords between which a corner shows at its own place."""
    aside: float = 0.09
    """Where, on either side of it, the path's own bend is taken."""
    share: float = 0.5
    """Share of the bend beside a corner that is taken off: all of it would punish corners that were rounded."""
    turn: float = radians(22.5)
    """Strength of a corner, at least: the geometric mean of the angle between the pieces and the bend that
    shows there, without what the path bends beside it. Half of the bluntest corner that is drawn on purpose
    (an octagon's 45°)."""


CORNERS = CornerRule()


@dataclass(frozen=True, slots=True)
class Piece:
    """A line or an arc from one point of the path to another. begins, ends: heading there, radians;
    length, in sizes; radius: infinite for a line."""

    first: int
    last: int
    begins: float
    ends: float
    length: float
    radius: float


def corners(points: FloatArray, rule: CornerRule = CORNERS) -> FloatArray:
    """Where a stroke turns, in drawing order, its ends not among them: (k, 2) in the points' frame."""
    clean = distinct(points)
    if len(clean) < 3:
        return np.empty((0, 2))
    path = resample(clean, rule.points)
    middle = path.mean(axis=0)
    size = (12 * ((path - middle) ** 2).sum(axis=1).mean()) ** 0.5
    unit = (path - middle) / size
    return path[turns(unit, pieces(unit, rule), rule)]


def pieces(path: FloatArray, rule: CornerRule = CORNERS) -> list[Piece]:
    """The lines and arcs that explain an equally spaced path of unit size best for what they cost."""
    scale = 0.5 / rule.waver**2
    straight = leg_errors(path) * scale
    bent = arc_errors(path, rule) * scale + rule.arc
    errors = np.minimum(straight, bent) + rule.price
    count = len(path)
    total, before = np.zeros(count), np.zeros(count, dtype=int)
    for last in range(1, count):
        through = total[:last] + errors[:last, last]
        before[last] = best = int(np.argmin(through))
        total[last] = through[best]
    found: list[Piece] = []
    last = count - 1
    while last > 0:
        first = int(before[last])
        is_arc = bool(bent[first, last] < straight[first, last])
        found.append(_piece(path, first, last, is_arc))
        last = first
    return found[::-1]


def arc_errors(path: FloatArray, rule: CornerRule = CORNERS) -> FloatArray:
    """Sum of squared distances of points i … j from their own best circle, (n, n); infinite where it is too
    tight, or goes too far round, and where fewer than four points say nothing. Kåsa's fit of every run
    from running sums, its algebraic error over (2 r)² for the distance (Taubin 1991)."""
    x, y = path[:, 0], path[:, 1]
    z = x * x + y * y
    running = np.zeros((9, len(path) + 1))
    np.cumsum([x, y, z, x * x, x * y, y * y, x * z, y * z, z * z], axis=1, out=running[:, 1:])
    sums = running[:, None, 1:] - running[:, :-1, None]
    index = np.arange(len(path))
    number = np.maximum(index[None, :] - index[:, None] + 1, 1)
    sx, sy, sz = mean = sums[:3] / number
    xx, xy, yy = sums[3] - sx * sums[0], sums[4] - sx * sums[1], sums[5] - sy * sums[1]
    xz, yz, zz = sums[6] - sx * sums[2], sums[7] - sy * sums[2], sums[8] - sz * sums[2]
    # Points that all but lie on a line have a circle of any size: the determinant tells, whatever else overflows.
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        determinant = xx * yy - xy * xy
        a, b = (xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant  # twice the centre
        square = mean[2] - a * mean[0] - b * mean[1] + 0.25 * (a * a + b * b)  # of the radius
        errors = np.maximum(zz - a * xz - b * yz, 0.0) / (4 * square)
        step = float(np.hypot(*(path[1] - path[0])))
        fits = (square > rule.tightest**2) & ((number - 1) * step < rule.widest * np.sqrt(square))
        fits &= (determinant > 1e-15) & (index[None, :] > index[:, None] + 2)
    return np.where(fits, errors, np.inf)


def turns(path: FloatArray, found: list[Piece], rule: CornerRule = CORNERS) -> list[int]:
    """Indices of the path's points where pieces that were meant meet at an angle."""
    total = sum(piece.length for piece in found)
    begin, end = 0, len(found)
    while end - begin > 1 and found[begin].length < min(rule.hook, 0.2 * total):
        begin += 1
    while end - begin > 1 and found[end - 1].length < min(rule.hook, 0.2 * total):
        end -= 1
    meant = [piece for piece in found[begin:end] if piece.length >= rule.shortest]
    step = total / (len(path) - 1)
    bend = np.abs(bends(path, max(round(rule.reach / step), 1)))
    aside = max(round(rule.aside / step), 2)
    corners: list[int] = []
    for before, after in pairwise(meant):
        angle = abs((after.begins - before.ends + pi) % (2 * pi) - pi)
        tip = _sharpest(path, before.last, after.first)
        shown = float(bend[max(tip - 1, 0) : tip + 2].max())
        left, right = (
            bend[max(tip - aside - 1, 0) : max(tip - aside + 2, 1)],
            bend[tip + aside - 1 : tip + aside + 2],
        )
        beside = 0.5 * float(left.mean() + (right.mean() if len(right) else 0.0))
        if sqrt(angle * shown) - rule.share * beside > rule.turn:
            corners.append(tip)
    return corners


def _piece(path: FloatArray, first: int, last: int, is_arc: bool) -> Piece:
    run = path[first : last + 1]
    chord = run[-1] - run[0]
    length = float(arc_lengths(run)[-1])
    if is_arc:
        centre = _centre(run)
        radius = float(np.hypot(*(run - centre).T).mean())
        rays = run[[0, -1]] - centre
        swept = np.unwrap(np.arctan2(*(run - centre).T[::-1]))
        side = pi / 2 if swept[-1] > swept[0] else -pi / 2
        begins, ends = (atan2(ray[1], ray[0]) + side for ray in rays.tolist())
        return Piece(first, last, begins, ends, length, radius)
    centred = run - run.mean(axis=0)
    along = np.linalg.svd(centred, full_matrices=False)[2][0] if len(run) > 2 else chord
    way = atan2(along[1], along[0]) + (0.0 if along @ chord >= 0 else pi)
    return Piece(first, last, way, way, length, float("inf"))


def _centre(run: FloatArray) -> FloatArray:
    """Kåsa's circle through a run of points: its centre, (2,)."""
    middle = run.mean(axis=0)
    centred = run - middle
    square = (centred**2).sum(axis=1)
    return middle + 0.5 * np.linalg.lstsq(centred, square - square.mean(), rcond=None)[0]


def _sharpest(path: FloatArray, first: int, last: int) -> int:
    """The point between two pieces that strays farthest from the chord around them: the corner's tip."""
    low, high = max(first - 2, 0), min(last + 2, len(path) - 1)
    if high - low < 2:
        return first
    (x, y), chord = (path[low : high + 1] - path[low]).T, path[high] - path[low]
    if hypot(*chord) == 0:
        return low + int(np.argmax(np.hypot(x, y)))
    return low + int(np.argmax(np.abs(x * chord[1] - y * chord[0])))
