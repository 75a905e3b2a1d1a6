"""Units of formulas in SI: their dimensions, and formulas without them.

Coherent SI units are 1; angles are exact multiples of π, in radians; for all others pint's
definitions are used, as exact fractions. pint is imported when the first such unit is met, which
takes about 0.3 s once. Trees never change, so what was once worked out of one is remembered.

A few letters are both: the language reads `2 m` as two metres and `500 g` as 500 times g. Where
that cannot be what the left side needs, and the other reading is, the other is taken (`settled`).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

import sympy

from physics.formula.program import Node
from physics.formula.si import (
    ACCELERATION,
    ENERGY,
    FORCE,
    LENGTH,
    MASS,
    NUMBER,
    POWER,
    PRESSURE,
    RATE,
    TIME,
    VELOCITY,
    Dimension,
)
from sketch.formula.print import plain
from sketch.formula.units import Unit, unit

SIZES: dict[str, Dimension] = {
    **dict.fromkeys(("kg", "g", "lb"), MASS),
    **dict.fromkeys(("m", "km", "dm", "cm", "mm", "ft", "inch", "mi"), LENGTH),
    **dict.fromkeys(("s", "ms", "min", "h"), TIME),
    **dict.fromkeys(("deg", "rad", "rev"), NUMBER),
    **dict.fromkeys(("Hz", "kHz", "rpm"), RATE),
    "mph": VELOCITY,
    **dict.fromkeys(("N", "mN", "kN", "MN", "lbf"), FORCE),
    **dict.fromkeys(("J", "mJ", "kJ", "MJ", "eV", "kWh"), ENERGY),
    **dict.fromkeys(("W", "kW", "MW"), POWER),
    **dict.fromkeys(("Pa", "kPa", "MPa"), PRESSURE),
}
"""The dimension of every unit of the language."""

_COHERENT = frozenset(["kg", "m", "s", "N", "J", "W", "Pa", "Hz", "rad"])
_TURNS: dict[str, Any] = {"deg": sympy.pi / 180, "rev": 2 * sympy.pi, "rpm": sympy.pi / 30}
_IN_PINT = {"h": "hour", "min": "minute", "mi": "mile", "mph": "mile/hour", "lb": "pound", "lbf": "force_pound", "rpm": "rpm"}  # fmt: skip
_AS_NAMES: dict[str, Dimension] = {
    "m": MASS,
    "s": LENGTH,
    "N": FORCE,
    "g": ACCELERATION,
    "h": LENGTH,
    "W": FORCE,
}
"""What letters that name a unit are as quantities."""


@dataclass(frozen=True, slots=True)
class Settled:
    """tree: as it is to be read; remark: how, where that is not how the language reads it."""

    tree: Node
    remark: str | None = None


@lru_cache(maxsize=256)
def factor(name: str) -> Node:
    """What one of a unit is in SI units, exactly; angles in radians. Raises KeyError for no unit."""
    if name in _COHERENT:
        return sympy.Integer(1)
    if name in _TURNS:
        return _TURNS[name]
    one = _registry().Quantity(Fraction(1), _IN_PINT.get(name, name)).to_base_units()
    return sympy.Rational(*Fraction(one.magnitude).as_integer_ratio())


@lru_cache(maxsize=1)
def _registry() -> Any:
    import pint  # 0.3 s, and most pages have SI units only

    exact: Any = Fraction
    return pint.UnitRegistry(non_int_type=exact)


@lru_cache(maxsize=4096)
def in_si(tree: Node) -> tuple[Node, str | None]:
    """The tree without units, in SI, and which conversions that took, in words (None: none)."""
    units = _units_of(tree)
    if not units:
        return tree, None
    said = [_told(part) for part in _measured(tree)]
    plain_tree = _replaced(tree, {one: factor(one.name) for one in units})
    told = [words for words in dict.fromkeys(said) if words is not None]
    return plain_tree, "; ".join(told) or None


@lru_cache(maxsize=4096)
def size_of_units(tree: Node) -> Dimension:
    """The dimension of a product of units and numbers; what is neither counts as a number."""
    size = NUMBER
    for part in _factors(tree):
        base, power = part.as_base_exp()
        if isinstance(base, Unit) and power.is_Rational:
            size *= SIZES[base.name] ** Fraction(int(power.p), int(power.q))
    return size


def has_units(tree: Node) -> bool:
    return bool(_units_of(tree))


@lru_cache(maxsize=4096)
def settled(tree: Node, size: Dimension, name: str) -> Settled:
    """The right side of `name = tree`, which must be of this size: letters after a number read as units
    or as quantities, whichever can be."""
    if not isinstance(tree, sympy.Mul | Unit | sympy.Symbol):
        return Settled(tree)
    factors = [part for part in _factors(tree) if not part.is_number]
    number = sympy.Mul(*(part for part in _factors(tree) if part.is_number))
    bases: list[tuple[Node, Node]] = [part.as_base_exp() for part in factors]
    if (
        not factors
        or number == 1
        or not all(isinstance(base, sympy.Symbol) and power.is_Integer for base, power in bases)
    ):
        return Settled(tree)
    if all(isinstance(base, Unit) for base, _ in bases) and size_of_units(tree) != size:
        other = [(sympy.Symbol(base.name), power) for base, power in bases]
        if _product(other) == size:
            read = sympy.Mul(number, *(base**power for base, power in other))
            return Settled(
                read, f"{name} = {plain(tree)} is read as {plain(read)}, since {name} is {size.spoken}"
            )
    if len(bases) == 1 and not isinstance(bases[0][0], Unit) and bases[0][0].name in ("g", "h", "W"):
        read = tree.xreplace({bases[0][0]: unit(bases[0][0].name)})
        if size_of_units(read) == size:
            return Settled(
                read, f"{name} = {plain(tree)} is read as {plain(read)}, since {name} is {size.spoken}"
            )
    return Settled(tree)


def _factors(tree: Node) -> list[Node]:
    return list(sympy.Mul.make_args(tree))


def _product(bases: list[tuple[Node, Node]]) -> Dimension | None:
    size = NUMBER
    for base, power in bases:
        if base.name not in _AS_NAMES:
            return None
        size *= _AS_NAMES[base.name] ** int(power)
    return size


@lru_cache(maxsize=4096)
def _units_of(tree: Node) -> frozenset[Unit]:
    return frozenset(one for one in getattr(tree, "free_symbols", ()) if isinstance(one, Unit))


def _replaced(tree: Node, factors: dict[Unit, Node]) -> Node:
    """Functions stay as they are written: sin(30°) is sin(π/6), not 1/2."""
    if not tree.args:
        return factors.get(tree, tree)
    args = [_replaced(part, factors) for part in tree.args]
    if isinstance(tree, sympy.Function | sympy.Equality):
        return tree.func(*args, evaluate=False)
    return tree.func(*args)


def _measured(tree: Node) -> list[Node]:
    """The products of a number and units within a tree."""
    factors = _factors(tree) if isinstance(tree, sympy.Expr) else []
    if any(isinstance(part.as_base_exp()[0], Unit) for part in factors):
        numbers = [part for part in factors if part.is_number or isinstance(part.as_base_exp()[0], Unit)]
        rest = [part for part in factors if part not in numbers]
        return [sympy.Mul(*numbers), *(found for part in rest for found in _measured(part))]
    return [found for part in tree.args for found in _measured(part)]


def _told(measured: Node) -> str | None:
    names = {one.name for one in _units_of(measured)}
    if names <= _COHERENT:
        return None
    size = size_of_units(measured)
    value = float(_replaced(measured, {unit(name): factor(name) for name in names}))
    angle = size == NUMBER or names & set(_TURNS)
    written = ("rad" if size == NUMBER else "rad/s") if angle and size in (NUMBER, RATE) else str(size)
    return f"{plain(measured)} is {value:.6g} {written}"
