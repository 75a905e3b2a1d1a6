"""Angles that a page says and does not have are told, and none that it has."""

from __future__ import annotations

from math import cos, pi, sin

import pytest
from physics_junk import junk
from physics_pages import ball_on_incline, page, rectangle
from physics_workshop import angles_off, shaken, workshop

from physics.build import build
from physics.formula.meaning import read
from physics.parts.given import spoken
from physics.rectify import rectify
from physics.rectify.unmet import unmet
from sketch.page import Component, Sketch
from sketch.shapes import Circle, Polygon, Wire


def told(sketch: Sketch) -> tuple[str, ...]:
    return unmet(sketch, spoken(read(sketch)))


@pytest.mark.parametrize(
    ("written", "says"),
    [
        (
            "30",
            "is 30 radians, 1719°: the angle of an incline lies between 2° and 88°; write 30° for degrees",
        ),
        ("200°", "is 200°: the angle of an incline lies between 2° and 88°. The drawing keeps its own"),
        ("-pi/6", "is -0.5236 radians, -30°"),
        ("0", "lies between 2° and 88°"),
    ],
)
def test_an_angle_that_no_incline_has_is_told_with_what_would_be_right(written: str, says: str) -> None:
    sketch = ball_on_incline(written=written)
    corrected = rectify(sketch)
    assert corrected.sketch.component("A") == sketch.component("A")
    notices = build(corrected.sketch, corrected.meanings).notices
    assert any(says in notice for notice in notices), notices


def test_degrees_are_an_angle_like_any_other() -> None:
    corrected = rectify(ball_on_incline(written="30°", drawn=0.55))
    assert build(corrected.sketch, corrected.meanings).notices == ()
    assert {one.rule for one in corrected.corrections} == {"C3"}


def test_a_link_that_lies_otherwise_is_told_at_which_angle_it_lies() -> None:
    ceiling = Component(rectangle(100, 0, 300, 40), label="A", fixed=True)
    bob = Component(Circle((200 + 120 * sin(0.4), 40 + 120 * cos(0.4)), 20.0), label="B")
    end = (200 + 100 * sin(0.4), 40 + 100 * cos(0.4))
    wire = Component(Wire((200.0, 40.0), end), label="C", ends=("A", "B"))
    drawn = page((ceiling, bob, wire), (("theta = pi/6", "C", (200.0, 45.0)),))
    assert told(drawn) == ("theta = pi/6 of C does not hold: as it is drawn, its angle is 22.92°.",)
    assert told(rectify(drawn).sketch) == ()
    assert told(rectify(drawn, {("C5", "C")}).sketch) == told(drawn)
    steep = page((ceiling, bob, wire), (("theta = 100°", "C", (200.0, 45.0)),))
    (notice,) = told(steep)
    assert "the angle of a wire lies between 0° and 90°" in notice


def test_an_angle_of_what_is_no_incline_is_a_number_of_the_students_own() -> None:
    parts = (
        Component(Circle((100.0, 100.0), 30.0), label="A"),
        Component(Polygon([(300, 0), (400, 0), (400, 80), (300, 80)]), label="B"),
    )
    assert told(page(parts, (("theta = 40", "A", None), ("theta = 40", "B", None)))) == ()


@pytest.mark.parametrize("seed", range(10))
def test_nothing_is_told_of_a_page_whose_angles_hold(seed: int) -> None:
    corrected = rectify(shaken(workshop(seed), 1.5, seed)).sketch
    assert max(angles_off(corrected).values()) < 1e-9
    assert told(corrected) == ()


@pytest.mark.parametrize("seed", range(60))
def test_every_angle_of_a_link_on_a_junk_page_holds_or_is_told(seed: int) -> None:
    corrected = rectify(junk(seed)).sketch
    notices = told(corrected)
    for label, off in angles_off(corrected).items():
        part = corrected.component(label)
        joins = part.ends[0] is None or part.ends[0] != part.ends[1]
        if isinstance(part.shape, Wire) and joins and off > 1e-6 and abs(off - pi / 2) > 1e-6:
            assert any(f" of {label} does not hold" in notice for notice in notices), (label, off)
