"""SymPy trees written as text: `plain` as a person types, `latex` as a person typesets.

Both are inverse to `parse`: parse(plain(tree)) == tree and parse(latex(tree)) == tree for every
tree that the formula language has. One walk serves both, and `mathml`; a `Notation` holds what
differs.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import sympy
from sympy.core.basic import Basic

from sketch.formula.names import FUNCTIONS, GREEK, UNIT_LETTERS
from sketch.formula.units import LIMITS, Unit

SUM, PRODUCT, POWER, ATOM = range(4)
"""How tightly a piece of text holds together; looser pieces are bracketed."""

_NAMES: dict[str, str] = {function.__name__: name for name, function in FUNCTIONS.items() if name != "norm"}
_DECIMAL_FROM = 10
"""Fractions of this denominator and above that end as decimals are written so: 981/100 as 9.81, but 1/8."""
_DECIMAL_PLACES = 12
"""Fractions that need more places are written as fractions."""


@dataclass(frozen=True, slots=True)
class Piece:
    text: str
    hold: int


@dataclass(frozen=True, slots=True)
class Notation:
    """number, symbol (of a canonical name) → text; product: factors → text; units: their product, and
    a number with them; fraction, root and call put their parts into a template.

    minus, plus, equals, comma: between parts; negative: before a part, and never within one;
    decimals: sizes of numbers that are written with a point, though they would look well as fractions.
    """

    number: Callable[[str], str]
    symbol: Callable[[str], str]
    product: Callable[[Sequence[str]], str]
    units: Callable[[Sequence[tuple[str, int]]], str]
    measured: Callable[[str, str], str]
    fraction: Callable[[Piece, Piece], Piece]
    power: Callable[[str, Piece], str]
    root: Callable[[str, int], str]
    call: Callable[[str, str], str]
    brackets: Callable[[str], str]
    pi: str
    minus: str = " - "
    plus: str = " + "
    equals: str = " = "
    comma: str = ", "
    negative: str = "-"
    decimals: frozenset[Fraction] = frozenset()


def plain(tree: Basic, decimals: frozenset[Fraction] = frozenset()) -> str:
    """The formula in ASCII as typed on a keyboard: `f_1 = |W|*cos(theta)`. decimals (see `lexer.decimals`): what
    somebody wrote as 0.5 is 0.5 again, not 1/2, which is the same number."""
    return write(tree, replace(_PLAIN, decimals=decimals)).text


def latex(tree: Basic, decimals: frozenset[Fraction] = frozenset()) -> str:
    """The formula in LaTeX: `f_{1} = \\left|W\\right| \\cos\\left(\\theta\\right)`. decimals as of `plain`."""
    return write(tree, replace(_LATEX, decimals=decimals)).text


def write(tree: Basic, notation: Notation) -> Piece:
    match tree:
        case sympy.Equality():
            left, right = (write(side, notation).text for side in tree.args)
            return Piece(left + notation.equals + right, SUM)
        case sympy.Tuple():
            components = notation.comma.join(write(component, notation).text for component in tree.args)
            return Piece(notation.brackets(components), ATOM)
        case Unit():
            return Piece(notation.brackets(_product([tree], notation).text), ATOM)
        case sympy.Symbol():
            return Piece(notation.symbol(tree.name), ATOM)
        case sympy.Rational():
            return _number(_exact(tree), notation)
        case sympy.Float():
            return _number(Fraction(str(tree)), notation)
        case sympy.Add():
            return _sum(tree, notation)
        case sympy.Mul():
            return _product(tree.args, notation)
        case sympy.Pow():
            return _power(tree, notation)
        case sympy.Function():
            name = _NAMES.get(type(tree).__name__, type(tree).__name__)
            return Piece(notation.call(name, write(tree.args[0], notation).text), ATOM)
        case _ if tree is sympy.pi:
            return Piece(notation.pi, ATOM)
        case _ if tree is sympy.E:
            return Piece(notation.call("exp", notation.number("1")), ATOM)
        case _:
            raise ValueError(f"{tree} ({type(tree).__name__}) is not part of the formula language")


def _exact(number: sympy.Rational) -> Fraction:
    return Fraction(int(number.p), int(number.q))


def _number(number: Fraction, notation: Notation) -> Piece:
    decimal = _decimal(abs(number), abs(number) in notation.decimals)
    if decimal is not None:
        return _signed(Piece(notation.number(decimal), ATOM), number, notation)
    over, under = (_whole(part, notation) for part in number.as_integer_ratio())
    return _signed(notation.fraction(over, under), number, notation)


def _whole(number: int, notation: Notation) -> Piece:
    return Piece(notation.number(str(abs(number))), ATOM)


def _sum(tree: sympy.Add, notation: Notation) -> Piece:
    """Terms in SymPy's order, but a positive one first where there is one: 3t − gt²/2."""
    terms = [write(term, notation).text for term in _ordered(tree)]
    first = next((term for term in terms if not term.startswith(notation.negative)), terms[0])
    terms.remove(first)
    rest = (
        notation.minus + term[len(notation.negative) :]
        if term.startswith(notation.negative)
        else notation.plus + term
        for term in terms
    )
    return Piece(first + "".join(rest), SUM)


def _product(factors: Sequence[Basic], notation: Notation) -> Piece:
    """Numbers, then names, then the rest, over the factors whose exponent is a negative number."""
    units = [_unit_power(factor) for factor in factors]
    if any(units):
        named = [found for found in units if found is not None]
        return _measured(
            [f for f, found in zip(factors, units, strict=True) if found is None], named, notation
        )
    coefficient = Fraction(1)
    above: list[Piece] = []
    below: list[Piece] = []
    for factor in sorted(factors, key=_rank):
        if isinstance(factor, sympy.Rational):
            coefficient *= _exact(factor)
        elif isinstance(factor, sympy.Pow) and _is_negative_number(factor.exp):
            below.append(_raised(factor.base, -factor.exp, notation))
        else:
            above.append(write(factor, notation))
    return _quotient(coefficient, above, below, notation)


def _quotient(coefficient: Fraction, above: list[Piece], below: list[Piece], notation: Notation) -> Piece:
    size = _number(abs(coefficient), notation)
    if coefficient.denominator == 1 or size.hold == ATOM:
        over, under = size, None
    else:
        over, under = (_whole(part, notation) for part in coefficient.as_integer_ratio())
    one = _whole(1, notation)
    if _spreads(over, above, one) or _spreads(under, below, one):
        piece = notation.product([size.text, _fraction(above, below, notation).text])
        return _signed(Piece(piece, PRODUCT), coefficient, notation)
    if over != one:
        above.insert(0, over)
    if under is not None:
        below.insert(0, under)
    return _signed(_fraction(above, below, notation), coefficient, notation)


def _measured(factors: Sequence[Basic], units: Sequence[tuple[str, int]], notation: Notation) -> Piece:
    """A number and its units, the factor before all others."""
    coefficient = next((f for f in factors if isinstance(f, sympy.Rational)), sympy.S.One)
    # A sum stays apart: SymPy would multiply the number into it.
    bare = [not f.free_symbols and not isinstance(f, sympy.Add) for f in factors]
    numbers = [f for f, alone in zip(factors, bare, strict=True) if alone and f is not coefficient]
    others = [f for f, alone in zip(factors, bare, strict=True) if not alone]
    sign = Fraction(-1 if coefficient < 0 else 1)
    size = _product([abs(coefficient), *numbers], notation)
    plain_number = size.hold == ATOM or (
        size.hold == PRODUCT
        and not any(isinstance(f, sympy.Pow) and _is_negative_number(f.exp) for f in numbers)
        and coefficient.q == 1
    )
    number = size.text if plain_number else notation.brackets(size.text)
    order = [*(u for u in units if u[1] > 0), *(u for u in units if u[1] < 0)]
    piece = Piece(notation.measured(number, notation.units(order)), PRODUCT)
    if others:
        rest = Piece(notation.brackets(piece.text), ATOM)
        above = [write(f, notation) for f in others if not _is_reciprocal(f)]
        below = [
            _raised(f.base, -f.exp, notation)
            for f in others
            if isinstance(f, sympy.Pow) and _is_negative_number(f.exp)
        ]
        piece = _fraction([rest, *above], below, notation)
    return _signed(piece, sign, notation)


def _unit_power(factor: Basic) -> tuple[str, int] | None:
    """(unit, whole power) of a factor that is one."""
    base, power = factor.as_base_exp() if isinstance(factor, sympy.Pow) else (factor, sympy.S.One)
    if isinstance(base, Unit) and power.is_Integer and abs(power) <= LIMITS.power:
        return base.name, int(power)
    return None


def _is_reciprocal(factor: Basic) -> bool:
    return isinstance(factor, sympy.Pow) and _is_negative_number(factor.exp)


def _spreads(number: Piece | None, factors: Sequence[Piece], one: Piece) -> bool:
    """Whether SymPy would multiply the number into the one sum that stands beside it: 2·(a + b) is
    2·a + 2·b for it, even in part of a fraction, where the tree has it otherwise."""
    return number is not None and number != one and len(factors) == 1 and factors[0].hold == SUM


def _fraction(above: Sequence[Piece], below: Sequence[Piece], notation: Notation) -> Piece:
    over = _joined(above, notation) if above else _whole(1, notation)
    return notation.fraction(over, _joined(below, notation)) if below else over


def _signed(piece: Piece, number: Fraction, notation: Notation) -> Piece:
    return Piece(notation.negative + piece.text, SUM) if number < 0 else piece


def _joined(pieces: Sequence[Piece], notation: Notation) -> Piece:
    if len(pieces) == 1:
        return pieces[0]
    return Piece(notation.product([_held(piece, POWER, notation) for piece in pieces]), PRODUCT)


def _power(tree: sympy.Pow, notation: Notation) -> Piece:
    if _is_negative_number(tree.exp):
        return _product([tree], notation)
    return _raised(tree.base, tree.exp, notation)


def _raised(base: Basic, exponent: Basic, notation: Notation) -> Piece:
    if exponent == 1:
        return write(base, notation)
    if isinstance(exponent, sympy.Rational) and exponent.p == 1 and _exact(exponent) not in notation.decimals:
        return Piece(
            notation.root(write(base, notation).text, int(exponent.q)), ATOM if exponent.q == 2 else POWER
        )
    foot = _held(write(base, notation), ATOM, notation)
    if base == sympy.Symbol("e"):
        foot = notation.brackets(foot)  # a bare e under an exponent would be Euler's number
    return Piece(notation.power(foot, write(exponent, notation)), POWER)


def _held(piece: Piece, hold: int, notation: Notation) -> str:
    return piece.text if piece.hold >= hold else notation.brackets(piece.text)


def _rank(factor: Basic) -> int:
    if isinstance(factor, sympy.Expr) and factor.is_number:
        return 0
    return 1 if factor.is_Symbol or (isinstance(factor, sympy.Pow) and factor.base.is_Symbol) else 2


def _ordered(tree: sympy.Add) -> list[Basic]:
    terms: list[Basic] = tree.as_ordered_terms()  # pyright: ignore[reportAssignmentType]  (a list unless data=True)
    return terms


def _is_negative_number(tree: Basic) -> bool:
    return isinstance(tree, sympy.Rational) and tree < 0


def _decimal(number: Fraction, wanted: bool) -> str | None:
    """The number as a terminating decimal (whole numbers too), None when it is better a fraction; wanted: a
    fraction would not be better, whatever it is."""
    if number.denominator == 1:
        return str(number.numerator)
    places = next((n for n in range(1, _DECIMAL_PLACES + 1) if 10**n % number.denominator == 0), None)
    if places is None or (number.denominator < _DECIMAL_FROM and not wanted):
        return None
    digits = str(int(number * 10**places)).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}"


def name_parts(name: str) -> tuple[str, str, str]:
    """(base, subscript, primes) of a canonical name."""
    bare = name.rstrip("'")
    base, _, below = bare.partition("_")
    return base, below, name[len(bare) :]


def _plain_symbol(name: str) -> str:
    base, below, primes = name_parts(name)
    mixed = below[:1].isdigit() and not below.isdigit()
    return f"{base}_{{{below}}}{primes}" if mixed else name


def _unit_text(units: Sequence[tuple[str, int]], gap: str, script: str, spelt: dict[str, str]) -> str:
    """kg m/s^2; s^-1 where nothing stands above. spelt: units that are written otherwise."""
    text = ""
    for name, power in units:
        under = power < 0 and text != "" and (units[0][1] > 0)
        size = -power if under else power
        name = name if name == "h" and under else spelt.get(name, name)
        text += ("/" if under else gap if text else "") + name + ("" if size == 1 else script.format(size))
    return text


def _plain_power(foot: str, exponent: Piece) -> str:
    return f"{foot}^{exponent.text if exponent.hold == ATOM else f'({exponent.text})'}"


def _plain_call(name: str, argument: str) -> str:
    return f"|{argument}|" if name == "abs" and "|" not in argument else f"{name}({argument})"


def _latex_symbol(name: str) -> str:
    base, below, primes = name_parts(name)
    written = f"\\{base}" if base in GREEK else base
    if not below:
        return written + primes
    below = f"\\{below}" if below in GREEK else below
    return f"{written}_{{{below}}}{primes}"


def _latex_product(factors: Sequence[str]) -> str:
    text = factors[0]
    for before, factor in pairwise(factors):
        name = _LATEX_NAME.fullmatch(before) is not None
        if factor[0].isdigit() or (before == "\\Sigma" and factor[0] != "("):
            gap = " \\cdot "
        elif _UNIT_LIKE.fullmatch(factor) and (before == "\\pi" or not name):
            gap = "" if before[-1].isdigit() else " \\cdot "  # 5 m would be five metres
        else:
            gap = " "
        text += gap + factor
    return text


def _latex_measured(number: str, units: str) -> str:
    return (
        f"{number}^{{\\circ}}"
        if units == "deg" and _DIGITS.fullmatch(number)
        else f"{number}\\,\\mathrm{{{units}}}"
    )


def _latex_call(name: str, argument: str) -> str:
    if name == "abs" and "|" not in argument:
        return f"\\left|{argument}\\right|"
    if name == "norm":
        return f"\\left\\|{argument}\\right\\|"
    if name == "sum":
        return f"\\sum {argument}" if _LATEX_NAME.fullmatch(argument) else f"\\sum\\left({argument}\\right)"
    return f"\\{_LATEX_FUNCTIONS.get(name, name)}\\left({argument}\\right)"


_LATEX_NAME = re.compile(r"(?:[A-Za-z]|\\[A-Za-z]+)(?:_\{[^{}]*\})?'*")
_UNIT_LIKE = re.compile(rf"[{''.join(sorted(UNIT_LETTERS))}](?:\^.*)?")
_DIGITS = re.compile(r"[0-9.]+")
_LATEX_FUNCTIONS = {"asin": "arcsin", "acos": "arccos", "atan": "arctan"}

_SPELT = {"g": "gram", "h": "hour", "W": "watt"}
"""In plain typing these letters are quantities."""

_PLAIN = Notation(
    number=str,
    symbol=_plain_symbol,
    product="*".join,
    units=lambda units: _unit_text(units, " ", "^{}", _SPELT),
    measured=lambda number, units: f"{number} {units}",
    fraction=lambda above, below: Piece(
        f"{_held(above, PRODUCT, _PLAIN)}/{_held(below, POWER, _PLAIN)}", PRODUCT
    ),
    power=_plain_power,
    root=lambda radicand, degree: f"sqrt({radicand})" if degree == 2 else f"({radicand})^(1/{degree})",
    call=_plain_call,
    brackets="({})".format,
    pi="pi",
)
_LATEX = Notation(
    number=str,
    symbol=_latex_symbol,
    product=_latex_product,
    units=lambda units: _unit_text(units, "\\,", "^{{{}}}", {}),
    measured=_latex_measured,
    fraction=lambda above, below: Piece(f"\\frac{{{above.text}}}{{{below.text}}}", PRODUCT),
    power=lambda foot, exponent: f"{foot}^{{{exponent.text}}}",
    root=lambda radicand, degree: f"\\sqrt{'' if degree == 2 else f'[{degree}]'}{{{radicand}}}",
    call=_latex_call,
    brackets="\\left({}\\right)".format,
    pi="\\pi",
)
