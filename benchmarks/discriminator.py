"""How well a forest tells people's ink from generated ink: the area under its ROC curve, label by label.

    INKLINED_REAL_INK=folder python benchmarks/discriminator.py --trees 300 --json discriminator.json

0.5 is ink that cannot be told apart, 1 ink that always can. Features are HBF49 (`recognizer.classical.hbf49`) after
the normalisation that a recognizer does too and no other: the drawing's box brought to unit size about the
origin, points spaced evenly; times and pressure are not looked at. People's rows of a label stand against as many
generated items of the label, as many of them in one stroke and in several; coils are left out, since no public set
has any. Forests are tried on writers (people) and
items (generated) that they were not grown on, in five parts; "all" is one forest for all labels, each given
the same weight. It is a measure of the generator's realism; nothing that ships learns from it.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from sklearn.ensemble import RandomForestClassifier
from sklearn.metrics import roc_auc_score
from sklearn.model_selection import GroupKFold

from data_gen.strokes import LabelledItem, items
from recognizer.classical.hbf49 import NAMES, hbf49
from sketch.files import jsonl
from sketch.files.jsonl import Row
from sketch.ink import FloatArray, Ink
from sketch.page import STROKE_KINDS, StrokeKind

PARTS = 5
"""Parts of the cross-validation."""


def main() -> None:
    parser = argparse.ArgumentParser(description="A forest tells people's ink from generated ink.")
    parser.add_argument("--trees", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--most", type=int, default=1000, help="rows of a label")
    parser.add_argument("--top", type=int, default=5, help="features to name for each label")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    folder = os.environ.get("INKLINED_REAL_INK")
    if folder is None:
        parser.error("INKLINED_REAL_INK must name the folder of people's ink (shapes-dev.jsonl.gz)")
    rows = jsonl.read(Path(folder) / "shapes-dev.jsonl.gz").rows
    trials = [
        trial(kind, rows, options.most, options.seed)
        for kind in STROKE_KINDS
        if any(row.label == kind for row in rows)
    ]
    found = {each.name: told_apart(each, options.trees, options.seed) for each in (*trials, together(trials))}
    for name, (auc, weights) in found.items():
        telling = ", ".join(f"{NAMES[k]} {weights[k]:.2f}" for k in np.argsort(-weights)[: options.top])
        print(f"{name:8} {auc:6.3f}   {telling}")
    if options.json:
        figures = {name: auc for name, (auc, _) in found.items()}
        options.json.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """features (n, 49); real (n,): whose ink; groups (n,): writers, or items; weights (n,)."""

    name: str
    features: FloatArray
    real: NDArray[np.bool_]
    groups: NDArray[np.int64]
    weights: FloatArray


def trial(kind: StrokeKind, rows: Sequence[Row], most: int, seed: int) -> Trial:
    """People's rows of a label, at most so many, and as many generated items."""
    people = [row for row in rows if row.label == kind]
    if len(people) > most:
        kept = np.random.default_rng(seed).choice(len(people), most, replace=False)
        people = [people[k] for k in kept]
    made = generated_like(people, kind, seed)
    names = [f"{row.extra.get('dataset')} {row.writer}" for row in people]
    writers = {name: number for number, name in enumerate(dict.fromkeys(names))}
    groups = [writers[name] for name in names] + [len(writers) + k for k in range(len(made))]
    return Trial(
        kind,
        hbf49([row.ink for row in people] + [Ink(item.strokes) for item in made]),
        np.arange(2 * len(people)) < len(people),
        np.array(groups),
        np.full(2 * len(people), 1 / len(people)),
    )


def generated_like(people: Sequence[Row], kind: StrokeKind, seed: int) -> list[LabelledItem]:
    """As many generated items of the label as there are rows, as many of them in one stroke and in several.
    Among springs zig-zags alone: the people's have no coils."""
    single = sum(len(row.ink) == 1 for row in people)
    wanted = {True: single, False: len(people) - single}
    found: list[LabelledItem] = []
    start = 0
    while sum(wanted.values()):
        for item in items(1000, seed, start, {kind: 1.0}):
            one = len(item.strokes) == 1
            if wanted[one] and (kind != "spring" or item.count > 0):
                wanted[one] -= 1
                found.append(item)
        start += 1000
    return found


def together(trials: Sequence[Trial]) -> Trial:
    """All labels, each of the same weight."""
    firsts = np.cumsum([0, *(int(each.groups.max()) + 1 for each in trials)])
    return Trial(
        "all",
        np.concatenate([each.features for each in trials]),
        np.concatenate([each.real for each in trials]),
        np.concatenate([each.groups + first for each, first in zip(trials, firsts, strict=False)]),
        np.concatenate([each.weights for each in trials]),
    )


def told_apart(trial: Trial, trees: int, seed: int) -> tuple[float, FloatArray]:
    """Area under the curve over rows that the forest was not grown on, and what it looked at, (49,)."""
    scores = np.zeros(len(trial.real))
    weights = np.zeros(trial.features.shape[1])
    for grown, tried in GroupKFold(PARTS).split(trial.features, trial.real, trial.groups):
        forest = RandomForestClassifier(trees, min_samples_leaf=2, random_state=seed)
        forest.fit(trial.features[grown], trial.real[grown], trial.weights[grown])
        scores[tried] = np.asarray(forest.predict_proba(trial.features[tried]))[:, 1]
        weights += forest.feature_importances_ / PARTS
    return float(roc_auc_score(trial.real, scores, sample_weight=trial.weights)), weights


if __name__ == "__main__":
    main()
