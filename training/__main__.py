"""`python -m training`: remakes the stroke net from nothing but a seed."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from datetime import date
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from recognizer.learned.recognizer import WEIGHTS
from sketch.page import STROKE_KINDS
from training.calibrate import temperature
from training.dataset import make_corpus
from training.export import export, parity
from training.fit import RULE, FitRule, fit, logits_of
from training.nets import parameters_of


def main(arguments: list[str] | None = None) -> int:
    """Makes the corpus, trains, calibrates, exports and writes the card beside the weights."""
    options = _options(arguments)
    console = Console(stderr=True)
    begun = time.monotonic()
    torch.set_num_threads(options.threads)
    with _progress(console) as tell:
        corpus = make_corpus(
            options.strokes,
            options.seed,
            options.threads,
            lambda done: tell("generating", done / options.strokes, ""),
        )
        held_out = make_corpus(max(512, options.strokes // 20), options.seed + 1_000, options.threads)
        net = fit(
            corpus,
            options.seed,
            FitRule(epochs=options.epochs),
            lambda share, loss: tell("training", share, f"loss {loss:.3f}"),
        )
    logits = logits_of(net, held_out)
    heat = temperature(logits, held_out.kind)
    accuracy = float((logits.argmax(axis=1) == held_out.kind).mean())
    target = Path(options.out)
    recipe = {
        "command": f"inklined train --seed {options.seed} --strokes {options.strokes} --epochs {options.epochs}",
        "seed": options.seed,
        "strokes": options.strokes,
        "epochs": options.epochs,
        "kinds": list(STROKE_KINDS),
        "parameters": parameters_of(net),
        "temperature": round(heat, 4),
        "held_out_accuracy_on_generated_ink": round(accuracy, 4),
        "date": date.today().isoformat(),
        "torch": torch.__version__,
    }
    export(net, heat, target, {"inklined": json.dumps(recipe)})
    recipe["parity_with_torch"] = parity(net, heat, target, held_out)
    recipe["minutes"] = round((time.monotonic() - begun) / 60, 2)
    target.with_suffix(".json").write_text(json.dumps(recipe, indent=2, ensure_ascii=False) + "\n", "utf-8")
    console.print(
        f"{recipe['parameters']:,} parameters, {accuracy:.2%} of held-out generated strokes right, "
        f"temperature {heat:.2f}, ONNX within {recipe['parity_with_torch']:.1e} of torch, "
        f"{recipe['minutes']} minutes"
    )
    console.print(f"wrote {target}")
    return 0 if np.isfinite(heat) and recipe["parity_with_torch"] < 1e-4 else 1


@contextmanager
def _progress(console: Console) -> Generator[Callable[[str, float, str], None]]:
    """Tells how far each stage is: bars on a terminal, a line every tenth in a log."""
    if not console.is_terminal:
        told: dict[str, int] = {}

        def tell(stage: str, share: float, note: str) -> None:
            tenth = int(10 * share)
            if told.get(stage) != tenth:
                told[stage] = tenth
                console.print(f"{stage} {10 * tenth} % {note}")

        yield tell
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[note]}"))
    with Progress(*columns, TimeElapsedColumn(), TimeRemainingColumn(), console=console) as bars:
        stages: dict[str, TaskID] = {}

        def draw(stage: str, share: float, note: str) -> None:
            if stage not in stages:
                stages[stage] = bars.add_task(stage, total=1.0, note="")
            bars.update(stages[stage], completed=share, note=note)

        yield draw


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="inklined train",
        description="Trains the learned recognizer's net from generated ink alone and exports it as ONNX.",
        epilog="example: inklined train --seed 1 --out my-net.onnx",
    )
    parser.add_argument("--seed", type=int, default=1, help="everything follows from it (default 1)")
    parser.add_argument("--strokes", type=int, default=200_000, help="generated strokes to train on")
    parser.add_argument("--epochs", type=int, default=RULE.epochs, help="times each stroke is looked at")
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1, help="processor cores to use")
    parser.add_argument(
        "--out", default=str(WEIGHTS), help="the ONNX file to write (default: the shipped one)"
    )
    options = parser.parse_args(arguments)
    for name, least in (("strokes", 1), ("epochs", 1), ("threads", 1), ("seed", 0)):
        if getattr(options, name) < least:
            parser.error(f"--{name} {getattr(options, name)}: it must be at least {least}")
    return options


if __name__ == "__main__":
    sys.exit(main())
