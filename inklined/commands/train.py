"""`inklined train`: starts the training of the learned recognizer where it is installed."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec

import typer

from inklined.output import OutputError

EXAMPLE = "Example: inklined train --help   (the options of training itself)"

KEEP_MEMORY = {
    "MALLOC_TRIM_THRESHOLD_": "2000000000",
    "MALLOC_MMAP_THRESHOLD_": "2000000000",
    "MALLOC_TOP_PAD_": "100000000",
}
"""Tells glibc to keep freed memory for the next batch: it halves the time of training on a CPU."""


def register(app: typer.Typer) -> None:
    """Adds the command; every argument after `train` goes to `python -m training` as it is."""
    app.command(
        epilog=EXAMPLE,
        context_settings={"allow_extra_args": True, "ignore_unknown_options": True, "help_option_names": []},
    )(train)


def train(context: typer.Context) -> None:
    """Train the learned recognizer anew from generated ink and export it to ONNX.

    Needs the extra `train` (torch, onnx): pip install 'inklined[train]'.
    """
    asked_for_help = "--help" in context.args
    missing = [name for name in ("torch", "onnx", "onnxscript", "training.__main__") if not _there(name)]
    if missing:
        if asked_for_help:
            typer.echo(context.get_help())
            return
        raise OutputError(
            f"training needs {', '.join(missing)}, not installed here; pip install 'inklined[train]' adds it"
        )
    if asked_for_help:
        typer.echo(context.get_help())
    finished = subprocess.run(
        [sys.executable, "-m", "training", *context.args], check=False, env={**KEEP_MEMORY, **os.environ}
    )
    raise typer.Exit(finished.returncode if finished.returncode >= 0 else 128 - finished.returncode)


def _there(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except ModuleNotFoundError:
        return False
