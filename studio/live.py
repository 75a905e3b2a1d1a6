"""Mathematics read while it is being written: what Analyze would make of each line, shown beside its ink at pen-up.

Nothing of this is the page's until somebody says so: *Analyze* takes the readings that are sure (and does not read a line
again that was read here), a tap on one takes it or another. A value: `read_on` gives the next one, in which only the
lines that have changed are read. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from physics.formula.expected import expected
from recognizer.claims import Bonds, Claim, Grouping
from recognizer.handwriting.roster import reader_of
from recognizer.handwriting.session import Session
from recognizer.interpret import interpret
from sketch.formula import mathml
from sketch.formula.parse import expression
from sketch.ink import FloatArray, Ink
from sketch.page import StrokeKind
from studio.board import Board
from studio.reading import HAND_READER, SURE, HandReader, Reading, as_typed


@dataclass(frozen=True, slots=True)
class LiveRule:
    """How much is read at a pen-up, and how near is near."""

    strokes: int = 240
    """Strokes that nobody has read beyond which the page waits for Analyze: what they are would take longer to say
    than it may take to show it."""
    near: float = 60.0
    """Page units from new ink within which a line that has been read may be gone on with: some two letters."""


RULE = LiveRule()


@dataclass(frozen=True, slots=True)
class LiveLine:
    """A line as it reads now. strokes: their names; line: the number of the page's line whose ink this is, None
    where the page has no such line yet."""

    strokes: tuple[str, ...]
    line: int | None
    reading: Reading

    @property
    def sure(self) -> bool:
        """Whether Analyze would take it."""
        return self.reading.confidence >= SURE


@dataclass(frozen=True, slots=True)
class Live:
    """What has been read so far of a page: the lines that are not the page's own yet, in reading order, and
    numbers, by which the session knows strokes that have names."""

    session: Session
    lines: tuple[LiveLine, ...] = ()
    numbers: Mapping[str, int] = field(default_factory=dict[str, int])


def begun() -> Live:
    """Of a page of which nothing has been read."""
    return Live(Session(reader_of("net"), expected))


def read_on(live: Live, board: Board, recognizer: Grouping) -> Live:
    """What is written on the board, where `live` was what was written before; recognizer: who tells mathematics."""
    writing = _writing(board, recognizer)
    numbers = dict(live.numbers)
    for place in writing:
        numbers.setdefault(board.names[place], len(numbers))
    session = live.session.holding({numbers[board.names[k]]: board.sketch.ink[k] for k in writing})
    names = {number: name for name, number in numbers.items()}
    place_of = {name: place for place, name in enumerate(board.names)}
    lines: list[LiveLine] = []
    for known in session.lines:
        strokes = tuple(names[number] for number in known.strokes)
        owner = _owner(board, [place_of[name] for name in strokes])
        said = as_typed(known.reading)
        if said is not None and not _stands(board, owner, [place_of[name] for name in strokes]):
            lines.append(LiveLine(strokes, owner, said))
    return Live(session, tuple(lines), numbers)


def reader_from(live: Live) -> HandReader:
    """A reader that knows what has been read while it was written, and reads the rest as ever."""
    numbers = {id(stroke): number for number, stroke in live.session.strokes.items()}
    known = {line.strokes: line.reading for line in live.session.lines}

    def reader(line: Ink) -> Reading | None:
        found = known.get(tuple(numbers.get(id(stroke), -1) for stroke in line.strokes))
        if found is None:
            return HAND_READER(line)
        said = as_typed(found)
        return said if said is not None and said.confidence >= SURE else None

    return reader


def live_json(live: Live) -> dict[str, Any]:
    """The message that tells browsers what is being written."""
    return {"type": "live", "lines": [_line_json(line) for line in live.lines]}


def _line_json(line: LiveLine) -> dict[str, Any]:
    said = line.reading
    return {
        "strokes": line.strokes,
        "line": line.line,
        "text": said.text,
        "mathml": mathml.shown(expression(said.text)),
        "sure": line.sure,
        "confidence": said.confidence,
        "alternatives": said.alternatives,
    }


def _writing(board: Board, recognizer: Grouping) -> list[int]:
    """The strokes, by their places, of lines that are being written: what would be mathematics if the page were
    read now, and of which a stroke at least looks like it by itself (a wire whose other end is still missing does not)."""
    open_ = _open(board)
    if not open_ or len(open_) > RULE.strokes:
        return []
    remembering = _Remembering(recognizer)
    found = interpret(Ink(tuple(board.sketch.ink[place] for place in open_)), remembering)
    looks: Sequence[StrokeKind | None] = [None if one.rejected else one.kind for one in remembering.said]
    owned = {place for line in board.sketch.expressions for place in line.strokes}
    return sorted(
        open_[stroke]
        for line in found.expressions
        if any(looks[one] == "math" or open_[one] in owned for one in line.strokes)
        for stroke in line.strokes
    )


def _open(board: Board) -> list[int]:
    """Ink that may be read now: all that nobody has read, and the ink of lines that stand near it."""
    kinds = board.sketch.kinds()
    loose = [place for place, kind in enumerate(kinds) if kind is None]
    unread = [place for line in board.sketch.expressions if line.text is None for place in line.strokes]
    new = sorted({*loose, *unread})
    if not new:
        return []
    fresh = np.array([_box(board, [place]) for place in new])
    beside = [
        place
        for line in board.sketch.expressions
        if line.text is not None and line.strokes and _near(_box(board, line.strokes), fresh)
        for place in line.strokes
    ]
    return sorted({*new, *beside})


def _box(board: Board, places: Sequence[int]) -> FloatArray:
    points = board.sketch.ink.points_of(places)
    return np.concatenate([points.min(axis=0), points.max(axis=0)])


def _near(box: FloatArray, others: FloatArray) -> bool:
    """Whether one of the others' boxes (n, 4) stands near a box."""
    apart = np.maximum(others[:, :2] - box[2:], box[:2] - others[:, 2:])
    return bool((apart.max(axis=1) <= RULE.near).any())


def _owner(board: Board, strokes: Sequence[int]) -> int | None:
    """The line of the page that holds the most of these strokes."""
    held = [len(set(strokes) & set(line.strokes)) for line in board.sketch.expressions]
    most = max(held, default=0)
    return held.index(most) if most else None


def _stands(board: Board, line: int | None, strokes: Sequence[int]) -> bool:
    """Whether that line has been read from just this ink."""
    if line is None:
        return False
    own = board.sketch.expressions[line]
    return own.text is not None and set(own.strokes) == set(strokes)


class _Remembering:
    """A recognizer, and what it said last."""

    def __init__(self, recognizer: Grouping) -> None:
        self._recognizer = recognizer
        self.said: tuple[Claim, ...] = ()

    @property
    def name(self) -> str:
        return self._recognizer.name

    @property
    def claims(self) -> frozenset[StrokeKind]:
        return self._recognizer.claims

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        return self.read(ink)[0]

    def read(self, ink: Ink) -> tuple[tuple[Claim, ...], Bonds]:
        self.said, bonds = self._recognizer.read(ink)
        return self.said, bonds
