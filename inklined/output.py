"""Files that appear whole or not at all, and never in place of what was read."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Generator, Iterable
from contextlib import contextmanager
from pathlib import Path


class OutputError(ValueError):
    """A place that cannot be written to as asked: the message says which and what would be right."""


@contextmanager
def replacing(path: Path, inputs: Iterable[Path] = ()) -> Generator[Path]:
    """A path beside `path`, of the same suffixes, to write to; it takes the place of `path` when the
    block ends well and is removed when it does not.

    Raises OutputError when the folder is not there, when `path` is a folder, or when it is one of
    the `inputs`.
    """
    check_writable(path, inputs)
    handle, name = tempfile.mkstemp(prefix=".inklined-", suffix="".join(path.suffixes), dir=path.parent)
    os.close(handle)
    draft = Path(name)
    try:
        yield draft
        draft.chmod(0o666 & ~_umask())
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def write_text(path: Path, text: str, inputs: Iterable[Path] = ()) -> None:
    """Writes UTF-8 text. Raises OutputError as `replacing`."""
    with replacing(path, inputs) as draft:
        draft.write_text(text, encoding="utf-8")


def check_writable(path: Path, inputs: Iterable[Path] = ()) -> None:
    """Raises OutputError when `path` cannot be written, before any long work is done for it."""
    if path.is_dir():
        raise OutputError(f"{path} is a folder; name a file in it")
    if not path.parent.is_dir():
        raise OutputError(f"the folder {path.parent} of {path.name} is not there; make it first")
    for read in inputs:
        if path.exists() and read.exists() and path.samefile(read):
            raise OutputError(f"{path} is what was read; name another file to write to")


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
