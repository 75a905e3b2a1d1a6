"""Whether lassos, scribbles and taps are told from drawing, on whole generated pages.

    python benchmarks/gestures.py --pages 300 --json gestures.json

Every page bears one gesture at something that is on it. A row says what the gestures of a kind were taken for,
after a look at the page; the last one what became of the strokes that were no gestures. Taps that the page has
anyway (they fix shapes) are counted as taps.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from pathlib import Path

from data_gen.gestured import gestured_pages
from recognizer.interpret import interpret, notes_of
from recognizer.roster import ROSTER, recognizer
from sketch.page import GESTURE_KINDS


def main() -> None:
    parser = argparse.ArgumentParser(description="Gestures against drawing.")
    parser.add_argument("--pages", type=int, default=300)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--recognizer", nargs="*", default=["geometric"], choices=list(ROSTER))
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    tables = {name: confusion(name, options.pages, options.seed) for name in options.recognizer}
    for name, table in tables.items():
        print(f"{name}, {options.pages} pages, seed {options.seed}")
        for truth, row in table.items():
            told = ", ".join(f"{kind} {count}" for kind, count in row.most_common())
            print(f"  {truth:10}{sum(row.values()):6}: {told}")
        print(
            f"  found {100 * share(table, True):.1f} % of gestures; {100 * share(table, False):.2f} % false"
        )
    if options.json:
        options.json.write_text(json.dumps(tables, indent=1) + "\n", encoding="utf-8")


def confusion(name: str, pages: int, seed: int) -> dict[str, Counter[str]]:
    """For each kind of gesture, and for drawing, what its strokes were taken for ("drawing", or a gesture)."""
    rival = recognizer(name)
    table: dict[str, Counter[str]] = {kind: Counter() for kind in (*GESTURE_KINDS, "drawing")}
    for item in gestured_pages(pages, seed):
        truth = item.page.truth
        true = [*truth.kinds(), item.kind]
        found = {
            gesture.stroke: gesture.kind for gesture in interpret(item.ink, rival, notes_of(truth)).gestures
        }
        for index, kind in enumerate(true):
            if item.kind == "scribble" and kind == "tap":
                continue  # it may have been rubbed out with what it was on
            row = kind if kind in GESTURE_KINDS else "drawing"
            table[row][found.get(index, "drawing")] += 1
    return table


def share(table: dict[str, Counter[str]], of_gestures: bool) -> float:
    """Share of gestures that were taken for what they are; or of drawing that was taken for a gesture."""
    if of_gestures:
        rows = {kind: row for kind, row in table.items() if kind in GESTURE_KINDS}
        return sum(row[kind] for kind, row in rows.items()) / max(
            sum(sum(r.values()) for r in rows.values()), 1
        )
    row = table["drawing"]
    return 1 - row["drawing"] / max(sum(row.values()), 1)


if __name__ == "__main__":
    main()
