"""What fractions and roots hold: signs over and under a bar, inside a root, accents over a letter.

Where it is in doubt whether a stroke is a bar or a root at all, or whether a sign at its end belongs to it, there are several ways,
and what is read decides among them. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from heapq import nlargest

import numpy as np

from recognizer.handwriting.language import Start
from recognizer.handwriting.relations import Place, place
from sketch.writing.rows import Node, Row
from sketch.writing.signs import ACCENTS, FRACTION, LETTERS, NUMBER, ROOT, SIGNS


@dataclass(frozen=True, slots=True)
class Choice:
    """What an item may be: its number among the signs, the logarithm of its chance, and its node without scripts."""

    sign: int
    score: float
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
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


Items = tuple[Item, ...]
Inner = Callable[[Items, Start], list[Ranked]]
"""Reads a region."""
Whole = tuple[Item, Items]
"""A fraction or root, and the items that it holds."""


@dataclass(frozen=True, slots=True)
class ContainRule:
    """Lengths are in the line's scale."""

    bar: float = 0.02
    """Chance of being a bar or a root, against the likeliest sign, from which it is tried."""
    doubtful: float = 0.05
    """Chance of the likeliest other sign, against that of being a bar or a root, from which that is tried too."""
    margin: float = 0.12
    """How far the middle of a sign over or under a bar may lie beyond its ends."""
    border: float = 0.45
    """A sign whose middle is this near to the end of a bar or root may belong to it or not."""
    across: float = 0.22
    """Share of its height by which a sign reaches above and below a bar that it stands beside: a bracket."""
    ways: int = 6
    """Ways that are read, of one region; none: nothing holds anything."""
    kept: int = 4
    """Readings of a fraction or root that are kept."""


RULE = ContainRule()


def contained(items: Items, scale: float, inner: Inner, rule: ContainRule = RULE) -> list[list[Item]]:
    """The ways to put fractions, roots and accented letters in place of what they hold, the likeliest first: the widest
    bars and roots take what is theirs before narrower ones do."""
    if rule.ways == 0:
        return [[_plain(item) for item in items]]
    widest = sorted(items, key=lambda item: item.place.box[0] - item.place.box[2])
    found = _expanded(list(items), widest, scale, inner, rule, rule.ways)
    return [_accented(way, scale) for way in found]


def _expanded(
    left: list[Item], queue: Sequence[Item], scale: float, inner: Inner, rule: ContainRule, most: int
) -> list[list[Item]]:
    for at, item in enumerate(queue):
        if item not in left:
            continue
        signs = {choice.sign: choice.score for choice in item.choices}
        best = item.choices[0].score
        wholes: list[tuple[float, Whole]] = []
        for sign, ways in ((NUMBER[FRACTION], _fractions), (NUMBER[ROOT], _roots)):
            if signs.get(sign, -np.inf) > best + np.log(rule.bar):
                others = [other for other in left if other is not item]
                wholes += [(signs[sign], whole) for whole in ways(item, others, scale, inner, rule)]
        plain = _plain(item)
        if not wholes:
            if plain is not item:
                left = [plain if other is item else other for other in left]
            continue
        sure = max(score for score, _ in wholes)
        rest = max((choice.score for choice in item.choices if choice.sign not in _HOLDING), default=-np.inf)
        ways_on: list[tuple[float, list[Item]]] = [
            (score, [other for other in left if other is not item and other not in taken] + [made])
            for score, (made, taken) in wholes
        ]
        if rule.ways > 1 and rest > sure + np.log(rule.doubtful):
            ways_on.append((rest, [plain if other is item else other for other in left]))
        ways_on.sort(key=lambda way: -way[0])
        found: list[list[Item]] = []
        for _, way in ways_on:
            if len(found) < most:
                found += _expanded(way, queue[at + 1 :], scale, inner, rule, max(1, most // len(ways_on)))
        return found[:most]
    return [left]


_HOLDING = (NUMBER[FRACTION], NUMBER[ROOT])


def _plain(item: Item) -> Item:
    """The item as one that holds nothing: a bar is a minus sign, and a root is none."""
    if not any(choice.sign in _HOLDING for choice in item.choices):
        return item
    minus = (NUMBER[FRACTION], NUMBER["-"])
    flat = [choice.score for choice in item.choices if choice.sign in minus]
    rest = [choice for choice in item.choices if choice.sign not in (*minus, NUMBER[ROOT])]
    if flat:
        total = float(np.logaddexp.reduce(flat))
        rest.append(Choice(NUMBER["-"], total, Node("-", item.strokes)))
    if not rest:
        return item
    return replace(item, choices=tuple(sorted(rest, key=lambda choice: -choice.score)))


def _fractions(
    item: Item, others: Sequence[Item], scale: float, inner: Inner, rule: ContainRule
) -> Iterator[Whole]:
    left, top, right, bottom = item.place.box
    axis = item.place.axis
    reach = [other for other in others if not _across(other, top, bottom, rule) and other.place.box[2] > left]
    margin, border = rule.margin * scale, rule.border * scale
    bar = next(choice for choice in item.choices if choice.sign == NUMBER[FRACTION])
    for held in _held(reach, left, right, margin, border, rule.ways == 1):
        over = tuple(other for other in held if other.place.axis < axis)
        under = tuple(other for other in held if other.place.axis >= axis)
        if not over or not under:
            continue
        choices = [
            Choice(
                bar.sign,
                bar.score + above.score + below.score,
                Node(FRACTION, item.strokes, over=above.row, under=below.row),
            )
            for above in inner(over, "over")
            for below in inner(under, "under")
        ]
        yield _whole(item, held, choices, axis, rule), held


def _across(item: Item, top: float, bottom: float, rule: ContainRule) -> bool:
    """Whether the item stands beside a bar, reaching above and below it."""
    above, below = item.place.box[1], item.place.box[3]
    slack = rule.across * (below - above)
    return above < top - slack and below > bottom + slack


def _held(
    reach: Sequence[Item], left: float, right: float, margin: float, border: float, only: bool
) -> Iterator[Items]:
    """The items between two ends, first those that are nearest to being so, then with those near an end in or out."""
    usual = tuple(other for other in reach if left - margin <= _middle(other) <= right + margin)
    yield usual
    if only:
        return
    seen = {frozenset(map(id, usual))}
    for low, high in ((left - margin, right - border), (left - margin, right + border),
                      (left + border, right + margin), (left - border, right + margin)):  # fmt: skip
        held = tuple(other for other in reach if low <= _middle(other) <= high)
        key = frozenset(map(id, held))
        if key not in seen:
            seen.add(key)
            yield held


def _roots(
    item: Item, others: Sequence[Item], scale: float, inner: Inner, rule: ContainRule
) -> Iterator[Whole]:
    left, top, right, bottom = item.place.box
    tall = bottom - top
    reach = [
        other
        for other in others
        if top - 0.1 * tall < 0.5 * (other.place.box[1] + other.place.box[3]) < bottom + 0.35 * tall
        and other.place.box[0] > left + 0.02 * (right - left)
    ]
    slack = min(0.12 * (right - left), 0.35 * scale)
    root = next(choice for choice in item.choices if choice.sign == NUMBER[ROOT])
    # Over the hook stands the degree.
    hook = left + min(0.5 * tall, 0.4 * (right - left))
    degree = tuple(
        other
        for other in others
        if left - 0.3 * scale < _middle(other) < hook
        and other.place.box[3] < top + 0.75 * tall
        and other.place.box[3] - other.place.box[1] < 0.7 * tall
        and other.place.box[2] < hook + 0.25 * scale
    )
    for held in _held(reach, left, right, slack, 0.5 * rule.border * scale, rule.ways == 1):
        for above in ((), degree) if degree else ((),):
            inside = tuple(other for other in held if other not in above)
            if not inside:
                continue
            choices = [
                Choice(
                    root.sign,
                    root.score + one.score + over.score,
                    Node(ROOT, item.strokes, over=over.row, inside=one.row),
                )
                for one in inner(inside, "inside")
                for over in (inner(above, "line")[:2] if above else [Ranked((), 0.0)])
            ]
            taken = (*inside, *above)
            yield _whole(item, inside, choices, None, rule), taken


def _whole(item: Item, held: Items, choices: Sequence[Choice], axis: float | None, rule: ContainRule) -> Item:
    boxes = np.array([item.place.box, *(other.place.box for other in held)])
    box = [*boxes[:, :2].min(axis=0).tolist(), *boxes[:, 2:].max(axis=0).tolist()]
    best = nlargest(rule.kept, choices, key=lambda choice: choice.score)
    return Item(place(box, axis), tuple(best), item.strokes)


def _middle(item: Item) -> float:
    return 0.5 * (item.place.box[0] + item.place.box[2])


def _accented(items: Sequence[Item], scale: float) -> list[Item]:
    """The items with arrows and hats put on the letters that they stand over."""
    left = list(items)
    for item in items:
        mark = item.choices[0]
        if item not in left or SIGNS[mark.sign] not in ACCENTS:
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
