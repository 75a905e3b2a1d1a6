"""A line of mathematics taken apart: the names that it gives values, and what each name is of what."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import sympy

from physics.formula.program import Node
from physics.formula.quantities import Owner, Quantity, Role, quantities_named, quantity_of, role_of
from physics.formula.said import names_in
from physics.formula.si import Dimension
from physics.formula.units import has_units, size_of_units
from sketch.formula.parse import expression as read_again
from sketch.formula.units import Unit
from sketch.page import Component, Expression
from sketch.shapes import Polygon

_TYPED = re.compile(r"[A-Za-z]_[0-9]+[xy]")
_BY_ASSOCIATION: frozenset[Role] = frozenset(["angle", "force", "tension"])
"""Of these any subscript is the student's own: f_B on A may be the force of B on A."""


@dataclass(frozen=True, slots=True)
class Line:
    """definitions: (name, tree) of each quantity that is given, two of (x, y) = (…, …); relation: the
    equation, where it gives none; text: as written."""

    text: str
    definitions: tuple[tuple[str, Node], ...] = ()
    relation: Node | None = None


def stated(expression: Expression, notices: list[str]) -> Line:
    """What a line states; a notice where that is nothing."""
    text = expression.text or str(expression.tree)
    tree, problem = expression.tree, expression.problem
    if tree is None and problem is None and expression.text is not None:
        again = read_again(expression.text)
        tree, problem = again.tree, again.problem
    if tree is None:
        notices.append(f"{text!r} is not a formula that can be read: {problem}")
        return Line(text)
    line = _line(tree, text)
    if not line.definitions and line.relation is None:
        notices.append(f"{text}: this does not say what one quantity is; write it as name = value.")
    return line


@lru_cache(maxsize=4096)
def _line(tree: Node, text: str) -> Line:
    """What a formula states."""
    if isinstance(tree, sympy.Equality):
        for left, right in (tree.args, tree.args[::-1]):
            names = _names(left, text)
            if len(names) == 1:
                return Line(text, ((names[0], right),))
            if len(names) > 1 and isinstance(right, sympy.Tuple) and len(right.args) == len(names):
                return Line(text, tuple(zip(names, right.args, strict=True)))
        if names_in(tree):
            return Line(text, relation=tree)
    return Line(text)


def belongs(name: str, component: str | None, parts: Mapping[str, Component]) -> tuple[str, str | None]:
    """(name, owner): whose quantity a name is that was said of a component (None: of nothing).

    A subscript that is a label tells, and is left out where the quantity is known without it:
    `v_A` is v of A, `v_xA` and `v_Ax` its v_x. Of angles, forces and tensions, whose subscripts are
    free, an association tells first; and so it does for what only an answer is called.
    """
    split = labelled(name, parts)
    if split is None:
        return name, component
    base, label = split
    kind = parts[label].kind
    plain, whole = quantity_of(base, kind), quantity_of(name, kind)
    if plain is None:
        return name, component
    free = plain.answer or plain.role in _BY_ASSOCIATION
    if component not in (None, label) and free:
        return name, component
    return (name if whole is not None and whole.role == plain.role else base), label


def labelled(name: str, labels: Mapping[str, object]) -> tuple[str, str] | None:
    """(v_x, A) for v_xA and v_Ax, (v, A) for v_A; None where the subscript names no component."""
    base, _, index = name.partition("_")
    if index in labels:
        return base, index
    if index[:1] in ("x", "y") and index[1:] in labels:
        return f"{base}_{index[0]}", index[1:]
    if index[-1:] in ("x", "y") and index[:-1] in labels:
        return f"{base}_{index[-1]}", index[:-1]
    return None


def meant(name: str, part: Component | None, tree: Node) -> Quantity | None:
    """The quantity that a name is of a component (None: of the page), as the units of its value tell where
    it may be several. α of what is inclined is an angle, of what can turn an angular acceleration."""
    kind = None if part is None else part.kind
    quantity = quantity_of(name, kind)
    if quantity is None:
        return None
    if isinstance(tree, sympy.Expr) and has_units(tree):
        return _measured(name, kind, size_of_units(tree)) or quantity
    if part is None or quantity.role != "angle" or name.partition("_")[0] != "alpha":
        return quantity
    inclined = not isinstance(part.shape, Polygon) or part.fixed or len(part.shape.vertices) == 3
    return quantity if inclined else role_of("angular_acceleration", part.kind)


@lru_cache(maxsize=4096)
def _measured(name: str, kind: Owner, size: Dimension) -> Quantity | None:
    """The quantity of such a thing that goes by this name and has this dimension."""
    fitting = (one for one in quantities_named(name) if kind in one.owners and one.size == size)
    return next(fitting, None)


def _names(side: Node, text: str) -> list[str]:
    """What one side of an equation names: x, |x|, x(t) or (x, y); nothing if it is anything else."""
    while type(side).__name__ in ("Abs", "norm"):
        side = side.args[0]
    if isinstance(side, sympy.Symbol) and not isinstance(side, Unit):
        return [side.name]
    if isinstance(side, sympy.Tuple) and all(isinstance(part, sympy.Symbol) for part in side.args):
        return [str(part) for part in side.args]
    written = text.partition("=")[0].replace(" ", "")
    if isinstance(side, sympy.Mul) and (whole := _TYPED.fullmatch(written)):
        # As a factor v_0x is v_0·x; alone on the left it names one thing.
        return [whole.group()]
    if isinstance(side, sympy.Mul) and written.endswith("(t)"):
        # The parser cannot tell a function of time from a product with it.
        others = [part for part in side.args if part != sympy.Symbol("t")]
        return [part.name for part in others if len(side.args) == 2 and isinstance(part, sympy.Symbol)]
    return []
