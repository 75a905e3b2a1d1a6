"""Text of any kind as formulas: each read, printed, analysed, solved; no exception, no hang.

    nice python benchmarks/fuzz_formulas.py --minutes 10 --json fuzz.json

Two hunters share the time: hypothesis, which makes lines from the language's own words, and a mutator
that grows a corpus. Where atheris can be imported (`pip install atheris`; its wheels are for few
Pythons) it takes the mutator's place, in a process of its own and guided by the coverage of our code;
else plain mutation does. A line that takes longer than `SLOW` seconds of CPU counts as a hang.
"""

from __future__ import annotations

import argparse
import json
import random
import subprocess
import sys
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from types import FunctionType
from typing import Any

from hypothesis import HealthCheck, Phase, Verbosity, given, settings
from hypothesis import strategies as st

from physics.formula.dimensions import check
from physics.formula.meaning import read
from sketch.formula.mathml import mathml
from sketch.formula.parse import FormulaError, parse
from sketch.formula.print import latex, plain
from sketch.page import Association, Component, Expression, Sketch
from sketch.shapes import Circle, Polygon, Spring, Wire

SLOW = 6.0
"""Seconds of CPU: the solver's own limit is 3, and the machine may be busy."""
PARTS = (
    Component(Polygon([(0, 380), (0, 420), (500, 420), (500, 380)]), label="A", fixed=True),
    Component(Circle((200.0, 160.0), 20.0), label="B"),
    Component(Wire((200.0, 40.0), (200.0, 140.0)), label="C", ends=(None, "B")),
    Component(Spring((320.0, 40.0), (320.0, 340.0), 5, 20), label="D"),
)
NAMES = (
    "m", "v", "v_x", "v_0", "a", "F", "f_1", "N", "T", "T_1", "k", "L", "theta", "alpha", "mu", "e", "x",
    "y", "s", "r", "W", "p", "E", "h", "t", "g", "omega", "rho", "q", "v_B", "m_C", "F_x", "v'", "ΣF",
    "m'",
)  # fmt: skip
"""Of quantities, as people write them."""
WORDS = (
    *NAMES,
    "\\theta", "\\mu", "\\alpha", "0", "1", "2", "3.5", "9.81", "1e3", "10^400", "0.5", "½", "+", "-",
    "*", "/", "^", "=", "==", "(", ")", "[", "]", "{", "}", "|", "‖", ",", "\\frac", "\\frac12", "\\sqrt",
    "sqrt", "sin", "cos", "\\tan", "ln", "exp", "\\left(", "\\right)", "\\sum", "Σ", "²", "³", "⁻¹", "₁",
    "°", "kg", "\\mathrm{kg}", "\\mathrm", "\\text{m/s}", "km/h", "m/s^2", "\\,", "\\cdot", "_", "_{",
    "}", ".", "pi", "π", "\\pi", "(0,5)", "'", "\\vec", "\\vec{F}", "|W|", "30°",
)  # fmt: skip
SEEDS: tuple[str, ...] = (
    "theta = pi/6", "f_1 = |W| cos(theta)", r"T=5\sqrt{2}\,\mathrm{N}", "y = 3t - 1/2 g t^2", "m = 5 kg", "v = 36 km/h",
    "½mv² = mgh", r"\sum F = m a", r"T_1\sin\alpha+T_2\sin\beta=W", "F = -G M m / r^2", "f = (0, 5) N", "v_1' = 3",
)  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description="Fuzz the formula language and what formulas mean.")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--guided", type=Path, help="internal: hunt with atheris alone, and tell this file")
    options = parser.parse_args()

    if options.guided is not None:
        guided_by_coverage(options.guided, 60 * options.minutes)
        return
    tally = Tally()
    half = 30 * options.minutes
    started = perf_counter()
    hunt_words(tally, half)
    guide = "atheris" if find_spec("atheris") else "nothing (atheris is not installed)"
    if guide == "atheris":
        _in_a_process_of_its_own(tally, half)
    else:
        mutate(tally, half, options.seed)
    spent = perf_counter() - started
    document = {
        "seconds": spent,
        "lines": tally.lines,
        "formulas": tally.formulas,
        "slowest_s": tally.slowest,
        "slowest": tally.slowest_text,
        "guided": guide,
        "failures": tally.failures,
    }
    print(f"{tally.lines} lines in {spent:.0f} s, {tally.formulas} of them formulas; guided by {guide}")
    print(f"slowest {tally.slowest:.2f} s: {tally.slowest_text!r}; failures: {len(tally.failures)}")
    for text, problem in tally.failures.items():
        print(f"  {text!r}: {problem}")
    if options.json:
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    sys.exit(1 if tally.failures else 0)


class Tally:
    """What has been tried, and what failed."""

    def __init__(self) -> None:
        self.lines = 0
        self.formulas = 0
        self.slowest = 0.0
        self.slowest_text = ""
        self.failures: dict[str, str] = {}

    def attempt(self, text: str) -> bool:
        """Whether the line is a formula. Whatever it does wrong is kept."""
        began = process_time()
        formula = False
        try:
            formula = exercise(text)
        except Exception as error:
            self.failures.setdefault(text, f"{type(error).__name__}: {error}")
        spent = process_time() - began
        self.lines += 1
        self.formulas += formula
        if spent > self.slowest:
            self.slowest, self.slowest_text = spent, text
        if spent > SLOW:
            self.failures.setdefault(text, f"took {spent:.1f} s")
        return formula


def exercise(text: str) -> bool:
    """All that is done with a line. Raises AssertionError where a law is broken."""
    expression = Expression(text)
    for label in ("B", "D", None):
        said = () if label is None else (Association(0, label, (0.0, 0.0)),)
        sketch = Sketch(components=PARTS, expressions=(expression,), associations=said)
        meanings = read(sketch)
        check(sketch, meanings)
        assert meanings.said or meanings.relations or meanings.notices, "nothing is said of it"
    try:
        tree = parse(text)
    except FormulaError as error:
        assert 0 <= error.position <= len(text), "the place is outside the text"
        assert error.reason, "no reason"
        return False
    assert mathml(tree).startswith("<math")
    for written in (plain(tree), latex(tree)):
        try:
            again = parse(written)
        except FormulaError as error:
            assert "at most" in error.reason, f"{written!r} is not read back: {error.reason}"
            continue
        assert again == tree, f"{written!r} is another formula"
    return True


def hunt_words(tally: Tally, seconds: float) -> None:
    """Lines of the language's own words, made by hypothesis."""
    until = perf_counter() + seconds
    words = st.lists(st.sampled_from(WORDS), max_size=16)
    lines = st.tuples(words, st.sampled_from(["", " "])).map(lambda made: made[1].join(made[0])) | st.text(
        max_size=30
    )

    @settings(
        max_examples=500,
        deadline=None,
        database=None,
        phases=[Phase.generate],
        verbosity=Verbosity.quiet,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
    )
    @given(lines)
    def batch(text: str) -> None:
        if perf_counter() < until:
            tally.attempt(text)

    while perf_counter() < until:
        batch()


def _in_a_process_of_its_own(tally: Tally, seconds: float) -> None:
    """atheris ends the process that it works in, so it has its own, whose tally is added."""
    with TemporaryDirectory() as folder:
        told = Path(folder, "tally.json")
        minutes = str(seconds / 60)
        subprocess.run([sys.executable, __file__, "--minutes", minutes, "--guided", str(told)], check=False)
        there: dict[str, Any] = json.loads(told.read_text(encoding="utf-8"))
    tally.lines += there["lines"]
    tally.formulas += there["formulas"]
    tally.failures |= there["failures"]
    if there["slowest"] > tally.slowest:
        tally.slowest, tally.slowest_text = there["slowest"], there["slowest_text"]


def guided_by_coverage(told: Path, seconds: float) -> None:
    """Lines grown by atheris; the tally is written to `told` all the while."""
    atheris: Any = import_module("atheris")
    tally = Tally()
    ours = [
        module
        for name, module in sys.modules.items()
        if name.startswith(("sketch.formula", "physics.formula"))
    ]
    for module in ours:
        for name, value in list(vars(module).items()):
            if isinstance(value, FunctionType) and value.__module__ == module.__name__:
                setattr(module, name, atheris.instrument_func(value))
    last = perf_counter()

    def one(data: bytes) -> None:
        nonlocal last
        tally.attempt(data.decode("utf-8", "replace")[:200])
        if perf_counter() - last > 1:
            last = perf_counter()
            told.write_text(json.dumps(vars(tally)), encoding="utf-8")

    with TemporaryDirectory() as corpus:
        for k, text in enumerate((*SEEDS, *WORDS)):
            Path(corpus, str(k)).write_text(text, encoding="utf-8")
        limits = [f"-max_total_time={int(seconds)}", "-max_len=200", "-verbosity=0", "-timeout=60"]
        atheris.Setup([sys.argv[0], *limits, corpus], one)
        atheris.Fuzz()


def mutate(tally: Tally, seconds: float, seed: int) -> None:
    """Lines grown from a corpus by cutting, doubling, swapping and inserting."""
    rng = random.Random(seed)
    corpus = list(SEEDS)
    until = perf_counter() + seconds
    while perf_counter() < until:
        text = rng.choice(corpus)
        for _ in range(rng.randint(1, 4)):
            at, to = sorted((rng.randint(0, len(text)), rng.randint(0, len(text))))
            match rng.randrange(5):
                case 0:
                    text = text[:at] + text[to:]
                case 1:
                    text = text[:at] + text[at:to] * 2 + text[to:]
                case 2:
                    text = text[:at] + rng.choice(WORDS) + text[at:]
                case 3:
                    other = rng.choice(corpus)
                    text = text[:at] + other[rng.randint(0, len(other)) :]
                case _:
                    text = (
                        text[:at]
                        + chr(rng.choice((rng.randrange(32, 127), rng.randrange(160, 0x2FFF))))
                        + text[to:]
                    )
        text = text[:200]
        if tally.attempt(text) and text not in corpus:
            corpus.append(text)
            if len(corpus) > 3000:
                corpus.pop(rng.randrange(len(SEEDS), len(corpus)))


if __name__ == "__main__":
    main()
