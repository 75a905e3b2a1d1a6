"""`hybrid`: geometry and the net heard together, each as far as it has deserved.

Stacked generalization (Wolpert 1992): the evidence for kind k is net · log p_k + geometry · log q_k + context · log (r_k / q_k), p
being what `learned` says, q what `geometric` says of the stroke alone, and r what it says of it on its page; a softmax makes
probabilities of it. The three weights are fitted to generated ink by `python -m training.stack` and kept in hybrid.json. They
are the same for all kinds: with weights and biases of its own for each kind the fit to generated ink was closer, and
people's ink was read worse than by the net alone (97.4 % of five kinds, not 98.4).
A lasso is told by what it encloses: where geometry finds none it says nothing of lassos, and the net is believed about them.
A stroke is rejected that the net rejects, unless geometry names the same kind.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.special import softmax

from recognizer.claims import Bonds, Claim, Recognizer
from recognizer.geometric.recognizer import Geometric, claim, weigh
from recognizer.learned.recognizer import Learned
from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind

WEIGHTS = Path(__file__).parent / "hybrid.json"
LASSO = STROKE_KINDS.index("lasso")
DOUBT = 1e-4
"""The least probability that is believed of either: nobody is that sure."""


@dataclass(frozen=True, slots=True)
class Stack:
    """How much each is heard."""

    net: float
    geometry: float
    context: float

    def shares(self, net: FloatArray, alone: FloatArray, page: FloatArray) -> FloatArray:
        """Probabilities (n, 9) from those of the net and of geometry without and with the page, (n, 9) each."""
        heard = self.net * logged(net) + self.geometry * logged(completed(alone, net))
        heard += self.context * (logged(page) - logged(alone))
        return np.asarray(softmax(heard, axis=1), dtype=np.float64)


def completed(geometry: FloatArray, net: FloatArray) -> FloatArray:
    """What geometry says, (n, 9), with the net's share of lassos where it finds no lasso itself; rows sum to 1."""
    others = np.arange(len(STROKE_KINDS)) != LASSO
    found = geometry.copy()
    silent = geometry.argmax(axis=1) != LASSO
    rest = geometry[silent][:, others]
    believed = net[silent, LASSO]
    found[np.ix_(silent, others)] = rest * ((1 - believed) / rest.sum(axis=1))[:, None]
    found[silent, LASSO] = believed
    return found


class StackError(ValueError):
    """A file of weights that cannot be used."""


def logged(scores: FloatArray) -> FloatArray:
    """Logarithms of scores, none below that of `DOUBT`."""
    return np.log(np.maximum(scores, DOUBT))


def load(path: Path = WEIGHTS) -> Stack:
    """The weights in a file that `training.stack` wrote. Raises StackError when it cannot be used."""
    try:
        told = json.loads(path.read_text("utf-8"))
        return Stack(float(told["net"]), float(told["geometry"]), float(told["context"]))
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise StackError(
            f"{path} is no file of stacking weights ({type(error).__name__}: {error}); `python -m training.stack` writes one"
        ) from None


class Hybrid:
    """The two, and how much each is heard."""

    name = "hybrid"
    claims: frozenset[StrokeKind] = frozenset(STROKE_KINDS)

    def __init__(self, stack: Stack | None = None) -> None:
        self._stack = load() if stack is None else stack
        self._net = Learned()
        self._geometry: Recognizer = Geometric()

    def recognize(self, ink: Ink) -> tuple[Claim, ...]:
        """One claim a stroke."""
        return self.read(ink)[0]

    def read(self, ink: Ink) -> tuple[tuple[Claim, ...], Bonds]:
        """One claim a stroke, and which strokes are one thing, which is the net's to say."""
        net, bonds = self._net.read(ink)
        if not len(ink):
            return (), bonds
        geometry = self._geometry.recognize(ink)
        shares = self._stack.shares(scores_of(net), scores_of(alone(ink)), scores_of(geometry))
        claims = tuple(
            Claim(row, first.rejected and first.kind != second.kind)
            for row, first, second in zip(shares, net, geometry, strict=True)
        )
        return claims, bonds


def alone(ink: Ink) -> tuple[Claim, ...]:
    """What geometry says of each stroke as if there were no other."""
    return tuple(claim(weigh(stroke)) for stroke in ink)


def scores_of(claims: tuple[Claim, ...]) -> FloatArray:
    """The claims' scores, (n, 9)."""
    return np.array([claim.scores for claim in claims]).reshape(-1, len(STROKE_KINDS))
