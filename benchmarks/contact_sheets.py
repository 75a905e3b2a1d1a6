"""Contact sheets: people's ink beside generated ink, a PNG for every kind, to look at.

    INKLINED_REAL_INK=folder python benchmarks/contact_sheets.py OUT --seed 1

Left people's rows (rows 1 to 8), right as many generated items; kinds that no public set has (scribble, lasso) and
doodles are shown generated alone. Dots are the device's samples, the green ring is where each stroke begins,
strokes after the first are orange. Nothing of what is written may be committed: people's ink has its own licences.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from data_gen.strokes import doodles, items
from sketch.files import jsonl
from sketch.ink import Ink
from sketch.page import STROKE_KINDS

ROWS, COLUMNS = 8, 9
"""Drawings of each half of a sheet."""


def main() -> None:
    parser = argparse.ArgumentParser(description="People's ink beside generated ink, to look at.")
    parser.add_argument("out", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    folder = os.environ.get("INKLINED_REAL_INK")
    rows = jsonl.read(Path(folder) / "shapes-dev.jsonl.gz").rows if folder else ()
    options.out.mkdir(parents=True, exist_ok=True)
    shown = ROWS * COLUMNS
    rng = np.random.default_rng(options.seed)
    for kind in STROKE_KINDS:
        people = [row.ink for row in rows if row.label == kind]
        chosen = [people[k] for k in rng.permutation(len(people))[:shown]]
        made = [Ink(item.strokes) for item in items(shown, options.seed, mix={kind: 1.0})]
        print(sheet(kind, chosen, made, options.out))
    print(sheet("doodle", [], [Ink(item.strokes) for item in doodles(shown, options.seed)], options.out))


def sheet(name: str, people: Sequence[Ink], made: Sequence[Ink], out: Path) -> Path:
    """Draws one sheet and gives its path."""
    figure, axes = plt.subplots(ROWS, 2 * COLUMNS + 1, figsize=(2 * COLUMNS + 1, ROWS))
    for spot in axes.ravel():
        spot.axis("off")
    for half, inks in ((0, people), (COLUMNS + 1, made)):
        for number, ink in enumerate(inks):
            drawn(axes[number // COLUMNS, half + number % COLUMNS], ink)
    figure.suptitle(f"{name}: people's left, generated right", fontsize=9)
    path = out / f"{name}.png"
    figure.savefig(path, dpi=64)
    plt.close(figure)
    return path


def drawn(spot: Axes, ink: Ink) -> None:
    for number, stroke in enumerate(ink):
        x, y = stroke.points.T
        spot.plot(x, y, "-", linewidth=0.8, color="tab:orange" if number else "tab:blue")
        spot.plot(x, y, ".", markersize=1.5, color="black")
        spot.plot(x[:1], y[:1], "o", markersize=3, markerfacecolor="none", color="tab:green")
    spot.set_aspect("equal", adjustable="datalim")
    spot.invert_yaxis()


if __name__ == "__main__":
    main()
