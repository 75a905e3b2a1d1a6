"""`inklined import`, `export` and `suites`: anybody's ink as a suite, a suite as anybody's files."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from inklined.options import known

if TYPE_CHECKING:
    from evaluation.cards import Card
    from sketch.files.collect import FileRead
    from sketch.files.jsonl import Row

SEED = 2026
TOLD = 8
"""Broken files and remarks that are shown; the JSON file holds all of them."""

Form = Annotated[
    str | None, typer.Option("--format", help="What the files are, where their names do not say it.")
]


def register(app: typer.Typer) -> None:
    """Adds the commands."""
    app.command(
        "import",
        epilog="Example: inklined import crohme/ --out symbols.parquet --parts --name crohme-symbols",
    )(import_)
    app.command(epilog="Example: inklined export symbols.parquet gestures/ --format dollar")(export)
    app.command(epilog="Example: inklined suites symbols.parquet --check")(suites)


def import_(
    sources: Annotated[
        list[Path], typer.Argument(help="Files of ink, or folders of them, in any known format.")
    ],
    out_file: Annotated[
        Path, typer.Option("--out", help="The suite to write: .parquet, .jsonl or .jsonl.gz.")
    ],
    name: Annotated[str | None, typer.Option(help="Of the suite. [default: the file's name]")] = None,
    version: Annotated[str, typer.Option(help="Of the suite.")] = "1",
    licence: Annotated[str | None, typer.Option(help="Of the ink, for the card.")] = None,
    parts: Annotated[
        bool, typer.Option("--parts", help="A row for each labelled trace group of InkML, not for each file.")
    ] = False,
    form: Form = None,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write what became of each file here.")
    ] = None,
) -> None:
    """Read ink in InkML, $-family XML, QuickDraw, UNIPEN, JSON Lines or Parquet, and keep it as one suite.

    Broken files and rows are named and counted; the others are read all the same. The suite's card is written beside it.
    """
    from evaluation import cards
    from inklined.options import there_or_folder
    from inklined.output import check_writable, write_text
    from inklined.terminal import out, progress
    from sketch.files import collect, formats
    from sketch.files.errors import FileError

    checked_format(form)
    if formats.format_of(out_file) not in ("parquet", "jsonl"):
        raise typer.BadParameter(f"--out {out_file}: a suite is a .parquet, .jsonl or .jsonl.gz file")
    files, passed = collect.files_in(there_or_folder(sources), form)
    if not files:
        raise FileError(", ".join(map(str, sources)), "no file in it is of a known format")
    for target in (out_file, json_file):
        if target:
            check_writable(target, files)
    read: list[FileRead] = []

    with progress() as tell:
        tally = cards.Tally()

        def rows() -> Iterator[Row]:
            for done, file in enumerate(collect.collect(files, form, parts), start=1):
                tell("Reading files", done, len(files))
                read.append(_without_rows(file))
                yield from file.rows
            if not tally.rows:
                told = read[0].failure or "it is empty"
                raise FileError(
                    read[0].path, f"nothing of any of the {len(files)} files could be read; {told}"
                )

        formats.write(out_file, tally.passing(rows()))
    broken = [file for file in read if file.failure]
    lost = sum(file.lost for file in read)
    remarks = [f"{len(broken)} of {len(files)} files could not be read"] * bool(broken)
    remarks += [f"{lost} rows could not be read"] * bool(lost)
    said = ", ".join(str(source) for source in sources)
    stem = out_file.name.removesuffix(".gz").rpartition(".")[0]
    card = tally.card(name or stem, version, said, licence=licence, remarks=remarks)
    cards.save(out_file, card)
    if json_file:
        write_text(json_file, json.dumps(_report(read, passed, card), indent=1, ensure_ascii=False) + "\n")
    out.print(
        f"{card.rows} rows, {card.strokes} strokes, {card.writers} writers from {len(files) - len(broken)} of {len(files)} "
        f"files in {out_file} (hash {card.hash})",
        markup=False,
    )
    if passed:
        out.print(f"{len(passed)} other files are of no known format and were passed over", markup=False)
    _tell(read, lost)


def export(
    suite: Annotated[Path, typer.Argument(help="A suite, or any file of labelled ink.")],
    place: Annotated[
        Path, typer.Argument(help="The file to write, or the folder, for formats of one row a file.")
    ],
    form: Annotated[
        str | None,
        typer.Option("--format", help="The format to write, where the place's name does not say it."),
    ] = None,
    label: Annotated[
        list[str] | None, typer.Option(help="Only rows with this label; may be repeated.")
    ] = None,
) -> None:
    """Write a suite as InkML, $-family XML, QuickDraw, UNIPEN, JSON Lines or Parquet."""
    from inklined.options import there
    from inklined.output import OutputError, check_writable
    from inklined.terminal import out
    from sketch.files import formats

    checked_format(form)
    (source,) = there([suite])
    chosen = form or formats.format_of(place)
    if chosen is None:
        raise typer.BadParameter(
            f"{place}: its name says no format; give --format, one of {', '.join(formats.FORMATS)}"
        )
    if chosen in formats.single():
        if place.exists() and (not place.is_dir() or any(place.iterdir())):
            raise OutputError(
                f"{place} is there already; name an empty or new folder, {chosen} is a file a row"
            )
    else:
        check_writable(place, [source])
    rows = [row for row in formats.read(source).rows if not label or row.label in label]
    if not rows:
        raise typer.BadParameter(f"no row of {source} has the label {' or '.join(label or ())}")
    count = formats.write(place, rows, chosen)
    out.print(f"{count} rows in {place}", markup=False)
    lost = [part for row in rows for part in formats.FORMATS[chosen].losses(row)]
    for part in dict.fromkeys(lost):
        out.print(
            f"{chosen} has no place for {part}: left out of {lost.count(part)} rows",
            style="dim",
            markup=False,
        )


def suites(
    files: Annotated[list[Path] | None, typer.Argument(help="Suites in files, or folders of them.")] = None,
    check: Annotated[bool, typer.Option("--check", help="Reckon each file's hash again.")] = False,
    seed: Annotated[int, typer.Option(min=0, help="Of the generated suites.")] = SEED,
    as_json: Annotated[bool, typer.Option("--json", help="As JSON, for programs.")] = False,
) -> None:
    """List suites by their cards: those that inklined generates, and those in files."""
    from evaluation import cards
    from evaluation.generated_suites import SUITES, card
    from inklined.options import there_or_folder
    from inklined.output import OutputError
    from inklined.terminal import out
    from sketch.files import collect, formats

    found = [] if files else [(name, SUITES[name].about, card(name, seed)) for name in SUITES]
    paths, _ = collect.files_in(there_or_folder(files or ()))
    for path in paths:
        if formats.format_of(path) is not None:
            found.append((str(path), "", cards.load(path)))
    wrong = [str(path) for path in paths if check and not cards.is_true(path, cards.load(path))]
    if as_json:
        typer.echo(
            json.dumps(
                [{"place": place, **asdict(one)} for place, _, one in found], indent=1, ensure_ascii=False
            )
        )
    else:
        for place, about, one in found:
            counted = "first " if about else ""
            out.print(f"[bold]{one.name}[/bold] version {one.version}, hash {one.hash}, {one.kind}")
            labels = ", ".join(f"{label} {n}" for label, n in list(one.labels.items())[:TOLD])
            lines = (
                about or place,
                f"{counted}{one.rows} rows, {one.strokes} strokes, {one.writers or 'no'} writers; {labels}",
                f"from {one.source}; licence {one.licence or 'not said'}; used by {SUITES[place].command}"
                if about
                else f"from {one.source}; licence {one.licence or 'not said'}",
                *one.remarks,
            )
            for line in lines:
                out.print(f"    {line}", style="dim", markup=False)
    if wrong:
        raise OutputError(f"{', '.join(wrong)} does not hold what its card says; import it again")


def checked_format(form: str | None) -> None:
    """Raises typer.BadParameter for a format that is not known."""
    from sketch.files import formats

    known("--format", [form] if form else [], formats.FORMATS)


def _without_rows(file: FileRead) -> FileRead:
    """The file's story without its ink, which need not stay in memory."""
    from dataclasses import replace

    return replace(file, rows=file.rows[:0])


def _report(read: Sequence[FileRead], passed: Sequence[Path], card: Card) -> dict[str, Any]:
    return {
        "suite": asdict(card),
        "files": [
            {
                "path": str(file.path),
                "failure": file.failure,
                "lost": file.lost,
                "remarks": list(file.remarks),
            }
            for file in read
        ],
        "passed_over": [str(path) for path in passed],
    }


def _tell(read: Sequence[FileRead], lost: int) -> None:
    """What could not be read, by name."""
    from inklined.terminal import out

    told = [f"{file.path}: {file.failure}" for file in read if file.failure]
    if told:
        out.print(f"{len(told)} files could not be read:", markup=False)
    remarks = [f"{file.path}, {remark}" for file in read for remark in file.remarks]
    for line in told[:TOLD]:
        out.print(f"    {line}", style="dim", markup=False)
    if remarks:
        out.print(f"{len(remarks)} remarks, {lost} rows lost:", markup=False)
    for line in remarks[:TOLD]:
        out.print(f"    {line}", style="dim", markup=False)
    more = max(0, len(told) - TOLD) + max(0, len(remarks) - TOLD)
    if more:
        out.print(f"    … and {more} more, all of them with --json", style="dim", markup=False)
