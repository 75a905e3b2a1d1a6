"""Links are attached to what they were drawn to: the shape, or the ink that it was made from."""

from __future__ import annotations

import numpy as np
import pytest

from recognizer.attach import Solids
from sketch.ink import Stroke
from sketch.shapes import Polygon, Wire

BOX = Polygon([(200.0, 260.0), (300.0, 260.0), (300.0, 320.0), (200.0, 320.0)])
CEILING = Polygon([(100.0, 0.0), (200.0, 0.0), (200.0, 40.0), (100.0, 40.0)])
WIRE = Wire((150.0, 41.0), (198.0, 238.0))


def strokes(shape: Polygon, *more: tuple[float, float]) -> list[Stroke]:
    return [Stroke(np.concatenate([np.array(more).reshape(-1, 2), shape.vertices, shape.vertices[:1]]))]


def test_an_end_that_stops_short_of_a_shape_reaches_the_ink_that_stands_over() -> None:
    far = Wire(WIRE.start, (198.0, 230.0))
    assert Solids([CEILING, BOX]).ends(far) is None
    drawn = [strokes(CEILING), strokes(BOX, (199.0, 234.0))]
    assert Solids([CEILING, BOX], drawn).ends(far) == (0, 1)


def test_ink_far_away_attaches_nothing() -> None:
    away = Wire(WIRE.start, (198.0, 150.0))
    assert Solids([CEILING, BOX], [strokes(CEILING), strokes(BOX)]).ends(away) is None


@pytest.mark.parametrize("points", [[[200.0, 260.0]], [[200.0, 260.0], [200.0, 260.0]]])
def test_a_solid_of_a_single_point_of_ink_is_no_trouble(points: list[list[float]]) -> None:
    drawn = [strokes(CEILING), [Stroke(points)]]
    assert Solids([CEILING, BOX], drawn).ends(Wire(WIRE.start, (205.0, 255.0))) == (0, 1)
