"""How the cost grows with the number of bodies: inklined, pymunk, Box2D 2.3 and Box2D 3, taking turns.

    python benchmarks/engine_scaling.py --json scaling.json

Two families at 1, 4, 16, 64 and 256 bodies. columns: discs side by side fall half a metre to one floor,
bounce (restitution 0.3) and come to rest, 2 s; each is alone with the floor. chain: links of 0.2 m, pinned in
a row to a fixed point, let go straight at 30° from the vertical, 1 s; the tension at the top, and with it the
stiffness, grows with the chain. Peers take 60 steps a second whatever that costs them in accuracy: their
error on the chain, against a converged reference, stands beside. CPU time as in benchmarks/engine.py.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import radians
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from engine_cases import box, disc
from engine_chain import chain, chain_places
from engine_study import turns
from peers.roster import INKLINED, NAMES, Engine, engines
from physics.scene import Material, Scene

LIVELY = Material(restitution=0.3, friction=0.5)
LINK, LEAN = 0.2, radians(30)
SECONDS = {"columns": 2.0, "chain": 1.0}


@dataclass(frozen=True, slots=True)
class Cost:
    """cpu: ms a simulated second and body; error: m, on the chain alone."""

    bodies: int
    cpu: float
    error: float | None


def main() -> None:
    parser = argparse.ArgumentParser(description="CPU time against the number of bodies.")
    parser.add_argument(
        "--only", nargs="*", default=[], choices=NAMES, metavar="ENGINE", help=", ".join(NAMES)
    )
    parser.add_argument("--bodies", type=int, nargs="*", default=[1, 4, 16, 64, 256])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    contest = engines(options.only)
    document: dict[str, dict[str, list[dict[str, float | None]]]] = {}
    for family in SECONDS:
        with threadpool_limits(limits=1):
            costs = measure(family, options.bodies, contest, options.repeats)
        show(family, costs)
        document[family] = {name: [asdict(cost) for cost in row] for name, row in costs.items()}
    if options.json:
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def measure(
    family: str, counts: Sequence[int], contest: Sequence[Engine], repeats: int
) -> dict[str, list[Cost]]:
    """Every engine at every number of bodies, at its usual setting."""
    seconds, costs = SECONDS[family], {engine.name: list[Cost]() for engine in contest}
    for count in counts:
        scene = scene_of(family, count)
        true = chain_places(count, LINK, LEAN, seconds)(seconds) if family == "chain" else None
        final = {engine.name: engine.run(scene, seconds, engine.usual, False) for engine in contest}
        cpu = turns(contest, lambda engine: [engine.usual], scene, seconds, repeats)
        for engine in contest:
            error = None
            if true is not None:
                error = float(np.linalg.norm(final[engine.name].places[-1, :, :2] - true, axis=1).max())
            costs[engine.name].append(Cost(count, cpu[engine.name, engine.usual] / count, error))
    return costs


def scene_of(family: str, count: int) -> Scene:
    """The family's scene with so many bodies."""
    if family == "chain":
        return chain(count, LINK, LEAN)
    floor = box("floor", (0.0, -0.5), count + 10.0, 1.0, LIVELY, fixed=True)
    row = [disc(f"disc {k}", (k - (count - 1) / 2, 0.75), 0.25, 1.0, LIVELY) for k in range(count)]
    return Scene((floor, *row))


def growth(costs: Sequence[Cost]) -> float:
    """The exponent p of cost ~ bodiesᵖ for the whole scene, fitted to the logarithms of the three largest: what a
    step costs however little there is to do hides it at first. NaN for one size alone."""
    if len(costs) < 2:
        return float("nan")
    many = sorted(costs, key=lambda cost: cost.bodies)[-3:]
    count = np.array([cost.bodies for cost in many], dtype=float)
    cpu = np.array([cost.cpu for cost in many])
    return float(np.polyfit(np.log(count), np.log(cpu * count), 1)[0])


def show(family: str, costs: dict[str, list[Cost]]) -> None:
    """A table of the family's costs, errors and growth."""
    counts = [cost.bodies for cost in next(iter(costs.values()))]
    print(f"\n{family}: CPU time, ms a simulated second and body; exponent of growth over the three largest")
    print(f"{'bodies':12}" + "".join(f"{count:>10}" for count in counts) + f"{'exponent':>10}")
    for name, row in costs.items():
        print(f"{name:12}" + "".join(f"{cost.cpu:10.3f}" for cost in row) + f"{growth(row):10.2f}")
    if all(cost.error is not None for row in costs.values() for cost in row):
        print("error at the end, m")
        for name, row in costs.items():
            print(f"{name:12}" + "".join(f"{cost.error:10.1e}" for cost in row))
    if INKLINED in costs and len(costs) > 1:
        worst = max(growth(row) for name, row in costs.items() if name != INKLINED)
        own = growth(costs[INKLINED])
        print(
            f"target: grows no worse than the peers: {own:.2f} <= {worst:.2f} {'met' if own <= worst else 'MISSED'}"
        )


if __name__ == "__main__":
    main()
