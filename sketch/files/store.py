"""Bytes in and out of files: gzip by name, and writing that never leaves half a file."""

from __future__ import annotations

import gzip
import os
import tempfile
import zlib
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, cast

from sketch.files.errors import FileError


@dataclass(frozen=True, slots=True)
class StoreLimits:
    size: int = 1 << 30
    """Bytes of a file once unpacked: a fifth of it holds the largest page `InkLimits` accepts."""


LIMITS = StoreLimits()


def read_text(path: str | Path) -> str:
    """The text of a UTF-8 file, unpacked when its name ends in .gz.

    Raises FileError when there is none, or it is no text, no gzip, or too large.
    """
    try:
        return read_bytes(path).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(path, "is not UTF-8 text", f"byte {error.start}") from None


def read_bytes(path: str | Path) -> bytes:
    """What a file holds, unpacked when its name ends in .gz. Raises FileError as `read_text` does."""
    file = Path(path)
    try:
        raw = gzip.open(file) if file.suffix == ".gz" else file.open("rb")  # noqa: SIM115  (closed below)
        with raw:
            data = raw.read(LIMITS.size + 1)
    except FileNotFoundError:
        raise FileError(file, "there is no such file") from None
    except (OSError, EOFError, zlib.error) as error:
        raise FileError(file, f"cannot be read: {error}") from None
    if len(data) > LIMITS.size:
        raise FileError(file, f"is larger than the {LIMITS.size} bytes that are read; split it")
    return data


def write_text(path: str | Path, text: str) -> None:
    """Write the file whole or not at all: what was there stays until the new text is on disk.

    Packed when its name ends in .gz, with no time stamp, so that equal text gives equal bytes.
    Raises FileError when the folder cannot be written to.
    """
    with written(path) as file:
        file.write(text.encode("utf-8"))


@contextmanager
def written(path: str | Path) -> Generator[BinaryIO]:
    """The same for bytes that come little by little: a file to write them to, as `drafted` has it."""
    with drafted(path) as draft:
        if Path(path).suffix != ".gz":
            yield draft
            return
        with gzip.GzipFile("", "wb", compresslevel=6, fileobj=draft, mtime=0) as packed:
            yield cast(BinaryIO, packed)


@contextmanager
def drafted(path: str | Path) -> Generator[BinaryIO]:
    """A file to write bytes to that takes the place of `path` when the block ends well, and is gone when it does not.

    Raises FileError when the folder cannot be written to.
    """
    file = Path(path)
    try:
        handle, name = tempfile.mkstemp(dir=file.parent, prefix=f".{file.name}.")
        draft = Path(name)
        try:
            with os.fdopen(handle, "wb") as out:
                yield out
                out.flush()
                os.fsync(out.fileno())
            draft.chmod(_mode(file))
            draft.replace(file)
        except BaseException:
            draft.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise FileError(file, f"cannot be written: {error.strerror or error}") from None


def _mode(file: Path) -> int:
    """Permissions of the file that is there, or what a new file would get (a draft is private)."""
    if file.exists():
        return file.stat().st_mode & 0o7777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
