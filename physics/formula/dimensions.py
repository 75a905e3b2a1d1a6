"""Dimensional analysis of the page's equations, on their trees (row M9).

What counts as consistent:

- Symbols are strict. A name has the dimension of its quantity (the table of `quantities`), whatever
  number it was given; a name that is no quantity has that of its value.
- A number without a unit, alone in a sum or on a side, is in SI of what it is added to or equal to:
  `f_1 = 5` is 5 N, and `v + 2` adds 2 m/s.
- A number that multiplies is a plain number, `2 m g` is a force. But a number other than 1 and 1/2,
  or a coefficient given as a bare number (μ = 0.5), that multiplies nothing but the time, the motion and
  functions carries what it must: `y = 3t` is 3 m/s times t, `f = -μ v` a drag, `sin(2t)` turns with 2/s.
- Functions take and give plain numbers, angles among them; exponents are plain numbers.
- A name whose dimension nobody can tell (c, b) may have any.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import sympy

from physics.formula.program import Node
from physics.formula.quantities import quantities_named, quantity_of
from physics.formula.said import Meanings, Said
from physics.formula.si import FORCE, LENGTH, NUMBER, RATE, TIME, VELOCITY, Dimension
from physics.formula.statements import labelled
from physics.formula.units import SIZES
from sketch.formula.print import plain
from sketch.formula.units import Unit
from sketch.page import Sketch

Size = Dimension | None
"""None: any; nothing is known of it."""

MOTION: dict[str, Dimension] = {
    "t": TIME,
    "x": LENGTH,
    "y": LENGTH,
    "phi": NUMBER,
    "v": VELOCITY,
    "v_x": VELOCITY,
    "v_y": VELOCITY,
    "omega": RATE,
}
"""What the motion has at every moment (`program.STATE`)."""

_DEPTH = 12
"""Names that stand for names, at most."""


@dataclass(frozen=True, slots=True)
class Finding:
    """An equation whose dimensions do not go together.

    expression: which of the page's; component: of which it is said; left, right: the dimensions of
    its sides as far as known; term: what does not fit, as text; message: all this for a student.
    """

    expression: int
    component: str | None
    left: Dimension | None
    right: Dimension | None
    term: str | None
    message: str


def check(sketch: Sketch, meanings: Meanings) -> tuple[Finding, ...]:
    """One finding for each equation of the page that is inconsistent."""
    found: dict[int, Finding] = {}
    for said in meanings.said:
        if said.expression is None or said.expression in found or said.given is None:
            continue
        finding = _check(sketch, meanings, said, said.expression)
        if finding is not None:
            found[said.expression] = finding
    for relation in meanings.relations:
        if relation.expression not in found:
            finding = _check_sides(
                sketch, meanings, relation.tree.args, relation.component, relation.text, relation.expression
            )
            if finding is not None:
                found[relation.expression] = finding
    return tuple(found[index] for index in sorted(found))


def size_of(sketch: Sketch, meanings: Meanings, tree: Node, component: str | None) -> Size:
    """The dimension of a formula about a component; None where nobody can tell.

    Raises Inconsistent where its parts do not go together.
    """
    return _Names(sketch, meanings, component).size(tree, None)


class Inconsistent(ValueError):
    """Parts of a formula that do not go together: term (as text), its dimension, and what it had to be."""

    def __init__(self, term: Node, found: Dimension, wanted: str) -> None:
        self.term = plain(term)
        self.found = found
        super().__init__(f"{self.term} is {found.spoken}, {wanted}")


def _check(sketch: Sketch, meanings: Meanings, said: Said, index: int) -> Finding | None:
    left = None if said.quantity is None else said.quantity.size
    names = _Names(sketch, meanings, said.component)
    if said.quantity is None:
        left = names.of_name(said.name, said)
    parts = said.given.args if isinstance(said.given, sympy.Tuple) else (said.given,)
    spoken = said.name if left is None else f"{said.name} is {left.spoken}"
    for part in parts:
        try:
            right = names.size(part, left)
        except Inconsistent as problem:
            return Finding(
                index, said.component, left, problem.found, problem.term, f"{said.text}: {problem}."
            )
        if left is not None and right is not None and left != right:
            term = plain(part)
            return Finding(
                index,
                said.component,
                left,
                right,
                term,
                f"{said.text}: {spoken}, but {term} is {right.spoken}.",
            )
    return None


def _check_sides(
    sketch: Sketch, meanings: Meanings, sides: Sequence[Node], component: str | None, text: str, index: int
) -> Finding | None:
    names = _Names(sketch, meanings, component)
    sizes: list[Size] = [None, None]
    try:
        for k, side in enumerate(sides):
            sizes[k] = names.size(side, sizes[0])
    except Inconsistent as problem:
        return Finding(index, component, sizes[0], problem.found, problem.term, f"{text}: {problem}.")
    left, right = sizes
    if left is None or right is None or left == right:
        return None
    term = plain(sides[1])
    message = f"{text}: {plain(sides[0])} is {left.spoken}, but {term} is {right.spoken}."
    return Finding(index, component, left, right, term, message)


@dataclass(frozen=True, slots=True)
class _Names:
    """The dimensions of names in the formulas of one component; within: names under way."""

    sketch: Sketch
    meanings: Meanings
    component: str | None
    within: tuple[str, ...] = ()

    def size(self, tree: Node, wanted: Size) -> Size:
        """The dimension of a tree; wanted: what a number without a unit may have to be."""
        if isinstance(tree, Unit):
            return SIZES[tree.name]
        if isinstance(tree, sympy.Symbol):
            return self.of_name(tree.name)
        if not getattr(tree, "free_symbols", None):
            return wanted
        if isinstance(tree, sympy.Add):
            return self._sum(tree, wanted)
        if isinstance(tree, sympy.Mul):
            return self._product(tree, wanted)
        if isinstance(tree, sympy.Pow):
            return self._power(tree)
        if isinstance(tree, sympy.Tuple):
            sizes = {self.size(part, wanted) for part in tree.args} - {None}
            return sizes.pop() if len(sizes) == 1 else wanted
        if _measures(tree):
            return self.size(tree.args[0], wanted)
        for argument in tree.args:
            self._number(argument, f"and {type(tree).__name__.lower()} takes a plain number")
        return NUMBER

    def _sum(self, tree: Node, wanted: Size) -> Size:
        """Terms that have numbers for coefficients take what the others have."""
        sizes = [(term, self.size(term, None)) for term in tree.as_ordered_terms()]
        known = [(term, size) for term, size in sizes if size is not None]
        if not known:
            return wanted
        if wanted is None:
            wanted = known[0][1]
        for term, size in known:
            if size != wanted:
                other = next((plain(one) for one, its in known if its == wanted), None)
                beside = "" if other is None else f" like {other}"
                raise Inconsistent(term, size, f"but must be {wanted.spoken}{beside}")
        return wanted

    def _product(self, tree: Node, wanted: Size) -> Size:
        if self._carries(tree):
            return wanted
        size: Dimension = NUMBER
        unknown = False
        for part in tree.args:
            own = NUMBER if not part.free_symbols else self.size(part, None)
            if own is None:
                unknown = True
            else:
                size *= own
        return wanted if unknown else size

    def _power(self, tree: Node) -> Size:
        base, exponent = tree.args
        size = self.size(base, None)
        if isinstance(exponent, sympy.Rational):
            return None if size is None else size ** Fraction(int(exponent.p), int(exponent.q))
        self._number(exponent, "and an exponent is a plain number")
        if size is not None and size != NUMBER:
            raise Inconsistent(base, size, "and only a plain number has such a power")
        return NUMBER

    def _number(self, tree: Node, wanted: str) -> None:
        size = self.size(tree, NUMBER)
        if size is not None and size != NUMBER:
            raise Inconsistent(tree, size, wanted)

    def _carries(self, tree: Node) -> bool:
        """Whether the numbers of a product carry what it must be: beside time and motion there is nothing
        but numbers, and not only 1 or 1/2."""
        number = sympy.Mul(*(part for part in tree.args if not part.free_symbols))
        rest = [part for part in tree.args if part.free_symbols]
        plain_numbers = [isinstance(part, sympy.Function) and not _measures(part) for part in rest]
        pure = (1,) if all(plain_numbers) else (1, sympy.Rational(1, 2))
        coefficient = abs(number) not in pure
        for part, is_number in zip(rest, plain_numbers, strict=True):
            if is_number:
                self.size(part, None)
                continue
            symbols = {symbol.name for symbol in part.free_symbols if not isinstance(symbol, Unit)}
            if any(isinstance(symbol, Unit) for symbol in part.free_symbols):
                return False
            moving = all(name in MOTION and self._own(name) is None for name in symbols)
            if not moving and not (isinstance(part, sympy.Symbol) and self._bare(part.name)):
                return False
            coefficient = coefficient or not moving
        return coefficient

    def _bare(self, name: str) -> bool:
        """Whether a name is a coefficient: a plain number by its quantity, no angle, and given as one."""
        said = self._own(name)
        role = None if said is None or said.quantity is None else said.quantity
        return (
            said is not None
            and role is not None
            and role.size == NUMBER
            and role.role != "angle"
            and not getattr(said.given, "free_symbols", ())
        )

    def _own(self, name: str) -> Said | None:
        if name in MOTION:
            return None
        return self.meanings.find(name, self.component)

    def of_name(self, name: str, itself: Said | None = None) -> Size:
        """The dimension of a name; itself: what is being said of it just now."""
        said = self._own(name) if itself is None else None
        if said is not None:
            return said.quantity.size if said.quantity is not None else self._of_value(name, said)
        if name in MOTION:
            return MOTION[name]
        labels = {part.label: part for part in self.sketch.components}
        found = labelled(name, labels)
        if found is not None:
            quantity = quantity_of(found[0], labels[found[1]].kind)
            return None if quantity is None else quantity.size
        if name == "W":
            return FORCE
        there = {None, *(part.kind for part in self.sketch.components)}
        named = [one for one in quantities_named(name) if there.intersection(one.owners)]
        sizes = {quantity.size for quantity in named}
        return sizes.pop() if len(sizes) == 1 else None

    def _of_value(self, name: str, said: Said) -> Size:
        """Of a mere name: what its value has; a number without a unit may be anything."""
        if name in self.within or len(self.within) > _DEPTH or not getattr(said.given, "free_symbols", ()):
            return None
        inner = _Names(self.sketch, self.meanings, said.component, (*self.within, name))
        try:
            return inner.size(said.given, None)
        except Inconsistent:
            return None


def _measures(tree: Node) -> bool:
    """Whether a function has the dimension of what it takes."""
    return type(tree).__name__ in ("Abs", "norm", "sum")
