"""Fitting the net of relations: of every sign that is read, and every row open then, whether it goes on it and how."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from recognizer.handwriting.line import Line, box_of
from recognizer.handwriting.relations import (
    BESIDE,
    FEATURES,
    FIT,
    MEASURES,
    NONE,
    OWN,
    Place,
    features,
    in_order,
    measures,
    place,
)
from sketch.writing.rows import Node, Row
from sketch.writing.signs import EXTENTS, FRACTION, extent
from training.handwriting.corpus import Example


class RelationNet(nn.Module):
    """pairs (n, 72) -> log P of right, sub, sup, none, and of the extents' fitting the boxes (n, 5)."""

    def __init__(self, width: int = 64) -> None:
        super().__init__()
        self.layers = nn.Sequential(
            nn.BatchNorm1d(FEATURES),
            nn.Linear(FEATURES, width),
            nn.ReLU(),
            nn.Linear(width, width),
            nn.ReLU(),
            nn.Linear(width, FIT + 1),
        )

    def forward(self, pairs: Tensor) -> Tensor:
        scores = self.layers(pairs)
        told = torch.log_softmax(scores[:, :FIT], dim=1)
        return torch.cat([told, nn.functional.logsigmoid(scores[:, FIT:])], dim=1)


@dataclass(frozen=True, slots=True)
class RelationFitRule:
    epochs: int = 8
    batch: int = 1024
    rate: float = 4e-3
    smoothing: float = 0.01
    fitting: float = 0.5
    """Weight of the extents' fitting."""
    blind: float = 0.15
    """Share of the pairs of which a neighbour is not shown, or is shown as another sign: the reader may have misread it."""


RULE = RelationFitRule()


@dataclass(slots=True)
class _Open:
    node: int
    lineage: tuple[int, ...]


def pairs_of(example: Example) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """What the net is shown of a line and what it should say: (n, 36) and (n,)."""
    shown: list[NDArray[np.float32]] = []
    answers: list[int] = []
    for row in _regions(example.row):
        _region(row, example.line, shown, answers)
    if not shown:
        return np.empty((0, FEATURES), dtype=np.float32), np.empty(0, dtype=np.int64)
    return np.concatenate(shown), np.array(answers)


def _regions(row: Row) -> Iterator[Row]:
    """The row and every row over, under or inside something in it, at any depth."""
    yield row

    def inner(part: Row) -> Iterator[Row]:
        for node in part:
            for region in (node.over, node.under, node.inside):
                if region:
                    yield from _regions(region)
            yield from inner(node.sub)
            yield from inner(node.sup)

    yield from inner(row)


def _strokes(node: Node) -> Iterator[int]:
    yield from node.strokes
    for part in (node.over, node.under, node.inside):
        for one in part:
            yield from _strokes(one)
            for script in (*one.sub, *one.sup):
                yield from _strokes(script)


def _region(row: Row, line: Line, shown: list[NDArray[np.float32]], answers: list[int]) -> None:
    """The pairs of one region: its signs are taken from left to right, as the reader takes them."""
    nodes: list[Node] = []
    edges: list[tuple[int, int]] = []

    def gather(part: Row, parent: int, relation: int) -> None:
        before, how = parent, relation
        for node in part:
            own = len(nodes)
            nodes.append(node)
            edges.append((before, how))
            gather(node.sub, own, 1)
            gather(node.sup, own, 2)
            before, how = own, 0

    gather(row, -1, 0)
    places = [_place(node, line) for node in nodes]
    order = in_order(places)
    at = {node: position for position, node in enumerate(order)}
    rows: list[_Open] = []
    parents: list[int] = []
    children: list[int] = []
    told: list[int] = []
    for child in order:
        parent, relation = edges[child]
        for one in rows:
            parents.append(at[one.node])
            children.append(at[child])
            told.append(relation if one.node == parent else NONE)
        if relation == 0 and parent >= 0:
            lineage = next((one.lineage for one in rows if one.node == parent), ())
            rows = [one for one in rows if one.node != parent and parent not in one.lineage]
        else:
            lineage = (*next((one.lineage for one in rows if one.node == parent), ()), parent)
        rows.append(_Open(child, lineage))
    if not parents:
        return
    extents = np.array([EXTENTS.index(extent(nodes[k].name)) for k in order])
    p, c = np.array(parents), np.array(children)
    measured = measures([places[k] for k in order], extents, p, c, line.scale)
    shown.append(features(measured, extents[p], extents[c]))
    answers += told


def _place(node: Node, line: Line) -> Place:
    box = box_of(line, tuple(_strokes(node)))
    axis = None
    if node.name == FRACTION:
        own = box_of(line, node.strokes)
        axis = 0.5 * float(own[1] + own[3])
    return place(box.tolist(), axis)


def fit(examples: Sequence[Example], seed: int, rule: RelationFitRule = RULE) -> RelationNet:
    """Trains on the lines."""
    torch.manual_seed(seed)
    rng = np.random.default_rng(seed)
    found = [pairs_of(example) for example in examples]
    shown = torch.from_numpy(np.concatenate([one for one, _ in found]))
    told = torch.from_numpy(np.concatenate([one for _, one in found]))
    net = RelationNet()
    steps = rule.epochs * -(-len(shown) // rule.batch)
    optimizer = torch.optim.AdamW(net.parameters(), lr=rule.rate, weight_decay=1e-3)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, rule.rate, total_steps=steps + 1)
    for _ in range(rule.epochs):
        order = torch.from_numpy(rng.permutation(len(shown)))
        for chosen in order.split(rule.batch):
            true = _blinded(shown[chosen], rule.blind)
            false = _mistaken(true)
            scores = net(torch.cat([true, false]))
            loss = nn.functional.cross_entropy(
                scores[: len(true), :FIT], told[chosen], label_smoothing=rule.smoothing
            )
            fits = scores[:, FIT].clamp(max=-1e-6)
            unfit = torch.log(-torch.expm1(fits[len(true) :]))
            loss = loss - rule.fitting * (fits[: len(true)].mean() + unfit.mean())
            optimizer.zero_grad(set_to_none=True)
            loss.backward()
            optimizer.step()
            schedule.step()
    return net.eval()


def _blinded(shown: Tensor, share: float) -> Tensor:
    """The pairs, of some of which a neighbour is hidden or taken for another sign."""
    seen = shown.clone()
    block = BESIDE + 1 + len(EXTENTS)
    for first in (OWN, OWN + block):
        hidden = torch.rand(len(seen)) < share / 2
        seen[hidden, first : first + block] = 0.0
        other = (torch.rand(len(seen)) < share / 2) & (seen[:, first + BESIDE] > 0)
        signs = slice(first + BESIDE + 1, first + block)
        seen[other, signs] = torch.eye(len(EXTENTS))[torch.randint(len(EXTENTS), (int(other.sum()),))]
    return seen


_TWINS = {
    "x": "tall",
    "tall": "x",
    "deep": "tall",
    "long": "tall",
    "middle": "x",
    "low": "tall",
    "high": "low",
    "bracket": "tall",
}
"""What a sign of an extent is easily mistaken for: s for S, P for p, 9 for g, × for x, a comma for 1."""
_SECOND = {"x": "middle", "tall": "deep", "deep": "x", "low": "middle", "middle": "low", "bracket": "x"}


def _mistaken(shown: Tensor) -> Tensor:
    """The pairs with one of the two signs taken for one of another extent."""
    places = {name: k for k, name in enumerate(EXTENTS)}
    first = torch.tensor([places[_TWINS.get(name, "x")] for name in EXTENTS])
    second = torch.tensor([places[_SECOND.get(name, _TWINS.get(name, "x"))] for name in EXTENTS])
    seen = shown.clone()
    of_child = torch.rand(len(seen)) < 0.5
    for chosen, begin in ((~of_child, MEASURES), (of_child, MEASURES + len(EXTENTS))):
        signs = slice(begin, begin + len(EXTENTS))
        true = seen[chosen, signs].argmax(dim=1)
        false = torch.where(torch.rand(len(true)) < 0.65, first[true], second[true])
        rows = seen[chosen]
        rows[:, signs] = torch.eye(len(EXTENTS))[false]
        seen[chosen] = rows
    return seen
