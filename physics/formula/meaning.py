"""What a line of mathematics says of what (rows M2-M6).

Each line is read as `name = value` of the components it is associated with, and the table of
`quantities` tells what that is to physics, or why it cannot be. A name whose subscript is a label
belongs to that component: `v_A` is A's velocity wherever it is written. A name is looked up on the
component itself, then anywhere on the page, then among what holds everywhere.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from physics.formula.quantities import LINKS, SOLIDS, Quantity, Role, quantity_of
from physics.formula.remarks import conflicts, impossible
from physics.formula.statements import belongs, meant, stated
from sketch.page import Sketch
from sketch.shapes import ComponentKind, Point

__all__ = [
    "DENSITY", "GRAVITY", "LINKS", "PER_METRE", "SOLIDS", "Meanings", "Quantity", "Role", "Said",
    "names_used", "quantity_of", "read",
]  # fmt: skip

PER_METRE = 100.0
"""Page units in a metre."""
DENSITY = 1.0
"""kg per m² of area, of a solid of which nothing is said: a ball of 50 units across weighs 0.2 kg."""
GRAVITY = 9.81
"""m/s², unless the page says otherwise."""


@dataclass(frozen=True, slots=True)
class Said:
    """One thing that the page says: `name` of `component` (None: of the whole page) = `tree`.

    tree: in SI units; text: as written; anchor: where on the component it was tapped, page units;
    expression: which of the page's it is; quantity: what it is to physics, None for a mere name.
    """

    name: str
    component: str | None
    tree: Any
    text: str
    anchor: Point | None = None
    expression: int | None = None
    quantity: Quantity | None = None


@dataclass(frozen=True, slots=True)
class Meanings:
    """All that a page says, in the order of association (the newest last)."""

    said: tuple[Said, ...]
    notices: tuple[str, ...]

    def of(self, component: str | None, role: Role, kind: ComponentKind | None) -> Said | None:
        """The newest that is said of a component in this role."""
        for said in reversed(self.said):
            if said.component != component:
                continue
            quantity = said.quantity or quantity_of(said.name, kind)
            if quantity is not None and quantity.role == role:
                return said
        return None

    def find(self, name: str, component: str | None) -> Said | None:
        """The newest meaning of a name: on the component, then anywhere, then for the whole page."""
        named = [said for said in reversed(self.said) if said.name == name]
        own = [said for said in named if said.component == component]
        elsewhere = [said for said in named if said.component is not None]
        return next(iter(own + elsewhere + named), None)

    @property
    def answers(self) -> tuple[Said, ...]:
        """What governs nothing and can be verified."""
        return tuple(said for said in self.said if said.quantity is not None and said.quantity.answer)


def read(sketch: Sketch) -> Meanings:
    """What a page says, and notices of what cannot be read, cannot be, or is said twice."""
    said: list[Said] = []
    notices: list[str] = []
    about: dict[int, list[tuple[str | None, Point | None]]] = {}
    for association in sketch.associations:
        about.setdefault(association.expression, []).append((association.component, association.anchor))
    order = [association.expression for association in sketch.associations]
    alone = [index for index in range(len(sketch.expressions)) if index not in about]
    parts = {part.label: part for part in sketch.components}
    for index in dict.fromkeys(alone + order):
        expression = sketch.expressions[index]
        if expression.text is None and expression.tree is None:
            continue
        for name, tree, text in stated(expression, notices):
            for component, anchor in about.get(index, [(None, None)]):
                own, owner = belongs(name, component, parts)
                if owner != component and component is not None:
                    notices.append(
                        f"{text}, written of {component}, is taken for {owner}'s, as its name says."
                    )
                part = None if owner is None else parts[owner]
                quantity = meant(own, part, tree)
                said.append(
                    Said(own, owner, tree, text, anchor if owner == component else None, index, quantity)
                )
    notices += impossible(said, parts, names_used(said))
    notices += conflicts(said)
    return Meanings(tuple(said), tuple(notices))


def names_used(said: Iterable[Said]) -> frozenset[str]:
    """All names that the formulas of a page read."""
    return frozenset(str(symbol) for one in said for symbol in getattr(one.tree, "free_symbols", ()))
