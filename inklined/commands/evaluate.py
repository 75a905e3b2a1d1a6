"""`inklined evaluate`: generated strokes by the million, a shard at a time, on this machine or a cluster."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from inklined.options import rivals

SEED = 2026


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(
        epilog="Example: inklined evaluate results --strokes 1000000 --recognizer geometric learned --cluster tcp://10.0.0.1:8786"
    )(evaluate)


def evaluate(
    folder: Annotated[
        Path, typer.Argument(help="Where results are streamed to; a run that was stopped goes on there.")
    ],
    strokes: Annotated[int, typer.Option(min=1, help="Generated strokes.")] = 100_000,
    recognizer: Annotated[list[str] | None, typer.Option(help="Who takes part, one or more.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the generated ink.")] = SEED,
    shard: Annotated[int, typer.Option(min=1, max=1_000_000, help="Strokes of a shard.")] = 2000,
    jobs: Annotated[int, typer.Option(min=0, help="Processes; 0: one for each core.")] = 0,
    cluster: Annotated[
        str | None,
        typer.Option(help="Address of a Dask scheduler, tcp://HOST:PORT; its workers do the work."),
    ] = None,
) -> None:
    """Evaluate recognizers on generated strokes of any number, with flat memory.

    Results are streamed to Parquet in the folder, a part for each shard; what is there already is not made again.
    """
    from resource import RUSAGE_SELF, getrusage
    from time import perf_counter

    from inklined.output import OutputError
    from inklined.terminal import as_rich, out, progress
    from recognizer.roster import ROSTER

    names = rivals(recognizer or ROSTER)
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder} is a file; name a folder for the results")
    with progress() as tell:
        from evaluation.stream import Run, code_digest, on_cluster, on_this_machine, place, shards
        from evaluation.stream import evaluate as evaluated
        from evaluation.table import column, table

        run = Run(strokes, seed, names, shard, code_digest())
        there = sum(place(folder, each).exists() for each in shards(run))
        try:
            engine = on_cluster(cluster) if cluster else on_this_machine(jobs or os.cpu_count() or 1)
        except ValueError as error:
            raise OutputError(str(error)) from None
        begun = perf_counter()
        found = evaluated(run, folder, engine, tell)
        seconds = perf_counter() - begun
    out.print(
        as_rich(
            table(
                f"{strokes} generated strokes, seed {seed}. Shares in %.",
                [one.name for one in found],
                {
                    "accuracy": column([one.accuracy for one in found], 2, 100),
                    "balanced": column([one.balanced_accuracy for one in found], 2, 100),
                },
            )
        )
    )
    fresh = len(shards(run)) - there
    rate = strokes * fresh / max(1, len(shards(run))) / seconds
    memory = getrusage(RUSAGE_SELF).ru_maxrss / 1024
    out.print(
        f"{fresh} shards made, {there} were there; {seconds:.1f} s, {rate:.0f} strokes a second; peak memory of this process "
        f"{memory:.0f} MB. Results: {folder}",
        markup=False,
    )
