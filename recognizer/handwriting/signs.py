"""Which sign a group of strokes is: the net's opinion, and that of a simpler rival with the same face.

Both answer with logarithms of probabilities over `sketch.writing.signs.SIGNS` and, last, that the group is no sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib import resources
from typing import Protocol

import numpy as np
import onnxruntime

from recognizer.handwriting.line import Group, Line, looks_of
from sketch.ink import FloatArray
from sketch.writing.signs import SIGNS

COUNT = len(SIGNS)
BATCH = 256
"""Groups shown to the net at once."""


class SignReader(Protocol):
    """Who tells signs."""

    @property
    def name(self) -> str: ...

    def scores(self, line: Line, groups: Sequence[Group], alone: bool = False) -> FloatArray:
        """log P of each sign and of none, (groups, signs + 1). alone: there is nothing else on the page."""
        ...


class NetSigns:
    """The net as shipped."""

    name = "net"

    def __init__(self, model: bytes) -> None:
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = options.inter_op_num_threads = 1
        self._session = onnxruntime.InferenceSession(model, options, providers=["CPUExecutionProvider"])

    def scores(self, line: Line, groups: Sequence[Group], alone: bool = False) -> FloatArray:
        parts = [np.empty((0, COUNT + 1))]
        for start in range(0, len(groups), BATCH):
            shown = looks_of(line, groups[start : start + BATCH], alone)
            feeds = {"sequence": shown.sequence, "images": shown.images, "numbers": shown.numbers}
            parts.append(np.asarray(self._session.run(None, feeds)[0], dtype=np.float64))
        raw = np.concatenate(parts)
        return raw - np.logaddexp.reduce(raw, axis=1, keepdims=True)


@cache
def shipped() -> NetSigns:
    return NetSigns(resources.files("recognizer.handwriting").joinpath("weights/signs.onnx").read_bytes())
