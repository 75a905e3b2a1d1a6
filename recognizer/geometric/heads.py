"""Arrows in several strokes: a shaft, and beside its end the strokes of a head.

A head is judged in the frame of the shaft's end: barbs on both sides, falling back from a tip that lies on
the shaft's line, and nothing else. Whether the head is one stroke or two, drawn before or after the shaft,
closed or open, is no matter; nor is how the shaft bends farther back. Frame: page units, y down; lengths
are judged against the head's own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from math import radians

import numpy as np
import shapely

from recognizer.geometric.bounds import Bound
from recognizer.geometric.cusps import bends
from recognizer.geometric.kernels.heads import head_shape
from recognizer.geometric.kernels.paths import extent_of, length_of, resampled
from recognizer.group import boxes_of
from sketch.geometry import diagonal, distinct
from sketch.ink import FloatArray, Ink


@dataclass(frozen=True, slots=True)
class HeadRule:
    """What a head is, and where its shaft is."""

    points: int = 32
    """Points of each stroke of a head: sixteen on a barb."""
    larger: float = 1.6
    """Size of a head's stroke over its shaft's, at most: the barbs of a stubby arrow reach back all of it."""
    near: float = 0.35
    """A shaft may end outside a head's box by this share of the box's size: people stop short."""
    candidates: int = 5
    """Strokes near a shaft's end that are tried as its head: where arrows stand among letters there are
    more strokes near, but a head was drawn right before or after its shaft, or little was."""
    aim: float = 0.6
    """The shaft's direction is taken over this share of the head's size before its end."""
    even: Bound = Bound(0.25, 0.06)
    """Lesser over greater reach to the sides: a barb may be short, but there are two."""
    back: Bound = Bound(0.4, 0.07)
    """How far the lesser barb falls back over how far it reaches aside: barbs stand at 60° at most; the
    bar of a T at 90°."""
    slim: Bound = Bound(6.0, 0.8)
    """The same of both barbs together at most: one at 10° is a line drawn again."""
    central: Bound = Bound(0.6, 0.1)
    """Distance of the tip from the shaft's line over half the head's width."""
    ahead: Bound = Bound(1.25, 0.12)
    """How far the tip lies before the shaft's end, in lengths of the head: a shaft may end at the level of the
    barbs' ends or a quarter short of it; beyond, < stands beside −."""
    through: Bound = Bound(0.4, 0.1)
    """How far the shaft runs on past the tip, in lengths of the head: the crossing of a t or an x lies in its
    middle."""
    vee: Bound = Bound(0.1, 0.02)
    """Distance, rms, of the head's ink from its three sides (two barbs and the line between their ends) over its
    size: a letter that lies about a line's end follows none of them."""
    drawn: Bound = Bound(0.16, 0.03)
    """Distance of either barb's middle from the nearest ink, over the head's size: one side of a 4 is open."""
    ink: Bound = Bound(2.9, 0.25)
    """Length of the head's ink over both its barbs: drawn once, or closed, or one barb retraced."""
    joined: Bound = Bound(0.3, 0.06)
    """Distance of the tip from the nearest end of a stroke that is one barb, over that stroke's size."""
    barb_turn: float = radians(75)
    """A shaft's own stroke may go on as the first barb: there the pen turns by more than this,"""
    barb: float = 0.7
    """and goes on for less than this share of the shaft."""
    shaft: Bound = Bound(0.75, 0.08)
    """Length of the shaft over the longer barb: < and − beside each other are about equal."""
    sure: float = -0.7
    """Logarithm of the belief from which it is an arrow: more likely than not."""


HEADS = HeadRule()


@dataclass(frozen=True, slots=True)
class PiecedArrow:
    """An arrow in several strokes: the logarithm of the belief in it, its shaft and its head."""

    belief: float
    shaft: int
    head: tuple[int, ...]

    @property
    def strokes(self) -> tuple[int, ...]:
        return (self.shaft, *self.head)


def pieced_arrows(
    ink: Ink, strokes: Sequence[int], closed: Sequence[int] = (), rule: HeadRule = HEADS
) -> list[PiecedArrow]:
    """The arrows that some of these strokes draw together, the surest first; no stroke is in two. closed:
    strokes that may be a closed head, and no shaft."""
    if len(strokes) == 0 or len(strokes) + len(closed) < 2:
        return []
    long = [*strokes, *closed]
    boxes = boxes_of(ink, long)
    sizes = np.hypot(boxes[:, 2] - boxes[:, 0], boxes[:, 3] - boxes[:, 1])
    moved = sizes > 0
    shafts = [
        shaft
        for index, whole in zip(strokes, moved.tolist(), strict=False)
        if whole
        for shaft in _shafts(index, ink[index].points, rule)
    ]
    long = [index for index, whole in zip(long, moved.tolist(), strict=True) if whole]
    boxes, sizes = boxes[moved], sizes[moved]
    if not shafts:
        return []
    out = rule.near * sizes[:, None] * np.array([-1.0, -1.0, 1.0, 1.0])
    tree = shapely.STRtree(shapely.box(*(boxes + out).T))
    of_end, near = tree.query(shapely.points([shaft.path[-1] for shaft in shafts]))
    lengths = np.array([extent_of(shaft.path) for shaft in shafts])
    fits = sizes[near] <= rule.larger * lengths[of_end]
    candidates: dict[int, list[int]] = {}
    for shaft, head in zip(of_end[fits].tolist(), near[fits].tolist(), strict=True):
        if long[head] != shafts[shaft].stroke:
            candidates.setdefault(shaft, []).append(long[head])
    lines: dict[int, FloatArray] = {}
    found: list[PiecedArrow] = []
    for position, heads in candidates.items():
        shaft = shafts[position]
        latest = sorted(heads, key=lambda head: abs(head - shaft.stroke))[: rule.candidates]
        for head in latest:
            if head not in lines:
                lines[head] = resampled(distinct(ink[head].points), rule.points)
        own = [] if shaft.barb is None else [shaft.barb]
        several = combinations(latest, 2) if shaft.barb is None else ()
        for chosen in (*((head,) for head in latest), *several):
            belief = head_evidence(shaft.path, [*own, *(lines[head] for head in chosen)], rule)
            if belief > rule.sure:
                found.append(PiecedArrow(belief, shaft.stroke, chosen))
    return _apart(found)


@dataclass(frozen=True, slots=True, eq=False)
class _Shaft:
    """A stroke as a shaft: its path from tail to end, and what its pen drew of the head before it left."""

    stroke: int
    path: FloatArray
    barb: FloatArray | None = None


def _shafts(stroke: int, points: FloatArray, rule: HeadRule) -> list[_Shaft]:
    """The stroke as a shaft either way round, and where it turns back sharply, up to there."""
    path = resampled(distinct(points), 2 * rule.points)
    ways = (path, np.ascontiguousarray(path[::-1]))
    found = [_Shaft(stroke, way) for way in ways]
    sharpness = np.abs(bends(path))
    for way, sharp in zip(ways, (sharpness, sharpness[::-1]), strict=True):
        tip = len(way) // 2 + int(np.argmax(sharp[len(way) // 2 :]))
        if sharp[tip] > rule.barb_turn and len(way) - tip < rule.barb * tip:
            found.append(_Shaft(stroke, way[: tip + 1], way[tip:]))
    return found


def head_evidence(shaft: FloatArray, head: Sequence[FloatArray], rule: HeadRule = HEADS) -> float:
    """Logarithm of the belief that the strokes of `head`, (n, 2) each, are the head of an arrow whose
    shaft, (m, 2), ends there."""
    ink = head[0] if len(head) == 1 else np.concatenate(head)
    there, even, fall, falls, central, ahead, vee, gap, barbs, longer, tip = head_shape(
        np.ascontiguousarray(shaft), np.ascontiguousarray(ink), rule.aim
    )
    if not there:
        return -np.inf
    return (
        rule.even.above(even)
        + rule.back.above(fall)
        + rule.slim.below(falls)
        + rule.central.below(central)
        + rule.ahead.below(ahead)
        + rule.through.below(-ahead)
        + rule.vee.below(vee)
        + rule.drawn.below(gap)
        + rule.ink.below(sum(length_of(np.ascontiguousarray(part)) for part in head) / barbs)
        + rule.shaft.above(length_of(np.ascontiguousarray(shaft)) / longer)
        + (_joint(head, tip, rule) if len(head) > 1 else 0.0)
    )


def _joint(barbs: Sequence[FloatArray], tip: FloatArray, rule: HeadRule) -> float:
    """Belief that each barb begins or ends at the tip."""
    gaps = [float(np.hypot(*(barb[[0, -1]] - tip).T).min()) / max(diagonal(barb), 1e-9) for barb in barbs]
    return rule.joined.below(max(gaps))


def _apart(found: list[PiecedArrow]) -> list[PiecedArrow]:
    """The surest arrows of which no two share a stroke; the head in one stroke before the same in more."""
    kept: list[PiecedArrow] = []
    used: set[int] = set()
    for arrow in sorted(found, key=lambda arrow: (-arrow.belief, len(arrow.head))):
        if used.isdisjoint(arrow.strokes):
            kept.append(arrow)
            used.update(arrow.strokes)
    return kept
