"""Our $P and $1 beside other people's: dollarpy and dollar-one-recognizer-py, test dependencies only.

Both were written by others from the same papers. Distances differ a little where resampling does: theirs walks along the
path adding up rounding, ours interpolates; the nearest template is the same but where two are nearly as near.
"""

from __future__ import annotations

import numpy as np
import pytest

from data_gen.strokes import generate
from recognizer.templates.dollar_one import DollarOne
from recognizer.templates.dollar_p import DollarP
from sketch.ink import Ink, Stroke

MIX = {"circle": 0.2, "polygon": 0.2, "spring": 0.2, "arrow": 0.2, "math": 0.2}
TEMPLATES, GESTURES = 12, 40
NEARLY = 0.03
"""Two templates whose distances differ by less than this share are nearly as near."""


@pytest.fixture(scope="module")
def drawn() -> list[Ink]:
    strokes = [item.stroke.points for item in generate(TEMPLATES + GESTURES, 5, mix=MIX)]
    # On the positive side of both axes: dollarpy takes 0 for the lowest of all maxima.
    rough = [points - points.min(axis=0) + 10.0 for points in strokes]
    return [Ink((Stroke(points),)) for points in rough if len(points) > 8]


def test_p_agrees_with_dollarpy(drawn):
    dollarpy = pytest.importorskip("dollarpy")

    def theirs(ink: Ink) -> list:
        return [dollarpy.Point(x, y, k) for k, stroke in enumerate(ink) for x, y in stroke.points.tolist()]

    parts = [_in_parts(ink) if k % 3 == 0 else ink for k, ink in enumerate(drawn)]
    templates, gestures = parts[:TEMPLATES], parts[TEMPLATES:]
    ours = DollarP.of(templates, np.arange(TEMPLATES)).distances(gestures)
    other = np.empty_like(ours)
    for i, gesture in enumerate(gestures):
        for j, template in enumerate(templates):
            # It puts the points that it resamples into what it is given: a new template every time.
            peer = dollarpy.Recognizer([dollarpy.Template("it", theirs(template))])
            _, score = peer.recognize(theirs(gesture))
            other[i, j] = 2 - 2 * score  # all it tells; distances of 2 and more are told as 2
    near = other < 1.9
    assert near.sum() > 20
    assert ours[near] == pytest.approx(other[near], rel=0.12, abs=0.08)
    assert np.median(np.abs(ours[near] - other[near])) < 0.02
    _same_nearest(ours[near.any(axis=1)], np.where(near, other, np.inf)[near.any(axis=1)])


def test_one_agrees_with_dollar_one_recognizer_py(drawn):
    peers = pytest.importorskip("dollar_one_recognizer_py")
    templates, gestures = drawn[:TEMPLATES], drawn[TEMPLATES:][:12]
    ours = DollarOne.of(templates, np.arange(TEMPLATES)).distances(gestures)
    other = np.empty_like(ours)
    for j, template in enumerate(templates):
        peer = peers.dollar_one_recognizer(250, [template[0].points.tolist()], ["it"], 64)
        for i, gesture in enumerate(gestures):
            _, _, score = peer.recognize(gesture[0].points.tolist())
            other[i, j] = (1 - score) * 0.5 * np.hypot(250, 250)
    assert ours == pytest.approx(other, rel=0.05, abs=0.5)
    _same_nearest(ours, other)


def _same_nearest(ours: np.ndarray, other: np.ndarray) -> None:
    for mine, theirs in zip(ours, other, strict=True):
        assert theirs[mine.argmin()] <= theirs.min() * (1 + NEARLY) + 0.02


def _in_parts(ink: Ink) -> Ink:
    points = ink[0].points
    cut = len(points) // 2
    return Ink((Stroke(points[: cut + 1]), Stroke(points[cut + 1 :] + np.array([12.0, 0.0]))))
