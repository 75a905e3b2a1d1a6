"""`python -m training.handwriting`: remakes what the reader of mathematics knows from nothing but a seed.

Writes signs.onnx, relations.onnx, language.npz, clouds.npz, confidence.json and card.json. Stopped, it goes on with what is in its
working folder when it is started again with the same options.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from datetime import date
from pathlib import Path

import numpy as np
import torch
from rich.console import Console

from data_gen.writing.grammars import mixed
from recognizer.handwriting.cloud import drawing, packed, size
from recognizer.handwriting.confidence import Curve
from recognizer.handwriting.kernels import CHANNELS, IMAGES, NUMBERS, POINTS, SIDE
from recognizer.handwriting.language import counted, language
from recognizer.handwriting.language import packed as packed_language
from recognizer.handwriting.reader import Reader
from recognizer.handwriting.relations import Relations
from recognizer.handwriting.signs import NetSigns
from sketch.ink import Ink
from sketch.writing.signs import SIGNS
from training.handwriting import relations
from training.handwriting.calibrate import calibrate
from training.handwriting.corpus import JUNK, Example, laid_out, shards
from training.handwriting.export import exported, save
from training.handwriting.fit import RULE, fit
from training.handwriting.looks import looks
from training.progress import Tell, progress

HERE = Path(__file__).parents[2] / "recognizer" / "handwriting" / "weights"
SHARD = 1000
"""Lines in a shard."""
TEMPLATES = 8
"""Of each sign for the rival."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Makes the corpus, trains, exports and writes the figures beside the weights."""
    options = _options(arguments)
    torch.set_num_threads(options.threads)
    begun = time.monotonic()
    work, out = Path(options.work), Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    with progress(Console(stderr=True)) as tell:
        corpus: list[Example] = []
        count = -(-options.lines // SHARD)
        for done, some in enumerate(shards(work, options.seed, count, min(SHARD, options.lines)), start=1):
            corpus += some
            tell("lines", done / count, "")
        rng = np.random.default_rng([options.seed, 10**6])
        rows = [mixed(rng) for _ in range(options.sentences)]
        (out / "language.npz").write_bytes(packed_language(*counted(rows)))
        tell("language", 1.0, "")
        laid = [
            laid_out(np.random.default_rng([options.seed, 10**8, index])) for index in range(options.related)
        ]
        related = relations.fit(laid, options.seed)
        save(
            exported(related, {"pairs": torch.zeros(4, relations.FEATURES)}, "scores"), out / "relations.onnx"
        )
        tell("relations", 1.0, "")
        (out / "clouds.npz").write_bytes(templates(corpus, options.seed))
        rule = replace(RULE, epochs=options.epochs)
        kept = f"signs-{options.seed}-{len(corpus)}-{options.epochs}"
        net = fit(corpus, options.seed, rule, _telling(tell, "signs"), work / f"{kept}.pt")
        shown = {
            "sequence": torch.zeros(4, CHANNELS, POINTS),
            "images": torch.zeros(4, IMAGES, SIDE, SIDE),
            "numbers": torch.zeros(4, NUMBERS),
        }
        save(exported(net, shown, "scores"), out / "signs.onnx")
        save(looks(), out / "looks.onnx")
        curve, read = calibrate(_reader(out), options.judged, options.seed)
        (out / "confidence.json").write_text(json.dumps(asdict(curve), indent=1) + "\n", "utf-8")
        tell("confidence", 1.0, "")
    card = {
        "command": f"python -m training.handwriting --seed {options.seed} --lines {options.lines} --epochs {options.epochs}",
        "seed": options.seed,
        "lines": len(corpus),
        "signs": list(SIGNS),
        "epochs": options.epochs,
        "rule": asdict(replace(RULE, epochs=options.epochs)),
        "parameters": sum(p.numel() for p in net.parameters()) + sum(p.numel() for p in related.parameters()),
        "lines_of_hard_hands_read_right": round(read, 4),
        "minutes_of_this_start": round((time.monotonic() - begun) / 60, 1),
        "torch": torch.__version__,
        "date": date.today().isoformat(),
    }
    (out / "card.json").write_text(json.dumps(card, indent=1, ensure_ascii=False) + "\n", "utf-8")
    return 0


def _telling(tell: Tell, stage: str) -> Callable[[float, float], None]:
    return lambda share, loss: tell(stage, share, f"loss {loss:.3f}")


def _reader(folder: Path) -> Reader:
    """The reader with what was just trained. Its confidence is not asked for yet."""
    kept = folder / "confidence.json"
    if not kept.exists():
        kept.write_text(json.dumps(asdict(Curve(0.0, 1.0, 1.0, 0.0))), "utf-8")
    with np.load(folder / "language.npz") as tables:
        usual = language(tables["follow"], tables["start"])
    related = Relations((folder / "relations.onnx").read_bytes())
    return Reader(NetSigns((folder / "signs.onnx").read_bytes()), related, usual)


def templates(corpus: Sequence[Example], seed: int) -> bytes:
    """Clouds of each sign and the spread of its size, for the rival."""
    rng = np.random.default_rng([seed, 10**7])
    found: dict[int, list[Ink]] = {}
    sizes: dict[int, list[np.ndarray[tuple[int], np.dtype[np.float64]]]] = {}
    for one in corpus:
        for group, sign in zip(one.groups, one.signs, strict=True):
            if sign != JUNK:
                sizes.setdefault(sign, []).append(size(one.line, group))
                if len(found.setdefault(sign, [])) < TEMPLATES and rng.random() < 0.5:
                    found[sign].append(drawing(one.line, group))
    labels = np.array([sign for sign in sorted(found) for _ in found[sign]], dtype=np.int64)
    spread = np.zeros((len(SIGNS), 4))
    spread[:, 2:] = 1.0
    for sign, seen in sizes.items():
        spread[sign, :2] = np.mean(seen, axis=0)
        spread[sign, 2:] = np.std(seen, axis=0) + 0.15
    return packed([ink for sign in sorted(found) for ink in found[sign]], labels, spread)


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m training.handwriting", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--lines", type=int, default=36_000, help="generated lines to learn from")
    parser.add_argument("--epochs", type=int, default=RULE.epochs)
    parser.add_argument("--related", type=int, default=16_000, help="lines that relations are learnt from")
    parser.add_argument(
        "--sentences", type=int, default=20_000, help="expressions that the language is counted in"
    )
    parser.add_argument("--judged", type=int, default=1_600, help="lines that confidence is fitted on")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument(
        "--work", default=".inklined-train/handwriting", help="where what is unfinished is kept"
    )
    parser.add_argument("--out", default=str(HERE))
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
