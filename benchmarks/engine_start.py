"""How long a fresh process takes to simulate its first pendulum, with machine code kept and without.

    python benchmarks/engine_start.py --json start.json

"compiled" begins with an empty cache, which happens once on a machine; "cached" is every start after that: a
new Python process that imports inklined's engine and simulates ten seconds of a pendulum. Beside it stands the
same process without the engine (numpy and numba imported), which no engine can go below. Seconds on the clock,
for that is what a person waits; the median of some starts.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter

TARGET = 1.5
"""Seconds for a cached start."""

PENDULUM = """
from physics.engine import simulate
from physics.scene import Anchor, Body, Disc, Scene, WireLink

bob = Body("bob", Disc(0.1), (0.6, -0.8), 1.0, 0.005)
wire = WireLink("wire", Anchor("bob", (0.0, 0.0)), Anchor(None, (0.0, 0.0)), 1.0)
motion = simulate(Scene((bob,), wires=(wire,)), 10.0)
assert len(motion.times) == 601
"""
BARE = "import numba, numpy"


def main() -> None:
    parser = argparse.ArgumentParser(description="Seconds until a fresh process has moved a pendulum.")
    parser.add_argument("--starts", type=int, default=5)
    parser.add_argument("--json", type=Path)
    parser.add_argument(
        "--warm", action="store_true", help="use the machine code that there is; compile nothing"
    )
    options = parser.parse_args()

    with tempfile.TemporaryDirectory() as empty:
        cache = None if options.warm else empty
        first, said = start(PENDULUM, cache)
        cached = median(start(PENDULUM, cache)[0] for _ in range(options.starts))
    bare = median(start(BARE, None)[0] for _ in range(options.starts))
    if not options.warm:
        print(f"compiled, once   {first:7.2f} s")
    print(f"cached           {cached:7.2f} s   target {TARGET} s {'met' if cached <= TARGET else 'MISSED'}")
    print(f"numba and numpy  {bare:7.2f} s")
    if not options.warm:
        print(f"it says meanwhile: {said.strip() or 'nothing'}")
    if options.json:
        document = {
            "compiled_s": None if options.warm else first,
            "cached_s": cached,
            "bare_s": bare,
            "said": said.strip(),
        }
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def start(program: str, cache: str | None) -> tuple[float, str]:
    """Seconds of a process that runs the program, and what it wrote to its standard error. cache: where compiled
    code is kept. Raises SystemExit with its words when the process fails."""
    kept = {} if cache is None else {"NUMBA_CACHE_DIR": cache}
    begun = perf_counter()
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False, env=os.environ | kept
    )
    took = perf_counter() - begun
    if done.returncode:
        raise SystemExit(done.stderr)
    return took, done.stderr


if __name__ == "__main__":
    main()
