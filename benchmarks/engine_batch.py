"""Ten thousand scenes of ten seconds: what `simulate_many` costs, on one thread and on two.

    python benchmarks/engine_batch.py --json batch.json

Three problems, every scene with its own sizes, masses and angles (scene k of a problem depends on the seed and
k alone): a disc on an incline, smooth or rough; a pendulum of up to 85°; a box on two wires. The time is the
CPU time of all threads together, with packing the scenes and poses at 60 Hz; making the `Scene`s is not
timed. The worst position error after the ten seconds, against the closed form and as a share of the way gone
(incline) or in metres, shows that the work was done; the digests show that threads change no bit.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from hashlib import sha256
from math import cos, inf, radians, sin, sqrt, tan
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
from scipy.special import ellipj

from engine_cases import G, incline, pendulum, two_wires
from physics.engine import simulate_many
from physics.scene import Material, Scene, Vector

BATCH = 500
"""Scenes of one call: the trajectories of ten thousand would fill half a gigabyte."""

TARGET = {"incline": 10.0, "pendulum": 6.0, "two wires": 7.0}
"""CPU seconds for 10,000 scenes of 10 s."""


@dataclass(frozen=True, slots=True)
class Made:
    """A scene, where its movable body must be in the end, m, and the length (m) that the error is a share of."""

    scene: Scene
    end: Vector
    scale: float


@dataclass(frozen=True, slots=True)
class Cost:
    """cpu, wall: seconds; error: the worst; digest: of all trajectories."""

    threads: int
    cpu: float
    wall: float
    error: float
    digest: str


def main() -> None:
    parser = argparse.ArgumentParser(description="CPU time of many scenes at once.")
    parser.add_argument("--scenes", type=int, default=10_000)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--threads", type=int, nargs="*", default=[1, 2])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    document: dict[str, object] = {"scenes": options.scenes, "seconds": options.seconds, "seed": options.seed}
    share = options.scenes * options.seconds / 1e5
    print(f"{options.scenes} scenes of {options.seconds:g} s")
    print(f"{'':12}{'threads':>8}{'CPU s':>9}{'wall s':>9}{'target':>9}{'':8}{'error':>9}  digest")
    for name, make in PROBLEMS.items():
        made = [
            make(np.random.default_rng([options.seed, k]), options.seconds) for k in range(options.scenes)
        ]
        simulate_many([one.scene for one in made[:2]], 0.1, threads=2)  # compilation, caches
        costs = [measure(made, options.seconds, threads) for threads in options.threads]
        for cost in costs:
            met = "met" if cost.cpu <= TARGET[name] * share else "MISSED"
            print(
                f"{name:12}{cost.threads:8}{cost.cpu:9.2f}{cost.wall:9.2f}{TARGET[name] * share:9.2f} {met:7}"
                f"{cost.error:9.1e}  {cost.digest[:12]}"
            )
        document[name] = [asdict(cost) for cost in costs]
    if options.json:
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def measure(made: list[Made], seconds: float, threads: int) -> Cost:
    """All scenes, a batch at a time; looking at the results is not timed."""
    cpu = wall = error = 0.0
    digest = sha256()
    for first in range(0, len(made), BATCH):
        batch = made[first : first + BATCH]
        begun, clock = process_time(), perf_counter()
        motions = simulate_many([one.scene for one in batch], seconds, threads=threads)
        cpu, wall = cpu + process_time() - begun, wall + perf_counter() - clock
        for one, motion in zip(batch, motions, strict=True):
            digest.update(motion.digest().encode())
            column = next(k for k, body in enumerate(one.scene.bodies) if not body.fixed)
            x, y = (motion.poses[-1, column, :2] - np.array(one.end)).tolist()
            away = sqrt(x * x + y * y) / one.scale
            error = max(error, inf if np.isnan(away) else away)
    return Cost(threads, cpu, wall, error, digest.hexdigest())


def on_incline(rng: np.random.Generator, seconds: float) -> Made:
    """Half of them smooth; the rough ones hold (never: a disc rolls), roll or slide as μ and θ decide."""
    angle, radius = radians(rng.uniform(10, 40)), rng.uniform(0.1, 0.5)
    friction = float(rng.choice([0.0, rng.uniform(0.02, 0.6)]))
    rolls = friction >= tan(angle) / 3
    pull = G * sin(angle) * 2 / 3 if rolls else G * (sin(angle) - friction * cos(angle))
    way = 0.5 * pull * seconds**2
    scene, (x, y) = incline(angle, way + 3.0, radius, Material(restitution=0.0, friction=friction))
    return Made(scene, (x + way * cos(angle), y - way * sin(angle)), way)


def on_a_wire(rng: np.random.Generator, seconds: float) -> Made:
    amplitude, length = radians(rng.uniform(10, 85)), rng.uniform(0.5, 2.0)
    k = sin(amplitude / 2)
    _, cn, dn, _ = ellipj(sqrt(G / length) * seconds, k * k)
    angle = 2 * float(np.arcsin(k * cn / dn))
    return Made(pendulum(amplitude, length), (length * sin(angle), -length * cos(angle)), 1.0)


def on_two_wires(rng: np.random.Generator, seconds: float) -> Made:
    """Always at rest; `seconds` changes nothing."""
    del seconds
    angle = radians(rng.uniform(20, 70))
    return Made(two_wires(angle, angle), (0.0, 0.0), 1.0)


PROBLEMS: dict[str, Callable[[np.random.Generator, float], Made]] = {
    "incline": on_incline,
    "pendulum": on_a_wire,
    "two wires": on_two_wires,
}

if __name__ == "__main__":
    main()
