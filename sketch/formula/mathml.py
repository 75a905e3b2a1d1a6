"""Formulas in presentation MathML (W3C MathML Core), which browsers show without help."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from sympy.core.basic import Basic

from sketch.formula.lexer import decimals
from sketch.formula.names import LETTERS
from sketch.formula.print import PRODUCT, Notation, Piece, name_parts, write
from sketch.page import Expression

_GREEK: dict[str, str] = {}
for _letter, _name in LETTERS.items():
    _GREEK.setdefault(_name, _letter)

_TIMES = "<mo>&#x2062;</mo>"
"""Invisible times."""
_APPLY = "<mo>&#x2061;</mo>"
"""Function application."""
_ONE_NAME = re.compile(r"<mi>[^<]*</mi>|<msub>(?:(?!<msub>).)*</msub>")
_SUBSCRIPT = re.compile(r"[0-9]+|[A-Za-z]+")


def mathml(tree: Basic, pointed: frozenset[Fraction] = frozenset()) -> str:
    """The formula as a `math` element; pointed: the numbers that are written with a point (see `lexer.decimals`). Raises ValueError for what is not of the
    formula language."""
    inner = write(tree, replace(MATHML, decimals=pointed)).text
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML">{_row(inner)}</math>'


def shown(line: Expression) -> str | None:
    """A page's formula as a `math` element, its decimals as they were written; None for what is no formula."""
    if line.tree is None or line.text is None:
        return None
    return mathml(line.tree, decimals(line.text))


def _row(inner: str) -> str:
    return f"<mrow>{inner}</mrow>"


def _fenced(left: str, inner: str, right: str) -> str:
    return _row(f'<mo fence="true">{left}</mo>{_row(inner)}<mo fence="true">{right}</mo>')


def _brackets(inner: str) -> str:
    return _fenced("(", inner, ")")


def _letters(name: str) -> str:
    """One name: a letter slanted, several upright, as MathML does by itself."""
    return f"<mi>{_GREEK.get(name, name)}</mi>"


def _symbol(name: str) -> str:
    base, below, primes = name_parts(name)
    if below in _GREEK:
        under = _letters(below)
    else:
        under = _row(
            "".join(
                f"<mn>{run}</mn>" if run.isdigit() else f"<mi>{run}</mi>" for run in _SUBSCRIPT.findall(below)
            )
        )
    raised = f"<mo>{'′' * len(primes)}</mo>"
    if below and primes:
        return f"<msubsup>{_letters(base)}{under}{raised}</msubsup>"
    if below:
        return f"<msub>{_letters(base)}{under}</msub>"
    return f"<msup>{_letters(base)}{raised}</msup>" if primes else _letters(base)


def _product(factors: Sequence[str]) -> str:
    text = factors[0]
    for factor in factors[1:]:
        text += ("<mo>·</mo>" if factor.startswith("<mn>") else _TIMES) + factor
    return text


def _units(units: Sequence[tuple[str, int]]) -> str:
    text = ""
    for name, power in units:
        under = power < 0 and units[0][1] > 0
        size = -power if under else power
        written = "<mo>°</mo>" if name == "deg" else f'<mi mathvariant="normal">{name}</mi>'
        if size != 1:
            exponent = f"<mn>{size}</mn>" if size > 0 else f"{_row(f'<mo>−</mo><mn>{-size}</mn>')}"
            written = f"<msup>{written}{exponent}</msup>"
        text += ("<mo>/</mo>" if under else '<mspace width="0.17em"/>' if text else "") + written
    return text


def _measured(number: str, units: str) -> str:
    gap = "" if units.startswith("<mo>°") else '<mspace width="0.17em"/>'
    return _row(f"{number}{gap}{units}")


def _fraction(above: Piece, below: Piece) -> Piece:
    return Piece(f"<mfrac>{_row(above.text)}{_row(below.text)}</mfrac>", PRODUCT)


def _power(foot: str, exponent: Piece) -> str:
    return f"<msup>{_row(foot)}{_row(exponent.text)}</msup>"


def _root(radicand: str, degree: int) -> str:
    return (
        f"<msqrt>{_row(radicand)}</msqrt>"
        if degree == 2
        else f"<mroot>{_row(radicand)}<mn>{degree}</mn></mroot>"
    )


def _call(name: str, argument: str) -> str:
    match name:
        case "abs":
            return _fenced("|", argument, "|")
        case "norm":
            return _fenced("‖", argument, "‖")
        case "sum":
            return _row(f"<mo>∑</mo>{argument if _ONE_NAME.fullmatch(argument) else _brackets(argument)}")
        case _:
            return _row(f"<mi>{name}</mi>{_APPLY}{_brackets(argument)}")


MATHML = Notation(
    number=lambda digits: f"<mn>{digits}</mn>",
    symbol=_symbol,
    product=_product,
    units=_units,
    measured=_measured,
    fraction=_fraction,
    power=_power,
    root=_root,
    call=_call,
    brackets=_brackets,
    pi="<mi>π</mi>",
    minus="<mo>−</mo>",
    plus="<mo>+</mo>",
    equals="<mo>=</mo>",
    comma="<mo>,</mo>",
    negative='<mo form="prefix">−</mo>',
)
