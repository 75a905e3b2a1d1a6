"""The words of the formula language: which names it knows, however they are spelt.

A name has one canonical ASCII spelling, which is the name of its SymPy symbol: `theta` for
θ, `\\theta` and theta; a subscript follows an underscore: `f_1`, `v_Ax`; a prime comes last: `v_1'`. A letter that is in none
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
    "sum": sympy.Function("sum"),
}
"""Functions of one argument by canonical name. `norm` (‖x‖) and `sum` (ΣF) have no meaning of their own
here."""

RECIPROCALS: dict[str, str] = {"cot": "tan", "sec": "cos", "csc": "sin"}
"""Functions that are kept as one over another: cot x is 1/tan x."""

FUNCTION_ALIASES: dict[str, str] = {
    **{name: name for name in (*FUNCTIONS, *RECIPROCALS)},
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


UNIT_LETTERS: frozenset[str] = frozenset(["m", "s", "N", "J"])
"""Letters that name a unit where nothing else can be meant."""
UPRIGHT_LETTERS: frozenset[str] = frozenset(["g", "h", "W"])
"""Letters that name a unit only when set upright; the quantities of these names are everywhere."""
UNITS: dict[str, tuple[str, ...]] = {
    **{
        name: (name,)
        for name in (
            "kg",
            "lb",
            "km",
            "dm",
            "cm",
            "mm",
            "ft",
            "inch",
            "mi",
            "ms",
            "min",
            "deg",
            "rad",
            "rev",
            "Hz",
            "kHz",
            "rpm",
            "mph",
            "kN",
            "mN",
            "MN",
            "lbf",
            "kJ",
            "mJ",
            "MJ",
            "eV",
            "kWh",
            "kW",
            "MW",
            "Pa",
            "kPa",
            "MPa",
        )
    },
    "Nm": ("N", "m"),
    "hr": ("h",),
    **dict.fromkeys(["degree", "degrees"], ("deg",)),
    **dict.fromkeys(["radian", "radians"], ("rad",)),
    **dict.fromkeys(["metre", "metres", "meter", "meters"], ("m",)),
    **dict.fromkeys(["second", "seconds"], ("s",)),
    **dict.fromkeys(["minute", "minutes"], ("min",)),
    **dict.fromkeys(["hour", "hours"], ("h",)),
    **dict.fromkeys(["gram", "grams"], ("g",)),
    **dict.fromkeys(["newton", "newtons"], ("N",)),
    **dict.fromkeys(["joule", "joules"], ("J",)),
    **dict.fromkeys(["watt", "watts"], ("W",)),
}
"""Units of several letters by spelling; the canonical names whose product they are."""
UNIT_WORDS: frozenset[str] = frozenset([*UNIT_LETTERS, *UPRIGHT_LETTERS, *UNITS])
"""Every spelling of a unit."""
UNIT_NAMES: frozenset[str] = frozenset(
    [*UNIT_LETTERS, *UPRIGHT_LETTERS, *(name for product in UNITS.values() for name in product)]
)
"""Canonical names of units."""
