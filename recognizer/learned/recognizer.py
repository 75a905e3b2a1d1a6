"""`learned`: a small net that has seen generated ink only, run by onnxruntime on one thread.

Differs from the other rivals in that nothing in it was set by hand for a kind: it knows what `data_gen`
drew. The ONNX file takes the raw points of a whole page and answers for each stroke in the light of the
others: what it is, whether it is anything known, and which strokes are one thing.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from recognizer.claims import Bonds, Claim
from recognizer.learned.raw import WINDOW, feeds, windows
from sketch.ink import FloatArray, Ink, Stroke
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


_NOBODY = np.empty(0, dtype=np.int64)


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
        if 0 < len(ink) <= WINDOW.most:
            scores, strange, together = self._answers(ink.strokes)
            first, second = np.nonzero(together > BOUND) if len(ink) > 1 else (_NOBODY, _NOBODY)
            ordered = first < second
            pairs = np.stack([first[ordered], second[ordered]], axis=1)
            return self._claims(scores, strange), Bonds(pairs, together[pairs[:, 0], pairs[:, 1]])
        return self._by_windows(ink)

    def _by_windows(self, ink: Ink) -> tuple[tuple[Claim, ...], Bonds]:
        """The same of a page that is too large to be read at once, or empty."""
        scores = np.empty((len(ink), len(STROKE_KINDS)))
        strange = np.empty(len(ink))
        pairs, bonds = [np.empty((0, 2), dtype=np.int64)], [np.empty(0)]
        for strokes, answered in windows(ink):
            order = np.argsort(strokes)
            kinds, odd, together = self._answers([ink[index] for index in strokes[order].tolist()])
            place = np.argsort(order)[:answered]
            scores[strokes[:answered]], strange[strokes[:answered]] = kinds[place], odd[place]
            first, second = np.nonzero(np.triu(together > BOUND, 1))
            bonds.append(together[first, second])
            pairs.append(np.stack([strokes[order][first], strokes[order][second]], axis=1))
        return self._claims(scores, strange), _each_once(np.concatenate(pairs), np.concatenate(bonds))

    def _claims(self, scores: FloatArray, strange: FloatArray) -> tuple[Claim, ...]:
        return tuple(
            Claim.trusted(row, odd > self._reject) for row, odd in zip(scores, strange.tolist(), strict=True)
        )

    def _answers(self, strokes: Sequence[Stroke]) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Kinds (s, 9), strange (s,) and together (s, s) of these strokes of a page, in drawing order."""
        kinds, odd, together = self._session.run(None, feeds(strokes))
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
    # Plans of memory pay where shapes come again: strokes have any number of points.
    options.enable_mem_pattern = False
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
