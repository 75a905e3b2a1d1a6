"""A page as a file."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Literal, assert_never

from evaluation.pictures import animation
from physics.pipeline import Motion, move
from sketch import svg
from sketch.files import document, inkml
from sketch.page import Sketch
from studio.board import Board, titled
from studio.film import film
from studio.limits import Refused
from studio.view import Shown

Kind = Literal["inklined", "inkml", "svg", "gif", "mp4"]
MEDIA: dict[Kind, str] = {
    "inklined": "application/json",
    "inkml": "application/inkml+xml",
    "svg": "image/svg+xml",
    "gif": "image/gif",
    "mp4": "video/mp4",
}
THUMBNAIL = 240.0
"""Pixels wide."""


def exported(what: Shown, kind: Kind, seconds: float) -> bytes:
    """The page as the bytes of a file; seconds: of motion, for an animation. Raises Refused where nothing can move,
    SceneError where it cannot be simulated."""
    board = what.board
    match kind:
        case "inklined":
            return document.dumps(board.sketch).encode()
        case "inkml":
            return inkml.dumps(board.sketch.ink).encode()
        case "svg":
            return svg.draw(what.sketch, 960.0).encode()
        case "gif":
            return animation(_moved(board, seconds), seconds)
        case "mp4":
            return film(_moved(board, seconds), seconds)
        case _:
            assert_never(kind)


def _moved(board: Board, seconds: float) -> Motion:
    if not board.sketch.components:
        raise Refused("nothing on this page has been read that could move: Analyze first")
    return move(board.sketch, seconds, without=board.without)


def thumbnail(sketch: Sketch) -> str:
    """A small SVG of the page; of one that is read the clean shapes and the writing."""
    if not len(sketch.ink) and not sketch.components and not sketch.expressions:
        return '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 3" width="240" height="180"></svg>'
    return svg.draw(sketch, THUMBNAIL, look=replace(svg.LOOK, points=240.0))


def file_name(board: Board, kind: Kind) -> str:
    """A name that every file system takes."""
    plain = re.sub(r"[^A-Za-z0-9]+", "-", titled(board)).strip("-")[:60] or "page"
    return f"{plain}.{kind}"
