"""MathML says what the tree says: read back by its presentation alone it is the same formula."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest
from hypothesis import assume, example, given, settings
from strategies import trees
from sympy.core.basic import Basic

from sketch.formula.mathml import mathml, shown
from sketch.formula.names import LETTERS
from sketch.formula.parse import FormulaError, expression, parse

NAMESPACE = "{http://www.w3.org/1998/Math/MathML}"
SIGNS = {"−": "-", "·": "*", "\u2062": "*", "\u2061": "", "∑": "sum ", "°": "°"}


def spoken(element: ET.Element) -> str:
    """What a reader of the page would type, with every group in brackets."""
    tag = element.tag.removeprefix(NAMESPACE)
    parts = [spoken(child) for child in element]
    match tag:
        case "math" | "mrow":
            if parts and element[0].text in ("|", "‖"):
                return f"{'abs' if element[0].text == '|' else 'norm'}({''.join(parts[1:-1])})"
            return "".join(parts)
        case "mn":
            return element.text or ""
        case "mi":
            name = element.text or ""
            return (
                f"\\mathrm{{{name}}}" if element.get("mathvariant") == "normal" else LETTERS.get(name, name)
            )
        case "mo":
            return SIGNS.get(element.text or "", element.text or "")
        case "mspace":
            return " "
        case "mfrac":
            return f"(({parts[0]})/({parts[1]}))"
        case "msub":
            return f"{parts[0]}_{{{parts[1]}}}"
        case "msubsup":
            return f"{parts[0]}_{{{parts[1]}}}{parts[2]}"
        case "msup":
            return parts[0] + parts[1] if parts[1].startswith("′") else f"{parts[0]}^({parts[1]})"
        case "msqrt":
            return f"sqrt({parts[0]})"
        case _:
            assert tag == "mroot"
            return f"({parts[0]})^(1/{parts[1]})"


@settings(max_examples=100, deadline=None)
@given(trees)
@example(parse("sum(1 + pi) + sum(F_x) + sum(F_1 F_2)"))
def test_mathml_reads_back_as_the_same_tree(tree: Basic) -> None:
    text = spoken(ET.fromstring(mathml(tree)))
    try:
        assert parse(text) == tree
    except FormulaError as error:
        assume("at most" not in error.reason)
        raise


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("f_1 = |W| cos(theta)", "<msub><mi>f</mi><mrow><mn>1</mn></mrow></msub>"),
        ("theta = pi/6", "<mfrac><mrow><mi>π</mi></mrow><mrow><mn>6</mn></mrow></mfrac>"),
        ("m = 5 kg", '<mi mathvariant="normal">kg</mi>'),
        ("theta = 30°", "<mn>30</mn><mo>°</mo>"),
        ("x = sqrt(2)", "<msqrt>"),
        ("ΣF = m a", "<mo>∑</mo><mi>F</mi>"),
        ("v_1' = 2", "<msubsup><mi>v</mi><mrow><mn>1</mn></mrow><mo>′</mo></msubsup>"),
    ],
)
def test_mathml_is_what_a_browser_shows(text: str, holds: str) -> None:
    assert holds in mathml(parse(text))


def test_a_line_of_a_page_shows_its_decimals_as_they_were_written_and_nothing_where_it_is_no_formula() -> (
    None
):
    assert "<mn>0.5</mn>" in (shown(expression("mu = 0.5")) or "")
    assert "<mfrac>" in (shown(expression("mu = 1/2")) or "")
    assert shown(expression("((")) is None
