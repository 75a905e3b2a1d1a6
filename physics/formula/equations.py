"""Equations of a page in letters: what is known in them, with its value, and what is not.

Known quantities stay letters while an equation is solved, and their numbers are put in afterwards:
letters are solved faster than numbers (which SymPy would factor), what cancels is seen to cancel, and an
edited number needs nothing solved again.

A letter is a name of a thing: the m of A is another than the m of B. `v`, `t`, `x` and whatever else
the motion has are unknown here where the page does not give them: an equation such as
½mv² = mgh speaks of one moment, not of the whole motion.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite

import sympy

from physics.formula.program import Node, ProgramError, compile_tree
from physics.formula.quantities import SOLIDS, axis_of, quantities_named, quantity_of
from physics.formula.said import Meanings, Relation, Said, names_in
from physics.formula.standard import DENSITY, GRAVITY, square_metres
from physics.formula.statements import labelled
from physics.formula.units import in_si
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon

_DEPTH = 16
"""Names that stand for names, at most."""
_FORCES = ("f", "F", "N", "R", "T")


@dataclass(frozen=True, slots=True)
class Letter:
    """A name in an equation, and whose it is (None: the page's, or nobody can tell yet)."""

    name: str
    component: str | None

    @property
    def symbol(self) -> sympy.Symbol:
        return sympy.Symbol(f"{self.name}@{self.component or ''}", real=True)


class Unsolvable(ValueError):
    """Why an equation cannot be worked with, in words."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)


@dataclass(slots=True)
class Letters:
    """What the names of a page stand for in its equations; known: letters with a value; unknown: those
    without. Both grow as equations are read."""

    sketch: Sketch
    meanings: Meanings
    parts: Mapping[str, Component]
    known: dict[sympy.Symbol, float] = field(default_factory=dict[sympy.Symbol, float])
    unknown: dict[sympy.Symbol, Letter] = field(default_factory=dict[sympy.Symbol, Letter])

    def tree(self, tree: Node, component: str | None, within: tuple[str, ...] = ()) -> Node:
        """The tree in letters. Raises Unsolvable."""
        if len(within) > _DEPTH:
            raise Unsolvable("its names stand for one another without end")
        if isinstance(tree, sympy.Tuple):
            raise Unsolvable("it is one of vectors; write one for x and one for y")
        if isinstance(tree, sympy.Symbol):
            return self._name(tree.name, component, within)
        if type(tree).__name__ == "norm":
            return sympy.Abs(self.tree(tree.args[0], component, within))
        if type(tree).__name__ == "sum":
            return self._sum(tree.args[0], component, within)
        if not tree.args:
            return tree
        return tree.func(*(self.tree(part, component, within) for part in tree.args))

    def default_mass(self, letter: Letter) -> float | None:
        """The mass by area of a solid whose mass is unknown; None for what is no mass."""
        part = None if letter.component is None else self.parts[letter.component]
        if part is None or not isinstance(part.shape, Circle | Polygon) or letter.name != "m":
            return None
        return DENSITY * square_metres(part.shape)

    def owner(self, letter: Letter) -> str | None:
        """Whose an unknown is of which the equation does not tell: the only one's that can have it and
        does not."""
        if letter.component is not None:
            return letter.component
        able = [
            part.label
            for part in self.parts.values()
            if (quantity := quantity_of(letter.name, part.kind)) is not None
            and not (part.fixed and quantity.role != "angle")
            and self.meanings.of(part.label, quantity.role, part.kind) is None
        ]
        base = letter.name.partition("_")[0]
        alike = [one for one in self.unknown.values() if one.name.partition("_")[0] == base]
        only = len(able) == 1 and len(alike) == 1 and quantity_of(letter.name, None) is None
        return able[0] if only else None

    def _name(self, name: str, component: str | None, within: tuple[str, ...]) -> Node:
        if name in within:
            raise Unsolvable(f"{name} is defined by itself")
        said = self._said(name, component)
        own = labelled(name, self.parts)
        base, about = own if own is not None else (name, component)
        if said is not None:
            tree = self.tree(said.tree, said.component or component, (*within, name))
            return self._let(Letter(said.name, said.component), tree)
        if name == "g":
            return self._let(Letter("g", None), sympy.Float(GRAVITY))
        kind = None if about is None else self.parts[about].kind
        if base == "W" and kind in SOLIDS:
            return self._name(f"m_{about}", about, within) * self._name("g", about, (*within, name))
        letter = Letter(base, self._whose(base, about))
        self.unknown[letter.symbol] = letter
        return letter.symbol

    def _whose(self, name: str, component: str | None) -> str | None:
        """The component's that an equation is of, where it can have such a thing; T of a body that hangs
        from a wire is the wire's."""
        if component is None:
            return None
        quantity = quantity_of(name, self.parts[component].kind)
        if quantity is not None and quantity.role == "period":
            wires = [
                part.label for part in self.parts.values() if part.kind == "wire" and component in part.ends
            ]
            if wires:
                return wires[0] if len(wires) == 1 else None
        return None if quantity is None else component

    def _let(self, letter: Letter, tree: Node) -> Node:
        """The letter for a value that is a number; the tree for one that has unknowns."""
        value = number(tree, self.known)
        if value is None:
            return tree
        self.known[letter.symbol] = value
        return letter.symbol

    def _said(self, name: str, component: str | None) -> Said | None:
        own = labelled(name, self.parts)
        if own is not None:
            found = self.meanings.find(own[0], own[1])
            if found is not None and found.component == own[1]:
                return found
        found = self.meanings.find(name, component)
        if found is None or found.component == component or name not in ("m", "W", "v", "v_x", "v_y"):
            return found
        # These are each body's own: the m of another is not this one's.
        return found if component is None or self.parts[component].kind not in SOLIDS else None

    def _sum(self, tree: Node, component: str | None, within: tuple[str, ...]) -> Node:
        """ΣF of a body: of all forces that are said of it; along one axis of their parts and its weight."""
        base, _, axis = str(tree).partition("_")
        if not isinstance(tree, sympy.Symbol) or base not in _FORCES or axis not in ("", "x", "y", "net"):
            raise Unsolvable("Σ is the sum of all forces; write ΣF, ΣF_x or ΣF_y")
        if component is None:
            raise Unsolvable("tap the body whose forces are summed")
        forces = {
            said.name: said.tree
            for said in self.meanings.said
            if said.component == component and said.quantity is not None and said.quantity.role == "force"
        }
        if str(tree) in forces and len(forces) == 1:
            return self._name(str(tree), component, within)
        if not forces and axis != "y":
            return self._name(str(tree), component, within)
        parts = [_along(force, name, axis) for name, force in forces.items()]
        if any(part is None for part in parts):
            raise Unsolvable(
                "ΣF is of forces with and without a direction; write ΣF_x or ΣF_y, and forces as pairs"
            )
        total = sympy.Add(*(self.tree(part, component, within) for part in parts))
        return total - self._name("W", component, within) if axis == "y" else total


def _along(force: Node, name: str, axis: str) -> Node | None:
    """A force's part along x or y, or itself where all are numbers; None where it has none."""
    if axis not in ("x", "y"):
        return None if isinstance(force, sympy.Tuple) else force
    if isinstance(force, sympy.Tuple) and len(force.args) == 2:
        return force.args["xy".index(axis)]
    along = axis_of(name)
    return None if along is None else force if along == axis else sympy.Integer(0)


def number(tree: Node, known: Mapping[sympy.Symbol, float] | None = None) -> float | None:
    """The value of a tree with numbers for known letters; None where that is no real, finite number."""
    values = {} if known is None else {symbol.name: value for symbol, value in known.items()}
    try:
        program = compile_tree(tree, values.get, text="")
    except ProgramError:
        return _evaluated(tree, known or {})
    value = program.value(())
    return None if program.unspecified or not isfinite(value) else value


def _evaluated(tree: Node, known: Mapping[sympy.Symbol, float]) -> float | None:
    """The same by SymPy, for what no program can be made of."""
    tree = tree.xreplace({symbol: sympy.Float(value, 20) for symbol, value in known.items()})
    if tree.free_symbols:
        return None
    try:
        value = complex(sympy.N(tree, 20))
    except (TypeError, ValueError, ArithmeticError, AttributeError):
        return None
    real = isfinite(value.real) and abs(value.imag) <= 1e-12 * max(1.0, abs(value.real))
    return value.real if real else None


def sides(relation: Relation, letters: Letters) -> tuple[Node, Node]:
    """Both sides in letters. Raises Unsolvable."""
    left, right = (letters.tree(in_si(side)[0], relation.component) for side in relation.tree.args)
    return left, right


def lacking(said: Said, names: frozenset[str], doubled: frozenset[tuple[str, str | None]]) -> bool:
    """Whether a definition `F = m a` is an equation: its name is given by another line (a weight by the
    mass), and it has names that no line gives. names: all that lines give; doubled: those of one owner
    that several do."""
    if said.name != "W" and (said.name, said.component) not in doubled:
        return False
    given = {*names, "g", "t", "x", "y", "W", *(("m",) if said.name == "W" else ())}
    missing = names_in(said.tree) - given
    return any(quantities_named(name) for name in missing)
