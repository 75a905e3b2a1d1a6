"""A suite's card: its name, version and hash, what it holds, and where it comes from; and suites by their cards.

The hash is of the rows' meaning (ink to the bit, label, writer, other keys), so that a suite has one hash whatever format it
is kept in. The card of a file stands beside it, `NAME.card.json`.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

from sketch.files import formats
from sketch.files.errors import FileError
from sketch.files.jsonl import Row
from sketch.files.store import read_text, write_text

LISTED = 200
"""Labels that a card counts by name; the others together."""


@dataclass(frozen=True, slots=True)
class Card:
    """kind: strokes (labelled rows), pages, problems or stress; rows, strokes, points: how many; writers: distinct names, 0
    where nobody is named; labels: rows by label, the most frequent first; source: where it comes from, a command for what
    is generated; licence: None where nobody said."""

    name: str
    version: str
    hash: str
    kind: str
    rows: int
    source: str
    strokes: int = 0
    points: int = 0
    writers: int = 0
    labels: dict[str, int] = field(default_factory=dict[str, int])
    licence: str | None = None
    remarks: tuple[str, ...] = ()


@dataclass(slots=True)
class Tally:
    """What a card tells of rows, counted as they pass."""

    rows: int = 0
    strokes: int = 0
    points: int = 0
    _writers: set[str] = field(default_factory=set[str])
    _labels: Counter[str] = field(default_factory=Counter[str])
    _hash: Any = field(default_factory=sha256)

    def passing(self, rows: Iterable[Row]) -> Iterator[Row]:
        """The rows as they are, each counted."""
        for row in rows:
            self.rows += 1
            self.strokes += len(row.ink)
            self.points += sum(map(len, row.ink))
            if row.writer is not None:
                self._writers.add(row.writer)
            if row.label is not None:
                self._labels[row.label] += 1
            self._hash.update(row_digest(row))
            yield row

    def card(
        self,
        name: str,
        version: str,
        source: str,
        kind: str = "strokes",
        licence: str | None = None,
        remarks: Iterable[str] = (),
    ) -> Card:
        """The card of all that has passed."""
        labels = dict(self._labels.most_common(LISTED))
        rest = sum(self._labels.values()) - sum(labels.values())
        return Card(
            name=name,
            version=version,
            hash=self._hash.hexdigest()[:16],
            kind=kind,
            rows=self.rows,
            source=source,
            strokes=self.strokes,
            points=self.points,
            writers=len(self._writers),
            labels={**labels, **({"…": rest} if rest else {})},
            licence=licence,
            remarks=tuple(remarks),
        )


def row_digest(row: Row) -> bytes:
    """Of everything that the row says."""
    hashed = sha256(json.dumps([row.label, row.writer, row.extra], sort_keys=True).encode())
    for stroke in row.ink:
        for channel in (stroke.points, stroke.times, stroke.pressure):
            hashed.update(b"-" if channel is None else len(stroke).to_bytes(8, "big") + channel.tobytes())
    return hashed.digest()


def rows_hash(rows: Iterable[Row]) -> str:
    """Of rows in their order: sixteen hexadecimal digits, the same as their card's."""
    tally = Tally()
    for _ in tally.passing(rows):
        pass
    return tally.card("", "", "").hash


def place_of(path: Path) -> Path:
    """Where the card of a file stands."""
    return path.with_name(f"{path.name}.card.json")


def save(path: Path, card: Card) -> None:
    """Writes the card beside the suite's file. Raises FileError where it cannot be written."""
    write_text(place_of(path), json.dumps(asdict(card), indent=1, ensure_ascii=False) + "\n")


def load(path: Path) -> Card:
    """The card of a suite's file; where none stands beside it, one made of what the file holds. Raises FileError."""
    place = place_of(path)
    if not place.is_file():
        tally = Tally()
        for _ in tally.passing(formats.read(path).rows):
            pass
        return tally.card(path.name, "none", str(path))
    try:
        said: dict[str, Any] = json.loads(read_text(place))
        return replace(Card(**said), remarks=tuple(said.get("remarks", ())))
    except (TypeError, ValueError, AttributeError) as error:
        raise FileError(place, f"is no card of a suite: {error}") from None


def is_true(path: Path, card: Card) -> bool:
    """Whether the file still holds what its card says. Raises FileError."""
    return rows_hash(formats.read(path).rows) == card.hash
