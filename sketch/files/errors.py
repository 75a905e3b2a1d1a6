"""What a file that cannot be read says, and what one that can be read in part reports."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


class FileError(ValueError):
    """A file that cannot be read or written: the message names the file, the place in it, what was wrong
    and what would be right."""

    def __init__(self, source: str | Path, reason: str, place: str = "") -> None:
        self.source = str(source)
        self.place = place
        self.reason = reason
        super().__init__(f"{self.source}{f', {place}' if place else ''}: {reason}")

    def __reduce__(self) -> tuple[type[FileError], tuple[str, str, str]]:
        return FileError, (self.source, self.reason, self.place)


@dataclass(frozen=True, slots=True)
class Notice:
    """Something in a file that was not taken as it stood.

    line: 1-based line of the file; text: what and why, in one sentence; lost: the row is not among
    those returned.
    """

    line: int
    text: str
    lost: bool

    def __str__(self) -> str:
        return f"line {self.line}: {self.text}"
