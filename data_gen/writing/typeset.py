"""Mathematics written by a hand: rows of signs laid out in two dimensions and drawn by a simulated pen.

Frame while laying out: y down, the baseline at 0, lengths in heights of a capital; the ink comes out in
page units. Proportions are those of a school copybook; every writer departs from them in a way of
his own (`Habits`), and every sign from the writer's (`TypeRule`, in `habits.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from data_gen.pen import draw_each
from data_gen.writing.forming import sign_of
from data_gen.writing.habits import Habits
from sketch.geometry import bounding_box
from sketch.ink import FloatArray, Ink, Stroke
from sketch.writing.rows import Node, Row
from sketch.writing.signs import FRACTION, FUNCTIONS, ROOT, extent


@dataclass(slots=True)
class _Sign:
    """A sign to be drawn: paths fill the unit box until it is placed at (x, y) with a size (w, h)."""

    node: int
    name: str
    paths: list[FloatArray]
    x: float
    y: float
    w: float
    h: float


@dataclass(slots=True)
class _Block:
    """Signs laid out together; left 0, right `width`; `top` and `bottom` are what the ink reaches."""

    signs: list[_Sign]
    width: float
    top: float
    bottom: float

    def moved(self, x: float, y: float) -> _Block:
        for sign in self.signs:
            sign.x += x
            sign.y += y
        self.top += y
        self.bottom += y
        return self

    def scaled(self, factor: float) -> _Block:
        for sign in self.signs:
            sign.x, sign.y, sign.w, sign.h = (
                sign.x * factor,
                sign.y * factor,
                sign.w * factor,
                sign.h * factor,
            )
        self.width, self.top, self.bottom = self.width * factor, self.top * factor, self.bottom * factor
        return self


@dataclass(frozen=True, slots=True)
class Written:
    """Ink of an expression and its truth: the row, every node with its strokes."""

    ink: Ink
    row: Row


def written(row: Row, by: Habits, pen: bool = True) -> Written:
    """The row as ink, its box's corner at the origin; without a pen, the paths as they are meant.

    Raises KeyError for a sign that has no glyph."""
    numbered, nodes = _numbered(row, [])
    block = _row(numbered, by)
    paths, owner = _placed(block, by)
    paths, owner = _delayed(paths, owner, nodes, by)
    low = np.min([path.min(axis=0) for path in paths], axis=0)
    meant = [path - low for path in paths]
    ink = draw_each(meant, [by.writer] * len(paths), by.rng) if pen else [Stroke(path) for path in meant]
    strokes: list[list[int]] = [[] for _ in nodes]
    for index, node in enumerate(owner):
        strokes[node].append(index)
    return Written(Ink(tuple(ink)), _inked(numbered, strokes))


def _numbered(row: Row, nodes: list[str]) -> tuple[Row, list[str]]:
    """The row with each node's number where its strokes will stand, and the names by number."""
    found: list[Node] = []
    for node in row:
        number = len(nodes)
        nodes.append(node.name)
        accent = node.accent
        if accent is not None:
            accent = replace(accent, strokes=(len(nodes),))
            nodes.append(accent.name)
        sub, sup, over, under, inside = (
            _numbered(part, nodes)[0] for part in (node.sub, node.sup, node.over, node.under, node.inside)
        )
        found.append(Node(node.name, (number,), sub, sup, over, under, inside, accent))
    return tuple(found), nodes


def _inked(row: Row, strokes: Sequence[Sequence[int]]) -> Row:
    def own(node: Node) -> tuple[int, ...]:
        return tuple(strokes[node.strokes[0]])

    return tuple(
        Node(
            node.name,
            own(node),
            sub=_inked(node.sub, strokes),
            sup=_inked(node.sup, strokes),
            over=_inked(node.over, strokes),
            under=_inked(node.under, strokes),
            inside=_inked(node.inside, strokes),
            accent=None if node.accent is None else replace(node.accent, strokes=own(node.accent)),
        )
        for node in row
    )


_AIRY = frozenset(["=", "<", ">", "\\leq", "\\geq", "+", "-", "\\times"])


def _row(row: Row, by: Habits) -> _Block:
    """What stands side by side on one baseline. Brackets and bars grow with what they hold."""
    blocks: list[_Block | None] = []
    for node in row:
        blocks.append(None if extent(node.name) == "bracket" and node.name != "/" else _node(node, by))
    for at, node in enumerate(row):
        if blocks[at] is None:
            inner = _held(row, blocks, at)
            top = min([-1.0 * by["digit"], *(block.top for block in inner)])
            bottom = max([0.0, *(block.bottom for block in inner)])
            more = 0.12 * by.rng.random() * (bottom - top)
            grown = by.rng.random() < 0.85 or bottom - top < 1.3
            sized = (top - more, bottom + more) if grown else (-1.1, 0.2)
            round_ = (0.16 + 0.06 * (bottom - top)) * float(np.exp(by.rule.bulge * by.rng.standard_normal()))
            width = {"|": 0.0, "\\Vert": 0.2}.get(node.name, round_)
            blocks[at] = _hung(node, _sign(node, by, *sized, width), by)
    signs: list[_Sign] = []
    at, top, bottom = 0.0, 0.0, 0.0
    before = ""
    for node, block in zip(row, blocks, strict=True):
        assert block is not None
        if before:
            airy = (
                (node.name in _AIRY)
                + (before in _AIRY)
                + 0.5 * (node.name in FUNCTIONS or before in FUNCTIONS)
            )
            digits = before.isdigit() and node.name.isdigit()
            gap = (0.7 if digits else 1.0) * by["gap"] + airy * by["space"]
            at += gap * (1 + by.rule.loose * float(np.clip(by.rng.standard_normal(), -2, 2))) - 0.03
        signs += block.moved(at, 0.0).signs
        at += block.width
        top, bottom = min(top, block.top), max(bottom, block.bottom)
        before = node.name
    return _Block(signs, at, top if signs else -1.0, bottom)


_PARTNER = {"(": ")", "[": "]", "|": "|", "\\Vert": "\\Vert"}


def _held(row: Row, blocks: Sequence[_Block | None], at: int) -> list[_Block]:
    """The blocks between a bracket and its partner, as far as they are laid out."""
    name = row[at].name
    names = [node.name for node in row]
    if name in _PARTNER and name not in ("|", "\\Vert"):
        ends = [k for k in range(at + 1, len(row)) if names[k] == _PARTNER[name]]
        between = range(at + 1, ends[-1] if ends else len(row))
    elif name in ("|", "\\Vert"):
        same = [k for k in range(len(row)) if names[k] == name]
        place = same.index(at)
        other = same[place ^ 1] if place ^ 1 < len(same) else at
        between = range(min(at, other) + 1, max(at, other))
    else:
        starts = [k for k in range(at) if _PARTNER.get(names[k]) == name]
        between = range((starts[0] if starts else 0) + 1, at)
    return [block for k in between if (block := blocks[k]) is not None]


def _node(node: Node, by: Habits) -> _Block:
    if node.name == FRACTION:
        return _hung(node, _fraction(node, by), by)
    if node.name == ROOT:
        return _hung(node, _root(node, by), by)
    if node.name in FUNCTIONS:
        return _hung(node, _word(node, by), by)
    x, up, deep, digit = -by["x_height"], -1.0, by["descent"], -by["digit"]
    axis = -by["axis"]
    match extent(node.name):
        case "x":
            slot = (x, 0.0)
        case "tall":
            slot = (digit if node.name.isdigit() else -0.85 if node.name in "it" else up, 0.0)
        case "deep":
            slot = (x, deep)
        case "long":
            slot = (-0.85 if node.name == "j" else up, deep)
        case "bracket":
            slot = (-1.05, 0.15)
        case "low":
            slot = (-0.05, 0.03) if node.name == "." else (-0.1, 0.22)
        case "high":
            slot = (-1.05, -0.75)
        case _:
            half = {"-": 0.0, "=": 0.13, "\\cdot": 0.03, "+": 0.27, "\\times": 0.22}.get(node.name, 0.26)
            half *= float(np.exp(0.2 * by.rng.standard_normal()))
            slot = (axis - half, axis + half)
    width = {"-": 0.5, "=": 0.55, "\\cdot": 0.05, ".": 0.05, "+": 0.54}.get(node.name)
    if width is not None:
        width *= float(np.exp(0.25 * by.rng.standard_normal()))
    block = _sign(node, by, *slot, width)
    if node.accent is not None:
        block = _accented(node.accent, block, by)
    return _hung(node, block, by)


def _sign(node: Node, by: Habits, top: float, bottom: float, width: float | None) -> _Block:
    """The writer's way of the sign in its slot; size, proportions and baseline stray."""
    rng = by.rng
    paths, aspect = sign_of(node.name, by)
    size = float(np.exp(by["uneven"] * rng.standard_normal()))
    height = (bottom - top) * size
    if width is None:
        width = min(aspect * (bottom - top), 1.4 * (bottom - top)) * float(np.exp(by.writer.stretch))
        if node.name in ("1", "l", "i", ",", "'") and aspect < 0.15:
            width = 0.03
    width *= size * float(np.exp(by.rule.aspect * rng.standard_normal()))
    y = bottom - height + by["jump"] * rng.standard_normal()
    return _Block([_Sign(node.strokes[0], node.name, paths, 0.0, y, width, height)], width, y, y + height)


def _hung(node: Node, block: _Block, by: Habits) -> _Block:
    """The block with its scripts."""
    if not node.sub and not node.sup:
        return block
    signs = list(block.signs)
    start = block.width
    small = by["script"]
    width, top, bottom = start, block.top, block.bottom
    gap = 0.6 * by["gap"]
    tail = 0.0
    if node.sub:
        below = _row(node.sub, by).scaled(small * float(np.exp(0.08 * by.rng.standard_normal())))
        drop = by.about("drop") + 0.5 * max(0.0, block.bottom)
        drop = max(drop, below.bottom + drop - 1.0, -below.top * 0.55)
        below.moved(start + gap * by.rng.uniform(0.2, 1.2), drop)
        signs += below.signs
        tail, bottom = max(tail, start + gap + below.width), max(bottom, below.bottom)
    if node.sup:
        above = _row(node.sup, by).scaled(small * float(np.exp(0.08 * by.rng.standard_normal())))
        base = max(-block.top, 0.4)
        rise = float(np.clip(by.about("rise"), 0.4, 1.05)) * base
        if node.sup[0].name in ("'", "\\circ"):
            rise = max(0.0, base - 0.75)
            above.scaled(float(min(1.0, 0.8 / small)))
        above.moved(start + gap * by.rng.uniform(0.2, 1.2), min(-rise, -rise - 0.0))
        signs += above.signs
        tail, top = max(tail, start + gap + above.width), min(top, above.top)
    width = max(width, tail)
    return _Block(signs, width, top, bottom)


def _accented(accent: Node, block: _Block, by: Habits) -> _Block:
    """An arrow or a hat over the block."""
    height = 0.16 if accent.name == "\\vec" else 0.2
    lift = 0.08 + 0.1 * by.rng.random()
    mark = _sign(
        accent,
        by,
        block.top - lift - height,
        block.top - lift,
        max(0.4, block.width) * by.rng.uniform(0.8, 1.3),
    )
    mark.moved((block.width - mark.width) / 2 + 0.05, 0.0)
    left = min(0.0, mark.signs[0].x)
    return _Block([*block.signs, *mark.signs], max(block.width, mark.width), mark.top, block.bottom).moved(
        -left, 0.0
    )


def _fraction(node: Node, by: Habits) -> _Block:
    """A numerator over a bar over a denominator, drawn in the writer's order."""
    over = _row(node.over, by).scaled(by["stacked_size"])
    under = _row(node.under, by).scaled(by["stacked_size"])
    width = max(over.width, under.width, 0.35) + 2 * by.about("overhang")
    gap = by["bar_gap"]
    axis = -by["axis"]
    over.moved((width - over.width) * by.rng.uniform(0.35, 0.65), axis - by.about("bar_gap") - over.bottom)
    under.moved((width - under.width) * by.rng.uniform(0.35, 0.65), axis + gap - under.top)
    tilt = 0.03 * by.rng.standard_normal()
    bar = _Sign(node.strokes[0], FRACTION, [np.array([[0.0, 0.0], [1.0, 0.0]])], 0.0, axis, width, 0.0)
    bar.paths = [np.array([[0.0, -tilt], [0.5, 0.3 * tilt], [1.0, tilt]])]
    bar.h = 0.5 * width
    order = by["bar_order"]
    if order < 0.75:
        signs = [*over.signs, bar, *under.signs]
    elif order < 0.9:
        signs = [bar, *over.signs, *under.signs]
    else:
        signs = [*over.signs, *under.signs, bar]
    return _Block(signs, width, over.top, under.bottom)


def _root(node: Node, by: Habits) -> _Block:
    """A hook, a rising line and a bar over what stands under it."""
    rng = by.rng
    inner = _row(node.inside, by)
    rise, sink = by.about("bar_gap"), rng.uniform(0.0, 0.2)
    top, bottom = inner.top - rise, inner.bottom + sink
    lead = 0.3 + 0.35 * rng.random()
    depth = (0.25 + 0.35 * rng.random()) * (bottom - top)
    right = lead + inner.width + rng.uniform(0.0, 0.3)
    ramp = rng.uniform(0.5, 0.9) * lead
    points = [
        [0.25 * ramp, bottom - depth],
        [ramp, bottom],
        [lead, top],
        [right, top + rng.uniform(-0.06, 0.06)],
    ]
    style = rng.random()
    if style < 0.55:
        points.insert(0, [0.0, bottom - depth + rng.uniform(0.05, 0.2)])
    elif style < 0.65:
        points[1:1] = [[0.35 * ramp, bottom - 0.5 * depth], [0.6 * ramp, bottom - 0.8 * depth]]
    if rng.random() < 0.25:
        points.append([right + 0.03, top + rng.uniform(0.08, 0.25)])
    path = np.array(points)
    paths = [path]
    if rng.random() < by.rule.two_strokes:
        corner = int(np.argmin(np.hypot(*(path - [lead, top]).T)))
        paths = [path[: corner + 1], path[corner:]]
    low, high = bounding_box(path)
    size = high - low
    sign = _Sign(
        node.strokes[0], ROOT, [(one - low) / size for one in paths], low[0], low[1], size[0], size[1]
    )
    inner.moved(lead + 0.06, 0.0)
    signs = [*inner.signs, sign] if by["root_last"] < 0.06 else [sign, *inner.signs]
    degree = float(low[1])
    if node.over:
        small = _row(node.over, by).scaled(0.5)
        small.moved(-0.1, bottom - depth - 0.1 - small.bottom)
        signs += small.signs
    return _Block(signs, float(high[0]), min(degree, top), bottom)


def _word(node: Node, by: Habits) -> _Block:
    """The name of a function, letter by letter, often without lifting the pen; one sign."""
    rng = by.rng
    at, top, bottom = 0.0, 0.0, 0.0
    paths: list[FloatArray] = []
    letters: list[list[FloatArray]] = []
    for letter in node.name[1:]:
        block = _node(Node(letter, (0,)), by)
        sign = block.signs[0]
        letters.append([path * [sign.w, sign.h] + [at, sign.y] for path in sign.paths])
        at += block.width + by["gap"] * rng.uniform(0.1, 0.8)
        top, bottom = min(top, block.top), max(bottom, block.bottom)
    if rng.random() < by.rule.joined:
        whole = [letters[0][0]]
        late: list[FloatArray] = list(letters[0][1:])
        for strokes in letters[1:]:
            whole.append(strokes[0])
            late += strokes[1:]
        cut = int(rng.integers(1, len(whole))) if rng.random() < 0.4 else len(whole)
        paths = [
            np.concatenate(whole[:cut]),
            *([np.concatenate(whole[cut:])] if cut < len(whole) else []),
            *late,
        ]
    else:
        paths = [path for strokes in letters for path in strokes]
    low, high = bounding_box(np.concatenate(paths))
    size = high - low
    sign = _Sign(
        node.strokes[0], node.name, [(p - low) / size for p in paths], low[0], low[1], size[0], size[1]
    )
    return _Block([sign], float(high[0]), top, bottom)


def _placed(block: _Block, by: Habits) -> tuple[list[FloatArray], list[int]]:
    """Paths in page units, in writing order, and the node of each."""
    rng = by.rng
    phase, period = rng.uniform(0, 2 * np.pi), rng.uniform(3, 9)
    wave = by.rule.drift * rng.standard_normal()
    paths: list[FloatArray] = []
    owner: list[int] = []
    for sign in block.signs:
        box = np.array([sign.w, sign.h])
        turn, lean = (
            by.rule.turn * rng.standard_normal(),
            by.rule.lean * rng.standard_normal() - by.writer.slant,
        )
        if sign.name in (FRACTION, ROOT, "-", "="):
            turn, lean = 0.5 * turn, 0.3 * lean
        spin = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        shear = np.array([[1.0, 0.0], [lean, 1.0]])
        centre = np.array([sign.x, sign.y]) + box / 2
        drift = by["slope"] * centre[0] + wave * np.sin(phase + centre[0] * 2 * np.pi / period)
        for path in sign.paths:
            paths.append((((path - 0.5) * box) @ shear @ spin + centre + [0.0, drift]) * by.writer.height)
            owner.append(sign.node)
    return paths, owner


def _delayed(
    paths: list[FloatArray], owner: list[int], nodes: Sequence[str], by: Habits
) -> tuple[list[FloatArray], list[int]]:
    """Dots of i and j and bars of t put when all is written, by some."""
    if by.rng.random() >= by.rule.delayed:
        return paths, owner
    first: set[int] = set()
    early: list[int] = []
    late: list[int] = []
    for k, node in enumerate(owner):
        (late if node in first and nodes[node] in ("i", "j", "t") else early).append(k)
        first.add(node)
    order = [*early, *late]
    return [paths[k] for k in order], [owner[k] for k in order]
