"""What a line of mathematics says of what: names of quantities and the things that have them.

A table, not code: each entry tells which names a quantity goes by, what can have it, and why
nothing else can. Quantities are SI, with y up. A name is looked up on the component itself, then
anywhere on the page, then among what holds everywhere (rows M2-M6).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import sympy

from physics.formula.program import STATE, Lookup, Node, ProgramError, compile_tree
from sketch.formula.parse import expression as read_again
from sketch.geometry import solid_area
from sketch.page import Component, Expression, Sketch
from sketch.shapes import Circle, ComponentKind, Point, Polygon

Role = Literal[
    "angle",
    "force",
    "friction",
    "gravity",
    "length",
    "mass",
    "restitution",
    "spin",
    "stiffness",
    "tension",
    "velocity",
    "v_x",
    "v_y",
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
        definition = _definition(expression, notices)
        if definition is None:
            continue
        name, tree, text = definition
        for component, anchor in about.get(index, [(None, None)]):
            said.append(Said(name, component, tree, text, anchor))
    notices += _impossible(sketch, said)
    notices += _twice(said)
    return Meanings(tuple(said), tuple(notices))


def mass_of(sketch: Sketch, meanings: Meanings, component: Component) -> tuple[float, str | None]:
    """(kg, a notice where what the page says of it cannot be). Of a solid of which nothing is said,
    by its area."""
    assert isinstance(component.shape, Circle | Polygon)
    default = DENSITY * solid_area(component.shape) / PER_METRE**2
    said = meanings.of(component.label, "mass", component.kind)
    if said is None:
        return default, None
    value = constant_of(said, lookup(sketch, meanings, component.label, {}, GRAVITY))
    if value is None or value <= 0:
        return (
            default,
            f"{said.text} of {component.label}: a mass must be a number above zero; {default:.3g} kg is used.",
        )
    return value, None


def constant_of(said: Said, find: Lookup) -> float | None:
    """The value at the start, where the motion's own quantities count as zero; None if there is none."""
    try:
        program = compile_tree(said.tree, find, said.text)
    except ProgramError:
        return None
    value = program.value([0.0] * (len(STATE) * (1 + len(program.others))))
    return value if value == value else None


def lookup(
    sketch: Sketch, meanings: Meanings, component: str | None, masses: Mapping[str, float], g: float
) -> Lookup:
    """What names stand for in the formulas of one component.

    masses: of the solids, kg, as far as known; a link's formulas speak of the movable solid at its
    end. `W` is that weight's size, m g; `m_B` is B's mass whatever the formula is about.
    """
    labels = {part.label for part in sketch.components}
    body = _body_of(sketch, component)

    def find(name: str) -> Node | float | None:
        if name in STATE:
            return None
        base, _, index = name.partition("_")
        if index in labels and meanings.find(name, component) is None:
            own = next((s for s in reversed(meanings.said) if s.name == base and s.component == index), None)
            if own is not None:
                return own.tree
            if base in ("m", "W") and index in masses:
                return masses[index] * (g if base == "W" else 1.0)
        own = next((s for s in reversed(meanings.said) if s.name == name and s.component == component), None)
        if own is not None:
            return own.tree
        if body is not None and body in masses and name in ("m", "W"):
            return masses[body] * (g if name == "W" else 1.0)
        said = meanings.find(name, component)
        if said is not None:
            return said.tree
        return g if name == "g" else None

    return find


def split(tree: Node) -> tuple[Node, Node] | None:
    """The x and y parts of a vector tree; None for a scalar.

    Pairs, the weight W (straight down) and the velocity v are vectors; |W| and ‖v‖ are not. Raises
    ProgramError where a vector meets what it cannot be added to or multiplied by.
    """
    if isinstance(tree, sympy.Tuple):
        if len(tree.args) != 2:
            raise ProgramError(f"{tree} has {len(tree.args)} parts; a vector of the plane has two")
        return tree.args[0], tree.args[1]
    if isinstance(tree, sympy.Symbol):
        if tree.name == "W":
            return sympy.Integer(0), -tree
        if tree.name == "v":
            return sympy.Symbol("v_x"), sympy.Symbol("v_y")
        return None
    if isinstance(tree, sympy.Add):
        parts = [split(part) for part in tree.args]
        if all(part is None for part in parts):
            return None
        if any(part is None for part in parts):
            raise ProgramError(f"{tree} adds a vector to a number")
        pairs = [part for part in parts if part is not None]
        return sympy.Add(*(x for x, _ in pairs)), sympy.Add(*(y for _, y in pairs))
    if isinstance(tree, sympy.Mul):
        vectors = [part for part in tree.args if split(part) is not None]
        if not vectors:
            return None
        if len(vectors) > 1:
            raise ProgramError(f"{tree} multiplies two vectors; write which product is meant, or |…|")
        pair = split(vectors[0])
        others = [part for part in tree.args if part is not vectors[0]]
        assert pair is not None
        return sympy.Mul(*others, pair[0]), sympy.Mul(*others, pair[1])
    return None


def _goes_by(name: str, pattern: str) -> bool:
    if not pattern.endswith("*"):
        return name == pattern
    stem = pattern[:-1]
    return name == stem or name.startswith(stem + "_")


def _definition(expression: Expression, notices: list[str]) -> tuple[str, Node, str] | None:
    """(name, tree, text) of an equation that says what one name is."""
    text = expression.text or str(expression.tree)
    tree, problem = expression.tree, expression.problem
    if tree is None and problem is None and expression.text is not None:
        again = read_again(expression.text)
        tree, problem = again.tree, again.problem
    if tree is None:
        notices.append(f"{text!r} is not a formula that can be read: {problem}")
        return None
    if isinstance(tree, sympy.Equality):
        for left, right in (tree.args, tree.args[::-1]):
            while type(left).__name__ in ("Abs", "norm"):
                left = left.args[0]
            if isinstance(left, sympy.Symbol):
                return left.name, right, text
    notices.append(f"{text}: this does not say what one quantity is; write it as name = value.")
    return None


def _impossible(sketch: Sketch, said: list[Said]) -> list[str]:
    """What a thing cannot have (M6), unless a formula of the page uses it as a mere name."""
    used = {str(symbol) for one in said for symbol in getattr(one.tree, "free_symbols", ())}
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


def _body_of(sketch: Sketch, component: str | None) -> str | None:
    """The solid that a component's formulas speak of: itself, or the movable one at a link's end."""
    if component is None:
        return None
    part = sketch.component(component)
    if part.kind in SOLIDS:
        return component
    ends = [sketch.component(end) for end in part.ends if end is not None]
    movable = [end.label for end in ends if not end.fixed]
    return movable[0] if movable else None
