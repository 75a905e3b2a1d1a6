"""`inklined generate`: synthetic ink with its truth, as files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer

from inklined.options import known

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
    file: Annotated[Path, typer.Argument(help="JSON Lines to write; a name ending in .gz is compressed.")],
    count: Annotated[int, typer.Option(min=1, max=10_000_000, help="How many strokes.")] = 1000,
    seed: Seed = 0,
    kind: Annotated[list[str] | None, typer.Option(help="Only this kind; may be repeated.")] = None,
    profile: Annotated[
        str | None, typer.Option(help="Only this group of writers: adult, child, tremor or low_vision.")
    ] = None,
) -> None:
    """Write labelled single strokes of all kinds as JSON Lines."""
    from data_gen.strokes import EQUAL, Recipe, stream
    from data_gen.writers import PROFILES
    from inklined.output import check_writable
    from inklined.terminal import out, progress
    from sketch.files import jsonl
    from sketch.ink import Ink
    from sketch.page import STROKE_KINDS, StrokeKind

    kinds: tuple[StrokeKind, ...] = known("--kind", kind or (), STROKE_KINDS)
    mix: Mapping[StrokeKind, float] = {name: 1 / len(kinds) for name in kinds} if kinds else EQUAL
    known("--profile", [profile] if profile else [], PROFILES)
    check_writable(file)
    rows: list[jsonl.Row] = []
    with progress() as tell:
        for stroke in stream(count, seed, mix=mix, recipe=Recipe(profile=profile)):
            rows.append(
                jsonl.Row(stroke.kind, Ink((stroke.stroke,)), None, {"index": stroke.index, "seed": seed})
            )
            if len(rows) % 512 == 0:
                tell("Drawing strokes", len(rows), count)
    jsonl.write(file, rows)
    out.print(f"{len(rows)} strokes in {file}", markup=False)


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
) -> None:
    """Write whole diagrams as .inklined documents: ink, components, mathematics and associations."""
    from data_gen.pages import page
    from data_gen.problems import ANSWERS, PROBLEMS
    from inklined.output import OutputError, write_text
    from inklined.terminal import out, progress
    from sketch.files import document

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
    with progress() as tell:
        for index in range(count):
            turn, which = divmod(index, len(names))
            name = names[which]
            given = answer or ANSWERS[name][turn % len(ANSWERS[name])]
            drawn = page(name, seed, index, given)
            write_text(folder / f"{index:05d}-{name}-{given}.inklined", document.dumps(drawn.truth))
            tell("Drawing pages", index + 1, count)
    out.print(f"{count} pages in {folder}", markup=False)
