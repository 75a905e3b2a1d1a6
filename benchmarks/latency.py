"""How long each recognizer takes for a stroke, side by side, on one thread, features and all.

    python benchmarks/latency.py --strokes 600 --pages 40 --json latency.json

Generated strokes of all kinds, one a page; the recognizers take turns over each stroke, so that
whatever else the machine does hits all of them alike. Beside the time on the clock stands the CPU's:
where the two differ much, the machine was busy with something else. Then pages of 60 strokes: whole generated pages, set
side by side until there are so many.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path
from time import perf_counter, thread_time

import numpy as np
from threadpoolctl import threadpool_limits

from data_gen.pages import pages as whole
from data_gen.strokes import generate
from recognizer.roster import ROSTER, recognizer
from sketch.ink import Ink, Stroke

WARM_UP = 30
"""Strokes that nobody times: caches, lazy imports, the first inference."""
FULL = 60
"""Strokes of a full page."""
WIDTH = 700.0
"""Page units from one page to the next beside it."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Milliseconds a stroke, on one thread.")
    parser.add_argument("--strokes", type=int, default=600)
    parser.add_argument("--pages", type=int, default=40, help="pages of 60 strokes, after three to warm up")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--recognizer", nargs="*", default=list(ROSTER), choices=list(ROSTER))
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    pages = [Ink((item.stroke,)) for item in generate(options.strokes + WARM_UP, options.seed)]
    figures = measure(options.recognizer, pages, WARM_UP)
    full = measure(options.recognizer, full_pages(options.pages + 3, options.seed), 3)
    slowest = max(figure["p50"] for figure in figures.values())
    print(f"{'a stroke':12}{'p50 ms':>9}{'p95 ms':>9}{'CPU p50':>9}{'CPU p95':>9}{'faster':>9}")
    for name, figure in figures.items():
        columns = "".join(f"{figure[key]:9.3f}" for key in ("p50", "p95", "cpu_p50", "cpu_p95"))
        print(f"{name:12}{columns}{slowest / figure['p50']:8.1f}x")
    print(f"a page of {FULL} strokes")
    for name, figure in full.items():
        print(f"{name:12}" + "".join(f"{figure[key]:9.1f}" for key in ("p50", "p95", "cpu_p50", "cpu_p95")))
    if options.json:
        document = {"strokes": options.strokes, "pages": options.pages, "seed": options.seed}
        document |= {"latency_ms": figures, "page_ms": full}
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def full_pages(count: int, seed: int) -> list[Ink]:
    """Pages of `FULL` strokes, each of whole pages side by side, the last one cut off."""
    drawn = whole(20 * count, seed)
    found: list[Ink] = []
    for _ in range(count):
        strokes: list[Stroke] = []
        right = 0.0
        while len(strokes) < FULL:
            page = next(drawn).truth.ink
            strokes += [replace(stroke, points=stroke.points + np.array([right, 0.0])) for stroke in page]
            right += WIDTH
        found.append(Ink(tuple(strokes[:FULL])))
    return found


def measure(names: list[str], pages: list[Ink], warm_up: int) -> dict[str, dict[str, float]]:
    """p50 and p95 of each recognizer over the pages after the warm-up, ms on the clock and of the CPU."""
    rivals = {name: recognizer(name) for name in names}
    spent: dict[str, list[tuple[float, float]]] = {name: [] for name in names}
    with threadpool_limits(limits=1):
        for page in pages:
            for name, rival in rivals.items():
                clock, cpu = perf_counter(), thread_time()
                rival.recognize(page)
                spent[name].append((1000 * (perf_counter() - clock), 1000 * (thread_time() - cpu)))
    figures: dict[str, dict[str, float]] = {}
    for name, times in spent.items():
        (p50, cpu_p50), (p95, cpu_p95) = np.percentile(times[warm_up:], [50, 95], axis=0).tolist()
        figures[name] = {"p50": p50, "p95": p95, "cpu_p50": cpu_p50, "cpu_p95": cpu_p95}
    return figures


if __name__ == "__main__":
    main()
