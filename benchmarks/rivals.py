"""The published rivals, taught by generated ink and by people's: how much of strangers' ink they read, and how quickly.

    INKLINED_REAL_INK=FOLDER python benchmarks/rivals.py --draws 5 --json rivals.json

Real ink is FOLDER/shapes-dev.jsonl.gz (or --ink FILE). Rows are drawings of one symbol, in one stroke or several, and are
classified whole, as the papers have it (dots are told by their size). Taught by people: so many rows a kind by writers drawn at random, the others'
rows are read; mean over the draws and a 95 % interval of that mean (Student's t). Taught by generated ink: once, all rows are read.
"Five" is balanced accuracy over single strokes of circle, polygon, wire, spring and mathematics, "all" over all rows
and labels. Times are milliseconds of CPU a stroke on one thread, one stroke a call, each rival with the templates it has in that row, and
beside them dollarpy with as many templates as $P.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import thread_time
from typing import Any

import numpy as np
from scipy.stats import t as student
from threadpoolctl import threadpool_limits

from evaluation.lessons import lesson
from evaluation.metrics.strokes import score
from evaluation.rivals import generated_samples, rival, taught
from evaluation.strangers import strangers
from evaluation.stroke_contest import DIAGRAM_KINDS
from recognizer.calibrated import Calibrated
from recognizer.claims import Claim, claim_for
from recognizer.geometric.context import dots
from recognizer.published import PUBLISHED
from recognizer.samples import Sample
from sketch.files import jsonl
from sketch.files.jsonl import Row
from sketch.geometry import diagonal
from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind

SIZES = (1, 5, 10)
"""Real rows of each kind that are learnt from."""
STRANGERS = 300
"""Generated drawings of no kind, of a seed that nothing was calibrated with."""
SEED_OF_STRANGERS = 71_003


@dataclass(frozen=True, slots=True)
class Reading:
    """One rival on one set of rows: shares, and None for what was not there."""

    five: float | None
    every: float | None
    ece: float | None


def main() -> None:
    parser = argparse.ArgumentParser(description="The published rivals on strangers' ink.")
    folder = os.environ.get("INKLINED_REAL_INK")
    parser.add_argument("--ink", type=Path, default=Path(folder, "shapes-dev.jsonl.gz") if folder else None)
    parser.add_argument(
        "--draws", type=int, default=5, help="random draws of writers for each number of rows"
    )
    parser.add_argument(
        "--rows", type=int, default=800, help="rows read in each draw, at most, drawn at random"
    )
    parser.add_argument("--recognizer", nargs="*", default=list(PUBLISHED), choices=list(PUBLISHED))
    parser.add_argument("--strokes", type=int, default=60, help="strokes timed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    if options.ink is None:
        parser.error("name a file of labelled ink with --ink, or its folder in INKLINED_REAL_INK")
    rows = [row for row in jsonl.read(options.ink).rows if row.label in STROKE_KINDS and len(row.ink)]
    with threadpool_limits(limits=1):
        document = {
            "ink": options.ink.name,
            "rows": len(rows),
            "seed": options.seed,
            "draws": options.draws,
            "rows_a_draw": options.rows,
            "generated": from_generated(options.recognizer, rows, options.strokes, options.seed),
            "people": from_people(options.recognizer, rows, options.draws, options.rows, options.seed),
        }
    print(as_text(document))
    if options.json:
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def from_generated(names: Sequence[str], rows: Sequence[Row], strokes: int, seed: int) -> dict[str, Any]:
    """Each rival as it comes: what it reads of all rows, what it rejects, and the time it takes."""
    kinds = generated_samples(40, SEED_OF_STRANGERS)
    foreign = strangers(STRANGERS, SEED_OF_STRANGERS)
    timed = [sample.ink for sample in generated_samples(strokes // 7 + 1, SEED_OF_STRANGERS + seed)][:strokes]
    found: dict[str, Any] = {}
    for name in names:
        ready = rival(name)
        assert isinstance(ready, Calibrated)
        reading = read(ready, rows)
        ours, theirs = ready.strangeness([sample.ink for sample in kinds]), ready.strangeness(foreign)
        found[name] = {
            "five": reading.five,
            "all": reading.every,
            "ece": reading.ece,
            "kinds_rejected": share(ready.classify([sample.ink for sample in kinds])),
            "strangers_rejected": share(ready.classify(foreign)),
            "strangers_kept_at_95": float((theirs <= np.quantile(ours, 0.95)).mean()),
            "ms": milliseconds(ready.recognize, timed),
        }
        print(f"taught by generated ink: {name}", flush=True)
    if (peer := dollarpy(generated_samples(PUBLISHED["dollar-p"].samples, seed))) is not None:
        found["dollarpy"] = {"ms": milliseconds(peer, timed[:6])}
    return found


def from_people(
    names: Sequence[str], rows: Sequence[Row], draws: int, most: int, seed: int
) -> dict[str, Any]:
    """For each number of rows a kind and each rival the mean over the draws, and half its 95 % interval."""
    found: dict[str, Any] = {}
    for size in SIZES:
        readings: dict[str, list[Reading]] = {name: [] for name in names}
        for draw in range(draws):
            rng = np.random.default_rng([seed, size, draw])
            learnt = lesson(rows, size, rng)
            others = [row for row in rows if not learnt.taught_by(row)]
            read_rows = [others[k] for k in rng.permutation(len(others))[:most].tolist()]
            for name in names:
                readings[name].append(read(taught(name, learnt.samples, seed), read_rows))
            print(f"taught by people: {size} a kind, draw {draw + 1} of {draws}", flush=True)
        found[str(size)] = {
            name: {
                "five": mean([reading.five for reading in many]),
                "all": mean([reading.every for reading in many]),
            }
            for name, many in readings.items()
        }
    return found


def read(ready: Calibrated, rows: Sequence[Row]) -> Reading:
    """What a rival makes of rows, each classified whole."""
    labels: list[StrokeKind] = [kind for row in rows for kind in STROKE_KINDS if kind == row.label]
    dot = [len(row.ink) == 1 and bool(dots(row.ink, sizes(row.ink))[0]) for row in rows]
    drawn = iter(ready.classify([row.ink for row, tiny in zip(rows, dot, strict=True) if not tiny]))
    claims = [claim_for("tap", 0.9) if tiny else next(drawn) for tiny in dot]
    five = [k for k, row in enumerate(rows) if len(row.ink) == 1 and labels[k] in DIAGRAM_KINDS]
    every = score(labels, claims)
    single = score([labels[k] for k in five], [claims[k] for k in five])
    return Reading(single.balanced_accuracy, every.balanced_accuracy, single.ece)


def sizes(ink: Ink) -> FloatArray:
    return np.array([diagonal(stroke.points) for stroke in ink])


def share(claims: Sequence[Claim]) -> float:
    return sum(claim.rejected for claim in claims) / len(claims)


def mean(values: Sequence[float | None]) -> tuple[float, float]:
    """Mean, and half the 95 % interval of the mean by Student's t (0 for a single value)."""
    known = np.array([value for value in values if value is not None])
    if len(known) < 2:
        return float(known.mean()), 0.0
    half = float(student.ppf(0.975, len(known) - 1)) * float(known.std(ddof=1)) / len(known) ** 0.5
    return float(known.mean()), half


def milliseconds(recognize: Callable[[Ink], object], inks: Sequence[Ink]) -> float:
    """Median CPU time of a call with one stroke."""
    for ink in inks[:3]:
        recognize(ink)
    spent: list[float] = []
    for ink in inks:
        begun = thread_time()
        recognize(ink)
        spent.append(1000 * (thread_time() - begun))
    return float(np.median(spent))


def dollarpy(samples: Sequence[Sample]) -> Callable[[Ink], object] | None:
    """dollarpy with these templates; None where it is not installed."""
    try:
        peer: Any = importlib.import_module("dollarpy")
    except ImportError:
        return None

    def points(ink: Ink) -> list[Any]:
        return [peer.Point(x, y, k) for k, stroke in enumerate(ink) for x, y in stroke.points.tolist()]

    templates = [(sample.kind, points(sample.ink)) for sample in samples]

    def recognize(ink: Ink) -> object:
        # It adds points to the templates that it is given, so that they would grow from call to call.
        fresh = [peer.Template(kind, list(drawn)) for kind, drawn in templates]
        return peer.Recognizer(fresh).recognize(points(ink))

    return recognize


def as_text(document: dict[str, Any]) -> str:
    """The figures as two tables."""
    lines = [
        f"{document['rows']} rows of {document['ink']}; shares in %",
        "",
        "Taught by generated ink, all rows read. Rejected: of generated kinds, of generated strangers; strangers kept where",
        "95 % of the kinds are kept.",
        "",
        f"{'':16}{'five':>7}{'all':>7}{'ECE':>7}{'kinds':>8}{'strangers':>11}{'kept at 95':>12}{'ms':>9}",
    ]
    for name, figure in document["generated"].items():
        shares = [
            figure.get(key)
            for key in ("five", "all", "ece", "kinds_rejected", "strangers_rejected", "strangers_kept_at_95")
        ]
        cells = "".join(
            f"{'' if value is None else f'{100 * value:.1f}':>{width}}"
            for value, width in zip(shares, (7, 7, 7, 8, 11, 12), strict=True)
        )
        lines.append(f"{name:16}{cells}{figure['ms']:9.3f}")
    lines += [
        "",
        f"Taught by so many rows of people a kind, {document['draws']} draws of writers, up to {document['rows_a_draw']} rows of other writers read:",
        "mean ± half the 95 % interval.",
        "",
        f"{'':16}"
        + "".join(f"{f'five, {size}':>14}" for size in SIZES)
        + "".join(f"{f'all, {size}':>14}" for size in SIZES),
    ]
    for name in document["people"][str(SIZES[0])]:
        cells = ""
        for key in ("five", "all"):
            for size in SIZES:
                middle, half = document["people"][str(size)][name][key]
                cells += f"{f'{100 * middle:.1f} ± {100 * half:.1f}':>14}"
        lines.append(f"{name:16}{cells}")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
