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
from math import exp, inf, log

import numpy as np

from recognizer.handwriting.language import END, STARTS, Language, Start
from recognizer.handwriting.relations import NONE, Place, Relations, features, measures, place
from sketch.writing.rows import Node, Row
from sketch.writing.signs import ACCENTS, EXTENTS, FRACTION, LETTERS, NUMBER, ROOT, SIGNS, extent


@dataclass(frozen=True, slots=True)
class LayoutRule:
    """Weights of what is believed, and what is looked at. Logarithms are natural."""

    relation: float = 1.0
    language: float = 0.5
    """Less than one: people write more than the grammar that the tables come from."""
    again: float = 0.25
    """Share of a sign's chance that comes from its having been used in the line already."""
    bare: float = 0.5
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
    ordered = sorted(flat, key=lambda item: (item.place.box[0], item.place.box[2]))
    return _beam(ordered, scale, relations, language, start, rule)


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


@dataclass(frozen=True, slots=True)
class _Open:
    """A row that can go on: its last item and that one's choice, its line of ancestors, and which scripts the last
    item has."""

    last: int
    chosen: int
    lineage: tuple[int, ...]
    scripts: int = 0


@dataclass(frozen=True, slots=True)
class _State:
    score: float
    rows: tuple[_Open, ...]
    used: frozenset[int]
    past: tuple[_State, int, int, int, int] | None
    """The state before, the item, its choice, the item that it hangs on (−1 where it is first), and how."""


def _beam(
    items: Sequence[Item],
    scale: float,
    relations: Relations,
    language: Language,
    start: Start,
    rule: LayoutRule,
) -> list[Ranked]:
    tables = _tables(items, scale, relations, rule)
    likely = [
        [
            (at, choice)
            for at, choice in enumerate(item.choices)
            if choice.score > item.choices[0].score - rule.unlikely
        ]
        for item in items
    ]
    begin = language.start[STARTS.index(start)]
    states = [
        _State(
            choice.score + rule.language * float(begin[choice.sign]),
            (_Open(0, at, ()),),
            frozenset([choice.sign]),
            (_EMPTY, 0, at, -1, 0),
        )
        for at, choice in likely[0]
    ]
    extents = [[EXTENTS.index(extent(SIGNS[choice.sign])) for choice in item.choices] for item in items]
    for child in range(1, len(items)):
        ways = _ways(child, states, items, likely[child], extents, tables, language, rule, -rule.far)
        if not ways:  # nothing is near enough to hang on: on the likeliest, then
            ways = _ways(child, states, items, likely[child], extents, tables, language, rule, -inf)
        states = [_next(way, child, items) for way in nlargest(rule.width, ways, key=_score)]
    ranked = [Ranked(_row_of(state, items), state.score) for state in states]
    settled = [replace(one, score=one.score - rule.open * _unpaired(one.row)) for one in ranked]
    return nlargest(rule.kept, settled, key=lambda one: one.score)


_EMPTY = _State(0.0, (), frozenset(), None)
_FAR = (-9.0, -9.0, -9.0, -0.01)
Scores = tuple[float, float, float, float]
"""Logarithms of the chances of right, sub, sup and none."""


def _score(entry: tuple[float, _State, int, int, int]) -> float:
    return entry[0]


def _ways(
    child: int,
    states: Sequence[_State],
    items: Sequence[Item],
    likely: Sequence[tuple[int, Choice]],
    extents: Sequence[Sequence[int]],
    tables: dict[tuple[int, int], dict[tuple[int, int], Scores]],
    language: Language,
    rule: LayoutRule,
    floor: float,
) -> list[tuple[float, _State, int, int, int]]:
    """Every way to go on from the states with the next item: score, state, open row, choice, relation."""
    follow = language.rows
    again = 0.25 * rule.again
    found: list[tuple[float, _State, int, int, int]] = []
    for state in states:
        near = [tables.get((row.last, child)) for row in state.rows]
        for at, choice in likely:
            sign, reach = choice.sign, extents[child][at]
            rows = [
                _FAR if table is None else table.get((extents[row.last][row.chosen], reach), _FAR)
                for table, row in zip(near, state.rows, strict=True)
            ]
            none = sum(scores[NONE] for scores in rows)
            known = sign in state.used
            for number, (row, scores) in enumerate(zip(state.rows, rows, strict=True)):
                parent = items[row.last].choices[row.chosen].sign
                for relation in range(NONE):
                    believed = scores[relation]
                    if believed < floor or row.scripts & relation:
                        continue
                    usual = follow[relation][parent][sign]
                    if known:
                        usual = log(exp(usual) + again)
                    if relation == 0:
                        if not row.scripts & 1:
                            usual += rule.bare * follow[1][parent][END]
                        if not row.scripts & 2:
                            usual += rule.bare * follow[2][parent][END]
                    gain = (
                        choice.score
                        + rule.relation * (none - scores[NONE] + believed)
                        + rule.language * usual
                    )
                    found.append((state.score + gain, state, number, at, relation))
    return found


def _next(entry: tuple[float, _State, int, int, int], child: int, items: Sequence[Item]) -> _State:
    score, state, at, chosen, relation = entry
    row = state.rows[at]
    if relation == 0:
        rows = tuple(
            _Open(child, chosen, one.lineage) if one is row else one
            for one in state.rows
            if one is row or row.last not in one.lineage
        )
    else:
        marked = replace(row, scripts=row.scripts | relation)
        new = _Open(child, chosen, (*row.lineage, row.last))
        rows = (*(marked if one is row else one for one in state.rows), new)
    used = state.used | {items[child].choices[chosen].sign}
    return _State(score, rows, used, (state, child, chosen, row.last, relation))


def _tables(
    items: Sequence[Item], scale: float, relations: Relations, rule: LayoutRule
) -> dict[tuple[int, int], dict[tuple[int, int], Scores]]:
    """For each pair of items that may hang together the scores by the extents of both."""
    pairs = [(p, c) for c in range(len(items)) for p in range(max(0, c - rule.back), c)]
    if not pairs:
        return {}
    measured = measures([items[p].place for p, _ in pairs], [items[c].place for _, c in pairs], scale)
    used = [sorted({EXTENTS.index(extent(SIGNS[choice.sign])) for choice in item.choices}) for item in items]
    rows = [(at, one, other) for at, (p, c) in enumerate(pairs) for one in used[p] for other in used[c]]
    index = np.array(rows)
    scores = relations.scores(features(measured[index[:, 0]], index[:, 1], index[:, 2])).tolist()
    tables: dict[tuple[int, int], dict[tuple[int, int], Scores]] = {pair: {} for pair in pairs}
    for (at, one, other), score in zip(rows, scores, strict=True):
        tables[pairs[at]][one, other] = tuple(score)
    return tables


def _row_of(state: _State, items: Sequence[Item]) -> Row:
    """The row that a state has read."""
    chosen: dict[int, Node] = {}
    hung: dict[tuple[int, int], int] = {}
    last = state.past
    while last is not None:
        before, child, at, parent, relation = last
        chosen[child] = items[child].choices[at].node
        if parent >= 0:
            hung[parent, relation] = child
        last = before.past

    def row(first: int) -> Row:
        nodes: list[Node] = []
        at: int | None = first
        while at is not None:
            sub, sup = hung.get((at, 1)), hung.get((at, 2))
            nodes.append(
                replace(chosen[at], sub=() if sub is None else row(sub), sup=() if sup is None else row(sup))
            )
            at = hung.get((at, 0))
        return tuple(nodes)

    return row(0)


_PAIRS = {")": "(", "]": "["}


def _unpaired(row: Row) -> int:
    """Brackets and bars of the row, and of the scripts in it, that have no partner."""
    stack: list[str] = []
    alone = 0
    for node in row:
        if node.name in _PAIRS.values():
            stack.append(node.name)
        elif node.name in _PAIRS:
            if stack and stack[-1] == _PAIRS[node.name]:
                stack.pop()
            else:
                alone += 1
        alone += _unpaired(node.sub) + _unpaired(node.sup)
    for bar in ("|", "\\Vert"):
        alone += sum(node.name == bar for node in row) % 2
    return alone + len(stack)
