"""Where a reader of mathematics goes wrong: in sharing out the strokes, in naming the signs or in how they lie.

Each row is read three times: as it is; told which strokes are a sign; and told which sign each is, too. What the second reading
puts right was the fault of sharing out, what the third puts right that of the signs, and the rest is that of the layout.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from evaluation.handwriting import segmented, truth_of
from evaluation.metrics.mathematics import mistakes, signs, tokens
from recognizer.handwriting.line import Group, groups, line_of, spaced
from recognizer.handwriting.reader import Reader, Reading
from sketch.files.jsonl import Row as InkRow
from sketch.ink import FloatArray
from sketch.writing.rows import Row, latex, nodes_of
from sketch.writing.signs import FRACTION, NUMBER, ROOT

Told = Literal["nothing", "strokes", "signs"]
TOLD: tuple[Told, ...] = ("nothing", "strokes", "signs")
"""What a reader is told of the truth."""
NEVER = -30.0
"""Logarithm of the chance of what is known to be otherwise."""


@dataclass(slots=True)
class Errors:
    """Counts over rows: read right and with at most one mistake, by what was told; and of what kind the mistakes were."""

    rows: int = 0
    right: Counter[Told] = field(default_factory=Counter[Told])
    nearly: Counter[Told] = field(default_factory=Counter[Told])
    confused: Counter[tuple[str, str]] = field(default_factory=Counter[tuple[str, str]])
    """Signs with the right strokes and another name."""
    shared: Counter[str] = field(default_factory=Counter[str])
    """Signs whose strokes were shared out otherwise."""
    related: Counter[tuple[str, str]] = field(default_factory=Counter[tuple[str, str]])
    """How a sign hung and how it was read to hang, where true signs were told."""
    constructs: Counter[str] = field(default_factory=Counter[str])
    """Rows with a construct,"""
    failed: Counter[str] = field(default_factory=Counter[str])
    """and those of them whose layout was wrong though true signs were told."""


def errors(rows: Sequence[InkRow], reader: Reader) -> Errors:
    """The rows that have a truth and say which strokes are which sign, read with ever more of it told."""
    found = Errors()
    for row in rows:
        truth, symbols = truth_of(row), segmented(row)
        if truth is None or not symbols:
            continue
        found.rows += 1
        line = line_of([spaced(stroke) for stroke in row.ink])
        candidates = groups(line)
        scores = reader.signs.scores(line, candidates)
        for told in TOLD:
            reading = reader.settled(line, candidates, _told(candidates, scores, symbols, told))
            found.right[told] += latex(truth) == reading.latex
            found.nearly[told] += mistakes(truth, reading.row) <= 1
            if told == "nothing":
                for one in signs(symbols, reading.row):
                    if one.claim is None:
                        found.shared[one.truth] += 1
                    elif not one.right:
                        found.confused[one.truth, one.claim] += 1
            if told == "signs":
                _layout(truth, reading, found)
    return found


def _told(
    candidates: Sequence[Group], scores: FloatArray, symbols: Sequence[tuple[str, Group]], told: Told
) -> FloatArray:
    """The net's scores, corrected by what is told."""
    if told == "nothing":
        return scores
    truth = {tuple(sorted(strokes)): name for name, strokes in symbols}
    known = np.full(scores.shape, NEVER)
    for k, group in enumerate(candidates):
        name = truth.get(group)
        if name is None:
            known[k, -1] = 0.0
        elif told == "strokes" or name not in NUMBER:
            known[k, :-1] = scores[k, :-1] - np.logaddexp.reduce(scores[k, :-1])
        else:
            known[k, [NUMBER[name], NUMBER[FRACTION] if name == "-" else NUMBER[name]]] = np.log(0.5)
    return known


def _layout(truth: Row, reading: Reading, found: Errors) -> None:
    """Which relations and constructs went wrong."""
    here = _constructs(truth)
    found.constructs.update(here)
    if latex(truth) != reading.latex:
        found.failed.update(here)
        written, read = tokens(truth), tokens(reading.row)
        if [name for _, _, name in written] == [name for _, _, name in read]:
            for one, other in zip(written, read, strict=True):
                if one[:2] != other[:2]:
                    found.related[one[0], other[0]] += 1
        else:
            found.related["order of signs", "another"] += 1


def _constructs(row: Row) -> set[str]:
    nodes = list(nodes_of(row))
    found = {"any"}
    for name, there in (
        ("fraction", any(node.name == FRACTION for node in nodes)),
        ("root", any(node.name == ROOT for node in nodes)),
        ("degree of a root", any(node.name == ROOT and node.over for node in nodes)),
        ("subscript", any(node.sub for node in nodes)),
        ("exponent", any(node.sup for node in nodes)),
        ("both scripts", any(node.sub and node.sup for node in nodes)),
        ("script of a script", any(n.sub or n.sup for node in nodes for n in (*node.sub, *node.sup))),
        ("brackets", any(node.name in "()[]" for node in nodes)),
        ("point or comma", any(node.name in (".", ",") for node in nodes)),
    ):
        if there:
            found.add(name)
    return found
