"""`inklined generate`: synthetic ink with its truth, as files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from inklined.options import ClusterAddress, Jobs, known, workers_of

if TYPE_CHECKING:
    from evaluation.parallel import Workers

generate = typer.Typer(
    no_args_is_help=True,
    help="Generate synthetic ink with its truth: single strokes, or whole diagrams.",
    epilog="Example: inklined generate strokes strokes.jsonl.gz --count 5000 --seed 3",
)

Seed = Annotated[int, typer.Option(min=0, help="The same seed gives the same ink.")]


def register(app: typer.Typer) -> None:
    """Adds the commands `generate strokes` and `generate pages`."""
    app.add_typer(generate, name="generate")


@generate.command(
    epilog="Example: inklined generate strokes wires.jsonl.gz --count 500 --kind wire --kind spring"
)
def strokes(
    place: Annotated[
        Path,
        typer.Argument(
            help="A .jsonl, .jsonl.gz or .parquet file to write, or any other name for a folder of Parquet parts."
        ),
    ],
    count: Annotated[int, typer.Option(min=1, help="How many strokes.")] = 1000,
    seed: Seed = 0,
    kind: Annotated[list[str] | None, typer.Option(help="Only this kind; may be repeated.")] = None,
    profile: Annotated[
        str | None, typer.Option(help="Only this group of writers: adult, child, tremor or low_vision.")
    ] = None,
    shard: Annotated[int, typer.Option(min=1, max=1_000_000, help="Strokes of a part.")] = 20_000,
    jobs: Jobs = 1,
    cluster: ClusterAddress = None,
) -> None:
    """Write labelled single strokes of all kinds; memory does not grow with their number.

    A folder of parts is made by --jobs processes or the workers of --cluster; where it was stopped it goes on. A file is made
    by this process.
    """
    from data_gen.strokes import EQUAL, Recipe
    from data_gen.writers import PROFILES
    from inklined.output import check_writable
    from inklined.terminal import out, progress
    from sketch.files import formats
    from sketch.files.jsonl import Row
    from sketch.page import STROKE_KINDS, StrokeKind

    kinds: tuple[StrokeKind, ...] = known("--kind", kind or (), STROKE_KINDS)
    mix: Mapping[StrokeKind, float] = {name: 1 / len(kinds) for name in kinds} if kinds else EQUAL
    known("--profile", [profile] if profile else [], PROFILES)
    form = formats.format_of(place)
    if form is None:
        if kinds or profile:
            raise typer.BadParameter("--kind and --profile are for a file; a folder of parts holds all kinds")
        _parts(place, count, seed, shard, workers_of(jobs, cluster))
        return
    if form in formats.single():
        raise typer.BadParameter(f"{place}: {form} is a file a row; write .jsonl, and `inklined export` it")
    if cluster is not None:
        raise typer.BadParameter(f"{place}: a file is made by this process; name a folder for --cluster")
    check_writable(place)
    with progress() as tell:
        from evaluation.stream_suites import ink_rows

        def watched() -> Iterator[Row]:
            for done, row in enumerate(ink_rows(count, seed, mix=mix, recipe=Recipe(profile=profile))):
                if done % 512 == 0:
                    tell("Drawing strokes", done, count)
                yield row

        made = formats.write(place, watched())
    out.print(f"{made} strokes in {place}", markup=False)


def _parts(folder: Path, count: int, seed: int, shard: int, workers: Workers) -> None:
    """A folder of parts, each a suite."""
    from evaluation.stream import Run, code_of, evaluate, missing, shards
    from inklined.output import OutputError
    from inklined.terminal import out, progress

    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder} is a file; name a folder for the parts, or a .jsonl or .parquet file")
    run = Run(count, seed, suite="ink", shard=shard, code=code_of("ink"))
    fresh = len(missing(run, folder))
    with progress() as tell:
        evaluate(run, folder, workers, tell)
    out.print(
        f"{count} strokes in {folder}: {fresh} parts made, {len(shards(run)) - fresh} were there",
        markup=False,
    )


@generate.command(epilog="Example: inklined generate pages examples --count 12 --problem pendulum")
def pages(
    folder: Annotated[Path, typer.Argument(help="Folder to write to; it is made if it is not there.")],
    count: Annotated[int, typer.Option(min=1, max=100_000, help="How many pages.")] = 12,
    seed: Seed = 0,
    problem: Annotated[list[str] | None, typer.Option(help="Only this diagram; may be repeated.")] = None,
    answer: Annotated[
        str | None,
        typer.Option(help="Only this answer of the student: right, low, high … [default: all in turn]"),
    ] = None,
    jobs: Jobs = 1,
    cluster: ClusterAddress = None,
) -> None:
    """Write whole diagrams as .inklined documents: ink, components, mathematics and associations."""
    from data_gen.problems import ANSWERS, PROBLEMS
    from inklined.output import OutputError, write_text
    from inklined.terminal import out, progress

    names = known("--problem", problem or (), PROBLEMS) or PROBLEMS
    if answer is not None:
        names = tuple(name for name in names if answer in ANSWERS[name])
        if not names:
            every = sorted({given for answers in ANSWERS.values() for given in answers})
            raise typer.BadParameter(
                f"--answer {answer}: no such answer to these problems; there are {', '.join(every)}"
            )
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder} is a file; name a folder to write pages to")
    folder.mkdir(parents=True, exist_ok=True)

    def asked(index: int) -> tuple[str, int, int, str]:
        turn, which = divmod(index, len(names))
        given = answer or ANSWERS[names[which]][turn % len(ANSWERS[names[which]])]
        return names[which], seed, index, given

    tasks = [asked(index) for index in range(count)]
    with progress() as tell:
        from evaluation.parallel import as_done

        for number, text in as_done(_page, tasks, workers_of(jobs, cluster), "Drawing pages", tell):
            name, _, index, given = tasks[number]
            write_text(folder / f"{index:05d}-{name}-{given}.inklined", text)
    out.print(f"{count} pages in {folder}", markup=False)


def _page(task: tuple[str, int, int, str]) -> str:
    """A page's document, by its diagram, seed, index and answer."""
    from data_gen.pages import page
    from sketch.files import document

    name, seed, index, answer = task
    return document.dumps(page(name, seed, index, answer).truth)
