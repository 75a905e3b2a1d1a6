"""Units in formulas: `m = 5 kg`, `v = 36 km/h`, `F = 3 N m`, `θ = 30°`.

The same letters name units and quantities (m is the metre and a mass, N the newton and a normal
force), so one rule tells them apart. **A unit stands after a number** (or a bracket, root or
fraction of numbers), and:

- degrees, units of several letters (kg, km, cm, ms, Hz, deg …), whatever is set upright
  (`\\mathrm{m}`, `\\text{km/h}`) and letters with a fraction bar between them (m/s, N/m) are units there;
- a letter alone or beside others (m, s, N, J, N m) is one only after a space, and where the term
  ends with it or goes on with a number: `x = 5 m`, `F = 3 N m`, `5 m + 3 m`, `5 m * 3`.
  `5m`, `5*m`, `1/2 m v^2` and `2 m g` are products with the mass;
- g, h and W are quantities unless set upright; h is the hour in km/h and km h^-1.

A number and its unit are one operand, `6 m / 2 s` is 3 m/s; but `1/2 m` is half a metre. In a tree
a unit is a `Unit`; what it is in SI units is not the language's business.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy
from sympy.core.basic import Basic

from sketch.formula.build import power
from sketch.formula.lexer import FormulaError, Token, TokenKind
from sketch.formula.names import UNIT_LETTERS, UNITS, UPRIGHT_LETTERS


class Unit(sympy.Symbol):
    """A unit in a tree, `36 km/h` being 36·Unit(km)/Unit(h). Never equal to the symbol of that name."""

    __slots__ = ()


def unit(name: str) -> Unit:
    """The unit of that canonical name."""
    return Unit(name, positive=True)


@dataclass(frozen=True, slots=True)
class UnitLimits:
    factors: int = 12
    """Units in one product: no quantity of physics has more."""
    power: int = 12


LIMITS = UnitLimits()
_ENDS_TERM: frozenset[TokenKind] = frozenset(["end", "+", "-", "=", ",", ")", "]", "}"])


def units_at(
    text: str, found: Sequence[Token], at: int, closer: TokenKind | None
) -> tuple[list[Basic], int] | None:
    """The units that begin at token `at`, which follows a number, and the token after them; None where
    what stands there is no unit. closer: what closes the innermost bracket.

    Raises FormulaError for powers that no unit has.
    """
    factors: list[Basic] = []
    end, sure = at, False
    while len(factors) < LIMITS.factors:
        begin = end + 1 if factors and found[end].kind in ("*", "/") else end
        under = begin > end and found[end].kind == "/"
        one = _unit_at(found, begin, under, first=not factors)
        if one is None:
            break
        names, after, certain = one
        raised = _exponent(found, after)
        if raised is None and not (sure or certain):
            return None
        if raised is None:
            reason = f"a unit's power is a whole number up to {LIMITS.power}, as in m/s^2"
            raise FormulaError(reason, text, found[min(after + 1, len(found) - 1)].start)
        exponent, end = raised
        factors += [power(unit(name), sympy.Integer(-exponent if under else exponent)) for name in names]
        sure = sure or certain or under
    follows = found[end]
    ends = follows.kind in _ENDS_TERM or follows.kind == closer
    if follows.kind in ("*", "/"):
        ends = found[end + 1].kind == "number"
    return (factors, end) if factors and (sure or ends) else None


def _unit_at(
    found: Sequence[Token], at: int, under: bool, first: bool
) -> tuple[tuple[str, ...], int, bool] | None:
    """(canonical names, the next token, whether it can be nothing else) of one unit."""
    here = found[at]
    if here.kind == "unit":
        return (here.value,), at + 1, True
    after = at
    while found[after].kind == "name" and found[after].upright == here.upright:
        if after > at and found[after].start != found[after - 1].end:
            break
        after += 1
    run = "".join(token.value for token in found[at:after])
    if run in UNITS:
        return UNITS[run], after, True
    if here.upright and (run in UNIT_LETTERS or run in UPRIGHT_LETTERS):
        return (run,), after, True
    spaced = not first or found[at - 1].end < here.start
    hour = run == "h" and not first and (under or found[after].kind == "^")
    if spaced and (run in UNIT_LETTERS or hour):
        return (run,), after, False
    return None


def _exponent(found: Sequence[Token], at: int) -> tuple[int, int] | None:
    """(the whole power that stands at token `at`, or 1; the token after it); None for any other power."""
    if found[at].kind != "^":
        return 1, at
    closing: dict[str, str] = {"{": "}", "(": ")"}
    opening = found[at + 1].kind
    k = at + 1 + (opening in closing)
    negative = found[k].kind == "-"
    digits = found[k + negative]
    k += 1 + negative
    whole = digits.kind == "number" and len(digits.value) < 3 and digits.value.isdigit()
    if not whole or int(digits.value) > LIMITS.power:
        return None
    if opening in closing:
        if found[k].kind != closing[opening]:
            return None
        k += 1
    return (-1 if negative else 1) * int(digits.value), k
