"""Pictures of pages: well-formed whatever the page holds, and showing what it holds."""

from __future__ import annotations

import math
import re

import defusedxml.ElementTree
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import sketches

from sketch import svg
from sketch.figures import COLOURS, Pen, Pose, coil, draw_shapes, posed
from sketch.formula.parse import expression
from sketch.geometry import solid_area
from sketch.ink import Ink, Stroke
from sketch.page import Association, Component, Sketch
from sketch.shapes import Circle, Point, Polygon, Solid, Spring, Wire

SVG = "{http://www.w3.org/2000/svg}"
TRIANGLE = Polygon([[0, 0], [80, 0], [0, 60]])


@settings(max_examples=80, deadline=None)
@given(sketches())
def test_any_page_gives_well_formed_xml_with_finite_numbers(sketch: Sketch) -> None:
    picture = svg.draw(sketch)
    root = defusedxml.ElementTree.fromstring(picture)
    assert root.tag == f"{SVG}svg"
    assert len(root.findall(f"{SVG}g")) == len(sketch.components)
    numbers = re.compile(r'[ "](nan|-?inf)')
    assert not any(
        numbers.search(f" {value}") for element in root.iter() for value in element.attrib.values()
    )


def test_text_is_escaped() -> None:
    text = '<script>"&\x00</script>'
    page = Sketch(expressions=(expression(text, at=(1, 2)),), components=(Component(TRIANGLE, label=text),))
    root = defusedxml.ElementTree.fromstring(svg.draw(page))
    written = [element.text for element in root.iter(f"{SVG}text")]
    assert written == [text.replace("\x00", "\ufffd"), None]  # the formula's own text follows its title
    assert not list(root.iter("script"))


def test_an_empty_page_and_one_dot_have_a_picture() -> None:
    for sketch in (Sketch(), Sketch(Ink((Stroke([[5, 5]]),))), Sketch(Ink((Stroke([[1e9, -1e9]]),)))):
        root = defusedxml.ElementTree.fromstring(svg.draw(sketch))
        width, height = (float(value) for value in root.attrib["viewBox"].split()[2:])
        assert width > 0
        assert height > 0


def test_the_view_holds_all_ink_and_shapes() -> None:
    page = Sketch(Ink((Stroke([[-50, 3], [4, 500]]),)), (Component(Circle((700, 0), 30)),))
    left, top, width, height = svg.view_of(page)
    assert left < -50
    assert top < -30
    assert left + width > 730
    assert top + height > 500


def test_recognized_shapes_lie_over_the_ink_and_formulas_over_both() -> None:
    page = Sketch(
        Ink((Stroke([[0, 0], [9, 9]]),)),
        (Component(Circle((5, 5), 4), (0,)),),
        (expression("theta = pi/6", at=(0, 0)),),
        (Association(0, "A", (5, 5)),),
    )
    picture = svg.draw(page)
    places = [
        picture.index(part) for part in (svg.LOOK.ink, COLOURS["circle"], "stroke-dasharray", "theta = pi/6")
    ]
    assert places == sorted(places)


def test_an_unread_formula_is_drawn_as_a_problem_and_tells_it() -> None:
    picture = svg.draw(Sketch(expressions=(expression("g = "),)))
    assert svg.LOOK.problem in picture
    assert "the formula ends" in picture


def test_only_fixed_solids_are_hatched_and_inside_their_outline() -> None:
    pen = Pen(1.0)
    loose, fixed = (
        draw_shapes([Component(TRIANGLE, fixed=fixed)], pen, names=False) for fixed in (False, True)
    )
    assert loose.count("<path") == 1
    assert fixed.count("<path") == 2
    hatch = re.findall(r'd="([^"]*)"', fixed)[1]
    for x, y in re.findall(r"(-?[\d.]+) (-?[\d.]+)", hatch):
        assert float(x) >= -0.01
        assert float(y) >= -0.01
        assert float(x) / 80 + float(y) / 60 <= 1.001


@given(st.integers(1, 30), st.floats(1, 50), st.floats(0, 6.3), st.floats(10, 300))
def test_a_coil_has_the_spring_s_ends_width_and_teeth(
    coils: int, width: float, angle: float, length: float
) -> None:
    end = (length * math.cos(angle), length * math.sin(angle))
    path = coil(Spring((0.0, 0.0), end, coils, width))
    assert path[0] == pytest.approx([0, 0])
    assert path[-1] == pytest.approx(list(end))
    axis = np.array(end) / length
    across = path @ np.array([-axis[1], axis[0]])
    assert np.ptp(across) == pytest.approx(width)
    inner = across[np.abs(across) > width / 4]
    assert np.count_nonzero(np.diff(np.sign(inner))) == 2 * coils - 1


@given(
    st.sampled_from([TRIANGLE, Circle((3, 4), 5)]),
    st.floats(-100, 100),
    st.floats(-100, 100),
    st.floats(-7, 7),
)
def test_a_pose_is_a_rigid_motion(solid: Solid, dx: float, dy: float, rotation: float) -> None:
    moved = posed(solid, Pose(dx, dy, rotation))
    assert solid_area(moved) == pytest.approx(solid_area(solid))
    if isinstance(moved, Polygon) and isinstance(solid, Polygon):
        sides = [np.linalg.norm(np.roll(p.vertices, 1, axis=0) - p.vertices, axis=1) for p in (moved, solid)]
        assert sides[0] == pytest.approx(sides[1])
        assert moved.vertices.mean(axis=0) - solid.vertices.mean(axis=0) == pytest.approx([dx, dy])


def test_poses_and_ends_place_what_moves() -> None:
    ends: tuple[Point, Point] = ((1.0, 2.0), (3.0, 4.0))
    parts = [Component(Circle((0, 0), 5), label="A"), Component(Wire((0, 0), (9, 9)), label="B")]
    drawn = draw_shapes(parts, Pen(1.0), {"A": Pose(10, 20, math.pi / 2)}, {"B": ends}, names=False)
    assert 'cx="10" cy="20"' in drawn
    assert "M10 20L10 25" in drawn  # the spoke, a quarter turn clockwise from +x
    assert "M1 2L3 4" in drawn
    assert drawn.index("M1 2L3 4") < drawn.index('cx="10"')  # links below solids
