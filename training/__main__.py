"""`python -m training`: remakes the net from nothing but a seed; by several processes with `torchrun -m training`."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from dataclasses import asdict
from datetime import date
from pathlib import Path

import numpy as np
import torch
from rich.console import Console

from data_gen.authored import NAMES
from recognizer.learned.recognizer import WEIGHTS
from sketch.page import STROKE_KINDS
from training.calibrate import Calibration, calibrate, false_positives
from training.dataset import Corpus, corpus_of, make_corpus
from training.drawings import FIRST_UNSEEN, NONE, Plan, alone, doodles_of
from training.export import export
from training.fit import RULE, FitRule, fit, say
from training.nets import PageNet, parameters_of
from training.parity import parity
from training.processes import Processes, processes
from training.progress import Tell, progress
from training.reader import RawReader

WORK = Path(".inklined-train")
"""Where corpus and checkpoint are kept while training runs, so that it can be taken up again."""

CHECKPOINT = "checkpoint.pt"

HELD_OUT = Plan(alone=10_000, strewn=800, pages=600, doodles=2_000, arrows=400, signs=60)
"""Drawings that the net is calibrated on; their seed, and so their writers, are others."""


def main(arguments: list[str] | None = None) -> int:
    """Makes the corpus, trains, calibrates, exports and writes the card's figures beside the weights."""
    options = _options(arguments)
    with processes() as among:
        return _trained(options, among)


def _trained(options: argparse.Namespace, among: Processes) -> int:
    """The same in one of some processes."""
    console = Console(stderr=True, quiet=not among.leads)
    begun = time.monotonic()
    torch.set_num_threads(options.threads)
    plan = Plan().scaled(options.drawings / Plan().total)
    held = HELD_OUT.scaled(min(1.0, 4 * options.drawings / Plan().total))
    work = Path(options.work)
    key: dict[str, object] = {
        "seed": options.seed,
        "epochs": options.epochs,
        "plan": asdict(plan),
        "kinds": list(STROKE_KINDS),
        **({"processes": among.count} if among.count > 1 else {}),
    }
    corpus_file = work / (f"corpus-{among.rank}.npz" if among.count > 1 else "corpus.npz")
    _prepare(work, key, corpus_file, among, resume=options.resume)
    with progress(console) as tell:
        corpus = _corpus(corpus_file, plan, options.seed, options.threads, among, tell)
        strokes = among.total(len(corpus.kind))
        trained = time.monotonic()
        net = fit(
            corpus,
            options.seed,
            FitRule(epochs=options.epochs),
            progress=lambda share, loss: tell("training", share, f"loss {loss:.3f}"),
            checkpoint=work / CHECKPOINT,
            among=among,
        )
        fitted = time.monotonic()
        if not among.leads:
            return 0
        unseen = make_corpus(
            held, options.seed + 1_000, options.threads, lambda s: tell("held-out ink", s, "")
        )
    found, figures = _judged(net, unseen, options.seed, held)
    target = Path(options.out)
    recipe = {
        "command": f"inklined train --seed {options.seed} --drawings {options.drawings} --epochs {options.epochs}",
        "seed": options.seed,
        "drawings": plan.total,
        "strokes": strokes,
        "epochs": options.epochs,
        **({"processes": among.count} if among.count > 1 else {}),
        "kinds": list(STROKE_KINDS),
        "parameters": parameters_of(net),
        "temperature": round(found.temperature, 4),
        "reject_above": round(found.reject_above, 5),
        **figures,
        "date": date.today().isoformat(),
        "torch": torch.__version__,
    }
    reader = RawReader(net, found.temperature).eval()
    export(reader, target, {"inklined": json.dumps(recipe)})
    recipe["parity_with_torch"] = parity(
        reader, target, seed=options.seed + 2_000, strokes=min(10_000, plan.total)
    )
    recipe["minutes_of_fitting"] = round((fitted - trained) / 60, 2)
    recipe["minutes"] = round((time.monotonic() - begun) / 60, 2)
    target.with_suffix(".json").write_text(json.dumps(recipe, indent=2, ensure_ascii=False) + "\n", "utf-8")
    for name, value in recipe.items():
        console.print(f"{name}: {value}", markup=False)
    console.print(f"wrote {target}")
    return 0 if np.isfinite(found.temperature) and recipe["parity_with_torch"] < 1e-4 else 1


def _prepare(work: Path, key: dict[str, object], corpus: Path, among: Processes, resume: bool) -> None:
    """An empty place to work in; with `resume` the one there, if it is of the same training."""
    note = work / (f"training-{among.rank}.json" if among.count > 1 else "training.json")
    text = json.dumps(key, sort_keys=True)
    if resume:
        if not note.exists():
            sys.exit(f"nothing to resume in {work}: it holds no {note.name}; leave --resume out to begin")
        if note.read_text("utf-8") != text:
            sys.exit(f"{work} holds another training: {note.read_text('utf-8')}; asked for is {text}")
        return
    work.mkdir(parents=True, exist_ok=True)
    corpus.unlink(missing_ok=True)
    if among.leads:
        (work / CHECKPOINT).unlink(missing_ok=True)
    note.write_text(text, "utf-8")


def _corpus(file: Path, plan: Plan, seed: int, jobs: int, among: Processes, tell: Tell) -> Corpus:
    """This process's part of the corpus, made unless it is there."""
    if file.exists():
        return Corpus.load(file)
    corpus = make_corpus(
        plan, seed, jobs, lambda share: tell("generating", share, ""), rank=among.rank, of=among.count
    )
    fresh = file.with_name(f"fresh-{file.name}")
    corpus.save(fresh)
    fresh.replace(file)
    return corpus


def _judged(net: PageNet, held: Corpus, seed: int, plan: Plan) -> tuple[Calibration, dict[str, float]]:
    """Calibration on held-out ink, and how the net does there."""
    said = say(net, held)
    known = said.kind >= 0
    right = said.logits.argmax(axis=1) == said.kind
    odd = doodles_of(0, 4 * plan.doodles, seed + 3_000, plan, unseen=True)
    first = [item for item in odd if NAMES[item.count] in FIRST_UNSEEN]
    strange, strange_first = (
        say(net, corpus_of([alone(item) for item in items], np.random.default_rng(seed))).strange
        for items in (odd, first)
    )
    usual = said.strange[known & said.alone]
    return calibrate(said), {
        "held_out_strokes_right_alone": round(float(right[known & said.alone].mean()), 4),
        "held_out_strokes_right_in_company": round(float(right[known & ~said.alone].mean()), 4),
        "held_out_pairs_right": round(float(((said.together > 0) == (said.paired > 0.5)).mean()), 4),
        "doodles_of_unseen_families_kept_at_95_percent": round(false_positives(usual, strange), 4),
        "doodles_of_the_first_four_unseen_kept_at_95_percent": round(
            false_positives(usual, strange_first), 4
        ),
        "doodles_of_seen_families_kept_at_95_percent": round(
            false_positives(usual, said.strange[said.kind == NONE]), 4
        ),
    }


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="inklined train",
        description="Trains the learned recognizer's net from generated ink alone and exports it as ONNX.",
        epilog="example: inklined train --seed 1 --out my-net.onnx; by several processes: "
        "torchrun --standalone --nproc-per-node 2 -m training --seed 1 --threads 1 --out my-net.onnx",
    )
    parser.add_argument("--seed", type=int, default=1, help="everything follows from it (default 1)")
    parser.add_argument(
        "--drawings",
        type=int,
        default=Plan().total,
        help=f"generated drawings to train on (default {Plan().total:,})",
    )
    parser.add_argument("--epochs", type=int, default=RULE.epochs, help="times each stroke is looked at")
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1, help="processor cores to use")
    parser.add_argument(
        "--work", default=str(WORK), help=f"where corpus and checkpoint are kept (default {WORK})"
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="take up the training that was stopped, after its last whole epoch",
    )
    parser.add_argument(
        "--out", default=str(WEIGHTS), help="the ONNX file to write (default: the shipped one)"
    )
    options = parser.parse_args(arguments)
    for name, least in (("drawings", 100), ("epochs", 1), ("threads", 1), ("seed", 0)):
        if getattr(options, name) < least:
            parser.error(f"--{name} {getattr(options, name)}: it must be at least {least}")
    return options


if __name__ == "__main__":
    sys.exit(main())
