"""Whether the studio tells gestures from drawing while a page is being drawn, when nothing that comes later helps.

    python benchmarks/studio_gestures.py --pages 60

Every stroke of generated pages is handed to `studio.gestures.understood` in turn, on the page as it was before it; then one
more gesture, as `data_gen.gestured` makes them. No stroke of the drawing may be taken for a gesture; taps that fix what
nobody has read yet stay ink, and are counted as drawing.
"""

from __future__ import annotations

import argparse
from collections import Counter

from data_gen.gestured import gestured_pages
from studio.actions import Draw, done
from studio.board import Board
from studio.gestures import understood
from studio.reading import rival


def main() -> None:
    parser = argparse.ArgumentParser(description="Gestures as they are made.")
    parser.add_argument("--pages", type=int, default=60)
    parser.add_argument("--seed", type=int, default=2027)
    parser.add_argument("--recognizer", default="geometric")
    options = parser.parse_args()
    reader = rival(options.recognizer)
    table: dict[str, Counter[str]] = {}
    for item in gestured_pages(options.pages, options.seed):
        board, last = Board(), len(item.ink) - 1
        for index, stroke in enumerate(item.ink):
            name = f"s{index}"
            found = understood(board, board.sketch, name, stroke, reader)
            truth = item.kind if index == last else "drawing"
            if truth == "tap":
                continue  # on what nobody has read it is kept as ink
            table.setdefault(truth, Counter())[found.said] += 1
            if truth == "drawing" and found.said != "drawn":
                kinds = item.page.truth.kinds()
                print(
                    f"page {item.index}: stroke {index} of {last}, a {kinds[index]}, is taken for a {found.said}"
                )
            board = done(board, Draw(name), lambda _, it=stroke: it)
    for truth, row in table.items():
        print(
            f"{truth:10}{sum(row.values()):6}: {', '.join(f'{kind} {count}' for kind, count in row.most_common())}"
        )


if __name__ == "__main__":
    main()
