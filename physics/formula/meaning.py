"""What a line of mathematics says of what: names of quantities and the things that have them.

A table, not code: each entry tells which names a quantity goes by, what can have it, and why
nothing else can. Quantities are SI, with y up. A name is looked up on the component itself, then
anywhere on the page, then among what holds everywhere (rows M2-M6).

`x`, `y`, and the pairs `r` and `s`, are metres from where the solid's centre was drawn: right and up.
An equation for them moves the solid (M7), and so does one for `v_x`, `v_y` or `v` that depends on
time or on the motion; a velocity that does not, and `v_0` ever, is what it has at the start (M2).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import sympy

from physics.formula.program import Node
from sketch.formula.parse import expression as read_again
from sketch.page import Expression, Sketch
from sketch.shapes import ComponentKind, Point

Role = Literal[
    "angle",
    "force",
    "friction",
    "gravity",
    "length",
    "mass",
    "position",
    "restitution",
    "spin",
    "stiffness",
    "tension",
    "velocity",
    "v_x",
    "v_y",
    "x",
    "y",
]

SOLIDS: tuple[ComponentKind, ...] = ("circle", "polygon")
LINKS: tuple[ComponentKind, ...] = ("spring", "wire")


@dataclass(frozen=True, slots=True)
class Quantity:
    """role: what it is to physics; names: what it is called (a * stands for any subscript or none);
    kinds: what can have it; constant: applied once, at the start; what: in words, with its unit."""

    role: Role
    names: tuple[str, ...]
    kinds: tuple[ComponentKind, ...]
    constant: bool
    what: str


QUANTITIES: tuple[Quantity, ...] = (
    Quantity("mass", ("m", "m*"), SOLIDS, True, "a mass (kg)"),
    Quantity("friction", ("mu", "mu*"), SOLIDS, True, "a coefficient of friction"),
    Quantity("restitution", ("e",), SOLIDS, True, "a coefficient of restitution"),
    Quantity("x", ("x",), SOLIDS, False, "a way to the right of where it was drawn (m)"),
    Quantity("y", ("y",), SOLIDS, False, "a way upwards from where it was drawn (m)"),
    Quantity("position", ("r", "s"), SOLIDS, False, "a way from where it was drawn (m)"),
    Quantity("v_x", ("v_x", "v_0x"), SOLIDS, True, "a velocity to the right (m/s)"),
    Quantity("v_y", ("v_y", "v_0y"), SOLIDS, True, "a velocity upwards (m/s)"),
    Quantity("velocity", ("v", "v_0"), SOLIDS, True, "a velocity (m/s)"),
    Quantity("spin", ("omega", "omega_0"), SOLIDS, True, "an angular velocity (rad/s)"),
    Quantity("force", ("f*", "F*", "N*", "R*"), SOLIDS, False, "a force (N)"),
    Quantity("angle", ("theta*", "alpha*", "beta*", "phi*"), (*SOLIDS, *LINKS), True, "an angle (rad)"),
    Quantity("stiffness", ("k", "k*"), ("spring",), True, "a spring's stiffness (N/m)"),
    Quantity("length", ("L*", "l*"), LINKS, True, "a link's length at rest (m)"),
    Quantity("tension", ("T*",), ("wire",), False, "a wire's tension (N)"),
    Quantity("gravity", ("g",), (), True, "the acceleration of free fall (m/s²), of the whole page"),
)
NAMES_OF: Mapping[ComponentKind, str] = {
    "circle": "a ball",
    "polygon": "a block",
    "spring": "a spring",
    "wire": "a wire",
    "arrow": "an arrow",
}
PER_METRE = 100.0
"""Page units in a metre."""
DENSITY = 1.0
"""kg per m² of area, of a solid of which nothing is said: a ball of 50 units across weighs 0.2 kg."""
GRAVITY = 9.81
"""m/s², unless the page says otherwise."""


@dataclass(frozen=True, slots=True)
class Said:
    """One thing that the page says: `name` of `component` (None: of the whole page) = `tree`.

    anchor: where on the component it was tapped, page units; text: as written.
    """

    name: str
    component: str | None
    tree: Any
    text: str
    anchor: Point | None = None


@dataclass(frozen=True, slots=True)
class Meanings:
    """All that a page says, in the order of association (the newest last)."""

    said: tuple[Said, ...]
    notices: tuple[str, ...]

    def of(self, component: str | None, role: Role, kind: ComponentKind | None) -> Said | None:
        """The newest that is said of a component in this role."""
        for said in reversed(self.said):
            quantity = quantity_of(said.name, kind)
            if said.component == component and quantity is not None and quantity.role == role:
                return said
        return None

    def find(self, name: str, component: str | None) -> Said | None:
        """The newest meaning of a name: on the component, then anywhere, then for the whole page."""
        named = [said for said in reversed(self.said) if said.name == name]
        own = [said for said in named if said.component == component]
        elsewhere = [said for said in named if said.component is not None]
        return next(iter(own + elsewhere + named), None)


def quantity_of(name: str, kind: ComponentKind | None) -> Quantity | None:
    """The quantity that goes by this name on such a thing (kind None: the whole page); None when
    the name is nobody's, or not one that such a thing can have."""
    for quantity in QUANTITIES:
        fits = kind in quantity.kinds if kind is not None else not quantity.kinds
        if fits and any(_goes_by(name, pattern) for pattern in quantity.names):
            return quantity
    return None


def read(sketch: Sketch) -> Meanings:
    """What a page says, and notices of what cannot be read, cannot be, or is said twice."""
    said: list[Said] = []
    notices: list[str] = []
    about: dict[int, list[tuple[str | None, Point | None]]] = {}
    for association in sketch.associations:
        about.setdefault(association.expression, []).append((association.component, association.anchor))
    order = [association.expression for association in sketch.associations]
    alone = [index for index in range(len(sketch.expressions)) if index not in about]
    for index in dict.fromkeys(alone + order):
        expression = sketch.expressions[index]
        if expression.text is None and expression.tree is None:
            continue
        for name, tree, text in _definitions(expression, notices):
            for component, anchor in about.get(index, [(None, None)]):
                said.append(Said(name, component, tree, text, anchor))
    notices += _impossible(sketch, said)
    notices += _twice(said)
    return Meanings(tuple(said), tuple(notices))


def names_used(said: Iterable[Said]) -> frozenset[str]:
    """All names that the formulas of a page read."""
    return frozenset(str(symbol) for one in said for symbol in getattr(one.tree, "free_symbols", ()))


def _goes_by(name: str, pattern: str) -> bool:
    if not pattern.endswith("*"):
        return name == pattern
    stem = pattern[:-1]
    return name == stem or name.startswith(stem + "_")


def _definitions(expression: Expression, notices: list[str]) -> list[tuple[str, Node, str]]:
    """(name, tree, text) of each quantity that an equation gives: one, or both of (x, y) = (…, …)."""
    text = expression.text or str(expression.tree)
    tree, problem = expression.tree, expression.problem
    if tree is None and problem is None and expression.text is not None:
        again = read_again(expression.text)
        tree, problem = again.tree, again.problem
    if tree is None:
        notices.append(f"{text!r} is not a formula that can be read: {problem}")
        return []
    if isinstance(tree, sympy.Equality):
        for left, right in (tree.args, tree.args[::-1]):
            names = _names(left, text)
            if len(names) == 1:
                return [(names[0], right, text)]
            if len(names) > 1 and isinstance(right, sympy.Tuple) and len(right.args) == len(names):
                return [(name, part, text) for name, part in zip(names, right.args, strict=True)]
    notices.append(f"{text}: this does not say what one quantity is; write it as name = value.")
    return []


def _names(side: Node, text: str) -> list[str]:
    """What one side of an equation names: x, |x|, x(t) or (x, y); nothing if it is anything else."""
    while type(side).__name__ in ("Abs", "norm"):
        side = side.args[0]
    if isinstance(side, sympy.Symbol):
        return [side.name]
    if isinstance(side, sympy.Tuple) and all(isinstance(part, sympy.Symbol) for part in side.args):
        return [str(part) for part in side.args]
    if isinstance(side, sympy.Mul) and text.partition("=")[0].replace(" ", "").endswith("(t)"):
        # The parser cannot tell a function of time from a product with it.
        others = [part for part in side.args if part != sympy.Symbol("t")]
        return [part.name for part in others if len(side.args) == 2 and isinstance(part, sympy.Symbol)]
    return []


def _impossible(sketch: Sketch, said: list[Said]) -> list[str]:
    """What a thing cannot have (M6), unless a formula of the page uses it as a mere name."""
    used = names_used(said)
    notices: list[str] = []
    for one in said:
        kind = None if one.component is None else sketch.component(one.component).kind
        if quantity_of(one.name, kind) is not None or one.name in used:
            continue
        where = "the whole page" if kind is None else f"{NAMES_OF[kind]} ({one.component})"
        for quantity in QUANTITIES:
            if any(_goes_by(one.name, pattern) for pattern in quantity.names):
                owners = " or ".join(NAMES_OF[owner] for owner in quantity.kinds) or "nothing but the page"
                notices.append(
                    f"{one.text}: {quantity.what} belongs to {owners}, and {where} has none; it is not used."
                )
                break
        else:
            notices.append(f"{one.text}: {one.name} is not a quantity of {where}; it is not used.")
    return notices


def _twice(said: list[Said]) -> list[str]:
    notices: list[str] = []
    newest: dict[tuple[str, str | None], Said] = {}
    for one in said:
        before = newest.get((one.name, one.component))
        if before is not None and before.tree != one.tree:
            where = "the page" if one.component is None else one.component
            notices.append(f"{where} is given {before.text} and {one.text}; the newest, {one.text}, is used.")
        newest[one.name, one.component] = one
    return notices
