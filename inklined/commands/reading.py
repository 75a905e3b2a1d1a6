"""`inklined analyze` and `inklined simulate`: one page, read and set in motion."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from inklined.options import rivals, there

if TYPE_CHECKING:
    from sketch.page import Sketch

FILE = Annotated[
    Path,
    typer.Argument(
        help="A page: .inklined, .inkml, or .jsonl / .jsonl.gz (its first row).", show_default=False
    ),
]
NAME = "learned"


def register(app: typer.Typer) -> None:
    """Adds the two commands."""
    app.command(epilog="Example: inklined analyze page.inklined --recognizer geometric --svg page.svg")(
        analyze
    )
    app.command(epilog="Example: inklined simulate page.inklined --seconds 3 --svg strip.svg --gif page.gif")(
        simulate
    )


def analyze(
    file: FILE,
    recognizer: Annotated[str, typer.Option(help="Who reads the page.")] = NAME,
    svg: Annotated[
        Path | None, typer.Option(help="Draw the page with what was recognized over the ink.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Write the page with its meaning as .inklined document.")
    ] = None,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write what was recognized as JSON; - for the terminal.")
    ] = None,
) -> None:
    """Read a page: its components, what they hang on, its mathematics."""
    import json

    from inklined.output import check_writable, write_text

    rivals([recognizer])
    there([file])
    to_terminal = json_file is not None and str(json_file) == "-"
    for target in (svg, out, None if to_terminal else json_file):
        if target:
            check_writable(target, [file])

    from inklined.show import page_json, page_tables
    from inklined.terminal import as_rich, progress
    from inklined.terminal import out as terminal
    from sketch import svg as picture
    from sketch.files import document

    with progress() as tell:
        tell("Reading", 0, 1)
        page = read(file, recognizer)
    if svg:
        write_text(svg, picture.draw(page), [file])
    if out:
        write_text(out, document.dumps(page), [file])
    if json_file:
        text = json.dumps(page_json(page, recognizer), indent=1, ensure_ascii=False) + "\n"
        if to_terminal:
            typer.echo(text, nl=False)
            return
        write_text(json_file, text, [file])
    for table in page_tables(page, f"{file.name} as {recognizer} reads it"):
        terminal.print(as_rich(table))


def simulate(
    file: FILE,
    seconds: Annotated[float, typer.Option(min=0.05, max=60, help="How long.")] = 2.0,
    recognizer: Annotated[
        str | None,
        typer.Option(
            help=f"Who reads the ink. [default: nobody where the document says what it is, else {NAME}]"
        ),
    ] = None,
    svg: Annotated[Path | None, typer.Option(help="Draw some moments side by side.")] = None,
    gif: Annotated[Path | None, typer.Option(help="Write the motion as an animation, in real time.")] = None,
) -> None:
    """Correct a page, set it in motion, say what happens, and judge the answers on it."""
    from inklined.output import check_writable, write_bytes, write_text

    rivals([recognizer] if recognizer else ())
    there([file])
    for target in (svg, gif):
        if target:
            check_writable(target, [file])

    from evaluation.pictures import animation, strip
    from evaluation.words import happened
    from inklined.api import judge, move
    from inklined.terminal import out, progress
    from physics.outcome import outcome
    from sketch.files.pages import open_page

    with progress() as tell:
        tell("Reading", 0, 1)
        page = read(file, recognizer) if recognizer else open_page(file)
        if not recognizer and not page.components and len(page.ink):
            page = read(file, NAME)
        tell("Reading", 1, 1)
        tell("Moving", 0, 1)
        motion = move(page, seconds)
        tell("Moving", 1, 1)
        if svg:
            write_text(svg, strip(motion, seconds), [file])
        if gif:
            write_bytes(gif, animation(motion, seconds, tell), [file])
        tell("Judging", 0, 1)
        verdicts = judge(page)
    for line in happened(motion, outcome(motion)):
        out.print(line, markup=False)
    for verdict in verdicts:
        out.print(f"{verdict.component}: {verdict.message}", markup=False)
    for correction in motion.corrections:
        out.print(
            f"Corrected: {correction.why} ({correction.rule})",
            style="dim",
            markup=False,
        )


def read(file: Path, recognizer: str) -> Sketch:
    """The page as that recognizer reads it."""
    from inklined.api import analyze as analyzed

    return analyzed(file, recognizer)
