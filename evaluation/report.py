"""The report: one HTML file that holds everything it shows, tables, pictures and style."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from datetime import datetime
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from evaluation.code import ROOMS, digest
from evaluation.contest import Contest
from evaluation.illustrations import ABOUT, ANSWER_TITLES, Illustration, illustrations
from evaluation.leaderboard import standings
from evaluation.page_tables import page_notes, page_tables
from evaluation.parallel import Progress, Workers, silent
from evaluation.provenance import machine, versions
from evaluation.report_parts import (
    all_tables,
    curves_of,
    explorer,
    exported,
    formulas_of,
    leaderboard,
    stress_of,
)
from evaluation.stroke_contest import StrokeResult
from evaluation.suites import StrokeSuite
from evaluation.table import Table
from evaluation.tables import recall_table, stroke_notes, stroke_table
from evaluation.textbook_pens import pens_table
from sketch.page import STROKE_KINDS


def report(
    contest: Contest,
    command: str,
    workers: Workers = 1,
    progress: Progress = silent,
    made: datetime | None = None,
) -> str:
    """HTML of a contest; `command` is what was run, as a person types it; made: when, now by default. On generated ink
    with pages it draws every diagram in every recognizer's hands."""
    drawn = (
        illustrations(contest.seed, contest.names, workers, progress)
        if contest.seed is not None and contest.pages and contest.pages.pages
        else []
    )
    of = standings(contest)
    tables = report_tables(contest)
    environment = Environment(
        loader=PackageLoader("evaluation"), autoescape=True, undefined=StrictUndefined, trim_blocks=True
    )
    loaded = environment.loader
    assert loaded is not None
    style = loaded.get_source(environment, "report.css")[0]
    return environment.get_template("report.html.j2").render(
        title=", ".join(contest.names or _readers(contest)),
        heading="Which recognizer reads the page best?"
        if contest.names
        else "Which reader reads mathematics best?",
        lead=_lead(contest),
        style=Markup(style),
        facts=_facts(contest, command, made or datetime.now().astimezone()),
        leaderboard=leaderboard(of),
        figures=curves_of(contest),
        stress=stress_of(contest) if contest.curves or contest.groups else None,
        formulas=formulas_of(contest),
        penned=pens_table(contest.penned) if contest.penned else None,
        explorer=_explorer(contest),
        exported=exported(tables),
        strokes=[_strokes(*each) for each in contest.stroke_suites() if each[0].rows],
        pages=_pages(contest) if contest.pages and contest.pages.pages else None,
        problems=_problems(drawn),
        footer="Made by inklined. Everything shown is in this file; it loads nothing.",
    )


def _lead(contest: Contest) -> str:
    if not contest.names:
        return f"{', '.join(_readers(contest))}: the same handwritten expressions, from their ink alone."
    rivals = ", ".join(contest.names)
    if contest.pages is None or not contest.pages.pages:
        return f"{rivals}: the same labelled ink, stroke by stroke."
    return (
        f"{rivals}: the same ink, one shared back end. Recognizers are compared by the strokes that they name, by "
        "the diagrams that they read, and by what matters to a person: does the drawing move as physics says "
        "it should?"
    )


def _readers(contest: Contest) -> list[str]:
    return list(dict.fromkeys(result.name for _, results in contest.formulas for result in results))


def report_tables(contest: Contest) -> list[Table]:
    """Every table that the report shows, in its order."""
    scores = [
        table
        for suite, results in contest.stroke_suites()
        if suite.rows
        for table in (stroke_table(suite, results), recall_table(results))
    ]
    return all_tables(contest, standings(contest), [*scores, *page_tables(contest.page_results)])


def _facts(contest: Contest, command: str, made: datetime) -> list[tuple[str, str]]:
    suites = list(contest.hashes())
    hashes = ", ".join(f"{name}: {digest}" for name, digest in contest.hashes().items())
    seed = [] if contest.seed is None else [("Seed", str(contest.seed))]
    return [
        ("Compared on", "; ".join(suites)),
        *seed,
        ("Command", command),
        ("Made", made.strftime("%Y-%m-%d %H:%M")),
        ("Machine", f"{machine()}, Python {platform.python_version()}"),
        ("Versions", ", ".join(f"{name} {number}" for name, number in versions().items())),
        ("Hash of the code", digest(*ROOMS)),
        ("Hashes of the data", hashes),
    ]


def _explorer(contest: Contest) -> dict[str, Any]:
    found = explorer(contest)
    return {**found, "pages": _problems(found["pages"])}


def _strokes(suite: StrokeSuite, results: Sequence[StrokeResult]) -> dict[str, Any]:
    return {
        "name": suite.name,
        "about": "Raw claims, stroke by stroke, before anybody asks whether a wire is attached to anything.",
        "scores": stroke_table(suite, results),
        "recalls": recall_table(results),
        "notes": stroke_notes(suite, results),
        "confusions": [_confusion(result) for result in results],
    }


def _confusion(result: StrokeResult) -> dict[str, Any]:
    table = result.scores.confusion
    shown = [k for k in range(len(STROKE_KINDS)) if table[k].any() or table[:, k].any()]

    def cells(row: int) -> list[dict[str, Any]]:
        total = int(table[row].sum())
        shares = [float(table[row, column]) / total for column in shown]
        return [
            {
                "share": f"{share:.3f}",
                "text": "" if share == 0 else "<1" if share < 0.005 else f"{100 * share:.0f}",
                "right": column == row,
                "title": f"{table[row, column]} of {total} {STROKE_KINDS[row]} taken for {STROKE_KINDS[column]}",
            }
            for column, share in zip(shown, shares, strict=True)
        ]

    return {
        "name": result.name,
        "columns": [STROKE_KINDS[k] for k in shown],
        "rows": [{"kind": STROKE_KINDS[k], "cells": cells(k)} for k in shown if table[k].any()],
    }


def _pages(contest: Contest) -> dict[str, Any]:
    return {
        "about": (
            "Whole diagrams: each recognizer's reading is corrected and moved by the same back end and compared "
            "with the truth. The oracle is told what each stroke is: its row is what the back end costs."
        ),
        "tables": page_tables(contest.page_results),
        "notes": page_notes(),
    }


def _problems(drawn: Sequence[Illustration]) -> list[dict[str, Any]]:
    problems: list[dict[str, Any]] = []
    for name in dict.fromkeys(one.problem for one in drawn):
        title, about = ABOUT.get(name, (name.replace("-", " "), ""))
        answers = [one for one in drawn if one.problem == name]
        problems.append(
            {
                "anchor": name,
                "title": title,
                "about": about,
                "answers": [_answer(one, len(answers) > 1) for one in answers],
            }
        )
    return problems


def _answer(one: Illustration, several: bool) -> dict[str, Any]:
    return {
        "title": ANSWER_TITLES.get(one.answer, one.answer) if several else "",
        "formulas": one.formulas,
        "views": [
            {
                "name": view.name,
                "verdict": view.verdict,
                "same": view.same,
                "page": Markup(view.page),
                "strip": Markup(view.strip),
                "graph": Markup(view.graph),
                "words": view.words,
            }
            for view in one.views
        ],
    }
