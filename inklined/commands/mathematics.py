"""`inklined read`: handwritten mathematics, one expression a row, read and scored where it is labelled."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from inklined.options import known, there

FILES = Annotated[
    list[Path],
    typer.Argument(help="Expressions as JSON Lines, one a row; .gz by its name.", show_default=False),
]


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(epilog="Example: inklined read expressions.jsonl.gz --json read.json")(read)


def read(
    files: FILES,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write scores and readings as JSON; - for the terminal.")
    ] = None,
    reader: Annotated[
        str, typer.Option(help="Who tells the signs: net, or dollar-p, the simpler rival.")
    ] = "net",
    limit: Annotated[int | None, typer.Option(min=1, help="Read only this many rows.")] = None,
) -> None:
    """Read handwritten expressions: LaTeX, how sure that is, and how much is right where a row has a label."""
    import json
    from dataclasses import asdict

    from inklined.output import check_writable, write_text
    from recognizer.handwriting.roster import READERS, reader_of

    chosen = known("--reader", [reader], READERS)[0]
    there(files)
    to_terminal = json_file is not None and str(json_file) == "-"
    if json_file and not to_terminal:
        check_writable(json_file, files)

    from evaluation.handwriting import read_all, scores
    from inklined.terminal import out, progress
    from sketch.files.jsonl import read as rows_of
    from sketch.writing.rows import latex

    loaded = [rows_of(file) for file in files]
    rows = [row for one in loaded for row in one.rows][:limit]
    with progress() as tell:
        tell("Reading", 0, len(rows))
        found = read_all(rows, reader_of(chosen), lambda done: tell("Reading", done, len(rows)))
    for file, one in zip(files, loaded, strict=True):
        for notice in one.notices:
            typer.echo(f"inklined: {file.name}: {notice}", err=True)
    items = [
        {
            "truth": None if one.truth is None else latex(one.truth),
            "claim": one.reading.latex,
            "confidence": round(one.reading.confidence, 4),
            "alternatives": [[text, round(chance, 4)] for text, chance in one.reading.alternatives],
        }
        for one in found
    ]
    summary = asdict(scores(found))
    if json_file:
        text = json.dumps({**summary, "items": items}, ensure_ascii=False, indent=1) + "\n"
        if to_terminal:
            typer.echo(text, nl=False)
            return
        write_text(json_file, text, files)
    if not json_file:
        for item in items:
            out.print(f"{item['confidence']:.2f}  {item['claim']}", markup=False, highlight=False)
    for name, value in summary.items():
        out.print(
            f"{name}: {value if not isinstance(value, float) else round(value, 4)}",
            markup=False,
            highlight=False,
        )
