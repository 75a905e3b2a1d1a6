"""Formula text cut into tokens: plain typing, Unicode and LaTeX give the same tokens.

Subscripts are part of a name and are read here; superscripts are grammar and are left to
the parser. Primes are part of a name too: v_1' is the v_1 after an impact. Positions count
characters of the text from 0.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from sketch.formula.names import COMMANDS, FUNCTION_ALIASES, LETTERS, UNIT_WORDS, words

TokenKind = Literal[
    "number", "name", "function", "sqrt", "frac", "unit",
    "+", "-", "*", "/", "^", "=", "(", ")", "[", "]", "{", "}", ",", "|", "‖", "end",
]  # fmt: skip


class FormulaError(ValueError):
    """Text that is not a formula.

    reason: one sentence that says what is wrong and what would be right; position: the index of the
    character where it was noticed; text: the formula. `str` shows the place with a caret.
    """

    def __init__(self, reason: str, text: str, position: int) -> None:
        self.reason = reason
        self.text = text
        self.position = position
        super().__init__(f"{reason}\n{_excerpt(text, position)}")

    def __reduce__(self) -> tuple[type[FormulaError], tuple[str, str, int]]:
        return FormulaError, (self.reason, self.text, self.position)

    @property
    def sentence(self) -> str:
        """The reason and the place in one line."""
        return f"{self.reason} (at character {self.position + 1})"


@dataclass(frozen=True, slots=True)
class Token:
    """value: digits of a number (or 1/2 for ½), canonical name of a name, function or unit, else what
    was written; upright: whether it was set upright, as units are."""

    kind: TokenKind
    value: str
    start: int
    end: int
    upright: bool = False


_SIGNS: dict[str, TokenKind] = {
    **dict.fromkeys("+＋", "+"),
    **dict.fromkeys("-−–", "-"),
    **dict.fromkeys("*·×⋅∗", "*"),
    **dict.fromkeys("/÷⁄", "/"),
    **dict.fromkeys("|∣", "|"),
    **dict.fromkeys("‖∥", "‖"),
    "^": "^", "=": "=", "(": "(", ")": ")", "[": "[", "]": "]", "{": "{", "}": "}", ",": ",",
    "√": "sqrt",
}  # fmt: skip
_COMMAND_SIGNS: dict[str, TokenKind] = {
    "cdot": "*", "times": "*", "ast": "*", "div": "/", "|": "‖", "Vert": "‖", "lVert": "‖", "rVert": "‖",
    "vert": "|", "lvert": "|", "rvert": "|", "{": "(", "}": ")",
    "frac": "frac", "dfrac": "frac", "tfrac": "frac", "sqrt": "sqrt",
}  # fmt: skip
_UPRIGHT = frozenset(["mathrm", "text", "rm"])
"""Commands that dress a unit, or a name."""
_STYLES = frozenset(["vec", "overrightarrow", "mathbf", "boldsymbol", "mathit", *_UPRIGHT])
"""Commands that dress a name; whether it is a vector is for its meaning to say."""
_FRACTIONS = dict(zip("½⅓⅔¼¾⅕⅛", ["1/2", "1/3", "2/3", "1/4", "3/4", "1/5", "1/8"], strict=True))
_BLANK_COMMANDS = frozenset([",", ";", ":", "!", " ", "quad", "qquad", "left", "right", "displaystyle"])
_SUPERSCRIPTS = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿ", "0123456789+-n", strict=True))
_SUBSCRIPTS = dict(zip("₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ", "0123456789aehijklmnoprstuvx", strict=True))
_NOT_YET: dict[str, str] = {
    **dict.fromkeys(
        ("dot", "ddot"),
        "derivatives are not read; give the quantity a name of its own, as v_x for the rate of x",
    ),
    **dict.fromkeys(("'", "′", "prime"), "a prime belongs to a letter, as in v'"),
    **dict.fromkeys(("±", "pm", "mp"), "a formula has one value; write the two on two lines"),
    "sum_": ("the sum of all forces is written without limits, as in \\sum F"),
    **dict.fromkeys(("$", "&", "\\"), "one formula is written without the signs that set it apart"),
    **dict.fromkeys(("%", "!", "?", ";", ":", "#", "@"), "this sign has no meaning in a formula"),
    **dict.fromkeys(
        ("<", ">", "≤", "≥", "≠", "≈", "le", "leq", "ge", "geq", "ne", "neq", "approx", "lt", "gt"),
        "only = relates two sides",
    ),
    "_": "a subscript belongs to a letter, as in f_1",
    ".": "a point stands between digits, as in 9.81",
}

_DEGREE = re.compile(r"°|º|(?:\^\s*)?\\degree(?![A-Za-z])|\^\s*(?:\{\s*\\circ\s*\}|\\circ(?![A-Za-z]))")
_PRIMES = re.compile(r"['′]+|(?:\^\s*(?:\{\s*(?:\\prime\s*)+\}|\\prime(?![A-Za-z])))")
_BLANK = re.compile(r"[\s~\u200b]+")
_NUMBER = re.compile(r"(?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_RUN = re.compile(r"[A-Za-z]+")
_COMMAND = re.compile(r"\\([A-Za-z]+|.)", re.DOTALL)
_SUBSCRIPT_START = re.compile(r"\s*_\s*")
_SUBSCRIPT_PLAIN = re.compile(r"[0-9]+|[A-Za-z][A-Za-z0-9]*")
_GROUP = re.compile(r"\s*(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\[A-Za-z]+|.)")
_SUBSCRIPT_FONT = re.compile(r"\\(?:text|mathrm|mathit|rm)(?![A-Za-z])")
_SUBSCRIPT_NOISE = re.compile(r"[\s{},]")
_SUBSCRIPT_CANONICAL = re.compile(r"[A-Za-z0-9]+")


def tokens(text: str) -> list[Token]:
    """All tokens of a formula, an `end` last. Raises FormulaError at what belongs to no formula."""
    found: list[Token] = []
    at = 0
    while at < len(text):
        if blank := _BLANK.match(text, at):
            at = blank.end()
            continue
        if text[at] == "_" and found and found[-1].value == "sum":
            raise FormulaError(_NOT_YET["sum_"], text, at)
        new = list(_tokens_at(text, at))
        if new and new[-1].kind == "name":
            new[-1] = _with_primes(text, _with_subscript(text, _with_primes(text, new[-1])))
        found.extend(new)
        at = new[-1].end if new else _end_of_command(text, at)
    return [*found, Token("end", "", len(text), len(text))]


def decimals(text: str) -> frozenset[Fraction]:
    """The numbers that a formula writes with a point: a person who writes 0.5 is to see 0.5 again, though the
    tree holds 1/2. Raises FormulaError as `tokens` does."""
    numbers = (token.value.lower().partition("e")[0] for token in tokens(text) if token.kind == "number")
    return frozenset(Fraction(digits) for digits in numbers if "." in digits)


def _tokens_at(text: str, at: int) -> Iterator[Token]:
    """What begins at `at`: one token, several for a run of letters, none for a blank command."""
    sign = text[at]
    if number := _NUMBER.match(text, at):
        yield Token("number", number.group(), at, number.end())
    elif run := _RUN.match(text, at):
        for word in words(run.group()):
            yield _word(word, at, at + len(word))
            at += len(word)
    elif degree := _DEGREE.match(text, at):
        yield Token("unit", "deg", at, degree.end(), upright=True)
    elif sign in _FRACTIONS:
        yield Token("number", _FRACTIONS[sign], at, at + 1)
    elif sign == "∑":
        yield Token("function", "sum", at, at + 1)
    elif sign == "\\":
        yield from _command(text, at)
    elif sign in LETTERS:
        yield Token("name", LETTERS[sign], at, at + 1)
    elif sign in _SUPERSCRIPTS:
        yield from _superscript(text, at)
    elif sign in _SIGNS:
        yield Token(_SIGNS[sign], sign, at, at + 1)
    else:
        raise FormulaError(
            _NOT_YET.get(sign, f"the character {sign!r} has no meaning in a formula"), text, at
        )


def _word(word: str, start: int, end: int) -> Token:
    if word == "sqrt":
        return Token("sqrt", word, start, end)
    if word in FUNCTION_ALIASES:
        return Token("function", FUNCTION_ALIASES[word], start, end)
    return Token("name", word, start, end)


def _command(text: str, at: int) -> Iterator[Token]:
    match = _COMMAND.match(text, at)
    if match is None:
        raise FormulaError("a backslash begins a command, as in \\theta", text, at)
    name, end = match.group(1), match.end()
    if name in COMMANDS:
        yield Token("name", COMMANDS[name], at, end)
    elif name in FUNCTION_ALIASES:
        yield Token("function", FUNCTION_ALIASES[name], at, end)
    elif name in _COMMAND_SIGNS:
        yield Token(_COMMAND_SIGNS[name], f"\\{name}", at, end)
    elif name in _STYLES:
        yield from _styled(text, at, end, name in _UPRIGHT)
    elif name not in _BLANK_COMMANDS:
        reason = _NOT_YET.get(
            name,
            f"the command \\{name} is not known; known are letters such as \\theta, functions such as \\cos, \\frac, \\sqrt",
        )
        raise FormulaError(reason, text, at)


def _styled(text: str, at: int, end: int, upright: bool) -> Iterator[Token]:
    """\\vec{F} is F; \\mathrm{m} is m, and \\mathrm{km/h} is km/h, set upright."""
    dressed = _GROUP.match(text, end)
    written = "" if dressed is None else dressed.group().strip()
    inside = written.removeprefix("{").removesuffix("}")
    try:
        *inner, last = tokens(inside)
    except FormulaError as error:
        raise FormulaError(error.reason, text, at) from None
    units = upright and all(run in UNIT_WORDS or run in FUNCTION_ALIASES for run in _RUN.findall(inside))
    if dressed is None or not inner or ([token.kind for token in inner] != ["name"] and not units):
        kind = "one letter or a unit" if upright else "one letter"
        raise FormulaError(f"{text[at:end]} takes {kind}, as in {text[at:end]}{{m}}", text, at)
    begin = dressed.start() + dressed.group().index(inside)
    for token, after in zip(inner, [*inner[1:], last], strict=True):
        stop = dressed.end() if after is last else begin + token.end
        start = at if token is inner[0] else begin + token.start
        yield Token(token.kind, token.value, start, stop, upright)


def _end_of_command(text: str, at: int) -> int:
    match = _COMMAND.match(text, at)
    return match.end() if match else len(text)


def _superscript(text: str, at: int) -> Iterator[Token]:
    """x⁻² is x^{-2}."""
    end = at
    while end < len(text) and text[end] in _SUPERSCRIPTS:
        end += 1
    written = "".join(_SUPERSCRIPTS[sign] for sign in text[at:end])
    power = re.fullmatch(r"([+-]?)([0-9]+|n)", written)
    if power is None:
        raise FormulaError("a raised exponent is a whole number or n; write any other as ^(…)", text, at)
    yield Token("^", "^", at, end)
    yield Token("{", "{", at, end)
    if power.group(1):
        yield Token("-" if power.group(1) == "-" else "+", power.group(1), at, end)
    yield Token("name" if power.group(2) == "n" else "number", power.group(2), at, end)
    yield Token("}", "}", at, end)


def _with_subscript(text: str, name: Token) -> Token:
    end = name.end
    while end < len(text) and text[end] in _SUBSCRIPTS:
        end += 1
    if end > name.end:
        below = "".join(_SUBSCRIPTS[sign] for sign in text[name.end : end])
    elif start := _SUBSCRIPT_START.match(text, end):
        below, end = _subscript(text, start.end())
    else:
        return name
    base, primes = name.value.rstrip("'"), "'" * name.value.count("'")
    return Token("name", f"{base}_{below}{primes}", name.start, end, name.upright)


def _with_primes(text: str, name: Token) -> Token:
    found = _PRIMES.match(text, name.end)
    if found is None:
        return name
    written = found.group()
    count = max(written.count("'") + written.count("′"), written.count("\\prime"))
    return Token("name", name.value + "'" * count, name.start, found.end(), name.upright)


def _subscript(text: str, at: int) -> tuple[str, int]:
    """The subscript that begins at `at`, canonical, and where it ends.

    Without braces digits end at the first letter (v_0t is v_0·t), letters take what follows
    (v_Ax is one name).
    """
    if plain := _SUBSCRIPT_PLAIN.match(text, at):
        return plain.group(), plain.end()
    if written := _GROUP.match(text, at):
        below = _SUBSCRIPT_FONT.sub("", written.group())
        below = _COMMAND.sub(lambda command: COMMANDS.get(command.group(1), command.group()), below)
        below = _SUBSCRIPT_NOISE.sub("", below)
        below = "".join(LETTERS.get(sign, sign) for sign in below)
        if _SUBSCRIPT_CANONICAL.fullmatch(below):
            return below, written.end()
    raise FormulaError("a subscript is made of letters and digits, as in v_{Ax}", text, at)


def _excerpt(text: str, position: int, reach: int = 30) -> str:
    """The text around a position and a caret below it: two lines."""
    first, last = max(0, position - reach), position + reach
    head, tail = "…" if first > 0 else "", "…" if last < len(text) else ""
    shown = "".join(sign if sign.isprintable() else " " for sign in text[first:last])
    return f"  {head}{shown}{tail}\n  {' ' * (len(head) + position - first)}^"
