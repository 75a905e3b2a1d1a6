"""What tests and benchmarks of the studio share: a server of its own, a client that speaks its protocol, a browser with a pen."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import time
import urllib.request
from collections.abc import Generator, Iterable, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from websockets.sync.client import ClientConnection, connect

from data_gen.writers import sample_writer
from data_gen.writing.habits import habits
from data_gen.writing.typeset import written
from sketch.ink import Ink, Stroke
from sketch.writing.rows import row_of

ROOT = Path(__file__).parents[1]
PATIENCE = 180.0
"""Seconds for a server to come up, and for an answer: kernels may have to be compiled on a busy machine."""


@dataclass
class Served:
    """A studio in a process of its own."""

    folder: Path
    port: int
    process: subprocess.Popen[str]

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    def kill(self) -> None:
        """As a power cut would."""
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def start(folder: Path, port: int | None = None, warm: bool = False) -> Served:
    """A studio that listens, on a notebook in the folder."""
    port = port or free_port()
    program = (
        "import sys; from pathlib import Path; from studio.serve import Address, serve; "
        "serve(Address('127.0.0.1', int(sys.argv[1])), Path(sys.argv[2]), browser=False, warm=sys.argv[3] == 'warm')"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", program, str(port), str(folder), "warm" if warm else "cold"],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    until = time.monotonic() + PATIENCE
    while time.monotonic() < until and process.poll() is None:
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                return Served(folder, port, process)
        time.sleep(0.1)
    process.kill()
    raise AssertionError(f"the studio did not come up: {process.stdout.read() if process.stdout else ''}")


@contextmanager
def served(folder: Path, warm: bool = False) -> Generator[Served]:
    studio = start(folder, warm=warm)
    try:
        yield studio
    finally:
        studio.kill()


def ready(studio: Served, patience: float = 1200.0) -> None:
    """Waits until everything is loaded and compiled: on a fresh and busy machine that takes minutes."""
    until = time.monotonic() + patience
    while time.monotonic() < until:
        with urllib.request.urlopen(f"{studio.url}/api/status", timeout=PATIENCE) as answer:
            if json.loads(answer.read())["ready"]:
                return
        time.sleep(0.5)
    raise AssertionError(f"the studio was not ready within {patience:.0f} s")


@dataclass
class Client:
    """A browser without a screen: what it was told last of everything."""

    socket: ClientConnection
    prefix: str = "k"
    told: dict[str, Any] = field(default_factory=dict[str, Any])
    packed: list[tuple[dict[str, Any], NDArray[np.float32]]] = field(
        default_factory=list[tuple[dict[str, Any], NDArray[np.float32]]]
    )
    count: int = 0

    @property
    def state(self) -> dict[str, Any]:
        return self.told["state"]

    def send(self, **message: Any) -> None:
        self.socket.send(json.dumps(message))

    def hear(self, timeout: float = PATIENCE) -> dict[str, Any]:
        data = self.socket.recv(timeout)
        if isinstance(data, bytes):
            (length,) = struct.unpack("<I", data[:4])
            head = json.loads(data[4 : 4 + length])
            self.packed.append((head, np.frombuffer(data[4 + length :], dtype="<f4")))
            return head
        message = json.loads(data)
        self.told[message["type"]] = message
        return message

    def until(self, kind: str, timeout: float = PATIENCE) -> dict[str, Any]:
        """Hears until a message of that type; raises AssertionError for an error in its place."""
        limit = time.monotonic() + timeout
        while time.monotonic() < limit:
            message = self.hear(timeout)
            if message["type"] == kind:
                return message
            assert message["type"] != "error", message
        raise AssertionError(f"no {kind} came within {timeout} s")

    def ask(self, **message: Any) -> dict[str, Any]:
        """Sends with a key and hears until it is acknowledged; the state comes before that."""
        self.count += 1
        key = f"{self.prefix}{self.count}"
        self.send(**message, key=key)
        while True:
            heard = self.hear()
            if heard["type"] in ("ack", "error") and heard["key"] == key:
                return heard

    def do(self, **action: Any) -> dict[str, Any]:
        return self.ask(type="do", action=action)

    def draw(self, stroke: Stroke, ink: bool = False) -> dict[str, Any]:
        return self.ask(type="stroke", ink=ink, pointer="pen", **stroke_message(stroke))


def stroke_message(stroke: Stroke) -> dict[str, Any]:
    return {
        "points": stroke.points.tolist(),
        "times": None if stroke.times is None else stroke.times.tolist(),
        "pressure": None if stroke.pressure is None else stroke.pressure.tolist(),
    }


@contextmanager
def client(url: str, page: str, prefix: str = "k") -> Generator[Client]:
    """A client at a page that has been greeted."""
    with connect(f"{url.replace('http', 'ws')}/ws/{page}", max_size=None) as connection:
        made = Client(connection, prefix)
        made.until("state")
        yield made


def dense(path: Iterable[Sequence[float]], step: float = 4.0, start: float = 0.0) -> Stroke:
    """A stroke along corners, a point every few units and every 8 ms."""
    corners = np.array(list(path), dtype=float)
    pieces = [
        np.linspace(a, b, max(2, int(np.hypot(*(b - a)) / step)), endpoint=False)
        for a, b in pairwise(corners)
    ]
    points = np.concatenate([*pieces, corners[-1:]]) if pieces else corners
    return Stroke(points, start + 0.008 * np.arange(len(points)), np.full(len(points), 0.5))


def ring(x: float, y: float, radius: float, start: float = 0.0) -> Stroke:
    angle = np.linspace(-1.2, 2 * np.pi - 1.15, 60)
    return dense(np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)]), start=start)


def loop(ink: Ink, strokes: Iterable[int], margin: float = 16.0) -> Stroke:
    """A lasso about strokes of the ink."""
    points = ink.points_of(list(strokes))
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    middle, half = (low + high) / 2, (high - low) / 2 * 1.25
    angle = np.linspace(0.3, 2 * np.pi + 0.35, 90)
    wobble = 1 + 0.03 * np.sin(3 * angle)
    return dense(middle + np.column_stack([np.cos(angle), np.sin(angle)]) * half * wobble[:, None])


def zigzag(ink: Ink, strokes: Iterable[int], teeth: int = 9) -> Stroke:
    """A scribble over strokes of the ink."""
    points = ink.points_of(list(strokes))
    low, high = points.min(axis=0) - 4, points.max(axis=0) + 4
    xs = np.linspace(low[0], high[0], 2 * teeth)
    ys = np.where(np.arange(2 * teeth) % 2, low[1], high[1])
    return dense(np.column_stack([xs, ys]))


def dot(x: float, y: float) -> Stroke:
    return Stroke([[x, y], [x + 0.4, y + 0.3]], [0.0, 0.02], [0.5, 0.5])


def line_of(
    text: str, x: float, y: float, seed: int, height: float = 30.0, start: float = 10.0
) -> list[Stroke]:
    """A line of mathematics (signs apart, as "m = 2") as a generated writer writes it, its left top at (x, y), its
    letters some so many page units high."""
    rng = np.random.default_rng([7, seed])
    ink = written(row_of(text), habits(sample_writer(rng), rng)).ink
    points = ink.points_of(range(len(ink)))
    low, factor = points.min(axis=0), height / np.ptp(points[:, 1])
    moved: list[Stroke] = []
    for stroke in ink:
        times = start + 0.008 * np.arange(len(stroke))
        start = float(times[-1]) + 0.2
        moved.append(Stroke((stroke.points - low) * factor + [x, y], times, np.full(len(stroke), 0.5)))
    return moved


RAMP = [(150, 350), (450, 350), (450, 160), (150, 350)]


PICTURES = os.environ.get("INKLINED_PICTURES")
"""A folder to put pictures of what was seen in."""


def picture(page: Any, name: str) -> None:
    """Keeps a picture of a Playwright page, without what it says in passing, where pictures are wanted."""
    if PICTURES:
        page.evaluate("document.getElementById('toasts').replaceChildren()")
        page.screenshot(path=str(Path(PICTURES) / f"{name}.png"))


def chromium() -> str | None:
    """Debian's Chromium where there is one; None leaves it to Playwright's own."""
    for name in ("/usr/bin/chromium", "/usr/bin/chromium-browser"):
        if Path(name).exists():
            return name
    return None


class Pen:
    """A pen on a Playwright page, by the debugging protocol: its events have pressure and are a pen's."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self._session = page.context.new_cdp_session(page)

    def send(self, kind: str, x: float, y: float, pressure: float, buttons: int = 1) -> None:
        self._session.send(
            "Input.dispatchMouseEvent",
            {
                "type": kind, "x": x, "y": y, "button": "left" if kind != "mouseMoved" or buttons else "none",
                "buttons": buttons, "pointerType": "pen", "force": pressure, "clickCount": 1,
            },
        )  # fmt: skip

    def draw(self, stroke: Stroke, most: int = 28) -> None:
        """Draws a stroke given in page units."""
        chosen = np.unique(np.linspace(0, len(stroke) - 1, min(most, len(stroke))).astype(int))
        points = self.on_screen(stroke.points[chosen].tolist())
        pressure = [0.5] * len(points) if stroke.pressure is None else stroke.pressure[chosen].tolist()
        (x, y), first = points[0], max(0.1, pressure[0])
        self.send("mousePressed", x, y, first)
        for (x, y), force in zip(points[1:], pressure[1:], strict=True):
            self.send("mouseMoved", x, y, max(0.1, force))
        self.send("mouseReleased", x, y, 0.0, buttons=0)

    def on_screen(self, points: list[list[float]]) -> list[list[float]]:
        """Where page points are seen."""
        return self.page.evaluate(
            """points => {
                const camera = inklined.scene.camera, box = document.getElementById("paper").getBoundingClientRect();
                return points.map(([x, y]) => [(x - camera.x) * camera.scale + box.left, (y - camera.y) * camera.scale + box.top]);
            }""",
            points,
        )

    def settled(self) -> None:
        """Waits until the server has answered all that was sent."""
        self.page.wait_for_function("inklined.connection.outbox.size === 0", timeout=PATIENCE * 1000)


def plain(text: str) -> str:
    """Text without the invisible characters and breaks of mathematics."""
    return re.sub(r"\s+", " ", text.replace("\u2062", "").replace("\u2061", ""))
