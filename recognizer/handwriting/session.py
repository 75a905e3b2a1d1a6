"""Mathematics read while it is being written: a stroke more or less changes the reading of its own line only.

    session = Session()
    session = session.wrote({3: stroke})       # values in, values out: the old session stays as it was
    session = session.erased({1})
    session.lines[0].reading.latex

Lines and their signs have numbers that outlive edits: a line keeps its number as long as most of its
strokes stay, a sign as long as its strokes do, so that what was associated with them still is.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from recognizer.group import lines as lines_of
from recognizer.handwriting.kernels import WINDOW
from recognizer.handwriting.line import Group, Line, groups, line_of, spaced
from recognizer.handwriting.reader import NOTHING, Prior, Reader, Reading
from sketch.ink import FloatArray, Ink, Stroke

Strokes = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class KnownLine:
    """A line: its number, its strokes (their keys, in drawing order), what they say, and the number of every
    sign by its strokes."""

    number: int
    strokes: Strokes
    reading: Reading
    signs: Mapping[Strokes, int]


@dataclass(frozen=True, slots=True)
class Session:
    """A page of mathematics as read so far. Strokes are known by keys that the caller chooses, in drawing order."""

    reader: Reader = field(default_factory=Reader)
    prior: Prior | None = None
    strokes: Mapping[int, Stroke] = field(default_factory=dict[int, Stroke])
    lines: tuple[KnownLine, ...] = ()
    next_number: int = 0
    looked: Mapping[tuple[object, ...], FloatArray] = field(
        default_factory=dict[tuple[object, ...], FloatArray], repr=False
    )
    """What the net said of groups in their surroundings."""

    def wrote(self, strokes: Mapping[int, Stroke]) -> Session:
        """The session with more strokes. Raises KeyError for a key that is there already."""
        for key in strokes:
            if key in self.strokes:
                raise KeyError(f"stroke {key} is there already")
        return self._read({**self.strokes, **strokes})

    def erased(self, keys: Collection[int]) -> Session:
        """The session without some strokes. Raises KeyError for a key that is not there."""
        for key in keys:
            if key not in self.strokes:
                raise KeyError(f"there is no stroke {key}")
        return self._read({key: stroke for key, stroke in self.strokes.items() if key not in set(keys)})

    def holding(self, strokes: Mapping[int, Stroke]) -> Session:
        """The session of a page that holds just these strokes now: a line whose strokes are the same objects as
        before is not read again."""
        return self._read(strokes)

    def _read(self, strokes: Mapping[int, Stroke]) -> Session:
        keys = list(strokes)
        ink = Ink(tuple(strokes[key] for key in keys))
        found = [tuple(keys[k] for k in line) for line in lines_of(ink, range(len(keys)))]
        before = {line.strokes: line for line in self.lines}
        heirs = _heirs(found, self.lines)
        number = self.next_number
        looked: dict[tuple[object, ...], FloatArray] = {}
        lines: list[KnownLine] = []
        for at, line in enumerate(found):
            if line in before and all(self.strokes.get(key) is strokes[key] for key in line):
                lines.append(before[line])
                continue
            old = heirs.get(at)
            own = number if old is None else old.number
            number += old is None
            reading = self._line([strokes[key] for key in line], line, looked)
            signs: dict[Strokes, int] = {}
            for symbol in reading.symbols:
                held = tuple(line[k] for k in symbol.strokes)
                kept = None if old is None else old.signs.get(held)
                signs[held] = number if kept is None else kept
                number += kept is None
            lines.append(KnownLine(own, line, reading, signs))
        return Session(
            self.reader,
            self.prior,
            strokes,
            tuple(lines),
            number,
            {**self.looked, **looked} if len(self.looked) < 20_000 else looked,
        )

    def _line(
        self, strokes: list[Stroke], keys: Strokes, looked: dict[tuple[object, ...], FloatArray]
    ) -> Reading:
        """A line read; groups that were looked at in just these surroundings are not looked at again."""
        if not strokes or len(strokes) > self.reader.rule.strokes:
            return NOTHING
        line = line_of([spaced(stroke) for stroke in strokes])
        candidates = groups(line)
        names = _surroundings(line, candidates, keys)
        missing = [k for k, name in enumerate(names) if name not in self.looked]
        if missing:
            new = self.reader.signs.scores(line, [candidates[k] for k in missing])
            looked.update({names[k]: row for k, row in zip(missing, new, strict=True)})
        scores = np.array([looked[name] if name in looked else self.looked[name] for name in names])
        return self.reader.settled(line, candidates, scores, self.prior)


def _surroundings(line: Line, candidates: Sequence[Group], keys: Strokes) -> list[tuple[object, ...]]:
    """What the net's opinion of each group depends on: its strokes, those around it, the line's scale."""
    boxes = line.boxes
    sizes = np.array([len(group) for group in candidates])
    members = np.concatenate([np.array(group) for group in candidates])
    begins = np.cumsum(sizes) - sizes
    low = np.minimum.reduceat(boxes[members, :2], begins)
    high = np.maximum.reduceat(boxes[members, 2:], begins)
    middle = 0.5 * (low + high)
    reach = WINDOW * line.scale
    begun = np.all(boxes[None, :, :2] <= middle[:, None] + reach, axis=2)
    near = np.logical_and(begun, np.all(boxes[None, :, 2:] >= middle[:, None] - reach, axis=2))
    near[np.repeat(np.arange(len(candidates)), sizes), members] = False
    known = np.array(keys)
    return [
        (tuple(keys[k] for k in group), tuple(known[around].tolist()), line.scale)
        for group, around in zip(candidates, near, strict=True)
    ]


def _heirs(found: list[Strokes], before: tuple[KnownLine, ...]) -> dict[int, KnownLine]:
    """Which old line each new one goes on: that of which it holds the most strokes, each old line at most once."""
    shared = sorted(
        ((len(set(line) & set(old.strokes)), -at, old) for at, line in enumerate(found) for old in before),
        key=lambda entry: (-entry[0], -entry[1], entry[2].number),
    )
    heirs: dict[int, KnownLine] = {}
    taken: set[int] = set()
    for count, at, old in shared:
        if count and -at not in heirs and old.number not in taken:
            heirs[-at] = old
            taken.add(old.number)
    return heirs
