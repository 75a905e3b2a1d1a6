"""Strokes that are none of the kinds: whether any kind explains a stroke well enough.

Beliefs are relative: of a heart, a lasso is believed most. Here each kind says what it never is, whatever
else it resembles; what no kind explains is a stranger. Thresholds lie where the geometry of the kind puts them, as in
`rules`; no doodle was learnt from. Frame: lengths are fractions of the stroke's size.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, pi, radians
from typing import assert_never

from recognizer.geometric.bounds import Bound
from recognizer.geometric.kernels.paths import crossing_places, length_of, winding
from recognizer.geometric.kernels.rings import dents
from recognizer.geometric.rules import Seen
from sketch.page import STROKE_KINDS, StrokeKind


@dataclass(frozen=True, slots=True)
class StrangerRule:
    """What each kind never is."""

    coarse: int = 28
    """Points on which a sign's turning is taken: seven on each of four legs, no tremor."""
    turning: Bound = Bound(4 * pi, 0.8)
    """Turning of a sign of mathematics, without regard to its sense, radians: an m turns thrice by half a circle, an ε and a
    cursive capital twice about; a scrawl goes on."""
    slight: float = radians(12)
    """Bend on that many points that is tremor, at most."""
    changes: Bound = Bound(5.5, 0.4)
    """How often a sign's turning changes its sense: a W thrice, a cursive k or ξ five times; stairs at every step."""
    length: Bound = Bound(3.5, 0.2)
    """Length of a sign's path over its size: four strokes of an M have 2.9."""
    knots: Bound = Bound(5.5, 0.5)
    """Crossings of a sign with itself: a cursive k has three."""
    dented: Bound = Bound(0.14, 0.015)
    """Share of the turning of a closed sign in the wrong sense where it crosses itself nowhere: O and D have none, an 8 crosses
    itself; a heart has 0.2, a star 0.3."""
    shut: float = 0.2
    """Gap between the ends of a closed sign: beyond, it is a C or a U."""
    loop: Bound = Bound(0.155, 0.012)
    """The same share of a lasso: a loop thrown in haste wavers, but goes round; a crescent has 0.18."""
    inwards: Bound = Bound(radians(62), radians(6))
    """Sharpest bend of a lasso in the wrong sense: a heart's dent has 90°."""
    horn: Bound = Bound(radians(105), radians(6))
    """Sharpest bend of a lasso in its own sense: it has no points, a crescent has two."""
    tip: Bound = Bound(radians(88), radians(5))
    """The same of a circle: a leaf has two tips."""
    lobe: Bound = Bound(radians(40), radians(4))
    """Sharpest bend of a circle in the wrong sense: a cloud's lobes meet at 60° and more."""
    wavy: Bound = Bound(0.1, 0.015)
    """Share of a circle's turning in the wrong sense."""
    side: Bound = Bound(radians(28), radians(3))
    """Sharpest bend of a polygon in the wrong sense: its sides may bow, a cloud's lobes meet."""
    teeth: Bound = Bound(0.56, 0.04)
    """Height of a spring's leg over its tooth's pitch: stairs, seen along their slope, have 0.5,"""
    sharp: Bound = Bound(1.75, 0.06)
    """and turn by a right angle (1.57) from leg to leg, where a tooth is sharper."""
    round: Bound = Bound(3.6, 0.12)
    """Turning of a spring or a scribble from leg to leg, radians: half a circle (π) in a coil, a little more by waver; what
    loops between its legs is writing."""
    direct: Bound = Bound(1.5, 0.05)
    """Length of a spring's path over that of its legs drawn straight: half a circle of a coil has 1.57, and leans."""
    leads: Bound = Bound(0.66, 0.04)
    """Distance between a spring's ends over its size: it leads from one to the other, a spiral stays."""
    meet: Bound = Bound(0.1, 0.02)
    """The same of a scribble: it does not come back to where it began, as a knot does."""
    even: Bound = Bound(0.3, 0.03)
    """Spread of a spring's or a scribble's legs: what is drawn by rhythm differs by a sixth, a signature by a third."""
    per_leg: int = 6
    """Points on a leg between which its turning is taken,"""
    least: int = 20
    """and on the whole path, at least."""
    arrow: Bound = Bound(2.9, 0.15)
    """Length of an arrow's path over its size: a shaft and four barbs of half of it have three."""
    reach: int = 3
    """Points of an outline to either side between which a bend is taken: an eighth of it in all."""
    limit: float = -9.0
    """Logarithm of the best explanation below which a stroke is rejected. On generated ink it keeps 99.5 % of the
    kinds: what is lost here is lost for good on a page."""


STRANGERS = StrangerRule()


def familiarity(look: Seen, rule: StrangerRule = STRANGERS) -> float:
    """Logarithm of how well the kind that explains a stroke best does, 0 at most. A tap explains nothing that moved."""
    beliefs: list[float] = look.beliefs.tolist()
    best = -float("inf")
    for belief, kind in sorted(zip(beliefs, STROKE_KINDS, strict=True), reverse=True):
        if belief <= best:  # no kind's limits add to what is believed of it
            break
        best = max(best, belief + _limits(kind, look, rule))
    return best


def is_stranger(look: Seen, rule: StrangerRule = STRANGERS) -> bool:
    """Whether no kind explains the stroke."""
    return familiarity(look, rule) < rule.limit


def _limits(kind: StrokeKind, look: Seen, rule: StrangerRule) -> float:
    """What speaks against the stroke's being of the kind, beyond what its belief has already."""
    match kind:
        case "math":
            turning, changes = winding(look.path, rule.coarse, rule.slight)
            ring = look.outline
            closed = ring is not None and ring.gap < rule.shut and ring.crosses == 0
            return (
                rule.turning.below(turning)
                + rule.changes.below(changes)
                + rule.length.below(length_of(look.finely))
                + rule.knots.below(len(crossing_places(look.path)))
                + (rule.dented.below(ring.wrong_way) if ring is not None and closed else 0.0)
            )
        case "circle" | "polygon" | "lasso":
            return _outline_limits(kind, look, rule)
        case "spring" | "scribble":
            return _swing_limits(kind, look, rule)
        case "arrow":
            return rule.arrow.below(length_of(look.finely))
        case "wire" | "tap":
            return 0.0
        case _:
            assert_never(kind)


def _outline_limits(kind: StrokeKind, look: Seen, rule: StrangerRule) -> float:
    ring = look.outline
    if ring is None:
        return 0.0
    outwards, inwards = dents(ring.points, rule.reach)
    if kind == "circle":
        return rule.tip.below(outwards) + rule.lobe.below(inwards) + rule.wavy.below(ring.wrong_way)
    if kind == "polygon":
        return rule.side.below(inwards)
    return rule.horn.below(outwards) + rule.inwards.below(inwards) + rule.loop.below(ring.wrong_way)


def _swing_limits(kind: StrokeKind, look: Seen, rule: StrangerRule) -> float:
    swings, ends = look.swings, look.path[-1] - look.path[0]
    points = min(max(rule.per_leg * swings.legs, rule.least), len(look.finely))
    turning, _ = winding(look.finely, points, rule.slight)
    apart = hypot(*ends.tolist())
    shared = rule.round.below(turning / max(swings.legs, 1)) + rule.even.below(swings.uneven)
    if kind == "scribble":
        return shared + rule.meet.above(apart)
    straight = swings.legs * hypot(swings.height, 0.5 * swings.pitch)
    return (
        shared
        + rule.sharp.above(turning / max(swings.legs, 1))
        + rule.teeth.above(swings.height / max(swings.pitch, 1e-6))
        + rule.direct.below(length_of(look.finely) / max(straight, 1e-6))
        + rule.leads.above(apart)
    )
