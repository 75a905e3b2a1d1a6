"""Corners of a stroke of lines and arcs: where it turns at once, not where it bends.

The path is cut into the lines and arcs that explain it best for their number (optimal segmentation by
dynamic programming, `kernels.corners.cut`); a corner is where two pieces meet at an angle. Pieces too short to be meant
are the rounding of a corner, or a hook at an end. What straws (Wolin 2008; Xiong and LaViola 2010, `straws`) decide by
windows of a fixed length is decided by whole pieces here, so that an obtuse corner between long sides and a sharp one
between short sides are found by one rule.

A hand comes nearly to rest at a corner and passes through a waver without a pause (Sezgin, Stahovich and Davis 2001; Plamondon
1995). So where the stroke's times are known a piece that ends at a slow place costs less than one that ends in full motion, and a
corner must show more where the pen did not slow down. Without times each place counts as slow as a corner usually is.

Frame: the caller's; lengths within are fractions of the stroke's size, √12 times the rms distance of its
points from their centre (the length of a straight line), which turns with the page.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import hypot, log, pi, radians

import numpy as np

from recognizer.geometric.cusps import bends
from recognizer.geometric.kernels.corners import cut, described, slowness
from recognizer.geometric.kernels.paths import resampled
from sketch.geometry import distinct
from sketch.ink import FloatArray


@dataclass(frozen=True, slots=True)
class CornerRule:
    """What is a piece, and what is a corner."""

    points: int = 112
    """Points of the path: fourteen on each of eight legs."""
    waver: float = 0.007
    """Distance, rms, that ink strays from the line or arc it follows: tremor, pixels and the quick half of a hand's waver; the
    other half is slow, bends a line to an arc and strays from neither."""
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
    """Length of a piece at an end, at least: a shorter one is a hook of the pen coming down or leaving,"""
    hook_share: float = 0.2
    """unless it is more than this share of the whole path."""
    passing: float = 0.03
    """Length to either side of a place within which the time that the pen spends there is taken,"""
    beside: float = 0.2
    """and how far away it is looked for how quick the pen was just before and after."""
    usual: float = log(2.5)
    """Slowness, its logarithm, of a place that may as well be a corner as not: two strokelets that overlap by a third of their
    time pass from one to the other at two fifths of their speed."""
    telling: float = 1.0
    """Slowness counts up to so much more and less than that, in logarithms: haste rounds a corner in almost full motion."""
    rest: float = 4.0
    """What a piece costs less that ends where the pen is slower by 1, in logarithms, than usual."""
    reach: float = 0.055
    """Length of the two chords between which a corner shows at its own place."""
    tip: int = 3
    """Points to either side of a corner's tip within which the pen may be slowest."""
    shown: float = 0.5
    """Power of the bend that shows at the tip, against 1 of the angle between the pieces: rounding takes it from
    corners, hooks and waver give it to places that turn no further."""
    slowed: float = 0.7
    """Power of the slowness up to the usual one,"""
    halted: float = 0.25
    """and beyond it: that the pen stops altogether says little more."""
    short: float = 0.4
    """Power of the shorter piece over the longest: what is drawn on purpose is of one order of size."""
    curl: float = 0.1
    """What is taken off for each unit of curvature (one over the stroke's size) of either piece: an arc bends by itself."""
    turn: float = radians(22.5)
    """Angle and bend of the slightest corner, between pieces of one length and as slow as usual. Half of the bluntest
    corner that is drawn on purpose (an octagon's 45°)."""


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


def corners(points: FloatArray, times: FloatArray | None = None, rule: CornerRule = CORNERS) -> FloatArray:
    """Where a stroke turns, in drawing order, its ends not among them: (k, 2) in the points' frame. times: (n,)
    seconds at which the pen was there, where they are known."""
    if len(distinct(points)) < 3:
        return np.empty((0, 2))
    path = resampled(np.ascontiguousarray(points), rule.points)
    middle = path.mean(axis=0)
    size = (12 * ((path - middle) ** 2).sum(axis=1).mean()) ** 0.5
    unit = (path - middle) / size
    slow = _slow(points / size, times, rule)
    return path[turns(unit, pieces(unit, slow, rule), slow, rule)]


def _slow(points: FloatArray, times: FloatArray | None, rule: CornerRule) -> FloatArray:
    """How slow the pen was at each point of the path, (points,); as slow as usual where nobody knows."""
    if times is not None:
        slow = slowness(points, np.ascontiguousarray(times), rule.points, rule.passing, rule.beside)
        if not np.isnan(slow[0]):
            return slow
    return np.full(rule.points, rule.usual)


def pieces(path: FloatArray, slow: FloatArray, rule: CornerRule = CORNERS) -> list[Piece]:
    """The lines and arcs that explain an equally spaced path of unit size best for what they cost."""
    rested = np.clip(slow - rule.usual, -rule.telling, rule.telling)
    rested[-1] = 0.0  # the stroke's own end
    ends, bent = cut(
        path, rule.price - rule.rest * rested, 0.5 / rule.waver**2, rule.arc, rule.tightest, rule.widest
    )
    rows = described(path, ends, bent).tolist()
    return [
        Piece(first, last, *row) for (first, last), row in zip(pairwise(ends.tolist()), rows, strict=True)
    ]


def turns(path: FloatArray, found: list[Piece], slow: FloatArray, rule: CornerRule = CORNERS) -> list[int]:
    """Indices of the path's points where pieces that were meant meet at an angle."""
    meant = _meant(found, rule)
    longest = max(piece.length for piece in meant) if meant else 0.0
    step = sum(piece.length for piece in found) / (len(path) - 1)
    bend = np.abs(bends(path, max(round(rule.reach / step), 1)))
    corners: list[int] = []
    for before, after in pairwise(meant):
        angle = abs((after.begins - before.ends + pi) % (2 * pi) - pi)
        tip = _sharpest(path, before.last, after.first)
        shown = float(bend[max(tip - 1, 0) : tip + 2].max())
        rest = float(slow[max(tip - rule.tip, 0) : tip + rule.tip + 1].max()) - rule.usual
        evidence = (
            log(max(angle, 1e-3) / rule.turn)
            + rule.shown * log(max(shown, 1e-3) / rule.turn)
            + rule.slowed * max(min(rest, 0.0), -rule.telling)
            + rule.halted * max(rest, 0.0)
            + rule.short * log(min(before.length, after.length) / longest)
            - rule.curl * (1 / before.radius + 1 / after.radius)
        )
        if evidence > 0:
            corners.append(tip)
    return corners


def _meant(found: list[Piece], rule: CornerRule) -> list[Piece]:
    """The pieces without hooks at the ends and the rounding of corners."""
    hook = min(rule.hook, rule.hook_share * sum(piece.length for piece in found))
    begin, end = 0, len(found)
    while end - begin > 1 and found[begin].length < hook:
        begin += 1
    while end - begin > 1 and found[end - 1].length < hook:
        end -= 1
    return [piece for piece in found[begin:end] if piece.length >= rule.shortest]


def _sharpest(path: FloatArray, first: int, last: int) -> int:
    """The point between two pieces that strays farthest from the chord around them: the corner's tip."""
    low, high = max(first - 2, 0), min(last + 2, len(path) - 1)
    if high - low < 2:
        return first
    (x, y), chord = (path[low : high + 1] - path[low]).T, path[high] - path[low]
    if hypot(*chord) == 0:
        return low + int(np.argmax(np.hypot(x, y)))
    return low + int(np.argmax(np.abs(x * chord[1] - y * chord[0])))
