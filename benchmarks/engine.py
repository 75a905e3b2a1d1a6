"""inklined's engine beside pymunk, Box2D 2.3 and Box2D 3: the same scenes, one interleaved run.

    pip install -e '.[bench]'
    python benchmarks/engine.py --json engine.json

How the time is taken: the CPU time of this process, one thread; engines take turns, one setting at a time,
and the median counts. Making the scene, and a peer's bodies and joints, is not timed. Timed are, for a
peer, its steps and reading off all poses at 60 Hz; for inklined the whole call of `simulate`: checking and
packing the scene, running it, poses and velocities at 60 Hz.

How the peers are set up stands in `peers/`: as their manuals advise, in metres, never asleep, undamped.
"Error against cost" runs them at 60 to 3840 steps a second (Box2D 3 with 4 and 8 substeps) and inklined at
accuracies from 1e-3 to 1e-12, and asks of every peer's point: what does inklined need to be at least as close?
"""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from threadpoolctl import threadpool_limits

from engine_cases import Case, cases
from engine_study import Closeness, Point, closeness, error_and_cost
from engine_tables import print_closeness, print_error_and_cost
from engine_targets import TARGETS
from peers.roster import HERTZ, INKLINED, NAMES, engines


def main() -> None:
    parser = argparse.ArgumentParser(description="inklined's engine beside game engines.")
    parser.add_argument(
        "--only", nargs="*", default=[], choices=NAMES, metavar="ENGINE", help=", ".join(NAMES)
    )
    parser.add_argument("--case", nargs="*", default=[], help="incline, pendulum, …; all for none")
    parser.add_argument(
        "--seconds", type=float, default=10.0, help="length of the runs that drift is measured on"
    )
    parser.add_argument("--repeats", type=int, default=5, help="turns of each engine at each setting")
    parser.add_argument("--hertz", type=int, nargs="*", default=list(HERTZ), help="the peers' steps a second")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    with threadpool_limits(limits=1):
        compare(options)


def compare(options: argparse.Namespace) -> None:
    """The whole run: measured, printed, written."""
    contest = engines(options.only, options.hertz)
    chosen: list[Case] = [case for case in cases() if not options.case or case.name in options.case]
    for engine in contest:  # caches, lazy imports, compilation
        for case in chosen:
            engine.run(case.scene, 0.5, engine.usual, True)

    usual: dict[str, dict[str, Closeness]] = {}
    for case in chosen:
        usual[case.name] = closeness(case, contest, options.repeats, options.seconds)
    print("Peers at 60 steps a second, inklined at its default accuracy")
    print_closeness(usual, chosen, [engine.name for engine in contest])

    every: dict[str, dict[str, list[Point]]] = {}
    missed = 0
    for case in chosen:
        every[case.name] = error_and_cost(case, contest, options.repeats)
        missed += print_error_and_cost(case, every[case.name], contest)
    if len(contest) > 1 and contest[0].name == INKLINED:
        print(
            f"\nno more CPU than a peer at its accuracy, single scenes: missed at {missed} of the peers' points"
        )
    if options.json:
        options.json.write_text(
            json.dumps(_document(options, usual, every), indent=1) + "\n", encoding="utf-8"
        )


def _document(
    options: argparse.Namespace,
    usual: dict[str, dict[str, Closeness]],
    every: dict[str, dict[str, list[Point]]],
) -> dict[str, Any]:
    return {
        "drift_seconds": options.seconds,
        "repeats": options.repeats,
        "targets": asdict(TARGETS),
        "usual": {case: {name: asdict(row) for name, row in rows.items()} for case, rows in usual.items()},
        "error_and_cost": {
            case: {name: [asdict(point) for point in points] for name, points in rows.items()}
            for case, rows in every.items()
        },
    }


if __name__ == "__main__":
    main()
