"""Handwritten mathematics read: strokes of one line to a row of signs, with its confidence and other readings.

    reading = Reader().read(strokes)
    print(reading.latex, reading.confidence, reading.tree)

What the page's physics expects comes in as a prior, a function that weighs a reading: it re-orders
readings and vetoes none. Frame: page units, y down.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from heapq import nlargest
from typing import Any

import numpy as np

from recognizer.handwriting import language, relations, signs
from recognizer.handwriting.confidence import believed
from recognizer.handwriting.contain import Choice, Item
from recognizer.handwriting.language import Language
from recognizer.handwriting.layout import RULE as LAYOUT
from recognizer.handwriting.layout import Layout, LayoutRule
from recognizer.handwriting.line import Group, Line, box_of, groups, line_of, spaced
from recognizer.handwriting.relations import Relations, place
from recognizer.handwriting.segment import Covering, coverings
from recognizer.handwriting.signs import COUNT, SignReader
from sketch.formula.lexer import FormulaError, decimals
from sketch.formula.mathml import mathml
from sketch.formula.parse import parse
from sketch.ink import FloatArray, Stroke
from sketch.writing.rows import Node, Row, formula, latex, nodes_of
from sketch.writing.signs import FUNCTIONS, NUMBER, SIGNS, TWINS

Prior = Callable[[Row], float]
"""The logarithm of how much a page speaks for a reading: 0 where it says nothing, less where it speaks against."""


@dataclass(frozen=True, slots=True)
class ReaderRule:
    """How a line is read."""

    choices: int = 6
    """Signs that a group is tried as."""
    doubt: float = 1.2
    """The net's opinions are softened by this temperature: people write otherwise than the generator."""
    twins: float = 0.5
    """Of how much a letter is rather its capital than its small form, and of the like, this share is believed: it is told by
    size, and writers differ in it more than the generator's."""
    each: float = 0.5
    """Added for each sign: without it few signs of many strokes are likelier than many, for which more has to fit."""
    strokes: int = 120
    """Strokes of the longest line that is read; a longer one is none, and is not read."""
    readings: int = 5
    prior_most: float = 4.0
    """A prior moves a reading by this at most, so that clear ink is always stronger."""


RULE = ReaderRule()


@dataclass(frozen=True, slots=True)
class Symbol:
    """A sign as read: its strokes (positions in the line), its box (left, top, right, bottom) and its own chance."""

    name: str
    strokes: tuple[int, ...]
    box: tuple[float, float, float, float]
    confidence: float


@dataclass(frozen=True, slots=True)
class Reading:
    """What a line says.

    row: the signs as they lie; latex: canonical; confidence: the calibrated chance that all of it is right;
    alternatives: other readings in LaTeX with their chances, the best first.
    """

    row: Row
    latex: str
    confidence: float
    symbols: tuple[Symbol, ...]
    alternatives: tuple[tuple[str, float], ...] = ()

    @property
    def text(self) -> str:
        """The line in the formula language."""
        return formula(self.row)

    @property
    def tree(self) -> Any:
        """Its SymPy tree, None where it is no formula."""
        try:
            return parse(self.text)
        except FormulaError:
            return None

    @property
    def mathml(self) -> str | None:
        """Its MathML, None where it is no formula."""
        tree = self.tree
        return None if tree is None else mathml(tree, decimals(self.text))


NOTHING = Reading((), "", 0.0, ())


class Reader:
    """Reads lines. signs: who tells signs; the rest is the same for all."""

    def __init__(
        self,
        sign_reader: SignReader | None = None,
        relation_net: Relations | None = None,
        usual: Language | None = None,
        rule: ReaderRule = RULE,
        layout: LayoutRule = LAYOUT,
    ) -> None:
        self.signs = sign_reader or signs.shipped()
        self.relations = relation_net or relations.shipped()
        self.language = usual or language.shipped()
        self.rule = rule
        self.layout = layout

    @property
    def name(self) -> str:
        return self.signs.name

    def read(self, strokes: Sequence[Stroke], prior: Prior | None = None) -> Reading:
        """The reading of one line's strokes in drawing order."""
        if not strokes or len(strokes) > self.rule.strokes:
            return NOTHING
        line = line_of([spaced(stroke) for stroke in strokes])
        candidates = groups(line)
        return self.settled(line, candidates, self.signs.scores(line, candidates), prior)

    def settled(
        self, line: Line, candidates: Sequence[Group], scores: FloatArray, prior: Prior | None = None
    ) -> Reading:
        """The reading of a line whose groups have been looked at: scores (groups, signs + 1)."""
        scores = softened(scores, self.rule.doubt, self.rule.twins)
        ways = coverings(len(line), candidates, scores)
        items = self._items(line, candidates, scores, {position for way in ways for position in way.groups})
        layout = Layout(line.scale, self.relations, self.language, self.layout)
        found: dict[str, tuple[float, Row, Covering]] = {}
        for way in ways:
            for ranked in layout.arranged([items[position] for position in way.groups]):
                row = named(ranked.row)
                total = ranked.score + way.score + self.rule.each * len(way.groups)
                if prior is not None:
                    total += max(prior(row), -self.rule.prior_most)
                text = latex(row)
                if text not in found or found[text][0] < total:
                    found[text] = (total, row, way)
        best = nlargest(self.rule.readings, found.items(), key=lambda entry: entry[1][0])
        weights = np.array([entry[1][0] for entry in best])
        shares = np.exp(weights - np.logaddexp.reduce(weights))
        text, (_, row, way) = best[0]
        symbols = self._symbols(line, row, candidates, scores, way)
        confidence = believed(float(shares[0]), [symbol.confidence for symbol in symbols])
        others = tuple(
            (other, float(share) / float(shares[0]) * confidence)
            for (other, _), share in zip(best[1:], shares[1:], strict=True)
        )
        return Reading(row, text, confidence, symbols, others)

    def _items(
        self, line: Line, candidates: Sequence[Group], scores: FloatArray, used: set[int]
    ) -> dict[int, Item]:
        """The groups that are in use as what may lie on the line, each with the signs that it is tried as."""
        positions = sorted(used)
        own = scores[positions, :COUNT]
        shares = own - np.logaddexp.reduce(own, axis=1, keepdims=True)
        orders = np.argsort(-own, axis=1, kind="stable")[:, : self.rule.choices]
        items: dict[int, Item] = {}
        for position, share, order in zip(positions, shares, orders.tolist(), strict=True):
            group = candidates[position]
            choices = tuple(Choice(k, float(share[k]), Node(SIGNS[k], group)) for k in order)
            items[position] = Item(place(box_of(line, group).tolist()), choices, group)
        return items

    def _symbols(
        self, line: Line, row: Row, candidates: Sequence[Group], scores: FloatArray, way: Covering
    ) -> tuple[Symbol, ...]:
        chance = {candidates[position]: scores[position] for position in way.groups}
        found: list[Symbol] = []
        for node in nodes_of(row):
            own = chance.get(node.strokes)
            sure = (
                0.5 if own is None or node.name not in SIGNS else float(np.exp(own[SIGNS.index(node.name)]))
            )
            left, top, right, bottom = box_of(line, node.strokes).tolist()
            found.append(Symbol(node.name, node.strokes, (left, top, right, bottom), sure))
        return tuple(found)


_TWINS = [np.array([NUMBER[name] for name in family]) for family in TWINS]


def softened(scores: FloatArray, temperature: float, twins: float = 1.0) -> FloatArray:
    """Log probabilities at a temperature, normalised again; twins: at another one among signs of one shape."""
    soft = scores / temperature
    for family in _TWINS:
        own = soft[:, family]
        total = np.logaddexp.reduce(own, axis=1, keepdims=True)
        own = twins * own
        soft[:, family] = own + total - np.logaddexp.reduce(own, axis=1, keepdims=True)
    return soft - np.logaddexp.reduce(soft, axis=1, keepdims=True)


_SPELT = sorted(((name[1:], name) for name in FUNCTIONS), key=lambda pair: -len(pair[0]))


_ENDS = {name[-1] for name in FUNCTIONS}


def named(row: Row) -> Row:
    """The row with functions that were read letter by letter as one sign each."""
    nodes = [_named_within(node) for node in row]
    if len(nodes) < 2 or not any(node.name in _ENDS for node in nodes):
        return tuple(nodes)
    at = 0
    while at < len(nodes):
        for letters, name in _SPELT:
            run = nodes[at : at + len(letters)]
            spelt = [node.name for node in run] == list(letters)
            if spelt and all(not (node.sub or node.sup or node.accent) for node in run[:-1]):
                strokes = tuple(sorted(stroke for node in run for stroke in node.strokes))
                nodes[at : at + len(letters)] = [replace(run[-1], name=name, strokes=strokes)]
                break
        at += 1
    return tuple(nodes)


def _named_within(node: Node) -> Node:
    if not (node.sub or node.sup or node.over or node.under or node.inside):
        return node
    return replace(
        node,
        sub=named(node.sub),
        sup=named(node.sup),
        over=named(node.over),
        under=named(node.under),
        inside=named(node.inside),
    )
