"""The strokes on which recognizers differ, and why: the corners and crossings that geometry finds, and the parts that matter
to a net.

What matters is found by leaving out: a part of the stroke is replaced by a straight line, and the part's weight is how much
of the net's probability for its own claim that costs (occlusion, after Zeiler and Fergus 2014). Frame: page units, y down.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from evaluation.contest import Contest
from evaluation.formula_contest import FormulaResult
from evaluation.rivals import rival
from evaluation.stroke_contest import StrokeResult
from evaluation.suites import StrokeSuite, claim_of_row
from recognizer.claims import Recognizer
from recognizer.geometric.crossings import crossings
from recognizer.geometric.cusps import cusps
from recognizer.preprocess import spaced, unit_path
from sketch.figures import Pen, draw_path
from sketch.ink import FloatArray, Ink, Stroke
from sketch.svg import Look, View, pen_for, picture, view_around

SHOWN = 12
"""Disagreements that a report shows."""
PARTS = 16
"""Parts of a stroke that are left out in turn."""
LOOK = Look(points=150.0, margin=10.0, ink="#8a8a8a")
CUSP, CROSSING, PATH, WRITTEN = "#d8703b", "#a05bc0", "#8a8a8a", "#333333"


@dataclass(frozen=True, slots=True)
class Disagreement:
    """A row on which recognizers differ. picture: SVG of the ink with cusps and crossings; attention: SVG of what the net looks
    at, "" where no net takes part; claims: (recognizer, claim, confidence, right)."""

    suite: str
    row: int
    label: str
    cusps: int
    crossings: int
    picture: str
    attention: str
    claims: tuple[tuple[str, str, float, bool], ...]


def disagreements(contest: Contest, most: int = SHOWN) -> list[Disagreement]:
    """Rows of all suites on which some but not all are right, kind by kind, those first where the wrong are surest; as many of
    each suite."""
    found: list[Disagreement] = []
    suites = [(suite, results) for suite, results in contest.stroke_suites() if suite.labels]
    net = rival("learned") if "learned" in contest.names else None
    for suite, results in suites:
        rows = _chosen(suite, results, max(1, most // len(suites)))
        found += [_disagreement(suite, results, row, net) for row in rows]
    return found


def attention(stroke: Stroke, net: Recognizer) -> FloatArray:
    """How much each of `PARTS` equal parts of the stroke matters to the net's claim, (PARTS,): the probability that is lost when
    it is a straight line, never below 0."""
    claim = claim_of_row(net.recognize(Ink((stroke,))))
    ends = np.linspace(0, len(stroke) - 1, PARTS + 1).round().astype(int)
    lost = np.zeros(PARTS)
    for k, (first, last) in enumerate(zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True)):
        if last - first < 2:
            continue
        points = np.array(stroke.points)
        points[first : last + 1] = np.linspace(points[first], points[last], last - first + 1)
        changed = claim_of_row(net.recognize(Ink((stroke.moved_to(points),))))
        lost[k] = max(0.0, claim.confidence - changed.score(claim.kind))
    return lost


def surest_wrong(results: Sequence[StrokeResult] | Sequence[FormulaResult]) -> list[int]:
    """Rows that some have right and others not, those first where the wrong are surest."""
    if not results or not results[0].sure:
        return []
    right = np.array([result.right for result in results])
    wrong = np.where(right, 0.0, np.array([result.sure for result in results])).max(axis=0)
    differ = np.flatnonzero(right.any(axis=0) & ~right.all(axis=0))
    return differ[np.argsort(-wrong[differ], kind="stable")].tolist()


def _chosen(suite: StrokeSuite, results: Sequence[StrokeResult], most: int) -> list[int]:
    """Those rows, the kinds in turn."""
    ranked = surest_wrong(results)
    turns: Counter[str] = Counter()
    turn: dict[int, int] = {}
    for row in ranked:
        turn[row] = turns[suite.labels[row]]
        turns[suite.labels[row]] += 1
    return sorted(ranked, key=lambda row: turn[row])[:most]


def ink_picture(ink: Ink, width: float, look: Look = LOOK) -> str:
    """SVG of ink alone."""
    view = view_around(np.concatenate([stroke.points for stroke in ink]), look)
    pen = pen_for(view, look)
    return picture([draw_path(stroke.points, pen, WRITTEN, 0.9) for stroke in ink], view, width, look)


def _square(view: View) -> View:
    """The view as wide as high."""
    left, top, width, height = view
    side = max(width, height)
    return (left - (side - width) / 2, top - (side - height) / 2, side, side)


def _disagreement(
    suite: StrokeSuite, results: Sequence[StrokeResult], row: int, net: Recognizer | None
) -> Disagreement:
    ink = suite.inks[row]
    view = _square(view_around(np.concatenate([stroke.points for stroke in ink]), LOOK))
    pen = pen_for(view, LOOK)
    corners, crossed = _marks(ink)
    pieces = [draw_path(stroke.points, pen, PATH, 1.8) for stroke in ink]
    pieces += [_dot(point, pen, CUSP) for point in corners] + [
        _dot(point, pen, CROSSING) for point in crossed
    ]
    return Disagreement(
        suite=suite.name,
        row=row,
        label=suite.labels[row],
        cusps=len(corners),
        crossings=len(crossed),
        picture=picture(pieces, view, 150.0, LOOK),
        attention="" if net is None else picture(_looked_at(ink, net, pen), view, 150.0, LOOK),
        claims=tuple((r.name, r.claimed[row], r.sure[row], r.right[row]) for r in results),
    )


def _marks(ink: Ink) -> tuple[list[FloatArray], list[FloatArray]]:
    """Where geometry sees corners (ends included) and crossings, page units."""
    corners: list[FloatArray] = []
    crossed: list[FloatArray] = []
    for stroke in ink:
        path = spaced(unit_path(stroke))
        low = stroke.points.min(axis=0)
        there = low + path * float(np.hypot(*np.ptp(stroke.points, axis=0)))
        if len(path) < 2:
            corners.append(there[0])
            continue
        corners += [there[k] for k in cusps(path)]
        crossed += [there[int(first)] for first, _ in crossings(path).tolist()]
    return corners, crossed


def _looked_at(ink: Ink, net: Recognizer, pen: Pen) -> list[str]:
    """The strokes, each part as dark as it matters."""
    pieces: list[str] = []
    for stroke in ink:
        weight = attention(stroke, net)
        strongest = float(weight.max()) or 1.0
        ends = np.linspace(0, len(stroke) - 1, PARTS + 1).round().astype(int).tolist()
        for k, share in enumerate((weight / strongest).tolist()):
            part = stroke.points[ends[k] : ends[k + 1] + 1]
            if len(part) > 1:
                pieces.append(draw_path(part, pen, _heat(share), 1.4 + 2.6 * share))
    return pieces


def _heat(share: float) -> str:
    """From grey to blue."""
    low, high = (205, 205, 205), (32, 92, 180)
    return "#" + "".join(f"{round(a + (b - a) * share):02x}" for a, b in zip(low, high, strict=True))


def _dot(point: FloatArray, pen: Pen, colour: str) -> str:
    x, y = (pen.number(value) for value in point.tolist())
    return f'<circle cx="{x}" cy="{y}" r="{pen.number(2.6 * pen.unit)}" fill="{colour}"/>'
