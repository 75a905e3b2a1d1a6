"""One page that is open: its history in memory and on disk, and the browsers that look at it.

Whatever changes the page happens under its lock, one after another, and is on disk before anybody is told that it was done.
"""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial
from typing import Any, Protocol, TypeVar

from physics.verify.verdict import verify
from sketch.ink import Stroke
from studio.actions import Action, Draw, Select, Write, dumps
from studio.board import Board, titled
from studio.gestures import understood, with_lines
from studio.history import REDO, UNDO, remembered
from studio.limits import LIMITS, Refused
from studio.live import Live, begun, live_json, read_on, reader_from
from studio.reading import GESTURES, HandReader, analyzed, reader, rival
from studio.store import Entry, Penned, Store
from studio.view import Json, Shown, shown, state, stroke_json, verdict_json

LOG = logging.getLogger("inklined.studio")
T = TypeVar("T")
LINE = 0.25
"""Seconds that Analyze waits for what is being read already: longer than a line takes, where nobody else is at it."""


class Listener(Protocol):
    """A browser that is told what becomes of a page; `tell` never waits."""

    def tell(self, message: Json) -> None: ...


class Session:
    """A page that is open. Made by `Session.opened`; used in one event loop."""

    def __init__(
        self,
        page: str,
        store: Store,
        work: Executor,
        hand: Executor,
        penned: dict[str, Penned],
        entries: list[Entry],
    ) -> None:
        self.page, self._store, self._work, self._hand = page, store, work, hand
        self._penned = penned
        self._keys = {entry.key for entry in entries}
        self._history = remembered([entry.text for entry in entries], self._stroke)
        self._shown = shown(self._history.board)
        self._lock = asyncio.Lock()
        self.listeners: set[Listener] = set()
        self._judging: asyncio.Task[None] | None = None
        self._verdicts: Json | None = None
        self._live: Live | None = None
        self._told_live: Json | None = None
        self._reading: asyncio.Task[None] | None = None
        self._unread = False

    @classmethod
    async def opened(cls, page: str, store: Store, work: Executor, hand: Executor) -> Session:
        """The page from the notebook; work: who does what browsers wait for; hand: who reads handwriting as it is
        written, which nobody waits for. Raises Refused where there is no such page."""

        def read() -> Session:
            store.page(page)
            return cls(page, store, work, hand, store.strokes(page), store.log(page))

        return await _in(work, read)

    @property
    def board(self) -> Board:
        """The page as it is."""
        return self._history.board

    @property
    def hand(self) -> HandReader | None:
        """A reader of handwriting that knows what has been read as it was written; None where nothing has."""
        return None if self._live is None else reader_from(self._live)

    @property
    def shown(self) -> Shown:
        """The page as it is seen."""
        return self._shown

    def greet(self, listener: Listener) -> None:
        """Tells a browser that has just come all of the page, and goes on telling it what changes."""
        self.listeners.add(listener)
        listener.tell({"type": "strokes", "strokes": self._strokes_json(self.board.names)})
        listener.tell(self.state())
        if self._verdicts is not None:
            listener.tell(self._verdicts)
        elif self._judging is None:
            self._judge()
        if self._told_live is not None:
            listener.tell(self._told_live)
        if self._live is None or self._unread:
            self._read_on()

    def leave(self, listener: Listener) -> None:
        """A browser has gone; where it was the last one, what was read while it wrote is let go."""
        self.listeners.discard(listener)
        if not self.listeners:
            self._live = self._told_live = None

    def state(self) -> Json:
        """All that a browser needs to know but for the points of strokes."""
        return state(self.page, self._history, self._shown)

    async def pen(self, key: str, stroke: Stroke, pointer: str, sender: Listener, as_ink: bool) -> Json:
        """A stroke: understood, carried out, and kept. as_ink: it draws, whatever it looks like. Returns the
        acknowledgement. Raises Refused."""
        async with self._lock:
            if key in self._keys:
                return self._ack(key, "drawn", "")
            if len(self._penned) >= 4 * LIMITS.strokes or len(self.board.names) >= LIMITS.strokes:
                raise Refused(
                    f"this page has {len(self.board.names)} strokes; at most {LIMITS.strokes} are kept, begin another"
                )
            before = self._history.board
            if as_ink:
                said, action, words = "drawn", Draw(key), ""
            else:
                sketch = self._shown.sketch
                found = await _in(
                    self._work, lambda: understood(before, sketch, key, stroke, rival(GESTURES))
                )
                said, action, words = found.said, found.action, found.words
            if isinstance(action, Select):
                action = with_lines(before, action)
            if action is None:
                return self._ack(key, said, words)
            await self._take(key, action, (Penned(key, stroke, pointer),))
            if isinstance(action, Draw) and not before.selected:
                self._shown = replace(self._shown, board=self.board)
                now = self.state()
                told = {name: now[name] for name in ("seq", "undo", "redo", "next", "loose", "name")}
                drawn = stroke_json(
                    key,
                    stroke.points.tolist(),
                    None if stroke.pressure is None else stroke.pressure.tolist(),
                    pointer,
                )
                self._tell(
                    {"type": "drawn", "id": key, **told},
                    {"type": "drawn", "id": key, **told, "stroke": drawn},
                    sender,
                )
                self._read_on()
            else:
                if isinstance(action, Draw):
                    self._tell({"type": "strokes", "strokes": self._strokes_json([key])})
                await self._changed(judge=not isinstance(action, Select | Draw))
            return self._ack(key, said, words)

    async def act(self, key: str, action: Action) -> Json:
        """An action that a browser asks for as it is."""
        async with self._lock:
            if key not in self._keys:
                if isinstance(action, Write):
                    action = replace(action, text=action.text.strip())
                    if not action.text:
                        raise Refused("a formula without a letter; type one, as m = 2 or F = m a")
                await self._take(key, action)
                await self._changed()
            return self._ack(key, "done", "")

    async def analyze(self, key: str, recognizer: str, anew: bool) -> Json:
        """Reads the page."""
        async with self._lock:
            if key not in self._keys:
                board = self.board
                if not board.names:
                    raise Refused("there is no ink on this page to be read; draw something first")
                if self._reading is not None:  # it is reading what is to be read here
                    await asyncio.wait({self._reading}, timeout=LINE)
                hand = self.hand
                action = await _in(self._work, lambda: analyzed(board, recognizer, anew, hand))
                await self._take(key, action)
                await self._changed()
            return self._ack(key, "done", self._counted())

    async def step(self, key: str, undo: bool) -> Json:
        """One action back, or forth again."""
        async with self._lock:
            if key not in self._keys:
                before = set(self.board.names)
                await self._take(key, UNDO if undo else REDO)
                fresh = [name for name in self.board.names if name not in before]
                if fresh:
                    self._tell({"type": "strokes", "strokes": self._strokes_json(fresh)})
                await self._changed()
            return self._ack(key, "done", "")

    async def put(self, key: str, action: Action, penned: Sequence[Penned]) -> None:
        """An action that brings strokes with it, as opening a file does."""
        async with self._lock:
            await self._take(key, action, penned)
            self._tell({"type": "strokes", "strokes": self._strokes_json([one.name for one in penned])})
            await self._changed()

    def _stroke(self, name: str) -> Stroke:
        return self._penned[name].stroke

    async def _take(self, key: str, entry: str | Action, penned: Sequence[Penned] = ()) -> None:
        """Foresees, writes to disk, and only then makes an entry."""
        self._penned.update({one.name: one for one in penned})
        try:
            board = await _in(self._work, lambda: self._history.foreseen(entry))
            text = entry if isinstance(entry, str) else dumps(entry)
            words = " ".join(line.text for line in board.sketch.expressions if line.text)
            await asyncio.to_thread(
                self._store.append, self.page, self._history.length, Entry(key, text), penned, titled(board), words, len(board.names)
            )  # fmt: skip
        except BaseException:
            for one in penned:
                self._penned.pop(one.name, None)
            raise
        self._history.take(entry, board)
        self._keys.add(key)

    async def _changed(self, judge: bool = True) -> None:
        board = self.board
        self._shown = await _in(self._work, lambda: shown(board))
        self._tell(self.state())
        self._read_on()
        if judge:
            self._judge()

    def _read_on(self) -> None:
        """Has what is being written read while nobody waits for it; strokes that come meanwhile are read after it,
        all at once."""
        self._unread = True
        if self._reading is None and self.listeners:
            self._reading = asyncio.create_task(self._reads())

    async def _reads(self) -> None:
        try:
            while self._unread:
                self._unread = False
                board, before = self.board, self._live
                self._live = await _in(self._hand, partial(_read_on, before, board))
                told = live_json(self._live)
                if told != self._told_live:
                    self._told_live = told
                    self._tell(told)
        except Exception:
            LOG.exception("what is written on page %s could not be read", self.page)
        finally:
            self._reading = None

    def _judge(self) -> None:
        """Has the answers on the page judged, and tells everybody, unless the page has changed by then."""
        if self._judging is not None:
            self._judging.cancel()
        self._verdicts = None
        what = self._shown
        if what.rectified is None or not what.board.sketch.associations:
            self._verdicts = {"type": "verdicts", "seq": self._history.length, "verdicts": []}
            self._tell(self._verdicts)
            return
        self._judging = asyncio.create_task(self._judged(what, self._history.length))

    async def _judged(self, what: Shown, seq: int) -> None:
        try:
            verdicts = await _in(self._work, lambda: verify(what.sketch))
        except Exception:
            LOG.exception("the answers of page %s could not be judged", self.page)
            return
        self._verdicts = {"type": "verdicts", "seq": seq, "verdicts": [verdict_json(one) for one in verdicts]}
        self._tell(self._verdicts)

    def _tell(self, message: Json, others: Json | None = None, sender: Listener | None = None) -> None:
        """Tells everybody; others: what all but the sender are told."""
        for listener in tuple(self.listeners):
            listener.tell(message if others is None or listener is sender else others)

    def _ack(self, key: str, said: str, words: str) -> Json:
        return {"type": "ack", "key": key, "said": said, "words": words, "seq": self._history.length}

    def _strokes_json(self, names: Sequence[str]) -> list[Json]:
        found = [self._penned[name] for name in names]
        return [
            stroke_json(one.name, one.stroke.points.tolist(), None if one.stroke.pressure is None else one.stroke.pressure.tolist(), one.pointer)
            for one in found
        ]  # fmt: skip

    def _counted(self) -> str:
        sketch = self.board.sketch
        parts, unread = len(sketch.components), sum(line.text is None for line in sketch.expressions)
        said = f"{parts} thing{'' if parts == 1 else 's'} found"
        return f"{said}, {unread} formula{'' if unread == 1 else 's'} to be typed." if unread else f"{said}."


def _read_on(before: Live | None, board: Board) -> Live:
    return read_on(before or begun(), board, reader())


async def _in(work: Executor, job: Callable[[], T]) -> T:
    """The result of a job that is done off the event loop."""
    return await asyncio.get_running_loop().run_in_executor(work, job)


def encoded(message: Json) -> str:
    """A message as JSON text."""
    return json.dumps(message, separators=(",", ":"), default=_plain)


def _plain(value: Any) -> Any:
    """numpy's numbers as Python's."""
    return value.item()
