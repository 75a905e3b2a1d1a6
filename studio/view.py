"""A board as browsers are shown it: plain values for JSON, formulas as MathML, corrections with their reasons.

Frame: page units, y down.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, assert_never

from physics.build import build
from physics.rectify import Correction, Rectified, rectify
from physics.verify.verdict import Verdict
from sketch.formula import mathml
from sketch.page import Expression, Sketch
from sketch.shapes import Arrow, Circle, Polygon, Shape, Spring, Wire
from studio.board import Board, loose, titled
from studio.history import History

Json = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Shown:
    """rectified: the corrected page; notices: what the student should know."""

    board: Board
    rectified: Rectified | None
    notices: tuple[str, ...]

    @property
    def sketch(self) -> Sketch:
        """What the person sees."""
        return self.board.sketch if self.rectified is None else self.rectified.sketch


def shown(board: Board) -> Shown:
    """The board corrected, with what is to be said of it."""
    if not board.sketch.components:
        return Shown(board, None, ())
    corrected = rectify(board.sketch, board.without)
    built = build(corrected.sketch, corrected.meanings)
    return Shown(board, corrected, built.notices)


def state(page: str, history: History, what: Shown) -> Json:
    """All that a browser needs to know of a page, but for the points of its strokes."""
    board, sketch = what.board, what.sketch
    kinds = board.sketch.kinds()
    return {
        "type": "state",
        "page": page,
        "seq": history.length,
        "title": board.title,
        "name": titled(board),
        "strokes": [
            {"id": name, "dx": dx, "dy": dy, "kind": kind}
            for name, (dx, dy), kind in zip(board.names, board.offsets, kinds, strict=True)
        ],
        "loose": len(loose(board)),
        "analyzed": board.analyzed,
        "components": [
            {
                "label": part.label,
                "kind": part.kind,
                "fixed": part.fixed,
                "ends": part.ends,
                "drawn": shape_json(drawn.shape),
                "shape": shape_json(part.shape),
                "strokes": [board.names[stroke] for stroke in part.strokes],
            }
            for drawn, part in zip(board.sketch.components, sketch.components, strict=True)
        ],
        "lines": [_line(board, number, line) for number, line in enumerate(board.sketch.expressions)],
        "associations": [
            {"line": one.expression, "component": one.component, "anchor": one.anchor}
            for one in sketch.associations
        ],
        "corrections": corrections(what),
        "notices": list(what.notices),
        "selected": {
            "strokes": sorted(board.selected.strokes),
            "components": sorted(board.selected.components),
            "lines": sorted(board.selected.lines),
        },
        "undo": _spoken(history.undoable),
        "redo": _spoken(history.redoable),
        "next": next_stroke(board),
    }


def _line(board: Board, number: int, line: Expression) -> Json:
    return {
        "line": number,
        "text": line.text,
        "mathml": mathml.shown(line),
        "problem": line.problem,
        "at": line.at,
        "strokes": [board.names[stroke] for stroke in line.strokes],
        "confidence": line.confidence,
        "alternatives": line.alternatives,
    }


def shape_json(shape: Shape) -> Json:
    """A shape's kind and numbers."""
    match shape:
        case Circle(centre, radius):
            return {"kind": "circle", "centre": centre, "radius": radius}
        case Polygon():
            return {"kind": "polygon", "vertices": shape.vertices.tolist()}
        case Spring(start, end, coils, width):
            return {"kind": "spring", "start": start, "end": end, "coils": coils, "width": width}
        case Wire(start, end):
            return {"kind": "wire", "start": start, "end": end}
        case Arrow(start, end):
            return {"kind": "arrow", "start": start, "end": end}
        case _:
            assert_never(shape)


def corrections(what: Shown) -> list[Json]:
    """What was corrected, by key, the reasons in order; then what was left out because somebody said so."""
    if what.rectified is None:
        return []
    made: dict[tuple[str, str], list[Correction]] = {}
    for one in what.rectified.corrections:
        made.setdefault(one.key, []).append(one)
    return [
        {
            "rule": rule,
            "component": label,
            "made": True,
            "why": list(dict.fromkeys(one.why for one in ones)),
            "labels": sorted({one.component for one in ones}),
        }
        for (rule, label), ones in made.items()
    ] + [
        {
            "rule": rule,
            "component": label,
            "made": False,
            "why": [_WORDS[rule].format(label)],
            "labels": [label],
        }
        for rule, label in sorted(what.board.without)
    ]


_WORDS = {
    "C1": "{}: its sides were straightened.",
    "C2": "{}: it was moved into contact.",
    "C3": "{}: it was given the angle that the page says.",
    "C4": "{}: its ends were moved onto what they are tied to.",
    "C5": "{}: it was turned to the angle that the page says.",
}
_VERBS = {
    "draw": "the last stroke", "read": "Analyze", "erase": "erasing", "select": "the selection", "move": "moving",
    "fix": "fixing or freeing", "associate": "the association", "dissociate": "letting go", "write": "the formula",
    "leave": "leaving a correction out", "correct": "the correction", "title": "the name", "open": "opening",
}  # fmt: skip


def _spoken(entry: str | None) -> str | None:
    """What undo or redo would change, in words."""
    return None if entry is None else _VERBS[json.loads(entry)["do"]]


def next_stroke(board: Board) -> str:
    """What the next stroke will do, in words."""
    chosen = board.selected
    if chosen.lines:
        what = ", ".join(
            board.sketch.expressions[line].text or "a formula nobody has read"
            for line in sorted(chosen.lines)
        )
        return f"{what}: tap a shape, wire or spring that it is said of. Drag inside the frame to move it; tap elsewhere to let go."
    if chosen:
        return "Drag inside the frame to move what is selected; tap elsewhere to let go."
    if not board.names and not board.sketch.expressions:
        return "The next stroke draws. Draw balls, boxes, ramps, springs and wires; write formulas beside them; then Analyze."
    if not board.sketch.components:
        return "The next stroke draws. When the drawing is done: Analyze."
    if loose(board):
        return "The next stroke draws. There is new ink: Analyze reads it. Circle to select, scribble to erase, tap a shape to fix or free it."
    return "The next stroke draws. Circle to select, scribble to erase, tap a shape to fix or free it."


def verdict_json(verdict: Verdict) -> Json:
    """A verdict's number, its error and its dimensions."""
    return {
        "line": verdict.expression,
        "component": verdict.component,
        "text": verdict.text,
        "status": verdict.status,
        "given": verdict.given,
        "true": verdict.true,
        "unit": verdict.unit,
        "error": verdict.error,
        "misconception": verdict.misconception,
        "dimensions": None if verdict.finding is None else verdict.finding.message,
        "converted": verdict.converted,
        "message": verdict.message,
    }


def stroke_json(
    name: str, points: Sequence[Sequence[float]], pressure: Sequence[float] | None, pointer: str
) -> Json:
    """A raw stroke, as far as it is to be drawn."""
    return {"id": name, "points": points, "pressure": pressure, "pointer": pointer}
