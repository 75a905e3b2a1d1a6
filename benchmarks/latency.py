"""How long each recognizer takes for a stroke, side by side, on one thread, features and all.

    python benchmarks/latency.py --strokes 600 --json latency.json

Generated strokes of all kinds, one a page; the recognizers take turns over each stroke, so that
whatever else the machine does hits all of them alike.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from time import perf_counter

import numpy as np
from threadpoolctl import threadpool_limits

from data_gen.strokes import generate
from recognizer.roster import ROSTER, recognizer
from sketch.ink import Ink

WARM_UP = 30
"""Strokes that nobody times: caches, lazy imports, the first inference."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Milliseconds a stroke, on one thread.")
    parser.add_argument("--strokes", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--recognizer", nargs="*", default=list(ROSTER), choices=list(ROSTER))
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    pages = [Ink((item.stroke,)) for item in generate(options.strokes + WARM_UP, options.seed)]
    figures = measure(options.recognizer, pages)
    slowest = max(figure["p50"] for figure in figures.values())
    print(f"{'':12}{'p50 ms':>9}{'p95 ms':>9}{'faster':>9}")
    for name, figure in figures.items():
        print(f"{name:12}{figure['p50']:9.3f}{figure['p95']:9.3f}{slowest / figure['p50']:8.1f}x")
    if options.json:
        document = {"strokes": options.strokes, "seed": options.seed, "latency_ms": figures}
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def measure(names: list[str], pages: list[Ink]) -> dict[str, dict[str, float]]:
    """p50 and p95 in ms of each recognizer over the pages after the warm-up."""
    rivals = {name: recognizer(name) for name in names}
    spent: dict[str, list[float]] = {name: [] for name in names}
    with threadpool_limits(limits=1):
        for page in pages:
            for name, rival in rivals.items():
                begun = perf_counter()
                rival.recognize(page)
                spent[name].append(1000 * (perf_counter() - begun))
    return {
        name: {
            "p50": float(np.percentile(times[WARM_UP:], 50)),
            "p95": float(np.percentile(times[WARM_UP:], 95)),
        }
        for name, times in spent.items()
    }


if __name__ == "__main__":
    main()
