"""How one sign lies to another: beside it, below it aslant, above it aslant, or not hung on it at all.

A small net looks at the two boxes in the line's scale, at which part of a line each sign takes up
(`sketch.writing.signs.extent`), and at the box before the one and after the other: whether `V p` is a product or V with a
subscript shows in what stands beside them. It also says whether boxes that lie so can be of such signs: a small s is no
capital. Frame: page units, y down.
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
FIT = NONE + 1
"""The number of the extents' fitting the boxes."""
OWN = 14
BESIDE = 6
MEASURES = OWN + 2 * (BESIDE + 1 + len(EXTENTS))
FEATURES = MEASURES + 2 * len(EXTENTS)
_EYE = np.eye(len(EXTENTS), dtype=np.float32)


@dataclass(frozen=True, slots=True)
class Place:
    """Where a sign, or a fraction or root as a whole, stands: its box and the height of its axis."""

    box: tuple[float, float, float, float]
    axis: float


def place(box: Sequence[float], axis: float | None = None) -> Place:
    left, top, right, bottom = (float(value) for value in box)
    return Place((left, top, right, bottom), 0.5 * (top + bottom) if axis is None else axis)


def in_order(places: Sequence[Place]) -> list[int]:
    """The order in which signs are read: that of their middles, since the hook of a j begins before the i on its left."""
    return sorted(range(len(places)), key=lambda k: places[k].box[0] + places[k].box[2])


def measures(
    places: Sequence[Place],
    extents: NDArray[np.int64],
    parents: NDArray[np.int64],
    children: NDArray[np.int64],
    scale: float,
) -> NDArray[np.float32]:
    """Numbers of pairs of places in the order of reading, (n, 50): the two boxes, and the boxes before the parent and after the
    child with their extents, in the line's scale. extents (places,): what each is taken for; parents, children (n,)."""
    every = np.array([[*one.box, one.axis] for one in places]).reshape(-1, 5) / scale
    p, c = every[parents], every[children]
    columns = [_pair(p, c)]
    for near, known, other in ((children + 1, c, p), (parents - 1, p, c)):
        there = (near >= 0) & (near < len(every))
        near = np.where(there, near, 0)
        columns.append(np.where(there[:, None], _beside(every[near], known, other), 0.0))
        columns.append(there[:, None].astype(np.float64))
        columns.append(np.where(there[:, None], _EYE[extents[near]], 0.0))
    return np.concatenate(columns, axis=1, dtype=np.float32)


def _pair(p: FloatArray, c: FloatArray) -> FloatArray:
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
    return np.clip(np.stack(columns, axis=1), -5, 5)


def _beside(near: FloatArray, known: FloatArray, other: FloatArray) -> FloatArray:
    """A third box against the one beside it and against the other."""
    gap = np.maximum(near[:, 0] - known[:, 2], known[:, 0] - near[:, 2])
    columns = [
        np.clip(gap, -2, 4),
        near[:, 4] - known[:, 4],
        near[:, 4] - other[:, 4],
        near[:, 3] - other[:, 3],
        near[:, 1] - other[:, 1],
        np.log(np.maximum(near[:, 3] - near[:, 1], 0.05)),
    ]
    return np.clip(np.stack(columns, axis=1), -5, 5)


def features(
    measured: NDArray[np.float32], parents: NDArray[np.int64], children: NDArray[np.int64]
) -> NDArray[np.float32]:
    """What the net is shown of pairs: measures (n, 50) and the numbers of their extents, (n,) each: (n, 72)."""
    return np.concatenate([measured, _EYE[parents], _EYE[children]], axis=1)


class Relations:
    """The net as shipped."""

    def __init__(self, model: bytes) -> None:
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = options.inter_op_num_threads = 1
        self._session = onnxruntime.InferenceSession(model, options, providers=["CPUExecutionProvider"])

    def scores(self, shown: NDArray[np.float32]) -> FloatArray:
        """Logarithms of the probabilities of right, sub, sup and none, and of the extents' fitting: (n, 5)."""
        if not len(shown):
            return np.empty((0, FIT + 1))
        return np.asarray(self._session.run(None, {"pairs": shown})[0], dtype=np.float64)


@cache
def shipped() -> Relations:
    return Relations(
        resources.files("recognizer.handwriting").joinpath("weights/relations.onnx").read_bytes()
    )
