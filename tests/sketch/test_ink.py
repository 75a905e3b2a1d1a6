"""The border: what ink is let in, and that what is refused is told why."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from strategies import inks, shapes, sketches, strokes

from sketch.ink import LIMITS, Ink, InkError, Stroke
from sketch.page import (
    Association,
    Component,
    Expression,
    Gesture,
    Sketch,
    SketchError,
    label,
)
from sketch.shapes import (
    Arrow,
    Circle,
    Polygon,
    Shape,
    ShapeError,
    Spring,
    Wire,
    kind_of,
    outline,
)


@pytest.mark.parametrize(
    ("points", "times", "pressure", "says"),
    [
        ([], None, None, "points"),
        (np.empty((0, 2)), None, None, "at least one"),
        ([1, 2], None, None, r"needs \(n, 2\)"),
        ([[1, 2, 3]], None, None, r"needs \(n, 2\)"),
        ([[1, 2], [3]], None, None, "regular array"),
        ([["a", "b"]], None, None, "regular array"),
        ([[1, float("nan")]], None, None, "points 0 is not a finite number"),
        ([[1, 2], [float("inf"), 2]], None, None, "points 1 is not a finite number"),
        ([[1, 10**400]], None, None, "numbers"),
        ([[2e9, 0]], None, None, "beyond"),
        (np.zeros((LIMITS.points + 1, 2)), None, None, f"at most {LIMITS.points}"),
        ([[1, 2], [3, 4]], [0], None, "one value per point"),
        ([[1, 2], [3, 4]], [0, float("nan")], None, "times 1 is not a finite number"),
        ([[1, 2], [3, 4]], [1, 0.5], None, "time runs backwards at point 1: 0.5 s after 1 s"),
        ([[1, 2], [3, 4]], None, [0.1, 0.2, 0.3], "one value per point"),
        ([[1, 2]], None, [float("inf")], "pressure 0 is not a finite number"),
    ],
)
def test_a_stroke_that_no_pen_draws_is_refused(
    points: object, times: object, pressure: object, says: str
) -> None:
    with pytest.raises(InkError, match=says):
        Stroke(points, times, pressure)


def test_a_dot_equal_times_and_extreme_clocks_are_ink() -> None:
    assert len(Stroke([[1, 2]], [0], [1])) == 1
    assert len(Stroke([[1, 2], [1, 2]], [5, 5])) == 2
    assert len(Stroke([[1, 2], [1, 2]], [-1.7e308, 1.7e308])) == 2


def test_a_page_of_too_much_is_refused() -> None:
    dot = Stroke([[0, 0]])
    with pytest.raises(InkError, match=f"at most {LIMITS.strokes}"):
        Ink((dot,) * (LIMITS.strokes + 1))
    long = Stroke(np.zeros((LIMITS.points, 2)))
    with pytest.raises(InkError, match=f"at most {LIMITS.total_points}"):
        Ink((long,) * (LIMITS.total_points // LIMITS.points + 1))


def test_ten_thousand_strokes_are_a_page() -> None:
    ink = Ink(tuple(Stroke([[k, -k]]) for k in range(10_000)))
    assert len(ink) == 10_000
    assert ink.bounds() == (0.0, -9999.0, 9999.0, 0.0)
    assert ink.points_of([3, 5]).tolist() == [[3, -3], [5, -5]]
    assert Ink().bounds() == (0.0, 0.0, 0.0, 0.0)
    assert ink.points_of([]).shape == (0, 2)


@given(strokes())
def test_a_stroke_cannot_be_changed_and_is_copied_from_its_source(stroke: Stroke) -> None:
    with pytest.raises(ValueError, match="read-only"):
        stroke.points[0, 0] = 1
    source = stroke.points.copy()
    copy = Stroke(source, stroke.times, stroke.pressure)
    source[0, 0] += 1.0
    assert copy == stroke
    assert hash(copy) == hash(stroke)


@given(inks())
def test_pickling_changes_no_bit_of_ink(ink: Ink) -> None:
    assert pickle.loads(pickle.dumps(ink)) == ink


def test_strokes_differ_by_the_bit() -> None:
    assert Stroke([[0.0, 1]]) != Stroke([[-0.0, 1]])
    assert Stroke([[0.0, 1]]) != Stroke([[0.0, 1]], [0])
    assert Stroke([[0.0, 1]], [0]) != Stroke([[0.0, 1]], None, [0])


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: Circle((0, 0), 0), "radius 0; it must be above zero"),
        (lambda: Circle((0, float("nan")), 1), "the circle has a coordinate that is not a finite number"),
        (lambda: Polygon([[0, 0], [1, 1]]), r"shape \(2, 2\); needed is \(n, 2\) with n at least 3"),
        (lambda: Polygon([[0, 0], [1, 1], [float("inf"), 0]]), "the polygon has a coordinate"),
        (lambda: Wire((1, 2), (1, 2)), r"a wire of no length at \(1, 2\)"),
        (lambda: Spring((1, 2), (1, 2), 3, 4), "a spring of no length"),
        (lambda: Spring((1, 2), (3, 2), float("nan"), 4), "the spring has a coordinate"),
        (lambda: Arrow((1, 2), (1, 2)), "an arrow of no length"),
    ],
)
def test_a_shape_that_cannot_be_is_refused(make: object, says: str) -> None:
    with pytest.raises(ShapeError, match=says):
        make()


@given(shapes)
def test_an_outline_closes_where_the_shape_does(shape: Shape) -> None:
    path = outline(shape)
    assert path.shape[1] == 2
    if kind_of(shape) in ("circle", "polygon"):
        assert path[0].tolist() == path[-1].tolist()
    else:
        assert path.tolist() == [list(shape.start), list(shape.end)]
    assert pickle.loads(pickle.dumps(shape)) == shape


CIRCLE = Circle((0, 0), 1)
INK = Ink((Stroke([[0, 0]]), Stroke([[1, 1]])))


@pytest.mark.parametrize(
    ("parts", "says"),
    [
        ({"components": (Component(CIRCLE), Component(CIRCLE))}, "label 'A' is borne by two components"),
        ({"components": (Component(CIRCLE, (2,)),)}, "names stroke 2; the page has 2"),
        ({"components": (Component(CIRCLE, (-1,)),)}, "names stroke -1"),
        ({"components": (Component(CIRCLE, (0,)),), "gestures": (Gesture("tap", 0),)}, "one owner at most"),
        ({"expressions": (Expression("x", (1, 1)),)}, "claimed as math and as math"),
        (
            {"components": (Component(Wire((0, 0), (1, 1)), ends=("B", None)),)},
            "attached to 'B', which is not there",
        ),
        ({"associations": (Association(0, "A", (0, 0)),)}, "names expression 0; the page has 0"),
        (
            {"expressions": (Expression("x"),), "associations": (Association(0, "A", (0, 0)),)},
            "names component 'A'",
        ),
    ],
)
def test_a_page_that_contradicts_itself_is_refused(parts: dict[str, tuple[object, ...]], says: str) -> None:
    with pytest.raises(SketchError, match=says):
        Sketch(INK, **parts)


@settings(max_examples=50, deadline=None)
@given(sketches())
def test_every_stroke_has_the_kind_of_what_owns_it(sketch: Sketch) -> None:
    kinds = sketch.kinds()
    assert len(kinds) == len(sketch.ink)
    for component in sketch.components:
        assert {kinds[stroke] for stroke in component.strokes} <= {component.kind}
        assert sketch.component(component.label) is component
    assert sum(kind is not None for kind in kinds) == sum(
        len(owner.strokes) for owner in (*sketch.components, *sketch.expressions)
    ) + len(sketch.gestures)


def test_labels_are_given_out_without_repeat() -> None:
    given_out = [label(rank) for rank in range(2000)]
    assert given_out[:3] == ["A", "B", "C"]
    assert given_out[25:28] == ["Z", "AA", "AB"]
    assert len(set(given_out)) == len(given_out)
    with pytest.raises(KeyError):
        Sketch().component("A")
