"""All formats of labelled ink by name: how each is known, read and written, and what it has no place for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from sketch.files import dollar_xml, jsonl, marked, parquet, quickdraw, unipen, xml_tree
from sketch.files.errors import FileError
from sketch.files.jsonl import Loaded, Row
from sketch.files.store import read_bytes

Part = Literal["label", "writer", "times", "pressure", "extra"]
"""What a row may have besides its points."""
PARTS: tuple[Part, ...] = ("label", "writer", "times", "pressure", "extra")


@dataclass(frozen=True, slots=True)
class Format:
    """suffixes: of its files' names, .gz aside; holds: what of a row it has place for; own: the key of `extra` that it holds
    where it holds no others; read: a file's rows; write: rows to a file, for formats of many rows; write_one: one row to a
    file, for formats of one."""

    about: str
    suffixes: tuple[str, ...]
    holds: frozenset[Part]
    read: Callable[[Path], Loaded]
    write: Callable[[Path, Iterable[Row]], object] | None = None
    write_one: Callable[[Path, Row], None] | None = None
    own: str | None = None

    def losses(self, row: Row) -> tuple[Part, ...]:
        """What the row has that the format has no place for."""
        has: dict[Part, bool] = {
            "label": row.label is not None,
            "writer": row.writer is not None,
            "times": any(stroke.times is not None for stroke in row.ink),
            "pressure": any(stroke.pressure is not None for stroke in row.ink),
            "extra": any(key != self.own for key in row.extra),
        }
        return tuple(part for part in PARTS if has[part] and part not in self.holds)


_ALL = frozenset(PARTS)

FORMATS: dict[str, Format] = {
    "jsonl": Format("JSON Lines, a row a line", (".jsonl",), _ALL, jsonl.read, jsonl.write),
    "parquet": Format("Parquet, for large suites", (".parquet",), _ALL, parquet.read, parquet.write),
    "inkml": Format(
        "InkML with annotations and trace groups (CROHME, flow charts), a file a row",
        (".inkml",),
        _ALL - {"extra"},
        marked.read,
        write_one=marked.write,
        own="inkml",
    ),
    "dollar": Format(
        "XML of the $-family's gestures ($1, $N), a file a row",
        (".xml",),
        _ALL - {"extra"},
        dollar_xml.read,
        write_one=dollar_xml.write,
        own="gesture",
    ),
    "quickdraw": Format(
        "QuickDraw's ndjson, a row a line",
        (".ndjson",),
        _ALL - {"writer", "pressure"},
        quickdraw.read,
        quickdraw.write,
    ),
    "unipen": Format(
        "UNIPEN 1.0, many rows a file",
        (".unipen", ".dat", ".upn"),
        _ALL - {"extra"},
        unipen.read,
        unipen.write,
    ),
}


def format_of(path: Path) -> str | None:
    """The name of the format that a file's name says it has; None where it says none."""
    suffix = (path.with_suffix("") if path.suffix == ".gz" else path).suffix.lower()
    return next((name for name, form in FORMATS.items() if suffix in form.suffixes), None)


def read(path: Path, form: str | None = None) -> Loaded:
    """The rows of a file in the format of that name, or in what its name says; XML is looked into, since $-gestures and
    InkML both come as .xml. Raises FileError when it is of no known format or cannot be read."""
    name = form or format_of(path)
    if name is None:
        known = ", ".join(suffix for each in FORMATS.values() for suffix in each.suffixes)
        raise FileError(path, f"its name ends in none of {known}; say --format if it is one of them")
    if name in ("dollar", "inkml"):
        root = xml_tree.parse(read_bytes(path), path)
        return dollar_xml.parse(root, path) if root.name == "Gesture" else marked.parse(root, path)
    return FORMATS[name].read(path)


def write(path: Path, rows: Iterable[Row], form: str | None = None) -> int:
    """Saves the rows in the format of that name, or in what the path says; a format of one row a file makes a folder of
    files, named by number and label. Returns the number of rows. Raises FileError, OSError."""
    name = form or format_of(path)
    if name is None:
        raise FileError(path, f"its name says no format; known are {', '.join(FORMATS)}")
    count = 0

    def counted() -> Iterable[Row]:
        nonlocal count
        for row in rows:
            count += 1
            yield row

    chosen = FORMATS[name]
    if chosen.write is not None:
        chosen.write(path, counted())
    elif chosen.write_one is not None:
        path.mkdir(parents=True, exist_ok=True)
        for row in counted():
            chosen.write_one(path / f"{count:06d}{_tail(row.label)}{chosen.suffixes[0]}", row)
    return count


def single(names: Sequence[str] = tuple(FORMATS)) -> tuple[str, ...]:
    """Those of the formats that hold one row a file."""
    return tuple(name for name in names if FORMATS[name].write_one is not None)


def _tail(label: str | None) -> str:
    """The label as a file's name may have it."""
    kept = "".join(letter for letter in label or "" if letter.isalnum())[:24]
    return f"-{kept}" if kept else ""
