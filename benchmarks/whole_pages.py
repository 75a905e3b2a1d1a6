"""Whole generated pages by writers never seen: is every component right in kind and grouping?

    python benchmarks/whole_pages.py --pages 1000 --recognizer learned oracle

A page counts when its components are the true ones, each of the right kind and with exactly its strokes.
Nothing is set in motion. `--cluttered`: with stray marks and crossings-out.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable
from time import process_time

from data_gen.pages import Page, pages
from evaluation.metrics.diagram import diagram_match
from recognizer.claims import Recognizer
from recognizer.interpret import interpret, notes_of
from recognizer.oracle import Oracle
from recognizer.roster import ROSTER, recognizer


def main() -> None:
    parser = argparse.ArgumentParser(description="Pages read exactly in kind and grouping.")
    parser.add_argument("--pages", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--cluttered", action="store_true")
    parser.add_argument("--recognizer", nargs="*", default=["learned", "oracle"], choices=[*ROSTER, "oracle"])
    options = parser.parse_args()
    drawn = list(pages(options.pages, options.seed, cluttered=options.cluttered))
    print(f"{options.pages} pages, seed {options.seed}{', cluttered' if options.cluttered else ''}")
    for name in options.recognizer:
        begun = process_time()
        right, failed = measure(drawn, _maker(name))
        each = 1000 * (process_time() - begun) / len(drawn)
        print(
            f"{name:12} kind and grouping right on {100 * right / len(drawn):.1f} %; {each:.1f} ms a page (CPU)"
        )
        for problem, count in failed.most_common():
            print(f"{'':14}{problem:24}{count}")


def measure(drawn: list[Page], rival_for: Callable[[Page], Recognizer]) -> tuple[int, Counter[str]]:
    """Pages right in kind and grouping, and how many of each diagram are not."""
    failed = Counter[str]()
    for page in drawn:
        match = diagram_match(page.truth, interpret(page.truth.ink, rival_for(page), notes_of(page.truth)))
        failed[page.name] += not (match.components and match.grouping)
    return len(drawn) - failed.total(), +failed


def _maker(name: str) -> Callable[[Page], Recognizer]:
    if name == "oracle":
        return lambda page: Oracle(page.truth)
    rival = recognizer(name)
    return lambda _page: rival


if __name__ == "__main__":
    main()
