"""What is usual in mathematics: how likely one sign is to follow another, beside it or as its script.

Tables of counts from generated expressions, smoothed: P(sign | relation, sign it hangs on), and which
sign begins a row. They re-score readings and forbid none.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib import resources
from io import BytesIO
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from sketch.ink import FloatArray
from sketch.writing.rows import Row
from sketch.writing.signs import NUMBER, SIGNS

Start = Literal["line", "over", "under", "inside"]
STARTS: tuple[Start, ...] = ("line", "over", "under", "inside")
COUNT = len(SIGNS)
END = COUNT
"""The number of the end of a row."""


@dataclass(frozen=True, slots=True)
class Smoothing:
    """How much is kept for what was not seen. Shares of one."""

    bigram: float = 0.75
    unigram: float = 0.2
    """The rest is shared by all signs alike."""


SMOOTHING = Smoothing()


@dataclass(frozen=True, slots=True, eq=False)
class Language:
    """follow (3, signs, signs + 1): log P of what stands right of, below or above a sign, the last column that
    nothing does (only right: the row ends); start (4, signs): log P of a row's first sign."""

    follow: FloatArray
    start: FloatArray
    rows: list[list[list[float]]]
    """`follow` as lists, which Python reads faster."""


def counted(rows: Iterable[Row]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """How often what follows what in the rows: (3, signs, signs + 1) and (4, signs)."""
    follow = np.zeros((3, COUNT, COUNT + 1), dtype=np.int32)
    start = np.zeros((len(STARTS), COUNT), dtype=np.int32)

    def count(row: Row) -> None:
        for at, node in enumerate(row):
            number = NUMBER[node.name]
            follow[0, number, NUMBER[row[at + 1].name] if at + 1 < len(row) else END] += 1
            for relation, script in ((1, node.sub), (2, node.sup)):
                follow[relation, number, NUMBER[script[0].name] if script else END] += 1
                count(script)
            for name, part in (("over", node.over), ("under", node.under), ("inside", node.inside)):
                if part:
                    start[STARTS.index(name), NUMBER[part[0].name]] += 1
                    count(part)

    for row in rows:
        if row:
            start[0, NUMBER[row[0].name]] += 1
            count(row)
    return follow, start


def language(follow: NDArray[np.int32], start: NDArray[np.int32], rule: Smoothing = SMOOTHING) -> Language:
    """The counts as smoothed logarithms of probabilities."""
    rest = 1 - rule.bigram - rule.unigram
    once = follow.sum(axis=1, keepdims=True) + 1e-9
    usual = once / once.sum(axis=2, keepdims=True)
    seen = follow.sum(axis=2, keepdims=True)
    own = np.where(seen > 0, follow / np.maximum(seen, 1), usual)
    table = rule.bigram * own + rule.unigram * usual + rest / (COUNT + 1)
    first = start / np.maximum(start.sum(axis=1, keepdims=True), 1)
    follows = np.log(table)
    return Language(follows, np.log(0.9 * first + 0.1 / COUNT), follows.tolist())


def packed(follow: NDArray[np.int32], start: NDArray[np.int32]) -> bytes:
    """The counts as a file."""
    file = BytesIO()
    np.savez_compressed(file, follow=follow, start=start)
    return file.getvalue()


@cache
def shipped() -> Language:
    """The language of the expressions that the reader was taught with."""
    file = resources.files("recognizer.handwriting").joinpath("weights/language.npz").read_bytes()
    with np.load(BytesIO(file)) as tables:
        return language(tables["follow"], tables["start"])
