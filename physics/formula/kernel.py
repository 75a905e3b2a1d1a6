"""Postfix programs (physics.formula.program) evaluated inside numba kernels.

All programs of a scene lie in flat arrays, one after the other: instruction k is the opcode `ops[k]`;
a push pushes `args[k]`, a read reads quantity `args[k]` of `STATE` of body `who[k]`. Program p runs
from `spans[p, 0]` up to `spans[p, 1]`.

State: t, s; pos and vel, (n, 3) x, y, angle of every body and their rates, SI, y up.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from physics.formula.program import BINARY, STATE, UNARY, Program
from physics.jit import kernel, part
from sketch.ink import FloatArray

IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

# A kernel sees these as constants, and its chains of ifs become jump tables.
PUSH, READ = 0, 1
ADD, MULTIPLY, POWER, ATAN2, MIN, MAX = 2, 3, 4, 5, 6, 7
SIN, COS, TAN, COT, SEC, CSC = 8, 9, 10, 11, 12, 13
ASIN, ACOS, ATAN, SINH, COSH, TANH = 14, 15, 16, 17, 18, 19
EXP, LOG, SQRT, INVERT = 20, 21, 22, 23
ABS, SIGN, FLOOR, CEILING = 24, 25, 26, 27

OPERATIONS: dict[str, int] = {
    "push": PUSH,
    "read": READ,
    "add": ADD,
    "multiply": MULTIPLY,
    "power": POWER,
    "atan2": ATAN2,
    "min": MIN,
    "max": MAX,
    "sin": SIN,
    "cos": COS,
    "tan": TAN,
    "cot": COT,
    "sec": SEC,
    "csc": CSC,
    "asin": ASIN,
    "acos": ACOS,
    "atan": ATAN,
    "sinh": SINH,
    "cosh": COSH,
    "tanh": TANH,
    "exp": EXP,
    "log": LOG,
    "sqrt": SQRT,
    "invert": INVERT,
    "abs": ABS,
    "sign": SIGN,
    "floor": FLOOR,
    "ceiling": CEILING,
}
"""Name of an operation -> opcode."""

SWITCHES = frozenset({"abs", "sign", "min", "max", "floor", "ceiling"})
"""Operations that decide between branches, where a formula is not smooth."""

NO_VALUE = -1
"""What `branches` gives where a program that has branches has no value."""

_MIX = 0x5851F42D4C957F2D
"""An odd number without pattern (Knuth's MMIX multiplier): two lists of decisions differ in their hash."""
_EXACT = 2.0**62
"""Sizes beyond this are not converted to integers."""


@dataclass(frozen=True, slots=True, eq=False)
class Packed:
    """Programs for the kernels. ops, args, who: (k,), see above; spans: (p, 2); depth: the stack that the
    deepest needs; switches: (p,) whether a program has branches at all."""

    ops: IntArray
    args: FloatArray
    who: IntArray
    spans: IntArray
    depth: int
    switches: BoolArray


def pack(bound: Sequence[tuple[Program, int, tuple[int, ...]]]) -> Packed:
    """One program after the other. bound: a program, its own body's index, those of `program.others`.

    Raises ValueError for code that is no postfix program, since a kernel trusts what it is given.
    """
    ops: list[int] = []
    args: list[float] = []
    who: list[int] = []
    spans: list[tuple[int, int]] = []
    switches: list[bool] = []
    depth = 1
    for program, own, others in bound:
        start, bodies = len(ops), (own, *others)
        depth = max(depth, _depth(program, len(bodies)))
        for operation, operand in program.code:
            body = 0
            if operation == "read":
                index, operand = divmod(operand, len(STATE))
                body = bodies[int(index)]
            ops.append(OPERATIONS[operation])
            args.append(operand)
            who.append(body)
        spans.append((start, len(ops)))
        switches.append(any(operation in SWITCHES for operation, _ in program.code))
    return Packed(
        np.array(ops, dtype=np.int64),
        np.array(args, dtype=np.float64),
        np.array(who, dtype=np.int64),
        np.array(spans, dtype=np.int64).reshape(-1, 2),
        depth,
        np.array(switches, dtype=np.bool_),
    )


def _depth(program: Program, bodies: int) -> int:
    """The highest that its stack grows."""
    height = most = 0
    for operation, operand in program.code:
        if operation not in OPERATIONS:
            raise ValueError(
                f"the code of {program.text!r} has an operation {operation!r}, which is not known"
            )
        if operation == "read" and not 0 <= operand < bodies * len(STATE):
            raise ValueError(f"the code of {program.text!r} reads quantity {operand:g}, which is not there")
        needs = 2 if operation in BINARY else 1 if operation in UNARY else 0
        if height < needs:
            break
        height += 1 - needs
        most = max(most, height)
    else:
        if height == 1:
            return most
    raise ValueError(f"the code of {program.text!r} does not leave one value")


@kernel
def evaluate(
    ops: IntArray,
    args: FloatArray,
    who: IntArray,
    start: int,
    stop: int,
    t: float,
    pos: FloatArray,
    vel: FloatArray,
    stack: FloatArray,
) -> float:
    """The value of the program from start up to stop; NaN where it has none. stack: scratch, at least
    `Packed.depth` long."""
    if stop - start == 1 and ops[start] == PUSH:
        return args[start] if np.isfinite(args[start]) else np.nan
    top = -1
    for k in range(start, stop):
        op = ops[k]
        if op <= READ:
            top += 1
            value = args[k] if op == PUSH else _read(int(args[k]), who[k], t, pos, vel)
        elif op <= MAX:
            top -= 1
            value = _binary(op, stack[top], stack[top + 1])
        else:
            value = _unary(op, stack[top])
        if not np.isfinite(value):
            return np.nan
        stack[top] = value
    return stack[0]


@kernel
def branches(
    ops: IntArray,
    args: FloatArray,
    who: IntArray,
    start: int,
    stop: int,
    t: float,
    pos: FloatArray,
    vel: FloatArray,
    stack: FloatArray,
) -> int:
    """A hash of what every abs, sign, min, max, floor and ceiling of the program decides: it changes
    where the formula goes over to another branch. 0 without any; `NO_VALUE` without a value."""
    signature = 0
    top = -1
    for k in range(start, stop):
        op = ops[k]
        if op <= READ:
            top += 1
            value = args[k] if op == PUSH else _read(int(args[k]), who[k], t, pos, vel)
        elif op <= MAX:
            top -= 1
            if op >= MIN:
                chosen = _second(op, stack[top], stack[top + 1])
                signature = (signature + (2 if chosen else 1)) * _MIX
            value = _binary(op, stack[top], stack[top + 1])
        else:
            if op >= ABS:
                signature = (signature + _decision(op, stack[top])) * _MIX
            value = _unary(op, stack[top])
        if not np.isfinite(value):
            return NO_VALUE if signature != 0 else 0
        stack[top] = value
    return signature


@part
def _read(quantity: int, body: int, t: float, pos: FloatArray, vel: FloatArray) -> float:
    if quantity == 0:
        return t
    if quantity <= 3:
        return pos[body, quantity - 1]
    if quantity <= 5:
        return vel[body, quantity - 4]
    if quantity == 6:
        return math.hypot(vel[body, 0], vel[body, 1])
    return vel[body, 2]


@part
def _second(op: int, a: float, b: float) -> bool:
    """Whether min or max takes its second argument."""
    return b < a if op == MIN else b > a


@part
def _decision(op: int, a: float) -> int:
    if op == ABS:
        return 1 if a < 0 else 2
    if op == SIGN:
        return 1 if a < 0 else 3 if a > 0 else 2
    whole = np.floor(a) if op == FLOOR else np.ceil(a)
    return int(min(max(whole, -_EXACT), _EXACT))


@part
def _binary(op: int, a: float, b: float) -> float:
    if op == ADD:
        return a + b
    if op == MULTIPLY:
        return a * b
    if op == POWER:
        return a * a if b == 2.0 else a**b
    if op == ATAN2:
        return math.atan2(a, b)
    return b if _second(op, a, b) else a


@part
def _unary(op: int, a: float) -> float:
    if op == SIN:
        return math.sin(a)
    if op == COS:
        return math.cos(a)
    if op == TAN:
        return math.tan(a)
    if op == COT:
        return 1 / math.tan(a)
    if op == SEC:
        return 1 / math.cos(a)
    if op == CSC:
        return 1 / math.sin(a)
    if op == ASIN:
        return math.asin(a)
    if op == ACOS:
        return math.acos(a)
    if op == ATAN:
        return math.atan(a)
    if op == SINH:
        return math.sinh(a)
    if op == COSH:
        return math.cosh(a)
    if op == TANH:
        return math.tanh(a)
    if op == EXP:
        return math.exp(a)
    if op == LOG:
        return math.log(a)
    if op == SQRT:
        return math.sqrt(a)
    if op == INVERT:
        return 1 / a
    if op == ABS:
        return abs(a)
    if op == SIGN:
        return 1.0 if a > 0 else -1.0 if a < 0 else 0.0
    if op == FLOOR:
        return np.floor(a) + 0.0  # no -0.0: Python's integers have none
    return np.ceil(a) + 0.0
