"""What the command line checks of its options beyond their types."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer

if TYPE_CHECKING:
    from evaluation.parallel import Workers

Name = TypeVar("Name", bound=str)
Jobs = Annotated[int, typer.Option("--jobs", min=0, help="Processes; 0: one for each core.")]
ClusterAddress = Annotated[
    str | None,
    typer.Option(
        "--cluster",
        help="Address of a Dask scheduler, tcp://HOST:PORT; its workers do the work, not this machine.",
    ),
]


def workers_of(jobs: int, cluster: str | None) -> Workers:
    """Who works, by --jobs and --cluster. Raises OutputError when a cluster is asked for and Dask is not installed."""
    from evaluation.parallel import Cluster, check_dask
    from inklined.output import OutputError

    if cluster is None:
        return jobs or os.cpu_count() or 1
    try:
        check_dask()
    except ValueError as error:
        raise OutputError(str(error)) from None
    return Cluster(cluster)


def known(option: str, values: Iterable[str], names: Collection[Name]) -> tuple[Name, ...]:
    """The values, each once, in their order. Raises typer.BadParameter for one that is no known name."""
    chosen: dict[Name, None] = {}
    for value in values:
        found = next((name for name in names if name == value), None)
        if found is None:
            raise typer.BadParameter(f"{option} {value}: there is no such name; known are {', '.join(names)}")
        chosen[found] = None
    return tuple(chosen)


def rivals(values: Iterable[str]) -> tuple[str, ...]:
    """Names of recognizers, ours or "module:Class" for somebody's own, each once. Raises typer.BadParameter
    for one that cannot be had."""
    from evaluation.rivals import known as all_rivals
    from recognizer.roster import recognizer

    for value in values:
        if ":" in value:
            try:
                recognizer(value)
            except ValueError as error:
                raise typer.BadParameter(f"--recognizer {error}") from None
        else:
            known("--recognizer", [value], (*all_rivals(), "module:Class (your own)"))
    return tuple(dict.fromkeys(values))


def there(paths: Iterable[Path]) -> list[Path]:
    """The paths. Raises FileNotFoundError or IsADirectoryError for one that is not a file to read."""
    checked = list(paths)
    for path in checked:
        if not path.exists():
            raise FileNotFoundError(2, "there is no such file", str(path))
        if path.is_dir():
            raise IsADirectoryError(21, "a folder, where a file of ink is needed", str(path))
    return checked


def there_or_folder(paths: Iterable[Path]) -> list[Path]:
    """The paths, files or folders. Raises FileNotFoundError for one that is not there."""
    checked = list(paths)
    for path in checked:
        if not path.exists():
            raise FileNotFoundError(2, "there is no such file or folder", str(path))
    return checked
