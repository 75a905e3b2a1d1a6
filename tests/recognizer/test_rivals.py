"""Laws that every rival obeys: what is no matter to a reader is no matter to a recognizer.

The shapes are ideal and clear: every rival that can claim their kind must be on the right side of
its bounds with room to spare, so that resampling (which cuts corners) cannot push it over.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from data_gen import ideals
from recognizer.claims import Recognizer
from recognizer.oracle import Oracle
from recognizer.roster import ROSTER, recognizer
from sketch.geometry import resample
from sketch.ink import Ink, Stroke
from sketch.page import STROKE_KINDS, Component, Expression, Sketch, StrokeKind
from sketch.shapes import Wire

NAMES = list(ROSTER)
RIVALS: dict[str, Recognizer] = {}

SECONDS = 4.0
"""Time of a stroke: at 20 Hz it still has 80 points, twenty on each turn of the coil."""

CLEAR: tuple[tuple[StrokeKind, np.ndarray], ...] = (
    ("circle", ideals.circle((50, 50), 60, 0.4, 2 * np.pi * 1.01)),
    ("circle", ideals.superellipse((0, 0), (70, 58), -1.2, -2 * np.pi * 0.99)),
    ("polygon", ideals.polygon([[0, 0], [140, 0], [140, 90], [0, 90]])),
    ("polygon", ideals.polygon([[0, 160], [200, 160], [200, 40]])),
    ("spring", ideals.coil((0, 0), (240, 20), 4, 100, 0.0, 0.9)),
    ("wire", ideals.circle((0, 0), 600, 0.2, 0.3)),  # a bow of 1.9 %: hands draw no mathematical lines
)
"""What the rules of the paper can claim too."""
ZIGZAG = ideals.zigzag((0, 0), (220, 20), 8, 70, 0.05)
"""The paper's springs are coils: zig-zags are for the others."""


def rival(name: str) -> Recognizer:
    if name not in RIVALS:
        RIVALS[name] = recognizer(name)
    return RIVALS[name]


def clear(name: str) -> list[tuple[StrokeKind, np.ndarray]]:
    return [*CLEAR] if name == "paper" else [*CLEAR, ("spring", ZIGZAG)]


def page(paths: list[np.ndarray], rate: float = 100.0, backwards: bool = False) -> Ink:
    """One stroke for each path, drawn at an even pace in `SECONDS`, sampled at `rate` Hz."""
    count = round(SECONDS * rate) + 1
    times = np.linspace(0.0, SECONDS, count)
    points = [resample(path[::-1] if backwards else path, count) for path in paths]
    return Ink(tuple(Stroke(path, times + 3.0 * k) for k, path in enumerate(points)))


def kinds(name: str, ink: Ink) -> list[StrokeKind]:
    return [claim.kind for claim in rival(name).recognize(ink)]


def apart(paths: list[np.ndarray]) -> list[np.ndarray]:
    """The paths in a row, so that none lies within another."""
    return [path + np.array([400.0 * k, 0.0]) for k, path in enumerate(paths)]


@pytest.mark.parametrize("name", NAMES)
def test_clear_shapes_are_what_they_are(name: str) -> None:
    shapes = clear(name)
    assert kinds(name, page(apart([path for _, path in shapes]))) == [kind for kind, _ in shapes]


@pytest.mark.parametrize("name", NAMES)
@given(st.floats(-5000, 5000), st.floats(-5000, 5000))
@settings(max_examples=8, deadline=None)
def test_moving_the_page_changes_no_claim(name: str, x: float, y: float) -> None:
    paths = apart([path for _, path in clear(name)])
    assert kinds(name, page([path + np.array([x, y]) for path in paths])) == [kind for kind, _ in clear(name)]


@pytest.mark.parametrize("name", NAMES)
@given(st.floats(0.2, 5.0))
@settings(max_examples=12, deadline=None)
def test_scaling_the_page_changes_no_claim(name: str, scale: float) -> None:
    paths = apart([path for _, path in clear(name)])
    assert kinds(name, page([scale * path for path in paths])) == [kind for kind, _ in clear(name)]


@pytest.mark.parametrize("name", NAMES)
@given(st.floats(20.0, 250.0))
@settings(max_examples=12, deadline=None)
def test_the_sampling_rate_changes_no_claim(name: str, rate: float) -> None:
    paths = apart([path for _, path in clear(name)])
    assert kinds(name, page(paths, rate)) == [kind for kind, _ in clear(name)]


@pytest.mark.parametrize("name", NAMES)
def test_the_direction_of_drawing_changes_no_claim(name: str) -> None:
    paths = apart([path for _, path in clear(name)])
    assert kinds(name, page(paths, backwards=True)) == [kind for kind, _ in clear(name)]


@pytest.mark.parametrize("name", NAMES)
def test_a_stroke_alone_is_recognized_at_every_scale(name: str) -> None:
    for kind, path in clear(name):
        for scale in (0.2, 1.0, 5.0):
            assert kinds(name, page([scale * path])) == [kind]


@pytest.mark.parametrize("name", NAMES)
def test_claims_are_probabilities_over_the_kinds_it_can_claim(name: str) -> None:
    rng = np.random.default_rng(5)
    paths = [rng.standard_normal((30, 2)).cumsum(axis=0) * 9 for _ in range(40)]
    for claim in rival(name).recognize(Ink(tuple(Stroke(path) for path in paths))):
        assert claim.scores.sum() == pytest.approx(1)
        assert claim.kind in rival(name).claims


BAD: dict[str, Ink] = {
    "an empty page": Ink(),
    "one dot": Ink((Stroke([[5.0, 5.0]]),)),
    "identical points": Ink((Stroke([[5.0, 5.0]] * 40), Stroke([[5.0, 5.0]] * 40))),
    "two points": Ink((Stroke([[0.0, 0.0], [100.0, 0.0]]),)),
    "a line there and back": Ink((Stroke([[0.0, 0.0], [100.0, 0.0], [0.0, 0.0]]),)),
    "huge": Ink((Stroke(1e8 * ideals.circle((0, 0), 5)),)),
    "tiny": Ink((Stroke(1e-6 * ideals.circle((0, 0), 5)),)),
    "far away": Ink((Stroke(ideals.circle((9e8, -9e8), 5)),)),
    "200,000 points": Ink((Stroke(resample(ideals.circle((0, 0), 50), 200_000)),)),
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("what", list(BAD))
def test_any_ink_gets_one_claim_a_stroke(name: str, what: str) -> None:
    claims = rival(name).recognize(BAD[what])
    assert len(claims) == len(BAD[what])
    assert claims == () or np.isfinite([claim.scores for claim in claims]).all()


def test_a_lone_dot_is_a_tap_to_those_that_claim_taps() -> None:
    for name in ("geometric", "learned"):
        assert kinds(name, BAD["one dot"]) == ["tap"]


def test_an_unknown_name_is_refused_with_the_known_ones() -> None:
    with pytest.raises(
        ValueError, match=r"no recognizer is called 'psychic'; known are paper, geometric, learned"
    ):
        recognizer("psychic")


def test_the_oracle_says_what_it_was_told_and_rejects_what_belongs_to_nobody() -> None:
    ink = page(apart([path for _, path in CLEAR[:3]]))
    truth = Sketch(ink, (Component(Wire((0, 0), (1, 1)), (0,)),), (Expression("g = 10", (2,)),))
    claims = Oracle(truth).recognize(ink)
    assert [(claim.kind, claim.rejected) for claim in claims] == [
        ("wire", False),
        ("math", True),
        ("math", False),
    ]


def test_the_oracle_refuses_another_page() -> None:
    with pytest.raises(ValueError, match="told of another page"):
        Oracle(Sketch()).recognize(BAD["one dot"])


def test_geometric_sees_arrows_scribbles_lassos_and_taps_in_their_places() -> None:
    box = ideals.polygon([[0, 0], [140, 0], [140, 90], [0, 90]])
    scribble = ideals.zigzag((300, 20), (360, 25), 14, 120, 0.0)
    erased = ideals.line((280, 0), (380, 40))
    lasso = ideals.superellipse((70, 45), (130, 90), 0.3, 2 * np.pi * 0.97)
    arrow = ideals.arrow((500, 0), (620, 30), 30, 0.5)
    drawn = page([box, erased, scribble, arrow, lasso]).strokes
    tap = Stroke([[70.0, 45.0], [70.5, 45.4]], [20.0, 20.1])
    found = kinds("geometric", Ink((drawn[0], tap, *drawn[1:])))
    assert found == ["polygon", "tap", "wire", "scribble", "arrow", "lasso"]


@pytest.mark.parametrize("name", NAMES)
def test_every_kind_that_a_rival_claims_is_a_kind(name: str) -> None:
    assert rival(name).claims <= frozenset(STROKE_KINDS)
