"""The operations of compiled formulas, and what postfix code of them is worth.

Code is a list of (operation, operand): `push` puts its operand on a stack, `read` the quantity of that number,
all others work on what lies on top. Nothing here raises: what has no value is NaN.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

Code = list[tuple[str, float]]


def _power(base: float, exponent: float) -> float:
    if exponent == 2:
        return base * base
    result = base**exponent
    return result if isinstance(result, float) else math.nan


BINARY: dict[str, Callable[[float, float], float]] = {
    "add": lambda a, b: a + b,
    "multiply": lambda a, b: a * b,
    "power": _power,
    "atan2": math.atan2,
    "min": min,
    "max": max,
}
UNARY: dict[str, Callable[[float], float]] = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "cot": lambda a: 1 / math.tan(a),
    "sec": lambda a: 1 / math.cos(a),
    "csc": lambda a: 1 / math.sin(a),
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "sinh": math.sinh,
    "cosh": math.cosh,
    "tanh": math.tanh,
    "exp": math.exp,
    "log": math.log,
    "sqrt": math.sqrt,
    "invert": lambda a: 1 / a,
    "abs": abs,
    "sign": lambda a: math.copysign(1.0, a) if a else 0.0,
    "floor": lambda a: float(math.floor(a)),
    "ceiling": lambda a: float(math.ceil(a)),
}
LOG_TO_BASE = "log to base"
"""Of two: the logarithm of the first to the base that is the second."""


def evaluated(code: Sequence[tuple[str, float]], state: Sequence[float]) -> float:
    """The value of code that leaves one number; NaN where it, or any part of it, has none. state: what it
    reads."""
    try:
        stack: list[float] = []
        for operation, operand in code:
            if operation == "push":
                stack.append(operand)
            elif operation == "read":
                stack.append(state[int(operand)])
            elif operation in BINARY:
                right = stack.pop()
                stack[-1] = BINARY[operation](stack[-1], right)
            else:
                stack[-1] = UNARY[operation](stack[-1])
            if not math.isfinite(stack[-1]):
                return math.nan
    except (ArithmeticError, ValueError):
        return math.nan
    return stack[-1]


def operated(operation: str, parts: list[Code]) -> Code:
    """The code of an operation on what these codes give, folded where that is a number."""
    if operation == LOG_TO_BASE:
        number, base = (_apply("log", part) for part in parts)
        return _fold("multiply", [number, _apply("invert", base)])
    return _apply(operation, parts[0]) if operation in UNARY else _fold(operation, parts)


def _fold(operation: str, parts: list[Code]) -> Code:
    code = parts[0]
    for part in parts[1:]:
        joined: Code = [*code, *part, (operation, 0.0)]
        code = _folded(joined) if len(code) == len(part) == 1 else joined
    return code


def _apply(operation: str, inside: Code) -> Code:
    joined: Code = [*inside, (operation, 0.0)]
    return _folded(joined) if len(inside) == 1 else joined


def _folded(code: Code) -> Code:
    """One number instead of the code, where it reads nothing and has a value."""
    if any(operation == "read" for operation, _ in code):
        return code
    value = evaluated(code, ())
    return code if math.isnan(value) else [("push", value)]
