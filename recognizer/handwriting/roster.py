"""The readers of mathematics by name: they differ in who tells the signs, and share everything else."""

from __future__ import annotations

from functools import cache

from recognizer.handwriting.reader import Reader

READERS: tuple[str, ...] = ("net", "dollar-p")


@cache
def reader_of(name: str) -> Reader:
    """The reader of that name. Raises ValueError when there is none."""
    match name:
        case "net":
            return Reader()
        case "dollar-p":
            from recognizer.handwriting.cloud import taught

            return Reader(taught())
        case _:
            raise ValueError(f"no reader is called {name!r}; there are {', '.join(READERS)}")
