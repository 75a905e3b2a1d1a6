"""`python -m training.stack`: fits how much the hybrid hears the net and the geometry, on generated ink alone.

To be run again whenever either of the two has changed; it takes half a minute. The strokes stand alone, each on a page of its own: what a
stroke of a page is in the end (the side of a box, the bar of a fraction) is settled after the claims, alike for all. Lassos
are left out, since alone they are circles. The loss is the mean cross-entropy.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import track
from scipy.optimize import minimize
from scipy.special import log_softmax, softmax

from data_gen.strokes import generate
from recognizer.geometric.recognizer import Geometric
from recognizer.hybrid import WEIGHTS, Stack, completed, logged, scores_of
from recognizer.learned.recognizer import Learned
from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind

KINDS = len(STROKE_KINDS)


@dataclass(frozen=True, slots=True)
class StackRule:
    """Numbers of the fit."""

    seed: int = 61_001
    """Of the ink that is fitted to; the ink that is held out has the next one. No other suite uses them."""
    held_out: float = 0.4
    """Strokes that are held out, as a share of those fitted to."""
    most: float = 5.0
    """Weights lie between 0 and this: neither is heard against its word."""


RULE = StackRule()
MIX: Mapping[StrokeKind, float] = {kind: 1 / (KINDS - 1) for kind in STROKE_KINDS if kind != "lasso"}


@dataclass(frozen=True, slots=True, eq=False)
class Heard:
    """What both said of n strokes, (n, 9) each, and which kind each is, (n,)."""

    net: FloatArray
    geometry: FloatArray
    kind: NDArray[np.int64]


def fit(heard: Heard, rule: StackRule = RULE) -> Stack:
    """The weights that make the truth likeliest."""
    net, geometry = logged(heard.net), logged(completed(heard.geometry, heard.net))
    truth = np.eye(KINDS)[heard.kind]

    def loss(weights: FloatArray) -> tuple[float, FloatArray]:
        logits = weights[0] * net + weights[1] * geometry
        off = (softmax(logits, axis=1) - truth) / len(truth)
        value = -(truth * log_softmax(logits, axis=1)).sum() / len(truth)
        return float(value), np.array([(off * net).sum(), (off * geometry).sum()])

    start, bounds = np.array([1.0, 0.0]), [(0.0, rule.most)] * 2
    best: Any = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=bounds)
    return Stack(float(best.x[0]), float(best.x[1]))


def listen(strokes: int, seed: int, console: Console) -> Heard:
    """What both say of so many generated strokes."""
    rivals = Learned(), Geometric()
    drawn = generate(strokes, seed, mix=MIX)
    said: list[tuple[FloatArray, FloatArray]] = []
    for item in track(drawn, "Listening", console=console, transient=True):
        ink = Ink((item.stroke,))
        net, geometry = (scores_of(rival.recognize(ink)) for rival in rivals)
        said.append((net, geometry))
    net, geometry = (np.concatenate([row[which] for row in said]) for which in (0, 1))
    return Heard(net, geometry, np.array([STROKE_KINDS.index(item.kind) for item in drawn]))


def main(arguments: list[str] | None = None) -> int:
    """Listens, fits, reports on held-out ink and writes the weights."""
    options = _options(arguments)
    console = Console(stderr=True)
    begun = time.monotonic()
    heard = listen(options.strokes, options.seed, console)
    stack = fit(heard)
    held = listen(round(RULE.held_out * options.strokes), options.seed + 1, console)
    figures = {
        "geometric": _figures(held.geometry, held.kind),
        "learned": _figures(held.net, held.kind),
        "hybrid": _figures(stack.shares(held.net, held.geometry), held.kind),
    }
    document = {
        "command": f"python -m training.stack --strokes {options.strokes} --seed {options.seed}",
        "date": date.today().isoformat(),
        "held_out": {"strokes": len(held.kind), **figures},
        "net": round(stack.net, 4),
        "geometry": round(stack.geometry, 4),
    }
    options.out.write_text(json.dumps(document, indent=1) + "\n", "utf-8")
    for name, figure in figures.items():
        console.print(f"{name:10} {figure['right']:.2%} right, {figure['loss']:.4f} nats a stroke, held out")
    console.print(f"wrote {options.out} after {time.monotonic() - begun:.0f} s")
    return 0


def _figures(scores: FloatArray, kind: NDArray[np.int64]) -> dict[str, float]:
    loss = -float(logged(scores)[np.arange(len(kind)), kind].mean())
    return {"right": round(float((scores.argmax(axis=1) == kind).mean()), 5), "loss": round(loss, 5)}


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m training.stack",
        description="Fits how much the hybrid hears the net and the geometry, on generated ink.",
    )
    parser.add_argument("--strokes", type=int, default=4000, help="generated strokes, each alone on its page")
    parser.add_argument("--seed", type=int, default=RULE.seed)
    parser.add_argument(
        "--out", type=Path, default=WEIGHTS, help="the file to write (default: the shipped one)"
    )
    options = parser.parse_args(arguments)
    for name, least in (("strokes", 100), ("seed", 0)):
        if getattr(options, name) < least:
            parser.error(f"--{name} {getattr(options, name)}: it must be at least {least}")
    return options


if __name__ == "__main__":
    sys.exit(main())
