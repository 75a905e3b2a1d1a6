"""`paper`: the geometric rules of a sketch-based physics tutor (Cheema and LaViola), verbatim.

Row R2 of FEATURES.md. The rules are the paper's, including what they cannot do: springs are
coils, never zig-zags; arrows, scribbles and lassos are not claimed at all. Its pages need the tap
that fixes a body (row P3): a dot is told from its page as every other rival here tells it. Where
the paper gives no number, one was chosen from the geometry of the shapes, and none was tuned on ink.

Frame: equal-length segments on a path whose bounding box has a diagonal of 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from recognizer.claims import Claim, claim_for
from recognizer.geometric.context import dots
from recognizer.geometric.crossings import crossings
from recognizer.geometric.cusps import cusps
from recognizer.preprocess import spaced, unit_path
from sketch.geometry import diagonal, path_length
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import StrokeKind


@dataclass(frozen=True, slots=True)
class PaperRules:
    """The thresholds of the rules."""

    closed: float = 0.2
    """First and last cusp nearer than this fraction of the size: closed. A pen that means to close
    misses by a hook, a few hundredths; the mouth of a C is a third or more."""
    round: float = 0.35
    """Standard deviation of the subtended angles over their mean: below it a circle. A circle has 0,
    an ellipse of 1.5:1 has 0.15, of 2:1 has 0.29, of 2.5:1 (no circle any more) has 0.41."""
    coils: int = 3
    """Self-intersections of a spring: the paper's own number."""
    straight: float = 0.95
    """Distance between the ends over the path's length: above it nearly straight. An arc of 60°,
    an ordinary bracket, has 0.955."""
    certainty: float = 0.8
    """The paper's rules say yes or no. A score is stated nevertheless, the same for every claim,
    since calibration compares it with how often claims are right."""


RULES = PaperRules()


class Paper:
    """The published rules as a rival. It sees each stroke alone, but for dots, which are small beside others."""

    name = "paper"
    claims: frozenset[StrokeKind] = frozenset({"circle", "polygon", "spring", "wire", "tap", "math"})

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """One claim a stroke; never rejects."""
        if not len(ink):
            return ()
        tiny = dots(ink, np.array([diagonal(stroke.points) for stroke in ink])).tolist()
        return tuple(
            claim_for("tap" if dot else classify(stroke), RULES.certainty)
            for dot, stroke in zip(tiny, ink, strict=True)
        )


def classify(stroke: Stroke, rules: PaperRules = RULES) -> StrokeKind:
    """The kind that the published rules give to a stroke."""
    path = unit_path(stroke)
    if len(path) == 1:
        return "math"  # a dot: decimal point, dot of an i
    points = spaced(path)
    corners = cusps(points)
    first, last = points[corners[0]], points[corners[-1]]
    if np.hypot(*(last - first)) < rules.closed:
        if len(corners) > 2:
            return "polygon"
        return "circle" if unevenness(points) < rules.round else "math"
    if len(corners) == 2 and len(crossings(points)) >= rules.coils:
        return "spring"
    if np.hypot(*(last - first)) > rules.straight * path_length(points):
        return "wire"
    return "math"


def unevenness(points: FloatArray) -> float:
    """Standard deviation over mean of the angles that the segments between neighbouring points
    subtend at the points' centroid; infinite where the path does not go round it."""
    rays = points - points.mean(axis=0)
    here, there = rays[:-1], rays[1:]
    cross = here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]
    angles = np.arctan2(cross, np.einsum("ij,ij->i", here, there))
    mean = abs(float(angles.mean()))
    return float(angles.std()) / mean if mean > 0 else float("inf")
