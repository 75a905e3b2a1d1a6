"""The rivals by name. Each is imported when it is asked for, not before: one rival's weights or
libraries cost nothing to whoever runs another."""

from __future__ import annotations

from collections.abc import Callable

from recognizer.claims import Recognizer


def _paper() -> Recognizer:
    from recognizer.paper import Paper

    return Paper()


def _geometric() -> Recognizer:
    from recognizer.geometric.recognizer import Geometric

    return Geometric()


def _learned() -> Recognizer:
    from recognizer.learned.recognizer import Learned

    return Learned()


ROSTER: dict[str, Callable[[], Recognizer]] = {
    "paper": _paper,
    "geometric": _geometric,
    "learned": _learned,
}


def recognizer(name: str) -> Recognizer:
    """The rival of that name, ready to recognize. Raises ValueError naming the known ones."""
    try:
        make = ROSTER[name]
    except KeyError:
        raise ValueError(f"no recognizer is called {name!r}; known are {', '.join(ROSTER)}") from None
    return make()
