"""The postfix programs, in Python and in the kernel, against SymPy; and what they must never do."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from physics.formula.kernel import NO_VALUE, OPERATIONS, branches, evaluate, pack
from physics.formula.program import (
    BINARY,
    STATE,
    UNARY,
    Program,
    ProgramError,
    Reading,
    compile_tree,
    constant,
)
from physics.formula.skeleton import part_of
from sketch.formula.parse import parse

T, X, V = sympy.Symbol("t"), sympy.Symbol("x"), sympy.Symbol("v_x")
A, B = sympy.Symbol("a"), sympy.Symbol("b")
GIVEN = {"a": 1.3, "b": -0.7}
LEAVES = st.sampled_from([T, X, V, A, B, sympy.pi, sympy.Integer(2), sympy.Rational(-3, 4), sympy.Float(0.3)])


def _grown(inner: st.SearchStrategy[sympy.Basic]) -> st.SearchStrategy[sympy.Basic]:
    one = st.sampled_from(
        [sympy.sin, sympy.cos, sympy.tan, sympy.exp, sympy.Abs, sympy.sqrt, sympy.log, sympy.atan, sympy.asin]
    )
    return st.one_of(
        st.builds(lambda f, a: f(a), one, inner),
        st.builds(lambda a, b: a + b, inner, inner),
        st.builds(lambda a, b: a * b, inner, inner),
        st.builds(lambda a, b: a / b, inner, inner),
        st.builds(lambda a, n: a**n, inner, st.integers(-3, 3)),
    )


TREES = st.recursive(LEAVES, _grown, max_leaves=8)


def lookup(name: str) -> float | None:
    return GIVEN.get(name)


def state(t: float, x: float, v: float) -> list[float]:
    values = dict.fromkeys(STATE, 0.0) | {"t": t, "x": x, "v_x": v}
    return [values[name] for name in STATE]


def in_kernel(program: Program, t: float, *bodies: tuple[float, ...]) -> tuple[float, int]:
    """Value and branches for the motion (x, y, angle, their rates) of its own body and the others."""
    packed = pack([(constant(7.0), 0, ()), (program, 0, tuple(range(1, len(bodies))))])
    start, stop = packed.spans[1]
    motion = np.array(bodies, dtype=float)
    pos, vel, stack = motion[:, :3].copy(), motion[:, 3:].copy(), np.zeros(packed.depth)
    given = (packed.ops, packed.args, packed.who, start, stop, t, pos, vel, stack)
    return evaluate(*given), branches(*given)


def in_python(program: Program, t: float, *bodies: tuple[float, ...]) -> float:
    values: list[float] = []
    for x, y, phi, v_x, v_y, omega in bodies:
        values += [t, x, y, phi, v_x, v_y, math.hypot(v_x, v_y), omega]
    return program.value(values)


@settings(max_examples=200, deadline=None)
@given(TREES, st.floats(-2, 2), st.floats(-2, 2), st.floats(-2, 2))
def test_a_program_has_the_value_that_sympy_gives_its_tree(
    tree: sympy.Basic, t: float, x: float, v: float
) -> None:
    try:
        program = compile_tree(tree, lookup)
    except ProgramError:
        return
    found = program.value(state(t, x, v))
    assert isinstance(found, float)
    assert not math.isinf(found)
    wanted = sympy.N(tree.subs({T: t, X: x, V: v, A: GIVEN["a"], B: GIVEN["b"]}), 30)
    if math.isnan(found) or not wanted.is_real or not wanted.is_finite:
        return
    assert found == pytest.approx(float(wanted), rel=1e-6, abs=1e-9)


@pytest.mark.parametrize(
    "text",
    [
        "x/x",
        "1/x",
        "sqrt(-1 - x)",
        "log(x)",
        "exp(1000 + x)",
        "10^(400 + x)",
        "asin(2 + x)",
        "(-1 + x)^(1/2)",
    ],
)
def test_what_has_no_value_is_not_a_number_and_never_an_exception(text: str) -> None:
    tree = parse(f"f = {text}").args[1]
    found = compile_tree(tree, lookup).value(state(0.0, 0.0, 0.0))
    # SymPy itself cancels x/x to 1 while the tree is built.
    assert math.isnan(found) or text == "x/x"


def test_constants_are_folded_to_a_single_number() -> None:
    tree = parse("f_1 = 0.9 |W| cos(theta)").args[1]
    program = compile_tree(tree, {"W": 19.62, "theta": sympy.pi / 6}.get)
    assert program.code == (("push", pytest.approx(0.9 * 19.62 * math.cos(math.pi / 6), rel=1e-15)),)
    assert program.constant


def test_names_that_nobody_gives_count_as_zero_and_are_listed() -> None:
    program = compile_tree(parse("f = k x + mu").args[1], lambda _: None)
    assert program.unspecified == ("k", "mu") or program.unspecified == ("mu", "k")
    assert program.value(state(1.0, 5.0, 0.0)) == 0.0
    assert not program.constant


def test_definitions_are_followed_through_definitions() -> None:
    names = {"f": parse("f = 2 h").args[1], "h": parse("h = t + a").args[1], "a": 3.0}
    assert compile_tree(sympy.Symbol("f"), names.get).value(state(4.0, 0, 0)) == 14.0


def test_a_definition_that_goes_round_in_a_circle_is_refused() -> None:
    names = {"a": sympy.Symbol("b") + 1, "b": sympy.Symbol("a") * 2}
    with pytest.raises(ProgramError, match="defined by itself"):
        compile_tree(sympy.Symbol("a"), names.get)


def test_what_is_no_number_is_refused() -> None:
    for tree in (sympy.Tuple(1, 2), sympy.true, sympy.Function("h")(T), sympy.I):
        with pytest.raises(ProgramError):
            compile_tree(tree, lambda _: None)


def test_a_program_is_a_value_that_can_be_written_by_hand() -> None:
    program = Program("t + 1", (("read", 0.0), ("push", 1.0), ("add", 0.0)))
    assert program.value([2.0]) == 3.0


IN_SYMPY = {
    "add": sympy.Add,
    "multiply": sympy.Mul,
    "power": sympy.Pow,
    "min": sympy.Min,
    "max": sympy.Max,
    "invert": lambda a: 1 / a,
    "abs": sympy.Abs,
}
NUMBERS = (-1e200, -7.25, -2.0, -1.0, -0.3, 0.0, 1e-9, 0.5, 1.0, 1.7, 2.0, 3.0, 20.5, 800.0, 1e200)


def same(a: float, b: float) -> bool:
    return (math.isnan(a) and math.isnan(b)) or a == pytest.approx(b, rel=1e-15, abs=0)


def as_sympy_says(operation: str, *numbers: float) -> float:
    """Its value in 40 digits; NaN where it is not a real number that a float can hold."""
    function = IN_SYMPY.get(operation) or getattr(sympy, operation)
    value = sympy.N(function(*(sympy.Rational(number) for number in numbers)), 40)
    if not (value.is_real and value.is_finite):
        return math.nan
    found = float(value)
    return found if math.isfinite(found) else math.nan


@given(TREES, st.sampled_from([2.5, None, X * B, sympy.Symbol("c")]))
def test_what_is_remembered_of_a_tree_says_nothing_of_its_names(
    tree: sympy.Basic, meaning: float | sympy.Basic | None
) -> None:
    def other(name: str) -> float | sympy.Basic | None:
        return meaning if name == "a" else lookup(name)

    def programs() -> list[Program | str]:
        made: list[Program | str] = []
        for names in (lookup, other, lookup):
            try:
                made.append(compile_tree(tree, names))
            except ProgramError as error:
                made.append(str(error))
        return made

    before = programs()
    part_of.cache_clear()
    assert repr(programs()) == repr(before)
    assert repr(before[0]) == repr(before[2])


@pytest.mark.parametrize("operation", UNARY)
def test_every_operation_on_one_number_is_the_kernel_s_and_sympy_s(operation: str) -> None:
    program = Program(operation, (("read", 1.0), (operation, 0.0)))
    for x in NUMBERS:
        body = (x, 0, 0, 0, 0, 0)
        found = in_python(program, 0, body)
        assert same(in_kernel(program, 0, body)[0], found), x
        # The tangent of a number of 200 digits would be as good as any.
        if abs(x) < 1e100:
            wanted = as_sympy_says(operation, x)
            assert (math.isnan(found) and math.isnan(wanted)) or found == pytest.approx(wanted, rel=1e-14), x


@pytest.mark.parametrize("operation", BINARY)
def test_every_operation_on_two_numbers_is_the_kernel_s_and_sympy_s(operation: str) -> None:
    program = Program(operation, (("read", 1.0), ("read", 2.0), (operation, 0.0)))
    for x in NUMBERS:
        for y in NUMBERS:
            body = (x, y, 0, 0, 0, 0)
            found = in_python(program, 0, body)
            assert same(in_kernel(program, 0, body)[0], found), (x, y)
            if operation == "atan2" and x == y == 0:  # of no direction: IEEE 754 says 0
                assert found == 0
            elif operation != "power" or (abs(x) < 1e100 and abs(y) < 1000):
                wanted = as_sympy_says(operation, x, y)
                assert (math.isnan(found) and math.isnan(wanted)) or found == pytest.approx(wanted, rel=1e-14)


def test_the_kernel_has_every_operation_under_a_number_of_its_own() -> None:
    assert set(OPERATIONS) == {"push", "read", *BINARY, *UNARY}
    assert len(set(OPERATIONS.values())) == len(OPERATIONS)


@pytest.mark.parametrize("quantity", STATE)
def test_the_kernel_reads_every_quantity_of_its_own_and_of_other_bodies(quantity: str) -> None:
    own, other, third = (1.0, 2, 3, 4, 5, 6), (-1.5, 7, 8, 9, 10, 11), (12.0, 13, 14, 15, 16, 17)
    names = {"p": Reading(quantity, "B"), "q": Reading(quantity, "C"), "r": Reading("x", "B")}
    tree = sympy.Symbol(quantity) + 100 * sympy.Symbol("p") + 10000 * sympy.Symbol("q") + sympy.Symbol("r")
    program = compile_tree(tree, names.get)
    assert set(program.others) == {"B", "C"}
    other, third = (other, third) if program.others == ("B", "C") else (third, other)
    value = in_python(program, 0.5, own, other, third)
    assert value == in_kernel(program, 0.5, own, other, third)[0]
    column = {"x": 0, "y": 1, "phi": 2, "v_x": 3, "v_y": 4, "omega": 5}.get(quantity)
    if column is not None:
        assert value == own[column] + 100 * (-1.5, 7, 8, 9, 10, 11)[column] + 10000 * (12 + column) - 1.5


def test_only_what_a_motion_has_can_be_read_of_another_body() -> None:
    with pytest.raises(ProgramError, match="mass"):
        Reading("mass", "B")


@settings(max_examples=200, deadline=None)
@given(TREES, st.tuples(*[st.floats(-3, 3)] * 6), st.floats(0, 10))
def test_the_kernel_has_the_value_that_python_has(
    tree: sympy.Basic, body: tuple[float, ...], t: float
) -> None:
    try:
        program = compile_tree(tree, lookup)
    except ProgramError:
        return
    assert same(in_kernel(program, t, body)[0], in_python(program, t, body))


@pytest.mark.parametrize(
    ("text", "decide"),
    [
        ("|x|", lambda p: p[0] < 0),
        ("x |x - y| + |y|", lambda p: (p[0] < p[1], p[1] < 0)),
        ("3 sin(|x|)", lambda p: p[0] < 0),
    ],
)
def test_branches_change_where_and_only_where_a_formula_goes_over(text: str, decide: object) -> None:
    assert callable(decide)
    _law(compile_tree(parse(f"f = {text}").args[1], lambda _: None), decide)


X_Y = (("read", 1.0), ("read", 2.0))


@pytest.mark.parametrize(
    ("code", "decide"),
    [
        ((X_Y[0], ("sign", 0.0)), lambda p: np.sign(p[0])),
        ((*X_Y, ("min", 0.0)), lambda p: p[1] < p[0]),
        ((*X_Y, ("max", 0.0)), lambda p: p[1] > p[0]),
        ((X_Y[0], ("floor", 0.0)), lambda p: math.floor(p[0])),
        ((X_Y[0], ("ceiling", 0.0), X_Y[1], ("floor", 0.0), ("multiply", 0.0)),
         lambda p: (math.ceil(p[0]), math.floor(p[1]))),
        ((*X_Y, ("min", 0.0), ("abs", 0.0)), lambda p: (p[1] < p[0], min(p) < 0)),
    ],
)  # fmt: skip
def test_branches_change_where_and_only_where_an_operation_decides_otherwise(
    code: tuple[tuple[str, float], ...], decide: object
) -> None:
    assert callable(decide)
    _law(Program("", code), decide)


def _law(program: Program, decide: object) -> None:
    """Two points of a grid have one signature just when all decisions are the same at both."""
    assert callable(decide)
    grid = [(x / 4, y / 4) for x in range(-9, 10) for y in range(-9, 10)]
    signatures = [in_kernel(program, 0.0, (x, y, 0, 0, 0, 0))[1] for x, y in grid]
    decisions = [decide(point) for point in grid]
    assert len(set(signatures)) == len(set(decisions)) == len(set(zip(signatures, decisions, strict=True)))


def test_a_formula_without_branches_has_signature_zero_and_says_so() -> None:
    smooth = compile_tree(parse("f = sin(x) / y").args[1], lambda _: None)
    broken = compile_tree(parse("f = |x| / y").args[1], lambda _: None)
    assert in_kernel(smooth, 0, (1, 1, 0, 0, 0, 0))[1] == 0
    assert in_kernel(smooth, 0, (1, 0, 0, 0, 0, 0))[1] == 0
    assert in_kernel(broken, 0, (1, 1, 0, 0, 0, 0))[1] != 0
    assert list(pack([(smooth, 0, ()), (broken, 0, ())]).switches) == [False, True]
    assert (
        in_kernel(Program("", (("read", 1.0), ("abs", 0.0), ("log", 0.0))), 0, (0, 0, 0, 0, 0, 0))[1]
        == NO_VALUE
    )


def test_code_that_a_kernel_could_not_trust_is_refused_when_it_is_packed() -> None:
    push = ("push", 1.0)
    for code in (
        (),
        (("add", 0.0),),
        (push, push),
        (push, ("add", 0.0)),
        (push, ("gamma", 0.0)),
        (("read", 8.0),),
    ):
        with pytest.raises(ValueError, match="code of 'f'"):
            pack([(Program("f", code), 0, ())])


def test_no_programs_pack_to_nothing() -> None:
    packed = pack([])
    assert packed.spans.shape == (0, 2)
    assert packed.depth == 1
