"""C1: edges that are nearly level or upright, corners that are nearly right angles, edges that are nearly
parallel or nearly as long as one another become so, where that is what the hand meant.

The new vertices are the nearest ones (least squares) that satisfy what was found. Level and upright edges make
their vertices share a height or a column, so that they are exact. Other sides that are parallel or at right
angles to one another share a direction, which is an unknown like the vertices: a side of direction (c, s) from
(x, y) to (u, v) satisfies c (v − y) = s (u − x), or its like for the direction across. These and equal lengths
are solved by Newton's method, each step being the smallest change from the drawn vertices that satisfies them
to first order.

What a hand meant is told from the shape itself. Where its corners or its sides agree to rounding, nobody drew
it by hand: it is turned on purpose, and left alone. Lengths count as equal only within the unsteadiness
that the hand has shown in the directions of the same shape. A block that lies on a slanted side of another, to
rounding, leans as that does.

Winding: a polygon that is corrected comes out anti-clockwise to the eye (with y down, the shoelace area of
`sketch.geometry.signed_area` is then negative, and positive in the scene, where y is up). One that
needs no correction is left as it was drawn, to the bit: which way round it runs cannot be seen on a page, and
a scene's blocks always run anti-clockwise (`physics.parts.solids.hull`).
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, cos, hypot, pi, radians, sin

import numpy as np

from physics.rectify.correction import Correction, Step, correction, reshaped
from physics.rectify.flush import lies_aslant
from physics.rectify.incline import no_worse
from physics.rectify.separation import Outline, outline_of
from sketch.ink import FloatArray
from sketch.page import Sketch
from sketch.shapes import Point, Polygon, Shape


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
    steps: int = 40
    """Newton's, of which eight are enough where the relations agree with one another."""
    solved: float = 1e-13
    """Share of the longest side by which a relation that was solved for may fail."""
    direction: float = 1e-4
    """Weight of a direction that is solved for, beside a vertex's, at the end of the longest side: so little that it
    is free, and so much that rounding does not turn it."""
    settled: float = 1e-12
    """The same, by which the last step may have moved a vertex (or radians, a direction)."""


RULE = StraightRule()


def straighten(sketch: Sketch, angles: Mapping[str, float], skipped: Container[str] = ()) -> Step:
    """C1 on every polygon of the page but those skipped. angles: that are said of inclines, radians, by label, which
    straightening makes no worse."""
    shapes: dict[str, Shape] = {}
    corrections: list[Correction] = []
    outlines: dict[str, Outline] = {}
    why = "its nearly level, upright, parallel, equal or right-angled sides are made so"
    for part in sketch.components:
        if isinstance(part.shape, Polygon) and part.label not in skipped:
            drawn: list[Point] = [(x, y) for x, y in part.shape.vertices.tolist()]
            vertices = _straight(drawn)
            if vertices == drawn:
                continue
            if not outlines:
                outlines = {
                    other.label: outline_of(other.shape)
                    for other in sketch.components
                    if isinstance(other.shape, Polygon)
                }
            own = outlines[part.label]
            (left, top), (right, bottom) = own.low, own.high
            near = [
                other
                for other in outlines.values()
                if other.low[0] < right + 1 and other.high[0] > left - 1
                if other.low[1] < bottom + 1 and other.high[1] > top - 1
            ]
            if not any(other is not own and lies_aslant(other, own) for other in near):
                shape = Polygon(_wound(vertices))
                if part.label in angles:
                    shape = no_worse(part.shape, shape, angles[part.label])
                shapes[part.label] = shape
                before: dict[str, Shape] = {part.label: part.shape}
                corrections += correction("C1", part.label, before, {part.label: shape}, why, why)
    return Step(reshaped(sketch, shapes), tuple(corrections))


def _straight(drawn: list[Point]) -> list[Point]:
    """The polygon's vertices with all that is meant made so, until nothing more is found; the same list where
    nothing is to be done, or where it has no end within reason."""
    if all(x == 0 or y == 0 for x, y in _sides(drawn)):
        return drawn  # nothing leans
    result = drawn
    for _ in range(RULE.rounds):
        after = _once(result)
        if after == result:
            return result
        if result is not drawn and not _plausible(drawn, after):
            return drawn
        if all(x == 0 or y == 0 for x, y in _sides(after)):
            return after  # nothing leans any more
        result = after
    return drawn


def _once(drawn: list[Point]) -> list[Point]:
    if _turned_on_purpose(drawn):
        return drawn
    level, upright = _leaning(drawn)
    level, upright, result = _levelled(drawn, level, upright)
    return _related(drawn, result, level, upright)


def _turned_on_purpose(vertices: list[Point]) -> bool:
    """Whether all corners are right angles, or all sides as long as one another, or one corner of a triangle
    a right angle, to rounding."""
    sides = _sides(vertices)
    lengths = [hypot(x, y) for x, y in sides]
    if max(lengths) - min(lengths) <= RULE.exact:
        return True
    right = (
        (pi / 2 - _between(sides[k - 1], sides[k])) * max(lengths[k - 1], lengths[k]) <= RULE.exact
        for k in range(len(sides))
    )
    return any(right) if len(sides) == 3 else all(right)


def _leaning(vertices: list[Point]) -> tuple[frozenset[int], frozenset[int]]:
    """(nearly level, nearly upright) sides, each by its first vertex."""
    sides = _sides(vertices)
    leans = [_lean(side) for side in sides]
    shared, _ = _directions(sides, frozenset(), frozenset())
    exact = any(abs(lean) * hypot(*side) <= RULE.exact for (lean, _), side in zip(leans, sides, strict=True))
    most = RULE.lean_beside_exact if exact else RULE.lean
    # Sides that belong together lean together: one side of a box that stands aslant is not level by itself.
    for name in {one[0] for one in shared if one is not None}:
        own = [(side, one[1]) for side, one in zip(sides, shared, strict=True) if one and one[0] == name]
        mean = _mean_direction(own)
        for k, one in enumerate(shared):
            if one and one[0] == name:
                angle = mean + (pi / 2 if one[1] else 0.0)
                leans[k] = _lean((cos(angle), sin(angle)))
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
    whole, left = _area(drawn), _area(after)
    xs, ys = [x for x, _ in drawn], [y for _, y in drawn]
    extent = hypot(max(xs) - min(xs), max(ys) - min(ys))
    most = max(hypot(x - u, y - v) for (x, y), (u, v) in zip(drawn, after, strict=True))
    return left * whole > 0 and abs(left) >= RULE.least_area * abs(whole) and most <= RULE.farthest * extent


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
    members: dict[int, list[float]] = {}
    group = _groups(len(values), edges)
    for name, value in zip(group, values, strict=True):
        members.setdefault(name, []).append(value)
    shared = {
        name: sum(sorted(several)) / len(several) if len(set(several)) > 1 else several[0]
        for name, several in members.items()
    }
    return [shared[name] for name in group]


def _related(
    drawn: list[Point], vertices: list[Point], level: frozenset[int], upright: frozenset[int]
) -> list[Point]:
    """The vertices with right angles, parallels and equal lengths as well, as far as they can be had."""
    sides = _sides(vertices)
    lengths = [hypot(x, y) for x, y in sides]
    directions, off = _directions(sides, level, upright)
    shown = max(off, max(hypot(x - u, y - v) for (x, y), (u, v) in zip(drawn, vertices, strict=True)))
    result = vertices
    if off > RULE.exact:
        result = _nearest(vertices, level, upright, directions, []) or vertices
    equal: list[tuple[int, int]] = []
    found: list[tuple[float, int, int]] = []
    for k in range(len(sides)):
        other = (k + 1) % len(sides)
        by, longer = abs(lengths[k] - lengths[other]), max(lengths[k], lengths[other])
        if shown > RULE.exact and by <= min(RULE.unsteady * shown, RULE.equal * longer):
            found.append((by, k, other))
    for _, k, other in sorted(found):  # the truest first
        now = [hypot(x, y) for x, y in _sides(result)]
        if abs(now[k] - now[other]) > RULE.exact:  # others may have made them so
            after = _nearest(vertices, level, upright, directions, [*equal, (k, other)])
            if after is not None and _plausible(drawn, after):
                equal.append((k, other))
                result = after
    return result if result is vertices or _plausible(drawn, result) else vertices


_Directions = list[tuple[int, bool] | None]
"""Of each side that is neither level nor upright: which unknown direction it has, by number, and whether it
lies across it; None where it has one of its own."""


def _directions(
    sides: list[Point], level: frozenset[int], upright: frozenset[int]
) -> tuple[_Directions, float]:
    """(which sides share directions; by how much they are off, page units)."""
    count = len(sides)
    straight = level | upright
    if len(straight) == count:
        return [None] * count, 0.0
    # What is straight lies along an axis, as truly as can be.
    meant = [((k or count) - 1, k, True) for k in range(count)]
    if count % 2 == 0:
        meant += [(k, k + count // 2, False) for k in range(count // 2)]
    found: list[tuple[float, int, int, bool]] = []
    for one, other, across in meant:
        if one not in straight and other not in straight:
            angle = _between(sides[one], sides[other])
            angle, most = (pi / 2 - angle, RULE.right) if across else (angle, RULE.parallel)
            if angle <= most:
                found.append((angle, one, other, across))
    group: list[tuple[int, bool]] = [(k, False) for k in range(count)]
    off = 0.0
    for angle, one, other, across in sorted(found):  # the truest first
        (name, turned), (old, other_turned) = group[one], group[other]
        flip = turned ^ other_turned ^ across
        if name != old:
            group = [(name, way ^ flip) if at == old else (at, way) for at, way in group]
        elif flip:
            continue  # these two are related otherwise already
        off = max(off, angle * max(hypot(*sides[one]), hypot(*sides[other])) / 2)
    names = [at for at, _ in group]
    return [one if names.count(one[0]) > 1 else None for one in group], off


def _nearest(
    start: list[Point],
    level: frozenset[int],
    upright: frozenset[int],
    directions: _Directions,
    equal: list[tuple[int, int]],
) -> list[Point] | None:
    """The vertices nearest to `start` whose sides have these directions and equal lengths, with what is level
    and upright kept; None where Newton's method finds none."""
    count = len(start)
    columns, rows = _groups(count, upright), _groups(count, level)
    names: list[tuple[str, int]] = sorted(
        {("x", name) for name in columns}
        | {("y", name) for name in rows}
        | {("angle", one[0]) for one in directions if one is not None}
    )
    index = {name: k for k, name in enumerate(names)}
    at_x = [index["x", name] for name in columns]
    at_y = [index["y", name] for name in rows]
    home, weight = np.zeros(len(names)), np.zeros(len(names))
    for (x, y), i, j in zip(start, at_x, at_y, strict=True):
        home[i], home[j] = x, y
        weight[i] += 1  # a coordinate that several vertices share weighs as much as all of them
        weight[j] += 1
    sides = _sides(start)
    size = max(hypot(x, y) for x, y in sides)
    for name, at in index.items():
        if name[0] == "angle":
            # The mean direction of its sides, which does not depend on where the outline begins; nearly any
            # other is as good.
            home[at] = _mean_direction(
                [
                    (side, one[1])
                    for side, one in zip(sides, directions, strict=True)
                    if one and one[0] == name[1]
                ]
            )
            weight[at] = RULE.direction * size * size
    ease = 1 / np.sqrt(weight)
    values = home.copy()
    settled = False
    for _ in range(RULE.steps):
        off, slopes = _conditions(values, at_x, at_y, index, directions, equal)
        if settled and np.abs(off).max() <= RULE.solved * size:
            return [(float(values[i]), float(values[j])) for i, j in zip(at_x, at_y, strict=True)]
        change = np.linalg.lstsq(slopes * ease, slopes @ (values - home) - off, rcond=1e-11)[0]
        after = home + ease * change
        settled = bool(np.abs(after - values).max() <= RULE.settled * size)
        values = after
    return None


def _mean_direction(sides: list[tuple[Point, bool]]) -> float:
    """Of sides that are parallel, or (True) across, up to the hand's unsteadiness; radians, up to half a turn."""
    angles = [(2 * (atan2(y, x) - (pi / 2 if across else 0.0)), x * x + y * y) for (x, y), across in sides]
    return atan2(sum(w * sin(a) for a, w in angles), sum(w * cos(a) for a, w in angles)) / 2


def _conditions(
    values: FloatArray,
    at_x: list[int],
    at_y: list[int],
    index: dict[tuple[str, int], int],
    directions: _Directions,
    equal: list[tuple[int, int]],
) -> tuple[FloatArray, FloatArray]:
    """(what must be zero, page units; its slopes against all unknowns)."""
    count = len(at_x)
    dx = [values[at_x[(k + 1) % count]] - values[at_x[k]] for k in range(count)]
    dy = [values[at_y[(k + 1) % count]] - values[at_y[k]] for k in range(count)]
    off: list[float] = []
    slopes: list[FloatArray] = []

    def condition(value: float, along: list[tuple[int, float, float]]) -> FloatArray:
        """along: (side, slope against its dx, against its dy)."""
        row = np.zeros(len(values))
        for k, gx, gy in along:
            for vertex, sign in ((k, -1.0), ((k + 1) % count, 1.0)):
                row[at_x[vertex]] += sign * gx
                row[at_y[vertex]] += sign * gy
        off.append(value)
        slopes.append(row)
        return row

    for k, one in enumerate(directions):
        if one is not None:
            name = index["angle", one[0]]
            angle = values[name] + (pi / 2 if one[1] else 0.0)
            c, s = cos(angle), sin(angle)
            condition(c * dy[k] - s * dx[k], [(k, -s, c)])[name] -= s * dy[k] + c * dx[k]
    for one, other in equal:
        a, b = hypot(dx[one], dy[one]), hypot(dx[other], dy[other])
        condition(a - b, [(one, dx[one] / a, dy[one] / a), (other, -dx[other] / b, -dy[other] / b)])
    return np.array(off), np.array(slopes)


def _between(one: Point, other: Point) -> float:
    """The angle between two sides, from 0 (parallel) to π/2."""
    return atan2(abs(one[0] * other[1] - one[1] * other[0]), abs(one[0] * other[0] + one[1] * other[1]))


def _sides(vertices: list[Point]) -> list[Point]:
    """From each vertex to the next."""
    return [(u - x, v - y) for (x, y), (u, v) in pairwise([*vertices, vertices[0]])]


def _area(vertices: list[Point]) -> float:
    """Shoelace, positive clockwise to the eye."""
    return 0.5 * sum(x * v - y * u for (x, y), (u, v) in pairwise([*vertices, vertices[0]]))


def _wound(vertices: list[Point]) -> list[Point]:
    """The same vertices from the same first one, anti-clockwise to the eye."""
    return vertices if _area(vertices) <= 0 else [vertices[0], *vertices[:0:-1]]
