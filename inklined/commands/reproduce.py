"""`inklined reproduce`: has a report's figures again, and says whether they are the same."""

from __future__ import annotations

import json
import shlex
import tempfile
from pathlib import Path
from typing import Annotated, Any

import typer

TOLD = 12
"""Differences that are shown."""
PLACES = ("--json", "--report", "--tables")
"""Options of `compare` that name what it writes."""


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command(epilog="Example: inklined reproduce scores.json")(reproduce)


def reproduce(
    figures: Annotated[Path, typer.Argument(help="What `inklined compare --json` wrote.")],
) -> None:
    """Run the comparison that figures come from again, where its files are, and compare every figure but the timings."""
    from evaluation.provenance import LIBRARIES, differences, without_timings
    from inklined.cli import run
    from inklined.options import there
    from inklined.output import OutputError
    from inklined.terminal import out
    from sketch.files.errors import FileError
    from sketch.files.store import read_text

    (place,) = there([figures])
    try:
        before: dict[str, Any] = json.loads(read_text(place))
        origin: dict[str, Any] = before["provenance"]
        arguments = [str(word) for word in origin["arguments"]]
    except (ValueError, KeyError, TypeError) as error:
        raise FileError(
            place, f"holds no figures of inklined compare with their provenance: {error}"
        ) from None
    if arguments[:1] != ["compare"]:
        raise FileError(place, f"comes from {shlex.join(arguments)!r}; only `compare` is run again")
    with tempfile.TemporaryDirectory() as folder:
        again = Path(folder) / "again.json"
        code = run(
            [*_without_places(arguments), "--json", str(again), "--report", str(Path(folder) / "again.html")]
        )
        if code:
            raise OutputError(f"inklined {shlex.join(arguments)} ended with code {code}")
        after: dict[str, Any] = json.loads(read_text(again))
    told = differences(*(without_timings(_without_words(each)) for each in (before, after)))
    changed = [
        name
        for name in LIBRARIES
        if origin.get("versions", {}).get(name) != after["provenance"]["versions"].get(name)
    ]
    if told:
        for line in told[:TOLD]:
            out.print(line, markup=False)
        more = f", {len(told) - TOLD} more of them" if len(told) > TOLD else ""
        cause = f"; other versions of {', '.join(changed)}" if changed else ""
        raise OutputError(f"{len(told)} figures are not what {place} says{more}{cause}")
    out.print(f"Every figure is what {place} says, apart from timings.", markup=False)


def _without_words(figures: dict[str, Any]) -> dict[str, Any]:
    """The figures with their provenance but for how they were asked for and by whose libraries."""
    origin = {key: value for key, value in figures["provenance"].items() if key in ("seed", "hashes")}
    return {**figures, "provenance": origin}


def _without_places(arguments: list[str]) -> list[str]:
    """The command without what it is to write."""
    kept: list[str] = []
    skip = False
    for word in arguments:
        if not skip and word not in PLACES and not word.startswith(tuple(f"{name}=" for name in PLACES)):
            kept.append(word)
        skip = not skip and word in PLACES
    return kept
