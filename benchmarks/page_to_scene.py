"""How long a page takes from sketch to scene, and an edited formula until it is live again.

    python benchmarks/page_to_scene.py --repeat 200 --json page_to_scene.json

The page has twenty components, fourteen of them with mathematics of every kind (units, vectors, other
bodies' quantities, an angle that corrects an incline), and an equation to be solved. Timed are:

- `sketch to scene`: `rectify` and `build` of the page, as after *Analyze* and as `physics.pipeline.move` does it,
  each time a little aside of where it was, so that no shape was seen before;
- `meaning alone`: `read`, which is most of what mathematics adds;
- `formula edited`: one formula's text replaced, parsed, the whole page's meaning read anew and its
  program or value made again, that is, until the number is in a scene's hands (`build`);
- `new equation`: an equation that was never seen, solved for the first time.

What was parsed and solved before is remembered by its text, in a session as here; every edit is a text
that was never seen. The targets are 10 ms and 5 ms (p95).
"""

from __future__ import annotations

import argparse
import gc
import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter, thread_time

import numpy as np
from threadpoolctl import threadpool_limits

from physics.build import build
from physics.formula.meaning import read
from physics.rectify import rectify
from sketch.formula.parse import expression
from sketch.page import Association, Component, Sketch
from sketch.shapes import Circle, Polygon, Spring, Wire

TARGETS = {"sketch to scene": 10.0, "formula edited": 5.0}
"""Milliseconds, p95."""
WARM_UP = 5


def main() -> None:
    parser = argparse.ArgumentParser(description="Milliseconds from a page to its scene, and for an edit.")
    parser.add_argument("--repeat", type=int, default=200)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    with threadpool_limits(limits=1):
        figures = measure(options.repeat)
    print(f"{'':18}{'p50 ms':>9}{'p95 ms':>9}{'CPU p50':>9}{'CPU p95':>9}{'target':>9}")
    for name, figure in figures.items():
        columns = "".join(f"{figure[key]:9.3f}" for key in ("p50", "p95", "cpu_p50", "cpu_p95"))
        target = f"{TARGETS[name]:9.1f}" if name in TARGETS else ""
        print(f"{name:18}{columns}{target}")
    if options.json:
        document = {"repeat": options.repeat, "components": len(page().components), "milliseconds": figures}
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def measure(repeat: int) -> dict[str, dict[str, float]]:
    """p50 and p95 of each, ms on the clock and of the CPU."""
    drawn = page()
    corrected = rectify(drawn).sketch
    masses = [f"{1 + k / 1000:.3f}" for k in range(repeat + WARM_UP)]
    pages = [page(aside=(k + 1) / 7) for k in range(repeat + WARM_UP)]
    return {
        "sketch to scene": _spread([_analyzed(one) for one in pages]),
        "meaning alone": _spread([lambda: read(drawn)] * (repeat + WARM_UP)),
        "formula edited": _spread([_edit(corrected, f"m = {mass} kg") for mass in masses]),
        "new equation": _spread([_edit(corrected, f"m g + {mass} = 19.62 {mass}") for mass in masses[:40]]),
    }


def _analyzed(drawn: Sketch) -> Callable[[], object]:
    def analyzed() -> object:
        corrected = rectify(drawn)
        return build(corrected.sketch, corrected.meanings)

    return analyzed


def _edit(sketch: Sketch, text: str) -> Callable[[], object]:
    def edited() -> object:
        lines = (expression(text), *sketch.expressions[1:])
        return build(replace(sketch, expressions=lines))

    return edited


def _spread(works: Sequence[Callable[[], object]]) -> dict[str, float]:
    times: list[tuple[float, float]] = []
    gc.collect()
    for work in works:
        clock, cpu = perf_counter(), thread_time()
        work()
        times.append((1000 * (perf_counter() - clock), 1000 * (thread_time() - cpu)))
    (p50, cpu_p50), (p95, cpu_p95) = np.percentile(times[WARM_UP:], [50, 95], axis=0).tolist()
    return {"p50": p50, "p95": p95, "cpu_p50": cpu_p50, "cpu_p95": cpu_p95}


def page(aside: float = 0.0) -> Sketch:
    """Twenty components: a floor, an incline with a ball on it, boxes stacked, pendulums, springs.

    aside: by how much all of it is further to the right, page units.
    """
    left, right, top = aside + 100, aside + 400, (aside + 400, 430)
    parts = [
        Component(_box(aside, 600, aside + 1200, 640), label="A", fixed=True),
        Component(Polygon([(left, 600), (right, 600), top]), label="B", fixed=True),
        Component(Circle((aside + 250, 489.0), 22.0), label="C"),
        Component(_box(aside, 0, aside + 1200, 30), label="D", fixed=True),
    ]
    for k in range(4):
        x = aside + 500 + 90 * k
        parts += [
            Component(_box(x - 25, 550, x + 25, 600), label="EFGH"[k]),
            Component(Circle((x, 250.0), 18.0), label="IJKL"[k]),
            Component(Wire((x, 30.0), (x, 232.0)), label="MNOP"[k], ends=("D", "IJKL"[k])),
        ]
    for k in range(2):
        x = aside + 950 + 120 * k
        parts += [
            Component(_box(x - 30, 250, x + 30, 310), label="QR"[k]),
            Component(Spring((x, 30.0), (x, 250.0), 6, 24), label="ST"[k], ends=("D", "QR"[k])),
        ]
    lines: list[tuple[str, str | None]] = [
        ("m = 1 kg", "C"),
        ("theta = 30°", "B"),
        ("f_1 = |W| cos(theta)", "C"),
        ("g = 9.81 m/s^2", None),
        ("mu = 0.3", "E"),
        ("m_F = 2 kg", "F"),
        ("F = (0.2 m_F g, 0)", "F"),
        ("v_x = 3.6 km/h", "I"),
        ("F_2 = -0.1 v", "J"),
        ("T_1 = 2 N", "P"),
        ("k = 40 N/m", "S"),
        ("L = 2 m", "T"),
        ("e = 0.5", "K"),
        ("a = g sin(theta)", "C"),
        ("½ m v_2^2 = m g h", "L"),
        ("h = 0.5 m", "L"),
    ]
    where = {part.label: (aside + 250, 590.0) for part in parts}
    return Sketch(
        components=tuple(parts),
        expressions=tuple(expression(text) for text, _ in lines),
        associations=tuple(
            Association(k, label, where[label]) for k, (_, label) in enumerate(lines) if label is not None
        ),
    )


def _box(left: float, top: float, right: float, bottom: float) -> Polygon:
    return Polygon([(left, top), (left, bottom), (right, bottom), (right, top)])


if __name__ == "__main__":
    main()
