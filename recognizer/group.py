"""Which strokes belong together: outlines drawn in several strokes, lines of mathematics.

Frame: page units, y down. Neighbours are found with a spatial index: a page of 10,000 strokes
takes seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

from recognizer.claims import Bonds
from sketch.geometry import diagonal
from sketch.ink import FloatArray, Ink


@dataclass(frozen=True, slots=True)
class GroupRule:
    """What is near enough to belong together."""

    joint: tuple[float, float] = (0.25, 0.05)
    """Gap between two strokes' ends over the shorter and the longer stroke's size, added up, where an
    outline goes on: a corner is missed by a share of either side."""
    closed: float = 0.08
    """Gap between a stroke's own ends over its size, below which it is an outline by itself."""
    neighbours: int = 6
    """Nearest ends that are looked at: where sides, wires and a letter meet there are no more."""
    letter_gap: float = 1.0
    """Gap along a line of mathematics, in letter heights: a wide space around = is one."""
    line_gap: float = 0.35
    """Gap between what stands above and below in one line (fractions, = and dots), in letter
    heights; lines of writing stand further apart."""
    bond: float = 0.5
    """Mean probability that the strokes of two sets are of one thing, from which they are: more likely than not."""
    flat: float = 0.3
    """Height over width: below it a bar, which says nothing of the letters' height."""


GROUP = GroupRule()


def chains(ink: Ink, strokes: Sequence[int], rule: GroupRule = GROUP) -> list[tuple[int, ...]]:
    """Sets of two or more of these strokes that, end to end, close an outline.

    Strokes with an end that meets nothing are left out first (a wire that ends at a corner would
    otherwise come between the sides that meet there); then each end goes on with the nearest.
    """
    ends = np.array([ink[index].points[end] for index in strokes for end in (0, -1)]).reshape(-1, 2)
    sizes = np.array([diagonal(ink[index].points) for index in strokes])
    joints = _joints(ends, sizes, rule)
    partner = _partners(joints, len(strokes))
    found: list[tuple[int, ...]] = []
    seen: set[int] = set()
    for first in range(len(strokes)):
        chain, end = [first], partner.get(2 * first + 1)
        while end is not None and end // 2 not in chain and end // 2 not in seen:
            chain.append(end // 2)
            end = partner.get(end ^ 1)
        if len(chain) > 1 and end == 2 * first:
            seen.update(chain)
            found.append(tuple(sorted(strokes[index] for index in chain)))
    return found


def bound(strokes: Sequence[int], bonds: Bonds, rule: GroupRule = GROUP) -> list[tuple[int, ...]]:
    """These strokes as things, by what a recognizer says of every two of them; every stroke is in one.

    The surest pair is joined first, and two sets are joined while the mean over all pairs between them is
    more likely than not: one doubtful bridge makes no thing of two.
    """
    chosen = np.asarray(strokes, dtype=np.int64)
    inside = np.isin(bonds.pairs, chosen).all(axis=1)
    pairs, scores = np.searchsorted(np.sort(chosen), bonds.pairs[inside]), bonds.scores[inside]
    sure = pairs[scores > rule.bond]
    graph = coo_array((np.ones(len(sure), dtype=np.int8), (sure[:, 0], sure[:, 1])), shape=(len(chosen),) * 2)
    # Sets are joined only where some pair is likely: what no such pair connects is told apart at once.
    count, part = connected_components(graph, directed=False)
    found: list[tuple[int, ...]] = []
    for number in range(count):
        members = np.flatnonzero(part == number)
        between = np.zeros((len(members), len(members)))
        of_part = part[pairs[:, 0]] == number
        of_part &= part[pairs[:, 1]] == number
        first, second = np.searchsorted(members, pairs[of_part]).T
        between[first, second] = between[second, first] = scores[of_part]
        found += [tuple(np.sort(chosen)[members[one]].tolist()) for one in _linked(between, rule.bond)]
    return found


def _linked(between: FloatArray, least: float) -> list[list[int]]:
    """Average linkage: sets of rows, joined while the mean score between two of them is above `least`."""
    sets = [[row] for row in range(len(between))]
    while len(sets) > 1:
        counts = np.array([len(one) for one in sets])
        mean = between / np.outer(counts, counts)
        i, j = divmod(int(np.argmax(mean)), len(sets))
        if mean[i, j] <= least:
            break
        keep, gone = min(i, j), max(i, j)
        sets[keep] += sets.pop(gone)
        between[keep] += between[gone]
        between[:, keep] += between[:, gone]
        between = np.delete(np.delete(between, gone, axis=0), gone, axis=1)
        between[keep, keep] = 0.0
    return [sorted(one) for one in sets]


def apart(strokes: Sequence[int], bonds: Bonds, rule: GroupRule = GROUP) -> bool:
    """Whether a recognizer says that these strokes are not one thing: every two of them, on the mean."""
    inside = np.isin(bonds.pairs, strokes).all(axis=1)
    return 2 * float(bonds.scores[inside].sum()) / (len(strokes) * (len(strokes) - 1)) < rule.bond


def lines(ink: Ink, strokes: Sequence[int], rule: GroupRule = GROUP) -> list[tuple[int, ...]]:
    """These strokes as lines of writing, each in drawing order, in reading order of their tops.

    Strokes belong to one line where their boxes, let out by a letter's height to the sides and a
    quarter of one up and down, meet.
    """
    if not strokes:
        return []
    boxes = boxes_of(ink, strokes)
    height = letter_height(boxes, rule)
    out = np.array([0.5 * rule.letter_gap, 0.5 * rule.line_gap]) * height
    grown = boxes + np.concatenate([-out, out])
    # Strokes in the same place are one for this purpose: a heap of them costs nothing.
    places, place = np.unique(grown, axis=0, return_inverse=True)
    shapes = shapely.box(*places.T)
    here, there = shapely.STRtree(shapes).query(shapes)
    graph = coo_array((np.ones(len(here), dtype=np.int8), (here, there)), shape=(len(places),) * 2)
    _, line = connected_components(graph, directed=False)
    members: dict[int, list[int]] = {}
    for position, index in enumerate(strokes):
        members.setdefault(int(line[place.ravel()[position]]), []).append(index)
    tops = {key: boxes_of(ink, value)[:, [1, 0]].min(axis=0).tolist() for key, value in members.items()}
    return [tuple(members[key]) for key in sorted(members, key=lambda key: tops[key])]


def boxes_of(ink: Ink, strokes: Sequence[int]) -> FloatArray:
    """(left, top, right, bottom) of each stroke: (n, 4)."""
    return np.array(
        [np.concatenate([ink[i].points.min(axis=0), ink[i].points.max(axis=0)]) for i in strokes]
    ).reshape(-1, 4)


def letter_height(boxes: FloatArray, rule: GroupRule = GROUP) -> float:
    """The height of a letter of full size among these boxes, the upper quartile: indices and parts of
    letters are lower. Bars count only where there is nothing else, by their width."""
    width, height = boxes[:, 2] - boxes[:, 0], boxes[:, 3] - boxes[:, 1]
    upright = height > rule.flat * width
    return float(np.quantile(height[upright], 0.75) if upright.any() else np.median(width))


def _joints(ends: FloatArray, sizes: FloatArray, rule: GroupRule) -> list[tuple[float, int, int]]:
    """(gap, end, end) of the ends near enough to go on in one another, the closest first. Ends 2i and
    2i + 1 are stroke i's. A stroke whose own ends meet is an outline by itself and joins nothing."""
    if len(ends) < 4:
        return []
    own = np.hypot(*np.transpose(ends[0::2] - ends[1::2])).tolist()
    whole = [gap < rule.closed * size for gap, size in zip(own, sizes.tolist(), strict=True)]
    count = min(rule.neighbours + 1, len(ends))
    found = KDTree(ends).query(ends, k=count)
    away, near = np.asarray(found[0]), np.asarray(found[1])
    joints: list[tuple[float, int, int]] = []
    for end in range(len(ends)):
        for gap, other in zip(away[end].tolist(), near[end].tolist(), strict=True):
            i, j = end // 2, other // 2
            shorter, longer = sorted((float(sizes[i]), float(sizes[j])))
            reach = rule.joint[0] * shorter + rule.joint[1] * longer
            if end < other and i != j and gap <= min(reach, own[i], own[j]) and not (whole[i] or whole[j]):
                joints.append((gap, end, other))
    return sorted(joints)


def _partners(joints: list[tuple[float, int, int]], count: int) -> dict[int, int]:
    """Which end goes on in which, both ways, of strokes both of whose ends go on."""
    alive = set(range(count))
    while True:
        meeting = {end for _, a, b in joints if {a // 2, b // 2} <= alive for end in (a, b)}
        through = {stroke for stroke in alive if {2 * stroke, 2 * stroke + 1} <= meeting}
        if through == alive:
            break
        alive = through
    partner: dict[int, int] = {}
    for _, a, b in joints:
        if {a // 2, b // 2} <= alive and a not in partner and b not in partner:
            partner[a], partner[b] = b, a
    return partner
