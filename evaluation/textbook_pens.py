"""Textbook problems drawn by simulated pens: read by a recognizer, corrected and run, does the same happen as on
the page that was meant? Each bears its right answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from data_gen.diagrams.problem import Problem
from data_gen.pages import Page
from data_gen.pages import drawn as inked
from data_gen.problems import in_reading_order
from data_gen.textbook.roster import exercise
from evaluation.metrics.diagram import diagram_match
from evaluation.metrics.matching import match_components
from evaluation.metrics.motion import same_outcome
from evaluation.page_contest import claimed
from evaluation.parallel import Progress, Workers, in_parallel, silent
from evaluation.table import Cell, Table
from evaluation.textbook import Name
from physics.outcome import outcome
from physics.pipeline import move


@dataclass(frozen=True, slots=True)
class Penned:
    """One page in a recognizer's hands. same: what happens is what was meant; exact: read exactly so."""

    name: Name
    index: int
    recognizer: str
    same: bool
    exact: bool


def read_problems(
    names: Sequence[Name],
    pens: int,
    seed: int,
    recognizers: Sequence[str],
    workers: Workers = 1,
    progress: Progress = silent,
) -> tuple[Penned, ...]:
    """Every problem drawn by `pens` people, in the hands of every recognizer ("oracle" is one)."""
    tasks = [
        (name, seed, len(names) * pen + number, tuple(recognizers))
        for pen in range(pens)
        for number, name in enumerate(names)
    ]
    read = in_parallel(read_problem, tasks, workers, "Reading and moving pages", progress)
    return tuple(one for page in read for one in page)


def penned(name: Name, seed: int, index: int) -> Page:
    """The problem with its right answer, as a random writer draws it."""

    def meant(rng: np.random.Generator) -> Problem:
        made = exercise(*name, rng)
        return in_reading_order(made.answered(made.answers[0]))

    return inked(": ".join(name), seed, index, "right", meant)


def read_problem(task: tuple[Name, int, int, Sequence[str]]) -> list[Penned]:
    """One page, by its name, seed and index, in the hands of recognizers of some names."""
    name, seed, index, recognizers = task
    page = penned(name, seed, index)
    truth = outcome(move(page.truth, page.seconds))
    found: list[Penned] = []
    for recognizer in recognizers:
        claim = claimed(page, recognizer)
        seen = outcome(move(claim, page.seconds))
        same = same_outcome(match_components(page.truth, claim), truth, seen)
        found.append(Penned(name, index, recognizer, same, diagram_match(page.truth, claim).exact))
    return found


def pens_table(read: Sequence[Penned]) -> Table:
    """Shares of pages on which what happens is what was meant, by family and recognizer."""
    recognizers = tuple(dict.fromkeys(one.recognizer for one in read))
    families = list(dict.fromkeys(one.name[0] for one in read))

    def row(pages: Sequence[Penned]) -> tuple[Cell, ...]:
        cells = [Cell(str(len(pages) // max(len(recognizers), 1)))]
        for recognizer in recognizers:
            same = [one.same for one in pages if one.recognizer == recognizer]
            cells.append(Cell(f"{100 * sum(same) / len(same):.1f} %"))
        return tuple(cells)

    rows = [(family, *row([one for one in read if one.name[0] == family])) for family in families]
    return Table(
        "Drawn by simulated pens: the outcome that was meant",
        ("", "pages", *recognizers),
        (*rows, ("all", *row(read))),
    )


def pens_summary(read: Sequence[Penned]) -> dict[str, Any]:
    """For every recognizer the shares of pages read exactly, and of those that move as was meant."""
    found: dict[str, Any] = {}
    for recognizer in dict.fromkeys(one.recognizer for one in read):
        pages = [one for one in read if one.recognizer == recognizer]
        found[recognizer] = {
            "pages": len(pages),
            "outcome_correct": sum(one.same for one in pages) / len(pages),
            "read_exactly": sum(one.exact for one in pages) / len(pages),
        }
    return found
