"""The notebook on disk: pages, their strokes as the pen made them, and the log of all that was done to them.

One SQLite file in write-ahead mode with full syncs: what `append` has returned from is on disk, whatever becomes of the
process or the machine. Strokes and log are only ever added to; a page that is thrown away is marked, and can be
fetched back. Several threads may use one store.
"""

from __future__ import annotations

import sqlite3
import threading
import time
import uuid
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sketch.ink import FloatArray, Stroke
from studio.limits import LIMITS, Refused

SCHEMA = """
create table if not exists pages (
    id text primary key, title text not null default '', words text not null default '',
    strokes integer not null default 0, created real not null, changed real not null, thrown real
);
create table if not exists strokes (
    page text not null references pages (id), name text not null,
    points blob not null, times blob, pressure blob, pointer text not null default '',
    primary key (page, name)
) without rowid;
create table if not exists log (
    page text not null references pages (id), seq integer not null, key text not null,
    entry text not null, at real not null,
    primary key (page, seq), unique (page, key)
) without rowid;
pragma user_version = 1;
"""
VERSION = 1


@dataclass(frozen=True, slots=True)
class Summary:
    """A page in the notebook. words: its formulas, to be searched; strokes: how many; created, changed: seconds
    since 1970."""

    id: str
    title: str
    words: str
    strokes: int
    created: float
    changed: float


@dataclass(frozen=True, slots=True)
class Entry:
    """One line of a page's log: key, by which whoever sent it twice did it once; text: an action, or undo, redo."""

    key: str
    text: str


@dataclass(frozen=True, slots=True)
class Penned:
    """A stroke under its name, and what it was drawn with: pen, touch, mouse or nothing that is known."""

    name: str
    stroke: Stroke
    pointer: str = ""


class Store:
    """A notebook file. Raises Refused for a file of a newer inklined, sqlite3.Error where the disk fails."""

    def __init__(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self._lock = threading.Lock()
        self._base = sqlite3.connect(path, check_same_thread=False, isolation_level=None, timeout=10)
        version: int = self._base.execute("pragma user_version").fetchone()[0]
        if version > VERSION:
            self._base.close()
            raise Refused(
                f"{path} is a notebook of a newer inklined (version {version}); update inklined to open it"
            )
        self._base.execute("pragma journal_mode = wal")
        self._base.execute("pragma synchronous = full")
        self._base.executescript(SCHEMA)

    def close(self) -> None:
        """Writes the log back into the file; the store is not to be used afterwards."""
        with self._lock:
            self._base.close()

    def create(self, title: str = "") -> str:
        """A new page's name. Raises Refused when the notebook is full."""
        name, now = uuid.uuid4().hex[:16], time.time()
        with self._lock:
            count: int = self._base.execute("select count(*) from pages where thrown is null").fetchone()[0]
            if count >= LIMITS.pages:
                raise Refused(
                    f"the notebook has {count} pages, which is the most it may have; throw some away"
                )
            self._base.execute(
                "insert into pages (id, title, created, changed) values (?, ?, ?, ?)", (name, title, now, now)
            )
        return name

    def pages(self, words: str = "", most: int = 500) -> list[Summary]:
        """The pages in whose name or formulas all these words stand, the last changed first."""
        asked = words.casefold().split()
        with (
            self._lock,
            closing(
                self._base.execute(
                    "select id, title, words, strokes, created, changed from pages where thrown is null order by changed desc"
                )
            ) as rows,
        ):
            found = (Summary(*row) for row in rows)
            kept = (
                one for one in found if all(word in f"{one.title} {one.words}".casefold() for word in asked)
            )
            return [one for one, _ in zip(kept, range(most), strict=False)]

    def page(self, name: str) -> Summary:
        """Raises Refused where the notebook has no such page."""
        with self._lock:
            row = self._base.execute(
                "select id, title, words, strokes, created, changed from pages where id = ? and thrown is null",
                (name,),
            ).fetchone()
        if row is None:
            raise Refused(f"there is no page {name[:40]!r} in this notebook")
        return Summary(*row)

    def throw(self, name: str) -> None:
        """Marks a page as thrown away."""
        self._mark(name, time.time())

    def fetch_back(self, name: str) -> None:
        """A page that was thrown away is there again."""
        self._mark(name, None)

    def _mark(self, name: str, thrown: float | None) -> None:
        with self._lock:
            marked = self._base.execute("update pages set thrown = ? where id = ?", (thrown, name)).rowcount
        if not marked:
            raise Refused(f"there is no page {name[:40]!r} in this notebook")

    def append(
        self,
        page: str,
        seq: int,
        entry: Entry,
        penned: Sequence[Penned],
        title: str,
        words: str,
        strokes: int,
    ) -> None:
        """Adds strokes and one entry to a page, all or nothing, and on disk when this returns."""
        now = time.time()
        rows = [
            (page, one.name, _bytes(one.stroke.points), _bytes(one.stroke.times), _bytes(one.stroke.pressure), one.pointer)
            for one in penned
        ]  # fmt: skip
        with self._lock:
            self._base.execute("begin immediate")
            try:
                self._base.executemany("insert into strokes values (?, ?, ?, ?, ?, ?)", rows)
                self._base.execute(
                    "insert into log values (?, ?, ?, ?, ?)", (page, seq, entry.key, entry.text, now)
                )
                self._base.execute(
                    "update pages set title = ?, words = ?, strokes = ?, changed = ? where id = ?",
                    (title, words, strokes, now, page),
                )
                self._base.execute("commit")
            except BaseException:
                self._base.execute("rollback")
                raise

    def log(self, page: str) -> list[Entry]:
        """All that was done to a page, in order."""
        with self._lock:
            rows = self._base.execute(
                "select key, entry from log where page = ? order by seq", (page,)
            ).fetchall()
        return [Entry(*row) for row in rows]

    def strokes(self, page: str) -> dict[str, Penned]:
        """Every stroke that a page has ever had, by name."""
        with self._lock:
            rows = self._base.execute(
                "select name, points, times, pressure, pointer from strokes where page = ?", (page,)
            ).fetchall()
        found: dict[str, Penned] = {}
        for name, points, times, pressure, pointer in rows:
            stroke = Stroke(_numbers(points).reshape(-1, 2), _maybe(times), _maybe(pressure))
            found[name] = Penned(name, stroke, pointer)
        return found


def _bytes(channel: FloatArray | None) -> bytes | None:
    return None if channel is None else channel.astype("<f8").tobytes()


def _numbers(blob: bytes) -> FloatArray:
    return np.frombuffer(blob, dtype="<f8").astype(np.float64)


def _maybe(blob: bytes | None) -> FloatArray | None:
    return None if blob is None else _numbers(blob)
