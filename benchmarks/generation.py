"""How fast ink is generated, on one core: single strokes a second, and whole pages a second.

    python benchmarks/generation.py --strokes 10000 --pages 24 --json generation.json

The best of some repeats counts: what else the machine does can only slow a run down. Seconds are
this process's own (CPU time on one thread), so that a busy machine changes little.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from pathlib import Path
from time import process_time

from threadpoolctl import threadpool_limits

from data_gen.pages import pages
from data_gen.strokes import generate


def main() -> None:
    parser = argparse.ArgumentParser(description="Strokes and pages a second, on one core.")
    parser.add_argument("--strokes", type=int, default=10_000)
    parser.add_argument("--pages", type=int, default=24)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    with threadpool_limits(limits=1):
        generate(600, options.seed)  # warm-up
        figures = {
            "strokes_per_second": options.strokes
            / best(lambda: generate(options.strokes, options.seed), options.repeats),
            "pages_per_second": options.pages
            / best(lambda: list(pages(options.pages, options.seed)), options.repeats),
        }
    for name, value in figures.items():
        print(f"{name.replace('_', ' '):20} {value:9.1f}")
    if options.json:
        document = {"strokes": options.strokes, "pages": options.pages, "seed": options.seed, **figures}
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def best(work: Callable[[], object], repeats: int) -> float:
    """The shortest CPU time that the work took, seconds."""
    times: list[float] = []
    for _ in range(repeats):
        begun = process_time()
        work()
        times.append(process_time() - begun)
    return min(times)


if __name__ == "__main__":
    main()
