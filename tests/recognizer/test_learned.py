"""The learned rival's own laws: features that do not care for place, scale or rate; the contract of its weights."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer.learned.features import (
    GLOBAL_FEATURES,
    PAGE_FEATURES,
    POINTS,
    SEQUENCE_CHANNELS,
    both_ways,
    of_strokes,
    page_features,
)
from recognizer.learned.recognizer import WEIGHTS, Learned, WeightsError
from sketch.geometry import resample
from sketch.ink import FloatArray, Ink, Stroke


def _ring(points: int = 80) -> FloatArray:
    """An oval without symmetry: counts of swings are not decided by rounding."""
    angle = np.linspace(0.3, 2 * np.pi + 0.3, points)
    return np.column_stack(
        [90 * np.cos(angle) + 5 * np.sin(3 * angle), 60 * np.sin(angle) + 3 * np.cos(2 * angle)]
    )


def _zigzag() -> FloatArray:
    return resample(np.array([(10.0 * k + k % 3, (25.0 + k) * (k % 2)) for k in range(9)]), 120)


def test_shapes_are_as_documented() -> None:
    sequence, overall = of_strokes([_ring(), _zigzag(), _ring(7)])
    assert sequence.shape == (3, len(SEQUENCE_CHANNELS), POINTS)
    assert overall.shape == (3, len(GLOBAL_FEATURES))


@settings(max_examples=40, deadline=None)
@given(
    scale=st.floats(0.05, 50),
    x=st.floats(-1e4, 1e4),
    y=st.floats(-1e4, 1e4),
)
def test_features_do_not_depend_on_place_and_scale(scale: float, x: float, y: float) -> None:
    for points in (_ring(), _zigzag()):
        moved = points * scale + np.array([x, y])
        for here, there in zip(of_strokes([points]), of_strokes([moved]), strict=True):
            assert np.allclose(here, there, atol=1e-5)


def test_features_hardly_depend_on_the_sampling_rate() -> None:
    sparse, dense = resample(_ring(2000), 60), resample(_ring(2000), 900)
    for here, there in zip(of_strokes([sparse]), of_strokes([dense]), strict=True):
        assert np.abs(here - there).max() < 0.05


def test_both_ways_is_the_stroke_and_its_reverse() -> None:
    both = both_ways([_zigzag()])
    forth, back = of_strokes([_zigzag()]), of_strokes([_zigzag()[::-1]])
    for channel in (0, 1):
        assert np.allclose(both[channel][0], forth[channel][0])
        assert np.allclose(both[channel][1], back[channel][0], atol=1e-9)


def test_crossings_are_counted_where_they_are() -> None:
    eight = np.linspace(0, 2 * np.pi, 200)
    crossing = GLOBAL_FEATURES.index("crossings")
    _, overall = of_strokes([np.column_stack([np.sin(eight + 0.3), np.sin(2 * (eight + 0.3))]), _zigzag()])
    assert overall[:, crossing] * 10 == pytest.approx([1, 0])


@pytest.mark.parametrize("points", [[(3, 4)], [(3, 4)] * 5, [(0, 0), (1, 0)], [(0, 0), (5, 5), (0, 0)]])
def test_degenerate_strokes_have_finite_features(points: list[tuple[float, float]]) -> None:
    for array in of_strokes([np.array(points, dtype=float)]):
        assert np.isfinite(array).all()


def test_a_stroke_alone_has_no_page() -> None:
    assert np.array_equal(page_features(Ink((Stroke(_ring()),))), np.zeros((1, len(PAGE_FEATURES))))


def test_what_a_loop_encloses_is_seen() -> None:
    inside = [Stroke(0.02 * _ring() + np.array([x, 0.0])) for x in (-40.0, 0.0, 40.0)]
    page = Ink((Stroke(_ring()), *inside, Stroke(_ring() + np.array([500.0, 0.0]))))
    assert page_features(page)[:, -1] == pytest.approx([0.75, 0, 0, 0, 0])


def test_claims_do_not_depend_on_how_many_strokes_are_read_at_once() -> None:
    page = Ink(tuple(Stroke(_zigzag() + np.array([30.0 * k, 0.0])) for k in range(300)))
    scores = np.array([claim.scores for claim in Learned().recognize(page)])
    assert np.abs(scores - scores[0]).max() < 1e-4


def test_the_card_beside_the_weights_belongs_to_them() -> None:
    card = json.loads(WEIGHTS.with_suffix(".json").read_text("utf-8"))
    assert card["parameters"] <= 150_000
    assert card["parity_with_torch"] < 1e-5
    assert WEIGHTS.stat().st_size < 1_000_000
    assert not list(WEIGHTS.parent.glob("*.data")), "the ONNX file must stand alone"


def test_missing_weights_are_explained(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match="inklined train"):
        Learned(tmp_path / "none.onnx")


def test_a_file_that_is_no_net_is_explained(tmp_path: Path) -> None:
    broken = tmp_path / "broken.onnx"
    broken.write_bytes(b"not a net")
    with pytest.raises(WeightsError, match="not a usable ONNX file"):
        Learned(broken)


@settings(max_examples=60, deadline=None)
@given(
    x=st.floats(-1e5, 1e5),
    y=st.floats(-1e5, 1e5),
    angle=st.floats(0, 6.3),
    length=st.floats(20, 500),
    points=st.integers(12, 200),
)
def test_an_exactly_straight_line_is_a_wire_wherever_it_stands(
    x: float, y: float, angle: float, length: float, points: int
) -> None:
    along = np.linspace(0, length, points)
    line = np.array([x, y]) + along[:, None] * np.array([np.cos(angle), np.sin(angle)])
    (claim,) = Learned().recognize(Ink((Stroke(line),)))
    assert claim.kind == "wire"
