"""What the studio has open: the notebook, the pages that somebody looks at, and whoever works for them."""

from __future__ import annotations

import asyncio
import logging
import secrets
from collections import OrderedDict
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

from physics.pipeline import move
from physics.verify.verdict import verify
from recognizer.interpret import interpret
from sketch.files import document, inkml
from sketch.formula.parse import expression
from sketch.ink import Ink, Stroke
from sketch.page import Association, Component, Sketch
from sketch.shapes import Circle, Polygon, Wire
from studio.actions import Open
from studio.limits import Refused
from studio.reading import GESTURES, READER, handwriting, rival
from studio.session import Listener, Session
from studio.store import Penned, Store

LOG = logging.getLogger("inklined.studio")
OPEN = 32
"""Pages that are kept in memory though nobody looks at them."""
WORKERS = 2
"""Threads for reading, correcting, simulating and judging: kernels run side by side, Python does not."""


class Desk:
    """Made once for a server; used in its event loop."""

    def __init__(self, notebook: Path) -> None:
        self.store = Store(notebook)
        self.work = ThreadPoolExecutor(WORKERS, "inklined-work")
        self.runs = ThreadPoolExecutor(WORKERS, "inklined-run")
        self.hand = ThreadPoolExecutor(1, "inklined-hand")
        self.ready = False
        self.connected: set[Listener] = set()
        self._open: OrderedDict[str, Session] = OrderedDict()
        self._opening = asyncio.Lock()

    async def session(self, page: str) -> Session:
        """The page, opened if it is not. Raises Refused where there is none."""
        async with self._opening:
            if page not in self._open:
                self._open[page] = await Session.opened(page, self.store, self.work, self.hand)
                idle = [name for name, one in self._open.items() if not one.listeners and name != page]
                for name in idle[: max(0, len(self._open) - OPEN)]:
                    del self._open[name]
            self._open.move_to_end(page)
            return self._open[page]

    async def new_page(self, sketch: Sketch | None = None, title: str = "") -> str:
        """A new page, empty or with what a file held; its name."""
        page = await asyncio.to_thread(self.store.create, title)
        if sketch is not None:
            names = [f"s{index}" for index in range(len(sketch.ink))]
            penned = [Penned(name, stroke) for name, stroke in zip(names, sketch.ink, strict=True)]
            session = await self.session(page)
            action = Open(tuple(names), document.dumps_meaning(sketch), title)
            await session.put(secrets.token_hex(8), action, penned)
        return page

    def throw(self, page: str) -> None:
        """Throws a page away; whoever looks at it keeps what is in memory."""
        self.store.throw(page)
        self._open.pop(page, None)

    async def warm(self) -> None:
        """Loads the recognizers and compiles the engine, so that nobody waits for it later."""
        try:
            await asyncio.get_running_loop().run_in_executor(self.runs, warm)
        except Exception:
            LOG.exception("the engine could not be made ready; it is made when it is first needed")
        self.ready = True
        for listener in tuple(self.connected):
            listener.tell({"type": "status", "ready": True})

    def close(self) -> None:
        """Ends the workers, then the notebook."""
        self.work.shutdown(wait=True, cancel_futures=True)
        self.runs.shutdown(wait=True, cancel_futures=True)
        self.hand.shutdown(wait=True, cancel_futures=True)
        self.store.close()


def opened(name: str, data: bytes) -> Sketch:
    """The page in a file that somebody sent, by its name. Raises FileError, Refused."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise Refused(f"{name} is not UTF-8 text; .inklined and .inkml files are opened") from None
    if name.casefold().endswith(".inkml"):
        return Sketch(inkml.loads(text, name))
    if name.casefold().endswith(".inklined"):
        return document.loads(text, name)
    raise Refused(f"{name} is of no kind that can be opened; .inklined and .inkml are")


def warm() -> None:
    """Reads, moves and judges a small page, so that everything is loaded and compiled."""
    ink = Ink((Stroke([[0, 0], [90, 2], [180, 0]]), Stroke([[0, 50], [40, 52], [90, 49]])))
    for name in (GESTURES, READER):
        interpret(ink, rival(name))
    handwriting(ink)
    block = Component(Polygon([[100, 300], [400, 300], [400, 100]]), (), "B", fixed=True)
    ball = Component(Circle((250, 120), 30), (), "A")
    bob = Component(Circle((20, 300), 15), (), "C")
    beam = Component(Polygon([[0, 80], [40, 80], [40, 100], [0, 100]]), (), "D", fixed=True)
    wire = Component(Wire((20, 100), (20, 285)), (), "E", ends=("D", "C"))
    said = replace(expression("m = 2"), at=(0.0, 0.0)), expression("a = 3")
    page = Sketch(
        Ink(), (block, ball, bob, beam, wire), said, (Association(0, "A", (250.0, 120.0)), Association(1, "A", (250.0, 120.0)))
    )  # fmt: skip
    motion = move(page, 0.5)
    _ = motion.trajectory.forces
    verify(motion.rectified)
