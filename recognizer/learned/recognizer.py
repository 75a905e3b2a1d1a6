"""`learned`: a small net that has seen generated ink only, run by onnxruntime on one thread.

Differs from the other rivals in that nothing in it was set by hand for a kind: it knows what `data_gen`
drew. The ONNX file takes the raw points of a whole page and answers for each stroke in the light of the
others: what it is, whether it is anything known, and which strokes are one thing.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from recognizer.claims import Bonds, Claim
from recognizer.learned.raw import feeds, windows
from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind

WEIGHTS = Path(__file__).parent / "weights" / "strokes.onnx"

INPUTS = {
    "points": (2, "double"),
    "times": (1, "double"),
    "stroke": (1, "int64"),
    "page": (1, "int64"),
    "timed": (1, "float"),
}
"""Inputs of the ONNX file: number of axes and type of each; README.md beside this file says what they hold."""

BOUND = 0.05
"""Pairs of strokes less likely than this to be one thing are not told."""


class WeightsError(ValueError):
    """An ONNX file that is missing or does not follow the contract of `training.export`."""


class Learned:
    """The learned recognizer. `weights`: another ONNX file of the same contract (see `inklined train`).

    Raises WeightsError when the file cannot be used.
    """

    name = "learned"
    claims: frozenset[StrokeKind] = frozenset(STROKE_KINDS)

    def __init__(self, weights: Path = WEIGHTS) -> None:
        self._session, self._reject = _session(weights)

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """One claim per stroke."""
        return self.read(ink)[0]

    def read(self, ink: Ink) -> tuple[tuple[Claim, ...], Bonds]:
        """One claim per stroke, and which strokes are one thing."""
        scores = np.empty((len(ink), len(STROKE_KINDS)))
        strange = np.empty(len(ink))
        pairs, bonds = [np.empty((0, 2), dtype=np.int64)], [np.empty(0)]
        for strokes, answered in windows(ink):
            order = np.argsort(strokes)
            kinds, odd, together = self._answers(ink, strokes[order])
            place = np.argsort(order)[:answered]
            scores[strokes[:answered]], strange[strokes[:answered]] = kinds[place], odd[place]
            first, second = np.nonzero(np.triu(together > BOUND, 1))
            bonds.append(together[first, second])
            pairs.append(np.stack([strokes[order][first], strokes[order][second]], axis=1))
        claims = tuple(
            Claim(row, odd > self._reject) for row, odd in zip(scores, strange.tolist(), strict=True)
        )
        return claims, _each_once(np.concatenate(pairs), np.concatenate(bonds))

    def _answers(self, ink: Ink, strokes: NDArray[np.int64]) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Kinds (s, 9), strange (s,) and together (s, s) of these strokes of the page."""
        kinds, odd, together = self._session.run(None, feeds([ink[index] for index in strokes.tolist()]))
        scores = np.asarray(kinds, dtype=np.float64)
        scores /= scores.sum(axis=1, keepdims=True)
        return scores, np.asarray(odd, dtype=np.float64), np.asarray(together, dtype=np.float64)


def _each_once(pairs: NDArray[np.int64], scores: FloatArray) -> Bonds:
    """Neighbouring windows may both speak of a pair: the surer one is heard."""
    order = np.lexsort((-scores, pairs[:, 1], pairs[:, 0]))
    pairs, scores = pairs[order], scores[order]
    fresh = np.ones(len(pairs), dtype=bool)
    fresh[1:] = (pairs[1:] != pairs[:-1]).any(axis=1)
    return Bonds(pairs[fresh], scores[fresh])


@cache
def _session(weights: Path) -> tuple[Any, float]:
    """The session, and the probability of being none of the kinds above which a stroke is rejected."""
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
    taken = {
        entry.name: (len(entry.shape), entry.type[len("tensor(") : -1]) for entry in session.get_inputs()
    }
    if taken != INPUTS:
        raise WeightsError(
            f"{weights} takes {taken}; this version gives {INPUTS}. Train it again with `inklined train`."
        )
    return session, float(recipe["reject_above"])
