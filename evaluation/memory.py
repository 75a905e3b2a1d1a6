"""How much memory a recognizer, or a reader of mathematics, takes, and how large what it learnt is.

Measured in a fresh process: the growth of the greatest resident memory while it is loaded and reads some generated ink, above
the same process with numpy, the page's types and the roster loaded. So libraries that only this one needs (onnxruntime,
scikit-learn, compiled kernels) count; what all need does not. `python -m evaluation.memory WHAT NAME` is that process.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from resource import RUSAGE_SELF, getrusage
from typing import Literal

from evaluation.rivals import OWN, kept_at, rival
from recognizer.published import PUBLISHED
from sketch.ink import Ink

What = Literal["recognizer", "reader"]
MEGABYTE = 1 << 20
STROKES, SEED = 200, 91_001
"""Generated strokes that it reads, one by one: by then nothing grows any more."""
FORMULAS = 3
"""Generated expressions that a reader reads."""
SECONDS = 300.0
"""A process that takes longer is given up."""

ROOT = Path(__file__).parents[1]
"""Where the rooms are: the fresh process imports the same ones."""
_ROOM = ROOT / "recognizer"
_NET = ("learned/weights/strokes.onnx",)
_READING = tuple(
    f"handwriting/weights/{name}" for name in ("relations.onnx", "language.npz", "confidence.json")
)
_LEARNT: dict[tuple[What, str], tuple[str, ...]] = {
    ("recognizer", "paper"): (),
    ("recognizer", "geometric"): (),
    ("recognizer", "learned"): _NET,
    ("recognizer", "hybrid"): (*_NET, "hybrid.json"),
    ("reader", "net"): ("handwriting/weights/signs.onnx", *_READING),
    ("reader", "dollar-p"): ("handwriting/weights/clouds.npz", *_READING),
}
"""Files of what ours have learnt, in the room `recognizer`."""


@dataclass(frozen=True, slots=True)
class Memory:
    """In megabytes (2²⁰ bytes). grown: of resident memory, None where it could not be measured, as of a program in another
    process; learnt: size of the files of what it learnt, 0 of none, None where nobody knows."""

    grown: float | None
    learnt: float | None


@cache
def memory(name: str, what: What = "recognizer") -> Memory:
    """Of the recognizer, or reader, of that name; measured once in a process."""
    return Memory(None if name.startswith("run:") else _grown(name, what), learnt(name, what))


def peak() -> float:
    """The greatest resident memory of this process so far, megabytes."""
    status = Path("/proc/self/status")
    if status.exists():  # elsewhere: a fresh process may be told the peak of the one that started it
        line = next(line for line in status.read_text().splitlines() if line.startswith("VmHWM:"))
        return int(line.split()[1]) / 1024
    return getrusage(RUSAGE_SELF).ru_maxrss / (MEGABYTE if sys.platform == "darwin" else 1024)


def _grown(name: str, what: What) -> float | None:
    if what == "recognizer":
        rival(name)  # taught here and kept, so that teaching is not measured
    try:
        told = subprocess.run(
            [sys.executable, "-m", "evaluation.memory", what, name],
            input=pickle.dumps(_inks(what)),
            capture_output=True,
            check=True,
            timeout=SECONDS,
            env={**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])},
        )
        return float(told.stdout.split()[-1])
    except (subprocess.SubprocessError, OSError, ValueError, IndexError):
        return None


def learnt(name: str, what: What = "recognizer") -> float | None:
    """Megabytes of the files of what it learnt, as in `Memory`."""
    if name.startswith("onnx:"):
        files = [Path(name.removeprefix("onnx:"))]
    elif what == "recognizer" and (name in PUBLISHED or OWN in name):
        files = [kept_at(name)]
    elif (what, name) in _LEARNT:
        files = [_ROOM / file for file in _LEARNT[what, name]]
    else:
        return None
    return sum(file.stat().st_size for file in files) / MEGABYTE if all(map(Path.is_file, files)) else None


@cache
def _inks(what: What) -> tuple[Ink, ...]:
    if what == "reader":
        from evaluation.formula_suites import generated_formulas

        return tuple(row.ink for row in generated_formulas(FORMULAS, SEED).rows)
    from data_gen.strokes import generate

    return tuple(Ink((item.stroke,)) for item in generate(STROKES, SEED))


def main(arguments: Sequence[str]) -> int:
    """The fresh process: ink comes in pickled, the growth goes out."""
    what, name = arguments
    inks: tuple[Ink, ...] = pickle.load(sys.stdin.buffer)
    before = peak()
    if what == "reader":
        from recognizer.handwriting.roster import reader_of

        reader = reader_of(name)
        for ink in inks:
            reader.read(ink.strokes)
    else:
        recognizer = rival(name)
        for ink in inks:
            recognizer.recognize(ink)
    sys.stdout.write(f"{peak() - before}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
