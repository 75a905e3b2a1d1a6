"""Pages changed a little: without their answers, and as misconceptions see them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import sympy

from physics.formula.meaning import Meanings, Role
from physics.formula.program import Node
from physics.verify.misconceptions import Misconception
from sketch.formula.print import plain
from sketch.page import Association, Expression, Sketch

ANGLES = ("theta", "alpha", "beta", "phi")


def without(sketch: Sketch, expressions: set[int]) -> Sketch:
    """The page with these expressions, by number, unread. They keep their numbers."""
    return replace(
        sketch,
        expressions=tuple(
            Expression(None, one.strokes, one.at) if number in expressions else one
            for number, one in enumerate(sketch.expressions)
        ),
        associations=tuple(one for one in sketch.associations if one.expression not in expressions),
    )


def saying(sketch: Sketch, name: str, tree: Node, component: str | None = None) -> Sketch:
    """The page with one thing more said: the newest holds."""
    left = sympy.Symbol(name)
    equation = sympy.Equality(left, tree, evaluate=False)
    expressions = (*sketch.expressions, Expression(plain(equation), tree=equation))
    if component is None:
        # What is said of the whole page is read before what is associated, so the older ones go.
        bound = {one.expression for one in sketch.associations}
        older = {
            number
            for number, one in enumerate(sketch.expressions)
            if number not in bound and isinstance(one.tree, sympy.Equality) and one.tree.lhs == left
        }
        cleared = without(sketch, older)
        return replace(cleared, expressions=(*cleared.expressions, expressions[-1]))
    association = Association(len(sketch.expressions), component, (0.0, 0.0))
    return replace(sketch, expressions=expressions, associations=(*sketch.associations, association))


def mistaken(
    sketch: Sketch, meanings: Meanings, masses: Mapping[str, float], g: float
) -> Iterator[tuple[Misconception, Sketch]]:
    """The page as each misconception that is in the physics sees it. masses: of the movable solids, kg."""
    turned = _angled(sketch, lambda angle: sympy.pi / 2 - angle)
    if turned != sketch:
        yield "sine for cosine", turned
    yield "forgot g", saying(sketch, "g", sympy.Integer(1))
    if turned != sketch:
        yield "degrees for radians", _angled(sketch, lambda angle: 180 * angle / sympy.pi)
    heavy = sketch
    for label, mass in masses.items():
        heavy = saying(heavy, "m", sympy.Float(mass * g), label)
    yield "weight for mass", heavy
    rough = _labels(meanings, "friction")
    if rough:
        yield "forgot friction", _said_of_all(sketch, rough, "mu", 0)
    solids = [part.label for part in sketch.components if part.kind in ("circle", "polygon")]
    yield "elastic for inelastic", _said_of_all(sketch, solids, "e", 1)
    yield "inelastic for elastic", _said_of_all(sketch, solids, "e", 0)
    if len(masses) == 2:
        (one, first), (other, second) = masses.items()
        exchanged = saying(sketch, "m", sympy.Float(second), one)
        yield "masses exchanged", saying(exchanged, "m", sympy.Float(first), other)
    moving = [*_labels(meanings, "velocity"), *_labels(meanings, "v_x"), *_labels(meanings, "v_y")]
    if moving:
        still = sketch
        for said in meanings.said:
            if said.quantity is not None and said.quantity.role in ("velocity", "v_x", "v_y"):
                zero = sympy.Tuple(0, 0) if said.quantity.role == "velocity" else sympy.Integer(0)
                still = saying(still, said.name, zero, said.component)
        yield "forgot the start velocity", still


def weightless(sketch: Sketch, g: float) -> Iterator[tuple[Misconception, Sketch]]:
    """The page with another gravity: so different that it is thought of last."""
    yield "forgot gravity", saying(sketch, "g", sympy.Integer(0))
    yield "gravity upwards", saying(sketch, "g", sympy.Float(-g))


def _labels(meanings: Meanings, role: Role) -> list[str]:
    found = [
        said.component
        for said in meanings.said
        if said.component is not None and said.quantity is not None and said.quantity.role == role
    ]
    return list(dict.fromkeys(found))


def _said_of_all(sketch: Sketch, labels: list[str], name: str, value: int) -> Sketch:
    for label in labels:
        sketch = saying(sketch, name, sympy.Integer(value), label)
    return sketch


def _angled(sketch: Sketch, change: Callable[[Node], Node]) -> Sketch:
    """The page with every angle changed."""

    def changed(one: Expression) -> Expression:
        tree = one.tree
        if not isinstance(tree, sympy.Equality) or str(tree.lhs).partition("_")[0] not in ANGLES:
            return one
        other = sympy.Equality(tree.lhs, change(tree.rhs), evaluate=False)
        return Expression(plain(other), one.strokes, one.at, tree=other)

    return replace(sketch, expressions=tuple(changed(one) for one in sketch.expressions))
