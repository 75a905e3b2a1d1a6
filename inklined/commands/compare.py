"""`inklined compare`: the contest, on generated ink or on anybody's labelled ink."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated

import typer

from inklined.options import ClusterAddress, Jobs, known, rivals, there, workers_of
from inklined.typed import TYPED

if TYPE_CHECKING:
    from evaluation.contest import Contest
    from evaluation.lessons import Lesson
    from evaluation.parallel import Progress

SEED = 2026
"""Of the generated suites, unless another is asked for; training draws from other seeds."""
REPORT = Path("report.html")
STROKES, PAGES = 1800, 30
"""Generated when no file is given."""
READERS = ("net", "dollar-p")
"""Of handwritten mathematics, as `recognizer.handwriting.roster` has them, which is not loaded for a help text."""


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(
        epilog="Example: inklined compare --ink strokes.jsonl.gz --recognizer paper learned --json out.json"
    )(compare)


def compare(
    ink: Annotated[
        list[Path] | None,
        typer.Option(
            help="Labelled ink to compare on, in any format that `inklined import` knows, one or more files."
        ),
    ] = None,
    recognizer: Annotated[
        list[str] | None,
        typer.Option(
            help="Who takes part, one or more names that `inklined recognizers` lists. [default: the contest's own]"
        ),
    ] = None,
    train: Annotated[
        list[Path] | None,
        typer.Option(
            help="Labelled JSON Lines that the published rivals learn from; its writers are left out of --ink."
        ),
    ] = None,
    templates: Annotated[
        int, typer.Option(min=1, max=10_000, help="Rows of each kind learnt from, with --train.")
    ] = 10,
    report: Annotated[
        Path | None,
        typer.Option(help="The report, one HTML file. [default: report.html; with --ink, none]"),
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="Write all figures here as JSON.")] = None,
    strokes: Annotated[
        int | None,
        typer.Option(min=0, max=1_000_000, help="Generated strokes. [default: 1800; with --ink, none]"),
    ] = None,
    pages: Annotated[
        int | None, typer.Option(min=0, max=10_000, help="Generated pages. [default: 30; with --ink, none]")
    ] = None,
    pens: Annotated[
        int, typer.Option(min=0, max=1000, help="Textbook problems too, each by so many simulated pens.")
    ] = 0,
    stress: Annotated[
        int, typer.Option(min=0, max=100_000, help="Stress too, by so many generated strokes at each level.")
    ] = 0,
    stress_pages: Annotated[
        int, typer.Option(min=0, max=1000, help="And the motion of so many generated pages at each level.")
    ] = 0,
    formulas: Annotated[
        list[Path] | None,
        typer.Option(
            help="Labelled handwritten expressions (LaTeX) to compare readers on, one or more files."
        ),
    ] = None,
    formula_rows: Annotated[
        int | None,
        typer.Option(min=1, help="Only so many rows of --formulas, evenly spread. [default: all]"),
    ] = None,
    expressions: Annotated[
        int, typer.Option(min=0, max=100_000, help="Generated handwritten expressions for the readers.")
    ] = 0,
    reader: Annotated[
        list[str] | None,
        typer.Option(help=f"Which readers of mathematics take part, one or more of {', '.join(READERS)}."),
    ] = None,
    tables: Annotated[
        Path | None, typer.Option(help="Write every table into this folder, as CSV and LaTeX.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the generated ink.")] = SEED,
    jobs: Jobs = 0,
    cluster: ClusterAddress = None,
) -> None:
    """Compare recognizers by what they make of the same ink.

    Without --ink the contest runs on generated ink: single strokes, and whole diagrams that are read,
    corrected and set in motion. It prints its tables and writes report.html with pictures of all of it.
    Published rivals learn from generated ink unless --train gives them people's. With --formulas or
    --expressions readers of handwritten mathematics are compared too, or alone.
    """
    from inklined.output import check_writable, write_text
    from inklined.terminal import out, progress
    from recognizer.published import PUBLISHED
    from recognizer.roster import ROSTER

    readers = known("--reader", reader or READERS, READERS)
    given = bool(ink or formulas or expressions)
    strokes = strokes if strokes is not None else 0 if given else STROKES
    pages = pages if pages is not None else 0 if given else PAGES
    drawn = bool(ink or strokes or pages or pens or stress or stress_pages)
    names = (rivals(recognizer or ()) or tuple(ROSTER)) if drawn else ()
    if not drawn and not formulas and not expressions:
        raise typer.BadParameter("--strokes 0 --pages 0 leaves nothing to compare; give one of them a number")
    if not drawn and recognizer:
        raise typer.BadParameter(
            "--recognizer: there are no strokes and no pages for it; --reader says who reads mathematics"
        )
    files = there(ink or ())
    written = there(formulas or ())
    lessons = there(train or ())
    workers = workers_of(jobs, cluster)
    if lessons and cluster:
        raise typer.BadParameter("--train teaches on this machine only; leave --cluster out")
    if lessons and not any(name in PUBLISHED for name in names):
        raise typer.BadParameter(
            f"--train teaches the published rivals; --recognizer names none of {', '.join(PUBLISHED)}"
        )
    place = report or (None if files or written else REPORT)
    for target in (place, json_file):
        if target:
            check_writable(target, [*files, *lessons, *written])

    with progress() as tell:
        from evaluation.contest import Extent, Reading, whole_contest
        from evaluation.report import report as report_of

        made, begun = datetime.now().astimezone(), perf_counter()
        learnt, names = _taught(lessons, templates, seed, names, tell) if lessons else (None, names)
        extent = Extent(strokes, pages, pens, stress, stress_pages, expressions)
        reading = Reading(readers, tuple(written), formula_rows)
        contest = whole_contest(files, extent, seed, names, workers, tell, learnt, reading)
        html = report_of(contest, _as_typed(), workers, tell, made) if place else ""

    # Files first: a reader of the terminal that hangs up must not cost the figures.
    if json_file:
        from evaluation.provenance import provenance
        from evaluation.summary import contest_summary

        origin = provenance(contest, TYPED.get(), made, perf_counter() - begun)
        figures = {**contest_summary(contest), "provenance": origin}
        write_text(json_file, json.dumps(figures, indent=1, ensure_ascii=False) + "\n", files)
    if tables:
        from evaluation.exports import save_tables
        from evaluation.report import report_tables

        save_tables(tables, report_tables(contest))
    if place:
        write_text(place, html, files)
    _print(contest)
    if json_file:
        out.print(f"Figures: {json_file}", markup=False)
    if place:
        out.print(f"Report: {place}", markup=False)


def _taught(
    files: Sequence[Path], per_kind: int, seed: int, names: tuple[str, ...], tell: Progress
) -> tuple[Lesson, tuple[str, ...]]:
    """What is learnt from the files, and the names with every published rival as it is once taught from it."""
    import numpy as np

    from evaluation.lessons import lesson
    from evaluation.rivals import taught_by_samples
    from recognizer.published import PUBLISHED
    from sketch.files import jsonl
    from sketch.files.errors import FileError

    rows = [row for file in files for row in jsonl.read(file).rows]
    try:
        learnt = lesson(rows, per_kind, np.random.default_rng(seed))
    except ValueError as error:
        raise FileError(", ".join(map(str, files)), str(error)) from None
    taught: list[str] = []
    for done, name in enumerate(names):
        tell("Teaching rivals", done, len(names))
        taught.append(taught_by_samples(name, learnt.samples, seed) if name in PUBLISHED else name)
    tell("Teaching rivals", len(names), len(names))
    return learnt, tuple(taught)


def _print(contest: Contest) -> None:
    """The contest's tables, and what they do not say."""
    from evaluation.formula_tables import formula_notes, formula_table
    from evaluation.page_tables import page_notes, page_tables
    from evaluation.tables import recall_table, stroke_notes, stroke_table
    from inklined.terminal import as_rich, out

    for suite, results in contest.stroke_suites():
        if suite.rows:
            out.print(as_rich(stroke_table(suite, results)))
            if suite.labels:
                out.print(as_rich(recall_table(results)))
            for note in stroke_notes(suite, results):
                out.print(note, style="dim", markup=False)
    paged = page_tables(contest.page_results)
    for table in paged:
        out.print(as_rich(table))
    for note in page_notes() if paged else ():
        out.print(note, style="dim", markup=False)
    for suite, results in contest.formulas:
        out.print(as_rich(formula_table(suite, results)))
        for note in formula_notes(suite):
            out.print(note, style="dim", markup=False)


def _as_typed() -> str:
    """This command line, for the report."""
    return "inklined " + shlex.join(TYPED.get())
