"""Soft rules: how well one stroke, seen alone, answers to each kind.

Every rule is a sum of logarithms of soft comparisons, each near 0 where the stroke is as the kind
should be and falling where it is not; `evidence` gives the sum for each kind. Thresholds lie
where the geometry of neighbouring kinds puts them, midway between the shapes named. None was
fitted by an optimiser, but some were added or moved after a look at strokes of people that earlier
versions misread. Frame: lengths are fractions of the stroke's size (its bounding box's diagonal).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, hypot, log, log1p, radians

import numpy as np

from recognizer.geometric.arrows import head
from recognizer.geometric.bounds import Bound
from recognizer.geometric.heads import head_evidence
from recognizer.geometric.kernels.paths import prepared, straightness
from recognizer.geometric.kernels.rings import turning_shares
from recognizer.geometric.legs import best_legs
from recognizer.geometric.ring import Ring, ring
from recognizer.geometric.teeth import Teeth, teeth
from recognizer.preprocess import SPACING
from sketch.ink import FloatArray
from sketch.page import STROKE_KINDS, StrokeKind


@dataclass(frozen=True, slots=True)
class Rules:
    """The bounds, and why they lie where they lie."""

    points: int = 64
    """Points of the path for outlines and wires: 16 on the side of a square."""
    gap: Bound = Bound(0.28, 0.04)
    """Between the ends of a closed outline. A careless circle leaves a tenth open; the mouth of a C
    is a third of its size and more, the open side of [ two thirds."""
    loose: Bound = Bound(0.17, 0.03)
    """Stray of what hangs over a closed outline. Straight tails past the closure reach a tenth; the
    arms of an x that closes one side, the tail of a 9, a third."""
    rounder: Bound = Bound(0.2, 0.25)
    """Logarithm of (distance from the ellipse / distance from the polygon). A circle drawn with 3 %
    of wobble has −0.8, a square drawn with 2 % +1.4."""
    round: Bound = Bound(0.115, 0.015)
    """Spread of a circle's radii. A careful square has 0.11 with no wobble at all, but that is for
    `rounder` to see; beyond it is neither."""
    lobed: Bound = Bound(0.085, 0.012)
    """The same for a lasso: thrown about things, it follows nothing."""
    thin: Bound = Bound(0.25, 0.04)
    """Smaller over larger axis of a circle. An ellipse of 3:1 was meant as a circle seen at an
    angle, one of 5:1 is a slip of a line."""
    sliver: Bound = Bound(0.035, 0.008)
    """The same for a polygon: a plank of 10:1 is one, a line drawn there and back is not."""
    side_costs: tuple[float, ...] = (1.0, 1.15, 1.4, 1.8)
    """Factor on the distance from the best triangle, quadrilateral, pentagon, hexagon: more sides
    follow any outline more closely, a circle's distance falls as 1 / sides²; these leave a third of
    that fall to be earned."""
    plank: float = 0.12
    """Smaller over larger axis of an outline below which a triangle costs `splinter` times as much: floors,
    shelves and beams are drawn often, splinters of less than 7° never, and a hand's waver is then no
    longer small beside the difference."""
    splinter: float = 1.35
    hand: float = 0.005
    """Distance, rms, that a careful hand wavers by: no side is earned by following it."""
    polygonal: Bound = Bound(0.014, 0.0015)
    """Distance from the best polygon, rms. Bowed sides and rounded corners have 0.01; a circle has 0.017 from
    its best hexagon, 0.031 from its best square."""
    curved: Bound = Bound(0.012, 0.0015)
    """The same of a lasso: a loop that no polygon follows."""
    cornered: Bound = Bound(0.74, 0.05)
    """Share of an outline's turning that lies at its polygon's corners, 0 where it turns evenly all the way
    round and 1 where it turns there only. A polygon with rounded corners has 0.9 and more, a circle 0.3 at
    the corners of its best hexagon, and one begun with a straight stroke 0.6."""
    corner_reach: int = 2
    """Points of the outline on either side of a corner that are its rounding: a tenth of a side of a
    square."""
    convex: Bound = Bound(0.06, 0.02)
    """Share of a polygon's turning in the wrong sense, corners only: a dart (a chevron) has 0.15."""
    simple: float = -2.5
    """Logarithm of belief for each crossing of an outline with itself: stars, eights."""
    wrong_way: Bound = Bound(0.16, 0.04)
    """Share of an outline's turning in the wrong sense: a bean has 0.2, wobble 0.05."""
    legs: Bound = Bound(4.5, 0.25)
    """Legs of a spring. An M or a W has four and is a letter: five make two teeth and a half."""
    uneven: Bound = Bound(0.42, 0.06)
    """Spread of a spring's legs: a hand's teeth differ by a sixth, a brace's strokes by half."""
    progress: Bound = Bound(0.6, 0.08)
    """A spring's teeth lead onward; loops drawn in place wander back half of their way."""
    tooth: Bound = Bound(0.2, 0.05)
    """Height of a leg over its tooth's pitch: below it a wave on a wire, at 0.5 a tooth of 45°."""
    dense: Bound = Bound(0.25, 0.03)
    """Pitch of the teeth over their height: legs that advance by an eighth of their height cover the
    page, as a scribble does; a spring's teeth are a third as wide as high, or more."""
    rubs: Bound = Bound(5.5, 0.25)
    """Legs of a scribble: there and back three times."""
    apart: Bound = Bound(0.15, 0.03)
    """Distance between a spring's ends: it goes from somewhere to somewhere else."""
    straight: Bound = Bound(0.03, 0.006)
    """Distance of a wire from its line, rms. A quarter circle has 0.09, a bracket (an arc of 60°)
    0.04, a bowed or hooked line of a quick hand 0.015."""
    hook: float = 0.08
    """Share of the path at each end where a wire may hook."""
    retraced: Bound = Bound(1.75, 0.12)
    """A wire's path over its size: a third may be retraced twice, not the whole there and back."""
    bow: Bound = Bound(0.09, 0.02)
    """Distance of an arrow's shaft from its chord: a quarter circle has 0.09 and is still pointed."""
    barb: Bound = Bound(0.06, 0.015)
    """Reach of an arrow's head to either side, in shafts: barbs of a fifth of the shaft at 30° reach
    0.1 on both sides, a check mark reaches to one side only."""
    spread: Bound = Bound(0.42, 0.03)
    """Reach to the greater side: a barb of half the shaft at 45° reaches 0.35, the second arm of an x
    0.5."""
    barbs_even: Bound = Bound(0.25, 0.06)
    """Lesser over greater reach: the pen may have started the head at either barb, but has two."""
    fallback: Bound = Bound(0.58, 0.04)
    """How far the head falls back, in shafts: barbs are half a shaft long at most, the second and third
    stroke of an x go further."""
    barb_turn: Bound = Bound(radians(75), radians(8))
    """The turn into the head: barbs come back at more than a right angle."""
    head_ink: Bound = Bound(2.6, 0.25)
    """Length of the head's path in shafts: four strokes of half a shaft, at most."""
    by_itself: float = log(0.55)
    """Added to the belief in a head that is judged by itself: its shaft may bend, and letters have bent ones."""
    otherwise: float = log(0.2)
    """Mathematics is what answers to nothing else: it wins where every other kind is less believed
    than this. One soft bound half missed (0.5) and another at 73 % still make a shape."""
    never: float = -30.0
    """What a kind gets that a stroke alone cannot be."""


RULES = Rules()


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """One stroke seen alone. path, finely: its points at equal spacing, (64, 2) and (n, 2), the diagonal of its box 1;
    beliefs: logarithms of the belief in each of `STROKE_KINDS`, (9,); swings and outline: what the
    beliefs in springs, scribbles and closed shapes rest on, and gestures too; outline is None where nothing is enclosed."""

    path: FloatArray
    finely: FloatArray
    beliefs: FloatArray
    swings: Teeth
    outline: Ring | None


def seen(points: FloatArray, rules: Rules = RULES) -> Seen | None:
    """What a stroke of points (n, 2) looks like by itself; None where the pen never moved.

    A tap depends on what else is on the page: `rules.never` is believed of it here.
    """
    path, finely = prepared(
        np.ascontiguousarray(points), rules.points, SPACING.step, SPACING.fewest, SPACING.most
    )
    if len(path) == 0:
        return None
    outline = ring(path)
    swings = teeth(finely)
    beliefs: dict[StrokeKind, float] = {
        "spring": spring_evidence(path, swings, rules),
        "wire": wire_evidence(path, swings, rules),
        "scribble": scribble_evidence(swings, rules),
        "math": rules.otherwise,
    }
    beliefs["arrow"] = max(arrow_evidence(path, rules), arrow_evidence(path[::-1], rules))
    # A small head hardly bends a line: whatever is believed of an arrow is not believed of a wire.
    beliefs["wire"] += log1p(-exp(beliefs["arrow"]))
    if outline is not None:
        beliefs |= outline_evidence(outline, rules)
    row = np.array([max(beliefs.get(kind, rules.never), rules.never) for kind in STROKE_KINDS])
    return Seen(path, finely, row, swings, outline)


def outline_evidence(outline: Ring, rules: Rules = RULES) -> dict[StrokeKind, float]:
    """Beliefs in circle, polygon and lasso: a loop that is neither."""
    closed = (
        rules.gap.below(outline.gap)
        + rules.loose.below(outline.loose)
        + rules.simple * outline.crosses
        + rules.wrong_way.below(outline.wrong_way)
    )
    if closed < rules.otherwise - 3:  # neither, whatever the sides: spare the search for them
        return {"circle": closed, "polygon": closed, "lasso": closed}
    corners, distance = best_polygon(outline, rules)
    sides = len(corners) - 1
    costly = distance * rules.side_costs[sides - 3]
    ratio = log((outline.roundness * outline.radius + 1e-4) / (costly + 1e-4))
    circle = (
        rules.rounder.below(ratio) + rules.round.below(outline.roundness) + rules.thin.above(outline.aspect)
    )
    wrong, at_corners = turning_shares(outline.points, np.array(corners, dtype=float), rules.corner_reach)
    even = (2 * rules.corner_reach + 1) * sides / (len(outline.points) - 1)
    polygon = (
        rules.rounder.above(ratio)
        + rules.polygonal.below(distance)
        + rules.convex.below(wrong)
        + rules.cornered.above((at_corners - even) / (1 - even))
        + rules.sliver.above(outline.aspect)
    )
    loop = rules.lobed.above(outline.roundness) + rules.curved.above(distance) - rules.rounder.width
    return {"circle": closed + circle, "polygon": closed + polygon, "lasso": closed + loop}


def best_polygon(outline: Ring, rules: Rules = RULES) -> tuple[list[int], float]:
    """The corners of the polygon of three to six sides that follows the outline best for its cost, as
    indices of its points, the first repeated as the last; and its rms distance."""
    legs = best_legs(outline.points, 2 + len(rules.side_costs))
    distances = legs.rms[2:].tolist()
    costs = list(rules.side_costs)
    if outline.aspect < rules.plank:
        costs[0] *= rules.splinter
    weighed = [(distance + rules.hand) * cost for distance, cost in zip(distances, costs, strict=True)]
    sides = 3 + weighed.index(min(weighed))
    return legs.breaks(sides), distances[sides - 3]


def spring_evidence(points: FloatArray, found: Teeth, rules: Rules = RULES) -> float:
    """Belief in a spring, whether of teeth, waves or coils."""
    return (
        rules.legs.above(found.legs)
        + rules.uneven.below(found.uneven)
        + rules.progress.above(found.progress)
        + rules.tooth.above(found.height / max(found.pitch, 1e-6))
        + rules.apart.above(hypot(*(points[-1] - points[0]).tolist()))
        + rules.dense.above(found.pitch / max(found.height, 1e-6))
    )


def scribble_evidence(found: Teeth, rules: Rules = RULES) -> float:
    """Belief in a scribble: to and fro over the same ground."""
    return rules.rubs.above(found.legs) + rules.dense.below(found.pitch / max(found.height, 1e-6))


def wire_evidence(points: FloatArray, found: Teeth, rules: Rules = RULES) -> float:
    """Belief in a wire: straight, apart from a hook at either end."""
    deviation, retraced = straightness(points, round(rules.hook * len(points)))
    small_teeth = rules.legs.below(found.legs) if found.height > 0.05 else 0.0
    return rules.straight.below(deviation) + rules.retraced.below(retraced) + small_teeth


def arrow_evidence(points: FloatArray, rules: Rules = RULES) -> float:
    """Belief in an arrow drawn from its tail: as the head lies to the whole shaft, or as it looks by itself."""
    found = head(points)
    if found is None:
        return rules.never
    by_shaft = (
        rules.bow.below(found.bow)
        + rules.barb.above(found.narrower)
        + rules.spread.below(found.wider)
        + rules.barbs_even.above(found.narrower / max(found.wider, 1e-6))
        + rules.fallback.below(found.fallback)
        + rules.barb_turn.above(found.sharpest)
        + rules.head_ink.below(found.ink)
    )
    by_itself = head_evidence(points[: found.tip + 1], [points[found.tip :]]) + rules.by_itself
    return max(by_shaft, by_itself)
