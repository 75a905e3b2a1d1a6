"""How far correcting a page moves its shapes, and whether it brings them nearer to what was meant; and how long it
takes from a page to its scene.

    python benchmarks/rectification.py --pages 60 --json rectification.json

The generated pages are read by the oracle, which is told what each stroke is, so that nothing but the hand and the
fit is between what was meant and what is corrected. Ways are of vertices, centres and ends, in page units.
A page of at least 20 components is made of generated diagrams side by side, each vertex, centre and end off by
`--noise`; of each the best of some repeats counts, in seconds of this thread's own. The speed of the machine at
the time is told along with it: milliseconds for a hundred thousand products in plain Python, 4 on a quiet
machine of 2023.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from dataclasses import replace
from math import hypot
from pathlib import Path
from time import thread_time
from typing import assert_never

import numpy as np
from threadpoolctl import threadpool_limits

from data_gen.pages import meaning, pages
from data_gen.problems import PROBLEMS, problem
from evaluation.metrics.matching import match_components
from physics.build import build
from physics.rectify import Rectified, rectify
from physics.rectify.correction import points_of
from recognizer.interpret import interpret, notes_of
from recognizer.oracle import Oracle
from sketch.ink import FloatArray
from sketch.page import Association, Component, Expression, Sketch, label
from sketch.shapes import Arrow, Circle, Polygon, Shape, Spring, Wire

APART = 700.0
"""Page units from one diagram to the next on a crowded page."""


def main() -> None:
    parser = argparse.ArgumentParser(description="What correcting a page does to it, and how long it takes.")
    parser.add_argument("--pages", type=int, default=60)
    parser.add_argument("--crowded", type=int, default=30)
    parser.add_argument("--noise", type=float, default=1.5)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()

    moved = ways(options.pages, options.seed)
    with threadpool_limits(limits=1):
        spent = times(options.crowded, options.noise, options.repeats, options.seed)
    print(f"{options.pages} generated pages, read by the oracle, page units")
    for name, value in moved.items():
        print(f"  {name.replace('_', ' '):42}{value:9.2f}")
    print(f"{options.crowded} pages of 20 components and more, ms")
    for name, figures in spent.items():
        print(f"  {name:12}" + "".join(f"{key:>6}{value:7.2f}" for key, value in figures.items()))
    if options.json:
        document = {
            "pages": options.pages,
            "seed": options.seed,
            "noise": options.noise,
            "ways": moved,
            "times_ms": spent,
        }
        options.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def ways(count: int, seed: int) -> dict[str, float]:
    """What correction does to generated pages, on average."""
    corrected: list[Rectified] = []
    points = before = after = 0.0
    worst = 0
    for page in pages(count, seed):
        claim = interpret(page.truth.ink, Oracle(page.truth), notes_of(page.truth))
        one = rectify(claim)
        corrected.append(one)
        points += sum(len(points_of(part.shape)) for part in claim.components)
        was, now = _from_truth(page.truth, claim), _from_truth(page.truth, one.sketch)
        before, after, worst = before + was, after + now, worst + int(now > was)
    total = sum(one.displacement for one in corrected)
    return {
        "displacement_of_a_page": total / count,
        "displacement_of_a_point": total / points,
        "farthest_on_a_page": float(np.mean([one.farthest for one in corrected])),
        "farthest_of_all": max(one.farthest for one in corrected),
        "corrections_on_a_page": float(np.mean([len({c.key for c in one.corrections}) for one in corrected])),
        "a_point_from_what_was_meant_as_read": before / points,
        "a_point_from_what_was_meant_as_corrected": after / points,
        "pages_farther_from_it_than_they_were_read": float(worst),
    }


def _from_truth(truth: Sketch, sketch: Sketch) -> float:
    """The summed distance of a page's vertices, centres and ends from the nearest that was meant."""
    pairs = match_components(truth, sketch)
    total = 0.0
    for meant, found in pairs.items():
        goals = points_of(truth.component(meant).shape)
        total += sum(
            min(hypot(x - u, y - v) for u, v in goals) for x, y in points_of(sketch.component(found).shape)
        )
    return total


def times(count: int, noise: float, repeats: int, seed: int) -> dict[str, dict[str, float]]:
    """p50 and p95 over crowded pages, ms; and the machine's speed."""
    crowd = [crowded(seed, index, noise) for index in range(count)]
    build(rectify(crowd[0]).sketch)  # warm-up
    spent: dict[str, list[float]] = {"rectify": [], "build": []}
    for sketch in crowd:
        corrected = rectify(sketch)
        one = _best(lambda page=sketch: rectify(page), repeats)
        other = _best(lambda page=corrected: build(page.sketch, page.meanings), repeats)
        spent["rectify"].append(one)
        spent["build"].append(other)
    spent["both"] = [one + other for one, other in zip(spent["rectify"], spent["build"], strict=True)]
    figures: dict[str, dict[str, float]] = {}
    for name, values in spent.items():
        p50, p95 = np.percentile(values, [50, 95]).tolist()
        figures[name] = {"p50": p50, "p95": p95}
    figures["machine"] = {"ms": _best(_products, 5)}
    return figures


def _best(work: Callable[[], object], repeats: int) -> float:
    taken: list[float] = []
    for _ in range(repeats):
        start = thread_time()
        work()
        taken.append(1000 * (thread_time() - start))
    return min(taken)


def _products() -> None:
    for number in range(100_000):
        _ = number * number


def crowded(seed: int, index: int, noise: float) -> Sketch:
    """Diagrams side by side, at least 20 components, as a hand leaves them."""
    rng = np.random.default_rng([seed, index])
    parts: list[Component] = []
    expressions: list[Expression] = []
    associations: list[Association] = []
    for turn in range(len(PROBLEMS)):
        if len(parts) >= 20:
            break
        one = meaning(problem(PROBLEMS[(index + turn) % len(PROBLEMS)], "right", rng))
        names = {part.label: label(len(parts) + k) for k, part in enumerate(one.components)}
        aside = turn * APART
        parts += [
            replace(
                part,
                shape=_shaken(part.shape, aside, noise, rng),
                label=names[part.label],
                ends=tuple(None if end is None else names[end] for end in part.ends),
            )
            for part in one.components
        ]
        about = {association.expression for association in one.associations}
        for number, expression in enumerate(one.expressions):
            if number in about:  # what holds for the whole page would hold for all diagrams
                associations += [
                    Association(
                        len(expressions), names[said.component], (said.anchor[0] + aside, said.anchor[1])
                    )
                    for said in one.associations
                    if said.expression == number
                ]
                expressions.append(expression)
    return Sketch(components=tuple(parts), expressions=tuple(expressions), associations=tuple(associations))


def _shaken(shape: Shape, aside: float, noise: float, rng: np.random.Generator) -> Shape:
    there = np.array(points_of(shape)) + (aside, 0.0) + noise * rng.normal(size=(len(points_of(shape)), 2))
    match shape:
        case Circle():
            return replace(shape, centre=_pair(there[0]))
        case Polygon():
            return Polygon(there)
        case Spring() | Wire() | Arrow():
            return replace(shape, start=_pair(there[0]), end=_pair(there[1]))
        case _:
            assert_never(shape)


def _pair(values: FloatArray) -> tuple[float, float]:
    return (float(values[0]), float(values[1]))


if __name__ == "__main__":
    main()
