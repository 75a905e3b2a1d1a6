"""Ten thousand random scenes through `simulate`: how many go wrong, and in what way.

    python benchmarks/engine_random.py --json random.json
    python benchmarks/engine_random.py --only-index 1234

Every scene is run for two seconds and its motion judged by `soundness`: not finite, overlap, stretched wire,
pin apart, energy from nowhere, stopped; besides exceptions and timeouts (a process of its own runs the scenes
and is ended when one takes too long). A scene can be remade alone by its index. The digest of all motions is
the same whenever the engine, the seed and the count are.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from hashlib import sha256
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from time import process_time
from typing import Any

from rich.progress import track

from physics.engine import simulate
from physics.scene import Block, Body, Disc, Material, Scene
from random_scenes import scene_at
from soundness import faults

SECONDS = 2.0
START = 900.0
"""Seconds that a process may take until it is ready: kernels may have to be compiled."""

SHOWN = 12
"""Failures of a kind that are listed."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a scene. faults: (kind, words); mode: "exact", "robust" or "mixed"; cpu: seconds."""

    index: int
    faults: list[tuple[str, str]]
    mode: str
    events: int
    digest: str
    cpu: float


def main() -> None:
    parser = argparse.ArgumentParser(description="Random scenes, and how many of their motions are unsound.")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--start", type=int, default=0, help="the first index")
    parser.add_argument("--timeout", type=float, default=20.0, help="seconds for one scene")
    parser.add_argument("--only-index", type=int, help="this scene alone, in this process, with all it says")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    if options.only_index is not None:
        alone(options.seed, options.only_index)
        return

    indices = range(options.start, options.start + options.count)
    running = run(options.seed, indices, options.timeout)
    outcomes = list(track(running, "scenes", total=options.count, update_period=1.0))
    summary = summarise(outcomes)
    show(summary, outcomes)
    if options.json:
        document = {"count": options.count, "seed": options.seed, "start": options.start, **summary}
        document["failures"] = [asdict(outcome) for outcome in outcomes if outcome.faults]
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def outcome_of(seed: int, index: int) -> Outcome:
    """Runs one scene and looks at its motion."""
    scene, begun = scene_at(seed, index), process_time()
    try:
        motion = simulate(scene, SECONDS)
        cpu = process_time() - begun
        found = faults(scene, motion)
    except Exception as error:  # whatever it is, it is counted and its words are kept
        return Outcome(index, [("exception", f"{type(error).__name__}: {error}")], "none", 0, "", 0.0)
    modes = set(motion.modes.values())
    mode = modes.pop() if len(modes) == 1 else "mixed"
    return Outcome(index, found, mode, len(motion.events), motion.digest(), cpu)


def run(seed: int, indices: range, timeout: float) -> Iterator[Outcome]:
    """All of them in order; the process that hangs is ended, and another goes on after it."""
    todo = iter(indices)
    following = next(todo, None)
    while following is not None:
        worker, pipe = _begin(seed)
        alive = True
        while alive and following is not None:
            pipe.send(following)
            outcome = _answer(worker, pipe, following, timeout)
            yield outcome
            alive, following = outcome.mode != "lost", next(todo, None)
        worker.kill()
        worker.join()


def _begin(seed: int) -> tuple[Any, Connection]:
    """A process that is ready, and the pipe to it."""
    context = get_context("spawn")
    ours, theirs = context.Pipe()
    worker = context.Process(target=_work, args=(theirs, seed), daemon=True)
    worker.start()
    theirs.close()
    if not ours.poll(START):
        raise SystemExit(f"a process was not ready within {START:g} s")
    ours.recv()
    return worker, ours


def _work(pipe: Connection, seed: int) -> None:
    first = Body("disc", Disc(0.1), (0.0, 0.1), 1.0, 0.005, material=Material(0.5, 0.5))
    other = Body("block", Block(((-1, -1), (1, -1), (1, 1), (-1, 1))), (0.0, -1.0), 1.0, 1.0)
    for mode in ("exact", "robust"):
        simulate(Scene((first, other)), 0.1, mode=mode)
    pipe.send("ready")
    while True:
        pipe.send(outcome_of(seed, pipe.recv()))


def _answer(worker: Any, pipe: Connection, index: int, patience: float) -> Outcome:
    try:
        if pipe.poll(patience):
            return pipe.recv()
    except EOFError:
        worker.join()
        return Outcome(index, [("crash", f"the process ended with {worker.exitcode}")], "lost", 0, "", 0.0)
    return Outcome(index, [("timeout", f"after {patience:g} s")], "lost", 0, "", patience)


def summarise(outcomes: list[Outcome]) -> dict[str, Any]:
    """Counts by kind and by mode, CPU time, the digest of all."""
    digest = sha256()
    for outcome in outcomes:
        digest.update(outcome.digest.encode())
    cpu = sorted(outcome.cpu for outcome in outcomes)
    return {
        "failed": sum(bool(outcome.faults) for outcome in outcomes),
        "kinds": dict(Counter(kind for outcome in outcomes for kind, _ in outcome.faults)),
        "modes": dict(Counter(outcome.mode for outcome in outcomes)),
        "cpu_s": sum(cpu),
        "cpu_median_ms": 1000 * cpu[len(cpu) // 2],
        "cpu_most_s": cpu[-1],
        "digest": digest.hexdigest(),
    }


def show(summary: dict[str, Any], outcomes: list[Outcome]) -> None:
    """What went wrong, and where to look."""
    print(f"{len(outcomes)} scenes of {SECONDS:g} s: {summary['failed']} failed")
    print("ran " + ", ".join(f"{mode} {count}" for mode, count in sorted(summary["modes"].items())))
    print(
        f"CPU {summary['cpu_s']:.1f} s; median {summary['cpu_median_ms']:.2f} ms a scene, at most {summary['cpu_most_s']:.2f} s"
    )
    print(f"digest {summary['digest'][:16]}")
    for kind, count in sorted(summary["kinds"].items(), key=lambda item: -item[1]):
        print(f"\n{kind}: {count}")
        listed = [(o.index, o.mode, words) for o in outcomes for k, words in o.faults if k == kind]
        for index, mode, words in listed[:SHOWN]:
            print(f"  {index:6} {mode:7} {words}")
        if len(listed) > SHOWN:
            print("  more: " + " ".join(str(index) for index, _, _ in listed[SHOWN : SHOWN + 40]))


def alone(seed: int, index: int) -> None:
    """One scene and all that happens in it."""
    scene = scene_at(seed, index)
    for part in (*scene.bodies, *scene.springs, *scene.wires, *scene.pins):
        print(part)
    motion = simulate(scene, SECONDS)
    for event in motion.events:
        print(f"{event.time:.9f} {event.kind}: {event.message}")
    print(f"modes {dict(motion.modes)}; digest {motion.digest()[:16]}")
    for kind, words in faults(scene, motion):
        print(f"{kind}: {words}")


if __name__ == "__main__":
    main()
