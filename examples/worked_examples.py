"""The two worked examples of a sketch-based physics tutor, with right and wrong answers, as figures.

    python examples/worked_examples.py FOLDER

E6: a ball on an incline under a normal force that a student gives. The right one lets it roll, its speed a straight line
of slope g sin θ; nine tenths of it let it sink and bounce, eleven tenths throw it off. E7: a box on two wires with given
tensions. 5√2 N on each hold it where it is; otherwise it moves and a wire breaks. Lengths in m, speeds in m/s.
"""

from __future__ import annotations

import sys
from math import cos, sin
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from data_gen.diagrams.wires import TENSIONS
from data_gen.pages import meaning
from data_gen.problems import ANSWERS, problem
from physics.formula.meaning import read
from physics.formula.names import number_said
from physics.outcome import outcome
from physics.pipeline import Motion, move
from sketch.figures import COLOURS
from sketch.ink import FloatArray
from sketch.page import Sketch
from sketch.shapes import outline

SEED = 6


def incline(seed: int = SEED) -> Figure:
    """E6: the path of the ball's middle, its speed beside g sin θ t, and how high it is over the incline."""
    answers = ANSWERS["incline-and-ball"]
    drawn, axes = _columns(len(answers), graphs=2)
    for answer, (place, graph, height) in zip(answers, axes, strict=True):
        made = problem("incline-and-ball", answer, np.random.default_rng(seed))
        motion = move(meaning(made), made.seconds)
        ball = next(iter(made.expected.fates))
        share = {"right": "the right f_1", "low": "0.9 of it", "high": "1.1 of it"}[answer]
        _page(place, motion, ball, f"{share}: {outcome(motion).fates[ball]}")
        times, angle = motion.trajectory.times, _angle(motion.rectified)
        graph.plot(times, motion.trajectory.speed(ball), label="speed of the ball")
        graph.plot(times, -motion.scene.gravity[1] * sin(angle) * times, "k:", label="g sin θ t")
        height.plot(times, _height(motion, ball, angle), label="height over the incline")
    _labelled([row[1] for row in axes], "m/s")
    _labelled([row[2] for row in axes], "m")
    return drawn


def box(seed: int = SEED) -> Figure:
    """E7: above the path of the box's middle, below how far it has got."""
    drawn, axes = _columns(len(TENSIONS), graphs=1)
    for (answer, tensions), (place, graph) in zip(TENSIONS.items(), axes, strict=True):
        made = problem("box-on-two-wires", answer, np.random.default_rng(seed))
        motion = move(meaning(made), 1.0)
        label = next(iter(made.expected.fates))
        found = outcome(motion)
        broken = f"; {' and '.join(sorted(found.broken))} broke" if found.broken else ""
        written = " and ".join(tensions).replace(" sqrt(2)", "√2")
        _page(place, motion, label, f"{written} N: {found.fates[label]}{broken}")
        path = motion.trajectory.path(label)
        graph.plot(motion.trajectory.times, np.hypot(*(path - path[0]).T), label="way of the box")
    _labelled([row[1] for row in axes], "m")
    return drawn


def _columns(count: int, graphs: int) -> tuple[Figure, list[list[Axes]]]:
    """For each column a place for the page and the axes of so many graphs below it."""
    drawn = Figure(figsize=(4.2 * count, 3.6 + 2.6 * graphs), layout="constrained")
    axes = drawn.subplots(1 + graphs, count, height_ratios=(3, *[2] * graphs))
    return drawn, [list(axes[:, k]) for k in range(count)]


def _page(place: Axes, motion: Motion, label: str, title: str) -> None:
    """The corrected page and, dotted, where the body's middle goes."""
    for part in motion.rectified.components:
        place.plot(*(outline(part.shape).T / 100), color=COLOURS[part.kind])
    x, y = motion.trajectory.path(label).T
    place.plot(x, -y, "k.", markersize=3)
    place.set_title(title)
    place.set_aspect("equal")
    place.invert_yaxis()


def _labelled(graphs: list[Axes], unit: str) -> None:
    """With one scale for all of them."""
    low, high = min(one.get_ylim()[0] for one in graphs), max(one.get_ylim()[1] for one in graphs)
    for graph in graphs:
        graph.set_ylim(low, high)
        graph.set_xlabel("time (s)")
        graph.set_ylabel(unit)
        graph.legend(fontsize="small")


def _height(motion: Motion, label: str, angle: float) -> FloatArray:
    """How far a body has come away from the long side of the incline, m."""
    rises = -np.sign(motion.trajectory.path(label)[-1, 0] - motion.trajectory.path(label)[0, 0])
    way = motion.trajectory.path(label) - motion.trajectory.path(label)[0]
    return way @ np.array([-rises * sin(angle), cos(angle)])


def _angle(page: Sketch) -> float:
    """That the page says its incline has, radians."""
    meanings = read(page)
    (said,) = (one for one in meanings.said if one.name == "theta")
    angle = number_said(page, meanings, said)
    assert angle is not None
    return angle


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    incline().savefig(folder / "incline.svg")
    box().savefig(folder / "box.svg")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "figures"))
