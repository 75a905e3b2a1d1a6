"""What has to be said of what a page says: what cannot be, and what is said twice (rows M3, M6)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from physics.formula.quantities import INSTEAD, NAMES_OF, Role, quantities_named, quantity_of
from physics.formula.said import Said
from sketch.page import Component

_SEVERAL: frozenset[Role] = frozenset(["force", "angle", "velocity", "v_x", "v_y"])
"""Of these a thing may have several, each with a name of its own: v, and v_0 at the start."""


def impossible(said: Sequence[Said], parts: Mapping[str, Component], used: frozenset[str]) -> list[str]:
    """What a thing cannot have (M6), unless a formula of the page uses it as a mere name."""
    notices: list[str] = []
    for one in said:
        part = None if one.component is None else parts[one.component]
        kind = None if part is None else part.kind
        if quantity_of(one.name, kind) is not None or one.name in used or one.solved:
            continue
        where = NAMES_OF[kind] if part is None else f"{NAMES_OF[kind]} ({part.label})"
        quantities = quantities_named(one.name)
        if not quantities:
            notices.append(f"{one.text}: {one.name} is not a quantity of {where}; it is not used.")
            continue
        quantity = quantities[0]
        owners = " or ".join(NAMES_OF[owner] for owner in quantity.owners)
        instead = INSTEAD.get((quantity.role, kind))
        advice = "it is not used" if instead is None else f"it is not used: {instead}"
        notices.append(f"{one.text}: {quantity.spoken} belongs to {owners}, and {where} has none; {advice}.")
    return notices


def conflicts(said: Sequence[Said]) -> list[str]:
    """One thing said twice, under one name or under two; the newest holds."""
    notices: list[str] = []
    newest: dict[tuple[str, str | None], Said] = {}
    for one in said:
        key = (one.name, one.component)
        if one.quantity is not None and one.quantity.constant and one.quantity.role not in _SEVERAL:
            key = (one.quantity.role, one.component)
        before = newest.get(key)
        if before is not None and before.tree != one.tree:
            where = "the page" if one.component is None else one.component
            notices.append(f"{where} is given {before.text} and {one.text}; the newest, {one.text}, is used.")
        newest[key] = one
    return notices
