"""How sure a reading is that all of it is right: a logistic curve over what the search says of itself.

Its four numbers are fitted to generated ink by writers of harder hands than usual (`training.handwriting`):
people's ink is never fitted to.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np


@dataclass(frozen=True, slots=True)
class Curve:
    """log-odds = constant + share · log-odds of the best reading's share + signs · Σ log p + worst · log least p."""

    constant: float
    share: float
    signs: float
    worst: float


@cache
def shipped() -> Curve:
    """The curve as fitted."""
    text = resources.files("recognizer.handwriting").joinpath("weights/confidence.json").read_text("utf-8")
    return Curve(**json.loads(text))


def measures(share: float, chances: Sequence[float]) -> tuple[float, float, float]:
    """Log-odds of the best reading's share of all, the sum of the signs' logarithms, the logarithm of the least."""
    bounded = float(np.clip(share, 1e-4, 1 - 1e-4))
    logs = np.log(np.clip(chances, 1e-4, 1.0)) if len(chances) else np.array([-9.0])
    return float(np.log(bounded / (1 - bounded))), float(logs.sum()), float(logs.min())


def believed(share: float, chances: Sequence[float], curve: Curve | None = None) -> float:
    """The chance that the whole reading is right, 0 to 1; share: of its weight among all readings; chances: of
    its signs, each by itself."""
    curve = curve or shipped()
    odds, total, least = measures(share, chances)
    value = curve.constant + curve.share * odds + curve.signs * total + curve.worst * least
    return float(1 / (1 + np.exp(-value)))
