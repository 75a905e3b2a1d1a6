"""A grammar of mathematics at large: sums, products, fractions, roots, scripts, functions, relations.

Each expression draws its letters from a small pool of its own, as people do, who repeat the names that
they introduced. Nothing here is taken from a collection of people's expressions.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from data_gen.writing.author import COMMON, GREEK, RULE, Author
from sketch.writing.rows import Node, Row
from sketch.writing.signs import FRACTION, FUNCTIONS, ROOT

_WEIGHTS = 1.0 / (4.0 + np.arange(len(COMMON)))
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


def general(rng: np.random.Generator) -> Row:
    """An expression of mathematics at large: some 1 to 40 signs."""
    count = int(rng.integers(1, 6))
    shares = _WEIGHTS / _WEIGHTS.sum()
    pool = [str(name) for name in rng.choice(COMMON, size=count, p=shares)]
    if rng.random() < 0.3:
        pool.append(GREEK[min(int(rng.exponential(4.0)), len(GREEK) - 1)])
    if rng.random() < 0.25:  # one letter in both cases
        other = pool[0].swapcase() if len(pool[0]) == 1 else pool[0]
        pool.append(other)
    author = Author(rng, tuple(pool))
    style = rng.random()
    if style < 0.1:
        return _arithmetic(author)
    if style < 0.4:
        return total(author, 0)
    row = (*_side(author), *_relation(author), *total(author, 0))
    if rng.random() < 0.08:
        row = (*row, *_relation(author), *total(author, 1))
    return row


def _side(author: Author) -> Row:
    if author.chance(0.55):
        name = author.letter()
        if author.chance(0.25):
            return (*_scripted(author, name), Node("("), *_arguments(author), Node(")"))
        return _scripted(author, name)
    return total(author, 1)


def _relation(author: Author) -> Row:
    return (Node(author.pick(["=", "<", ">", "\\leq", "\\geq"], [0.86, 0.04, 0.04, 0.03, 0.03])),)


def total(author: Author, depth: int) -> Row:
    row: Row = (Node("-"),) if author.chance(0.08) else ()
    count = author.count(RULE.terms if depth < 2 else RULE.terms[:2])
    for k in range(count):
        if k:
            row = (*row, Node(author.pick("+-", [0.55, 0.45])))
        row = (*row, *product(author, depth))
    return row


def product(author: Author, depth: int) -> Row:
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


def _factor(author: Author, depth: int, first: bool) -> Row:
    forms: list[tuple[float, Callable[[], Row]]] = [
        (0.5, lambda: _scripted(author, author.letter())),
        (0.24 if first else 0.06, lambda: number(author)),
    ]
    if depth < RULE.deepest:
        deeper = depth + 1
        forms += [
            (0.09, lambda: (Node(FRACTION, over=total(author, deeper), under=total(author, deeper)),)),
            (0.05, lambda: (Node(ROOT, inside=total(author, deeper)),)),
            (0.07, lambda: _bracketed(author, deeper)),
            (0.07, lambda: _function(author, deeper)),
            (0.04, lambda: (Node(author.letter()), Node("("), *_arguments(author), Node(")"))),
            (0.03, lambda: _bars(author, deeper)),
            (0.01, lambda: (Node(author.letter(), accent=Node(author.pick(["\\vec", "\\hat"]))),)),
        ]
    shares = np.array([share for share, _ in forms])
    return forms[int(np.searchsorted(np.cumsum(shares) / shares.sum(), author.rng.random()))][1]()


def number(author: Author) -> Row:
    if author.chance(0.6):
        return (Node(author.pick("0123456789", [0.6, 2.2, 2.2, 1.6, 1.3, 1, 0.9, 0.8, 0.8, 0.8])),)
    length = 1 + author.count([0.6, 0.25, 0.15])
    digits = [Node(author.pick("0123456789")) for _ in range(length)]
    if digits[0].name == "0":
        digits[0] = Node("1")
    if author.chance(0.25):
        digits.insert(int(author.rng.integers(1, length)), Node("."))
    return tuple(digits)


def _arithmetic(author: Author) -> Row:
    row = number(author)
    for _ in range(author.count([0.5, 0.3, 0.2])):
        sign = author.pick(["+", "-", "\\times", "/", "=", "\\cdot"], [3, 2, 2, 1, 2, 0.5])
        row = (*row, Node(sign), *number(author))
    return row


def _scripted(author: Author, name: str) -> Row:
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


def _subscript(author: Author) -> Row:
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


def _superscript(author: Author) -> Row:
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


def _bracketed(author: Author, depth: int) -> Row:
    left, right = ("(", ")") if author.chance(0.85) else ("[", "]")
    sup = _superscript(author) if author.chance(0.25) else ()
    return (Node(left), *total(author, depth), Node(right, sup=sup))


def _bars(author: Author, depth: int) -> Row:
    bar = "|" if author.chance(0.75) else "\\Vert"
    inner = _scripted(author, author.letter()) if author.chance(0.7) else total(author, depth)
    return (Node(bar), *inner, Node(bar))


def _function(author: Author, depth: int) -> Row:
    name = author.pick(FUNCTIONS, [4, 4, 2, 2, 1, 1])
    sup: Row = (Node(author.pick("23")),) if author.chance(0.12) else ()
    style = author.rng.random()
    if style < 0.5 and name != "\\exp":
        argument = _scripted(author, author.letter())
        if author.chance(0.25):
            argument = (*number(author), *argument)
    elif style < 0.6 and name != "\\exp":
        argument = (Node(FRACTION, over=product(author, depth), under=product(author, depth)),)
    else:
        argument = (Node("("), *total(author, depth), Node(")"))
    return (Node(name, sup=sup), *argument)


def _arguments(author: Author) -> Row:
    row = _scripted(author, author.letter()) if author.chance(0.75) else total(author, 2)
    while author.chance(0.25):
        row = (*row, Node(","), *_scripted(author, author.letter()))
    return row
