"""Opening any file that holds a page."""

from __future__ import annotations

from pathlib import Path

from sketch.files import document, inkml, jsonl
from sketch.files.errors import FileError
from sketch.page import Sketch

SUFFIXES = (".inklined", ".inkml", ".jsonl")


def open_page(path: str | Path) -> Sketch:
    """The page in a file, by the suffix of its name (.gz may follow): a `.inklined` document, the ink of
    an InkML file, or the ink of the first readable row of JSON Lines.

    Raises FileError when the suffix is none of these or the file cannot be read.
    """
    file = Path(path)
    match _suffix(file):
        case ".inklined":
            return document.read(file)
        case ".inkml":
            return Sketch(inkml.read(file))
        case ".jsonl":
            return Sketch(jsonl.read(file).rows[0].ink)
        case _:
            raise FileError(file, f"is of no kind that holds a page; known are {', '.join(SUFFIXES)}")


def _suffix(file: Path) -> str:
    return (file.with_suffix("") if file.suffix == ".gz" else file).suffix.lower()
