"""Somebody who writes one expression: the letters in use and the chance of the moment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True)
class GrammarRule:
    """How often what is written. Shares of one unless told otherwise."""

    deepest: int = 3
    """Fractions, roots, brackets and functions within one another."""
    terms: tuple[float, ...] = (0.5, 0.32, 0.12, 0.06)
    """A sum of one, two, three, four terms."""
    factors: tuple[float, ...] = (0.62, 0.28, 0.1)
    """A product of one, two, three factors."""
    longest: int = 40
    """Signs of the longest expression of a mixture."""
    physics: float = 0.35
    """Share of physics in a mixture of both grammars."""


RULE = GrammarRule()
COMMON = list("xyabnzcdtkpruvmfieqsghwjlo") + list("APTVRESLMNCXGHBFIDJKQUWYZO")
GREEK = ["\\alpha", "\\beta", "\\theta", "\\pi", "\\mu", "\\gamma", "\\phi", "\\lambda", "\\sigma", "\\Delta", "\\omega",
          "\\rho", "\\delta", "\\epsilon", "\\tau", "\\eta", "\\Omega"]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Author:
    """Somebody who writes one expression: the chance of the moment and the letters in use."""

    rng: np.random.Generator
    pool: tuple[str, ...]

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def pick(self, among: Sequence[str], weights: Sequence[float] | None = None) -> str:
        if weights is None:
            return among[int(self.rng.integers(len(among)))]
        return among[int(np.searchsorted(np.cumsum(weights) / np.sum(weights), self.rng.random()))]

    def count(self, shares: Sequence[float]) -> int:
        return 1 + int(np.searchsorted(np.cumsum(shares), self.rng.random() * sum(shares)))

    def letter(self) -> str:
        return self.pick(self.pool)
