"""How often every corner of a stroke is found and nothing else, beside the published finders.

    python benchmarks/corners.py --strokes 2000 --json corners.json

All or nothing (Wolin 2008): a stroke counts where as many corners are found as were meant, in order, each
near its own. The ink is generated (`data_gen.corner_suite`); the seed was not used to develop the finder.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from time import perf_counter

import numpy as np

from data_gen.corner_suite import FIGURES, SLOW, UNHOOKED, CornerStroke, line_arcs, polylines
from recognizer.geometric.corners import corners
from recognizer.geometric.straws import istraw, short_straw
from sketch.geometry import diagonal
from sketch.ink import FloatArray, Stroke

Finder = Callable[[Stroke], FloatArray]
FINDERS: dict[str, Finder] = {
    "ShortStraw": short_straw,
    "IStraw": istraw,
    "corners": lambda stroke: corners(stroke.points, stroke.times),
}
NEAR = 0.15
"""Distance of a corner found from the one meant, over the figure's diagonal, at most: a hand displaces parts
of a figure by a tenth of it, while legs are longer than that."""


def main() -> None:
    parser = argparse.ArgumentParser(description="All-or-nothing accuracy of corner finders.")
    parser.add_argument("--strokes", type=int, default=2000, help="strokes of each suite")
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    suites = {
        "polylines": polylines(options.strokes, options.seed),
        "polylines, no hooks": polylines(options.strokes, options.seed, UNHOOKED),
        "polylines, 20-60 Hz": polylines(options.strokes, options.seed, SLOW),
        "lines and arcs": line_arcs(options.strokes, options.seed),
        "lines and arcs, no hooks": line_arcs(options.strokes, options.seed, UNHOOKED),
        "lines and arcs, 20-60 Hz": line_arcs(options.strokes, options.seed, SLOW),
    }
    figures = {name: measure(suite) for name, suite in suites.items()}
    print(f"all corners and no other, %{'':<6}" + "".join(f"{name:>12}" for name in FINDERS))
    for name, row in figures.items():
        print(f"{name:32}" + "".join(f"{100 * row[finder]['right']:12.1f}" for finder in FINDERS))
    print(f"{'ms a stroke, p50':32}" + "".join(f"{figures['polylines'][f]['ms']:12.2f}" for f in FINDERS))
    families = {
        family: measure([item for item in suites["lines and arcs"] if item.family == family])
        for family in FIGURES
    }
    print("\nlines and arcs by figure, %")
    for name, row in families.items():
        print(f"{name:32}" + "".join(f"{100 * row[finder]['right']:12.1f}" for finder in FINDERS))
    if options.json:
        document = {"strokes": options.strokes, "seed": options.seed, "suites": figures, "figures": families}
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def measure(suite: Sequence[CornerStroke]) -> dict[str, dict[str, float]]:
    """For each finder the share of strokes with all corners and no other, and the median time, ms."""
    figures: dict[str, dict[str, float]] = {}
    for name, finder in FINDERS.items():
        right: list[bool] = []
        spent: list[float] = []
        for item in suite:
            begun = perf_counter()
            found = finder(item.stroke)
            spent.append(1000 * (perf_counter() - begun))
            right.append(all_or_nothing(found, item))
        figures[name] = {"right": float(np.mean(right)), "ms": float(np.median(spent))}
    return figures


def all_or_nothing(found: FloatArray, item: CornerStroke) -> bool:
    """Whether these are the stroke's corners, every one and no other."""
    if len(found) != len(item.corners):
        return False
    away = np.hypot(*(found - item.corners).T)
    return bool((away <= NEAR * diagonal(item.stroke.points)).all())


if __name__ == "__main__":
    main()
