"""Equations that are not solved for one quantity (row M11).

`½mv² = mgh`, `ΣF = ma`, `T₁ sin α + T₂ sin β = W`, several at once: numbers are put in for all that
the page gives, and what it lacks is solved for. All real solutions are kept; the one that can be is
chosen, by what its quantity allows (a mass is above zero, an angle of an incline is between 0 and
90°), and the others are named. Where nothing is lacking the equation is a check. Masses that the page
does not give are unknown while that leaves as many equations as unknowns; beyond, they are what the
drawing makes them.

What governs is not changed by what is an answer: a `v` that is found is the speed of which the
equation speaks, not one at the start, which is called v_0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import inf, pi

import sympy

from physics.formula.bounded import bounded
from physics.formula.equations import Letter, Letters, Unsolvable, lacking, number, sides
from physics.formula.program import Node
from physics.formula.quantities import INSTEAD, QUANTITIES, Quantity, Role, quantities_named, quantity_of
from physics.formula.said import Meanings, Relation, Said, symbols_in
from physics.formula.si import NUMBER
from sketch.page import Sketch


@dataclass(frozen=True, slots=True)
class SolveLimits:
    """What is given to SymPy's solver, and for how long."""

    unknowns: int = 4
    equations: int = 6
    operations: int = 120
    """Of one system after numbers are put in; handwritten ones have 30."""
    calls: int = 600_000
    """Function calls: T₁ sin α + T₂ sin β = W with its companion takes about 20,000."""
    seconds: float = 3.0
    off: float = 1e-6
    """Share of its larger side by which an equation may be off and still hold: pages give few digits."""


LIMITS = SolveLimits()

_RANGES: dict[Role, tuple[float, float]] = {
    **dict.fromkeys(
        (
            "mass",
            "density",
            "stiffness",
            "length",
            "speed",
            "time",
            "period",
            "frequency",
            "inertia",
            "gravity",
        ),
        (0.0, inf),
    ),
    **dict.fromkeys(("tension", "weight", "friction", "height", "distance", "kinetic"), (0.0, inf)),
    "restitution": (0.0, 1.0),
    "angle": (0.0, pi / 2),
}
"""What a quantity can be."""
_NEVER_ZERO: frozenset[Role] = frozenset(["mass", "density", "length"])
_OF_A_MOMENT: dict[Role, Role] = {
    "velocity": "speed", "v_x": "speed", "v_y": "speed", "x": "distance", "y": "distance",
    "position": "distance", "spin": "angular_velocity",
}  # fmt: skip
"""What a solved value is, instead of governing the motion from its start."""


@dataclass(frozen=True, slots=True)
class Solved:
    """said: all that is said, what was solved for last; relations: the equations; notices: what was found."""

    said: tuple[Said, ...]
    relations: tuple[Relation, ...]
    notices: tuple[str, ...]


def solve(sketch: Sketch, said: Sequence[Said], relations: Sequence[Relation]) -> Solved:
    """What the equations of a page give beside what it says."""
    names = frozenset(one.name for one in said)
    doubled = _doubled(said)
    twins = [one for one in said if lacking(one, names, doubled)]
    kept = [one for one in said if one not in twins]
    turned = [
        Relation(
            one.expression,
            one.component,
            sympy.Equality(sympy.Symbol(one.name), one.given, evaluate=False),
            one.text,
        )
        for one in twins
        if one.expression is not None
    ]
    every = (*relations, *turned)
    if not every:
        return Solved(tuple(said), (), ())
    letters = Letters(sketch, Meanings(tuple(kept), ()), {part.label: part for part in sketch.components})
    notices: list[str] = []
    ready: list[_Equation] = []
    for relation in every:
        try:
            left, right = sides(relation, letters)
        except Unsolvable as problem:
            notices.append(f"{relation.text} cannot be solved: {problem.reason}.")
            continue
        ready.append(_Equation(relation, left, right))
    found: list[Said] = []
    for system in _systems(ready, letters):
        found += _worked(system, letters, notices)
    return Solved((*kept, *found), tuple(every), tuple(notices))


@dataclass(frozen=True, slots=True)
class _Equation:
    relation: Relation
    left: Node
    right: Node

    def unknowns(self, letters: Letters) -> set[sympy.Symbol]:
        symbols = symbols_in(self.left) | symbols_in(self.right)
        return {symbol for symbol in symbols if symbol in letters.unknown and symbol not in letters.known}


def _doubled(said: Sequence[Said]) -> frozenset[tuple[str, str | None]]:
    """Names of one owner that several lines give."""
    lines: dict[tuple[str, str | None], set[int | None]] = {}
    for one in said:
        lines.setdefault((one.name, one.component), set()).add(one.expression)
    return frozenset(key for key, indices in lines.items() if len(indices) > 1)


def _systems(equations: Sequence[_Equation], letters: Letters) -> list[list[_Equation]]:
    """Equations that share unknowns, together."""
    systems: list[list[_Equation]] = []
    for equation in equations:
        mine = equation.unknowns(letters)
        joined = [s for s in systems if any(one.unknowns(letters) & mine for one in s)]
        systems = [s for s in systems if s not in joined]
        systems.append([*(one for s in joined for one in s), equation])
    return systems


def _worked(system: list[_Equation], letters: Letters, notices: list[str]) -> list[Said]:
    """What a system gives; a notice of what it gives, or why not."""
    for symbol in _unknowns(system, letters):
        mass = letters.default_mass(letters.unknown[symbol])
        cancels = all(symbol not in symbols_in(_difference(one, letters)) for one in system)
        if mass is not None and (cancels or len(_unknowns(system, letters)) > len(system)):
            letters.known[symbol] = mass
    unknowns = _unknowns(system, letters)
    text = "; ".join(dict.fromkeys(equation.relation.text for equation in system))
    if not unknowns:
        notices.extend(_checked(equation, letters) for equation in system)
        return []
    if len(unknowns) > len(system):
        wanted = " and ".join(_spoken(letters.unknown[symbol], letters) for symbol in unknowns)
        notices.append(f"{text}: {wanted} are lacking on this page; give all of them but {len(system)}.")
        return []
    branches = _branches(system, unknowns, letters)
    if isinstance(branches, str):
        notices.append(f"{text}: {branches}")
        return []
    chosen = _possible(branches, unknowns, letters)
    if chosen is None:
        got = " or ".join(_told(branch, unknowns, letters) for branch in branches)
        notices.append(f"{text} gives {got}, which cannot be; it is not used.")
        return []
    others = " or ".join(_told(branch, unknowns, letters) for branch in branches if branch is not chosen)
    beside = f" (also {others}, which is not used)" if others else ""
    notices.append(f"{text} gives {_told(chosen, unknowns, letters)}{beside}.")
    relation = system[-1].relation
    for symbol in unknowns:
        letter = letters.unknown[symbol]
        role = _role(letter, letters)
        if letters.owner(letter) is None and role is not None and (role, None) in INSTEAD:
            notices.append(f"{letter.name} governs nothing yet: {INSTEAD[role, None]}.")
    return [
        _found(letters.unknown[symbol], value, relation, letters)
        for symbol, value in zip(unknowns, chosen, strict=True)
    ]


def _unknowns(system: Sequence[_Equation], letters: Letters) -> list[sympy.Symbol]:
    return sorted(
        {symbol for equation in system for symbol in equation.unknowns(letters)},
        key=lambda symbol: symbol.name,
    )


def _difference(equation: _Equation, letters: Letters) -> Node:
    """What must be zero, without the masses and lengths that multiply all of it: they are not zero."""
    symbols = (symbols_in(equation.left) | symbols_in(equation.right)) & letters.unknown.keys()
    fixed = frozenset(one for one in symbols if _role(letters.unknown[one], letters) in _NEVER_ZERO)
    return _without(equation.left, equation.right, fixed)


@lru_cache(maxsize=512)
def _without(left: Node, right: Node, factors: frozenset[sympy.Symbol]) -> Node:
    whole = sympy.factor_terms(left - right)
    return sympy.Mul(*(part for part in sympy.Mul.make_args(whole) if part not in factors))


def _checked(equation: _Equation, letters: Letters) -> str:
    """What an equation says of a page that lacks nothing."""
    text = equation.relation.text
    left, right = (_value(side, letters) for side in (equation.left, equation.right))
    if left is None or right is None:
        return f"{text}: one of its sides has no value with what this page gives."
    size = max(abs(left), abs(right))
    if abs(left - right) <= LIMITS.off * size:
        return f"{text} holds on this page: both sides are {left:.4g}."
    off = f"off by {abs(left - right) / size:.1%}"
    return f"{text} does not hold on this page: {left:.4g} on the left, {right:.4g} on the right, {off}."


def _value(tree: Node, letters: Letters) -> float | None:
    return number(tree, letters.known)


def _branches(
    system: Sequence[_Equation], unknowns: Sequence[sympy.Symbol], letters: Letters
) -> list[tuple[float, ...]] | str:
    """All real solutions, a number for each unknown; or why there are none."""
    equations = tuple(_difference(equation, letters) for equation in system)
    operations = sum(_operations(equation) for equation in equations)
    if len(unknowns) > LIMITS.unknowns or len(system) > LIMITS.equations or operations > LIMITS.operations:
        return "too long to be solved here; write it as name = value."
    solutions = _solutions(equations, tuple(unknowns))
    if solutions is None:
        return "this cannot be solved here in reasonable time; write it as name = value."
    found: list[tuple[float, ...]] = []
    for solution in solutions:
        numbers = [_value(value, letters) for value in solution]
        real = tuple(value for value in numbers if value is not None)
        if len(real) == len(unknowns) and not any(_near(real, other) for other in found):
            found.append(real)
    return found or "no real numbers solve this; is something written wrongly?"


@lru_cache(maxsize=512)
def _operations(equation: Node) -> int:
    return int(sympy.count_ops(equation))


@lru_cache(maxsize=512)
def _solutions(
    equations: tuple[Node, ...], unknowns: tuple[sympy.Symbol, ...]
) -> tuple[tuple[Node, ...], ...] | None:
    """What SymPy finds, in letters; None where it does not, or takes too long. Remembered: a page is
    read anew whenever any of its lines changes."""

    def work() -> tuple[tuple[Node, ...], ...] | None:
        try:
            solved = sympy.solve(equations, unknowns, dict=True, check=False, simplify=False)
        except Exception:
            # SymPy raises a dozen kinds, among them TypeError and RecursionError, where it has no method.
            return None
        return tuple(tuple(one[u] for u in unknowns) for one in solved if all(u in one for u in unknowns))

    return bounded(work, LIMITS.calls, LIMITS.seconds)


def _near(one: Sequence[float], other: Sequence[float]) -> bool:
    return all(abs(a - b) <= 1e-9 * max(1.0, abs(a), abs(b)) for a, b in zip(one, other, strict=True))


def _possible(
    branches: Sequence[tuple[float, ...]], unknowns: Sequence[sympy.Symbol], letters: Letters
) -> tuple[float, ...] | None:
    """The branch that can be; of several the one with the least numbers: the first moment, the
    least angle."""
    able: list[tuple[float, ...]] = []
    for branch in branches:
        if all(
            _can_be(value, _role(letters.unknown[s], letters))
            for s, value in zip(unknowns, branch, strict=True)
        ):
            able.append(branch)
    moving = [branch for branch in able if any(value != 0 for value in branch)]
    return min(moving or able, key=lambda branch: tuple((abs(v), v < 0) for v in branch), default=None)


def _can_be(value: float, role: Role | None) -> bool:
    low, high = (-inf, inf) if role is None else _RANGES.get(role, (-inf, inf))
    return low - 1e-12 <= value <= high + 1e-12 and not (role in _NEVER_ZERO and value == 0)


def _role(letter: Letter, letters: Letters) -> Role | None:
    quantity = _quantity(letter, letters)
    return None if quantity is None else quantity.role


def _quantity(letter: Letter, letters: Letters) -> Quantity | None:
    """What an unknown is: a velocity found is one of a moment."""
    owner = letters.owner(letter)
    kind = None if owner is None else letters.parts[owner].kind
    quantity = quantity_of(letter.name, kind)
    if quantity is None and owner is None:
        quantity = next(iter(quantities_named(letter.name)), None)
    if quantity is None or quantity.role not in _OF_A_MOMENT or letter.name.startswith("v_0"):
        return quantity
    role = _OF_A_MOMENT[quantity.role]
    return next((one for one in QUANTITIES if one.role == role and kind in one.owners), None)


def _found(letter: Letter, value: float, relation: Relation, letters: Letters) -> Said:
    owner = letters.owner(letter)
    quantity = _quantity(letter, letters)
    kind = None if owner is None else letters.parts[owner].kind
    own = None if quantity is None or kind not in quantity.owners else quantity
    text = f"{letter.name} = {value:.6g}"
    tree = sympy.Float(value, 17)
    return Said(letter.name, owner, tree, text, None, relation.expression, own, None, None, solved=True)


def _told(branch: Sequence[float], unknowns: Sequence[sympy.Symbol], letters: Letters) -> str:
    parts: list[str] = []
    for symbol, value in zip(unknowns, branch, strict=True):
        letter = letters.unknown[symbol]
        quantity = _quantity(letter, letters)
        unit = "" if quantity is None or quantity.size == NUMBER else f" {quantity.size}"
        parts.append(f"{_spoken(letter, letters)} = {value:.4g}{unit}")
    return ", ".join(parts)


def _spoken(letter: Letter, letters: Letters) -> str:
    owner = letters.owner(letter)
    return letter.name if owner is None else f"{letter.name} of {owner}"
