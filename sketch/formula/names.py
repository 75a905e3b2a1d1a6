"""The words of the formula language: which names it knows, however they are spelt.

A name has one canonical ASCII spelling, which is the name of its SymPy symbol: `theta` for
θ, `\\theta` and theta; a subscript follows an underscore: `f_1`, `v_Ax`. A letter that is in none
of these tables stands for itself.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy
from sympy.core.basic import Basic

_LOWER = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi chi psi omega"
_UPPER = "Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega"
GREEK: frozenset[str] = frozenset([*_LOWER.split(), *_UPPER.split()])
"""Canonical names; those capitals that LaTeX writes as Latin letters are left out."""

LETTERS: dict[str, str] = {
    **dict(zip("αβγδεζηθικλμνξπρστυφχψω", _LOWER.split(), strict=True)),
    **dict(zip("ΓΔΘΛΞΠΣΥΦΨΩ", _UPPER.split(), strict=True)),
    "µ": "mu",
    "ϵ": "epsilon",
    "ϑ": "theta",
    "ϕ": "phi",
    "ϱ": "rho",
    "ς": "sigma",
    "Ω": "Omega",
    "∆": "Delta",
    "ℓ": "l",
}
"""Letters beyond ASCII, by canonical name."""

COMMANDS: dict[str, str] = {
    **{name: name for name in GREEK},
    **{f"var{name}": name for name in ("epsilon", "theta", "rho", "sigma", "phi")},
    "ell": "l",
}
"""LaTeX commands that stand for a letter, by canonical name."""

FUNCTIONS: dict[str, Callable[..., Basic]] = {
    "sin": sympy.sin,
    "cos": sympy.cos,
    "tan": sympy.tan,
    "asin": sympy.asin,
    "acos": sympy.acos,
    "atan": sympy.atan,
    "sinh": sympy.sinh,
    "cosh": sympy.cosh,
    "tanh": sympy.tanh,
    "exp": sympy.exp,
    "ln": sympy.log,
    "abs": sympy.Abs,
    "norm": sympy.Function("norm"),
}
"""Functions of one argument by canonical name. `norm` (‖x‖) has no meaning of its own here."""

FUNCTION_ALIASES: dict[str, str] = {
    **{name: name for name in FUNCTIONS},
    "arcsin": "asin",
    "arccos": "acos",
    "arctan": "atan",
    "log": "ln",
}
"""Every spelling of a function. The logarithm is natural under both of its names."""

INVERSES: dict[str, str] = {"sin": "asin", "cos": "acos", "tan": "atan"}
"""What f^{-1} is. Other functions have no inverse here and 1/f has to be written as a fraction."""

WORDS: frozenset[str] = frozenset([*GREEK, *FUNCTION_ALIASES, "sqrt"])
"""Runs of plain letters that are one word; letters of any other run multiply."""

_LONGEST_WORD = max(map(len, WORDS))


def words(run: str) -> list[str]:
    """Cut a run of letters into known words and single letters, the longest word first:
    `mgsin` is m, g, sin; `mgh` is m, g, h; `epsilon` is one word although `psi` is in it."""
    cut: list[str] = []
    at = 0
    while at < len(run):
        lengths = range(min(_LONGEST_WORD, len(run) - at), 1, -1)
        length = next((n for n in lengths if run[at : at + n] in WORDS), 1)
        cut.append(run[at : at + length])
        at += length
    return cut
