"""`inklined recognizers`: who can read ink, in a line each."""

from __future__ import annotations

import json
from typing import Annotated

import typer


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(epilog="Example: inklined compare --recognizer learned dollar-p hbf49-forest")(recognizers)


def recognizers(
    as_json: Annotated[bool, typer.Option("--json", help="As JSON, for programs.")] = False,
) -> None:
    """List the recognizers: their names, what they are, whose they are, and how they come to know ink."""
    from rich.markup import escape

    from inklined.terminal import out
    from recognizer.published import PUBLISHED
    from recognizer.roster import OURS

    rows = [(name, ours.summary, ours.source, ours.knows) for name, ours in OURS.items()]
    rows += [
        (name, one.summary, one.paper, f"{one.samples} generated of each kind, or --train")
        for name, one in PUBLISHED.items()
    ]
    if as_json:
        fields = ("name", "summary", "source", "learns_from")
        typer.echo(
            json.dumps([dict(zip(fields, row, strict=True)) for row in rows], indent=1, ensure_ascii=False)
        )
        return
    out.print("Names for --recognizer; your own is module:Class.", style="dim")
    for name, summary, source, learns in rows:
        out.print(f"[bold]{name:14}[/bold] {escape(summary)}")
        out.print(f"{'':14} {source}; learns from {learns}", style="dim", markup=False)
