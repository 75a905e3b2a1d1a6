"""From signs on a line to rows: fractions and roots by what lies over, under and inside them, scripts by a beam.

Within a region (a line, a numerator, a radicand …) the widest bars and roots are taken first, each with
the signs over, under or inside it, which are regions again; what is left is read from left to right. A state of the
beam knows which rows are open: a sign goes on one of them, or begins a script of the last sign of one.
Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from heapq import nlargest

import numpy as np

from recognizer.handwriting.language import IS_LETTER, LINE, PART, STARTS, Language, Start
from recognizer.handwriting.relations import FIT, Place, Relations, features, in_order, measures, place
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
from sketch.writing.signs import ACCENTS, EXTENTS, FRACTION, LETTERS, NUMBER, ROOT, SIGNS, extent


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
    bar: float = 0.04
    """Chance of being a fraction's bar from which it is tried."""
    margin: float = 0.12
    """How far the middle of a sign over or under a bar may lie beyond its ends, in the line's scale."""
    back: int = 10
    """Signs before a sign that it may hang on."""
    ends: float = 1.0
    """Weight of how seldom a sign is the last of its row."""
    fitting: float = 0.5
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


@dataclass(frozen=True, slots=True)
class Choice:
    """What an item may be: its number among the signs, the logarithm of its chance, and its node without scripts."""

    sign: int
    score: float
    node: Node


@dataclass(frozen=True, slots=True)
class Item:
    """A sign, or a fraction or root with all it holds."""

    place: Place
    choices: tuple[Choice, ...]
    strokes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Ranked:
    """A reading of a region and the logarithm of its weight."""

    row: Row
    score: float


def arranged(
    items: Sequence[Item],
    scale: float,
    relations: Relations,
    language: Language,
    start: Start = "line",
    rule: LayoutRule = RULE,
) -> list[Ranked]:
    """Readings of a region, the best first."""
    if not items:
        return [Ranked((), 0.0)]

    def inner(part: Sequence[Item], name: Start) -> list[Ranked]:
        return arranged(part, scale, relations, language, name, rule)

    flat = _accented(_contained(items, scale, inner, rule), scale)
    ordered = in_order([item.place for item in flat])
    return _beam([flat[k] for k in ordered], scale, relations, language, start, rule)


def _contained(
    items: Sequence[Item],
    scale: float,
    inner: Callable[[Sequence[Item], Start], list[Ranked]],
    rule: LayoutRule,
) -> list[Item]:
    """The items with fractions and roots in place of what they hold, the widest first."""
    left = list(items)
    for item in sorted(items, key=lambda item: item.place.box[0] - item.place.box[2]):
        if item not in left:
            continue
        best = item.choices[0].score
        holds = {choice.sign: choice for choice in item.choices if choice.score > best + np.log(rule.bar)}
        others = [other for other in left if other is not item]
        made: Item | None = None
        taken: list[Item] = []
        if NUMBER[FRACTION] in holds:
            made, taken = _fraction(item, holds[NUMBER[FRACTION]], others, scale, inner, rule)
        if made is None and NUMBER[ROOT] in holds:
            made, taken = _root(item, holds[NUMBER[ROOT]], others, inner, rule)
        if made is not None:
            left = [other for other in others if other not in taken]
            left.append(made)
        elif NUMBER[FRACTION] in holds:
            left = [*others, _unbarred(item)]
    return left


def _fraction(
    item: Item,
    bar: Choice,
    others: Sequence[Item],
    scale: float,
    inner: Callable[[Sequence[Item], Start], list[Ranked]],
    rule: LayoutRule,
) -> tuple[Item | None, list[Item]]:
    left, _, right, _ = item.place.box
    margin = rule.margin * scale
    reach = [other for other in others if left - margin <= _middle(other) <= right + margin]
    over = [other for other in reach if other.place.axis < item.place.axis]
    under = [other for other in reach if other.place.axis >= item.place.axis]
    if not over or not under:
        return None, []
    choices = [
        Choice(
            bar.sign,
            bar.score + above.score + below.score,
            Node(FRACTION, item.strokes, over=above.row, under=below.row),
        )
        for above in inner(over, "over")
        for below in inner(under, "under")
    ]
    return _whole(item, [*over, *under], choices, item.place.axis, rule), [*over, *under]


def _root(
    item: Item,
    root: Choice,
    others: Sequence[Item],
    inner: Callable[[Sequence[Item], Start], list[Ranked]],
    rule: LayoutRule,
) -> tuple[Item | None, list[Item]]:
    left, top, right, bottom = item.place.box
    slack = 0.12 * (right - left)
    tall = bottom - top
    held = [
        other
        for other in others
        if left < _middle(other) < right + slack
        and top - 0.1 * tall < 0.5 * (other.place.box[1] + other.place.box[3]) < bottom + 0.35 * tall
        and other.place.box[0] > left + 0.02 * (right - left)
    ]
    if not held:
        return None, []
    choices = [
        Choice(root.sign, root.score + one.score, Node(ROOT, item.strokes, inside=one.row))
        for one in inner(held, "inside")
    ]
    return _whole(item, held, choices, None, rule), held


def _whole(
    item: Item, held: Sequence[Item], choices: Sequence[Choice], axis: float | None, rule: LayoutRule
) -> Item:
    boxes = np.array([item.place.box, *(other.place.box for other in held)])
    box = [*boxes[:, :2].min(axis=0).tolist(), *boxes[:, 2:].max(axis=0).tolist()]
    best = nlargest(rule.kept, choices, key=lambda choice: choice.score)
    return Item(place(box, axis), tuple(best), item.strokes)


def _unbarred(item: Item) -> Item:
    """A bar with nothing over or under it is a minus sign."""
    both = (NUMBER[FRACTION], NUMBER["-"])
    total = float(np.logaddexp.reduce([choice.score for choice in item.choices if choice.sign in both]))
    rest = [choice for choice in item.choices if choice.sign not in both]
    minus = Choice(NUMBER["-"], total, Node("-", item.strokes))
    return replace(item, choices=tuple(sorted([minus, *rest], key=lambda choice: -choice.score)))


def _middle(item: Item) -> float:
    return 0.5 * (item.place.box[0] + item.place.box[2])


def _accented(items: Sequence[Item], scale: float) -> list[Item]:
    """The items with arrows and hats put on the letters that they stand over."""
    left = list(items)
    for item in items:
        mark = item.choices[0]
        if item not in left:
            continue
        if SIGNS[mark.sign] not in ACCENTS:
            continue
        below = [
            other
            for other in left
            if other is not item
            and other.place.box[0] - 0.3 * scale < _middle(item) < other.place.box[2] + 0.3 * scale
            and item.place.axis < other.place.axis
            and other.place.box[1] - item.place.box[3] < 0.6 * scale
            and SIGNS[other.choices[0].sign] in LETTERS
        ]
        if not below:
            continue
        letter = min(below, key=lambda other: abs(_middle(other) - _middle(item)))
        choices = tuple(
            replace(choice, score=choice.score + mark.score, node=replace(choice.node, accent=mark.node))
            for choice in letter.choices
            if SIGNS[choice.sign] in LETTERS
        )
        left = [other for other in left if other is not item and other is not letter]
        left.append(replace(letter, choices=choices))
    return left


def _beam(
    items: Sequence[Item],
    scale: float,
    relations: Relations,
    language: Language,
    start: Start,
    rule: LayoutRule,
) -> list[Ranked]:
    signs, kinds, scores, counts, reaches = _choices(items, rule)
    table = _table(items, reaches, scale, relations, rule)
    found, chosen, parents, hows = beam(
        signs,
        kinds,
        scores,
        counts,
        table,
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
