"""Temperature scaling (Guo et al. 2017): one number that makes confidence mean what it says."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.special import log_softmax


def temperature(logits: NDArray[np.float32], kind: NDArray[np.int64]) -> float:
    """The T > 0 that minimises the negative log likelihood of softmax(logits / T)."""

    def loss(log_t: float) -> float:
        scores = log_softmax(logits.astype(np.float64) / np.exp(log_t), axis=1)
        return float(-scores[np.arange(len(kind)), kind].mean())

    best: Any = minimize_scalar(loss, bounds=(-2.0, 2.0), method="bounded")
    return float(np.exp(best.x))
