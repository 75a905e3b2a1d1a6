"""Fitting: what was drawn exactly is found exactly; what was drawn with a waver, nearly."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen import ideals
from recognizer.fit import fit, joined
from sketch.geometry import resample
from sketch.ink import FloatArray, Stroke
from sketch.shapes import COMPONENT_KINDS, Arrow, Circle, Polygon, Spring, Wire

PLACES = st.floats(-2000, 2000)
SIZES = st.floats(0.5, 500)


def drawn(path: FloatArray, count: int = 160) -> list[Stroke]:
    return [Stroke(resample(path, count))]


def wavering(path: FloatArray, seed: int, share: float = 0.004) -> list[Stroke]:
    """The path with white noise of this share of its size: a shaky digitiser."""
    points = resample(path, 160)
    noise = np.random.default_rng(seed).standard_normal(points.shape)
    return [Stroke(points + share * float(np.ptp(points)) * noise)]


def corners_apart(found: FloatArray, meant: FloatArray) -> float:
    """Largest distance of a meant corner from the nearest one found."""
    away = np.hypot(*(meant[:, None] - found[None]).transpose(2, 0, 1))
    return float(away.min(axis=1).max())


@given(PLACES, PLACES, SIZES, st.floats(-3, 3))
@settings(max_examples=40, deadline=None)
def test_a_circle_is_found_where_it_was_drawn(x: float, y: float, radius: float, start: float) -> None:
    shape = fit("circle", drawn(ideals.circle((x, y), radius, start)))
    assert isinstance(shape, Circle)
    assert shape.centre == pytest.approx((x, y), abs=0.003 * radius)
    assert shape.radius == pytest.approx(radius, rel=0.003)


@pytest.mark.parametrize("sweep", [0.9, 1.0, 1.15])
def test_an_open_or_overlapping_circle_is_the_same_circle(sweep: float) -> None:
    shape = fit("circle", wavering(ideals.circle((10, 20), 50, 0.3, 2 * np.pi * sweep), 1))
    assert isinstance(shape, Circle)
    assert shape.centre == pytest.approx((10, 20), abs=0.5)
    assert shape.radius == pytest.approx(50, abs=0.5)


@pytest.mark.parametrize(
    "vertices",
    [
        [[0, 0], [120, 0], [120, 80], [0, 80]],
        [[0, 100], [180, 100], [180, 0]],
        [[60, 0], [120, 50], [60, 100], [0, 50]],
        [[30, 0], [130, 0], [100, 70], [0, 70]],
        [[0, 0], [400, 0], [400, 30], [0, 30]],
        [[50, 0], [98, 35], [79, 90], [21, 90], [2, 35]],
        [[100, 50], [75, 93], [25, 93], [0, 50], [25, 7], [75, 7]],
    ],
)
@pytest.mark.parametrize("start", [0.0, 0.5, 1.3])
def test_a_polygon_has_the_corners_that_were_drawn(vertices: list[list[float]], start: float) -> None:
    meant = np.array(vertices, dtype=float)
    size = float(np.ptp(meant))
    for seed in range(3):
        shape = fit("polygon", wavering(ideals.polygon(meant, start, 0.01), seed, 0.002))
        assert isinstance(shape, Polygon)
        assert len(shape.vertices) == len(meant)
        assert corners_apart(shape.vertices, meant) < 0.03 * size


def test_a_plank_whose_end_was_left_over_is_a_plank_and_no_needle() -> None:
    """Its short side is drawn first and overshoots: it is cut off as what hangs over, but there is ink of it."""
    path = np.array([[5, -20], [0, 4], [0, 8], [250, 5], [500, 16], [508, -25], [250, -28], [-2, 2.0]])
    shape = fit("polygon", drawn(path, 300))
    assert isinstance(shape, Polygon)
    assert len(shape.vertices) == 4
    left = shape.vertices[shape.vertices[:, 0] < 100]
    assert len(left) == 2
    assert np.ptp(left[:, 1]) > 20
    wedge = fit("polygon", drawn(ideals.polygon([[0, 100], [400, 100], [400, 20]], 0.5, 0.0)))
    assert isinstance(wedge, Polygon)
    assert len(wedge.vertices) == 3


def test_polygons_are_convex_whatever_was_drawn() -> None:
    dart = ideals.polygon([[0, 0], [100, 50], [0, 100], [35, 50]])
    shape = fit("polygon", drawn(dart))
    assert isinstance(shape, Polygon)
    steps = np.roll(shape.vertices, -1, axis=0) - shape.vertices
    after = np.roll(steps, -1, axis=0)
    cross = steps[:, 0] * after[:, 1] - steps[:, 1] * after[:, 0]
    assert (np.sign(cross) == np.sign(cross[0])).all()


@pytest.mark.parametrize("pieces", [(2, 2), (1, 1, 1, 1), (3, 1)])
def test_a_rectangle_in_pieces_is_the_same_rectangle(pieces: tuple[int, ...]) -> None:
    corners = np.array([[0.0, 0.0], [120, 0], [120, 80], [0, 80], [0, 0]])
    starts = np.cumsum((0, *pieces))
    strokes = [
        drawn(corners[a : a + n + 1][:: -1 if k % 2 else 1], 60)[0]
        for k, (a, n) in enumerate(zip(starts, pieces, strict=False))
    ]
    assert np.allclose(np.unique(joined(strokes).round(6), axis=0)[0], [0, 0])
    shape = fit("polygon", strokes[::-1])
    assert isinstance(shape, Polygon)
    assert len(shape.vertices) == 4
    assert corners_apart(shape.vertices, corners[:4]) < 2.0


@given(PLACES, PLACES, st.floats(-3, 3), SIZES)
@settings(max_examples=30, deadline=None)
def test_a_wire_runs_from_end_to_end(x: float, y: float, angle: float, length: float) -> None:
    end = (x + length * np.cos(angle), y + length * np.sin(angle))
    shape = fit("wire", drawn(ideals.line((x, y), end)))
    assert isinstance(shape, Wire)
    assert shape.start == pytest.approx((x, y), abs=1e-6 * (1 + length))
    assert shape.end == pytest.approx(end, abs=1e-6 * (1 + length))


def test_a_hook_does_not_turn_a_wire() -> None:
    hooked = np.array([[-2.0, 4.0], [0.0, 0.0], [200.0, 0.0]])
    shape = fit("wire", drawn(hooked))
    assert isinstance(shape, Wire)
    assert abs(np.degrees(np.arctan2(shape.end[1] - shape.start[1], shape.end[0] - shape.start[0]))) < 0.5


@pytest.mark.parametrize("coils", [3, 5, 8])
def test_a_spring_has_its_ends_its_width_and_about_its_teeth(coils: int) -> None:
    shape = fit("spring", drawn(ideals.zigzag((10, 10), (210, 60), 2 * coils, 40, 0.1), 400))
    assert isinstance(shape, Spring)
    assert shape.start == pytest.approx((10, 10))
    assert shape.end == pytest.approx((210, 60))
    assert shape.coils == pytest.approx(coils, abs=1)
    assert shape.width == pytest.approx(40, rel=0.15)


@pytest.mark.parametrize("backwards", [False, True])
def test_an_arrow_points_from_tail_to_tip(backwards: bool) -> None:
    path = ideals.arrow((0, 0), (100, 40), 25, 0.5)
    shape = fit("arrow", drawn(path[::-1] if backwards else path))
    assert isinstance(shape, Arrow)
    assert shape.start == pytest.approx((0, 0), abs=2)
    assert shape.end == pytest.approx((100, 40), abs=2)


def test_an_arrow_in_two_strokes_points_to_its_head() -> None:
    shaft, head = drawn(ideals.line((100, 0), (0, 0))), drawn(np.array([[80.0, 12], [102, 0], [80, -12]]))
    assert fit("arrow", [*shaft, *head]) == Arrow((0.0, 0.0), (100.0, 0.0))


@pytest.mark.parametrize("kind", COMPONENT_KINDS)
def test_ink_without_extent_has_no_shape(kind) -> None:
    assert fit(kind, [Stroke([[3.0, 4.0]])]) is None
    assert fit(kind, [Stroke([[3.0, 4.0]] * 20)]) is None


@pytest.mark.parametrize("kind", COMPONENT_KINDS)
@pytest.mark.parametrize("seed", range(8))
def test_any_ink_gives_a_shape_of_the_kind_or_none(kind, seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.standard_normal((int(rng.integers(2, 60)), 2)).cumsum(axis=0)
    shape = fit(kind, [Stroke(points * [1.0, rng.choice([0.0, 1.0])])])
    assert shape is None or type(shape).__name__.lower() == kind
