"""`learned`: a small net that has seen generated ink only, run by onnxruntime on one thread.

Differs from the other rivals in that nothing in it was set by hand for a kind: it knows what
`data_gen.families` drew. Each stroke is looked at in both drawing senses and the two answers are
averaged, so that the sense never matters.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import onnxruntime

from recognizer.claims import Claim
from recognizer.learned.features import (
    GLOBAL_FEATURES,
    PAGE_FEATURES,
    POINTS,
    SEQUENCE_CHANNELS,
    both_ways,
    page_features,
)
from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind

WEIGHTS = Path(__file__).parent / "weights" / "strokes.onnx"

CONTRACT = {
    "sequence": [len(SEQUENCE_CHANNELS), POINTS],
    "whole": [len(GLOBAL_FEATURES) + len(PAGE_FEATURES)],
}
"""Inputs of the ONNX file, float32, each with the batch in front; its output is "logits" (B, 9)."""

REJECT_BELOW = 0.35
"""Confidence below which the net would rather not say: a rejected stroke belongs to nobody, and on a page a
doubtful reading serves better than none."""

BATCH = 256
"""Strokes looked at together: bounds memory on pages of thousands of strokes (crossings need 64 × 64 each)."""


class WeightsError(ValueError):
    """An ONNX file that is missing or does not follow the contract of `training.export`."""


class Learned:
    """The learned recognizer. `weights`: another ONNX file of the same contract (see `inklined train`).

    Raises WeightsError when the file cannot be used.
    """

    name = "learned"
    claims: frozenset[StrokeKind] = frozenset(STROKE_KINDS)

    def __init__(self, weights: Path = WEIGHTS) -> None:
        self._session = _session(weights)

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """One claim per stroke; on a page, size and what a stroke encloses are looked at too."""
        page = page_features(ink)
        claims: list[Claim] = []
        for first in range(0, len(ink), BATCH):
            points = [stroke.points for stroke in ink.strokes[first : first + BATCH]]
            scores = self._scores(points, page[first : first + BATCH])
            claims += [Claim(row, bool(row.max() < REJECT_BELOW)) for row in scores]
        return tuple(claims)

    def _scores(self, points: list[FloatArray], page: FloatArray) -> FloatArray:
        """Calibrated probabilities, (B, 9)."""
        sequence, overall = both_ways(points)
        whole = np.concatenate([overall, np.concatenate([page, page])], axis=1)
        (logits,) = self._session.run(
            None, {"sequence": sequence.astype(np.float32), "whole": whole.astype(np.float32)}
        )
        both = np.asarray(logits, dtype=np.float64).reshape(2, len(points), len(STROKE_KINDS))
        mean = 0.5 * (both[0] + both[1])
        shares = np.exp(mean - mean.max(axis=1, keepdims=True))
        return shares / shares.sum(axis=1, keepdims=True)


@cache
def _session(weights: Path) -> Any:
    if not weights.is_file():
        raise WeightsError(
            f"no weights at {weights}; `inklined train` makes them (the train extra is needed)"
        )
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 1
    options.inter_op_num_threads = 1
    options.log_severity_level = 3
    try:
        session = onnxruntime.InferenceSession(str(weights), options, providers=["CPUExecutionProvider"])
        recipe = json.loads(session.get_modelmeta().custom_metadata_map.get("inklined", "{}"))
    except Exception as error:
        raise WeightsError(f"{weights} is not a usable ONNX file: {error}") from None
    if recipe.get("kinds") != list(STROKE_KINDS):
        raise WeightsError(
            f"{weights} answers for the kinds {recipe.get('kinds')}; needed are {list(STROKE_KINDS)}. "
            "Train it again with `inklined train`."
        )
    shapes = {entry.name: list(entry.shape[1:]) for entry in session.get_inputs()}
    if shapes != CONTRACT:
        raise WeightsError(
            f"{weights} takes {shapes}; this version gives {CONTRACT}. Train it again with `inklined train`."
        )
    return session
