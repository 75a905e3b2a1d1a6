"""C1: edges that are nearly level or upright, corners that are nearly right angles, edges that are nearly
parallel or nearly as long as one another become so, where that is what the hand meant.

The new vertices are the nearest ones (least squares) that satisfy what was found. Level and upright edges make
their vertices share a height or a column, so that they are exact; the others are solved for in what is
left, by Newton's method on the constraints from the drawn vertices (each step the smallest change that
satisfies the linearised constraints).

What a hand meant is told from the shape itself. Where its corners or its sides agree to rounding, nobody drew
it by hand: it is turned on purpose, and left alone. Lengths count as equal only within the unsteadiness
that the hand has shown in the directions of the same shape.

Winding: a polygon that is corrected comes out anti-clockwise to the eye (with y down, the shoelace area of
`sketch.geometry.signed_area` is then negative, and positive in the scene, where y is up). One that
needs no correction is left as it was drawn, to the bit: which way round it runs cannot be seen on a page, and
a scene's blocks always run anti-clockwise (`physics.parts.solids.hull`).
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, hypot, pi, radians
from typing import Literal

import numpy as np

from physics.rectify.correction import Correction, Step, made
from sketch.ink import FloatArray
from sketch.page import Sketch
from sketch.shapes import Point, Polygon


@dataclass(frozen=True, slots=True)
class StraightRule:
    """When a relation is meant. Angles in radians."""

    lean: float = radians(12)
    """From the axis: short edges of hand-drawn boxes lean by up to 9 degrees; inclines are steeper."""
    lean_beside_exact: float = radians(4)
    """The same of a shape that has an edge level or upright to rounding: no hand drew that one, so the others
    lean on purpose if they lean visibly."""
    right: float = radians(8)
    """A corner's angle from a right one: both its sides lean, in a box that stands aslant."""
    parallel: float = radians(6)
    """Between two opposite sides: they are seen together, and drawn truer than one against the page."""
    equal: float = 0.08
    """Share by which two sides that are meant to be equal may differ at most; and:"""
    unsteady: float = 2.0
    """Their difference may be this many times the way by which the shape's vertices are off in direction: the
    error of a length is that of two vertices."""
    exact: float = 1e-9
    """Page units, at the end of the longest side: what is off by less is off by rounding."""
    least_area: float = 0.5
    """Share of its area that a polygon must keep: a flat triangle is not to be pressed flat."""
    farthest: float = 0.12
    """Share of the shape's extent that a vertex may move: 12 degrees of lean on its longest side."""
    rounds: int = 4
    """Straightening one edge turns its neighbours, which may then be nearly level too."""
    steps: int = 30
    """Newton's, of which six are enough for 1e-12 where the relations agree with one another."""


RULE = StraightRule()
Relation = tuple[Literal["right", "parallel", "equal"], int, int]
"""A corner (twice), or two sides, by the number of the vertex at which each begins."""


def straighten(sketch: Sketch, skipped: Container[str] = ()) -> Step:
    """C1 on every polygon of the page but those skipped."""
    after = sketch
    corrections: list[Correction] = []
    why = "its nearly level, upright, parallel, equal or right-angled sides are made so"
    for part in sketch.components:
        if isinstance(part.shape, Polygon) and part.label not in skipped:
            drawn: list[Point] = [(x, y) for x, y in part.shape.vertices.tolist()]
            vertices = _straight(drawn)
            if vertices != drawn:
                step = made("C1", part.label, after, {part.label: Polygon(_wound(vertices))}, why, why)
                after = step.sketch
                corrections += step.corrections
    return Step(after, tuple(corrections))


def _straight(drawn: list[Point]) -> list[Point]:
    """The polygon's vertices with all that is meant made so; the same list where nothing is to be done."""
    if _turned_on_purpose(drawn):
        return drawn
    level: frozenset[int] = frozenset()
    upright: frozenset[int] = frozenset()
    result = drawn
    for _ in range(RULE.rounds):
        found = _leaning(result)
        if found[0] <= level and found[1] <= upright:
            break
        level, upright = level | found[0], upright | found[1]
        level, upright, after = _levelled(drawn, level, upright)
        if after == result:
            break
        result = after
    related = _related(drawn, result, level, upright)
    return result if related is None else related


def _turned_on_purpose(vertices: list[Point]) -> bool:
    """Whether all corners are right angles, or all sides as long as one another, or one corner of a triangle
    a right angle, to rounding."""
    sides = _sides(vertices)
    longest = max(hypot(x, y) for x, y in sides)
    right = [_off(("right", k, k), sides) <= RULE.exact for k in range(len(sides))]
    if all(right) or (len(sides) == 3 and any(right)):
        return True
    lengths = [hypot(x, y) for x, y in sides]
    return longest - min(lengths) <= RULE.exact


def _leaning(vertices: list[Point]) -> tuple[frozenset[int], frozenset[int]]:
    """(nearly level, nearly upright) sides, each by its first vertex."""
    sides = _sides(vertices)
    leans = [_lean(side) for side in sides]
    exact = any(abs(lean) * hypot(*side) <= RULE.exact for (lean, _), side in zip(leans, sides, strict=True))
    most = RULE.lean_beside_exact if exact else RULE.lean
    level = frozenset(k for k, (lean, across) in enumerate(leans) if lean <= most and across)
    upright = frozenset(k for k, (lean, across) in enumerate(leans) if lean <= most and not across)
    return level, upright


def _lean(side: Point) -> tuple[float, bool]:
    """(radians from the nearer axis, whether that is the level one)."""
    angle = abs(atan2(side[1], side[0]))
    level = min(angle, pi - angle)
    return (level, True) if level <= pi / 4 else (abs(angle - pi / 2), False)


def _levelled(
    drawn: list[Point], level: frozenset[int], upright: frozenset[int]
) -> tuple[frozenset[int], frozenset[int], list[Point]]:
    """The vertices with these sides level and upright, and which could be: the ones that lean most are given up
    until the shape keeps its area and no vertex goes too far."""
    leans = {k: _lean(side)[0] for k, side in enumerate(_sides(drawn))}
    while True:
        columns = _shared([x for x, _ in drawn], upright)
        rows = _shared([y for _, y in drawn], level)
        after = list(zip(columns, rows, strict=True))
        if not (level or upright) or _plausible(drawn, after):
            return level, upright, after
        worst = max(level | upright, key=lambda k: (leans[k], k))
        level, upright = level - {worst}, upright - {worst}


def _plausible(drawn: list[Point], after: list[Point]) -> bool:
    whole = _area(drawn)
    xs, ys = [x for x, _ in drawn], [y for _, y in drawn]
    extent = hypot(max(xs) - min(xs), max(ys) - min(ys))
    most = max(hypot(x - u, y - v) for (x, y), (u, v) in zip(drawn, after, strict=True))
    return _area(after) * whole > 0 and (
        abs(_area(after)) >= RULE.least_area * abs(whole) and most <= RULE.farthest * extent
    )


def _groups(count: int, edges: frozenset[int]) -> list[int]:
    """For each vertex the least one of those that the edges join it to."""
    group = list(range(count))
    for edge in sorted(edges):
        one, other = group[edge], group[(edge + 1) % count]
        low, high = min(one, other), max(one, other)
        group = [low if name == high else name for name in group]
    return group


def _shared(values: list[float], edges: frozenset[int]) -> list[float]:
    """Values with one mean for all vertices that the edges join."""
    group = _groups(len(values), edges)
    result = list(values)
    for name in set(group):
        members = [values[k] for k in range(len(values)) if group[k] == name]
        if len(set(members)) > 1:
            mean = sum(sorted(members)) / len(members)
            result = [mean if group[k] == name else value for k, value in enumerate(result)]
    return result


def _related(
    drawn: list[Point], vertices: list[Point], level: frozenset[int], upright: frozenset[int]
) -> list[Point] | None:
    """The vertices with right angles, parallels and equal lengths as well; None where there are none to make.
    What cannot all be had is given up from the last kind on."""
    sides = _sides(vertices)
    straight = level | upright
    found: list[Relation] = [
        ("right", k, k)
        for k in range(len(sides))
        # Two sides that lie along the axes are at right angles already.
        if not {k, (k - 1) % len(sides)} <= straight and _angle_off(("right", k, k), sides) <= RULE.right
    ]
    half = len(sides) // 2
    if len(sides) % 2 == 0:
        found += [
            ("parallel", k, k + half)
            for k in range(half)
            if not {k, k + half} <= straight
            and _angle_off(("parallel", k, k + half), sides) <= RULE.parallel
        ]
    moved = max(hypot(x - u, y - v) for (x, y), (u, v) in zip(drawn, vertices, strict=True))
    shown = max([moved, *(_off(relation, sides) / 2 for relation in found)])
    lengths = [hypot(x, y) for x, y in sides]
    equal: list[Relation] = []
    for k in range(len(sides)):
        other = (k + 1) % len(sides)
        most = min(RULE.unsteady * shown, RULE.equal * max(lengths[k], lengths[other]))
        if shown > RULE.exact and abs(lengths[k] - lengths[other]) <= most:
            equal.append(("equal", k, other))
    for relations in (found + equal, found):
        if not relations or all(_off(relation, sides) <= RULE.exact for relation in relations):
            continue
        after = _nearest(drawn, vertices, relations, level, upright)
        if after is not None and _plausible(drawn, after):
            return after
    return None


def _nearest(
    drawn: list[Point],
    start: list[Point],
    relations: list[Relation],
    level: frozenset[int],
    upright: frozenset[int],
) -> list[Point] | None:
    """The vertices nearest to those drawn that satisfy the relations, with what is level and upright kept; None
    where there are none."""
    count = len(drawn)
    columns, rows = _groups(count, upright), _groups(count, level)
    unknowns = sorted({(0, name) for name in columns} | {(1, name) for name in rows})
    index = {name: k for k, name in enumerate(unknowns)}
    where = np.array([index[0, name] for name in columns] + [index[1, name] for name in rows])
    # A coordinate that several vertices share weighs as much as all of them.
    weight = np.sqrt(np.bincount(where))
    home = np.array([x for x, _ in start] + [y for _, y in start])
    base = np.zeros(len(unknowns))
    base[where] = home  # where several vertices share a coordinate, `start` holds their mean
    values = base.copy()
    for _ in range(RULE.steps):
        x, y = values[where[:count]], values[where[count:]]
        off, slopes = _constraints(x, y, relations)
        if np.abs(off).max() <= 1e-13:
            break
        folded = np.zeros((len(relations), len(unknowns)))
        np.add.at(folded.T, where, slopes.T)
        scaled = folded / weight
        change = np.linalg.lstsq(scaled, folded @ (values - base) - off, rcond=1e-10)[0]
        values = base + change / weight
    else:
        if np.abs(off).max() > 1e-12:
            return None
    x, y = values[where[:count]], values[where[count:]]
    return list(zip(x.tolist(), y.tolist(), strict=True))


def _constraints(x: FloatArray, y: FloatArray, relations: list[Relation]) -> tuple[FloatArray, FloatArray]:
    """(values, (k,); slopes against x and then y of all vertices, (k, 2 n)), each without a unit."""
    count = len(x)
    dx, dy = np.roll(x, -1) - x, np.roll(y, -1) - y
    scale = float(np.hypot(dx, dy).max()) ** 2
    off, slopes = np.zeros(len(relations)), np.zeros((len(relations), 2 * count))
    for row, (kind, i, j) in enumerate(relations):
        one, other = ((i - 1) % count, i) if kind == "right" else (i, j)
        (ax, ay), (bx, by) = (dx[one], dy[one]), (dx[other], dy[other])
        if kind == "right":
            value, along = ax * bx + ay * by, (bx, by, ax, ay)
        elif kind == "parallel":
            value, along = ax * by - ay * bx, (by, -bx, -ay, ax)
        else:
            value, along = 0.5 * (ax * ax + ay * ay - bx * bx - by * by), (ax, ay, -bx, -by)
        off[row] = value / scale
        for side, (gx, gy) in ((one, along[:2]), (other, along[2:])):
            for vertex, sign in ((side, -1.0), ((side + 1) % count, 1.0)):
                slopes[row, vertex] += sign * gx / scale
                slopes[row, count + vertex] += sign * gy / scale
    return off, slopes


def _angle_off(relation: Relation, sides: list[Point]) -> float:
    """By how much a relation of directions fails, radians."""
    kind, i, j = relation
    (ax, ay), (bx, by) = sides[i - 1] if kind == "right" else sides[i], sides[j]
    cross, dot = abs(ax * by - ay * bx), abs(ax * bx + ay * by)
    return atan2(dot, cross) if kind == "right" else atan2(cross, dot)


def _off(relation: Relation, sides: list[Point]) -> float:
    """By how much a relation fails, page units at the end of the longer side."""
    kind, i, j = relation
    one, other = sides[i - 1] if kind == "right" else sides[i], sides[j]
    if kind == "equal":
        return abs(hypot(*one) - hypot(*other))
    return _angle_off(relation, sides) * max(hypot(*one), hypot(*other))


def _sides(vertices: list[Point]) -> list[Point]:
    """From each vertex to the next."""
    return [(u - x, v - y) for (x, y), (u, v) in pairwise([*vertices, vertices[0]])]


def _area(vertices: list[Point]) -> float:
    """Shoelace, positive clockwise to the eye."""
    return 0.5 * sum(x * v - y * u for (x, y), (u, v) in pairwise([*vertices, vertices[0]]))


def _wound(vertices: list[Point]) -> list[Point]:
    """The same vertices from the same first one, anti-clockwise to the eye."""
    return vertices if _area(vertices) <= 0 else [vertices[0], *vertices[:0:-1]]
