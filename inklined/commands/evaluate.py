"""`inklined evaluate`: generated strokes, pages or problems by the million, a shard at a time, on this machine or a cluster."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from inklined.options import ClusterAddress, Jobs, rivals, workers_of

SEED = 2026
STROKES = 100_000
"""Where nothing is said of how many, and of what."""
SHARDS = {"strokes": 2000, "pages": 20, "problems": 20}
"""Items of a shard: some seconds of work, so that little is lost with a worker."""


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(
        epilog="Example: inklined evaluate results --strokes 1000000 --recognizer geometric learned --cluster tcp://10.0.0.1:8786"
    )(evaluate)


def evaluate(
    folder: Annotated[
        Path, typer.Argument(help="Where results are streamed to; a run that was stopped goes on there.")
    ],
    strokes: Annotated[
        int | None, typer.Option(min=1, help=f"So many generated strokes. [default: {STROKES}]")
    ] = None,
    pages: Annotated[
        int | None, typer.Option(min=1, help="Or generated pages, read, corrected and moved.")
    ] = None,
    problems: Annotated[
        int | None, typer.Option(min=1, help="Or textbook problems in turn, drawn by simulated pens.")
    ] = None,
    recognizer: Annotated[
        list[str] | None,
        typer.Option(help="Who takes part, one or more; of pages and problems the oracle always does."),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the generated ink.")] = SEED,
    shard: Annotated[
        int | None,
        typer.Option(
            min=1, max=1_000_000, help="Items of a shard. [default: 2000 strokes, 20 pages or problems]"
        ),
    ] = None,
    jobs: Jobs = 0,
    cluster: ClusterAddress = None,
) -> None:
    """Evaluate recognizers on generated strokes, pages or problems of any number, with flat memory.

    Results are streamed to Parquet in the folder, a part for each shard; what is there already is not made again.
    """
    from resource import RUSAGE_SELF, getrusage
    from time import perf_counter

    from inklined.output import OutputError
    from inklined.terminal import as_rich, out, progress
    from recognizer.roster import ROSTER

    asked = {"strokes": strokes, "pages": pages, "problems": problems}
    given = [name for name, count in asked.items() if count is not None]
    if len(given) > 1:
        raise typer.BadParameter(
            f"{', '.join(f'--{name}' for name in given)}: a folder holds one of them; run each in its own"
        )
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder} is a file; name a folder for the results")
    names = rivals(recognizer or ROSTER)
    workers = workers_of(jobs, cluster)
    with progress() as tell:
        from evaluation.page_contest import ORACLE
        from evaluation.stream import Run, code_of, missing, shards
        from evaluation.stream import evaluate as evaluated
        from evaluation.stream_tables import tally_table

        suite = "pages" if pages else "problems" if problems else "strokes"
        count = asked[suite] or STROKES
        readers = names if suite == "strokes" else (*names, ORACLE)
        run = Run(count, seed, readers, suite, shard or SHARDS[suite], code_of(suite))
        fresh, begun = len(missing(run, folder)), perf_counter()
        found = evaluated(run, folder, workers, tell)
        seconds = perf_counter() - begun
    out.print(as_rich(tally_table(f"{count} generated {suite}, seed {seed}", found)))
    rate = min(count, run.shard * fresh) / seconds
    memory = getrusage(RUSAGE_SELF).ru_maxrss / 1024
    out.print(
        f"{fresh} shards made, {len(shards(run)) - fresh} were there; {seconds:.1f} s, {rate:.3g} {suite} a second; peak memory "
        f"of this process {memory:.0f} MB. Results: {folder}",
        markup=False,
    )
