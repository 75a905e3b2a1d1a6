"""The contest made visible: how each recognizer reads the page, and how what it read would move."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recognizer.claims import Claim
from recognizer.roster import OURS
from sketch.page import STROKE_KINDS
from studio import motion as moving
from studio.actions import done
from studio.board import Board
from studio.reading import HandReader, analyzed, rival
from studio.view import shape_json

NOBODY = np.zeros((0, 1), dtype=np.float32)


def reading(
    board: Board, name: str, seconds: float, hand: HandReader | None = None
) -> tuple[dict[str, Any], NDArray[np.float32]]:
    """One recognizer's reading: what it claims of each stroke, the components that come of it, and its motion's frames
    (see `studio.motion`). hand: who reads handwriting, alike for all."""
    claims = rival(name).recognize(board.sketch.ink)
    read = done(board, analyzed(board, name, anew=True, hand=hand), lambda _: board.sketch.ink[0])
    head: dict[str, Any] = {
        "type": "reading",
        "name": name,
        "about": OURS[name].summary,
        "claims": [_claim(stroke, claim) for stroke, claim in zip(board.names, claims, strict=True)],
    }
    scene = moving.scene_of(replace(read, without=frozenset()))
    components = [
        {"label": part.label, "kind": part.kind, "fixed": part.fixed, "shape": shape_json(part.shape)}
        for part in scene.corrected.sketch.components
    ]
    head |= {"components": components, "lines": len(read.sketch.expressions)}
    if not components:
        return head | {"run": None, "rows": 0, "columns": 1}, NOBODY
    found = list(moving.pieces(scene, seconds, lambda: False))
    frames = [piece.frames for piece in found if isinstance(piece, moving.Piece)]
    events = list(chain.from_iterable(piece.events for piece in found if isinstance(piece, moving.Piece)))
    every = np.concatenate(frames) if frames else NOBODY
    run = moving.head(scene, 0, seconds)
    return head | {"run": run, "events": events, "rows": len(every), "columns": every.shape[1]}, every


def _claim(stroke: str, claim: Claim) -> dict[str, Any]:
    scores = {kind: round(float(score), 4) for kind, score in zip(STROKE_KINDS, claim.scores, strict=True)}
    return {
        "id": stroke,
        "kind": claim.kind,
        "confidence": round(claim.confidence, 4),
        "rejected": claim.rejected,
        "scores": scores,
    }
