"""Raw strokes to what the net of signs is shown, as ONNX: how far from the reader's own step, and what it costs.

    python benchmarks/raw_signs.py --lines 300 > benchmarks/results/raw_signs.txt

Generated lines, every group of strokes that may be one sign, on their line and alone. CPU time on one thread, so that what else
the machine does counts little: the reader's step (Python and numba, spacing included), the graph, the net after either.
"""

from __future__ import annotations

import argparse
import sys
from datetime import date
from pathlib import Path
from time import process_time

import numpy as np
import onnxruntime

from data_gen.writers import sample_writer
from data_gen.writing.grammars import mixed
from data_gen.writing.habits import habits
from data_gen.writing.typeset import written
from recognizer.handwriting.line import groups, line_of, looks_of, spaced

WEIGHTS = Path(__file__).parents[1] / "recognizer" / "handwriting" / "weights"
SHOWN = ("sequence", "images", "numbers")
WARM_UP = 3
"""Lines that nobody times."""


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description="Raw strokes to what the net of signs is shown, as ONNX.")
    parser.add_argument("--lines", type=int, default=300)
    parser.add_argument("--seed", type=int, default=770_061)
    options = parser.parse_args(arguments)
    threads = onnxruntime.SessionOptions()
    threads.intra_op_num_threads = threads.inter_op_num_threads = 1
    graph, net = (
        onnxruntime.InferenceSession(str(WEIGHTS / name), threads, providers=["CPUExecutionProvider"])
        for name in ("looks.onnx", "signs.onnx")
    )
    apart = np.zeros(3)
    costs: list[tuple[float, float, float]] = []
    strokes: list[int] = []
    shown: list[int] = []
    for index in range(options.lines + WARM_UP):
        rng = np.random.default_rng([options.seed, index])
        ink = written(mixed(rng), habits(sample_writer(rng), rng)).ink
        found = groups(line_of([spaced(stroke) for stroke in ink]))
        most = max(len(group) for group in found)
        feeds = {
            "points": np.concatenate([stroke.points for stroke in ink]),
            "ends": np.cumsum([len(stroke) for stroke in ink]),
            "groups": np.array([[*group, *[-1] * (most - len(group))] for group in found]),
        }
        for alone in (True, False):
            begun = process_time()
            own = looks_of(line_of([spaced(stroke) for stroke in ink]), found, alone)
            middle = process_time()
            raw = graph.run(list(SHOWN), {**feeds, "alone": np.full(len(found), alone)})
            done = process_time()
            pairs = zip(raw, (own.sequence, own.images, own.numbers), strict=True)
            apart = np.maximum(apart, [np.abs(np.asarray(one) - other).max() for one, other in pairs])
        asked = process_time()
        net.run(None, dict(zip(SHOWN, raw, strict=True)))
        if index >= WARM_UP:
            costs.append((middle - begun, done - middle, process_time() - asked))
            strokes.append(len(ink))
            shown.append(len(found))
    print(f"python benchmarks/raw_signs.py {' '.join(arguments if arguments is not None else sys.argv[1:])}")
    print(f"measured {date.today()}, onnxruntime {onnxruntime.__version__}, one thread")
    print(f"{sum(strokes):,} strokes on {len(strokes)} lines, {sum(shown):,} groups, on their line and alone")
    for name, most_apart in zip(SHOWN, apart, strict=True):
        print(f"{name:10} at most {most_apart:.1e} apart")
    told = ("median", "p95")
    print("of a line " + "".join(f"{name:>10}" for name in told))
    rows = [("strokes", strokes), ("groups", shown)]
    rows += [
        (name, 1e3 * np.array(costs)[:, k]) for k, name in enumerate(("own step, ms", "graph, ms", "net, ms"))
    ]
    for name, values in rows:
        print(f"{name:14}" + "".join(f"{value:10.1f}" for value in np.percentile(values, [50, 95])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
