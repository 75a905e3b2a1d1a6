"""What a page says, as values: single statements, equations between several quantities, and all of them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from physics.formula.quantities import Quantity, Role, quantity_of
from sketch.formula.units import Unit
from sketch.shapes import ComponentKind, Point


@dataclass(frozen=True, slots=True)
class Said:
    """One thing that the page says: `name` of `component` (None: of the whole page) = `tree`.

    tree: in SI, without units; text: as written; anchor: where on the component it was tapped, page
    units; expression: which of the page's it is; quantity: what it is to physics, None for a mere
    name; given: the right side as written, with units; converted: the conversion to SI that was made,
    in words; solved: whether it was worked out from equations.
    """

    name: str
    component: str | None
    tree: Any
    text: str
    anchor: Point | None = None
    expression: int | None = None
    quantity: Quantity | None = None
    given: Any = None
    converted: str | None = None
    solved: bool = False


@dataclass(frozen=True, slots=True)
class Relation:
    """An equation that is not solved for one quantity: tree, an Equality with its units; of which
    component it is written (None: of none)."""

    expression: int
    component: str | None
    tree: Any
    text: str


@dataclass(frozen=True, slots=True)
class Meanings:
    """All that a page says, in the order of association (the newest last)."""

    said: tuple[Said, ...]
    notices: tuple[str, ...]
    relations: tuple[Relation, ...] = ()

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
        elsewhere: Said | None = None
        everywhere: Said | None = None
        for said in reversed(self.said):
            if said.name != name:
                continue
            if said.component == component:
                return said
            if said.component is None:
                everywhere = everywhere or said
            else:
                elsewhere = elsewhere or said
        return elsewhere or everywhere

    @property
    def answers(self) -> tuple[Said, ...]:
        """What governs nothing and can be verified."""
        return tuple(said for said in self.said if said.quantity is not None and said.quantity.answer)


def names_used(said: Iterable[Said | Relation]) -> frozenset[str]:
    """All names that the formulas of a page read."""
    return frozenset().union(*(names_in(one.tree) for one in said))


@lru_cache(maxsize=4096)
def names_in(tree: Any) -> frozenset[str]:
    """The names in a tree, its units not among them."""
    return frozenset(symbol.name for symbol in symbols_in(tree) if not isinstance(symbol, Unit))


@lru_cache(maxsize=4096)
def symbols_in(tree: Any) -> frozenset[Any]:
    """The symbols in a tree, names and units. SymPy looks for them anew each time."""
    return frozenset(getattr(tree, "free_symbols", ()))
