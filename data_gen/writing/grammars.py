"""Expressions drawn at random: a grammar of mathematics at large, and one of physics pages.

A reader taught by the first does not merely guess physics; the second holds what people write beside
diagrams. Each expression draws its letters from a small pool of its own, as people do, who repeat
the names that they introduced. Nothing here is taken from a collection of people's expressions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from sketch.writing.rows import Node, Row, nodes_of, row_of
from sketch.writing.signs import ACCENTS, FRACTION, FUNCTIONS, LETTERS, PRIME, ROOT, SIGNS


@dataclass(frozen=True, slots=True)
class GrammarRule:
    """How often what is written. Shares of one unless told otherwise."""

    deepest: int = 3
    """Fractions, roots, brackets and functions within one another."""
    terms: tuple[float, ...] = (0.5, 0.32, 0.12, 0.06)
    """A sum of one, two, three, four terms."""
    factors: tuple[float, ...] = (0.62, 0.28, 0.1)
    """A product of one, two, three factors."""
    longest: int = 40
    """Signs of the longest expression of a mixture."""
    physics: float = 0.35
    """Share of physics in a mixture of both grammars."""


RULE = GrammarRule()
_COMMON = list("xyabnzcdtkpruvmfieqsghwjlo") + list("APTVRESLMNCXGHBFIDJKQUWYZO")
_WEIGHTS = 1.0 / (4.0 + np.arange(len(_COMMON)))
_GREEK = ["\\alpha", "\\beta", "\\theta", "\\pi", "\\mu", "\\gamma", "\\phi", "\\lambda", "\\sigma", "\\Delta", "\\omega",
          "\\rho", "\\delta", "\\epsilon", "\\tau", "\\eta", "\\Omega"]  # fmt: skip
_WORDS = (
    "max",
    "min",
    "tot",
    "in",
    "out",
    "ext",
    "eff",
    "sat",
    "av",
    "ij",
    "nm",
    "kl",
    "AB",
    "xy",
    "CM",
    "net",
    "rel",
)


@dataclass(frozen=True, slots=True)
class _Author:
    """Somebody who writes one expression: the chance of the moment and the letters in use."""

    rng: np.random.Generator
    pool: tuple[str, ...]

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def pick(self, among: Sequence[str], weights: Sequence[float] | None = None) -> str:
        if weights is None:
            return among[int(self.rng.integers(len(among)))]
        return among[int(np.searchsorted(np.cumsum(weights) / np.sum(weights), self.rng.random()))]

    def count(self, shares: Sequence[float]) -> int:
        return 1 + int(np.searchsorted(np.cumsum(shares), self.rng.random() * sum(shares)))

    def letter(self) -> str:
        return self.pick(self.pool)


def general(rng: np.random.Generator) -> Row:
    """An expression of mathematics at large: some 1 to 40 signs."""
    count = int(rng.integers(1, 6))
    shares = _WEIGHTS / _WEIGHTS.sum()
    pool = [str(name) for name in rng.choice(_COMMON, size=count, p=shares)]
    if rng.random() < 0.3:
        pool.append(_GREEK[min(int(rng.exponential(4.0)), len(_GREEK) - 1)])
    if rng.random() < 0.25:  # one letter in both cases
        other = pool[0].swapcase() if len(pool[0]) == 1 else pool[0]
        pool.append(other)
    author = _Author(rng, tuple(pool))
    style = rng.random()
    if style < 0.1:
        return _arithmetic(author)
    if style < 0.4:
        return _sum(author, 0)
    row = (*_side(author), *_relation(author), *_sum(author, 0))
    if rng.random() < 0.08:
        row = (*row, *_relation(author), *_sum(author, 1))
    return row


def physics(rng: np.random.Generator) -> Row:
    """A line as it stands on a physics page."""
    pool = tuple(str(name) for name in rng.choice(_QUANTITIES, size=5))
    author = _Author(rng, pool)
    style = rng.random()
    if style < 0.5:
        return _templated(author)
    left = _quantity(author)
    if style < 0.68:
        return (*left, Node("="), *_value(author))
    if style < 0.74:
        return (*left, Node("="), *_vector(author))
    right = _sum(author, 1)
    return (*left, Node("="), *right)


def mixed(rng: np.random.Generator) -> Row:
    """One of the two grammars by chance, of some length at most: most lines are short, few are long."""
    most = RULE.longest * rng.random() ** 0.5
    while True:
        row = physics(rng) if rng.random() < RULE.physics else general(rng)
        if sum(1 for _ in nodes_of(row)) <= max(most, 4):
            return row


def _side(author: _Author) -> Row:
    if author.chance(0.55):
        name = author.letter()
        if author.chance(0.25):
            return (*_scripted(author, name), Node("("), *_arguments(author), Node(")"))
        return _scripted(author, name)
    return _sum(author, 1)


def _relation(author: _Author) -> Row:
    return (Node(author.pick(["=", "<", ">", "\\leq", "\\geq"], [0.86, 0.04, 0.04, 0.03, 0.03])),)


def _sum(author: _Author, depth: int) -> Row:
    row: Row = (Node("-"),) if author.chance(0.08) else ()
    count = author.count(RULE.terms if depth < 2 else RULE.terms[:2])
    for k in range(count):
        if k:
            row = (*row, Node(author.pick("+-", [0.55, 0.45])))
        row = (*row, *_product(author, depth))
    return row


def _product(author: _Author, depth: int) -> Row:
    row: Row = ()
    count = author.count(RULE.factors)
    for k in range(count):
        factor = _factor(author, depth, first=k == 0)
        if row and (row[-1].name.isdigit() and factor[0].name.isdigit()):
            row = (*row, Node(author.pick(["\\times", "\\cdot"])))
        elif k and author.chance(0.08):
            row = (*row, Node(author.pick(["\\times", "\\cdot", "."], [0.6, 0.3, 0.1])))
        row = (*row, *factor)
    if author.chance(0.04):
        row = (*row, Node("/"), *_factor(author, RULE.deepest, first=False))
    return row


def _factor(author: _Author, depth: int, first: bool) -> Row:
    forms: list[tuple[float, Callable[[], Row]]] = [
        (0.5, lambda: _scripted(author, author.letter())),
        (0.24 if first else 0.06, lambda: _number(author)),
    ]
    if depth < RULE.deepest:
        deeper = depth + 1
        forms += [
            (0.09, lambda: (Node(FRACTION, over=_sum(author, deeper), under=_sum(author, deeper)),)),
            (0.05, lambda: (Node(ROOT, inside=_sum(author, deeper)),)),
            (0.07, lambda: _bracketed(author, deeper)),
            (0.07, lambda: _function(author, deeper)),
            (0.04, lambda: (Node(author.letter()), Node("("), *_arguments(author), Node(")"))),
            (0.03, lambda: _bars(author, deeper)),
            (0.01, lambda: (Node(author.letter(), accent=Node(author.pick(["\\vec", "\\hat"]))),)),
        ]
    shares = np.array([share for share, _ in forms])
    return forms[int(np.searchsorted(np.cumsum(shares) / shares.sum(), author.rng.random()))][1]()


def _number(author: _Author) -> Row:
    if author.chance(0.6):
        return (Node(author.pick("0123456789", [0.6, 2.2, 2.2, 1.6, 1.3, 1, 0.9, 0.8, 0.8, 0.8])),)
    length = 1 + author.count([0.6, 0.25, 0.15])
    digits = [Node(author.pick("0123456789")) for _ in range(length)]
    if digits[0].name == "0":
        digits[0] = Node("1")
    if author.chance(0.25):
        digits.insert(int(author.rng.integers(1, length)), Node("."))
    return tuple(digits)


def _arithmetic(author: _Author) -> Row:
    row = _number(author)
    for _ in range(author.count([0.5, 0.3, 0.2])):
        sign = author.pick(["+", "-", "\\times", "/", "=", "\\cdot"], [3, 2, 2, 1, 2, 0.5])
        row = (*row, Node(sign), *_number(author))
    return row


def _scripted(author: _Author, name: str) -> Row:
    """A letter, perhaps with scripts or a prime."""
    sub: Row = ()
    sup: Row = ()
    if author.chance(0.26):
        sub = _subscript(author)
    if author.chance(0.24):
        sup = _superscript(author)
    elif author.chance(0.02):
        sup = (Node("'"),)
    return (Node(name, sub=sub, sup=sup),)


def _subscript(author: _Author) -> Row:
    style = author.rng.random()
    if style < 0.42:
        return (Node(author.pick("0123456789", [3, 4, 3, 2, 1, 0.6, 0.5, 0.4, 0.4, 0.3])),)
    if style < 0.78:
        return (Node(author.pick("nkijxyztmpabABCNrsfev")),)
    if style < 0.86:
        return (Node(author.pick("nkijt")), Node(author.pick("+-")), Node(author.pick("12")))
    if style < 0.93:
        return tuple(Node(letter) for letter in author.pick(_WORDS))
    if style < 0.97:
        return tuple(Node(digit) for digit in str(int(author.rng.integers(10, 100))))
    return (Node(author.pick("ijkxyAB")), Node(","), Node(author.pick("ijkxyAB")))


def _superscript(author: _Author) -> Row:
    style = author.rng.random()
    if style < 0.58:
        return (Node(author.pick("23456", [6, 2, 0.8, 0.5, 0.4])),)
    if style < 0.74:
        return (Node(author.pick("nkmpxtabcis")),)
    if style < 0.82:
        return (Node("-"), Node(author.pick("12nx")))
    if style < 0.9:
        return (Node(author.pick("nkmp2")), Node(author.pick("+-")), Node(author.pick("12kpn")))
    if style < 0.94:
        return tuple(Node(digit) for digit in str(int(author.rng.integers(10, 100))))
    if style < 0.96:
        return (Node(FRACTION, over=(Node(author.pick("123np")),), under=(Node(author.pick("2345n")),)),)
    if style < 0.98:
        return (Node("("), Node(author.pick("nki012")), Node(")"))
    return (Node(author.pick("i2")), Node(author.letter()))


def _bracketed(author: _Author, depth: int) -> Row:
    left, right = ("(", ")") if author.chance(0.85) else ("[", "]")
    sup = _superscript(author) if author.chance(0.25) else ()
    return (Node(left), *_sum(author, depth), Node(right, sup=sup))


def _bars(author: _Author, depth: int) -> Row:
    bar = "|" if author.chance(0.75) else "\\Vert"
    inner = _scripted(author, author.letter()) if author.chance(0.7) else _sum(author, depth)
    return (Node(bar), *inner, Node(bar))


def _function(author: _Author, depth: int) -> Row:
    name = author.pick(FUNCTIONS, [4, 4, 2, 2, 1, 1])
    sup: Row = (Node(author.pick("23")),) if author.chance(0.12) else ()
    style = author.rng.random()
    if style < 0.5 and name != "\\exp":
        argument = _scripted(author, author.letter())
        if author.chance(0.25):
            argument = (*_number(author), *argument)
    elif style < 0.6 and name != "\\exp":
        argument = (Node(FRACTION, over=_product(author, depth), under=_product(author, depth)),)
    else:
        argument = (Node("("), *_sum(author, depth), Node(")"))
    return (Node(name, sup=sup), *argument)


def _arguments(author: _Author) -> Row:
    row = _scripted(author, author.letter()) if author.chance(0.75) else _sum(author, 2)
    while author.chance(0.25):
        row = (*row, Node(","), *_scripted(author, author.letter()))
    return row


_QUANTITIES = ["v", "a", "m", "g", "F", "T", "N", "W", "f", "x", "y", "t", "k", "l", "L", "r", "R", "h", "E", "P", "I", "M",
               "p", "s", "d", "u", "A", "V", "U", "K", "\\theta", "\\theta", "\\alpha", "\\omega", "\\mu", "\\mu", "\\rho",
               "\\phi", "\\tau", "\\lambda", "\\beta", "\\pi", "\\Delta", "\\sigma", "\\eta", "\\epsilon", "\\delta", "\\gamma",
               "\\Omega"]  # fmt: skip
_MARKS = ["0", "1", "2", "3", "x", "y", "A", "B", "C", "i", "f", "k", "s", "n", "t", "c"]


def _quantity(author: _Author) -> Row:
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


def _value(author: _Author) -> Row:
    """A number with or without a unit, an angle in degrees or in parts of π."""
    style = author.rng.random()
    sign: Row = (Node("-"),) if author.chance(0.1) else ()
    if style < 0.15:
        return (*_number(author)[:2], Node("\\circ")) if author.chance(0.0) else _degrees(author)
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


def _degrees(author: _Author) -> Row:
    digits = str(5 * int(author.rng.integers(1, 36)))
    return (*(Node(digit) for digit in digits[:-1]), Node(digits[-1], sup=(Node("\\circ"),)))


def _decimal(author: _Author) -> Row:
    style = author.rng.random()
    if style < 0.4:
        text = str(int(author.rng.integers(0, 100)))
    elif style < 0.8:
        text = f"{author.rng.uniform(0, 12):.{int(author.rng.integers(1, 3))}f}"
    else:
        text = f"{author.rng.uniform(10, 200):.1f}"
    return tuple(Node(sign) for sign in text)


def _vector(author: _Author) -> Row:
    left, right = ("(", ")") if author.chance(0.8) else ("[", "]")

    def part() -> Row:
        sign: Row = (Node("-"),) if author.chance(0.2) else ()
        if author.chance(0.6):
            return (*sign, *_decimal(author))
        return (*sign, *_product(author, RULE.deepest))

    return (Node(left), *part(), Node(","), *part(), Node(right))


_TEMPLATES = (
    r"# = - \mu #", r"# = m g", r"# = m g \sin \theta", r"# = m g \cos \theta", r"# = \mu N", r"# = \mu # \cos \theta",
    r"# = # + a t", r"# ^ 2 = # ^ 2 + 2 a #", r"# = # t + \frac { 1 } { 2 } a t ^ 2", r"# = \frac { 1 } { 2 } # # ^ 2",
    r"# = 2 \pi \sqrt { \frac { # } { # } }", r"# = # - k #", r"# = - k #", r"# = - k ( # - # )", r"\frac { 1 } { 2 } # # ^ 2 = # g #",
    r"# = \frac { # # } { # + # }", r"# = \frac { # - # } { # + # } g", r"# = \sqrt { 2 g # }", r"# = # \cos \theta", r"# = # \sin ( \omega t )",
    r"# = A \cos ( \omega t + \phi )", r"# = \| # \| \cos \theta", r"# = \| # \| \sin \theta", r"F = m a", r"# = \frac { # ^ 2 } { # }",
    r"# = ( # , # )", r"\theta = \frac { \pi } { $ }", r"# = G \frac { # # } { # ^ 2 }", r"# = \frac { # } { # }", r"# + # = #", r"# = # \omega ^ 2",
    r"# = # e ^ { - # t }", r"# = | # - # |", r"# = # ( $ + # )", r"# = \frac { $ } { $ } # # ^ 2", r"# = \sqrt { # ^ 2 + # ^ 2 }", r"# = $ \sqrt { $ }",
    r"\sin # = \frac { # } { # }", r"\Sigma = 0", r"# = # \tan \theta", r"# - # = # #", r"# # = # #", r"# = # # \cos ( # )", r"# = \frac { # \sin \theta } { # }",
    r"# = # / #", r"\mu = \tan #", r"# = 1 / # + 1 / #", r"# \leq \mu #", r"# > 0", r"# = # \cdot #", r"# = $ # t", r"# = # \times #",
)  # fmt: skip


@cache
def _template(text: str) -> Row:
    return row_of(text)


def _templated(author: _Author) -> Row:
    row = _template(_TEMPLATES[int(author.rng.integers(len(_TEMPLATES)))])
    return _filled(row, author)


def _filled(row: Row, author: _Author) -> Row:
    """The row with a quantity for each # and a number for each $."""
    found: list[Node] = []
    for node in row:
        sub, sup = _filled(node.sub, author), _filled(node.sup, author)
        if node.name == "#":
            *before, last = _quantity(author)
            joined = (*last.sup, *sup) if sup else last.sup
            found += [*before, Node(last.name, sub=last.sub or sub, sup=joined, accent=last.accent)]
        elif node.name == "$":
            found += list(_decimal(author))
        elif node.name == "\\Sigma":
            found += [Node("F"), Node("+"), Node("T")]
        else:
            over, under, inside = (_filled(part, author) for part in (node.over, node.under, node.inside))
            found.append(Node(node.name, (), sub, sup, over, under, inside, node.accent))
    return tuple(found)


def aslant(rng: np.random.Generator) -> Row:
    """Letters and numbers with many scripts, of one sign or several: what tells scripts from neighbours."""
    author = _Author(rng, tuple(str(name) for name in rng.choice([*_COMMON, *_GREEK], size=6)))

    def script(above: bool) -> Row:
        signs = [*author.pool, *"0123456789", "+", "-", "(", ")", ","]
        if above and author.chance(0.05):
            return (Node(PRIME),)
        length = author.count([0.6, 0.2, 0.14, 0.06])
        row = tuple(Node(author.pick(signs)) for _ in range(length))
        if author.chance(0.08):
            row = (*row[:-1], Node(row[-1].name, sub=(Node(author.pick(signs)),)))
        return row

    row: Row = ()
    for _ in range(int(rng.integers(1, 8))):
        name = (
            author.letter()
            if author.chance(0.75)
            else author.pick([*"0123456789", ")", "=", "+", "-", "/", ",", "("])
        )
        style = rng.random()
        sub = script(False) if style < 0.28 or style > 0.92 else ()
        sup = script(True) if 0.28 <= style < 0.5 or style > 0.92 else ()
        row = (*row, Node(name, sub=sub, sup=sup))
    return row


def drill(rng: np.random.Generator) -> Row:
    """Any signs side by side, all of them alike often, some with a script: what no grammar would teach."""
    pool = [sign for sign in SIGNS if sign not in (FRACTION, ROOT, PRIME, *ACCENTS)]
    row: Row = ()
    for _ in range(int(rng.integers(1, 7))):
        sub: Row = ()
        sup: Row = ()
        name = pool[int(rng.integers(len(pool)))]
        style = rng.random()
        if style < 0.12:
            sub = (Node(pool[int(rng.integers(len(pool)))]),)
        elif style < 0.24:
            sup = (Node(PRIME if style > 0.22 else pool[int(rng.integers(len(pool)))]),)
        elif style < 0.3 and name in LETTERS:
            row = (*row, Node(name, accent=Node(ACCENTS[int(rng.integers(len(ACCENTS)))])))
            continue
        elif style < 0.34:
            row = (*row, Node(ROOT, inside=(Node(name),)))
            continue
        elif style < 0.38:
            other = pool[int(rng.integers(len(pool)))]
            row = (*row, Node(FRACTION, over=(Node(name),), under=(Node(other),)))
            continue
        row = (*row, Node(name, sub=sub, sup=sup))
    return row
