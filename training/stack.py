"""`python -m training.stack`: fits how much the hybrid hears the net, the geometry and its context, on generated ink alone.

To be run again whenever either of the two has changed; it takes about a minute. Net and geometry are weighed on strokes that stand alone, each
on a page of its own, lassos and taps left out, since alone they are circles and lines; what the page adds is weighed on whole
pages, on arrows in two strokes and on taps, with the other two as they are. The loss is the mean cross-entropy.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from datetime import date
from math import cos, sin
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import track
from scipy.optimize import minimize
from scipy.special import log_softmax, softmax

from data_gen.ideals import arrow_head, line
from data_gen.pages import pages
from data_gen.pen import draw
from data_gen.strokes import generate
from data_gen.writers import sample_writer
from recognizer.geometric.recognizer import Geometric
from recognizer.hybrid import WEIGHTS, Stack, alone, completed, logged, scores_of
from recognizer.learned.recognizer import Learned
from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind

KINDS = len(STROKE_KINDS)
Drawn = tuple[Ink, Sequence[StrokeKind | None]]
"""A page, and what each of its strokes is; None for one that belongs to nobody."""


@dataclass(frozen=True, slots=True)
class StackRule:
    """Numbers of the fit."""

    seed: int = 61_001
    """Of the ink that is fitted to; the ink that is held out has the next one. No other suite uses them."""
    held_out: float = 0.4
    """Strokes that are held out, as a share of those fitted to."""
    arrows: int = 8
    """Arrows in two strokes for each page that is listened to;"""
    taps: int = 4
    """taps for each."""
    size: float = 150.0
    """Length of the arrows, page units."""
    most: float = 5.0
    """Weights lie between 0 and this: neither is heard against its word."""


RULE = StackRule()
SHAPES: tuple[StrokeKind, ...] = tuple(kind for kind in STROKE_KINDS if kind not in ("lasso", "tap"))
MIX: Mapping[StrokeKind, float] = {kind: 1 / len(SHAPES) for kind in SHAPES}
TAPS: Mapping[StrokeKind, float] = {"tap": 1.0}


@dataclass(frozen=True, slots=True, eq=False)
class Heard:
    """What both said of n strokes, geometry without and with the page, (n, 9) each, and which kind each is, (n,)."""

    net: FloatArray
    alone: FloatArray
    page: FloatArray
    kind: NDArray[np.int64]


def fit(strokes: Heard, on_pages: Heard) -> Stack:
    """The weights that make the truth likeliest: net and geometry of strokes alone, then context of those on pages."""
    net, geometry = _likeliest(strokes, _terms(strokes)[:2], 0.0)
    *known, context = _terms(on_pages)
    (added,) = _likeliest(on_pages, [context], net * known[0] + geometry * known[1])
    return Stack(net, geometry, added)


def _terms(heard: Heard) -> list[FloatArray]:
    """What the three weights multiply, (n, 9) each."""
    return [
        logged(heard.net),
        logged(completed(heard.alone, heard.net)),
        logged(heard.page) - logged(heard.alone),
    ]


def _likeliest(heard: Heard, terms: Sequence[FloatArray], offset: FloatArray | float) -> list[float]:
    """The weights of the terms, from 0 to `RULE.most`, that make the truth likeliest beside the offset."""
    truth = np.eye(KINDS)[heard.kind]

    def loss(weights: FloatArray) -> tuple[float, FloatArray]:
        logits = offset + sum(weight * term for weight, term in zip(weights, terms, strict=True))
        off = (softmax(logits, axis=1) - truth) / len(truth)
        value = -(truth * log_softmax(logits, axis=1)).sum() / len(truth)
        return float(value), np.array([(off * term).sum() for term in terms])

    start = np.full(len(terms), 0.5)
    best: Any = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=[(0.0, RULE.most)] * len(terms))
    return [float(weight) for weight in best.x]


def listen(drawn: Iterable[Drawn], count: int, console: Console) -> Heard:
    """What both say of the strokes of `count` pages, but for those that belong to nobody."""
    rivals = Learned().recognize, alone, Geometric().recognize
    said: list[list[FloatArray]] = []
    truth: list[int] = []
    for ink, kinds in track(drawn, "Listening", count, console=console, transient=True):
        known = [index for index, kind in enumerate(kinds) if kind is not None]
        said.append([scores_of(tell(ink))[known] for tell in rivals])
        truth += [STROKE_KINDS.index(kind) for kind in kinds if kind is not None]
    net, bare, page = (np.concatenate([rows[which] for rows in said]) for which in range(3))
    return Heard(net, bare, page, np.array(truth))


def _strokes(count: int, seed: int, mix: Mapping[StrokeKind, float] = MIX) -> Iterator[Drawn]:
    for item in generate(count, seed, mix=mix):
        yield Ink((item.stroke,)), [item.kind]


def _on_pages(count: int, seed: int) -> Iterator[Drawn]:
    """`count` pages, and for each of them some arrows in two strokes and a tap or two, each on a page of its own."""
    for drawn in pages(count, seed):
        yield drawn.truth.ink, drawn.truth.kinds()
    for index in range(RULE.arrows * count):
        yield _arrow_in_two(np.random.default_rng([seed, index])), ["arrow", "arrow"]
    yield from _strokes(RULE.taps * count, seed, TAPS)


def _arrow_in_two(rng: np.random.Generator) -> Ink:
    """A shaft and its head: barbs of a tenth to a half of the shaft, 15 to 50 degrees from it."""
    angle, share, opening = rng.uniform((0.0, 0.1, 0.26), (2 * np.pi, 0.5, 0.87)).tolist()
    start, tip = (0.0, 0.0), (RULE.size * cos(angle), RULE.size * sin(angle))
    head = arrow_head(start, tip, share * RULE.size, opening)
    return Ink(tuple(draw([line(start, tip), head], sample_writer(rng), rng)))


def main(arguments: list[str] | None = None) -> int:
    """Listens, fits, reports on held-out ink and writes the weights."""
    options = _options(arguments)
    console = Console(stderr=True)
    begun = time.monotonic()
    heard = _listened(options.strokes, options.pages, options.seed, console)
    stack = fit(**heard)
    share = RULE.held_out
    held_out = _listened(
        round(share * options.strokes), round(share * options.pages), options.seed + 1, console
    )
    figures = {
        place: {name: _figures(told, held.kind) for name, told in _scores(stack, held).items()}
        for place, held in held_out.items()
    }
    document = {
        "command": f"python -m training.stack --strokes {options.strokes} --pages {options.pages} --seed {options.seed}",
        "date": date.today().isoformat(),
        "held_out": figures,
        **{name: round(value, 4) for name, value in asdict(stack).items()},
    }
    options.out.write_text(json.dumps(document, indent=1) + "\n", "utf-8")
    for place, told in figures.items():
        for name in ("geometric", "learned", "hybrid"):
            figure = told[name]
            console.print(
                f"{place:8} {name:10} {figure['right']:.2%} right, {figure['loss']:.4f} nats a stroke"
            )
    console.print(f"wrote {options.out} after {time.monotonic() - begun:.0f} s")
    return 0


def _listened(strokes: int, page_count: int, seed: int, console: Console) -> dict[str, Heard]:
    every = (1 + RULE.arrows + RULE.taps) * page_count
    return {
        "strokes": listen(_strokes(strokes, seed), strokes, console),
        "on_pages": listen(_on_pages(page_count, seed), every, console),
    }


def _scores(stack: Stack, held: Heard) -> dict[str, FloatArray]:
    both = stack.shares(held.net, held.alone, held.page)
    return {"geometric": held.page, "learned": held.net, "hybrid": both}


def _figures(scores: FloatArray, kind: NDArray[np.int64]) -> dict[str, float]:
    """The share that is right, and the mean cross-entropy."""
    loss = -float(logged(scores)[np.arange(len(kind)), kind].mean())
    return {"right": round(float((scores.argmax(axis=1) == kind).mean()), 5), "loss": round(loss, 5)}


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m training.stack",
        description="Fits how much the hybrid hears the net and the geometry, on generated ink.",
    )
    parser.add_argument("--strokes", type=int, default=4000, help="generated strokes, each alone on its page")
    parser.add_argument("--pages", type=int, default=40, help="generated pages")
    parser.add_argument("--seed", type=int, default=RULE.seed)
    parser.add_argument(
        "--out", type=Path, default=WEIGHTS, help="the file to write (default: the shipped one)"
    )
    options = parser.parse_args(arguments)
    for name, least in (("strokes", 100), ("pages", 3), ("seed", 0)):
        if getattr(options, name) < least:
            parser.error(f"--{name} {getattr(options, name)}: it must be at least {least}")
    return options


if __name__ == "__main__":
    sys.exit(main())
