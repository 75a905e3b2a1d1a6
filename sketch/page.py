"""The page: what was drawn, and what it is taken to mean.

A `Sketch` is both the generator's truth and a recognizer's claim, so that every metric is
one function of two values of the same type.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

from sketch.ink import Ink
from sketch.shapes import ComponentKind, Point, Shape, kind_of

StrokeKind = Literal["circle", "polygon", "spring", "wire", "arrow", "tap", "scribble", "lasso", "math"]
STROKE_KINDS: tuple[StrokeKind, ...] = (
    "circle",
    "polygon",
    "spring",
    "wire",
    "arrow",
    "tap",
    "scribble",
    "lasso",
    "math",
)
GestureKind = Literal["tap", "scribble", "lasso"]
GESTURE_KINDS: tuple[GestureKind, ...] = ("tap", "scribble", "lasso")


class SketchError(ValueError):
    """A page that contradicts itself: an index or a label that is not there."""


@dataclass(frozen=True, slots=True)
class Component:
    """A thing on the page that physics knows.

    shape: its ideal shape; strokes: indices into the page's ink; label: "A", "B" …, unique on
    the page; fixed: immobile; ends: for springs and wires, the labels of the components at
    start and end, None where an end hangs free.
    """

    shape: Shape
    strokes: tuple[int, ...] = ()
    label: str = "A"
    fixed: bool = False
    ends: tuple[str | None, str | None] = (None, None)

    @property
    def kind(self) -> ComponentKind:
        return kind_of(self.shape)


@dataclass(frozen=True, slots=True)
class Expression:
    """A line of mathematics.

    text: as written or typed, in the formula language, None while nobody has read it;
    tree: its SymPy tree, None when there is no text or the text is not a formula, in which case
    problem says why; at: where on the page it stands (its centre), page units.
    """

    text: str | None
    strokes: tuple[int, ...] = ()
    at: Point | None = None
    tree: Any = field(default=None, compare=False)
    problem: str | None = field(default=None, compare=False)
    confidence: float = 1.0
    alternatives: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Association:
    """An expression (index into the page's expressions) governs a component (its label).

    anchor: where on the component it was tapped, page units: an angle near the top end of a wire
    means something else than one near its bottom end.
    """

    expression: int
    component: str
    anchor: Point


@dataclass(frozen=True, slots=True)
class Gesture:
    """A stroke that said something instead of drawing something."""

    kind: GestureKind
    stroke: int


@dataclass(frozen=True, slots=True)
class Sketch:
    """A page of ink with its meaning.

    Strokes that belong to nothing were claimed by nobody (rejected, or not analysed yet).
    Raises SketchError when a stroke index, an expression index or a label does not exist, when
    two components share a label, or when two owners claim one stroke.
    """

    ink: Ink = field(default_factory=Ink)
    components: tuple[Component, ...] = ()
    expressions: tuple[Expression, ...] = ()
    associations: tuple[Association, ...] = ()
    gestures: tuple[Gesture, ...] = ()

    def __post_init__(self) -> None:
        labels = [component.label for component in self.components]
        if len(set(labels)) < len(labels):
            twice = min(label for label in labels if labels.count(label) > 1)
            raise SketchError(f"label {twice!r} is borne by two components; labels must be unique")
        self.kinds()
        for component in self.components:
            for end in component.ends:
                if end is not None and end not in labels:
                    raise SketchError(
                        f"component {component.label!r} is attached to {end!r}, which is not there"
                    )
        for index, association in enumerate(self.associations):
            if not 0 <= association.expression < len(self.expressions):
                raise SketchError(
                    f"association {index} names expression {association.expression}; "
                    f"the page has {len(self.expressions)}"
                )
            if association.component not in labels:
                raise SketchError(
                    f"association {index} names component {association.component!r}, which is not there"
                )

    def component(self, label: str) -> Component:
        """The component that bears the label. Raises KeyError when there is none."""
        for component in self.components:
            if component.label == label:
                return component
        raise KeyError(label)

    def kinds(self) -> tuple[StrokeKind | None, ...]:
        """For every stroke of the ink what it is taken to be; None when nobody claims it."""
        kinds: list[StrokeKind | None] = [None] * len(self.ink)
        claimed: list[tuple[StrokeKind, int]] = [
            *((component.kind, stroke) for component in self.components for stroke in component.strokes),
            *(("math", stroke) for expression in self.expressions for stroke in expression.strokes),
            *((gesture.kind, gesture.stroke) for gesture in self.gestures),
        ]
        for kind, stroke in claimed:
            if not 0 <= stroke < len(kinds):
                raise SketchError(f"a {kind} names stroke {stroke}; the page has {len(kinds)}")
            if kinds[stroke] is not None:
                raise SketchError(
                    f"stroke {stroke} is claimed as {kinds[stroke]} and as {kind}; one owner at most"
                )
            kinds[stroke] = kind
        return tuple(kinds)


def label(rank: int) -> str:
    """The label given out at a rank in reading order: A, B … Z, AA, AB … for 0, 1 …"""
    rest, letters = rank + 1, ""
    while rest:
        rest, digit = divmod(rest - 1, 26)
        letters = chr(ord("A") + digit) + letters
    return letters
