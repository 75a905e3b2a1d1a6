"""How far apart two convex solids are, against Shapely, and by the laws that a gap has."""

from __future__ import annotations

from math import cos, hypot, pi, sin

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from shapely import Polygon as Region
from shapely.affinity import translate

from physics.rectify.separation import apart, boxes_apart, outline_of
from sketch.shapes import Polygon


@st.composite
def blocks(draw: st.DrawFn) -> Polygon:
    """Convex: the corners of a regular block of three to eight, stretched, turned and put somewhere."""
    count = draw(st.integers(3, 8))
    wide, high = draw(st.floats(5, 200)), draw(st.floats(5, 200))
    turned, x, y = draw(st.floats(0, 2 * pi)), draw(st.floats(-300, 300)), draw(st.floats(-300, 300))
    flat = [(wide * cos(2 * pi * k / count), high * sin(2 * pi * k / count)) for k in range(count)]
    return Polygon(
        [(x + cos(turned) * u - sin(turned) * v, y + sin(turned) * u + cos(turned) * v) for u, v in flat]
    )


HARDLY_BESIDE = (
    Polygon([(-4.11392876, -2.34175828), (9.41699677, -8.73402038), (-5.30306801, 12.57577866)]),
    Polygon([(-31.7, 276.1), (-8.5, 276.4), (23.2, 298.3), (31.7, 319.9), (8.5, 319.6), (-23.2, 297.7)]),
)
"""A corner that lies just beside the face that it seems to be nearest to."""


@given(blocks(), blocks())
@example(*HARDLY_BESIDE)
def test_the_gap_of_two_blocks_is_their_distance_and_no_less_than_that_of_their_boxes(
    one: Polygon, other: Polygon
) -> None:
    gap, (x, y) = apart(one, other)
    distance = Region(one.vertices).distance(Region(other.vertices))
    assert hypot(x, y) == pytest.approx(1)
    assert max(gap, 0.0) == pytest.approx(distance, abs=1e-7)
    assert gap >= boxes_apart(outline_of(one), outline_of(other)) - 1e-9


@given(blocks(), blocks())
def test_moved_by_the_gap_along_its_direction_two_blocks_just_touch(one: Polygon, other: Polygon) -> None:
    gap, (x, y) = apart(one, other)
    here, there = Region(one.vertices), translate(Region(other.vertices), -gap * x, -gap * y)
    assert here.distance(there) == pytest.approx(0, abs=1e-6)
    assert here.intersection(there).area <= 1e-6 * (here.area + there.area)


@given(blocks(), blocks())
def test_a_gap_is_the_same_either_way_round(one: Polygon, other: Polygon) -> None:
    assert apart(one, other)[0] == pytest.approx(apart(other, one)[0], abs=1e-9)
