"""The report's parts beyond tables of scores: standings with their doubts, curves, disagreements, and how to have it again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from markupsafe import Markup

from evaluation.contest import Contest
from evaluation.disagreements import disagreements, ink_picture, surest_wrong
from evaluation.exports import as_csv, as_latex
from evaluation.formula_contest import FormulaResult
from evaluation.formula_suites import FormulaSuite
from evaluation.formula_tables import formula_notes, formula_table
from evaluation.graph import line_graph
from evaluation.illustrations import illustrate
from evaluation.leaderboard import Standings
from evaluation.leaderboard_tables import standing_tables
from evaluation.metrics.calibration import reliability, risk_coverage
from evaluation.metrics.motion import TIMES
from evaluation.page_contest import ORACLE
from evaluation.page_scores import summarize
from evaluation.statistics.diagram import critical_difference_diagram
from evaluation.stress import AXES
from evaluation.stress_contest import Curve
from evaluation.stress_tables import stress_tables
from evaluation.stroke_contest import StrokeResult
from evaluation.table import Table
from evaluation.textbook_pens import pens_table
from sketch.ink import FloatArray
from sketch.writing.rows import latex

MOST_PAGES = 3
"""Pages shown on which the motions of the readings differ."""
MOST_FORMULAS = 6
"""Expressions shown that readers read differently."""


def leaderboard(of: Standings) -> dict[str, Any]:
    """Every measure with its interval; the ranks over all suites."""
    return {
        "about": (
            "Each figure with its 95 % interval: writers are resampled whole, the same ones for all recognizers. "
            "Pairs are compared on the same rows, p corrected by Holm for all pairs of a table."
        ),
        "tables": standing_tables(of),
        "diagram": Markup(critical_difference_diagram(of.ranks)) if of.ranks else "",
        "order": _order(of),
    }


def curves_of(contest: Contest) -> list[dict[str, Any]]:
    """Figures: reliability and risk for each suite of strokes, divergence for pages, stress for each axis."""
    figures: list[dict[str, Any]] = []
    for suite, results in contest.stroke_suites():
        if suite.labels and results and results[0].sure:
            figures += _confidence(f"{suite.name}, n = {len(suite.labels)}", results)
    pages = [result for result in contest.page_results if result.pages]
    if pages:
        times = np.array(TIMES)
        curves = {r.name: (times, 100 * np.array(summarize(r.pages).divergence)) for r in pages}
        n = len(pages[0].pages)
        figures.append(
            _figure(
                "Divergence of the motions",
                f"mean over {n} pages, of the diagram's size",
                line_graph(curves, "time, s", "motion error, %"),
            )
        )
    return figures


def stress_of(contest: Contest) -> dict[str, Any]:
    """Curves against every axis of stress, and their tables."""
    figures: list[dict[str, Any]] = []
    for axis, measure in dict.fromkeys((curve.axis, curve.measure) for curve in contest.curves):
        own = [curve for curve in contest.curves if (curve.axis, curve.measure) == (axis, measure)]
        told = "balanced accuracy, %" if measure == "accuracy" else "motion error, %"
        n = own[0].values[0].n
        curves = {curve.name: _along(curve, [value.value for value in curve.values]) for curve in own}
        bands = {
            curve.name: (
                _along(curve, [value.value if value.low is None else value.low for value in curve.values])[1],
                _along(curve, [value.value if value.high is None else value.high for value in curve.values])[
                    1
                ],
            )
            for curve in own
        }
        what = "strokes" if measure == "accuracy" else "pages"
        figures.append(
            _figure(
                AXES[axis].about,
                f"{n} {what} at each level, 95 % intervals",
                line_graph(curves, _axis(axis), told, bands=bands),
            )
        )
    return {"figures": figures, "tables": stress_tables(contest.curves, contest.groups)}


def formulas_of(contest: Contest) -> list[dict[str, Any]]:
    """The contest over handwritten mathematics, suite by suite, with expressions on which readers differ."""
    return [
        {
            "name": suite.name,
            "table": formula_table(suite, results),
            "notes": formula_notes(suite),
            "figures": _confidence(f"{suite.name}, n = {len(suite.rows)}", results),
            "differ": [
                _differently_read(suite, results, row) for row in surest_wrong(results)[:MOST_FORMULAS]
            ],
        }
        for suite, results in contest.formulas
    ]


def _differently_read(suite: FormulaSuite, results: Sequence[FormulaResult], row: int) -> dict[str, Any]:
    truth = results[0].reads[row].truth
    return {
        "label": latex(truth or ()),
        "picture": Markup(ink_picture(suite.rows[row].ink, 320.0)),
        "claims": [
            {
                "name": result.name,
                "claim": result.reads[row].reading.latex or "nothing",
                "sure": f"{100 * result.sure[row]:.0f}",
                "right": result.right[row],
            }
            for result in results
        ],
    }


def explorer(contest: Contest) -> dict[str, Any]:
    """The strokes on which recognizers differ, and pages whose readings move differently."""
    shown = [
        {
            "label": one.label,
            "where": f"{one.suite}, row {one.row}",
            "found": f"{one.cusps} cusps (ends included), {one.crossings} crossings",
            "picture": Markup(one.picture),
            "attention": Markup(one.attention),
            "claims": [
                {"name": name, "claim": claim, "sure": f"{100 * sure:.0f}", "right": right}
                for name, claim, sure, right in one.claims
            ],
        }
        for one in disagreements(contest)
    ]
    pages: list[Any] = []
    if contest.pages is not None:
        rivals = [result for result in contest.page_results if result.name != ORACLE]
        for k, page in enumerate(contest.pages.pages):
            same = {result.pages[k].same_outcome for result in rivals}
            if len(same) > 1 and len(pages) < MOST_PAGES:
                pages.append(illustrate((page, contest.names)))
    return {"strokes": shown, "pages": pages}


def exported(tables: Sequence[Table]) -> list[dict[str, str]]:
    """Every table as CSV and LaTeX."""
    return [{"caption": table.caption, "csv": as_csv(table), "latex": as_latex(table)} for table in tables]


def all_tables(contest: Contest, of: Standings, others: Sequence[Table]) -> list[Table]:
    """The tables of the report, in its order."""
    penned = [pens_table(contest.penned)] if contest.penned else []
    read = [formula_table(*each) for each in contest.formulas]
    return [*standing_tables(of), *others, *penned, *stress_tables(contest.curves, contest.groups), *read]


def _order(of: Standings) -> str:
    if of.order is None:
        return ""
    f = of.order
    return (
        f"Over {f.n} suites (each suite of strokes by balanced accuracy, each diagram by its outcome) Friedman's χ² is {f.chi2:.2f} "
        f"(p = {f.p:.2g}), Iman and Davenport's F {_number(f.f)} (p = {f.f_p:.2g}), Kendall's W {f.w:.2f}. Suites of one generator are not "
        "independent of one another: the diagram is a picture of the order, not a proof of it."
    )


def _number(value: float) -> str:
    """∞ where all suites agree."""
    return f"{value:.2f}" if np.isfinite(value) else "∞"


def _confidence(
    about: str, results: Sequence[StrokeResult] | Sequence[FormulaResult]
) -> list[dict[str, Any]]:
    """What the confidence of each is worth, as two figures."""
    even = np.array([0.0, 100.0])
    reliable, risks = {}, {}
    for result in results:
        bins = reliability(result.sure, result.right)
        reliable[result.name] = (
            100 * np.array([b.sure for b in bins]),
            100 * np.array([b.right for b in bins]),
        )
        risk = risk_coverage(result.sure, result.right)
        risks[result.name] = (100 * np.array(risk.coverage), 100 * np.array(risk.risk))
    return [
        _figure(
            "Reliability",
            f"{about}; dotted: as right as sure",
            line_graph(reliable, "confidence, %", "right, %", guide=(even, even)),
        ),
        _figure(
            "Risk when the unsure are refused",
            about,
            line_graph(risks, "kept, %", "wrong of the kept, %"),
        ),
    ]


def _along(curve: Curve, values: Sequence[float]) -> tuple[FloatArray, FloatArray]:
    """A curve's levels as they lie on its axis, percent as percent, rates as the time between points; and values at them in %."""
    levels = np.array(curve.levels)
    if AXES[curve.axis].unit == "Hz":
        levels = np.where(np.isinf(levels), 0.0, 1000.0 / np.where(np.isinf(levels), 1.0, levels))
    elif AXES[curve.axis].unit.startswith("%"):
        levels = 100 * levels
    elif curve.axis == "scale":
        levels = np.log2(levels)
    order = np.argsort(levels, kind="stable")
    return levels[order], 100 * np.array(values)[order]


def _axis(axis: str) -> str:
    unit = {"Hz": "ms between points"}.get(AXES[axis].unit, AXES[axis].unit)
    return f"{axis}, {'doublings' if axis == 'scale' else unit}"


def _figure(title: str, about: str, svg: str) -> dict[str, Any]:
    return {"title": title, "about": about, "svg": Markup(svg)}
