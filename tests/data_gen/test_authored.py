"""Laws of the drawings that are authored for the net to learn from: they are what they say, of any seed, all unlike."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from data_gen.authored import NAMES, SIGNS, flow_arrows, oddities, signs
from data_gen.flow_arrows import FlowRule, flow_arrow
from data_gen.glyphs import alphabet
from data_gen.hand.doodles import DOODLES
from data_gen.oddities import ODDITIES
from data_gen.strokes import Recipe

EXACT = FlowRule(
    elbows=(1.0, 0.0, 0.0, 0.0),
    askew=0.0,
    head=(0.2, 0.2),
    opening=(0.5, 0.5),
    uneven=0.0,
    off=0.0,
    short=0.0,
)


@pytest.mark.parametrize("made", [oddities, flow_arrows, signs])
def test_an_item_depends_on_its_seed_and_number_alone(made) -> None:
    several, one = made(6, seed=3), made(1, seed=3, start=4)
    assert one[0].index == several[4].index == 4 and one[0].count == several[4].count
    assert one[0].strokes == several[4].strokes
    assert made(6, seed=4)[4].strokes != several[4].strokes


def test_kinds_are_those_that_are_meant() -> None:
    assert {item.kind for item in oddities(20, seed=1)} == {None}
    assert {item.kind for item in flow_arrows(20, seed=1)} == {"arrow"}
    assert {item.kind for item in signs(20, seed=1)} == {"math"}
    assert {item.count for item in signs(40, seed=1)} == {len(strokes) for strokes in SIGNS.values()}


def test_every_family_is_drawn_and_bears_its_number() -> None:
    numbers = {item.count for item in oddities(1500, seed=2)}
    assert {NAMES[number] for number in numbers} == set(ODDITIES)
    assert NAMES[: len(DOODLES)] == DOODLES and len(set(NAMES)) == len(NAMES)


@pytest.mark.parametrize("name", ODDITIES)
def test_no_two_drawings_of_a_family_are_alike(name: str) -> None:
    one, other = (ODDITIES[name](np.random.default_rng(seed)) for seed in (1, 2))
    for path in (*one, *other):
        assert path.ndim == 2 and path.shape[1] == 2 and len(path) > 1 and np.isfinite(path).all()
    assert len(one) != len(other) or any(
        a.shape != b.shape or not np.allclose(a, b) for a, b in zip(one, other, strict=True)
    )


def test_a_curve_goes_through_its_knots() -> None:
    for name in alphabet.objects():
        for points, corners in alphabet.knots(name):
            path = alphabet.curve(points, corners)
            apart = np.linalg.norm(path[:, None] - points, axis=2)
            assert apart.min(axis=0).max() < 1e-9, name


@pytest.mark.parametrize("seed", range(12))
def test_the_barbs_of_an_exact_arrow_stand_at_its_opening_from_the_shaft(seed: int) -> None:
    strokes = flow_arrow(np.random.default_rng(seed), replace(EXACT, head=(0.2, 0.2)))
    every = np.concatenate(strokes)
    # The tip is where the barbs meet: the point with another at a barb's length in two directions a head's width apart.
    away = np.linalg.norm(every[:, None] - every, axis=2)
    barbs = np.isclose(away, 0.2, atol=0.015)
    spread = 2 * 0.2 * np.sin(0.5)
    assert any(
        np.isclose(away[a, b], spread, atol=0.03)
        for row in barbs
        for a in np.flatnonzero(row)
        for b in np.flatnonzero(row)
    )


def test_variations_can_be_left_out() -> None:
    plain = Recipe(without=("quantisation", "jitter", "tremor", "missing"))
    assert oddities(3, 5, recipe=plain)[0].strokes != oddities(3, 5)[0].strokes
