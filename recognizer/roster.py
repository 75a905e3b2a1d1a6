"""The rivals that are ready as they come, by name; the published ones, which learn first, are in `published`. Each is imported when it is asked for, not before: one rival's weights or
libraries cost nothing to whoever runs another."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

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


def _hybrid() -> Recognizer:
    from recognizer.hybrid import Hybrid

    return Hybrid()


ROSTER: dict[str, Callable[[], Recognizer]] = {
    "paper": _paper,
    "geometric": _geometric,
    "learned": _learned,
    "hybrid": _hybrid,
}


@dataclass(frozen=True, slots=True)
class Ours:
    """What a rival of the roster is, in a line; whose; and how it comes to know ink."""

    summary: str
    source: str
    knows: str


OURS: dict[str, Ours] = {
    "paper": Ours("The published rules of a sketch-based physics tutor", "Cheema and LaViola", "no ink"),
    "geometric": Ours("Hand-made geometry, stroke by stroke and against the page", "inklined", "no ink"),
    "learned": Ours(
        "A small net on 64 points of a stroke and its page", "inklined", "generated ink; weights are shipped"
    ),
    "hybrid": Ours("The net and the geometry, stacked", "inklined", "generated ink; weights are shipped"),
}
assert OURS.keys() == ROSTER.keys()


def recognizer(name: str) -> Recognizer:
    """The rival of that name, ready to recognize.

    name: one of `ROSTER`, or anybody's own (outside/README.md): "run:COMMAND", a program; "onnx:FILE"; or "module:Class" (or
    "module:function"), importable from where Python runs and called without arguments. Raises ValueError that says what is wrong with the
    name or what the object lacks of the `Recognizer` protocol.
    """
    if name in ROSTER:
        return ROSTER[name]()
    way, _, what = name.partition(":")
    if way == "run":
        from recognizer.outside.process import program

        return program(what)
    if way == "onnx":
        from recognizer.outside.onnx_file import OnnxFile

        return OnnxFile(Path(what))
    if ":" in name:
        return _foreign(name)
    raise ValueError(
        f"no recognizer is called {name!r}; known are {', '.join(ROSTER)}, or module:Class for one of your own"
    )


def _foreign(name: str) -> Recognizer:
    """A recognizer that is not ours, found by "module:attribute" (the working directory counts)."""
    module_name, _, attribute = name.partition(":")
    if "" not in sys.path:
        sys.path.insert(0, "")
    try:
        module = importlib.import_module(module_name)
    except ImportError as error:
        raise ValueError(f"{name!r} cannot be imported: {error}") from None
    make = getattr(module, attribute, None)
    if not callable(make):
        raise ValueError(f"{module_name!r} has no class or function {attribute!r} that makes a recognizer")
    found: Any = make()
    for member in ("name", "claims", "recognize"):
        if not hasattr(found, member):
            raise ValueError(
                f"{name!r} has no {member!r}; a recognizer needs name, claims and recognize(ink)"
            )
    return found
