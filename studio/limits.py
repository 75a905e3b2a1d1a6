"""How much one page, one message and one run may hold: each refused with a sentence when it is passed."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Limits:
    """Generous for people, narrow for whoever would fill the disk or the memory."""

    message: int = 1 << 20
    """Bytes of one websocket message: a stroke of a minute at 240 Hz has some 600 kB."""
    body: int = 20 << 20
    """Bytes of a file that is opened."""
    points: int = 20_000
    """Points in one stroke: 80 s at 240 Hz without lifting the pen."""
    coordinate: float = 1e6
    """Page units from the origin: 10 km."""
    strokes: int = 5_000
    """Strokes on one page: ten times a dense page of mathematics."""
    actions: int = 100_000
    """Actions in the life of one page, undone ones too."""
    pages: int = 10_000
    """Pages in a notebook."""
    seconds: float = 60.0
    """Simulated time of one run, s."""
    patience: float = 60.0
    """Seconds of computing after which a run is cut short where it has got to."""
    title: int = 200
    """Characters of a page's name."""
    formula: int = 1_000
    """Characters of a typed formula: what the parser takes."""
    lines: int = 500
    """Formulas on one page."""
    clients: int = 64
    """Browsers that may be connected at once."""
    waiting: int = 256
    """Messages that may wait to be sent to one browser before it is let go as too slow."""


LIMITS = Limits()


class Refused(ValueError):
    """A request that cannot be carried out: the message says what, where and what would be right."""
