"""`inklined studio`: draw in the browser, analyze, and watch it move."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(epilog="Example: inklined studio --host 0.0.0.0 --tls --no-browser")(studio)


def studio(
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="Where to listen; 0 takes any that is free.")
    ] = 8765,
    host: Annotated[
        str,
        typer.Option(help="Listen beyond this machine, for a tablet; the address shown has a token then."),
    ] = "127.0.0.1",
    browser: Annotated[bool, typer.Option(help="Open the studio in the browser.")] = True,
    tls: Annotated[
        bool, typer.Option("--tls", help="Encrypt, with a certificate of this machine's own.")
    ] = False,
    notebook: Annotated[
        Path | None,
        typer.Option(
            help="Folder to keep pages in. [default: $INKLINED_NOTEBOOK, or the user's data folder]",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Draw with a pen, a finger or the mouse; every stroke is kept. Ends with Ctrl+C."""
    from inklined.output import OutputError

    try:
        from studio.bundle import BundleError
        from studio.serve import Address, notebook_folder, serve
    except ModuleNotFoundError as missing:
        raise OutputError(f"the studio needs {missing.name}: pip install 'inklined[studio]'") from None
    try:
        serve(Address(host, port, tls), notebook or notebook_folder(), browser)
    except BundleError as reason:
        raise OutputError(str(reason)) from None
