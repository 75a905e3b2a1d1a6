"""Soft comparisons: how far a measure is on the good side of a bound, as the logarithm of a belief."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log1p


@dataclass(frozen=True, slots=True)
class Bound:
    """A soft bound: half belief `at`, 73 % one `width` to the good side, 27 % one to the bad."""

    at: float
    width: float

    def below(self, value: float) -> float:
        """Logarithm of the belief that the value is small enough."""
        return _log_logistic((self.at - value) / self.width)

    def above(self, value: float) -> float:
        """Logarithm of the belief that the value is large enough."""
        return _log_logistic((value - self.at) / self.width)


def _log_logistic(value: float) -> float:
    """log(1 / (1 + e^−value)) without overflow."""
    return -log1p(exp(-value)) if value > 0 else value - log1p(exp(value))
