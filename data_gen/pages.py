"""Whole pages: a diagram as it was meant, and the ink that one person made of it.

Frame: page units, y down; seconds. The truth is exact: shapes, ends, angles and formulas are what
was meant, and name the strokes that drew them; the ink is what the pen did. Page i of a seed
depends on (seed, i) alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Literal, assert_never

import numpy as np

from data_gen import drawing, layout, typeset
from data_gen.clutter import Clutter, clutter
from data_gen.diagrams.problem import Expected, Problem
from data_gen.hand.batch import LOOSE
from data_gen.pen import draw_each
from data_gen.problems import ANSWERS, PROBLEMS, problem
from data_gen.writers import Writer, sample_writer
from sketch.formula.parse import expression
from sketch.geometry import bounding_box
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import Association, Component, Gesture, Sketch
from sketch.shapes import Circle, Point, Polygon, Shape, Spring, Wire, outline


@dataclass(frozen=True, slots=True)
class PageRule:
    """The order and the pauses in which a page is drawn."""

    held_first: float = 0.7
    """Share of pages on which what is fixed is drawn before what moves."""
    tapped_at_once: float = 0.25
    """Share of pages on which a shape is tapped right after it was drawn, not when all are."""
    mathematics_last: float = 0.85
    """Share of pages whose mathematics comes after the taps rather than before them."""
    steady: float = 120.0
    """A shape's waver grows as its size up to here (page units), and as the root of it beyond."""
    late: float = 12.0
    """A slow device misses at most about twice this length (page units) of a shape's outline."""
    lift: tuple[float, float] = (0.12, 0.4)
    """Pause between two strokes of one thing, s."""
    thought: tuple[float, float] = (0.5, 2.0)
    """Pause between two things, s."""


RULE = PageRule()


@dataclass(frozen=True, slots=True)
class Page:
    """A page and what is known of it.

    name: the diagram, of `PROBLEMS`; answer: of `ANSWERS[name]`; truth: what was meant, with the ink;
    seconds: how long to watch it move; expected: what must then be seen.
    """

    name: str
    answer: str
    seed: int
    index: int
    truth: Sketch
    seconds: float
    expected: Expected
    writer: Writer


def page(name: str, seed: int, index: int, answer: str = "right", cluttered: bool = False) -> Page:
    """The diagram `name` with an answer, drawn by a random writer; always the same for the same arguments.
    cluttered: with stray marks and crossings-out, whose strokes the truth gives to nobody.

    Raises ValueError on a name or an answer that is not known, or a negative seed or index.
    """
    return drawn(name, seed, index, answer, lambda rng: problem(name, answer, rng), cluttered)


def drawn(
    name: str,
    seed: int,
    index: int,
    answer: str,
    meant_by: Callable[[np.random.Generator], Problem],
    cluttered: bool = False,
) -> Page:
    """A diagram of that name drawn by a random writer. meant_by: what is drawn, from the page's own generator.

    Raises ValueError on a negative seed or index.
    """
    if seed < 0 or index < 0:
        raise ValueError(f"seed {seed} and index {index}: both must be zero or more")
    rng = np.random.default_rng([seed, index])
    writer = sample_writer(rng)
    meant = meant_by(rng)
    stray = clutter(writer.height, rng) if cluttered else []
    truth = _inked(meant, stray, writer, rng)
    return Page(name, answer, seed, index, truth, meant.seconds, meant.expected, writer)


def pages(count: int, seed: int, start: int = 0, cluttered: bool = False) -> Iterator[Page]:
    """Pages start … start + count − 1 of a seed: the six diagrams in turn, and each through its answers."""
    for index in range(start, start + count):
        turn, which = divmod(index, len(PROBLEMS))
        name = PROBLEMS[which]
        yield page(name, seed, index, ANSWERS[name][turn % len(ANSWERS[name])], cluttered)


def meaning(meant: Problem, places: Sequence[Point | None] = ()) -> Sketch:
    """The diagram as a sketch without ink; places: the centre of each line of mathematics, if it has one."""
    where = places or [None] * len(meant.remarks)
    return Sketch(
        components=meant.components,
        expressions=tuple(
            expression(remark.text, at=at) for remark, at in zip(meant.remarks, where, strict=True)
        ),
        associations=tuple(
            Association(index, label, spot)
            for index, remark in enumerate(meant.remarks)
            for label, spot in remark.about
        ),
    )


def _steadied(writer: Writer, component: Component) -> Writer:
    """The writer at a shape of this size. The pen strays in proportion to a stroke; on large and on thin
    shapes the eye corrects it, and a device wakes up after a time, not after a share of the drawing."""
    low, high = bounding_box(outline(component.shape))
    width, height = (high - low).tolist()
    size = float(np.hypot(width, height))
    waver = min(1.0, (RULE.steady / size) ** 0.5)
    if isinstance(component.shape, Circle | Polygon):
        waver = min(waver, (2 * width * height) ** 0.5 / size)  # 1 for a square
    late = min(writer.late, RULE.late / max(size, 1.0))
    return replace(writer, wobble=waver * writer.wobble, late=late)


@dataclass(frozen=True, slots=True)
class _Thing:
    """What is drawn in one go: a component, a tap, a line of mathematics, a stray mark or a crossed-out sign."""

    role: Literal["component", "tap", "line", "stray", "crossed"]
    number: int
    paths: Sequence[FloatArray]
    writer: Writer
    strokes: Sequence[Stroke] = ()


def _inked(meant: Problem, stray: Sequence[Clutter], writer: Writer, rng: np.random.Generator) -> Sketch:
    """The truth with ink: draws everything thing by thing, and notes whose each stroke is."""
    hand = typeset.hand(writer, rng)
    lines = [typeset.line(remark.text, hand) for remark in meant.remarks]
    wishes = [remark.about[0][1] if remark.about else None for remark in meant.remarks]
    sizes = [_size(line) for line in (*lines, *(piece.paths for piece in stray))]
    wishes += [None] * len(stray)
    places = layout.place(sizes, wishes, meant.components, writer.height, rng)
    dots, letters = replace(writer, hooks=0.0), replace(writer, wobble=LOOSE * writer.wobble)

    def component(number: int, part: Component, shape: Shape) -> _Thing:
        return _Thing("component", number, drawing.paths(shape, writer, rng), _steadied(writer, part))

    numbered = list(enumerate(meant.components))
    solids = [
        component(number, part, part.shape)
        for number, part in numbered
        if isinstance(part.shape, Circle | Polygon)
    ]
    solids = _with_ink(solids, rng)
    # A link is drawn to where the solids have come to be on paper.
    on_paper = {
        part.label: drawing.Drawn(part.shape, solid.strokes)
        for solid in solids
        if isinstance((part := meant.components[solid.number]).shape, Circle | Polygon)
    }
    links = [
        component(number, part, drawing.led_to(part.shape, part.ends, on_paper))
        for number, part in numbered
        if isinstance(part.shape, Spring | Wire)
    ]
    taps = [
        _Thing("tap", number, [drawing.tap(part.shape, rng)], dots)
        for number, part in numbered
        if part.fixed and isinstance(part.shape, Circle | Polygon)
    ]
    mathematics = [
        _Thing("line", number, [path + centre for path in line], letters)
        for number, (line, centre) in enumerate(zip(lines, places, strict=False))
    ]
    mathematics += [
        _Thing(
            "crossed" if piece.crossed else "stray", number, [path + centre for path in piece.paths], letters
        )
        for number, (piece, centre) in enumerate(zip(stray, places[len(lines) :], strict=True))
    ]
    if stray:
        mathematics = [mathematics[k] for k in rng.permutation(len(mathematics))]
    rest = _with_ink([*links, *taps, *mathematics], rng)
    return _owned(meaning(meant, places[: len(lines)]), _in_drawing_order([*solids, *rest], meant, rng), rng)


def _size(line: Sequence[FloatArray]) -> layout.Size:
    low, high = bounding_box(np.concatenate(line))
    return (float(high[0] - low[0]), float(high[1] - low[1]))


def _with_ink(things: Sequence[_Thing], rng: np.random.Generator) -> list[_Thing]:
    """The things with their ink, each stroke's times beginning at 0."""
    paths = [path for thing in things for path in thing.paths]
    writers = [thing.writer for thing in things for _ in thing.paths]
    strokes = iter(draw_each(paths, writers, rng))
    return [replace(thing, strokes=tuple(islice(strokes, len(thing.paths)))) for thing in things]


def _in_drawing_order(things: Sequence[_Thing], meant: Problem, rng: np.random.Generator) -> list[_Thing]:
    """Shapes, taps, mathematics: roughly in this order, differently from page to page."""
    shapes = [thing for thing in things if thing.role == "component"]
    taps = [thing for thing in things if thing.role == "tap"]
    mathematics = [thing for thing in things if thing.role not in ("component", "tap")]
    shuffled = [shapes[k] for k in rng.permutation(len(shapes))]
    held_first, at_once, last = rng.random(3) < [RULE.held_first, RULE.tapped_at_once, RULE.mathematics_last]
    if held_first:
        shuffled.sort(key=lambda thing: not meant.components[thing.number].fixed)
    if at_once:
        tap_of = {tap.number: tap for tap in taps}
        drawn = [part for shape in shuffled for part in (shape, tap_of.get(shape.number)) if part is not None]
        return [*drawn, *mathematics]
    return [*shuffled, *taps, *mathematics] if last else [*shuffled, *mathematics, *taps]


def _owned(truth: Sketch, things: Sequence[_Thing], rng: np.random.Generator) -> Sketch:
    """The truth with the ink of these things, one stroke after another in time, each in the hands of
    the thing that it drew."""
    components, expressions = list(truth.components), list(truth.expressions)
    gestures: list[Gesture] = []
    strokes: list[Stroke] = []
    clock = 0.0
    for thing in things:
        owned = tuple(range(len(strokes), len(strokes) + len(thing.strokes)))
        for index, stroke in enumerate(thing.strokes):
            if strokes:
                clock += float(rng.uniform(*(RULE.lift if index else RULE.thought)))
            times = clock + (np.zeros(len(stroke)) if stroke.times is None else stroke.times)
            strokes.append(Stroke(stroke.points, times, stroke.pressure))
            clock = float(times[-1])
        match thing.role:
            case "component":
                components[thing.number] = replace(components[thing.number], strokes=owned)
            case "tap":
                gestures.extend(Gesture("tap", stroke) for stroke in owned)
            case "line":
                expressions[thing.number] = replace(expressions[thing.number], strokes=owned)
            case "crossed":
                gestures.append(Gesture("scribble", owned[-1]))
            case "stray":
                pass
            case _:
                assert_never(thing.role)
    return replace(
        truth,
        ink=Ink(tuple(strokes)),
        components=tuple(components),
        expressions=tuple(expressions),
        gestures=tuple(gestures),
    )
