"""`inklined observe`: what a body of a page does through time, as a table, a file or a graph."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from inklined.commands.reading import FILE, NAME, read
from inklined.options import rivals, there


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(
        epilog="Example: inklined observe page.inklined --body B --quantity velocity 'net force' --csv b.csv"
    )(observe)


def observe(
    file: FILE,
    body: Annotated[str, typer.Option(help="Which body, by its label (inklined analyze shows them).")],
    quantity: Annotated[
        list[str] | None,
        typer.Option(help="What of it, one or more; without any: everything, and its names are listed."),
    ] = None,
    seconds: Annotated[float, typer.Option(min=0.05, max=60, help="How long.")] = 2.0,
    rate: Annotated[float, typer.Option(min=1, max=10_000, help="Frames a second.")] = 60.0,
    recognizer: Annotated[
        str | None,
        typer.Option(
            help=f"Who reads the ink. [default: nobody where the document says what it is, else {NAME}]"
        ),
    ] = None,
    csv: Annotated[Path | None, typer.Option(help="Write the table as CSV.")] = None,
    parquet: Annotated[Path | None, typer.Option(help="Write the table as Parquet.")] = None,
    svg: Annotated[Path | None, typer.Option(help="Draw graphs over time.")] = None,
) -> None:
    """Observe a body: velocity, acceleration, forces, energies and more."""
    import io

    from inklined.output import check_writable, write_bytes, write_text

    rivals([recognizer] if recognizer else ())
    there([file])
    for target in (csv, parquet, svg):
        if target:
            check_writable(target, [file])

    from evaluation.table import Cell, Table
    from inklined.api import move
    from inklined.terminal import as_rich, out, progress
    from physics import observables
    from sketch.files.pages import open_page

    with progress() as tell:
        tell("Moving", 0, 1)
        page = read(file, recognizer) if recognizer else open_page(file)
        if not recognizer and not page.components and len(page.ink):
            page = read(file, NAME)
        motion = move(page, seconds, rate)
        scene, run = motion.scene, motion.trajectory
        series = (
            tuple(observables.observe(scene, run, body, name) for name in quantity)
            if quantity
            else observables.observe_all(scene, run, body)
        )
        tell("Moving", 1, 1)
        if csv:
            write_text(csv, observables.csv(series), [file])
        if parquet:
            write_bytes(parquet, observables.parquet(series), [file])
        if svg:
            drawn = io.BytesIO()
            observables.figure(series).savefig(drawn, format="svg")
            write_bytes(svg, drawn.getvalue(), [file])
    rows = tuple(
        (
            one.name,
            Cell(one.unit),
            *(Cell(f"{value:.4g}") for value in (one.size[0], one.size.max(), one.size[-1])),
        )
        for one in series
    )
    head = ("", "unit", "at the start", "greatest", "at the end")
    out.print(as_rich(Table(f"{body} of {file.name} in {seconds:g} s (vectors by their size)", head, rows)))
