"""Laws of how shapes are divided into strokes."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from data_gen import drawing
from data_gen.writers import sample_writer
from sketch.geometry import contains, diagonal, resample, self_intersections, signed_area
from sketch.ink import Stroke
from sketch.shapes import Arrow, Circle, Polygon, Spring, Wire, outline

SHAPES = [
    Circle((100, 80), 30),
    Polygon([(0, 0), (200, 0), (200, 120), (0, 120)]),
    Polygon([(0, 200), (300, 200), (300, 30)]),
    Spring((50, 50), (50, 170), 6, 24),
    Wire((10, 10), (150, 110)),
    Arrow((10, 10), (150, 110)),
]
SEEDS = range(60)


def draw(shape, seed, **habits):
    rng = np.random.default_rng([4, seed])
    return drawing.paths(shape, replace(sample_writer(rng), **habits), rng)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_what_is_meant_covers_the_whole_shape_and_nothing_else(shape):
    """Within the largest slips: a twelfth of the shape's size, and half a spring's width."""
    ideal = resample(outline(shape), 200)
    slack = diagonal(ideal) / 12 + (shape.width * 0.9 if isinstance(shape, Spring) else 0)
    if isinstance(shape, Arrow):
        slack += 0.2 * diagonal(ideal)
    for seed in SEEDS:
        ink = np.concatenate([resample(path, 200) for path in draw(shape, seed)])
        apart = cdist(ink, ideal)
        assert apart.min(axis=1).max() < slack
        assert apart.min(axis=0).max() < slack


@pytest.mark.parametrize("corners", [3, 4, 5])
def test_a_polygon_in_pieces_has_from_two_strokes_to_one_for_each_side(corners):
    angle = np.arange(corners) * 2 * np.pi / corners
    shape = Polygon(100 * np.column_stack([np.cos(angle), np.sin(angle)]))
    counts = {len(draw(shape, seed, pieces=1.0)) for seed in SEEDS}
    assert counts == set(range(2, corners + 1))
    assert {len(draw(shape, seed, pieces=0.0)) for seed in SEEDS} == {1}


def test_coils_cross_themselves_and_zigzags_do_not():
    spring = Spring((50, 50), (50, 170), 6, 24)
    for seed in SEEDS:
        (coil,) = draw(spring, seed, zigzag=0.0)
        (zigzag,) = draw(spring, seed, zigzag=1.0)
        assert len(self_intersections(coil)) >= 5
        assert len(self_intersections(zigzag)) == 0


def test_closed_shapes_are_drawn_both_ways_round():
    def sense(path):
        return float(np.sign(signed_area(path)))

    for shape in SHAPES[:3]:
        assert {sense(draw(shape, seed, pieces=0.0)[0]) for seed in SEEDS} == {-1.0, 1.0}


def test_a_tap_lies_inside_its_solid_even_in_a_thin_one():
    solids = [*SHAPES[:3], Polygon([(0, 0), (400, 0), (400, 12), (0, 12)])]
    for shape in solids:
        for seed in SEEDS:
            dot = drawing.tap(shape, np.random.default_rng(seed))
            assert contains(shape, tuple(dot.mean(axis=0).tolist()))
            assert diagonal(dot) < 10


def test_a_link_is_led_to_the_ink_of_what_it_joins_and_nowhere_if_that_is_far():
    wire = Wire((0, 0), (100, 0))
    near, far = Stroke([(-6.0, -40), (-6, 40)]), Stroke([(160.0, -40), (160, 40)])
    ball = Circle((500, 500), 5)
    solids = {"A": drawing.Drawn(ball, [near]), "B": drawing.Drawn(ball, [far])}
    led = drawing.led_to(wire, ("A", "B"), solids)
    assert led.start == pytest.approx((-6, 0), abs=0.5)
    assert led.end == (100, 0)
    assert drawing.led_to(wire, (None, None), {}) == wire


def test_a_link_meant_for_a_corner_is_led_to_the_corner_drawn():
    box = Polygon([(0, 0), (100, 0), (100, 80), (0, 80)])
    wire = Wire((-50, -50), (0, 0))
    for shift in ((-6, -6), (7, -3), (-4, 8), (6, 6)):
        drawn = Stroke(np.concatenate([box.vertices, box.vertices[:1]]) + shift)
        led = drawing.led_to(wire, (None, "A"), {"A": drawing.Drawn(box, [drawn])})
        assert led.end == pytest.approx(shift, abs=3)
