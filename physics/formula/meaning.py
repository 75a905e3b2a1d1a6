"""What a line of mathematics says of what (rows M2-M6, M11).

Each line is read as `name = value` of the components it is associated with, and the table of
`quantities` tells what that is to physics, or why it cannot be. A name whose subscript is a label
belongs to that component: `v_A` is A's velocity wherever it is written. A name is looked up on the
component itself, then anywhere on the page, then among what holds everywhere. Equations that are
not solved for one quantity give the quantities that the page lacks, or are a check of those it has.
"""

from __future__ import annotations

from collections.abc import Mapping

from physics.formula.quantities import LINKS, SOLIDS, Quantity, Role, quantity_of
from physics.formula.remarks import conflicts, impossible
from physics.formula.said import Meanings, Relation, Said, names_used
from physics.formula.solve import solve
from physics.formula.standard import DENSITY, GRAVITY, PER_METRE
from physics.formula.statements import belongs, meant, stated
from physics.formula.units import in_si, settled
from sketch.page import Component, Sketch
from sketch.shapes import Point

__all__ = [
    "DENSITY", "GRAVITY", "LINKS", "PER_METRE", "SOLIDS", "Meanings", "Quantity", "Role", "Said",
    "names_used", "quantity_of", "read",
]  # fmt: skip


def read(sketch: Sketch) -> Meanings:
    """What a page says, and notices of what cannot be read, cannot be, or is said twice."""
    said: list[Said] = []
    relations: list[Relation] = []
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
        line = stated(expression, notices)
        places = about.get(index, [(None, None)])
        if line.relation is not None:
            relations += [Relation(index, component, line.relation, line.text) for component, _ in places]
        for name, tree in line.definitions:
            for component, anchor in places:
                said.append(_said(Said(name, component, tree, line.text, anchor, index), parts, notices))
    found = solve(sketch, said, relations)
    notices += [
        *found.notices,
        *impossible(found.said, parts, names_used(found.said)),
        *conflicts(found.said),
    ]
    notices += _newtons(found.said)
    return Meanings(found.said, tuple(dict.fromkeys(notices)), found.relations)


def _said(one: Said, parts: Mapping[str, Component], notices: list[str]) -> Said:
    """With its owner, its quantity and its value in SI."""
    name, owner = belongs(one.name, one.component, parts)
    if owner != one.component and one.component is not None:
        notices.append(f"{one.text}, written of {one.component}, is taken for {owner}'s, as its name says.")
    quantity = meant(name, None if owner is None else parts[owner], one.tree)
    given = one.tree
    if quantity is not None:
        reading = settled(given, quantity.size, one.name)
        given = reading.tree
        if reading.remark is not None:
            notices.append(f"{reading.remark}.")
    tree, converted = in_si(given)
    anchor = one.anchor if owner == one.component else None
    return Said(name, owner, tree, one.text, anchor, one.expression, quantity, given, converted)


def _newtons(said: tuple[Said, ...]) -> list[str]:
    """0.3 N, where the page also gives a normal force N."""
    given = {one.name for one in said}
    notices: list[str] = []
    for one in said:
        letters = {str(symbol) for symbol in getattr(one.given, "free_symbols", ())}
        if "N" in letters & given and "N" not in names_used((one,)):
            notices.append(f"{one.text}: N after a number is the newton; write it with * for the force N.")
    return notices
