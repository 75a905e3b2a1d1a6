"""Equations that are not solved for one quantity (row M11): what they give, and that they always end."""

from __future__ import annotations

import sys
import time
from math import asin, cos, pi, radians, sin, sqrt, tan

import pytest
from formula_pages import BALL, saying
from hypothesis import given, settings
from hypothesis import strategies as st
from physics_pages import page

from physics.build import build
from physics.formula.bounded import bounded
from physics.formula.meaning import Said, read
from sketch.page import Sketch

Remarks = list[tuple[str, str | None]]


def solved(sketch: Sketch) -> dict[str, Said]:
    return {said.name: said for said in read(sketch).said if said.solved}


@pytest.mark.parametrize(
    ("remarks", "name", "owner", "role", "value"),
    [
        ([("½mv² = mgh", "B"), ("h = 2 m", "B")], "v", "B", "speed", sqrt(2 * 9.81 * 2)),
        ([("½mv² = mgh", "B"), ("v = 3 m/s", "B")], "h", "B", "height", 9 / (2 * 9.81)),
        ([("F = m a", "C"), ("F = 10 N", "C"), ("m = 2 kg", "C")], "a", "C", "acceleration", 5),
        ([("F = 10 N", "C"), ("a = 4", "C"), ("F = m a", "C")], "m", "C", "mass", 2.5),
        ([("ΣF = ma", "C"), ("F_1 = 10", "C"), ("F_2 = -4", "C"), ("m = 2", "C")], "a", "C", "acceleration", 3),
        ([(r"\sum F_x = m a_x", "C"), ("F_1 = (10, 3)", "C"), ("m = 2", "C")], "a_x", "C", "a_x", 5),
        ([(r"\sum F_y = m a_y", "C"), ("F_1 = (10, 3)", "C"), ("m = 2", "C"), ("g = 10", None)], "a_y", "C", "a_y", -8.5),
        ([("m g sin(theta) = mu m g cos(theta)", "C"), ("theta = 30°", "F")], "mu", "C", "friction", tan(pi / 6)),
        ([("m g sin(theta) = 5 N", "C"), ("m = 1 kg", "C")], "theta", "C", "angle", asin(5 / 9.81)),
        ([("k x = m g", "C"), ("m = 1 kg", "C"), ("x = 10 cm", "E")], "k", "E", "stiffness", 98.1),
        ([("0 = h - 1/2 g t^2", "B"), ("h = 5 m", "B")], "t", "B", "time", sqrt(10 / 9.81)),
        ([("m_B v_B + m_C v_C = 4", None), ("m_B = 1", None), ("m_C = 2", None), ("v_C = 1", None)], "v", "B", "speed", 2),
        ([("1/2 k x^2 = 1/2 m v^2", "C"), ("k = 200", "E"), ("x = 0.1", "E"), ("m = 2", "C")], "v", "C", "speed", 1),
        ([("T sin(30°) = 5 N", "B")], "T", "D", "tension", 10),
        ([("m g = 20 N", "B"), ("g = 10", None)], "m", "B", "mass", 2),
        ([("m v_0^2 = 8", "B"), ("m = 2", "B")], "v_0", "B", "velocity", 2),
    ],
    ids=lambda value: value[0][0] if isinstance(value, list) else "",
)  # fmt: skip
def test_an_equation_gives_what_the_page_lacks(
    remarks: Remarks, name: str, owner: str, role: str, value: float
) -> None:
    sketch = saying(*remarks)
    found = solved(sketch)[name]
    assert found.component == owner
    assert found.quantity is not None
    assert found.quantity.role == role
    assert float(abs(found.tree)) == pytest.approx(abs(value), rel=1e-12)
    assert float(found.tree) == pytest.approx(value, rel=1e-12) or name == "v_0"
    assert any("gives" in notice for notice in read(sketch).notices)


def test_two_equations_give_two_tensions() -> None:
    alpha, beta, weight = radians(40), radians(65), 9.81
    sketch = saying(
        ("T_1 sin(alpha) + T_2 sin(beta) = W", "B"),
        ("T_1 cos(alpha) = T_2 cos(beta)", "B"),
        ("alpha = 40°", None),
        ("beta = 65°", None),
        ("m = 1 kg", "B"),
    )
    found = solved(sketch)
    assert float(found["T_1"].tree) == pytest.approx(weight * cos(beta) / sin(alpha + beta), rel=1e-12)
    assert float(found["T_2"].tree) == pytest.approx(weight * cos(alpha) / sin(alpha + beta), rel=1e-12)
    assert any("tap the wire" in notice for notice in read(sketch).notices)


def test_a_solved_value_governs_the_drawing() -> None:
    built = build(page((BALL,), (("m g = 20", "B", None), ("g = 10", None, None))))
    assert built.scene.body("B").mass == pytest.approx(2)
    built = build(saying(("k x = m g", "C"), ("m = 1", "C"), ("x = 0.1", "E")))
    assert built.scene.springs[0].stiffness == pytest.approx(98.1)


def test_a_speed_that_is_found_is_not_the_one_at_the_start() -> None:
    built = build(page((BALL,), (("½mv² = mgh", "B", None), ("h = 2", "B", None))))
    assert built.scene.body("B").velocity == (0, 0, 0)


def test_all_branches_are_told_and_the_possible_one_is_named() -> None:
    (notice,) = (
        n for n in read(saying(("x^2 = 4", "B"), ("½mv² = mgh", "B"), ("h = 2", "B"))).notices if "½" in n
    )
    assert "v of B = 6.264 m/s (also v of B = -6.264 m/s" in notice
    (notice,) = read(saying(("e^2 + e = 6", "B"))).notices
    assert "cannot be" in notice


@pytest.mark.parametrize(
    ("remarks", "says"),
    [
        ([("m g = 19.62 N", "B"), ("m = 2", "B")], "holds on this page"),
        ([("m g = 25 N", "B"), ("m = 2", "B")], "off by 21.5%"),
        ([("½mv² = mgh", "B"), ("v = 2", "B"), ("h = 0.2", "B")], "off by 1.9%"),
        ([("½mv² = mgh", "B")], "v of B are lacking"),
        ([("x^2 = -4", "B")], "no real numbers"),
        ([("x^5 - x = cos(x)", "B")], "cannot be solved here"),
        ([("(F, 0) + (1, 2) = (3, 4) t", "B")], "one for x and one for y"),
        ([("ΣF = m a", None)], "tap the body"),
        ([("Σq = m a", "B")], "write ΣF"),
        ([("m a = a b c d h j k L", "B")], "lacking"),
        ([("q + 1 = 2 + u", "B"), ("q = u", "B"), ("u = q", "B")], "defined by itself"),
    ],
    ids=lambda value: value[0][0] if isinstance(value, list) else "",
)  # fmt: skip
def test_what_gives_nothing_is_explained(remarks: Remarks, says: str) -> None:
    notices = read(saying(*remarks)).notices
    assert any(says in notice for notice in notices), notices


def test_work_without_end_is_stopped_and_leaves_no_trace() -> None:
    def forever() -> None:
        while True:
            len("")

    before = sys.getprofile()
    started = time.perf_counter()
    assert bounded(forever, calls=100_000, seconds=10.0) is None
    assert time.perf_counter() - started < 5
    assert bounded(forever, calls=10**12, seconds=0.05) is None
    assert bounded(lambda: 7, calls=100, seconds=1.0) == 7
    assert sys.getprofile() is before


@pytest.mark.parametrize(
    "text",
    [
        "sin(x) + cos(x) exp(x) = ln(x + 2)^3",
        "x^9 + sin(x^7) = exp(x)^x",
        "tan(x) tan(2x) tan(3x) = x^7",
        "sqrt(x + sqrt(x + sqrt(x + sqrt(x + 1)))) = x^(1/7)",
        "exp(exp(exp(x))) = x^x^x",
        "a^b + b^c = c^a",
        "|x|^|x - 1|^|x - 2| = 3",
    ],
)
def test_no_equation_keeps_a_page_waiting(text: str) -> None:
    started = time.process_time()
    meanings = read(saying((text, "B")))
    assert time.process_time() - started < 6
    assert meanings.notices


@settings(max_examples=30, deadline=None)
@given(st.floats(0.1, 50), st.floats(0.1, 50), st.floats(1, 20))
def test_what_is_solved_for_satisfies_the_equation(mass: float, height: float, g: float) -> None:
    sketch = saying(
        ("½mv² = mgh", "B"), (f"m = {mass:.6f}", "B"), (f"h = {height:.6f}", "B"), (f"g = {g:.6f}", None)
    )
    speed = float(solved(sketch)["v"].tree)
    assert speed**2 / 2 == pytest.approx(round(g, 6) * round(height, 6), rel=1e-12)
