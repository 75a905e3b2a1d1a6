"""Fitting the net of relations: of every sign that is read, and every row open then, whether it goes on it and how."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from recognizer.handwriting.line import Line, box_of
from recognizer.handwriting.relations import FEATURES, NONE, Place, features, measures, place
from sketch.writing.rows import Node, Row
from sketch.writing.signs import EXTENTS, FRACTION, extent
from training.handwriting.corpus import Example


class RelationNet(nn.Module):
    """pairs (n, 36) -> log P of right, sub, sup, none (n, 4)."""

    def __init__(self, width: int = 64) -> None:
        super().__init__()
        self.layers = nn.Sequential(
            nn.BatchNorm1d(FEATURES),
            nn.Linear(FEATURES, width),
            nn.ReLU(),
            nn.Linear(width, width),
            nn.ReLU(),
            nn.Linear(width, NONE + 1),
        )

    def forward(self, pairs: Tensor) -> Tensor:
        return torch.log_softmax(self.layers(pairs), dim=1)


@dataclass(frozen=True, slots=True)
class RelationFitRule:
    epochs: int = 8
    batch: int = 1024
    rate: float = 4e-3
    smoothing: float = 0.01


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
    order = sorted(range(len(nodes)), key=lambda k: (places[k].box[0], places[k].box[2]))
    rows: list[_Open] = []
    parents: list[int] = []
    children: list[int] = []
    told: list[int] = []
    for child in order:
        parent, relation = edges[child]
        for one in rows:
            parents.append(one.node)
            children.append(child)
            told.append(relation if one.node == parent else NONE)
        if relation == 0 and parent >= 0:
            lineage = next((one.lineage for one in rows if one.node == parent), ())
            rows = [one for one in rows if one.node != parent and parent not in one.lineage]
        else:
            lineage = (*next((one.lineage for one in rows if one.node == parent), ()), parent)
        rows.append(_Open(child, lineage))
    if not parents:
        return
    measured = measures([places[k] for k in parents], [places[k] for k in children], line.scale)
    extents = np.array([EXTENTS.index(extent(node.name)) for node in nodes])
    shown.append(features(measured, extents[parents], extents[children]))
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
            scores = net(shown[chosen])
            loss = nn.functional.cross_entropy(scores, told[chosen], label_smoothing=rule.smoothing)
            optimizer.zero_grad(set_to_none=True)
            loss.backward()
            optimizer.step()
            schedule.step()
    return net.eval()
