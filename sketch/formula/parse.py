"""Formula text to SymPy trees: a small strict parser, never `sympify` or `eval`.

The grammar; `*` repeats, `?` is optional, juxtaposition of operands multiplies:

    relation   sum  ( = sum )?                     x = y is Equality(x, y, evaluate=False)
    sum        sign? product  ( + or - sign? product )*
    product    power  ( * or / sign? power  |  power )*      left to right: 1/2 g t^2 is (1/2)·g·t²
    power      operand ( ^ exponent )? units?      right to left: x^y^z is x^(y^z)
    exponent   sign? power  |  { sum }
    operand    number  |  name  |  ( sum )  |  [ sum ]  |  { sum }  |  ( sum , sum … )  vector
               | sum |  →  Abs        ‖ sum ‖  or  || sum ||  →  norm
               frac argument argument  |  sqrt ([ sum ])? operand
               function (^ exponent)? argument
    argument   a bracketed operand  |  power juxtaposed with numbers, names and fractions:
               cos 2πt is cos(2πt), but cos θ |W| is cos(θ)·|W|

Numbers are exact rationals, decimals too (0.1 is 1/10): equal texts give equal trees, sums of
decimals have no rounding, and whoever computes chooses the precision. π is a number; `e` is an
ordinary name (restitution, say) except as the base of a power, where it is Euler's number. Where a
letter after a number is a unit is told in `units`. ΣF is the sum of all forces F.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

import sympy
from sympy.core.basic import Basic

from sketch.formula.build import Unbuildable, add, call, multiply, power, reciprocal
from sketch.formula.lexer import FormulaError, Token, TokenKind, tokens
from sketch.formula.names import INVERSES
from sketch.formula.units import Unit, units_at
from sketch.page import Expression
from sketch.shapes import Point

__all__ = ["FormulaError", "expression", "parse"]


@dataclass(frozen=True, slots=True)
class ParseLimits:
    characters: int = 1000
    """Length of a formula; the longest of 1,979 handwritten ones has 255."""
    nesting: int = 32
    """Brackets, powers and functions within one another; keeps far from Python's recursion limit."""
    digits: int = 320
    """Characters of one number: as many as float64's largest has."""


LIMITS = ParseLimits()

T = TypeVar("T")

_CLOSERS: dict[TokenKind, TokenKind] = {"(": ")", "[": "]", "{": "}", "|": "|", "‖": "‖"}
_BEGINS_OPERAND: frozenset[TokenKind] = frozenset(
    ["number", "name", "function", "sqrt", "frac", "(", "[", "{", "|", "‖"]
)
_CONTINUES_ARGUMENT: frozenset[TokenKind] = frozenset(["number", "name", "frac"])


def parse(text: str) -> Basic:
    """The tree of a formula: an Equality, a scalar expression or a vector (Tuple).

    Raises FormulaError, which says what is wrong, where, and what would be right.
    """
    read = _read(text)
    if isinstance(read, FormulaError):
        raise FormulaError(read.reason, read.text, read.position)
    return read


@lru_cache(maxsize=4096)
def _read(text: str) -> Basic | FormulaError:
    """A page is read again whenever one of its formulas is edited: the others are remembered."""
    try:
        return _parsed(text)
    except FormulaError as error:
        return error.with_traceback(None)


def _parsed(text: str) -> Basic:
    if len(text) > LIMITS.characters:
        raise FormulaError(
            f"a formula of {len(text)} characters; at most {LIMITS.characters} are read",
            text,
            LIMITS.characters,
        )
    return _Parser(text, tokens(text)).relation()


def expression(text: str, strokes: Sequence[int] = (), at: Point | None = None) -> Expression:
    """The text as a page's expression; one that cannot be read has no tree and says why in `problem`."""
    try:
        return Expression(text, tuple(strokes), at, tree=parse(text))
    except FormulaError as error:
        return Expression(text, tuple(strokes), at, problem=error.sentence)


class _Parser:
    """A cursor over the tokens; each method reads what the grammar gives its name to."""

    __slots__ = ("_closers", "_depth", "_next", "_text", "_tokens")

    def __init__(self, text: str, found: list[Token]) -> None:
        self._text = text
        self._tokens = found
        self._next = 0
        self._depth = 0
        self._closers: list[TokenKind] = []
        """What each open bracket waits for: tells a closing bar from an opening one."""

    def relation(self) -> Basic:
        if self._here.kind == "end":
            raise self._error("an empty formula; write one such as g = 9.81")
        left = self._sum()
        if not self._take("="):
            self._finish("an operator, = or the end")
            return left
        right = self._sum()
        self._finish("an operator or the end")
        return sympy.Equality(left, right, evaluate=False)

    def _sum(self) -> Basic:
        start = self._here
        terms = [self._signed(self._product)]
        while self._here.kind in ("+", "-"):
            negative = self._advance().kind == "-"
            term = self._signed(self._product)
            terms.append(
                self._built(start, lambda t=term: multiply([sympy.S.NegativeOne, t])) if negative else term
            )
        return terms[0] if len(terms) == 1 else self._built(start, lambda: add(terms))

    def _signed(self, read: Callable[[], Basic]) -> Basic:
        start = self._here
        if not (self._take("-") or self._take("+")):
            return read()
        operand = read()
        if start.kind == "+":
            return operand
        return self._built(start, lambda: multiply([sympy.S.NegativeOne, operand]))

    def _product(self) -> Basic:
        start = self._here
        factors = [self._power()]
        while True:
            before = self._tokens[self._next - 1]
            here = self._here
            if self._take("*"):
                factors.append(self._signed(self._power))
            elif self._take("/"):
                number = self._here.kind == "number"
                divisor = self._signed(self._power)
                if (
                    number
                    and isinstance(divisor, sympy.Expr)
                    and divisor.has(Unit)
                    and not any(f.free_symbols for f in factors)
                ):
                    divisor, units = divisor.as_independent(Unit)
                    factors.append(units)
                factors.append(self._built(here, lambda d=divisor: reciprocal(d)))
            elif here.kind in _BEGINS_OPERAND and not self._closes(here):
                self._check_juxtaposed(before, here)
                factors.append(self._power())
            else:
                break
        return factors[0] if len(factors) == 1 else self._built(start, lambda: multiply(factors))

    def _power(self) -> Basic:
        return self._measured(self._raised())

    def _raised(self) -> Basic:
        """A power without what measures it: in 10^3 m the metres are not the exponent's."""
        start = self._here
        euler = start.kind == "name" and start.value == "e"
        base = self._operand()
        if not self._take("^"):
            return base
        exponent = self._exponent()
        if euler:
            return self._built(start, lambda: call("exp", exponent))
        return self._built(start, lambda: power(base, exponent))

    def _measured(self, value: Basic) -> Basic:
        """The value with the units that follow it, where it is a number and they are units."""
        here = self._here
        if here.kind not in ("name", "unit"):
            return value
        closer = self._closers[-1] if self._closers else None
        found = units_at(self._text, self._tokens, self._next, closer)
        if found is None or value.free_symbols:
            return value
        units, self._next = found
        return self._built(here, lambda: multiply([value, *units]))

    def _exponent(self) -> Basic:
        with self._deeper():
            return self._operand() if self._here.kind == "{" else self._signed(self._raised)

    @contextmanager
    def _deeper(self) -> Generator[None]:
        self._depth += 1
        if self._depth > LIMITS.nesting:
            raise self._error(f"nested more than {LIMITS.nesting} deep; name a part and use its name")
        yield
        self._depth -= 1

    def _operand(self) -> Basic:
        if self._here.kind not in _BEGINS_OPERAND:
            raise self._error(f"expected a number, a name or an opening bracket, but {self._spoken}")
        with self._deeper():
            return self._operand_at(self._advance())

    def _operand_at(self, token: Token) -> Basic:
        match token.kind:
            case "number":
                return self._number(token)
            case "name":
                if token.value == "Sigma" and self._here.kind == "name":
                    return self._sum_of_all(token)
                return sympy.pi if token.value == "pi" else sympy.Symbol(token.value)
            case "(" | "[":
                return self._bracketed(token)
            case "{" | "‖":
                inner = self._enclosed(token, self._sum)
                return inner if token.kind == "{" else call("norm", inner)
            case "|":
                return self._bars(token)
            case "frac":
                above, below = self._fraction_arguments(token)
                return self._built(token, lambda: multiply([above, reciprocal(below)]))
            case "sqrt":
                return self._root(token)
            case _:
                return self._call(token)

    def _number(self, token: Token) -> Basic:
        if len(token.value) > LIMITS.digits:
            raise FormulaError(
                f"a number of {len(token.value)} characters; at most {LIMITS.digits} are read",
                self._text,
                token.start,
            )
        mantissa, _, exponent = token.value.lower().partition("e")
        ten = sympy.Integer(10)
        if not exponent:
            return sympy.Rational(mantissa)
        return self._built(
            token, lambda: multiply([sympy.Rational(mantissa), power(ten, sympy.Integer(exponent))])
        )

    def _bracketed(self, token: Token) -> Basic:
        components = self._enclosed(token, self._components)
        return components[0] if len(components) == 1 else sympy.Tuple(*components)

    def _components(self) -> list[Basic]:
        components = [self._sum()]
        while self._take(","):
            components.append(self._sum())
        if len(components) > 1 and any(isinstance(component, sympy.Tuple) for component in components):
            raise self._error("a vector's components are scalars")
        return components

    def _bars(self, token: Token) -> Basic:
        """|x|, or ||x|| when the bars touch."""
        double = self._here.kind == "|" and self._here.start == token.end
        if not double:
            argument = self._enclosed(token, self._sum)
            return self._built(token, lambda: call("abs", argument))
        argument = self._enclosed(self._advance(), self._sum)
        if not self._take("|"):
            raise self._error("|| opens a norm and needs || to close it; write abs(…) for nested bars")
        return call("norm", argument)

    def _fraction_arguments(self, token: Token) -> tuple[Basic, Basic]:
        """What follows \\frac: two groups, or as in TeX two single letters or digits (\\frac12)."""
        here = self._here
        if here.kind == "number" and len(here.value) > 1:
            if len(here.value) != 2 or not here.value.isdigit():
                raise self._error(f"put braces around both parts of {token.value}, as in \\frac{{1}}{{2}}")
            self._advance()
            return sympy.Integer(int(here.value[0])), sympy.Integer(int(here.value[1]))
        return self._operand(), self._operand()

    def _root(self, token: Token) -> Basic:
        degree: Basic = sympy.Integer(2)
        if token.value == "\\sqrt" and self._here.kind == "[":
            degree = self._enclosed(self._advance(), self._sum)
        here = self._here
        if token.value == "\\sqrt" and here.kind == "number" and len(here.value) > 1:
            raise self._error("put braces around what is under the root, as in \\sqrt{12}")
        radicand = self._operand()
        return self._built(token, lambda: power(radicand, reciprocal(degree)))

    def _sum_of_all(self, token: Token) -> Basic:
        """ΣF, \\sum F_x: of one name or bracket."""
        if self._here.kind == "^":
            raise self._error("the sum of all forces is written without limits, as in \\sum F")
        inner = self._operand()
        return self._built(token, lambda: call("sum", inner))

    def _call(self, token: Token) -> Basic:
        if token.value == "sum":
            return self._sum_of_all(token)
        name, raised = token.value, None
        if self._take("^"):
            raised = self._exponent()
            if raised == -1:
                if name not in INVERSES:
                    raise self._error(f"{name} has no inverse here; write 1/{name}(…) for the reciprocal")
                name, raised = INVERSES[name], None
        argument = self._argument()
        value = self._built(token, lambda: call(name, argument))
        return value if raised is None else self._built(token, lambda: power(value, raised))

    def _argument(self) -> Basic:
        start = self._here
        if start.kind in _CLOSERS:
            return self._operand()
        factors = [self._power()]
        while start.kind in _CONTINUES_ARGUMENT and self._here.kind in _CONTINUES_ARGUMENT:
            self._check_juxtaposed(self._tokens[self._next - 1], self._here)
            factors.append(self._power())
        return self._built(start, lambda: multiply(factors))

    def _check_juxtaposed(self, before: Token, here: Token) -> None:
        """Refuse products that a person would read in two ways."""
        if here.kind != "number":
            return
        if before.kind == "number":
            raise self._error("two numbers side by side; write * between them")
        if before.kind == "name" and before.end == here.start:
            name, number = before.value, here.value
            raise self._error(
                f"{name}{number} can be read in three ways; write {name}_{number}, {name}*{number} or {name}^{number}"
            )

    def _enclosed(self, opening: Token, read: Callable[[], T]) -> T:
        """What `read` reads up to the bracket that closes `opening`."""
        closer = _CLOSERS[opening.kind]
        self._closers.append(closer)
        inner = read()
        self._closers.pop()
        if not self._take(closer):
            raise self._error(
                f"expected {closer} to close the {opening.value} at character {opening.start + 1}, but {self._spoken}"
            )
        return inner

    def _closes(self, token: Token) -> bool:
        return bool(self._closers) and self._closers[-1] == token.kind

    def _finish(self, wanted: str) -> None:
        here = self._here
        if here.kind == "end":
            return
        if here.kind == "=":
            raise self._error("a formula has one equals sign")
        if here.kind == ",":
            raise self._error(
                "a comma separates the components of a vector in brackets; a decimal has a point, as in 9.81"
            )
        if here.kind == "unit":
            raise self._error("degrees stand after a number, as in 30°")
        raise self._error(f"expected {wanted}, but {self._spoken}")

    def _built(self, token: Token, build: Callable[[], Basic]) -> Basic:
        try:
            return build()
        except Unbuildable as problem:
            raise FormulaError(str(problem), self._text, token.start) from None
        except ArithmeticError:  # SymPy's, where it looks for the sign of what has no value: 1/sin(0)
            raise FormulaError("this has no value", self._text, token.start) from None

    @property
    def _here(self) -> Token:
        return self._tokens[self._next]

    @property
    def _spoken(self) -> str:
        here = self._here
        return (
            "the formula ends" if here.kind == "end" else f"{self._text[here.start : here.end]!r} stands here"
        )

    def _advance(self) -> Token:
        self._next += 1
        return self._tokens[self._next - 1]

    def _take(self, kind: TokenKind) -> bool:
        taken = self._here.kind == kind
        self._next += taken
        return taken

    def _error(self, reason: str) -> FormulaError:
        return FormulaError(reason, self._text, self._here.start)
