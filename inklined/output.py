"""Files that appear whole or not at all, and never in place of what was read."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

from sketch.files import store


class OutputError(ValueError):
    """A place that cannot be written to as asked: the message says which and what would be right."""


def write_text(path: Path, text: str, inputs: Iterable[Path] = ()) -> None:
    """Writes UTF-8 text. Raises OutputError as `check_writable`, FileError when writing fails."""
    check_writable(path, inputs)
    store.write_text(path, text)


def write_bytes(path: Path, data: bytes, inputs: Iterable[Path] = ()) -> None:
    """Writes bytes by way of a draft beside `path`. Raises OutputError as `check_writable`, and when
    writing fails."""
    check_writable(path, inputs)
    try:
        handle, name = tempfile.mkstemp(prefix=".inklined-", dir=path.parent)
        draft = Path(name)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            draft.chmod(0o644)
            draft.replace(path)
        finally:
            draft.unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror or error}") from None


def check_writable(path: Path, inputs: Iterable[Path] = ()) -> None:
    """Raises OutputError when `path` cannot be written to, before any long work is done for it: when it
    is a folder or one of the `inputs`, or when its folder is not there."""
    if path.is_dir():
        raise OutputError(f"{path} is a folder; name a file in it")
    if not path.parent.is_dir():
        raise OutputError(f"the folder {path.parent} of {path.name} is not there; make it first")
    for read in inputs:
        if path.exists() and read.exists() and path.samefile(read):
            raise OutputError(f"{path} is what was read; name another file to write to")
