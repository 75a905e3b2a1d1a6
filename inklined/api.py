"""The public functions: a page in, its meaning, its motion or a contest out."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from evaluation.stroke_contest import StrokeResult
    from physics.pipeline import Motion
    from physics.verify.verdict import Verdict
    from sketch.ink import Ink
    from sketch.page import Sketch

RECOGNIZER = "learned"
"""Who reads a page when nobody else is named."""


def analyze(page: Ink | str | PathLike[str], recognizer: str = RECOGNIZER) -> Sketch:
    """Reads a page of ink: which strokes are which components, their ideal shapes, what hangs on
    what, and its mathematics.

    page: ink, or a file (.inklined, .inkml, .jsonl, .jsonl.gz: its first row); typed mathematics of
    an .inklined file is kept and associated anew. recognizer: a name that `inklined recognizers` lists.
    Raises FileError for an unreadable file, ValueError for an unknown name.
    """
    from pathlib import Path

    from evaluation.rivals import rival as called
    from recognizer.interpret import interpret, notes_of
    from sketch.files.pages import open_page
    from sketch.ink import Ink

    reader = called(recognizer)
    if isinstance(page, Ink):
        return interpret(page, reader)
    opened = open_page(Path(page))
    return interpret(opened.ink, reader, notes_of(opened))


def move(sketch: Sketch, seconds: float = 2.0, rate: float = 60.0) -> Motion:
    """Corrects a page and sets it in motion: `rate` frames a second for `seconds` seconds."""
    from physics.pipeline import move as moved

    return moved(sketch, seconds, rate)


def judge(sketch: Sketch) -> tuple[Verdict, ...]:
    """Corrects a page and judges every answer on it by the engine: right, wrong or not determined, by how much, its
    dimensions, and the misconception that explains it. `physics.verify.asked` says what counts as an answer."""
    from physics.rectify import rectify
    from physics.verify.verdict import verify

    return verify(rectify(sketch).sketch)


def compare(
    files: Sequence[str | PathLike[str]] = (),
    recognizers: Sequence[str] = (),
    *,
    strokes: int = 1000,
    seed: int = 0,
) -> tuple[StrokeResult, ...]:
    """Scores recognizers (those of `recognizer.roster.ROSTER` when none is named) on labelled JSON Lines files, or on
    `strokes` generated strokes when there is no file. Raises FileError, ValueError as `analyze`."""
    from pathlib import Path

    from evaluation.stroke_contest import stroke_contest
    from evaluation.suites import generated_strokes, strokes_from_files
    from recognizer.roster import ROSTER

    suite = strokes_from_files([Path(file) for file in files]) if files else generated_strokes(strokes, seed)
    return stroke_contest(suite, recognizers or tuple(ROSTER))
