"""From signs on a line to rows: fractions and roots by what lies over, under and inside them, scripts by a beam.

Within a region (a line, a numerator, a radicand …) bars and roots are taken with the signs over, under or inside them
(`contain.py`), which are regions again; what is left is read from left to right (`search/beam.py`). Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from heapq import nlargest

import numpy as np

from recognizer.handwriting.contain import RULE as CONTAIN
from recognizer.handwriting.contain import Item, Items, Ranked, contained
from recognizer.handwriting.language import IS_LETTER, LINE, PART, STARTS, Language, Start
from recognizer.handwriting.relations import FIT, Relations, features, in_order, measures
from recognizer.handwriting.search.beam import (
    BAR,
    NORM,
    RIGHT,
    ROUND_CLOSES,
    ROUND_OPENS,
    SQUARE_CLOSES,
    SQUARE_OPENS,
    SUB,
    SUP,
    Indices,
    beam,
)
from sketch.ink import FloatArray
from sketch.writing.rows import Node, Row
from sketch.writing.signs import EXTENTS, NUMBER, SIGNS, extent


@dataclass(frozen=True, slots=True)
class LayoutRule:
    """Weights of what is believed, and what is looked at. Logarithms are natural."""

    relation: float = 1.0
    language: float = 0.5
    """Less than one: people write more than the grammar that the tables come from."""
    again: float = 0.5
    """Share of a sign's chance that comes from its having been used in the line already."""
    bare: float = 1.0
    """Weight of a sign's chance to have no script, against that of what follows it."""
    open: float = 2.5
    """Taken off for each bracket that has no partner in its row."""
    width: int = 12
    """States of the beam."""
    kept: int = 4
    """Readings of a region that are kept."""
    unlikely: float = 5.0
    """Choices of a sign this far below its best are not looked at,"""
    far: float = 7.0
    """nor relations this unlikely."""
    back: int = 10
    """Signs before a sign that it may hang on."""
    effort: int = 700
    """Items placed in regions of a line, over all ways to read them, after which fewer ways are tried; a line of 25 signs
    takes some 300."""
    scribble: float = 60.0
    """Taken off where no way is tried any more."""
    ends: float = 1.0
    """Weight of how seldom a sign is the last of its row."""
    fitting: float = 0.3
    """Weight of how well the extents of two signs fit their boxes."""
    subbed: float = 0.3
    supped: float = 0.0
    """Added for each script: people write more of them than the generator, and less steeply."""

    @property
    def weights(self) -> FloatArray:
        """As the beam takes them."""
        return np.array(
            [
                self.relation,
                self.language,
                self.again,
                self.bare,
                self.ends,
                self.open,
                -self.far,
                self.subbed,
                self.supped,
                self.fitting,
            ]
        )


RULE = LayoutRule()


class Layout:
    """Reads regions of one line, each of them once."""

    def __init__(
        self, scale: float, relations: Relations, language: Language, rule: LayoutRule = RULE
    ) -> None:
        self._scale, self._relations, self._language, self._rule = scale, relations, language, rule
        self._read: dict[tuple[Items, Start], list[Ranked]] = {}
        self._done = 0

    def arranged(self, items: Sequence[Item], start: Start = "line") -> list[Ranked]:
        """Readings of a region, the best first."""
        if not items:
            return [Ranked((), 0.0)]
        key = (tuple(items), start)
        if key not in self._read:
            effort = self._done / self._rule.effort
            if (
                effort > 3
            ):  # a scribble: what is taken for bars and roots in it is within one another without end
                return [Ranked(tuple(item.choices[0].node for item in items), -self._rule.scribble)]
            ways = contained(key[0], self._scale, self.arranged, _CONTAIN[min(int(effort), 2)])
            found = [ranked for way in ways for ranked in self._beam(way, start)]
            self._read[key] = nlargest(self._rule.kept, found, key=lambda ranked: ranked.score)
        return self._read[key]

    def _beam(self, unordered: Sequence[Item], start: Start) -> list[Ranked]:
        language, rule = self._language, self._rule
        self._done += len(unordered)
        items = [unordered[k] for k in in_order([item.place for item in unordered])]
        signs, kinds, scores, counts, reaches = _choices(items, rule)
        found, chosen, parents, hows = beam(
            signs,
            kinds,
            scores,
            counts,
            _table(items, reaches, self._scale, self._relations, rule),
            language.follow,
            language.letters,
            language.start[STARTS.index(start)],
            LINE if start == "line" else PART,
            IS_LETTER,
            _BRACKETS,
            rule.weights,
            rule.width,
        )
        return [
            Ranked(_row_of(items, chosen[k].tolist(), parents[k].tolist(), hows[k].tolist()), float(found[k]))
            for k in range(min(rule.kept, len(found)))
        ]


_CONTAIN = (CONTAIN, replace(CONTAIN, ways=1), replace(CONTAIN, ways=0))
"""What is tried with ever more effort spent: all ways, one way, and nothing held by anything."""
_BRACKETS = np.zeros(len(SIGNS), dtype=np.int64)
for _sign, _does in zip(
    ("(", ")", "[", "]", "|", "\\Vert"),
    (ROUND_OPENS, ROUND_CLOSES, SQUARE_OPENS, SQUARE_CLOSES, BAR, NORM),
    strict=True,
):
    _BRACKETS[NUMBER[_sign]] = _does
_EXTENT = np.array([EXTENTS.index(extent(sign)) for sign in SIGNS])


def _choices(
    items: Sequence[Item], rule: LayoutRule
) -> tuple[Indices, Indices, FloatArray, Indices, Indices]:
    """What the items may be, as the beam takes it: signs, kinds, scores (n, c), counts (n,), and of each item the extents
    that its kinds stand for, (n, k), −1 where there is none."""
    most = max(len(item.choices) for item in items)
    signs = np.zeros((len(items), most), dtype=np.int64)
    kinds = np.zeros((len(items), most), dtype=np.int64)
    scores = np.full((len(items), most), -np.inf)
    counts = np.zeros(len(items), dtype=np.int64)
    reaches = np.full((len(items), most), -1, dtype=np.int64)
    for k, item in enumerate(items):
        known: list[int] = []
        likely = item.choices[0].score - rule.unlikely
        for at, choice in enumerate(item.choices):
            if choice.score <= likely:
                continue
            reach = int(_EXTENT[choice.sign])
            if reach not in known:
                reaches[k, len(known)] = reach
                known.append(reach)
            signs[k, at], scores[k, at], kinds[k, at] = choice.sign, choice.score, known.index(reach)
            counts[k] = at + 1
    return signs, kinds, scores, counts, reaches[:, : int((reaches >= 0).sum(axis=1).max())]


def _table(
    items: Sequence[Item], reaches: Indices, scale: float, relations: Relations, rule: LayoutRule
) -> FloatArray:
    """The scores of every item's relation to those before it by the kinds of both: (n, back, k, k, 5)."""
    count, kinds = reaches.shape
    back = min(rule.back, max(count - 1, 1))
    table = np.full((count, back, kinds, kinds, FIT + 1), -9.0)
    children, gaps = np.nonzero(np.arange(count)[:, None] > np.arange(back)[None])
    parents = children - gaps - 1
    told = (reaches[parents] >= 0)[:, :, None] & (reaches[children] >= 0)[:, None]
    pairs, ones, others = np.nonzero(told)
    if len(pairs):
        measured = measures([item.place for item in items], reaches[:, 0], parents, children, scale)
        shown = features(measured[pairs], reaches[parents[pairs], ones], reaches[children[pairs], others])
        table[children[pairs], gaps[pairs], ones, others] = relations.scores(shown)
    return table


def _row_of(items: Sequence[Item], chosen: list[int], parents: list[int], hows: list[int]) -> Row:
    """The row that the items make, each hung on an item before it."""
    hung: dict[tuple[int, int], int] = {
        (parent, how): child
        for child, (parent, how) in enumerate(zip(parents, hows, strict=True))
        if parent >= 0
    }

    def row(first: int) -> Row:
        nodes: list[Node] = []
        at: int | None = first
        while at is not None:
            node = items[at].choices[chosen[at]].node
            sub, sup = hung.get((at, SUB)), hung.get((at, SUP))
            if sub is not None or sup is not None:
                node = replace(node, sub=() if sub is None else row(sub), sup=() if sup is None else row(sup))
            nodes.append(node)
            at = hung.get((at, RIGHT))
        return tuple(nodes)

    return row(0)
