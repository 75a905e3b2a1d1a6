"""Hypothesis strategies for the page's values: any ink, any sketch, any formula tree.

pytest puts this folder on the path (`pythonpath` in pyproject.toml): `from strategies import inks`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import sympy
from hypothesis import strategies as st
from sympy.core.basic import Basic

from sketch.formula.build import Unbuildable, add, call, multiply, power, reciprocal
from sketch.formula.names import FUNCTIONS, GREEK, UNIT_NAMES
from sketch.formula.parse import expression
from sketch.formula.units import unit
from sketch.ink import LIMITS, Ink, Stroke
from sketch.page import GESTURE_KINDS, Association, Component, Expression, Gesture, Sketch
from sketch.shapes import Arrow, Circle, Link, Polygon, Shape, Solid, Spring, Wire

# Formulas ---------------------------------------------------------------------------------------

_letters = st.sampled_from([*"abcdefgGFTWkmrtvxye", *sorted(GREEK - {"pi"})])
_subscripts = st.sampled_from(
    ["", "", "", "_1", "_12", "_x", "_Ax", "_net", "_theta", "_1x", "_x0", "'", "_2'", "_A''"]
)
symbols = st.builds(lambda letter, below: sympy.Symbol(letter + below), _letters, _subscripts)
numbers = st.integers(0, 50).map(sympy.Integer) | st.fractions(0, 100, max_denominator=200).map(
    lambda value: sympy.Rational(value.numerator, value.denominator)
)
units = st.lists(
    st.builds(
        lambda name, power: unit(name) ** power, st.sampled_from(sorted(UNIT_NAMES)), st.integers(-3, 3)
    ),
    min_size=1,
    max_size=3,
).map(lambda factors: sympy.Mul(*factors))
"""Products of units, that of none included."""


def _or_symbol(build: Callable[..., Basic]) -> Callable[..., Basic]:
    """The built tree, or a plain symbol for operands that do not go together (1/0, √−1)."""

    def built(*operands: Basic) -> Basic:
        try:
            return build(*operands)
        except Unbuildable:
            return sympy.Symbol("q")

    return built


def _composites(scalars: st.SearchStrategy[Basic]) -> st.SearchStrategy[Basic]:
    names = st.sampled_from(sorted(FUNCTIONS))
    minus = sympy.S.NegativeOne
    return st.one_of(
        st.builds(_or_symbol(lambda *terms: add(terms)), scalars, scalars),
        st.builds(_or_symbol(lambda a, b, c: add([a, multiply([minus, b]), c])), scalars, scalars, scalars),
        st.builds(_or_symbol(lambda *factors: multiply(factors)), scalars, scalars, scalars),
        st.builds(_or_symbol(lambda a, b: multiply([a, reciprocal(b)])), scalars, scalars),
        st.builds(_or_symbol(lambda number, measure: multiply([number, measure])), scalars, units),
        st.builds(_or_symbol(power), scalars, scalars),
        st.builds(_or_symbol(lambda base: power(base, sympy.Rational(1, 2))), scalars),
        st.builds(_or_symbol(lambda name, argument: call(name, argument)), names, scalars),
    )


scalars = st.recursive(symbols | numbers | st.just(sympy.pi), _composites, max_leaves=12)
vectors = st.lists(scalars, min_size=2, max_size=3).map(lambda components: sympy.Tuple(*components))
trees = st.one_of(
    scalars,
    vectors,
    st.builds(lambda left, right: sympy.Equality(left, right, evaluate=False), scalars, scalars | vectors),
)
"""Any tree that the formula language has."""

# Ink --------------------------------------------------------------------------------------------

coordinates = st.floats(-LIMITS.coordinate, LIMITS.coordinate)
points = st.tuples(coordinates, coordinates)
finite = st.floats(allow_nan=False, allow_infinity=False)


@st.composite
def strokes(draw: st.DrawFn, most_points: int = 12) -> Stroke:
    """Any stroke that the border lets in: with or without times and pressure."""
    path = draw(st.lists(points, min_size=1, max_size=most_points))
    channel = st.lists(finite, min_size=len(path), max_size=len(path))
    return Stroke(path, draw(st.none() | channel.map(sorted)), draw(st.none() | channel))


def inks(most_strokes: int = 4) -> st.SearchStrategy[Ink]:
    """Any ink, an empty page included."""
    return st.lists(strokes(), max_size=most_strokes).map(lambda drawn: Ink(tuple(drawn)))


# Shapes and pages -------------------------------------------------------------------------------

_sizes = st.floats(1e-3, 1e6)
_segments = st.tuples(points, points).filter(lambda ends: ends[0] != ends[1])
circles = st.builds(Circle, points, _sizes)
polygons = st.lists(points, min_size=3, max_size=8).map(Polygon)
solids: st.SearchStrategy[Solid] = circles | polygons
links: st.SearchStrategy[Link] = st.builds(lambda ends: Wire(*ends), _segments) | st.builds(
    lambda ends, coils, width: Spring(*ends, coils, width), _segments, st.floats(0, 1e3), _sizes
)
arrows = st.builds(lambda ends: Arrow(*ends), _segments)
shapes: st.SearchStrategy[Shape] = solids | links | arrows
texts = st.text(max_size=20) | st.sampled_from(
    ["g = 10", "f_1 = |W| cos(theta)", r"\theta=\frac{\pi}{6}", "x = (0, 5)"]
)


@st.composite
def sketches(draw: st.DrawFn) -> Sketch:
    """Any page: consistent, but otherwise of any content (formulas that are none, shapes far off)."""
    ink = draw(inks())
    free = draw(st.permutations(range(len(ink))))
    names = draw(st.lists(st.text(min_size=1, max_size=3), max_size=4, unique=True))
    end = st.none() | (st.sampled_from(names) if names else st.none())

    def some_strokes() -> tuple[int, ...]:
        taken = draw(st.integers(0, len(free)))
        mine = tuple(free[:taken])
        del free[:taken]
        return mine

    components = tuple(
        Component(draw(shapes), some_strokes(), name, draw(st.booleans()), (draw(end), draw(end)))
        for name in names
    )
    expressions = tuple(
        replace(
            Expression(None, some_strokes())
            if text is None
            else expression(text, some_strokes(), draw(st.none() | points)),
            confidence=draw(st.floats(0, 1)),
            alternatives=tuple(draw(st.lists(st.text(max_size=5), max_size=2))),
        )
        for text in draw(st.lists(st.none() | texts, max_size=3))
    )
    associations = tuple(
        Association(draw(st.integers(0, len(expressions) - 1)), draw(st.sampled_from(names)), draw(points))
        for _ in range(draw(st.integers(0, 3)) if expressions and names else 0)
    )
    gestures = tuple(Gesture(draw(st.sampled_from(GESTURE_KINDS)), stroke) for stroke in free)
    return Sketch(ink, components, expressions, associations, gestures)
