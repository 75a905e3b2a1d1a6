"""`inklined compile`: machine code for this machine, made before anybody waits for it.

The engine, the pen, the geometric recognizer and the reader of handwriting compile their inner loops when these are first needed, one after
another. Here they are needed all at once, each in a process of its own, so that every core works. What the studio
needs to set a first drawing in motion is half of it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from physics.trajectory import Mode


def register(app: typer.Typer) -> None:
    """Adds the command."""
    app.command("compile", epilog="Example: inklined compile")(compile_all)


def compile_all(
    studio: Annotated[
        bool, typer.Option("--studio", help="Only what the studio needs for a first drawing.")
    ] = False,
) -> None:
    """Compile for this machine what runs fast: once, in all cores, instead of when it is first needed."""
    from joblib import Parallel, delayed

    from inklined.terminal import err, progress

    # The long ones first: the short ones fill the gaps.
    jobs: dict[str, Callable[[], None]] = {
        "the exact engine": _exact,
        "the ink generator": _pen,
        "the engine for crowds": _robust,
        "the geometric recognizer": _geometric,
        "the reader of handwriting": _reading,
    }
    if studio:
        jobs = {name: job for name, job in jobs.items() if job in (_exact, _geometric, _reading)}
    err.print(f"Compiling {', '.join(jobs)} for this machine: once, for a minute or two.", style="dim")
    with progress() as tell:
        done = Parallel(n_jobs=-1, return_as="generator_unordered")(
            delayed(_quietly)(job) for job in jobs.values()
        )
        for number, _ in enumerate(done, 1):
            tell("compiling", number, len(jobs))


def _quietly(job: Callable[[], None]) -> None:
    """Without saying that it compiles: that was said for all."""
    import logging

    logging.getLogger("inklined").setLevel(logging.ERROR)
    job()


def _pen() -> None:
    from data_gen.ideals import coil
    from data_gen.pages import pages
    from data_gen.strokes import doodles, items

    items(100, seed=1)
    doodles(5, seed=1)
    list(pages(6, seed=1, cluttered=True))
    coil((0.0, 0.0), (100.0, 0.0), 5.0, 20.0)


def _geometric() -> None:
    """Strokes of the sorts that are looked at differently."""
    import numpy as np

    from recognizer.geometric.recognizer import Geometric
    from sketch.ink import Ink, Stroke

    share = np.linspace(0.0, 1.0, 120)
    turn = 2 * np.pi * share
    paths = [
        np.column_stack([60 * np.cos(turn), 40 * np.sin(turn)]),  # a ring
        np.column_stack([300 * share, 0 * share]),  # a wire
        np.column_stack([300 * share + 15 * np.cos(8 * turn), 15 * np.sin(8 * turn)]),  # a coil
        np.column_stack([300 * share, 20 * np.abs(16 * share % 2 - 1)]),  # a zig-zag
        np.column_stack([60 * np.sign(np.cos(turn)), 60 * np.sign(np.sin(turn))]),  # a box
        np.column_stack(
            [
                np.interp(share, [0, 0.6, 0.8, 0.9, 1], [0, 100, 85, 100, 85]),
                np.interp(share, [0, 0.6, 0.8, 0.9, 1], [0, 0, 12, 0, -12]),
            ]
        ),  # an arrow
    ]
    beside = np.array([400.0, 0.0])
    strokes = (Stroke(path + k * beside, 0.001 * np.arange(120)) for k, path in enumerate(paths))
    several = Ink(tuple(strokes))
    Geometric().recognize(several)
    Geometric().recognize(Ink(several.strokes[:1]))  # what stands alone is measured by itself


def _reading() -> None:
    """A line of a fraction, a root and scripts, as it is meant: no pen is needed."""
    import numpy as np

    from data_gen.writers import sample_writer
    from data_gen.writing.habits import habits
    from data_gen.writing.typeset import written
    from recognizer.handwriting.reader import Reader
    from sketch.writing.rows import row_of

    rng = np.random.default_rng(1)
    row = row_of(r"x _ { 1 } ^ { 2 } = \frac { a } { \sqrt { b } }")
    Reader().read(written(row, habits(sample_writer(rng), rng), pen=False).ink.strokes)


def _exact() -> None:
    """All that happens on the six diagrams, with right and wrong answers."""
    import numpy as np

    from data_gen.pages import meaning
    from data_gen.problems import ANSWERS, PROBLEMS, problem
    from physics.pipeline import move

    _move("exact")
    for name in PROBLEMS:
        for answer in ANSWERS[name]:
            move(meaning(problem(name, answer, np.random.default_rng(1))), 1.0)


def _robust() -> None:
    _move("robust")


def _move(mode: Mode) -> None:
    """A ball that falls and runs into a box, which is drawn into the floor; a bob on a wire, a load on a spring, a push by a formula:
    bodies that meet, and bodies that do not."""
    import numpy as np
    from sympy import Symbol

    from physics.engine import simulate
    from physics.formula.program import compile_tree
    from physics.scene import (
        Anchor,
        Block,
        Body,
        Disc,
        Force,
        Material,
        Scene,
        SpringLink,
        WireLink,
        block_inertia,
        disc_inertia,
    )

    rough = Material(0.5, 0.4)
    square = ((-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.3, 0.3))
    plank = ((-9.0, -0.5), (9.0, -0.5), (9.0, 0.5), (-9.0, 0.5))
    round_ = disc_inertia(1.0, 0.2)
    bodies = (
        Body("floor", Block(plank), (0.0, -0.5), 1.0, block_inertia(1.0, plank), fixed=True, material=rough),
        Body("ball", Disc(0.2), (0.0, 0.3), 1.0, round_, velocity=(3.0, 0.0, 0.0), material=rough),
        Body("box", Block(square), (1.5, 0.29), 1.0, block_inertia(1.0, square), 0.01, material=rough),
        Body("bob", Disc(0.2), (-3.0, 2.0), 1.0, round_),
        Body("load", Disc(0.2), (-5.0, 2.0), 1.0, round_),
    )
    nothing, grows = (compile_tree(tree, lambda _: None) for tree in (0.0, Symbol("t") + Symbol("x")))
    scene = Scene(
        bodies,
        springs=(SpringLink("k", Anchor("load", (0.0, 0.0)), Anchor(None, (-5.0, 3.0)), 1.0, 50.0),),
        wires=(WireLink("T", Anchor("bob", (0.0, 0.0)), Anchor(None, (-4.0, 2.0)), 1.0),),
        forces=(Force("F", "load", grows, nothing),),
    )
    motion = simulate(scene, 1.0, mode=mode)
    motion.at(np.array([0.5]))
    assert motion.forces
