"""How one sign lies to another: beside it, below it aslant, above it aslant, or not hung on it at all.

A small net looks at the two boxes in the line's scale and at which part of a line each sign takes up
(`sketch.writing.signs.extent`). Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Literal

import numpy as np
import onnxruntime
from numpy.typing import NDArray

from sketch.ink import FloatArray
from sketch.writing.signs import EXTENTS

Relation = Literal["right", "sub", "sup"]
RELATIONS: tuple[Relation, ...] = ("right", "sub", "sup")
NONE = len(RELATIONS)
"""The number of no relation at all."""
MEASURES = 14
FEATURES = MEASURES + 2 * len(EXTENTS)


@dataclass(frozen=True, slots=True)
class Place:
    """Where a sign, or a fraction or root as a whole, stands: its box and the height of its axis."""

    box: tuple[float, float, float, float]
    axis: float


def place(box: Sequence[float], axis: float | None = None) -> Place:
    left, top, right, bottom = (float(value) for value in box)
    return Place((left, top, right, bottom), 0.5 * (top + bottom) if axis is None else axis)


def measures(parents: Sequence[Place], children: Sequence[Place], scale: float) -> NDArray[np.float32]:
    """Numbers of each pair's boxes, (n, 14), in the line's scale and in the parent's height."""
    p = np.array([[*one.box, one.axis] for one in parents]).reshape(-1, 5) / scale
    c = np.array([[*one.box, one.axis] for one in children]).reshape(-1, 5) / scale
    height_p, height_c = np.maximum(p[:, 3] - p[:, 1], 0.05), np.maximum(c[:, 3] - c[:, 1], 0.05)
    wide_p, wide_c = np.maximum(p[:, 2] - p[:, 0], 0.05), np.maximum(c[:, 2] - c[:, 0], 0.05)
    tall = np.maximum(height_p, 0.3)
    columns = [
        np.clip(c[:, 0] - p[:, 2], -2, 4),
        np.clip(c[:, 0] - p[:, 0], -2, 4),
        c[:, 4] - p[:, 4],
        c[:, 3] - p[:, 3],
        c[:, 1] - p[:, 1],
        c[:, 3] - p[:, 1],
        c[:, 1] - p[:, 3],
        np.log(height_p),
        np.log(height_c),
        np.log(wide_p),
        np.log(wide_c),
        np.log(height_c / height_p),
        (c[:, 4] - p[:, 4]) / tall,
        (c[:, 3] - p[:, 1]) / tall,
    ]
    return np.clip(np.stack(columns, axis=1), -5, 5).astype(np.float32)


def features(
    measured: NDArray[np.float32], parents: NDArray[np.int64], children: NDArray[np.int64]
) -> NDArray[np.float32]:
    """What the net is shown of pairs: measures (n, 14) and the numbers of their extents, (n,) each: (n, 36)."""
    eye = np.eye(len(EXTENTS), dtype=np.float32)
    return np.concatenate([measured, eye[parents], eye[children]], axis=1)


class Relations:
    """The net as shipped."""

    def __init__(self, model: bytes) -> None:
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = options.inter_op_num_threads = 1
        self._session = onnxruntime.InferenceSession(model, options, providers=["CPUExecutionProvider"])

    def scores(self, shown: NDArray[np.float32]) -> FloatArray:
        """Logarithms of the probabilities of right, sub, sup and none: (n, 4)."""
        if not len(shown):
            return np.empty((0, NONE + 1))
        return np.asarray(self._session.run(None, {"pairs": shown})[0], dtype=np.float64)


@cache
def shipped() -> Relations:
    return Relations(
        resources.files("recognizer.handwriting").joinpath("weights/relations.onnx").read_bytes()
    )
