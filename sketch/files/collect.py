"""Many files of ink, read one after another: what could be read, and by name and number whatever could not.

A broken file, or a broken row of one, ends nothing. Memory holds one file at a time.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from sketch.files import formats, marked
from sketch.files.errors import FileError
from sketch.files.jsonl import Loaded, Row


@dataclass(frozen=True, slots=True)
class FileRead:
    """One file. rows: those taken; lost: rows that were not; remarks: what was not taken as it stood, each with its line;
    failure: why nothing of it could be read, None when something could."""

    path: Path
    rows: tuple[Row, ...]
    lost: int = 0
    remarks: tuple[str, ...] = ()
    failure: str | None = None


def files_in(paths: Iterable[Path], form: str | None = None) -> tuple[list[Path], list[Path]]:
    """The files to read, folders searched through, in order; and the files in folders that no format's name fits, which
    are passed over. With a format said, all files of a folder are read."""
    wanted: list[Path] = []
    passed: list[Path] = []
    for path in paths:
        if not path.is_dir():
            wanted.append(path)
            continue
        for file in sorted(found for found in path.rglob("*") if found.is_file()):
            fits = form is not None or formats.format_of(file) is not None
            (wanted if fits and not file.name.startswith(".") else passed).append(file)
    return wanted, passed


def collect(paths: Iterable[Path], form: str | None = None, by_part: bool = False) -> Iterator[FileRead]:
    """Each file as it is read. by_part: a row for each labelled group of marked InkML instead of one for the file."""
    for path in paths:
        try:
            yield _taken(path, formats.read(path, form), by_part)
        except (FileError, MemoryError, OSError, RecursionError) as error:
            reason = error.reason if isinstance(error, FileError) else f"{type(error).__name__}: {error}"
            place = f"{error.place}: " if isinstance(error, FileError) and error.place else ""
            yield FileRead(path, (), failure=place + reason)


def _taken(path: Path, loaded: Loaded, by_part: bool) -> FileRead:
    rows = loaded.rows
    if by_part and any("inkml" in row.extra for row in rows):
        rows = tuple(part for row in rows for part in marked.parts(row))
        if not rows:
            return FileRead(path, (), loaded.lost, failure="no trace group of it bears a label")
    return FileRead(path, rows, loaded.lost, tuple(str(notice) for notice in loaded.notices))
