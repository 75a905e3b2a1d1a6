"""Whole pages: a diagram as it was meant, and the ink that one person made of it.

Frame: page units, y down; seconds. The truth is exact: shapes, ends, angles and formulas are what
was meant, and name the strokes that drew them; the ink is what the pen did. Page i of a seed
depends on (seed, i) alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from data_gen import drawing, layout, typeset
from data_gen.diagrams.problem import Expected, Problem
from data_gen.pen import draw_batch, strokes_from
from data_gen.problems import ANSWERS, PROBLEMS, problem
from data_gen.strokes import RULE as STROKE_RULE
from data_gen.writers import Writer, sample_writer
from sketch.formula.parse import expression
from sketch.geometry import bounding_box, diagonal
from sketch.ink import FloatArray, Ink, Stroke
from sketch.page import Association, Component, Gesture, Sketch
from sketch.shapes import Circle, Point, Polygon, outline


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


def page(name: str, seed: int, index: int, answer: str = "right") -> Page:
    """The diagram `name` with an answer, drawn by a random writer; always the same for the same arguments.

    Raises ValueError on a name or an answer that is not known, or a negative seed or index.
    """
    if seed < 0 or index < 0:
        raise ValueError(f"seed {seed} and index {index}: both must be zero or more")
    rng = np.random.default_rng([seed, index])
    writer = sample_writer(rng)
    meant = problem(name, answer, rng)
    return Page(name, answer, seed, index, _inked(meant, writer, rng), meant.seconds, meant.expected, writer)


def pages(count: int, seed: int, start: int = 0) -> Iterator[Page]:
    """Pages start … start + count − 1 of a seed: the six diagrams in turn, and each through its answers."""
    for index in range(start, start + count):
        turn, which = divmod(index, len(PROBLEMS))
        name = PROBLEMS[which]
        yield page(name, seed, index, ANSWERS[name][turn % len(ANSWERS[name])])


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
    """The writer at a shape of this size: beyond `steady` the eye corrects what the arm would stray."""
    size = diagonal(outline(component.shape))
    return replace(writer, wobble=writer.wobble * min(1.0, (RULE.steady / size) ** 0.5))


@dataclass(frozen=True, slots=True)
class _Thing:
    """What is drawn in one go: a component, a tap or a line, by its number; and its meant paths."""

    role: str
    number: int
    paths: Sequence[FloatArray]
    writer: Writer


def _inked(meant: Problem, writer: Writer, rng: np.random.Generator) -> Sketch:
    """The truth with ink: draws everything thing by thing, and notes whose each stroke is."""
    hand = typeset.hand(writer, rng)
    lines = [typeset.line(remark.text, hand) for remark in meant.remarks]
    sizes = [_size(line) for line in lines]
    wishes = [remark.about[0][1] if remark.about else None for remark in meant.remarks]
    places = layout.place(sizes, wishes, meant.components, writer.height, rng)
    truth = meaning(meant, places)

    quick = replace(writer, speed=STROKE_RULE.tap_speed * writer.speed, hooks=0.0)
    small = replace(writer, wobble=STROKE_RULE.loose * writer.wobble)
    shapes = [
        _Thing("component", number, drawing.paths(component.shape, writer, rng), _steadied(writer, component))
        for number, component in enumerate(meant.components)
    ]
    taps = [
        _Thing("tap", number, [drawing.tap(component.shape, rng)], quick)
        for number, component in enumerate(meant.components)
        if component.fixed and isinstance(component.shape, Circle | Polygon)
    ]
    mathematics = [
        _Thing("line", number, [path + centre for path in line], small)
        for number, (line, centre) in enumerate(zip(lines, places, strict=True))
    ]
    things = _in_drawing_order(shapes, taps, mathematics, meant, rng)
    return _owned(truth, things, _drawn(things, rng))


def _size(line: Sequence[FloatArray]) -> layout.Size:
    low, high = bounding_box(np.concatenate(line))
    return (float(high[0] - low[0]), float(high[1] - low[1]))


def _in_drawing_order(
    shapes: Sequence[_Thing],
    taps: Sequence[_Thing],
    mathematics: Sequence[_Thing],
    meant: Problem,
    rng: np.random.Generator,
) -> list[_Thing]:
    """Shapes, taps, mathematics: roughly in this order, differently from page to page."""
    shuffled = [shapes[k] for k in rng.permutation(len(shapes))]
    held_first, at_once, last = rng.random(3) < [RULE.held_first, RULE.tapped_at_once, RULE.mathematics_last]
    if held_first:
        shuffled.sort(key=lambda thing: not meant.components[thing.number].fixed)
    if at_once:
        tap_of = {tap.number: tap for tap in taps}
        drawn = [part for shape in shuffled for part in (shape, tap_of.get(shape.number)) if part is not None]
        return [*drawn, *mathematics]
    return [*shuffled, *taps, *mathematics] if last else [*shuffled, *mathematics, *taps]


def _drawn(things: Sequence[_Thing], rng: np.random.Generator) -> list[Stroke]:
    """The ink of all things, one stroke after another in time."""
    paths = [path for thing in things for path in thing.paths]
    writers = [thing.writer for thing in things for _ in thing.paths]
    strokes = strokes_from(draw_batch(paths, writers, rng.spawn(len(paths))))
    clock, timed = 0.0, list[Stroke]()
    firsts = {sum(len(thing.paths) for thing in things[:k]) for k in range(len(things))}
    for index, stroke in enumerate(strokes):
        if index > 0:
            clock += rng.uniform(*(RULE.thought if index in firsts else RULE.lift))
        times = np.zeros(len(stroke)) if stroke.times is None else stroke.times - stroke.times[0]
        timed.append(Stroke(stroke.points, clock + times, stroke.pressure))
        clock += float(times[-1])
    return timed


def _owned(truth: Sketch, things: Sequence[_Thing], strokes: Sequence[Stroke]) -> Sketch:
    """The truth with its ink, every stroke in the hands of the thing that it drew."""
    components, expressions = list(truth.components), list(truth.expressions)
    gestures: list[Gesture] = []
    first = 0
    for thing in things:
        owned = tuple(range(first, first + len(thing.paths)))
        first += len(owned)
        match thing.role:
            case "component":
                components[thing.number] = replace(components[thing.number], strokes=owned)
            case "tap":
                gestures.append(Gesture("tap", owned[0]))
            case _:
                expressions[thing.number] = replace(expressions[thing.number], strokes=owned)
    return replace(
        truth,
        ink=Ink(tuple(strokes)),
        components=tuple(components),
        expressions=tuple(expressions),
        gestures=tuple(gestures),
    )
