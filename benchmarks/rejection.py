"""Which recognizers know what they do not know: strokes of no kind that are kept where 95 % of the kinds are.

    python benchmarks/rejection.py --strokes 2000 --recognizer geometric learned hbf49-forest --json rejection.json

Every rival gives a stroke a strangeness of its own scale; where 95 % of single generated strokes of the kinds are kept, so much
of what is none is kept too (false positives). Dots are left out: only their page tells them. What is none: doodles
(`data_gen.strokes.doodles`; the net has learnt from all families but a few), drawings of `evaluation.strangers` (which published
rivals are calibrated on, of another seed), and stray marks of cluttered pages that are no signs of mathematics.
`paper` has no rejection and takes no part; `hybrid` has the net's.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
import onnxruntime
from threadpoolctl import threadpool_limits

from data_gen.glyphs import alphabet
from data_gen.pen import draw
from data_gen.strokes import doodles, generate
from data_gen.writers import sample_writer
from evaluation.rivals import rival
from evaluation.strangers import FAMILIES, strangers
from recognizer.calibrated import Calibrated
from recognizer.geometric.recognizer import Geometric
from recognizer.learned.raw import feeds
from recognizer.learned.recognizer import WEIGHTS
from recognizer.published import PUBLISHED
from sketch.geometry import bounding_box
from sketch.ink import FloatArray, Ink

Strangeness = Callable[[Sequence[Ink]], FloatArray]
MARKS = (
    "delete",
    "five-point star",
    "loop word",
    "pigtail",
    "pitchfork",
    "spiral",
    "star cross",
    "step",
    "wave",
)
"""Marks of `data_gen.glyphs.alphabet` that are no kind: the others are brackets, carets, checks, arrows and notes."""
SIZE = (20.0, 60.0)
"""Of a stray mark, page units: one to three capital letters."""
KEPT = 0.95
"""Share of the kinds that is kept."""


def main() -> None:
    parser = argparse.ArgumentParser(description="False positives of rejection.")
    parser.add_argument("--strokes", type=int, default=2000, help="strokes of the kinds, and doodles")
    parser.add_argument("--seed", type=int, default=2026)
    names = ["geometric", "learned", *PUBLISHED]
    parser.add_argument("--recognizer", nargs="*", default=names, choices=names)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    kinds = kinds_of(options.strokes, options.seed)
    odd = odd_of(options.strokes, options.seed)
    with threadpool_limits(limits=1):
        figures = {name: measure(strangeness_of(name), kinds, odd) for name in options.recognizer}
    print(as_text(figures))
    if options.json:
        document = {"strokes": options.strokes, "seed": options.seed, "kept_at_95": figures}
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def kinds_of(count: int, seed: int) -> list[Ink]:
    """Single strokes of the kinds, dots left out."""
    return [Ink((item.stroke,)) for item in generate(count, seed) if item.kind != "tap"]


def odd_of(count: int, seed: int) -> dict[str, dict[str, list[Ink]]]:
    """Single strokes of no kind: source, family, drawings."""
    found: dict[str, dict[str, list[Ink]]] = {"doodles": {}, "strangers": {}, "marks": {}}
    for item in doodles(count, seed + 1):
        if len(item.strokes) == 1:
            found["doodles"].setdefault(item.form, []).append(Ink(item.strokes))
    for index, ink in enumerate(strangers(count // 2, seed + 2)):
        found["strangers"].setdefault(FAMILIES[index % len(FAMILIES)].__name__, []).append(ink)
    for index in range(count // 2):
        name = MARKS[index % len(MARKS)]
        found["marks"].setdefault(name, []).append(_mark(name, np.random.default_rng([seed + 3, index])))
    return found


def measure(
    strangeness: Strangeness, kinds: Sequence[Ink], odd: Mapping[str, Mapping[str, Sequence[Ink]]]
) -> dict[str, dict[str, float]]:
    """For each source the share of its drawings that is kept where `KEPT` of the kinds are, in all and by family."""
    limit = float(np.quantile(strangeness(kinds), KEPT))
    figures: dict[str, dict[str, float]] = {}
    for source, families in odd.items():
        kept = {name: strangeness(drawings) <= limit for name, drawings in families.items()}
        figures[source] = {
            "all": float(np.concatenate(list(kept.values())).mean()),
            **{name: float(share.mean()) for name, share in kept.items()},
        }
    return figures


def strangeness_of(name: str) -> Strangeness:
    """A rival's strangeness of drawings, one stroke each and seen alone."""
    if name == "geometric":
        return Geometric().strangeness
    if name == "learned":
        return _net()
    ready = rival(name)
    assert isinstance(ready, Calibrated)
    return ready.strangeness


def as_text(figures: Mapping[str, Mapping[str, Mapping[str, float]]]) -> str:
    """A column a rival, a row a source and a family, %."""
    names = list(figures)
    lines = [f"{'kept where 95 % of kinds are, %':32}" + "".join(f"{name:>16}" for name in names)]
    for source, families in figures[names[0]].items():
        for family in families:
            title = source if family == "all" else f"   {family}"
            lines.append(
                f"{title:32}" + "".join(f"{100 * figures[name][source][family]:16.0f}" for name in names)
            )
    return "\n".join(lines)


def _mark(name: str, rng: np.random.Generator) -> Ink:
    ways = alphabet.strokes(name, int(rng.integers(alphabet.variants(name))))
    path = max(ways, key=len)
    low, high = bounding_box(path)
    size = float(rng.uniform(*SIZE))
    placed = (path - low) * (size / max(float(np.max(high - low)), 1e-9)) + 300.0
    return Ink(tuple(draw([placed], sample_writer(rng), rng)))


def _net() -> Strangeness:
    session = onnxruntime.InferenceSession(str(WEIGHTS), providers=["CPUExecutionProvider"])

    def strangeness(drawings: Sequence[Ink]) -> FloatArray:
        odd = [np.asarray(session.run(["strange"], feeds(list(drawing)))[0]).max() for drawing in drawings]
        return np.array(odd, dtype=np.float64)

    return strangeness


if __name__ == "__main__":
    main()
