"""Drawings to learn from: things alone, things beside one another, whole pages; what each stroke is, and of which thing.

Nothing here looks at human ink. Drawing i of a seed depends on (seed, i) and on the plan alone.
Frame: page units, y down; seconds.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from data_gen.authored import NAMES, flow_arrows, oddities, signs
from data_gen.oddities import ODDITIES
from data_gen.pages import page as whole_page
from data_gen.problems import ANSWERS, PROBLEMS
from data_gen.strokes import EVERYBODY, LabelledItem, Recipe, doodles, items
from sketch.ink import FloatArray, Stroke
from sketch.page import STROKE_KINDS, Sketch, StrokeKind

NONE = -1
"""Instead of a kind: the stroke is none of them. Instead of a thing: which other strokes are of the same
thing is not asked."""
UNASKED = -2
"""Instead of a kind: nobody knows, and nobody asks. A stray mark on a page may be anything."""


@dataclass(frozen=True, slots=True)
class Drawing:
    """Strokes of one page in drawing order; kinds and things, (n,): indices into `STROKE_KINDS`, and one number
    for all strokes of a thing; `NONE` as above."""

    strokes: tuple[Stroke, ...]
    kinds: tuple[int, ...]
    things: tuple[int, ...]


ALONE: Mapping[StrokeKind, float] = {
    "circle": 0.15,
    "polygon": 0.15,
    "spring": 0.14,
    "wire": 0.13,
    "arrow": 0.14,
    "tap": 0.06,
    "scribble": 0.03,
    "lasso": 0.005,
    "math": 0.195,
}
"""Shares of things that stand alone. With nothing in it a lasso is a badly drawn circle."""

BESIDE: Mapping[StrokeKind, float] = {
    "circle": 0.15,
    "polygon": 0.17,
    "spring": 0.12,
    "wire": 0.17,
    "arrow": 0.15,
    "tap": 0.04,
    "scribble": 0.0,
    "lasso": 0.0,
    "math": 0.20,
}
"""Shares of things strewn over a page. Gestures come over what is there, below."""


PAGES = (0.3, 0.35)
"""Share of whole pages that are looked at before they are finished, and of those that bear clutter."""


FIRST_UNSEEN = ("knot", "fish", "signature", "leaf")
"""Families of doodles that have been kept for measuring from the beginning."""
UNSEEN = (*FIRST_UNSEEN, *sorted(ODDITIES)[3::4])
"""All families that are kept for measuring, every fourth of the others by the alphabet: what is rejected must not have
been learned by heart."""
DOODLED = 3
"""One in so many of the doodles is of the generator's own families, the others are of `data_gen.oddities`."""
COUNTS = ("alone", "strewn", "pages", "doodles", "arrows", "signs")
"""What a plan counts."""


@dataclass(frozen=True, slots=True)
class Plan:
    """How many of what. Counts are drawings."""

    alone: int = 146_000
    strewn: int = 10_000
    pages: int = 2_500
    doodles: int = 30_000
    arrows: int = 7_000
    """Arrows of charts, and"""
    signs: int = 1_000
    """signs whose strokes are those of other kinds; both beside those that are among the things alone."""
    recipe: Recipe = EVERYBODY
    unseen: tuple[str, ...] = UNSEEN

    @property
    def total(self) -> int:
        return sum(getattr(self, name) for name in COUNTS)

    def scaled(self, share: float) -> Plan:
        """The same mixture, larger or smaller."""
        return replace(self, **{name: round(share * getattr(self, name)) for name in COUNTS})


@dataclass(frozen=True, slots=True)
class StrewnRule:
    """Pages on which things stand beside one another for no reason."""

    things: tuple[int, int] = (2, 9)
    size: tuple[float, float] = (25.0, 220.0)
    """Log-uniform range of a thing's size on its page of `paper` units, letters smaller by `letters`."""
    letters: float = 0.35
    paper: tuple[float, float] = (640.0, 480.0)
    doodle: float = 0.09
    """Share of things that are doodles,"""
    flow: float = 0.03
    """and of those that are arrows of charts."""
    lasso: float = 0.25
    """Share of pages on which a lasso is thrown about some things,"""
    scribble: float = 0.2
    """and on which one thing is rubbed out."""
    tapped: float = 0.3
    """Share of pages with a tap in a shape."""
    room: tuple[float, float] = (1.05, 1.7)
    """A lasso's box over that of what it holds."""
    tries: int = 12
    """Places tried before a thing may lie over another."""


STREWN = StrewnRule()


@dataclass(frozen=True, slots=True)
class _Gestures:
    """Gestures to be thrown over pages, in the order in which they are used up."""

    lassos: Sequence[LabelledItem] = field(default_factory=list[LabelledItem])
    scribbles: Sequence[LabelledItem] = field(default_factory=list[LabelledItem])
    taps: Sequence[LabelledItem] = field(default_factory=list[LabelledItem])


def drawings(plan: Plan, seed: int, part: int, parts: int) -> Iterator[Drawing]:
    """Part `part` of `parts` of the plan's drawings."""
    yield from things_alone(*_range(plan.alone, part, parts), seed, plan.recipe)
    yield from strewn(*_range(plan.strewn, part, parts), seed + 1, plan)
    yield from pages(*_range(plan.pages, part, parts), seed + 2)
    for item in doodles_of(*_range(plan.doodles, part, parts), seed + 3, plan):
        yield alone(item)
    for made, count, offset in ((flow_arrows, plan.arrows, 4), (signs, plan.signs, 5)):
        start, here = _range(count, part, parts)
        for item in made(here, seed + offset, start, plan.recipe):
            yield alone(item)


def things_alone(start: int, count: int, seed: int, recipe: Recipe = EVERYBODY) -> Iterator[Drawing]:
    """Things in one stroke or several, each on its own page."""
    for item in items(count, seed, start, ALONE, recipe):
        yield alone(item)


def doodles_of(start: int, count: int, seed: int, plan: Plan, unseen: bool = False) -> list[LabelledItem]:
    """Doodles of the families that are learned from, or of the others; fewer than `count`."""
    pairs = zip(
        doodles(count, seed, start, plan.recipe), oddities(count, seed, start, plan.recipe), strict=True
    )
    made = [ours if ours.index % DOODLED == 0 else other for ours, other in pairs]
    return [item for item in made if (NAMES[item.count] in plan.unseen) == unseen]


def pages(start: int, count: int, seed: int) -> Iterator[Drawing]:
    """Whole generated pages."""
    for index in range(start, start + count):
        turn, which = divmod(index, len(PROBLEMS))
        name = PROBLEMS[which]
        answers = ANSWERS[name]
        rng = np.random.default_rng([seed, index, 11])
        partly, cluttered = (rng.random(2) < PAGES).tolist()
        drawn = drawing_of(whole_page(name, seed, index, answers[turn % len(answers)], cluttered).truth)
        yield _partly(drawn, rng) if partly else drawn


def drawing_of(sketch: Sketch) -> Drawing:
    """A page of known meaning as a drawing."""
    things = [NONE] * len(sketch.ink)
    owners = [part.strokes for part in (*sketch.components, *sketch.expressions)]
    for number, strokes in enumerate(owners):
        for stroke in strokes:
            things[stroke] = number
    kinds = tuple(UNASKED if kind is None else STROKE_KINDS.index(kind) for kind in sketch.kinds())
    return Drawing(sketch.ink.strokes, kinds, tuple(things))


def strewn(start: int, count: int, seed: int, plan: Plan) -> Iterator[Drawing]:
    """Pages of things beside one another, with lassos, scribbles and taps over them."""
    most = STREWN.things[1]
    pool = items(count * most, seed, start * most, BESIDE, plan.recipe)
    odd = doodles_of(start, count, seed + 7_000, plan)
    flow = flow_arrows(count, seed + 11_000, start, plan.recipe)
    gestures = _Gestures(
        items(count, seed + 8_000, start, _only("lasso"), plan.recipe),
        items(count, seed + 9_000, start, _only("scribble"), plan.recipe),
        items(count, seed + 10_000, start, _only("tap"), plan.recipe),
    )
    for offset in range(count):
        rng = np.random.default_rng([seed, start + offset, 13])
        chosen = list(pool[offset * most : offset * most + int(rng.integers(STREWN.things[0], most + 1))])
        for place in range(len(chosen)):
            if odd and rng.random() < STREWN.doodle:
                chosen[place] = odd[int(rng.integers(len(odd)))]
            elif rng.random() < STREWN.flow:
                chosen[place] = flow[int(rng.integers(count))]
        yield _strewn(chosen, gestures, offset, rng)


def _only(kind: StrokeKind) -> Mapping[StrokeKind, float]:
    return {other: float(other == kind) for other in STROKE_KINDS}


def _strewn(
    chosen: Sequence[LabelledItem], gestures: _Gestures, number: int, rng: np.random.Generator
) -> Drawing:
    placed: list[tuple[LabelledItem, tuple[Stroke, ...]]] = []
    boxes: list[FloatArray] = []
    for item in chosen:
        strokes, box = _placed(item, boxes, rng)
        placed.append((item, strokes))
        boxes.append(box)
    u = rng.random(3)
    over: list[tuple[LabelledItem, tuple[Stroke, ...]]] = []
    shapes = [k for k, item in enumerate(chosen) if item.kind in ("circle", "polygon")]
    if u[0] < STREWN.tapped and shapes:
        box = boxes[shapes[int(rng.integers(len(shapes)))]]
        spot = box[:2] + rng.uniform(0.3, 0.7, 2) * (box[2:] - box[:2])
        item = gestures.taps[number]
        size = float(rng.uniform(0.3, 3.0))
        over.append((item, _fitted(item.strokes, spot - size / 2, spot + size / 2)))
    if u[1] < STREWN.lasso:
        held = [boxes[k] for k in rng.permutation(len(boxes))[: int(rng.integers(1, 4))]]
        low, high = np.min(held, axis=0)[:2], np.max(held, axis=0)[2:]
        middle, half = (low + high) / 2, (high - low) / 2
        room = rng.uniform(*STREWN.room, 2)
        over.append(
            (
                gestures.lassos[number],
                _stretched(
                    gestures.lassos[number].strokes, middle - room * half - 6, middle + room * half + 6
                ),
            )
        )
    elif u[2] < STREWN.scribble:
        box = boxes[int(rng.integers(len(boxes)))]
        middle, half = (box[:2] + box[2:]) / 2, (box[2:] - box[:2]) / 2
        reach = np.maximum(half * rng.uniform(0.5, 1.2, 2), 6.0)
        over.append(
            (
                gestures.scribbles[number],
                _stretched(gestures.scribbles[number].strokes, middle - reach, middle + reach),
            )
        )
    strokes, kinds, things = list[Stroke](), list[int](), list[int]()
    clock = 0.0
    for thing, (item, drawn) in enumerate([*placed, *over]):
        asked = item.kind is not None and item.kind not in ("tap", "lasso", "scribble")
        clock += float(rng.uniform(0.4, 2.0))
        for stroke in drawn:
            strokes.append(_later(stroke, clock))
            kinds.append(_number(item.kind))
            things.append(thing if asked else NONE)
        clock = _end(strokes[-1], clock)
    return Drawing(tuple(strokes), tuple(kinds), tuple(things))


def _placed(
    item: LabelledItem, boxes: Sequence[FloatArray], rng: np.random.Generator
) -> tuple[tuple[Stroke, ...], FloatArray]:
    """The item at a random size and place, where there is room if some is found."""
    every = np.concatenate([stroke.points for stroke in item.strokes])
    extent = np.ptp(every, axis=0)
    low, high = STREWN.size
    size = low * (high / low) ** float(rng.random())
    if item.kind == "math":
        size *= STREWN.letters
    if item.kind == "tap":
        size = float(rng.uniform(0.3, 3.0))
    scaled = extent * (size / max(float(np.hypot(*extent)), 1e-9))
    box = np.zeros(4)
    for _ in range(STREWN.tries):
        corner = rng.random(2) * np.maximum(np.array(STREWN.paper) - scaled, 1.0)
        box = np.concatenate([corner, corner + scaled])
        if all((box[2:] < other[:2]).any() or (other[2:] < box[:2]).any() for other in boxes):
            break
    return _fitted(item.strokes, box[:2], box[2:]), box


def _fitted(strokes: Sequence[Stroke], low: FloatArray, high: FloatArray) -> tuple[Stroke, ...]:
    """Strokes moved and scaled alike, so that their box has the middle and the diagonal of the box asked for."""
    every = np.concatenate([stroke.points for stroke in strokes])
    from_low, from_high = every.min(axis=0), every.max(axis=0)
    size = float(np.hypot(*(from_high - from_low)))
    scale = float(np.hypot(*(high - low))) / size if size > 0 else 1.0
    return _moved(strokes, (from_low + from_high) / 2, (low + high) / 2, np.array([scale, scale]))


def _stretched(strokes: Sequence[Stroke], low: FloatArray, high: FloatArray) -> tuple[Stroke, ...]:
    """The same, but filling the box both ways."""
    every = np.concatenate([stroke.points for stroke in strokes])
    from_low, from_high = every.min(axis=0), every.max(axis=0)
    scale = (high - low) / np.maximum(from_high - from_low, 1e-9)
    return _moved(strokes, (from_low + from_high) / 2, (low + high) / 2, scale)


def _moved(
    strokes: Sequence[Stroke], middle: FloatArray, to: FloatArray, scale: FloatArray
) -> tuple[Stroke, ...]:
    return tuple(
        Stroke.trusted((stroke.points - middle) * scale + to, stroke.times, stroke.pressure)
        for stroke in strokes
    )


def _partly(drawn: Drawing, rng: np.random.Generator) -> Drawing:
    """Some of the page's things only: a page is analysed before it is finished, too."""
    share = float(rng.uniform(0.2, 0.9))
    numbers = sorted(set(drawn.things))
    kept = {number for number in numbers if rng.random() < share} or {numbers[-1]}
    chosen = [k for k, thing in enumerate(drawn.things) if thing in kept]
    return Drawing(
        tuple(drawn.strokes[k] for k in chosen),
        tuple(drawn.kinds[k] for k in chosen),
        tuple(drawn.things[k] for k in chosen),
    )


def alone(item: LabelledItem) -> Drawing:
    """The item on a page of its own."""
    count = len(item.strokes)
    return Drawing(item.strokes, (_number(item.kind),) * count, (NONE if item.kind is None else 0,) * count)


def _number(kind: StrokeKind | None) -> int:
    return NONE if kind is None else STROKE_KINDS.index(kind)


def _later(stroke: Stroke, by: float) -> Stroke:
    times = None if stroke.times is None else stroke.times + by
    return Stroke.trusted(stroke.points, times, stroke.pressure)


def _end(stroke: Stroke, clock: float) -> float:
    return clock if stroke.times is None else float(stroke.times[-1])


def _range(count: int, part: int, parts: int) -> tuple[int, int]:
    first, last = count * part // parts, count * (part + 1) // parts
    return first, last - first
