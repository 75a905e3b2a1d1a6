"""One browser at a page: its messages in, what becomes of the page and its runs out.

in    {"type": "stroke", "key", "points", "times", "pressure", "pointer", "ink"}    {"type": "do", "key", "action"}
      {"type": "analyze", "key", "recognizer", "anew"}    {"type": "undo", "key"}    {"type": "redo", "key"}
      {"type": "run", "run", "seconds"}    {"type": "stop"}    {"type": "observe", "run", "body", "quantity"}
      {"type": "contest", "seconds"}    {"type": "ping"}
out   status, strokes, state, drawn, live, ack, verdicts, run, end, error: JSON; piece, series, reading: binary (see
      `studio.motion.packed`)
"""

from __future__ import annotations

import asyncio
import json
import logging
import threading
from typing import Any, cast

import numpy as np
from starlette.websockets import WebSocket, WebSocketDisconnect

from physics.observables import ObservableError
from physics.pipeline import Motion
from physics.scene import SceneError
from recognizer.roster import ROSTER
from sketch.ink import InkError
from studio import motion as moving
from studio.actions import BY_HAND, from_json
from studio.asked import key_of, stroke_of, text_of
from studio.contest import reading
from studio.desk import Desk
from studio.limits import LIMITS, Refused
from studio.reading import READER
from studio.session import Session, encoded
from studio.view import Json

LOG = logging.getLogger("inklined.studio")
POINTERS = ("pen", "touch", "mouse")


class Link:
    """Reads and writes until either side is gone."""

    def __init__(self, socket: WebSocket, desk: Desk, session: Session) -> None:
        self._socket, self._desk, self._session = socket, desk, session
        self._out: asyncio.Queue[Json | bytes | None] = asyncio.Queue(LIMITS.waiting)
        self._slow = False
        self._stop = threading.Event()
        self._running: asyncio.Task[None] | None = None
        self._motion: tuple[int, Motion] | None = None

    def tell(self, message: Json | bytes) -> None:
        """Queues a message; a browser that does not read what it is sent is let go."""
        try:
            self._out.put_nowait(message)
        except asyncio.QueueFull:
            self._slow = True

    async def serve(self) -> None:
        """Until the browser goes."""
        writing = asyncio.create_task(self._write())
        self._desk.connected.add(self)
        self.tell({"type": "status", "ready": self._desk.ready})
        self._session.greet(self)
        try:
            while not self._slow:
                await self._read(await self._socket.receive())
        except WebSocketDisconnect:
            pass
        finally:
            self._session.leave(self)
            self._desk.connected.discard(self)
            self._halt()
            writing.cancel()

    async def _write(self) -> None:
        while True:
            message = await self._out.get()
            try:
                if isinstance(message, bytes):
                    await self._socket.send_bytes(message)
                else:
                    await self._socket.send_text(encoded(cast(Json, message)))
            except (WebSocketDisconnect, RuntimeError):
                return

    async def _read(self, received: Any) -> None:
        if received["type"] == "websocket.disconnect":
            raise WebSocketDisconnect(received.get("code", 1000))
        text = received.get("text")
        key: str | None = None
        try:
            if text is None:
                raise Refused("messages are JSON text; binary ones only ever come from the server")
            message = _parsed(text)
            given = message.get("key")
            key = given if isinstance(given, str) else None
            await self._carry_out(message)
        except (Refused, InkError, SceneError, ObservableError) as reason:
            self.tell({"type": "error", "key": None if key is None else key[:64], "message": str(reason)})
        except Exception as fault:
            LOG.exception("a message could not be carried out")
            said = f"a fault of inklined's own, {type(fault).__name__}; the page is as it was"
            self.tell({"type": "error", "key": None if key is None else key[:64], "message": said})

    async def _carry_out(self, message: Json) -> None:
        session = self._session
        match message.get("type"):
            case "stroke":
                pointer = message.get("pointer", "")
                self.tell(
                    await session.pen(
                        key_of(message), stroke_of(message), pointer if pointer in POINTERS else "", self, message.get("ink") is True
                    )
                )  # fmt: skip
            case "do":
                action = from_json(message.get("action"))
                if type(action).__name__.lower() not in BY_HAND:
                    raise Refused(f"{type(action).__name__.lower()} is not asked for by itself")
                self.tell(await session.act(key_of(message), action))
            case "analyze":
                name = text_of(message.get("recognizer", READER), "recognizer", 40)
                self.tell(await session.analyze(key_of(message), name, message.get("anew") is True))
            case "undo" | "redo" as way:
                self.tell(await session.step(key_of(message), way == "undo"))
            case "run":
                await self._run(_count(message.get("run")), _seconds(message.get("seconds", 10.0)))
            case "stop":
                self._halt()
            case "observe":
                await self._observe(message)
            case "contest":
                await self._contest(_seconds(message.get("seconds", 3.0)))
            case "ping":
                self.tell({"type": "pong"})
            case other:
                raise Refused(f"no message is of type {str(other)[:40]!r}")

    def _halt(self) -> None:
        self._stop.set()
        if self._running is not None:
            self._running.cancel()
            self._running = None

    async def _run(self, run: int, seconds: float) -> None:
        self._halt()
        self._stop = stop = threading.Event()
        board = self._session.board
        if not board.sketch.components:
            raise Refused("nothing on this page has been read that could move: Analyze first")
        self._motion = None
        self._running = asyncio.create_task(self._play(run, seconds, stop))

    async def _play(self, run: int, seconds: float, stop: threading.Event) -> None:
        loop, board = asyncio.get_running_loop(), self._session.board

        def say(message: Json | bytes) -> None:
            loop.call_soon_threadsafe(self.tell, message)

        def simulate() -> Motion | None:
            scene = moving.scene_of(board)
            say(moving.head(scene, run, seconds))
            for piece in moving.pieces(scene, seconds, stop.is_set):
                if isinstance(piece, moving.Piece):
                    rows, columns = piece.frames.shape
                    told = {
                        "type": "piece",
                        "run": run,
                        "rows": rows,
                        "columns": columns,
                        "events": piece.events,
                    }
                    say(moving.packed(told, piece.frames))
                else:
                    return moving.motion_of(scene, piece)
            return None

        try:
            motion = await loop.run_in_executor(self._desk.runs, simulate)
            if motion is None or stop.is_set():
                return
            self._motion = (run, motion)
            ended = await loop.run_in_executor(
                self._desk.runs,
                lambda: {"told": moving.told(motion), "observable": moving.observable(motion)},
            )
            until = float(motion.trajectory.times[-1])
            self.tell({"type": "end", "run": run, "seconds": until, "asked": seconds, **ended})
        except SceneError as reason:
            self.tell({"type": "error", "key": None, "run": run, "message": str(reason)})
        except Exception as fault:
            LOG.exception("a run failed")
            said = f"a fault of inklined's own, {type(fault).__name__}: this page could not be moved"
            self.tell({"type": "error", "key": None, "run": run, "message": said})

    async def _observe(self, message: Json) -> None:
        run, found = _count(message.get("run")), self._motion
        body = text_of(message.get("body"), "body", 20)
        quantity = text_of(message.get("quantity"), "quantity", 200)
        if found is None or found[0] != run:
            raise Refused("that run is over; run again to observe it")
        motion = found[1]
        series = await asyncio.get_running_loop().run_in_executor(
            self._desk.runs, lambda: moving.observed(motion, body, quantity)
        )
        told = {
            "type": "series", "run": run, "body": body, "quantity": quantity, "unit": series.unit,
            "vector": series.vector, "rows": len(series.times),
        }  # fmt: skip
        self.tell(moving.packed(told, series.values.astype(np.float32)))

    async def _contest(self, seconds: float) -> None:
        board = self._session.board
        if not board.names:
            raise Refused("there is no ink on this page that could be read")
        hand = self._session.hand
        for name in ROSTER:
            head, frames = await asyncio.get_running_loop().run_in_executor(
                self._desk.runs, reading, board, name, min(seconds, 10.0), hand
            )
            self.tell(moving.packed(head, frames))


def _parsed(text: str) -> Json:
    try:
        message: object = json.loads(text)
    except (ValueError, RecursionError):
        raise Refused("a message is a JSON object") from None
    if not isinstance(message, dict):
        raise Refused("a message is a JSON object")
    return cast(Json, message)


def _seconds(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.05 <= value <= LIMITS.seconds:
        raise Refused(f"seconds must be a number from 0.05 to {LIMITS.seconds:g}: no run is longer")
    return float(value)


def _count(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 1 << 31:
        raise Refused("run must be a whole number, the browser's own count of its runs")
    return value
