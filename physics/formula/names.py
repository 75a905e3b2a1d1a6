"""What names stand for in the formulas of one component, and the values that follow (rows M3-M5)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import hypot, inf

import sympy

from physics.formula.meaning import DENSITY, GRAVITY, SOLIDS, Meanings, Said
from physics.formula.program import STATE, Lookup, Node, Program, ProgramError, Reading, compile_tree
from physics.formula.quantities import Role
from physics.formula.said import names_in
from physics.formula.standard import square_metres
from physics.formula.statements import labelled
from physics.formula.vectors import split
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon

MASS_ROLES: tuple[Role, ...] = ("mass", "weight", "density")
"""What tells the mass of a solid, the first that is said."""


def mass_of(sketch: Sketch, meanings: Meanings, component: Component) -> tuple[float, str | None]:
    """(kg, a notice where what the page says of it cannot be).

    What the page says of the mass, else of the weight, else of the density; of a solid of which
    nothing is said, by its area.
    """
    assert isinstance(component.shape, Circle | Polygon)
    area = square_metres(component.shape)
    default = DENSITY * area
    find = lookup(sketch, meanings, component.label, {}, GRAVITY)
    for role in MASS_ROLES:
        said = meanings.of(component.label, role, component.kind)
        if said is None:
            continue
        value = constant_of(said, find) if role != "weight" else _size(said, find)
        if role == "weight":
            # A weight that is worked out from the mass, as in W = m g, tells nothing of the mass.
            g = gravity_of(sketch, meanings) or GRAVITY
            if value is None or "m" in names_in(said.tree):
                continue
            value = value / g
        if role == "density" and value is not None:
            value *= area
        if value is None or not 0 < value < inf:
            must = f"a {role} must be a number above zero; {default:.3g} kg is used as its mass"
            return default, f"{said.text} of {component.label}: {must}."
        return value, None
    return default, None


def gravity_of(sketch: Sketch, meanings: Meanings) -> float | None:
    """The acceleration of free fall that the page gives, m/s²; None where it gives none that is a number."""
    said = meanings.of(None, "gravity", None)
    return None if said is None else number_said(sketch, meanings, said)


def number_said(sketch: Sketch, meanings: Meanings, said: Said, g: float = GRAVITY) -> float | None:
    """The value at the start of what the page says of a component, where nothing but the page is known; None if
    there is none. g: m/s², where the page does not say."""
    return constant_of(said, lookup(sketch, meanings, said.component, {}, g))


def _size(said: Said, find: Lookup) -> float | None:
    """The value at the start of a number, or the length of a vector."""
    try:
        pair = split(said.tree)
    except ProgramError:
        return None
    trees = (said.tree,) if pair is None else pair
    values = [constant_of(replace(said, tree=tree), find) for tree in trees]
    return None if None in values else hypot(*(value for value in values if value is not None))


def constant_of(said: Said, find: Lookup) -> float | None:
    """The value at the start, where the motion's own quantities count as zero; None if there is none."""
    try:
        program = compile_tree(said.tree, find, said.text)
    except ProgramError:
        return None
    return value_at_rest(program)


def value_at_rest(program: Program) -> float | None:
    """A program's value where all that it reads of the motion is zero; None where it has none."""
    value = program.value([0.0] * (len(STATE) * (1 + len(program.others))))
    return value if value == value else None


def lookup(
    sketch: Sketch, meanings: Meanings, component: str | None, masses: Mapping[str, float], g: float
) -> Lookup:
    """What names stand for in the formulas of one component.

    masses: of the solids, kg, as far as known; a link's formulas speak of the movable solid at its
    end. `W` is that weight's size, m g; `m_B` is B's mass whatever the formula is about; `v_B`, `v_xB`,
    `v_yB` and `omega_B` are read from B's motion.
    """

    def find(name: str) -> Node | float | Reading | None:
        if name in STATE:
            return None
        said = meanings.find(name, component)
        if said is None:
            motion = _motion_of(name, masses)
            if motion is not None:
                return motion
            base, _, index = name.partition("_")
            if any(part.label == index for part in sketch.components):
                of_it = meanings.find(base, index)
                if of_it is not None and of_it.component == index:
                    return of_it.tree
                if base in ("m", "W") and index in masses:
                    return masses[index] * (g if base == "W" else 1.0)
        own = said if said is not None and said.component == component else None
        if own is not None and not (name == "W" and isinstance(own.tree, sympy.Tuple)):
            return own.tree
        body = solid_of(sketch, component) if name in ("m", "W") else None
        if body is not None and body in masses:
            return masses[body] * (g if name == "W" else 1.0)
        if said is not None:
            return said.tree
        return g if name == "g" else None

    return find


def _motion_of(name: str, masses: Mapping[str, float]) -> Reading | None:
    """What `v_B`, `v_xB`, `v_Bx`, `v_yB` or `omega_B` reads of solid B."""
    found = labelled(name, masses)
    return Reading(*found) if found is not None and found[0] in ("v", "v_x", "v_y", "omega") else None


def solid_of(sketch: Sketch, component: str | None) -> str | None:
    """The solid that a component's formulas speak of: itself, or the movable one at a link's end."""
    if component is None:
        return None
    part = sketch.component(component)
    if part.kind in SOLIDS:
        return component
    ends = [sketch.component(end) for end in part.ends if end is not None]
    movable = [end.label for end in ends if not end.fixed]
    return movable[0] if movable else None
