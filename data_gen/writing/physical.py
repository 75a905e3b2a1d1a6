"""A grammar of physics pages: what people write beside diagrams."""

from __future__ import annotations

from functools import cache

import numpy as np

from data_gen.writing.author import RULE, Author
from data_gen.writing.general import number, product, total
from sketch.writing.rows import Node, Row, row_of
from sketch.writing.signs import FRACTION, ROOT

_QUANTITIES = ["v", "a", "m", "g", "F", "T", "N", "W", "f", "x", "y", "t", "k", "l", "L", "r", "R", "h", "E", "P", "I", "M",
               "p", "s", "d", "u", "A", "V", "U", "K", "\\theta", "\\theta", "\\alpha", "\\omega", "\\mu", "\\mu", "\\rho",
               "\\phi", "\\tau", "\\lambda", "\\beta", "\\pi", "\\Delta", "\\sigma", "\\eta", "\\epsilon", "\\delta", "\\gamma",
               "\\Omega"]  # fmt: skip
_MARKS = ["0", "1", "2", "3", "x", "y", "A", "B", "C", "i", "f", "k", "s", "n", "t", "c"]


def _quantity(author: Author) -> Row:
    name = author.letter()
    if name == "\\Delta":
        return (Node(name), Node(author.pick("xtvyEp")))
    sub: Row = (Node(author.pick(_MARKS)),) if author.chance(0.4) else ()
    if sub and author.chance(0.12):
        sub = (*sub, Node(author.pick("xyAB12")))
    whole: Row = (Node(name, sub=sub),)
    style = author.rng.random()
    if style < 0.03:
        return (Node(name, sub=sub, sup=(Node("'"),)),)
    if style < 0.08:
        return (Node("\\Vert"), *whole, Node("\\Vert"))
    if style < 0.12:
        return (Node("|"), *whole, Node("|"))
    if style < 0.15:
        return (Node(name, sub=sub, accent=Node("\\vec")),)
    return whole


def _value(author: Author) -> Row:
    """A number with or without a unit, an angle in degrees or in parts of π."""
    style = author.rng.random()
    sign: Row = (Node("-"),) if author.chance(0.1) else ()
    if style < 0.15:
        return (*number(author)[:2], Node("\\circ")) if author.chance(0.0) else _degrees(author)
    if style < 0.27:
        over: Row = (Node("\\pi"),)
        if author.chance(0.3):
            over = (Node(author.pick("235")), *over)
        return (Node(FRACTION, over=over, under=(Node(author.pick("23468")),)),)
    if style < 0.35:
        return (*sign, Node(author.pick("123456789")), Node(ROOT, inside=(Node(author.pick("2357")),)))
    digits = _decimal(author)
    if style < 0.55:
        unit = author.pick(["m", "s", "kg", "N", "cm", "J", "m/s", "N/m", "km/h"])
        digits = (*digits, *(Node(letter) for letter in unit))
        if unit == "m/s" and author.chance(0.3):
            digits = (*digits[:-1], Node("s", sup=(Node("2"),)))
    return (*sign, *digits)


def _degrees(author: Author) -> Row:
    digits = str(5 * int(author.rng.integers(1, 36)))
    return (*(Node(digit) for digit in digits[:-1]), Node(digits[-1], sup=(Node("\\circ"),)))


def _decimal(author: Author) -> Row:
    style = author.rng.random()
    if style < 0.4:
        text = str(int(author.rng.integers(0, 100)))
    elif style < 0.8:
        text = f"{author.rng.uniform(0, 12):.{int(author.rng.integers(1, 5))}f}"
    else:
        text = f"{author.rng.uniform(10, 200):.1f}"
    return tuple(Node(sign) for sign in text)


def _vector(author: Author) -> Row:
    left, right = ("(", ")") if author.chance(0.8) else ("[", "]")

    def part() -> Row:
        sign: Row = (Node("-"),) if author.chance(0.2) else ()
        if author.chance(0.6):
            return (*sign, *_decimal(author))
        return (*sign, *product(author, RULE.deepest))

    return (Node(left), *part(), Node(","), *part(), Node(right))


_TEMPLATES = (
    r"# = - \mu #", r"# = m g", r"# = m g \sin \theta", r"# = m g \cos \theta", r"# = \mu N", r"# = \mu # \cos \theta",
    r"# = # + a t", r"# ^ 2 = # ^ 2 + 2 a #", r"# = # t + \frac { 1 } { 2 } a t ^ 2", r"# = \frac { 1 } { 2 } # # ^ 2",
    r"# = 2 \pi \sqrt { \frac { # } { # } }", r"# = # - k #", r"# = - k #", r"# = - k ( # - # )", r"\frac { 1 } { 2 } # # ^ 2 = # g #",
    r"# = \frac { # # } { # + # }", r"# = \frac { # - # } { # + # } g", r"# = \sqrt { 2 g # }", r"# = # \cos \theta", r"# = # \sin ( \omega t )",
    r"# = A \cos ( \omega t + \phi )", r"# = \| # \| \cos \theta", r"# = \| # \| \sin \theta", r"F = m a", r"# = \frac { # ^ 2 } { # }",
    r"# = ( # , # )", r"\theta = \frac { \pi } { @ }", r"# = G \frac { # # } { # ^ 2 }", r"# = \frac { # } { # }", r"# + # = #", r"# = # \omega ^ 2",
    r"# = # e ^ { - # t }", r"# = | # - # |", r"# = # ( @ + # )", r"# = \frac { @ } { @ } # # ^ 2", r"# = \sqrt { # ^ 2 + # ^ 2 }", r"# = @ \sqrt { @ }",
    r"\sin # = \frac { # } { # }", r"\Sigma = 0", r"# = # \tan \theta", r"# - # = # #", r"# # = # #", r"# = # # \cos ( # )", r"# = \frac { # \sin \theta } { # }",
    r"# = # / #", r"\mu = \tan #", r"# = 1 / # + 1 / #", r"# \leq \mu #", r"# > 0", r"# = # \cdot #", r"# = @ # t", r"# = # \times #",
)  # fmt: skip


@cache
def _template(text: str) -> Row:
    return row_of(text)


def _templated(author: Author) -> Row:
    row = _template(_TEMPLATES[int(author.rng.integers(len(_TEMPLATES)))])
    return _filled(row, author)


def _filled(row: Row, author: Author) -> Row:
    """The row with a quantity for each # and a number for each @."""
    found: list[Node] = []
    for node in row:
        sub, sup = _filled(node.sub, author), _filled(node.sup, author)
        if node.name == "#":
            *before, last = _quantity(author)
            joined = (*last.sup, *sup) if sup else last.sup
            found += [*before, Node(last.name, sub=last.sub or sub, sup=joined, accent=last.accent)]
        elif node.name == "@":
            found += list(_decimal(author))
        elif node.name == "\\Sigma":
            found += [Node("F"), Node("+"), Node("T")]
        else:
            over, under, inside = (_filled(part, author) for part in (node.over, node.under, node.inside))
            found.append(Node(node.name, (), sub, sup, over, under, inside, node.accent))
    return tuple(found)


def physics(rng: np.random.Generator) -> Row:
    """A line as it stands on a physics page."""
    pool = tuple(str(name) for name in rng.choice(_QUANTITIES, size=5))
    author = Author(rng, pool)
    style = rng.random()
    if style < 0.5:
        return _templated(author)
    left = _quantity(author)
    if style < 0.68:
        return (*left, Node("="), *_value(author))
    if style < 0.74:
        return (*left, Node("="), *_vector(author))
    right = total(author, 1)
    return (*left, Node("="), *right)
