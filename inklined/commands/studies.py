"""`inklined protocol`, `early`, `stress`, `gestures`, `agreement` and `plan`: examinations of recognizers, and how many rows they need."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from inklined.options import ClusterAddress, Jobs, known, rivals, there, workers_of

if TYPE_CHECKING:
    from evaluation.table import Table

SEED = 2026
PROTOCOLS = ("user-dependent", "user-independent", "zero-shot")
Json = Annotated[Path | None, typer.Option("--json", help="Write all figures here as JSON.")]
Folder = Annotated[
    Path | None, typer.Option("--tables", help="Write every table into this folder, as CSV and LaTeX.")
]
Names = Annotated[list[str] | None, typer.Option(help="Who takes part, one or more.")]


def register(app: typer.Typer) -> None:
    """Adds the commands."""
    app.command(
        epilog="Example: inklined protocol user-dependent gestures.parquet --recognizer dollar-p protractor --templates 1 3 5"
    )(protocol)
    app.command(epilog="Example: inklined early strokes.jsonl.gz --recognizer learned geometric")(early)
    app.command(epilog="Example: inklined stress --axis tremor gap --recognizer hybrid geometric --pages 24")(
        stress
    )
    app.command(epilog="Example: inklined gestures gestures.parquet --per-writer --tables tables")(gestures)
    app.command(epilog="Example: inklined agreement proposals.csv --json agreement.json")(agreement)
    app.command(epilog="Example: inklined plan --first 0.05 --second 0.01 --per-writer 20 --alike 0.1")(plan)


def protocol(
    kind: Annotated[str, typer.Argument(help=f"One of {', '.join(PROTOCOLS)}.")],
    ink: Annotated[list[Path], typer.Argument(help="Labelled ink in any known format; labels of any kind.")],
    recognizer: Names = None,
    templates: Annotated[
        list[int] | None, typer.Option(help="Rows of each label learnt from, one or more. [default: 1 2 4]")
    ] = None,
    trials: Annotated[int, typer.Option(min=1, max=10_000, help="Draws of templates for each writer.")] = 10,
    folds: Annotated[int, typer.Option(min=2, max=10_000, help="Folds of writers that are left out.")] = 5,
    seed: Annotated[int, typer.Option(min=0, help="Of the draws.")] = SEED,
    jobs: Jobs = 0,
    cluster: ClusterAddress = None,
    json_file: Json = None,
    tables: Folder = None,
) -> None:
    """Examine recognizers on people's gestures: who is learnt from, and who is tested.

    user-dependent: T templates of each label by a writer, another drawing of that writer tested, so many trials.
    user-independent: writers left out in folds. zero-shot: nothing learnt from people.
    """
    import numpy as np

    from inklined.terminal import progress
    from recognizer.published import PUBLISHED
    from recognizer.roster import ROSTER

    (chosen,) = known("the protocol", [kind], PROTOCOLS)
    counts = sorted(set(templates or (1, 2, 4)))
    if min(counts) < 1:
        raise typer.BadParameter("--templates must be at least 1")
    files = there(ink)
    untaught = chosen == "zero-shot"
    names = rivals(recognizer or (ROSTER if untaught else ("protractor", "dollar-p", "hbf49-linear")))
    if not untaught and any(name not in PUBLISHED for name in names):
        raise typer.BadParameter(
            f"{chosen} examines those that learn: {', '.join(PUBLISHED)}; the others take zero-shot"
        )
    with progress() as tell:
        from evaluation import examination, protocols
        from sketch.files import formats
        from sketch.files.errors import FileError

        rows = protocols.usable([row for file in files for row in formats.read(file).rows])
        rng = np.random.default_rng(seed)
        try:
            match chosen:
                case "user-dependent":
                    splits = protocols.user_dependent(rows, counts, trials, rng)
                case "user-independent":
                    splits = protocols.user_independent(rows, counts, folds, rng)
                case _:
                    splits = protocols.zero_shot(rows)
        except ValueError as error:
            raise FileError(", ".join(map(str, files)), str(error)) from None
        guesses = protocols.examine(rows, splits, names, seed, workers_of(jobs, cluster), tell)
        found, fought = examination.marks(rows, guesses, seed), examination.duels(guesses)
    _tell(
        examination.tables(chosen, found, fought),
        {"protocol": chosen, **examination.plain(found, fought)},
        json_file,
        tables,
    )


def early(
    ink: Annotated[list[Path], typer.Argument(help="Labelled ink; labels must be stroke kinds.")],
    recognizer: Names = None,
    steps: Annotated[
        int, typer.Option(min=2, max=100, help="So many parts of the stroke, one after another.")
    ] = 10,
    jobs: Jobs = 0,
    cluster: ClusterAddress = None,
    json_file: Json = None,
    tables: Folder = None,
) -> None:
    """How early is a stroke known? Accuracy against the fraction of its length that has been drawn."""
    from inklined.terminal import progress
    from recognizer.roster import ROSTER

    files = there(ink)
    names = rivals(recognizer or ROSTER)
    with progress() as tell:
        from evaluation.early import early_curves, early_table, plain
        from sketch.files import formats
        from sketch.files.errors import FileError

        rows = [row for file in files for row in formats.read(file).rows]
        try:
            curves = early_curves(rows, names, steps, workers_of(jobs, cluster), tell)
        except ValueError as error:
            raise FileError(", ".join(map(str, files)), str(error)) from None
    _tell([early_table(curves)], plain(curves), json_file, tables)


def stress(
    recognizer: Names = None,
    axis: Annotated[list[str] | None, typer.Option(help="What grows, one or more. [default: all]")] = None,
    strokes: Annotated[
        int, typer.Option(min=1, max=1_000_000, help="Generated strokes at each level.")
    ] = 450,
    pages: Annotated[
        int, typer.Option(min=0, max=10_000, help="Generated pages at each level, for the motion.")
    ] = 0,
    seed: Annotated[int, typer.Option(min=0, help="Of the generated ink.")] = SEED,
    jobs: Jobs = 0,
    cluster: ClusterAddress = None,
    json_file: Json = None,
    tables: Folder = None,
) -> None:
    """What can recognizers bear? Accuracy and motion against tremor, rate, speed, gap, rotation, scale, order and missing
    time, and on groups of writers."""
    from inklined.terminal import progress
    from recognizer.roster import ROSTER

    names = rivals(recognizer or ROSTER)
    with progress() as tell:
        from evaluation import stress_contest as contest
        from evaluation.stress import AXES
        from evaluation.stress_tables import stress_tables

        axes = known("--axis", axis or AXES, AXES)
        workers = workers_of(jobs, cluster)
        curves, by_group = contest.under_stress(names, axes, (strokes, pages), seed, workers, tell)
    figures = {"seed": seed, "strokes": strokes, "pages": pages, **contest.plain(curves, by_group)}
    _tell(stress_tables(curves, by_group), figures, json_file, tables)


def gestures(
    ink: Annotated[list[Path], typer.Argument(help="Labelled gestures in any known format.")],
    per_writer: Annotated[
        bool, typer.Option("--per-writer", help="Against each writer's own way, not everybody's.")
    ] = False,
    json_file: Json = None,
    tables: Folder = None,
) -> None:
    """How do people make their gestures? Relative accuracy (GREAT) and consistency (GECKo), by label."""
    from evaluation.gestures.tables import study
    from inklined.terminal import progress
    from sketch.files import formats
    from sketch.files.errors import FileError

    files = there(ink)
    with progress():
        rows = [row for file in files for row in formats.read(file).rows]
        try:
            found, figures = study(rows, SEED, per_writer)
        except ValueError as error:
            raise FileError(", ".join(map(str, files)), str(error)) from None
    _tell(found, figures, json_file, tables)


def agreement(
    proposals: Annotated[
        Path,
        typer.Argument(help="CSV: a head with the referents, a row a participant, each cell the proposal."),
    ],
    json_file: Json = None,
    tables: Folder = None,
) -> None:
    """How far do participants of an elicitation study agree? Agreement rates (AGATe), and whether they differ."""
    from evaluation.gestures.elicitation import elicitation, elicitation_table, plain
    from sketch.files.errors import FileError
    from sketch.files.store import read_text

    (place,) = there([proposals])
    try:
        found = elicitation(read_text(place))
    except ValueError as error:
        raise error if isinstance(error, FileError) else FileError(place, str(error)) from None
    _tell([elicitation_table(found)], plain(found), json_file, tables)


def plan(
    first: Annotated[
        float, typer.Option(min=0, max=1, help="Share of rows that the one alone will have right.")
    ] = 0.05,
    second: Annotated[
        float, typer.Option(min=0, max=1, help="Share of rows that the other alone will have right.")
    ] = 0.02,
    per_writer: Annotated[int, typer.Option(min=1, help="Rows that each writer draws.")] = 1,
    alike: Annotated[
        float, typer.Option(min=0, max=1, help="Intraclass correlation of a writer's rows.")
    ] = 0.0,
    alpha: Annotated[float, typer.Option(min=1e-6, max=0.5, help="Of the test.")] = 0.05,
    power: Annotated[float, typer.Option(min=0.05, max=0.999, help="To be reached.")] = 0.8,
    margin: Annotated[
        float | None,
        typer.Option(help="Plan one recognizer's interval instead: it is to reach so far to either side,"),
    ] = None,
    share: Annotated[
        float, typer.Option(help="of about this share that is right; a half needs the most rows.")
    ] = 0.5,
) -> None:
    """How many rows and writers does a comparison need, so that McNemar's exact test finds the difference? Or, with --margin, a
    share's interval?"""
    from evaluation.statistics.planner import rows_for_difference, rows_for_margin
    from inklined.terminal import out

    try:
        made = (
            rows_for_difference(first, second, per_writer, alike, alpha, power)
            if margin is None
            else rows_for_margin(share, margin, per_writer, alike, alpha)
        )
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None
    reached = f"margin {margin:g}" if made.power is None else f"power {made.power:.3f}"
    out.print(
        f"{made.rows} rows by {made.writers} writers: {reached} at alpha {alpha:g}, design effect {made.effect:.2f}"
    )


def _tell(
    tables: Sequence[Table], figures: dict[str, Any], json_file: Path | None, folder: Path | None
) -> None:
    from evaluation.exports import save_tables
    from inklined.output import write_text
    from inklined.terminal import as_rich, out

    if json_file:
        write_text(json_file, json.dumps(figures, indent=1, ensure_ascii=False) + "\n")
    if folder:
        save_tables(folder, tables)
    for table in tables:
        out.print(as_rich(table))
    for place in (json_file, folder):
        if place:
            out.print(f"Written: {place}", markup=False)
