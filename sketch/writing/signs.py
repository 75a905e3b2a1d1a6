"""The signs of handwritten mathematics: the vocabulary that its reader and its generator share.

A sign is named as LaTeX writes it. `\\bar` is the bar of a fraction, which on paper is a minus sign
with something above and something below; sin, cos, tan, log, ln and exp are one sign each, since
people write them in one go. Frame of the slots: y down, the baseline at 0, a capital is 1 high.
"""

from __future__ import annotations

from typing import Literal

DIGITS = tuple("0123456789")
SMALL = tuple("abcdefghijklmnopqrstuvwxyz")
CAPITALS = tuple("ABCDEFGHIJKLMNOPQRSTUVWXYZ")
GREEK = tuple(
    f"\\{name}"
    for name in (
        "alpha", "beta", "gamma", "delta", "Delta", "epsilon", "eta", "theta", "lambda",
        "mu", "pi", "rho", "sigma", "tau", "phi", "omega", "Omega",
    )
)  # fmt: skip
OPERATORS = ("+", "-", "\\times", "\\cdot", "/")
RELATIONS = ("=", "<", ">", "\\leq", "\\geq")
OPENING, CLOSING = ("(", "["), (")", "]")
BARS = ("|", "\\Vert")
POINTS = (".", ",")
FUNCTIONS = ("\\sin", "\\cos", "\\tan", "\\log", "\\ln", "\\exp")
PRIME, DEGREE = "'", "\\circ"
FRACTION, ROOT = "\\bar", "\\sqrt"
ACCENTS = ("\\vec", "\\hat")

SIGNS: tuple[str, ...] = (
    *DIGITS, *SMALL, *CAPITALS, *GREEK, *OPERATORS, *RELATIONS, *OPENING, *CLOSING, *BARS, *POINTS,
    *FUNCTIONS, PRIME, DEGREE, FRACTION, ROOT, *ACCENTS,
)  # fmt: skip
"""Every sign, in the order in which the nets number them."""
NUMBER: dict[str, int] = {sign: number for number, sign in enumerate(SIGNS)}
LETTERS = frozenset([*SMALL, *CAPITALS, *GREEK])

TWINS: tuple[tuple[str, ...], ...] = (
    ("c", "C"), ("0", "o", "O"), ("p", "P"), ("s", "S"), ("v", "V"), ("x", "X", "\\times"),
    ("z", "Z"), ("w", "W"), ("k", "K"), ("1", "l", "|"),
)  # fmt: skip
"""Signs of one shape, which only size, place and neighbours tell apart: what "merged" scores count as one."""
MERGED: dict[str, str] = {twin: twins[0] for twins in TWINS for twin in twins}

Extent = Literal["x", "tall", "deep", "long", "middle", "low", "high", "bar", "bracket", "root", "word"]
"""Which part of a line a sign takes up: x-height, as tall as a capital, x-height with a descender, both,
about the axis, at the baseline, at the top, a fraction's bar, as tall as what stands beside, a root, a word."""
EXTENTS: tuple[Extent, ...] = (
    "x", "tall", "deep", "long", "middle", "low", "high", "bar", "bracket", "root", "word",
)  # fmt: skip

_EXTENT: dict[str, Extent] = {
    **dict.fromkeys([*DIGITS, *CAPITALS, "b", "d", "h", "k", "l", "i", "t", "\\delta", "\\Delta"], "tall"),
    **dict.fromkeys(["\\lambda", "\\theta", "\\Omega"], "tall"),
    **dict.fromkeys([*"acemnorsuvwxz", "\\alpha", "\\pi", "\\sigma", "\\omega", "\\epsilon", "\\tau"], "x"),
    **dict.fromkeys([*"gpqy", "\\mu", "\\gamma", "\\rho", "\\eta"], "deep"),
    **dict.fromkeys([*"fj", "\\beta", "\\phi"], "long"),
    **dict.fromkeys(["+", "-", "\\times", "\\cdot", *RELATIONS], "middle"),
    **dict.fromkeys(POINTS, "low"),
    **dict.fromkeys([PRIME, DEGREE, *ACCENTS], "high"),
    **dict.fromkeys([*OPENING, *CLOSING, *BARS, "/"], "bracket"),
    **dict.fromkeys(FUNCTIONS, "word"),
    FRACTION: "bar",
    ROOT: "root",
}


def extent(sign: str) -> Extent:
    """The part of a line that the sign takes up. Raises KeyError when it is not in the vocabulary."""
    return _EXTENT[sign]
