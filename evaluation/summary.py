"""The contest's figures as plain values, ready for JSON. Shares are fractions; null is "not measured"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from evaluation.contest import Contest
from evaluation.formula_contest import FormulaResult
from evaluation.formula_suites import FormulaSuite
from evaluation.leaderboard import plain, standings
from evaluation.metrics.calibration import reliability, risk_coverage
from evaluation.metrics.strokes import StrokeScores
from evaluation.page_scores import by_problem, summarize
from evaluation.stress_contest import plain as stress_plain
from evaluation.stroke_contest import DIAGRAM_KINDS, StrokeResult
from evaluation.suites import StrokeSuite
from evaluation.textbook_pens import pens_summary
from sketch.page import STROKE_KINDS

Json = dict[str, Any]
COVERAGES = (1.0, 0.95, 0.9, 0.8, 0.5)
"""Shares of claims that are kept, at which risks are told."""


def contest_summary(contest: Contest) -> Json:
    """`stroke_summary`, and "pages" where pages were compared: for each recognizer the `PageSummary` over
    all pages and by problem. "seed" is null for files. "statistics": every measure with its interval, and all pairs; "more": further
    suites of strokes; "textbook", "stress", "formulas": where these took part."""
    summary = {
        **stroke_summary(contest.strokes, contest.stroke_results),
        "seed": contest.seed,
        "statistics": plain(standings(contest)),
    }
    if contest.more:
        summary["more"] = [stroke_summary(*each) for each in contest.more]
    if contest.penned:
        summary["textbook"] = pens_summary(contest.penned)
    if contest.curves or contest.groups:
        summary["stress"] = stress_plain(contest.curves, contest.groups)
    if contest.formulas:
        summary["formulas"] = [formula_summary(*each) for each in contest.formulas]
    if contest.pages is None:
        return summary
    pages = {
        result.name: {
            **asdict(summarize(result.pages)),
            "by_problem": {name: asdict(each) for name, each in by_problem(result.pages).items()},
        }
        for result in contest.page_results
    }
    return {**summary, "pages": {"suite": contest.pages.name, "recognizers": pages}}


def stroke_summary(suite: StrokeSuite, results: Sequence[StrokeResult]) -> Json:
    """suite; rows: in the files or generated; scored: those with a label that is a stroke kind;
    unknown_labels, unlabelled: the others; notices: what the reader skipped; recognizers: by name."""
    return {
        "suite": suite.name,
        "rows": suite.rows,
        "scored": len(suite.labels),
        "unlabelled": suite.unlabelled,
        "unknown_labels": dict(suite.unknown),
        "notices": list(suite.notices),
        "recognizers": {result.name: _recognizer(result) for result in results},
    }


def formula_summary(suite: FormulaSuite, results: Sequence[FormulaResult]) -> Json:
    """suite; rows: in the files or generated; unread: those whose label is no mathematics; over: left out because fewer were asked
    for; readers: by name."""
    return {
        "suite": suite.name,
        "rows": suite.held,
        "unread": suite.unread,
        "over": suite.over,
        "readers": {
            result.name: {
                **asdict(result.scores),
                "memory_mb": {"grown": result.memory.grown, "learnt": result.memory.learnt},
                "reliability": [asdict(each) for each in reliability(result.sure, result.right)],
                "risk": _risk(result.sure, result.right),
            }
            for result in results
        },
    }


def _recognizer(result: StrokeResult) -> Json:
    return {
        **_scores(result.scores),
        "latency_ms": {"p50": result.latency.p50, "p95": result.latency.p95, "n": result.latency.n},
        "memory_mb": {"grown": result.memory.grown, "learnt": result.memory.learnt},
        "unclaimable": dict(result.unclaimable),
        "rejected": result.rejected,
        "five_kinds": {
            "kinds": list(DIAGRAM_KINDS),
            "n": result.five.n,
            "balanced_accuracy": result.five.balanced_accuracy,
            "accuracy": result.five.accuracy,
        },
        "single_stroke": _scores(result.single),
        "several_strokes": _scores(result.several),
        "claimable_only": _scores(result.claimable),
        "confusion": _confusion(result.scores),
        "reliability": [asdict(each) for each in reliability(result.sure, result.right)]
        if result.sure
        else [],
        "risk": _risk(result.sure, result.right),
    }


def _risk(sure: Sequence[float], right: Sequence[bool]) -> Json:
    """The risk at some coverages, and the area under all of the curve."""
    if not sure:
        return {}
    risk = risk_coverage(sure, right)
    return {"area": risk.area, "at": {f"{kept:g}": risk.at(kept) for kept in COVERAGES}}


def _scores(scores: StrokeScores) -> Json:
    return {
        "n": scores.n,
        "accuracy": scores.accuracy,
        "balanced_accuracy": scores.balanced_accuracy,
        "macro_f1": scores.macro_f1,
        "ece": scores.ece,
        "per_class": {kind: asdict(values) for kind, values in scores.per_class.items()},
    }


def _confusion(scores: StrokeScores) -> Json:
    """For each true kind that is present, how often it was claimed as what."""
    return {
        kind: {
            claimed: int(scores.confusion[row, column])
            for column, claimed in enumerate(STROKE_KINDS)
            if scores.confusion[row, column]
        }
        for row, kind in enumerate(STROKE_KINDS)
        if kind in scores.per_class
    }
