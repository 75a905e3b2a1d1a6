"""A recognizer that is an ONNX file of somebody's own, following the contract of recognizer/learned/README.md.

Differs from `learned` in its name alone, the file's: the weights are all that it is.
"""

from __future__ import annotations

from pathlib import Path

from recognizer.learned.recognizer import Learned, WeightsError
from recognizer.outside.process import RecognizerError


class OnnxFile(Learned):
    """The recognizer in an ONNX file. Raises RecognizerError when the file cannot be used."""

    def __init__(self, weights: Path) -> None:
        try:
            super().__init__(weights)
        except WeightsError as error:
            raise RecognizerError(str(error)) from None
        self.name = weights.stem
