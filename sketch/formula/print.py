"""SymPy trees written as text: `plain` as a person types, `latex` as a person typesets.

Both are inverse to `parse`: parse(plain(tree)) == tree and parse(latex(tree)) == tree for every
tree that the formula language has. One walk serves both; a `Notation` holds what differs.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

import sympy
from sympy.core.basic import Basic

from sketch.formula.names import FUNCTIONS, GREEK

_SUM, _PRODUCT, _POWER, _ATOM = range(4)
"""How tightly a piece of text holds together; looser pieces are bracketed."""

_NAMES: dict[str, str] = {function.__name__: name for name, function in FUNCTIONS.items() if name != "norm"}
_DECIMAL_FROM = 10
"""Fractions of this denominator and above that end as decimals are written so: 981/100 as 9.81, but 1/8."""
_DECIMAL_PLACES = 12
"""Fractions that need more places are written as fractions."""


@dataclass(frozen=True, slots=True)
class _Piece:
    text: str
    hold: int


@dataclass(frozen=True, slots=True)
class Notation:
    """symbol: canonical name → text; product: factors → text; fraction, root and call put their parts
    into a template; sum and brackets are the same in both."""

    symbol: Callable[[str], str]
    product: Callable[[Sequence[str]], str]
    fraction: Callable[[_Piece, _Piece], _Piece]
    power: Callable[[str, _Piece], str]
    root: Callable[[str, int], str]
    call: Callable[[str, str], str]
    brackets: str
    pi: str


def plain(tree: Basic) -> str:
    """The formula in ASCII as typed on a keyboard: `f_1 = |W|*cos(theta)`."""
    return _write(tree, _PLAIN).text


def latex(tree: Basic) -> str:
    """The formula in LaTeX: `f_{1} = \\left|W\\right| \\cos\\left(\\theta\\right)`."""
    return _write(tree, _LATEX).text


def _write(tree: Basic, notation: Notation) -> _Piece:
    match tree:
        case sympy.Equality():
            left, right = (_write(side, notation).text for side in tree.args)
            return _Piece(f"{left} = {right}", _SUM)
        case sympy.Tuple():
            components = ", ".join(_write(component, notation).text for component in tree.args)
            return _Piece(notation.brackets.format(components), _ATOM)
        case sympy.Symbol():
            return _Piece(notation.symbol(tree.name), _ATOM)
        case sympy.Rational():
            return _number(Fraction(int(tree.p), int(tree.q)), notation)
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
            return _Piece(notation.call(name, _write(tree.args[0], notation).text), _ATOM)
        case _ if tree is sympy.pi:
            return _Piece(notation.pi, _ATOM)
        case _ if tree is sympy.E:
            return _Piece(notation.call("exp", "1"), _ATOM)
        case _:
            raise ValueError(f"{tree} ({type(tree).__name__}) is not part of the formula language")


def _number(number: Fraction, notation: Notation) -> _Piece:
    decimal = _decimal(abs(number))
    if decimal is not None:
        return _signed(_Piece(decimal, _ATOM), number)
    over, under = (_Piece(str(abs(part)), _ATOM) for part in number.as_integer_ratio())
    return _signed(notation.fraction(over, under), number)


def _sum(tree: sympy.Add, notation: Notation) -> _Piece:
    """Terms in SymPy's order, but a positive one first where there is one: 3t − gt²/2."""
    terms = [_write(term, notation).text for term in _ordered(tree)]
    first = next((term for term in terms if not term.startswith("-")), terms[0])
    terms.remove(first)
    rest = (f" - {term[1:]}" if term.startswith("-") else f" + {term}" for term in terms)
    return _Piece(first + "".join(rest), _SUM)


def _product(factors: Sequence[Basic], notation: Notation) -> _Piece:
    """Numbers, then names, then the rest, over the factors whose exponent is a negative number."""
    coefficient = Fraction(1)
    above: list[_Piece] = []
    below: list[_Piece] = []
    for factor in sorted(factors, key=_rank):
        if isinstance(factor, sympy.Rational):
            coefficient *= Fraction(int(factor.p), int(factor.q))
        elif isinstance(factor, sympy.Pow) and _is_negative_number(factor.exp):
            below.append(_raised(factor.base, -factor.exp, notation))
        else:
            above.append(_write(factor, notation))
    size = _number(abs(coefficient), notation)
    if coefficient.denominator == 1 or size.hold == _ATOM:
        over, under = size, None
    else:
        over, under = (_Piece(str(abs(part)), _ATOM) for part in coefficient.as_integer_ratio())
    if _spreads(over, above) or _spreads(under, below):
        piece = notation.product([size.text, _fraction(above, below, notation).text])
        return _signed(_Piece(piece, _PRODUCT), coefficient)
    if over.text != "1":
        above.insert(0, over)
    if under is not None:
        below.insert(0, under)
    return _signed(_fraction(above, below, notation), coefficient)


def _spreads(number: _Piece | None, factors: Sequence[_Piece]) -> bool:
    """Whether SymPy would multiply the number into the one sum that stands beside it: 2·(a + b) is
    2·a + 2·b for it, even in part of a fraction, where the tree has it otherwise."""
    return number is not None and number.text != "1" and len(factors) == 1 and factors[0].hold == _SUM


def _fraction(above: Sequence[_Piece], below: Sequence[_Piece], notation: Notation) -> _Piece:
    over = _joined(above, notation) if above else _Piece("1", _ATOM)
    return notation.fraction(over, _joined(below, notation)) if below else over


def _signed(piece: _Piece, number: Fraction) -> _Piece:
    return _Piece(f"-{piece.text}", _SUM) if number < 0 else piece


def _joined(pieces: Sequence[_Piece], notation: Notation) -> _Piece:
    if len(pieces) == 1:
        return pieces[0]
    return _Piece(notation.product([_held(piece, _POWER, notation) for piece in pieces]), _PRODUCT)


def _power(tree: sympy.Pow, notation: Notation) -> _Piece:
    if _is_negative_number(tree.exp):
        return _product([tree], notation)
    return _raised(tree.base, tree.exp, notation)


def _raised(base: Basic, exponent: Basic, notation: Notation) -> _Piece:
    if exponent == 1:
        return _write(base, notation)
    if isinstance(exponent, sympy.Rational) and exponent.p == 1:
        return _Piece(
            notation.root(_write(base, notation).text, int(exponent.q)), _ATOM if exponent.q == 2 else _POWER
        )
    foot = _held(_write(base, notation), _ATOM, notation)
    if base == sympy.Symbol("e"):
        foot = notation.brackets.format(foot)  # a bare e under an exponent would be Euler's number
    return _Piece(notation.power(foot, _write(exponent, notation)), _POWER)


def _held(piece: _Piece, hold: int, notation: Notation) -> str:
    return piece.text if piece.hold >= hold else notation.brackets.format(piece.text)


def _rank(factor: Basic) -> int:
    if isinstance(factor, sympy.Expr) and factor.is_number:
        return 0
    return 1 if factor.is_Symbol or (isinstance(factor, sympy.Pow) and factor.base.is_Symbol) else 2


def _ordered(tree: sympy.Add) -> list[Basic]:
    terms: list[Basic] = tree.as_ordered_terms()  # pyright: ignore[reportAssignmentType]  (a list unless data=True)
    return terms


def _is_negative_number(tree: Basic) -> bool:
    return isinstance(tree, sympy.Rational) and tree < 0


def _decimal(number: Fraction) -> str | None:
    """The number as a terminating decimal (whole numbers too), None when it is better a fraction."""
    if number.denominator == 1:
        return str(number.numerator)
    places = next((n for n in range(1, _DECIMAL_PLACES + 1) if 10**n % number.denominator == 0), None)
    if places is None or number.denominator < _DECIMAL_FROM:
        return None
    digits = str(int(number * 10**places)).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}"


def _plain_symbol(name: str) -> str:
    base, _, below = name.partition("_")
    mixed = below[:1].isdigit() and not below.isdigit()
    return f"{base}_{{{below}}}" if mixed else name


def _plain_power(foot: str, exponent: _Piece) -> str:
    return f"{foot}^{exponent.text if exponent.hold == _ATOM else f'({exponent.text})'}"


def _plain_call(name: str, argument: str) -> str:
    return f"|{argument}|" if name == "abs" and "|" not in argument else f"{name}({argument})"


def _latex_symbol(name: str) -> str:
    base, _, below = name.partition("_")
    written = f"\\{base}" if base in GREEK else base
    if not below:
        return written
    below = f"\\{below}" if below in GREEK else below
    return f"{written}_{{{below}}}"


def _latex_product(factors: Sequence[str]) -> str:
    text = factors[0]
    for factor in factors[1:]:
        text += f" \\cdot {factor}" if factor[0].isdigit() else f" {factor}"
    return text


def _latex_call(name: str, argument: str) -> str:
    if name == "abs" and "|" not in argument:
        return f"\\left|{argument}\\right|"
    if name == "norm":
        return f"\\left\\|{argument}\\right\\|"
    return f"\\{_LATEX_FUNCTIONS.get(name, name)}\\left({argument}\\right)"


_LATEX_FUNCTIONS = {"asin": "arcsin", "acos": "arccos", "atan": "arctan"}

_PLAIN = Notation(
    symbol=_plain_symbol,
    product="*".join,
    fraction=lambda above, below: _Piece(
        f"{_held(above, _PRODUCT, _PLAIN)}/{_held(below, _POWER, _PLAIN)}", _PRODUCT
    ),
    power=_plain_power,
    root=lambda radicand, degree: f"sqrt({radicand})" if degree == 2 else f"({radicand})^(1/{degree})",
    call=_plain_call,
    brackets="({})",
    pi="pi",
)
_LATEX = Notation(
    symbol=_latex_symbol,
    product=_latex_product,
    fraction=lambda above, below: _Piece(f"\\frac{{{above.text}}}{{{below.text}}}", _PRODUCT),
    power=lambda foot, exponent: f"{foot}^{{{exponent.text}}}",
    root=lambda radicand, degree: f"\\sqrt{'' if degree == 2 else f'[{degree}]'}{{{radicand}}}",
    call=_latex_call,
    brackets="\\left({}\\right)",
    pi="\\pi",
)
