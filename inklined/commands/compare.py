"""`inklined compare`: the contest, on generated ink or on anybody's labelled ink."""

from __future__ import annotations

import json
import os
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from inklined.options import rivals, there

if TYPE_CHECKING:
    from evaluation.contest import Contest

SEED = 2026
"""Of the generated suites, unless another is asked for; training draws from other seeds."""
REPORT = Path("report.html")


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(
        epilog="Example: inklined compare --ink strokes.jsonl.gz --recognizer paper learned --json out.json"
    )(compare)


def compare(
    ink: Annotated[
        list[Path] | None,
        typer.Option(help="Labelled JSON Lines (.jsonl, .jsonl.gz) to compare on, one or more files."),
    ] = None,
    recognizer: Annotated[
        list[str] | None, typer.Option(help="Who takes part, one or more names; everybody by default.")
    ] = None,
    report: Annotated[
        Path | None,
        typer.Option(help="The report, one HTML file. [default: report.html; with --ink, none]"),
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="Write all figures here as JSON.")] = None,
    strokes: Annotated[int, typer.Option(min=0, max=1_000_000, help="Generated strokes.")] = 1800,
    pages: Annotated[int, typer.Option(min=0, max=10_000, help="Generated pages.")] = 30,
    seed: Annotated[int, typer.Option(min=0, help="Of the generated ink.")] = SEED,
    jobs: Annotated[int, typer.Option(min=0, help="Processes; 0: one for each core.")] = 0,
) -> None:
    """Compare recognizers by what they make of the same ink.

    Without --ink the contest runs on generated ink: single strokes, and whole diagrams that are read,
    corrected and set in motion. It prints its tables and writes report.html with pictures of all of it.
    """
    from inklined.output import check_writable, write_text
    from inklined.terminal import out, progress
    from recognizer.roster import ROSTER

    names = rivals(recognizer or ()) or tuple(ROSTER)
    if not ink and not strokes and not pages:
        raise typer.BadParameter("--strokes 0 --pages 0 leaves nothing to compare; give one of them a number")
    files = there(ink or ())
    place = report or (None if files else REPORT)
    for target in (place, json_file):
        if target:
            check_writable(target, files)

    with progress() as tell:
        from evaluation.contest import contest_on_files, contest_on_generated
        from evaluation.report import report as report_of

        workers = jobs or os.cpu_count() or 1
        contest = (
            contest_on_files(files, names, workers, tell)
            if files
            else contest_on_generated(strokes, pages, seed, names, workers, tell)
        )
        html = report_of(contest, _as_typed(), workers, tell) if place else ""

    # Files first: a reader of the terminal that hangs up must not cost the figures.
    if json_file:
        from evaluation.summary import contest_summary

        figures = json.dumps(contest_summary(contest), indent=1, ensure_ascii=False)
        write_text(json_file, figures + "\n", files)
    if place:
        write_text(place, html, files)
    _print(contest)
    if json_file:
        out.print(f"Figures: {json_file}", markup=False)
    if place:
        out.print(f"Report: {place}", markup=False)


def _print(contest: Contest) -> None:
    """The contest's tables, and what they do not say."""
    from evaluation.page_tables import page_notes, page_tables
    from evaluation.tables import recall_table, stroke_notes, stroke_table
    from inklined.terminal import as_rich, out

    if contest.strokes.rows:
        out.print(as_rich(stroke_table(contest.strokes, contest.stroke_results)))
        if contest.strokes.labels:
            out.print(as_rich(recall_table(contest.stroke_results)))
        for note in stroke_notes(contest.strokes, contest.stroke_results):
            out.print(note, style="dim", markup=False)
    paged = page_tables(contest.page_results)
    for table in paged:
        out.print(as_rich(table))
    for note in page_notes() if paged else ():
        out.print(note, style="dim", markup=False)


def _as_typed() -> str:
    """This command line, for the report."""
    return "inklined " + shlex.join(sys.argv[1:] or ["compare"])
