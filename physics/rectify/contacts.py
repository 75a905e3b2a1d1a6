"""C2: shapes that are meant to touch are moved until they do, all pairs together.

Circles are moved along their line of centres, others along the minimum-distance vector. What is fixed never
moves. In each cluster of solids that are meant to touch one another, the displacements d of those that can move
minimise Σ m² |d|² under the condition that every pair touches, so that the lighter moves to the heavier, no
pair undoes another, and nothing moves farther than it must. The gaps are not linear in d where a
circle or a corner rolls along another; Newton's method takes the smallest d that closes them to first order,
from where the solids were drawn, until all are closed to 1e-10 and d has settled. A cluster that nothing fixed is in stays where
its heaviest solid is.

Where a cluster cannot have all its contacts (a ball too large for the gap between two walls), the one that is
least plausible is given up, and then the next. Page units, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from physics.rectify.correction import (
    Correction,
    Step,
    carried,
    correction,
    reshaped,
    shapes_of,
    shift,
    taken_along,
)
from physics.rectify.separation import Outline, boxes_apart, outline_of, separation
from sketch.page import Sketch
from sketch.shapes import Circle, Point, Polygon, Shape, Spring, Wire


@dataclass(frozen=True, slots=True)
class ContactRule:
    """When two shapes are meant to touch. Sizes are roots of areas; the smaller of two counts."""

    gap: float = 0.4
    """Share of the size: a ball of 40 units across may hover 14 units above its floor. A long floor
    drawn at 2 degrees is off by that much at its ends once it is level."""
    overlap: float = 0.4
    """Share of the size."""
    most: float = 25.0
    """Page units, for either: two large blocks this far apart were drawn apart."""
    beside: float = 0.2
    """Share of the size, for a gap sideways: nothing must be held up there, so that a visible one is meant."""
    most_beside: float = 10.0
    """Page units, for a gap sideways."""
    bearing: float = 0.3
    """A direction has this share of itself up or down at least where one solid may bear the other: that of an
    incline of 72 degrees."""
    exact: float = 1e-9
    """Page units: already in contact (rounding is a ten-thousandth of it)."""
    closed: float = 1e-10
    """Page units: what is being moved comes this near, and is moved until it moves less than that."""
    heavier: float = 1.05
    """By which one solid must be heavier than another to be surely the heavier of two drawn ones."""
    lightest: float = 1e-3
    """Share of the heaviest mass in a cluster below which all weigh alike."""
    steps: int = 60
    """Newton's; straight faces take two, circles about ten."""
    rounds: int = 10
    """Of adding contacts that come about only when others are closed."""


RULE = ContactRule()


Touching = Callable[[], Mapping[str, frozenset[str]]]
"""What each solid of a page is meant to touch, worked out when it is first asked for."""


@dataclass(frozen=True, slots=True)
class Pair:
    """Two solids (labels) that are meant to touch. slip: how far their gap or overlap is from none, as a share of
    the most that a slip of the pen can be."""

    one: str
    other: str
    slip: float

    @property
    def labels(self) -> frozenset[str]:
        return frozenset((self.one, self.other))


def resting(pairs: Sequence[Pair]) -> dict[str, frozenset[str]]:
    """For every solid that is meant to touch any the labels of those."""
    touching: dict[str, set[str]] = {}
    for pair in pairs:
        touching.setdefault(pair.one, set()).add(pair.other)
        touching.setdefault(pair.other, set()).add(pair.one)
    return {label: frozenset(others) for label, others in touching.items()}


def touch(
    sketch: Sketch, pairs: Sequence[Pair], mass: Callable[[str], float], skipped: Container[str] = ()
) -> Step:
    """C2 on the whole page. pairs: that are meant to touch; mass: of a solid by its label, kg; skipped: labels of
    what stays where it is."""
    outlines = outlines_of(sketch)
    still = {part.label for part in sketch.components if part.fixed or part.label in skipped}
    weight = dict.fromkeys(still, inf)  # the others are weighed where it matters
    known = {pair.labels: pair for pair in pairs}
    shifts: dict[str, Point] = {}
    for _ in range(RULE.rounds):
        shifts = {}
        for cluster in _clusters([pair for pair in known.values() if not pair.labels <= still], still):
            if any(
                abs(separation(outlines[pair.one], outlines[pair.other])[0]) > RULE.exact for pair in cluster
            ):
                for label in {label for pair in cluster for label in pair.labels} - still:
                    weight[label] = mass(label)
                shifts |= _settled(cluster, outlines, weight, skipped)
        if not shifts:
            break
        # What has been moved may have come near to something else, which then belongs to it.
        here = {
            label: outline.shifted(*shifts[label]) if label in shifts else outline
            for label, outline in outlines.items()
        }
        new = {pair.labels: pair for pair in pairs_of(sketch, here) if pair.labels not in known}
        known |= new
        if not new:
            break
    held = frozenset(label for labels in known for label in labels)
    return _moved(sketch, shifts, held) if shifts else Step(sketch)


def outlines_of(sketch: Sketch) -> dict[str, Outline]:
    """The outline of every solid, by label."""
    return {
        part.label: outline_of(part.shape)
        for part in sketch.components
        if isinstance(part.shape, Circle | Polygon)
    }


def pairs_of(sketch: Sketch, outlines: Mapping[str, Outline]) -> list[Pair]:
    """All pairs that are meant to touch, in an order that does not depend on the order of drawing. Two that a link
    joins are not, since the link is what keeps them apart, nor are two that are fixed."""
    fixed = {part.label for part in sketch.components if part.fixed}
    joined = {
        frozenset(part.ends)
        for part in sketch.components
        if isinstance(part.shape, Spring | Wire) and None not in part.ends
    }
    labels = sorted(outlines, key=lambda label: (outlines[label].size, outlines[label].centre))
    if len(labels) < 2:
        return []
    low, high = (np.array([getattr(outlines[label], side) for label in labels]) for side in ("low", "high"))
    # No gap is less than that between the boxes around two outlines.
    near = ((low[:, None] - high[None, :] <= RULE.most).all(axis=2)).astype(bool)
    found: list[Pair] = []
    for i, j in np.argwhere(np.triu(near & near.T, 1)).tolist():
        one, other = labels[i], labels[j]
        if not (one in fixed and other in fixed) and frozenset((one, other)) not in joined:
            slip = _slip(outlines[one], outlines[other])
            if slip is not None:
                found.append(Pair(one, other, slip))
    return found


def _slip(one: Outline, other: Outline) -> float | None:
    """How far a gap or an overlap is from none, as a share of the most that a slip of the pen can be; None for
    what is more."""
    size = min(one.size, other.size)
    if size == 0 or boxes_apart(one, other) > min(RULE.gap * size, RULE.most):
        return None
    gap, (_, y) = separation(one, other)
    most = min((RULE.overlap if gap < 0 else RULE.gap) * size, RULE.most)
    if gap > 0 and abs(y) < RULE.bearing:
        most = min(RULE.beside * size, RULE.most_beside)
    return abs(gap) / most if abs(gap) <= most else None


def _clusters(pairs: list[Pair], still: Container[str]) -> list[list[Pair]]:
    """Pairs that have movable solids in common, directly or through others, belong together."""
    group: dict[str, int] = {}
    clusters: dict[int, list[Pair]] = {}
    for k, pair in enumerate(pairs):
        movable = [label for label in (pair.one, pair.other) if label not in still]
        met = sorted({group[label] for label in movable if label in group})
        clusters[k] = [one for name in met for one in clusters.pop(name)] + [pair]
        group = {label: k if name in met else name for label, name in group.items()} | dict.fromkeys(
            movable, k
        )
    return list(clusters.values())


def _settled(
    pairs: list[Pair], outlines: dict[str, Outline], weight: dict[str, float], skipped: Container[str]
) -> dict[str, Point]:
    """How far each solid of a cluster must be moved."""
    kept = list(pairs)
    labels = list(dict.fromkeys(label for pair in pairs for label in (pair.one, pair.other)))
    movable = [label for label in labels if weight[label] < inf]
    if len(movable) == len(labels):
        heaviest = sorted(movable, key=lambda label: weight[label])
        if weight[heaviest[-1]] > RULE.heavier * weight[heaviest[-2]]:
            movable.remove(heaviest[-1])
    while kept:
        moves, left = _closed(kept, movable, outlines, weight)
        if moves is not None:
            return moves
        # Of those that stand in each other's way, one with something that was not to be moved; then the one
        # that was drawn worst.
        amiss = [k for k, off in enumerate(left) if off >= 1e-3 * max(left)] or range(len(kept))
        kept.pop(max(amiss, key=lambda k: (any(label in skipped for label in kept[k].labels), kept[k].slip)))
    return {}


def _closed(
    pairs: list[Pair], movable: list[str], outlines: dict[str, Outline], weight: dict[str, float]
) -> tuple[dict[str, Point] | None, Sequence[float]]:
    """(the least displacements that close all gaps, or None; what is left of each gap where they cannot be)."""
    column = {label: 2 * k for k, label in enumerate(movable)}
    greatest = max((weight[label] for label in movable), default=1.0)
    ease = np.repeat([1 / max(weight[label] / greatest, RULE.lightest) for label in movable], 2)
    moves = np.zeros(2 * len(movable))
    here = dict(outlines)
    settled = not movable
    gaps = np.zeros(len(pairs))
    for _ in range(RULE.steps):
        slopes = np.zeros((len(pairs), len(moves)))
        for row, pair in enumerate(pairs):
            gaps[row], direction = separation(here[pair.one], here[pair.other])
            for label, sign in ((pair.one, -1.0), (pair.other, 1.0)):
                if label in column:
                    slopes[row, column[label]] = sign * direction[0]
                    slopes[row, column[label] + 1] = sign * direction[1]
        if settled and np.abs(gaps).max() <= RULE.closed:
            return {
                label: (float(moves[k]), float(moves[k + 1]))
                for label, k in column.items()
                if moves[k] or moves[k + 1]
            }, ()
        wanted = slopes @ moves - gaps
        scaled = np.linalg.lstsq(slopes * ease, wanted, rcond=1e-9)[0]
        left = np.abs(slopes @ (ease * scaled) - wanted)
        settled = np.abs(ease * scaled - moves).max(initial=0.0) <= RULE.closed
        moves = ease * scaled
        if left.max() > 1e-6:
            return None, left.tolist()
        for label, k in column.items():
            here[label] = outlines[label].shifted(float(moves[k]), float(moves[k + 1]))
    return None, np.abs(gaps).tolist()


def _moved(sketch: Sketch, shifts: dict[str, Point], held: Container[str]) -> Step:
    """The page with solids moved, one correction for each, and what hangs from them along with them."""
    corrections: list[Correction] = []
    shapes, changed = shapes_of(sketch), dict[str, Shape]()
    attached = {label for part in sketch.components for label in part.ends}
    why = "it is moved into contact with what it was drawn to touch"
    for label in sorted(shifts):
        place = shift(*shifts[label])
        if label in attached:
            moves = taken_along(reshaped(sketch, changed), {label: place}, held)
        else:
            moves = {label: carried(shapes[label], place)}
        corrections += correction("C2", label, shapes, moves, why, f"it goes along with {label}")
        shapes |= moves
        changed |= moves
    return Step(reshaped(sketch, changed), tuple(corrections))
