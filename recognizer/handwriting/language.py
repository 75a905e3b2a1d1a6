"""What is usual in mathematics: how likely one sign is to follow another, beside it or as its script.

Tables of counts from generated expressions, smoothed: P(sign | where, sign it hangs on), and which sign
begins a row. What goes on in an exponent or in a fraction differs from what goes on in a line (an equals sign ends neither), so
that each has a table of its own. They re-score readings and forbid none.
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
from sketch.writing.signs import (
    ACCENTS,
    BARS,
    CLOSING,
    DEGREE,
    DIGITS,
    FRACTION,
    FUNCTIONS,
    LETTERS,
    NUMBER,
    OPENING,
    OPERATORS,
    POINTS,
    PRIME,
    RELATIONS,
    ROOT,
    SIGNS,
)

Start = Literal["line", "over", "under", "inside"]
STARTS: tuple[Start, ...] = ("line", "over", "under", "inside")
COUNT = len(SIGNS)
END = COUNT
"""The number of the end of a row, and of there being no script."""
LINE, PART, BELOW, ABOVE, SUB, SUP = range(6)
"""Tables: beside a sign in a line, in a fraction or root, in a subscript, in an exponent; as a sign's subscript, as its exponent."""
TABLES = 6

Counts = NDArray[np.int32]


def _kinds() -> NDArray[np.int64]:
    """The kind of each sign, and last that of the end: signs of a kind stand in like places."""
    families = (
        DIGITS, [sign for sign in LETTERS if len(sign) == 1 and sign.islower()],
        [sign for sign in LETTERS if len(sign) == 1 and sign.isupper()], [sign for sign in LETTERS if len(sign) > 1],
        OPERATORS, RELATIONS, OPENING, CLOSING, BARS, POINTS, FUNCTIONS, (PRIME,), (DEGREE,), (FRACTION,), (ROOT,), ACCENTS,
    )  # fmt: skip
    kinds = np.zeros(COUNT + 1, dtype=np.int64)
    for number, family in enumerate(families):
        for sign in family:
            kinds[NUMBER[sign]] = number
    kinds[END] = len(families)
    return kinds


KINDS = _kinds()
_IN_KIND = np.eye(int(KINDS.max()) + 1)[KINDS]
"""(signs + 1, kinds): 1 where the sign is of the kind."""
IS_LETTER = np.array([sign in LETTERS for sign in SIGNS])


@dataclass(frozen=True, slots=True)
class Smoothing:
    """What a chance is mixed from. Shares of one."""

    pair: float = 0.4
    """Of what followed just this sign."""
    kind: float = 0.45
    """Of what followed signs of its kind: which kind, and which sign of that kind is usual there."""
    table: float = 0.13
    """Of what stood there after anything. The rest is shared by all signs alike."""
    ends: float = 0.01
    """The share of any sign in whether anything follows."""


SMOOTHING = Smoothing()


@dataclass(frozen=True, slots=True, eq=False)
class Language:
    """follow (6, signs, signs + 1): P of what stands beside a sign, below or above it, the last column that nothing does;
    letters (6, signs): P of its being a letter; start (4, signs): P of a row's first sign; begun (4,): of its being a letter."""

    follow: FloatArray
    letters: FloatArray
    start: FloatArray
    begun: FloatArray


def counted(rows: Iterable[Row]) -> tuple[Counts, Counts]:
    """How often what follows what in the rows: (6, signs, signs + 1) and (4, signs)."""
    follow = np.zeros((TABLES, COUNT, COUNT + 1), dtype=np.int32)
    start = np.zeros((len(STARTS), COUNT), dtype=np.int32)

    def count(row: Row, table: int) -> None:
        for at, node in enumerate(row):
            number = NUMBER[node.name]
            follow[table, number, NUMBER[row[at + 1].name] if at + 1 < len(row) else END] += 1
            for script, first, inner in ((node.sub, SUB, BELOW), (node.sup, SUP, ABOVE)):
                follow[first, number, NUMBER[script[0].name] if script else END] += 1
                count(script, inner)
            for name, part in (("over", node.over), ("under", node.under), ("inside", node.inside)):
                if part:
                    start[STARTS.index(name), NUMBER[part[0].name]] += 1
                    count(part, PART)

    for row in rows:
        if row:
            start[0, NUMBER[row[0].name]] += 1
            count(row, LINE)
    return follow, start


def language(follow: Counts, start: Counts, rule: Smoothing = SMOOTHING) -> Language:
    """The counts as smoothed probabilities."""
    table = np.stack([_smoothed(each.astype(float), rule) for each in follow])
    first = start / np.maximum(start.sum(axis=1, keepdims=True), 1)
    likely = 0.9 * first + 0.1 / COUNT
    return Language(table, table[:, :, :-1] @ IS_LETTER, likely, likely @ IS_LETTER)


def _smoothed(counts: FloatArray, rule: Smoothing) -> FloatArray:
    """P of each column given the row, (signs, signs + 1): whether anything follows at all, and what if so."""
    kinds = _IN_KIND[:-1, :-1]
    ended, seen = counts[:, -1], counts.sum(axis=1)
    usual = ended.sum() / counts.sum()
    of_kind = (kinds.T @ ended + usual) / (kinds.T @ seen + 1)
    end = np.where(seen > 0, ended / np.maximum(seen, 1), of_kind[KINDS[:-1]])
    end = (1 - rule.ends) * (0.5 * end + 0.5 * of_kind[KINDS[:-1]]) + rule.ends * usual

    following = counts[:, :-1]
    after = _shares(kinds.T @ following @ kinds + 0.05)  # P(kind | kind)
    members = following.sum(axis=0) + 0.5
    within = members / (kinds @ (members @ kinds))  # P(sign | its kind)
    kind = after[KINDS[:-1]][:, KINDS[:-1]] * within
    pair = np.where(following.sum(axis=1, keepdims=True) > 0, _shares(following), kind)
    rest = 1 - rule.pair - rule.kind - rule.table
    mixed = rule.pair * pair + rule.kind * kind + rule.table * _shares(members) + rest / COUNT
    return np.concatenate([(1 - end[:, None]) * mixed, end[:, None]], axis=1)


def _shares(counts: FloatArray) -> FloatArray:
    return counts / np.maximum(counts.sum(axis=-1, keepdims=True), 1e-9)


def packed(follow: Counts, start: Counts) -> bytes:
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
